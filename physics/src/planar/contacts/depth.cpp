#include "planar/contacts/depth.h"

#include <algorithm>

namespace tweenfall::planar::inner {

namespace {

/// With few contacts there is time to keep a high stack standing; a heap of many sinks as in space.
constexpr int fewest = 4, most_of_few = 24, most_of_many = 10;
constexpr std::size_t few = 128;
/// At this depth the number of sub-steps reaches its limit.
constexpr std::uint32_t deep_of_few = 20, deep_of_many = 50;

}  // namespace

std::uint32_t Depth::deepest(const std::vector<Body>& bodies, const std::vector<Meeting>& meetings,
                             std::span<const std::uint32_t> active) {
  // Meetings are sorted by their bodies, which were mostly added from bottom to top or the other way around.
  constexpr int most_passes = 12;
  constexpr std::uint32_t nobody = 0xfffffffe;
  levels_.resize(bodies.size());
  bool leads = false;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    leads = leads || (!body.movable && body.under_way);
    levels_[i] = !body.movable || body.asleep ? 0 : nobody;
  }
  // A body pushed from the side may be carried by the whole row, however near the floor is.
  const bool pushed = leads && std::any_of(active.begin(), active.end(), [&](std::uint32_t k) {
                        const auto is_led = [](const Body& body) { return !body.movable && body.under_way; };
                        return is_led(bodies[meetings[k].a]) || is_led(bodies[meetings[k].b]);
                      });
  bool changed = !pushed;
  const auto lower = [&](std::uint32_t level, std::uint32_t other) {
    if (levels_[level] <= levels_[other] + 1) return;
    levels_[level] = levels_[other] + 1;
    changed = true;
  };
  for (int pass = 0; pass < most_passes && changed; ++pass) {
    changed = false;
    for (std::size_t n = 0; n < active.size(); ++n) {
      const Meeting& meeting = meetings[active[pass % 2 == 0 ? n : active.size() - 1 - n]];
      lower(meeting.a, meeting.b);
      lower(meeting.b, meeting.a);
    }
  }
  std::uint32_t deepest = 0;
  if (changed || pushed) {
    // Each is counted once per contact: that is no less than their number.
    for (const std::uint32_t k : active)
      deepest += (levels_[meetings[k].a] != 0 ? 1 : 0) + (levels_[meetings[k].b] != 0 ? 1 : 0);
    return deepest;
  }
  for (const std::uint32_t level : levels_)
    if (level != nobody) deepest = std::max(deepest, level);
  return deepest;
}

Effort Depth::effort_for(const std::vector<Body>& bodies, const std::vector<Meeting>& meetings,
                         std::span<const std::uint32_t> active) {
  const bool many = active.size() > few;
  const std::uint32_t deep = many ? deep_of_many : deep_of_few;
  const auto more = static_cast<std::uint32_t>((many ? most_of_many : most_of_few) - fewest);
  const std::uint32_t depth = std::min(deepest(bodies, meetings, active), deep);
  // One contact over another is not piled up.
  if (depth < 2) return {fewest, true};
  return {fewest + static_cast<int>((depth * more + deep - 1) / deep), !many};
}

}  // namespace tweenfall::planar::inner
