#include "model/model_matrix.h"

#include <tweenfall/importers/recording_file.h>

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tweenfall {

namespace recordings {
namespace {

[[noreturn]] void fail(const Recording& recording, std::string reason) {
  throw RecordingFault(recording, no_node, std::move(reason));
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
    if (!models::is_finite(world.linear) || !world.motion.pose.position.allFinite() ||
        !world.motion.pose.rotation.coeffs().allFinite() || !twist.linear.allFinite() || !twist.angular.allFinite())
      throw RecordingFault(recording, index,
                           "node \"" + node.name + "\" is not at a finite place or speed at " +
                               number_text(recording.times[frame]) + " s (frame " + std::to_string(frame) +
                               "); the simulation has diverged there");
    if (!node.weights.empty() && !std::all_of(node.weights[frame].begin(), node.weights[frame].end(),
                                              [](double weight) { return std::isfinite(weight); }))
      throw RecordingFault(recording, index,
                           "a morph weight of node \"" + node.name + "\" is not finite at " +
                               number_text(recording.times[frame]) + " s");
  }
}

struct IsFiniteValue {
  bool operator()(double number) const { return std::isfinite(number); }
  bool operator()(const Color& color) const { return color.rgba.allFinite(); }
  bool operator()(const Quat& rotation) const { return rotation.coeffs().allFinite(); }
  template <class Vector>
  bool operator()(const Eigen::MatrixBase<Vector>& vector) const {
    return vector.allFinite();
  }
  template <class T>
  bool operator()(const Sample<T>& sample) const {
    return (*this)(sample.value) && (*this)(sample.rate);
  }
  bool operator()(const std::vector<Sample<double>>& weights) const { return std::ranges::all_of(weights, *this); }
  bool operator()(bool) const { return true; }
  bool operator()(const std::string&) const { return true; }
};

void check_user_track(const Recording& recording, const UserTrackRecord& track) {
  const std::string named = "user track \"" + track.name + "\"";
  if (track.value.size() != recording.times.size())
    fail(recording, named + " has " + std::to_string(track.value.size()) + " values for " +
                        std::to_string(recording.times.size()) + " frames");
  for (std::size_t frame = 0; frame < track.value.size(); ++frame) {
    const char* fault = track.value[frame].index() != track.value[0].index() ? "is of another kind than before"
                        : !std::visit(IsFiniteValue{}, track.value[frame])   ? "has no finite value or rate"
                                                                             : nullptr;
    if (fault) fail(recording, named + " " + fault + " at " + number_text(recording.times[frame]) + " s");
  }
}

/// The largest number of a node at one frame in a file of floats, and its name.
std::pair<double, const char*> largest_number(const NodeRecord& node, std::size_t frame) {
  std::pair<double, const char*> largest(0, "");
  const auto take = [&](double size, const char* what) {
    if (size > largest.first) largest = {size, what};
  };
  take(node.world[frame].motion.pose.position.cwiseAbs().maxCoeff(), "m from the origin");
  take(node.world[frame].linear.cwiseAbs().maxCoeff(), "times its size");
  take(node.world[frame].motion.pose.scale.cwiseAbs().maxCoeff(), "times its size");
  take(node.twist[frame].linear.cwiseAbs().maxCoeff(), "m/s fast");
  take(node.twist[frame].angular.cwiseAbs().maxCoeff(), "radians per second fast");
  if (!node.weights.empty())
    for (const double weight : node.weights[frame]) take(std::abs(weight), "times morphed");
  return largest;
}

double largest_number(const Shape& shape) {
  struct Sizes {
    double operator()(const Sphere& sphere) const { return sphere.radius; }
    double operator()(const Box& box) const { return box.half_extents.maxCoeff(); }
    double operator()(const Capsule& capsule) const { return capsule.radius + capsule.half_height; }
    double operator()(const Cylinder& cylinder) const { return std::max(cylinder.radius, cylinder.half_height); }
    double operator()(const Cone& cone) const { return std::max(cone.radius, cone.half_height); }
    double operator()(const TaperedCapsule& capsule) const {
      return std::max(capsule.bottom_radius, capsule.top_radius) + capsule.half_height;
    }
    double operator()(const Compound& compound) const {
      double size = 0;
      for (const Shape& part : compound.parts()) size = std::max(size, largest_number(part));
      return size;
    }
    double operator()(const Plane& plane) const { return std::abs(plane.offset); }
    double operator()(const TriangleMesh& mesh) const {
      double size = 0;
      for (const Vec3& vertex : mesh.vertices()) size = std::max(size, vertex.cwiseAbs().maxCoeff());
      return size;
    }
    double operator()(const HeightField& field) const {
      double size = std::max(field.spacing_x() * static_cast<double>(field.columns()),
                             field.spacing_z() * static_cast<double>(field.rows()));
      for (const double height : field.heights()) size = std::max(size, std::abs(height));
      return size;
    }
    double operator()(const Hull& hull) const {
      double size = 0;
      for (const Vec3& vertex : hull.convex.vertices()) size = std::max(size, vertex.cwiseAbs().maxCoeff());
      return size;
    }
  };
  return std::max(std::visit(Sizes{}, shape.solid), shape.offset.position.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace recordings

RecordingFault::RecordingFault(const Recording& recording, NodeId node_at_fault, std::string why)
    : std::invalid_argument((recording.name.empty() ? "" : "recording \"" + recording.name + "\": ") + why),
      node(node_at_fault),
      reason(std::move(why)) {}

void check_recording(const Recording& recording) {
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    if (!std::isfinite(recording.times[frame]))
      recordings::fail(recording, "the time of frame " + std::to_string(frame) + " is not finite");
    if (frame > 0 && recording.times[frame] <= recording.times[frame - 1])
      recordings::fail(recording, "times must increase; " + number_text(recording.times[frame]) + " s is not after " +
                                      number_text(recording.times[frame - 1]) + " s");
  }
  for (std::size_t index = 0; index < recording.nodes.size(); ++index) recordings::check_node(recording, index);
  const auto is_finite = [](const Twist& twist) { return twist.linear.allFinite() && twist.angular.allFinite(); };
  for (const HandOff& handoff : recording.handoffs) {
    if (handoff.node >= recording.nodes.size())
      recordings::fail(recording, "a hand-off at " + number_text(handoff.time) + " s names node " +
                                      std::to_string(handoff.node) + ", but there are " +
                                      std::to_string(recording.nodes.size()) + " nodes");
    if (!std::isfinite(handoff.time) || !is_finite(handoff.before.twist) || !is_finite(handoff.after.twist))
      recordings::fail(recording, "the hand-off of \"" + recording.nodes[handoff.node].name + "\" at " +
                                      number_text(handoff.time) + " s has no finite speed");
  }
  for (const UserTrackRecord& track : recording.user_tracks) recordings::check_user_track(recording, track);
  for (const SoftRecord& soft : recording.softs) {
    if (soft.positions.size() != recording.times.size())
      recordings::fail(recording, "soft body \"" + soft.name + "\" has " + std::to_string(soft.positions.size()) +
                                      " lists of places for " + std::to_string(recording.times.size()) + " frames");
    for (std::size_t frame = 0; frame < soft.positions.size(); ++frame)
      for (const Vec3& place : soft.positions[frame])
        if (!place.allFinite())
          recordings::fail(recording, "soft body \"" + soft.name + "\" is not at a finite place at " +
                                          number_text(recording.times[frame]) + " s");
  }
  const auto require_frames = [&](const std::string& what, std::size_t frames) {
    if (frames != recording.times.size())
      recordings::fail(recording, what + " has " + std::to_string(frames) + " lists for " +
                                      std::to_string(recording.times.size()) + " frames");
  };
  if (!recording.energy.empty()) require_frames("the energy", recording.energy.size());
  if (!recording.complementarity.empty()) require_frames("the complementarity", recording.complementarity.size());
  for (const VehicleRecord& vehicle : recording.vehicles) {
    require_frames("vehicle \"" + vehicle.name + "\"", vehicle.frame.size());
    for (const std::vector<StageWheel>& wheels : vehicle.frame)
      if (wheels.size() != vehicle.wheels.size())
        recordings::fail(recording, "vehicle \"" + vehicle.name + "\" has more or fewer wheels in some frame");
  }
  for (const ParticlesRecord& particles : recording.particles) {
    require_frames("the particles \"" + particles.name + "\"", particles.frame.size());
    for (const StageParticles& there : particles.frame)
      if (there.numbers.size() != there.positions.size() || there.velocities.size() != there.positions.size())
        recordings::fail(recording, "the particles \"" + particles.name + "\" have lists of different lengths");
  }
  for (const JointRecord& joint : recording.joints) {
    for (const NodeId node : {joint.a, joint.b})
      if (node != no_node && node >= recording.nodes.size())
        recordings::fail(recording, "joint \"" + joint.name + "\" names node " + std::to_string(node) +
                                        ", but there are " + std::to_string(recording.nodes.size()) + " nodes");
    if (joint.reading.size() != recording.times.size())
      recordings::fail(recording, "joint \"" + joint.name + "\" has " + std::to_string(joint.reading.size()) +
                                      " readings for " + std::to_string(recording.times.size()) + " frames");
    for (std::size_t frame = 0; frame < joint.reading.size(); ++frame)
      if (const auto& reading = joint.reading[frame];
          reading && (!reading->force.allFinite() || !reading->torque.allFinite()))
        recordings::fail(recording, "joint \"" + joint.name + "\" has no finite load at " +
                                        number_text(recording.times[frame]) + " s");
  }
  for (const UnfiredRule& unfired : recording.unfired)
    if (unfired.node >= recording.nodes.size())
      recordings::fail(recording, "rule " + std::to_string(unfired.rule) + " waits for node " +
                                      std::to_string(unfired.node) + ", but there are " +
                                      std::to_string(recording.nodes.size()) + " nodes");
  for (const StageEvent& event : recording.events) {
    if (!std::isfinite(event.time) || !std::isfinite(event.impulse))
      recordings::fail(recording, "event \"" + event.name + "\" at " + number_text(event.time) +
                                      " s has an impulse of " + number_text(event.impulse) + " N s");
    for (const NodeId node : event.nodes)
      if (node >= recording.nodes.size())
        recordings::fail(recording, "event \"" + event.name + "\" at " + number_text(event.time) + " s names node " +
                                        std::to_string(node) + ", but there are " +
                                        std::to_string(recording.nodes.size()) + " nodes");
  }
}

void check_drawable(const Recording& recording, const StageDescription& stage) {
  check_recording(recording);
  constexpr double largest_float = std::numeric_limits<float>::max();
  constexpr const char* limit = ", beyond the 3.4e+38 that .glb files hold";
  for (NodeId index = 0; index < recording.nodes.size(); ++index)
    for (std::size_t frame = 0; frame < recording.times.size(); ++frame)
      if (const auto [size, what] = recordings::largest_number(recording.nodes[index], frame); size > largest_float)
        throw RecordingFault(recording, index,
                             "node \"" + recording.nodes[index].name + "\" is " + brief_text(size) + " " + what +
                                 " at " + number_text(recording.times[frame]) + " s" + limit);
  for (NodeId index = 0; index < stage.nodes.size(); ++index) {
    const NodeDescription& node = stage.nodes[index];
    if (node.body && recordings::largest_number(node.body->shape) > largest_float)
      throw RecordingFault(recording, index,
                           "the shape of node \"" + node.name + "\" is " +
                               brief_text(recordings::largest_number(node.body->shape)) + " m large" + limit);
  }
}

}  // namespace tweenfall
