#include <tweenfall/anim/graph.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <set>

namespace tweenfall {

namespace graphs {
namespace {

std::string number_in_words(const GraphNumber& number) {
  if (const double* constant = std::get_if<double>(&number)) return brief_text(*constant);
  if (const auto* parameter = std::get_if<ByParameter>(&number)) return parameter->name;
  return "keys";
}

struct Operands {
  std::vector<GraphOperand>& out;

  void operator()(const RestPose&) const {}
  void operator()(const ClipPose& pose) const { out.push_back({pose.clip, "clip", true}); }
  void operator()(const BlendPose& pose) const {
    for (const BlendPose::Part& part : pose.parts) out.push_back({part.pose, number_in_words(part.weight)});
  }
  void operator()(const LayersPose& pose) const {
    if (!pose.base.empty()) out.push_back({pose.base, "base"});
    for (const LayersPose::Layer& layer : pose.layers) {
      const bool plain = std::holds_alternative<double>(layer.weight) && std::get<double>(layer.weight) == 1;
      out.push_back(
          {layer.pose, std::string(layer.adds ? "add" : "over") + (plain ? "" : " " + number_in_words(layer.weight))});
      if (!layer.reference.empty()) out.push_back({layer.reference, "reference"});
    }
  }
  void operator()(const SpacePose& pose) const {
    for (const SpacePose::Entry& entry : pose.entries)
      out.push_back({entry.pose, pose.by.size() == 2 ? brief_text(entry.place.x()) + ", " + brief_text(entry.place.y())
                                                     : brief_text(entry.place.x())});
  }
  void operator()(const MachinePose& pose) const {
    for (const MachinePose::State& state : pose.states) out.push_back({state.pose, state.name});
  }
};

}  // namespace
}  // namespace graphs

std::vector<GraphOperand> operands_of(const PoseOperation& operation) {
  std::vector<GraphOperand> operands;
  std::visit(graphs::Operands{operands}, operation);
  return operands;
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
