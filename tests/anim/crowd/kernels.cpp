#include <tweenfall/anim/crowd_kernels.h>

#include <thread>

#include "crowd/pose_kernels.h"
#include "curves/counted_allocations.h"
#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr std::size_t figure_sizes[] = {1, 7, 8, 20, 67, 200};

std::vector<CrowdGroup> random_pose(Random& random, std::size_t size) {
  std::vector<CrowdGroup> pose(crowd_groups(size));
  for (CrowdGroup& group : pose)
    for (std::size_t lane = 0; lane < CrowdGroup::size; ++lane) {
      const Quat q = random.rotation();
      for (int c = 0; c < 3; ++c) {
        group.translation[c][lane] = static_cast<float>(random.between(-2, 2));
        group.scale[c][lane] = static_cast<float>(random.between(0.5, 2));
      }
      for (int c = 0; c < 4; ++c) group.rotation[c][lane] = static_cast<float>(q.coeffs()[c]);
    }
  return pose;
}

template <class A, class B>
bool equal_bytes(const A& a, const B& b) {
  return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}

// The definition, in double precision.
Pose mean_pose(const std::vector<Pose>& poses, const std::vector<double>& weights) {
  Pose sum{.position = {0, 0, 0}, .rotation = Quat(0, 0, 0, 0), .scale = {0, 0, 0}};
  double total = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    sum.position += weights[i] * poses[i].position;
    sum.scale += weights[i] * poses[i].scale;
    const double sign = poses[i].rotation.dot(poses[0].rotation) < 0 ? -1 : 1;
    sum.rotation.coeffs() += weights[i] * sign * poses[i].rotation.coeffs();
    total += weights[i];
  }
  return {sum.position / total, sum.rotation.normalized(), sum.scale / total};
}

}  // namespace

TEST_CASE("a crowd's blend is the weighted mean of its layers, of any number, with masks or without") {
  Random random(1);
  for (const std::size_t size : figure_sizes)
    for (const std::size_t count : {1, 2, 3, 4, 20}) {
      std::vector<std::vector<CrowdGroup>> poses;
      std::vector<CrowdLayer> layers;
      std::vector<float> mask(crowd_groups(size) * CrowdGroup::size);
      for (float& weight : mask) weight = static_cast<float>(random.between(0.1, 1));
      poses.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto weight = static_cast<float>(random.between(0.1, 3));
        layers.push_back({poses.emplace_back(random_pose(random, size)), weight});
      }
      for (const bool masked : {false, true}) {
        if (masked) layers.back().mask = mask;
        std::vector<CrowdGroup> out(crowd_groups(size));
        blend(layers, out);
        for (std::size_t joint = 0; joint < size; ++joint) {
          std::vector<Pose> of_joint;
          std::vector<double> weights;
          for (const CrowdLayer& layer : layers) {
            of_joint.push_back(pose_of(layer.pose, joint));
            weights.push_back(layer.weight * (layer.mask.empty() ? 1.0F : layer.mask[joint]));
          }
          const Pose wanted = mean_pose(of_joint, weights), found = pose_of(out, joint);
          CHECK(near(found.position, wanted.position, 2e-6));
          CHECK(near(found.scale, wanted.scale, 2e-6));
          CHECK(near(found.rotation, wanted.rotation, 2e-5));
        }
      }
    }
}

TEST_CASE("weights of a crowd's blend may be as small or as large as 1e-30 or 1e30, with masks, too") {
  Random random(12);
  const std::size_t size = 13;
  const auto a = random_pose(random, size), b = random_pose(random, size);
  std::vector<CrowdGroup> out(a.size());
  const std::vector<float> whole(a.size() * CrowdGroup::size, 1.0F), little(whole.size(), 1e-20F);
  for (const float weight : {1e-44F, 1e-39F, 1e-31F, 2e-30F, 1e-17F, 1.0F, 1e20F, 1e30F})
    for (const auto& mask : {std::span<const float>(), std::span(whole), std::span(little)}) {
      INFO("weight ", weight, ", mask of ", mask.empty() ? 0.0F : mask[0]);
      blend(std::vector<CrowdLayer>{{a, weight, mask}, {b, 3 * weight, mask}}, out);
      const float least = 3 * weight * (mask.empty() ? 1.0F : mask[0]);
      if (least <= 1e-30F) {
        CHECK(equal_bytes(out, a));
        continue;
      }
      for (std::size_t joint = 0; joint < size; ++joint) {
        const Pose wanted = mean_pose({pose_of(a, joint), pose_of(b, joint)}, {0.25, 0.75}),
                   found = pose_of(out, joint);
        CHECK(near(found.position, wanted.position, 2e-6));
        CHECK(near(found.scale, wanted.scale, 2e-6));
        CHECK(near(found.rotation, wanted.rotation, 2e-5));
      }
    }
  // A little of b beside a weight that counts is nothing.
  blend(std::vector<CrowdLayer>{{a, 2e-30F}, {b, 9e-31F}}, out);
  CHECK(equal_bytes(out, a));
  blend(std::vector<CrowdLayer>{{a, 2e-30F, whole}, {b, 9e-31F}}, out);
  CHECK(equal_bytes(out, a));
}

