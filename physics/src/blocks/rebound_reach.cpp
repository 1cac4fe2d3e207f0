#include "blocks/rebound_reach.h"

namespace tweenfall::blocks {

void ReboundReach::begin(const std::vector<ContactBlock>& blocks, const std::vector<IslandBody>& bodies) {
  stirred_.assign(bodies.size(), 0);
  reached_.assign((blocks.size() * lane_count + 63) / 64, 0);
  if (!starts_.empty()) return;
  const auto each_end = [&](const auto& see) {
    for (std::size_t i = blocks.size(); i-- > 0;)
      for (int lane = lane_count; lane-- > 0;) {
        if (!blocks[i].contacts[lane]) continue;
        for (const std::uint32_t place : {blocks[i].a[lane], blocks[i].b[lane]})
          if (bodies[place].movable)
            see(place, static_cast<std::uint32_t>(lane_count * i) + static_cast<std::uint32_t>(lane));
      }
  };
  starts_.assign(bodies.size() + 1, 0);
  each_end([this](std::uint32_t place, std::uint32_t) { ++starts_[place]; });
  std::uint32_t end = 0;
  for (std::uint32_t& start : starts_) start = end += start;
  lanes_.resize(end);
  each_end([this](std::uint32_t place, std::uint32_t lane) { lanes_[--starts_[place]] = lane; });
}

void ReboundReach::stir(std::uint32_t place) {
  if (stirred_[place]) return;
  stirred_[place] = 1;
  for (std::uint32_t i = starts_[place]; i < starts_[place + 1]; ++i)
    reached_[lanes_[i] / 64] |= std::uint64_t{1} << (lanes_[i] % 64);
}

}  // namespace tweenfall::blocks
