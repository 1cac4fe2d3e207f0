#pragma once

// Spans whose angular acceleration is continuous over a run.

#include <optional>

#include "turns/turn_rule.h"

namespace tweenfall::turns {

struct NaturalEnds {
  std::optional<Vec3> start{}, end{};  ///< angular velocity, rad/s, axes of the key; empty: no angular acceleration
  bool around = false;                 ///< the last key is the same as the first
};

void append_natural(const std::vector<Stretch>& stretches, std::size_t first, std::size_t last, const NaturalEnds& ends,
                    std::vector<RotationSpan>& spans);

}  // namespace tweenfall::turns
