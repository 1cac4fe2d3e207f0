#pragma once

// Which way each channel is stored: in little room, and so that few runs come about.

#include <vector>

#include "crowd/encode.h"

namespace tweenfall::crowd {

/// One form for each channel, of its ways. A run more is worth while where it saves some room of the whole.
[[nodiscard]] std::vector<Form> chosen(const std::vector<std::vector<Way>>& choices);

}  // namespace tweenfall::crowd
