#include <tweenfall/importers/recording_file.h>

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/shown_text.h>

#include "recording/user_numbers.h"
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
/// @param after  the columns that follow
void append_point(std::string& out, double time, const std::string& name, const char* kind, const Vec3& position,
                  const Vec3* velocity, const std::string& after) {
  append_number(out, time);
  (((out += ',') += field(name)) += ',') += kind;
  append_columns(out, position, 3);
  out += ",,,,";
  if (velocity)
    append_columns(out, *velocity, 3);
  else
    out += ",,,";
  (out += ",,,") += after;
  out += '\n';
}

void append_softs(std::string& out, const Recording& recording, std::size_t frame, const std::string& after) {
  for (const SoftRecord& soft : recording.softs)
    for (std::size_t i = 0; i < soft.positions[frame].size(); ++i)
      append_point(out, recording.times[frame], soft.name + ":" + std::to_string(i), "soft", soft.positions[frame][i],
                   nullptr, after);
}

void append_wheels(std::string& out, const Recording& recording, std::size_t frame, const std::string& after) {
  for (const VehicleRecord& vehicle : recording.vehicles)
    for (std::size_t i = 0; i < vehicle.frame[frame].size() && i < vehicle.wheels.size(); ++i) {
      const Pose& pose = vehicle.frame[frame][i].pose;
      append_number(out, recording.times[frame]);
      ((out += ',') += field(vehicle.name + "/" + vehicle.wheels[i])) += ",wheel";
      append_columns(out, pose.position, 3);
      append_columns(out, pose.rotation.coeffs(), 4);
      (out += ",,,,,,") += after;
      out += '\n';
    }
}

void append_particles(std::string& out, const Recording& recording, std::size_t frame, const std::string& after) {
  for (const ParticlesRecord& particles : recording.particles) {
    const StageParticles& there = particles.frame[frame];
    for (std::size_t i = 0; i < there.positions.size(); ++i)
      append_point(out, recording.times[frame], particles.name + ":" + std::to_string(there.numbers[i]), "particle",
                   there.positions[i], &there.velocities[i], after);
  }
}

/// The columns of user tracks. Their values stand in the rows of the node that a track names, or where there is none in
/// the first row of each frame.
class UserColumns {
 public:
  explicit UserColumns(const Recording& recording) {
    for (const UserTrackRecord& track : recording.user_tracks) {
      std::size_t place = 0, longest = 0;
      for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
        const std::string& name = recording.nodes[i].name;
        if (name.size() < longest || !track.name.starts_with(name + ".")) continue;
        place = i;
        longest = name.size();
      }
      const bool is_text = !track.value.empty() && std::holds_alternative<std::string>(track.value.front());
      columns_.push_back({&track, place, is_text ? std::vector<std::string>{""} : number_names(track), is_text});
    }
  }
  void append_header(std::string& out) const {
    for (const Column& column : columns_)
      for (const std::string& part : column.parts)
        (out += ',') += field(column.track->name + (part.empty() ? "" : "_" + part));
  }
  void append_values(std::string& out, std::size_t node, std::size_t frame) const {
    for (const Column& column : columns_) {
      if (column.node != node)
        out.append(column.parts.size(), ',');
      else if (column.is_text)
        (out += ',') += field(std::get<std::string>(column.track->value[frame]));
      else
        append_columns(out, numbers_at(*column.track, frame, column.parts.size()),
                       static_cast<int>(column.parts.size()));
    }
  }
  /// In rows that are not of nodes.
  [[nodiscard]] std::string nothing() const {
    std::size_t count = 0;
    for (const Column& column : columns_) count += column.parts.size();
    return std::string(count, ',');
  }

 private:
  struct Column {
    const UserTrackRecord* track;
    std::size_t node;
    std::vector<std::string> parts;
    bool is_text;
  };
  std::vector<Column> columns_{};
};

}  // namespace
}  // namespace recordings

std::string recording_csv(const Recording& recording) {
  check_recording(recording);
  std::string out =
      "time,node,owner,position_x,position_y,position_z,rotation_x,rotation_y,rotation_z,rotation_w,"
      "velocity_x,velocity_y,velocity_z,angular_velocity_x,angular_velocity_y,angular_velocity_z";
  const recordings::UserColumns user(recording);
  const std::string nothing = user.nothing();
  user.append_header(out);
  out += '\n';
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
      const NodeRecord& node = recording.nodes[i];
      append_number(out, recording.times[frame]);
      ((out += ',') += recordings::field(node.name)) += ',';
      out += owner_word(node.owner[frame]);
      const Pose& pose = node.world[frame].motion.pose;
      recordings::append_columns(out, pose.position, 3);
      recordings::append_columns(out, pose.rotation.coeffs(), 4);
      recordings::append_columns(out, node.twist[frame].linear, 3);
      recordings::append_columns(out, node.twist[frame].angular, 3);
      user.append_values(out, i, frame);
      out += '\n';
    }
    recordings::append_softs(out, recording, frame, nothing);
    recordings::append_wheels(out, recording, frame, nothing);
    recordings::append_particles(out, recording, frame, nothing);
  }
  return out;
}

}  // namespace tweenfall
