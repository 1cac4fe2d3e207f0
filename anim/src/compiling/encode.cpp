#include "compiling/encode.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "compiling/smooth_base.h"

namespace tweenfall::crowd {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A sequence of numbers as whole numbers of steps from an offset.
struct Grid {
  float offset = 0, step = 0;

  [[nodiscard]] int nearest(double number, int limit) const {
    if (step == 0) return 0;
    return static_cast<int>(std::clamp(std::round((number - offset) / step), -1.0 * limit, 1.0 * limit));
  }
  [[nodiscard]] double number(int steps) const {
    return static_cast<double>(offset) + static_cast<double>(step) * steps;
  }
};

struct Range {
  double low = infinite, high = -infinite;

  void add(double number) {
    low = std::min(low, number);
    high = std::max(high, number);
  }
  [[nodiscard]] double half() const { return 0.5 * (high - low); }
  [[nodiscard]] double middle() const { return low + half(); }
};

Grid grid_over(const Range& range, int limit) {
  Grid grid;
  grid.offset = static_cast<float>(range.middle());
  // Rounded up, so that the ends are not further off than the rest.
  const double reach = std::max(range.high - grid.offset, grid.offset - range.low);
  grid.step = static_cast<float>(reach / limit);
  if (static_cast<double>(grid.step) * limit < reach)
    grid.step = std::nextafter(grid.step, std::numeric_limits<float>::max());
  return grid;
}

/// What remains of a channel after a base of some stride.
class Based {
 public:
  Based(const Fitted& fitted, std::size_t stride) : fitted_(fitted), spline_(fitted.knots.size(), stride) {
    const std::size_t sequences = fitted.slots() * lane_count;
    coefficients_.resize(sequences * spline_.coefficients());
    for (std::size_t i = 0; i < sequences; ++i) spline_.fit(fitted.values.data() + i, sequences, coefficients(i));
  }

  [[nodiscard]] std::size_t rows() const { return spline_.coefficients(); }

  void round(Packing base) {
    const std::size_t sequences = fitted_.slots() * lane_count;
    const int limit = limit_of(base, components(fitted_.kind));
    rounded_.resize(coefficients_.size());
    grids_.assign(sequences, {});
    for (std::size_t i = 0; i < sequences; ++i) {
      Range range;
      for (std::size_t row = 0; row < rows(); ++row) range.add(coefficients(i)[row]);
      grids_[i] = grid_over(range, limit);
      for (std::size_t row = 0; row < rows(); ++row)
        rounded_[i * rows() + row] = grids_[i].nearest(coefficients(i)[row], limit);
    }
  }

  /// After `round`.
  [[nodiscard]] int rounded(std::size_t row, std::size_t sequence) const { return rounded_[sequence * rows() + row]; }
  [[nodiscard]] const Grid& grid(std::size_t sequence) const { return grids_[sequence]; }
  void residual(std::size_t sequence, std::vector<double>& out) const {
    std::vector<double> numbers(rows());
    for (std::size_t row = 0; row < rows(); ++row) numbers[row] = grids_[sequence].number(rounded(row, sequence));
    for (std::size_t knot = 0; knot < out.size(); ++knot)
      out[knot] = fitted_.values[knot * fitted_.slots() * lane_count + sequence] - spline_.at(knot, numbers.data());
  }

 private:
  [[nodiscard]] double* coefficients(std::size_t sequence) { return &coefficients_[sequence * rows()]; }

  const Fitted& fitted_;
  SmoothBase spline_;
  std::vector<double> coefficients_;
  std::vector<int> rounded_;
  std::vector<Grid> grids_;
};

/// Packs one integer of a lane into its word.
void pack(std::int32_t* row, const Field& field, std::size_t lane, int number) {
  const std::uint32_t mask = (1U << field.bits) - 1;
  std::int32_t& at = row[field.word * lane_count + lane];
  at = static_cast<std::int32_t>(static_cast<std::uint32_t>(at) |
                                 (static_cast<std::uint32_t>(number + field.bias()) & mask) << field.at);
}

/// The first word of a slot's value within a channel's row.
std::int32_t* slot_row(std::vector<std::int32_t>& words, std::size_t row, const Form& form, Packing packing,
                       std::size_t count, std::size_t slot) {
  const std::size_t part = words_of(packing, count) * lane_count;
  return words.data() + row * form.lines(packing, count) * lane_count + slot / count * part;
}

Encoded written(const Fitted& fitted, const Form& form, const Based* based) {
  const std::size_t count = components(fitted.kind), knots = fitted.knots.size();
  Encoded out;
  out.numbers.resize(form.slots(count) * form.numbers_per_slot() * lane_count);
  if (based) out.base.resize(based->rows() * form.lines(form.base, count) * lane_count);
  if (form.fine != Packing::none) out.fine.resize(knots * form.lines(form.fine, count) * lane_count);
  std::vector<double> left(knots);
  for (std::size_t slot = 0; slot < form.slots(count); ++slot)
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t sequence = slot * lane_count + lane, component = slot % count;
      const Field base_field = field_of(form.base, count, component),
                  fine_field = field_of(form.fine, count, component);
      if (based) {
        based->residual(sequence, left);
        for (std::size_t row = 0; row < based->rows(); ++row)
          pack(slot_row(out.base, row, form, form.base, count, slot), base_field, lane, based->rounded(row, sequence));
      } else {
        for (std::size_t knot = 0; knot < knots; ++knot) left[knot] = fitted.at(knot, slot, lane);
      }
      if (form.fine == Packing::exact) {
        for (std::size_t knot = 0; knot < knots; ++knot)
          slot_row(out.fine, knot, form, form.fine, count, slot)[component * lane_count + lane] =
              std::bit_cast<std::int32_t>(static_cast<float>(left[knot]));
        continue;
      }
      Range range;
      for (const double number : left) range.add(number);
      Grid grid{.offset = static_cast<float>(range.middle())};
      if (form.fine != Packing::none) {
        const int limit = limit_of(form.fine, count);
        grid = grid_over(range, limit);
        for (std::size_t knot = 0; knot < knots; ++knot)
          pack(slot_row(out.fine, knot, form, form.fine, count, slot), fine_field, lane,
               grid.nearest(left[knot], limit));
      } else if (based) {
        grid.offset = 0;
      }
      float* numbers = out.numbers.data() + slot * form.numbers_per_slot() * lane_count + lane;
      double offset = grid.offset;
      if (based) offset += based->grid(sequence).number(-base_field.bias());
      if (form.fine != Packing::none) offset -= static_cast<double>(grid.step) * fine_field.bias();
      *numbers = static_cast<float>(offset);
      if (based) *(numbers += lane_count) = static_cast<float>(based->grid(sequence).step / base_field.factor());
      if (form.fine != Packing::none) *(numbers += lane_count) = static_cast<float>(grid.step / fine_field.factor());
    }
  return out;
}

}  // namespace

