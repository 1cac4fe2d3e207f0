#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/number_text.h>

#include "graph/binder.h"
#include "operations/account.h"

#include <algorithm>
#include <utility>

namespace tweenfall::graphs {

namespace {

class Layered : public Operation {
 public:
  struct Layer {
    const Operation* pose;
    const Operation* reference;  // for a layer that adds; null: the pose below the graph
    bool adds;
    Number weight;
    JointMask mask;
  };
  Layered(const Operation* base, std::vector<Layer> layers) : base_(base), layers_(std::move(layers)) {
    operands_.reserve(layers_.size() + 1);
    if (base_) operands_.push_back(base_);
    for (const Layer& layer : layers_) operands_.push_back(layer.pose);
  }

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    if (base_)
      base_->pose(log, moment, scratch, out);
    else
      std::ranges::copy(scratch.below, out.begin());
    for (const Layer& layer : layers_) {
      const Sample<double> weight = as_share(layer.weight.sample(log, moment.time, moment.side), moment.side);
      if (is_nothing(weight)) continue;
      const std::span<Motion> motions = scratch.pose();
      const Scratch rest = scratch.rest();
      layer.pose->pose(log, moment, rest, motions);
      if (!layer.adds) {
        cross_fade(out, motions, weight, out, layer.mask);
        continue;
      }
      std::span<const Motion> reference = scratch.below;
      if (layer.reference) {
        layer.reference->pose(log, moment, rest.rest(), rest.pose());
        reference = rest.pose();
      }
      difference(reference, motions, motions);
      add(out, motions, weight, out, layer.mask);
    }
  }

  // References are left out, because their events do not count.
  [[nodiscard]] std::span<const Operation* const> operands() const noexcept override { return operands_; }

  [[nodiscard]] double share(const Log& log, std::size_t operand, double time) const noexcept override {
    const auto weight = [&](const Layer& layer) {
      return as_share(layer.weight.sample(log, time, Side::out), Side::out).value;
    };
    const std::size_t above = base_ ? operand : operand + 1;  // the first layer over it
    double share = above == 0 ? 1 : weight(layers_[above - 1]);
    for (std::size_t i = above; i < layers_.size(); ++i)
      if (!layers_[i].adds && layers_[i].mask.size() == 0) share *= 1 - weight(layers_[i]);
    return share;
  }

  // Additive layers do not move the figure, but values.
  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    Sample<double> left = weight;
    for (std::size_t i = layers_.size(); i-- > 0;) {
      const Layer& layer = layers_[i];
      const double reach = layer.mask.size() == 0 ? 1 : node < layer.mask.size() ? layer.mask[node] : 0;
      if ((layer.adds && !out.adds) || reach == 0) continue;
      out.note(log, layer.weight, moment);
      const Sample<double> own =
          product({reach, 0, 0}, as_share(layer.weight.sample(log, moment.time, moment.side), moment.side));
      if (is_nothing(own)) continue;
      const Sample<double> part = product(left, own);
      const bool within = std::exchange(out.adding, out.adding || layer.adds);
      layer.pose->bearers(log, moment, node, part, out);
      if (!layer.adds)
        left = product(left, rest_of(own));
      else if (layer.reference)
        layer.reference->bearers(log, moment, node, {-part.value, -part.rate, -part.acceleration}, out);
      out.adding = within;
    }
    if (base_ && !is_nothing(left)) base_->bearers(log, moment, node, left, out);
  }

 private:
  const Operation* base_;  // null: what lies below the graph
  std::vector<Layer> layers_;
  std::vector<const Operation*> operands_;
};

}  // namespace

void tell(const LayersPose& pose, Account& account) {
  account.words = "layers";
  account.pose(pose.base, "base");
  for (const LayersPose::Layer& layer : pose.layers) {
    const bool plain = std::holds_alternative<double>(layer.weight) && std::get<double>(layer.weight) == 1;
    account.pose(layer.pose, std::string(layer.adds ? "add" : "over") + (plain ? "" : " " + words_of(layer.weight)));
    account.pose(layer.reference, "reference");
    account.tell(layer.adds, layer.weight, layer.mask);
  }
}

std::unique_ptr<Operation> bound(const LayersPose& described, Binder& binder) {
  bool whole = true;
  const auto pose = [&](const std::string& name, const Place& place) -> const Operation* {
    const Operation* found = binder.pose(name, place);
    whole = whole && found;
    return found;
  };
  const Operation* base = described.base.empty() ? nullptr : pose(described.base, {"base"});
  std::vector<Layered::Layer> layers;
  for (std::size_t i = 0; i < described.layers.size(); ++i) {
    const LayersPose::Layer& layer = described.layers[i];
    const auto place = [&](const char* part) { return Place{"layers", std::to_string(i), part}; };
    Layered::Layer made{.pose = pose(layer.pose, place(layer.adds ? "add" : "over")),
                        .reference = layer.reference.empty() ? nullptr : pose(layer.reference, place("reference")),
                        .adds = layer.adds,
                        .weight = binder.number(layer.weight, place("weight")),
                        .mask = binder.mask(layer.mask, place("mask"))};
    if (!layer.adds && !layer.reference.empty())
      binder.fault(place("reference"), "only a layer that adds has a reference");
    const std::optional<double> said = made.weight.constant();
    if (said && !(*said >= 0 && *said <= 1))
      binder.fault(place("weight"), "the weight of a layer is 0 to 1; it is " + number_text(*said));
    layers.push_back(std::move(made));
  }
  if (layers.empty()) binder.fault({"layers"}, "there are no layers; give one, or name the pose itself");
  if (!whole) return nullptr;
  auto operation = std::make_unique<Layered>(base, std::move(layers));
  operation->set_rooms(2);
  return operation;
}

}  // namespace tweenfall::graphs
