#pragma once

#include <tweenfall/physics/executor.h>

#include <algorithm>
#include <exception>
#include <mutex>

namespace tweenfall::threads {

/// Distributes work to an executor. Results must not depend on how it is divided.
class Workers {
 public:
  Workers() = default;
  explicit Workers(Executor* executor) : executor_(executor) {}

  [[nodiscard]] std::size_t threads() const { return executor_ ? executor_->threads() : 1; }

  /// Calls part(i) for each i below `count`. Rethrows what the part with the smallest number threw.
  template <class Part>
  void parts(std::size_t count, const Part& part) const {
    if (!executor_ || count <= 1) {
      for (std::size_t i = 0; i < count; ++i) part(i);
      return;
    }
    Faults faults;
    const auto guarded = [&](std::size_t i) noexcept {
      try {
        part(i);
      } catch (...) {
        faults.note(i, std::current_exception());
      }
    };
    executor_->for_each(count, Work(guarded));
    if (faults.first) std::rethrow_exception(faults.first);
  }

  /// How many ranges `ranges` makes.
  [[nodiscard]] std::size_t range_count(std::size_t count, std::size_t least) const {
    if (threads() == 1) return count > 0 ? 1 : 0;
    return std::min((count + least - 1) / least, ranges_per_thread * threads());
  }
  /// Calls range(number, begin, end) for ranges that follow each other from 0 to `count`.
  /// @param least  number of items that are worth a task of their own; > 0
  template <class Range>
  void numbered_ranges(std::size_t count, std::size_t least, const Range& range) const {
    const std::size_t ranges = range_count(count, least);
    parts(ranges, [&](std::size_t i) { range(i, count * i / ranges, count * (i + 1) / ranges); });
  }
  template <class Range>
  void ranges(std::size_t count, std::size_t least, const Range& range) const {
    numbered_ranges(count, least, [&](std::size_t, std::size_t begin, std::size_t end) { range(begin, end); });
  }

 private:
  static constexpr std::size_t ranges_per_thread = 4;

  struct Faults {
    std::mutex mutex;
    std::size_t part = 0;
    std::exception_ptr first;
    void note(std::size_t i, const std::exception_ptr& fault) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (first && part < i) return;
      part = i;
      first = fault;
    }
  };

  Executor* executor_ = nullptr;
};

}  // namespace tweenfall::threads
