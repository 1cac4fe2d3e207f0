#include "crowd/choice.h"

#include <algorithm>
#include <limits>
#include <map>

namespace tweenfall::crowd {

namespace {

/// What a run has to save, of the whole.
constexpr double worth_a_run = 0.03;
constexpr std::size_t impossible = std::numeric_limits<std::size_t>::max() / 4;

/// Each channel in the best of its ways that are left. @returns all lines; `impossible` where a channel has no way
std::size_t best_ways(const std::vector<std::vector<Way>>& choices, const std::map<Form, bool>& left,
                      const Form* without, std::vector<Form>* out) {
  std::size_t lines = 0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Way* best = nullptr;
    for (const Way& way : choices[i]) {
      if ((without && way.form == *without) || !left.at(way.form)) continue;
      if (!best || way.lines < best->lines) best = &way;
    }
    if (!best) return impossible;
    lines += best->lines;
    if (out) (*out)[i] = best->form;
  }
  return lines;
}

}  // namespace

std::vector<Form> chosen(const std::vector<std::vector<Way>>& choices) {
  std::map<Form, bool> left;
  for (const std::vector<Way>& ways_of_one : choices)
    for (const Way& way : ways_of_one) left[way.form] = true;
  std::vector<Form> forms(choices.size());
  std::size_t lines = best_ways(choices, left, nullptr, nullptr);
  const double worth = worth_a_run * static_cast<double>(lines);
  // One form after the other is given up, as long as that costs less than a run may.
  while (true) {
    const Form* cheapest = nullptr;
    std::size_t least = impossible;
    for (const auto& [form, in_use] : left) {
      if (!in_use) continue;
      const std::size_t without = best_ways(choices, left, &form, nullptr);
      if (without < least) {
        least = without;
        cheapest = &form;
      }
    }
    if (!cheapest || static_cast<double>(least - lines) > worth) break;
    left[*cheapest] = false;
    lines = least;
  }
  best_ways(choices, left, nullptr, &forms);
  return forms;
}

}  // namespace tweenfall::crowd
