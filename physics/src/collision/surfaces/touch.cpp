#include "collision/surfaces/touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/collide_pairs.h"
#include "collision/convex/collide_convex.h"
#include "collision/convex/depth.h"
#include "collision/convex/distance.h"
#include "collision/convex/facet.h"
#include "collision/surfaces/convex_piece.h"
#include "pairs/contact_candidates.h"

namespace tweenfall::surfaces {

namespace {

/// Sine of the angle up to which two triangles lie in one plane.
constexpr double lying_flat = 1e-5;
/// Sine of the angle by which the surroundings of a touched point may rise along the normal.
constexpr double rising = 1e-6;
/// Cosine of the angle within which directions count as the same.
constexpr double one_direction = 1 - 5e-7;
/// How many triangles around a vertex are visited each way.
constexpr int most_around = 64;

/// Contact points that push in one direction.
struct TouchGroup {
  Vec3 normal{0, 1, 0};
  double least_gap = std::numeric_limits<double>::infinity();
  std::array<pairs::ContactCandidate, 48> points;
  std::size_t count = 0;
};

/// A solid among the triangles of a surface, relative to the solid's position in the surface's axes.
class Toucher {
 public:
  Toucher(const Surface& surface, const convex::Core& core, const Vec3& place, const Vec3& middle, double margin,
          double reach)
      : surface_(surface),
        core_(core),
        place_(place),
        middle_(core.turn * middle),
        margin_(margin),
        reach_(reach),
        leaning_(core.turn * Vec3(1, 0.61, 0.37)) {}

  Touch find() {
    Bounds box = bounds_of(core_);
    size_ = 0.5 * (box.high - box.low).maxCoeff();
    const Vec3 room = Vec3::Constant(reach_);
    box = {box.low - room, box.high + room};
    const Bounds around{box.low + place_, box.high + place_};
    const auto meets = [](const Bounds& a, const Bounds& b) {
      return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
    };
    surface_.walk([&](const Bounds& other) { return meets(other, around); },
                  [&](std::uint32_t index) {
                    const SurfaceTriangle triangle = seen(index);
                    if (meets(triangle.bounds(), box)) see(index, triangle);
                  });
    Touch touch;
    for (std::size_t i = 0; i < groups_count_; ++i)
      if (groups_[i].least_gap <= margin_) tell(groups_[i], touch.manifolds[touch.count++]);
    return touch;
  }

 private:
  [[nodiscard]] SurfaceTriangle seen(std::uint32_t index) const {
    SurfaceTriangle triangle = surface_.triangle(index);
    for (Vec3& corner : triangle.corners) corner -= place_;
    return triangle;
  }

  /// The corner of a neighbor that is not on the shared side.
  [[nodiscard]] Vec3 beyond(std::uint32_t neighbor, const SurfaceTriangle& triangle, std::size_t side) const {
    const SurfaceTriangle its = seen(neighbor);
    const std::uint32_t from = triangle.vertices[side], to = triangle.vertices[(side + 1) % 3];
    for (std::size_t i = 0; i < 3; ++i)
      if (its.vertices[i] != from && its.vertices[i] != to) return its.corners[i];
    return triangle.corners[side];
  }

  struct Sides {
    std::array<bool, 3> flat{};
    bool sharp = false;  ///< one of them is a border, or lies between triangles that fall away from each other
  };
  [[nodiscard]] Sides sides_of(std::uint32_t index, const SurfaceTriangle& triangle, const Vec3& normal) const {
    Sides sides;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t neighbor = surface_.across(index, i);
      if (neighbor == Surface::none) {
        sides.sharp = true;
        continue;
      }
      const Vec3 away = beyond(neighbor, triangle, i) - triangle.corners[i];
      const double up = normal.dot(away), length = away.norm();
      sides.flat[i] = std::abs(up) <= lying_flat * length && faces(neighbor, normal);
      sides.sharp = sides.sharp || up < -lying_flat * length;
    }
    return sides;
  }
  /// Whether it faces the same way: a neighbor folded back lies in the same plane, too.
  [[nodiscard]] bool faces(std::uint32_t index, const Vec3& normal) const {
    const SurfaceTriangle its = seen(index);
    return (its.corners[1] - its.corners[0]).cross(its.corners[2] - its.corners[0]).dot(normal) > 0;
  }

