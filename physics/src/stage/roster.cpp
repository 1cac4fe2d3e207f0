#include "stage/stage_data.h"

#include <cmath>
#include <stdexcept>

namespace tweenfall {

namespace {

Motion about_origin(Motion motion, const Twist& at_center, const Vec3& center) {
  const Vec3 arm = motion.pose.rotation * center;
  motion.twist = shifted(at_center, -arm);
  return motion;
}

/// Puts the description's body on its node.
void add_body(StageState& state, NodeId node, const BodyDescription& body) {
  Path path(state.animation, node, state.time);
  const WorldMotion start = path.world(state.time);
  BodySettings settings{.shape = body.shape,
                        .mass = body.mass,
                        .density = body.density,
                        .friction = body.friction,
                        .restitution = body.restitution,
                        .rolling_friction = body.rolling_friction,
                        .linear_damping = body.linear_damping,
                        .angular_damping = body.angular_damping,
                        .fixed = body.fixed};
  settings.drive = body.drive ? *body.drive : state.animation->animates(node) ? Drive::keyed() : Drive::free();
  settings.motion = start.motion;
  settings.motion.pose.scale = Vec3(1, 1, 1);
  const BodyId id = state.world.add(settings);
  if (!body.fixed && settings.drive.owner() == Owner::free) {
    Motion moving = about_origin(settings.motion, body.twist, state.world.mass(id).center);
    state.world.set_motion(id, moving);
  }

  StagedBody staged{.node = node, .id = id, .path = std::move(path), .shown = start};
  staged.released_at = state.time;
  state.body_of[node] = state.bodies.size();
  if (state.node_of.size() <= id.index) state.node_of.resize(id.index + 1, no_node);
  state.node_of[id.index] = node;
  state.bodies.push_back(std::move(staged));
}

bool names_body(const StageState& state, const StagedBody& body, const std::string& pattern) {
  return body.present && matches(pattern, (*state.nodes)[body.node].name);
}

void arm_on(StageState& state, std::size_t rule, std::size_t body) {
  ArmedRule armed{.body = body, .rule = rule};
  armed.latched.assign(state.rules[rule].when.triggers.size(), 0);
  const auto place = std::ranges::upper_bound(state.armed, std::pair(body, rule), {},
                                              [](const ArmedRule& other) { return std::pair(other.body, other.rule); });
  state.armed.insert(place, std::move(armed));
}

void validate(const Rule& rule) {
  if (rule.when.triggers.empty()) throw std::invalid_argument("a hand-off rule needs a trigger");
  if (rule.to.hz < 0 || std::isnan(rule.to.hz)) throw std::invalid_argument("a drive's hz must be 0 or more");
  if (!(rule.hand_back.settle.seconds > 0) || !std::isfinite(rule.hand_back.settle.seconds))
    throw std::invalid_argument("a settle needs a time above 0 s");
  if (!(rule.take_over.average_over > 0) || !std::isfinite(rule.take_over.average_over))
    throw std::invalid_argument("a velocity is averaged over a time above 0 s");
}

}  // namespace

StageState initial_state(const StageDescription& description) {
  constexpr double least_step = 1e-6;
  if (!(description.step >= least_step) || !std::isfinite(description.step))
    throw std::invalid_argument("the stage's step must be a microsecond or more, not " +
                                std::to_string(description.step) + " s");
  StageState state{.world = World(description.world)};
  std::vector<Node> nodes;
  for (const NodeDescription& node : description.nodes) nodes.push_back({node.name, node.parent, node.rest});
  state.nodes = std::make_shared<const Hierarchy>(std::move(nodes));
  state.animation = std::make_shared<const Animation>(state.nodes, description.clips, description.plays);
  state.jumps = clip_jumps(state.animation->clips());
  state.present.assign(state.nodes->size(), 1);
  state.body_of.assign(state.nodes->size(), no_body);
  for (NodeId node = 0; node < description.nodes.size(); ++node) {
    const NodeDescription& described = description.nodes[node];
    state.colors.push_back(described.color);
    if (!described.body) continue;
    if (described.body->fixed && state.animation->animates(node))
      throw std::invalid_argument("\"" + described.name +
                                  "\" is static, but a playing clip moves it; leave out \"static\" and it is keyed");
    try {
      add_body(state, node, *described.body);
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument("the body of \"" + described.name + "\": " + fault.what());
    }
  }

  for (const ForceDescription& force : description.forces) {
    if (const auto* drag = std::get_if<DragDescription>(&force)) state.world.add_force(drag->drag);
    if (const auto* described = std::get_if<SpringDescription>(&force)) {
      Spring spring = described->spring;
      const StagedBody* a = described->a == no_node ? nullptr : state.body(described->a);
      const StagedBody* b = described->b == no_node ? nullptr : state.body(described->b);
      if (!a || (described->b != no_node && !b))
        throw std::invalid_argument("a spring's ends must be nodes with bodies");
      spring.a = a->id;
      spring.b = b ? b->id : BodyId{};
      state.world.add_force(spring);
    }
  }
  for (const Rule& rule : description.rules) arm_rule(state, rule);
  return state;
}

void arm_rule(StageState& state, const Rule& rule) {
  validate(rule);
  std::vector<std::size_t> meant;
  for (const std::string& pattern : rule.bodies) {
    bool any = false;
    for (std::size_t body = 0; body < state.bodies.size(); ++body)
      if (names_body(state, state.bodies[body], pattern)) {
        any = true;
        if (std::ranges::find(meant, body) == meant.end()) meant.push_back(body);
      }
    if (!any) throw std::invalid_argument("no node with a body is named \"" + pattern + "\"");
  }
  if (rule.to.owner() == Owner::keyed && !rule.hand_back.clip.empty()) {
    const auto clips = state.animation->clips();
    if (std::ranges::find(clips, rule.hand_back.clip, &Clip::name) == clips.end())
      throw std::invalid_argument("there is no clip \"" + rule.hand_back.clip + "\" to hand back to");
  }
  state.rules.push_back(rule);
  for (const std::size_t body : meant) arm_on(state, state.rules.size() - 1, body);
}

namespace {

/// Everything that was bound to the old nodes, bound to the new ones.
void rebind(StageState& state, std::vector<Node> nodes) {
  state.nodes = std::make_shared<const Hierarchy>(std::move(nodes));
  const std::shared_ptr<const Animation> before = state.animation;
  state.animation = std::make_shared<const Animation>(before->with_nodes(state.nodes));
  for (StagedBody& body : state.bodies) {
    if (&body.path.animation() == before.get())
      body.path = body.path.rebound(state.animation);
    else
      body.path = body.path.rebound(std::make_shared<const Animation>(body.path.animation().with_nodes(state.nodes)));
  }
}

}  // namespace

NodeId add_node(StageState& state, const NodeDescription& node) {
  std::vector<Node> nodes(state.nodes->nodes().begin(), state.nodes->nodes().end());
  // A removed node keeps its place; its name is free again.
  for (NodeId old = 0; old < nodes.size(); ++old)
    if (nodes[old].name == node.name && !state.present[old]) nodes[old].name += "#removed" + std::to_string(old);
  if (node.parent != no_node && (node.parent >= nodes.size() || !state.present[node.parent]))
    throw std::invalid_argument("the parent of \"" + node.name + "\" is not on the stage");
  nodes.push_back({node.name, node.parent, node.rest});
  rebind(state, std::move(nodes));
  state.present.push_back(1);
  state.colors.push_back(node.color);
  state.body_of.push_back(no_body);
  const NodeId id = state.present.size() - 1;
  if (node.body) add_body(state, id, *node.body);
  return id;
}

void remove_node(StageState& state, NodeId node) {
  std::vector<char> going(state.present.size(), 0);
  going[node] = 1;
  for (NodeId i = node + 1; i < going.size(); ++i) {
    const std::size_t parent = (*state.nodes)[i].parent;
    if (parent != no_node && going[parent]) going[i] = 1;
  }
  for (NodeId i = node; i < going.size(); ++i) {
    if (!going[i] || !state.present[i]) continue;
    state.present[i] = 0;
    if (state.body_of[i] == no_body) continue;
    const std::size_t gone = state.body_of[i];
    state.world.remove(state.bodies[gone].id);
    state.bodies[gone].present = false;
    state.body_of[i] = no_body;
    std::erase_if(state.armed, [&](const ArmedRule& armed) { return armed.body == gone; });
  }
}

}  // namespace tweenfall
