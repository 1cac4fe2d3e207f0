#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/number_text.h>

#include "graph/binder.h"
#include "operations/account.h"

#include <array>
#include <cmath>

namespace tweenfall::graphs {

namespace {

class Blended : public Operation {
 public:
  struct Part {
    const Operation* pose;
    Number weight;
  };
  explicit Blended(std::vector<Part> parts) : parts_(std::move(parts)) {
    operands_.reserve(parts_.size());
    for (const Part& part : parts_) operands_.push_back(part.pose);
  }

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    std::array<PoseLayer, most_blended> layers;
    std::size_t count = 0;
    Scratch free = scratch;
    for (const Part& part : parts_) {
      const Sample<double> weight = as_weight(part.weight.sample(log, moment.time, moment.side), moment.side);
      if (is_nothing(weight)) continue;
      const std::span<Motion> motions = free.pose();
      free = free.rest();
      part.pose->pose(log, moment, free, motions);
      layers[count++] = {.pose = motions, .weight = weight};
    }
    blend({layers.data(), count}, scratch.below, out);
  }

  [[nodiscard]] std::span<const Operation* const> operands() const noexcept override { return operands_; }

  [[nodiscard]] double share(const Log& log, std::size_t operand, double time) const noexcept override {
    double sum = 0;
    for (const Part& part : parts_) sum += as_weight(part.weight.sample(log, time, Side::out), Side::out).value;
    const double own = as_weight(parts_[operand].weight.sample(log, time, Side::out), Side::out).value;
    return sum > 0 ? own / std::max(sum, least_weight) : 0;
  }

  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    Sample<double> sum{0, 0, 0};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      weights[i] = as_weight(parts_[i].weight.sample(log, moment.time, moment.side), moment.side);
      sum.value += weights[i].value;
      sum.rate += weights[i].rate;
      out.note(log, parts_[i].weight, moment);
    }
    if (!(sum.value >= least_weight)) sum = {least_weight, 0, 0};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double share = weights[i].value / sum.value;
      const Sample<double> own{share, (weights[i].rate - share * sum.rate) / sum.value, 0};
      if (!is_nothing(own)) parts_[i].pose->bearers(log, moment, node, product(weight, own), out);
    }
  }

 private:
  std::vector<Part> parts_;
  std::vector<const Operation*> operands_;
};

}  // namespace

void tell(const BlendPose& pose, Account& account) {
  account.words = "blend";
  for (const BlendPose::Part& part : pose.parts) {
    account.pose(part.pose, words_of(part.weight));
    account.tell(part.weight);
  }
}

std::unique_ptr<Operation> bound(const BlendPose& described, Binder& binder) {
  std::vector<Blended::Part> parts;
  bool nothing = true, whole = true;
  for (std::size_t i = 0; i < described.parts.size(); ++i) {
    const Place place = {"blend", std::to_string(i)};
    const Operation* pose = binder.pose(described.parts[i].pose, place);
    whole = whole && pose;
    Number weight = binder.number(described.parts[i].weight, place);
    const std::optional<double> said = weight.constant();
    if (said && !(*said >= 0 && std::isfinite(*said)))
      binder.fault(place, "a weight is 0 or more; it is " + number_text(*said));
    nothing = nothing && (said ? *said == 0 : weight.is_nothing_throughout());
    parts.push_back({pose, std::move(weight)});
  }
  if (parts.empty())
    binder.fault({"blend"}, "a blend has poses; this one has none");
  else if (nothing)
    binder.fault({"blend"}, "these weights sum to zero; give one above 0");
  if (parts.size() > most_blended)
    binder.fault({"blend"}, "a blend takes " + std::to_string(most_blended) + " poses at most; this one has " +
                                std::to_string(parts.size()) + ": blend blends of them");
  if (!whole || parts.empty() || parts.size() > most_blended) return nullptr;
  auto operation = std::make_unique<Blended>(std::move(parts));
  operation->set_rooms(described.parts.size());
  return operation;
}

}  // namespace tweenfall::graphs
