#include "planar/contacts/manifold.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::planar::inner {

namespace {

/// If two sides are equally good within this part of the smaller size, the first body's is taken, so that the points
/// keep their names from step to step.
constexpr double alike = 1e-4;

/// A plate in a's axes, about a's center.
struct Sides {
  const Corner* corners = nullptr;
  std::size_t count = 0;
  double skin = 0;

  [[nodiscard]] const Vec2& at(std::size_t i) const { return corners[i].at; }
  [[nodiscard]] const Vec2& normal(std::size_t i) const { return corners[i].normal; }
  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == count ? 0 : i + 1; }
  [[nodiscard]] std::size_t before(std::size_t i) const { return i == 0 ? count - 1 : i - 1; }
};

struct BestSide {
  double apart = -std::numeric_limits<double>::infinity();  ///< of the cores, along its normal
  std::size_t side = 0;
  std::size_t corner = 0;  ///< of the other plate, the one nearest to the side's line
};

std::size_t lowest(const Sides& of, const Vec2& normal) {
  std::size_t best = 0;
  double least = normal.dot(of.at(0));
  for (std::size_t j = 1; j < of.count; ++j) {
    const double height = normal.dot(of.at(j));
    if (height >= least) continue;
    least = height;
    best = j;
  }
  return best;
}

BestSide best_side(const Sides& of, const Sides& other, double enough) {
  BestSide best;
  if (of.count < 2) return best;
  for (std::size_t i = 0; i < of.count; ++i) {
    const std::size_t corner = lowest(other, of.normal(i));
    const double apart = of.normal(i).dot(other.at(corner) - of.at(i));
    if (apart <= best.apart) continue;
    best = {apart, i, corner};
    if (apart > enough) break;
  }
  return best;
}

/// A pair of points in a's axes.
struct Near {
  Vec2 on_a{0, 0}, on_b{0, 0};
  std::uint32_t feature = 0;
  double square = std::numeric_limits<double>::infinity();
};

/// From the corners of one to the sides of the other.
template <class Note>
void corners_to_sides(const Sides& corners, const Sides& sides, const Note& note) {
  for (std::size_t i = 0; i < corners.count; ++i)
    for (std::size_t j = 0; j < sides.count; ++j) {
      const Vec2& from = sides.at(j);
      const Vec2 along = sides.at(sides.after(j)) - from;
      const double square = along.squaredNorm();
      const double part = square > 0 ? std::clamp(along.dot(corners.at(i) - from) / square, 0.0, 1.0) : 0;
      note(corners.at(i), Vec2(from + part * along), i, part < 1 ? j : sides.after(j));
    }
}

Near nearest_points(const Sides& a, const Sides& b) {
  Near best;
  const auto note = [&best](const Vec2& on_a, const Vec2& on_b, std::size_t i, std::size_t j) {
    const double square = (on_b - on_a).squaredNorm();
    if (!(square < best.square)) return;
    best = {on_a, on_b, 0x20000u | static_cast<std::uint32_t>(i << 8 | j), square};
  };
  corners_to_sides(a, b, note);
  corners_to_sides(
      b, a, [&note](const Vec2& on_b, const Vec2& on_a, std::size_t j, std::size_t i) { note(on_a, on_b, i, j); });
  return best;
}

/// Where the other's points lie along a side and above it.
struct Above {
  double along = 0, above = 0;
  std::uint32_t feature = 0;
};

/// For a round end that lies beyond the middle of the other's; their centers may coincide.
Vec2 direction(const Vec2& from, const Vec2& to) {
  const double length = (to - from).norm();
  return length > std::numeric_limits<double>::min() ? Vec2((to - from) / length) : Vec2(0, 1);
}

/// Whether something without area lies beyond the end of a lone side, on its line: no side's normal separates them.
bool beyond(const Sides& side, const Sides& other) {
  if (side.count != 2 || other.count > 2) return false;
  const Vec2 along = side.at(1) - side.at(0);
  const double first = along.dot(other.at(0) - side.at(0)), last = along.dot(other.at(other.count - 1) - side.at(0));
  const double length = along.squaredNorm();
  return (first < 0 && last < 0) || (first > length && last > length);
}

