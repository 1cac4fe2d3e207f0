#include "page/content/page_data.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/recording_file.h>

#include "figures/shape_mesh.h"
#include "figures/turned_profile.h"
#include "json/json_string.h"
#include "page/content/page_details.h"
#include "page/content/page_frames.h"
#include "page/content/page_graphs.h"
#include "page/content/page_meshes.h"
#include "page/content/page_particles.h"
#include "recording/base64.h"
#include "recording/key_lanes.h"
#include "recording/words.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tweenfall::page {

namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

void add_vector(std::vector<float>& out, const Vec3& vector) {
  for (int i = 0; i < 3; ++i) out.push_back(single(vector[i]));
}

void add_matrix(std::vector<float>& out, const Mat3& matrix) {
  for (int column = 0; column < 3; ++column) add_vector(out, matrix.col(column));
}

/// Keeps a single frame if all are equal, so that things at rest cost nothing.
void drop_repeats(std::vector<float>& values, std::size_t stride) {
  for (std::size_t i = stride; i < values.size(); ++i)
    if (values[i] != values[i - stride]) return;
  if (values.size() > stride) values.resize(stride);
}

void append_quoted(std::string& out, const char* name, const std::string& text) {
  ((((out += ",\"") += name) += "\":\"") += text) += '"';
}

void append_hull(std::string& out, const ConvexHull& hull) {
  out += "\"hull\":{\"vertices\":[";
  for (std::size_t i = 0; i < hull.vertices().size(); ++i) {
    if (i > 0) out += ',';
    append_vector(out, hull.vertices()[i]);
  }
  out += "],\"faces\":[";
  for (std::size_t i = 0; i < hull.faces().size(); ++i) {
    out += i > 0 ? ",[" : "[";
    const std::span<const std::uint32_t> corners = hull.corners(hull.faces()[i]);
    for (std::size_t k = 0; k < corners.size(); ++k) (k > 0 ? out += ',' : out) += std::to_string(corners[k]);
    out += ']';
  }
  out += "]}";
}

/// An outline about y, from the top down: [radius, height, normal's radius, normal's height].
void append_turned(std::string& out, const std::vector<figures::ProfilePoint>& profile) {
  out += "\"turned\":[";
  for (std::size_t i = 0; i < profile.size(); ++i) {
    out += i > 0 ? ",[" : "[";
    out += number_text(profile[i].radius) + "," + number_text(profile[i].height) + "," +
           number_text(profile[i].normal_radius) + "," + number_text(profile[i].normal_height) + "]";
  }
  out += "]";
}

/// All corners, one after the other.
void append_triangles(std::string& out, const Mesh& mesh) {
  out += "\"corners\":[";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i > 0) out += ',';
    append_vector(out, mesh.positions[mesh.triangles[i]]);
  }
  out += "]";
}

std::string shape_json(const Shape& shape) {
  std::string out = "{";
  std::visit(Overloaded{[&](const Sphere& s) { out += "\"sphere\":" + number_text(s.radius); },
                        [&](const Box& b) {
                          out += "\"box\":";
                          append_vector(out, b.half_extents);
                        },
                        [&](const Capsule& c) {
                          out += "\"capsule\":[" + number_text(c.radius) + "," + number_text(c.half_height) + "]";
                        },
                        [&](const Plane& p) {
                          out += "\"plane\":";
                          append_vector(out, p.normal);
                          out += ",\"offset\":" + number_text(p.offset);
                        },
                        [&](const Hull& h) { append_hull(out, h.convex); },
                        [&](const Compound& c) { append_triangles(out, figures::shape_mesh({c})); },
                        [&](const TriangleMesh& m) { append_triangles(out, figures::shape_mesh({m})); },
                        [&](const HeightField& f) { append_triangles(out, figures::shape_mesh({f})); },
                        [&](const auto&) { append_turned(out, figures::turned_profile(shape.solid)); }},
             shape.solid);
  out += ",\"position\":";
  append_vector(out, shape.offset.position);
  out += ",\"rotation\":";
  append_rotation(out, shape.offset.rotation);
  return out + "}";
}

