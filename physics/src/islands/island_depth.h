#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "state/body.h"
#include "step/contact_constraint.h"

namespace tweenfall::islands {

/// Over how many contacts, one upon the other, what lies highest on an island is carried.
class IslandDepth {
 public:
  /// Nothing carries some of it, something pushes it, or it is not worth finding out: as deep as any.
  static constexpr std::uint32_t bottomless = 0xffffffff;

  /// @param places  from a body's index to a number of its own, which is less than `count`
  [[nodiscard]] std::uint32_t of(std::span<step::ContactConstraint* const> contacts,
                                 const std::vector<state::Body>& bodies, const std::vector<std::uint32_t>& places,
                                 std::size_t count);

 private:
  std::vector<std::uint32_t> levels_;  ///< by place
};

}  // namespace tweenfall::islands
