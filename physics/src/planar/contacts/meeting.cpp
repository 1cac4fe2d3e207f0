#include <algorithm>
#include <cmath>

#include "planar/contacts/manifold.h"
#include "planar/world_data.h"

namespace tweenfall::planar {

using inner::Body;
using inner::Makeup;
using inner::Meeting;

namespace inner {
namespace {

/// Points are kept while the bodies have moved against each other by no more than this part of the smaller reach, and
/// turned by no more than this.
constexpr double kept_way = 1e-3, kept_turn = 1e-3;
/// Bodies that may come nearer in a step than this part of the thinner one meet where they will be then. Of circles the
/// normal turns with every bit of the way.
constexpr double quick = 0.25, quick_of_round = 0.01;
constexpr int most_advances = 24;

Placed placed(const Body& body, const Makeup& makeup) {
  return {&makeup.plate, body.center, body.turn};
}
Placed later(const Body& body, const Makeup& makeup, const Vec2& way, double share) {
  if (!body.under_way) return placed(body, makeup);
  return {&makeup.plate, body.center + share * way, body.turn};
}

bool keeps_its_points(const Meeting& meeting, const Body& a, const Body& b) {
  if (!meeting.exact || meeting.count == 0) return false;
  const double way = kept_way * std::min(a.reach, b.reach);
  if (!((a.turn.back(b.center - a.center) - meeting.apart).squaredNorm() <= way * way)) return false;
  const Turn off = meeting.relative.to(a.turn.to(b.turn));
  return off.cos > 0 && std::abs(off.sin) <= kept_turn;
}

/// Points that were there before begin with the impulses that they had. What none of them is left of is not the
/// contact that resisted rolling.
void take_over(const Meeting& before, Meeting& meeting) {
  meeting.rolling = 0;
  for (int i = 0; i < meeting.count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    meeting.pressing[n] = meeting.dragging[n] = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(before.count); ++k) {
      if (before.feature[k] != meeting.feature[n]) continue;
      meeting.pressing[n] = before.pressing[k];
      meeting.dragging[n] = before.dragging[k];
      meeting.rolling = before.rolling;
    }
  }
}

void adopt(const Found& found, const Body& a, const Turn& turn_a, const Turn& turn_b, Meeting& meeting) {
  const Meeting before = meeting;
  meeting.count = found.count;
  meeting.normal = a.turn.back(found.normal);
  for (int i = 0; i < found.count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const FoundPoint& point = found.points[n];
    meeting.core_a[n] = turn_a.back(point.core_a);
    meeting.core_b[n] = turn_b.back(point.core_b);
    meeting.feature[n] = point.feature;
  }
  take_over(before, meeting);
}

}  // namespace
}  // namespace inner

/// Quick bodies meet by conservative advancement along straight ways, turning not at all: each time they go on by as
/// much as the gap allows. Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, 2.3.
void World::Implementation::look_at(Meeting& meeting, double dt) {
  const Body &a = bodies[meeting.a], &b = bodies[meeting.b];
  const double travel = a.travel + b.travel;
  const double close = inner::close * (a.reach > 0 && b.reach > 0 ? std::min(a.reach, b.reach) : a.reach + b.reach);
  const double limit = travel + close;
  if (a.reach > 0 && b.reach > 0) {
    const double far = a.reach + b.reach + limit;
    if ((b.center - a.center).squaredNorm() > far * far) {
      meeting.count = 0;
      return;
    }
  }
  const bool is_quick = travel > (a.lone || b.lone ? inner::quick_of_round : inner::quick) * std::min(a.least, b.least);
  if (!(a.lone && b.lone) && !is_quick && inner::keeps_its_points(meeting, a, b)) return;
  const Makeup &makeup_a = makeups[meeting.a], &makeup_b = makeups[meeting.b];
  meeting.apart = a.turn.back(b.center - a.center);
  meeting.relative = a.turn.to(b.turn);
  meeting.exact = true;
  inner::Found found = inner::find_manifold(inner::placed(a, makeup_a), inner::placed(b, makeup_b), limit);
  if (!is_quick || found.count == 0) {
    inner::adopt(found, a, a.turn, b.turn, meeting);
    return;
  }
  const auto way_of = [&](const Body& body, std::uint32_t index) -> Vec2 {
    const inner::Gain& gain = solver.gains[index];
    return (body.velocity + 0.5 * dt * Vec2(gain.x, gain.y)) * dt;
  };
  const Vec2 way_a = way_of(a, meeting.a), way_b = way_of(b, meeting.b);
  const double enough = 1e-10 * std::min(a.least, b.least);
  double share = 0;
  for (int advance = 0; advance < inner::most_advances; ++advance) {
    double gap = found.points[0].gap;
    for (int i = 1; i < found.count; ++i) gap = std::min(gap, found.points[static_cast<std::size_t>(i)].gap);
    if (gap <= enough) break;
    const double closing = found.normal.dot(way_a - way_b);
    if (!(share * closing + gap < (1 + 1e-9) * closing)) {
      // They pass: only what is close now may yet touch, by what others do to them.
      if (gap > close) found.count = 0;
      break;
    }
    share += gap / closing;
    found =
        inner::find_manifold(inner::later(a, makeup_a, way_a, share), inner::later(b, makeup_b, way_b, share), limit);
    if (found.count == 0) break;
  }
  meeting.exact = share == 0;
  inner::adopt(found, a, a.turn, b.turn, meeting);
}

}  // namespace tweenfall::planar
