#pragma once

/// A world whose bodies lie in a plane: they are carried by a world in two dimensions.

#include <tweenfall/physics/planar_world.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::state {
struct Body;
struct WorldState;
}  // namespace tweenfall::state
namespace tweenfall::saving {
class ByteReader;
class ByteWriter;
}  // namespace tweenfall::saving

namespace tweenfall::flat {

// All four pass where there is no plane, and else throw std::invalid_argument that tells what does not lie in it.
void validate(const WorldSettings& settings);
void require_body(WorldPlane plane, const BodySettings& body);
void require_motion(WorldPlane plane, const Motion& motion);
void refuse(WorldPlane plane, const char* what);

/// What the bodies of a world are in their plane.
class Flat {
 public:
  void begin(const WorldSettings& settings);

  /// Tells the plane what has been done to the bodies since the last step.
  void take_over(const state::WorldState& world);
  /// A force in N and a torque in N m through the next step; what points out of the plane is borne by it.
  /// @param index  of the body in the world @param at  where the force acts
  void push(std::uint32_t index, const Vec3& force, const Vec3& torque, const Vec3& at);
  /// @throws NotFinite
  void step(double dt);
  /// Tells the bodies where they are now, and the world what touches.
  void hand_back(state::WorldState& world);
  /// Keyed bodies have arrived: from here on they are where the world says.
  void settle(const state::WorldState& world);

  [[nodiscard]] std::uint64_t hash() const { return world_.state_hash(); }
  void write(saving::ByteWriter& bytes) const;
  void read(saving::ByteReader& bytes);
  void check(const state::WorldState& world);  ///< after reading. @throws std::invalid_argument

 private:
  struct Entry {
    BodyId id;                     ///< in the plane; none for a free place
    std::uint32_t generation = 0;  ///< in the world
    Drive drive;
    std::uint64_t groups = 0, collides_with = 0;
    Motion told;  ///< where the world had it when the plane last heard of it
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  void take_over(const state::Body& body, std::uint32_t index);
  void take_over_ignored(const state::WorldState& world);
  [[nodiscard]] std::uint32_t index_of(const BodyId& id) const { return owners_[id.index]; }
  void tell_contacts(state::WorldState& world) const;

  WorldPlane plane_{};
  planar::World world_;
  std::vector<Entry> entries_;         ///< by the world's index
  std::vector<std::uint32_t> owners_;  ///< by the plane's index
  std::vector<Pair> ignored_;          ///< by the world's indices
};

}  // namespace tweenfall::flat
