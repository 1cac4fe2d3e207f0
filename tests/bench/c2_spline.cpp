// Building a C2 curve of very many keys, from keys and from data, beside GSL's cubic spline.

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/splines.h>

#include <benchmark/benchmark.h>
#include <gsl/gsl_spline.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using namespace tweenfall;

struct Data {
  std::vector<double> times, values;

  explicit Data(std::int64_t count) {
    double time = 0;
    for (std::int64_t i = 0; i < count; ++i) {
      times.push_back(time);
      values.push_back(std::sin(0.3 * static_cast<double>(i)));
      time += 1 + 0.4 * std::sin(1.7 * static_cast<double>(i));
    }
  }
};

void c2_from_keys(benchmark::State& state) {
  const Data data(state.range(0));
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < data.times.size(); ++i) keys.push_back({data.times[i], data.values[i], Ease::natural()});
  for (auto _ : state) benchmark::DoNotOptimize(keyed_curve<double>(std::span<const Key<double>>(keys)));
}

void c2_from_data(benchmark::State& state) {
  const Data data(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(c2_spline<double>(data.times, data.values));
}

void c2_of_gsl(benchmark::State& state) {
  const Data data(state.range(0));
  for (auto _ : state) {
    gsl_spline* spline = gsl_spline_alloc(gsl_interp_cspline, data.times.size());
    gsl_spline_init(spline, data.times.data(), data.values.data(), data.times.size());
    benchmark::DoNotOptimize(spline);
    gsl_spline_free(spline);
  }
}

BENCHMARK(c2_from_keys)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(c2_from_data)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(c2_of_gsl)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
