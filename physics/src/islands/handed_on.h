#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Momentum that passed between the bodies of an island after its contacts and joints were solved: it is added to what
/// they tell, along as few of them as join the bodies, so that their impulses add up to how each body moved.
class HandedOn {
 public:
  /// @param bodies  number of those that exchanged something
  void begin(std::size_t bodies);
  /// @param change  of a body's momentum, N s
  void note(std::uint32_t body, const Vec3& change);
  /// @param slot_of  from a body's index to its number here; at least the number of bodies for any other
  void hand_on(const IslandContents& island, double dt, const std::function<std::uint32_t(std::uint32_t)>& slot_of);

 private:
  /// A body in the tree of those that join them.
  struct Knot {
    Vec3 change{0, 0, 0};     ///< N s
    std::uint32_t links = 0;  ///< that have not handed on yet
    std::uint32_t which = 0;  ///< their places in `tree_`, all combined by exclusive or: of a single one, its place
  };
  struct Link {
    std::uint32_t a = 0, b = 0;
    contacts::ContactConstraint* contact = nullptr;
    joints::JointLink* joint = nullptr;
  };
  void join(const Link& link);
  static void tell(const Link& link, const Vec3& on_b, double dt);

  std::vector<Knot> knots_;
  std::vector<Link> tree_;
  Islands joined_;
  bool any_ = false;
};

}  // namespace tweenfall::islands
