#include "document/report/units.h"

#include "document/report/foreign_words.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace tweenfall::document {

namespace {

struct Spelling {
  std::string_view told;  // in the help of a field
  std::string_view unit;
};

// Longer ones before those that they begin with.
constexpr std::array<Spelling, 31> spellings = {{
    {"kg m^2/s", "kg m^2/s"},
    {"kg m^2", "kg m^2"},
    {"kg/m^3", "kg/m^3"},
    {"kg/m^2", "kg/m^2"},
    {"kg/m", "kg/m"},
    {"kg", "kg"},
    {"m^3/s^2", "m^3/s^2"},
    {"m/s^2", "m/s^2"},
    {"m/s", "m/s"},
    {"m per second", "m/s"},
    {"meters", "m"},
    {"m", "m"},
    {"N m^2", "N m^2"},
    {"N m", "N m"},
    {"N s/m", "N s/m"},
    {"N s", "N s"},
    {"N/m", "N/m"},
    {"N", "N"},
    {"Pa s", "Pa s"},
    {"Pa", "Pa"},
    {"J", "J"},
    {"1/s", "1/s"},
    {"degrees/s", "degrees/s"},
    {"degrees per second", "degrees/s"},
    {"degrees", "degrees"},
    {"radians", "radians"},
    {"cycles per second", "Hz"},
    {"pull, in cycles per second", "Hz"},
    {"Hz", "Hz"},
    {"seconds", "s"},
    {"s", "s"},
}};

struct Measure {
  std::string_view given;  // small letters without spaces
  std::string_view unit;
  double factor;
};

// Source: The International System of Units, 9th edition, and NIST Special Publication 811, appendix B.
constexpr double degrees_per_radian = 57.29577951308232;
constexpr std::array<Measure, 77> measures = {{
    {"cm", "m", 0.01},
    {"mm", "m", 0.001},
    {"km", "m", 1000},
    {"meter", "m", 1},
    {"meters", "m", 1},
    {"metre", "m", 1},
    {"metres", "m", 1},
    {"ft", "m", 0.3048},
    {"foot", "m", 0.3048},
    {"feet", "m", 0.3048},
    {"in", "m", 0.0254},
    {"inch", "m", 0.0254},
    {"inches", "m", 0.0254},
    {"yd", "m", 0.9144},
    {"g", "kg", 0.001},
    {"t", "kg", 1000},
    {"lb", "kg", 0.45359237},
    {"lbs", "kg", 0.45359237},
    {"ms", "s", 0.001},
    {"us", "s", 0.000001},
    {"sec", "s", 1},
    {"secs", "s", 1},
    {"second", "s", 1},
    {"seconds", "s", 1},
    {"min", "s", 60},
    {"h", "s", 3600},
    {"deg", "degrees", 1},
    {"degs", "degrees", 1},
    {"degree", "degrees", 1},
    {"rad", "degrees", degrees_per_radian},
    {"radian", "degrees", degrees_per_radian},
    {"radians", "degrees", degrees_per_radian},
    {"grad", "degrees", 0.9},
    {"turn", "degrees", 360},
    {"turns", "degrees", 360},
    {"rev", "degrees", 360},
    {"revs", "degrees", 360},
    {"rad", "radians", 1},
    {"radian", "radians", 1},
    {"deg", "radians", 1 / degrees_per_radian},
    {"degrees", "radians", 1 / degrees_per_radian},
    {"newton", "N", 1},
    {"newtons", "N", 1},
    {"kn", "N", 1000},
    {"lbf", "N", 4.4482216152605},
    {"knm", "N m", 1000},
    {"khz", "Hz", 1000},
    {"rpm", "Hz", 1 / 60.0},
    {"hertz", "Hz", 1},
    {"1/s", "Hz", 1},
    {"km/h", "m/s", 1 / 3.6},
    {"kmh", "m/s", 1 / 3.6},
    {"kph", "m/s", 1 / 3.6},
    {"mps", "m/s", 1},
    {"mph", "m/s", 0.44704},
    {"cm/s", "m/s", 0.01},
    {"mm/s", "m/s", 0.001},
    {"km/s", "m/s", 1000},
    {"ft/s", "m/s", 0.3048},
    {"m/s2", "m/s^2", 1},
    {"g", "m/s^2", 9.80665},
    {"cm/s^2", "m/s^2", 0.01},
    {"ft/s^2", "m/s^2", 0.3048},
    {"deg/s", "degrees/s", 1},
    {"degree/s", "degrees/s", 1},
    {"rad/s", "degrees/s", degrees_per_radian},
    {"turn/s", "degrees/s", 360},
    {"turns/s", "degrees/s", 360},
    {"rev/s", "degrees/s", 360},
    {"rps", "degrees/s", 360},
    {"rpm", "degrees/s", 6},
    {"kg/m3", "kg/m^3", 1},
    {"g/cm^3", "kg/m^3", 1000},
    {"g/cm3", "kg/m^3", 1000},
    {"kpa", "Pa", 1000},
    {"gpa", "Pa", 1e9},
    {"n/mm", "N/m", 1000},
}};

bool begins_with_word(std::string_view text, std::string_view word) {
  return text.starts_with(word) && (text.size() == word.size() || text[word.size()] == ' ' ||
                                    text[word.size()] == ',' || text[word.size()] == ';' || text[word.size()] == ':');
}

std::string_view unit_at(std::string_view text) {
  for (const auto& [told, unit] : spellings)
    if (begins_with_word(text, told)) return unit;
  return {};
}

// In small letters without spaces, "m/s²" as "m/s^2", "45°" as "45deg"
std::string plain(std::string_view unit) {
  std::string out;
  for (const char c : small_letters(unit))
    if (c != ' ' && c != '*') out += c;
  for (const auto& [from, to] :
       {std::pair("\u00b2", "^2"), std::pair("\u00b3", "^3"), std::pair("\u00b7", ""), std::pair("\u00b0", "deg")})
    for (std::size_t at = 0; (at = out.find(from)) != std::string::npos;)
      out.replace(at, std::string_view(from).size(), to);
  return out;
}

}  // namespace

std::string_view unit_told(std::string_view help, std::string_view what) {
  // A unit stands at the start of the help, or after a comma.
  for (std::size_t at = 0; at < help.size();) {
    if (const std::string_view unit = unit_at(help.substr(at)); !unit.empty()) return unit;
    at = help.find_first_of(",;", at);
    if (at == std::string_view::npos) break;
    at = std::min(help.find_first_not_of(' ', at + 1), help.size());
  }
  for (std::size_t at = 0; at < what.size();) {
    for (const std::string_view word : {"degrees per second", "degrees", "Hz", "seconds", "meters", "kg"})
      if (begins_with_word(what.substr(at), word)) return unit_at(what.substr(at));
    at = what.find(' ', at);
    if (at == std::string_view::npos) break;
    ++at;
  }
  return {};
}

std::optional<double> factor_to(std::string_view unit, std::string_view given) {
  if (unit.empty()) return {};
  const std::string name = plain(given);
  if (name == plain(unit)) return 1;
  for (const Measure& measure : measures)
    if (measure.unit == unit && measure.given == name) return measure.factor;
  return {};
}

}  // namespace tweenfall::document
