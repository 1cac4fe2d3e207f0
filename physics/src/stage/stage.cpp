#include <tweenfall/anim/graph_player.h>
#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/strategies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "stage/actors/energy.h"
#include "stage/actors/particles.h"
#include "stage/actors/vehicles.h"
#include "stage/roster/staged_softs.h"
#include "stage/rules/played_tracks.h"
#include "stage/rules/ramps.h"
#include "stage/saving/stage_hash.h"
#include "stage/stage_implementation.h"

namespace tweenfall {

namespace staging {

/// A call that would take more steps than this counts as a mistake: it would seem never to end.
constexpr double most_steps = 2e7;

void require_reachable(double from, double to, double step) {
  const double steps = (to - from) / step;
  if (steps <= most_steps) return;
  throw std::invalid_argument("from " + number_text(from) + " s to " + number_text(to) + " s a stage takes " +
                              number_text(steps) + " steps of " + number_text(step) +
                              " s; one call takes 20 million at most");
}

}  // namespace staging

NodeNotFinite::NodeNotFinite(NodeId which, const std::string& name, const NotFinite& fault)
    : NotFinite(fault, "the motion of \"" + name + "\" is no longer finite at " + number_text(fault.time) +
                           " s: " + fault.cause),
      node(which) {}

Stage::Stage(StageDescription description)
    : implementation_(std::make_shared<Implementation>(std::move(description))) {}
Stage::~Stage() {
  if (implementation_) implementation_->abandoned = true;
}
Stage::Stage(Stage&&) noexcept = default;
Stage& Stage::operator=(Stage&& other) noexcept {
  if (this == &other) return *this;
  if (implementation_) implementation_->abandoned = true;
  implementation_ = std::move(other.implementation_);
  return *this;
}

Stage::Implementation& Stage::inside() const {
  if (!implementation_) throw std::logic_error("a stage that was moved from can only be assigned to or destroyed");
  return *implementation_;
}

void Stage::advance(double dt) {
  if (!(dt >= 0) || !std::isfinite(dt))
    throw std::invalid_argument("a stage advances by 0 s or more, not " + number_text(dt));
  advance_to(inside().now() + dt);
}

void Stage::advance_to(double time) {
  const std::shared_ptr<Implementation> held = implementation_;  // a callback may destroy the stage
  Implementation& timeline = inside();
  if (!(time >= timeline.now()) || !std::isfinite(time))
    throw std::invalid_argument("a stage at " + number_text(timeline.now()) + " s cannot advance to " +
                                number_text(time) + " s; seek goes back");
  timeline.require_not_telling("advance");
  staging::require_reachable(timeline.now(), time, timeline.description.step);
  timeline.run_to(time, true);
}

void Stage::seek(double time) {
  const std::shared_ptr<Implementation> held = implementation_;
  Implementation& timeline = inside();
  if (!(time >= 0) || !std::isfinite(time))
    throw std::invalid_argument("a stage has no time " + number_text(time) + "; times start at 0");
  timeline.require_not_telling("seek");
  const bool back = time < timeline.now();
  staging::require_reachable(back ? 0 : timeline.now(), time, timeline.description.step);
  if (back) timeline.restart();
  timeline.run_to(time, false);
}

double Stage::time() const noexcept {
  return implementation_ ? implementation_->now() : 0;
}
double Stage::step() const noexcept {
  return implementation_ ? implementation_->description.step : 0;
}

NodeId Stage::node(std::string_view name) const {
  const staging::StageState& state = inside().current();
  if (const auto found = state.nodes->find(name); found && state.present[*found]) return *found;
  std::vector<std::string> names;
  for (NodeId i = 0; i < state.nodes->size(); ++i)
    if (state.present[i]) names.push_back((*state.nodes)[i].name);
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no node \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

std::span<const Node> Stage::nodes() const noexcept {
  if (!implementation_) return {};
  return implementation_->current().nodes->nodes();
}

bool Stage::contains(NodeId node) const noexcept {
  if (!implementation_) return false;
  const staging::StageState& state = implementation_->current();
  return node < state.present.size() && state.present[node];
}

bool Stage::has_body(NodeId node) const noexcept {
  return contains(node) && implementation_->current().body_of[node] != staging::no_body;
}

WorldMotion Stage::world(NodeId node) const {
  const auto [from, to] = inside().around();
  staging::require_node(*from, node);
  return staging::node_world(*from, *to, node, time());
}

void Stage::world(std::span<WorldMotion> out) const {
  const auto [from, to] = inside().around();
  if (out.size() != nodes().size())
    throw std::invalid_argument("the stage has " + std::to_string(nodes().size()) + " nodes; there is room for " +
                                std::to_string(out.size()));
  staging::stage_world(*from, *to, time(), out);
}

Twist Stage::twist(NodeId node) const {
  const auto [from, to] = inside().around();
  staging::require_node(*from, node);
  const std::size_t body = from->body_of[node];
  return body == staging::no_body ? staging::node_world(*from, *to, node, time()).motion.twist
                                  : staging::body_twist(*from, *to, body, time());
}

Owner Stage::owner(NodeId node) const {
  const staging::StageState& state = inside().current();
  staging::require_node(state, node);
  const staging::StagedBody* body = state.body(node);
  return body ? state.world.owner(body->id) : Owner::keyed;
}

Drive Stage::drive(NodeId node) const {
  const staging::StageState& state = inside().current();
  staging::require_node(state, node);
  const staging::StagedBody* body = state.body(node);
  if (!body) return Drive::keyed();
  return body->ramp ? staging::drive_on(*body->ramp, time()) : state.world.drive(body->id);
}

NodeLook Stage::look(NodeId node) const {
  const staging::StageState& state = inside().current();
  staging::require_node(state, node);
  NodeLook look = state.animation->look(node, time());
  if (!look.color && state.colors[node])
    look.color = Sample<Color>{*state.colors[node], Vec4(0, 0, 0, 0), Vec4(0, 0, 0, 0)};
  return look;
}

std::vector<std::string> Stage::user_tracks() const {
  std::vector<std::string> names = inside().current().animation->user_tracks();
  std::erase_if(names, staging::drives_a_body);
  return names;
}

UserValue Stage::user_value(std::string_view track) const {
  return inside().current().animation->user_value(track, time());
}

Vec3 Stage::reaction(NodeId node) const {
  const staging::StageState& state = inside().current();
  return state.world.reaction(state.bodies[staging::body_index(state, node)].id);
}

Path Stage::path(NodeId node) const {
  const staging::StageState& state = inside().current();
  staging::require_node(state, node);
  if (const staging::StagedBody* body = state.body(node)) return body->path;
  return Path(state.animation, node);
}

std::optional<JointReading> Stage::joint(std::string_view name) const {
  return staging::joint_reading(inside().current(), name);
}

std::vector<JointEnds> Stage::joints() const {
  const staging::StageState& state = inside().current();
  std::vector<JointEnds> joints;
  joints.reserve(state.joints->list.size());
  for (const staging::StagedJoint& joint : state.joints->list) joints.push_back({joint.name, joint.a, joint.b});
  return joints;
}

StageEnergy Stage::energy() const {
  const auto [from, to] = inside().around();
  return staging::stage_energy(*from, *to, time());
}

std::optional<double> Stage::complementarity() const {
  if (inside().description.world.solver != ContactSolver::lcp) return std::nullopt;
  return inside().current().complementarity;
}

std::vector<StageWheel> Stage::vehicle(std::string_view name) const {
  const auto [from, to] = inside().around();
  return staging::vehicle_wheels(*from, *to, name, time());
}

StageParticles Stage::particles(std::string_view name) const {
  const auto [from, to] = inside().around();
  return staging::stage_particles(*from, *to, name, time());
}

SoftNodes Stage::soft(std::string_view name) const {
  const auto [from, to] = inside().around();
  return staging::soft_nodes(*from, *to, name, time());
}

const StageDescription& Stage::description() const {
  return inside().description;
}

namespace {

/// The nearest angle that a number of degrees gives as documents read it: some doubles between are given by none. So a
/// file of what was asked for says all of it.
double angle_in_degrees(double angle) {
  constexpr double one = std::numbers::pi / 180, infinity = std::numeric_limits<double>::infinity();
  const double near = angle / one, least = std::nextafter(near, -infinity), most = std::nextafter(near, infinity);
  double best = near * one;
  for (const double degrees : {least, most})
    if (std::abs(degrees * one - angle) < std::abs(best - angle)) best = degrees * one;
  return std::isfinite(best) ? best : angle;
}

TakeOver in_degrees(TakeOver settings) {
  for (double& angle : settings.add.angular) angle = angle_in_degrees(angle);
  return settings;
}

}  // namespace

void Stage::release(NodeId node, const TakeOver& settings) {
  inside().command(staging::change::Release{node, in_degrees(settings)});
}

void Stage::recover(NodeId node, const HandBack& settings) {
  inside().command(staging::change::Recover{node, settings});
}

void Stage::hand_over(NodeId node, const OwnerChange& change) {
  OwnerChange asked = change;
  asked.take_over = in_degrees(asked.take_over);
  inside().command(staging::change::HandOver{node, asked});
}

void Stage::ask(std::string_view play, PlayAction action) {
  // How a play is to begin that there is not yet: what is kept says its clip, so that it does not depend on the others.
  if (auto* start = std::get_if<playing::Start>(&action);
      start && start->clip.empty() && !(*start == playing::Start{})) {
    const Animation& animation = *inside().current().animation;
    const bool is_there = std::ranges::any_of(animation.players(), [&](const Player& player) {
      const std::string& name = player.play().name;
      return (name.empty() ? animation.clips()[player.play().clip].name : name) == play;
    });
    if (!is_there) start->clip = play;
  }
  inside().command(staging::change::Ask{std::string(play), std::move(action)});
}

void Stage::set(std::string_view graph, std::string_view parameter, double value) {
  inside().command(staging::change::Tell{std::string(graph), std::string(parameter), value});
}

void Stage::send(std::string_view graph, std::string_view event) {
  inside().command(staging::change::Tell{std::string(graph), std::string(event), std::nullopt});
}

void Stage::control(std::string_view vehicle, const VehicleControl& control) {
  inside().command(staging::change::Control{std::string(vehicle), control});
}

GraphPlayer Stage::graph(std::string_view name) const {
  return inside().current().animation->graph(name, time());
}

std::vector<TimedInput> Stage::inputs() const {
  return inside().inputs();
}

void Stage::give(const Input& input) {
  struct Giver {
    Stage& stage;
    void operator()(const input::Ask& ask) const { stage.ask(ask.play, ask.action); }
    void operator()(const input::Release& release) const { stage.release(stage.node(release.body), release.settings); }
    void operator()(const input::Recover& recover) const { stage.recover(stage.node(recover.body), recover.settings); }
    void operator()(const input::HandOver& handed) const { stage.hand_over(stage.node(handed.body), handed.change); }
    void operator()(const input::Push& push) const {
      stage.apply_impulse(stage.node(push.body), push.impulse, push.point);
    }
    void operator()(const input::Set& set) const { stage.set(set.graph, set.parameter, set.value); }
    void operator()(const input::Send& send) const { stage.send(send.graph, send.event); }
    void operator()(const input::Control& told) const { stage.control(told.vehicle, told.control); }
  };
  std::visit(Giver{*this}, input);
}

void Stage::give(const TimedInput& input) {
  const std::shared_ptr<Implementation> held = implementation_;
  advance_to(input.time);
  if (!held->abandoned) held->pass_blows(input.after_blows);
  if (!held->abandoned) give(input.what);
}

void Stage::arm(Rule rule) {
  inside().command(staging::change::Arm{std::move(rule)});
}

NodeId Stage::add(const NodeDescription& node) {
  inside().command(staging::change::Add{node});
  return this->node(node.name);
}

void Stage::remove(NodeId node) {
  inside().command(staging::change::Remove{node});
}

void Stage::apply_impulse(NodeId node, const Vec3& impulse, const Vec3& point) {
  inside().command(staging::change::Push{node, impulse, point});
}

void Stage::add_joint(const JointDescription& joint) {
  inside().command(staging::change::Join{joint});
}

void Stage::remove_joint(std::string_view name) {
  inside().command(staging::change::Part{std::string(name)});
}

void Stage::ignore(NodeId a, NodeId b) {
  inside().command(staging::change::Ignore{a, b, true});
}

void Stage::collide(NodeId a, NodeId b) {
  inside().command(staging::change::Ignore{a, b, false});
}

bool Stage::collides(NodeId a, NodeId b) const {
  const staging::StageState& state = inside().current();
  return state.world.collides(state.bodies[staging::body_index(state, a)].id,
                              state.bodies[staging::body_index(state, b)].id);
}

void Stage::on_event(std::function<void(const StageEvent&)> callback) {
  inside().on_event = std::move(callback);
}
void Stage::on_contact(std::function<void(const StageEvent&)> callback) {
  inside().on_contact = std::move(callback);
}
void Stage::on_handoff(std::function<void(const HandOff&)> callback) {
  inside().on_handoff = std::move(callback);
}

std::span<const HandOff> Stage::handoffs() const noexcept {
  if (!implementation_) return {};
  return implementation_->handoffs;
}
std::span<const StageEvent> Stage::events() const noexcept {
  if (!implementation_) return {};
  return implementation_->events;
}

std::vector<UnfiredRule> Stage::unfired_rules() const {
  return staging::unfired_rules(inside().current());
}

std::vector<std::byte> Stage::save() const {
  return inside().save();
}

void Stage::load(std::span<const std::byte> saved) {
  inside().load(saved);
}

std::uint64_t Stage::state_hash() const noexcept {
  return implementation_ ? staging::stage_hash(implementation_->ahead()) : 0;
}

}  // namespace tweenfall
