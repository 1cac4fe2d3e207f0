#include <cstring>

#include "joint_scene.h"
#include "joints/figure_group.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::jointed;

namespace {

/// A tilted trunk with two arms of two parts each, falling onto what lies below; limits are met on the way.
std::vector<BodyId> add_figure(World& world, const Vec3& at, double tilt, bool hinged) {
  const BodyId trunk =
      world.add({.shape = {Capsule{0.12, 0.25}},
                 .mass = 20,
                 .motion = {.pose = {.position = at},
                            .twist = {.linear = Vec3(0.3, -2, tilt), .angular = Vec3(tilt, 1, -tilt)}}});
  std::vector<BodyId> bodies{trunk};
  for (const double side : {-1.0, 1.0}) {
    BodyId last = trunk;
    for (const double out : {0.3, 0.65}) {
      const Quat lying(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
      const BodyId limb =
          world.add({.shape = {Capsule{0.05, 0.12}},
                     .mass = 3,
                     .motion = {.pose = {.position = at + Vec3(side * out, 0.2, 0), .rotation = lying}}});
      const Vec3 point = at + Vec3(side * (out - 0.17), 0.2, 0);
      if (hinged && out > 0.5)
        join(world, last, limb, point, HingeJoint{.limits = Limits{-0.4, 0.05}}, Vec3(0, 0, 1));
      else
        join(world, last, limb, point,
             SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.1, .twist = {.low = -0.2, .high = 0.2}}, Vec3(side, 0, 0));
      bodies.push_back(limb);
      last = limb;
    }
  }
  // Slack at first: none of the joint's rows is active.
  const BodyId ball = add_ball(world, at + Vec3(0.8, 0.1, 0), 0.06, 1);
  join(world, bodies[4], ball, at + Vec3(0.8, 0.1, 0), DistanceJoint{.limits = {0, 0.3}});
  bodies.push_back(ball);
  return bodies;
}

std::vector<Motion> fall(int others, int threads) {
  WorldSettings settings = awake;
  settings.threads = threads;
  World world(settings);
  world.add({.shape = {Plane{}}, .fixed = true});
  const std::vector<BodyId> watched = add_figure(world, Vec3(0, 0.9, 0), 0.4, true);
  for (int i = 0; i < others; ++i)
    add_figure(world, Vec3(3.0 * (1 + i), 0.8 + 0.1 * (i % 5), 0), 0.1 * i - 0.7, i % 7 != 3);
  for (int step = 0; step < 90; ++step) world.step(1.0 / 60);
  std::vector<Motion> motions;
  for (const BodyId body : watched) motions.push_back(world.motion(body));
  return motions;
}

bool same_bits(const std::vector<Motion>& first, const std::vector<Motion>& second) {
  const auto same = [](const Vec3& a, const Vec3& b) {
    return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
  };
  bool all = first.size() == second.size();
  for (std::size_t i = 0; i < first.size() && all; ++i) {
    const Motion &a = first[i], &b = second[i];
    all = same(a.pose.position, b.pose.position) && same(a.pose.rotation.vec(), b.pose.rotation.vec()) &&
          a.pose.rotation.w() == b.pose.rotation.w() && same(a.twist.linear, b.twist.linear) &&
          same(a.twist.angular, b.twist.angular);
  }
  return all;
}

}  // namespace

TEST_CASE("what a figure does depends on no other: alone, beside one, beside forty, to the last bit") {
  const std::vector<Motion> alone = fall(0, 1);
  CHECK(alone[1].pose.position.y() < 0.5);
  for (const int others : {1, 2, 7, 8, 40}) {
    CAPTURE(others);
    CHECK(same_bits(alone, fall(others, 1)));
  }
  CHECK(same_bits(alone, fall(40, 2)));
}

