#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planar/body.h"

namespace tweenfall::planar::inner {

/// How a step is divided.
struct Effort {
  int sub_steps = 1;
  /// Contacts end each sub-step with hard passes. In a heap, with many short sub-steps, only the last one needs them:
  /// the speed from removing overlap dies away from one to the next.
  bool relaxes_each = true;
};

/// How high bodies are piled up, and how short sub-steps have to be for it: contacts give way by the square of their
/// length, each under everything it carries.
class Depth {
 public:
  /// @param active  meetings with points
  [[nodiscard]] Effort effort_for(const std::vector<Body>& bodies, const std::vector<Meeting>& meetings,
                                  std::span<const std::uint32_t> active);

 private:
  /// Over how many contacts, one on top of the other, the highest body is carried; at most the number of bodies.
  [[nodiscard]] std::uint32_t deepest(const std::vector<Body>& bodies, const std::vector<Meeting>& meetings,
                                      std::span<const std::uint32_t> active);

  std::vector<std::uint32_t> levels_;  ///< by body
};

}  // namespace tweenfall::planar::inner
