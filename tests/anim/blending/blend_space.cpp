#include <tweenfall/anim/blend_space.h>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::vector<Vec2> random_places(std::uint64_t seed, std::size_t count, double size = 1) {
  Random random(seed);
  std::vector<Vec2> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.between(-size, size), y = random.between(-size, size);
    places.emplace_back(x, y);
  }
  return places;
}

std::vector<Vec2> grid_places(int side) {
  std::vector<Vec2> places;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) places.emplace_back(0.1 * x, 3 * y);
  return places;
}

// A parameter that moves along a parabola.
Sample<Vec2> parabola(std::uint64_t seed, double t, double size = 1.3) {
  Random random(seed);
  const double x = random.between(-size, size), y = random.between(-size, size);
  const double dx = random.between(-1, 1), dy = random.between(-1, 1);
  const double ddx = random.between(-1, 1), ddy = random.between(-1, 1);
  return {Vec2(x, y) + t * Vec2(dx, dy) + (0.5 * t * t) * Vec2(ddx, ddy), Vec2(dx, dy) + t * Vec2(ddx, ddy),
          Vec2(ddx, ddy)};
}

template <class Space, class Parameter>
std::vector<Sample<double>> weights_of(const Space& space, const Parameter& at, Side side = Side::out) {
  std::vector<Sample<double>> weights(space.places().size());
  space.weights(at, weights, side);
  return weights;
}

Vec2 place_of(const BlendPlane& plane, const std::vector<Sample<double>>& weights) {
  Vec2 place(0, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) place += weights[i].value * plane.places()[i];
  return place;
}

double double_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// The nearest point of the hull, from the segments between any two places.
Vec2 nearest_by_pairs(std::span<const Vec2> places, const Vec2& p) {
  Vec2 best = places[0];
  for (const Vec2& a : places)
    for (const Vec2& b : places) {
      const Vec2 along = b - a;
      const double u = along.squaredNorm() > 0 ? std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0) : 0;
      const Vec2 on = a + u * along;
      if ((on - p).squaredNorm() < (best - p).squaredNorm()) best = on;
    }
  return best;
}

bool in_some_triangle(const BlendPlane& plane, const Vec2& p) {
  const auto place = [&](std::size_t i) { return plane.places()[i]; };
  return std::ranges::any_of(plane.triangles(), [&](const auto& t) {
    return double_area(place(t[0]), place(t[1]), p) >= 0 && double_area(place(t[1]), place(t[2]), p) >= 0 &&
           double_area(place(t[2]), place(t[0]), p) >= 0;
  });
}

}  // namespace

TEST_CASE("neighbors on a blend line share the weight evenly, and the ends keep it") {
  const BlendLine line({4, -1, 1});
  const auto weights = weights_of(line, Sample<double>{2.5, 0.6, -0.3});
  CHECK(weights[0].value == 0.5);
  CHECK(weights[2].value == 0.5);
  CHECK(weights[1].value == 0);
  CHECK(near(weights[0].rate, 0.2, 1e-15));
  CHECK(near(weights[2].rate, -0.2, 1e-15));
  CHECK(near(weights[0].acceleration, -0.1, 1e-15));
  for (const double beyond : {-1.5, -1e300}) CHECK(weights_of(line, Sample<double>{beyond, 1, 1})[1].value == 1);
  for (const double beyond : {4.0001, 1e300}) {
    const auto last = weights_of(line, Sample<double>{beyond, 1, 1});
    CHECK(last[0].value == 1);
    CHECK(last[0].rate == 0);
  }
}