/// Computes results in a's axes.
class Finder {
 public:
  Finder(const Sides& a, const Sides& b, double limit) : a_(a), b_(b), limit_(limit), skins_(a.skin + b.skin) {}

  void find(double size) {
    if (a_.count == 1 && b_.count == 1) {
      add_single(a_.at(0), b_.at(0), direction(a_.at(0), b_.at(0)), 0);
      return;
    }
    const double enough = limit_ + skins_;
    const BestSide of_a = best_side(a_, b_, enough);
    if (of_a.apart > enough) return keep_clear(of_a);
    const BestSide of_b = best_side(b_, a_, enough);
    if (of_b.apart > enough) return keep_clear(of_b);
    flipped_ = of_b.apart > of_a.apart + alike * size;
    const BestSide& best = flipped_ ? of_b : of_a;
    if ((best.apart <= 0 && (beyond(a_, b_) || beyond(b_, a_))) || !touch_side(best, alike * size))
      touch_corners();
    else if (best.apart <= 0 && !flipped_ && of_b.apart > of_a.apart)
      lean_on(of_b);
  }
  void find_on_line() {
    const Vec2 normal = a_.normal(0);
    found.normal = normal;
    const auto add = [&](std::size_t j) {
      const double above = normal.dot(b_.at(j) - a_.at(0));
      if (above - skins_ <= limit_) put(b_.at(j) - above * normal, b_.at(j), above, static_cast<std::uint32_t>(j));
    };
    const std::size_t first = lowest(b_, normal);
    add(first);
    if (b_.count == 1) return;
    const std::size_t next = b_.after(first), before = b_.before(first);
    add(normal.dot(b_.at(next)) <= normal.dot(b_.at(before)) ? next : before);
  }

  Found found;

 private:
  void put(const Vec2& core_a, const Vec2& core_b, double apart, std::uint32_t feature) {
    found.points[static_cast<std::size_t>(found.count++)] = {core_a, core_b, apart - skins_, feature};
  }
  void keep_clear(const BestSide& best) { found.clear = best.apart - skins_; }
  void add_single(const Vec2& on_a, const Vec2& on_b, const Vec2& normal, std::uint32_t feature) {
    const double apart = normal.dot(on_b - on_a);
    if (apart - skins_ > limit_) return;
    found.normal = normal;
    put(on_a, on_b, apart, feature);
  }
  void touch_corners() {
    const Near near = nearest_points(a_, b_);
    add_single(near.on_a, near.on_b, direction(near.on_a, near.on_b), near.feature);
  }

  /// Of two sides as good as alike the first body's has named the points; the other's tells how deep they are.
  void lean_on(const BestSide& of_b) {
    if (found.count == 0) return;
    const Vec2 normal = -b_.normal(of_b.side), corner = a_.at(of_b.corner);
    std::size_t there = 0;
    for (std::size_t i = 1; i < static_cast<std::size_t>(found.count); ++i)
      if ((found.points[i].core_a - corner).squaredNorm() < (found.points[there].core_a - corner).squaredNorm())
        there = i;
    found.normal = normal;
    found.points[there].core_a = corner;
    found.points[there].core_b = corner + of_b.apart * normal;
    for (FoundPoint& point : found.points) point.gap = normal.dot(point.core_b - point.core_a) - skins_;
  }

  /// Two points above a side, of which the nearer one is cut off at the side's end though the other's corner beyond it
  /// is lower: what is nearest there lies across the other's side. The normal goes there, and both points stay.
  void lean(double slack) {
    const Near near = nearest_points(a_, b_);
    const Vec2 normal = direction(near.on_a, near.on_b);
    if (found.normal.dot(normal) < 0.5) return;
    std::size_t nearer = 0;
    for (std::size_t i = 1; i < static_cast<std::size_t>(found.count); ++i)
      if (found.points[i].gap < found.points[nearer].gap) nearer = i;
    if (found.count == 0 || found.points[nearer].gap + skins_ > std::sqrt(near.square) + slack) return;
    found.normal = normal;
    found.points[nearer].core_a = near.on_a;
    found.points[nearer].core_b = near.on_b;
    for (FoundPoint& point : found.points) point.gap = normal.dot(point.core_b - point.core_a) - skins_;
  }

