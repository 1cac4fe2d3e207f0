#pragma once

// Things in columns, and wires that lead from one to another further right: each wire has a lane of its own through
// the columns that it skips.

#include <cstddef>
#include <vector>

namespace tweenfall::plotting {

class Layers {
 public:
  struct Wire {
    std::size_t from, to;  ///< things; `from` stands in a column further left
  };
  /// @param columns  of each thing
  /// @param heights  of each thing, px, with what is to be free around it
  Layers(const std::vector<std::size_t>& columns, const std::vector<double>& heights, std::vector<Wire> wires);

  [[nodiscard]] double height() const noexcept { return height_; }
  /// The middle of a thing, px from the top.
  [[nodiscard]] double middle_of(std::size_t thing) const { return cells_[thing].middle; }
  /// The heights of a wire's lanes, px from the top, from left to right: one for each column between its ends.
  [[nodiscard]] std::vector<double> lanes_of(std::size_t wire) const;
  /// The wires that come to a thing, from the top: in the order in which they arrive.
  [[nodiscard]] std::vector<std::size_t> wires_to(std::size_t thing) const;

 private:
  struct Cell {
    double height = 0, middle = 0;
    std::vector<std::size_t> before, after;  // cells in the columns beside it
  };
  enum class Beside { before, after };

  [[nodiscard]] double wanted(std::size_t cell, Beside beside) const;
  void put_in_order(Beside beside);
  void put_near(Beside beside);
  void stack(std::vector<std::size_t>& column, const std::vector<double>& wanted);

  std::vector<Cell> cells_;  // things, then lanes
  std::vector<std::vector<std::size_t>> columns_;
  std::vector<Wire> wires_;
  std::vector<std::vector<std::size_t>> lanes_;  // of each wire
  double height_ = 0;
};

}  // namespace tweenfall::plotting
