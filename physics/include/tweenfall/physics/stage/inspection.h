#pragma once

/// A stage judged before it runs: all that does not hold together, and what starts out badly.

#include <tweenfall/physics/stage/description.h>

#include <string>
#include <vector>

namespace tweenfall {

/// Something for which a description makes no stage.
struct StageFault {
  enum class Part { world, step, clips, node, force, joint, soft, vehicle, particles, ignored, rule };
  Part part = Part::world;
  std::size_t index = 0;  ///< of the node, force, joint, soft body, vehicle, particles, ignored pair or rule
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

/// A joint whose ends do not stand at time 0 as it holds them: it brings them there.
struct OpenJoint {
  std::size_t joint = 0;
  double gap = 0;   ///< m; 0 for no more than rounding
  double turn = 0;  ///< rad; the same
};

/// A coordinate of a joint that begins beyond its limits: it is brought back.
struct PassedLimit {
  std::size_t joint = 0;
  int coordinate = 0;        ///< as `JointReading` counts them
  double position = 0;       ///< rad or m
  double low = 0, high = 0;  ///< of a cone, as far as it reaches in the coordinate's direction
  bool length = false;       ///< whether it is a length, m, and no angle
};

/// Something so large, small, far or fast, or so strong for the step, that numbers or steps cannot follow it: it may
/// run astray.
struct Extreme {
  StageFault::Part part = StageFault::Part::node;
  std::size_t index = 0;  ///< of the node, force or soft body
  std::string message;    ///< what it is, and up to where it goes well
};

struct StageInspection {
  std::vector<StageFault> faults;      ///< none: `Stage` takes the description
  std::vector<StartOverlap> overlaps;  ///< deeper than a hundredth of the smaller body; the first 100
  std::vector<StiffSpring> stiff_springs;
  std::vector<OpenJoint> open_joints;  ///< by more than a thousandth of the smaller body, or of a radian
  std::vector<PassedLimit> passed_limits;
  std::vector<Extreme>
      extremes;  ///< by places, sizes, masses and speeds, by rates of forces, and by a few steps on trial
};

/// Holds a description against everything that `Stage` asks of it.
/// @param try_steps  whether a copy takes its first steps, up to 256, for what nothing else tells of `extremes`
[[nodiscard]] StageInspection inspect(const StageDescription& description, bool try_steps = true);

}  // namespace tweenfall
