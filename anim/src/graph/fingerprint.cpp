#include <tweenfall/anim/graph.h>

#include "graph/digest.h"

#include <cmath>

namespace tweenfall {

namespace graphs {
namespace {

class Fingerprint {
 public:
  void add(const GraphDescription& graph) {
    for (const GraphParameter& each : graph.parameters) {
      digest_.text(each.name);
      digest_.number(each.start);
      digest_.number(each.half_life);
      if (each.curve) add(*each.curve);
    }
    for (const GraphPose& each : graph.poses) {
      digest_.text(each.name);
      digest_.number(std::uint64_t{each.operation.index()});
      std::visit([&](const auto& operation) { add(operation); }, each.operation);
    }
    digest_.text(graph.output);
    for (const GraphInput& each : graph.inputs) {
      digest_.number(each.time);
      digest_.text(each.name);
      digest_.number(std::uint64_t{each.value.has_value()});
      digest_.number(each.value.value_or(0));
    }
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return digest_.value(); }

 private:
  void add(const Curve<double>& curve) {
    const double from = std::isfinite(curve.start()) ? curve.start() : 0;
    const double to = std::isfinite(curve.end()) ? curve.end() : from + 10;
    constexpr int between = 16;
    for (int i = -1; i <= between + 1; ++i) digest_.number(curve.value(from + (to - from) * i / between));
    for (const double knot : curve.knots()) {
      digest_.number(knot);
      digest_.number(curve.value(knot, Side::in));
      digest_.number(curve.rate(knot));
    }
  }
  void add(const GraphNumber& number) {
    digest_.number(std::uint64_t{number.index()});
    if (const double* constant = std::get_if<double>(&number)) digest_.number(*constant);
    if (const auto* curve = std::get_if<Curve<double>>(&number)) add(*curve);
    if (const auto* parameter = std::get_if<ByParameter>(&number)) digest_.text(parameter->name);
  }
  void add(const RestPose&) {}
  void add(const ClipPose& pose) {
    digest_.text(pose.clip);
    digest_.number(pose.at);
    digest_.number(pose.speed);
    digest_.number(std::uint64_t{pose.loop.has_value()});
    if (!pose.loop) return;
    digest_.number(static_cast<std::uint64_t>(pose.loop->mode));
    digest_.number(pose.loop->count);
  }
  void add(const BlendPose& pose) {
    for (const BlendPose::Part& part : pose.parts) {
      digest_.text(part.pose);
      add(part.weight);
    }
  }
  void add(const LayersPose& pose) {
    digest_.text(pose.base);
    for (const LayersPose::Layer& layer : pose.layers) {
      digest_.text(layer.pose);
      digest_.text(layer.reference);
      digest_.number(std::uint64_t{layer.adds});
      add(layer.weight);
      for (const MaskPart& part : layer.mask) {
        digest_.text(part.joints);
        digest_.number(part.weight);
        digest_.number(std::uint64_t{part.below});
      }
    }
  }
  void add(const SpacePose& pose) {
    for (const GraphNumber& number : pose.by) add(number);
    for (const SpacePose::Entry& entry : pose.entries) {
      digest_.text(entry.pose);
      digest_.number(entry.place.x());
      digest_.number(entry.place.y());
    }
    digest_.number(std::uint64_t{pose.sync.has_value()});
    digest_.text(pose.sync.value_or(""));
  }
  void add(const MachinePose& pose) {
    digest_.text(pose.start);
    for (const MachinePose::State& state : pose.states) {
      digest_.text(state.name);
      digest_.text(state.pose);
    }
    for (const GraphTransition& transition : pose.transitions) {
      for (const std::string& from : transition.from) digest_.text(from);
      digest_.text(transition.to);
      for (const GraphCondition& condition : transition.when) {
        digest_.number(static_cast<std::uint64_t>(condition.kind));
        digest_.text(condition.name);
        digest_.number(condition.value);
      }
      digest_.number(static_cast<std::uint64_t>(transition.change.kind));
      digest_.number(transition.change.seconds);
      if (transition.change.ease) digest_.text(transition.change.ease->name());
    }
  }

  Digest digest_;
};

}  // namespace
}  // namespace graphs

std::uint64_t fingerprint(const GraphDescription& description) noexcept {
  graphs::Fingerprint fingerprint;
  fingerprint.add(description);
  return fingerprint.value();
}

}  // namespace tweenfall
