#pragma once

/// A world whose bodies lie in a plane: they are simulated by a world in two dimensions.

#include <tweenfall/physics/planar_world.h>
#include <tweenfall/physics/soft_body.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::state {
struct Body;
struct Joint;
struct WorldState;
}  // namespace tweenfall::state
namespace tweenfall::saving {
class ByteReader;
class ByteWriter;
}  // namespace tweenfall::saving

namespace tweenfall::flat {

// All of these pass if there is no plane, and otherwise throw std::invalid_argument naming what does not lie in it.
void validate(const WorldSettings& settings);
void require_body(WorldPlane plane, const BodySettings& body);
void require_motion(WorldPlane plane, const Motion& motion);
void refuse(WorldPlane plane, const char* what);
/// A point, or a displacement.
void require_point(WorldPlane plane, const Vec3& point, const char* what);
void require_soft(WorldPlane plane, const SoftSettings& soft);
/// The part of a vector in the plane, if there is one; else the vector.
[[nodiscard]] Vec3 in_plane(WorldPlane plane, const Vec3& v);
/// The same check for a joint, whose rotations must be of unit length.
void require_joint(WorldPlane plane, const tweenfall::JointSettings& joint);

/// The bodies of a world in its plane.
class Flat {
 public:
  void begin(const WorldSettings& settings);

  /// Passes on to the plane what has been done to the bodies since the last step.
  void take_over(const state::WorldState& world);
  // Forces of the world through the next step. A sleeping body keeps the pull with which it fell asleep.
  void begin_pushes(const state::WorldState& world);
  /// A force in N and a torque in N m; the plane bears the part that points out of it.
  /// @param index  of the body in the world @param arm  from its center of mass to where the force acts
  void push(std::uint32_t index, const Vec3& force, const Vec3& torque, const Vec3& arm);
  void exert(const state::WorldState& world);
  /// @throws NotFinite
  void step(double dt, double parts);
  [[nodiscard]] int sub_steps() const { return world_.sub_steps(); }  ///< of the last step
  /// Tells the bodies where they are now, and the world what touches.
  void hand_back(state::WorldState& world);
  /// Writes the forces of joints in the last step, and how far the joints have turned.
  void hand_back_joints(state::WorldState& world, double dt) const;
  void forget_joint(std::uint32_t index);  ///< by the world's index: it is copied again in the next step
  /// Keyed bodies have arrived: from here on they are where the world says.
  void settle(const state::WorldState& world);

  [[nodiscard]] std::uint64_t hash() const { return world_.state_hash(); }
  void write(saving::ByteWriter& bytes) const;
  void read(saving::ByteReader& bytes);
  void check(const state::WorldState& world);  ///< after reading. @throws std::invalid_argument

 private:
  struct Entry {
    BodyId id;                     ///< in the plane; none for an unused entry
    std::uint32_t generation = 0;  ///< in the world
    Drive drive;
    std::uint64_t groups = 0, collides_with = 0;
    Motion told;       ///< where the world had it when the plane last took it over
    Vec2 force{0, 0};  ///< the last force on it, N
    double torque = 0;
  };
  struct Link {
    JointId id;                    ///< in the plane; none for an unused entry
    std::uint32_t generation = 0;  ///< in the world
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  void take_over(const state::Body& body, std::uint32_t index, const Vec3& gravity);
  void take_over_ignored(const state::WorldState& world);
  void take_over_joints(const state::WorldState& world);
  [[nodiscard]] planar::JointSettings joint_in_plane(const state::WorldState& world, const state::Joint& joint) const;
  [[nodiscard]] std::uint32_t index_of(const BodyId& id) const { return owners_[id.index]; }
  void tell_contacts(state::WorldState& world) const;

  WorldPlane plane_{};
  planar::World world_;
  std::vector<Entry> entries_;         ///< by the world's index
  std::vector<std::uint32_t> owners_;  ///< by the plane's index
  std::vector<Pair> ignored_;          ///< by the world's indices
  std::vector<Link> links_;            ///< joints, by the world's index
};

}  // namespace tweenfall::flat