TEST_CASE("weights of 0 and 1 give a crowd's inputs bit for bit, and the output may be an input") {
  Random random(2);
  for (const std::size_t size : figure_sizes) {
    const auto a = random_pose(random, size), b = random_pose(random, size);
    std::vector<CrowdGroup> out(a.size());
    blend(std::vector<CrowdLayer>{{a, 1}, {b, 0}}, out);
    CHECK(equal_bytes(out, a));
    blend(std::vector<CrowdLayer>{{a, 0}, {b, 0.3F}}, out);
    CHECK(equal_bytes(out, b));
    blend(std::vector<CrowdLayer>{{a, -1}, {b, 0}}, out);
    CHECK(equal_bytes(out, a));  // without any weight: the first
    add(a, b, 0, out);
    CHECK(equal_bytes(out, a));

    // Joint by joint with masks: every other joint is b's, the others are a's.
    std::vector<float> odd(a.size() * CrowdGroup::size), even(odd.size());
    for (std::size_t i = 0; i < odd.size(); ++i) (i % 2 ? odd : even)[i] = 1;
    blend(std::vector<CrowdLayer>{{a, 0.7F, even}, {b, 0.2F, odd}}, out);
    for (std::size_t joint = 0; joint < size; ++joint) {
      const Pose wanted = pose_of(joint % 2 ? b : a, joint), found = pose_of(out, joint);
      CHECK(found.position == wanted.position);
      CHECK(found.rotation.coeffs() == wanted.rotation.coeffs());
      CHECK(found.scale == wanted.scale);
    }
    add(a, b, 0.5F, out, even);
    for (std::size_t joint = 1; joint < size; joint += 2)
      CHECK(pose_of(out, joint).rotation.coeffs() == pose_of(a, joint).rotation.coeffs());

    std::vector<CrowdGroup> in_place = b, apart(a.size());
    blend(std::vector<CrowdLayer>{{a, 0.5F}, {b, 0.5F}}, apart);
    blend(std::vector<CrowdLayer>{{a, 0.5F}, {in_place, 0.5F}}, in_place);
    CHECK(equal_bytes(in_place, apart));
  }
}

TEST_CASE("a crowd's difference, added to its reference, gives the pose back; half of it goes half way") {
  Random random(3);
  for (const std::size_t size : figure_sizes) {
    const auto reference = random_pose(random, size), pose = random_pose(random, size);
    std::vector<CrowdGroup> between(pose.size()), whole(pose.size()), half(pose.size());
    difference(reference, pose, between);
    add(reference, between, 1, whole);
    add(reference, between, 0.5F, half);
    for (std::size_t joint = 0; joint < size; ++joint) {
      const Pose from = pose_of(reference, joint), to = pose_of(pose, joint);
      CHECK(near(pose_of(whole, joint).position, to.position, 1e-6));
      CHECK(near(pose_of(whole, joint).rotation, to.rotation, 2e-6));
      CHECK(near(pose_of(whole, joint).scale, to.scale, 1e-6));
      CHECK(near(pose_of(half, joint).position, 0.5 * (from.position + to.position), 1e-6));
      CHECK(near(pose_of(half, joint).scale, 0.5 * (from.scale + to.scale), 2e-6));
      // Half of a normalized mix is half of the turn.
      CHECK(near(pose_of(half, joint).rotation, slerp(from.rotation, to.rotation, 0.5), 2e-5));
    }
  }
}

TEST_CASE("a crowd's joints are where the exact path has them") {
  Random random(4);
  for (const std::size_t size : figure_sizes) {
    const auto nodes = random_figure(size, size);
    auto pose = random_pose(random, size);
    // Limbs that neither grow nor shrink without limit.
    for (CrowdGroup& group : pose)
      for (auto& axis : group.scale)
        for (float& factor : axis) factor = 0.8F + 0.2F * factor;
    std::vector<Motion> local(size);
    for (std::size_t i = 0; i < size; ++i) local[i].pose = pose_of(pose, i);
    std::vector<WorldMotion> wanted(size);
    nodes->world_motions(local, wanted);
    std::vector<CrowdMatrix> world(size + 1);
    const CrowdMatrix root{{{0, -2, 0, 1}, {2, 0, 0, 5}, {0, 0, 2, -3}}};
    world[size].row[0][0] = 77;
    CrowdSkeleton(*nodes).local_to_world(pose, std::span(world).first(size), root);
    CHECK(world[size].row[0][0] == 77);  // nothing is written behind the joints
    Mat3 turned;
    turned << 0, -2, 0, 2, 0, 0, 0, 0, 2;
    for (std::size_t i = 0; i < size; ++i) {
      const Mat3 linear = turned * wanted[i].linear;
      const Vec3 origin = turned * wanted[i].motion.pose.position + Vec3(1, 5, -3);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) CHECK(near(world[i].row[r][c], linear(r, c), 5e-5 * (1 + linear.norm())));
        CHECK(near(world[i].row[r][3], origin[r], 5e-5 * (1 + origin.norm())));
      }
    }
  }
}

