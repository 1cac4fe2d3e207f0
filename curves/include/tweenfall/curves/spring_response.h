#pragma once

/// The free motion of a damped spring of frequency 1 radian per second, for every damping ratio.

namespace tweenfall {

/// Solutions of x'' + 2 z x' + x = 0 at one time: the motion that starts from 1 at rest, and the one from 0 at speed 1.
/// The derivative of `displaced` is -struck, that of `struck` is displaced - 2 z struck.
struct SpringResponse {
  double displaced, struck;
};

/// @param phase          time times frequency, radians; at negative ones it runs backwards
/// @param damping_ratio  >= 0
[[nodiscard]] SpringResponse spring_response(double phase, double damping_ratio) noexcept;

}  // namespace tweenfall
