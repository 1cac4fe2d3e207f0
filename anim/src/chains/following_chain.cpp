#include <tweenfall/anim/following_chain.h>

#include "chains/chain_follow.h"
#include "chains/chain_solve.h"
#include "chains/moving.h"
#include "chains/state_bytes.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace chains {

double follow_from(const JointChain& chain, const Sample<Vec3>& target, double seconds, const Sample<double>& weight,
                   std::span<const Quat> before, std::span<Quat> after, double since_search,
                   std::span<Motion> pose) noexcept {
  constexpr double homewards = 0.2;  // s; the time constant
  constexpr double patience = 0.25;  // s; between searches in vain
  constexpr double reached = std::numeric_limits<double>::infinity();
  double searched = reached;
  const std::size_t count = chain.joints().size();
  const WorldMotion parent = above(chain.nodes(), chain.joints().front().node, pose);
  const Inward inward(parent);
  const ChainShape home(chain, pose);
  ChainShape shape = home;
  if (!inward.flat() && home.reach().v > 0) {
    const Arrow place = inward.point(arrow(target));
    if (!chain.limited()) {
      reach_freely(chain, place, shape);
    } else if (before.size() != count) {
      reach_within_limits(chain, place, shape);
      if (length(place - shape.end()).v > 1e-9 * shape.reach().v) searched = 0;
    } else {
      for (std::size_t i = 0; i < count; ++i)
        shape.turn(i, within_limits(chain.joints()[i], Turning{before[i], Vec3(0, 0, 0)}));
      shape.place();
      const double left = elementary::exp(-seconds / homewards);
      const bool searches = since_search + seconds >= patience;
      if (!follow_within_limits(chain, place, home, {1 - left, left / homewards}, searches, shape))
        searched = searches ? 0 : since_search + seconds;
    }
  } else {
    for (std::size_t i = 0; i < count && before.size() == count; ++i) shape.turn(i, {before[i], Vec3(0, 0, 0)});
  }
  for (std::size_t i = 0; i < after.size(); ++i) after[i] = shape.turn(i).v;
  if (is_nothing(weight) || inward.flat()) return searched;
  for (std::size_t i = 0; i < count; ++i) turn_to(pose[chain.joints()[i].node], shape.local(i), weight);
  return searched;
}

}  // namespace chains

bool ChainMemory::operator==(const ChainMemory& other) const noexcept {
  return since_search == other.since_search &&
         std::ranges::equal(turns, other.turns, [](const Quat& a, const Quat& b) { return a.coeffs() == b.coeffs(); });
}

std::vector<std::byte> ChainMemory::bytes() const {
  chains::StateWriter out;
  out.real(std::isfinite(since_search) ? since_search : -1);
  out.number(static_cast<std::int64_t>(turns.size()));
  for (const Quat& turn : turns) {
    out.vector(turn.vec());
    out.real(turn.w());
  }
  return out.bytes;
}

ChainMemory ChainMemory::from_bytes(std::span<const std::byte> bytes) {
  chains::StateReader in{bytes, "chain memory"};
  if (bytes.size() < 16 || (bytes.size() - 16) % 32 != 0) in.require_size(16);
  const std::size_t count = (bytes.size() - 16) / 32;
  ChainMemory memory;
  if (const double since = in.real(); since >= 0)
    memory.since_search = since;
  else if (since != -1)
    throw std::invalid_argument("chain memory: its search is still to come");
  const std::int64_t told = in.number();
  if (told != static_cast<std::int64_t>(count))
    throw std::invalid_argument("chain memory: it says that it has " + std::to_string(told) + " joints and has " +
                                std::to_string(count));
  memory.turns.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = in.vector();
    const double w = in.real();
    const double square = v.squaredNorm() + w * w;
    if (!(std::abs(square - 1) < 1e-6))
      throw std::invalid_argument("chain memory: the turn of joint " + std::to_string(i + 1) + " is no rotation");
    memory.turns.emplace_back(w, v.x(), v.y(), v.z());
  }
  return memory;
}

void follow(const JointChain& chain, const Sample<Vec3>& target, double seconds, const Sample<double>& weight,
            ChainMemory& memory, std::span<Motion> pose) noexcept {
  const std::size_t count = chain.joints().size();
  if (memory.turns.size() == count) {
    memory.since_search =
        chains::follow_from(chain, target, seconds, weight, memory.turns, memory.turns, memory.since_search, pose);
    return;
  }
  memory.turns.resize(count, Quat(1, 0, 0, 0));
  memory.since_search = chains::follow_from(chain, target, seconds, weight, {}, memory.turns, 0, pose);
}

}  // namespace tweenfall
