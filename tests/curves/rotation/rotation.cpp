#include <tweenfall/curves/orientation.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curves/stated.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("slerp agrees with scipy") {
  for (const auto& file : test::vector_family("rotation_slerp")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const auto& times = c["input"]["times"];
      const auto& keys = c["input"]["q_xyzw"];
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const double t = c["t"][k];
        std::size_t i = 0;
        while (i + 2 < times.size() && t > times[i + 1].get<double>()) ++i;
        const double t0 = times[i], t1 = times[i + 1];
        const Quat q = slerp(normalized(quat(keys[i])), normalized(quat(keys[i + 1])), (t - t0) / (t1 - t0));
        CHECK(test::near(q, quat(c["q_xyzw"][k]), tolerance));
      }
    }
  }
}

TEST_CASE("the exponential and logarithm agree with scipy") {
  for (const auto& file : test::vector_family("rotation_exp")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const Vec3 r = vec(c["input"]["rotvec"]);
      const Quat q = exp_map(r);
      CHECK(test::near(q, quat(c["q_xyzw"]), tolerance));
      for (int row = 0; row < 3; ++row)
        CHECK(test::near(Vec3(q.toRotationMatrix().row(row)), vec(c["matrix_rows"][static_cast<std::size_t>(row)]),
                         tolerance));
      // From half a turn on, the rest of the turn the other way is the shorter.
      constexpr double half_turn = 0x1.921fb54442d18p+1;
      const Vec3 back = log_map(q);
      const bool other_way =
          r.norm() > half_turn - tolerance && test::near(back, Vec3(r - 2 * half_turn * r.normalized()), tolerance);
      CHECK((test::near(back, r, tolerance) || other_way));
    }
  }
}

TEST_CASE("the exponential is that of mpmath to the last digit, from the smallest vectors to whole turns") {
  // cos(|r|/2) and sin(|r|/2)/|r| r, with 40 digits; |r|^2 on both sides of 0.5, up to which a series is summed.
  const struct {
    Vec3 r;
    Vec4 q;
  } cases[] = {
      {{0.1, -0.2, 0.3},
       {0.049708843324859480776, -0.099417686649718961552, 0.14912652997457842853, 0.98255098215525896}},
      {{0.5, -0.3, 0.3},
       {0.24554484732421288883, -0.14732690839452772785, 0.14732690839452772785, 0.94672978831256274}},
      {{0.4, 0.4, 0.42426406871192845},
       {0.19585929762944413282, 0.19585929762944413282, 0.20774015626832131721, 0.93814833503972871418}},
      {{0.4, 0.4, 0.4242640687119285},
       {0.19585929762944413244, 0.19585929762944413244, 0.20774015626832134398, 0.93814833503972870842}},
      {{0.4, 0.4, 0.4242640687119286},
       {0.19585929762944413166, 0.19585929762944413166, 0.20774015626832139751, 0.93814833503972869688}},
      {{0.7, 0.05, -0.06},
       {0.34280994082856902504, 0.024486424344897790415, -0.02938370921387734578, 0.9386257811954394}},
      {{1e-3, 2e-3, -1e-3},
       {0.00049999987500000938541, 0.00099999975000001877082, -0.00049999987500000938541, 0.99999925000009375}},
      {{1e-170, 0, -3e-170}, {5e-171, 0, -1.5e-170, 1}},
      {{-1.5, 2, 0.25},
       {-0.56772763889326474612, 0.75697018519101966149, 0.094621273148877457686, 0.30939987303849642365}},
      {{6, 0, -1}, {0.098682543954708733819, 0, -0.016447090659118122303, -0.99498303941699314181}},
  };
  for (const auto& c : cases) {
    CAPTURE(c.r.transpose());
    const Quat q = exp_map(c.r);
    const double size = std::min(1.0, c.r.stableNorm());
    for (int i = 0; i < 3; ++i) CHECK(std::abs(q.coeffs()[i] - c.q[i]) <= 3e-16 * size);
    CHECK(std::abs(q.w() - c.q[3]) <= 3e-16);
    CHECK(std::abs(q.squaredNorm() - 1) < 5e-16);
  }
  CHECK(exp_map({0, 0, 0}).coeffs() == Vec4(0, 0, 0, 1));
}

