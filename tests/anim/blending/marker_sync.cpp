#include <tweenfall/anim/marker_sync.h>

#include "anim/moving_pose.h"
#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// A walk, a limping run that begins with its right foot, a skip of two rounds, and a breath without steps.
std::vector<SyncClip> gaits() {
  return {{.duration = 1.2, .markers = {{0.1, "left"}, {0.7, "right"}}},
          {.duration = 0.7, .markers = {{0.05, "right"}, {0.45, "left"}}},
          {.duration = 2.5, .markers = {{0.0, "left"}, {0.8, "right"}, {1.3, "left"}, {1.9, "right"}}},
          {.duration = 4}};
}

double unwrapped(const MarkerSync& sync, std::size_t clip, double phase) {
  const SyncedTime at = sync.time(clip, {phase, 0, 0});
  return at.time.value + at.cycle * gaits()[clip].duration;
}

// Runge-Kutta of order 4 for the time over the phase, in a thousand steps from one whole phase to the next.
double finely_advanced(const MarkerSync& sync, double phase, double seconds, const std::vector<double>& from,
                       const std::vector<double>& to) {
  const double way = seconds > 0 ? 1 : -1;
  double sum_from = 0, sum_to = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    sum_from += from[i];
    sum_to += to[i];
  }
  std::vector<double> weights(from.size());
  const auto pace = [&](double at, double time) {
    for (std::size_t i = 0; i < from.size(); ++i)
      weights[i] = from[i] / sum_from * (1 - time / seconds) + to[i] / sum_to * (time / seconds);
    return 1 / sync.rate(at, weights);
  };
  double time = 0;
  for (;;) {
    const double marker = way > 0 ? std::floor(phase) + 1 : std::ceil(phase) - 1, begin = phase;
    for (int k = 0; k < 1000; ++k) {
      const auto after = [&](double h) {
        const double a = pace(phase, time), b = pace(phase + h / 2, time + h / 2 * a),
                     c = pace(phase + h / 2, time + h / 2 * b), d = pace(phase + h, time + h * c);
        return time + h / 6 * (a + 2 * b + 2 * c + d);
      };
      const double next = begin + (marker - begin) * (k + 1) / 1000, whole = next - phase;
      const double passed = after(whole);
      if (way * passed >= way * seconds) {
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
          const double middle = (low + high) / 2;
          (way * after(middle * whole) >= way * seconds ? high : low) = middle;
        }
        return phase + high * whole;
      }
      phase = next;
      time = passed;
    }
    phase = marker;
  }
}

}  // namespace

TEST_CASE("at a whole phase every clip is at its marker of the same name") {
  const MarkerSync sync(gaits());
  CHECK(sync.period() == 4);
  for (int phase = -8; phase < 12; ++phase) {
    const bool left = phase % 2 == 0;
    CHECK(sync.time(0, {1.0 * phase, 1, 0}).time.value == (left ? 0.1 : 0.7));
    CHECK(near(sync.time(1, {1.0 * phase, 1, 0}).time.value, left ? 0.45 : 0.05, 1e-15));
    const double skip[]{0, 0.8, 1.3, 1.9};
    CHECK(sync.time(2, {1.0 * phase, 1, 0}).time.value == skip[(phase + 8) % 4]);
    CHECK(near(sync.time(3, {1.0 * phase, 1, 0}).time.value, left ? 0.0 : 2.0, 1e-15));
  }
}

TEST_CASE("a clip's time in phase goes on smoothly and never back, and its rates are derivatives") {
  const MarkerSync sync(gaits());
  for (std::size_t clip = 0; clip < 4; ++clip) {
    double before = unwrapped(sync, clip, -4.001);
    for (int step = -4000; step < 8000; ++step) {
      const double now = unwrapped(sync, clip, step / 1000.0);
      if (!(now > before && now - before < 0.004)) CHECK(now > before);
      before = now;
    }
    for (const double phase : {0.3, 1.7, 2.45, 3.9}) {
      const double rate = 1.3, bend = -0.4;
      const auto at = [&](double t) {
        return sync.time(clip, {phase + rate * t + 0.5 * bend * t * t, rate + bend * t, bend});
      };
      const auto whole = [&](double t) { return at(t).time.value + at(t).cycle * gaits()[clip].duration; };
      CHECK(near(at(0).time.rate, slope(whole, 0), 1e-10));
      CHECK(near(at(0).time.acceleration, slope([&](double t) { return at(t).time.rate; }, 0), 1e-10));
    }
    // No jump of speed at a marker.
    for (const double phase : {0.0, 1.0, 2.0, 3.0})
      CHECK(near(sync.time(clip, {phase - 1e-9, 1, 0}).time.rate, sync.time(clip, {phase, 1, 0}).time.rate, 1e-7));
  }
}

