#pragma once

// Particles of a stage: released along the paths of nodes, and stepped with the world.

#include <memory>
#include <string_view>
#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Adds the description's particles. Impossible ones are faults.
void add_particles(StageState& state, const StageDescription& description, std::vector<StageFault>& faults);

/// A step of the world, with which particles are stepped: constructed before it.
class ParticleStep {
 public:
  explicit ParticleStep(const StageState& state);
  /// Call it when the world is at the step's end, and so is the stage's time.
  void take(StageState& state) const;

 private:
  struct Place {
    Vec3 point, velocity;
    Quat rotation;
  };
  [[nodiscard]] static Place place_of(const StageState& state, const EmitterDescription& emitter, double time);

  double from_;
  std::vector<std::vector<Place>> starts_;  ///< of the emitters of each kind of particles
};

/// Between two consecutive states. @throws std::invalid_argument with the nearest name
[[nodiscard]] StageParticles stage_particles(const StageState& from, const StageState& to, std::string_view name,
                                             double time);

}  // namespace tweenfall::staging
