#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/orientation.h>

#include <limits>

#include "support.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

Vec3 within(test::Random& random, double most) {
  return random.between(0, most) * random.vector(1).normalized();
}

/// The closed form of a spinning top without torque, with moments a, a and c.
/// Source: Goldstein, Poole, Safko, Classical Mechanics, 5.6: it precesses about its momentum at |L| / a, and turns on
/// its own axis beside that at w3 (a - c) / a.
struct Top {
  double a = 2, c = 3;
  Vec3 spin{0.4, 0.3, 5};  ///< at the start, in its own axes, which are the world's then

  [[nodiscard]] Vec3 momentum() const { return {a * spin.x(), a * spin.y(), c * spin.z()}; }
  [[nodiscard]] double beside() const { return spin.z() * (a - c) / a; }
  [[nodiscard]] Quat at(double time) const {
    return exp_map(momentum() * (time / a)) * exp_map(Vec3(0, 0, beside() * time));
  }
  [[nodiscard]] Vec3 angular_velocity(double time) const {
    return momentum() / a + beside() * (at(time) * Vec3(0, 0, 1));
  }
};

double turn_between(const Quat& a, const Quat& b) {
  return log_map(a * b.conjugate()).norm();
}

/// Turned from 0 to 1 s by the velocity in the middle of each step; the error at the end.
template <class Step, class State, class ToQuaternion>
double off_after(int steps, State state, const Step& step, const ToQuaternion& to_quaternion) {
  const Top top;
  const double dt = 1.0 / steps;
  for (int k = 0; k < steps; ++k) state = step(state, top.angular_velocity((k + 0.5) * dt), dt);
  return turn_between(to_quaternion(state), top.at(1));
}

}  // namespace

TEST_CASE("angle, matrix and complex number of one direction turn a vector alike, and each gives the others") {
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double angle = random.between(-20, 20), short_one = std::remainder(angle, 2 * pi);
    const Vec2 v(random.between(-3, 3), random.between(-3, 3));
    const Vec2 expected(v.x() * std::cos(angle) - v.y() * std::sin(angle),
                        v.x() * std::sin(angle) + v.y() * std::cos(angle));
    CHECK(near(Vec2(matrix_of(angle) * v), expected, 1e-14));
    CHECK(near(Vec2(complex_of(angle) * v), expected, 1e-14));
    CHECK(near(matrix_of(complex_of(angle)), matrix_of(angle), 0));
    CHECK(complex_of(matrix_of(angle)) == complex_of(angle));
    CHECK(near(angle_of(matrix_of(angle)), short_one, 1e-14));
    CHECK(near(wrapped(angle), short_one, 0));
  }
  CHECK(wrapped(0) == 0);
  CHECK(near(turned(3, 1, 0.5), 3.5 - 2 * pi, 1e-15));
}

TEST_CASE("rotation vector, matrix and quaternion of one rotation turn a vector alike, and each gives the others") {
  test::Random random(5);
  for (int i = 0; i < 500; ++i) {
    // Among them turns by next to nothing, and by next to half a turn about axes of all kinds.
    Vec3 r = within(random, pi);
    if (i % 5 == 0) r *= 1e-9;
    if (i % 5 == 1) r *= (pi - 1e-9) / r.norm();
    if (i % 5 == 2) r = (i % 2 == 0 ? pi : -pi) * Vec3::Unit(i % 3);
    const Quat q = exp_map(r);
    const Vec3 v = random.vector(2);
    CHECK(near(Vec3(matrix_of(r) * v), Vec3(q * v), 1e-14));
    CHECK(near(matrix_of(q), matrix_of(r), 1e-14));
    CHECK(near(quaternion_of(matrix_of(q)), q, 1e-15));
    CHECK(near(exp_map(rotation_vector_of(matrix_of(r))), q, 1e-14));
    CHECK(near(exp_map(wrapped(Vec3(r * (1 + 4 * pi / r.norm())))), q, 1e-14));
    CHECK(wrapped(Vec3(r * (1 + 3 / r.norm()))).norm() <= pi * (1 + 1e-15));
  }
  // The lecture's: [4 pi, 3 pi, 0] is 5 pi a second about the axis along y = 3 x / 4; in a fifth of a second half a
  // turn.
  CHECK(near(turned(Mat3(Mat3::Identity()), Vec3(4 * pi, 3 * pi, 0), 0.2), matrix_of(Vec3(0.8 * pi, 0.6 * pi, 0)),
             1e-15));
  CHECK(matrix_of(Vec3(0, 0, 0)) == Mat3(Mat3::Identity()));
}

