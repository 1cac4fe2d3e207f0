#include "anim/chains/chain_support.h"

#include <tweenfall/anim/jiggle.h>

#include <complex>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Path = std::function<Sample<Vec3>(double)>;

Vec3 along_x(double x) {
  return {x, 0, 0};
}

/// x'' + 2 z w x' + w^2 x = 0 from x0 and v0, the damped, the critical and the overdamped solution.
double free_motion(double w, double z, double x0, double v0, double t) {
  if (z < 1) {
    const double d = w * std::sqrt(1 - z * z);
    return std::exp(-z * w * t) * (x0 * std::cos(d * t) + (v0 + z * w * x0) / d * std::sin(d * t));
  }
  if (z == 1) return std::exp(-w * t) * (x0 + (v0 + w * x0) * t);
  const double root = std::sqrt(z * z - 1), fast = -w * (z + root), slow = -w * (z - root);
  const double b = (v0 - slow * x0) / (fast - slow);
  return (x0 - b) * std::exp(slow * t) + b * std::exp(fast * t);
}

/// A spring after `target` from rest, asked at times `frame` apart up to `end`.
Sample<Vec3> followed(const SpringFollower& spring, const Path& target, double frame, double end) {
  SpringState state = spring.at_rest(0);
  for (int i = 1; i * frame < end; ++i) (void)spring.follow(state, i * frame, target);
  return spring.follow(state, end, target);
}

}  // namespace

TEST_CASE("a spring that is let go beside a still target moves as the closed form says, for every damping") {
  for (const double hz : {0.05, 0.3, 2.0, 15.0, 200.0}) {
    for (const double damping : {0.0, 0.2, 0.999, 1.0, 1.001, 3.0, 50.0}) {
      CAPTURE(hz);
      CAPTURE(damping);
      const SpringFollower spring({.hz = hz, .damping = damping, .steps_per_second = 100});
      SpringState state = spring.at_rest(0);
      state.offset = along_x(0.3);
      state.rate = along_x(-1);
      const Path target = [](double) { return still({1, 2, 3}); };
      for (double t = 0.003; t < 2; t += 0.0173) {
        const Sample<Vec3> now = spring.follow(state, t, target);
        const double w = 2 * pi * hz;
        CHECK(near(now.value, Vec3(1 + free_motion(w, damping, 0.3, -1, t), 2, 3), 1e-10));
      }
    }
  }
}

TEST_CASE("a spring sags by gravity over the square of its frequency, and falls freely without one") {
  const Path target = [](double) { return still({0, 5, 0}); };
  const SpringFollower spring({.hz = 2, .damping = 0.7, .gravity = {0, -9.81, 0}});
  CHECK(near(followed(spring, target, 0.1, 20).value, Vec3(0, 5 - 9.81 / (16 * pi * pi), 0), 1e-12));
  const SpringFollower loose({.hz = 0, .gravity = {0, -9.81, 0}});
  const Sample<Vec3> fallen = followed(loose, target, 1.0 / 30, 3);
  CHECK(near(fallen.value, Vec3(0, 5 - 9.81 / 2 * 9, 0), 1e-11));
  CHECK(near(fallen.rate, Vec3(0, -9.81 * 3, 0), 1e-11));
}

TEST_CASE("a spring after a target that sets off evenly lags as the closed form says") {
  // Relative to the target, it is struck with the speed at which the target moves away.
  const Path target = [](double t) { return moving({2 * t, 0, 0}, {2, 0, 0}); };
  for (const double damping : {0.0, 0.3, 1.0, 2.0}) {
    const SpringFollower spring({.hz = 1.5, .damping = damping});
    SpringState state = spring.at_rest(0);
    state.rate = {-2, 0, 0};
    for (double t = 0.01; t < 3; t += 0.037)
      CHECK(near(spring.follow(state, t, target).value.x(), 2 * t + free_motion(3 * pi, damping, 0, -2, t), 1e-11));
  }
}

