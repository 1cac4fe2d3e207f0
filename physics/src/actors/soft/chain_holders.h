#pragma once

#include <span>
#include <vector>

#include "actors/soft/chain_factor.h"
#include "actors/soft/sub_step.h"

namespace tweenfall::soft {

/// The matrix of a chain together with the bodies that some of its nodes are pinned to and move: those hear of what the
/// whole chain does, where blocks of their own would leave it to conjugate gradients, which stiff springs mislead.
class ChainAndHolders {
 public:
  static constexpr std::size_t most_holders = 8;

  /// The chain's own matrix, to be filled in as if nothing held it.
  [[nodiscard]] ChainFactor& chain() { return chain_; }

  /// @param blocks  diagonal blocks of nodes, and from number `nodes` on of partners, linear and angular in turn,
  ///                without what the chain does
  /// @return whether it is definite
  [[nodiscard]] bool factor(std::span<const Held> held, const std::vector<Mat3>& blocks, std::size_t nodes);
  /// Solves for the nodes and the holders; others are left as they are.
  void solve(std::vector<Vec3>& values) const;
  /// Whether `solve` solves for this number, too.
  [[nodiscard]] bool solves(std::size_t number) const;

 private:
  struct Lever {
    Mat3 linear, angular;  ///< by which the velocity of what holds becomes the node's
  };
  [[nodiscard]] std::size_t place_of(std::uint32_t partner) const;
  void add_to_border(std::size_t first, const Lever& of_first, const Mat3& block, std::size_t second,
                     const Lever& of_second, bool both);

  std::size_t nodes_ = 0;
  ChainFactor chain_, border_;
  std::vector<std::uint32_t> holders_;     ///< partners
  std::vector<std::vector<Vec3>> joined_;  ///< by direction of a holder: what it does to the nodes
  std::vector<std::vector<Vec3>> led_;     ///< and how they follow it
};

}  // namespace tweenfall::soft
