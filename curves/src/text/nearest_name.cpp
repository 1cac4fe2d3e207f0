#include <tweenfall/curves/nearest_name.h>

#include <algorithm>
#include <vector>

namespace tweenfall {

namespace words {
namespace {

constexpr std::size_t longest_compared = 64;  // longer names are not misspelled words
constexpr std::size_t most_compared = 5000;   // bounds the cost of a hostile file

bool alike(char a, char b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  const auto plain = [&](char c) { return c == '-' || c == ' ' ? '_' : lower(c); };
  return plain(a) == plain(b);
}

bool goes_on(std::string_view name, std::string_view start) {
  return name.size() > start.size() && std::equal(start.begin(), start.end(), name.begin(), alike);
}

}  // namespace
}  // namespace words

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = words::alike(a[i - 1], b[j - 1]) ? 0 : 1;
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + change});
      if (i > 1 && j > 1 && words::alike(a[i - 1], b[j - 2]) && words::alike(a[i - 2], b[j - 1]))
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row[b.size()];
}

std::string nearest_name(std::string_view wrong, std::span<const std::string> names) {
  if (wrong.size() > words::longest_compared) return {};
  names = names.first(std::min(names.size(), words::most_compared));
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, wrong.size() / 3) + 1;
  for (const std::string& name : names) {
    if (name.size() > words::longest_compared) continue;
    const std::size_t edits = edit_distance(wrong, name);
    // A name that has nothing in common with `wrong` is not near, however short it is.
    if (edits >= fewest || edits >= std::max(wrong.size(), name.size())) continue;
    fewest = edits;
    best = name;
  }
  if (!best.empty() || wrong.size() < 2) return best;
  for (const std::string& name : names)
    if (name.size() <= words::longest_compared && words::goes_on(name, wrong)) return name;
  return best;
}

}  // namespace tweenfall
