#include <bit>

#include "state/world_data.h"

namespace tweenfall {

namespace state {
namespace {

/// FNV-1a over 64-bit words with a final mix.
/// Source: Fowler, Noll, Vo, The FNV Non-Cryptographic Hash Algorithm, IETF draft; splitmix64's finalizer.
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ ^= word;
    value_ *= 0x100000001b3u;
    value_ ^= value_ >> 29;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec3& value) {
    for (int i = 0; i < 3; ++i) add(value[i]);
  }
  void add(const Motion& motion) {
    add(motion.pose.position);
    for (int i = 0; i < 4; ++i) add(motion.pose.rotation.coeffs()[i]);
    add(motion.pose.scale);
    add(motion.twist.linear);
    add(motion.twist.angular);
    add(motion.scale_rate);
  }
  std::uint64_t value() const {
    std::uint64_t z = value_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace
}  // namespace state

std::uint64_t World::state_hash() const noexcept {
  if (!implementation_) return 0;
  const Implementation& world = *implementation_;
  state::Hash hash;
  hash.add(world.time);
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
    const state::Body& body = world.bodies[i];
    if (!body.alive) continue;
    hash.add(std::uint64_t{i} << 32 | body.generation);
    hash.add(body.motion);
    hash.add(body.center);
    hash.add(body.twist.linear);
    hash.add(body.twist.angular);
    hash.add(body.drive.hz);
    hash.add(body.drive.zeta);
    hash.add(body.drive.max_force);
    hash.add(body.drive.max_torque);
    hash.add(body.target);
    hash.add(std::uint64_t{body.has_target} | std::uint64_t{body.placed} << 1 | std::uint64_t{body.led} << 2);
    hash.add(body.force);
    hash.add(body.torque);
    hash.add(body.reaction);
    hash.add(body.still_for);
    hash.add(std::uint64_t{body.asleep});
    const BodySettings usual;
    if (body.groups == usual.groups && body.collides_with == usual.collides_with) continue;
    hash.add(body.groups);
    hash.add(body.collides_with);
  }
  for (const state::IgnoredPairs::Entry& pair : world.ignored.all()) {
    hash.add(std::uint64_t{pair.a} << 32 | pair.b);
    hash.add(std::uint64_t{pair.holders} << 1 | std::uint64_t{pair.asked});
  }
  for (const std::uint32_t place : world.memories.sorted()) {
    const state::ContactMemory& memory = world.memories[place];
    if (memory.gone) continue;
    hash.add(std::uint64_t{memory.a} << 32 | memory.b);
    hash.add(memory.kept.kept_rolling);
    hash.add(memory.kept.kept_step);
    hash.add(memory.kept.passed_over);
    hash.add(std::uint64_t{memory.touching});
    for (int i = 0; i < memory.count; ++i) {
      const state::PointMemory& point = memory.points[static_cast<std::size_t>(i)];
      hash.add(std::uint64_t{point.feature});
      hash.add(point.kept_normal);
      hash.add(point.kept_friction);
    }
  }
  return hash.value();
}

}  // namespace tweenfall
