#include <tweenfall/curves/pose.h>
#include <tweenfall/curves/rotation.h>

#include <functional>

#include "support.h"

using namespace tweenfall;

namespace {

// A motion whose rates are known because it is made from functions of time.
Motion moving(double t, double phase) {
  Motion m;
  const Vec3 rate(0.3, -0.8, 0.5 + phase);
  m.pose.position = Vec3(1 + phase * t, t * t, std::sin(t + phase));
  m.pose.rotation = exp_map(t * rate) * exp_map(Vec3(phase, 0.2, -0.4));
  const double s = 1.5 + 0.2 * std::sin(t * phase);
  m.pose.scale = Vec3(s, s, s);
  m.twist.linear = Vec3(phase, 2 * t, std::cos(t + phase));
  m.twist.angular = rate;
  m.scale_rate = Vec3::Constant(0.2 * phase * std::cos(t * phase));
  return m;
}

void check_rates(const std::function<Motion(double)>& motion, double t) {
  const double h = 1e-3;
  const auto stencil = [&](const auto& f) {
    return Vec3((8 * (f(motion(t + h)) - f(motion(t - h))) - (f(motion(t + 2 * h)) - f(motion(t - 2 * h)))) / (12 * h));
  };
  const Motion m = motion(t);
  CHECK(test::near(m.twist.linear, stencil([](const Motion& x) { return x.pose.position; }), 1e-9));
  CHECK(test::near(m.scale_rate, stencil([](const Motion& x) { return x.pose.scale; }), 1e-9));
  CHECK(test::near(m.twist.angular,
                   stencil([&](const Motion& x) { return log_map(x.pose.rotation * m.pose.rotation.conjugate()); }),
                   1e-9));
}

}  // namespace

TEST_CASE("composed motions carry the rates that their poses really have") {
  for (const double t : {0.0, 0.4, 1.7})
    check_rates([](double x) { return compose(moving(x, 0.7), moving(x, -1.1)); }, t);
}

TEST_CASE("relative_to undoes compose, rates included") {
  const Motion parent = moving(0.6, 0.7), child = moving(0.6, -1.1);
  const Motion back = relative_to(parent, compose(parent, child));
  CHECK(test::near(back.pose.position, child.pose.position, 1e-14));
  CHECK(test::near(back.pose.rotation, child.pose.rotation, 1e-14));
  CHECK(test::near(back.pose.scale, child.pose.scale, 1e-14));
  CHECK(test::near(back.twist.linear, child.twist.linear, 1e-13));
  CHECK(test::near(back.twist.angular, child.twist.angular, 1e-14));
  CHECK(test::near(back.scale_rate, child.scale_rate, 1e-14));
}

TEST_CASE(
    "below scales that mirror, composed poses have the matrices, the rates and the inverses of composed matrices") {
  const auto matrix = [](const Pose& pose) { return Mat3(pose.rotation.toRotationMatrix() * pose.scale.asDiagonal()); };
  for (int signs = 0; signs < 64; ++signs) {
    CAPTURE(signs);
    const auto mirrored = [&](double t, double phase, int first) {
      Motion motion = moving(t, phase);
      for (int i = 0; i < 3; ++i)
        if (signs >> (first + i) & 1) {
          motion.pose.scale[i] *= -1;
          motion.scale_rate[i] *= -1;
        }
      return motion;
    };
    const Motion parent = mirrored(0.6, 0.7, 0), child = mirrored(0.6, -1.1, 3), whole = compose(parent, child);
    CHECK(test::near(matrix(whole.pose), Mat3(matrix(parent.pose) * matrix(child.pose)), 1e-14));
    check_rates([&](double x) { return compose(mirrored(x, 0.7, 0), mirrored(x, -1.1, 3)); }, 0.6);
    const Motion back = relative_to(parent, whole);
    CHECK(test::near(back.pose.position, child.pose.position, 1e-14));
    CHECK(test::near(back.pose.rotation, child.pose.rotation, 1e-14));
    CHECK(test::near(back.pose.scale, child.pose.scale, 1e-14));
    CHECK(test::near(back.twist.linear, child.twist.linear, 1e-13));
    CHECK(test::near(back.twist.angular, child.twist.angular, 1e-13));
    CHECK(test::near(back.scale_rate, child.scale_rate, 1e-14));
  }
}

TEST_CASE("mixed motions carry the rates of their poses and of the weight") {
  const auto mixed = [](double x) {
    const double weight = 0.5 + 0.4 * std::sin(2 * x);
    return mix(moving(x, 0.7), moving(x, -1.1), weight, 0.8 * std::cos(2 * x));
  };
  for (const double t : {0.0, 0.4, 1.1}) check_rates(mixed, t);
}

TEST_CASE("a mix of weight 0 or 1 is its input bit for bit") {
  const Motion a = moving(0.3, 0.7), b = moving(0.3, -1.1);
  const Motion first = mix(a, b, 0, 0), second = mix(a, b, 1, 0);
  CHECK(first.pose.position == a.pose.position);
  CHECK(first.pose.rotation.coeffs() == a.pose.rotation.coeffs());
  CHECK(first.twist.angular == a.twist.angular);
  CHECK(second.pose.scale == b.pose.scale);
  CHECK(second.pose.rotation.coeffs() == b.pose.rotation.coeffs());
  CHECK(second.twist.linear == b.twist.linear);
  CHECK(second.scale_rate == b.scale_rate);
}

TEST_CASE("a point on a turning wheel moves at right angles to its arm") {
  const Twist wheel{{2, 0, 0}, {0, 0, 3}};
  CHECK(velocity_at(wheel, {0, -1, 0}) == Vec3(5, 0, 0));
  CHECK(shifted(wheel, {1, 0, 0}).linear == Vec3(2, 3, 0));
  CHECK(shifted(wheel, {1, 0, 0}).angular == Vec3(0, 0, 3));
}
