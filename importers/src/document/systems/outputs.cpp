#include "document/systems/outputs.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/splines.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "document/form.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_expression.h"

namespace tweenfall::document::systems {

namespace {

using Kind = json::Value::Kind;

// Values and rates at the steps: one list of samples for each number of the track.
using Columns = std::vector<std::vector<Sample<double>>>;

std::vector<Sample<double>> moving_state(const ExpressionSystem& system, const FirstOrder& rates,
                                         const FirstOrderPath& path, std::size_t at) {
  std::vector<double> speeds(system.variables.size());
  rates(path.times[at], path.states[at], speeds);
  std::vector<Sample<double>> samples(speeds.size() + 1);
  samples[0] = {path.times[at], 1, 0};
  for (std::size_t i = 0; i < speeds.size(); ++i) samples[i + 1] = {path.states[at][i], speeds[i], 0};
  return samples;
}

Columns columns_of(const ExpressionSystem& system, const FirstOrderPath& path, std::span<const Expression> parts) {
  const FirstOrder rates = rates_of(system);
  Columns columns(parts.size());
  for (std::size_t at = 0; at < path.times.size(); ++at) {
    const std::vector<Sample<double>> state = moving_state(system, rates, path, at);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Sample<double> sample = parts[i].sample(state);
      if (!std::isfinite(sample.value) || !std::isfinite(sample.rate))
        throw std::invalid_argument("has no finite value and rate after " + brief_text(path.times[at]) + " s");
      columns[i].push_back(sample);
    }
  }
  return columns;
}

template <class T>
Curve<T> curve_of(const FirstOrderPath& path, const Columns& columns) {
  std::vector<T> values(path.times.size()), rates(path.times.size());
  for (std::size_t at = 0; at < path.times.size(); ++at)
    if constexpr (std::is_same_v<T, double>) {
      values[at] = columns[0][at].value;
      rates[at] = columns[0][at].rate;
    } else {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        values[at][static_cast<Eigen::Index>(i)] = columns[i][at].value;
        rates[at][static_cast<Eigen::Index>(i)] = columns[i][at].rate;
      }
    }
  return hermite_spline<T>(path.times, values, rates);
}

TrackCurve track_curve_of(const FirstOrderPath& path, const Columns& columns) {
  switch (columns.size()) {
    case 1:
      return curve_of<double>(path, columns);
    case 2:
      return curve_of<Vec2>(path, columns);
    case 3:
      return curve_of<Vec3>(path, columns);
    default:
      return curve_of<Vec4>(path, columns);
  }
}

// How many numbers a property takes: 0 for any; properties that cannot be driven are reported.
std::optional<std::size_t> numbers_of(const json::Member& track, const std::string& property, Problems& problems) {
  if (property == "rotation" || property == "color" || property == "weights") {
    problems.add_name(track, "a system drives numbers: of \"" + property + "\" " +
                                 (property == "rotation" ? "one angle, as \"rotation.z\""
                                  : property == "color"  ? "one part, as \"color.a\""
                                                         : "none"));
    return {};
  }
  if (property == "position" || property == "scale") return 3;
  return component_named(property) ? 1 : 0;
}

std::optional<Track> track_of(const json::Member& member, const ExpressionSystem& system, const FirstOrderPath& path,
                              const Expressions& expressions, Problems& problems) {
  const std::size_t dot = property_dot(member.name);
  if (dot == std::string::npos) {
    problems.add_name(member, "a track is named \"node.property\", found " + json::in_quotes(member.name));
    return {};
  }
  const std::string property(member.name.substr(dot + 1));
  const std::optional<std::size_t> wanted = numbers_of(member, property, problems);
  if (!wanted) return {};
  std::vector<Expression> parts;
  const bool list = member.value.is(Kind::list);
  const std::size_t count = list ? member.value.items().size() : 1;
  if (*wanted > 0 && count != *wanted) {
    problems.add(member.value, json::in_quotes(property) + " takes " + std::to_string(*wanted) +
                                   (*wanted == 1 ? " expression" : " expressions in a list") + ", found " +
                                   std::to_string(count));
    return {};
  }
  const auto add = [&](const json::Value& value) {
    if (const std::optional<Expression> part = expressions.read(value)) parts.push_back(*part);
  };
  if (list)
    for (const json::Value& each : member.value.items()) add(each);
  else
    add(member.value);
  if (parts.size() != count) return {};
  try {
    Columns columns = columns_of(system, path, parts);
    if (property.starts_with("rotation."))
      for (Sample<double>& sample : columns[0]) sample = {radians(sample.value), radians(sample.rate), 0};
    return Track{.node = std::string(member.name.substr(0, dot)),
                 .property = property,
                 .curve = track_curve_of(path, columns),
                 .words = {{-HUGE_VAL, "system"}}};
  } catch (const std::invalid_argument& fault) {
    problems.add(member.value, fault.what());
    return {};
  }
}

