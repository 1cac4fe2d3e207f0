#include "document/tracks/read_track.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/number_text.h>

#include "document/grammar/grammar_functions.h"
#include "document/read/values.h"
#include "document/tracks/read_functions.h"
#include "document/tracks/read_keys.h"
#include "document/tracks/read_mix.h"
#include "document/tracks/read_modifiers.h"
#include "document/tracks/read_rotation.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

template <int size>
using Vector = Eigen::Matrix<double, size, 1, Eigen::DontAlign>;

template <int size>
std::optional<Vector<size>> numbers_of(const json::Value& value) {
  if (!value.is(Kind::list) || value.items().size() != static_cast<std::size_t>(size)) return {};
  Vector<size> out;
  for (int i = 0; i < size; ++i) {
    const json::Value& item = value.items()[static_cast<std::size_t>(i)];
    if (!item.is(Kind::number)) return {};
    out[i] = item.number();
  }
  return out;
}

std::optional<double> number_of(const json::Value& value) {
  return value.is(Kind::number) ? std::optional(value.number()) : std::nullopt;
}

template <class T>
KeyReader<T> reader_of(std::optional<T> (*read)(const json::Value&)) {
  return {[read](const json::Value& value) { return read(value); },
          [read](const json::Value& rate, const T&) { return read(rate); }};
}

class TrackReader {
 public:
  TrackReader(const json::Value& track, const ClipTimes& times, Problems& problems)
      : track_(track),
        list_(track.is(Kind::list) ? track : usable(track, "keys")),
        times_(times),
        problems_(problems) {}

  std::optional<TrackCurve> read(const std::string& property) {
    if (property == "rotation") return made(read_rotation_track(track_, times_, problems_));
    if (property.starts_with("rotation.")) return made(read_angle_track(track_, times_, problems_));
    if (const json::Value mix = usable(track_, "barycentric")) return mixed(property, mix);
    if (const json::Value ratios = usable(track_, "aspect")) {
      const std::optional<Curve<Vec3>> factors = read_aspect(ratios, times_, problems_);
      return factors ? modified_by_track(*factors) : std::nullopt;
    }
    if (has_function(track_)) return function(property);
    if (!list_ || list_.items().empty()) return {};
    if (property == "position") return keyed(reader_of<Vec3>(vector_of));
    if (property == "scale") return scale();
    if (property == "color") return color();
    if (property == "weights") return weights();
    return user();
  }

 private:
  template <class T>
  static std::optional<TrackCurve> made(const std::optional<T>& curve) {
    return curve ? std::optional<TrackCurve>(*curve) : std::nullopt;
  }

  std::optional<TrackCurve> function(const std::string& property) {
    std::optional<TrackCurve> curve = read_function(track_, problems_);
    if (!curve) return {};
    // A single number is for all three axes.
    if (property == "scale" && std::holds_alternative<Curve<double>>(*curve)) {
      const Curve<double> factor = std::get<Curve<double>>(*curve);
      curve = parametric(factor, factor, factor);
    }
    return std::visit([this](const auto& held) { return modified_by_track(held); }, *curve);
  }

  std::optional<TrackCurve> mixed(const std::string& property, const json::Value& mix) {
    if (property == "position") return mixed<Vec3>(mix, vector_of);
    if (property == "scale") return mixed<Vec3>(mix, scale_of);
    const json::Value values = usable(mix, "values");
    if (!values || values.items().empty()) return {};
    const json::Value& first = values.items().front();
    if (property == "color" || first.is(Kind::text)) return mixed<Color>(mix, color_of);
    if (!first.is(Kind::list)) return mixed<double>(mix, number_of);
    if (first.items().size() == 2) return mixed<Vec2>(mix, numbers_of<2>);
    if (first.items().size() == 4) return mixed<Vec4>(mix, numbers_of<4>);
    return mixed<Vec3>(mix, numbers_of<3>);
  }

  template <class T>
  std::optional<TrackCurve> mixed(const json::Value& mix, std::optional<T> (*value_of)(const json::Value&)) {
    const std::optional<std::vector<Curve<double>>> weights = read_mix_weights(mix, times_, problems_);
    const std::optional<std::vector<Curve<T>>> values = read_mix_values<T>(mix, value_of);
    if (!weights || !values) return {};
    if constexpr (std::is_same_v<T, Color>)
      return TrackCurve(barycentric_curve(*values, *weights, color_options().space));
    else
      return modified_by_track(barycentric_curve<T>(*values, *weights));
  }

  template <class T>
  std::optional<TrackCurve> modified_by_track(const T& curve) {
    return TrackCurve(curve);
  }
  std::optional<TrackCurve> modified_by_track(const Curve<double>& curve) {
    return made(with_modifiers_of(track_, curve, problems_));
  }
  std::optional<TrackCurve> modified_by_track(const Curve<Vec2>& curve) {
    return made(with_modifiers_of(track_, curve, problems_));
  }
  std::optional<TrackCurve> modified_by_track(const Curve<Vec3>& curve) {
    return made(with_modifiers_of(track_, curve, problems_));
  }
  std::optional<TrackCurve> modified_by_track(const Curve<Vec4>& curve) {
    return made(with_modifiers_of(track_, curve, problems_));
  }

