#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace tweenfall::state {

/// Pairs of bodies that pass through each other: because the caller asked for it, or because something that holds them
/// together requires it.
class IgnoredPairs {
 public:
  struct Entry {
    std::uint32_t a = 0, b = 0;  ///< a < b
    std::uint32_t holders = 0;
    bool asked = false;
  };

  IgnoredPairs() = default;
  explicit IgnoredPairs(std::vector<Entry> entries) : entries_(std::move(entries)) {}  ///< by pair

  [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const;
  /// What the caller asks for. @return whether this changes if the pair meets
  bool ask(std::uint32_t a, std::uint32_t b, bool ignore);
  /// One more thing holds them together. @return whether the pair met before
  bool hold(std::uint32_t a, std::uint32_t b);
  /// One thing less. @return whether the pair meets again
  bool let_go(std::uint32_t a, std::uint32_t b);
  void remove(std::uint32_t body);                                          ///< with all its pairs
  [[nodiscard]] const std::vector<Entry>& all() const { return entries_; }  ///< by pair

 private:
  [[nodiscard]] std::vector<Entry>::iterator place_of(std::uint32_t& a, std::uint32_t& b);
  [[nodiscard]] bool at(std::vector<Entry>::iterator place, std::uint32_t a, std::uint32_t b) const {
    return place != entries_.end() && place->a == a && place->b == b;
  }

  std::vector<Entry> entries_;
};

}  // namespace tweenfall::state
