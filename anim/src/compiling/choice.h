#pragma once

// Which way each channel is stored: at little cost, and so that few runs come about.

#include <vector>

#include "compiling/encode.h"

namespace tweenfall::crowd {

/// One form for each channel, of its ways. A run more is worth while where it saves some of the whole cost.
[[nodiscard]] std::vector<Form> chosen(const std::vector<std::vector<Way>>& choices);

}  // namespace tweenfall::crowd
