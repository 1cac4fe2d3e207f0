#pragma once

/// Recordings as files: JSON, CSV, SVG, HTML and glTF, chosen by the name's ending.

#include <tweenfall/physics/stage/recording.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tweenfall {

/// A recording that cannot be written; `what()` says why, after the recording's name.
class RecordingFault : public std::invalid_argument {
 public:
  RecordingFault(const Recording& recording, NodeId node, std::string reason);
  NodeId node;         ///< `no_node` where it is about no single one
  std::string reason;  ///< with the node's name and the time
};

/// @throws RecordingFault when the recording does not hold together: lists of different lengths, numbers that are not
/// finite, times that do not increase, nodes that are not there.
void check_recording(const Recording& recording);

// All that follow throw as `check_recording` does.

/// Whether .glb files can hold the recording, whose numbers are 32-bit floats.
/// @throws RecordingFault with the node, the time and the number that is beyond 3.4e+38.
void check_drawable(const Recording& recording, const StageDescription& stage);

/// One object: "times", "nodes" (position, rotation x y z w, velocity and angular velocity at the center of mass,
/// owner), "joints" of a stage that has some (by name: "nodes", one where the other end is the world; frame by frame
/// "force" and "torque" of the joint on the last of them, N and N m, mean of the step before, world axes, and the
/// "position" and "rate" of each of its coordinates, rad or m; null once it is gone), "handoffs", "events" (of the end
/// of a joint with its "joint"), and "unfired": the rules that waited in vain, each with "rule" (its place in the list
/// of rules, from 0), "body" and "reason" (in words). Numbers have the fewest digits that read back to the same bits;
/// minus zero is -0.0.
[[nodiscard]] std::string recording_json(const Recording& recording);

/// One row for each time and node, times outermost, under a header row. Columns: time (s), node, owner (keyed, driven,
/// free), position_x to _z (m, of the node's origin), rotation_x to _w, velocity_x to _z (m/s, at the center of mass),
/// angular_velocity_x to _z (rad/s); world axes. Quoting as RFC 4180. Then, time by time, rows whose owner is "soft"
/// (node "name:number", with a position alone), "wheel" ("vehicle/wheel", with position and rotation) and "particle"
/// ("name:number", by which it is known for its life, with position and velocity); what they have not is empty.
[[nodiscard]] std::string recording_csv(const Recording& recording);

/// A moving picture of the recording as animated SVG (SMIL, no script), seen from the side: bodies as outlines in the
/// color of their owner, skeletons as stick figures, trails, and a time bar with the hand-offs. Keyframes are within
/// 0.4 px of the recording; where that makes more than 280 kB, the error is doubled until it fits, 25.6 px at most. A
/// comment in the file states the error.
[[nodiscard]] std::string recording_svg(const Recording& recording, const StageDescription& stage);

/// One self-contained page: 3-D view, play, scrub, step back, timeline with key lanes, curves of the chosen node,
/// owners in color. Long recordings are thinned and say so; nodes beyond 1e30 m are left out and named. A program can
/// drive it through `window.tweenfall`; "#t=0.8&node=ball" opens it at that time.
/// @throws std::runtime_error when the library was built without three.js.
[[nodiscard]] std::string recording_html(const Recording& recording, const StageDescription& stage);

/// A recording and the stage that it was made of.
struct ShownRecording {
  const Recording& recording;
  const StageDescription& stage;
};

/// Both pages side by side in one, with one clock and one way of looking: to compare what two strategies make of a
/// stage. The one that lasts longer has the clock. A program drives it through `window.beside`, whose `pages` are the
/// two as `window.tweenfall` is of one.
/// @throws std::runtime_error when the library was built without three.js.
[[nodiscard]] std::string side_by_side_html(const ShownRecording& left, const ShownRecording& right);

/// What stands for an owner, and for what made a body change hands, in every file that is written.
[[nodiscard]] const char* owner_word(Owner owner) noexcept;
[[nodiscard]] const char* cause_word(Cause cause) noexcept;

/// How many of the recording's frames its page carries: all of them, unless they are so many that it thins them.
[[nodiscard]] std::size_t page_frame_count(const Recording& recording);

/// Of each kind of particles so many at a time are in a .glb, as nodes; of more, every second, third, ... one.
inline constexpr std::size_t most_particles_in_glb = 500;

/// By the ending of `file`: .json, .csv, .svg, .html or .glb. A .glb has the motion alone, and nothing of physics: a
/// viewer that simulated joints would work against the motion that they made. Written whole or not at all.
/// @throws std::invalid_argument for another ending, std::runtime_error when it cannot be written.
void save_recording(const Recording& recording, const StageDescription& stage, const std::filesystem::path& file);

}  // namespace tweenfall
