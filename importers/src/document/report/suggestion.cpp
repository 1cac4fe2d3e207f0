#include "document/report/suggestion.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/nearest_name.h>

#include "document/report/foreign_words.h"
#include "json/json_tree.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 24;
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) out += (i ? ", " : "") + json::in_quotes(names[i]);
  if (names.size() > most) out += " and " + std::to_string(names.size() - most) + " more";
  return out;
}

std::string name_meant(std::string_view wrong, const std::vector<std::string>& names) {
  const std::string ours = word_of_ours(wrong, names);
  return ours.empty() ? nearest_name(wrong, names) : ours;
}

std::string property_meant(std::string_view track) {
  static const std::vector<std::string> ours{"position", "rotation", "scale", "color", "weights"};
  const std::size_t dot = property_dot(track);
  if (dot == std::string_view::npos) return {};
  const std::string_view property = track.substr(dot + 1);
  if (component_named(property)) return {};
  if (std::find(ours.begin(), ours.end(), property) != ours.end()) return {};
  std::string meant = property_of_ours(property);
  if (meant.empty() && said_of_property(property, {}).empty()) meant = nearest_name(property, ours);
  // A misspelled word of others; short ones are too near to anything.
  static const std::vector<std::string> long_words{"translation", "translate", "location", "orientation", "quaternion"};
  if (meant.empty() && property.size() > 6) meant = property_of_ours(nearest_name(property, long_words));
  return meant.empty() ? meant : std::string(track.substr(0, dot + 1)) + meant;
}

std::string component_meant(std::string_view track) {
  const std::size_t last = track.rfind('.');
  const std::size_t before = last == std::string_view::npos || last == 0 ? last : track.rfind('.', last - 1);
  if (before == std::string_view::npos || before == last) return {};
  static const std::vector<std::string> whole{"position", "rotation", "scale", "color"};
  const std::string_view word = track.substr(before + 1, last - before - 1), part = track.substr(last + 1);
  const bool ours = std::find(whole.begin(), whole.end(), word) != whole.end();
  const std::string meant = ours ? std::string(word) : name_meant(word, whole);
  if (meant.empty()) return {};
  const std::string small = small_letters(part);
  const std::string name = std::string(track.substr(0, before + 1)) + meant + "." + small;
  if (component_named(meant + "." + small)) return "; did you mean " + json::in_quotes(name) + "?";
  if (!ours) return {};
  return "; the components of a " + meant + " are " +
         (meant == "color" ? "\"r\", \"g\", \"b\" and \"a\"" : "\"x\", \"y\" and \"z\"");
}

namespace {

// The nearest pattern of all names below one, "box/*"; empty if none is near.
std::string pattern_meant(std::string_view wrong, const std::vector<std::string>& names) {
  std::vector<std::string> patterns;
  for (const std::string& name : names) {
    const std::size_t slash = name.rfind('/');
    if (slash == std::string::npos) continue;
    std::string pattern = name.substr(0, slash + 1) + "*";
    if (patterns.empty() || patterns.back() != pattern) patterns.push_back(std::move(pattern));
  }
  return nearest_name(wrong, patterns);
}

}  // namespace

std::string suggestion_or_import(std::string_view wrong, const std::vector<std::string>& names) {
  if (wrong.find('*') != std::string_view::npos)
    if (const std::string meant = pattern_meant(wrong, names); !meant.empty()) return suggestion_of(meant, names);
  const std::size_t slash = wrong.find('/');
  if (slash == std::string_view::npos) {
    // A name from an import, without the import's name.
    const auto bare = [&](const std::string& name) {
      const std::size_t last = name.rfind('/');
      return last != std::string::npos && std::string_view(name).substr(last + 1) == wrong;
    };
    const auto found = std::find_if(names.begin(), names.end(), bare);
    return found == names.end() ? suggestion(wrong, names) : suggestion_of(*found, names);
  }
  const std::string_view prefix = wrong.substr(0, slash + 1);
  const auto from_there = [&](const std::string& name) {
    return std::string_view(name).substr(0, slash + 1) == prefix;
  };
  if (slash == 0 || std::any_of(names.begin(), names.end(), from_there) || !nearest_name(wrong, names).empty())
    return suggestion(wrong, names);
  return "; names that begin with " + json::in_quotes(prefix) + " come in with \"import\": {" +
         json::in_quotes(wrong.substr(0, slash)) + ": \"FILE\"}";
}

std::string suggestion(std::string_view wrong, const std::vector<std::string>& names) {
  return suggestion_of(name_meant(wrong, names), names);
}

std::string suggestion_of(const std::string& meant, const std::vector<std::string>& names) {
  if (!meant.empty()) return "; did you mean " + json::in_quotes(meant) + "?";
  return names.empty() ? std::string() : "; available: " + listed(names);
}

}  // namespace tweenfall::document
