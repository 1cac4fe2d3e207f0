#pragma once

#include <span>
#include <vector>

#include "joints/joint_rows.h"

namespace tweenfall::joints {

/// All rows of an island's joints that hold, solved together: J M^-1 J^T by Cholesky's factors, block by block. Joints
/// are eliminated from the leaves of the tree that they make to its root, where nothing is filled in, so that a chain
/// or a figure takes time in proportion to its joints. What has so many loops that much is filled in is solved joint by
/// joint.
/// Sources: Baraff, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH 1996 (the order); George and Liu,
/// Computer Solution of Large Sparse Positive Definite Systems, 1981 (the factors' structure).
class JointSystem {
 public:
  /// One joint between two places; rows in a place that cannot move see no other joint.
  struct Member {
    std::uint32_t a = 0, b = 0;
    bool a_moves = false, b_moves = false;
    JointRows* rows = nullptr;
  };

  /// Finds order and structure. @param places  how many there are
  void plan(std::span<const Member> members, std::size_t places);
  /// Finds the factors for the rows as they are. Rows that say nothing new are left out: their impulse becomes 0.
  void factor(std::span<const Masses> masses);
  /// Whether all are solved at once.
  [[nodiscard]] bool whole() const { return whole_; }

  using Values = std::array<double, most_together>;
  /// From speeds to impulses of all members' rows, in place.
  void solve(std::vector<Values>& values) const;
  /// The same for one member as if it were alone.
  void solve_alone(std::size_t member, Values& values) const;

 private:
  struct Block {
    std::array<std::array<double, most_together>, most_together> at{};
  };
  void order(std::size_t places);
  void find_structure(std::size_t places);
  void fill(std::span<const Masses> masses);
  void factor_diagonal(std::size_t place);
  [[nodiscard]] std::size_t rows_at(std::size_t place) const { return members_[order_[place]].rows->together; }

  std::vector<Member> members_;
  bool whole_ = false;
  std::vector<std::uint32_t> order_, place_of_;    ///< members by elimination, and back
  std::vector<std::vector<std::uint32_t>> later_;  ///< by place in the order: those eliminated later that it acts on
  std::vector<std::size_t> first_;                 ///< by place: its first block
  std::vector<Block> diagonal_, below_;
  std::vector<std::vector<std::uint32_t>> at_body_;  ///< members by place of a body
  std::vector<std::uint32_t> depth_, queue_;
};

}  // namespace tweenfall::joints
