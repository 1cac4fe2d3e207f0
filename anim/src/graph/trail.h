#pragma once

// Where a long computation over time has been, so that it need not start again from the beginning.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace tweenfall::graphs {

/// The course since one start: the latest places, and marks at growing distances, so that going back finds one nearby
/// in bounded memory.
template <class Place, std::size_t most_markers>
class Trail {
 public:
  struct Mark {
    double time = -1;  // below 0: nothing is marked
    Place place{};
  };

  double start = -1;
  std::size_t asked = 0;  // when it was used last: the least recently used one is replaced

  /// The last mark before a time, or also at it if `with`; null for none.
  [[nodiscard]] const Mark* last_mark(double time, bool with = true) const noexcept {
    const auto is_before = [&](const Mark& mark) { return mark.time < time || (with && mark.time == time); };
    const Mark* found = nullptr;
    const auto end = markers_.begin() + static_cast<std::ptrdiff_t>(marked_);
    if (const auto next = std::partition_point(markers_.begin(), end, is_before); next != markers_.begin())
      found = &*std::prev(next);
    const auto consider = [&](const Mark& mark) {
      if (mark.time >= 0 && is_before(mark) && (!found || mark.time > found->time)) found = &mark;
    };
    std::ranges::for_each(latest_.list, consider);
    std::ranges::for_each(passed_.list, consider);
    return found;
  }

  /// The computation passes this place.
  void pass(double time, const Place& place) noexcept {
    passed_.add({time, place});
    mark(time, place);
  }
  /// The computation stopped here for a request just ahead.
  void stay(double time, const Place& place) noexcept { latest_.add({time, place}); }

  void forget_after(double time) noexcept {
    latest_.forget_after(time);
    passed_.forget_after(time);
    while (marked_ > 0 && markers_[marked_ - 1].time > time) --marked_;
  }

 private:
  void mark(double time, const Place& place) noexcept {
    if (marked_ > 0 && time < markers_[marked_ - 1].time + gap_) return;
    if (marked_ == most_markers) {
      // Every other mark is dropped, and the distance between marks doubles.
      for (std::size_t i = 0; 2 * i + 1 < most_markers; ++i) markers_[i] = markers_[2 * i + 1];
      marked_ /= 2;
      gap_ *= 2;
      if (time < markers_[marked_ - 1].time + gap_) return;
    }
    markers_[marked_++] = {time, place};
  }

  /// The last marks that were added.
  template <std::size_t count>
  struct Ring {
    std::array<Mark, count> list{};
    std::size_t oldest = 0;

    void add(const Mark& mark) noexcept {
      list[oldest] = mark;
      oldest = (oldest + 1) % count;
    }
    void forget_after(double time) noexcept {
      for (Mark& mark : list)
        if (mark.time > time) mark.time = -1;
    }
  };
  Ring<4> latest_{};
  Ring<12> passed_{};
  std::array<Mark, most_markers> markers_{};
  std::size_t marked_ = 0;
  double gap_ = 1.0 / 16;
};

/// The trails since the starts used most recently.
template <class Place, std::size_t most_markers>
class Trails {
 public:
  [[nodiscard]] Trail<Place, most_markers>& since(double start) noexcept {
    ++asked_;
    auto found = std::ranges::find(trails_, start, &Trail<Place, most_markers>::start);
    if (found == trails_.end()) {
      found = std::ranges::min_element(trails_, {}, &Trail<Place, most_markers>::asked);
      *found = {};
      found->start = start;
    }
    found->asked = asked_;
    return *found;
  }
  void forget_after(double time) noexcept {
    for (Trail<Place, most_markers>& trail : trails_) trail.forget_after(time);
  }

 private:
  std::array<Trail<Place, most_markers>, 8> trails_{};
  std::size_t asked_ = 0;
};

}  // namespace tweenfall::graphs
