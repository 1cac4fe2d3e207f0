#include <tweenfall/anim/clip_jumps.h>
#include <tweenfall/anim/graph_player.h>
#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include "graph/log_bytes.h"
#include "graph/look.h"
#include "machine/course.h"
#include "pose/clip_values.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

struct GraphPlayer::Run {
  graphs::Log log;
  double time = 0;
  GraphGround ground;
  std::vector<Motion> room;
};

namespace graphs {
namespace {

void write_at_rest(const Hierarchy& nodes, std::span<Motion> out) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out[i] = Motion();
    out[i].pose = nodes[i].rest;
  }
}

void require_time(double time, double least) {
  if (!(time >= least) || !std::isfinite(time))
    throw std::invalid_argument("a graph can be sought to a finite time of 0 s or later, not to " + number_text(time) +
                                " s");
}

std::size_t parameter_named(const GraphDescription& description, std::string_view name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < description.parameters.size(); ++i) {
    if (description.parameters[i].name == name) return i;
    names.push_back(description.parameters[i].name);
  }
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no parameter \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

}  // namespace
}  // namespace graphs

GraphPlayer::GraphPlayer(std::shared_ptr<const Graph> graph, GraphGround ground)
    : graph_(std::move(graph)), run_(std::make_unique<Run>()) {
  run_->log = graphs::fresh_log(graph_->description(), graph_->compiled().sizes());
  lie_on(std::move(ground));
  know(0);
}

GraphPlayer::GraphPlayer(const GraphPlayer& other, GraphGround ground, double from)
    : graph_(other.graph_), run_(std::make_unique<Run>()) {
  run_->log = other.run_->log;
  run_->time = other.run_->time;
  lie_on(std::move(ground));
  graphs::forget_course(run_->log, graph_->description(), std::max(0.0, from - graph_->compiled().looks_ahead));
  know(run_->time);
}

void GraphPlayer::lie_on(GraphGround ground) {
  run_->room.resize(graphs::rooms_of(*graph_) * graph_->nodes().size());
  run_->ground = std::move(ground);
  if (!run_->ground.pose)
    run_->ground.pose = [graph = graph_.get()](double, Side, std::span<Motion> out) {
      graphs::write_at_rest(graph->nodes(), out);
    };
}

GraphPlayer::~GraphPlayer() = default;
GraphPlayer::GraphPlayer(GraphPlayer&&) noexcept = default;
GraphPlayer& GraphPlayer::operator=(GraphPlayer&&) noexcept = default;

void GraphPlayer::know(double time) {
  graphs::Log& log = run_->log;
  if (log.known >= time) return;
  if (log.keeps_all) {
    log.keeps_all = false;
    for (graphs::Record<graphs::Passage>& passages : log.passages) graphs::let_go(passages, true);
  }
  graphs::make_known(log, *graph_, time, run_->ground, run_->room);
  if (log.lacks) recall();
}

// Everything that happened follows from the inputs: it is computed again.
void GraphPlayer::recall() {
  graphs::Log& log = run_->log;
  const double known = log.known;
  log.keeps_all = true;
  graphs::forget_course(log, graph_->description(), 0);
  graphs::make_known(log, *graph_, known, run_->ground, run_->room);
  log.lacks = false;
}

void GraphPlayer::set(std::string_view name, double value) {
  const std::size_t parameter = graphs::parameter_named(graph_->description(), name);
  if (graph_->description().parameters[parameter].curve)
    throw std::invalid_argument("the parameter \"" + std::string(name) + "\" has keys and cannot be set");
  if (!(std::abs(value) <= graphs::largest_parameter))
    throw std::invalid_argument("the parameter \"" + std::string(name) + "\" is set to a number up to 1e15, not to " +
                                number_text(value));
  graphs::forget_after(run_->log, graph_->description(), run_->time);
  graphs::set(run_->log, graph_->description(), parameter, run_->time, value, graphs::Origin::outside);
  know(run_->time);
}

