#include "gltf/physics/read_physics.h"
#include "gltf/physics/written_physics.h"

#include <algorithm>

namespace tweenfall::gltf::physics {

Fields physics_of(const Fields& root, std::size_t node) {
  return root.at("nodes", node).inside("extensions").inside(bodies_extension);
}

std::optional<double> number_of(const Fields& fields, const char* name) {
  const json::Value value = fields.find(name);
  if (!value) return std::nullopt;
  if (value.is(json::Value::Kind::number)) return value.number();
  fields.problems().add(fields.place_of(name), "must be a finite number");
  return std::nullopt;
}

Vec3 vector_of(const Fields& fields, const char* name, const Vec3& otherwise) {
  const std::vector<double> numbers = fields.numbers(name, 3);
  return numbers.empty() ? otherwise : Vec3(numbers[0], numbers[1], numbers[2]);
}

std::vector<std::size_t> movers(const FileScene& scene) {
  std::vector<std::size_t> mover(scene.nodes.size(), no_node);
  for (const std::size_t i : parents_first({scene.nodes.begin(), scene.nodes.end()})) {
    const std::size_t parent = scene.nodes[i].node.parent;
    if (physics_of(scene.root, i).has("motion"))
      mover[i] = i;
    else if (parent != no_node)
      mover[i] = mover[parent];
  }
  return mover;
}

Pose pose_within(const FileScene& scene, std::size_t node, std::size_t ancestor) {
  std::vector<std::size_t> chain;
  for (std::size_t i = node; i != ancestor && i != no_node; i = scene.nodes[i].node.parent) chain.push_back(i);
  Pose pose;
  for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
    pose = compose(pose, scene.nodes[*i].node.rest);
    pose.rotation.normalize();
  }
  return pose;
}

}  // namespace tweenfall::gltf::physics
