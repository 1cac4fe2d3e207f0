#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "actors/particles/block.h"

namespace tweenfall::particles {

namespace {

/// Particles solved together: their slopes follow from states aside along each axis.
constexpr std::size_t group = most_together / 3;
constexpr int most_steps = 120, most_halvings = 40;
/// Rounding of a velocity, relative.
constexpr double rounding = 4e-16;
/// A step that is shorter than the one before by this factor needs no new slopes.
constexpr double straight = 0.01;

/// The velocity that one particle has at the end of the step, as far as it is known.
struct Unknown {
  Vec3 place;      ///< at the end, without what the unknown velocity adds
  Vec3 known;      ///< part of the velocity that follows from the start
  Vec3 now, best;  ///< the present guess, and the last that came nearer
  Vec3 pull;       ///< acceleration at the present guess
  std::array<Vec3, 3> slopes;
  double least_off, least_change, before;
  int halvings;

  void begin(const Vec3& guess) {
    now = best = guess;
    least_off = least_change = std::numeric_limits<double>::infinity();
    before = 0;
    halvings = 0;
  }
};

struct Memory {
  std::array<Unknown, group> unknowns;
  std::array<std::size_t, group> open, bent;
  Lists places, speeds, start, end;
  Pulls pulls;
};

/// x with a x + b y + c z = value, by Cramer's rule; 0 if there is none.
Vec3 solution(const std::array<Vec3, 3>& columns, const Vec3& value) {
  const auto& [a, b, c] = columns;
  const Vec3 across = b.cross(c);
  const double determinant = a.dot(across);
  const Vec3 found = Vec3(value.dot(across), a.dot(value.cross(c)), a.dot(b.cross(value))) / determinant;
  return found.allFinite() ? found : Vec3(0, 0, 0);
}

class Ending {
 public:
  /// @param share  of the rates at the end in the mean over the step: 1 or 1/2
  Ending(const Pulling& pulling, double end, double dt, double share, Memory& memory)
      : pulling_(pulling), end_(end), ahead_(share * dt), memory_(memory) {}

  /// Solves for the first `count` unknowns.
  void meet(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) memory_.open[i] = i;
    for (int step = 0; step < most_steps && count > 0; ++step) {
      pull({memory_.open.data(), count});
      std::size_t left = 0, bent = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t who = memory_.open[i];
        Unknown& one = memory_.unknowns[who];
        const Vec3 error = error_of(one), change = one.before > 0 ? solution(one.slopes, error) : Vec3(0, 0, 0);
        if (one.before > 0 && change.norm() <= straight * one.before) {
          if (go_on(one, error, change)) memory_.open[left++] = who;
        } else {
          memory_.bent[bent++] = who;
        }
      }
      find_slopes({memory_.bent.data(), bent});
      for (std::size_t i = 0; i < bent; ++i) {
        Unknown& one = memory_.unknowns[memory_.bent[i]];
        const Vec3 error = error_of(one);
        if (go_on(one, error, solution(one.slopes, error))) memory_.open[left++] = memory_.bent[i];
      }
      count = left;
    }
  }

 private:
  [[nodiscard]] Vec3 error_of(const Unknown& one) const { return one.known + ahead_ * one.pull - one.now; }

  /// Evaluates what acts on some at their present guesses.
  void pull(std::span<const std::size_t> some) {
    for (std::size_t i = 0; i < some.size(); ++i) put(i, memory_.unknowns[some[i]], memory_.unknowns[some[i]].now);
    evaluate(some.size());
    for (std::size_t i = 0; i < some.size(); ++i) memory_.unknowns[some[i]].pull = found(i);
  }

