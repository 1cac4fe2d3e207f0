#include <tweenfall/importers/recording_file.h>

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "json/json_string.h"
#include "recording/words.h"

namespace tweenfall {

namespace recordings {
namespace {

/// "[a,b,...]" with what `append` adds for each index.
template <class Append>
void append_list(std::string& out, std::size_t size, Append append) {
  out += '[';
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) out += ',';
    append(i);
  }
  out += ']';
}

void append_word(std::string& out, const char* word) {
  out += '"';
  out += word;
  out += '"';
}

void append_node(std::string& out, const NodeRecord& node) {
  const std::size_t frames = node.world.size();
  json::append_string(out, node.name);
  out += ": {\n   \"position\": ";
  append_list(out, frames, [&](std::size_t i) { append_vector(out, node.world[i].motion.pose.position); });
  out += ",\n   \"rotation\": ";
  append_list(out, frames, [&](std::size_t i) { append_rotation(out, node.world[i].motion.pose.rotation); });
  out += ",\n   \"velocity\": ";
  append_list(out, frames, [&](std::size_t i) { append_vector(out, node.twist[i].linear); });
  out += ",\n   \"angular_velocity\": ";
  append_list(out, frames, [&](std::size_t i) { append_vector(out, node.twist[i].angular); });
  out += ",\n   \"owner\": ";
  append_list(out, frames, [&](std::size_t i) { append_word(out, owner_word(node.owner[i])); });
  out += "}";
}

/// A list with one value for each frame, null where the joint is gone or does not exist yet.
template <class Append>
void append_readings(std::string& out, const char* name, const JointRecord& joint, Append append) {
  ((out += ",\n   \"") += name) += "\": ";
  append_list(out, joint.reading.size(), [&](std::size_t i) {
    if (joint.reading[i])
      append(*joint.reading[i]);
    else
      out += "null";
  });
}

/// The name of a joint; a later joint with the name of one that is gone also gets a number.
std::string told_name(const Recording& recording, const JointRecord& joint) {
  const std::span<const JointRecord> before(recording.joints.data(), &joint);
  const auto namesakes = std::ranges::count(before, joint.name, &JointRecord::name);
  return namesakes == 0 ? joint.name : joint.name + " #" + std::to_string(namesakes + 1);
}

void append_joint(std::string& out, const Recording& recording, const JointRecord& joint) {
  json::append_string(out, told_name(recording, joint));
  out += ": {\n   \"nodes\": [";
  if (joint.a != no_node) {
    json::append_string(out, recording.nodes[joint.a].name);
    out += ", ";
  }
  json::append_string(out, recording.nodes[joint.b].name);
  out += "]";
  append_readings(out, "force", joint, [&](const JointReading& reading) { append_vector(out, reading.force); });
  append_readings(out, "torque", joint, [&](const JointReading& reading) { append_vector(out, reading.torque); });
  const auto first = std::ranges::find_if(joint.reading, [](const auto& reading) { return reading.has_value(); });
  if (first != joint.reading.end() && (*first)->coordinates > 0) {
    const auto append_coordinates = [&](const std::array<double, 3>& values, int count) {
      append_list(out, static_cast<std::size_t>(count), [&](std::size_t i) { append_number(out, values[i]); });
    };
    append_readings(out, "position", joint,
                    [&](const JointReading& reading) { append_coordinates(reading.position, reading.coordinates); });
    append_readings(out, "rate", joint,
                    [&](const JointReading& reading) { append_coordinates(reading.rate, reading.coordinates); });
  }
  out += "}";
}

template <class T>
void append_value(std::string& out, const T& value) {
  if constexpr (std::is_same_v<T, double>)
    append_number(out, value);
  else if constexpr (std::is_same_v<T, Quat>)
    append_rotation(out, value);
  else if constexpr (std::is_same_v<T, Color>)
    append_value(out, value.rgba);
  else
    append_list(out, static_cast<std::size_t>(value.size()),
                [&](std::size_t i) { append_number(out, value[static_cast<Eigen::Index>(i)]); });
}

/// Values frame by frame and, where they have any, rates: rotations x y z w, their rates angular velocities; colors
/// linear red, green, blue, alpha.
void append_user_track(std::string& out, const UserTrackRecord& track) {
  json::append_string(out, track.name);
  const auto each = [&](const char* word, const auto& append) {
    (out += word) += ": ";
    append_list(out, track.value.size(), [&](std::size_t frame) { std::visit(append, track.value[frame]); });
  };
  each(": {\"value\"", [&]<class T>(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
      out += value ? "true" : "false";
    else if constexpr (std::is_same_v<T, std::string>)
      json::append_string(out, value);
    else if constexpr (std::is_same_v<T, std::vector<Sample<double>>>)
      append_list(out, value.size(), [&](std::size_t i) { append_number(out, value[i].value); });
    else
      append_value(out, value.value);
  });
  const bool has_rate = !track.value.empty() && !std::holds_alternative<bool>(track.value.front()) &&
                        !std::holds_alternative<std::string>(track.value.front());
  if (has_rate)
    each(", \"rate\"", [&]<class T>(const T& value) {
      if constexpr (std::is_same_v<T, std::vector<Sample<double>>>)
        append_list(out, value.size(), [&](std::size_t i) { append_number(out, value[i].rate); });
      else if constexpr (!std::is_same_v<T, bool> && !std::is_same_v<T, std::string>)
        append_value(out, value.rate);
    });
  out += "}";
}

/// The positions of all nodes, frame by frame, and the times at which edges tore.
void append_soft(std::string& out, const Recording& recording, const SoftRecord& soft) {
  json::append_string(out, soft.name);
  out += ": {\n   \"positions\": ";
  append_list(out, soft.positions.size(), [&](std::size_t frame) {
    append_list(out, soft.positions[frame].size(),
                [&](std::size_t i) { append_vector(out, soft.positions[frame][i]); });
  });
  out += ",\n   \"torn\": ";
  std::vector<std::size_t> torn;
  for (std::size_t i = 0; i < soft.torn_at.size(); ++i)
    if (soft.torn_at[i] < recording.times.size()) torn.push_back(i);
  append_list(out, torn.size(), [&](std::size_t i) {
    out += "{\"edge\": " + std::to_string(torn[i]) + ", \"time\": ";
    append_number(out, recording.times[soft.torn_at[torn[i]]]);
    out += "}";
  });
  out += "}";
}

/// The poses of its wheels, wheel by wheel and frame by frame.
void append_vehicle(std::string& out, const VehicleRecord& vehicle) {
  json::append_string(out, vehicle.name);
  out += ": {";
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    out += i > 0 ? ",\n   " : "\n   ";
    json::append_string(out, vehicle.wheels[i]);
    const auto series = [&](const char* name, const auto& append) {
      (out += name) += ": ";
      append_list(out, vehicle.frame.size(), [&](std::size_t frame) { append(vehicle.frame[frame].at(i)); });
    };
    const auto numbers = [&](const char* name, double WheelReading::*part) {
      series(name, [&](const StageWheel& wheel) { append_number(out, wheel.reading.*part); });
    };
    series(": {\"position\"", [&](const StageWheel& wheel) { append_vector(out, wheel.pose.position); });
    numbers(", \"spin\"", &WheelReading::spin);
    numbers(", \"steer\"", &WheelReading::steer);
    numbers(", \"load\"", &WheelReading::load);
    numbers(", \"slip\"", &WheelReading::slip);
    out += "}";
  }
  out += "}";
}

