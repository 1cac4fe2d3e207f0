#pragma once

// Engine-neutral scenes: meters, kilograms, Y up, quaternions x, y, z, w; a capsule lies along its local y.

#include <tweenfall/physics/world.h>

#include <optional>
#include <string>

#include "support.h"

namespace tweenfall::test {

/// A scene's world before its first step.
struct Scene {
  nlohmann::json file;
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

inline Vec3 vector_from(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// Joints are not read.
inline Scene scene_from(const nlohmann::json& json) {
  const std::string name = json.at("name");
  WorldSettings settings;
  settings.gravity = vector_from(json.at("gravity"));
  settings.sleep_after = std::numeric_limits<double>::infinity();
  Scene scene{json, World(settings), json.at("dt").get<double>(), json.at("steps").get<int>(), {}, {}, {0, 0, 0}};
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
    } else if (type == "hull") {
      std::vector<Vec3> points;
      for (const auto& point : shape.at("points")) points.push_back(vector_from(point));
      entry.shape.solid = Hull{ConvexHull(points)};
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
    entry.restitution = body.value("restitution", 0.0);
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

/// The scenes whose names begin so, of tests/data and of the scenes folder; said loudly when that one is absent.
inline std::vector<Scene> scenes(const std::string& beginning) {
  std::vector<std::filesystem::path> found;
  for (const auto& folder : {data_folder() / "scenes", scenes_folder()}) {
    if (!std::filesystem::is_directory(folder)) {
      MESSAGE("SKIPPED: scenes " << beginning << "..., no folder " << folder.string());
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".json" && entry.path().filename().string().rfind(beginning, 0) == 0)
        found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  CHECK_MESSAGE(!found.empty(), "no scene " << beginning << "... anywhere");
  std::vector<Scene> result;
  for (const auto& path : found) result.push_back(scene_from(read_json(path)));
  return result;
}

}  // namespace tweenfall::test
