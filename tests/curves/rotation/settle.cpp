#include <tweenfall/curves/settle.h>

#include "curves/stated.h"

using namespace tweenfall;

TEST_CASE("the quintic decay agrees with scipy, at both signs") {
  for (const auto& file : test::vector_family("inertialize_quintic")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const double offset = c["input"]["offset"], rate = c["input"]["velocity"];
      for (const double sign : {1.0, -1.0}) {
        const QuinticDecay decay(sign * offset, sign * rate, c["input"]["blend_time"], 0);
        CHECK(std::abs(decay.duration - c["blend_time_used"].get<double>()) <= tolerance);
        CHECK(test::near(decay.sample(0).acceleration, sign * c["initial_acceleration"].get<double>(), tolerance));
        for (std::size_t i = 0; i < c["t"].size(); ++i) {
          CAPTURE(c["t"][i].get<double>());
          const Sample<double> s = decay.sample(c["t"][i]);
          CHECK(std::abs(s.value - sign * c["value"][i].get<double>()) <= tolerance);
          CHECK(std::abs(s.rate - sign * c["derivative"][i].get<double>()) <= tolerance);
        }
      }
    }
  }
}

TEST_CASE("a decay starts with the offset it was given and is exactly zero afterwards") {
  const QuinticDecay decay(-0.3, 4, 0.4);
  CHECK(decay.sample(0).value == -0.3);
  CHECK(decay.sample(0).rate == 4);
  CHECK(decay.duration == doctest::Approx(5 * 0.3 / 4));
  CHECK(decay.sample(decay.duration).value == 0);
  CHECK(decay.sample(decay.duration).rate == 0);
  CHECK(decay.sample(9).acceleration == 0);
  CHECK(std::abs(decay.sample(decay.duration * (1 - 1e-9)).value) < 1e-15);
}

TEST_CASE("a decay is never shortened below its floor") {
  CHECK(QuinticDecay(0.001, -10, 0.4).duration == 0.02);
  CHECK(QuinticDecay(0.001, -10, 0.01).duration == 0.01);
  CHECK(QuinticDecay(0, 0, 0.4).duration == 0);
}

TEST_CASE("the spring decay solves x'' + 2 y x' + y^2 x = 0") {
  const SpringDecay decay{1.5, -2, 0.2};
  const double y = 2 * std::log(2.0) / 0.2;
  CHECK(decay.sample(0).value == 1.5);
  CHECK(decay.sample(0).rate == doctest::Approx(-2));
  for (const double t : {0.0, 0.1, 0.5, 2.0}) {
    const Sample<double> s = decay.sample(t);
    CHECK(std::abs(s.acceleration + 2 * y * s.rate + y * y * s.value) < 1e-12);
    CHECK(s.value == doctest::Approx((1.5 + (-2 + y * 1.5) * t) * std::exp(-y * t)));
  }
}

TEST_CASE("a decay of next to nothing is met with no more than the stated acceleration") {
  for (const double rate : {-1.0, -50.0, -300.0, -1000.0, 700.0}) {
    for (const double offset : {1e-18, 1e-9, 1e-3}) {
      CAPTURE(rate);
      CAPTURE(offset);
      const QuinticDecay decay(offset, rate, 3);
      CHECK(std::abs(decay.sample(0).acceleration) <= 4000 * (1 + 1e-9));
    }
  }
}
