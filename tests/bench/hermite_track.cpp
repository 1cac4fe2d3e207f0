// One scalar Hermite curve of 301 keys beside Boost.Math's cubic_hermite and GSL's cubic spline, and a thousand of
// them.

#include <tweenfall/curves/batch.h>
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

constexpr std::size_t key_count = 301;
constexpr std::size_t curve_count = 1000;

double hashed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x / 4294967296.0;
}

// Ten seconds of keys near every thirtieth of a second, different for each curve.
struct Track {
  std::vector<double> times, values, slopes;

  explicit Track(std::uint32_t seed) {
    for (std::uint32_t i = 0; i < key_count; ++i) {
      times.push_back((i + 0.4 * hashed(seed * 977 + i)) / 30);
      values.push_back(std::sin(times.back() * 3 + seed));
      slopes.push_back(3 * std::cos(times.back() * 3 + seed));
    }
  }
  // Inside all tracks, whatever their seed.
  [[nodiscard]] static double at(double share) { return 0.02 + 9.97 * share; }
};

enum class Order { sequential, random };

// Shares of the duration, 4096 of them: 1/60 s apart in a loop, or anywhere.
std::vector<double> shares(Order order) {
  std::vector<double> result(4096);
  for (std::uint32_t i = 0; i < result.size(); ++i)
    result[i] = order == Order::sequential ? std::fmod(i / 600.0, 1.0) : hashed(i);
  return result;
}

Curve<double> ours(const Track& track) {
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < key_count; ++i) {
    Key<double> key{track.times[i], track.values[i]};
    key.in = key.out = Tangent<double>{Tangent<double>::Kind::given, track.slopes[i]};
    keys.push_back(key);
  }
  return keyed_curve<double>(keys);
}

struct Gsl {
  std::unique_ptr<gsl_spline, decltype(&gsl_spline_free)> spline;
  std::unique_ptr<gsl_interp_accel, decltype(&gsl_interp_accel_free)> place;

  explicit Gsl(const Track& track)
      : spline(gsl_spline_alloc(gsl_interp_cspline, key_count), &gsl_spline_free),
        place(gsl_interp_accel_alloc(), &gsl_interp_accel_free) {
    gsl_spline_init(spline.get(), track.times.data(), track.values.data(), key_count);
  }
  double operator()(double time) { return gsl_spline_eval(spline.get(), time, place.get()); }
};

boost::math::interpolators::cubic_hermite<std::vector<double>> boosts(Track track) {
  return {std::move(track.times), std::move(track.values), std::move(track.slopes)};
}

template <class Evaluate>
void one_curve(benchmark::State& state, Order order, Evaluate evaluate) {
  const Track track(1);
  std::vector<double> times = shares(order);
  for (double& time : times) time = Track::at(time);
  for (auto _ : state) {
    double sum = 0;
    for (const double time : times) sum += evaluate(time);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(times.size()));
}

void one_value(benchmark::State& state, Order order) {
  const Curve<double> curve = ours(Track(1));
  one_curve(state, order, [&](double time) { return curve.value(time); });
}
void one_value_and_rates(benchmark::State& state, Order order) {
  const Curve<double> curve = ours(Track(1));
  one_curve(state, order, [&](double time) {
    const Sample<double> sample = curve.sample(time);
    return sample.value + sample.rate + sample.acceleration;
  });
}
void one_of_boost(benchmark::State& state, Order order) {
  const auto curve = boosts(Track(1));
  one_curve(state, order, [&](double time) { return curve(time); });
}
void one_of_gsl(benchmark::State& state, Order order) {
  Gsl curve(Track(1));
  one_curve(state, order, [&](double time) { return curve(time); });
}

// A thousand curves at one time after the other; `evaluate(time)` evaluates all of them.
template <class Evaluate>
void all_curves(benchmark::State& state, Order order, Evaluate evaluate) {
  std::vector<double> times = shares(order);
  for (double& time : times) time = Track::at(time);
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(evaluate(times[next++ % times.size()]));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(curve_count));
}

template <class Make>
auto thousand(Make make) {
  std::vector<decltype(make(Track(0)))> curves;
  for (std::uint32_t i = 0; i < curve_count; ++i) curves.push_back(make(Track(i)));
  return curves;
}

void batch_values(benchmark::State& state, Order order) {
  CurveBatch batch(thousand(ours));
  std::vector<double> values(curve_count);
  all_curves(state, order, [&](double time) {
    batch.sample(time, values);
    return values[7];
  });
}
void batch_values_and_rates(benchmark::State& state, Order order) {
  CurveBatch batch(thousand(ours));
  std::vector<double> values(curve_count), rates(curve_count);
  all_curves(state, order, [&](double time) {
    batch.sample(time, values, rates);
    return values[7] + rates[7];
  });
}
void batch_of_boost(benchmark::State& state, Order order) {
  const auto curves = thousand(boosts);
  std::vector<double> values(curve_count);
  all_curves(state, order, [&](double time) {
    for (std::size_t i = 0; i < curve_count; ++i) values[i] = curves[i](time);
    return values[7];
  });
}
void batch_of_gsl(benchmark::State& state, Order order) {
  auto curves = thousand([](const Track& track) { return Gsl(track); });
  std::vector<double> values(curve_count);
  all_curves(state, order, [&](double time) {
    for (std::size_t i = 0; i < curve_count; ++i) values[i] = curves[i](time);
    return values[7];
  });
}

BENCHMARK_CAPTURE(one_value, sequential, Order::sequential);
BENCHMARK_CAPTURE(one_value_and_rates, sequential, Order::sequential);
BENCHMARK_CAPTURE(one_of_boost, sequential, Order::sequential);
BENCHMARK_CAPTURE(one_of_gsl, sequential, Order::sequential);
BENCHMARK_CAPTURE(one_value, random, Order::random);
BENCHMARK_CAPTURE(one_value_and_rates, random, Order::random);
BENCHMARK_CAPTURE(one_of_boost, random, Order::random);
BENCHMARK_CAPTURE(one_of_gsl, random, Order::random);
BENCHMARK_CAPTURE(batch_values, sequential, Order::sequential);
BENCHMARK_CAPTURE(batch_values_and_rates, sequential, Order::sequential);
BENCHMARK_CAPTURE(batch_of_boost, sequential, Order::sequential);
BENCHMARK_CAPTURE(batch_of_gsl, sequential, Order::sequential);
BENCHMARK_CAPTURE(batch_values, random, Order::random);
BENCHMARK_CAPTURE(batch_values_and_rates, random, Order::random);
BENCHMARK_CAPTURE(batch_of_boost, random, Order::random);
BENCHMARK_CAPTURE(batch_of_gsl, random, Order::random);

}  // namespace