TEST_CASE("what is done with a crowd's poses has the same bits by the wide and by the plain kernels") {
  Random random(5);
  const auto all = crowd::possible_pose_kernels();
  const crowd::PoseKernels& plain = *all.front();
  const std::size_t size = 67;
  const auto a = random_pose(random, size), b = random_pose(random, size), c = random_pose(random, size);
  std::vector<float> mask(a.size() * CrowdGroup::size);
  for (float& weight : mask) weight = static_cast<float>(std::max(0.0, random.between(-0.3, 1)));
  std::vector<CrowdGroup> one(a.size()), other(a.size());
  const std::vector<std::vector<CrowdLayer>> blends{
      {{a, 0.3F}, {b, 0.9F}}, {{a, 0.3F}, {b, 0.2F}, {c, 7}}, {{a, 0.3F, mask}, {b, 0.2F}, {c, 1, mask}}};
  std::vector<CrowdMatrix> matrices(size), others(size);
  std::vector<std::uint32_t> order(size), parents(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    order[i] = i;
    parents[i] = i == 0 ? 0xffffffffU : i / 2;
  }
  for (const crowd::PoseKernels* kernels : all) {
    for (const auto& layers : blends) {
      crowd::blend_with(*kernels, layers, one);
      crowd::blend_with(plain, layers, other);
      CHECK(equal_bytes(one, other));
    }
    crowd::add_with(*kernels, a, b, 0.4F, one, mask);
    crowd::add_with(plain, a, b, 0.4F, other, mask);
    CHECK(equal_bytes(one, other));
    kernels->difference(a.data(), b.data(), one.size(), one.data());
    plain.difference(a.data(), b.data(), other.size(), other.data());
    CHECK(equal_bytes(one, other));
    kernels->place(a.data(), size, matrices.data());
    plain.place(a.data(), size, others.data());
    CHECK(equal_bytes(matrices, others));
    kernels->compose(order.data(), parents.data(), size, {}, matrices.data());
    plain.compose(order.data(), parents.data(), size, {}, others.data());
    CHECK(equal_bytes(matrices, others));
  }
}

TEST_CASE("a crowd on many threads has the bits of a crowd on one, and asks for no memory") {
  const auto nodes = random_figure(7, 20);
  const CrowdClip clip = compile(random_clip(3, *nodes, 1), *nodes, {.tolerance = 1e-3});
  const CrowdSkeleton skeleton(*nodes);
  const std::size_t crowd_size = 100, groups = clip.groups();
  const auto run = [&](const auto& for_each) {
    std::vector<CrowdGroup> poses(2 * groups * crowd_size);
    std::vector<CrowdMatrix> world(20 * crowd_size);
    const std::size_t before = allocations();
    each_of_crowd(crowd_size, for_each, [&](std::size_t i) {
      const auto first = std::span(poses).subspan(2 * i * groups, groups);
      const auto second = std::span(poses).subspan((2 * i + 1) * groups, groups);
      clip.sample(clip.clock(-0.01 * static_cast<double>(i), 1, 3), first);
      clip.sample(clip.clock(-0.02 * static_cast<double>(i), 1, 3), second);
      const CrowdLayer layers[] = {{first, 0.25F}, {second, 0.75F}};
      blend(layers, first);
      skeleton.local_to_world(first, std::span(world).subspan(20 * i, 20));
    });
    return std::pair(std::move(world), allocations() - before);
  };
  const auto alone = run([](std::size_t parts, const auto& part) {
    for (std::size_t p = 0; p < parts; ++p) part(p);
  });
  const auto together = run([](std::size_t parts, const auto& part) {
    std::thread odd([&] {
      for (std::size_t p = 1; p < parts; p += 2) part(p);
    });
    for (std::size_t p = 0; p < parts; p += 2) part(p);
    odd.join();
  });
  CHECK(equal_bytes(alone.first, together.first));
  CHECK(alone.second == 0);
}

TEST_CASE("a joint mask reaches the lanes of a crowd's joints, and none beyond the last") {
  std::vector<double> weights(11);
  for (std::size_t joint = 0; joint < weights.size(); ++joint) weights[joint] = 0.0625 * static_cast<double>(joint);
  const std::vector<float> lanes = crowd_mask(JointMask(weights), weights.size());
  REQUIRE(lanes.size() == crowd_groups(weights.size()) * CrowdGroup::size);
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    CHECK(static_cast<double>(lanes[lane]) == (lane < weights.size() ? weights[lane] : 0));

  const std::vector<float> whole = crowd_mask(JointMask(), 3);
  CHECK(std::ranges::count(whole, 1.0F) == 3);
  CHECK(std::ranges::count(whole, 0.0F) == static_cast<std::ptrdiff_t>(whole.size() - 3));
  CHECK_THROWS_WITH_AS(static_cast<void>(crowd_mask(JointMask(weights), 12)),
                       "a mask of 11 nodes does not fit 12 joints", std::invalid_argument);
}
