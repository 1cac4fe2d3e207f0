// The lecture's projectile, thrown at (3, 4) m/s under a gravity of 1 m/s^2: its table of the analytical model beside
// ours, and the numerical model second by second, by each integrator.

#include <tweenfall/curves/functions.h>
#include <tweenfall/physics/world.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

using namespace tweenfall;

namespace {

constexpr int seconds = 8;
/// As printed: 3 t and 4 t - t^2 / 2.
constexpr std::array<double, seconds + 1> printed_x{0, 3, 6, 9, 12, 15, 18, 21, 24};
constexpr std::array<double, seconds + 1> printed_y{0, 3.5, 6, 7.5, 8, 7.5, 6, 3.5, 0};

struct Throw {
  World world;
  BodyId ball;
};

Throw thrown_by(Integrator integrator) {
  WorldSettings settings;
  settings.gravity = Vec3(0, -1, 0);
  settings.integrator = integrator;
  Throw made{World(settings), {}};
  BodySettings ball;
  ball.motion.twist.linear = Vec3(3, 4, 0);
  made.ball = made.world.add(ball);
  return made;
}

}  // namespace

int main() {
  const Curve<Vec3> path = projectile({.velocity = {3, 4, 0}, .gravity = {0, -1, 0}});
  std::printf("Analytical: u = (3, 4), a = (0, -1)\n  t    lecture          ours\n");
  double off = 0;
  for (int t = 0; t <= seconds; ++t) {
    const auto row = static_cast<std::size_t>(t);
    const Vec3 place = path.value(t);
    off = std::max({off, std::abs(place.x() - printed_x[row]), std::abs(place.y() - printed_y[row])});
    std::printf("  %d  (%4.1f, %3.1f)  (%4.1f, %3.1f)\n", t, printed_x[row], printed_y[row], place.x(), place.y());
  }

  // Its first row is the lecture's: p' = (3, 4), v' = (3, 3).
  std::printf("\nNumerical, dt = 1: p' = p + v, v' = v + a\n  t       p         v          p'         v'\n");
  Throw euler = thrown_by(Integrator::explicit_euler);
  for (int t = 0; t < seconds; ++t) {
    const Vec3 p = euler.world.motion(euler.ball).pose.position, v = euler.world.twist(euler.ball).linear;
    euler.world.step(1);
    const Vec3 next = euler.world.motion(euler.ball).pose.position, rate = euler.world.twist(euler.ball).linear;
    std::printf("  %d  (%2.0f, %2.0f)  (%1.0f, %2.0f)   (%2.0f, %2.0f)   (%1.0f, %2.0f)\n", t, p.x(), p.y(), v.x(),
                v.y(), next.x(), next.y(), rate.x(), rate.y());
    if (t == 0) off = std::max({off, (next - Vec3(3, 4, 0)).norm(), (rate - Vec3(3, 3, 0)).norm()});
  }

  struct Row {
    const char* name;
    Integrator integrator;
  };
  std::printf("\nHeight, of which the last column is how far off it ends\n  %-20s", "t");
  for (int t = 1; t <= seconds; ++t) std::printf("%6d", t);
  std::printf("\n  %-20s", "lecture");
  for (int t = 1; t <= seconds; ++t) std::printf("%6.1f", printed_y[static_cast<std::size_t>(t)]);
  std::printf("\n");
  for (const Row& each :
       {Row{"explicit Euler", Integrator::explicit_euler}, Row{"semi-implicit Euler", Integrator::semi_implicit_euler},
        Row{"backward Euler", Integrator::backward_euler}, Row{"midpoint", Integrator::midpoint},
        Row{"trapezoid", Integrator::trapezoid}, Row{"implicit trapezoid", Integrator::implicit_trapezoid},
        Row{"verlet", Integrator::verlet}, Row{"rk4", Integrator::rk4},
        Row{"exact quadratic", Integrator::exact_quadratic}}) {
    Throw made = thrown_by(each.integrator);
    std::printf("  %-20s", each.name);
    double y = 0;
    for (int t = 1; t <= seconds; ++t) {
      made.world.step(1);
      y = made.world.motion(made.ball).pose.position.y();
      std::printf("%6.1f", y);
    }
    std::printf("%10.1e\n", y - printed_y.back());
    // Constant acceleration: what is of second order is exact, and the Eulers are off by t dt / 2.
    const bool euler_kind = each.integrator == Integrator::explicit_euler ||
                            each.integrator == Integrator::semi_implicit_euler ||
                            each.integrator == Integrator::backward_euler;
    off = std::max(off, std::abs(std::abs(y) - (euler_kind ? 4 : 0)));
  }
  return off < 1e-9 ? 0 : 1;
}
