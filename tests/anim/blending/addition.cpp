#include <tweenfall/anim/blend.h>

#include "anim/moving_pose.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

struct AddedPoses {
  std::vector<Motion> base, reference, pose, apart;

  AddedPoses(std::uint64_t seed, double t)
      : base(moving_pose(seed, pose_size, t)),
        reference(moving_pose(seed + 1, pose_size, t)),
        pose(moving_pose(seed + 2, pose_size, t)),
        apart(pose_size) {
    difference(reference, pose, apart);
  }
};

}  // namespace

TEST_CASE("a difference added to its reference is the pose, rates too, and taken away again the reference") {
  for (std::uint64_t seed = 10; seed < 60; seed += 10) {
    const AddedPoses c(seed, 0.15);
    std::vector<Motion> there(pose_size), back(pose_size);
    add(c.reference, c.apart, {1, 0, 0}, there);
    add(there, c.apart, {-1, 0, 0}, back);
    for (std::size_t i = 0; i < pose_size; ++i) {
      CHECK(near(there[i], c.pose[i], 1e-12));
      CHECK(near(back[i], c.reference[i], 1e-11));
    }
  }
}

TEST_CASE("a difference is added with rates that are derivatives, its weight moving, also where scales are mirrored") {
  for (const bool mirrored : {false, true})
    for (std::size_t i = 0; i < pose_size; ++i) {
      const auto at = [&](double t) {
        AddedPoses c(40, t);
        if (mirrored) {
          c.pose[i].pose.scale[1] *= -1;
          c.pose[i].scale_rate[1] *= -1;
          c.apart[i] = difference(c.reference[i], c.pose[i]);
        }
        return add(c.base[i], c.apart[i], moving_weight(t));
      };
      check_rates(at, 0.1, 2e-9);
      check_rates([&](double t) { return AddedPoses(40, t).apart[i]; }, 0.1, 2e-9);
    }
}

TEST_CASE("added with weight 0 a difference changes no bit, and with a mask only the joints that it reaches") {
  const AddedPoses c(70, 0.1);
  std::vector<Motion> out(pose_size);
  add(c.base, c.apart, {0, 0, 0}, out);
  for (std::size_t i = 0; i < pose_size; ++i) CHECK(same_bits(out[i], c.base[i]));
  std::vector<double> weights(pose_size, 0.0);
  weights[3] = 0.5;
  add(c.base, c.apart, {0.8, 0.3, 0}, out, JointMask(weights));
  for (std::size_t i = 0; i < pose_size; ++i)
    if (i == 3)
      CHECK(same_bits(out[i], add(c.base[i], c.apart[i], {0.4, 0.15, 0})));
    else
      CHECK(same_bits(out[i], c.base[i]));
}

TEST_CASE("two weights one after the other add what their sum adds") {
  const AddedPoses c(80, 0.1);
  for (std::size_t i = 0; i < pose_size; ++i) {
    const Motion twice = add(add(c.base[i], c.apart[i], {0.3, 0.5, 0}), c.apart[i], {0.45, -0.2, 0});
    CHECK(near(twice, add(c.base[i], c.apart[i], {0.75, 0.3, 0}), 1e-12));
  }
}

TEST_CASE("a reference without a size leaves the scale alone, and a pose without a size takes it away") {
  Motion flat, whole;
  flat.pose.scale = {0, 1, 1};
  const Motion grown = add(whole, difference(flat, whole), {0.5, 1, 0});
  CHECK(grown.pose.scale == Vec3(1, 1, 1));
  CHECK(grown.scale_rate == Vec3(0, 0, 0));
  const Motion shrunk = add(whole, difference(whole, flat), {0.25, 2, 0});
  CHECK(shrunk.pose.scale == Vec3(0.75, 1, 1));
  CHECK(shrunk.scale_rate == Vec3(-2, 0, 0));
}
