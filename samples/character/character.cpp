#include "character.h"

#include "body.h"
#include "keying.h"
#include "motions.h"
#include "skeleton.h"

namespace tweenfall::character {

namespace {

// "Character" comes first, "Body" second, then the joints in their own order.
constexpr std::size_t root_node = 0, body_node = 1, first_joint_node = 2;

void add_nodes(Model& model) {
  model.nodes.push_back({.name = "Character"});
  // A skinned mesh follows its joints alone, so the body hangs below nothing.
  model.nodes.push_back({.name = "Body"});
  const FigurePose rest = standing();
  for (std::size_t j = 0; j < joint_count; ++j) {
    const Joint joint = static_cast<Joint>(j);
    const std::size_t parent = parent_of(joint);
    model.nodes.push_back({.name = name_of(joint),
                           .parent = parent == joint_count ? root_node : first_joint_node + parent,
                           .rest = {.position = bind_offset(joint), .rotation = rest.turns[j]}});
  }
}

Skin make_skin() {
  Skin skin;
  for (std::size_t j = 0; j < joint_count; ++j) {
    skin.joints.push_back(first_joint_node + j);
    skin.inverse_binds.push_back({Mat3::Identity(), -bind_position(static_cast<Joint>(j))});
  }
  return skin;
}

}  // namespace

Model make_character() {
  Model model;
  model.name = "character";
  add_nodes(model);
  model.meshes.push_back(make_body());
  model.skins.push_back(make_skin());
  model.instances.push_back({.node = body_node, .mesh = 0, .skin = 0});

  constexpr int keys_per_cycle = 20;
  model.clips.push_back(
      keyed_clip({.name = "Walk", .duration = walk_cycle, .spans = keys_per_cycle, .is_cyclic = true}, walk_pose));
  model.clips.push_back(keyed_clip({.name = "WalkForward",
                                    .duration = walk_forward_cycles * walk_cycle,
                                    .spans = walk_forward_cycles * keys_per_cycle,
                                    .is_cyclic = true},
                                   walk_forward_pose));
  model.clips.back().loop.mode = LoopMode::repeat_offset;
  model.clips.push_back(keyed_clip({.name = "Wave", .duration = wave_duration, .spans = 36}, wave_pose));
  model.clips.push_back(keyed_clip({.name = "GetUp", .duration = get_up_duration, .spans = 39}, get_up_pose));
  return model;
}

}  // namespace tweenfall::character
