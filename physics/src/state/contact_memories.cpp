#include "state/contact_memories.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "state/blank.h"

namespace tweenfall::state {

ContactMemories::ContactMemories(std::span<const WholeContact> all) {
  all_.reserve(all.size());
  for (const WholeContact& whole : all) {
    ContactMemory& memory = all_.emplace_back(whole.memory);
    const MoreOfContact& more = whole.more;
    const RareOfContact& rare = whole.rare;
    memory.more = memory.rare = nowhere;
    if (memory.count > 1 || !blank(more.kept_twist) || memory.is(ContactMemory::holds)) own_more(memory) = more;
    const bool parts = rare.part_a != 0 || rare.part_b != 0;
    const bool impulses = !blank(rare.kept_spin) || !blank(rare.passed_over) || !blank(rare.kept_rolling);
    if (parts || impulses || rare.has_arms) own_rare(memory) = rare;
  }
  sorted_.resize(all_.size());
  std::iota(sorted_.begin(), sorted_.end(), std::uint32_t{0});
}

WholeContact ContactMemories::whole(std::uint32_t place) const {
  WholeContact whole;
  whole.memory = all_[place];
  if (const MoreOfContact* its = more(all_[place])) whole.more = *its;
  if (const RareOfContact* its = rare(all_[place])) whole.rare = *its;
  return whole;
}

KeptImpulses ContactMemories::kept(const ContactMemory& memory) const {
  KeptImpulses kept;
  kept.kept_step = memory.kept_step;
  kept.slid = memory.is(ContactMemory::slid);
  if (const MoreOfContact* its = more(memory)) kept.kept_twist = its->kept_twist;
  if (const RareOfContact* its = rare(memory)) {
    kept.kept_rolling = its->kept_rolling;
    kept.kept_spin = its->kept_spin;
    kept.passed_over = its->passed_over;
  }
  return kept;
}

std::span<const std::uint32_t> ContactMemories::of(std::uint32_t body) {
  if (starts_.empty()) {
    std::uint32_t last = 0;
    for (const std::uint32_t place : sorted_) last = std::max(last, all_[place].b);
    starts_.assign(last + std::size_t{2}, 0);
    for (const std::uint32_t place : sorted_)
      for (const std::uint32_t end : {all_[place].a, all_[place].b}) ++starts_[end];
    std::size_t end = 0;
    for (std::size_t& start : starts_) start = end += start;
    by_body_.resize(end);
    for (std::size_t i = sorted_.size(); i-- > 0;)
      for (const std::uint32_t of : {all_[sorted_[i]].a, all_[sorted_[i]].b}) by_body_[--starts_[of]] = sorted_[i];
  }
  if (body + std::size_t{1} >= starts_.size()) return {};
  return std::span(by_body_).subspan(starts_[body], starts_[body + 1] - starts_[body]);
}

void ContactMemories::tidy() {
  starts_.clear();
  if (!some_gone_) return;
  std::erase_if(sorted_, [this](std::uint32_t place) {
    if (!all_[place].is(ContactMemory::gone)) return false;
    free(place);
    return true;
  });
  some_gone_ = false;
}

std::uint32_t ContactMemories::take() {
  if (unused_.empty()) {
    all_.emplace_back();
    return static_cast<std::uint32_t>(all_.size() - 1);
  }
  const std::uint32_t place = unused_.back();
  unused_.pop_back();
  all_[place] = {};
  return place;
}

void ContactMemories::free(std::uint32_t place) {
  more_.free(all_[place].more);
  rare_.free(all_[place].rare);
  unused_.push_back(place);
}

}  // namespace tweenfall::state
