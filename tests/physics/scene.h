#pragma once

// Engine-neutral scenes: meters, kilograms, Y up, quaternions x, y, z, w; a capsule lies along its local y.

#include <tweenfall/physics/world.h>

#include <optional>
#include <string>

#include "support.h"

namespace tweenfall::test {

/// A scene's world before its first step.
struct Scene {
  World world;
  double dt = 0;
  int steps = 0;
  std::vector<BodyId> bodies;  ///< in the file's order
  std::optional<BodyId> pushed;
  Vec3 push{0, 0, 0};  ///< N, on `pushed`, every step

  void step() {
    if (pushed) world.apply_force(*pushed, push, world.motion(*pushed).pose.position);
    world.step(dt);
  }
};

/// TWEENFALL_SCENES, or ../shared/scenes.
inline std::filesystem::path scenes_folder() {
  return detail::folder("TWEENFALL_SCENES", "../shared/scenes");
}

inline Vec3 vector_from(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// Nothing, said loudly, when the file is absent. Joints and hulls are not read.
inline std::optional<Scene> load_scene(const std::string& name, double restitution_scale = 1) {
  std::filesystem::path file = data_folder() / "scenes" / (name + ".json");
  if (!std::filesystem::exists(file)) file = scenes_folder() / (name + ".json");
  if (!std::filesystem::exists(file)) {
    MESSAGE("SKIPPED: scene " << name << ", no file " << file.string());
    return std::nullopt;
  }
  const nlohmann::json json = read_json(file);
  WorldSettings settings;
  settings.gravity = vector_from(json.at("gravity"));
  settings.sleep_after = std::numeric_limits<double>::infinity();
  Scene scene{World(settings), json.at("dt").get<double>(), json.at("steps").get<int>(), {}, {}, {0, 0, 0}};
  const bool multiply = json.value("friction_combine", "") == "multiply";
  for (const auto& body : json.at("bodies")) {
    const auto& shape = json.at("shapes").at(body.at("shape").get<std::size_t>());
    BodySettings entry;
    const std::string type = shape.at("type");
    if (type == "box") {
      entry.shape.solid = Box{vector_from(shape.at("half_extents"))};
    } else if (type == "sphere") {
      entry.shape.solid = Sphere{shape.at("radius").get<double>()};
    } else if (type == "capsule") {
      entry.shape.solid = Capsule{shape.at("radius").get<double>(), shape.at("half_height").get<double>()};
    } else {
      MESSAGE("SKIPPED: a body of scene " << name << " with shape " << type);
      continue;
    }
    entry.motion.pose.position = vector_from(body.at("pos"));
    const auto& turn = body.at("rot");
    entry.motion.pose.rotation = Quat(turn.at(3), turn.at(0), turn.at(1), turn.at(2));
    entry.fixed = body.at("motion") == "static";
    if (body.contains("mass")) entry.mass = body.at("mass").get<double>();
    const double friction = body.value("friction", 0.5);
    // A pair takes the root of the product: of the squares, the product itself.
    entry.friction = multiply ? friction * friction : friction;
    entry.restitution = body.value("restitution", 0.0) * restitution_scale;
    entry.linear_damping = json.value("linear_damping", 0.0);
    entry.angular_damping = json.value("angular_damping", 0.0);
    if (body.contains("linear_velocity")) entry.motion.twist.linear = vector_from(body.at("linear_velocity"));
    if (body.contains("angular_velocity")) entry.motion.twist.angular = vector_from(body.at("angular_velocity"));
    scene.bodies.push_back(scene.world.add(entry));
  }
  if (json.contains("force")) {
    scene.pushed = scene.bodies.at(json.at("force").at("body").get<std::size_t>());
    scene.push = vector_from(json.at("force").at("value"));
  }
  return scene;
}

}  // namespace tweenfall::test
