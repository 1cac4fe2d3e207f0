#include <tweenfall/anim/blend_space.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "blending/delaunay.h"
#include "blending/heading.h"
#include "blending/places.h"

namespace tweenfall {

namespace blending {
namespace {

// The turn from a to b to the parameter, with its rates.
Sample<double> moving_turn(std::span<const Vec2> places, std::size_t a, std::size_t b,
                           const Sample<Vec2>& at) noexcept {
  const Vec2 along = places[b] - places[a];
  return {turn_of(places, a, b, at.value), along[0] * at.rate[1] - along[1] * at.rate[0],
          along[0] * at.acceleration[1] - along[1] * at.acceleration[0]};
}

Sample<double> divided(const Sample<double>& number, double by) noexcept {
  return {number.value / by, number.rate / by, number.acceleration / by};
}

// The turns about the edges opposite the corners: the weights before division by their sum.
std::array<Sample<double>, 3> turns_in(std::span<const Vec2> places, const Triangle& triangle,
                                       const Sample<Vec2>& at) noexcept {
  return {moving_turn(places, triangle[1], triangle[2], at), moving_turn(places, triangle[2], triangle[0], at),
          moving_turn(places, triangle[0], triangle[1], at)};
}

void weigh_triangle(const Triangle& triangle, const std::array<Sample<double>, 3>& turns,
                    std::span<Sample<double>> weights) noexcept {
  double sum = 0;
  for (const Sample<double>& turn : turns) sum += std::max(turn.value, 0.0);
  if (!(sum > 0)) {
    weights[triangle[0]].value = 1;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    weights[triangle[i]] = divided(turns[i], sum);
    if (!(turns[i].value > 0)) weights[triangle[i]].value = 0;
  }
}

}  // namespace
}  // namespace blending

BlendPlane::BlendPlane(std::vector<Vec2> places) : places_(std::move(places)) {
  std::string problems;
  if (places_.size() < 3)
    problems += "\n  it needs three entries or more; there " +
                std::string(places_.size() == 1 ? "is 1" : "are " + std::to_string(places_.size()));
  const blending::PlaneFrame frame = blending::framed(places_, scaled_places_, problems);
  center_ = frame.center;
  size_ = frame.size;
  if (problems.empty()) {
    blending::Triangulation made = blending::delaunay(scaled_places_);
    triangles_ = std::move(made.triangles);
    border_ = std::move(made.border);
    std::vector<char> used(places_.size());
    for (const auto& triangle : triangles_)
      for (const std::size_t entry : triangle) used[entry] = 1;
    if (triangles_.empty())
      problems += "\n  all its entries lie on one line, from " + blending::text_of(places_[0]) + " to " +
                  blending::text_of(places_.back()) + "; use a blend line for these";
    else
      for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i])
          problems += "\n  entry " + std::to_string(i) + " at " + blending::text_of(places_[i]) +
                      " makes a triangle without an area with any two others";
  }
  if (!problems.empty()) throw std::invalid_argument("a blend plane cannot be made of its entries:" + problems);
}

Vec2 BlendPlane::scaled(const Vec2& place) const noexcept {
  return blending::PlaneFrame{center_, size_}.scaled(place);
}

void BlendPlane::weights(const Sample<Vec2>& parameter, std::span<Sample<double>> weights, Side side) const noexcept {
  using blending::heading;
  std::ranges::fill(weights, Sample<double>{0, 0, 0});
  const Sample<Vec2> at{scaled(parameter.value), parameter.rate / size_, parameter.acceleration / size_};

  // Beyond an edge of the border, between its ends: the nearest point is on that edge.
  const std::size_t count = border_.size();
  bool outside = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t a = border_[i], b = border_[i + 1 < count ? i + 1 : 0];
    const Sample<double> turn = blending::moving_turn(scaled_places_, a, b, at);
    if (heading(blending::without_rounding(turn, at), side) >= 0) continue;
    outside = true;
    const Vec2 along = scaled_places_[b] - scaled_places_[a], from = at.value - scaled_places_[a];
    const double length = along.squaredNorm();
    const Sample<double> share{along.dot(from) / length, along.dot(at.rate) / length,
                               along.dot(at.acceleration) / length};
    const Sample<double> rest{1 - share.value, -share.rate, -share.acceleration};
    if (heading(share, side) < 0 || heading(rest, side) < 0) continue;
    const double distance = -turn.value / std::sqrt(length);
    if (!(distance < nearest)) continue;
    if (std::isfinite(nearest)) std::ranges::fill(weights, Sample<double>{0, 0, 0});
    nearest = distance;
    weights[b] = share;
    weights[a] = rest;
  }
  if (std::isfinite(nearest)) return;
  if (outside) {
    const std::size_t corner = *std::ranges::min_element(
        border_, {}, [&](std::size_t entry) { return Vec2(scaled_places_[entry] - at.value).squaredNorm(); });
    weights[corner].value = 1;
    return;
  }

  const blending::Triangle* best = nullptr;
  double least_outside = -std::numeric_limits<double>::infinity();
  for (const blending::Triangle& triangle : triangles_) {
    const auto turns = blending::turns_in(scaled_places_, triangle, at);
    if (std::ranges::all_of(turns, [&](const Sample<double>& turn) {
          return heading(blending::without_rounding(turn, at), side) >= 0;
        })) {
      best = &triangle;
      break;
    }
    // Rounding may leave the parameter very slightly outside all triangles.
    const double inside = std::min({turns[0].value, turns[1].value, turns[2].value});
    if (inside > least_outside) {
      least_outside = inside;
      best = &triangle;
    }
  }
  blending::weigh_triangle(*best, blending::turns_in(scaled_places_, *best, at), weights);
}

}  // namespace tweenfall
