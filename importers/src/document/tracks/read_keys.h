#pragma once

// Keys of one type of value, from checked trees.

#include <tweenfall/curves/keys.h>

#include "document/read/clip_times.h"
#include "document/read/values.h"

#include <functional>
#include <stdexcept>
#include <type_traits>

namespace tweenfall::document {

// How values and rates of one kind are read; both return empty for faulty ones. Rates may need the key's value.
template <class T>
struct KeyReader {
  std::function<std::optional<T>(const json::Value&)> value;
  std::function<std::optional<Rate<T>>(const json::Value& rate, const T& value)> rate;
  double unit = 1;                                     // factor for slopes written in an ease
  std::function<Turn(const json::Value& key)> turn{};  // rotations only
};

[[nodiscard]] TangentKind tangent_kind_of(std::string_view word);

// `options` with the track's settings for handles and ends.
[[nodiscard]] KeyOptions key_options_of(const json::Value& track, KeyOptions options = {});

template <class T>
std::optional<Tangent<T>> read_tangent(json::Value tangent, const T& value, const KeyReader<T>& reader) {
  if (!tangent) return {};
  Tangent<T> out;
  if constexpr (!std::is_same_v<Rate<T>, double>) out.rate.setZero();
  if (tangent.is(json::Value::Kind::text)) {
    out.kind = tangent_kind_of(tangent.text());
    return out;
  }
  out.kind = Tangent<T>::Kind::given;
  json::Value rate = tangent;
  if (tangent.is(json::Value::Kind::object)) {
    rate = usable(tangent, "rate");
    out.weight = number_in(tangent, "weight", out.weight);
    if (const json::Value kind = usable(tangent, "kind")) {
      out.kind = tangent_kind_of(kind.text());
      return out;
    }
  }
  const std::optional<Rate<T>> read = rate ? reader.rate(rate, value) : std::nullopt;
  if (!read) return {};
  out.rate = *read;
  return out;
}

// The curve through the keys; empty where one of them is faulty.
template <class T>
std::optional<Curve<T>> read_keys(const json::Value& list, const ClipTimes& times, const KeyReader<T>& reader,
                                  const KeyOptions& options, Problems& problems) {
  const std::size_t problems_before = problems.size();
  const std::vector<std::optional<double>> seconds = times.of_keys(list, problems);
  std::vector<Key<T>> keys;
  for (std::size_t i = 0; i < list.items().size(); ++i) {
    const KeyParts parts = key_parts(list.items()[i]);
    const std::optional<T> value = parts.value ? reader.value(parts.value) : std::nullopt;
    if (!value || !seconds[i]) continue;
    Key<T> key{.time = *seconds[i], .value = *value};
    if (parts.ease)
      if (const std::optional<Ease> ease = Ease::named(parts.ease.text())) key.ease = ease->scaled(reader.unit);
    key.in = read_tangent(parts.in, parts.value_in ? reader.value(parts.value_in).value_or(*value) : *value, reader);
    key.out = read_tangent(parts.out, *value, reader);
    if (parts.value_in) key.value_in = reader.value(parts.value_in);
    if (reader.turn) key.turn = reader.turn(list.items()[i]);
    keys.push_back(std::move(key));
  }
  if (keys.size() != list.items().size() || keys.empty() || problems.size() != problems_before) return {};
  try {
    return keyed_curve<T>(std::span<const Key<T>>(keys), options);
  } catch (const std::invalid_argument& fault) {
    problems.add(list, fault.what());
    return {};
  }
}

}  // namespace tweenfall::document
