#include <tweenfall/anim/following_chain.h>

#include "chains/chain_follow.h"
#include "chains/chain_solve.h"
#include "chains/moving.h"
#include "chains/state_bytes.h"

#include <algorithm>

namespace tweenfall {

namespace chains {

void follow_from(const JointChain& chain, const Sample<Vec3>& target, double seconds, const Sample<double>& weight,
                 std::span<const Quat> before, std::span<Quat> after, std::span<Motion> pose) noexcept {
  constexpr double homewards = 0.2;  // s; the time constant
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
    } else {
      for (std::size_t i = 0; i < count; ++i)
        shape.turn(i, within_limits(chain.joints()[i], Turning{before[i], Vec3(0, 0, 0)}));
      shape.place();
      const double left = elementary::exp(-seconds / homewards);
      follow_within_limits(chain, place, home, {1 - left, left / homewards}, shape);
    }
  } else {
    for (std::size_t i = 0; i < count && before.size() == count; ++i) shape.turn(i, {before[i], Vec3(0, 0, 0)});
  }
  for (std::size_t i = 0; i < after.size(); ++i) after[i] = shape.turn(i).v;
  if (is_nothing(weight) || inward.flat()) return;
  for (std::size_t i = 0; i < count; ++i) turn_to(pose[chain.joints()[i].node], shape.local(i), weight);
}

}  // namespace chains

bool ChainMemory::operator==(const ChainMemory& other) const noexcept {
  return std::ranges::equal(turns, other.turns, [](const Quat& a, const Quat& b) { return a.coeffs() == b.coeffs(); });
}

std::vector<std::byte> ChainMemory::bytes() const {
  chains::StateWriter out;
  out.number(static_cast<std::int64_t>(turns.size()));
  for (const Quat& turn : turns) {
    out.vector(turn.vec());
    out.real(turn.w());
  }
  return out.bytes;
}

ChainMemory ChainMemory::from_bytes(std::span<const std::byte> bytes) {
  chains::StateReader in{bytes, "chain memory"};
  if (bytes.size() < 8 || (bytes.size() - 8) % 32 != 0) in.require_size(8);
  const std::size_t count = (bytes.size() - 8) / 32;
  const std::int64_t told = in.number();
  if (told != static_cast<std::int64_t>(count))
    throw std::invalid_argument("chain memory: it says that it has " + std::to_string(told) + " joints and has " +
                                std::to_string(count));
  ChainMemory memory;
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
    chains::follow_from(chain, target, seconds, weight, memory.turns, memory.turns, pose);
    return;
  }
  memory.turns.resize(count, Quat(1, 0, 0, 0));
  chains::follow_from(chain, target, seconds, weight, {}, memory.turns, pose);
}

}  // namespace tweenfall
