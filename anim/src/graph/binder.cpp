#include "graph/binder.h"

#include <tweenfall/anim/clip_jumps.h>
#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/number_text.h>

#include "operations/account.h"
#include "operations/remembered.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tweenfall::graphs {

namespace {

constexpr std::size_t deepest = 64;     // nested operations
constexpr double most_evaluated = 1e4;  // operations in the evaluation of one pose

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

std::string nearest_of(const std::string& wrong, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(wrong, names);
  return nearest.empty() ? "" : "; did you mean " + quoted(nearest) + "?";
}

template <class Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

// Index of the first thing of a name; the number of things where there is none.
template <class Things>
std::size_t number_of(const Things& things, const std::string& name) {
  const auto found = std::ranges::find_if(things, [&](const auto& thing) { return thing.name == name; });
  return static_cast<std::size_t>(found - things.begin());
}

}  // namespace

Binder::Binder(const GraphDescription& description, const Hierarchy& nodes, std::span<const Clip> clips)
    : description_(description),
      nodes_(nodes),
      clips_(clips),
      compiled_(std::make_unique<Graph::Compiled>()),
      made_(description.poses.size()) {
  for (std::size_t i = 0; i < description.poses.size(); ++i)
    if (std::holds_alternative<MachinePose>(description.poses[i].operation)) compiled_->machine_poses.push_back(i);
  compiled_->machines.resize(compiled_->machine_poses.size());
  compiled_->moved.resize(nodes.size());
}

void Binder::bind_all() {
  count_askers();
  bind_parameters();
  bind_inputs();
  bind_reactions();
  std::set<std::string> names;
  for (std::size_t i = 0; i < description_.poses.size(); ++i) {
    const std::string& name = description_.poses[i].name;
    if (!names.insert(name).second) fault({"poses", name}, "two poses are named " + quoted(name));
    if (made_[i].stage == Made::Stage::waiting) static_cast<void>(bind_pose(i));
  }
  if (description_.poses.empty()) {
    fault({"poses"}, "a graph has poses; this one has none");
    return;
  }
  const std::size_t shown =
      description_.output.empty() ? made_.size() - 1 : number_of(description_.poses, description_.output);
  if (shown < made_.size())
    compiled_->output = made_[shown].operation;
  else
    fault({"output"}, "there is no pose " + quoted(description_.output) +
                          nearest_of(description_.output, names_of(description_.poses)));
}

void Binder::bind_parameters() {
  std::set<std::string> names;
  for (const GraphParameter& parameter : description_.parameters) {
    const Place place = {"parameters", parameter.name};
    if (!names.insert(parameter.name).second) fault(place, "two parameters are named " + quoted(parameter.name));
    if (!(std::abs(parameter.start) <= largest_parameter)) fault(place, "a parameter starts as a number up to 1e15");
    if (!(parameter.half_life >= 0) || !std::isfinite(parameter.half_life))
      fault({"parameters", parameter.name, "half_life"},
            "a half-life is 0 s or more; it is " + number_text(parameter.half_life) + " s");
    if (parameter.curve && parameter.half_life != 0)
      fault({"parameters", parameter.name, "half_life"}, "a parameter that has keys takes no half-life");
    if (parameter.curve) keep_jumps_of(*parameter.curve);
  }
}

void Binder::bind_inputs() {
  const std::vector<std::string> awaited = events_awaited(description_);
  for (std::size_t i = 0; i < description_.inputs.size(); ++i) {
    const GraphInput& input = description_.inputs[i];
    const Place place = {"inputs", std::to_string(i)};
    if (!(input.time >= 0) || !std::isfinite(input.time))
      fault(place, "an input comes at 0 s or later; this one at " + number_text(input.time) + " s");
    const std::size_t found = number_of(description_.parameters, input.name);
    const bool known = found < description_.parameters.size();
    if (!input.value) {
      if (known)
        fault(place, "the parameter " + quoted(input.name) + " is set to a value; give one");
      else if (std::ranges::find(awaited, input.name) == awaited.end())
        fault(place, "no machine waits for an event " + quoted(input.name) + nearest_of(input.name, awaited));
      continue;
    }
    if (!(std::abs(*input.value) <= largest_parameter)) fault(place, "a parameter is set to a number up to 1e15");
    if (!known)
      fault(place,
            "there is no parameter " + quoted(input.name) + nearest_of(input.name, names_of(description_.parameters)));
    else if (description_.parameters[found].curve)
      fault(place, "the parameter " + quoted(input.name) + " has keys and cannot be set");
  }
}

