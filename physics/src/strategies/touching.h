#pragma once

namespace tweenfall::strategies {

/// What is nearer than this touches, m.
constexpr double touching = 1e-6;

}  // namespace tweenfall::strategies
