#include "graph_picture/layers.h"

#include <algorithm>

namespace tweenfall::plotting {

namespace {

constexpr double lane_height = 15;  // px
constexpr int sweeps = 12;

}  // namespace

Layers::Layers(const std::vector<std::size_t>& columns, const std::vector<double>& heights, std::vector<Wire> wires)
    : wires_(std::move(wires)) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns_.size() <= columns[i]) columns_.resize(columns[i] + 1);
    columns_[columns[i]].push_back(i);
    cells_.push_back({.height = heights[i]});
  }
  const auto join = [&](std::size_t left, std::size_t right) {
    cells_[left].after.push_back(right);
    cells_[right].before.push_back(left);
  };
  for (const Wire& wire : wires_) {
    std::vector<std::size_t>& lanes = lanes_.emplace_back();
    std::size_t last = wire.from;
    for (std::size_t column = columns[wire.from] + 1; column < columns[wire.to]; ++column) {
      lanes.push_back(cells_.size());
      columns_[column].push_back(cells_.size());
      cells_.push_back({.height = lane_height});
      join(last, lanes.back());
      last = lanes.back();
    }
    join(last, wire.to);
  }
  for (std::vector<std::size_t>& column : columns_) stack(column, std::vector<double>(column.size(), 0));
  // Who belongs together comes together: from the right, where all ends, to the left and back. Source: Sugiyama, Tagawa
  // and Toda, "Methods for Visual Understanding of Hierarchical System Structures", 1981, barycenters.
  for (int sweep = 0; sweep < sweeps; ++sweep) put_in_order(sweep % 2 == 0 ? Beside::after : Beside::before);
  for (int sweep = 0; sweep < sweeps; ++sweep) put_near(sweep % 2 == 0 ? Beside::before : Beside::after);
  double top = 0;
  for (const Cell& cell : cells_) top = std::min(top, cell.middle - cell.height / 2);
  for (Cell& cell : cells_) {
    cell.middle -= top;
    height_ = std::max(height_, cell.middle + cell.height / 2);
  }
}

double Layers::wanted(std::size_t cell, Beside beside) const {
  const std::vector<std::size_t>& others = beside == Beside::before ? cells_[cell].before : cells_[cell].after;
  if (others.empty()) return cells_[cell].middle;
  double sum = 0;
  for (const std::size_t other : others) sum += cells_[other].middle;
  return sum / static_cast<double>(others.size());
}

void Layers::put_in_order(Beside beside) {
  const auto order = [&](std::vector<std::size_t>& column) {
    std::vector<std::pair<double, std::size_t>> places;
    places.reserve(column.size());
    for (const std::size_t cell : column) places.emplace_back(wanted(cell, beside), cell);
    std::ranges::stable_sort(places, {}, &std::pair<double, std::size_t>::first);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = places[i].second;
    stack(column, std::vector<double>(column.size(), 0));
  };
  if (beside == Beside::before)
    for (std::vector<std::size_t>& column : columns_) order(column);
  else
    std::for_each(columns_.rbegin(), columns_.rend(), order);
}

void Layers::put_near(Beside beside) {
  const auto move = [&](std::vector<std::size_t>& column) {
    std::vector<double> places;
    places.reserve(column.size());
    for (const std::size_t cell : column) places.push_back(wanted(cell, beside));
    stack(column, places);
  };
  if (beside == Beside::before)
    for (std::vector<std::size_t>& column : columns_) move(column);
  else
    std::for_each(columns_.rbegin(), columns_.rend(), move);
}

// Each as near to where it wants to be as those above and below it let it: those that push each other stand together,
// around the mean of what they want.
void Layers::stack(std::vector<std::size_t>& column, const std::vector<double>& wanted) {
  struct Block {
    double top, height, sum;
    std::size_t first, count;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const double height = cells_[column[i]].height;
    Block block{0, height, wanted[i] - height / 2, i, 1};
    block.top = block.sum;
    while (!blocks.empty() && blocks.back().top + blocks.back().height > block.top) {
      const Block& above = blocks.back();
      block = {0, above.height + block.height, above.sum + block.sum - static_cast<double>(block.count) * above.height,
               above.first, above.count + block.count};
      block.top = block.sum / static_cast<double>(block.count);
      blocks.pop_back();
    }
    blocks.push_back(block);
  }
  for (const Block& block : blocks) {
    double top = block.top;
    for (std::size_t i = block.first; i < block.first + block.count; ++i) {
      Cell& cell = cells_[column[i]];
      cell.middle = top + cell.height / 2;
      top += cell.height;
    }
  }
}

std::vector<double> Layers::lanes_of(std::size_t wire) const {
  std::vector<double> heights;
  for (const std::size_t lane : lanes_[wire]) heights.push_back(cells_[lane].middle);
  return heights;
}

std::vector<std::size_t> Layers::wires_to(std::size_t thing) const {
  std::vector<std::size_t> wires;
  for (std::size_t i = 0; i < wires_.size(); ++i)
    if (wires_[i].to == thing) wires.push_back(i);
  const auto height = [&](std::size_t wire) {
    return cells_[lanes_[wire].empty() ? wires_[wire].from : lanes_[wire].back()].middle;
  };
  std::ranges::stable_sort(wires, {}, height);
  return wires;
}

}  // namespace tweenfall::plotting