void Binder::bind_reactions() {
  const std::vector<std::string> awaited = events_awaited(description_);
  for (std::size_t i = 0; i < description_.reactions.size(); ++i) {
    const GraphReaction& reaction = description_.reactions[i];
    const Place place = {"on", std::to_string(i)};
    if (reaction.event.empty()) fault(place, "an event has a name");
    const std::size_t found = number_of(description_.parameters, reaction.name);
    const bool known = found < description_.parameters.size();
    compiled_->reacting.push_back(reaction.value && known ? std::optional(found) : std::nullopt);
    if (!reaction.value) {
      if (known)
        fault(place, "the parameter " + quoted(reaction.name) + " is set to a value; give one");
      else if (std::ranges::find(awaited, reaction.name) == awaited.end())
        fault(place, "no machine waits for an event " + quoted(reaction.name) + nearest_of(reaction.name, awaited));
      continue;
    }
    if (!(std::abs(*reaction.value) <= largest_parameter)) fault(place, "a parameter is set to a number up to 1e15");
    if (!known)
      fault(place, "there is no parameter " + quoted(reaction.name) +
                       nearest_of(reaction.name, names_of(description_.parameters)));
    else if (description_.parameters[found].curve)
      fault(place, "the parameter " + quoted(reaction.name) + " has keys and cannot be set");
  }
}

void Binder::keep_jumps_of(const Curve<double>& curve) {
  const std::span<const double> knots = curve.knots();
  if (!knots.empty() && std::isfinite(first_jump(curve, knots.front() - 1, knots.back() + 1 + curve.duration())))
    compiled_->jumping.push_back(curve);
}

const Operation* Binder::bind_pose(std::size_t index) {
  Made& made = made_[index];
  made.stage = Made::Stage::making;
  made.depth = 1;
  made.size = 1;
  making_.push_back(index);
  std::unique_ptr<Operation> operation =
      std::visit([&](const auto& described) { return bound(described, *this); }, description_.poses[index].operation);
  if (operation) operation->set_rooms(operation->rooms() + made.rooms);
  if (operation && made.depth > deepest) {
    fault({}, "poses are nested more than " + std::to_string(deepest) + " deep here");
    operation.reset();
  }
  if (operation && made.size > most_evaluated) {
    fault({},
          "this pose comes to " + brief_text(made.size) + " operations, because it uses other poses again and again");
    operation.reset();
  }
  making_.pop_back();
  made.stage = Made::Stage::made;
  if (!operation) return nullptr;
  made.operation = add(std::move(operation));
  for (std::size_t m = 0; m < compiled_->machines.size(); ++m)
    if (compiled_->machine_poses[m] == index) compiled_->machines[m] = made.operation;
  return made.operation;
}

const Operation* Binder::add(std::unique_ptr<Operation> operation) {
  compiled_->operations.push_back(std::move(operation));
  return compiled_->operations.back().get();
}

const Operation* Binder::pose(const std::string& name, const Place& place) {
  Made& outer = made_[making_.back()];
  const std::size_t index = number_of(description_.poses, name);
  if (index == made_.size()) {
    const std::size_t clip_index = number_of(clips_, name);
    if (clip_index == clips_.size()) {
      std::vector<std::string> names = names_of(description_.poses);
      for (const Clip& each : clips_) names.push_back(each.name);
      fault(place, "there is no pose or clip " + quoted(name) + nearest_of(name, names));
      return nullptr;
    }
    outer.size += 1;
    outer.depth = std::max<std::size_t>(outer.depth, 2);
    return seen(bind_clip(clip_index), name);
  }
  if (made_[index].stage == Made::Stage::making) {
    std::string way;
    for (auto at = std::ranges::find(making_, index); at != making_.end(); ++at)
      way += quoted(description_.poses[*at].name) + " -> ";
    fault(place, "poses go around in a circle: " + way + quoted(name));
    return nullptr;
  }
  const Operation* found = made_[index].stage == Made::Stage::waiting ? bind_pose(index) : made_[index].operation;
  if (!found) return nullptr;
  outer.size += made_[index].size;
  outer.depth = std::max(outer.depth, made_[index].depth + 1);
  outer.rooms = std::max(outer.rooms, found->rooms());
  return seen(found, name);
}

const Operation* Binder::bind_clip(std::size_t index) {
  const Operation*& played = played_[index];
  if (!played)
    if (std::unique_ptr<Operation> operation = bound(ClipPose{.clip = clips_[index].name}, *this))
      played = add(std::move(operation));
  return played;
}

// Counts how often each pose is used. Springs, and chains that follow, sample a pose at every point of their grid, and
// at the next.
void Binder::count_askers() {
  for (const GraphPose& pose : description_.poses) {
    const auto* reach = std::get_if<ReachPose>(&pose.operation);
    const bool often = std::holds_alternative<SpringPose>(pose.operation) ||
                       std::holds_alternative<JigglePose>(pose.operation) || (reach && reach->follows);
    for (const GraphOperand& operand : operands_of(pose.operation)) askers_[operand.pose] += often ? 2 : 1;
  }
}

