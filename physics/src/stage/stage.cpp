#include "stage/stage_data.h"

#include <tweenfall/anim/nearest_name.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tweenfall {

/// The world is simulated to the first step boundary at or after `now`. `before` is the boundary left of it, and what
/// the caller reads lies between the two. A change by the caller goes into `commands` and the step is taken again from
/// `before`, split at the change, so it acts at its exact time and going back finds it again.
struct Stage::Implementation {
  StageDescription description;
  StageState initial;
  StageState before, state;
  std::vector<StageState> splits;     ///< states at the splits between the two
  std::vector<Command> commands;      ///< in order of time
  std::vector<Happening> happenings;  ///< of the current step
  std::size_t told = 0;               ///< how many of them have been
  double now = 0;
  bool telling = false;

  std::vector<StageEvent> events;
  std::vector<HandOff> handoffs;
  std::function<void(const StageEvent&)> event_callback, contact_callback;
  std::function<void(const HandOff&)> handoff_callback;

  explicit Implementation(StageDescription described)
      : description(std::move(described)), initial(initial_state(description)), before(initial), state(initial) {
    take(description.step);
  }

  void take(double step) {
    splits.clear();
    take_step(state, step, commands, splits, happenings);
    std::ranges::stable_sort(happenings, {}, &Happening::time);
  }

  void next_step() {
    before = state;
    happenings.clear();
    told = 0;
    take(description.step);
  }

  /// The current step once more, with the commands as they now are; what was told stays told.
  void retake() {
    state = before;
    happenings.clear();
    take(description.step);
  }

  void tell(bool aloud, double until) {
    struct Telling {
      bool& flag;
      const bool before = std::exchange(flag, true);
      ~Telling() { flag = before; }
    } guard{telling};
    while (told < happenings.size() && happenings[told].time <= until) {
      const Happening happening = happenings[told++];
      now = std::max(now, happening.time);
      if (const auto* handoff = std::get_if<HandOff>(&happening.what)) {
        handoffs.push_back(*handoff);
        const auto callback = handoff_callback;  // a copy: it may put another in its place
        if (aloud && callback) callback(*handoff);
      } else {
        const StageEvent& event = std::get<StageEvent>(happening.what);
        events.push_back(event);
        const auto callback = event.nodes.empty() ? event_callback : contact_callback;
        if (aloud && callback) callback(event);
      }
    }
  }

  void run_to(double target, bool aloud) {
    for (;;) {
      tell(aloud, target);
      if (state.time >= target) break;
      next_step();
    }
    now = std::max(now, target);
  }

  /// Makes a change at exactly `now`. When it cannot be made, nothing has changed.
  void command(std::function<void(StageState&, std::vector<Happening>&)> run) {
    const std::vector<Command> kept = commands;
    // A change made in the past begins another future.
    std::erase_if(commands, [&](const Command& other) { return other.time > now; });
    // What lies at `before` is settled; a change there comes right after it.
    const double time = state.steps > 0 ? std::max(now, std::nextafter(before.time, 1e300)) : now;
    commands.push_back({time, std::move(run)});
    try {
      retake();
    } catch (...) {
      commands = kept;
      retake();
      throw;
    }
    if (!telling) tell(true, time);
  }

  void restart() {
    before = initial;
    state = initial;
    happenings.clear();
    events.clear();
    handoffs.clear();
    told = 0;
    now = 0;
    take(description.step);
  }

  /// The two states between which `now` lies without a split.
  [[nodiscard]] std::pair<const StageState*, const StageState*> around() const {
    if (now >= state.time) return {&state, &state};
    const StageState* from = &before;
    for (const StageState& split : splits) {
      if (split.time > now) return {from, &split};
      from = &split;
    }
    return {from, &state};
  }

  [[nodiscard]] const StageState& current() const { return *around().first; }

  void require(NodeId node) const {
    const StageState& shown = current();
    if (node >= shown.present.size() || !shown.present[node])
      throw std::invalid_argument("node number " + std::to_string(node) + " is not on the stage");
  }

  [[nodiscard]] std::size_t body_index(NodeId node) const {
    require(node);
    const std::size_t body = current().body_of[node];
    if (body == no_body) throw std::invalid_argument("\"" + (*current().nodes)[node].name + "\" has no body");
    return body;
  }
};

Stage::Stage(StageDescription description)
    : implementation_(std::make_unique<Implementation>(std::move(description))) {}
Stage::~Stage() = default;
Stage::Stage(Stage&&) noexcept = default;
Stage& Stage::operator=(Stage&&) noexcept = default;

void Stage::advance(double dt) {
  if (!(dt >= 0) || !std::isfinite(dt))
    throw std::invalid_argument("a stage advances by 0 s or more, not " + std::to_string(dt));
  if (implementation_->telling) throw std::logic_error("a callback cannot advance the stage that called it");
  implementation_->run_to(implementation_->now + dt, true);
}

void Stage::advance_to(double time) {
  if (!(time >= implementation_->now) || !std::isfinite(time))
    throw std::invalid_argument("a stage at " + std::to_string(implementation_->now) + " s cannot advance to " +
                                std::to_string(time) + " s; seek goes back");
  if (implementation_->telling) throw std::logic_error("a callback cannot advance the stage that called it");
  implementation_->run_to(time, true);
}

