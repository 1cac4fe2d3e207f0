#pragma once

/// Numbers as text and back: the shortest digits that read back to the same bits for files, fixed decimals for
/// pictures, a few digits for people. The same text everywhere, whatever the locale.

#include <tweenfall/curves/values.h>

#include <optional>
#include <string>
#include <string_view>

namespace tweenfall {

/// Shortest text that reads back to the same double; "-0" keeps its sign. Numbers that are not finite, which none of
/// our files hold, become "inf", "-inf" or "nan".
[[nodiscard]] std::string number_text(double number);

/// Rounded to `decimals` places, trailing zeros and the point dropped; never "-0". Finite numbers only.
/// @param decimals  0 to 17
[[nodiscard]] std::string short_text(double number, int decimals);

/// For tables: at most five significant digits, "0" for sizes below 1e-12, "endless" and "-endless" for infinities.
[[nodiscard]] std::string brief_text(double number);
[[nodiscard]] std::string brief_text(const Vec3& vector);  ///< "0 1.5 0"

/// Appends `number_text` of the number to `out`.
void append_number(std::string& out, double number);
/// "[x,y,z]"
void append_vector(std::string& out, const Vec3& vector);
/// "[x,y,z,w]"
void append_rotation(std::string& out, const Quat& rotation);

/// The whole text as a number: an optional sign, then digits with point and exponent. Empty when the text is anything
/// else, goes on after the number, or is not finite.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace tweenfall
