#include "recording/figures.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace tweenfall {

namespace {

double reach(const Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&solid)) return sphere->radius;
  if (const auto* box = std::get_if<Box>(&solid)) return box->half_extents.norm();
  if (const auto* capsule = std::get_if<Capsule>(&solid)) return capsule->radius + capsule->half_height;
  if (const auto* hull = std::get_if<Hull>(&solid))
    return hull->convex.measures().center.norm() + hull->convex.outer_radius();
  return 0;
}

bool is_plane(const BodyDescription& body) {
  return std::holds_alternative<Plane>(body.shape.solid);
}

/// The center of mass, the vertices, and the ends of sharp edges unless those are many, as on what is nearly round.
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

/// In place of the vertices, those of them that are farthest in directions all around.
std::vector<Vec2> outlined(const std::vector<Vec2>& points, std::size_t vertices) {
  std::vector<Vec2> result = {points.front()};
  for (std::size_t i = 0; i < hull_outline; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(hull_outline);
    const auto [sine, cosine] = elementary::sin_cos(angle);
    const Vec2 direction(cosine, sine);
    Vec2 farthest = points[1];
    for (std::size_t k = 2; k <= vertices; ++k)
      if (direction.dot(points[k]) > direction.dot(farthest) + 1e-9) farthest = points[k];
    result.push_back(farthest);
  }
  result.insert(result.end(), points.begin() + 1 + static_cast<std::ptrdiff_t>(vertices), points.end());
  return result;
}

/// Points of one shape on a node, in the node's space.
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
  }
  for (Vec3& point : points)
    point = transform_point({shape.offset.position, shape.offset.rotation, Vec3(1, 1, 1)}, point);
  return points;
}

std::vector<Vec3> box_around(const Mesh& mesh) {
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& position : mesh.positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  return corners;
}

void place(Figure& figure, const NodeRecord& node, const std::vector<Vec3>& points, const SideView& view) {
  for (const WorldMotion& world : node.world) {
    std::vector<Vec2>& placed = figure.points.emplace_back();
    for (const Vec3& point : points) placed.push_back(view.place(world.point(point)));
  }
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

SideView side_view(const Recording& recording, const StageDescription& stage, double left, double top, double width,
                   double height) {
  const std::vector<const NodeDescription*> described = descriptions(recording, stage);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double low[3] = {infinite, infinite, infinite}, high[3] = {-infinite, -infinite, -infinite};
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
    const NodeDescription* node = described[i];
    double room = 0;
    if (node && node->body) {
      if (is_plane(*node->body)) continue;
      room = reach(node->body->shape.solid);
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> places;
      for (const WorldMotion& world : recording.nodes[i].world) places.push_back(world.motion.pose.position[axis]);
      if (places.empty()) continue;
      std::sort(places.begin(), places.end());
      low[axis] = std::min(low[axis], places[places.size() / 50] - room);
      high[axis] = std::max(high[axis], places[places.size() - 1 - places.size() / 50] + room);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
    if (!(low[axis] <= high[axis])) {
      low[axis] = -1;
      high[axis] = 1;
    }
  SideView view;
  view.across = high[2] - low[2] > 1.5 * (high[0] - low[0]) ? 2 : 0;
  const double wide = std::max(1e-6, high[view.across] - low[view.across]) * 1.08;
  const double tall = std::max(1e-6, high[1] - low[1]) * 1.12;
  view.scale = std::min(width / wide, height / tall);
  view.left = left;
  view.top = top;
  view.width = width;
  view.height = std::min(height, std::max(0.45 * height, tall * view.scale));
  view.low = (low[view.across] + high[view.across]) / 2 - width / view.scale / 2;
  view.high = (low[1] + high[1]) / 2 + view.height / view.scale / 2;
  return view;
}

std::vector<Figure> figures(const Recording& recording, const StageDescription& stage, const SideView& view) {
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
    const std::vector<Vec3> points = outline(described[i]->body->shape, figure, view.scale);
    place(figure, recording.nodes[i], points, view);
    if (const auto* hull = std::get_if<Hull>(&described[i]->body->shape.solid))
      for (std::vector<Vec2>& placed : figure.points) placed = outlined(placed, hull->convex.vertices().size());
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
    place(figure, recording.nodes[node], box_around(stage.meshes[instance.mesh]), view);
    list.push_back(std::move(figure));
    drawn[node] = true;
  }

  // A skin is drawn as its bones, those with colliders included; what is left of the nodes, as a line to each parent.
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
          placed.push_back(view.place(recording.nodes[end].world[frame].motion.pose.position));
    }
    list.push_back(std::move(figure));
  }
  return list;
}

}  // namespace tweenfall
