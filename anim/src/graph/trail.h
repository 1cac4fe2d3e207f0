#pragma once

// Where something that goes on and on has been, so that not all its way is gone again.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace tweenfall::graphs {

/// The way since one start: where it was of late, and marks ever further apart, so that whoever goes back finds one
/// near, and none takes more room.
template <class Place, std::size_t most_markers>
class Trail {
 public:
  struct Mark {
    double time = -1;  // below 0: nothing is marked
    Place place{};
  };

  double start = -1;
  std::size_t asked = 0;  // when it was asked for last: the one that was longest ago makes room

  /// The last one up to a time, at it too where `with` says so; null for none.
  [[nodiscard]] const Mark* last_mark(double time, bool with = true) const noexcept {
    const auto is_before = [&](const Mark& mark) { return mark.time < time || (with && mark.time == time); };
    const Mark* found = nullptr;
    const auto end = markers_.begin() + static_cast<std::ptrdiff_t>(marked_);
    if (const auto next = std::partition_point(markers_.begin(), end, is_before); next != markers_.begin())
      found = &*std::prev(next);
    for (const Mark& mark : latest_)
      if (mark.time >= 0 && is_before(mark) && (!found || mark.time > found->time)) found = &mark;
    return found;
  }

  /// It comes by here.
  void pass(double time, const Place& place) noexcept {
    if (marked_ > 0 && time < markers_[marked_ - 1].time + gap_) return;
    if (marked_ == most_markers) {
      // Every other one goes, and they are twice as far apart from here on.
      for (std::size_t i = 0; 2 * i + 1 < most_markers; ++i) markers_[i] = markers_[2 * i + 1];
      marked_ /= 2;
      gap_ *= 2;
      if (time < markers_[marked_ - 1].time + gap_) return;
    }
    markers_[marked_++] = {time, place};
  }
  /// Somebody asked for what is just ahead of here.
  void stay(double time, const Place& place) noexcept {
    pass(time, place);
    latest_[oldest_] = {time, place};
    oldest_ = (oldest_ + 1) % latest_.size();
  }

  void forget_after(double time) noexcept {
    for (Mark& mark : latest_)
      if (mark.time > time) mark.time = -1;
    while (marked_ > 0 && markers_[marked_ - 1].time > time) --marked_;
  }

 private:
  std::array<Mark, 4> latest_{};
  std::size_t oldest_ = 0;
  std::array<Mark, most_markers> markers_{};
  std::size_t marked_ = 0;
  double gap_ = 1.0 / 16;
};

/// Those since the starts that were asked for last.
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