void GraphPlayer::send(std::string_view event) {
  const std::vector<std::string> awaited = events_awaited(graph_->description());
  if (std::ranges::find(awaited, event) == awaited.end()) {
    const std::string nearest = nearest_name(event, awaited);
    throw std::invalid_argument("no machine waits for an event \"" + std::string(event) + "\"" +
                                (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  graphs::forget_after(run_->log, graph_->description(), run_->time);
  graphs::send(run_->log, run_->time, event, graphs::Origin::outside);
  know(run_->time);
}

namespace graphs {
namespace {

/// @param counts whether an origin counts
template <class Counts>
std::vector<GraphInput> inputs_of(const Log& log, const GraphDescription& description, const Counts& counts) {
  std::vector<GraphInput> inputs;
  for (std::size_t p = 0; p < log.settings.size(); ++p)
    for (std::size_t i = 1; i < log.settings[p].size(); ++i)
      if (const Setting& each = log.settings[p][i]; counts(each.origin))
        inputs.push_back({each.time, description.parameters[p].name, each.value});
  for (const Sending& each : log.sent)
    if (counts(each.origin)) inputs.push_back({each.time, each.event, std::nullopt});
  std::ranges::stable_sort(inputs, {}, &GraphInput::time);
  return inputs;
}

}  // namespace
}  // namespace graphs

std::vector<GraphInput> GraphPlayer::inputs() const {
  return graphs::inputs_of(run_->log, graph_->description(),
                           [](graphs::Origin origin) { return origin != graphs::Origin::event; });
}

std::vector<GraphInput> GraphPlayer::own_inputs() const {
  return graphs::inputs_of(run_->log, graph_->description(),
                           [](graphs::Origin origin) { return origin == graphs::Origin::outside; });
}

void GraphPlayer::advance(double dt) {
  if (!(dt >= 0)) throw std::invalid_argument("a graph advances by 0 s or more, not by " + number_text(dt) + " s");
  seek(run_->time + dt);
}

void GraphPlayer::seek(double time) {
  graphs::require_time(time, 0);
  know(time);
  run_->time = time;
}

double GraphPlayer::time() const noexcept {
  return run_->time;
}

void GraphPlayer::pose(std::span<Motion> local, Side side) noexcept {
  evaluate(run_->time, local, side);
}

void GraphPlayer::pose_at(double time, std::span<Motion> local, Side side) {
  graphs::require_time(time, 0);
  know(time);
  evaluate(time, local, side);
}

void GraphPlayer::evaluate(double time, std::span<Motion> local, Side side) noexcept {
  const std::size_t nodes = graph_->nodes().size();
  const std::span<Motion> below(run_->room.data(), nodes);
  const auto show = [&] {
    run_->ground.pose(time, side, below);
    graph_->compiled().output->pose(run_->log, {time, side, 0}, {below, run_->room.data() + nodes, &run_->ground},
                                    local);
  };
  show();
  if (!run_->log.lacks) return;
  recall();
  show();
}

NodeLook GraphPlayer::look_at(std::size_t node, double time, Side side) {
  graphs::require_time(time, 0);
  NodeLook below;
  if (run_->ground.look) below = run_->ground.look(node, time, side);
  if (!graph_->compiled().looks(node)) return below;
  know(time);
  return graphs::look_of(run_->log, *graph_, node, {time, side, 0}, below);
}

UserValue GraphPlayer::user_value_at(std::string_view track, double time, Side side) {
  graphs::require_time(time, 0);
  const auto& tracks = graph_->compiled().user_tracks;
  const auto known = tracks.find(track);
  if (known == tracks.end()) static_cast<void>(pose::user_track_named(graph_->clips(), track));  // throws
  const auto& [first, node, shows] = known->second;
  UserValue below =
      run_->ground.user_value ? run_->ground.user_value(track, time, side) : pose::nothing_of(first->curve);
  if (!shows) return below;
  know(time);
  return graphs::user_value_of(run_->log, *graph_, track, node, {time, side, 0}, below);
}

Sample<double> GraphPlayer::parameter(std::string_view name) const {
  return graphs::sample_of(run_->log, graph_->description(), graphs::parameter_named(graph_->description(), name),
                           run_->time, Side::out);
}

std::vector<GraphEvent> GraphPlayer::events(double from, double to) {
  if (std::isnan(from)) throw std::invalid_argument("events are found between two times; the first is not a number");
  graphs::require_time(to, 0);
  know(to);
  std::vector<GraphEvent> events;
  if (from <= to) graph_->compiled().output->events(run_->log, {from, to, 0}, events);
  std::erase_if(events, [](const GraphEvent& event) { return !(event.weight > 0); });
  std::ranges::stable_sort(events, {}, &GraphEvent::time);
  return events;
}

namespace graphs {
namespace {

bool is_same_place(const Motion& a, const Motion& b) noexcept {
  const auto near = [](const Vec3& v, const Vec3& w) { return (v - w).squaredNorm() <= 1e-18 * (1 + v.squaredNorm()); };
  const Quat &q = a.pose.rotation, &r = b.pose.rotation;
  return near(a.pose.position, b.pose.position) && near(a.pose.scale, b.pose.scale) &&
         (hemisphere_aligned(q, r).coeffs() - r.coeffs()).squaredNorm() <= 1e-18;
}

}  // namespace
}  // namespace graphs

std::optional<double> GraphPlayer::first_instant(double from, double to) {
  return instant(from, from, to, true);
}

std::optional<double> GraphPlayer::first_possible_jump(double from, double to, std::optional<double> since) {
  const double began = since.value_or(from);
  std::optional<double> first = instant(began, from, to, false);
  if (run_->ground.next_jump)
    if (const auto below = run_->ground.next_jump(began, from, first.value_or(to))) first = below;
  return first;
}

std::optional<double> GraphPlayer::instant(double since, double from, double to, bool looks) {
  if (!(from < to) || !std::isfinite(to)) return std::nullopt;
  know(to);
  std::optional<double> first;
  const auto meet = [&](const auto& list, auto time) {
    const auto next = std::ranges::upper_bound(list, from, {}, time);
    if (next != list.end() && std::invoke(time, *next) <= first.value_or(to)) first = std::invoke(time, *next);
  };
  for (const graphs::Record<graphs::Setting>& settings : run_->log.settings) meet(settings, &graphs::Setting::time);
  for (const graphs::Record<graphs::Passage>& passages : run_->log.passages) meet(passages, &graphs::Passage::time);
  // Where root motion continues over the seams of loops, a jump of a clip may not be a jump of the pose. If there are
  // very many seams in one stretch, the rest count as jumps unchecked; but if they follow each other faster than any
  // frames, they count as the ones before did.
  constexpr int most_looked_at = 64;
  constexpr double dense = 1e-3;  // mean distance between seams, s
  const bool may_go_on = looks && graph_->compiled().travels > 0;
  std::vector<Motion> before(may_go_on ? graph_->nodes().size() : 0), behind(before.size());
  const auto goes_on = [&](double time) {
    evaluate(time, before, Side::in);
    evaluate(time, behind, Side::out);
    return std::ranges::equal(before, behind, graphs::is_same_place);
  };
  graphs::Search left{since, from, to};
  for (int looked_at = 0;; ++looked_at) {
    const auto jump = graph_->compiled().output->next_jump(run_->log, 0, left.up_to(first.value_or(to)));
    if (!jump) break;
    if (may_go_on && looked_at == most_looked_at && *jump - from < most_looked_at * dense) break;
    if (!may_go_on || looked_at == most_looked_at || !goes_on(*jump)) {
      first = jump;
      break;
    }
    left = left.from(*jump);
  }
  for (const Curve<double>& curve : graph_->compiled().jumping)
    if (const double jump = first_jump(curve, from, first.value_or(to)); std::isfinite(jump)) first = jump;
  return first;
}

std::optional<double> GraphPlayer::first_event(std::string_view name, double from, double to) {
  for (const GraphEvent& event : events(from, to))
    if (event.name == name && event.kind != GraphEvent::Kind::end) return event.time;
  return std::nullopt;
}

std::size_t GraphPlayer::machines() const noexcept {
  return graph_->compiled().machines.size();
}

const std::string& GraphPlayer::machine_name(std::size_t machine) const {
  return graph_->description().poses[graph_->compiled().machine_poses.at(machine)].name;
}

std::vector<GraphActivity> GraphPlayer::activity(std::size_t machine) const {
  const graphs::Operation* operation = graph_->compiled().machines.at(machine);
  return static_cast<const graphs::Machine*>(operation)->activity(run_->log, run_->time);
}

std::vector<GraphPassage> GraphPlayer::passages(std::size_t machine) const {
  std::vector<GraphPassage> out;
  for (const graphs::Passage& each : run_->log.passages.at(machine))
    if (each.time <= run_->time) out.push_back(each);
  return out;
}

std::vector<GraphStop> GraphPlayer::stops() const {
  std::vector<GraphStop> out = run_->log.stops;
  std::erase_if(out, [&](const GraphStop& stop) { return stop.time > run_->time; });
  return out;
}

std::vector<std::byte> GraphPlayer::save() const {
  return graphs::bytes_of(run_->log, graph_->description(), run_->time);
}

void GraphPlayer::load(std::span<const std::byte> saved) {
  graphs::SavedLog read = graphs::log_of(saved, graph_->description(), graph_->compiled().sizes());
  // Computing what happened forgets how far springs were followed.
  std::vector<graphs::SwingMemory> swings = read.log.swings;
  graphs::make_known(read.log, *graph_, read.time, run_->ground, run_->room);
  read.log.swings = std::move(swings);
  run_->log = std::move(read.log);
  run_->time = read.time;
}

std::uint64_t GraphPlayer::hash() const noexcept {
  return graphs::hash_of(run_->log, run_->time);
}

}  // namespace tweenfall
