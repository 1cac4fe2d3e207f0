#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/stage/recording.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stage/record/graph_record.h"
#include "stage/record/jump_record.h"
#include "stage/record/user_track_record.h"

namespace tweenfall {

namespace staging {
namespace {

void take_frame(const Stage& stage, std::vector<WorldMotion>& world, Recording& recording) {
  const auto nodes = stage.nodes();
  const std::size_t frame = recording.times.size();
  recording.times.push_back(stage.time());
  // Nodes that were added later are shown at rest where they were added, back to the first frame.
  world.resize(nodes.size());
  stage.world(world);
  for (std::size_t i = recording.nodes.size(); i < nodes.size(); ++i)
    recording.nodes.push_back({.name = nodes[i].name,
                               .parent = nodes[i].parent,
                               .world = std::vector<WorldMotion>(frame, world[i]),
                               .twist = std::vector<Twist>(frame),
                               .owner = std::vector<Owner>(frame, Owner::keyed),
                               .color = {},
                               .weights = {}});
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    NodeRecord& record = recording.nodes[i];
    const bool here = stage.contains(i);
    record.world.push_back(here ? world[i] : record.world.back());
    record.twist.push_back(!here ? Twist{} : stage.has_body(i) ? stage.twist(i) : world[i].motion.twist);
    record.owner.push_back(here ? stage.owner(i) : record.owner.back());
    if (!here) continue;
    const NodeLook look = stage.look(i);
    if (look.color) {
      record.color.resize(frame, look.color->value);
      record.color.push_back(look.color->value);
    }
    if (!look.weights.empty()) {
      std::vector<double> weights;
      for (const Sample<double>& weight : look.weights) weights.push_back(weight.value);
      record.weights.resize(frame, weights);
      record.weights.push_back(std::move(weights));
    }
  }
}

/// Joints added later, and those that hold other bodies under the name of one that is gone, have records of their own.
void take_joints(const Stage& stage, Recording& recording) {
  const std::vector<JointEnds> joints = stage.joints();
  const std::size_t frame = recording.times.size() - 1;
  for (const JointEnds& joint : joints) {
    const auto is_it = [&joint](const JointRecord& record) {
      return record.name == joint.name && record.a == joint.a && record.b == joint.b;
    };
    // They keep their order, so that it is nearly always the next.
    const auto place = static_cast<std::size_t>(&joint - joints.data());
    auto record = recording.joints.begin() + static_cast<std::ptrdiff_t>(std::min(place, recording.joints.size()));
    if (record == recording.joints.end() || !is_it(*record)) record = std::ranges::find_if(recording.joints, is_it);
    if (record == recording.joints.end()) {
      recording.joints.push_back({.name = joint.name, .a = joint.a, .b = joint.b, .reading = {}});
      record = recording.joints.end() - 1;
    }
    record->reading.resize(frame);
    record->reading.push_back(stage.joint(joint.name));
  }
  for (JointRecord& record : recording.joints) record.reading.resize(frame + 1);
}

void take_softs(const Stage& stage, Recording& recording) {
  constexpr auto never = static_cast<std::size_t>(-1);
  const std::size_t frame = recording.times.size() - 1;
  for (std::size_t i = 0; i < stage.description().softs.size(); ++i) {
    const std::string& name = stage.description().softs[i].name;
    SoftNodes nodes = stage.soft(name);
    if (i == recording.softs.size()) {
      SoftRecord& record = recording.softs.emplace_back();
      record.name = name;
      record.torn_at.assign(nodes.torn.size(), never);
    }
    SoftRecord& record = recording.softs[i];
    for (std::size_t edge = 0; edge < nodes.torn.size(); ++edge)
      if (nodes.torn[edge] != 0) record.torn_at[edge] = std::min(record.torn_at[edge], frame);
    record.positions.push_back(std::move(nodes.positions));
  }
}

void take_vehicles(const Stage& stage, Recording& recording) {
  for (std::size_t i = 0; i < stage.description().vehicles.size(); ++i) {
    const VehicleDescription& described = stage.description().vehicles[i];
    if (i == recording.vehicles.size()) {
      VehicleRecord& record = recording.vehicles.emplace_back();
      record.name = described.name;
      record.chassis = described.chassis;
      for (const WheelDescription& wheel : described.wheels) record.wheels.push_back(wheel.name);
    }
    recording.vehicles[i].frame.push_back(stage.vehicle(described.name));
  }
}

/// Their number is known only as they come.
void take_particles(const Stage& stage, Recording& recording, double& room) {
  for (std::size_t i = 0; i < stage.description().particles.size(); ++i) {
    const ParticlesDescription& described = stage.description().particles[i];
    if (i == recording.particles.size())
      recording.particles.push_back({.name = described.name, .radius = described.settings.radius, .frame = {}});
    const StageParticles& taken = recording.particles[i].frame.emplace_back(stage.particles(described.name));
    room -= static_cast<double>(taken.numbers.size() * (2 * sizeof(Vec3) + sizeof(std::uint64_t)));
    if (room < 0)
      throw std::invalid_argument(
          "by " + number_text(stage.time()) + " s a recording of the particles \"" + described.name +
          "\" takes more memory than is allowed: end it earlier, take fewer frames per second, or "
          "release fewer particles");
  }
}

/// @return whether there was room
bool take_details(const Stage& stage, Recording& recording, double& room) {
  const StageDetail& taken = recording.details.emplace_back(detail_of(stage));
  room -= static_cast<double>(taken.nodes.size() * sizeof(NodeDetail) + taken.contacts.size() * sizeof(ContactDetail));
  if (room >= 0) return true;
  recording.details = {};
  return false;
}

/// @return what is left for tracks and particles, whose size is known only as they come, bytes
double require_affordable(const Stage& stage, double until, double fps, double most_bytes) {
  constexpr double most_steps = 2e7;
  const double length = std::max(0.0, until - stage.time()), frames = length * fps + 1, steps = length / stage.step();
  constexpr double node_bytes = sizeof(WorldMotion) + sizeof(Twist) + sizeof(Owner);
  constexpr double joint_bytes = sizeof(std::optional<JointReading>);
  double soft_bytes = 0;
  for (const SoftDescription& soft : stage.description().softs)
    soft_bytes += static_cast<double>(soft.soft.positions.size() * sizeof(Vec3));
  const double bytes = frames * (static_cast<double>(stage.nodes().size()) * node_bytes +
                                 static_cast<double>(stage.description().joints.size()) * joint_bytes + soft_bytes);
  const auto whole = [](double value) { return std::to_string(std::llround(std::min(value, 1e18))); };
  if (steps > most_steps)
    throw std::invalid_argument("a recording of " + whole(length) + " s takes " + whole(steps) +
                                " steps; 20 million are allowed: end it earlier, or take longer steps");
  if (bytes > most_bytes)
    throw std::invalid_argument("a recording of " + whole(frames) + " frames of " +
                                std::to_string(stage.nodes().size()) + " nodes takes " + whole(bytes / (1024 * 1024)) +
                                " MiB; " + whole(most_bytes / (1024 * 1024)) +
                                " are allowed: end it earlier, or take fewer frames per second");
  return most_bytes - bytes;
}

void require_tellable(const Stage& stage) {
  constexpr std::size_t most_events = 1'000'000;
  if (stage.events().size() > most_events)
    throw std::invalid_argument("a recording of " + std::to_string(stage.events().size()) + " events by " +
                                number_text(stage.time()) +
                                " s; a million are allowed: end it earlier, or loop clips with events less often");
}

}  // namespace
}  // namespace staging

