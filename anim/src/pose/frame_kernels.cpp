#include "pose/frame_kernels.h"

#include <tweenfall/curves/reflection.h>

#include <cmath>

#include "pose/moving_frame.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::pose {

namespace {

TWEENFALL_POSE_INLINED MovingFrame read(const Mat3& linear, const Mat3& rate, const Vec3& origin,
                                        const Vec3& velocity) noexcept {
  MovingFrame frame;
  for (int i = 0; i < 3; ++i) frame.axes[i] = MovingColumn::read(linear.data() + 3 * i, rate.data() + 3 * i);
  frame.origin = MovingColumn::read(origin.data(), velocity.data());
  return frame;
}
TWEENFALL_POSE_INLINED MovingFrame read(const WorldFrame& world) noexcept {
  return read(world.linear, world.linear_rate, world.origin, world.velocity);
}
TWEENFALL_POSE_INLINED MovingFrame read(const WorldMotion& world) noexcept {
  return read(world.linear, world.linear_rate, world.motion.pose.position, world.motion.twist.linear);
}

[[gnu::always_inline]] inline void write(const MovingFrame& frame, Mat3& linear, Mat3& rate, Vec3& origin,
                                         Vec3& velocity) noexcept {
  for (int i = 0; i < 3; ++i) frame.axes[i].write(linear.data() + 3 * i, rate.data() + 3 * i);
  frame.origin.write(origin.data(), velocity.data());
}
[[gnu::always_inline]] inline void write(const MovingFrame& frame, WorldFrame& world) noexcept {
  write(frame, world.linear, world.linear_rate, world.origin, world.velocity);
}
[[gnu::always_inline]] inline void write(const MovingFrame& frame, WorldMotion& world) noexcept {
  write(frame, world.linear, world.linear_rate, world.motion.pose.position, world.motion.twist.linear);
}

/// Normalizes; near a length of 1, as for products of rotations, by one Newton step, which is exact to rounding.
[[gnu::always_inline]] inline Quat near_unit(const Quat& q) noexcept {
  const double excess = q.squaredNorm() - 1;
  if (!(std::abs(excess) < 1e-9)) return q.normalized();
  return Quat(q.coeffs() * (1 - 0.5 * excess));
}

// The rotation and scale that a motion has besides its frame.
[[gnu::always_inline]] inline void turn(const WorldFrame&, const Motion&, WorldFrame&) noexcept {}
[[gnu::always_inline]] inline void turn(const WorldMotion& parent, const Motion& local, WorldMotion& world) noexcept {
  const Motion& above = parent.motion;
  Motion& motion = world.motion;
  Quat rotation = local.pose.rotation;
  Vec3 angular = local.twist.angular;
  const Vec3& scale = above.pose.scale;
  if (scale[0] < 0 || scale[1] < 0 || scale[2] < 0) [[unlikely]] {
    const Vec3 reflection = reflection_of(scale);
    rotation = reflected_by(reflection, rotation);
    angular = reflection.cwiseProduct(angular);
  }
  motion.pose.rotation = near_unit(above.pose.rotation * rotation);
  motion.pose.scale = above.pose.scale.cwiseProduct(local.pose.scale);
  motion.twist.angular = above.twist.angular + above.pose.rotation * angular;
  motion.scale_rate = above.scale_rate.cwiseProduct(local.pose.scale) + above.pose.scale.cwiseProduct(local.scale_rate);
}

[[gnu::always_inline]] inline void place(const WorldMotion& parent, const Motion& local, WorldMotion& world) noexcept {
  write(child_frame(read(parent), local), world);
  turn(parent, local, world);
}

template <class World>
[[gnu::always_inline]] inline void walk(const std::uint32_t* parents, std::size_t count, const Motion* local,
                                        World* world) noexcept {
  const World outside;
  MovingFrame frame = read(outside);
  for (std::size_t i = 0; i < count; ++i) {
    const World& above = parents[i] == no_parent ? outside : world[parents[i]];
    // Most nodes directly follow their parents, whose frame is then still at hand and need not be read back.
    if (parents[i] + std::size_t{1} != i) frame = read(above);
    frame = child_frame(frame, local[i]);
    write(frame, world[i]);
    turn(above, local[i], world[i]);
  }
}

// The same source for each instruction set. None of them has a fused multiply and add, so the bits are the same.
#define TWEENFALL_FRAME_VERSIONS(name, target)                                                                         \
  target void frames_##name(const std::uint32_t* parents, std::size_t count, const Motion* local, WorldFrame* world) { \
    walk(parents, count, local, world);                                                                                \
  }                                                                                                                    \
  target void motions_##name(const std::uint32_t* parents, std::size_t count, const Motion* local,                     \
                             WorldMotion* world) {                                                                     \
    walk(parents, count, local, world);                                                                                \
  }                                                                                                                    \
  target void child_##name(const WorldMotion& parent, const Motion& local, WorldMotion& world) {                       \
    place(parent, local, world);                                                                                       \
  }                                                                                                                    \
  constexpr FrameKernels name##_kernels = {frames_##name, motions_##name, child_##name};

TWEENFALL_FRAME_VERSIONS(plain, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_FRAME_VERSIONS(avx2, [[gnu::target("avx2")]])
#endif
#undef TWEENFALL_FRAME_VERSIONS

}  // namespace

const FrameKernels& plain_frame_kernels() noexcept {
  return plain_kernels;
}

const FrameKernels& fastest_frame_kernels() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  if (__builtin_cpu_supports("avx2")) return avx2_kernels;
#endif
  return plain_kernels;
}

}  // namespace tweenfall::pose