/// Positions and velocities, frame by frame, and the number of each particle.
void append_particles(std::string& out, const ParticlesRecord& particles) {
  json::append_string(out, particles.name);
  out += ": {\n   \"numbers\": ";
  append_list(out, particles.frame.size(), [&](std::size_t frame) {
    const std::vector<std::uint64_t>& numbers = particles.frame[frame].numbers;
    append_list(out, numbers.size(), [&](std::size_t i) { out += std::to_string(numbers[i]); });
  });
  const auto vectors = [&](const char* name, std::vector<Vec3> StageParticles::*part) {
    (out += name) += ": ";
    append_list(out, particles.frame.size(), [&](std::size_t frame) {
      const std::vector<Vec3>& list = particles.frame[frame].*part;
      append_list(out, list.size(), [&](std::size_t i) { append_vector(out, list[i]); });
    });
  };
  vectors(",\n   \"positions\"", &StageParticles::positions);
  vectors(",\n   \"velocities\"", &StageParticles::velocities);
  out += "}";
}

/// Energies, frame by frame; null for a force without energy.
void append_energy(std::string& out, const Recording& recording) {
  const std::vector<StageEnergy>& energy = recording.energy;
  for (const StageEnergy& one : energy)
    if (one.softs.size() != recording.softs.size() || one.particles.size() != recording.particles.size())
      throw RecordingFault(recording, no_node,
                           "the energy tells of more or fewer soft bodies or kinds of particles than there are");
  const auto series = [&](const char* name, const auto& append_at) {
    out += name;
    append_list(out, energy.size(), [&](std::size_t frame) { append_at(energy[frame]); });
  };
  series("{\"kinetic\": ", [&](const StageEnergy& one) { append_number(out, one.kinetic); });
  series(",\n  \"weight\": ", [&](const StageEnergy& one) { append_number(out, one.weight); });
  out += ",\n  \"forces\": ";
  append_list(out, energy.front().forces.size(), [&](std::size_t force) {
    series("", [&](const StageEnergy& one) {
      if (force < one.forces.size() && one.forces[force])
        append_number(out, *one.forces[force]);
      else
        out += "null";
    });
  });
  const auto part_of = [&](const char* name, const auto& part) {
    series(name, [&](const StageEnergy& one) { append_number(out, part(one)); });
  };
  const auto named = [&](const char* word, const auto& records, const auto& append_one) {
    if (records.empty()) return;
    (out += ",\n  \"") += word;
    for (std::size_t i = 0; i < records.size(); ++i) {
      out += i == 0 ? "\": {" : ", ";
      json::append_string(out, records[i].name);
      out += ": ";
      append_one(i);
      out += "}";
    }
    out += "}";
  };
  named("soft", recording.softs, [&](std::size_t i) {
    part_of("{\"kinetic\": ", [i](const StageEnergy& one) { return one.softs[i].kinetic; });
    part_of(", \"elastic\": ", [i](const StageEnergy& one) { return one.softs[i].elastic; });
    part_of(", \"weight\": ", [i](const StageEnergy& one) { return one.softs[i].weight; });
  });
  named("particles", recording.particles, [&](std::size_t i) {
    part_of("{\"kinetic\": ", [i](const StageEnergy& one) { return one.particles[i].kinetic; });
    part_of(", \"weight\": ", [i](const StageEnergy& one) { return one.particles[i].weight; });
  });
  part_of(",\n  \"total\": ", [](const StageEnergy& one) { return one.total(); });
  out += "}";
}

