#pragma once

#include <cstdint>
#include <vector>

namespace tweenfall::state {

constexpr std::uint32_t nowhere = 0xffffffff;

/// Values in places that are reused.
template <class T>
class Pool {
 public:
  [[nodiscard]] const T& operator[](std::uint32_t place) const { return all_[place]; }
  [[nodiscard]] T& operator[](std::uint32_t place) { return all_[place]; }
  /// Null for `nowhere`.
  [[nodiscard]] const T* find(std::uint32_t place) const { return place == nowhere ? nullptr : &all_[place]; }
  [[nodiscard]] T* find(std::uint32_t place) { return place == nowhere ? nullptr : &all_[place]; }
  /// The value there; if the place is `nowhere`, a new value, and `place` is set.
  T& own(std::uint32_t& place) {
    if (place != nowhere) return all_[place];
    if (unused_.empty()) {
      place = static_cast<std::uint32_t>(all_.size());
      return all_.emplace_back();
    }
    place = unused_.back();
    unused_.pop_back();
    return all_[place] = {};
  }
  void free(std::uint32_t& place) {
    if (place != nowhere) unused_.push_back(place);
    place = nowhere;
  }

 private:
  std::vector<T> all_;
  std::vector<std::uint32_t> unused_;
};

}  // namespace tweenfall::state
