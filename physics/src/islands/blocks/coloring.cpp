#include "islands/blocks/coloring.h"

#include <algorithm>
#include <bit>

namespace tweenfall::blocks {

namespace {

constexpr std::uint32_t bits = 64;

std::uint64_t word_of(const std::vector<std::uint64_t>& words, std::size_t at) {
  return at < words.size() ? words[at] : 0;
}

}  // namespace

void Coloring::reset(std::size_t bodies) {
  taken_.assign(bodies, {});
  for (const std::uint32_t body : with_late_) taken_late_[body].clear();
  with_late_.clear();
  end_ = late;
}

std::uint32_t Coloring::color(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves) {
  if (a_moves && b_moves) {
    const std::uint64_t open = ~(taken_[a].pairs | taken_[b].pairs);
    if (open == 0) return late_color(a, a_moves, b, b_moves);
    const std::uint64_t bit = open & (~open + 1);
    taken_[a].pairs |= bit;
    taken_[b].pairs |= bit;
    return static_cast<std::uint32_t>(std::countr_zero(bit));
  }
  std::uint64_t& taken = taken_[a_moves ? a : b].singles;
  if (~taken == 0) return late_color(a, a_moves, b, b_moves);
  const std::uint64_t bit = ~taken & (taken + 1);
  taken |= bit;
  return half + static_cast<std::uint32_t>(std::countr_zero(bit));
}

std::uint32_t Coloring::late_color(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves) {
  if (taken_late_.size() < taken_.size()) taken_late_.resize(taken_.size());
  const auto taken_in = [&](std::size_t word) {
    return (a_moves ? word_of(taken_late_[a], word) : 0) | (b_moves ? word_of(taken_late_[b], word) : 0);
  };
  std::size_t word = 0;
  while (~taken_in(word) == 0) ++word;
  const auto place = static_cast<std::uint32_t>(std::countr_one(taken_in(word)));
  const auto take = [&](std::uint32_t body) {
    std::vector<std::uint64_t>& words = taken_late_[body];
    if (words.empty()) with_late_.push_back(body);
    if (words.size() <= word) words.resize(word + 1);
    words[word] |= std::uint64_t{1} << place;
  };
  if (a_moves) take(a);
  if (b_moves) take(b);
  const std::uint32_t color = late + bits * static_cast<std::uint32_t>(word) + place;
  end_ = std::max(end_, color + 1);
  return color;
}

}  // namespace tweenfall::blocks
