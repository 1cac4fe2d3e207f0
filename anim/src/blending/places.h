#pragma once

// Places of entries on a plane, relative to their middle and scaled to size 1.

#include <tweenfall/curves/values.h>

#include <span>
#include <string>
#include <vector>

namespace tweenfall::blending {

struct PlaneFrame {
  Vec2 center{0, 0};
  double size = 1;

  [[nodiscard]] Vec2 scaled(const Vec2& place) const noexcept {
    constexpr double far = 1e100;
    return Vec2((place - center) / size).cwiseMax(-far).cwiseMin(far);
  }
};

[[nodiscard]] std::string text_of(const Vec2& place);

/// @param scaled    written, one for each place, where these are finite
/// @param problems one line is added for each: places that are not finite, too far apart, or equal
[[nodiscard]] PlaneFrame framed(std::span<const Vec2> places, std::vector<Vec2>& scaled, std::string& problems);

}  // namespace tweenfall::blending
