#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::joints {

/// The order in which the joints of a figure are eliminated: from the leaves of their tree to its root. In this order
/// no fill-in arises, so that a chain or a figure takes time in proportion to its joints. Sources: Baraff, Linear-Time
/// Dynamics using Lagrange Multipliers, SIGGRAPH 1996 (the order); George and Liu, Computer Solution of Large Sparse
/// Positive Definite Systems, 1981 (the factors' structure).
class FigurePlan {
 public:
  /// One joint between two places; rows do not see each other through an immovable body.
  struct Member {
    std::uint32_t a = 0, b = 0;
    bool a_moves = false, b_moves = false;
    std::uint32_t joint = 0;  ///< its index for the caller
  };
  /// Working memory of plans. Sized for all places of an island; between plans everything is reset.
  struct Room {
    void fit(std::size_t places);
    std::vector<std::vector<std::uint32_t>> at_body;  ///< members by place of a body
    std::vector<std::vector<std::uint32_t>> later;    ///< as in the plan
    std::vector<std::uint32_t> depth, queue, place_of;
    std::vector<Member> given;
  };

  /// Finds order and structure.
  /// @return false if there are so many loops that solving joint by joint would be less work; there is no plan then
  [[nodiscard]] bool make(std::span<const Member> members, Room& room);

  /// Uses the plan for as many other joints, connected in the same way.
  void change_members(std::span<const Member> members);

  /// In the order of elimination.
  [[nodiscard]] std::span<const Member> members() const { return members_; }
  /// Index of each member's first entry in `later`, and the end.
  [[nodiscard]] std::span<const std::uint32_t> firsts() const { return first_; }
  /// For each member, the members that it affects and that are eliminated later, in order.
  [[nodiscard]] std::span<const std::uint32_t> later() const { return later_; }

 private:
  void order(Room& room);
  [[nodiscard]] bool find_structure(Room& room);

  std::vector<Member> members_;
  std::vector<std::uint32_t> place_of_;  ///< by index in the members it was made for
  std::vector<std::uint32_t> first_, later_;
};

}  // namespace tweenfall::joints