void append_twist(std::string& out, const Twist& twist) {
  out += "{\"linear\": ";
  append_vector(out, twist.linear);
  out += ", \"angular\": ";
  append_vector(out, twist.angular);
  out += "}";
}

void append_handoff(std::string& out, const Recording& recording, const HandOff& handoff) {
  out += "{\"time\": ";
  append_number(out, handoff.time);
  out += ", \"body\": ";
  json::append_string(out, recording.nodes[handoff.node].name);
  out += ", \"from\": ";
  append_word(out, owner_word(handoff.from));
  out += ", \"to\": ";
  append_word(out, owner_word(handoff.to));
  out += ", \"cause\": ";
  append_word(out, cause_word(handoff.cause));
  out += ",\n   \"before\": ";
  append_twist(out, handoff.before.twist);
  out += ", \"after\": ";
  append_twist(out, handoff.after.twist);
  out += "}";
}

void append_event(std::string& out, const Recording& recording, const StageEvent& event) {
  out += "{\"time\": ";
  append_number(out, event.time);
  out += ", \"name\": ";
  json::append_string(out, event.name);
  if (event.kind != EventKind::moment) ((out += ", \"kind\": \"") += kind_word(event.kind)) += '"';
  if (!event.data.empty()) (out += ", \"data\": ") += event.data;
  if (!event.nodes.empty()) {
    out += ", \"nodes\": ";
    append_list(out, event.nodes.size(),
                [&](std::size_t i) { json::append_string(out, recording.nodes[event.nodes[i]].name); });
    if (event.joint.empty()) {
      out += ", \"impulse\": ";
      append_number(out, event.impulse);
    } else {
      out += ", \"joint\": ";
      json::append_string(out, event.joint);
    }
  }
  out += "}";
}

