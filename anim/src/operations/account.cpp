#include "operations/account.h"

#include <tweenfall/curves/number_text.h>

#include "operations/operation.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tweenfall {

namespace graphs {

void Account::pose(const std::string& name, std::string role) {
  add(name);
  if (!name.empty()) operands.push_back({name, std::move(role), false});
}

void Account::clip(const std::string& name) {
  add(name);
  operands.push_back({name, "clip", true});
}

void Account::add(const Curve<double>& curve) {
  const double from = std::isfinite(curve.start()) ? curve.start() : 0;
  const double to = std::isfinite(curve.end()) ? curve.end() : from + 10;
  constexpr int between = 16;
  for (int i = -1; i <= between + 1; ++i) digest_.number(curve.value(from + (to - from) * i / between));
  for (const double knot : curve.knots()) tell(knot, curve.value(knot, Side::in), curve.rate(knot));
}

void Account::add(const GraphNumber& number) {
  add(number.index());
  if (const double* constant = std::get_if<double>(&number)) add(*constant);
  if (const auto* curve = std::get_if<Curve<double>>(&number)) add(*curve);
  if (const auto* parameter = std::get_if<ByParameter>(&number)) add(parameter->name);
}

void Account::add(const GraphPlace& place) {
  add(place.node);
  for (const GraphNumber& number : place.at) add(number);
}

void Account::add(const JointLimit& limit) {
  add(limit.index());
  if (const auto* hinge = std::get_if<HingeLimit>(&limit)) tell(hinge->axis, hinge->low, hinge->high);
  if (const auto* cone = std::get_if<ConeLimit>(&limit)) tell(cone->swing, cone->twist_low, cone->twist_high);
}

void Account::add(const GraphChange& change) {
  tell(change.kind, change.seconds, change.ease ? change.ease->name() : std::string());
}

std::string words_of(const GraphNumber& number) {
  if (const double* constant = std::get_if<double>(&number)) return brief_text(*constant);
  if (const auto* parameter = std::get_if<ByParameter>(&number)) return parameter->name;
  return "keys";
}

std::string words_of(const GraphPlace& place) {
  if (!place.node.empty()) return place.node;
  return "[" + words_of(place.at[0]) + ", " + words_of(place.at[1]) + ", " + words_of(place.at[2]) + "]";
}

std::string share_in_words(const GraphNumber& weight) {
  const double* constant = std::get_if<double>(&weight);
  return constant && *constant == 1 ? "" : " by " + words_of(weight);
}

namespace {

Account account_of(const PoseOperation& operation) {
  Account account;
  std::visit([&](const auto& described) { tell(described, account); }, operation);
  return account;
}

}  // namespace

class Fingerprint {
 public:
  static std::uint64_t of(const GraphDescription& graph) {
    Account all;
    for (const GraphParameter& each : graph.parameters) {
      all.tell(each.name, each.start, each.half_life);
      if (each.curve) all.add(*each.curve);
    }
    for (const GraphPose& each : graph.poses)
      all.tell(each.name, each.operation.index(), account_of(each.operation).value());
    all.add(graph.output);
    for (const GraphInput& each : graph.inputs) all.tell(each.time, each.name, each.value);
    for (const GraphReaction& each : graph.reactions) all.tell(each.event, each.name, each.value);
    return all.value();
  }
};

}  // namespace graphs

std::uint64_t fingerprint(const GraphDescription& description) noexcept {
  return graphs::Fingerprint::of(description);
}

std::string words_of(const PoseOperation& operation) {
  return graphs::account_of(operation).words;
}

std::vector<GraphOperand> operands_of(const PoseOperation& operation) {
  return graphs::account_of(operation).operands;
}

std::vector<std::string> events_awaited(const GraphDescription& description) {
  std::set<std::string> names;
  for (const GraphPose& pose : description.poses)
    if (const auto* machine = std::get_if<MachinePose>(&pose.operation))
      for (const GraphTransition& transition : machine->transitions)
        for (const GraphCondition& condition : transition.when)
          if (condition.kind == GraphCondition::Kind::event) names.insert(condition.name);
  return {names.begin(), names.end()};
}

std::vector<std::string> clips_named_in(const GraphDescription& description) {
  std::set<std::string> names;
  for (const GraphPose& pose : description.poses)
    for (const GraphOperand& operand : operands_of(pose.operation))
      if (operand.clip ||
          std::ranges::find(description.poses, operand.pose, &GraphPose::name) == description.poses.end())
        names.insert(operand.pose);
  return {names.begin(), names.end()};
}

}  // namespace tweenfall
