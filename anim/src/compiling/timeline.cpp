#include <algorithm>
#include <cmath>

#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

namespace {

/// Among so few knots a linear search is just as fast.
constexpr std::size_t few = 8;

std::size_t cell_of(const Timeline& timeline, double time) {
  const double cell = (time - timeline.knots.front()) * timeline.cells_per_second;
  const std::size_t last = timeline.cells.size() - 2;
  return cell > 0 ? std::min(static_cast<std::size_t>(std::min(cell, 4e9)), last) : 0;
}

}  // namespace

void Timeline::index() {
  const double length = knots.back() - knots.front();
  const std::size_t count = length > 0 ? knots.size() : 1;
  cells_per_second = length > 0 ? std::min(static_cast<double>(count) / length, 1e300) : 0;
  cells.assign(count + 1, static_cast<std::uint32_t>(knots.size()));
  // With the same rounding as in the lookup of times, so that a knot is never assigned to another cell.
  for (std::size_t i = knots.size(); i-- > 0;) cells[cell_of(*this, knots[i])] = static_cast<std::uint32_t>(i);
  for (std::size_t cell = count; cell-- > 0;) cells[cell] = std::min(cells[cell], cells[cell + 1]);
}

Timeline::Place Timeline::at(double time, bool arriving) const noexcept {
  const std::size_t cell = cell_of(*this, time);
  // The first knot after the time; one at the time counts as after it on arrival.
  std::size_t behind = cells[cell];
  const std::size_t end = cells[cell + 1];
  if (end - behind > few) {
    const auto first = knots.begin() + static_cast<std::ptrdiff_t>(behind),
               last = knots.begin() + static_cast<std::ptrdiff_t>(end);
    const auto next = arriving ? std::lower_bound(first, last, time) : std::upper_bound(first, last, time);
    behind = static_cast<std::size_t>(next - knots.begin());
  } else {
    // All are counted, because a branch to stop early could not be predicted.
    std::size_t passed = 0;
    for (std::size_t i = behind; i < end; ++i) passed += (arriving ? knots[i] < time : knots[i] <= time) ? 1 : 0;
    behind += passed;
  }
  Place place{};
  place.knot = std::min(behind > 0 ? behind - 1 : 0, knots.size() - 2);
  const double from = knots[place.knot];
  place.length = knots[place.knot + 1] - from;
  if (place.length > 0)
    place.u = std::clamp((time - from) / place.length, 0.0, 1.0);
  else
    place.u = (arriving ? time > from : time >= from) ? 1 : 0;
  return place;
}

void spline_weights(double x, double* weights) noexcept {
  const double y = 1 - x;
  weights[0] = y * y * y / 6;
  weights[1] = (4 + x * x * (3 * x - 6)) / 6;
  weights[2] = (4 + y * y * (3 * y - 6)) / 6;
  weights[3] = x * x * x / 6;
}

}  // namespace tweenfall::crowd
