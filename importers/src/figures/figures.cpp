#include "figures/figures.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "figures/actor_figures.h"
#include "figures/shape_mesh.h"
#include "figures/turned_profile.h"

namespace tweenfall::figures {

namespace {

bool is_plane(const BodyDescription& body) {
  return std::holds_alternative<Plane>(body.shape.solid);
}

/// The center of mass, the vertices, and the ends of sharp edges, unless there are many, as on nearly round hulls.
std::vector<Vec3> hull_points(const ConvexHull& hull) {
  constexpr double sharp = 0.866;  // cosine of the least angle between the faces of an edge that is drawn
  constexpr std::size_t many = 16;
  std::vector<Vec3> points(1, hull.measures().center);
  points.insert(points.end(), hull.vertices().begin(), hull.vertices().end());
  const std::size_t before = points.size();
  for (const ConvexHull::Edge& edge : hull.edges()) {
    if (hull.faces()[edge.left].normal.dot(hull.faces()[edge.right].normal) > sharp) continue;
    points.push_back(hull.vertices()[edge.from]);
    points.push_back(hull.vertices()[edge.to]);
  }
  if (points.size() > before + 2 * many) points.resize(before);
  return points;
}

/// The middle of a solid turned about y, and places all around it.
std::vector<Vec3> turned_points(const std::vector<ProfilePoint>& profile) {
  constexpr int around = 24;
  std::vector<Vec3> points(1, Vec3(0, 0.5 * (profile.front().height + profile.back().height), 0));
  for (const ProfilePoint& point : profile)
    for (int i = 0; i < around; ++i) {
      const auto [sine, cosine] = elementary::sin_cos(2 * std::numbers::pi * i / around);
      points.emplace_back(point.radius * sine, point.height, point.radius * cosine);
    }
  return points;
}

/// Replaces the vertices by those that are farthest in directions all around.
std::vector<Vec2> outlined(const std::vector<Vec2>& points, std::size_t vertices) {
  std::vector<Vec2> result = {points.front()};
  for (std::size_t i = 0; i < hull_outline; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(hull_outline);
    const auto [sine, cosine] = elementary::sin_cos(angle);
    std::size_t farthest = 1;
    double reach = 0;
    for (std::size_t k = 1; k <= vertices; ++k) {
      const double* const point = points[k].data();
      const double along = cosine * point[0] + sine * point[1];
      if (k > 1 && !(along > reach + 1e-9)) continue;
      farthest = k;
      reach = along;
    }
    result.push_back(points[farthest]);
  }
  result.insert(result.end(), points.begin() + 1 + static_cast<std::ptrdiff_t>(vertices), points.end());
  return result;
}

/// Points of one shape on a node, in the node's space; `scale` is the node's.
std::vector<Vec3> outline(const Shape& shape, Figure& figure, double scale) {
  std::vector<Vec3> points;
  if (const auto* sphere = std::get_if<Sphere>(&shape.solid)) {
    figure.kind = Figure::Kind::ball;
    figure.radius = sphere->radius * scale;
    points = {Vec3(0, 0, 0), Vec3(0, sphere->radius, 0)};
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.solid)) {
    figure.kind = Figure::Kind::stick;
    figure.radius = capsule->radius * scale;
    points = {Vec3(0, -capsule->half_height, 0), Vec3(0, capsule->half_height, 0)};
  } else if (const auto* box = std::get_if<Box>(&shape.solid)) {
    figure.kind = Figure::Kind::box;
    for (int i = 0; i < 8; ++i)
      points.push_back(box->half_extents.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  }
  if (const auto* hull = std::get_if<Hull>(&shape.solid)) {
    figure.kind = Figure::Kind::hull;
    points = hull_points(hull->convex);
    figure.vertices = hull->convex.vertices().size();
  } else if (const std::vector<ProfilePoint> profile = turned_profile(shape.solid); !profile.empty()) {
    figure.kind = Figure::Kind::hull;
    points = turned_points(profile);
    figure.vertices = points.size() - 1;
  } else if (std::holds_alternative<Compound>(shape.solid) || is_scenery(shape.solid)) {
    figure.kind = Figure::Kind::hull;
    const Mesh mesh = shape_mesh({shape.solid});
    points = {is_scenery(shape.solid) ? Vec3(0, 0, 0) : mass_properties(Shape{shape.solid}, 1).center};
    points.insert(points.end(), mesh.positions.begin(), mesh.positions.end());
    figure.vertices = points.size() - 1;
  }
  for (Vec3& point : points)
    point = transform_point({shape.offset.position, shape.offset.rotation, Vec3(1, 1, 1)}, point);
  return points;
}

/// The corners of the box around a mesh with given morph weights.
std::vector<Vec3> box_around(const Mesh& mesh, const std::vector<double>& weights) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(infinite), high = Vec3::Constant(-infinite);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3 position = mesh.positions[v];
    for (std::size_t i = 0; i < std::min(weights.size(), mesh.morphs.size()); ++i)
      if (weights[i] != 0) position += weights[i] * mesh.morphs[i].position_offsets[v];
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  return corners;
}

void place(Figure& figure, const NodeRecord& node, const std::vector<Vec3>& points, Facing facing) {
  for (const WorldMotion& world : node.world) {
    std::vector<Vec2>& placed = figure.points.emplace_back();
    for (const Vec3& point : points) placed.push_back(flattened(world.point(point), facing));
  }
}

void place_mesh(Figure& figure, const NodeRecord& node, const Mesh& mesh, Facing facing) {
  const bool molded = !mesh.morphs.empty() && !node.weights.empty();
  std::vector<Vec3> corners = box_around(mesh, mesh.rest_weights);
  for (std::size_t frame = 0; frame < node.world.size(); ++frame) {
    if (molded && (frame == 0 || node.weights[frame] != node.weights[frame - 1]))
      corners = box_around(mesh, node.weights[frame]);
    std::vector<Vec2>& placed = figure.points.emplace_back();
    for (const Vec3& corner : corners) placed.push_back(flattened(node.world[frame].point(corner), facing));
  }
}

/// The smallest rectangle around a figure at a frame, in its own units; empty for one without points.
struct Rectangle {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec2& point, double radius = 0) {
    low = low.cwiseMin(point - Vec2::Constant(radius));
    high = high.cwiseMax(point + Vec2::Constant(radius));
  }
  [[nodiscard]] bool empty() const { return !(low.x() <= high.x()); }
};

