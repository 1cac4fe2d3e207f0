#include "islands/island_contents.h"

#include <algorithm>

namespace tweenfall::islands {

const std::vector<IslandContents>& IslandSorter::sort(const std::vector<state::Body>& bodies, Islands& islands,
                                                      std::vector<step::ContactConstraint>& contacts,
                                                      std::vector<step::SpringRow>& springs) {
  const auto island_of = [&](std::uint32_t a, std::uint32_t b) {
    return islands.of(b == step::SpringRow::world || !bodies[a].immovable() ? a : b);
  };
  const auto sorted = [&](auto& list, std::vector<Entry>& entries, auto& pointers) {
    entries.clear();
    for (const auto& item : list)
      entries.push_back({island_of(item.a, item.b), static_cast<std::uint32_t>(entries.size())});
    std::sort(entries.begin(), entries.end(), [](const Entry& left, const Entry& right) {
      return left.island != right.island ? left.island < right.island : left.number < right.number;
    });
    pointers.clear();
    for (const Entry& entry : entries) pointers.push_back(&list[entry.number]);
  };
  sorted(contacts, contact_entries_, contacts_);
  sorted(springs, spring_entries_, springs_);

  islands_.clear();
  std::size_t contact = 0;
  std::size_t spring = 0;
  while (contact < contacts_.size() || spring < springs_.size()) {
    const std::uint32_t none = 0xffffffffu;
    const std::uint32_t island = std::min(contact < contacts_.size() ? contact_entries_[contact].island : none,
                                          spring < springs_.size() ? spring_entries_[spring].island : none);
    const auto taken = [island](const std::vector<Entry>& entries, std::size_t& next, const auto& pointers) {
      const std::size_t first = next;
      while (next < entries.size() && entries[next].island == island) ++next;
      return std::span(pointers.data() + first, next - first);
    };
    IslandContents contents;
    contents.contacts = taken(contact_entries_, contact, contacts_);
    contents.springs = taken(spring_entries_, spring, springs_);
    islands_.push_back(contents);
  }
  return islands_;
}

}  // namespace tweenfall::islands
