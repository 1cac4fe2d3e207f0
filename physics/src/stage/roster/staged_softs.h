#pragma once

// Soft bodies of a stage: their handles in the world, and the nodes that hold them.

#include <tweenfall/physics/soft_body.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

class WholePose;

/// A pin to a node without a body: the stage leads it.
struct LedPin {
  SoftId soft;
  std::uint32_t node = 0;  ///< of the soft body
  NodeId to = no_node;     ///< of the stage
  Vec3 point{0, 0, 0};     ///< on it
};
/// A pin that lets go.
struct EndingPin {
  std::string name;  ///< of its soft body
  SoftId soft;
  std::uint32_t node = 0;
  NodeId to = no_node;
  std::variant<std::monostate, when::At, when::Event> until;
};
struct StagedSofts {
  std::vector<std::pair<std::string, SoftId>> list;  ///< as they were described
  std::vector<std::size_t> nodes;                    ///< how many each has
  std::vector<LedPin> led;
  std::vector<EndingPin> ending;
};

/// Adds the description's soft bodies to the world. Impossible ones are faults.
void add_softs(StageState& state, const StageDescription& description, std::vector<StageFault>& faults);
/// Moves pins to nodes without bodies to where these are. @param pose  at the end of the step
void lead_pins(StageState& state, WholePose& pose);
/// The first moment in (from, to] at which a pin lets go; infinity if there is none.
[[nodiscard]] double next_pin_end(const StageState& state, double from, double to);
/// Removes pins whose end is due in (from, state.handled].
void end_pins(StageState& state, double from, std::vector<Happening>& happenings);
/// Reports what tore in the world's last step.
void report_tears(const StageState& state, std::vector<Happening>& happenings);
/// Between two consecutive states. @throws std::invalid_argument with the nearest name
[[nodiscard]] SoftNodes soft_nodes(const StageState& from, const StageState& to, std::string_view name, double time);

}  // namespace tweenfall::staging
