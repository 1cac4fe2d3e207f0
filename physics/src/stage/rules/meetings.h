#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// A keyed body whose rules wait for a contact starts to touch another body.
struct Meeting {
  double time = 0;       ///< stage time just before, s
  std::size_t body = 0;  ///< index among the staged bodies
  BodyId other;
};

/// All in (state.time, end), in order of time; each pair once. Keyed bodies are followed along their own curves, free
/// ones as they fly if nothing stops them.
/// @param watched  by staged body: whether it counts
[[nodiscard]] std::vector<Meeting> meetings(const StageState& state, double end, const std::vector<char>& watched);

}  // namespace tweenfall::staging
