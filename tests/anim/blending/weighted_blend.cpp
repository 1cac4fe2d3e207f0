#include <tweenfall/anim/blend.h>

#include "anim/moving_pose.h"
#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::vector<Motion> rest_pose(double t = 0) {
  return moving_near(900, pose_size, t);
}

// As many layers as weights, the i-th pose of seed i.
std::vector<Motion> blended(std::span<const Sample<double>> weights, double t, double least = least_weight,
                            const JointMask* mask_of_first = nullptr) {
  std::vector<std::vector<Motion>> poses;
  std::vector<PoseLayer> layers(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) poses.push_back(moving_near(i, pose_size, t));
  for (std::size_t i = 0; i < weights.size(); ++i) layers[i] = {poses[i], weights[i], i == 0 ? mask_of_first : nullptr};
  std::vector<Motion> out(pose_size);
  blend(layers, rest_pose(t), out, least);
  return out;
}

}  // namespace

TEST_CASE("the rates of a blend by any number of moving weights are the derivatives of its poses") {
  const JointMask mask(std::vector<double>{0, 0.25, 0.5, 1, 1, 0.75});
  for (const std::size_t count : {1, 2, 3, 5, 16, 17, 40})
    for (const double least : {0.0, least_weight, 1000.0})
      for (std::size_t joint = 0; joint < pose_size; joint += count < 10 ? 1 : 3) {
        CAPTURE(count);
        const auto at = [&](double t) {
          std::vector<Sample<double>> weights;
          for (std::size_t i = 0; i < count; ++i)
            weights.push_back(moving_weight(t, 0.1 + 0.04 * static_cast<double>(i)));
          return blended(weights, t, least, &mask)[joint];
        };
        check_rates(at, 0.1, 5e-9);
      }
}

TEST_CASE("a blend of one pose is that pose, bit for bit, whatever its weight and however it moves") {
  for (const Sample<double>& weight : {Sample<double>{1, 0, 0}, Sample<double>{0.3, 5, 1}, Sample<double>{40, 0, 0}}) {
    const auto pose = moving_near(0, pose_size, 0.3), out = blended(std::vector{weight}, 0.3);
    for (std::size_t i = 0; i < pose_size; ++i) CHECK(same_bits(out[i], pose[i]));
    const std::vector<Sample<double>> among{weight, {0, 0, 0}, {-3, 1, 0}};
    const auto same = blended(among, 0.3);
    for (std::size_t i = 0; i < pose_size; ++i) CHECK(same_bits(same[i], pose[i]));
  }
}

TEST_CASE("weights that sum to nothing give the rest pose bit for bit, and next to nothing nearly so") {
  const auto rest = rest_pose(0.3);
  for (const double least : {0.0, least_weight}) {
    const std::vector<Sample<double>> none{{0, 0, 0}, {0, 0, 0}, {-1, 3, 0}};
    const auto out = blended(none, 0.3, least);
    const auto empty = blended({}, 0.3, least);
    for (std::size_t i = 0; i < pose_size; ++i) {
      CHECK(same_bits(out[i], rest[i]));
      CHECK(same_bits(empty[i], rest[i]));
    }
  }
  const std::vector<Sample<double>> little{{1e-9, 0, 0}, {1e-9, 0, 0}};
  const auto out = blended(little, 0.3);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(near(out[i], rest[i], 1e-6));
}

TEST_CASE("a weight too small to be told from nothing, or too large for a sum, is no fault") {
  for (const Sample<double>& weight : {Sample<double>{1e-320, 1e300, 0}, Sample<double>{1e308, 1, 0}}) {
    const std::vector<Sample<double>> both{weight, weight, weight};
    for (const double least : {0.0, least_weight})
      for (const Motion& motion : blended(both, 0.3, least)) CHECK(std::isfinite(motion.pose.position.sum()));
  }
}

TEST_CASE("the order of poses does not matter to their blend, nor the signs of their rotations") {
  const double t = 0.2;
  std::vector<std::vector<Motion>> poses;
  for (std::uint64_t i = 0; i < 5; ++i) poses.push_back(moving_near(i, pose_size, t));
  std::vector<PoseLayer> layers(5);
  for (std::size_t i = 0; i < 5; ++i) layers[i] = {poses[i], moving_weight(t, 0.1 + 0.1 * static_cast<double>(i))};
  std::vector<Motion> first(pose_size), turned(pose_size);
  blend(layers, rest_pose(), first);
  std::ranges::reverse(layers);
  for (Motion& motion : poses[2]) motion.pose.rotation.coeffs() *= -1;
  blend(layers, rest_pose(), turned);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(near(turned[i], first[i], 1e-12));
}

TEST_CASE("a blend of two is their cross-fade, and goes into it smoothly as the third weight fades") {
  const double t = 0.2;
  const auto a = moving_near(0, pose_size, t), b = moving_near(1, pose_size, t);
  std::vector<Motion> faded(pose_size);
  cross_fade(a, b, {0.4, 0.3, 0}, faded);
  const auto two = blended(std::vector<Sample<double>>{{0.6, -0.3, 0}, {0.4, 0.3, 0}}, t);
  const auto three = blended(std::vector<Sample<double>>{{0.6, -0.3, 0}, {0.4, 0.3, 0}, {1e-13, 0, 0}}, t);
  for (std::size_t i = 0; i < pose_size; ++i) {
    CHECK(near(two[i], faded[i], 1e-13));
    CHECK(near(three[i], faded[i], 1e-11));
  }
}

TEST_CASE("where weights are shares of the whole the rest pose has what they leave") {
  const double t = 0.2;
  const auto a = moving_near(0, pose_size, t), rest = rest_pose(t);
  std::vector<Motion> faded(pose_size);
  cross_fade(rest, a, {0.4, 0.3, 0}, faded);
  const auto filled = blended(std::vector<Sample<double>>{{0.4, 0.3, 0}}, t, 1);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(near(filled[i], faded[i], 1e-13));
}

TEST_CASE("a joint that the mask of a layer leaves out is blended of the other layers alone") {
  const JointMask mask(std::vector<double>{0, 1, 0, 1, 0, 1});
  const std::vector<Sample<double>> weights{{0.7, 0.1, 0}, {0.2, 0.3, 0}};
  const auto masked = blended(weights, 0.2, least_weight, &mask), whole = blended(weights, 0.2);
  const auto other = moving_near(1, pose_size, 0.2);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(same_bits(masked[i], i % 2 == 0 ? other[i] : whole[i]));
}

TEST_CASE("blending asks for no memory, however many poses there are") {
  std::vector<std::vector<Motion>> poses;
  for (std::size_t i = 0; i < 40; ++i) poses.push_back(moving_near(i, pose_size, 0.1));
  std::vector<PoseLayer> layers;
  for (const auto& pose : poses) layers.push_back({pose, {0.3, 0.1, 0}});
  const auto rest = rest_pose();
  std::vector<Motion> out(pose_size), apart(pose_size);
  const std::size_t before = allocations();
  blend(layers, rest, out, 30);
  cross_fade(out, poses[0], {0.3, 0.1, 0}, out);
  difference(rest, out, apart);
  add(out, apart, {0.3, 0.1, 0}, out);
  CHECK(allocations() == before);
}
