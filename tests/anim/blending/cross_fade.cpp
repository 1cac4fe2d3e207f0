#include <tweenfall/anim/blend.h>

#include "anim/moving_pose.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::vector<Motion> cross_faded(std::uint64_t seed, double t, const JointMask& mask) {
  const auto a = moving_pose(seed, pose_size, t), b = moving_pose(seed + 100, pose_size, t);
  std::vector<Motion> out(pose_size);
  cross_fade(a, b, moving_weight(t), out, mask);
  return out;
}

JointMask some_mask() {
  std::vector<double> weights;
  for (std::size_t i = 0; i < pose_size; ++i) weights.push_back(static_cast<double>(i % 5) / 4);
  return JointMask(weights);
}

}  // namespace

TEST_CASE("a cross-fade at weight 0 and at weight 1 is the input, bit for bit, and may be written over it") {
  const auto a = moving_pose(1, pose_size, 0.2), b = moving_pose(2, pose_size, 0.2);
  std::vector<Motion> out(pose_size);
  cross_fade(a, b, {0, 0, 0}, out);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(same_bits(out[i], a[i]));
  cross_fade(out, b, {1, 0, 0}, out);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(same_bits(out[i], b[i]));
}

TEST_CASE("the rates of a masked cross-fade are the derivatives of its poses, the weight's rate included") {
  for (const JointMask& mask : {JointMask(), some_mask()})
    for (std::size_t i = 0; i < pose_size; ++i)
      check_rates([&, i](double t) { return cross_faded(7, t, mask)[i]; }, 0.1);
}

TEST_CASE("a joint whose mask is 0 keeps the lower pose bit for bit, one whose mask is 1 is as without a mask") {
  const auto a = moving_pose(7, pose_size, 0.1);
  const auto masked = cross_faded(7, 0.1, some_mask()), whole = cross_faded(7, 0.1, {});
  for (std::size_t i = 0; i < pose_size; ++i) {
    if (i % 5 == 0) CHECK(same_bits(masked[i], a[i]));
    if (i % 5 == 4) CHECK(same_bits(masked[i], whole[i]));
  }
}

TEST_CASE("at weight 0 that grows the pose is the lower one and its rate has the upper one's pull") {
  const auto a = moving_pose(1, 1, 0.2), b = moving_pose(2, 1, 0.2);
  Motion out[1];
  cross_fade(a, b, {0, 2, 0}, out);
  CHECK(out[0].pose.position == a[0].pose.position);
  CHECK(out[0].pose.rotation.coeffs() == a[0].pose.rotation.coeffs());
  CHECK(near(out[0].twist.linear, a[0].twist.linear + 2 * (b[0].pose.position - a[0].pose.position), 1e-15));
  const Vec3 turn = log_map(b[0].pose.rotation * a[0].pose.rotation.conjugate());
  CHECK(near(out[0].twist.angular, a[0].twist.angular + 2 * turn, 1e-12));
}
