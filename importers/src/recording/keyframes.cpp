#include "recording/keyframes.h"

#include <algorithm>
#include <utility>

namespace tweenfall::recordings {

std::vector<std::size_t> key_frames(const std::vector<double>& times, const std::vector<std::vector<Vec2>>& points,
                                    double tolerance, std::span<const std::size_t> starts) {
  std::vector<std::size_t> kept;
  if (times.empty()) return kept;
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  const auto add = [&](std::size_t first, std::size_t last) {
    kept.insert(kept.end(), {first, last});
    stretches.emplace_back(first, last);
  };
  std::size_t from = 0;
  for (const std::size_t start : starts) {
    add(from, start - 1);
    from = start;
  }
  add(from, times.size() - 1);
  while (!stretches.empty()) {
    const auto [first, last] = stretches.back();
    stretches.pop_back();
    double worst = tolerance * tolerance;
    std::size_t split = first;
    for (std::size_t frame = first + 1; frame < last; ++frame) {
      const double u = (times[frame] - times[first]) / (times[last] - times[first]);
      for (std::size_t i = 0; i < points[frame].size(); ++i) {
        const Vec2 straight = points[first][i] + u * (points[last][i] - points[first][i]);
        const double away = (points[frame][i] - straight).squaredNorm();
        if (away > worst) {
          worst = away;
          split = frame;
        }
      }
    }
    if (split == first) continue;
    kept.push_back(split);
    stretches.emplace_back(first, split);
    stretches.emplace_back(split, last);
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace tweenfall::recordings
