#pragma once

#include <array>
#include <memory>

#include "state/body.h"

namespace tweenfall::state {

/// Lets a body share its makeup with equal bodies that were added shortly before.
class Makeups {
 public:
  [[nodiscard]] std::shared_ptr<const Makeup> share(const Makeup& makeup);

 private:
  std::array<std::shared_ptr<const Makeup>, 32> last_;  ///< used in turn
  std::size_t next_ = 0;
};

/// Whether two makeups are the same to the bit, with the same objects for hulls, meshes and the like.
[[nodiscard]] bool alike(const Makeup& a, const Makeup& b);

}  // namespace tweenfall::state
