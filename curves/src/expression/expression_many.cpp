#include "expression/expression_many.h"

#include <algorithm>
#include <limits>

namespace tweenfall {

namespace expressions {

namespace {

using Step = Expression::Program::Step;

constexpr std::size_t no_variable = std::numeric_limits<std::size_t>::max();
constexpr std::size_t power = kinds::All::place_of<kinds::Power>();

constexpr bool prepares(std::size_t kind) noexcept {
  return kind == power || kind == kinds::All::place_of<kinds::Sine>() ||
         kind == kinds::All::place_of<kinds::Cosine>() || kind == kinds::All::place_of<kinds::Exponential>() ||
         kind == kinds::All::place_of<kinds::Logarithm>();
}

constexpr std::array<double, most_lanes> zeros{};
constexpr std::array<double, most_lanes> ones = [] {
  std::array<double, most_lanes> all{};
  all.fill(1);
  return all;
}();

/// The stack machine of one expression, each of whose places holds a number per lane, or one for all lanes.
template <class Number>
class Machine {
 public:
  Machine(const KernelsOf<Number>& kernels, const std::vector<Step>& steps, VariableLists variables,
          double way) noexcept
      : kernels_(kernels), steps_(steps), variables_(variables), way_(way) {}

  /// What was prepared for other sets of variables is of no more use.
  void forget() noexcept {
    for (Prepared& each : prepared_) each.count = 0;
  }

  /// @param begin, count  which of the `all` sets of variables
  /// @param by            the variable that moves
  /// @param part          what of the result is written: value or rate
  /// @return false if numbers that stand still do not tell the result
  bool run(std::size_t all, std::size_t begin, std::size_t count, std::size_t by, std::size_t part,
           double* out) noexcept {
    std::size_t top = 0;
    by_ = by;
    calls_ = 0;
    free_ = static_cast<int>(buffers_.size());
    for (int i = 0; i < free_; ++i) unused_[static_cast<std::size_t>(i)] = free_ - 1 - i;
    for (const Step& step : steps_) {
      if (!step.function) {
        stack_[top++] = step.variable < 0 ? Place{.number = math::constant(step.number)}
                                          : variable(static_cast<std::size_t>(step.variable), all, begin);
        continue;
      }
      top -= static_cast<std::size_t>(step.function->count);
      if (!call(*step.function, &stack_[top], count)) return false;
      ++top;
    }
    const Place& result = stack_[0];
    if (result.buffer == one_for_all)
      std::fill_n(out, count, part == 0 ? result.number.v : result.number.d);
    else
      std::copy_n(result.lists[part], count, out);
    return true;
  }

 private:
  static constexpr int one_for_all = -1, of_caller = -2;
  struct Place {
    Jet number;  ///< for all lanes: with its rates, even where those of the lanes stand still
    int buffer = one_for_all;
    LanesView<Number> lists{};
  };

  [[nodiscard]] Place variable(std::size_t index, std::size_t all, std::size_t begin) const noexcept {
    const bool moves = index == by_;
    const std::span<const double> list = index < variables_.size() ? variables_[index] : std::span<const double>();
    if (list.size() < all || all == 1) return {.number = {list.empty() ? 0 : list[0], moves ? 1.0 : 0.0, 0}};
    Place place;
    place.buffer = of_caller;
    place.lists[0] = list.data() + begin;
    if constexpr (parts_of < Number >> 1) {
      place.lists[1] = moves ? ones.data() : zeros.data();
      place.lists[2] = zeros.data();
    }
    return place;
  }

  bool call(const ExpressionFunction& function, Place* arguments, std::size_t count) noexcept {
    const std::span<Place> given(arguments, static_cast<std::size_t>(function.count));
    if (std::ranges::all_of(given, [](const Place& place) { return place.buffer == one_for_all; })) {
      Jet numbers[3];
      std::ranges::transform(given, numbers, &Place::number);
      arguments[0] = {.number = function.apply(numbers, way_)};
      return true;
    }
    const Place& last = given.back();
    const bool fixed_power =
        function.kind == power && last.buffer == one_for_all && last.number.d == 0 && last.number.dd == 0;
    if (function.kind == power && !fixed_power && parts_of<Number> == 1) return false;
    Prepared& prepared = prepared_[std::min(calls_, prepared_.size() - 1)];
    // Of very long expressions the last calls share a place, and prepare each time.
    if (calls_ + 1 >= prepared_.size()) prepared.count = 0;
    if (prepares(function.kind)) ++calls_;
    const int target = take();
    Lanes<Number>& out = buffers_[static_cast<std::size_t>(target)];
    if (fixed_power) {
      kernels_.raise(arguments[0].lists, last.number.v, count, prepared, out);
    } else {
      std::array<LanesView<Number>, 3> views;
      for (Place& place : given) {
        if (place.buffer == one_for_all) spread(place, count);
        views[static_cast<std::size_t>(&place - arguments)] = place.lists;
      }
      kernels_.functions[function.kind](views.data(), count, way_, prepared, out);
    }
    for (const Place& place : given)
      if (place.buffer >= 0) unused_[static_cast<std::size_t>(free_++)] = place.buffer;
    arguments[0] = in_buffer(target);
    return true;
  }

