#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "blocks/contact_block.h"
#include "blocks/island_body.h"

namespace tweenfall::blocks {

/// Which contacts a rebound reaches: those of the bodies that it stirs. Contacts are lanes here: 4 * block + lane.
class ReboundReach {
 public:
  /// The blocks have others in them.
  void forget() { starts_.clear(); }
  /// Nothing is stirred yet.
  void begin(const std::vector<ContactBlock>& blocks, const std::vector<IslandBody>& bodies);
  /// From now on the contacts of a movable body are reached.
  void stir(std::uint32_t place);
  [[nodiscard]] bool stirred(std::uint32_t place) const { return stirred_[place] != 0; }

  /// Calls `visit(lane)` for what is reached, in order; also for what comes to be reached further on meanwhile.
  template <class Visit>
  void visit(const Visit& visit) {
    for (std::size_t word = 0; word < reached_.size(); ++word) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while (const std::uint64_t open = reached_[word] & ahead) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(open));
        ahead = bit == 63 ? 0 : ~std::uint64_t{0} << (bit + 1);
        visit(static_cast<std::uint32_t>(64 * word) + bit);
      }
    }
  }

 private:
  std::vector<std::uint32_t> starts_, lanes_;  ///< by place: the contacts of each movable body
  std::vector<char> stirred_;                  ///< by place
  std::vector<std::uint64_t> reached_;         ///< bits of lanes
};

}  // namespace tweenfall::blocks
