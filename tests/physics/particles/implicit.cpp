#include <tweenfall/physics/particles.h>

#include <cmath>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

constexpr Integrator implicit_ones[] = {Integrator::backward_euler, Integrator::implicit_trapezoid};

/// A particle of 1 kg, without weight, and a second far away.
Particles unweighted(Integrator integrator, const Vec3& place, const Vec3& velocity) {
  Particles particles({.gravity = Vec3(0, 0, 0), .integrator = integrator, .mass = 1, .life = 1e9});
  particles.emit(place, velocity);
  particles.emit(Vec3(30, -2, 7), Vec3(0, 1, 0));
  return particles;
}

double share_of_end(Integrator integrator) {
  return integrator == Integrator::backward_euler ? 1 : 0.5;
}

}  // namespace

TEST_CASE("a particle on a spring loses 1 + (h w)^2 of its energy per step by backward Euler, none by the trapezoid") {
  const double w = 3, h = 0.05;
  for (const Integrator integrator : implicit_ones) {
    Particles particles = unweighted(integrator, Vec3(0.7, 0.2, -0.4), Vec3(-1, 0.5, 2));
    particles.add_force(ForceFormula::potential("4.5*(x*x + y*y + z*z)"));
    const auto energy = [&] {
      return 0.5 * particles.velocity(0).squaredNorm() + 0.5 * w * w * particles.position(0).squaredNorm();
    };
    const double factor = integrator == Integrator::backward_euler ? 1 / (1 + h * h * w * w) : 1;
    double expected = energy();
    for (int step = 0; step < 400; ++step) {
      particles.step(h);
      expected *= factor;
      REQUIRE(energy() == doctest::Approx(expected).epsilon(1e-12 * (step + 1)));
    }
  }
}

TEST_CASE(
    "where the force is linear a particle ends where the closed form says, however stiff and from whichever side") {
  const double h = 1.0 / 60;
  for (const Integrator integrator : implicit_ones)
    for (const double stiffness : {1.0, 1e3, 1e6, 1e9, 1e12}) {
      CAPTURE(stiffness);
      const Vec3 x(0.3, -0.1, 0.2), v(1, 2, -1);
      Particles particles = unweighted(integrator, x, v);
      const Expression::Parameter k{"k", stiffness};
      // A spring along x alone, drag across it, and a steady push.
      particles.add_force(ForceFormula({"-k*x", "2 - 5*vy", "-0.5*vz + 3*vx"}, {k}));
      particles.step(h);
      const double a = share_of_end(integrator), before = 1 - a;
      const double vx = (v.x() - before * h * stiffness * x.x() - a * h * stiffness * (x.x() + before * h * v.x())) /
                        (1 + a * a * h * h * stiffness);
      const double vy = (v.y() + h * 2 - before * h * 5 * v.y()) / (1 + a * h * 5);
      const double vz = (v.z() + before * h * (3 * v.x() - 0.5 * v.z()) + a * h * 3 * vx) / (1 + a * h * 0.5);
      const double rounds = 1e-13 * std::max(1.0, std::abs(vx));
      CHECK(near(particles.velocity(0), Vec3(vx, vy, vz), rounds));
      CHECK(near(particles.position(0), x + h * (before * v + a * Vec3(vx, vy, vz)), 1e-13));
    }
}

TEST_CASE("quadratic drag of any strength slows a particle to the root of its quadratic equation") {
  const double h = 0.1, v = 20;
  for (const double c : {1e-3, 1.0, 1e4, 1e9}) {
    CAPTURE(c);
    const Vec3 along = Vec3(2, -1, 2) / 3;
    for (const Integrator integrator : implicit_ones) {
      Particles particles = unweighted(integrator, Vec3(5, 5, 5), v * along);
      particles.add_force(Drag{.quadratic = c});
      particles.step(h);
      // u + a h c u |u| = v - (1 - a) h c v^2
      const double a = share_of_end(integrator), known = v - (1 - a) * h * c * v * v, share = a * h * c;
      const double u = 2 * known / (1 + std::sqrt(1 + 4 * share * std::abs(known)));
      CHECK(near(particles.velocity(0), u * along, 1e-12 * std::max(v, std::abs(u))));
    }
  }
}

TEST_CASE("what an implicit integrator does to a particle does not depend on the others, and stays finite anywhere") {
  for (const Integrator integrator : implicit_ones) {
    const auto thrown = [&](int others) {
      Particles particles({.integrator = integrator, .mass = 0.01});
      for (int i = 0; i < others; ++i) particles.emit(Vec3(0.01 * i, 1, 0.3), Vec3(0, 0.1 * i, 1));
      particles.emit(Vec3(1, 2, 3), Vec3(3, 0, -1));
      particles.add_force(Drag{.linear = 0.01, .quadratic = 0.02});
      particles.add_force(Attractor{.at = Vec3(0.5, 1, 0.3), .acceleration = 50});
      particles.add_force(ForceFormula({"sin(30*x)", "-sign(y - 1)", "abs(z)"}));
      for (int i = 0; i < 60; ++i) particles.step(1.0 / 60);
      for (std::size_t i = 0; i < particles.size(); ++i)
        REQUIRE((particles.position(i).allFinite() && particles.velocity(i).allFinite()));
      return particles;
    };
    const Particles alone = thrown(0), among = thrown(700);
    REQUIRE(alone.size() == 1);
    CHECK(among.position(among.size() - 1) == alone.position(0));
    CHECK(among.velocity(among.size() - 1) == alone.velocity(0));
  }
}
