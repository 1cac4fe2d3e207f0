#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::joints {

/// In which order the joints of a figure are eliminated: from the leaves of the tree that they make to its root, where
/// nothing is filled in, so that a chain or a figure takes time in proportion to its joints.
/// Sources: Baraff, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH 1996 (the order); George and Liu,
/// Computer Solution of Large Sparse Positive Definite Systems, 1981 (the factors' structure).
class FigurePlan {
 public:
  /// One joint between two places; rows in a place that cannot move see no other joint.
  struct Member {
    std::uint32_t a = 0, b = 0;
    bool a_moves = false, b_moves = false;
    std::uint32_t joint = 0;  ///< which one it is, for those who ask
  };
  /// What plans need for a while. Sized for all places of an island; between plans all is as it was.
  struct Room {
    void fit(std::size_t places);
    std::vector<std::vector<std::uint32_t>> at_body;  ///< members by place of a body
    std::vector<std::vector<std::uint32_t>> later;    ///< as in the plan
    std::vector<std::uint32_t> depth, queue, place_of;
    std::vector<Member> given;
  };

  /// Finds order and structure.
  /// @return false if there are so many loops that joint by joint would be less work; it is no plan then
  [[nodiscard]] bool make(std::span<const Member> members, Room& room);

  /// The same plan for as many others that hang together in the same way.
  void change_members(std::span<const Member> members);

  /// In the order of elimination.
  [[nodiscard]] std::span<const Member> members() const { return members_; }
  /// Of each member into `later`, and their end.
  [[nodiscard]] std::span<const std::uint32_t> firsts() const { return first_; }
  /// Members eliminated later that each acts on, in order.
  [[nodiscard]] std::span<const std::uint32_t> later() const { return later_; }

 private:
  void order(Room& room);
  [[nodiscard]] bool find_structure(Room& room);

  std::vector<Member> members_;
  std::vector<std::uint32_t> place_of_;  ///< by number in what it was made for
  std::vector<std::uint32_t> first_, later_;
};

}  // namespace tweenfall::joints
