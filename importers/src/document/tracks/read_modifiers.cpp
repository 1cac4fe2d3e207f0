#include "document/tracks/read_modifiers.h"

#include <tweenfall/curves/modifiers.h>

#include "document/read/values.h"
#include "document/tracks/read_track.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

namespace tweenfall::document {
namespace {

using namespace tweenfall::modifiers;

std::optional<double> number_at(const json::Value& object, std::string_view name) {
  const json::Value value = usable(object, name);
  return value ? std::optional(value.number()) : std::nullopt;
}

std::vector<double> numbers_at(const json::Value& list) {
  std::vector<double> result;
  for (const json::Value& item : list.items()) result.push_back(item.number());
  return result;
}

Cycles::Mode mode_at(const json::Value& object, std::string_view name) {
  const std::string word = text_in(object, name, "repeat");
  return word == "none"            ? Cycles::Mode::none
         : word == "repeat-offset" ? Cycles::Mode::repeat_offset
         : word == "mirror"        ? Cycles::Mode::mirror
                                   : Cycles::Mode::repeat;
}

Cycles cycles(const json::Value& o) {
  return {mode_at(o, "before"), mode_at(o, "after"), static_cast<int>(number_in(o, "plays_before", 0)),
          static_cast<int>(number_in(o, "plays_after", 0))};
}

Noise noise(const json::Value& o) {
  const std::string mix = text_in(o, "mix", "add");
  return {.mix = mix == "replace"    ? Noise::Mix::replace
                 : mix == "multiply" ? Noise::Mix::multiply
                                     : Noise::Mix::add,
          .seed = static_cast<std::uint64_t>(number_in(o, "seed", 0)),
          .strength = number_in(o, "strength", 1),
          .scale = number_in(o, "scale", 1),
          .phase = number_in(o, "phase", 0),
          .layers = static_cast<int>(number_in(o, "layers", 1))};
}

Generator polynomial(const json::Value& o) {
  Generator result;
  if (const json::Value list = usable(o, "coefficients")) result.coefficients = numbers_at(list);
  result.additive = flag_in(o, "add", false);
  return result;
}

Generator factors(const json::Value& o) {
  Generator result{.coefficients = {}, .factorized = true, .additive = flag_in(o, "add", false)};
  if (const json::Value lines = usable(o, "lines"))
    for (const json::Value& line : lines.items())
      for (const double v : numbers_at(line)) result.coefficients.push_back(v);
  return result;
}

BuiltIn function(const json::Value& o) {
  static constexpr std::pair<std::string_view, BuiltIn::Function> words[] = {
      {"sin", BuiltIn::Function::sin},   {"cos", BuiltIn::Function::cos}, {"tan", BuiltIn::Function::tan},
      {"sqrt", BuiltIn::Function::sqrt}, {"ln", BuiltIn::Function::ln},   {"sinc", BuiltIn::Function::sinc}};
  BuiltIn result{.amplitude = number_in(o, "amplitude", 1),
                 .multiplier = number_in(o, "multiplier", 1),
                 .phase = number_in(o, "phase", 0),
                 .offset = number_in(o, "offset", 0),
                 .additive = flag_in(o, "add", false)};
  const std::string name = text_in(o, "name");
  for (const auto& [word, meant] : words)
    if (name == word) result.function = meant;
  return result;
}

Envelope envelope(const json::Value& o) {
  Envelope result{.reference = number_in(o, "reference", 0),
                  .low = number_in(o, "low", -1),
                  .high = number_in(o, "high", 1),
                  .points = {}};
  if (const json::Value points = usable(o, "points"))
    for (const json::Value& point : points.items())
      if (const std::optional<Vec3> p = vector_of(point)) result.points.push_back({p->x(), p->y(), p->z()});
  return result;
}

std::optional<modifiers::Kind> kind_of(const json::Value& modifier, Problems& problems) {
  if (const json::Value o = usable(modifier, "cycles")) return cycles(o);
  if (const json::Value o = usable(modifier, "noise")) return noise(o);
  if (const json::Value o = usable(modifier, "polynomial")) return polynomial(o);
  if (const json::Value o = usable(modifier, "factors")) return factors(o);
  if (const json::Value o = usable(modifier, "function")) return function(o);
  if (const json::Value o = usable(modifier, "stepped"))
    return Stepped{.step = number_in(o, "step", 1),
                   .offset = number_in(o, "offset", 0),
                   .start = number_at(o, "start"),
                   .end = number_at(o, "end")};
  if (const json::Value o = usable(modifier, "limits"))
    return modifiers::Limits{number_at(o, "low"), number_at(o, "high"), number_at(o, "start"), number_at(o, "end")};
  if (const json::Value o = usable(modifier, "envelope")) return envelope(o);
  if (const json::Value o = usable(modifier, "placement"))
    return Placement{number_in(o, "time_offset", 0), number_in(o, "time_scale", 1), number_in(o, "value_offset", 0),
                     number_in(o, "value_scale", 1)};
  if (const json::Value keys = usable(modifier, "warp"))
    if (const std::optional<Curve<double>> clock = read_plain_keys(keys, problems)) return TimeWarp{*clock};
  return {};
}

// The modifiers of `list`; `check` throws for an invalid one. Empty where one is faulty.
template <class Check>
std::optional<std::vector<Modifier>> modifiers_in(const json::Value& list, const Check& check, Problems& problems) {
  std::vector<Modifier> modifiers;
  for (const json::Value& item : list.items()) {
    std::optional<modifiers::Kind> kind = kind_of(item, problems);
    if (!kind) continue;
    Modifier modifier{std::move(*kind)};
    if (const json::Value range = usable(item, "range"))
      modifier.range = ModifierRange{number_in(range, "start", 0), number_in(range, "end", 0),
                                     number_in(range, "blend_in", 0), number_in(range, "blend_out", 0)};
    modifier.influence = number_in(item, "influence", 1);
    try {
      check(modifier);
    } catch (const std::invalid_argument& fault) {
      const std::string what = fault.what();
      problems.add(item, what.substr(what.find(": ") + 2));
      continue;
    }
    modifiers.push_back(std::move(modifier));
  }
  if (modifiers.size() != list.items().size()) return {};
  return modifiers;
}

}  // namespace

template <class T>
std::optional<Curve<T>> with_modifiers_of(const json::Value& track, const Curve<T>& curve, Problems& problems) {
  const json::Value said = usable(track, "modifiers");
  if (!said) return curve;
  if constexpr (std::is_same_v<T, double>) {
    const auto check = [&](const Modifier& one) { (void)modified(curve, std::span(&one, 1)); };
    const std::optional<std::vector<Modifier>> modifiers = modifiers_in(said, check, problems);
    return modifiers ? std::optional(modified(curve, *modifiers)) : std::nullopt;
  } else {
    using Lists = std::vector<std::vector<Modifier>>;
    constexpr std::size_t size = static_cast<std::size_t>(T::RowsAtCompileTime);
    Lists lists(size);
    bool faulty = false;
    const auto over = [&](const Lists& all) { return modified<T>(curve, std::span<const std::vector<Modifier>>(all)); };
    const auto read = [&](const json::Value& list, std::size_t i) {
      const auto check = [&](const Modifier& one) {
        Lists alone(size);
        alone[i] = {one};
        (void)over(alone);
      };
      if (std::optional<std::vector<Modifier>> modifiers = modifiers_in(list, check, problems))
        lists[i] = std::move(*modifiers);
      else
        faulty = true;
    };
    if (said.is(json::Value::Kind::list)) {
      read(said, 0);
      std::fill(lists.begin() + 1, lists.end(), lists.front());
    } else {
      for (std::size_t i = 0; i < size; ++i)
        if (const json::Value list = usable(said, std::string_view("xyzw").substr(i, 1))) read(list, i);
    }
    return faulty ? std::nullopt : std::optional(over(lists));
  }
}

template std::optional<Curve<double>> with_modifiers_of(const json::Value&, const Curve<double>&, Problems&);
template std::optional<Curve<Vec2>> with_modifiers_of(const json::Value&, const Curve<Vec2>&, Problems&);
template std::optional<Curve<Vec3>> with_modifiers_of(const json::Value&, const Curve<Vec3>&, Problems&);
template std::optional<Curve<Vec4>> with_modifiers_of(const json::Value&, const Curve<Vec4>&, Problems&);

}  // namespace tweenfall::document