void append_unfired(std::string& out, const Recording& recording, const UnfiredRule& unfired) {
  out += "{\"rule\": " + std::to_string(unfired.rule) + ", \"body\": ";
  json::append_string(out, recording.nodes[unfired.node].name);
  out += ", \"reason\": ";
  json::append_string(out, unfired.reason);
  out += "}";
}

/// "[" or "{", the items each on a line of its own, and the closing bracket.
template <class Append>
void append_lines(std::string& out, char open, char close, std::size_t size, Append append) {
  out += open;
  for (std::size_t i = 0; i < size; ++i) {
    out += i == 0 ? "\n  " : ",\n  ";
    append(i);
  }
  if (size > 0) out += "\n ";
  out += close;
}

}  // namespace
}  // namespace recordings

std::string recording_json(const Recording& recording) {
  check_recording(recording);
  std::string out = "{\"times\": ";
  recordings::append_list(out, recording.times.size(), [&](std::size_t i) { append_number(out, recording.times[i]); });
  out += ",\n \"nodes\": ";
  recordings::append_lines(out, '{', '}', recording.nodes.size(),
                           [&](std::size_t i) { recordings::append_node(out, recording.nodes[i]); });
  if (!recording.user_tracks.empty()) {
    out += ",\n \"tracks\": ";
    recordings::append_lines(out, '{', '}', recording.user_tracks.size(),
                             [&](std::size_t i) { recordings::append_user_track(out, recording.user_tracks[i]); });
  }
  if (!recording.joints.empty()) {
    out += ",\n \"joints\": ";
    recordings::append_lines(out, '{', '}', recording.joints.size(),
                             [&](std::size_t i) { recordings::append_joint(out, recording, recording.joints[i]); });
  }
  if (!recording.softs.empty()) {
    out += ",\n \"soft\": ";
    recordings::append_lines(out, '{', '}', recording.softs.size(),
                             [&](std::size_t i) { recordings::append_soft(out, recording, recording.softs[i]); });
  }
  if (!recording.energy.empty()) {
    out += ",\n \"energy\": ";
    recordings::append_energy(out, recording);
  }
  if (!recording.complementarity.empty()) {
    out += ",\n \"complementarity\": ";
    recordings::append_list(out, recording.complementarity.size(),
                            [&](std::size_t i) { append_number(out, recording.complementarity[i]); });
  }
  if (!recording.vehicles.empty()) {
    out += ",\n \"vehicles\": ";
    recordings::append_lines(out, '{', '}', recording.vehicles.size(),
                             [&](std::size_t i) { recordings::append_vehicle(out, recording.vehicles[i]); });
  }
  if (!recording.particles.empty()) {
    out += ",\n \"particles\": ";
    recordings::append_lines(out, '{', '}', recording.particles.size(),
                             [&](std::size_t i) { recordings::append_particles(out, recording.particles[i]); });
  }
  out += ",\n \"handoffs\": ";
  recordings::append_lines(out, '[', ']', recording.handoffs.size(),
                           [&](std::size_t i) { recordings::append_handoff(out, recording, recording.handoffs[i]); });
  out += ",\n \"events\": ";
  recordings::append_lines(out, '[', ']', recording.events.size(),
                           [&](std::size_t i) { recordings::append_event(out, recording, recording.events[i]); });
  out += ",\n \"unfired\": ";
  recordings::append_lines(out, '[', ']', recording.unfired.size(),
                           [&](std::size_t i) { recordings::append_unfired(out, recording, recording.unfired[i]); });
  out += "}\n";
  return out;
}

}  // namespace tweenfall