void Stage::seek(double time) {
  if (!(time >= 0) || !std::isfinite(time))
    throw std::invalid_argument("a stage has no time " + std::to_string(time) + "; times start at 0");
  if (implementation_->telling) throw std::logic_error("a callback cannot seek the stage that called it");
  if (time < implementation_->now) implementation_->restart();
  implementation_->run_to(time, false);
}

double Stage::time() const noexcept {
  return implementation_->now;
}
double Stage::step() const noexcept {
  return implementation_->description.step;
}

NodeId Stage::node(std::string_view name) const {
  const StageState& state = implementation_->current();
  if (const auto found = state.nodes->find(name); found && state.present[*found]) return *found;
  std::vector<std::string> names;
  for (NodeId i = 0; i < state.nodes->size(); ++i)
    if (state.present[i]) names.push_back((*state.nodes)[i].name);
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no node \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

std::span<const Node> Stage::nodes() const noexcept {
  return implementation_->current().nodes->nodes();
}

bool Stage::contains(NodeId node) const noexcept {
  const StageState& state = implementation_->current();
  return node < state.present.size() && state.present[node];
}

bool Stage::has_body(NodeId node) const noexcept {
  return contains(node) && implementation_->current().body_of[node] != no_body;
}

WorldMotion Stage::world(NodeId node) const {
  implementation_->require(node);
  const auto [from, to] = implementation_->around();
  return node_world(*from, *to, node, time());
}

void Stage::world(std::span<WorldMotion> out) const {
  if (out.size() != nodes().size())
    throw std::invalid_argument("the stage has " + std::to_string(nodes().size()) + " nodes; there is room for " +
                                std::to_string(out.size()));
  const auto [from, to] = implementation_->around();
  stage_world(*from, *to, time(), out);
}

Twist Stage::twist(NodeId node) const {
  implementation_->require(node);
  const auto [from, to] = implementation_->around();
  const std::size_t body = from->body_of[node];
  return body == no_body ? node_world(*from, *to, node, time()).motion.twist : body_twist(*from, *to, body, time());
}

Owner Stage::owner(NodeId node) const {
  implementation_->require(node);
  const StageState& state = implementation_->current();
  const StagedBody* body = state.body(node);
  return body ? state.world.owner(body->id) : Owner::keyed;
}

NodeLook Stage::look(NodeId node) const {
  implementation_->require(node);
  const StageState& state = implementation_->current();
  NodeLook look = state.animation->look(node, time());
  if (!look.color && state.colors[node])
    look.color = Sample<Color>{*state.colors[node], Vec4(0, 0, 0, 0), Vec4(0, 0, 0, 0)};
  return look;
}

Vec3 Stage::reaction(NodeId node) const {
  const std::size_t body = implementation_->body_index(node);
  const StageState& state = implementation_->current();
  return state.world.reaction(state.bodies[body].id);
}

Path Stage::path(NodeId node) const {
  implementation_->require(node);
  const StageState& state = implementation_->current();
  if (const StagedBody* body = state.body(node)) return body->path;
  return Path(state.animation, node);
}

const StageDescription& Stage::description() const noexcept {
  return implementation_->description;
}

void Stage::release(NodeId node, const TakeOver& settings) {
  const std::size_t body = implementation_->body_index(node);
  const double step = implementation_->description.step;
  implementation_->command([=](StageState& state, std::vector<Happening>& happenings) {
    change_owner(state, body, Drive::free(), Cause::caller, settings, {}, step, happenings);
  });
}

void Stage::recover(NodeId node, const HandBack& settings) {
  const std::size_t body = implementation_->body_index(node);
  const double step = implementation_->description.step;
  implementation_->command([=](StageState& state, std::vector<Happening>& happenings) {
    change_owner(state, body, Drive::keyed(), Cause::caller, {}, settings, step, happenings);
  });
}

void Stage::arm(Rule rule) {
  implementation_->command(
      [rule = std::move(rule)](StageState& state, std::vector<Happening>&) { arm_rule(state, rule); });
}

NodeId Stage::add(const NodeDescription& node) {
  implementation_->command([node](StageState& state, std::vector<Happening>&) { (void)add_node(state, node); });
  return this->node(node.name);
}

void Stage::remove(NodeId node) {
  implementation_->require(node);
  implementation_->command([node](StageState& state, std::vector<Happening>&) { remove_node(state, node); });
}

void Stage::apply_impulse(NodeId node, const Vec3& impulse, const Vec3& point) {
  const std::size_t body = implementation_->body_index(node);
  implementation_->command([=](StageState& state, std::vector<Happening>&) {
    state.world.apply_impulse(state.bodies[body].id, impulse, point);
  });
}

void Stage::on_event(std::function<void(const StageEvent&)> callback) {
  implementation_->event_callback = std::move(callback);
}
void Stage::on_contact(std::function<void(const StageEvent&)> callback) {
  implementation_->contact_callback = std::move(callback);
}
void Stage::on_handoff(std::function<void(const HandOff&)> callback) {
  implementation_->handoff_callback = std::move(callback);
}

std::span<const HandOff> Stage::handoffs() const noexcept {
  return implementation_->handoffs;
}
std::span<const StageEvent> Stage::events() const noexcept {
  return implementation_->events;
}

std::uint64_t Stage::state_hash() const noexcept {
  return implementation_->state.world.state_hash();
}

}  // namespace tweenfall