  /// @return false when two corners are nearer than what lies above the side
  bool touch_side(const BestSide& best, double slack) {
    const Sides &of = flipped_ ? b_ : a_, &other = flipped_ ? a_ : b_;
    const Vec2 normal = of.normal(best.side), start = of.at(best.side), along = quarter(normal);
    const double length = along.dot(of.at(of.after(best.side)) - start);
    const auto above = [&](std::size_t j, std::size_t of_side, std::uint32_t end) {
      const Vec2 from = other.at(j) - start;
      const auto feature = static_cast<std::uint32_t>((flipped_ ? 0x10000u : 0) | best.side << 9 | of_side << 1 | end);
      return Above{along.dot(from), normal.dot(from), feature};
    };
    std::array<Above, 2> points;
    int count = 1;
    bool leans = false;
    if (other.count == 1) {
      points[0] = above(0, 0, 0);
      if (best.apart > 0 && !(points[0].along >= 0 && points[0].along <= length)) return false;
    } else {
      // The side of the other that faces this one.
      const std::size_t before = other.before(best.corner);
      const std::size_t facing =
          normal.dot(other.normal(before)) < normal.dot(other.normal(best.corner)) ? before : best.corner;
      points = {above(facing, facing, 0), above(other.after(facing), facing, 1)};
      count = clip(points, length);
      if (count == 0) {
        if (best.apart > 0) return false;
        points[0] = above(best.corner, facing, 0);
        count = 1;
      } else if (best.apart > 0 && std::min(points[0].above, points[1].above) > best.apart + slack) {
        return false;
      }
      leans = best.apart > 0 && count == 2 && std::min(points[0].above, points[1].above) > best.apart;
    }
    found.normal = flipped_ ? Vec2(-normal) : normal;
    for (int i = 0; i < count; ++i) {
      const Above& point = points[static_cast<std::size_t>(i)];
      if (point.above - skins_ > limit_) continue;
      const Vec2 on_side = start + point.along * along, on_other = on_side + point.above * normal;
      put(flipped_ ? on_other : on_side, flipped_ ? on_side : on_other, point.above, point.feature);
    }
    if (leans) lean(slack);
    return true;
  }

  /// Clips to the points above the side from 0 to `length`. @return how many points there are
  static int clip(std::array<Above, 2>& points, double length) {
    const Above first = points[0], second = points[1];
    const double span = second.along - first.along;
    const auto clipped = [&](Above point) {
      const double along = std::clamp(point.along, 0.0, length);
      if (along == point.along) return point;
      point.above = first.above + (second.above - first.above) * ((along - first.along) / span);
      point.along = along;
      return point;
    };
    if ((first.along < 0 && second.along < 0) || (first.along > length && second.along > length)) return 0;
    points = {clipped(first), clipped(second)};
    return 2;
  }

  const Sides &a_, &b_;
  double limit_, skins_;
  bool flipped_ = false;
};

}  // namespace

Found find_manifold(const Placed& a, const Placed& b, double limit) {
  if (b.plate->endless) {
    if (a.plate->endless) return {};
    Found found = find_manifold(b, a, limit);
    found.normal = -found.normal;
    for (FoundPoint& point : found.points) std::swap(point.core_a, point.core_b);
    return found;
  }
  const Vec2 apart = a.turn.back(b.center - a.center);
  const Turn relative = a.turn.to(b.turn);
  std::array<Corner, Polygon::most_corners> placed;
  const std::size_t count = b.plate->corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Corner& corner = b.plate->corners[i];
    placed[i] = {apart + relative * corner.at, relative * corner.normal};
  }
  const Sides sides_a{a.plate->corners.data(), a.plate->corners.size(), a.plate->skin};
  const Sides sides_b{placed.data(), count, b.plate->skin};
  Finder finder(sides_a, sides_b, limit);
  if (a.plate->endless)
    finder.find_on_line();
  else
    finder.find(std::min(a.plate->reach, b.plate->reach));
  Found& found = finder.found;
  found.normal = a.turn * found.normal;
  for (int i = 0; i < found.count; ++i) {
    FoundPoint& point = found.points[static_cast<std::size_t>(i)];
    point.core_b = a.turn * Vec2(point.core_b - apart);
    point.core_a = a.turn * point.core_a;
  }
  return found;
}

}  // namespace tweenfall::planar::inner