TEST_CASE("a clip that has all the weight runs at its own speed, whatever the others are like") {
  const MarkerSync sync(gaits());
  for (std::size_t clip = 0; clip < 4; ++clip) {
    std::vector<double> weights(4, 0.0);
    std::vector<Sample<double>> samples(4, {0, 0, 0});
    weights[clip] = 0.3;
    samples[clip] = {0.3, 0.1, 0};
    double phase = sync.phase_at(clip, 0.2);
    CHECK(near(sync.time(clip, {phase, 0, 0}).time.value, 0.2, 1e-15));
    CHECK(near(sync.time(clip, sync.running(phase, samples)).time.rate, 1, 1e-15));
    CHECK(near(sync.time(clip, sync.running(phase, samples)).time.acceleration, 0, 1e-12));
    const double start = unwrapped(sync, clip, phase);
    for (int step = 1; step <= 100; ++step) {
      phase = sync.advanced(phase, 0.05, weights);
      CHECK(near(unwrapped(sync, clip, phase), start + 0.05 * step, 1e-13));
    }
    phase = sync.advanced(phase, -5, weights);
    CHECK(near(unwrapped(sync, clip, phase), start, 1e-12));
  }
}

TEST_CASE("the running phase has the exact rates of the clock, the weights' rates among them") {
  const MarkerSync sync(gaits());
  const auto weights_at = [](double t) {
    std::vector<Sample<double>> weights;
    for (const double start : {0.5, 0.2, 0.1, 0.3}) weights.push_back(moving_weight(t, start));
    return weights;
  };
  for (const double phase : {0.3, 1.2, 2.6, 3.8}) {
    const Sample<double> now = sync.running(phase, weights_at(0));
    // A phase that moves like this for a moment, to second order.
    const auto rate_at = [&](double t) {
      return sync.running(phase + now.rate * t + 0.5 * now.acceleration * t * t, weights_at(t)).rate;
    };
    CHECK(near(now.acceleration, slope(rate_at, 0), 1e-9));
    std::vector<double> plain;
    for (const Sample<double>& weight : weights_at(0)) plain.push_back(weight.value);
    CHECK(near(now.rate, slope([&](double t) { return sync.advanced(phase, t, plain); }, 0), 1e-9));
  }
}

TEST_CASE("under steady weights the mean of what clips go on by is the time that passes, over 10,000 loops too") {
  const MarkerSync sync(gaits());
  const std::vector<double> weights{0.4, 0.3, 0.2, 0.1};
  for (const double seconds : {0.001, 0.3, 5.0, 100.0, 25000.0}) {
    const double start = 1.37, end = sync.advanced(start, seconds, weights);
    double mean = 0;
    for (std::size_t i = 0; i < 4; ++i) mean += weights[i] * (unwrapped(sync, i, end) - unwrapped(sync, i, start));
    CHECK(near(mean, seconds, 1e-13));
    CHECK(near(sync.advanced(end, -seconds, weights), start, 1e-11 * std::max(1.0, seconds)));
  }
  // One step of ten thousand periods is that many periods, exactly.
  const double period = 0.4 * 2.4 + 0.3 * 1.4 + 0.2 * 2.5 + 0.1 * 8;
  CHECK(near(sync.advanced(0.5, 10000 * period, weights), 0.5 + 40000, 1e-14));
}

TEST_CASE("while weights change the phase is the same for long frames as for short ones") {
  const MarkerSync sync(gaits());
  const auto share = [](double t) { return std::vector<double>{1 - t, t, 0, 0}; };
  const auto run = [&](int frames) {
    double phase = 0.2;
    for (int k = 0; k < frames; ++k)
      phase = sync.advanced(phase, 1.0 / frames, share(1.0 * k / frames), share((k + 1.0) / frames));
    return phase;
  };
  const double fine = run(4000);
  for (const int frames : {1, 30, 60, 144}) CHECK(near(run(frames), fine, 1e-12));
  CHECK(run(60) != sync.advanced(0.2, 1, share(0.5)));
}

