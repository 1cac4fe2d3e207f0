#include "operations/operation.h"

#include <algorithm>

namespace tweenfall::graphs {

void Operation::events(const Log& log, const Stretch& stretch, std::vector<GraphEvent>& out) const {
  const std::span<const Operation* const> poses = operands();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::size_t first = out.size();
    poses[i]->events(log, stretch, out);
    for (std::size_t e = first; e < out.size(); ++e) out[e].weight *= share(log, i, out[e].time);
  }
}

std::optional<double> Operation::next_event(const Log& log, std::string_view name, double start, double after,
                                            double until) const {
  std::optional<double> first;
  for (const Operation* pose : operands())
    if (const std::optional<double> next = pose->next_event(log, name, start, after, first.value_or(until)))
      first = next;
  return first;
}

std::optional<double> Operation::next_jump(const Log& log, double start, const Search& search) const {
  std::optional<double> first;
  for (const Operation* pose : operands())
    if (const auto next = pose->next_jump(log, start, search.up_to(first.value_or(search.until)))) first = next;
  return first;
}

double Operation::end(const Log& log, double start) const noexcept {
  double latest = 0;
  for (const Operation* pose : operands()) latest = std::max(latest, pose->end(log, start));
  return latest;
}

}  // namespace tweenfall::graphs
