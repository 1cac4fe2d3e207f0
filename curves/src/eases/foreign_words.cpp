#include <algorithm>

#include "eases/ease_row.h"

namespace tweenfall {
namespace eases {
namespace {

struct ForeignWord {
  std::string_view theirs;  // only lower case letters and digits
  std::string_view ours;
};

// Names of whole eases. Source: the manuals of Blender 4 (F-curves and their handles), Maya 2024 (tangents), After
// Effects, glTF 2.0, three.js, jQuery, d3, and R. Penner's classes, in which even the linear ease has directions.
constexpr ForeignWord words[] = {{"constant", "hold"},
                                 {"stepped", "hold"},
                                 {"step", "hold"},
                                 {"discrete", "hold"},
                                 {"stepnext", "step-next"},
                                 {"lerp", "linear"},
                                 {"none", "linear"},
                                 {"easenone", "linear"},
                                 {"easelinear", "linear"},
                                 {"interpolatelinear", "linear"},
                                 {"interpolatediscrete", "hold"},
                                 {"interpolatesmooth", "smooth"},
                                 {"lineareasenone", "linear"},
                                 {"lineareasein", "linear"},
                                 {"lineareaseout", "linear"},
                                 {"lineareaseinout", "linear"},
                                 {"noneeasenone", "linear"},
                                 {"vector", "linear"},
                                 {"easyease", "ease-in-out"},
                                 {"auto", "smooth-clamped"},
                                 {"autoclamped", "smooth-clamped"},
                                 {"bezier", "smooth-clamped"},
                                 {"plateau", "smooth-clamped"},
                                 {"spline", "smooth"},
                                 {"fixed", "smooth"},
                                 {"cubicspline", "smooth"},
                                 {"flat", "ease-in-out"},
                                 {"slow", "ease-in-out"},
                                 {"fast", "linear"},
                                 {"smoothstep", "ease-in-out"},
                                 {"swing", "sine-in-out"},
                                 {"pchip", "monotone"},
                                 {"c2", "natural"}};

// Other names of families; and our names, where one without a direction means the out form (Blender's "dynamic
// effects").
constexpr ForeignWord families_elsewhere[] = {
    {"quadratic", "quad"}, {"cube", "cubic"},      {"quartic", "quart"},    {"quintic", "quint"},
    {"sin", "sine"},       {"sinusoidal", "sine"}, {"exponential", "expo"}, {"exp", "expo"},
    {"circle", "circ"},    {"circular", "circ"},   {"power1", "quad"},      {"power2", "cubic"},
    {"power3", "quart"},   {"power4", "quint"},    {"regular", "quad"},     {"strong", "quint"}};
constexpr std::string_view outward[] = {"back", "bounce", "elastic"};

std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c >= 'A' && c <= 'Z') result += static_cast<char>(c + 32);
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) result += c;
  }
  return result;
}

std::string_view family_named(std::string_view theirs) {
  for (const FamilyRow* family : families())
    if (plain(family->word) == theirs) return family->word;
  for (const ForeignWord& word : families_elsewhere)
    if (word.theirs == theirs) return word.ours;
  return {};
}

// "easeInQuad", "quadInOut", "InOutCubic", "Sine.easeOut", "TWEEN.Easing.Sine.Out", "BACK".
std::string of_family(std::string key) {
  for (const std::string_view before : {"tween", "easing"})
    if (key.starts_with(before)) key.erase(0, before.size());
  if (const std::size_t ease = key.find("ease"); ease != std::string::npos) key.erase(ease, 4);
  constexpr ForeignWord ways[] = {{"inout", "-in-out"}, {"in", "-in"}, {"out", "-out"}};
  for (const ForeignWord& flow : ways) {
    const std::size_t size = flow.theirs.size();
    std::string_view family;
    if (key.starts_with(flow.theirs)) family = family_named(std::string_view(key).substr(size));
    if (family.empty() && key.ends_with(flow.theirs))
      family = family_named(std::string_view(key).substr(0, key.size() - size));
    if (!family.empty()) return std::string(family) + std::string(flow.ours);
  }
  const std::string_view family = family_named(key);
  if (family.empty()) return {};
  const bool is_outward = std::find(std::begin(outward), std::end(outward), family) != std::end(outward);
  return std::string(family) + (is_outward ? "-out" : "-in");
}

}  // namespace
}  // namespace eases

std::string Ease::ours(std::string_view foreign) {
  const std::string_view text = eases::trimmed(foreign), word = text.substr(0, text.find('('));
  const std::string_view call = text.substr(word.size());
  const std::string key = eases::plain(word);
  if (key.empty() || key.size() > 40) return {};
  // Our own names in another spelling, "easeIn" and "catmullRom".
  for (const std::string& name : names()) {
    const std::string own = name.substr(0, name.find('('));
    if (eases::plain(own) != key || call.empty() != (own.size() == name.size())) continue;
    return own == word ? std::string() : own + std::string(call);
  }
  if (!call.empty()) {
    const std::string family = eases::of_family(key);
    const auto takes_numbers = [&](const std::string& name) { return name.starts_with(family + "("); };
    return !family.empty() && std::ranges::any_of(names(), takes_numbers) ? family + std::string(call) : std::string();
  }
  for (const eases::ForeignWord& row : eases::words)
    if (row.theirs == key) return std::string(row.ours);
  return eases::of_family(key);
}

}  // namespace tweenfall
