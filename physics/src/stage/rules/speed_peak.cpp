#include "stage/rules/speed_peak.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::staging {

namespace {

/// Speeds are compared at multiples of this time, so that a peak is found at the same time whatever stretch
/// is searched, s.
constexpr double grid = 1.0 / 2048;
constexpr double most_cells = 1e5;
/// Time over which the slope of a speed is computed, s.
constexpr double beside = 1e-5;
/// A speed must exceed those a cell before and after it by this part to be a peak.
constexpr double told_apart = 1e-12;

class SpeedOnPath {
 public:
  SpeedOnPath(const Path& path, const Vec3& center) : path_(path), center_(center) {}
  [[nodiscard]] double at(double time) const {
    const Motion motion = path_.at(time);
    return shifted(motion.twist, motion.pose.rotation * center_).linear.norm();
  }
  [[nodiscard]] bool rises(double time) const { return at(time + beside) > at(std::max(0.0, time - beside)); }

 private:
  const Path& path_;
  const Vec3& center_;
};

}  // namespace

double speed_peak(const StageState& state, const StagedBody& body, double from, double to) {
  if (state.world.owner(body.id) == Owner::free || !std::isfinite(to)) return infinity;
  const SpeedOnPath speed(body.path, state.world.mass(body.id).center);
  const double first = std::floor(std::max(from, 0.0) / grid), last = std::ceil(to / grid);
  if (last - first > most_cells) return infinity;
  bool rises = speed.rises(first * grid);
  for (double cell = first; cell < last; ++cell) {
    const bool rose = rises;
    rises = speed.rises((cell + 1) * grid);
    if (!rose || rises) continue;
    double low = cell * grid, high = (cell + 1) * grid;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (speed.rises(middle) ? low : high) = middle;
    }
    const double least = speed.at(high) * (1 - told_apart);
    if (high > from && high <= to && speed.at(high - grid) < least && speed.at(high + grid) < least) return high;
  }
  return infinity;
}

}  // namespace tweenfall::staging
