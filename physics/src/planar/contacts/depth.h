#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planar/body.h"

namespace tweenfall::planar::inner {

/// How a step is divided.
struct Effort {
  int sub_steps = 1;
  /// Contacts end each sub-step firmly. In a heap of many short ones it is enough that the last one does: what pushes
  /// overlap apart has died away from one to the next.
  bool relaxes_each = true;
};

/// How much is piled up, and how short sub-steps have to be for it: contacts give way by the square of their length,
/// each under all that it carries.
class Depth {
 public:
  /// @param active  meetings with points
  [[nodiscard]] Effort effort_for(const std::vector<Body>& bodies, const std::vector<Meeting>& meetings,
                                  std::span<const std::uint32_t> active);

 private:
  /// Over how many contacts, one upon the other, what lies highest is carried; no more than there are bodies.
  [[nodiscard]] std::uint32_t deepest(const std::vector<Body>& bodies, const std::vector<Meeting>& meetings,
                                      std::span<const std::uint32_t> active);

  std::vector<std::uint32_t> levels_;  ///< by body; only of what the meetings touch
};

}  // namespace tweenfall::planar::inner
