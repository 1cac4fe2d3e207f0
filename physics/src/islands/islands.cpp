#include "islands/islands.h"

namespace tweenfall::islands {

void Islands::reset(std::size_t count) {
  parent_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
}

std::uint32_t Islands::of(std::uint32_t body) {
  while (parent_[body] != body) {
    parent_[body] = parent_[parent_[body]];
    body = parent_[body];
  }
  return body;
}

void Islands::join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t root_a = of(a);
  const std::uint32_t root_b = of(b);
  // The smaller index stays the root: the result does not depend on the order of joining.
  if (root_a < root_b)
    parent_[root_b] = root_a;
  else
    parent_[root_a] = root_b;
}

}  // namespace tweenfall::islands
