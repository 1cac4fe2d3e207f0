#include <tweenfall/anim/blend_space.h>

#include "curves/counted_allocations.h"
#include "support.h"

#include <vector>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::vector<Sample<double>> bands_at(const BlendBands& bands, const Sample<Vec2>& at, Side side = Side::out) {
  std::vector<Sample<double>> weights(bands.places().size());
  bands.weights(at, weights, side);
  return weights;
}

std::vector<Vec2> scattered(std::uint64_t seed, std::size_t count, double size = 1) {
  Random random(seed);
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.between(-size, size), y = random.between(-size, size);
    places.emplace_back(x, y);
  }
  return places;
}

}  // namespace

TEST_CASE("gradient bands by hand: between two entries, and at the middle of a square and of its sides") {
  const BlendBands two({{0, 0}, {2, 0}});
  CHECK(bands_at(two, {{0.5, 7}, {0, 0}, {0, 0}})[0].value == 0.75);
  CHECK(bands_at(two, {{0.5, 7}, {1, 3}, {0, 0}})[1].rate == 0.5);
  CHECK(bands_at(two, {{-3, 1}, {0, 0}, {0, 0}})[0].value == 1);
  const BlendBands square({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const Sample<double>& weight : bands_at(square, {{0.5, 0.5}, {0, 0}, {0, 0}})) CHECK(weight.value == 0.25);
  // At (1/4, 1/2) the influences are 1/2 left and 1/4 right, where the band along the diagonal is not the least.
  const auto weights = bands_at(square, {{0.25, 0.5}, {0, 0}, {0, 0}});
  CHECK(near(weights[0].value, 1.0 / 3, 1e-15));
  CHECK(near(weights[1].value, 1.0 / 6, 1e-15));
}

TEST_CASE("gradient bands are 1 at their places, sum to 1 anywhere, do not jump and go on by their rates") {
  for (const double size : {1e-120, 1., 1e6}) {
    const auto places = scattered(3, 14, size);
    const BlendBands bands(places);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const Vec2& rate : {Vec2(0, 0), Vec2(size, 0), Vec2(-0.3 * size, 0.7 * size)}) {
        const auto weights = bands_at(bands, {places[i], rate, {0, 0}});
        for (std::size_t k = 0; k < places.size(); ++k) CHECK(near(weights[k].value, k == i ? 1 : 0, 1e-15));
      }
    for (const double far : {0., 0.4, 3., 1e9, 1e150}) {
      double sum = 0;
      for (const Sample<double>& weight : bands_at(bands, {{far * size, -far * size}, {0, 0}, {0, 0}})) {
        CHECK(weight.value >= 0);
        sum += weight.value;
      }
      CHECK(near(sum, 1, 1e-14));
    }
  }
  const BlendBands bands(scattered(8, 20));
  Random random(2);
  for (int round = 0; round < 300; ++round) {
    const double x = random.between(-1.5, 1.5), y = random.between(-1.5, 1.5);
    const Vec2 at(x, y), rate = 0.5 * random.vector(1).head<2>(), bend = random.vector(1).head<2>();
    for (const Side side : {Side::out, Side::in}) {
      const double h = side == Side::out ? 1e-5 : -1e-5;
      const auto now = bands_at(bands, {at, rate, bend}, side);
      const auto next = bands_at(bands, {Vec2(at + h * rate + 0.5 * h * h * bend), Vec2(rate + h * bend), bend}, side);
      for (std::size_t i = 0; i < now.size(); ++i)
        CHECK(near(next[i].value, now[i].value + h * now[i].rate + 0.5 * h * h * now[i].acceleration, 1e-8));
    }
  }
}

TEST_CASE("gradient bands list what is wrong with their entries, and ask for no memory") {
  CHECK_THROWS_WITH(BlendBands({{1, 1}}), doctest::Contains("two entries or more; there is 1"));
  CHECK_THROWS_WITH(BlendBands({{1, 1}, {0, 0}, {1, 1}}), doctest::Contains("entries 0 and 2 are both at (1, 1)"));
  CHECK_THROWS_WITH(BlendBands({{1, 1}, {0, std::nan("")}}), doctest::Contains("must be finite"));
  const BlendBands line({{0, 0}, {1, 0}, {2, 0}});
  std::vector<Sample<double>> weights(3);
  const std::size_t before = allocations();
  line.weights({Vec2(0.5, 0), Vec2(0, 0), Vec2(0, 0)}, weights);
  CHECK(allocations() == before);
  CHECK(weights[1].value == 0.5);
  CHECK(weights[2].value == 0);
}
