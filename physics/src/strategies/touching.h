#pragma once

namespace tweenfall::strategies {

/// Bodies nearer than this touch, m.
constexpr double touching = 1e-6;

}  // namespace tweenfall::strategies