TEST_CASE("a fade between even loops follows its logarithm, however far the loops are apart and however long it is") {
  // With T = d phase for each clip, the phase comes by the integral of dt / (a + (b - a) t / h) = h log(b / a) / (b -
  // a).
  for (const double a : {0.01, 1.0, 1.0001, 300.0})
    for (const double b : {0.02, 1.5, 100.0, 4000.0}) {
      const MarkerSync sync({{.duration = a}, {.duration = b}});
      const std::vector<double> first{1, 0}, second{0, 1};
      for (const double seconds : {1e-5, 1.0 / 30, 0.7, 20.0, 1e6}) {
        const double way = seconds * std::log(b / a) / (b - a);
        // A rounding of the phase in the slow clip is multiplied when the fast one has taken over.
        const double error = std::max(1e-12, 1e-16 * std::max(a / b, b / a)) * std::max(1.0, way);
        CAPTURE(a);
        CAPTURE(b);
        CAPTURE(seconds);
        CHECK(near(sync.advanced(0, seconds, first, second), way, error));
        CHECK(near(sync.advanced(0.3, seconds, second, first) - 0.3, way, error));
        CHECK(near(sync.advanced(0.3, -seconds, first, second) - 0.3, -way, error));
      }
    }
}

TEST_CASE("a fade between clips with markers is what a fine integration of the running phase gives") {
  // Strides of 20 ms and of 12 s, uneven ones.
  const MarkerSync sync({{.duration = 0.03, .markers = {{0.0, "left"}, {0.02, "right"}}},
                         {.duration = 20, .markers = {{1, "right"}, {13, "left"}}},
                         {.duration = 1}});
  const std::vector<double> from{1, 0, 0.3}, to{0, 2, 0.1};
  for (const double seconds : {1.0 / 30, 1.0, -1.0}) {
    // Runge-Kutta of order 4; markers, at which it would lose its order, are met by steps.
    double phase = 0.37, time = 0;
    const auto rate = [&](double at, double t) {
      std::vector<Sample<double>> weights;
      weights.reserve(3);
      for (std::size_t i = 0; i < 3; ++i) {
        const double a = from[i] / 1.3, b = to[i] / 2.1;
        weights.push_back({a + (b - a) * t / seconds, (b - a) / seconds, 0});
      }
      return sync.running(at, weights).rate;
    };
    const auto stepped = [&](double h) {
      const double a = rate(phase, time), b = rate(phase + h / 2 * a, time + h / 2),
                   c = rate(phase + h / 2 * b, time + h / 2), d = rate(phase + h * c, time + h);
      return phase + h / 6 * (a + 2 * b + 2 * c + d);
    };
    for (int left = 20'000; left > 0; --left) {
      const double h = (seconds - time) / left, next = stepped(h);
      if (std::floor(next) == std::floor(phase)) {
        phase = next;
        time += h;
        continue;
      }
      double before = 0, after = 1;
      for (int i = 0; i < 60; ++i) {
        const double middle = (before + after) / 2;
        (std::floor(stepped(middle * h)) == std::floor(phase) ? before : after) = middle;
      }
      const double met = seconds > 0 ? after : before;
      phase = seconds > 0 ? std::floor(stepped(met * h)) : std::nextafter(std::floor(phase), -1e9);
      time += met * h;
      ++left;
    }
    CAPTURE(seconds);
    CHECK(near(sync.advanced(0.37, seconds, from, to), phase, 1e-9));
    // In one step it is the same as in many.
    double many = 0.37;
    const auto share = [&](double u) {
      std::vector<double> weights;
      weights.reserve(3);
      for (std::size_t i = 0; i < 3; ++i) weights.push_back(from[i] / 1.3 * (1 - u) + to[i] / 2.1 * u);
      return weights;
    };
    for (int k = 0; k < 144; ++k) many = sync.advanced(many, seconds / 144, share(k / 144.0), share((k + 1) / 144.0));
    CHECK(near(sync.advanced(0.37, seconds, from, to), many, 1e-11));
  }
}

TEST_CASE("under steady weights each step is what a fine integration gives, and a step back undoes it") {
  // Of strides so uneven that the pace of the phase changes fivefold between two steps.
  const MarkerSync sync({{.duration = 1, .markers = {{0.14, "left"}, {0.96, "right"}}},
                         {.duration = 0.55, .markers = {{0.04, "left"}, {0.14, "right"}}}});
  const std::vector<double> weights{0.89, 0.32};
  for (const double seconds : {0.384, 0.385, 0.386, 0.39, -0.2, 0.8})
    CHECK(near(sync.advanced(0, seconds, weights), finely_advanced(sync, 0, seconds, weights, weights), 1e-10));
  int lost = 0;
  for (int step = 0; step < 20'000; ++step) {
    const double phase = step * 1e-4, seconds = 0.385 - step * 3e-5;
    lost += !near(sync.advanced(sync.advanced(phase, seconds, weights), -seconds, weights), phase, 1e-13);
  }
  CHECK(lost == 0);
}