TEST_CASE("rotation vectors whose square is beyond all numbers turn as mpmath says, and are numbers in every form") {
  // sin(x/2), cos(x/2) with 600 digits of pi
  for (const auto& [length, sine, cosine] : {std::array{1e160, -0.19712707965349915, -0.9803779447066744},
                                             std::array{1.7e308, -0.3134198014740629, 0.9496146734565336}}) {
    const Quat q = exp_map({0, -length, 0});
    CHECK(std::abs(q.y() + sine) <= 3e-16);
    CHECK(std::abs(q.w() - cosine) <= 3e-16);
    const Vec3 skew = Vec3(1, 1, -1) * length;
    CHECK(std::abs(exp_map(skew).squaredNorm() - 1) < 1e-15);
    CHECK(near(matrix_of(skew), matrix_of(exp_map(skew)), 1e-15));
    CHECK(wrapped(skew).norm() <= test::pi);
    CHECK(near(exp_map(wrapped(skew)).toRotationMatrix(), matrix_of(skew), 1e-14));
    CHECK(near(right_jacobian(skew), Vec3(1, 1, -1) * Vec3(1, 1, -1).transpose() / 3, 1e-15));
  }
}

TEST_CASE("Euler angles agree with scipy in all orders, turning and fixed axes") {
  constexpr double degree = pi / 180;
  for (const auto& file : test::vector_family("rotation_euler"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const std::string letters = c["input"]["order"];
      EulerOrder order;
      for (std::size_t i = 0; i < 3; ++i) order.axes[i] = letters[i] - 'X';
      const Vec3 angles = degree * vec(c["input"]["degrees"]);
      for (const bool intrinsic : {true, false}) {
        order.intrinsic = intrinsic;
        const Quat expected = quat(c[intrinsic ? "intrinsic_q_xyzw" : "extrinsic_q_xyzw"]);
        CHECK(test::near(from_euler(angles, order), expected, 1e-12));
        // Angles are not unique; the rotation they represent is. At gimbal lock half the digits are lost.
        const Vec3 found = to_euler(normalized(expected), order);
        CHECK(test::near(from_euler(found, order), expected, 3e-7));
      }
    }
}

TEST_CASE("Euler angles come back as they went in, away from gimbal lock") {
  test::Random random(3);
  const int orders[12][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0},
                             {0, 1, 0}, {0, 2, 0}, {1, 0, 1}, {1, 2, 1}, {2, 0, 2}, {2, 1, 2}};
  for (const auto& axes : orders)
    for (const bool intrinsic : {true, false})
      for (int i = 0; i < 20; ++i) {
        const EulerOrder order{{axes[0], axes[1], axes[2]}, intrinsic};
        const bool proper = axes[0] == axes[2];
        const Vec3 angles(random.between(-3, 3), proper ? random.between(0.1, 3) : random.between(-1.5, 1.5),
                          random.between(-3, 3));
        CHECK(test::near(to_euler(from_euler(angles, order), order), angles, 1e-12));
      }
}

TEST_CASE("at gimbal lock the third Euler angle is zero and the rotation is kept") {
  constexpr double quarter = 0x1.921fb54442d18p+0;
  for (const bool intrinsic : {true, false})
    for (const double sign : {-1.0, 1.0}) {
      const EulerOrder order{{0, 1, 2}, intrinsic};
      const Quat q = from_euler({0.4, sign * quarter, -0.9}, order);
      const Vec3 angles = to_euler(q, order);
      CHECK(angles[2] == 0);
      CHECK(test::near(from_euler(angles, order), q, 1e-7));
    }
}

TEST_CASE("the right Jacobian takes the rate of a rotation vector to the body's angular velocity") {
  test::Random random(4);
  for (const double size : {1e-9, 1e-3, 0.5, 1.0, 3.0, 5.0}) {
    const Vec3 r = random.vector(size), rate = random.vector(1);
    const double h = 1e-4;
    const auto turned = [&](double t) { return log_map(exp_map(r).conjugate() * exp_map(r + t * rate)); };
    const Vec3 stencil = (8 * (turned(h) - turned(-h)) - (turned(2 * h) - turned(-2 * h))) / (12 * h);
    CHECK(test::near(Vec3(right_jacobian(r) * rate), stencil, 1e-10));
    CHECK(test::near(Mat3(right_jacobian(r) * right_jacobian_inverse(r)), Mat3(Mat3::Identity()), 1e-12));
  }
}

TEST_CASE("a zero quaternion is refused with its numbers") {
  CHECK_THROWS_WITH_AS(static_cast<void>(normalized(Quat(0, 0, 0, 0))), doctest::Contains("w 0)"),
                       std::invalid_argument);
}
