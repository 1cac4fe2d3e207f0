#pragma once

// Chooses how each channel is stored: at little cost, and with few runs.

#include <vector>

#include "compiling/encode.h"

namespace tweenfall::crowd {

/// One form for each channel, from its ways. An additional run is worthwhile if it saves some share of the whole cost.
/// @param smallest  size alone counts
[[nodiscard]] std::vector<Form> chosen(const std::vector<std::vector<Way>>& choices, bool smallest);

}  // namespace tweenfall::crowd
