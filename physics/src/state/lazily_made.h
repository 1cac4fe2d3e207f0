#pragma once

#include <atomic>
#include <mutex>

namespace tweenfall::state {

/// What follows from something that changes, made when it is first asked for after a change, by whichever thread is
/// first. A copy begins without one.
template <class T>
class LazilyMade {
 public:
  LazilyMade() = default;
  LazilyMade(const LazilyMade&) noexcept {}
  LazilyMade& operator=(const LazilyMade&) {
    forget();
    value_ = {};
    return *this;
  }
  ~LazilyMade() = default;

  void forget() noexcept { made_.store(false, std::memory_order_relaxed); }
  /// @param make  called with what there was before
  template <class Make>
  [[nodiscard]] const T& get(const Make& make) const {
    if (!made_.load(std::memory_order_acquire)) {
      const std::lock_guard lock(mutex_);
      if (!made_.load(std::memory_order_relaxed)) {
        make(value_);
        made_.store(true, std::memory_order_release);
      }
    }
    return value_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::atomic<bool> made_{false};
  mutable T value_;
};

}  // namespace tweenfall::state
