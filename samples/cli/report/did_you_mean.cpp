#include "report/did_you_mean.h"

#include <tweenfall/curves/nearest_name.h>

#include <algorithm>

namespace tweenfall::cli {

std::string did_you_mean(std::string_view typed, std::span<const std::string> names) {
  const std::string nearest = nearest_name(typed, names);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

namespace {

std::string joined_by(std::span<const std::string> names, const std::string& last) {
  constexpr std::size_t most = 12;
  const std::size_t shown = std::min(names.size(), most);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == names.size() ? last : ", ";
    text += names[i];
  }
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

}  // namespace

std::string listed(std::span<const std::string> names) {
  return joined_by(names, " and ");
}

std::string one_of(std::span<const std::string> names) {
  return joined_by(names, " or ");
}

}  // namespace tweenfall::cli
