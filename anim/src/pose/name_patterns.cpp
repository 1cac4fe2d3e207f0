#include "pose/name_patterns.h"

#include <algorithm>
#include <vector>

namespace tweenfall::pose {

std::size_t stars_in(std::string_view pattern) noexcept {
  return static_cast<std::size_t>(std::ranges::count(pattern, '*'));
}

std::optional<std::string> renamed(std::string_view name, std::string_view from, std::string_view to) {
  if (stars_in(from) != stars_in(to)) return std::nullopt;
  std::string result;
  // Up to the next star each pattern has its own text; the star stands for everything up to the text after it.
  const auto piece = [](std::string_view& pattern) {
    const std::size_t star = pattern.find('*');
    const std::string_view text = pattern.substr(0, star);
    pattern.remove_prefix(star == std::string_view::npos ? pattern.size() : star + 1);
    return text;
  };
  std::size_t left = stars_in(from);
  const std::string_view start = piece(from);
  if (!name.starts_with(start)) return std::nullopt;
  name.remove_prefix(start.size());
  result += piece(to);
  for (; left > 0; --left) {
    const std::string_view text = piece(from);
    std::size_t found = name.find(text);
    if (left == 1) found = name.ends_with(text) ? name.size() - text.size() : std::string_view::npos;
    if (found == std::string_view::npos) return std::nullopt;
    result += name.substr(0, found);
    result += piece(to);
    name.remove_prefix(found + text.size());
  }
  if (!name.empty()) return std::nullopt;
  return result;
}

}  // namespace tweenfall::pose
