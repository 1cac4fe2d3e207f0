#pragma once

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall::page {

/// Greatest number of contact points in a page, over all frames.
inline constexpr std::size_t most_page_contacts = 300 * 1000;

/// Appends the details of the steps at these frames as a member "details"; nothing where they were not recorded, or are
/// too many for a page.
void append_details(std::string& out, const Recording& recording, const std::vector<std::size_t>& frames);

}  // namespace tweenfall::page