std::vector<Rectangle> rectangles(const std::vector<Figure>& list, const Recording& recording, Facing facing) {
  std::vector<Rectangle> all;
  for (const ParticlesRecord& particles : recording.particles)
    for (const StageParticles& frame : particles.frame) {
      Rectangle around;
      for (const Vec3& place : frame.positions) around.add(flattened(place, facing));
      if (!around.empty()) all.push_back(around);
    }
  for (const Figure& figure : list)
    for (const std::vector<Vec2>& points : figure.points) {
      Rectangle around;
      for (const Vec2& point : points) around.add(point, figure.radius);
      if (!around.empty() && around.low.allFinite() && around.high.allFinite()) all.push_back(around);
    }
  return all;
}

/// Around everything or, where that is far larger than a rectangle around 96 of 100 of them, only around those, so that
/// something that flies off does not shrink the rest to a dot.
Rectangle around_most(const std::vector<Rectangle>& all) {
  Rectangle whole;
  for (const Rectangle& each : all) {
    whole.add(each.low);
    whole.add(each.high);
  }
  constexpr std::size_t few = 50;
  constexpr double far = 6;
  if (all.size() < few) return whole;
  Rectangle most;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> lows, highs;
    for (const Rectangle& each : all) {
      lows.push_back(each.low[axis]);
      highs.push_back(each.high[axis]);
    }
    std::sort(lows.begin(), lows.end());
    std::sort(highs.begin(), highs.end());
    most.low[axis] = lows[all.size() / few];
    most.high[axis] = highs[all.size() - 1 - all.size() / few];
  }
  const double size = (most.high - most.low).maxCoeff();
  return (whole.high - whole.low).maxCoeff() > far * size ? most : whole;
}

/// How far something gets along each axis, and the area that its way fills as seen from each side, if it is not a line.
struct Way {
  Vec3 range{0, 0, 0};  ///< m
  double front = 0, side = 0, above = 0;

  void add(std::size_t count, const auto& at) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low, mean(0, 0, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 place = at(i);
      if (!place.allFinite()) return;
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
      mean += place / static_cast<double>(count);
    }
    if (count == 0) return;
    Mat3 spread = Mat3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 off = at(i) - mean;
      spread += off * off.transpose() / static_cast<double>(count);
    }
    const auto area = [&spread](int a, int b) {
      return std::sqrt(std::max(0.0, spread(a, a) * spread(b, b) - spread(a, b) * spread(a, b)));
    };
    range = range.cwiseMax(high - low);
    front = std::max(front, area(0, 1));
    side = std::max(side, area(2, 1));
    above = std::max(above, area(0, 2));
  }
};

