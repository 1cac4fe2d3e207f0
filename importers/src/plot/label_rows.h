#pragma once

// Labels along a time line, each in the first row where it does not overlap another.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::plotting {

/// Approximate width of a text of size 10, px.
[[nodiscard]] double text_width(const std::string& text);

/// The text, or its beginning with "…", in no more than `width` px.
[[nodiscard]] std::string shortened(const std::string& text, double width);

class LabelRows {
 public:
  LabelRows(double left, double right, std::size_t rows) : left_(left), right_(right), rows_(rows) {}

  struct Place {
    double x;  ///< where the text begins, px
    std::size_t row;
  };
  /// Whether something else is in the way of a text between two places of a row.
  using IsTaken = std::function<bool(double from, double to, std::size_t row)>;
  /// Beside `x`, right of it where there is room, else left; in the first row where it lies over nothing, else in the
  /// first where it lies over no other label; nothing where it would in every row.
  [[nodiscard]] std::optional<Place> place(double x, const std::string& text, const IsTaken& is_taken = {});

 private:
  double left_, right_;
  std::vector<std::vector<std::pair<double, double>>> rows_;
};

}  // namespace tweenfall::plotting
