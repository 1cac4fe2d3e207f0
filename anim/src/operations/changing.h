#pragma once

// The common part of operations that change a pose: the pose, and how much they change it.

#include "graph/binder.h"

#include <algorithm>

namespace tweenfall::graphs {

/// The pose that is changed, or the pose below the graph, and by how much.
struct Changed {
  const Operation* base = nullptr;  // null: the pose below the graph
  Number weight{};
  bool whole = true;  // false where a fault was reported
};

class Changing : public Operation {
 public:
  explicit Changing(Changed changed) : changed_(std::move(changed)) {}

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    show_base(log, moment, scratch, out);
    const Sample<double> weight = as_share(changed_.weight.sample(log, moment.time, moment.side), moment.side);
    if (!is_nothing(weight)) change(log, moment, weight, scratch, out);
  }

  [[nodiscard]] std::span<const Operation* const> operands() const noexcept override {
    return {&changed_.base, changed_.base ? std::size_t{1} : std::size_t{0}};
  }

  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    if (changed_.base) changed_.base->bearers(log, moment, node, weight, out);
  }

 protected:
  /// @param weight not 0
  virtual void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch& scratch,
                      std::span<Motion> pose) const noexcept = 0;

  void show_base(const Log& log, const Moment& moment, const Scratch& scratch, std::span<Motion> out) const noexcept {
    if (changed_.base)
      changed_.base->pose(log, moment, scratch, out);
    else
      std::ranges::copy(scratch.below, out.begin());
  }
  [[nodiscard]] const Number& weight() const noexcept { return changed_.weight; }
  [[nodiscard]] const Operation* base() const noexcept { return changed_.base; }

 private:
  Changed changed_;
};

/// A weight from 0 to 1.
[[nodiscard]] Number bound_share(const GraphNumber& weight, const Place& place, Binder& binder);

/// @param word the operation's word in documents, where its weight is given
template <class Described>
[[nodiscard]] Changed bound_change(const Described& described, const char* word, Binder& binder) {
  Changed changed;
  if (!described.base.empty()) changed.base = binder.pose(described.base, {"base"});
  changed.whole = described.base.empty() || changed.base;
  changed.weight = bound_share(described.weight, {word, "weight"}, binder);
  return changed;
}

}  // namespace tweenfall::graphs
