#pragma once

#include <span>
#include <vector>

#include "joints/joint_rows.h"

namespace tweenfall::joints {

/// All rows that are in, of joints that hang together, solved at once: J M^-1 J^T by Cholesky's factors, block by
/// block. Joints are eliminated from the leaves of the tree that they make to its root, where nothing is filled in, so
/// that a chain or a figure takes time in proportion to its joints.
/// Sources: Baraff, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH 1996 (the order); George and Liu,
/// Computer Solution of Large Sparse Positive Definite Systems, 1981 (the factors' structure).
class JointSystem {
 public:
  /// One joint between two places; rows in a place that cannot move see no other joint.
  struct Member {
    std::uint32_t a = 0, b = 0;
    bool a_moves = false, b_moves = false;
    std::uint32_t joint = 0;  ///< which one it is, for those who ask
    JointRows* rows = nullptr;
  };
  /// What plans need for a while. Sized for all places of an island; between plans all is as it was.
  struct Plans {
    explicit Plans(std::size_t places = 0) { fit(places); }
    void fit(std::size_t places);
    std::vector<std::vector<std::uint32_t>> at_body;  ///< members by place of a body
    std::vector<std::vector<std::uint32_t>> later;    ///< as in the system
    std::vector<std::uint32_t> depth, queue, place_of;
  };

  /// Finds order and structure.
  /// @return false if there are so many loops that joint by joint would be less work; it is no system then
  [[nodiscard]] bool plan(std::span<const Member> members, Plans& plans);
  /// Finds the factors for the rows that are in.
  void factor();

  [[nodiscard]] std::size_t size() const { return members_.size(); }
  [[nodiscard]] const Member& member(std::size_t place) const { return members_[place]; }
  /// Which of a member's rows are in.
  [[nodiscard]] std::span<const std::uint8_t> slots(std::size_t place) const {
    return {slots_[place].data(), counts_[place]};
  }
  /// One for each of them: speeds before `solve`, and impulses after it. Those of rows that say nothing new are 0.
  [[nodiscard]] double* values(std::size_t place) { return values_.data() + first_value_[place]; }
  /// Speed that the row alone gains by a unit of impulse.
  [[nodiscard]] const double* inverses(std::size_t place) const { return inverses_.data() + first_value_[place]; }
  /// Whether what is in adds something to those before it.
  [[nodiscard]] bool says_something(std::size_t place, std::size_t row) const {
    return diagonal(place)[row * counts_[place] + row] > 0;
  }
  void solve();

 private:
  void order(Plans& plans);
  [[nodiscard]] bool find_structure(Plans& plans);
  void lay_out();
  void fill(std::size_t place);
  void factor_diagonal(std::size_t place);
  void eliminate(std::size_t place);
  [[nodiscard]] std::span<const std::uint32_t> later(std::size_t place) const {
    return {later_.data() + first_[place], first_[place + 1] - first_[place]};
  }
  [[nodiscard]] double* diagonal(std::size_t place) { return blocks_.data() + diagonal_[place]; }
  [[nodiscard]] const double* diagonal(std::size_t place) const { return blocks_.data() + diagonal_[place]; }

  // By place in the order of elimination
  std::vector<Member> members_;
  std::vector<std::uint32_t> first_;  ///< into later_
  std::vector<std::uint32_t> later_;  ///< places eliminated later that each acts on, in order

  // For the rows that are in
  std::vector<std::uint8_t> counts_;
  std::vector<std::array<std::uint8_t, most_rows>> slots_;
  std::vector<std::uint32_t> first_value_, diagonal_, below_;  ///< below_: beside later_
  std::vector<double> blocks_, values_, inverses_;             ///< blocks row by row
};

}  // namespace tweenfall::joints
