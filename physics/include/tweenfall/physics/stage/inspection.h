#pragma once

/// A stage judged before it runs: all that does not hold together, and what starts out badly.

#include <tweenfall/physics/stage/description.h>

#include <string>
#include <vector>

namespace tweenfall {

/// Something for which a description makes no stage.
struct StageFault {
  enum class Part { world, step, clips, node, force, rule };
  Part part = Part::world;
  std::size_t index = 0;  ///< of the node, force or rule
  std::string message;
};

/// Two bodies that lie in each other at time 0, one of which can move by itself.
struct StartOverlap {
  std::size_t a = 0, b = 0;  ///< nodes; of the pair a body that moves by itself comes first
  double depth = 0;          ///< m
};

/// A spring that swings, or is damped, too fast for the stage's step. It stays stable: the step damps its swing away.
struct StiffSpring {
  std::size_t force = 0;
  double longest_step = 0;  ///< that shows the swing, s
};

struct StageInspection {
  std::vector<StageFault> faults;      ///< none: `Stage` takes the description
  std::vector<StartOverlap> overlaps;  ///< deeper than a hundredth of the smaller body; the first 100
  std::vector<StiffSpring> stiff_springs;
};

/// Holds a description against everything that `Stage` asks of it.
[[nodiscard]] StageInspection inspect(const StageDescription& description);

}  // namespace tweenfall
