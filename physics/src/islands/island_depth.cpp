#include "islands/island_depth.h"

#include <algorithm>
#include <atomic>

namespace tweenfall::islands {

namespace {

/// Number of contacts that are worth a task of their own.
constexpr std::size_t worth_a_part = 128;

}  // namespace

std::uint32_t IslandDepth::of(std::span<contacts::ContactConstraint* const> contacts,
                              const std::vector<state::Body>& bodies, const threads::Workers& workers) {
  // Contacts are sorted by their bodies, which were mostly added from bottom to top or the other way around.
  constexpr int most_passes = 12;
  constexpr std::uint32_t nobody = 0xfffffffe;  // one more is bottomless, and no more than that
  levels_.resize(bodies.size());
  ends_.resize(contacts.size());
  std::atomic<bool> sideways = false;
  workers.ranges(contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const state::Body &a = bodies[contacts[i]->a], &b = bodies[contacts[i]->b];
      const auto stands = [](const state::Body& body) { return body.immovable() || body.asleep; };
      ends_[i] = {contacts[i]->a, contacts[i]->b, stands(a), stands(b)};
      // Bodies may be pushed or dragged from the side, however near the floor is.
      if (a.displaces() || a.conveys || b.displaces() || b.conveys) sideways.store(true, std::memory_order_relaxed);
    }
  });
  if (sideways) return bottomless;
  for (const Ends& ends : ends_) {
    levels_[ends.a] = ends.a_stands ? 0 : nobody;
    levels_[ends.b] = ends.b_stands ? 0 : nobody;
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
