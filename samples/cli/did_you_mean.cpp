#include "nearest_name.h"

#include <algorithm>
#include <vector>

namespace tweenfall::cli {

namespace {

/// Insertions, deletions, replacements and swaps of neighbors that turn `a` into `b`.
/// Source: Damerau, A technique for computer detection and correction of spelling errors, 1964 (restricted form).
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> names) {
  std::optional<std::string> nearest;
  std::size_t fewest = std::max<std::size_t>(1, typed.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t count = edits(typed, name);
    if (count >= fewest) continue;
    fewest = count;
    nearest = name;
  }
  if (nearest || typed.empty()) return nearest;
  for (const std::string& name : names)
    if (typed.size() > 1 && name.starts_with(typed)) return name;
  return nearest;
}

std::string did_you_mean(std::string_view typed, std::span<const std::string> names) {
  const std::optional<std::string> nearest = nearest_name(typed, names);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

std::string listed(std::span<const std::string> names) {
  constexpr std::size_t most = 12;
  const std::size_t shown = std::min(names.size(), most);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

}  // namespace tweenfall::cli
