#pragma once

/// Checks a stage before it runs: everything that does not hold together, and everything that starts out badly.

#include <tweenfall/physics/stage/description.h>

#include <string>
#include <vector>

namespace tweenfall {

/// A reason why a description makes no stage.
struct StageFault {
  enum class Part { world, step, clips, node, force, joint, soft, vehicle, particles, ignored, rule };
  Part part = Part::world;
  std::size_t index = 0;  ///< of the node, force, joint, soft body, vehicle, particles, ignored pair or rule
  std::string message;
};

/// Two bodies that overlap at time 0, at least one of which moves by itself.
struct StartOverlap {
  std::size_t a = 0, b = 0;  ///< nodes; a body that moves by itself comes first
  double depth = 0;          ///< m
};

/// A spring that swings, or is damped, too fast for the stage's step. It stays stable: the step damps its swing away.
struct StiffSpring {
  std::size_t force = 0;
  double longest_step = 0;  ///< the longest step that still shows the swing, s
};

/// A joint whose ends are not where it holds them at time 0: it pulls them there.
struct OpenJoint {
  std::size_t joint = 0;
  double gap = 0;   ///< m; 0 when it is only rounding
  double turn = 0;  ///< rad; likewise
};

/// A coordinate of a joint that starts beyond its limits: the joint brings it back.
struct PassedLimit {
  std::size_t joint = 0;
  int coordinate = 0;        ///< numbered as in `JointReading`
  double position = 0;       ///< rad or m
  double low = 0, high = 0;  ///< for a cone, its limits in the coordinate's direction
  bool length = false;       ///< whether the coordinate is a length, m, rather than an angle
};

/// Something so large, small, far or fast, or so strong for the step, that numbers or steps cannot follow it: its
/// motion may go astray.
struct Extreme {
  StageFault::Part part = StageFault::Part::node;
  std::size_t index = 0;  ///< of the node, force or soft body
  std::string message;    ///< what it is, and up to which value all goes well
};

struct StageInspection {
  std::vector<StageFault> faults;      ///< empty: `Stage` takes the description
  std::vector<StartOverlap> overlaps;  ///< deeper than a hundredth of the smaller body's size; the first 100
  std::vector<StiffSpring> stiff_springs;
  std::vector<OpenJoint> open_joints;  ///< by more than a thousandth of the smaller body's size, or of a radian
  std::vector<PassedLimit> passed_limits;
  std::vector<Extreme>
      extremes;  ///< of places, sizes, masses and speeds, of the rates of forces, and in a few trial steps
};

/// Checks a description against everything that `Stage` asks of it.
/// @param try_steps  whether a copy takes up to 256 trial steps, to find those `extremes` that only steps show
[[nodiscard]] StageInspection inspect(const StageDescription& description, bool try_steps = true);

}  // namespace tweenfall
