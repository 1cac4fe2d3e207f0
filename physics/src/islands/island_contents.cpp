#include "islands/island_contents.h"

#include <algorithm>

namespace tweenfall::islands {

/// Counting sort, since an island has the index of one of its bodies.
void IslandSorter::sort_by_island(std::size_t bodies, std::vector<Entry>& entries) {
  const auto by_island = [](const Entry& left, const Entry& right) { return left.island < right.island; };
  if (std::is_sorted(entries.begin(), entries.end(), by_island)) return;
  starts_.assign(bodies + 1, 0);
  for (const Entry& entry : entries) ++starts_[entry.island + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sorted_.resize(entries.size());
  for (const Entry& entry : entries) sorted_[starts_[entry.island]++] = entry;
  std::swap(entries, sorted_);
}

const std::vector<IslandContents>& IslandSorter::sort(const std::vector<state::Body>& bodies, const Islands& islands,
                                                      std::span<contacts::ContactConstraint* const> contacts,
                                                      std::vector<step::SpringRow>& springs,
                                                      std::vector<joints::JointLink>& links,
                                                      const threads::Workers& workers) {
  constexpr std::size_t worth_a_part = 256;
  static_assert(step::SpringRow::world == joints::JointLink::world);
  const auto island_of = [&](std::uint32_t a, std::uint32_t b) {
    const bool by_a = a != step::SpringRow::world && (b == step::SpringRow::world || !bodies[a].immovable());
    return islands.root(by_a ? a : b);
  };
  const auto sorted = [&](const auto& list, std::vector<Entry>& entries, auto& pointers, const auto& island_of_item) {
    entries.resize(list.size());
    workers.ranges(list.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        entries[i] = {island_of_item(list[i]->a, list[i]->b), static_cast<std::uint32_t>(i)};
    });
    sort_by_island(bodies.size(), entries);
    pointers.clear();
    for (const Entry& entry : entries) pointers.push_back(list[entry.number]);
  };
  const auto list_of = [](auto& list, auto& pointers) -> const auto& {
    pointers.clear();
    for (auto& item : list) pointers.push_back(&item);
    return pointers;
  };
  sorted(contacts, contact_entries_, contacts_, island_of);
  sorted(list_of(springs, listed_springs_), spring_entries_, springs_, island_of);
  sorted(list_of(links, listed_links_), link_entries_, links_, island_of);

  islands_.clear();
  std::size_t contact = 0;
  std::size_t spring = 0;
  std::size_t link = 0;
  while (contact < contacts_.size() || spring < springs_.size() || link < links_.size()) {
    const auto next_of = [](const std::vector<Entry>& entries, std::size_t next) {
      return next < entries.size() ? entries[next].island : 0xffffffffu;
    };
    const std::uint32_t island =
        std::min({next_of(contact_entries_, contact), next_of(spring_entries_, spring), next_of(link_entries_, link)});
    const auto taken = [island](const std::vector<Entry>& entries, std::size_t& next, const auto& pointers) {
      const std::size_t first = next;
      while (next < entries.size() && entries[next].island == island) ++next;
      return std::span(pointers.data() + first, next - first);
    };
    IslandContents contents;
    contents.contacts = taken(contact_entries_, contact, contacts_);
    contents.springs = taken(spring_entries_, spring, springs_);
    contents.joints = taken(link_entries_, link, links_);
    islands_.push_back(contents);
  }
  return islands_;
}

}  // namespace tweenfall::islands
