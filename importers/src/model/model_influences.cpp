#include "model/model_influences.h"

#include <algorithm>

namespace tweenfall {

void InfluenceTally::report(const std::string& place, ModelProblems& problems) const {
  if (dropped)
    problems.repair(place,
                    std::to_string(dropped) + " vertices follow more than four joints; the four strongest were kept");
  if (unbound)
    problems.repair(place, std::to_string(unbound) + " vertices have no weight and were hung on the first joint");
  if (negative)
    problems.repair(place, std::to_string(negative) + " vertices have a weight below 0, which was not read");
}

Influence strongest(std::vector<WeightedJoint> pulls, InfluenceTally& tally) {
  if (std::any_of(pulls.begin(), pulls.end(), [](const WeightedJoint& pull) { return pull.weight < 0; }))
    ++tally.negative;
  std::erase_if(pulls, [](const WeightedJoint& pull) { return !(pull.weight > 0); });
  std::stable_sort(pulls.begin(), pulls.end(),
                   [](const WeightedJoint& a, const WeightedJoint& b) { return a.weight > b.weight; });
  if (pulls.size() > 4) {
    ++tally.dropped;
    pulls.resize(4);
  }
  Influence result;
  if (pulls.empty()) {
    ++tally.unbound;
    result.weights[0] = 1;
    return result;
  }
  double sum = 0;
  for (const WeightedJoint& pull : pulls) sum += pull.weight;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    result.joints[i] = pulls[i].joint;
    result.weights[i] = pulls[i].weight / sum;
  }
  return result;
}

}  // namespace tweenfall
