#include "state/contact_memories.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tweenfall::state {

ContactMemories::ContactMemories(std::vector<ContactMemory> all) : all_(std::move(all)) {
  sorted_.resize(all_.size());
  std::iota(sorted_.begin(), sorted_.end(), std::uint32_t{0});
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
    if (all_[place].gone) unused_.push_back(place);
    return all_[place].gone;
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

void ContactMemories::keep(std::vector<std::uint32_t>& sorted) {
  kept_.assign(all_.size(), 0);
  for (const std::uint32_t place : sorted) kept_[place] = 1;
  for (const std::uint32_t place : sorted_)
    if (kept_[place] == 0) unused_.push_back(place);
  std::swap(sorted_, sorted);
  starts_.clear();
}

}  // namespace tweenfall::state
