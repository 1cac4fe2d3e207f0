#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contacts/contact_constraint.h"
#include "state/body.h"
#include "threads/workers.h"

namespace tweenfall::islands {

/// Over how many contacts, one on top of the other, the highest body of an island is carried; 0 if nothing carries it.
class IslandDepth {
 public:
  /// Something pushes the island, or finding out is not worth while: as deep as any.
  static constexpr std::uint32_t bottomless = 0xffffffff;

  [[nodiscard]] std::uint32_t of(std::span<contacts::ContactConstraint* const> contacts,
                                 const std::vector<state::Body>& bodies, const threads::Workers& workers);

 private:
  struct Ends {
    std::uint32_t a, b;
    bool a_stands, b_stands;
  };
  std::vector<Ends> ends_;             ///< of the contacts
  std::vector<std::uint32_t> levels_;  ///< by body; only of bodies that the contacts touch
};

}  // namespace tweenfall::islands
