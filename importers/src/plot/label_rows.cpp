#include "plot/label_rows.h"

#include <algorithm>

namespace tweenfall::plotting {

namespace {

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

double text_width(const std::string& text) {
  return 6.2 * static_cast<double>(letters(text));
}

std::string shortened(const std::string& text, double width) {
  if (text_width(text) <= width) return text;
  std::string out = text;
  while (!out.empty() && text_width(out) > width - 6.2) {
    while ((static_cast<unsigned char>(out.back()) & 0xc0) == 0x80) out.pop_back();
    out.pop_back();
  }
  return out + "\xe2\x80\xa6";
}

std::optional<LabelRows::Place> LabelRows::place(double x, const std::string& text, const IsTaken& is_taken) {
  constexpr double gap = 4;
  const double width = text_width(text);
  double from = x + gap;
  if (from + width > right_) from = std::max(left_, x - gap - width);
  const auto lies_over_labels = [&](const auto& row) {
    return std::any_of(row.begin(), row.end(), [&](const auto& other) {
      return from < other.second + gap && other.first < from + width + gap;
    });
  };
  std::size_t chosen = rows_.size();
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (lies_over_labels(rows_[row])) continue;
    if (chosen == rows_.size()) chosen = row;
    if (is_taken && is_taken(from, from + width, row)) continue;
    chosen = row;
    break;
  }
  if (chosen == rows_.size()) return std::nullopt;
  rows_[chosen].emplace_back(from, from + width);
  return Place{from, chosen};
}

}  // namespace tweenfall::plotting
