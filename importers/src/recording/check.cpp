#include "recording/check.h"

#include <tweenfall/importers/number_text.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tweenfall {

namespace {

[[noreturn]] void fail(const Recording& recording, const std::string& what) {
  throw std::invalid_argument("recording \"" + recording.name + "\": " + what);
}

void check_length(const Recording& recording, const NodeRecord& node, std::size_t length, const char* list) {
  if (length != recording.times.size())
    fail(recording, "node \"" + node.name + "\" has " + std::to_string(length) + " entries in " + list +
                        ", but there are " + std::to_string(recording.times.size()) + " times");
}

void check_node(const Recording& recording, std::size_t index) {
  const NodeRecord& node = recording.nodes[index];
  check_length(recording, node, node.world.size(), "world");
  check_length(recording, node, node.twist.size(), "twist");
  check_length(recording, node, node.owner.size(), "owner");
  if (!node.color.empty()) check_length(recording, node, node.color.size(), "color");
  if (!node.weights.empty()) check_length(recording, node, node.weights.size(), "weights");
  if (node.parent != no_node && node.parent >= index)
    fail(recording, "the parent of node \"" + node.name + "\" must come before it");
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    const WorldMotion& world = node.world[frame];
    const Twist& twist = node.twist[frame];
    if (!world.linear.allFinite() || !world.motion.pose.position.allFinite() ||
        !world.motion.pose.rotation.coeffs().allFinite() || !twist.linear.allFinite() || !twist.angular.allFinite())
      fail(recording, "node \"" + node.name + "\" is not at a finite place or speed at " +
                          number_text(recording.times[frame]) + " s (frame " + std::to_string(frame) +
                          "); the simulation has gone astray there");
  }
}

}  // namespace

void check_recording(const Recording& recording) {
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    if (!std::isfinite(recording.times[frame]))
      fail(recording, "the time of frame " + std::to_string(frame) + " is not finite");
    if (frame > 0 && recording.times[frame] <= recording.times[frame - 1])
      fail(recording, "times must increase; " + number_text(recording.times[frame]) + " s is not after " +
                          number_text(recording.times[frame - 1]) + " s");
  }
  for (std::size_t index = 0; index < recording.nodes.size(); ++index) check_node(recording, index);
  for (const HandOff& handoff : recording.handoffs)
    if (handoff.node >= recording.nodes.size())
      fail(recording, "a hand-off at " + number_text(handoff.time) + " s names node " + std::to_string(handoff.node) +
                          ", but there are " + std::to_string(recording.nodes.size()) + " nodes");
  for (const StageEvent& event : recording.events)
    for (const NodeId node : event.nodes)
      if (node >= recording.nodes.size())
        fail(recording, "event \"" + event.name + "\" at " + number_text(event.time) + " s names node " +
                            std::to_string(node) + ", but there are " + std::to_string(recording.nodes.size()) +
                            " nodes");
}

}  // namespace tweenfall