  [[nodiscard]] static bool rises(const Vec3& direction, const Vec3& from, const Vec3& to) {
    return direction.dot(to - from) > rising * (to - from).norm();
  }

  /// Whether no triangle around a vertex rises along a direction; visits those over one side of the first one.
  [[nodiscard]] bool tops_around(std::uint32_t index, const SurfaceTriangle& first, std::size_t corner,
                                 const Vec3& direction, bool forward, bool& closed) const {
    const std::uint32_t vertex = first.vertices[corner];
    SurfaceTriangle triangle = first;
    std::uint32_t at = index;
    for (int i = 0; i < most_around; ++i) {
      std::size_t here = 0;
      while (here < 2 && triangle.vertices[here] != vertex) ++here;
      const std::uint32_t next = surface_.across(at, forward ? here : (here + 2) % 3);
      if (next == Surface::none) return true;
      if (next == index) {
        closed = true;
        return true;
      }
      at = next;
      triangle = seen(next);
      for (const Vec3& other : triangle.corners)
        if (rises(direction, first.corners[corner], other)) return false;
    }
    return true;
  }

  /// Whether the part of the triangle that is foremost along a direction is foremost among all around it.
  [[nodiscard]] bool tops(std::uint32_t index, const SurfaceTriangle& triangle, const Vec3& direction) const {
    double top = -std::numeric_limits<double>::infinity(), length = 0;
    std::array<double, 3> heights{};
    for (std::size_t i = 0; i < 3; ++i) {
      heights[i] = direction.dot(triangle.corners[i]);
      top = std::max(top, heights[i]);
      length = std::max(length, (triangle.corners[(i + 1) % 3] - triangle.corners[i]).norm());
    }
    std::array<bool, 3> first{};
    std::size_t count = 0, last = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] = heights[i] >= top - lying_flat * length;
      if (!first[i]) continue;
      ++count;
      last = i;
    }
    if (count == 3) return true;
    if (count == 2) {
      const std::size_t side = !first[0] ? 1 : !first[1] ? 2 : 0;
      const std::uint32_t neighbor = surface_.across(index, side);
      return neighbor == Surface::none || !rises(direction, triangle.corners[side], beyond(neighbor, triangle, side));
    }
    bool closed = false;
    if (!tops_around(index, triangle, last, direction, true, closed)) return false;
    return closed || tops_around(index, triangle, last, direction, false, closed);
  }

  void see(std::uint32_t index, const SurfaceTriangle& triangle) {
    const Vec3 normal = triangle.normal();
    const double offset = normal.dot(triangle.corners[0]);
    if (!(normal.dot(middle_) > offset)) return;
    if (-core_.height(-normal) - offset > reach_) return;
    convex::Core flat = convex::core_of(triangle.corners, normal);
    const double near = reach_ + core_.radius;
    convex::Nearness nearness = convex::nearness_of(flat, core_, near);
    if (nearness.distance > 0 && nearness.normal.dot(normal) < -rising) {
      // Its nearest point is behind: it came around a border, or through another triangle of the plane.
      if (!(-core_.height(-normal) < offset)) return;
      if (nearness.distance > near)
        nearness = convex::nearness_of(flat, core_, std::numeric_limits<double>::infinity());
      if (goes_through(normal, offset, nearness.on_b))
        add_face(index, triangle, normal, offset, sides_of(index, triangle, normal));
      return;
    }
    if (nearness.distance > near) return;
    const Sides sides = sides_of(index, triangle, normal);
    if (sides.sharp) {
      const convex::Meeting meeting = met(flat, nearness);
      if (meeting.normal.squaredNorm() > 0.5 && meeting.normal.dot(normal) < one_direction &&
          tops(index, triangle, meeting.normal)) {
        const Manifold manifold = convex::contact_along(flat, core_, meeting, reach_);
        if (manifold.normal.dot(normal) < one_direction) return add(manifold, triangle);
      }
    }
    add_face(index, triangle, normal, offset, sides);
  }

  /// Whether the straight line from the solid's middle to a point behind a plane crosses the surface there.
  [[nodiscard]] bool goes_through(const Vec3& normal, double offset, const Vec3& behind) const {
    const double above = normal.dot(middle_) - offset, below = offset - normal.dot(behind);
    if (!(above > 0 && below > 0)) return false;
    const Vec3 crossing = middle_ + above / (above + below) * (behind - middle_);
    const Vec3 room = Vec3::Constant(1e-9 * (size_ + place_.cwiseAbs().maxCoeff()));
    const Vec3 low = crossing + place_ - room, high = crossing + place_ + room;
    bool found = false;
    surface_.walk(
        [&](const Bounds& box) {
          return !found && (box.low.array() <= high.array()).all() && (low.array() <= box.high.array()).all();
        },
        [&](std::uint32_t index) {
          const SurfaceTriangle triangle = seen(index);
          const Vec3 its = triangle.normal();
          if (!(its.dot(normal) >= one_direction)) return;
          bool inside = std::abs(its.dot(crossing - triangle.corners[0])) <= 1e-3 * size_;
          for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 along = triangle.corners[(i + 1) % 3] - triangle.corners[i];
            inside = inside && along.cross(its).dot(crossing - triangle.corners[i]) <= room[0] * along.norm();
          }
          found = found || inside;
        });
    return found;
  }

  /// The shortest way out of a triangle toward its front.
  [[nodiscard]] convex::Meeting met(convex::Core& flat, const convex::Nearness& nearness) {
    convex::Meeting meeting;
    const auto set = [&](double distance, const Vec3& normal, const Vec3& on_flat, const Vec3& on_core) {
      meeting.gap = distance - core_.radius;
      meeting.normal = normal;
      meeting.middle = 0.5 * (on_flat + on_core - core_.radius * normal);
    };
    if (nearness.distance > 0) {
      set(nearness.distance, nearness.normal, nearness.on_a, nearness.on_b);
      return meeting;
    }
    // So thick that no way out leads through it.
    convex::Core thick = flat;
    thick.back = 4 * (size_ + core_.reach);
    thick.reach += thick.back;
    const convex::Depth depth = convex::depth_of(thick, core_);
    set(-depth.depth, depth.normal, depth.on_a, depth.on_b);
    return meeting;
  }

  /// Adds what lies over the triangle, within its sides. Sides that continue flat cut nothing off.
  void add_face(std::uint32_t index, const SurfaceTriangle& triangle, const Vec3& normal, double offset,
                const Sides& sides) {
    constexpr std::uint32_t first_side = 256;
    convex::ClipPolygon* now = &polygon_;
    convex::ClipPolygon* next = &spare_;
    convex::foremost(core_, -normal, *now);
    const double tolerance = 1e-6 * size_;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Vec3& from = triangle.corners[i];
      const Vec3 out = (triangle.corners[(i + 1) % 3] - from).cross(normal).normalized();
      convex::cut_face(*now, out, out.dot(from), first_side + i, tolerance, *next);
      std::swap(now, next);
    }
    for (std::size_t i = 0; i < now->count; ++i) {
      const convex::ClipCorner& corner = now->corners[i];
      std::uint32_t feature = corner.feature;
      if ((feature & 0x1000000u) != 0) {
        bool flat = true, of_triangle = true;
        for (const std::uint32_t line : {feature & 511u, feature >> 9 & 511u}) {
          of_triangle = of_triangle && line >= first_side;
          if (line >= first_side && line < first_side + 3) flat = flat && sides.flat[line - first_side];
        }
        if (flat) continue;
        // A corner of the triangle belongs to all triangles around it.
        feature = 0x1000000u | ((feature * 2654435761u ^ index * 40503u) >> 8 & (of_triangle ? 0x7fffffu : 0xffffffu));
      }
      const Vec3 lowest = corner.position - corner.radius * normal;
      const double gap = normal.dot(lowest) - offset;
      if (gap <= reach_) add_point(normal, {lowest - 0.5 * gap * normal, gap, feature});
    }
  }

  void add(const Manifold& manifold, const SurfaceTriangle& triangle) {
    std::uint32_t mixed = 0;
    for (const std::uint32_t vertex : triangle.vertices) mixed ^= vertex * 2654435761u;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
      const ContactPoint& point = manifold.points[i];
      add_point(manifold.normal,
                {point.position, -point.penetration, 0x2000000u | ((mixed ^ point.feature) & 0xffffffu)});
    }
  }

  void add_point(const Vec3& normal, const pairs::ContactCandidate& point) {
    TouchGroup* group = group_along(normal, point.gap);
    if (!group) return;
    group->least_gap = std::min(group->least_gap, point.gap);
    const double same = 1e-6 * size_;
    for (std::size_t i = 0; i < group->count; ++i) {
      pairs::ContactCandidate& known = group->points[i];
      if ((known.position - point.position).squaredNorm() > same * same) continue;
      // The solid's own corners keep their names from triangle to triangle.
      if (point.feature < known.feature) known.feature = point.feature;
      return;
    }
    if (group->count == group->points.size())
      group->count = pairs::reduce_to_four(std::span(group->points).first(group->count), group->normal, leaning_);
    group->points[group->count++] = point;
  }

  /// Null if all existing ones go deeper.
  TouchGroup* group_along(const Vec3& normal, double gap) {
    for (std::size_t i = 0; i < groups_count_; ++i)
      if (groups_[i].normal.dot(normal) >= one_direction) return &groups_[i];
    TouchGroup* group = nullptr;
    if (groups_count_ < groups_.size()) {
      group = &groups_[groups_count_++];
    } else {
      group = &*std::ranges::max_element(groups_, {}, &TouchGroup::least_gap);
      if (!(gap < group->least_gap)) return nullptr;
    }
    group->normal = normal;
    group->least_gap = std::numeric_limits<double>::infinity();
    group->count = 0;
    return group;
  }

  void tell(TouchGroup& group, Manifold& manifold) const {
    manifold = {};
    manifold.normal = group.normal;
    const std::size_t count = pairs::reduce_to_four(std::span(group.points).first(group.count), group.normal, leaning_);
    for (std::size_t i = 0; i < count; ++i)
      collision::add_point(manifold, place_ + group.points[i].position, -group.points[i].gap, group.points[i].feature,
                           reach_);
  }

  const Surface& surface_;
  convex::Core core_;
  Vec3 place_, middle_;
  double margin_, reach_;
  double size_ = 0;
  Vec3 leaning_;
  std::array<TouchGroup, Touch::most> groups_;
  std::size_t groups_count_ = 0;
  convex::ClipPolygon polygon_, spare_;
};

}  // namespace

std::size_t Touch::deepest() const noexcept {
  std::size_t best = count;
  double deep = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < manifolds[i].count; ++k) {
      const double depth = manifolds[i].points[static_cast<std::size_t>(k)].penetration;
      if (!(depth > deep)) continue;
      deep = depth;
      best = i;
    }
  return best;
}

Touch touch(const Surface& surface, const Solid& solid, const shapes::Placed& at, double margin,
            double reach) noexcept {
  const std::optional<convex::Core> core = convex_piece(solid, {Vec3::Zero(), at.axes});
  if (!core || !at.center.allFinite() || !at.axes.allFinite()) return {};
  return Toucher(surface, *core, at.center, middle_of(solid), margin, reach).find();
}

Manifold deepest_touch(const Surface& surface, const shapes::Placed& at_surface, const Solid& solid,
                       const shapes::Placed& at, double margin, double reach) noexcept {
  const Touch all = touch(surface, solid, seen_from(at_surface, at), margin, reach);
  const std::size_t best = all.deepest();
  return best < all.count ? collision::to_world(all.manifolds[best], at_surface) : Manifold{};
}

}  // namespace tweenfall::surfaces
