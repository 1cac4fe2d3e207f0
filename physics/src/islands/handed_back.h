#pragma once

#include <cstdint>
#include <vector>

#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Momentum taken from bodies of an island after its contacts were solved, which goes back through the contacts that
/// press to what leads or stands: what is told of the contacts, and the reactions, then add up to how the bodies moved.
class HandedBack {
 public:
  HandedBack(const IslandContents& island, const std::vector<state::Body>& bodies);

  /// @param change  of the body's momentum, N s
  void note(std::uint32_t body, const Vec3& change);
  /// Adds what was noted to the impulses of the contacts.
  void hand_back();

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  /// A body that something leads or bears, by way of a contact.
  struct Borne {
    std::uint32_t body = 0;
    contacts::ContactConstraint* contact = nullptr;
    std::size_t bearer = nowhere;  ///< its place in the list; of what does not move, nowhere
    Vec3 change{0, 0, 0};          ///< N s
  };
  std::vector<Borne> borne_;         ///< each after the one that bears it
  std::vector<std::size_t> places_;  ///< by body: in borne_
};

}  // namespace tweenfall::islands
