#include "stage/saving/stage_hash.h"

#include "saving/state_hash.h"
#include "stage/saving/stage_fields.h"

namespace tweenfall::staging {

std::uint64_t stage_hash(const StageState& state) {
  const std::uint64_t of_world = state.world.state_hash();
  if (state.vehicles.empty() && state.particles.empty()) return of_world;
  saving::StateHash hash;
  hash.number(of_world);
  for (const StagedVehicle& staged : state.vehicles) saving::walk(hash, staged);
  for (const StagedParticles& staged : state.particles) saving::walk(hash, staged);
  return hash.value();
}

}  // namespace tweenfall::staging