  template <class T>
  std::optional<TrackCurve> keyed(const KeyReader<T>& reader, const KeyOptions& options = {}) {
    const std::optional<Curve<T>> curve =
        read_keys<T>(list_, times_, reader, key_options_of(track_, options), problems_);
    if (!curve) return {};
    return modified_by_track(with_outside_of(track_, *curve));
  }

  std::optional<TrackCurve> scale() {
    const bool logarithmic = text_in(track_, "mix") == "log";
    if (!logarithmic) return keyed(reader_of<Vec3>(scale_of));
    KeyReader<Vec3> reader = reader_of<Vec3>(scale_of);
    reader.value = [this](const json::Value& value) -> std::optional<Vec3> {
      const std::optional<Vec3> factors = scale_of(value);
      if (!factors || factors->minCoeff() > 0) return factors;
      problems_.add(value, "scales mixed by their logarithm are above 0, found " + json::on_one_line(value));
      return {};
    };
    return keyed(reader, {.logarithmic = true});
  }

  KeyOptions color_options() {
    KeyOptions options;
    const std::string space = text_in(track_, "space", "oklab");
    static constexpr std::pair<std::string_view, ColorSpace> spaces[] = {
        {"linear", ColorSpace::linear}, {"srgb", ColorSpace::srgb}, {"oklab", ColorSpace::oklab},
        {"oklch", ColorSpace::oklch},   {"hsl", ColorSpace::hsl},   {"hsv", ColorSpace::hsv},
        {"hwb", ColorSpace::hwb},       {"lab", ColorSpace::lab},   {"lch", ColorSpace::lch}};
    for (const auto& [word, meant] : spaces)
      if (space == word) options.space = meant;
    if (const json::Value hue = usable(track_, "hue")) {
      options.hue = hue.text() == "longer"       ? HueRule::longer
                    : hue.text() == "increasing" ? HueRule::increasing
                    : hue.text() == "decreasing" ? HueRule::decreasing
                                                 : HueRule::shorter;
      if (hue_index(options.space) < 0)
        problems_.add(hue, "the space " + json::in_quotes(space) +
                               " has no hue; spaces with one are \"oklch\", \"hsl\", \"hsv\", \"hwb\", \"lch\"");
    }
    return options;
  }

  std::optional<TrackCurve> color() {
    KeyReader<Color> reader;
    reader.value = [](const json::Value& value) { return color_of(value); };
    reader.rate = [](const json::Value& rate, const Color&) { return numbers_of<4>(rate); };
    return keyed(reader, color_options());
  }

  // One curve for each morph target.
  std::optional<TrackCurve> weights() {
    const json::Value first = key_parts(list_.items().front()).value;
    const std::size_t count = first ? first.items().size() : 0;
    const std::size_t problems_before = problems_.size();
    for (const json::Value& key : list_.items()) {
      const KeyParts parts = key_parts(key);
      for (const json::Value& value : {parts.value, parts.value_in}) check_count(value, count);
      for (const json::Value& tangent : {parts.in, parts.out})
        check_count(tangent && tangent.is(Kind::object) ? usable(tangent, "rate") : tangent, count);
    }
    if (problems_.size() != problems_before || count == 0) {
      (void)times_.of_keys(list_, problems_);
      return {};
    }
    WeightCurves curves;
    for (std::size_t i = 0; i < count; ++i) {
      const auto part = [i](const json::Value& value) -> std::optional<double> {
        return i < value.items().size() ? number_of(value.items()[i]) : std::nullopt;
      };
      const KeyReader<double> reader{part, [part](const json::Value& rate, double) { return part(rate); }};
      const std::optional<Curve<double>> curve =
          read_keys<double>(list_, times_, reader, key_options_of(track_), problems_);
      if (!curve) return {};
      curves.push_back(with_outside_of(track_, *curve));
    }
    return TrackCurve(std::move(curves));
  }

  void check_count(json::Value value, std::size_t count) {
    if (!value || !value.is(Kind::list) || value.items().size() == count) return;
    problems_.add(value, "the first key has " + std::to_string(count) +
                             " weights, one for each morph target; this has " + std::to_string(value.items().size()));
  }

  template <class T>
  std::optional<TrackCurve> stepped(std::optional<T> (*value_of)(const json::Value&)) {
    const std::size_t problems_before = problems_.size();
    const std::vector<std::optional<double>> seconds = times_.of_keys(list_, problems_);
    std::vector<std::pair<double, T>> steps;
    for (std::size_t i = 0; i < list_.items().size(); ++i) {
      const KeyParts parts = key_parts(list_.items()[i]);
      const std::optional<T> value = parts.value ? value_of(parts.value) : std::nullopt;
      if (value && seconds[i]) steps.emplace_back(*seconds[i], *value);
    }
    if (steps.size() != list_.items().size() || problems_.size() != problems_before) return {};
    return TrackCurve(StepCurve<T>(std::move(steps)));
  }