Recording record(Stage& stage, double until, double fps, double most_bytes, bool details) {
  return record(stage, until, fps, most_bytes, details, {});
}

std::span<const TimedInput> advance_with(Stage& stage, std::span<const TimedInput> inputs, double until) {
  std::size_t given = 0;
  for (; given < inputs.size() && inputs[given].time <= until; ++given) {
    if (!(inputs[given].time >= stage.time()))
      throw std::invalid_argument("an input at " + number_text(inputs[given].time) + " s is before the stage's time, " +
                                  number_text(stage.time()) + " s");
    stage.give(inputs[given]);
  }
  stage.advance_to(until);
  return inputs.subspan(given);
}

Recording record(Stage& stage, double until, double fps, double most_bytes, bool details,
                 std::span<const TimedInput> inputs) {
  if (!(fps > 0) || !std::isfinite(fps))
    throw std::invalid_argument("frames per second must be above 0, not " + number_text(fps));
  if (!std::isfinite(until)) throw std::invalid_argument("a recording needs an end");
  double room = staging::require_affordable(stage, until, fps, most_bytes);
  Recording recording;
  recording.name = stage.description().name;
  staging::UserTrackRecorder user_tracks(stage);
  std::vector<WorldMotion> world;
  const double start = stage.time();
  double detail_room = std::min(most_bytes, 256.0 * 1024 * 1024);
  const auto take = [&] {
    staging::take_frame(stage, world, recording);
    user_tracks.take(stage, room);
    staging::take_joints(stage, recording);
    staging::take_softs(stage, recording);
    recording.energy.push_back(stage.energy());
    if (const std::optional<double> off = stage.complementarity()) recording.complementarity.push_back(*off);
    staging::take_vehicles(stage, recording);
    staging::take_particles(stage, recording, room);
    if (details) details = staging::take_details(stage, recording, detail_room);
  };
  staging::JumpRecorder jumps;
  inputs = advance_with(stage, inputs, stage.time());
  take();
  for (double frame = 1;; ++frame) {
    double time = start + frame / fps;
    // A last frame closer than this to the end is the end.
    const bool last = time >= until - 1e-9;
    if (last) time = std::max(until, stage.time());
    if (last && time <= stage.time()) break;
    const double before = stage.time();
    const std::span<const TimedInput> to_come = advance_with(stage, inputs, time);
    staging::require_tellable(stage);
    take();
    jumps.take(stage, before, inputs.first(inputs.size() - to_come.size()), recording);
    inputs = to_come;
    if (last) break;
  }
  for (NodeRecord& node : recording.nodes) {
    if (!node.color.empty()) node.color.resize(recording.times.size(), node.color.back());
    if (!node.weights.empty()) node.weights.resize(recording.times.size(), node.weights.back());
  }
  recording.user_tracks = std::move(user_tracks).records();
  recording.graphs = staging::graph_records(stage, recording.times);
  for (SoftRecord& soft : recording.softs)
    for (std::size_t& edge : soft.torn_at) edge = std::min(edge, recording.times.size());
  recording.handoffs.assign(stage.handoffs().begin(), stage.handoffs().end());
  recording.events.assign(stage.events().begin(), stage.events().end());
  std::ranges::stable_sort(recording.events, {}, &StageEvent::time);  // contacts are reported a little later
  recording.unfired = stage.unfired_rules();
  return recording;
}

