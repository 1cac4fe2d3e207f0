#pragma once

#include "stage/time/timeline.h"

namespace tweenfall {

struct Stage::Implementation : staging::Timeline {
  using Timeline::Timeline;
};

}  // namespace tweenfall
