// A curve from keys, and what every evaluation returns: the value and its exact rate.

#include <tweenfall/curves/keys.h>

#include <cstdio>

using namespace tweenfall;

int main() {
  // Keys say how the curve leaves them: eased, with a slope of its own, or by the default rule.
  const Curve<double> height = keyed_curve<double>({
      {.time = 0.0, .value = 3.0, .ease = *Ease::named("quad-in")},
      {.time = 0.8, .value = 0.2, .ease = Ease::linear()},
      {.time = 1.0, .value = 0.2, .out = Tangent<double>{.kind = Tangent<double>::Kind::given, .rate = 4.0}},
      {.time = 1.6, .value = 1.0},
  });

  std::printf("  time    height      rate\n");
  for (double time = 0; time <= 1.6001; time += 0.2) {
    const Sample<double> sample = height.sample(time);
    std::printf("%6.2f %9.4f %9.4f\n", time, sample.value, sample.rate);
  }

  // At a key where the curve kinks, both sides can be asked for.
  std::printf("at 0.8 s it arrives with %.3f and leaves with %.3f\n", height.rate(0.8, Side::in), height.rate(0.8));
  return height.rate(0.8, Side::in) < -6.9 && height.rate(0.8) == 0 ? 0 : 1;
}