const Operation* Binder::seen(const Operation* operation, const std::string& name) {
  if (!operation || askers_[name] < 2) return operation;
  const Operation*& remembered = remembered_[operation];
  if (!remembered) remembered = add(std::make_unique<Remembered>(*operation, compiled_->recent++));
  return remembered;
}

const LoopedClip* Binder::clip(const std::string& name, const std::optional<Loop>& loop, const Place& place) {
  const std::size_t index = number_of(clips_, name);
  if (index == clips_.size()) {
    fault(place, "there is no clip " + quoted(name) + nearest_of(name, names_of(clips_)));
    return nullptr;
  }
  LoopedClip& made = *compiled_->clips.emplace_back(std::make_unique<LoopedClip>(LoopedClip{index, clips_[index]}));
  if (loop) made.clip.loop = *loop;
  std::string problems;
  made.bound.emplace(made.clip, nodes_, problems);
  if (!problems.empty()) {
    fault(place, "the clip does not fit its nodes:" + problems);
    return nullptr;
  }
  made.jumps.duration = made.clip.duration;
  made.jumps.loop = made.clip.loop;
  std::vector<double> jumps = jumps_of(made.clip, moves_its_node);
  if (jumps_at_seam(made.clip, made.clip.loop.mode, 0, made.clip.duration, moves_its_node))
    jumps.insert(jumps.begin(), 0);
  for (const double time : jumps) made.jumps.events.push_back({.from = time, .to = time, .name = {}, .data = {}});
  made.formulas = clips::FormulaJumps::of(made.clip, moves_its_node);
  return &made;
}

std::optional<std::size_t> Binder::parameter(const std::string& name, const Place& place) {
  const std::size_t index = number_of(description_.parameters, name);
  if (index < description_.parameters.size()) return index;
  fault(place, "there is no parameter " + quoted(name) + nearest_of(name, names_of(description_.parameters)));
  return std::nullopt;
}

Number Binder::number(const GraphNumber& number, const Place& place) {
  if (const double* constant = std::get_if<double>(&number)) {
    if (!std::isfinite(*constant))
      fault(place, "this is not a finite number");
    else if (std::abs(*constant) > largest_parameter)
      fault(place, "a number may be up to 1e15; this one is " + number_text(*constant));
    return Number(*constant);
  }
  if (const auto* curve = std::get_if<Curve<double>>(&number)) {
    const auto is_too_large = [&](double knot) {
      return std::abs(curve->value(knot, Side::in)) > largest_parameter ||
             std::abs(curve->value(knot)) > largest_parameter;
    };
    if (std::ranges::any_of(curve->knots(), is_too_large))
      fault(place, "a number may be up to 1e15, at any of its keys too");
    keep_jumps_of(*curve);
    return Number(*curve);
  }
  const std::optional<std::size_t> found = parameter(std::get<ByParameter>(number).name, place);
  return found ? Number(description_, *found) : Number();
}

std::size_t Binder::node(const std::string& name, const Place& place) {
  if (const auto found = nodes_.find(name)) return *found;
  fault(place, "there is no node " + quoted(name) + nearest_of(name, names_of(nodes_.nodes())));
  return no_node;
}

JointMask Binder::mask(const std::vector<MaskPart>& parts, const Place& place) {
  // Each by itself, so that each is told at its own place.
  bool fits = !parts.empty();
  for (std::size_t i = 0; i < parts.size(); ++i)
    fits = attempt(inside(place, {std::to_string(i)}),
                   [&] {
                     static_cast<void>(JointMask(nodes_, {&parts[i], 1}));
                   }) &&
           fits;
  return fits ? JointMask(nodes_, parts) : JointMask();
}

std::size_t Binder::machine_number() const noexcept {
  return static_cast<std::size_t>(std::ranges::find(compiled_->machine_poses, making_.back()) -
                                  compiled_->machine_poses.begin());
}

// Each line is a fault; if there are indented lines, only these are, below a line that says what they are about.
void Binder::fault_each(const Place& place, const std::string& lines) {
  const bool headed = lines.find("\n ") != std::string::npos;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    const std::size_t begin = lines.find_first_not_of(' ', at);
    if (begin < end && (!headed || begin > at)) fault(place, lines.substr(begin, end - begin));
    at = end + 1;
  }
}

void Binder::fault(const Place& place, std::string message) {
  Place full;
  if (!making_.empty()) full = {"poses", description_.poses[making_.back()].name};
  full.insert(full.end(), place.begin(), place.end());
  faults_.push_back({std::move(full), std::move(message)});
}

}  // namespace tweenfall::graphs
