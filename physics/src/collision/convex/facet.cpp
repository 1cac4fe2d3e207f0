#include "collision/convex/facet.h"

#include <algorithm>
#include <cmath>

#include "shapes/turned.h"

namespace tweenfall::convex {

namespace {

constexpr std::size_t rim_corners = 16;
/// Cosines of zero to four sixteenths of a turn.
constexpr std::array<double, 5> rim_cosines = {1, 0.92387953251128674, 0.70710678118654752, 0.38268343236508977, 0};

double rim_cosine(std::size_t sixteenths) {
  const std::size_t i = sixteenths % rim_corners;
  if (i <= 4) return rim_cosines[i];
  if (i <= 8) return -rim_cosines[8 - i];
  if (i <= 12) return -rim_cosines[i - 8];
  return rim_cosines[16 - i];
}

/// Where the surface of a solid of revolution about y is foremost, seen along the axis.
Vec3 outward(const Vec3& local) {
  const double across = std::sqrt(local.x() * local.x() + local.z() * local.z());
  return across > 0 ? Vec3(local.x() / across, 0, local.z() / across) : Vec3(1, 0, 0);
}

void add_rim(const Core& core, double height, bool up, const Vec3& local, ClipPolygon& corners) {
  /// Sine of the angle from which one point of the rim is the lowest.
  constexpr double leaning = 1e-5;
  const bool leans = local.x() * local.x() + local.z() * local.z() > leaning * leaning;
  const Vec3 first = leans ? outward(local) : Vec3(1, 0, 0);
  const Vec3 second = up ? Vec3(first.z(), 0, -first.x()) : Vec3(-first.z(), 0, first.x());
  for (std::size_t i = 0; i < rim_corners; ++i) {
    const Vec3 out = rim_cosine(i) * first + rim_cosine(i + 12) * second;
    const auto number = static_cast<std::uint32_t>(i);
    corners.add(core.place(core.half.x() * out + Vec3(0, height, 0)), (leans ? 32 : 0) + number, number);
  }
}

void add_hull_face(const Core& core, std::uint32_t index, ClipPolygon& corners) {
  std::uint32_t side = 0;
  const std::span<const Vec3> vertices = core.hull->vertices();
  for (const std::uint32_t corner : core.hull->corners(core.hull->faces()[index])) {
    corners.add(core.place(vertices[corner]), side, side);
    ++side;
  }
}

void add_box_face(const Core& core, std::uint32_t index, ClipPolygon& corners) {
  const auto axis = static_cast<int>(index / 2);
  const double side = index % 2 == 1 ? 1 : -1;
  Vec3 out(0, 0, 0), u(0, 0, 0), v(0, 0, 0);
  out[axis] = side * core.half[axis];
  u[(axis + 1) % 3] = core.half[(axis + 1) % 3];
  v[(axis + 2) % 3] = side * core.half[(axis + 2) % 3];
  corners.add(core.place(out - u - v), 8 * index, 0);
  corners.add(core.place(out + u - v), 8 * index + 1, 1);
  corners.add(core.place(out + u + v), 8 * index + 2, 2);
  corners.add(core.place(out - u + v), 8 * index + 3, 3);
}

void add_triangle(const Core& core, ClipPolygon& corners) {
  for (std::uint32_t i = 0; i < 3; ++i) corners.add((*core.corners)[i], i, i);
}

/// The face at the farthest vertex that faces most along a direction.
std::uint32_t hull_face_along(const ConvexHull& hull, std::uint32_t vertex, const Vec3& local) {
  std::uint32_t best = 0;
  double most = -2;
  const std::span<const ConvexHull::Face> faces = hull.faces();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const double along = faces[i].normal.dot(local);
    if (along <= most + 1e-6) continue;
    const std::span<const std::uint32_t> around = hull.corners(faces[i]);
    if (std::find(around.begin(), around.end(), vertex) == around.end()) continue;
    most = along;
    best = i;
  }
  return best;
}

/// The ends of a cone's straight line that is farthest out.
struct Generator {
  Vec3 rim, tip;
};
Generator generator_of(const Core& cone, const Vec3& local) {
  return {cone.half.x() * outward(local) - Vec3(0, cone.half.y(), 0), Vec3(0, cone.half.y(), 0)};
}

/// Whether a cone's base is foremost rather than its side.
bool base_first(const Core& cone, const Vec3& local) {
  const double across = std::sqrt(local.x() * local.x() + local.z() * local.z());
  const double slant = Vec2(2 * cone.half.y(), cone.half.x()).norm();
  return -local.y() > (2 * cone.half.y() * across + cone.half.x() * local.y()) / slant;
}

}  // namespace