Survey::Survey(const Fitted& fitted) : fitted_(&fitted) {
  const std::size_t sequences = fitted.slots() * lane_count, knots = fitted.knots.size();
  std::vector<double> numbers(knots);
  const auto extent = [&] {
    Range range;
    for (const double number : numbers) range.add(number);
    return Extent{range.half(), std::max(range.high, -range.low)};
  };
  for (std::size_t i = 0; i < sequences; ++i) {
    for (std::size_t knot = 0; knot < knots; ++knot) numbers[knot] = fitted.values[knot * sequences + i];
    whole_.push_back(extent());
  }
  for (const std::uint32_t stride : {2, 4, 8, 16, 32}) {
    if (stride + 1 > knots) break;
    Based based(fitted, stride);
    for (const Packing base : {Packing::narrow, Packing::wide}) {
      based.round(base);
      Rest& rest = rests_.emplace_back(Rest{stride, base, {}});
      rest.left.reserve(sequences);
      for (std::size_t i = 0; i < sequences; ++i) {
        based.residual(i, numbers);
        rest.left.push_back(extent());
      }
    }
  }
}

std::vector<Way> Survey::ways(const Steps& steps, double line_for_row) const {
  const std::size_t count = components(fitted_->kind), knots = fitted_->knots.size();
  const auto all_within = [&](const Extents& extents, const auto& within) {
    for (std::size_t i = 0; i < extents.size(); ++i)
      if (!within(extents[i], steps[i / lane_count][i % lane_count], i / lane_count)) return false;
    return true;
  };
  const auto told_by = [&](const Extents& extents, Packing packing) {
    const int limit = limit_of(packing, count);
    return all_within(extents,
                      [&](const Extent& extent, double step, std::size_t) { return extent.half <= limit * step; });
  };
  const bool constant = all_within(whole_, [&](const Extent& extent, double step, std::size_t slot) {
    return (slot < count ? extent.half : extent.most) <= 0.5 * step;
  });
  if (knots < 2 || constant) return {{Form{}, static_cast<double>(count)}};
  std::vector<Way> all;
  const auto add = [&](const Form& form) {
    const std::size_t lines = form.base_rows(knots) * form.lines(form.base, count) +
                              knots * form.lines(form.fine, count) + form.slots(count) * form.numbers_per_slot();
    const std::size_t rows = (form.base != Packing::none ? 4 : 0) + (form.fine != Packing::none ? 2 : 0);
    const double time = line_for_row * static_cast<double>(knots * rows * form.slots(count));
    all.push_back({form, static_cast<double>(lines) + time});
  };
  const bool cubic = fitted_->cubic;
  add({.cubic = cubic, .fine = Packing::exact});
  for (const Packing fine : {Packing::narrow, Packing::wide})
    if (told_by(whole_, fine)) add({.cubic = cubic, .fine = fine});
  for (const Rest& rest : rests_) {
    if (told_by(rest.left, Packing::narrow))
      add({.cubic = cubic, .base = rest.base, .fine = Packing::narrow, .stride = rest.stride});
    if (all_within(rest.left, [](const Extent& extent, double step, std::size_t) { return extent.most <= 0.5 * step; }))
      add({.cubic = cubic, .base = rest.base, .fine = Packing::none, .stride = rest.stride});
  }
  return all;
}

Encoded encoded(const Fitted& fitted, const Form& form) {
  if (form.base != Packing::none) {
    Based based(fitted, form.stride);
    based.round(form.base);
    return written(fitted, form, &based);
  }
  if (form.fine != Packing::none || !fitted.cubic) return written(fitted, form, nullptr);
  // A constant has no rates.
  Fitted still{.kind = fitted.kind, .knots = fitted.knots};
  for (std::size_t knot = 0; knot < fitted.knots.size(); ++knot)
    for (std::size_t slot = 0; slot < components(fitted.kind); ++slot)
      for (std::size_t lane = 0; lane < lane_count; ++lane) still.values.push_back(fitted.at(knot, slot, lane));
  return written(still, form, nullptr);
}

}  // namespace tweenfall::crowd