TEST_CASE("plain steps turn by an arc tangent and grow by a root, as their closed forms say") {
  constexpr int steps = 1000;
  constexpr double rate = 3, dt = 1e-3;
  UnitComplex complex;
  Mat2 matrix = Mat2::Identity();
  Quat q(1, 0, 0, 0);
  for (int k = 0; k < steps; ++k) {
    complex = turned_to_first_order(complex, rate, dt);
    matrix = turned_to_first_order(matrix, rate, dt);
    q = turned_to_first_order(q, Vec3(0, 0, rate), dt);
  }
  const double grown = std::pow(1 + rate * dt * rate * dt, steps / 2.0);
  CHECK(near(angle_of(complex), std::remainder(steps * std::atan(rate * dt), 2 * pi), 1e-12));
  CHECK(near(drift(complex), grown - 1, 1e-13));
  CHECK(near(drift(matrix), grown * grown - 1, 1e-12));
  CHECK(near(drift(q), std::pow(1 + rate * dt * rate * dt / 4, steps / 2.0) - 1, 1e-13));
  CHECK(near(log_map(normalized(q)).z(), 2 * steps * std::atan(rate * dt / 2), 1e-12));
  CHECK(std::abs(drift(renormalized(complex))) < 1e-15);
  CHECK(near(angle_of(renormalized(complex)), angle_of(complex), 1e-15));
  CHECK(drift(renormalized(matrix)) < 1e-15);
}

TEST_CASE("products drift by rounding alone, and what is renormalized is a rotation again") {
  UnitComplex complex;
  Mat2 plane = Mat2::Identity();
  Mat3 matrix = Mat3::Identity();
  Quat q(1, 0, 0, 0);
  const Vec3 w(0.3, -0.7, 1.1);
  for (int k = 0; k < 20000; ++k) {
    complex = turned(complex, 1.3, 0.01);
    plane = turned(plane, 1.3, 0.01);
    matrix = turned(matrix, w, 0.01);
    q = turned(q, w, 0.01);
  }
  CHECK(std::abs(drift(complex)) < 1e-11);
  CHECK(drift(plane) < 1e-11);
  CHECK(drift(matrix) < 1e-11);
  CHECK(std::abs(drift(q)) < 1e-11);
  CHECK(near(angle_of(complex), std::remainder(1.3 * 200, 2 * pi), 1e-10));
  CHECK(near(quaternion_of(matrix), exp_map(200 * w), 1e-10));
  CHECK(near(normalized(q), exp_map(200 * w), 1e-10));
  test::Random random(8);
  for (int i = 0; i < 50; ++i) {
    Mat3 bent = matrix_of(within(random, 3));
    for (int k = 0; k < 9; ++k) bent(k % 3, k / 3) += random.between(-0.05, 0.05);
    const Mat3 made = renormalized(bent);
    CHECK(drift(made) < 1e-15);
    CHECK(made.determinant() == doctest::Approx(1));
    CHECK((made - bent).cwiseAbs().maxCoeff() < 0.3);
    CHECK(std::abs(drift(quaternion_of(bent))) < 1e-15);
  }
  // Columns that are nearly the same still make a rotation.
  for (const double apart : {1e-3, 1e-7, 1e-11}) {
    Mat3 flat = matrix_of(within(random, 3));
    flat.col(1) = flat.col(0) + apart * flat.col(1);
    CHECK(drift(renormalized(flat)) < 1e-15);
  }
}

TEST_CASE("a top that nothing turns is led to where its closed form says, by the order of each way") {
  const auto same = [](const Quat& q) { return normalized(q); };
  const auto by_quaternion = [](const Quat& q, const Vec3& w, double dt) { return turned(q, w, dt); };
  const auto by_plain_quaternion = [](const Quat& q, const Vec3& w, double dt) {
    return normalized(turned_to_first_order(q, w, dt));
  };
  const auto by_matrix = [](const Mat3& m, const Vec3& w, double dt) { return turned(m, w, dt); };
  const auto by_vector = [](const Vec3& r, const Vec3& w, double dt) { return turned(r, w, dt); };
  const auto order = [](const auto& off) { return std::log2(off(200) / off(400)); };
  const Quat none(1, 0, 0, 0);
  CHECK(order([&](int n) { return off_after(n, none, by_quaternion, same); }) == doctest::Approx(2).epsilon(0.02));
  CHECK(order([&](int n) { return off_after(n, none, by_plain_quaternion, same); }) ==
        doctest::Approx(2).epsilon(0.02));
  const double exact = off_after(400, none, by_quaternion, same);
  CHECK(exact < 1e-5);
  CHECK(near(off_after(400, Mat3(Mat3::Identity()), by_matrix, [](const Mat3& m) { return quaternion_of(m); }), exact,
             1e-12));
  CHECK(near(off_after(400, Vec3(0, 0, 0), by_vector, [](const Vec3& r) { return exp_map(r); }), exact, 1e-12));
  // Vectors that are merely added do not get there at any step.
  const auto by_sum = [](const Vec3& r, const Vec3& w, double dt) { return turned_to_first_order(r, w, dt); };
  for (const int steps : {400, 4000})
    CHECK(off_after(steps, Vec3(0, 0, 0), by_sum, [](const Vec3& r) { return exp_map(r); }) > 0.01);
}

TEST_CASE("what turns nothing is refused") {
  CHECK_THROWS_AS((void)renormalized(UnitComplex{0, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)renormalized(Mat2(Mat2::Zero())), std::invalid_argument);
  CHECK_THROWS_AS((void)renormalized(Mat3(Mat3::Ones())), std::invalid_argument);
  Mat3 broken = Mat3::Identity();
  broken(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)renormalized(broken), std::invalid_argument);
}
