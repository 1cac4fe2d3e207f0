#include "mass/cubature.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::mass {

namespace {

constexpr std::size_t points = 7;
/// From 0 to 1; the second, fourth and sixth are Gauss's three.
constexpr std::array<double, points> nodes = {
    0.5 - 0.960491268708020283 / 2, 0.5 - 0.774596669241483377 / 2, 0.5 - 0.434243749346802558 / 2, 0.5,
    0.5 + 0.434243749346802558 / 2, 0.5 + 0.774596669241483377 / 2, 0.5 + 0.960491268708020283 / 2};
constexpr std::array<double, points> fine = {
    0.104656226026467265 / 2, 0.268488089868333441 / 2, 0.401397414775962223 / 2, 0.450916538658474142 / 2,
    0.401397414775962223 / 2, 0.268488089868333441 / 2, 0.104656226026467265 / 2};
constexpr std::array<double, points> coarse = {0, 5.0 / 18, 0, 8.0 / 18, 0, 5.0 / 18, 0};

/// A block of the unit cube, and the integrals over it.
struct Block {
  std::uint32_t piece = 0;
  std::array<double, 3> low{0, 0, 0}, size{1, 1, 1};
  Moments moments{}, errors{};
  double error = 0;         ///< of all moments as one number, kg
  std::uint8_t widest = 0;  ///< the direction with the greatest error
};

/// Compensated summation. Source: Kahan, "Further remarks on reducing truncation errors",
/// 1965.
struct ExactSum {
  double sum = 0, lost = 0;
  void add(double value) {
    const double next = value - lost, more = sum + next;
    lost = (more - sum) - next;
    sum = more;
  }
};

class Cutting {
 public:
  Cutting(const Pieces& pieces, const Vec3& from, double size, const std::function<double(const Vec3&)>& at)
      : pieces_(pieces), from_(from), at_(at) {
    const double square = size * size;
    shares_ = {1, 1 / size, 1 / size, 1 / size, 1 / square, 1 / square, 1 / square, 1 / square, 1 / square, 1 / square};
  }

  void measure(Block& block) {
    std::array<Moments, 3> without{};  // with the coarse rule in one direction
    block.moments = {};
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t j = 0; j < points; ++j)
        for (std::size_t k = 0; k < points; ++k) {
          const Image image =
              pieces_[block.piece](block.low[0] + block.size[0] * nodes[i], block.low[1] + block.size[1] * nodes[j],
                                   block.low[2] + block.size[2] * nodes[k]);
          const double dense = at_(image.place) * image.stretch * block.size[0] * block.size[1] * block.size[2];
          const Vec3 p = image.place - from_;
          const Moments terms = {1,
                                 p.x(),
                                 p.y(),
                                 p.z(),
                                 p.x() * p.x(),
                                 p.y() * p.y(),
                                 p.z() * p.z(),
                                 p.x() * p.y(),
                                 p.y() * p.z(),
                                 p.z() * p.x()};
          const double all = dense * fine[i] * fine[j] * fine[k];
          const std::array<double, 3> one = {dense * coarse[i] * fine[j] * fine[k],
                                             dense * fine[i] * coarse[j] * fine[k],
                                             dense * fine[i] * fine[j] * coarse[k]};
          for (std::size_t m = 0; m < terms.size(); ++m) {
            block.moments[m] += all * terms[m];
            for (std::size_t d = 0; d < 3; ++d) without[d][m] += one[d] * terms[m];
          }
        }
    evaluations += points * points * points;
    block.errors = {};
    block.error = 0;
    double most = -1;
    for (std::size_t d = 0; d < 3; ++d) {
      double of_direction = 0;
      for (std::size_t m = 0; m < block.moments.size(); ++m) {
        const double error = std::abs(block.moments[m] - without[d][m]);
        block.errors[m] += error;
        of_direction += shares_[m] * error;
      }
      block.error += of_direction;
      if (!(of_direction > most)) continue;
      most = of_direction;
      block.widest = static_cast<std::uint8_t>(d);
    }
  }

  std::size_t evaluations = 0;

 private:
  const Pieces& pieces_;
  Vec3 from_;
  const std::function<double(const Vec3&)>& at_;
  Moments shares_;
};

}  // namespace

Summed sum_up(const Pieces& pieces, const Vec3& from, double size, const std::function<double(const Vec3&)>& at,
              const Quadrature& quadrature) {
  Cutting cutting(pieces, from, size, at);
  std::vector<Block> blocks(pieces.size());
  ExactSum mass, error;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].piece = static_cast<std::uint32_t>(i);
    cutting.measure(blocks[i]);
    mass.add(blocks[i].moments[0]);
    error.add(blocks[i].error);
  }
  // The block with the greatest error on top; of equal ones the one that was made first.
  std::vector<std::size_t> order(blocks.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto errs_less = [&blocks](std::size_t a, std::size_t b) {
    return blocks[a].error != blocks[b].error ? blocks[a].error < blocks[b].error : a > b;
  };
  std::ranges::make_heap(order, errs_less);
  // Cutting does not reduce rounding: a block whose error is so small a share of the whole is left as it is.
  constexpr double rounding = 1e-16;
  while (!order.empty() && error.sum > quadrature.tolerance * std::abs(mass.sum) &&
         cutting.evaluations < quadrature.most_evaluations) {
    std::ranges::pop_heap(order, errs_less);
    const std::size_t here = order.back(), there = blocks.size();
    if (!(blocks[here].error > rounding * std::abs(mass.sum))) break;
    Block half = blocks[here];
    const Block whole = half;
    half.size[whole.widest] *= 0.5;
    blocks[here] = half;
    half.low[whole.widest] += half.size[whole.widest];
    cutting.measure(blocks[here]);
    cutting.measure(half);
    blocks.push_back(half);
    mass.add(blocks[here].moments[0] + half.moments[0] - whole.moments[0]);
    error.add(blocks[here].error + half.error - whole.error);
    std::ranges::push_heap(order, errs_less);
    order.push_back(there);
    std::ranges::push_heap(order, errs_less);
  }
  Summed all;
  for (std::size_t m = 0; m < all.moments.size(); ++m) {
    ExactSum moment, wrong;
    for (const Block& block : blocks) {
      moment.add(block.moments[m]);
      wrong.add(block.errors[m]);
    }
    all.moments[m] = moment.sum;
    all.errors[m] = wrong.sum;
  }
  all.evaluations = cutting.evaluations;
  return all;
}

}  // namespace tweenfall::mass
