#include "blending/places.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::blending {

std::string text_of(const Vec2& place) {
  return "(" + number_text(place[0]) + ", " + number_text(place[1]) + ")";
}

namespace {

// Lists the pairs that are nearer to each other than 1e-9, among places within a square of size 1.
std::string nearly_equal(std::span<const Vec2> scaled, std::span<const Vec2> places) {
  std::vector<std::size_t> order(scaled.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return scaled[i][0]; });
  std::string problems;
  constexpr double near = 1e-9;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && scaled[order[k]][0] - scaled[order[i]][0] <= near; ++k) {
      const auto [first, second] = std::minmax(order[i], order[k]);
      if (std::abs(scaled[first][1] - scaled[second][1]) <= near)
        problems += "\n  entries " + std::to_string(first) + " and " + std::to_string(second) + " are both at " +
                    text_of(places[first]);
    }
  return problems;
}

}  // namespace

PlaneFrame framed(std::span<const Vec2> places, std::vector<Vec2>& scaled, std::string& problems) {
  PlaneFrame frame;
  bool finite = true;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::isfinite(places[i][0]) || !std::isfinite(places[i][1])) {
      finite = false;
      problems += "\n  the place of entry " + std::to_string(i) + " must be finite; it is " + text_of(places[i]);
    }
  if (finite && !places.empty()) {
    Vec2 least = places[0], most = places[0];
    for (const Vec2& place : places) {
      least = least.cwiseMin(place);
      most = most.cwiseMax(place);
    }
    frame.center = least / 2 + most / 2;
    frame.size = std::max(most[0] - least[0], most[1] - least[1]);
    if (!(frame.size > 1e-150)) frame.size = 1;  // all at one place
    if (!(frame.size < 1e150)) {
      problems += "\n  its places are too far apart for a number to hold the distance";
      finite = false;
    }
  }
  if (!finite) return frame;
  scaled.reserve(places.size());
  for (const Vec2& place : places) scaled.push_back(frame.scaled(place));
  problems += nearly_equal(scaled, places);
  return frame;
}

}  // namespace tweenfall::blending
