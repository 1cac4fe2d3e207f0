// One scalar cubic Hermite curve of 301 keys at sequential and at random times, 1,000 such curves at one time, and
// building a C2 curve of a million keys: ours beside Boost.Math's and the GNU Scientific Library's. GSL has no curve
// with given slopes, so there it is the C2 spline through the same keys, which is evaluated in the same way.

#include <tweenfall/curves/keys.h>

#include <benchmark/benchmark.h>
#include <gsl/gsl_spline.h>
#include <boost/math/interpolators/cubic_hermite.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace {

using namespace tweenfall;

constexpr std::size_t key_count = 301, time_count = 4096, curve_count = 1000;

struct Data {
  std::vector<double> times, values, slopes;
};

// Uneven keys of a wave; `phase` tells the curves apart.
Data data(std::size_t count, double phase) {
  Data result;
  double time = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i);
    result.times.push_back(time);
    result.values.push_back(std::sin(0.3 * x + phase));
    result.slopes.push_back(0.3 * std::cos(0.3 * x + phase));
    time += 1 + 0.4 * std::sin(1.7 * x);
  }
  return result;
}

std::vector<double> sequential_times(double end) {
  std::vector<double> result;
  for (std::size_t i = 0; i < time_count; ++i)
    result.push_back(end * static_cast<double>(i) / static_cast<double>(time_count));
  return result;
}

std::vector<double> random_times(double end) {
  std::vector<double> result;
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < time_count; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    result.push_back(end * static_cast<double>(state >> 11) * 0x1p-53);
  }
  return result;
}

struct Ours {
  explicit Ours(const Data& d) : curve(built(d)) {}
  static Curve<double> built(const Data& d) {
    std::vector<Key<double>> keys;
    for (std::size_t i = 0; i < d.times.size(); ++i) {
      const Tangent<double> slope{Tangent<double>::Kind::given, d.slopes[i]};
      keys.push_back({d.times[i], d.values[i], Ease::smooth_clamped(), slope, slope});
    }
    return keyed_curve<double>(std::span<const Key<double>>(keys));
  }
  double operator()(double t) const { return curve.value(t); }
  Curve<double> curve;
};

// Value, rate and acceleration at once, which is what is mostly asked for.
struct OursWithRates : Ours {
  using Ours::Ours;
  double operator()(double t) const {
    const Sample<double> s = curve.sample(t);
    return s.value + s.rate + s.acceleration;
  }
};

struct Boost {
  explicit Boost(const Data& d)
      : curve(std::vector<double>(d.times), std::vector<double>(d.values), std::vector<double>(d.slopes)) {}
  double operator()(double t) const { return curve(t); }
  boost::math::interpolators::cubic_hermite<std::vector<double>> curve;
};

struct Gsl {
  explicit Gsl(const Data& d)
      : curve(gsl_spline_alloc(gsl_interp_cspline, d.times.size()), gsl_spline_free),
        memory(gsl_interp_accel_alloc(), gsl_interp_accel_free) {
    gsl_spline_init(curve.get(), d.times.data(), d.values.data(), d.times.size());
  }
  double operator()(double t) const { return gsl_spline_eval(curve.get(), t, memory.get()); }
  std::shared_ptr<gsl_spline> curve;
  std::shared_ptr<gsl_interp_accel> memory;
};

template <class Library>
void at_times(benchmark::State& state, const std::vector<double>& times, const Data& d) {
  const Library curve(d);
  for (auto _ : state)
    for (const double t : times) benchmark::DoNotOptimize(curve(t));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(times.size()));
}

template <class Library>
void sequential(benchmark::State& state) {
  const Data d = data(key_count, 0);
  at_times<Library>(state, sequential_times(d.times.back()), d);
}

template <class Library>
void random(benchmark::State& state) {
  const Data d = data(key_count, 0);
  at_times<Library>(state, random_times(d.times.back()), d);
}

template <class Library>
void many_at_one_time(benchmark::State& state) {
  std::vector<Library> curves;
  for (std::size_t i = 0; i < curve_count; ++i) curves.emplace_back(data(key_count, static_cast<double>(i)));
  std::vector<double> out(curve_count);
  const std::vector<double> times = sequential_times(data(key_count, 0).times.back());
  std::size_t next = 0;
  for (auto _ : state) {
    const double t = times[next++ % times.size()];
    for (std::size_t i = 0; i < curve_count; ++i) out[i] = curves[i](t);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(curve_count));
}

void build_c2(benchmark::State& state) {
  const Data d = data(static_cast<std::size_t>(state.range(0)), 0);
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < d.times.size(); ++i) keys.push_back({d.times[i], d.values[i], Ease::natural()});
  for (auto _ : state) benchmark::DoNotOptimize(keyed_curve<double>(std::span<const Key<double>>(keys)));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void build_c2_gsl(benchmark::State& state) {
  const Data d = data(static_cast<std::size_t>(state.range(0)), 0);
  for (auto _ : state) benchmark::DoNotOptimize(Gsl(d));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(sequential<Ours>);
BENCHMARK(sequential<OursWithRates>);
BENCHMARK(sequential<Boost>);
BENCHMARK(sequential<Gsl>);
BENCHMARK(random<Ours>);
BENCHMARK(random<OursWithRates>);
BENCHMARK(random<Boost>);
BENCHMARK(random<Gsl>);
BENCHMARK(many_at_one_time<Ours>);
BENCHMARK(many_at_one_time<OursWithRates>);
BENCHMARK(many_at_one_time<Boost>);
BENCHMARK(many_at_one_time<Gsl>);
BENCHMARK(build_c2)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(build_c2_gsl)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
