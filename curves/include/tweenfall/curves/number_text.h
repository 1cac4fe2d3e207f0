#pragma once

/// Numbers as text and back: the shortest digits that read back to the same bits for files, fixed decimals for
/// pictures, a few digits for people. The same text everywhere, whatever the locale.

#include <tweenfall/curves/values.h>

#include <optional>
#include <string>
#include <string_view>

namespace tweenfall {

/// Shortest text that reads back to the same double; "-0" keeps its sign. What is not finite, which no file of ours
/// holds, is "inf", "-inf" or "nan".
[[nodiscard]] std::string number_text(double number);

/// Rounded to `decimals` places, trailing zeros and the point dropped; never "-0". Finite numbers only.
/// @param decimals  0 to 17
[[nodiscard]] std::string short_text(double number, int decimals);

/// For tables: at most five significant digits, "0" for what is below 1e-12, "endless" and "-endless" for infinities.
[[nodiscard]] std::string brief_text(double number);
[[nodiscard]] std::string brief_text(const Vec3& vector);  ///< "0 1.5 0"

/// As `number_text`, to the end of `out`.
void append_number(std::string& out, double number);
/// "[x,y,z]"
void append_vector(std::string& out, const Vec3& vector);
/// "[x,y,z,w]"
void append_rotation(std::string& out, const Quat& rotation);

/// The whole text as a number: digits with point and exponent, a sign before them. Empty when it is anything else, has
/// anything after it, or is not finite.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace tweenfall
