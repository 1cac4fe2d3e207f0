// The lecture's two tables of ways to represent the rotation of a body, with measured numbers: what each stores, what a
// step and the conversion to a matrix cost, and how far a million steps drift.

#include <tweenfall/curves/orientation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

using namespace tweenfall;

namespace {

constexpr int steps = 1'000'000;
constexpr double dt = 1e-3;

struct Row {
  std::string name;
  int numbers;
  double cost, to_matrix;  ///< CPU s
  double drift, off;       ///< from being a rotation; from the exact rotation, rad
};

/// Runs it a million times.
template <class Work>
double seconds_of(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

template <class State, class Step, class Matrix, class Off>
Row measured(const std::string& name, int numbers, State state, const Step& step, const Matrix& matrix,
             double drifted(const State&), const Off& off) {
  const double cost = seconds_of([&] {
    for (int k = 0; k < steps; ++k) state = step(state, k);
  });
  // Summed up, so that no step is optimized away.
  double sum = 0;
  const double to_matrix = seconds_of([&] {
    State copy = state;
    for (int k = 0; k < steps; ++k) {
      copy = state;
      sum += matrix(copy)(0, 0);
    }
  });
  return {name, numbers, cost, to_matrix + 0 * sum, drifted(state), off(state)};
}

void print(const char* title, const std::vector<Row>& rows) {
  double least = rows.front().cost, cheapest = 1e9;
  for (const Row& row : rows) {
    least = std::min(least, row.cost);
    if (row.to_matrix > 0) cheapest = std::min(cheapest, row.to_matrix);
  }
  std::printf("%s\n  %-36s numbers   a step   to a matrix      drift   off, rad\n", title, "");
  for (const Row& row : rows)
    std::printf("  %-36s %7d %6.1f x %11.1f x %10.1e %10.1e\n", row.name.c_str(), row.numbers, row.cost / least,
                row.to_matrix / cheapest, std::abs(row.drift), row.off);
}

}  // namespace

int main() {
  // In a plane: 3 rad/s.
  constexpr double rate = 3;
  const auto off_angle = [](double angle) {
    return std::abs(std::remainder(angle - rate * dt * steps, 2 * std::numbers::pi));
  };
  const auto off_complex = [&](const UnitComplex& z) { return off_angle(angle_of(z)); };
  const auto off_matrix = [&](const Mat2& m) { return off_angle(angle_of(m)); };
  const auto to_matrix = [](const auto& state) { return matrix_of(state); };
  const auto as_it_is = [](const auto& matrix) { return matrix; };
  const std::vector<Row> plane = {
      measured<double>(
          "angle", 1, 0.0, [](double a, int) { return turned(a, rate, dt); }, to_matrix,
          [](const double&) { return 0.0; }, off_angle),
      measured<Mat2>(
          "matrix", 4, Mat2(Mat2::Identity()), [](const Mat2& m, int) { return turned(m, rate, dt); }, as_it_is, drift,
          off_matrix),
      measured<Mat2>(
          "matrix, renormalized", 4, Mat2(Mat2::Identity()),
          [](const Mat2& m, int) { return renormalized(turned(m, rate, dt)); }, as_it_is, drift, off_matrix),
      measured<UnitComplex>(
          "complex number", 2, UnitComplex{}, [](const UnitComplex& z, int) { return turned(z, rate, dt); }, to_matrix,
          drift, off_complex),
      measured<UnitComplex>(
          "complex number, renormalized", 2, UnitComplex{},
          [](const UnitComplex& z, int) { return renormalized(turned(z, rate, dt)); }, to_matrix, drift, off_complex),
      measured<UnitComplex>(
          "complex number, plain steps", 2, UnitComplex{},
          [](const UnitComplex& z, int) { return turned_to_first_order(z, rate, dt); }, to_matrix, drift, off_complex)};
  print("In a plane, a million steps of 1 ms at 3 rad/s", plane);

  // In space: a top of moments 2, 2, 3 without torque. It precesses about its momentum at |L| / 2, and also turns about
  // its own axis.
  const Vec3 momentum(0.8, 0.6, 15);
  constexpr double beside = 5 * (2.0 - 3) / 2;
  const auto top_at = [&](double time) { return exp_map(momentum * (time / 2)) * exp_map(Vec3(0, 0, beside * time)); };
  // Its angular velocity in the middle of each step, computed once.
  std::vector<Vec3> w;
  w.reserve(steps);
  for (int k = 0; k < steps; ++k) w.emplace_back(momentum / 2 + beside * (top_at((k + 0.5) * dt) * Vec3(0, 0, 1)));
  const Quat end = top_at(steps * dt);
  const auto off_quat = [&](const Quat& q) { return log_map(normalized(q) * end.conjugate()).norm(); };
  const auto off_mat = [&](const Mat3& m) { return off_quat(quaternion_of(m)); };
  const auto off_vec = [&](const Vec3& r) { return off_quat(exp_map(r)); };
  const auto at = [&](int k) -> const Vec3& { return w[static_cast<std::size_t>(k)]; };
  const auto none = [](const Vec3&) { return 0.0; };
  const Quat q0(1, 0, 0, 0);
  const Mat3 m0 = Mat3::Identity();
  const std::vector<Row> space = {
      measured<Vec3>(
          "rotation vector, merely added", 3, Vec3(0, 0, 0),
          [&](const Vec3& r, int k) { return turned_to_first_order(r, at(k), dt); }, to_matrix, none, off_vec),
      measured<Vec3>(
          "rotation vector", 3, Vec3(0, 0, 0), [&](const Vec3& r, int k) { return turned(r, at(k), dt); }, to_matrix,
          none, off_vec),
      measured<Mat3>(
          "matrix", 9, m0, [&](const Mat3& m, int k) { return turned(m, at(k), dt); }, as_it_is, drift, off_mat),
      measured<Mat3>(
          "matrix, renormalized", 9, m0, [&](const Mat3& m, int k) { return renormalized(turned(m, at(k), dt)); },
          as_it_is, drift, off_mat),
      measured<Quat>(
          "quaternion", 4, q0, [&](const Quat& q, int k) { return turned(q, at(k), dt); }, to_matrix, drift, off_quat),
      measured<Quat>(
          "quaternion, plain steps", 4, q0, [&](const Quat& q, int k) { return turned_to_first_order(q, at(k), dt); },
          to_matrix, drift, off_quat),
      measured<Quat>(
          "quaternion, plain steps, renormalized", 4, q0,
          [&](const Quat& q, int k) { return normalized(turned_to_first_order(q, at(k), dt)); }, to_matrix, drift,
          off_quat)};
  print("\nIn space, a million steps of 1 ms of a top that precesses at 7.5 rad/s", space);

  // Exact turns stay near, mere additions do not.
  return plane[1].off < 1e-6 && space[4].off < 0.1 && space[4].off < space[0].off ? 0 : 1;
}
