#include "model/model_influences.h"

#include <algorithm>

namespace tweenfall::models {

void InfluenceTally::report(const std::string& place, ModelProblems& problems) const {
  if (unbound)
    problems.repair(place, counted(unbound, "vertex has no weight and was bound to the first joint",
                                   "vertices have no weight and were bound to the first joint"));
  if (negative)
    problems.repair(place, counted(negative, "vertex has a weight below 0, which was not read",
                                   "vertices have a weight below 0, which was not read"));
}

std::vector<Influence> summing_to_one(std::vector<Influence> pulls, InfluenceTally& tally) {
  if (std::any_of(pulls.begin(), pulls.end(), [](const Influence& pull) { return pull.weight < 0; })) ++tally.negative;
  std::erase_if(pulls, [](const Influence& pull) { return !(pull.weight > 0); });
  std::stable_sort(pulls.begin(), pulls.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  if (pulls.empty()) {
    ++tally.unbound;
    return {{0, 1}};
  }
  double sum = 0;
  for (const Influence& pull : pulls) sum += pull.weight;
  for (Influence& pull : pulls) pull.weight /= sum;
  return pulls;
}

}  // namespace tweenfall::models
