#include "planar/queries/difference.h"

#include <cmath>
#include <limits>

namespace tweenfall::planar::inner {

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();
/// Sides of a round polygon are extended beyond their ends by this part of their length, so that no ray slips through.
constexpr double seam = 1e-12;

Vec2 corner_of(const Placed& placed, std::size_t i) {
  return placed.center + placed.turn * placed.plate->corners[i].at;
}

/// Which of two sides comes first when going around from the lowest corner, counterclockwise: below 0 the first.
int order(const Vec2& first, const Vec2& second) {
  const auto back = [](const Vec2& side) { return side.y() < 0 || (side.y() == 0 && side.x() < 0); };
  if (back(first) != back(second)) return back(first) ? 1 : -1;
  const double turn = cross(first, second);
  return turn > 0 ? -1 : turn < 0 ? 1 : 0;
}

/// The corners of a plate in order, starting from the one that comes first.
struct Around {
  const Placed& placed;
  double sign;  ///< -1: for the plate turned by half a turn about the origin
  std::size_t first = 0, count = 0, sides = 0;

  Around(const Placed& whose, double way) : placed(whose), sign(way), count(whose.plate->corners.size()) {
    sides = count > 1 ? count : 0;
    for (std::size_t i = 1; i < count; ++i) {
      const Vec2 here = sign * corner_of(placed, i), best = sign * corner_of(placed, first);
      if (here.y() < best.y() || (here.y() == best.y() && here.x() < best.x())) first = i;
    }
  }
  [[nodiscard]] Vec2 at(std::size_t n) const { return corner_of(placed, (first + n) % count); }
  [[nodiscard]] Vec2 side(std::size_t n) const { return sign * (at(n + 1) - at(n)); }
};

Vec2 unit(const Vec2& v) {
  const double size = std::max(std::abs(v.x()), std::abs(v.y()));
  return size > 0 ? Vec2((v / size).normalized()) : Vec2(0, 1);
}

}  // namespace

Difference::Difference(const Placed& a, const Placed& b) : skin_a_(a.plate->skin), skin_b_(b.plate->skin) {
  if (b.plate->endless)
    lean(b, a, true);
  else if (a.plate->endless)
    lean(a, b, false);
  else
    go_around(a, b);
}

void Difference::lean(const Placed& line, const Placed& other, bool of_b) {
  endless_ = true;
  const Vec2 normal = line.turn * line.plate->corners[0].normal, on_line = corner_of(line, 0);
  normal_ = of_b ? normal : Vec2(-normal);
  double least = nowhere;
  Vec2 lowest(0, 0);
  for (std::size_t i = 0; i < other.plate->corners.size(); ++i) {
    const Vec2 corner = corner_of(other, i);
    const double height = normal.dot(corner - on_line);
    if (height >= least) continue;
    least = height;
    lowest = corner;
  }
  const Vec2 foot = lowest - least * normal;
  const Vec2 &on_a = of_b ? lowest : foot, &on_b = of_b ? foot : lowest;
  tips_[0] = {on_b - on_a, on_a, on_b};
  count_ = 1;
}

void Difference::go_around(const Placed& a, const Placed& b) {
  const Around of_a(a, -1), of_b(b, 1);
  std::size_t i = 0, k = 0;
  do {
    const Vec2 on_a = of_a.at(k), on_b = of_b.at(i);
    tips_[count_++] = {on_b - on_a, on_a, on_b};
    const bool done_a = k == of_a.sides, done_b = i == of_b.sides;
    const int next = done_a && done_b ? 0 : done_a ? -1 : done_b ? 1 : order(of_b.side(i), of_a.side(k));
    if (next <= 0 && !done_b) ++i;
    if (next >= 0 && !done_a) ++k;
  } while (i < of_b.sides || k < of_a.sides);
}

Vec2 Difference::out_of(std::size_t side) const {
  return unit(-quarter(after(side).at - tips_[side].at));
}

bool Difference::holds_none() const {
  if (count_ < 3) return false;
  for (std::size_t i = 0; i < count_; ++i)
    if (cross(after(i).at - tips_[i].at, -tips_[i].at) < 0) return false;
  return true;
}

/// For cores that overlap.
Difference::Nearest Difference::overlapping() const {
  Nearest found;
  double room = nowhere;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec2 normal = out_of(i);
    const double here = normal.dot(tips_[i].at);
    if (here >= room) continue;
    room = here;
    found.normal = normal;
  }
  found.gap = -room - (skin_a_ + skin_b_);
  // 0 is in one of the triangles that the first tip makes with the sides.
  double best = -nowhere;
  for (std::size_t i = 1; i + 1 < count_; ++i) {
    const Tip &p = tips_[0], &q = tips_[i], &r = tips_[i + 1];
    const double whole = cross(q.at - p.at, r.at - p.at);
    if (!(whole > 0)) continue;
    const double of_p = cross(q.at, r.at) / whole, of_q = cross(r.at, p.at) / whole;
    const double least = std::min({of_p, of_q, 1 - of_p - of_q});
    if (least <= best) continue;
    best = least;
    found.on_a = of_p * p.on_a + of_q * q.on_a + (1 - of_p - of_q) * r.on_a;
  }
  found.on_b = found.on_a;
  found.common = found.on_a;
  return found;
}

