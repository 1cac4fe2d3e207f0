#pragma once

// Engine-neutral scenes: meters, kilograms, Y up, quaternions x, y, z, w; a capsule lies along its local y.

#include <tweenfall/physics/world.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tweenfall::test {

/// A scene's world before its first step.
struct Scene {
  nlohmann::json file;
  World world;
  double dt = 0;
  int steps = 0;
  std::vector<BodySettings> settings;  ///< in the file's order
  std::vector<BodyId> bodies;          ///< of `settings`
  std::vector<JointSettings> joints;
  std::set<std::string> left_out;  ///< kinds of shapes that no body here can have
  std::optional<BodyId> pushed;
  Vec3 push{0, 0, 0};  ///< N, on `pushed`, every step

  void step() {
    if (pushed) world.apply_force(*pushed, push, world.motion(*pushed).pose.position);
    world.step(dt);
  }
};

inline Vec3 vector_from(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

inline std::optional<Solid> solid_from(const nlohmann::json& shape) {
  const std::string type = shape.at("type");
  if (type == "box") return Box{vector_from(shape.at("half_extents"))};
  if (type == "sphere") return Sphere{shape.at("radius").get<double>()};
  if (type == "capsule") return Capsule{shape.at("radius").get<double>(), shape.at("half_height").get<double>()};
  if (type != "hull") return std::nullopt;
  std::vector<Vec3> points;
  points.reserve(shape.at("points").size());
  for (const auto& point : shape.at("points")) points.push_back(vector_from(point));
  return Hull{ConvexHull(points)};
}

inline Pose frame_from(const nlohmann::json& frame) {
  const auto& turn = frame.at("rot");
  return {vector_from(frame.at("pos")), Quat(turn.at(3), turn.at(0), turn.at(1), turn.at(2)).normalized()};
}

/// Joints are swing-twist joints, the only kind that scenes have.
inline Scene scene_from(const nlohmann::json& json) {
  WorldSettings settings;
  settings.gravity = vector_from(json.at("gravity"));
  settings.sleep_after = std::numeric_limits<double>::infinity();
  Scene scene{json, World(settings), json.at("dt").get<double>(), json.at("steps").get<int>(), {}, {}, {}, {},
              {},   {0, 0, 0}};
  const bool multiply = json.value("friction_combine", "") == "multiply";
  for (const auto& body : json.at("bodies")) {
    const auto& shape = json.at("shapes").at(body.at("shape").get<std::size_t>());
    const std::optional<Solid> solid = solid_from(shape);
    if (!solid) {
      scene.left_out.insert(shape.at("type"));
      continue;
    }
    BodySettings entry;
    entry.shape.solid = *solid;
    entry.motion.pose.position = vector_from(body.at("pos"));
    const auto& turn = body.at("rot");
    entry.motion.pose.rotation = Quat(turn.at(3), turn.at(0), turn.at(1), turn.at(2));
    entry.fixed = body.at("motion") == "static";
    if (body.contains("mass")) entry.mass = body.at("mass").get<double>();
    const double friction = body.value("friction", 0.5);
    // A pair takes the root of the product: of the squares, the product itself.
    entry.friction = multiply ? friction * friction : friction;
    entry.restitution = body.value("restitution", 0.0);
    entry.linear_damping = json.value("linear_damping", 0.0);
    entry.angular_damping = json.value("angular_damping", 0.0);
    if (body.contains("linear_velocity")) entry.motion.twist.linear = vector_from(body.at("linear_velocity"));
    if (body.contains("angular_velocity")) entry.motion.twist.angular = vector_from(body.at("angular_velocity"));
    if (!json.value("collisions", true)) entry.collides_with = 0;
    scene.bodies.push_back(scene.world.add(entry));
    scene.settings.push_back(entry);
  }
  for (const auto& joint : json.value("joints", nlohmann::json::array())) {
    SwingTwistJoint kind;
    kind.swing_y = joint.at("swing_y").get<double>();
    kind.swing_z = joint.at("swing_z").get<double>();
    kind.twist = {joint.at("twist_min").get<double>(), joint.at("twist_max").get<double>()};
    scene.joints.push_back({.a = scene.bodies.at(joint.at("a").get<std::size_t>()),
                            .b = scene.bodies.at(joint.at("b").get<std::size_t>()),
                            .frame_a = frame_from(joint.at("frame_a")),
                            .frame_b = frame_from(joint.at("frame_b")),
                            .kind = kind});
    scene.world.add_joint(scene.joints.back());
  }
  if (json.contains("force")) {
    scene.pushed = scene.bodies.at(json.at("force").at("body").get<std::size_t>());
    scene.push = vector_from(json.at("force").at("value"));
  }
  return scene;
}

}  // namespace tweenfall::test
