#pragma once

// The elements of an FBX file, text or binary: records with a name, values and nested records.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tweenfall::fbx {

using Integers = std::vector<std::int64_t>;
using Reals = std::vector<double>;
using Value = std::variant<std::int64_t, double, std::string, Integers, Reals>;

struct Record {
  std::string name;
  std::size_t at = 0;  ///< the byte where it begins
  std::vector<Value> values;
  std::vector<Record> children;

  /// The first child of that name, or null.
  [[nodiscard]] const Record* find(std::string_view child) const;

  /// Value `index` as the requested type; `otherwise` where it is absent or of another kind.
  [[nodiscard]] std::int64_t whole(std::size_t index, std::int64_t otherwise) const;
  [[nodiscard]] double number(std::size_t index, double otherwise) const;
  [[nodiscard]] std::string_view text(std::size_t index) const;

  /// All numbers of the record, stored as one array or as single values.
  [[nodiscard]] Reals reals() const;
  [[nodiscard]] Integers integers() const;
  /// The numbers of the child of that name; none where there is no such child.
  [[nodiscard]] Reals reals(std::string_view child) const;
  [[nodiscard]] Integers integers(std::string_view child) const;
};

/// Greatest nesting depth of records; real files stay below ten.
inline constexpr std::size_t deepest = 64;

/// A real as an integer, clamped to the range of integers.
[[nodiscard]] std::int64_t whole_of(double value) noexcept;

}  // namespace tweenfall::fbx
