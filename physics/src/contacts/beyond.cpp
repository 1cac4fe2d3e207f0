#include <algorithm>
#include <array>

#include "collision/passage.h"
#include "contacts/followers.h"
#include "state/world_data.h"

/// What is struck hard goes where nothing was going before the blow: what lies there is no pair of this step yet.

namespace tweenfall {

namespace contacts {
namespace {

/// In a crowd, what is struck soon meets others that are pairs already.
constexpr std::size_t most_beyond = 16;

/// Where the center of a body may be between a blow and the end of the step, with room for the body.
Bounds after_blow(const collision::Passage& way, const Struck& struck, double dt) {
  const Vec3 met = way.body->center + struck.time * way.course.linear;
  const Vec3 end = met + (dt - struck.time) * (way.course.linear + struck.change);
  const Vec3 around = Vec3::Constant(way.radius + near_enough_of(way));
  return {met.cwiseMin(end) - around, met.cwiseMax(end) + around};
}

}  // namespace
}  // namespace contacts

void World::Implementation::find_beyond(std::uint32_t index, std::span<contacts::FoundPart> parts, double dt) {
  if (!passages[index].simple || passages[index].boundless) return;
  const Bounds way = contacts::after_blow(passages[index], struck_bodies[index], dt);
  const pairs::PairFilter filter{bodies, ignored};
  std::array<std::uint32_t, contacts::most_beyond> near;
  std::size_t count = 0;
  broad_phase.visit_swept(
      way, [&] { return count <= near.size(); },
      [&](std::uint32_t other) {
        if (other == index || !filter.lets(index, other)) return;
        if (count < near.size()) near[count] = other;
        ++count;
      });
  if (count > near.size()) return;
  std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count));
  const auto pair_of = [](const auto& of) { return pairs::Pair(of.a, of.b); };
  const auto is_contact = [&](const pairs::Pair& pair) {
    const auto contact = std::lower_bound(active.begin(), active.end(), pair,
                                          [&](const auto* one, const auto& than) { return pair_of(*one) < than; });
    const std::span<contacts::ContactConstraint> made = followers.all();
    return (contact != active.end() && pair_of(**contact) == pair) ||
           std::any_of(made.begin(), made.end(), [&](const auto& one) { return pair_of(one) == pair; });
  };
  const std::span<const std::uint32_t> sorted = memories.sorted();
  const auto memory_of = [&](const pairs::Pair& pair) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), pair, [&](std::uint32_t place, const auto& than) {
      return pair_of(memories[place]) < than;
    });
    return at != sorted.end() && pair_of(memories[*at]) == pair ? *at : state::ContactMemories::nowhere;
  };
  for (const std::uint32_t other : std::span(near).first(count)) {
    const pairs::Pair pair(std::min(index, other), std::max(index, other));
    const auto is_it = [&](const contacts::Followers& one) { return pair_of(one.link) == pair; };
    if (looked_at[other] != look) {
      looked_at[other] = look;
      passages[other] = collision::passage_of(bodies[other], loads[other], dt);
    }
    if (!passages[other].simple || is_contact(pair) || std::any_of(beyond.begin(), beyond.end(), is_it)) continue;
    contacts::Followers follower;
    follower.link.a = pair.first;
    follower.link.b = pair.second;
    follower.memory = memory_of(pair);
    follower.known = false;
    // Whether it was among the others may depend on a direction of earlier steps, but no result must.
    for (contacts::FoundPart& part : parts)
      if (const auto known =
              std::ranges::lower_bound(part.followers, pair, {}, [&](const auto& one) { return pair_of(one.link); });
          known != part.followers.end() && is_it(*known)) {
        follower = *known;
        part.followers.erase(known);
      }
    follower.beyond = true;
    beyond.push_back(follower);
  }
}

}  // namespace tweenfall
