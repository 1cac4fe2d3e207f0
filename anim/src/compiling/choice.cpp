#include "compiling/choice.h"

#include <algorithm>
#include <limits>
#include <map>

namespace tweenfall::crowd {

namespace {

/// The share of the whole cost that an additional run has to save; where time counts also the cost of one channel, for
/// sampling a run takes as much longer.
constexpr double worth_a_run = 0.03;
constexpr double impossible = std::numeric_limits<double>::infinity();

/// Stores each channel in the best of its remaining ways. @returns the total cost; `impossible` where a channel has
/// none
double best_ways(const std::vector<std::vector<Way>>& choices, const std::map<Form, bool>& left, const Form* without,
                 std::vector<Form>* out) {
  double cost = 0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Way* best = nullptr;
    for (const Way& way : choices[i]) {
      if ((without && way.form == *without) || !left.at(way.form)) continue;
      if (!best || way.cost < best->cost) best = &way;
    }
    if (!best) return impossible;
    cost += best->cost;
    if (out) (*out)[i] = best->form;
  }
  return cost;
}

}  // namespace

std::vector<Form> chosen(const std::vector<std::vector<Way>>& choices, bool smallest) {
  std::map<Form, bool> left;
  for (const std::vector<Way>& ways_of_one : choices)
    for (const Way& way : ways_of_one) left[way.form] = true;
  std::vector<Form> forms(choices.size());
  double cost = best_ways(choices, left, nullptr, nullptr);
  const double of_time = smallest ? 0 : 1 / static_cast<double>(choices.size());
  const double worth = cost * std::max(worth_a_run, of_time);
  // Gives up one form after the other, as long as that costs less than a run may.
  while (true) {
    const Form* cheapest = nullptr;
    double least = impossible;
    for (const auto& [form, in_use] : left) {
      if (!in_use) continue;
      const double without = best_ways(choices, left, &form, nullptr);
      if (without < least) {
        least = without;
        cheapest = &form;
      }
    }
    if (!cheapest || least - cost > worth) break;
    left[*cheapest] = false;
    cost = least;
  }
  best_ways(choices, left, nullptr, &forms);
  return forms;
}

}  // namespace tweenfall::crowd