  std::optional<TrackCurve> user() {
    const json::Value first = key_parts(list_.items().front()).value;
    if (!first) {
      (void)times_.of_keys(list_, problems_);
      return {};
    }
    switch (first.kind()) {
      case Kind::boolean:
        return stepped<bool>([](const json::Value& value) {
          return value.is(Kind::boolean) ? std::optional(value.boolean()) : std::nullopt;
        });
      case Kind::text:
        if (text_in(track_, "kind") != "text" && first.text().substr(0, 1) == "#") return color();
        return stepped<std::string>([](const json::Value& value) {
          return value.is(Kind::text) ? std::optional(std::string(value.text())) : std::nullopt;
        });
      case Kind::list:
        if (first.items().size() == 2) return keyed(reader_of<Vec2>(numbers_of<2>));
        if (first.items().size() == 4) return keyed(reader_of<Vec4>(numbers_of<4>));
        return keyed(reader_of<Vec3>(numbers_of<3>));
      default:
        return keyed(reader_of<double>(number_of));
    }
  }

  const json::Value& track_;
  json::Value list_;
  const ClipTimes& times_;
  Problems& problems_;
};

// Faults that a curve finds only when all its parts are together are reported for the track.
std::optional<TrackCurve> read_curve(const json::Value& track, const std::string& property, const ClipTimes& times,
                                     Problems& problems) {
  try {
    return TrackReader(track, times, problems).read(property);
  } catch (const std::invalid_argument& fault) {
    problems.add(track, fault.what());
    return {};
  }
}

// The track's words for how its curve leaves its keys, each with the time from which it applies; defaults are included.
// Empty with modifiers, which change times and values so that the words no longer apply, and for steps, which have no
// choice.
std::vector<std::pair<double, std::string>> words_of(const json::Value& track, const TrackCurve& curve,
                                                     const ClipTimes& times) {
  std::vector<std::pair<double, std::string>> words;
  const bool steps =
      std::holds_alternative<StepCurve<bool>>(curve) || std::holds_alternative<StepCurve<std::string>>(curve);
  if (steps || usable(track, "modifiers")) return words;
  for (const std::string& function : FunctionForms::names())
    if (usable(track, function)) return {{-std::numeric_limits<double>::infinity(), function}};
  const json::Value list = track.is(Kind::list) ? track : usable(track, "keys");
  if (!list) return words;
  Problems heard_before;
  const std::vector<std::optional<double>> seconds = times.of_keys(list, heard_before);
  std::string_view said;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const KeyParts parts = key_parts(list.items()[i]);
    const std::string_view word = parts.ease ? parts.ease.text() : parts.out ? "" : "smooth-clamped";
    if (seconds[i] && word != said) words.emplace_back(*seconds[i], word);
    said = word;
  }
  return words;
}

}  // namespace

std::optional<Track> read_track(const json::Member& track, const ClipTimes& times, Problems& problems) {
  const std::size_t dot = property_dot(track.name);
  if (dot == std::string::npos || track.value.is(Kind::faulty)) return {};
  const std::string property(track.name.substr(dot + 1));
  std::optional<TrackCurve> curve = read_curve(track.value, property, times, problems);
  if (!curve) return {};
  std::vector<std::pair<double, std::string>> words = words_of(track.value, *curve, times);
  return Track{.node = std::string(track.name.substr(0, dot)),
               .property = property,
               .curve = std::move(*curve),
               .relative = flag_in(track.value, "relative", false),
               .words = std::move(words),
               .order = order_of(text_in(track.value, "order", "XYZ"))};
}

std::optional<Curve<double>> read_numbers(const json::Value& track, const ClipTimes& times, Problems& problems) {
  const std::optional<TrackCurve> curve = read_curve(track, "", times, problems);
  if (!curve || !std::holds_alternative<Curve<double>>(*curve)) return {};
  return std::get<Curve<double>>(*curve);
}

std::optional<Curve<double>> read_plain_keys(const json::Value& keys, Problems& problems) {
  const ClipTimes times({}, {}, "the keys of a warp have no duration of their own");
  return read_keys<double>(keys, times, reader_of<double>(number_of), {}, problems);
}

std::optional<Curve<double>> read_play_keys(const json::Value& keys, std::optional<double> fps, const Form& number,
                                            double from, Problems& problems) {
  const ClipTimes times(fps, {}, "these keys run on a clock that has none");
  KeyReader<double> reader = reader_of<double>(number_of);
  reader.value = [&](const json::Value& value) -> std::optional<double> {
    const std::optional<double> found = number_of(value);
    if (!found || (*found >= number.low && *found <= number.high)) return found;
    problems.add(value, "expected " + number.what + ", found " + number_text(*found));
    return {};
  };
  const std::optional<Curve<double>> curve = read_keys<double>(keys, times, reader, {}, problems);
  return curve && from != 0 ? std::optional(shifted(*curve, -from)) : curve;
}

}  // namespace tweenfall::document