TEST_CASE("at a place of a blend line its weight is 1, and the rates are those of the side asked for") {
  const BlendLine line({0, 1, 3});
  for (const double rate : {2.0, -2.0})
    for (const Side side : {Side::in, Side::out}) {
      const auto weights = weights_of(line, Sample<double>{1, rate, 0}, side);
      CHECK(weights[0].value == 0);
      CHECK(weights[1].value == 1);
      CHECK(weights[2].value == 0);
      const bool upper = (rate > 0) == (side == Side::out);
      CHECK(weights[0].rate == (upper ? 0 : -rate));
      CHECK(weights[2].rate == (upper ? rate / 2 : 0));
    }
  const auto turning = weights_of(line, Sample<double>{1, 0, -4});
  CHECK(turning[0].acceleration == 4);
  CHECK(turning[2].acceleration == 0);
  CHECK(weights_of(line, Sample<double>{0, -1, 0})[0].rate == 0);
  CHECK(weights_of(line, Sample<double>{0, -1, 0}, Side::in)[0].rate == 1);
}

TEST_CASE("a blend line and a blend plane list all that is wrong with their entries") {
  CHECK_THROWS_WITH_AS(BlendLine({1}),
                       "a blend line cannot be made of its entries:\n  it needs two entries or more; there is 1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(BlendLine({1, 2, 1, 2, 3}),
                       "a blend line cannot be made of its entries:\n  entries 0 and 2 are both at 1\n"
                       "  entries 1 and 3 are both at 2",
                       std::invalid_argument);
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(BlendLine({infinity, 0}),
                       "a blend line cannot be made of its entries:\n  the place of entry 0 must be finite; it is inf",
                       std::invalid_argument);
  CHECK_THROWS_AS(BlendLine({-1.7e308, 1.7e308}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(BlendPlane({}),
                       "a blend plane cannot be made of its entries:\n  it needs three entries or more; there are 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(BlendPlane({{1, 1}, {1, 1}}),
                       "a blend plane cannot be made of its entries:\n  it needs three entries or more; there are 2\n"
                       "  entries 0 and 1 are both at (1, 1)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      BlendPlane({{0, 0}, {1, 2}, {2, 4}, {3, 6}}),
      "a blend plane cannot be made of its entries:\n  all its entries lie on one line, from (0, 0) to "
      "(3, 6); use a blend line for these",
      std::invalid_argument);
  CHECK_THROWS_WITH_AS(BlendPlane({{0, 0}, {infinity, 2}, {2, 4}}),
                       "a blend plane cannot be made of its entries:\n  the place of entry 1 must be finite; it is "
                       "(inf, 2)",
                       std::invalid_argument);
}

TEST_CASE("no entry of a blend plane lies inside the circle of a triangle, and the triangles cover the hull once") {
  for (const std::size_t count : {3, 4, 5, 8, 20, 60})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      CAPTURE(count);
      CAPTURE(seed);
      const BlendPlane plane(random_places(seed + 100 * count, count));
      double area = 0;
      for (const auto& t : plane.triangles()) {
        const Vec2 a = plane.places()[t[0]], b = plane.places()[t[1]], c = plane.places()[t[2]];
        CHECK(double_area(a, b, c) > 0);
        area += double_area(a, b, c);
        // The circle's center is as far from all three corners.
        const Vec2 u = b - a, v = c - a;
        const Vec2 center =
            a + Vec2(v[1] * u.squaredNorm() - u[1] * v.squaredNorm(), u[0] * v.squaredNorm() - v[0] * u.squaredNorm()) /
                    (2 * double_area(a, b, c));
        for (const Vec2& p : plane.places()) CHECK((p - center).norm() >= (a - center).norm() * (1 - 1e-9));
      }
      // A border that turns the same way all around, with every entry on its inner side, is the hull's.
      double whole = 0;
      const auto border = plane.border();
      for (std::size_t i = 0; i < border.size(); ++i) {
        const Vec2 a = plane.places()[border[i]], b = plane.places()[border[(i + 1) % border.size()]];
        for (const Vec2& p : plane.places()) CHECK(double_area(a, b, p) >= -1e-12);
        whole += a[0] * b[1] - a[1] * b[0];
      }
      CHECK(near(area, whole, 1e-12));
      CHECK(plane.triangles().size() == 2 * count - 2 - border.size());
    }
}

TEST_CASE("weights of a blend plane lead to the parameter inside of it, and to the nearest point of its hull outside") {
  std::vector<std::vector<Vec2>> sets{grid_places(5), grid_places(2)};
  for (std::uint64_t seed = 0; seed < 10; ++seed) sets.push_back(random_places(seed, 3 + 2 * seed));
  for (const auto& places : sets) {
    const BlendPlane plane(places);
    Random random(9);
    for (int round = 0; round < 200; ++round) {
      const double x = random.between(-2, 2), y = random.between(-2, 14);
      const auto weights = weights_of(plane, Sample<Vec2>{{x, y}, {0.1, 0.2}, {0, 0}});
      double sum = 0, rates = 0;
      for (const Sample<double>& weight : weights) {
        CHECK(weight.value >= 0);
        CHECK(weight.value <= 1);
        sum += weight.value;
        rates += weight.rate;
      }
      CHECK(near(sum, 1, 1e-14));
      CHECK(std::abs(rates) < 1e-12);
      const Vec2 expected = in_some_triangle(plane, {x, y}) ? Vec2(x, y) : nearest_by_pairs(places, {x, y});
      CHECK(near(place_of(plane, weights), expected, 1e-12));
    }
  }
}

TEST_CASE("at the place of an entry its weight is 1 and the others are 0, exactly, whichever way the parameter moves") {
  for (const auto& places : {grid_places(5), random_places(3, 30), random_places(4, 12, 1e6)}) {
    const BlendPlane plane(places);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const Vec2& rate : {Vec2(0, 0), Vec2(1, 0), Vec2(-0.3, 0.7), Vec2(0.2, -1)}) {
        const auto weights = weights_of(plane, Sample<Vec2>{places[i], rate, {0, 0}});
        for (std::size_t k = 0; k < places.size(); ++k) CHECK(weights[k].value == (k == i ? 1 : 0));
      }
  }
}