  /// By differences: exact if forces are linear.
  void find_slopes(std::span<const std::size_t> some) {
    // Large enough to exceed rounding, and small enough that curves look straight.
    const auto aside = [&](const Unknown& one) { return 1e-7 * size_of(one) + 1e-9; };
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Unknown& one = memory_.unknowns[some[i]];
      for (std::size_t axis = 0; axis < 3; ++axis)
        put(3 * i + axis, one, one.now + aside(one) * Vec3::Unit(static_cast<Eigen::Index>(axis)));
    }
    evaluate(3 * some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      Unknown& one = memory_.unknowns[some[i]];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Vec3& slope = one.slopes[axis];
        slope = ahead_ / aside(one) * (one.pull - found(3 * i + axis));
        if (!slope.allFinite()) slope.setZero();
        slope[static_cast<Eigen::Index>(axis)] += 1;
      }
    }
  }

  void put(std::size_t at, const Unknown& one, const Vec3& speed) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      memory_.speeds[axis][at] = speed[k];
      memory_.places[axis][at] = one.place[k] + ahead_ * speed[k];
    }
  }
  void evaluate(std::size_t count) {
    accelerate(pulling_, count, memory_.places, memory_.speeds, end_, Instant::end, memory_.pulls, memory_.end);
  }
  [[nodiscard]] Vec3 found(std::size_t at) const {
    return {memory_.end[0][at], memory_.end[1][at], memory_.end[2][at]};
  }

  /// One step of Newton's method, or half of the one before if that led further away.
  /// @return whether more are needed
  bool go_on(Unknown& one, const Vec3& error, const Vec3& change) const {
    const double off = error.norm(), length = change.norm(), size = size_of(one);
    if (!(off < one.least_off || length < one.least_change)) {
      // It went too far, or rounding is all that is left.
      const bool rounds = one.least_change <= 1e-9 * size;
      one.now = rounds || ++one.halvings > most_halvings ? one.best : Vec3(0.5 * (one.now + one.best));
      one.before = 0;
      return one.now != one.best;
    }
    // Steps shrink at least as fast as they did.
    const double next = one.before > length ? length / one.before * length : length;
    one.halvings = 0;
    one.before = length;
    one.least_off = std::min(off, one.least_off);
    one.least_change = std::min(length, one.least_change);
    one.best = one.now;
    one.now += change;
    return next > rounding * size;
  }

  /// Of a velocity, and of one that changes the place as much as rounding does.
  [[nodiscard]] double size_of(const Unknown& one) const {
    const double far = pulling_.steady ? 0 : std::min(one.place.cwiseAbs().maxCoeff() / ahead_, 1e12);
    return one.now.cwiseAbs().maxCoeff() + far;
  }

  const Pulling& pulling_;
  double end_, ahead_;
  Memory& memory_;
};

}  // namespace

void meet_the_end(const Pulling& pulling, std::size_t count, double time, double dt, double share, Lists& places,
                  Lists& speeds) {
  thread_local Memory memory;
  if (share < 1) accelerate(pulling, count, places, speeds, time, Instant::start, memory.pulls, memory.start);
  Ending ending(pulling, time + dt, dt, share, memory);
  for (std::size_t begin = 0; begin < count; begin += group) {
    const std::size_t some = std::min(group, count - begin);
    for (std::size_t i = 0; i < some; ++i) {
      Unknown& one = memory.unknowns[i];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<Eigen::Index>(axis);
        const double speed = speeds[axis][begin + i];
        one.place[at] = places[axis][begin + i] + (1 - share) * dt * speed;
        one.known[at] = share < 1 ? speed + (1 - share) * dt * memory.start[axis][begin + i] : speed;
      }
      one.begin({speeds[0][begin + i], speeds[1][begin + i], speeds[2][begin + i]});
    }
    ending.meet(some);
    for (std::size_t i = 0; i < some; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<Eigen::Index>(axis);
        speeds[axis][begin + i] = memory.unknowns[i].now[at];
        places[axis][begin + i] = memory.unknowns[i].place[at] + share * dt * memory.unknowns[i].now[at];
      }
  }
}

}  // namespace tweenfall::particles
