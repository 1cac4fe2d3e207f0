#pragma once

#include <atomic>
#include <mutex>

namespace tweenfall::state {

/// Something derived from data that changes: made on first use after a change, by whichever thread is
/// first. A copy starts without it.
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
  /// @param make  called with the previous value
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
