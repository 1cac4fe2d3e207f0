#pragma once

#include <memory>
#include <new>
#include <vector>

namespace tweenfall::blocks {

/// Leaves new elements as they were in memory, but for members with initializers of their own.
template <class Element>
struct NotClearing : std::allocator<Element> {
  template <class Other>
  struct rebind {
    using other = NotClearing<Other>;
  };

  using std::allocator<Element>::allocator;

  template <class Other>
  void construct(Other* place) const {
    ::new (static_cast<void*>(place)) Other;
  }
};

/// A list that grows without being cleared: whoever fills an element clears it, and several threads can share that.
template <class Element>
using Uncleared = std::vector<Element, NotClearing<Element>>;

}  // namespace tweenfall::blocks