/// From where to look at what is a line from the front: above, if nothing rises or falls by much; otherwise, where ways
/// are seen edge-on, from where they fill more.
/// @param size  of the picture, m: of what moves by little of it nothing is seen
Facing facing_of_ways(const Recording& recording, double size) {
  constexpr double flat = 0.1, seen = 0.05;
  Way way;
  for (const NodeRecord& node : recording.nodes)
    way.add(node.world.size(), [&node](std::size_t frame) { return node.world[frame].motion.pose.position; });
  for (const SoftRecord& soft : recording.softs)
    for (std::size_t node = 0; !soft.positions.empty() && node < soft.positions.front().size(); ++node)
      way.add(soft.positions.size(), [&](std::size_t frame) { return soft.positions[frame][node]; });
  for (const ParticlesRecord& particles : recording.particles)
    for (const StageParticles& frame : particles.frame)
      way.add(frame.positions.size(), [&frame](std::size_t i) { return frame.positions[i]; });
  const double across = std::min(way.range.x(), way.range.z()), most = std::max(way.side, way.above);
  if (across > seen * size && way.range.y() < flat * across) return Facing::above;
  if (way.front > flat * most || std::sqrt(most) < seen * size) return Facing::front;
  return way.above >= way.side ? Facing::above : Facing::side;
}

bool ever_apart(const Recording& recording, std::size_t a, std::size_t b) {
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame)
    if (recording.nodes[a].world[frame].motion.pose.position != recording.nodes[b].world[frame].motion.pose.position)
      return true;
  return false;
}

}  // namespace

std::vector<const NodeDescription*> descriptions(const Recording& recording, const StageDescription& stage) {
  std::map<std::string, const NodeDescription*> named;
  for (const NodeDescription& node : stage.nodes) named.emplace(node.name, &node);
  std::vector<const NodeDescription*> list;
  for (const NodeRecord& node : recording.nodes) {
    const auto found = named.find(node.name);
    list.push_back(found == named.end() ? nullptr : found->second);
  }
  return list;
}

namespace {

/// The outline of a skinned mesh whose joints make no bones to draw.
Figure skinned_figure(const Recording& recording, const StageDescription& stage, const MeshInstance& instance,
                      const std::vector<std::size_t>& record_of, Facing facing) {
  const Mesh& mesh = stage.meshes[instance.mesh];
  Figure figure;
  figure.kind = Figure::Kind::hull;
  figure.node = record_of[stage.skins[instance.skin].joints.front()];
  std::vector<WorldMotion> world(stage.nodes.size());
  std::vector<Vec3> vertices(mesh.positions.size());
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    for (std::size_t i = 0; i < world.size(); ++i)
      if (record_of[i] != no_node) world[i] = recording.nodes[record_of[i]].world[frame];
    const bool molded = instance.node < record_of.size() && record_of[instance.node] != no_node &&
                        !recording.nodes[record_of[instance.node]].weights.empty();
    deform(mesh, molded ? recording.nodes[record_of[instance.node]].weights[frame] : std::vector<double>{},
           &stage.skins[instance.skin], instance.node, world, vertices);
    std::vector<Vec2> points(1, Vec2::Zero());
    for (const Vec3& vertex : vertices) {
      points.push_back(flattened(vertex, facing));
      points.front() += points.back() / static_cast<double>(vertices.size());
    }
    figure.points.push_back(outlined(points, vertices.size()));
  }
  return figure;
}

