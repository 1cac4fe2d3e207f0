#include "document/report/suggestion.h"

#include <tweenfall/curves/nearest_name.h>

#include "json/json_tree.h"

#include <algorithm>

namespace tweenfall::document {

std::string suggestion(std::string_view wrong, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(wrong, names);
  if (!nearest.empty()) return "; did you mean " + in_quotes(nearest) + "?";
  if (names.empty()) return {};
  constexpr std::size_t most = 24;
  std::string out = "; available: ";
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) out += (i ? ", " : "") + in_quotes(names[i]);
  if (names.size() > most) out += " and " + std::to_string(names.size() - most) + " more";
  return out;
}

}  // namespace tweenfall::document
