#include "islands/island_depth.h"

#include <algorithm>

namespace tweenfall::islands {

std::uint32_t IslandDepth::of(std::span<contacts::ContactConstraint* const> contacts,
                              const std::vector<state::Body>& bodies) {
  // Contacts are sorted by their bodies, which mostly were added from the bottom to the top or the other way around.
  constexpr int most_passes = 12;
  constexpr std::uint32_t nobody = 0xfffffffe;  // one more is bottomless, and no more than that
  levels_.resize(bodies.size());
  ends_.clear();
  ends_.reserve(contacts.size());
  for (const contacts::ContactConstraint* contact : contacts) {
    ends_.push_back({contact->a, contact->b});
    for (const std::uint32_t end : {contact->a, contact->b}) {
      const state::Body& body = bodies[end];
      // What is pushed or taken along is so from the side, however near the floor is.
      if (body.displaces() || body.conveys) return bottomless;
      levels_[end] = body.immovable() || body.asleep ? 0 : nobody;
    }
  }
  const auto lower = [](std::uint32_t& level, std::uint32_t other) {
    if (level <= other + 1) return false;
    level = other + 1;
    return true;
  };
  bool changed = true;
  for (int pass = 0; pass < most_passes && changed; ++pass) {
    changed = false;
    for (std::size_t n = 0; n < ends_.size(); ++n) {
      const Ends& ends = ends_[pass % 2 == 0 ? n : ends_.size() - 1 - n];
      std::uint32_t &a = levels_[ends.a], &b = levels_[ends.b];
      const bool lowered_a = lower(a, b), lowered_b = lower(b, a);
      changed = changed || lowered_a || lowered_b;
    }
  }
  if (changed) return bottomless;
  std::uint32_t deepest = 0;
  for (const Ends& ends : ends_)
    for (const std::uint32_t end : {ends.a, ends.b}) deepest = std::max(deepest, levels_[end]);
  return deepest == nobody ? 0 : deepest;
}

}  // namespace tweenfall::islands