double natural_length(const StageDescription& description) {
  constexpr double to_come_to_rest = 3, endless = 4, hour = 3600, most = 600;
  double length = 0;
  bool simulated = false;
  for (const Play& play : description.plays) {
    if (play.clip >= description.clips.size()) continue;
    const Clip& clip = description.clips[play.clip];
    const double end = end_time(play, clip);
    if (end < hour)
      length = std::max(length, end);
    else
      length = std::max(length, play.at + (clip.duration < hour ? std::max(endless, clip.duration) : endless));
  }
  for (const GraphDescription& graph : description.graphs) {
    length = std::max(length, endless);
    for (const GraphInput& input : graph.inputs)
      if (input.time < hour) length = std::max(length, input.time + endless / 2);
  }
  for (const Rule& rule : description.rules) {
    simulated = true;
    for (const Trigger& trigger : rule.when.triggers)
      if (const auto* at = std::get_if<when::At>(&trigger)) length = std::max(length, at->time);
  }
  for (const JointDescription& joint : description.joints)
    if (const auto* at = std::get_if<when::At>(&joint.until)) length = std::max(length, at->time);
  for (const NodeDescription& node : description.nodes)
    if (node.body && !node.body->fixed) simulated = true;
  for (const VehicleDescription& vehicle : description.vehicles)
    for (const Strength* script : {&vehicle.throttle, &vehicle.brake, &vehicle.steer})
      if (script->curve() && script->curve()->end() < hour) length = std::max(length, script->curve()->end());
  if (!description.softs.empty() || !description.vehicles.empty() || !description.particles.empty()) simulated = true;
  if (simulated) length += to_come_to_rest;
  return std::clamp(length, 1.0, most);
}

}  // namespace tweenfall
