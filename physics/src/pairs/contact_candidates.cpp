#include "pairs/contact_candidates.h"

#include <array>

namespace tweenfall::pairs {

std::size_t reduce_to_four(std::span<ContactCandidate> candidates, const Vec3& normal, const Vec3& leaning) noexcept {
  if (candidates.size() <= 4) return candidates.size();
  std::array<ContactCandidate, 4> chosen;
  const auto pick = [&](const auto& score) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < candidates.size(); ++i)
      if (score(candidates[i]) > score(candidates[best]) + 1e-9) best = i;
    return candidates[best];
  };
  // Equal depths differ only by rounding: the position decides between them.
  chosen[0] = pick([&](const ContactCandidate& c) { return -c.gap + 1e-3 * leaning.dot(c.position); });
  chosen[1] = pick([&](const ContactCandidate& c) { return (c.position - chosen[0].position).squaredNorm(); });
  const Vec3 side = normal.cross(chosen[1].position - chosen[0].position);
  chosen[2] = pick([&](const ContactCandidate& c) { return side.dot(c.position - chosen[0].position); });
  chosen[3] = pick([&](const ContactCandidate& c) { return -side.dot(c.position - chosen[0].position); });
  std::size_t count = 0;
  for (const ContactCandidate& candidate : chosen) {
    bool known = false;
    for (std::size_t i = 0; i < count; ++i) known = known || candidates[i].feature == candidate.feature;
    if (!known) candidates[count++] = candidate;
  }
  return count;
}

}  // namespace tweenfall::pairs
