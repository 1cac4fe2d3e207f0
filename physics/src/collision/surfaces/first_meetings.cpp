#include "collision/surfaces/first_meetings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/convex/distance.h"
#include "collision/surfaces/convex_piece.h"
#include "collision/surfaces/touch.h"

namespace tweenfall::surfaces {

using collision::Passage;
using shapes::Placed;

namespace {

constexpr int most_advances = 64;
/// Cosine of the angle within which normals belong to one plane.
constexpr double one_plane = 1 - 1e-6;

Placed placed_at(const Passage& way, double time) {
  return shapes::place(*way.course.shape, way.course.at(time).node(*way.body));
}

/// Keeps the first few of many meetings, one per plane.
class EarliestMeetings {
 public:
  explicit EarliestMeetings(double near) : near_(near) {}

  void add(const TriangleMeeting& meeting) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (!same_plane(first_[i], meeting)) continue;
      if (meeting.time < first_[i].time) first_[i].time = meeting.time;
      return;
    }
    if (count_ < first_.size()) {
      first_[count_++] = meeting;
      return;
    }
    auto last = std::ranges::max_element(first_, {}, &TriangleMeeting::time);
    if (meeting.time < last->time) *last = meeting;
  }

  /// After the first, only those toward which `way` still leads after the earlier ones have stopped it.
  [[nodiscard]] FirstMeetings chosen(Vec3 way) {
    std::sort(first_.begin(), first_.begin() + static_cast<std::ptrdiff_t>(count_), in_order);
    const double least = 1e-3 * way.norm();
    FirstMeetings result;
    for (std::size_t i = 0; i < count_ && result.count < FirstMeetings::most; ++i) {
      const double into = -first_[i].normal.dot(way);
      if (result.count > 0 && !(into > least)) continue;
      result.meetings[result.count++] = first_[i];
      if (into > 0) way += into * first_[i].normal;
    }
    return result;
  }

 private:
  [[nodiscard]] bool same_plane(const TriangleMeeting& a, const TriangleMeeting& b) const {
    return a.normal.dot(b.normal) >= one_plane && std::abs(a.offset - b.offset) <= near_;
  }
  static bool in_order(const TriangleMeeting& a, const TriangleMeeting& b) {
    if (a.time != b.time) return a.time < b.time;
    for (int i = 0; i < 3; ++i)
      if (a.normal[i] != b.normal[i]) return a.normal[i] < b.normal[i];
    return a.offset < b.offset;
  }

  std::array<TriangleMeeting, 16> first_;
  std::size_t count_ = 0;
  double near_;
};

/// A solid moving toward triangles.
class Approach {
 public:
  Approach(const Surface& surface, const Passage& way_surface, const Passage& way, double dt)
      : surface_(surface), way_surface_(way_surface), way_(way), dt_(dt) {
    const Vec3 velocity = way.course.linear - way_surface.course.linear;
    const Vec3 acceleration = way.course.acceleration - way_surface.course.acceleration;
    at_ = seen_from(way_surface.placed, way.placed);
    velocity_ = way_surface.placed.axes.transpose() * velocity;
    acceleration_ = way_surface.placed.axes.transpose() * acceleration;
    // A turning surface moves quickly what is far from its center, so this bounds how far away the solid gets in the
    // step.
    const double away = (way.body->center - way_surface.body->center).norm() + way.body->radius() +
                        (velocity.norm() + acceleration.norm() * dt) * dt;
    swing_ = way.swing + way_surface.spin * away;
  }

  [[nodiscard]] FirstMeetings find(std::span<const KnownPlane> known, double near) {
    const std::optional<convex::Core> start = convex_piece(way_.course.shape->solid, at_);
    if (!start) return {};
    convex::Core core = *start;
    const Vec3 displacement = velocity_ * dt_;
    const double extra = (0.5 * acceleration_.norm() * dt_ + swing_) * dt_ + collision::hair;
    if (displacement.norm() + extra <= collision::hair) return {};
    Bounds box = bounds_of(core);
    box = {box.low - Vec3::Constant(extra), box.high + Vec3::Constant(extra)};
    const Vec3 middle = at_.center + at_.axes * middle_of(way_.course.shape->solid);
    EarliestMeetings earliest(near);
    const auto see = [&](std::uint32_t index) {
      const SurfaceTriangle triangle = surface_.triangle(index);
      if (!meets_on_way(box, displacement, triangle.bounds())) return;
      const Vec3 normal = triangle.normal();
      const double offset = normal.dot(triangle.corners[0]);
      if (!(normal.dot(middle) > offset)) return;
      // As far as its lowest point comes down.
      if (-core.height(-normal) - offset > extra + std::max(0.0, -normal.dot(displacement))) return;
      for (const KnownPlane& plane : known)
        if (plane.normal.dot(normal) >= one_plane && std::abs(plane.offset - offset) <= near) return;
      if (const std::optional<double> time = time_of(triangle, normal, near)) earliest.add({*time, normal, offset});
    };
    surface_.walk([&](const Bounds& other) { return meets_on_way(box, displacement, other); }, see);
    return earliest.chosen(velocity_ + acceleration_ * dt_);
  }

 private:
  /// By conservative advancement; see `collision::impact_time`.
  [[nodiscard]] std::optional<double> time_of(const SurfaceTriangle& triangle, const Vec3& normal, double near) const {
    double time = 0;
    for (int i = 0; i < most_advances; ++i) {
      const Placed surface = time == 0 ? way_surface_.placed : placed_at(way_surface_, time);
      const Placed solid = time == 0 ? way_.placed : placed_at(way_, time);
      const Placed at = seen_from(surface, solid);
      // Relative to the solid, so that nothing is lost far from the surface's origin.
      std::array<Vec3, 3> corners = triangle.corners;
      for (Vec3& corner : corners) corner -= at.center;
      convex::Core flat = convex::core_of(corners, normal);
      convex::Core core = *convex_piece(way_.course.shape->solid, {Vec3::Zero(), at.axes});
      const convex::Nearness nearness = convex::nearness_of(flat, core, std::numeric_limits<double>::infinity());
      const double gap = nearness.distance - core.radius;
      if (i == 0 && gap <= near) return std::nullopt;
      if (gap <= collision::hair) return time;
      const Vec3 toward = surface.axes * nearness.normal;
      const Vec3 velocity = way_.course.linear - way_surface_.course.linear;
      const Vec3 acceleration = way_.course.acceleration - way_surface_.course.acceleration;
      const double now = -toward.dot(velocity + acceleration * time), end = -toward.dot(velocity + acceleration * dt_);
      const double closing = std::max(now, end) + swing_;
      if (!(closing > 0)) return std::nullopt;
      time += (gap - 0.5 * collision::hair) / closing;
      if (time > dt_) return std::nullopt;
    }
    return time;
  }

  const Surface& surface_;
  const Passage& way_surface_;
  const Passage& way_;
  double dt_;
  Placed at_;
  Vec3 velocity_, acceleration_;
  double swing_ = 0;
};

}  // namespace

FirstMeetings first_meetings(const Surface& surface, const Passage& way_surface, const Passage& way,
                             std::span<const KnownPlane> known, double near, double dt) {
  return Approach(surface, way_surface, way, dt).find(known, near);
}

}  // namespace tweenfall::surfaces
