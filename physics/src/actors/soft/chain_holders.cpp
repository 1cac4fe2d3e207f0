// The nodes are eliminated first; what is left of the holders is a small dense matrix, the Schur complement.
// Source: Golub, Van Loan, Matrix Computations, 4th edition, 2013, 3.2.11.

#include "actors/soft/chain_holders.h"

#include <algorithm>

namespace tweenfall::soft {

namespace {

double product_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

}  // namespace

std::size_t ChainAndHolders::place_of(std::uint32_t partner) const {
  return static_cast<std::size_t>(std::ranges::find(holders_, partner) - holders_.begin());
}

bool ChainAndHolders::solves(std::size_t number) const {
  return number < nodes_ ||
         std::ranges::find(holders_, static_cast<std::uint32_t>((number - nodes_) / 2)) != holders_.end();
}

void ChainAndHolders::add_to_border(std::size_t first, const Lever& of_first, const Mat3& block, std::size_t second,
                                    const Lever& of_second, bool both) {
  const Mat3 parts[2][2] = {
      {of_first.linear.transpose() * block * of_second.linear, of_first.linear.transpose() * block * of_second.angular},
      {of_first.angular.transpose() * block * of_second.linear,
       of_first.angular.transpose() * block * of_second.angular}};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const std::size_t row = 2 * first + i, column = 2 * second + j;
      // The same node twice: the other half is this one's mirror image.
      if (!both && row < column) continue;
      border_.add(row, column, both && row == column ? Mat3(parts[i][j] + parts[i][j].transpose()) : parts[i][j]);
    }
}

bool ChainAndHolders::factor(std::span<const Held> held, const std::vector<Mat3>& blocks, std::size_t nodes) {
  nodes_ = nodes;
  holders_.clear();
  for (const Held& pin : held)
    if (pin.partner != Held::nobody && place_of(pin.partner) == holders_.size()) holders_.push_back(pin.partner);
  if (holders_.size() > most_holders) holders_.clear();
  const std::size_t directions = 6 * holders_.size();
  joined_.assign(directions, std::vector<Vec3>(nodes, Vec3(0, 0, 0)));
  if (!holders_.empty()) border_.clear(2 * holders_.size());
  for (std::size_t p = 0; p < holders_.size(); ++p)
    for (std::size_t i = 0; i < 2; ++i) border_.add(2 * p + i, 2 * p + i, blocks[nodes + 2 * holders_[p] + i]);
  std::vector<std::size_t> pins(nodes, held.size());
  for (std::size_t k = 0; k < held.size(); ++k) pins[held[k].node] = k;
  const auto lever_of = [](const Held& pin) {
    Mat3 turned;
    turned << 0, pin.arm.z(), -pin.arm.y(), -pin.arm.z(), 0, pin.arm.x(), pin.arm.y(), -pin.arm.x(), 0;
    return Lever{Mat3::Identity(), turned};
  };
  if (!holders_.empty())
    for (const Held& pin : held) {
      if (pin.partner == Held::nobody) continue;
      const std::size_t holder = place_of(pin.partner), node = pin.node;
      const Lever lever = lever_of(pin);
      for (const std::size_t other : chain_.nodes_near(node)) {
        const Mat3 block = chain_.block(other, node);
        if (pins[other] == held.size()) {
          const Mat3 linear = block * lever.linear, angular = block * lever.angular;
          for (Eigen::Index c = 0; c < 3; ++c) {
            joined_[6 * holder + static_cast<std::size_t>(c)][other] += linear.col(c);
            joined_[6 * holder + 3 + static_cast<std::size_t>(c)][other] += angular.col(c);
          }
        } else if (const Held& neighbor = held[pins[other]]; neighbor.partner != Held::nobody && other <= node) {
          add_to_border(place_of(neighbor.partner), lever_of(neighbor), block, holder, lever, other != node);
        }
      }
    }
  for (const Held& pin : held) chain_.fix(pin.node);
  if (!chain_.factor()) return false;
  if (holders_.empty()) return true;
  led_ = joined_;
  for (std::vector<Vec3>& way : led_) chain_.solve(way);
  for (std::size_t i = 0; i < directions / 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      Mat3 given;
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          given(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
              product_of(joined_[3 * i + r], led_[3 * j + c]);
      border_.add(i, j, -given);
    }
  if (!border_.factor()) holders_.clear();
  return true;
}

void ChainAndHolders::solve(std::vector<Vec3>& values) const {
  std::vector<Vec3> nodes(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(nodes_));
  if (!holders_.empty()) {
    std::vector<Vec3> rest;
    for (std::size_t p = 0; p < holders_.size(); ++p)
      for (std::size_t i = 0; i < 2; ++i) {
        Vec3 left = values[nodes_ + 2 * holders_[p] + i];
        for (std::size_t c = 0; c < 3; ++c)
          left[static_cast<Eigen::Index>(c)] -= product_of(led_[6 * p + 3 * i + c], nodes);
        rest.push_back(left);
      }
    border_.solve(rest);
    chain_.solve(nodes);
    for (std::size_t k = 0; k < led_.size(); ++k)
      for (std::size_t i = 0; i < nodes_; ++i) nodes[i] -= rest[k / 3][static_cast<Eigen::Index>(k % 3)] * led_[k][i];
    for (std::size_t p = 0; p < holders_.size(); ++p)
      for (std::size_t i = 0; i < 2; ++i) values[nodes_ + 2 * holders_[p] + i] = rest[2 * p + i];
  } else {
    chain_.solve(nodes);
  }
  std::ranges::copy(nodes, values.begin());
}

}  // namespace tweenfall::soft
