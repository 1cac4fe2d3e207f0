#pragma once

#include <atomic>
#include <mutex>

#include "queries/scene.h"

namespace tweenfall::queries {

/// The scene of something that changes, made when it is first asked for after a change, by whichever thread is first.
/// A copy begins without one.
class LazyScene {
 public:
  LazyScene() = default;
  LazyScene(const LazyScene&) noexcept {}
  LazyScene& operator=(const LazyScene&) {
    forget();
    scene_ = {};
    return *this;
  }
  ~LazyScene() = default;

  void forget() noexcept { arranged_.store(false, std::memory_order_relaxed); }
  template <class Arrange>
  [[nodiscard]] const Scene& get(const Arrange& arrange) const {
    if (!arranged_.load(std::memory_order_acquire)) {
      const std::lock_guard lock(mutex_);
      if (!arranged_.load(std::memory_order_relaxed)) {
        arrange(scene_);
        arranged_.store(true, std::memory_order_release);
      }
    }
    return scene_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::atomic<bool> arranged_{false};
  mutable Scene scene_;
};

}  // namespace tweenfall::queries
