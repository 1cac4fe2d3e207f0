#pragma once

// Functions in place of keys.

#include "document/grammar/grammar_parts.h"

#include <string>
#include <vector>

namespace tweenfall::document {

// What a track may have instead of keys.
struct TrackFunctions {
  std::vector<Field> endless{};  // these have no "before" and "after"
  std::vector<Field> passing{};  // these begin at 0 s and end
  bool parameters = false;       // whether an expression is among them
};

// Splines through values of one kind, or with these as control points.
[[nodiscard]] std::vector<Field> spline_fields(FormStore& store, const ValueForms& values, const Form* value,
                                               const std::string& kind);

// The same for rotations.
[[nodiscard]] std::vector<Field> rotation_spline_fields(FormStore& store, const ValueForms& values);

class FunctionForms {
 public:
  FunctionForms(FormStore& store, const ValueForms& values);

  // For numbers of a unit; angles can follow a pendulum.
  [[nodiscard]] TrackFunctions of_numbers(const std::string& unit, bool angles) const;
  [[nodiscard]] TrackFunctions of_places(const std::string& unit) const;  // for positions: curves in space
  [[nodiscard]] TrackFunctions of_scales() const;
  [[nodiscard]] TrackFunctions of_vectors(std::size_t size) const;  // 2 or 4 numbers
  [[nodiscard]] const Form* parameters() const { return parameters_; }

  // How many numbers the values of a track's function have.
  [[nodiscard]] static std::size_t dimension(const json::Value& track);
  [[nodiscard]] static const std::vector<std::string>& names();

 private:
  [[nodiscard]] Field oscillator(const Form* value, const std::string& unit) const;
  [[nodiscard]] Field spring(const Form* value, const std::string& unit) const;
  [[nodiscard]] Field expression(const Form* form) const;

  FormStore& store_;
  const ValueForms& values_;
  const Form *text_, *expressions_2_, *expressions_3_, *expressions_4_;
  const Form *projectile_, *pendulum_, *orbit_, *path_, *line_, *arc_, *parameters_;
};

}  // namespace tweenfall::document
