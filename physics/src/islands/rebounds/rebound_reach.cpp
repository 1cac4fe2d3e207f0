#include "islands/rebounds/rebound_reach.h"

namespace tweenfall::blocks {

void ReboundReach::begin(const ContactBlocks& contacts, const std::vector<IslandBody>& bodies,
                         const std::vector<BodyLanes>& velocities) {
  before_.assign(velocities.begin(), velocities.begin() + static_cast<std::ptrdiff_t>(bodies.size()));
  const std::size_t words = (contacts.size() * lane_count + 63) / 64;
  if (open_.size() < words) open_ = std::vector<std::atomic<std::uint64_t>>(words);
  for (std::atomic<std::uint64_t>& word : open_) word.store(0, std::memory_order_relaxed);
  slots_.assign(contacts.size() * lane_count, 0);
  contact_count_ = ball_count_ = known_contacts_ = known_balls_ = 0;
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

void ReboundReach::reach(std::span<const std::uint32_t> lanes) {
  known_contacts_ = contact_count_;
  known_balls_ = ball_count_;
  for (const std::uint32_t lane : lanes) {
    if (slots_[lane] != 0) continue;
    slots_[lane] = static_cast<std::uint32_t>(lane >= first_ball_ ? ++ball_count_ : ++contact_count_);
  }
  if (contacts_.size() < contact_count_) contacts_.resize(contact_count_);
  if (balls_.size() < ball_count_) balls_.resize(ball_count_);
}

std::span<const std::uint32_t> ReboundReach::due(const ContactBlocks::Stretch& stretch) {
  due_.clear();
  for (std::uint32_t word = stretch.begin / 64; 64 * word < stretch.end; ++word) {
    const std::uint32_t first = 64 * word;
    std::uint64_t its = ~std::uint64_t{0};
    if (first < stretch.begin) its &= ~std::uint64_t{0} << (stretch.begin - first);
    if (stretch.end - first < 64) its &= ~(~std::uint64_t{0} << (stretch.end - first));
    const std::uint64_t all = open_[word].load(std::memory_order_relaxed);
    if ((all & its) == 0) continue;
    open_[word].store(all & ~its, std::memory_order_relaxed);
    for (std::uint64_t open = all & its; open != 0; open &= open - 1)
      due_.push_back(first + static_cast<std::uint32_t>(std::countr_zero(open)));
  }
  return due_;
}

}  // namespace tweenfall::blocks
