#include "fbx/nodes.h"

#include "model/model_names.h"

#include <algorithm>
#include <tuple>

namespace tweenfall::fbx {

namespace {

Inherit inherit_of(std::int64_t type) {
  return type == 0 ? Inherit::factors : type == 2 ? Inherit::none : Inherit::normal;
}

/// MotionBuilder's own view cameras are not part of the scene.
bool is_producer(const Object& object) {
  return object.name.starts_with("Producer ") || object.name == "Camera Switcher";
}

}  // namespace

Nodes::Nodes(const Objects& objects, models::ModelProblems& problems) : objects_(objects) {
  find_models(problems);
  make_nodes();
}

void Nodes::find_models(models::ModelProblems& problems) {
  std::vector<std::size_t> models, parent(objects_.all().size(), no_node);
  for (std::size_t i = 0; i < objects_.all().size(); ++i) {
    if (objects_[i].kind != "Model") continue;
    const std::vector<std::size_t> above = objects_.above(i, "Model");
    if (above.empty() && is_producer(objects_[i])) continue;
    models.push_back(i);
    if (!above.empty() && above[0] != i) parent[i] = above[0];
  }
  std::vector<std::vector<std::size_t>> children(objects_.all().size());
  for (const std::size_t model : models)
    if (parent[model] != no_node) children[parent[model]].push_back(model);
  std::vector<std::size_t> depth(objects_.all().size(), no_node);
  const auto reach = [&](std::size_t root) {
    std::vector<std::size_t> waiting{root};
    depth[root] = 0;
    while (!waiting.empty()) {
      const std::size_t at = waiting.back();
      waiting.pop_back();
      for (const std::size_t child : children[at]) {
        if (depth[child] != no_node) continue;
        depth[child] = depth[at] + 1;
        waiting.push_back(child);
      }
    }
  };
  for (const std::size_t model : models)
    if (parent[model] == no_node) reach(model);
  for (const std::size_t model : models) {
    if (depth[model] != no_node) continue;
    problems.repair("node \"" + objects_[model].name + "\"",
                    "is below nodes that are parents of each other; it was put below the scene");
    parent[model] = no_node;
    reach(model);
  }
  std::ranges::sort(models, [&](std::size_t a, std::size_t b) {
    return std::tuple(depth[a], parent[a], a) < std::tuple(depth[b], parent[b], b);
  });
  for (const std::size_t model : models) {
    by_object_[model] = files_.size();
    const std::size_t above = parent[model] == no_node ? no_node : by_object_.at(parent[model]);
    files_.push_back({model, above, inherit_of(objects_.whole(objects_[model], "InheritType", 1)), no_node, no_node});
  }
}

void Nodes::make_nodes() {
  std::vector<bool> split(files_.size(), false);
  for (const FileNode& file : files_)
    if (file.parent != no_node && file.inherit != Inherit::normal) split[file.parent] = true;
  models::UniqueNames names;
  std::vector<std::string> own;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const std::string& name = objects_[files_[i].object].name;
    own.push_back(names.unique(name.empty() ? "node_" + std::to_string(i) : name));
  }
  const std::vector<Placed> rest = placed(nullptr);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    FileNode& file = files_[i];
    const Placement& at = rest[i].placement;
    const bool through_frame = file.inherit != Inherit::normal;
    Node node;
    node.name = own[i];
    if (file.parent != no_node) node.parent = through_frame ? files_[file.parent].frame : files_[file.parent].node;
    node.rest = {at.position.curve.value(0), at.rotation.curve.value(0), at.scale.curve.value(0)};
    if (split[i]) {
      Node frame = node;
      frame.name = names.unique(own[i] + " (unscaled)");
      frame.rest.scale = Vec3(1, 1, 1);
      file.frame = nodes_.size();
      nodes_.push_back(std::move(frame));
      node.parent = file.frame;
      node.rest = {{0, 0, 0}, Quat::Identity(), node.rest.scale};
    }
    file.node = nodes_.size();
    if (!split[i]) file.frame = file.node;
    nodes_.push_back(std::move(node));
  }
}

// A node that does not inherit its parent's scale is attached to its parent's frame: the parent's scale still applies
// to its position, and its own scale is multiplied by the factors that it inherits.
std::vector<Nodes::Placed> Nodes::placed(const Stack* stack) const {
  const Channel<Vec3> one{Curve<Vec3>(Vec3(1, 1, 1)), false};
  std::vector<Placed> all;
  // The node from which each inherits factors: an earlier node, or none.
  std::vector<std::size_t> from(files_.size(), no_node);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const FileNode& file = files_[i];
    Placement own = placement(objects_, file.object, stack);
    if (file.inherit == Inherit::factors) from[i] = file.parent;
    if (file.inherit == Inherit::none && file.parent != no_node) from[i] = from[file.parent];
    if (file.inherit != Inherit::normal) {
      if (file.parent != no_node) own.position = product(all[file.parent].passed_on, own.position);
      if (from[i] != no_node) own.scale = product(all[from[i]].passed_on, own.scale);
    }
    const Channel<Vec3> passed_on = own.scale;
    all.push_back({std::move(own), passed_on});
  }
  return all;
}

std::size_t Nodes::of(std::size_t object) const {
  const auto found = by_object_.find(object);
  return found == by_object_.end() ? no_node : files_[found->second].node;
}

WorldMotion Nodes::at_rest(std::size_t object) const {
  std::vector<std::size_t> chain;
  for (std::size_t at = of(object); at != no_node; at = nodes_[at].parent) chain.push_back(at);
  WorldMotion world;
  for (std::size_t left = chain.size(); left > 0; --left)
    world = child_of(world, Motion{nodes_[chain[left - 1]].rest, {}, {0, 0, 0}});
  return world;
}

std::vector<Track> Nodes::tracks(const Stack& stack) const {
  std::vector<Track> tracks;
  const std::vector<Placed> moving = placed(&stack);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const Placement& at = moving[i].placement;
    const std::string &frame = nodes_[files_[i].frame].name, &node = nodes_[files_[i].node].name;
    if (at.position.driven) tracks.push_back({frame, "position", at.position.curve});
    if (at.rotation.driven) tracks.push_back({frame, "rotation", at.rotation.curve});
    if (at.scale.driven) tracks.push_back({node, "scale", at.scale.curve});
  }
  return tracks;
}

}  // namespace tweenfall::fbx