/// Owners as runs: [[first frame, word], ...].
std::string owner_runs(const std::vector<Owner>& owners, const std::vector<std::size_t>& frames) {
  std::string out = "[";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i > 0 && owners[frames[i]] == owners[frames[i - 1]]) continue;
    if (i > 0) out += ',';
    out += "[" + std::to_string(i) + ",\"" + owner_word(owners[frames[i]]) + "\"]";
  }
  return out + "]";
}

/// One part of a color; invalid or extremely bright parts become the nearest usable number.
double drawn(double part) {
  constexpr double brightest = 1e6;
  return part > -brightest ? std::min(part, brightest) : part < 0 ? -brightest : 0;
}

/// The numbers that `append` gives for each of `frames`, or only for one if they never change.
template <class Append>
std::vector<float> gathered(const std::vector<std::size_t>& frames, std::size_t stride, Append append) {
  std::vector<float> numbers;
  numbers.reserve(frames.size() * stride);
  for (const std::size_t frame : frames) append(numbers, frame);
  drop_repeats(numbers, stride);
  return numbers;
}

/// The rate of the linear part without the rotation, world axes, 1/s.
Mat3 stretching(const WorldMotion& world) {
  const Vec3& w = world.motion.twist.angular;
  Mat3 turning;
  turning << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return world.linear_rate - turning * world.linear;
}

/// Places and rates of a node, frame by frame.
void append_motion(std::string& out, const NodeRecord& node, const std::vector<std::size_t>& frames) {
  append_quoted(out, "matrices",
                recordings::base64(gathered(frames, 12, [&](std::vector<float>& to, std::size_t frame) {
                  add_matrix(to, node.world[frame].linear);
                  add_vector(to, node.world[frame].motion.pose.position);
                })));
  append_quoted(out, "twists", recordings::base64(gathered(frames, 6, [&](std::vector<float>& to, std::size_t frame) {
                  add_vector(to, node.twist[frame].linear);
                  add_vector(to, node.twist[frame].angular);
                })));
  const auto any = [&](auto differs) { return std::any_of(frames.begin(), frames.end(), differs); };
  // The origin's own velocity, if it differs from that of the center of mass.
  if (any([&](std::size_t frame) { return node.world[frame].motion.twist.linear != node.twist[frame].linear; }))
    append_quoted(out, "velocities",
                  recordings::base64(gathered(frames, 3, [&](std::vector<float>& to, std::size_t frame) {
                    add_vector(to, node.world[frame].motion.twist.linear);
                  })));
  if (any([&](std::size_t frame) {
        return !node.world[frame].linear_rate.isZero(0) && !stretching(node.world[frame]).isZero(1e-9);
      }))
    append_quoted(out, "stretches",
                  recordings::base64(gathered(frames, 9, [&](std::vector<float>& to, std::size_t frame) {
                    add_matrix(to, stretching(node.world[frame]));
                  })));
}

std::string color_json(const Color& color) {
  std::string out = "[";
  for (int i = 0; i < 4; ++i) (i > 0 ? out += ',' : out) += short_text(drawn(color.rgba[i]), 4);
  return out + "]";
}

std::string node_json(const NodeRecord& node, const NodeDescription* description,
                      const std::vector<std::size_t>& frames) {
  std::string out = "{\"name\":";
  json::append_string(out, node.name);
  out += ",\"parent\":" + (node.parent == no_node ? std::string("-1") : std::to_string(node.parent));
  out += ",\"owner\":" + owner_runs(node.owner, frames);
  append_motion(out, node, frames);
  if (!node.color.empty()) {
    append_quoted(out, "colors", recordings::base64(gathered(frames, 4, [&](std::vector<float>& to, std::size_t frame) {
                    for (int i = 0; i < 4; ++i) to.push_back(single(drawn(node.color[frame].rgba[i])));
                  })));
  } else if (description && description->color) {
    out += ",\"color\":" + color_json(*description->color);
  }
  if (!node.weights.empty() && !node.weights.front().empty()) {
    const std::size_t count = node.weights.front().size();
    out += ",\"weightCount\":" + std::to_string(count);
    append_quoted(out, "weights",
                  recordings::base64(gathered(frames, count, [&](std::vector<float>& to, std::size_t frame) {
                    const std::vector<double>& weights = node.weights[frame];
                    for (std::size_t i = 0; i < count; ++i) to.push_back(i < weights.size() ? single(weights[i]) : 0);
                  })));
  }
  if (description && description->body) {
    out += ",\"shape\":" + shape_json(description->body->shape);
    if (description->body->fixed) out += ",\"fixed\":true";
    if (!is_scenery(description->body->shape.solid)) {
      out += ",\"center\":";
      const std::optional<MassProperties>& given = description->body->mass_properties;
      append_vector(out, given ? given->center : mass_properties(description->body->shape, 1).center);
    }
  }
  return out + "}";
}