TEST_CASE("figures are solved to the same bits with every instruction set") {
  using namespace joints;
  test::Random random(9);
  const auto vector = [&random] {
    const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
    return Vec3(x, y, z);
  };
  // A chain of five bodies that hangs on something fixed, with bounds that differ from lane to lane.
  constexpr std::uint32_t count = 5;
  constexpr std::uint32_t lanes = 7;
  std::vector<blocks::IslandBody> island(1 + lanes * (count + 1));
  std::vector<blocks::BodyLanes> velocities(island.size());
  FigurePlan::Room room;
  room.fit(island.size());
  std::vector<std::uint32_t> local(island.size());
  const std::vector<std::uint32_t> kinds(lanes * count);
  FigureGroup group;
  for (std::uint32_t lane = 0; lane < lanes; ++lane) {
    std::vector<FigurePlan::Member> members;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t place = 1 + lane * (count + 1) + i;
      members.push_back({place, place + 1, i > 0, true, lane * count + i});
      island[place + 1].movable = true;
      island[place + 1].inverse_mass = random.between(0.1, 2);
      const Mat3 some = vector().asDiagonal();
      island[place + 1].inverse_inertia = Mat3::Identity() + 0.1 * some;
      for (int k = 0; k < 3; ++k) velocities[place + 1].linear[k] = random.between(-1, 1);
      for (int k = 0; k < 3; ++k) velocities[place + 1].angular[k] = random.between(-3, 3);
    }
    FigurePlan plan;
    REQUIRE(plan.make(members, room));
    FigureGroup::Shape shape;
    FigureGroup::find_shape(plan.members(), kinds, local, shape);
    if (lane == 0)
      group.begin(plan, shape, true);
    else
      REQUIRE(group.take(plan, shape));
  }
  group.load_bodies(island);
  for (std::uint32_t place = 0; place < count; ++place)
    for (int lane = 0; lane < group.lanes(); ++lane) {
      Placement at;
      at.arm_a = 0.3 * vector();
      at.arm_b = 0.3 * vector();
      at.center_b = at.arm_a - at.arm_b + 1e-3 * vector();
      JointRows rows;
      rows.begin({1, 1, Mat3::Identity(), Mat3::Identity()}, {}, 1.0 / 180, 50, 1.0 / 60);
      rows.hold_point(at);
      const Limits limits{-0.1, 0.1};
      const double angle = random.between(-0.25, 0.25);
      rows.bound(about(vector()), angle, random.between(0, 1) < 0.7 ? &limits : nullptr);
      group.load(place, lane, rows, at.arm_a, at.arm_b);
    }
  group.end_load();
  const auto run = [&](const FigureKernels& kernels, std::vector<blocks::BodyLanes>& bodies) {
    FigureGroup own = group;
    own.end_load();
    Figures& figures = own.figures(bodies);
    std::vector<double> seen;
    kernels.solve(figures, true);
    kernels.moved(figures);
    kernels.solve(figures, false);
    kernels.warm_start(figures);
    kernels.add_up(figures);
    blocks::Lanes widest;
    kernels.close(figures, false, blocks::all(1), widest);
    kernels.hold_only(figures);
    kernels.solve(figures, false);
    for (std::uint32_t place = 0; place < count; ++place)
      for (int lane = 0; lane < own.lanes(); ++lane) {
        const Vec3 push = own.push(place, lane), turn = own.turn(place, lane);
        seen.insert(seen.end(), {push.x(), push.y(), push.z(), turn.x(), turn.y(), turn.z(), widest[lane]});
      }
    return seen;
  };
  std::vector<blocks::BodyLanes> first = velocities;
  const std::vector<double> told = run(*possible_figure_kernels().front(), first);
  CHECK(std::memcmp(first.data(), velocities.data(), first.size() * sizeof first[0]) != 0);
  for (const FigureKernels* kernels : possible_figure_kernels()) {
    std::vector<blocks::BodyLanes> second = velocities;
    CHECK(run(*kernels, second) == told);
    CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof first[0]) == 0);
  }
  // What is held together moves as one: every point.
  double worst = 0;
  for (std::uint32_t place = 0; place < count; ++place)
    for (int lane = 0; lane < group.lanes(); ++lane) {
      const FigureJoint& joint = group.figures().joints[place];
      const Vec3 arm_a = blocks::lane_of(joint.arm_a, lane), arm_b = blocks::lane_of(joint.arm_b, lane);
      const std::uint32_t a = group.body(joint.a, lane), b = group.body(joint.b, lane);
      const auto speed = [&](std::uint32_t at, const Vec3& arm) -> Vec3 {
        return blocks::linear_of(first[at]) + blocks::angular_of(first[at]).cross(arm);
      };
      worst = std::max(worst, (speed(b, arm_b) - speed(a, arm_a)).norm());
    }
  CHECK(worst < 1e-6);
}
