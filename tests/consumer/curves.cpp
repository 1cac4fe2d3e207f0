// Uses curves and nothing else; prints bits, so that builds with other flags can be compared.

#include <tweenfall/curves/keys.h>

#include <cstdio>

int main() {
  const tweenfall::Curve<double> height = tweenfall::keyed_curve<double>(
      {{.time = 0.0, .value = 3.0}, {.time = 0.8, .value = 0.1}, {.time = 1.4, .value = 0.7}});
  for (int i = 0; i <= 20; ++i) std::printf("%a %a\n", height.value(0.07 * i), height.rate(0.07 * i));
  return height.value(0.0) == 3.0 ? 0 : 1;
}