void corners_of(const Core& core, const FlatFace& face, const Vec3& direction, ClipPolygon& corners) {
  corners.count = 0;
  const Vec3 local = core.turn.transpose() * direction;
  if (core.kind == Core::Kind::box)
    add_box_face(core, face.index, corners);
  else if (core.kind == Core::Kind::hull)
    add_hull_face(core, face.index, corners);
  else if (core.kind == Core::Kind::triangle)
    add_triangle(core, corners);
  else if (core.kind == Core::Kind::cylinder || core.kind == Core::Kind::cone)
    add_rim(core, face.index == 1 ? core.half.y() : -core.half.y(), face.index == 1, local, corners);
}

void foremost(Core& core, const Vec3& direction, ClipPolygon& corners) {
  corners.count = 0;
  const Vec3 local = core.turn.transpose() * direction;
  const Vec3 end(0, core.half.y(), 0);
  switch (core.kind) {
    case Core::Kind::point:
      corners.add(core.shift, 0, 0, core.radius);
      break;
    case Core::Kind::segment:
      corners.add(core.place(-end), 0, 0, core.radius);
      if (core.half.y() > 0) corners.add(core.place(end), 1, 1, core.radius);
      break;
    case Core::Kind::drop:
      corners.add(core.place(-end), 0, 0, core.radius);
      corners.add(core.place(end), 1, 1, core.radius + core.half.x());
      break;
    case Core::Kind::box: {
      int axis = 0;
      for (int i = 1; i < 3; ++i)
        if (std::abs(local[i]) > std::abs(local[axis]) + 1e-6) axis = i;
      add_box_face(core, static_cast<std::uint32_t>(2 * axis + (local[axis] > 0 ? 1 : 0)), corners);
      break;
    }
    case Core::Kind::hull:
      (void)core.support(direction);
      add_hull_face(core, hull_face_along(*core.hull, core.vertex, local), corners);
      break;
    case Core::Kind::cylinder:
      if (2 * local.y() * local.y() > local.squaredNorm()) {
        add_rim(core, local.y() > 0 ? end.y() : -end.y(), local.y() > 0, local, corners);
      } else {
        const Vec3 out = core.half.x() * outward(local);
        corners.add(core.place(out - end), 16, 0);
        corners.add(core.place(out + end), 17, 1);
      }
      break;
    case Core::Kind::cone:
      if (base_first(core, local)) {
        add_rim(core, -end.y(), false, local, corners);
      } else {
        const Generator line = generator_of(core, local);
        corners.add(core.place(line.rim), 16, 0);
        corners.add(core.place(line.tip), 17, 1);
      }
      break;
    case Core::Kind::triangle:
      add_triangle(core, corners);
      break;
  }
}

SurfaceLine foremost_line(Core& core, const Vec3& direction) {
  /// Sine of the angle within which a line counts as perpendicular.
  constexpr double leaning = 0.05;
  const Vec3 local = core.turn.transpose() * direction;
  const Vec3 end(0, core.half.y(), 0);
  SurfaceLine line;
  const auto set = [&](const Vec3& from, const Vec3& to) {
    const double length = (to - from).norm();
    if (!(std::abs((to - from).dot(local)) <= leaning * length)) return;
    line = {true, core.place(from), core.place(to)};
  };
  switch (core.kind) {
    case Core::Kind::point:
      break;
    case Core::Kind::segment:
      if (core.half.y() > 0) set(core.radius * local - end, core.radius * local + end);
      break;
    case Core::Kind::drop:
      set(core.radius * local - end, (core.radius + core.half.x()) * local + end);
      break;
    case Core::Kind::cylinder: {
      const Vec3 out = core.half.x() * outward(local);
      set(out - end, out + end);
      break;
    }
    case Core::Kind::cone: {
      const Generator generator = generator_of(core, local);
      set(generator.rim, generator.tip);
      break;
    }
    case Core::Kind::box: {
      int axis = 0;
      for (int i = 1; i < 3; ++i)
        if (std::abs(local[i]) < std::abs(local[axis]) - 1e-6) axis = i;
      Vec3 from, along(0, 0, 0);
      for (int i = 0; i < 3; ++i) from[i] = local[i] < 0 ? -core.half[i] : core.half[i];
      from[axis] = -core.half[axis];
      along[axis] = 2 * core.half[axis];
      set(from, from + along);
      break;
    }
    case Core::Kind::hull: {
      (void)core.support(direction);
      const Vec3& from = core.hull->vertices()[core.vertex];
      double least = leaning;
      for (const std::uint32_t neighbor : core.hull->neighbors(core.vertex)) {
        const Vec3 along = core.hull->vertices()[neighbor] - from;
        const double lean = std::abs(along.dot(local)) / along.norm();
        if (lean >= least - 1e-6) continue;
        least = lean;
        set(from, from + along);
      }
      break;
    }
    case Core::Kind::triangle: {
      double highest = -1e300;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &from = (*core.corners)[i], &to = (*core.corners)[(i + 1) % 3];
        const double height = direction.dot(from + to);
        if (!(height > highest) || !(std::abs((to - from).dot(direction)) <= leaning * (to - from).norm())) continue;
        highest = height;
        line = {true, from, to};
      }
      break;
    }
  }
  return line;
}

}  // namespace tweenfall::convex