// Adds tracks of the state itself, on a node with the system's name.
void show_state(const ExpressionSystem& system, const FirstOrderPath& path, Clip& clip) {
  const auto add = [&](const std::string& name, const Expression& expression) {
    clip.tracks.push_back({.node = system.name,
                           .property = name,
                           .curve = track_curve_of(path, columns_of(system, path, {&expression, 1})),
                           .words = {{-HUGE_VAL, "system"}}});
  };
  std::vector<std::string> names{"t"};
  names.insert(names.end(), system.variables.begin(), system.variables.end());
  for (const std::string& name : system.variables) add(name, Expression(name, names, {}));
  if (system.energy && std::ranges::find(system.variables, "energy") == system.variables.end())
    add("energy", *system.energy);
}

void add_node(const std::string& name, Building& building) {
  NodeDescription node;
  node.name = name;
  if (building.nodes.emplace(name, building.stage.nodes.size()).second) building.stage.nodes.push_back(std::move(node));
}

}  // namespace

Expressions::Expressions(std::span<const std::string> variables, const json::Value& parameters, Problems& problems)
    : problems_(problems) {
  names_.emplace_back("t");
  names_.insert(names_.end(), variables.begin(), variables.end());
  if (!parameters) return;
  for (const json::Member& each : parameters.members()) {
    if (is_free_name(each.name) || !each.value.is(Kind::number)) continue;
    const Expression::Parameter one{std::string(each.name), each.value.number()};
    try {
      (void)Expression("0", names_, std::span<const Expression::Parameter>(&one, 1));
      parameters_.push_back(one);
    } catch (const std::invalid_argument& fault) {
      problems_.add_name(each, fault.what());
    }
  }
}

std::optional<Expression> Expressions::read(const json::Value& value) const {
  try {
    if (value.is(Kind::number)) return Expression(number_text(value.number()), names_, {});
    if (value.is(Kind::text)) return Expression(value.text(), names_, parameters_);
  } catch (const ExpressionError& error) {
    add_fault_of_expression(value, error, problems_);
  }
  return {};
}

void take_track_nodes(const json::Value& tracks, Building& building) {
  for (const json::Member& track : tracks.members()) {
    const std::size_t dot = property_dot(track.name);
    if (is_free_name(track.name) || dot == std::string::npos) continue;
    const std::string node(track.name.substr(0, dot));
    if (building.names_are_free) {
      add_node(node, building);
    } else if (building.nodes.count(node) == 0 && !building.excused(node)) {
      building.problems.add_name(
          track, "there is no node " + json::in_quotes(node) + suggestion_or_import(node, building.node_names()));
    }
  }
}

Clip clip_of(const Draft& draft, const FirstOrderPath& path, const Expressions& expressions, Building& building) {
  const ExpressionSystem& system = draft.system;
  Clip clip;
  clip.name = system.name;
  clip.duration = system.duration;
  if (draft.tracks) {
    std::vector<json::Member> read_from;
    for (const json::Member& member : draft.tracks.members()) {
      if (is_free_name(member.name)) continue;
      std::optional<Track> track = track_of(member, system, path, expressions, building.problems);
      if (!track) continue;
      clip.tracks.push_back(std::move(*track));
      read_from.push_back(member);
    }
    for (const Rivals& pair : rivals(clip.tracks))
      building.problems.add_name_beside(read_from[pair.second], "the tracks " + pair.problem, read_from[pair.first]);
  } else if (building.names_are_free) {
    add_node(system.name, building);
    show_state(system, path, clip);
  }
  return clip;
}

}  // namespace tweenfall::document::systems
