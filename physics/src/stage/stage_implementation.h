#pragma once

#include "stage/timeline.h"

namespace tweenfall {

struct Stage::Implementation : staging::Timeline {
  using Timeline::Timeline;
};

namespace staging {

/// @throws std::invalid_argument for a node that is not on the stage
void require_node(const StageState& shown, NodeId node);
/// @throws std::invalid_argument for a node that has no body, too
[[nodiscard]] std::size_t body_index(const StageState& shown, NodeId node);

}  // namespace staging

}  // namespace tweenfall
