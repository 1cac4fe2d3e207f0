#pragma once

#include <tweenfall/physics/world.h>

#include <vector>

#include "actors/soft/soft_state.h"
#include "flat/flat.h"
#include "forces/forces.h"
#include "state/body.h"
#include "state/boxed.h"
#include "state/contact_memories.h"
#include "state/ignored_pairs.h"
#include "state/joint.h"

namespace tweenfall::state {

/// Everything that carries over from step to step, as plain values: it is copied, hashed, saved and loaded. Its
/// fields are listed in `saving/fields.h`.
struct WorldState {
  WorldSettings settings;
  std::vector<Body> bodies;
  std::vector<std::uint32_t> unused;  ///< indices of removed bodies
  std::vector<forces::NumberedForce> forces;
  std::uint64_t next_force = 0;
  double time = 0;
  bool failed = false;        ///< the last step left a body that is not finite
  ContactMemories memories;   ///< of the last step
  std::vector<Stand> stands;  ///< by body, of the last step in which it was awake
  IgnoredPairs ignored;
  std::vector<Joint> joints;
  std::vector<std::uint32_t> unused_joints;  ///< indices of removed joints
  std::vector<JointId> broken;               ///< in the last step
  std::vector<Contact> planar_contacts;  ///< what the caller sees of a planar world; else it is taken from `memories`
  std::vector<EndedContact> ended;       ///< in the last step
  std::vector<EndedContact> gone_contacts;  ///< with bodies that were removed since then
  std::vector<std::uint32_t> sensors;       ///< indices of bodies, sorted
  std::vector<SensorOverlap> overlaps;      ///< by sensor, then by body
  std::vector<SensorOverlap> left_sensors;  ///< in the last step
  std::size_t other_detections = 0;         ///< number of bodies that ask for another collision than the default
  std::vector<soft::SoftBody> softs;
  std::vector<std::uint32_t> unused_softs;  ///< indices of removed soft bodies
  Boxed<flat::Flat> flat;                   ///< only of a planar world
};

}  // namespace tweenfall::state
