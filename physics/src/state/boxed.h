#pragma once

#include <memory>

#include "state/prefetch.h"

namespace tweenfall::state {

/// A value that most owners lack, allocated separately; copied like any other value.
template <class T>
class Boxed {
 public:
  Boxed() = default;
  Boxed(const Boxed& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Boxed(Boxed&&) noexcept = default;
  Boxed& operator=(const Boxed& other) {
    if (this == &other) return *this;
    if (value_ && other.value_)
      *value_ = *other.value_;
    else
      *this = Boxed(other);
    return *this;
  }
  Boxed& operator=(Boxed&&) noexcept = default;
  ~Boxed() = default;

  [[nodiscard]] bool has_value() const { return value_ != nullptr; }
  /// The value, or a default one if there is none.
  [[nodiscard]] const T& value() const {
    static const T none{};
    return value_ ? *value_ : none;
  }
  /// The value, created if there is none.
  [[nodiscard]] T& own() {
    if (!value_) value_ = std::make_unique<T>();
    return *value_;
  }
  void reset() { value_.reset(); }
  /// Prefetches it.
  void fetch() const {
    if (value_) state::fetch(value_.get());
  }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace tweenfall::state