std::string lane_json(const recordings::KeyLane& lane, std::size_t node) {
  std::string out = "{\"node\":" + std::to_string(node) + ",\"property\":";
  json::append_string(out, lane.property);
  append_quoted(out, "times", recordings::base64(std::span<const double>(lane.times)));
  append_quoted(out, "keyOf", recordings::base64(std::span<const std::uint32_t>(lane.key_of)));
  out += ",\"keys\":[";
  for (std::size_t i = 0; i < lane.keys.size(); ++i) {
    out += i > 0 ? ",{\"value\":" : "{\"value\":";
    json::append_string(out, lane.keys[i].value);
    out += ",\"ease\":";
    json::append_string(out, lane.keys[i].ease);
    out += '}';
  }
  return out + "]}";
}

std::string motion_json(const Motion& motion) {
  std::string out = "{\"position\":";
  append_vector(out, motion.pose.position);
  out += ",\"rotation\":";
  append_rotation(out, motion.pose.rotation);
  out += ",\"velocity\":";
  append_vector(out, motion.twist.linear);
  out += ",\"angular\":";
  append_vector(out, motion.twist.angular);
  return out + "}";
}

std::string handoff_json(const HandOff& handoff) {
  std::string out = "{\"time\":" + number_text(handoff.time) + ",\"node\":" + std::to_string(handoff.node);
  append_quoted(out, "from", owner_word(handoff.from));
  append_quoted(out, "to", owner_word(handoff.to));
  append_quoted(out, "cause", cause_word(handoff.cause));
  return out + ",\"before\":" + motion_json(handoff.before) + ",\"after\":" + motion_json(handoff.after) + "}";
}

std::string event_json(const StageEvent& event) {
  std::string out = "{\"time\":" + number_text(event.time) + ",\"name\":";
  json::append_string(out, event.name);
  append_quoted(out, "kind", recordings::kind_word(event.kind));
  out += ",\"nodes\":[";
  for (std::size_t i = 0; i < event.nodes.size(); ++i) out += (i > 0 ? "," : "") + std::to_string(event.nodes[i]);
  return out + "],\"impulse\":" + short_text(event.impulse, 6) + "}";
}

void append_frame(std::string& out, const Pose& frame) {
  for (int i = 0; i < 3; ++i) out += (i > 0 ? "," : "[") + number_text(frame.position[i]);
  const Quat& turn = frame.rotation;
  for (const double part : {turn.x(), turn.y(), turn.z(), turn.w()}) out += "," + number_text(part);
  out += "]";
}

/// The time at which a joint was gone; null where it held to the end.
std::string gone_text(const Recording& recording, const std::string& joint) {
  for (const StageEvent& event : recording.events)
    if (event.joint == joint) return number_text(event.time);
  return "null";
}