std::vector<Figure> flat_figures(const Recording& recording, const StageDescription& stage, Facing facing) {
  const std::vector<const NodeDescription*> described = descriptions(recording, stage);
  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) index_of.emplace(recording.nodes[i].name, i);
  const auto recorded = [&](std::size_t node) {
    if (node >= stage.nodes.size()) return no_node;
    const auto found = index_of.find(stage.nodes[node].name);
    return found == index_of.end() ? no_node : found->second;
  };

  std::vector<Figure> list;
  std::vector<bool> drawn(recording.nodes.size(), false);
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
    if (!described[i] || !described[i]->body || is_plane(*described[i]->body)) continue;
    Figure figure;
    figure.node = i;
    figure.fixed = described[i]->body->fixed;
    const double scale = std::cbrt(std::abs(recording.nodes[i].world.front().linear.determinant()));
    const std::vector<Vec3> points = outline(described[i]->body->shape, figure, scale);
    place(figure, recording.nodes[i], points, facing);
    if (figure.kind == Figure::Kind::hull)
      for (std::vector<Vec2>& placed : figure.points) placed = outlined(placed, figure.vertices);
    list.push_back(std::move(figure));
    drawn[i] = true;
  }
  for (const MeshInstance& instance : stage.mesh_instances) {
    const std::size_t node = recorded(instance.node);
    if (instance.skin < stage.skins.size() || node == no_node || drawn[node] || instance.mesh >= stage.meshes.size() ||
        stage.meshes[instance.mesh].positions.empty())
      continue;
    Figure figure;
    figure.node = node;
    place_mesh(figure, recording.nodes[node], stage.meshes[instance.mesh], facing);
    list.push_back(std::move(figure));
    drawn[node] = true;
  }

  // A skin is drawn as its bones, including those with colliders; the other nodes as a line to each parent.
  std::vector<bool> joint(recording.nodes.size(), false);
  for (const Skin& skin : stage.skins)
    for (const std::size_t each : skin.joints)
      if (const std::size_t node = recorded(each); node != no_node) joint[node] = true;
  std::vector<std::size_t> root(recording.nodes.size());
  std::map<std::size_t, std::vector<std::size_t>> tree;
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
    const std::size_t parent = recording.nodes[i].parent;
    root[i] = i;
    if (parent == no_node || joint[i] != joint[parent] || (!joint[i] && (drawn[i] || drawn[parent]))) continue;
    root[i] = root[parent];
    // A node put exactly on its parent has no length to draw.
    if (ever_apart(recording, i, parent)) tree[root[i]].push_back(i);
  }
  for (const auto& [top, ends] : tree) {
    Figure figure;
    figure.kind = Figure::Kind::bones;
    figure.node = top;
    for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
      std::vector<Vec2>& placed = figure.points.emplace_back();
      for (const std::size_t each : ends)
        for (const std::size_t end : {recording.nodes[each].parent, each})
          placed.push_back(flattened(recording.nodes[end].world[frame].motion.pose.position, facing));
    }
    list.push_back(std::move(figure));
  }
  std::vector<std::size_t> record_of(stage.nodes.size());
  for (std::size_t i = 0; i < record_of.size(); ++i) record_of[i] = recorded(i);
  for (const MeshInstance& instance : stage.mesh_instances) {
    if (instance.skin >= stage.skins.size() || instance.mesh >= stage.meshes.size()) continue;
    const std::vector<std::size_t>& joints = stage.skins[instance.skin].joints;
    const auto has_bones = [&](std::size_t each) {
      return recorded(each) == no_node || tree.contains(root[recorded(each)]);
    };
    if (joints.empty() || std::any_of(joints.begin(), joints.end(), has_bones) ||
        stage.meshes[instance.mesh].positions.empty())
      continue;
    list.push_back(skinned_figure(recording, stage, instance, record_of, facing));
  }
  add_wheel_figures(list, recording, stage, facing);
  add_soft_figures(list, recording, stage, facing);
  return list;
}

/// Converts figures from meters to the picture.
void into_picture(std::vector<Figure>& list, const SideView& view) {
  for (Figure& figure : list) {
    figure.radius *= view.scale;
    for (std::vector<Vec2>& points : figure.points)
      for (Vec2& point : points)
        point = Vec2(view.left + (point.x() - view.low) * view.scale, view.top + (view.high + point.y()) * view.scale);
  }
}

}  // namespace

Vec2 flattened(const Vec3& point, Facing facing) {
  switch (facing) {
    case Facing::front:
      return {point.x(), -point.y()};
    case Facing::side:
      return {point.z(), -point.y()};
    case Facing::above:
      return {point.x(), point.z()};
  }
  return {0, 0};
}

SideScene side_scene(const Recording& recording, const StageDescription& stage, double left, double top, double width,
                     double height) {
  SideScene scene;
  SideView& view = scene.view;
  scene.figures = flat_figures(recording, stage, view.facing);
  Rectangle around = around_most(rectangles(scene.figures, recording, view.facing));
  const Facing facing =
      around.empty() ? Facing::front : facing_of_ways(recording, (around.high - around.low).maxCoeff());
  if (facing != Facing::front) {
    view.facing = facing;
    scene.figures = flat_figures(recording, stage, facing);
    around = around_most(rectangles(scene.figures, recording, facing));
  } else {
    std::vector<Figure> other = flat_figures(recording, stage, Facing::side);
    const Rectangle around_other = around_most(rectangles(other, recording, Facing::side));
    if (!around.empty() && around_other.high.x() - around_other.low.x() > 1.5 * (around.high.x() - around.low.x())) {
      view.facing = Facing::side;
      scene.figures = std::move(other);
      around = around_other;
    }
  }
  if (around.empty()) {
    around.low = Vec2(-1, -1);
    around.high = Vec2(1, 1);
  }
  constexpr double room = 1.1;  // lines have a width, and things should not touch the edge
  const double least =
      1e-6 * std::max(1.0, std::max(around.low.cwiseAbs().maxCoeff(), around.high.cwiseAbs().maxCoeff()));
  const Vec2 size = room * (around.high - around.low).cwiseMax(least), middle = (around.low + around.high) / 2;
  view.scale = std::min(width / size.x(), height / size.y());
  view.left = left;
  view.top = top;
  view.width = width;
  view.height = std::min(height, std::max(0.45 * height, size.y() * view.scale));
  view.low = middle.x() - width / view.scale / 2;
  view.high = -middle.y() + view.height / view.scale / 2;
  into_picture(scene.figures, view);
  return scene;
}

}  // namespace tweenfall::figures
