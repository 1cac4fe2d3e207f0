#pragma once

/// Recordings as files: JSON, CSV, SVG, HTML and glTF, chosen by the file extension.

#include <tweenfall/physics/stage/recording.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tweenfall {

/// A recording that cannot be written; `what()` says why, after the recording's name.
class RecordingFault : public std::invalid_argument {
 public:
  RecordingFault(const Recording& recording, NodeId node, std::string reason);
  NodeId node;         ///< `no_node` where it is not about a single node
  std::string reason;  ///< with the node's name and the time
};

/// @throws RecordingFault when the recording is inconsistent: lists of different lengths, numbers that are not finite,
/// times that do not increase, nodes that do not exist.
void check_recording(const Recording& recording);

// All functions below throw as `check_recording` does.

/// Checks that a .glb file, whose numbers are 32-bit floats, can hold the recording.
/// @throws RecordingFault with the node, the time and the number that is beyond 3.4e+38.
void check_drawable(const Recording& recording, const StageDescription& stage);

/// One object: "times", "nodes" (position, rotation x y z w, velocity and angular velocity at the center of mass,
/// owner), "joints" if the stage has any (by name: "nodes", a single one where the other end is the world; for each
/// frame "force" and "torque" of the joint on the last of its nodes, N and N m, mean over the step before, world axes,
/// and the "position" and "rate" of each of its coordinates, rad or m; null once it is gone), "handoffs", "events" (for
/// the end of a joint with its "joint"), and "unfired": the rules that never fired, each with "rule" (its index in the
/// list of rules, from 0), "body" and "reason" (in words). Numbers have the fewest digits that read back to the same
/// bits; minus zero is -0.0.
[[nodiscard]] std::string recording_json(const Recording& recording);

/// One row for each time and node, sorted by time, under a header row. Columns: time (s), node, owner (keyed, driven,
/// free), position_x to _z (m, of the node's origin), rotation_x to _w, velocity_x to _z (m/s, at the center of mass),
/// angular_velocity_x to _z (rad/s); world axes. Quoting as RFC 4180. Then, for each time, rows whose owner is "soft"
/// (node "name:number", with only a position), "wheel" ("vehicle/wheel", with position and rotation) and "particle"
/// ("name:number", which it keeps for its life, with position and velocity); columns that do not apply are empty.
[[nodiscard]] std::string recording_csv(const Recording& recording);

/// The recording as animated SVG (SMIL, no script), seen from the side, or from above where what moves would be a
/// line: bodies as outlines in the color of their owner, skeletons as stick figures, trails, and a
/// time bar with the hand-offs. Keyframes are within 0.4 px of the recording; where that takes more than 280 kB, the
/// error is doubled until it fits, up to 25.6 px. A comment in the file states the error.
[[nodiscard]] std::string recording_svg(const Recording& recording, const StageDescription& stage);

/// One self-contained page: 3-D view, play, scrub, step back, timeline with key lanes, curves of the chosen node,
/// owners in color. Long recordings are thinned and say so; nodes beyond 1e30 m are left out and named. A program can
/// drive it through `window.tweenfall`; "#t=0.8&node=ball" opens it at that time.
/// @throws std::runtime_error when the library was built without three.js.
[[nodiscard]] std::string recording_html(const Recording& recording, const StageDescription& stage);

/// A recording and the stage that it was made from.
struct ShownRecording {
  const Recording& recording;
  const StageDescription& stage;
};

/// Both pages side by side in one, with a common clock and camera: to compare two strategies on a stage. The longer
/// recording controls the clock. A program drives it through `window.beside`, whose `pages` are the two pages'
/// `window.tweenfall`.
/// @throws std::runtime_error when the library was built without three.js.
[[nodiscard]] std::string side_by_side_html(const ShownRecording& left, const ShownRecording& right);

/// The words for an owner, and for the cause of a hand-off, in all files written.
[[nodiscard]] const char* owner_word(Owner owner) noexcept;
[[nodiscard]] const char* cause_word(Cause cause) noexcept;

/// The number of frames of the recording in its page: all of them, unless there are so many that it is thinned.
[[nodiscard]] std::size_t page_frame_count(const Recording& recording);

/// Most particles of a kind at any time that a .glb has as nodes; of more, it has every second, third, ... one.
inline constexpr std::size_t most_particles_in_glb = 500;

/// Writes the form given by the extension of `file`: .json, .csv, .svg, .html or .glb. A .glb has only the motion,
/// without physics: a viewer that simulated joints would work against their motion. Written whole or not at all.
/// @throws std::invalid_argument for another extension, std::runtime_error when it cannot be written.
void save_recording(const Recording& recording, const StageDescription& stage, const std::filesystem::path& file);

}  // namespace tweenfall
