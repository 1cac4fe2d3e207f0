#include "recording/base64.h"

#include <bit>

namespace tweenfall::recordings {

static_assert(std::endian::native == std::endian::little, "pages hold little-endian numbers");

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (j < count ? std::to_integer<std::uint32_t>(bytes[i + j]) : 0);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? letters[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

std::string base64(std::span<const float> numbers) {
  return base64(std::as_bytes(numbers));
}
std::string base64(std::span<const double> numbers) {
  return base64(std::as_bytes(numbers));
}
std::string base64(std::span<const std::uint32_t> numbers) {
  return base64(std::as_bytes(numbers));
}

}  // namespace tweenfall::recordings