TEST_CASE("a fade of many strides is what a fine integration gives") {
  const MarkerSync sync({{.duration = 0.17, .markers = {{0.02, "b"}, {0.089, "a"}, {0.135, "b"}, {0.164, "a"}}},
                         {.duration = 0.31, .markers = {{0.13, "b"}, {0.286, "a"}}},
                         {.duration = 1.24, .markers = {{0.006, "a"}, {0.435, "b"}}}});
  const std::vector<double> from{0.905, 0.144, 0.037}, to{0.912, 0.97, 0.082};
  for (const double phase : {0.0, 3.2010355750481163})
    for (const double seconds : {7.910457380127097, -7.9, 0.5, 0.01})
      CHECK(near(sync.advanced(phase, seconds, from, to), finely_advanced(sync, phase, seconds, from, to), 1e-11));
  Random random(1);
  const MarkerSync pair(
      {{.duration = 1, .markers = {{0.1, "a"}, {0.6, "b"}}}, {.duration = 1.3, .markers = {{0.2, "a"}, {0.9, "b"}}}});
  for (int i = 0; i < 40; ++i) {
    const std::vector<double> first{random.between(0, 1), random.between(0, 1)},
        last{random.between(0, 1), random.between(0, 1)};
    const double phase = random.between(0, 2), seconds = random.between(-3, 3);
    CHECK(near(pair.advanced(phase, seconds, first, last), finely_advanced(pair, phase, seconds, first, last), 1e-11));
  }
}

TEST_CASE("clips without markers are played in shares of their loops") {
  const MarkerSync sync({{.duration = 2}, {.duration = 3}});
  CHECK(sync.period() == 1);
  CHECK(sync.phase_at(1, 1.5) == 0.5);
  CHECK(near(sync.phase_at(1, 7.5), 0.5, 1e-15));
  const std::vector<double> even{1, 1};
  CHECK(near(sync.advanced(0, 1, even), 0.4, 1e-15));
  CHECK(sync.time(0, {0.25, 0.4, 0}).time.rate == 0.8);
  CHECK(sync.time(1, {2.5, 0.4, 0}).cycle == 2);
  const std::vector<double> none{0, -1};
  CHECK(near(sync.advanced(0, 1, none), 0.4, 1e-15));
}

TEST_CASE("markers are a clip's events of the names asked for") {
  Clip clip{.name = "walk", .duration = 1.5};
  clip.events = {{0.2, 0.2, "foot left", ""}, {0.5, 0.6, "sound", ""}, {0.9, 1.0, "foot right", ""}};
  const SyncClip made = sync_clip(clip, "foot *");
  REQUIRE(made.markers.size() == 2);
  CHECK(made.duration == 1.5);
  CHECK(made.markers[1].time == 0.9);
  CHECK(made.markers[1].name == "foot right");
}

TEST_CASE("all that keeps clips from being played in phase is listed") {
  CHECK_THROWS_WITH_AS(MarkerSync({}), "clips cannot be played in phase:\n  there are no clips", std::invalid_argument);
  CHECK_THROWS_WITH_AS(MarkerSync({{.duration = 1, .markers = {{0.1, "left"}, {0.6, "right"}}},
                                   {.duration = 0},
                                   {.duration = 1, .markers = {{0.1, "left"}, {1.2, "right"}}},
                                   {.duration = 1, .markers = {{0, "left"}, {1, "right"}}},
                                   {.duration = 1, .markers = {{0.2, "left"}, {0.3, "left"}, {0.4, "right"}}}}),
                       "clips cannot be played in phase:\n"
                       "  the duration of clip 1 must be finite and above 0 s; it is 0\n"
                       "  the marker \"right\" of clip 2 must lie within its 1 s; it is at 1.2\n"
                       "  the markers \"left\" and \"right\" of clip 3 are both at 0 s\n"
                       "  the markers of clip 4 (\"left\", \"left\", \"right\") are not in the same order as those of "
                       "clip 0 (\"left\", \"right\")",
                       std::invalid_argument);
}

TEST_CASE("playing clips in phase asks for no memory, and takes any phase and time") {
  const MarkerSync sync(gaits());
  const std::vector<double> weights{0.4, 0.3, 0.2, 0.1}, others{0, 1, 0, 2};
  const std::vector<Sample<double>> samples(4, {0.2, 0.1, 0});
  const std::size_t before = allocations();
  double sum = 0;
  for (const double phase : {-1e9, -3.0, 0.0, 3.999999999999999, 1e9, 1e15}) {
    sum += sync.advanced(phase, 0.1, weights, others) - phase + sync.running(phase, samples).rate;
    for (std::size_t i = 0; i < 4; ++i) {
      const SyncedTime at = sync.time(i, {phase, 1, 0});
      sum += at.time.value + at.time.rate;
      if (!(at.time.value >= 0 && at.time.value < 4)) sum = -1e9;
    }
  }
  CHECK(sum > 0);
  CHECK(std::isfinite(sum));
  CHECK(allocations() == before);
}
