#pragma once

#include <memory>

#include "state/prefetch.h"

namespace tweenfall::state {

/// A value that most have not, in a place of its own; copied like any other value.
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
  /// That of those who have none, too.
  [[nodiscard]] const T& value() const {
    static const T none{};
    return value_ ? *value_ : none;
  }
  /// From now on there is one.
  [[nodiscard]] T& own() {
    if (!value_) value_ = std::make_unique<T>();
    return *value_;
  }
  void reset() { value_.reset(); }
  /// It will be asked for soon.
  void fetch() const {
    if (value_) state::fetch(value_.get());
  }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace tweenfall::state
