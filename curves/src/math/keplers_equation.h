#pragma once

// Where on its conic section a body is at a given time.

namespace tweenfall::math {

/// E with E - eccentricity sin E = mean; eccentricity 0 to below 1, |mean| <= pi.
[[nodiscard]] double eccentric_anomaly(double mean, double eccentricity) noexcept;

/// H with eccentricity sinh H - H = mean; eccentricity above 1, any finite mean.
[[nodiscard]] double hyperbolic_anomaly(double mean, double eccentricity) noexcept;

}  // namespace tweenfall::math
