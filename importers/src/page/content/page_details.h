#pragma once

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall::page {

/// Points of contact that a page carries at most, over all frames.
inline constexpr std::size_t most_page_contacts = 300 * 1000;

/// What the steps worked with at these frames, as a member "details"; nothing where it was not recorded, or is more
/// than a page carries.
void append_details(std::string& out, const Recording& recording, const std::vector<std::size_t>& frames);

}  // namespace tweenfall::page
