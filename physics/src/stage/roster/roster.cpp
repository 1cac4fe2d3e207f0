#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "flat/flat.h"
#include "stage/actors/particles.h"
#include "stage/actors/vehicles.h"
#include "stage/roster/scaled_shape.h"
#include "stage/roster/staged_softs.h"
#include "stage/rules/played_tracks.h"
#include "stage/stage_data.h"
#include "stage/time/leaps.h"
#include "stage/whole_pose.h"
#include "state/checks.h"
#include "state/countable.h"

namespace tweenfall::staging {

namespace {

Motion about_origin(Motion motion, const Twist& at_center, const Vec3& center) {
  const Vec3 arm = motion.pose.rotation * center;
  motion.twist = shifted(at_center, -arm);
  return motion;
}

/// The world's settings for the description's body.
BodySettings settings_of(const StageState& state, NodeId node, const BodyDescription& body, const WorldMotion& start,
                         const Vec3& scale) {
  BodySettings settings{.shape = scaled(body.shape, scale),
                        .mass = body.mass,
                        .density = body.density,
                        .mass_properties = body.mass_properties,
                        .friction = body.friction,
                        .restitution = body.restitution,
                        .friction_combine = body.friction_combine,
                        .restitution_combine = body.restitution_combine,
                        .rolling_friction = body.rolling_friction,
                        .spinning_friction = body.spinning_friction,
                        .surface_velocity = body.surface_velocity,
                        .sensor = body.sensor,
                        .collision = body.collision,
                        .linear_damping = body.linear_damping,
                        .angular_damping = body.angular_damping,
                        .fixed = body.fixed,
                        .groups = body.groups,
                        .collides_with = body.collides_with};
  if (body.mass_properties && scale != Vec3(1, 1, 1))
    throw std::invalid_argument(
        "a varying density and mass properties need a node of scale 1; this one is "
        "scaled, so scale its shape instead");
  settings.drive = body.drive ? *body.drive : state.animation->animates(node) ? Drive::keyed() : Drive::free();
  settings.motion = rigid(start.motion);
  if (!body.twist.linear.allFinite() || !body.twist.angular.allFinite())
    throw std::invalid_argument("velocities must be finite");
  return settings;
}

void forget_gone_rules(StageState& state) {
  if (state.gone_rules == 0) return;
  std::erase_if(state.armed, [](const ArmedRule& armed) { return armed.gone; });
  state.gone_rules = 0;
}

/// What is known of a node from its parents, so that a long chain of them is not climbed again.
struct PlacedNode {
  const WorldMotion& authored;  ///< where the animation has it
  const RestAxes& axes;
};

/// Puts the description's body on its node. If it throws, nothing has changed.
void add_body(StageState& state, NodeId node, const BodyDescription& body, const PlacedNode* placed = nullptr) {
  Path path(state.animation, node, state.time);
  const WorldMotion start = placed ? path.world(state.time, placed->authored) : path.world(state.time);
  const Vec3 scale = rest_scale(placed ? placed->axes : rest_axes(*state.nodes, node));
  const BodySettings settings = settings_of(state, node, body, start, scale);
  const BodyId id = state.world.add(settings);
  if (!body.fixed && settings.drive.owner() == Owner::free)
    state.world.set_motion(id, about_origin(settings.motion, body.twist, state.world.mass(id).center));

  StagedBody staged{.node = node, .id = id, .path = path, .shown = std::make_shared<const WorldMotion>(start)};
  staged.released_at = state.time;
  staged.drive = settings.drive;
  staged.surface = settings.surface_velocity.linear;
  if (state.node_of.size() <= id.index) state.node_of.resize(id.index + 1, no_node);
  state.node_of[id.index] = node;
  if (state.unused.empty()) {
    state.body_of[node] = state.bodies.size();
    state.bodies.push_back(std::move(staged));
    return;
  }
  forget_gone_rules(state);
  state.body_of[node] = state.unused.back();
  state.unused.pop_back();
  state.bodies[state.body_of[node]] = std::move(staged);
}

/// Links the last node to its parent.
void link(StageState& state, NodeId node, NodeId parent) {
  state.first_child.push_back(no_node);
  state.next_sibling.push_back(parent == no_node ? no_node : std::exchange(state.first_child[parent], node));
}

bool names_body(const StageState& state, const StagedBody& body, const std::string& pattern) {
  return body.present && matches(pattern, (*state.nodes)[body.node].name);
}

/// @param bodies  in order
void arm_on(StageState& state, std::size_t rule, const std::vector<std::size_t>& bodies) {
  const auto before = static_cast<std::ptrdiff_t>(state.armed.size());
  for (const std::size_t body : bodies) {
    ArmedRule armed{.body = body, .rule = rule};
    armed.latched.assign(state.rules[rule]->when.triggers.size(), 0);
    state.armed.push_back(std::move(armed));
  }
  std::ranges::inplace_merge(state.armed, state.armed.begin() + before, {},
                             [](const ArmedRule& other) { return std::pair(other.body, other.rule); });
}

void validate(const OwnerChange& change) {
  state::validate(change.to);
  if (!(change.hand_back.settle.seconds > 0) || !std::isfinite(change.hand_back.settle.seconds))
    throw std::invalid_argument("a settle needs a time above 0 s");
  if (!(change.take_over.average_over > 0) || !std::isfinite(change.take_over.average_over))
    throw std::invalid_argument("a velocity is averaged over a time above 0 s");
  const Twist& added = change.take_over.add;
  if (!state::countable(change.take_over.scale) || !state::countable(added.linear) || !state::countable(added.angular))
    throw std::invalid_argument("the scale of a velocity and what is added to it must be finite and at most 1e30");
  if (!(change.take_over.rewind_within >= 0)) throw std::invalid_argument("a rewind needs a time of 0 s or more");
  if (!(change.ramp >= 0) || !std::isfinite(change.ramp))
    throw std::invalid_argument("a ramp takes a time of 0 s or more");
}

/// What is added to a velocity must not lead out of the world's plane.
void require_in_plane(const StageState& state, const OwnerChange& change) {
  flat::require_motion(state.plane, {.twist = change.take_over.add});
}

void require_clip(const StageState& state, const HandBack& hand_back) {
  const auto clips = state.animation->clips();
  if (hand_back.clip.empty() || std::ranges::find(clips, hand_back.clip, &Clip::name) != clips.end()) return;
  throw std::invalid_argument("there is no clip \"" + hand_back.clip + "\" to hand back to");
}

/// Whether the body is led by its path alone at all times.
bool stays_keyed(const OwnerChange& change) {
  return change.to.owner() == Owner::keyed && !(change.ramp > 0);
}

bool has_mass(const StageState& state, const StagedBody& body) {
  return state.world.mass(body.id).mass > 0;
}

void require_mass(const StageState& state, const StagedBody& body) {
  if (!has_mass(state, body))
    throw std::invalid_argument("\"" + (*state.nodes)[body.node].name + "\" is " +
                                kind_name(state.world.shape(body.id).solid) + ", which has no mass: it stays keyed");
}

void validate(const Rule& rule) {
  if (rule.when.triggers.empty()) throw std::invalid_argument("a hand-off rule needs a trigger");
  for (const Trigger& trigger : rule.when.triggers) {
    const auto* at = std::get_if<when::At>(&trigger);
    const auto* hit = std::get_if<when::ContactHit>(&trigger);
    const auto* asleep = std::get_if<when::Asleep>(&trigger);
    const auto* saturated = std::get_if<when::Saturated>(&trigger);
    const auto* error = std::get_if<when::Error>(&trigger);
    if ((at && std::isnan(at->time)) || (hit && (std::isnan(hit->impulse) || std::isnan(hit->speed))) ||
        (asleep && std::isnan(asleep->seconds)) || (saturated && std::isnan(saturated->seconds)) ||
        (error && std::isnan(error->distance)))
      throw std::invalid_argument("a trigger's time, impulse, speed, stillness and distance must be numbers");
  }
  validate(rule.change());
  for (const NextChange& next : rule.then) {
    validate(next.change);
    if (!(next.after >= 0) || !std::isfinite(next.after))
      throw std::invalid_argument("a change comes 0 s or more after the one before it");
  }
}

/// @throws std::invalid_argument for an impossible rest pose
Node checked_node(const NodeDescription& node) {
  Pose rest = node.rest;
  const double turn = rest.rotation.norm();
  if (!rest.position.allFinite() || !rest.scale.allFinite() || !std::isfinite(turn) || !(turn > 0))
    throw std::invalid_argument("the rest pose of \"" + node.name +
                                "\" needs finite numbers and a rotation that can be normalized");
  // Farther out what turns it would make it faster than any number. Of a body the world says so.
  if (!node.body && (!state::countable(rest.position) || !state::countable(rest.scale)))
    throw std::invalid_argument("the rest pose of \"" + node.name + "\" needs numbers of at most 1e30");
  if (node.color && !node.color->rgba.allFinite())
    throw std::invalid_argument("the color of \"" + node.name + "\" needs finite numbers");
  // A unit quaternion stays as it was given, to the bit.
  if (std::abs(turn - 1) > 1e-12) rest.rotation.normalize();
  return {node.name, node.parent, rest, node.color, {}};
}

/// Events are reported step by step, each step's all at once, so their number must be limited.
void require_countable_events(const StageDescription& description) {
  for (const Play& play : description.plays) {
    const Clip& clip = description.clips[play.clip];
    const std::string fault = too_many_events(play, clip, description.step + sliver, most_events_in_step(clip));
    if (!fault.empty()) throw std::invalid_argument(fault);
  }
}

}  // namespace

namespace {

/// Calls `make`; what it throws is a fault of that part.
template <class Make>
bool attempt(std::vector<StageFault>& faults, StageFault::Part part, std::size_t index, const std::string& before,
             const Make& make) {
  try {
    make();
    return true;
  } catch (const std::invalid_argument& fault) {
    faults.push_back({part, index, before + fault.what()});
    return false;
  }
}

Hierarchy nodes_of(const StageDescription& description, std::vector<StageFault>& faults) {
  std::vector<Node> nodes;
  for (const NodeDescription& node : description.nodes)
    if (!attempt(faults, StageFault::Part::node, nodes.size(), "", [&] { nodes.push_back(checked_node(node)); }))
      nodes.push_back({node.name, node.parent, {}, {}, {}});
  for (const MeshInstance& instance : description.mesh_instances) {
    if (instance.node >= nodes.size() || instance.mesh >= description.meshes.size()) continue;
    Node& node = nodes[instance.node];
    const Mesh& mesh = description.meshes[instance.mesh];
    if (!node.color) node.color = mesh.base_color;
    if (node.weights.size() < mesh.rest_weights.size()) node.weights = mesh.rest_weights;
  }
  return Hierarchy(std::move(nodes));
}

void add_described_force(StageState& state, const ForceDescription& described) {
  const auto body_at = [&](std::size_t node, const std::string& what) {
    const StagedBody* body = node < state.body_of.size() ? state.body(node) : nullptr;
    if (!body) throw std::invalid_argument(what + " must be a node with a body");
    return body->id;
  };
  Force force = described.force;
  const auto name_bodies = [&](auto& kind) {
    if constexpr (requires { kind.anchor_a; }) {
      kind.a = body_at(described.a, "an end of a spring");
      kind.b = described.b == no_node ? BodyId{} : body_at(described.b, "an end of a spring");
    } else if constexpr (requires { kind.turns; }) {
      kind.body = body_at(described.a, "what a push acts on");
    } else if constexpr (requires { kind.of; }) {
      kind.of = described.a == no_node ? BodyId{} : body_at(described.a, "what an attractor is on");
    }
  };
  std::visit(name_bodies, force);
  ForceSettings settings{{}, described.strength};
  for (const std::size_t node : described.bodies) settings.bodies.push_back(body_at(node, "what a force acts on"));
  state.forces.push_back(state.world.add_force(std::move(force), std::move(settings)));
}

}  // namespace

StageState described_state(const StageDescription& description, std::vector<StageFault>& faults) {
  using Part = StageFault::Part;
  constexpr double least_step = 1e-6;
  if (!(description.step >= least_step) || !std::isfinite(description.step))
    faults.push_back(
        {Part::step, 0, "the stage's step must be a microsecond or more, not " + number_text(description.step) + " s"});
  StageState state;
  attempt(faults, Part::world, 0, "", [&] { state.world = World(description.world); });
  state.gravity = description.world.gravity;
  state.plane = description.world.plane;
  const bool bound = attempt(faults, Part::clips, 0, "", [&] {
    state.nodes = std::make_shared<const Hierarchy>(nodes_of(description, faults));
    state.animation = std::make_shared<const Animation>(
        Animation(state.nodes, description.clips, description.plays).with_graphs(description.graphs));
    require_countable_events(description);
  });
  if (!bound) return state;
  state.present.assign(state.nodes->size(), 1);
  state.body_of.assign(state.nodes->size(), no_body);
  for (NodeId node = 0; node < state.nodes->size(); ++node) link(state, node, (*state.nodes)[node].parent);
  WholePose pose(state, state.time, Side::out);
  std::vector<RestAxes> axes;
  for (std::size_t node = 0; node < state.nodes->size(); ++node) {
    const Node& its = (*state.nodes)[node];
    axes.push_back(rest_axes_below(its.parent == no_node ? RestAxes() : axes[its.parent], its.rest));
  }
  // No more than there are: what a timeline keeps for good grows with them.
  state.colors.reserve(description.nodes.size());
  state.bodies.reserve(static_cast<std::size_t>(
      std::ranges::count_if(description.nodes, [](const NodeDescription& node) { return node.body.has_value(); })));
  for (NodeId node = 0; node < description.nodes.size(); ++node) {
    const NodeDescription& described = description.nodes[node];
    state.colors.push_back(described.color);
    if (!described.body) continue;
    if (described.body->fixed && state.animation->animates(node)) {
      faults.push_back(
          {Part::node, node,
           "\"" + described.name + "\" is static, but a playing clip moves it; leave out \"static\" and it is keyed"});
      continue;
    }
    attempt(faults, Part::node, node, "the body of \"" + described.name + "\": ", [&] {
      const PlacedNode placed{pose.authored(node), axes[node]};
      add_body(state, node, *described.body, &placed);
    });
  }
  // Forces and rules of bodies that could not be made would only repeat these faults.
  if (!faults.empty()) return state;
  for (std::size_t i = 0; i < description.forces.size(); ++i)
    attempt(faults, Part::force, i, "", [&] { add_described_force(state, description.forces[i]); });
  add_joints(state, description, faults);
  add_softs(state, description, faults);
  add_vehicles(state, description, faults);
  add_particles(state, description, faults);
  for (std::size_t i = 0; i < description.ignored.size(); ++i)
    attempt(faults, Part::ignored, i, "", [&] {
      const auto body = [&](std::size_t node) { return state.bodies[body_index(state, node)].id; };
      state.world.ignore(body(description.ignored[i].first), body(description.ignored[i].second));
    });
  state.leaps = leaps_of(description);
  state.jumps = find_jumps(state);
  start_played_tracks(state);
  for (std::size_t i = 0; i < description.rules.size(); ++i)
    attempt(faults, Part::rule, i, "", [&] { arm_rule(state, description.rules[i]); });
  return state;
}

StageState initial_state(const StageDescription& description) {
  std::vector<StageFault> faults;
  StageState state = described_state(description, faults);
  if (faults.empty()) return state;
  std::string all = faults.front().message;
  if (faults.size() > 1) {
    all = "this makes no stage:";
    for (const StageFault& fault : faults) all += "\n  " + fault.message;
  }
  throw std::invalid_argument(all);
}

void arm_rule(StageState& state, const Rule& rule) {
  validate(rule);
  require_in_plane(state, rule.change());
  require_clip(state, rule.hand_back);
  bool keyed_always = stays_keyed(rule.change());
  for (const NextChange& next : rule.then) {
    require_in_plane(state, next.change);
    require_clip(state, next.change.hand_back);
    keyed_always = keyed_always && stays_keyed(next.change);
  }
  std::vector<std::size_t> meant;
  for (const std::string& pattern : rule.bodies) {
    const bool one = pattern.find('*') == std::string::npos;
    const std::size_t before = meant.size();
    bool any = false;
    const auto take = [&](std::size_t index) {
      const StagedBody& body = state.bodies[index];
      any = true;
      // Of the bodies a pattern names, those that can be taken are taken: static ones, or those without mass, stay as
      // they are.
      if (!one && (state.world.is_fixed(body.id) || (!keyed_always && !has_mass(state, body)))) return;
      meant.push_back(index);
    };
    if (one) {
      const auto node = state.nodes->find(pattern);
      if (node && state.body_of[*node] != no_body) take(state.body_of[*node]);
    } else {
      for (std::size_t body = 0; body < state.bodies.size(); ++body)
        if (names_body(state, state.bodies[body], pattern)) take(body);
    }
    if (!any) throw std::invalid_argument("no node with a body is named \"" + pattern + "\"");
    if (!one && meant.size() == before)
      throw std::invalid_argument("all bodies named \"" + pattern +
                                  "\" are static or without mass: nothing can take them");
  }
  for (const std::size_t index : meant) {
    const StagedBody& body = state.bodies[index];
    const std::string name = "\"" + (*state.nodes)[body.node].name + "\"";
    if (state.world.is_fixed(body.id)) throw std::invalid_argument(name + " is static: nothing can take it over");
    if (!keyed_always) require_mass(state, body);
  }
  std::ranges::sort(meant);
  meant.erase(std::unique(meant.begin(), meant.end()), meant.end());
  state.rules.push_back(std::make_shared<const Rule>(rule));
  arm_on(state, state.rules.size() - 1, meant);
}

void require_possible(const StageState& state, const StagedBody& body, const OwnerChange& change) {
  validate(change);
  require_in_plane(state, change);
  require_clip(state, change.hand_back);
  if (!stays_keyed(change)) require_mass(state, body);
}

namespace {

/// Binds everything that was bound to the old nodes to these.
void rebind(StageState& state, std::shared_ptr<const Hierarchy> nodes) {
  state.animation = std::make_shared<const Animation>(state.animation->with_nodes(nodes));
  state.nodes = std::move(nodes);
  for (StagedBody& body : state.bodies) body.path = body.path.rebound(state.animation);
}

}  // namespace

NodeId add_node(StageState& state, const NodeDescription& node) {
  Node added = checked_node(node);
  if (node.parent != no_node && (node.parent >= state.present.size() || !state.present[node.parent]))
    throw std::invalid_argument("the parent of \"" + node.name + "\" is not on the stage");
  // A removed node keeps its place; its name is free again.
  const std::optional<std::size_t> old = state.nodes->find(node.name);
  const bool again = old && !state.present[*old];
  const auto nodes = std::make_shared<Hierarchy>(*state.nodes);
  const NodeId id = again ? nodes->add_again(std::move(added)) : nodes->add(std::move(added));
  // What is bound to unchanged nodes stays bound; only tracks that name the new one are bound to it.
  const bool named = again && state.animation->has_tracks(*old);
  const std::shared_ptr<const Hierarchy> old_nodes = state.nodes;
  const std::shared_ptr<const Animation> old_animation = state.animation;
  std::vector<Path> old_paths;
  if (named)
    for (const StagedBody& body : state.bodies) old_paths.push_back(body.path);
  try {
    if (named) {
      rebind(state, nodes);
    } else {
      state.animation = std::make_shared<const Animation>(state.animation->with_more_nodes(nodes));
      state.nodes = nodes;
    }
    state.present.push_back(1);
    state.colors.push_back(node.color);
    state.body_of.push_back(no_body);
    if (node.body) add_body(state, id, *node.body);
  } catch (...) {
    state.nodes = old_nodes;
    state.animation = old_animation;
    for (std::size_t i = 0; i < old_paths.size(); ++i) state.bodies[i].path = old_paths[i];
    state.present.resize(id);
    state.colors.resize(id);
    state.body_of.resize(id);
    throw;
  }
  link(state, id, node.parent);
  if (named || (node.body && !node.body->fixed && carries_more(state, id))) state.jumps = find_jumps(state);
  return id;
}

void remove_node(StageState& state, NodeId node) {
  std::vector<NodeId> going = state.below(node, [](NodeId) { return true; });
  going.push_back(node);
  for (const NodeId gone : going) {
    state.present[gone] = 0;
    const std::size_t body = std::exchange(state.body_of[gone], no_body);
    if (body == no_body) continue;
    state.world.remove(state.bodies[body].id);
    state.bodies[body].present = false;
    state.bodies[body].below.reset();
    state.unused.push_back(body);
    const auto last = std::ranges::upper_bound(state.armed, body, {}, &ArmedRule::body);
    for (auto armed = std::ranges::lower_bound(state.armed, body, {}, &ArmedRule::body); armed != last; ++armed) {
      armed->done = armed->gone = true;
      ++state.gone_rules;
    }
  }
  if (2 * state.gone_rules > state.armed.size()) forget_gone_rules(state);
}

}  // namespace tweenfall::staging
