#pragma once

#include <array>
#include <memory>

#include "state/body.h"

namespace tweenfall::state {

/// Lets bodies share what they are made of with such as were made alike a short while before.
class Makeups {
 public:
  [[nodiscard]] std::shared_ptr<const Makeup> share(const Makeup& makeup);

 private:
  std::array<std::shared_ptr<const Makeup>, 32> last_;  ///< in turns
  std::size_t next_ = 0;
};

/// Whether all of two makeups is the same to the bit, and hulls, meshes and the like are the same objects.
[[nodiscard]] bool alike(const Makeup& a, const Makeup& b);

}  // namespace tweenfall::state
