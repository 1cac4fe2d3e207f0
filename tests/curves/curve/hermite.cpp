#include <tweenfall/curves/hermite.h>

#include "support.h"

using namespace tweenfall;

TEST_CASE("the Hermite basis has the lecture's values and slopes at both ends") {
  const hermite::Basis at0 = hermite::basis(0), at1 = hermite::basis(1);
  const hermite::Basis slope0 = hermite::basis_derivative(0), slope1 = hermite::basis_derivative(1);
  const double table[4][4] = {
      {at0.h00, at1.h00, slope0.h00, slope1.h00},
      {at0.h10, at1.h10, slope0.h10, slope1.h10},
      {at0.h01, at1.h01, slope0.h01, slope1.h01},
      {at0.h11, at1.h11, slope0.h11, slope1.h11},
  };
  const double expected[4][4] = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) CHECK(table[row][column] == expected[row][column]);
}

TEST_CASE("the slope of the first Hermite weight is 6u(u - 1)") {
  for (int i = 0; i <= 20; ++i) {
    const double u = i / 20.0;
    CHECK(test::near(hermite::basis_derivative(u).h00, 6 * u * (u - 1), 1e-15));
    CHECK(test::near(hermite::basis(u).h00 + hermite::basis(u).h01, 1.0, 1e-15));
  }
}

TEST_CASE("a Hermite segment through a parabola is the parabola with its rates") {
  // x = 3 - 2 t + 5 t^2 on 0 to 0.7
  const double end = 3 - 2 * 0.7 + 5 * 0.49;
  for (int i = 0; i <= 10; ++i) {
    const double t = 0.07 * i;
    const Sample<double> s = hermite::sample(3.0, -2.0, end, -2 + 10 * 0.7, 0.7, t / 0.7);
    CHECK(test::near(s.value, 3 - 2 * t + 5 * t * t, 1e-14));
    CHECK(test::near(s.rate, -2 + 10 * t, 1e-13));
    CHECK(test::near(s.acceleration, 10.0, 1e-12));
  }
}
