#pragma once

#include <span>
#include <vector>

#include "actors/soft/chain_factor.h"
#include "actors/soft/sub_step.h"

namespace tweenfall::soft {

/// The matrix of a chain together with the movable bodies that some of its nodes are pinned to: so the bodies feel what
/// the whole chain does. Blocks of their own would leave that to conjugate gradients, which stiff springs mislead.
class ChainAndHolders {
 public:
  static constexpr std::size_t most_holders = 8;

  /// The chain's own matrix, to be filled in as if nothing held it.
  [[nodiscard]] ChainFactor& chain() { return chain_; }

  /// @param blocks  diagonal blocks of nodes, and from index `nodes` on of partners, linear and angular in turn,
  ///                without the effect of the chain
  /// @return whether it is definite
  [[nodiscard]] bool factor(std::span<const Held> held, const std::vector<Mat3>& blocks, std::size_t nodes);
  /// Solves for the nodes and the holders; others are left as they are.
  void solve(std::vector<Vec3>& values) const;
  /// Whether `solve` also solves for this index.
  [[nodiscard]] bool solves(std::size_t number) const;

 private:
  struct Lever {
    Mat3 linear, angular;  ///< they turn the velocity of the holder into the node's
  };
  [[nodiscard]] std::size_t place_of(std::uint32_t partner) const;
  void add_to_border(std::size_t first, const Lever& of_first, const Mat3& block, std::size_t second,
                     const Lever& of_second, bool both);

  std::size_t nodes_ = 0;
  ChainFactor chain_, border_;
  std::vector<std::uint32_t> holders_;     ///< partners
  std::vector<std::vector<Vec3>> joined_;  ///< by direction of a holder: its effect on the nodes
  std::vector<std::vector<Vec3>> led_;     ///< and how they follow it
};

}  // namespace tweenfall::soft