  /// The same number for each lane.
  void spread(Place& place, std::size_t count) noexcept {
    const Jet number = place.number;
    place = in_buffer(take());
    Lanes<Number>& lanes = buffers_[static_cast<std::size_t>(place.buffer)];
    const std::array<double, 3> parts{number.v, number.d, number.dd};
    for (std::size_t part = 0; part < parts_of<Number>; ++part) std::fill_n(lanes[part].begin(), count, parts[part]);
  }

  [[nodiscard]] int take() noexcept { return unused_[static_cast<std::size_t>(--free_)]; }
  [[nodiscard]] Place in_buffer(int buffer) const noexcept {
    Place place;
    place.buffer = buffer;
    for (std::size_t part = 0; part < parts_of<Number>; ++part)
      place.lists[part] = buffers_[static_cast<std::size_t>(buffer)][part].data();
    return place;
  }

  const KernelsOf<Number>& kernels_;
  const std::vector<Step>& steps_;
  VariableLists variables_;
  double way_;
  std::size_t by_ = no_variable, calls_ = 0;
  std::array<Place, Expression::Program::most_depth> stack_;
  // One more than places, for a result is written elsewhere than what it follows from.
  std::array<Lanes<Number>, Expression::Program::most_depth + 1> buffers_;
  std::array<int, Expression::Program::most_depth + 1> unused_;
  int free_ = 0;
  std::array<Prepared, 8> prepared_;
};

template <class Number>
bool run_values(const ExpressionKernels& kernels, const Expression::Program& program, VariableLists variables,
                std::span<double> out) noexcept {
  Machine<Number> machine(kernels.of<Number>(), program.steps, variables, 1);
  for (std::size_t begin = 0; begin < out.size(); begin += most_lanes) {
    machine.forget();
    if (!machine.run(out.size(), begin, std::min(most_lanes, out.size() - begin), no_variable, 0, out.data() + begin))
      return false;
  }
  return true;
}

}  // namespace

void find_values(const ExpressionKernels& kernels, const Expression::Program& program, VariableLists variables,
                 std::span<double> out) noexcept {
  // A power with a moving exponent has a value of its own where the exponent has no rate.
  if (!run_values<Still>(kernels, program, variables, out)) run_values<Jet>(kernels, program, variables, out);
}

void find_slopes(const ExpressionKernels& kernels, const Expression::Program& program, VariableLists variables,
                 std::size_t first, double way, std::span<const std::span<double>> out) noexcept {
  if (out.empty()) return;
  Machine<Jet> machine(kernels.of<Jet>(), program.steps, variables, way);
  const std::size_t all = out.front().size();
  for (std::size_t begin = 0; begin < all; begin += most_lanes) {
    machine.forget();
    for (std::size_t i = 0; i < out.size(); ++i)
      (void)machine.run(all, begin, std::min(most_lanes, all - begin), first + i, 1, out[i].data() + begin);
  }
}

}  // namespace expressions

void Expression::values(std::span<const std::span<const double>> variables, std::span<double> out) const noexcept {
  static const expressions::ExpressionKernels& fastest = *expressions::expression_kernels().back();
  expressions::find_values(fastest, *program_, variables, out);
}

void Expression::slopes(std::span<const std::span<const double>> variables, std::size_t first,
                        std::span<const std::span<double>> out, Side side) const noexcept {
  static const expressions::ExpressionKernels& fastest = *expressions::expression_kernels().back();
  expressions::find_slopes(fastest, *program_, variables, first, side == Side::out ? 1 : -1, out);
}

}  // namespace tweenfall