Difference::Nearest Difference::nearest() const {
  const double skins = skin_a_ + skin_b_;
  Nearest found;
  if (endless_) {
    found.normal = normal_;
    found.on_a = tips_[0].on_a;
    found.on_b = tips_[0].on_b;
    const double apart = -normal_.dot(tips_[0].at);
    found.gap = apart - skins;
    // If the point lies behind the line, it is common to both.
    if (apart <= 0) found.common = tips_[0].on_a;
    return found;
  }
  if (holds_none()) return overlapping();
  double least = nowhere;
  Vec2 way(0, 0);
  for (std::size_t i = 0; i < count_; ++i) {
    const Tip &tip = tips_[i], &next = after(i);
    const Vec2 side = next.at - tip.at;
    const double square = side.squaredNorm();
    const double part = square > 0 ? std::clamp(-side.dot(tip.at) / square, 0.0, 1.0) : 0;
    const Vec2 at = tip.at + part * side;
    const double here = at.norm();
    if (here >= least) continue;
    least = here;
    way = at;
    found.on_a = tip.on_a + part * (next.on_a - tip.on_a);
    found.on_b = tip.on_b + part * (next.on_b - tip.on_b);
    found.normal = here > 0 ? unit(-at) : count_ > 1 ? out_of(i) : Vec2(0, 1);
  }
  found.gap = least - skins;
  return found;
}

std::optional<Difference::Met> Difference::met(const Vec2& direction, double length) const {
  if (endless_) {
    const double closing = -normal_.dot(direction), apart = -normal_.dot(tips_[0].at) - (skin_a_ + skin_b_);
    if (!(closing > 0) || !(apart <= length * closing)) return std::nullopt;
    const double way = std::max(0.0, apart / closing);
    // A half-plane is met at the point where the other reaches its line.
    return Met{way, tips_[0].on_a + way * direction - skin_a_ * normal_, normal_};
  }
  return skin_a_ + skin_b_ > 0 ? met_round(direction, length) : met_sharp(direction, length);
}

/// Source: Cyrus and Beck, Generalized two- and three-dimensional clipping, 1978.
std::optional<Difference::Met> Difference::met_sharp(const Vec2& direction, double length) const {
  double enters = -nowhere, leaves = nowhere;
  std::size_t side = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec2 normal = out_of(i);
    const double height = -normal.dot(tips_[i].at), along = normal.dot(direction);
    if (along == 0) {
      if (height > 0) return std::nullopt;
      continue;
    }
    const double when = -height / along;
    if (along > 0) {
      leaves = std::min(leaves, when);
    } else if (when > enters) {
      enters = when;
      side = i;
    }
  }
  if (!(enters <= leaves && enters >= 0 && enters <= length)) return std::nullopt;
  const Tip &tip = tips_[side], &next = after(side);
  const Vec2 run = next.at - tip.at;
  const double part = std::clamp(run.dot(enters * direction - tip.at) / run.squaredNorm(), 0.0, 1.0);
  return Met{enters, tip.on_b + part * (next.on_b - tip.on_b), out_of(side)};
}

/// Its sides, moved out by the skins, and circles about its tips.
std::optional<Difference::Met> Difference::met_round(const Vec2& direction, double length) const {
  const double skins = skin_a_ + skin_b_;
  std::optional<Met> first;
  const auto note = [&](double way, const Vec2& on_b, const Vec2& normal) {
    if (way >= 0 && way <= length && normal.dot(direction) < 0 && (!first || way < first->way))
      first = Met{way, on_b + skin_b_ * normal, normal};
  };
  for (std::size_t i = 0; i < count_; ++i) {
    const Tip &tip = tips_[i], &next = after(i);
    const double middle = direction.dot(tip.at), aside = cross(direction, tip.at);
    if (std::abs(aside) <= skins) {
      const double way = middle - std::sqrt((skins - aside) * (skins + aside));
      note(way, tip.on_b, unit(way * direction - tip.at));
    }
    if (count_ < 2) continue;
    const Vec2 normal = out_of(i), run = next.at - tip.at;
    const double closing = -normal.dot(direction);
    if (!(closing > 0)) continue;
    const double way = (-normal.dot(tip.at) - skins) / closing;
    const double part = run.dot(way * direction - tip.at) / run.squaredNorm();
    if (part >= -seam && part <= 1 + seam) note(way, tip.on_b + part * (next.on_b - tip.on_b), normal);
  }
  return first;
}

}  // namespace tweenfall::planar::inner
