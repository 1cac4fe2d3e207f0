#pragma once

// The graphs in a page: parameters, and the states of machines, over time.

#include <tweenfall/physics/stage/recording.h>

namespace tweenfall::page {

/// Appends `,"graphs":[...]`, nothing where there are none. @param frames the frames in the page
void append_page_graphs(std::string& out, const Recording& recording, const std::vector<std::size_t>& frames);

}  // namespace tweenfall::page
