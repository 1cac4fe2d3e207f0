#include <tweenfall/importers/recording_file.h>

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/shown_text.h>

#include "recording/words.h"

namespace tweenfall {

namespace recordings {
namespace {

/// A field by RFC 4180: quoted when it contains a comma, a quote or a line break. Other control characters are
/// replaced, because readers of tables stop at a zero byte or refuse them.
std::string field(const std::string& name) {
  std::string text;
  for (const char c : utf8_text(name)) {
    const bool is_control = (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
    is_control ? text += "\xef\xbf\xbd" : text += c;
  }
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

template <class Values>
void append_columns(std::string& out, const Values& values, int count) {
  for (int i = 0; i < count; ++i) {
    out += ',';
    append_number(out, values[i]);
  }
}

/// A row for a point, with a position, perhaps a velocity, and no rotation.
void append_point(std::string& out, double time, const std::string& name, const char* kind, const Vec3& position,
                  const Vec3* velocity) {
  append_number(out, time);
  (((out += ',') += field(name)) += ',') += kind;
  append_columns(out, position, 3);
  out += ",,,,";
  if (velocity)
    append_columns(out, *velocity, 3);
  else
    out += ",,,";
  out += ",,,\n";
}

void append_softs(std::string& out, const Recording& recording, std::size_t frame) {
  for (const SoftRecord& soft : recording.softs)
    for (std::size_t i = 0; i < soft.positions[frame].size(); ++i)
      append_point(out, recording.times[frame], soft.name + ":" + std::to_string(i), "soft", soft.positions[frame][i],
                   nullptr);
}

void append_wheels(std::string& out, const Recording& recording, std::size_t frame) {
  for (const VehicleRecord& vehicle : recording.vehicles)
    for (std::size_t i = 0; i < vehicle.frame[frame].size() && i < vehicle.wheels.size(); ++i) {
      const Pose& pose = vehicle.frame[frame][i].pose;
      append_number(out, recording.times[frame]);
      ((out += ',') += field(vehicle.name + "/" + vehicle.wheels[i])) += ",wheel";
      append_columns(out, pose.position, 3);
      append_columns(out, pose.rotation.coeffs(), 4);
      out += ",,,,,,\n";
    }
}

void append_particles(std::string& out, const Recording& recording, std::size_t frame) {
  for (const ParticlesRecord& particles : recording.particles) {
    const StageParticles& there = particles.frame[frame];
    for (std::size_t i = 0; i < there.positions.size(); ++i)
      append_point(out, recording.times[frame], particles.name + ":" + std::to_string(there.numbers[i]), "particle",
                   there.positions[i], &there.velocities[i]);
  }
}

}  // namespace
}  // namespace recordings

std::string recording_csv(const Recording& recording) {
  check_recording(recording);
  std::string out =
      "time,node,owner,position_x,position_y,position_z,rotation_x,rotation_y,rotation_z,rotation_w,"
      "velocity_x,velocity_y,velocity_z,angular_velocity_x,angular_velocity_y,angular_velocity_z\n";
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    for (const NodeRecord& node : recording.nodes) {
      append_number(out, recording.times[frame]);
      ((out += ',') += recordings::field(node.name)) += ',';
      out += owner_word(node.owner[frame]);
      const Pose& pose = node.world[frame].motion.pose;
      recordings::append_columns(out, pose.position, 3);
      recordings::append_columns(out, pose.rotation.coeffs(), 4);
      recordings::append_columns(out, node.twist[frame].linear, 3);
      recordings::append_columns(out, node.twist[frame].angular, 3);
      out += '\n';
    }
    recordings::append_softs(out, recording, frame);
    recordings::append_wheels(out, recording, frame);
    recordings::append_particles(out, recording, frame);
  }
  return out;
}

}  // namespace tweenfall