TEST_CASE("weights go on by their rates and accelerations, inside and outside of the hull") {
  const BlendPlane plane(random_places(5, 15));
  int checked = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const double h = 1e-4;
    const auto before = weights_of(plane, parabola(seed, -h)), now = weights_of(plane, parabola(seed, 0)),
               after = weights_of(plane, parabola(seed, h));
    // Within one triangle or stretch the weights are parabolas too.
    bool same = true;
    for (std::size_t i = 0; i < now.size(); ++i)
      same &= (before[i].value == 0) == (now[i].value == 0) && (after[i].value == 0) == (now[i].value == 0);
    if (!same) continue;
    ++checked;
    for (std::size_t i = 0; i < now.size(); ++i) {
      CHECK(near(after[i].value - before[i].value, 2 * h * now[i].rate, 1e-14));
      CHECK(near(after[i].value + before[i].value - 2 * now[i].value, h * h * now[i].acceleration, 1e-14));
    }
  }
  CHECK(checked > 250);
}

TEST_CASE("on a border between triangles, and on the hull, each side has its own rates and both the same weights") {
  const BlendPlane plane({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  Random random(12);
  for (int round = 0; round < 100; ++round) {
    // Points of the two diagonals and of the hull, whichever of the diagonals is an edge.
    const double u = 0.25 * static_cast<double>(1 + round % 7);
    const Vec2 points[]{{u, u}, {u, 2 - u}, {u, 0}, {2, u}, {0, u}, {u, 2}, {2, 2}, {0, 0}};
    const Vec2 at = points[round % 8];
    const double dx = random.between(-1, 1), dy = random.between(-1, 1);
    for (const Side side : {Side::in, Side::out}) {
      const double h = side == Side::out ? 0x1p-10 : -0x1p-10;
      const auto now = weights_of(plane, Sample<Vec2>{at, {dx, dy}, {0, 0}}, side);
      const auto beside = weights_of(plane, Sample<Vec2>{at + h * Vec2(dx, dy), {dx, dy}, {0, 0}});
      for (std::size_t i = 0; i < now.size(); ++i) CHECK(near(beside[i].value, now[i].value + h * now[i].rate, 1e-14));
    }
    const auto out = weights_of(plane, Sample<Vec2>{at, {dx, dy}, {0, 0}}, Side::out),
               in = weights_of(plane, Sample<Vec2>{at, {dx, dy}, {0, 0}}, Side::in);
    for (std::size_t i = 0; i < out.size(); ++i) CHECK(near(out[i].value, in[i].value, 1e-15));
  }
}

TEST_CASE("from an entry toward another one, on any grid, rates are those of the side to which the parameter moves") {
  Random random(21);
  std::size_t planes = 0;
  const auto check = [](const auto& space) {
    constexpr double h = 1e-6;
    for (const Vec2& here : space.places())
      for (const Vec2& there : space.places())
        for (const Side side : {Side::in, Side::out}) {
          const Sample<Vec2> at{here, there - here, {0, 0}};
          const double ahead = side == Side::out ? h : -h;
          const auto now = weights_of(space, at, side);
          const auto beside = weights_of(space, Sample<Vec2>{here + ahead * at.rate, at.rate, {0, 0}}, side);
          for (std::size_t i = 0; i < now.size(); ++i)
            CHECK(near(beside[i].value, now[i].value + ahead * now[i].rate, 1e-10));
        }
  };
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec2> places;
    while (places.size() < static_cast<std::size_t>(4 + round % 3)) {
      const Vec2 place(std::floor(random.between(0, 4)), std::floor(random.between(0, 4)));
      if (std::ranges::find(places, place) == places.end()) places.push_back(place);
    }
    check(BlendBands(places));
    try {
      check(BlendPlane(places));
      ++planes;
    } catch (const std::invalid_argument&) {
      // All on one line, or an entry between two others.
    }
  }
  CHECK(planes > 100);
}

TEST_CASE("weights of a blend plane do not jump anywhere along a way through it") {
  const BlendPlane plane(random_places(8, 25));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const double x = random.between(-2, 2), y = random.between(-2, 2);
    const double to_x = random.between(-2, 2), to_y = random.between(-2, 2);
    std::vector<Sample<double>> before;
    for (int step = 0; step <= 20000; ++step) {
      const double u = step / 20000.0;
      const auto now = weights_of(plane, Sample<Vec2>{{x + u * (to_x - x), y + u * (to_y - y)}, {0, 0}, {0, 0}});
      double jump = 0;
      for (std::size_t i = 0; i < before.size(); ++i) jump = std::max(jump, std::abs(now[i].value - before[i].value));
      if (!(jump < 0.02)) CHECK(jump < 0.02);  // thin triangles make steep weights
      before = now;
    }
  }
}

TEST_CASE("blend spaces of any size and place give weights, and ask for no memory") {
  for (const double size : {1e-120, 1e-6, 1e6, 1e120}) {
    const auto places = random_places(6, 10, size);
    const BlendPlane plane(places);
    CHECK(plane.triangles().size() == BlendPlane(random_places(6, 10)).triangles().size());
    std::vector<Sample<double>> weights(places.size());
    const std::size_t before = allocations();
    for (const double far : {0.0, 0.3, 1.0, 1e9, 1e150}) {
      plane.weights({Vec2(far * size, -far * size), Vec2(0, 0), Vec2(0, 0)}, weights);
      double sum = 0;
      for (const Sample<double>& weight : weights) sum += weight.value;
      if (!near(sum, 1, 1e-14)) CHECK(sum == 1);
    }
    CHECK(allocations() == before);
  }
  // A thousand in a row beside one, and a hundred by a hundred.
  std::vector<Vec2> fan{{0, 1}};
  for (int i = 0; i < 1000; ++i) fan.emplace_back(0.01 * i, 0);
  CHECK(BlendPlane(fan).triangles().size() == 999);
  CHECK(BlendPlane(grid_places(40)).triangles().size() == 2 * 39 * 39);
}
