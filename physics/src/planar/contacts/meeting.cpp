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

/// Points are kept as long as the bodies have moved relative to each other by at most this part of the smaller reach,
/// and turned by at most this.
constexpr double kept_way = 1e-3, kept_turn = 1e-3;
/// Bodies that may approach in a step by more than this part of the thinner one are tested where they will then be. The
/// normal of circles turns with any motion.
constexpr double quick = 0.25, quick_of_round = 0.01;
constexpr int most_advances = 24;

/// A meeting body, or a part of it.
struct Side {
  double size = 0;      ///< from its center to its farthest point, m; 0 for a half-plane
  double leverage = 1;  ///< how far a turn of the body moves it, relative to that size times the turn; >= 1
  bool lone = false;    ///< a circle
};

Side side_of(const Body& body, const Makeup& makeup, std::uint32_t part) {
  if (!body.compound) return {body.reach, 1, body.lone};
  const Plate& plate = makeup.plates[part];
  return {plate.size, plate.reach / plate.size, plate.corners.size() == 1};
}

Placed placed(const Body& body, const Plate& plate) {
  return {&plate, body.center, body.turn};
}
Placed later(const Body& body, const Plate& plate, const Vec2& way, double share) {
  if (!body.under_way) return placed(body, plate);
  return {&plate, body.center + share * way, body.turn};
}

/// Whether two parts are farther apart than `limit`, by the circles around them.
bool are_far(const Body& a, const Plate& plate_a, const Body& b, const Plate& plate_b, double limit) {
  if (plate_a.endless || plate_b.endless) return false;
  const Vec2 apart = (b.center + b.turn * plate_b.middle) - (a.center + a.turn * plate_a.middle);
  const double far = plate_a.size + plate_b.size + limit;
  return apart.squaredNorm() > far * far;
}

bool keeps_its_points(const Meeting& meeting, const Body& a, const Side& side_a, const Body& b, const Side& side_b) {
  if (!meeting.exact || meeting.count == 0) return false;
  const double way = kept_way * std::min(side_a.size, side_b.size);
  if (!((a.turn.back(b.center - a.center) - meeting.apart).squaredNorm() <= way * way)) return false;
  const Turn off = meeting.relative.to(a.turn.to(b.turn));
  return off.cos > 0 && std::abs(off.sin) * std::max(side_a.leverage, side_b.leverage) <= kept_turn;
}

/// Whether parts that were clear of each other are still farther apart than `limit`, however they moved since.
bool stays_clear(const Meeting& meeting, const Body& a, const Body& b, double reach_b, double limit) {
  const Turn off = meeting.relative.to(a.turn.to(b.turn));
  // An angle of up to a quarter turn is at most so many times its sine.
  constexpr double widest = 1.5708;
  const double left = meeting.clear - limit - widest * std::abs(off.sin) * reach_b;
  return off.cos > 0 && left > 0 && (a.turn.back(b.center - a.center) - meeting.apart).squaredNorm() < left * left;
}

/// Earlier points pass on their impulses. If none of the earlier points is left, it is not the
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
  meeting.clear = found.clear;
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

/// Fast bodies meet by conservative advancement along straight paths, without turning: each time they advance by as
/// much as the gap allows. Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, 2.3.
void World::Implementation::look_at(Meeting& meeting, double dt) {
  const Body &a = bodies[meeting.a], &b = bodies[meeting.b];
  const double travel = a.travel + b.travel;
  const inner::Side side_a = inner::side_of(a, makeups[meeting.a], meeting.part_a),
                    side_b = inner::side_of(b, makeups[meeting.b], meeting.part_b);
  const double smaller = std::min(side_a.size, side_b.size);
  const double close = inner::close * (smaller > 0 ? smaller : side_a.size + side_b.size);
  const double limit = travel + close;
  if (a.reach > 0 && b.reach > 0) {
    const double far = a.reach + b.reach + limit;
    if ((b.center - a.center).squaredNorm() > far * far) {
      meeting.count = 0;
      meeting.clear = 0;
      return;
    }
  }
  const bool is_round = side_a.lone || side_b.lone;
  const bool is_quick = travel > (is_round ? inner::quick_of_round : inner::quick) * std::min(a.least, b.least);
  if (!(side_a.lone && side_b.lone) && !is_quick && inner::keeps_its_points(meeting, a, side_a, b, side_b)) return;
  const inner::Plate &plate_a = makeups[meeting.a].plates[meeting.part_a],
                     &plate_b = makeups[meeting.b].plates[meeting.part_b];
  if (meeting.count == 0 && meeting.exact && inner::stays_clear(meeting, a, b, plate_b.reach, limit)) return;
  if ((a.compound || b.compound) && inner::are_far(a, plate_a, b, plate_b, limit)) {
    meeting.count = 0;
    meeting.clear = 0;
    return;
  }
  meeting.apart = a.turn.back(b.center - a.center);
  meeting.relative = a.turn.to(b.turn);
  meeting.exact = true;
  inner::Found found = inner::find_manifold(inner::placed(a, plate_a), inner::placed(b, plate_b), limit);
  if (!is_quick || found.count == 0) {
    inner::adopt(found, a, a.turn, b.turn, meeting);
    return;
  }
  const auto way_of = [&](const Body& body, std::uint32_t index) -> Vec2 {
    const inner::BodyRow& gain = solver.gains[index];
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
      // They pass: only what is close now may still touch, if others push it.
      if (gap > close) found.count = 0;
      break;
    }
    share += gap / closing;
    found = inner::find_manifold(inner::later(a, plate_a, way_a, share), inner::later(b, plate_b, way_b, share), limit);
    if (found.count == 0) break;
  }
  meeting.exact = share == 0;
  inner::adopt(found, a, a.turn, b.turn, meeting);
}

}  // namespace tweenfall::planar
