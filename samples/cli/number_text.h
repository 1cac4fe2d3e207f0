#pragma once

/// Numbers as text: for tools, to read back to the same bits; for people, short.

#include <tweenfall/curves/values.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tweenfall::cli {

/// The shortest text that reads back to the same bits; "null" when not finite, as JSON has nothing else.
[[nodiscard]] std::string exact(double number);

/// For tables: at most five significant digits, "0" for what is below 1e-12, "endless" for infinity.
[[nodiscard]] std::string brief(double number);
[[nodiscard]] std::string brief(const Vec3& vector);  ///< "0 1.5 0"

/// "1 problem", "2 problems".
[[nodiscard]] std::string counted(std::size_t count, std::string_view one, std::string_view many = {});

/// The whole text as a finite number, or nothing.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace tweenfall::cli