TEST_CASE("a spring after a swinging target moves as the driven oscillator does, to 1e-9") {
  for (const double damping : {0.1, 0.5, 1.0, 2.0}) {
    for (const double hz : {0.5, 2.0, 8.0}) {
      CAPTURE(damping);
      CAPTURE(hz);
      const double w = 2 * pi * hz, drive = 2 * pi * 1.0;
      const Path target = [&](double t) -> Sample<Vec3> {
        return {along_x(std::sin(drive * t)), along_x(drive * std::cos(drive * t)),
                along_x(-drive * drive * std::sin(drive * t))};
      };
      // The offset y has y'' + 2 z w y' + w^2 y = drive^2 sin(drive t): the imaginary part of c exp(i drive t).
      const std::complex<double> c =
          drive * drive / std::complex<double>(w * w - drive * drive, 2 * damping * w * drive);
      const auto steady = [&](double t) { return (c * std::polar(1.0, drive * t)).imag(); };
      const double rate = (c * std::complex<double>(0, drive)).imag();
      const SpringFollower spring({.hz = hz, .damping = damping});
      SpringState state = spring.at_rest(0);
      double worst = 0, worst_rate_error = 0;
      for (double t = 0.01; t < 4; t += 0.0123) {
        const Sample<Vec3> now = spring.follow(state, t, target);
        const double expected = std::sin(drive * t) + steady(t) + free_motion(w, damping, -steady(0), -rate, t);
        worst = std::max(worst, std::abs(now.value.x() - expected));
        const auto at = [&](double time) -> Vec3 {
          SpringState copy = state;
          return spring.follow(copy, time, target).value;
        };
        // Within one step, so that the difference does not go back in time.
        const double s = t - spring.time_of(state.step);
        if (s > 3e-3 && s < 5e-3)
          worst_rate_error = std::max(worst_rate_error, (difference(at, t, 5e-4) - now.rate).norm());
      }
      CHECK(worst < 1e-9);
      CHECK(worst_rate_error < 1e-10);
    }
  }
}

TEST_CASE("the acceleration of a spring is the derivative of its rate") {
  Random random(3);
  const SwingingVector way = swinging(random, {0, 0, 0}, 1);
  const Path target = [&](double t) { return way.at(t); };
  const SpringFollower spring({.hz = 3, .damping = 0.3, .gravity = {0, -9.81, 0}, .steps_per_second = 10});
  const SpringState start{.step = 3, .offset = {0.1, 0.2, 0.3}, .rate = {1, 2, 3}};
  const auto at = [&](double t) {
    SpringState state = start;
    return spring.follow(state, t, target);
  };
  const Vec3 expected = difference([&](double t) -> Vec3 { return at(t).rate; }, 0.35);
  CHECK(near(at(0.35).acceleration, expected, 1e-9));

  const auto turned = [&](double t) {
    SpringState state = start;
    const std::function<Sample<Quat>(double)> turning = [&](double time) {
      const Sample<Vec3> axis{{0.3, 1, 0.2}, {0, 0, 0}, {0, 0, 0}};
      const double angle = std::sin(2 * time), rate = 2 * std::cos(2 * time), second = -4 * std::sin(2 * time);
      return Sample<Quat>{exp_map(angle * axis.value), rate * axis.value, second * axis.value};
    };
    return spring.follow(state, t, turning);
  };
  const Sample<Quat> now = turned(0.35);
  const Vec3 turning =
      difference([&](double t) -> Vec3 { return log_map(turned(t).value * now.value.conjugate()); }, 0.35);
  CHECK(near(now.rate, turning, 1e-9));
  CHECK(near(now.acceleration, difference([&](double t) -> Vec3 { return turned(t).rate; }, 0.35), 1e-9));
}

TEST_CASE("a rotation that springs about one axis moves as an angle does") {
  const double drive = 3;
  const Vec3 axis = Vec3(1, 2, 2) / 3;
  const auto angle = [&](double t) -> Sample<double> {
    return {2 * std::sin(drive * t), 2 * drive * std::cos(drive * t), -2 * drive * drive * std::sin(drive * t)};
  };
  const std::function<Sample<Quat>(double)> turning = [&](double t) {
    const Sample<double> a = angle(t);
    return Sample<Quat>{exp_map(a.value * axis), a.rate * axis, a.acceleration * axis};
  };
  const Path line = [&](double t) {
    const Sample<double> a = angle(t);
    return Sample<Vec3>{a.value * axis, a.rate * axis, a.acceleration * axis};
  };
  const SpringFollower spring({.hz = 1.2, .damping = 0.4});
  SpringState turned = spring.at_rest(0), moved = spring.at_rest(0);
  for (double t = 0.01; t < 3; t += 0.021) {
    const Sample<Quat> rotation = spring.follow(turned, t, turning);
    const Sample<Vec3> place = spring.follow(moved, t, line);
    CHECK(near(rotation.value, exp_map(place.value), 1e-12));
    CHECK(near(rotation.rate, place.rate, 1e-12));
    CHECK(near(rotation.acceleration, place.acceleration, 1e-10));
  }
}

TEST_CASE("a spring is the same to the bit at common times of 30, 60 and 144 frames per second, and of odd ones") {
  Random random(4);
  const SwingingVector way = swinging(random, {0, 0, 0}, 1);
  const Path target = [&](double t) { return way.at(t); };
  const SpringFollower spring({.hz = 2, .damping = 0.2, .gravity = {0, -9.81, 0}});
  for (const double end : {1.0, 1.5, 7.0, 1.2345}) {
    const Sample<Vec3> slow = followed(spring, target, 1.0 / 30, end);
    for (const double frame : {1.0 / 60, 1.0 / 144, 0.0123, 0.4, 100.0}) {
      const Sample<Vec3> other = followed(spring, target, frame, end);
      CHECK(slow.value == other.value);
      CHECK(slow.rate == other.rate);
    }
  }
}

