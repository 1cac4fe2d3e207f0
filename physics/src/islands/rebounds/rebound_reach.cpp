#include "islands/rebounds/rebound_reach.h"

namespace tweenfall::blocks {

void ReboundReach::begin(const ContactBlocks& contacts, const std::vector<IslandBody>& bodies) {
  known_.assign(bodies.size(), 0);
  before_.resize(bodies.size());
  open_.assign((contacts.size() * lane_count + 63) / 64, 0);
  slots_.assign(contacts.size() * lane_count, 0);
  contact_count_ = ball_count_ = 0;
  first_ball_ = contacts.blocks.size() * lane_count;
  if (!starts_.empty()) return;
  const auto each_end = [&](const auto& see) {
    for (std::size_t i = contacts.size(); i-- > 0;) {
      const ContactBlocks::Origin& origin = contacts.origin(i);
      const bool ball = i >= contacts.blocks.size();
      const std::uint32_t* a = ball ? contacts.balls[i - contacts.blocks.size()].a : contacts.blocks[i].a;
      const std::uint32_t* b = ball ? contacts.balls[i - contacts.blocks.size()].b : contacts.blocks[i].b;
      for (std::size_t lane = lane_count; lane-- > 0;) {
        if (!origin[lane]) continue;
        for (const std::uint32_t place : {a[lane], b[lane]})
          if (bodies[place].movable) see(place, static_cast<std::uint32_t>(lane_count * i + lane));
      }
    }
  };
  starts_.assign(bodies.size() + 1, 0);
  each_end([this](std::uint32_t place, std::uint32_t) { ++starts_[place]; });
  std::uint32_t end = 0;
  for (std::uint32_t& start : starts_) start = end += start;
  lanes_.resize(end);
  each_end([this](std::uint32_t place, std::uint32_t lane) { lanes_[--starts_[place]] = lane; });
}

void ReboundReach::push(std::uint32_t place) {
  for (std::uint32_t i = starts_[place]; i < starts_[place + 1]; ++i) look_at(lanes_[i]);
}

}  // namespace tweenfall::blocks
