#pragma once

#include <cstdint>
#include <vector>

namespace tweenfall::islands {

/// Bodies that touch each other, directly or through others.
class Islands {
 public:
  void reset(std::size_t count);
  void join(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t of(std::uint32_t body);  ///< the smallest index of its island
  /// The same, for several threads at once.
  [[nodiscard]] std::uint32_t root(std::uint32_t body) const {
    while (parent_[body] != body) body = parent_[body];
    return body;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace tweenfall::islands
