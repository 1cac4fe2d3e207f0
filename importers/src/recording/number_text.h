#pragma once

// Numbers as text: the shortest digits that read back to the same bits, and fixed decimals for pictures.

#include <tweenfall/curves/values.h>

#include <string>

namespace tweenfall {

/// Shortest text that reads back to the same double; minus zero is "-0.0". Finite numbers only.
[[nodiscard]] std::string number_text(double number);

/// Rounded to `decimals` places, trailing zeros and the point dropped; never "-0".
[[nodiscard]] std::string short_text(double number, int decimals);

void append_number(std::string& out, double number);
/// "[x,y,z]"
void append_vector(std::string& out, const Vec3& vector);
/// "[x,y,z,w]"
void append_rotation(std::string& out, const Quat& rotation);
/// A JSON string with its quotes. `<` is escaped too, so that the text may stand inside an HTML script element.
void append_json_string(std::string& out, const std::string& text);

}  // namespace tweenfall
