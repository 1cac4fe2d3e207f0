#pragma once

#include "stage/timeline.h"

namespace tweenfall {

struct Stage::Implementation : staging::Timeline {
  using Timeline::Timeline;
};

}  // namespace tweenfall