std::string joint_json(const Recording& recording, const JointDescription& joint) {
  const auto index = [&](std::size_t node) {
    return node < recording.nodes.size() ? std::to_string(node) : std::string("-1");
  };
  std::string out = "{\"name\":";
  json::append_string(out, joint.name);
  out += ",\"a\":" + index(joint.a) + ",\"b\":" + index(joint.b) + ",\"frames\":[";
  append_frame(out, joint.frame_a);
  out += ",";
  append_frame(out, joint.frame_b);
  out += "],\"gone\":" + gone_text(recording, joint.name);
  const auto angles = [&](const std::optional<Limits>& limits) {
    out += ",\"axis\":true,\"turns\":true";
    if (limits && std::abs(limits->low) < 1e6 && std::abs(limits->high) < 1e6)
      out += ",\"angles\":[" + number_text(limits->low) + "," + number_text(limits->high) + "]";
  };
  const auto axis = [&] { out += ",\"axis\":true"; };
  std::visit(Overloaded{[&](const HingeJoint& hinge) { angles(hinge.limits); },
                        [&](const UniversalJoint& universal) { angles(universal.first_limits); },
                        [&](const SwingTwistJoint& limb) { angles(limb.twist); }, [&](const SliderJoint&) { axis(); },
                        [&](const WheelJoint&) { axis(); }, [&](const GearJoint&) { axis(); },
                        [&](const PulleyJoint& pulley) {
                          out += ",\"over\":[";
                          append_vector(out, pulley.pulley_a);
                          out += ",";
                          append_vector(out, pulley.pulley_b);
                          out += "]";
                        },
                        [](const auto&) {}},
             joint.kind);
  return out + "}";
}

/// [{node, kind, times}, ...]
void append_jumps(std::string& out, const Recording& recording) {
  constexpr const char* words[] = {"place", "color", "weights"};
  std::map<std::pair<NodeId, std::size_t>, std::vector<double>> times_of;
  for (const JumpRecord& jump : recording.jumps)
    times_of[{jump.node, static_cast<std::size_t>(jump.kind)}].push_back(jump.time);
  out += ",\n\"jumps\":[";
  bool first = true;
  for (const auto& [of, times] : times_of) {
    out += (first ? "{\"node\":" : ",\n{\"node\":") + std::to_string(of.first);
    append_quoted(out, "kind", words[of.second]);
    append_quoted(out, "times", recordings::base64(std::span<const double>(times)));
    out += '}';
    first = false;
  }
  out += ']';
}

template <class List, class ToJson>
void append_items(std::string& out, const char* name, const List& list, ToJson to_json) {
  ((out += ",\n\"") += name) += "\":[";
  bool first = true;
  for (const auto& item : list) {
    const std::string text = to_json(item);
    if (text.empty()) continue;
    if (!first) out += ",\n";
    out += text;
    first = false;
  }
  out += ']';
}

}  // namespace

std::string page_data(const Recording& recording, const StageDescription& stage) {
  std::map<std::string, std::size_t> node_of;
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) node_of.emplace(recording.nodes[i].name, i);
  std::map<std::string, const NodeDescription*> description_of;
  for (const NodeDescription& node : stage.nodes) description_of.emplace(node.name, &node);

  std::string out = "{\"name\":";
  json::append_string(out, recording.name.empty() ? stage.name : recording.name);
  const std::vector<std::size_t> frames = page_frames(recording);
  std::vector<double> times;
  times.reserve(frames.size());
  for (const std::size_t frame : frames) times.push_back(recording.times[frame]);
  append_quoted(out, "times", recordings::base64(std::span<const double>(times)));
  out += ",\"recordedFrames\":" + std::to_string(recording.times.size());
  append_items(out, "nodes", recording.nodes, [&](const NodeRecord& node) {
    const auto found = description_of.find(node.name);
    return node_json(node, found == description_of.end() ? nullptr : found->second, frames);
  });
  const double from = recording.times.empty() ? 0 : recording.times.front();
  const double until = recording.times.empty() ? 0 : recording.times.back();
  append_items(out, "lanes", recordings::key_lanes(stage, from, until), [&](const recordings::KeyLane& lane) {
    const auto found = node_of.find(lane.node);
    return found == node_of.end() ? std::string() : lane_json(lane, found->second);
  });
  if (!stage.joints.empty())
    append_items(out, "joints", stage.joints,
                 [&](const JointDescription& joint) { return joint_json(recording, joint); });
  append_details(out, recording, frames);
  append_page_graphs(out, recording, frames);
  append_page_particles(out, recording, stage, frames);
  append_items(out, "handoffs", recording.handoffs, handoff_json);
  append_items(out, "events", recording.events, event_json);
  append_jumps(out, recording);
  append_page_meshes(out, stage, node_of);
  return out + "}";
}

}  // namespace tweenfall::page