TEST_CASE("a spring knows the points of its grid, starts anew when time goes back, and takes any time") {
  for (const double steps : {1.0, 3.0, 60.0, 120.0, 99999.0}) {
    const SpringFollower spring({.steps_per_second = steps});
    for (std::int64_t step = -5000; step < 5000; step += 7) {
      CHECK(spring.step_at(spring.time_of(step)) == step);
      CHECK(spring.step_at(std::nextafter(spring.time_of(step), -1e9)) == step - 1);
    }
  }
  const SpringFollower spring({.hz = 2});
  const Path target = [](double t) { return moving({t, 0, 0}, {1, 0, 0}); };
  SpringState state = spring.at_rest(5);
  state.offset = {1, 1, 1};
  CHECK(spring.follow(state, 4, target).value == target(4).value);
  CHECK(state == spring.at_rest(4));
  for (const double time : {-1e300, 1e300, 1e15, -3.5}) CHECK(spring.follow(state, time, target).value.allFinite());
}

TEST_CASE("the state of a spring goes to bytes and back, and hostile bytes are refused") {
  const SpringState state{-7, {1, 2, 3}, {4, 5, -6}};
  CHECK(state.bytes().size() == 56);
  CHECK(SpringState::from_bytes(state.bytes()) == state);
  std::vector<std::byte> bytes = state.bytes();
  bytes.pop_back();
  CHECK_THROWS_WITH_AS((void)SpringState::from_bytes(bytes), "spring state: there are 55 bytes where 56 were expected",
                       std::invalid_argument);
  const SpringState bad{0, {NAN, 0, 0}, {0, 0, 0}};
  CHECK_THROWS_AS((void)SpringState::from_bytes(bad.bytes()), std::invalid_argument);
  const JiggleState chain{3, {{1, 2, 3}, {4, 5, 6}}, {{0, 0, 1}, {0, 2, 0}}};
  CHECK(JiggleState::from_bytes(chain.bytes()) == chain);
  bytes = chain.bytes();
  bytes[8] = std::byte{200};
  CHECK_THROWS_AS((void)JiggleState::from_bytes(bytes), std::invalid_argument);
  const std::vector<std::byte> whole = chain.bytes();
  for (std::size_t length = 0; length < whole.size(); ++length)
    CHECK_THROWS_AS((void)JiggleState::from_bytes(std::span(whole).first(length)), std::invalid_argument);
}

TEST_CASE("a node that springs follows its place and rotation in the world, with exact rates") {
  Random random(5);
  const Hierarchy nodes = straight_chain(4);
  const SwingingPose swing(random, nodes, 0.2, 0.6);
  const PoseAt pose_at = [&](double t, std::span<Motion> pose) {
    for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = swing.nodes[i].at(t);
  };
  const NodeSpring spring(nodes, {.node = 2,
                                  .position = SpringSettings{.hz = 3, .steps_per_second = 200},
                                  .rotation = SpringSettings{.hz = 2, .steps_per_second = 200}});
  NodeSpringState start = spring.at_rest(0);
  std::vector<Motion> scratch(nodes.size());
  const auto at = [&](double t) {
    NodeSpringState state = start;
    std::vector<Motion> pose = swing.at(t);
    follow(spring, state, t, pose_at, {1, 0, 0}, scratch, pose);
    return pose;
  };
  CHECK(worst_rate(at, 2.0025, 5e-4) < 1e-8);
  // Like the position's own spring, given the accelerations too.
  const Path place = [&](double t) -> Sample<Vec3> {
    const WorldMotion world = world_of_node(nodes, 2, swing.at(t));
    const auto velocity = [&](double time) -> Vec3 {
      return world_of_node(nodes, 2, swing.at(time)).motion.twist.linear;
    };
    return {world.motion.pose.position, world.motion.twist.linear, difference(velocity, t)};
  };
  const Sample<Vec3> expected = followed(*spring.position(), place, 0.1, 2);
  const WorldMotion world = world_of_node(nodes, 2, at(2));
  CHECK(near(world.motion.pose.position, expected.value, 1e-7));
  CHECK(near(world.motion.twist.linear, expected.rate, 1e-6));

  std::vector<Motion> pose = swing.at(1);
  const std::vector<Motion> before = pose;
  NodeSpringState state = start;
  follow(spring, state, 1, pose_at, {0, 0, 0}, scratch, pose);
  CHECK(same_bits(before, pose));
  CHECK(state.position.step == 200);
  CHECK_THROWS_WITH_AS(NodeSpring(nodes, {.node = "leaf", .position = SpringSettings{.hz = -1}}),
                       "node spring: node is \"leaf\", and there is no such node\n"
                       "node spring: position spring: hz is -1; it must be from 0 to 1e+05",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(NodeSpring(nodes, {.node = 1}),
                       "node spring: it has neither a position nor a rotation to follow", std::invalid_argument);
}
