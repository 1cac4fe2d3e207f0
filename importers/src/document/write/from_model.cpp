#include "document/write/from_model.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/number_text.h>

#include "document/form.h"
#include "document/read/values.h"
#include "json/json_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tweenfall::document {

namespace {

// One JSON object or list being written.
class Parts {
 public:
  explicit Parts(char open) : text_(1, open), close_(open == '{' ? '}' : ']') {}

  void add(std::string_view part) {
    if (text_.size() > 1) text_ += ',';
    text_ += part;
  }
  void add(std::string_view name, std::string_view part) {
    add(json::in_quotes(name));
    text_ += ':';
    text_ += part;
  }
  [[nodiscard]] std::string whole() const { return text_ + close_; }

 private:
  std::string text_;
  char close_;
};

template <class Vector>
std::string numbers_json(const Vector& vector) {
  Parts list('[');
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.add(number_text(vector[i]));
  return list.whole();
}

std::string value_json(double value) {
  return number_text(value);
}
std::string value_json(const Vec2& value) {
  return numbers_json(value);
}
std::string value_json(const Vec3& value) {
  return numbers_json(value);
}
std::string value_json(const Vec4& value) {
  return numbers_json(value);
}
std::string value_json(const Color& value) {
  return json::in_quotes(color_text(value));
}
std::string value_json(const Quat& value) {
  return "{\"quat\":" + numbers_json(value.coeffs()) + "}";
}

template <class T>
std::string rate_json(const Rate<T>& rate) {
  if constexpr (std::is_same_v<T, double>) {
    return number_text(rate);
  } else if constexpr (std::is_same_v<T, Quat>) {
    return numbers_json(Vec3(degrees(rate[0]), degrees(rate[1]), degrees(rate[2])));
  } else {
    return numbers_json(rate);
  }
}

double difference(const Quat& a, const Quat& b) {
  return std::min((a.coeffs() - b.coeffs()).cwiseAbs().maxCoeff(), (a.coeffs() + b.coeffs()).cwiseAbs().maxCoeff());
}
double difference(const Color& a, const Color& b) {
  return (a.rgba - b.rgba).cwiseAbs().maxCoeff();
}
double difference(double a, double b) {
  return std::abs(a - b);
}
template <class Vector>
double difference(const Vector& a, const Vector& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

// How a stretch of a curve is written in a document.
enum class Stretch { hold, linear, cubic };

// One stretch between two knots in the form of the document.
struct Piece {
  double start, end;
  Stretch stretch;
};

template <class T>
bool plain(const Span<T>& span, int degree) {
  return span.degree <= degree && !span.warp.function;
}
bool plain(const RotationSpan& span, int degree) {
  return span.degree <= degree && !span.warp.function && span.form == RotationSpan::Form::exponential &&
         span.spin.isZero(0);
}

// Whether the span is the cubic through its values and rates at its ends.
template <class T>
bool is_cubic(const Span<T>& span) {
  return plain(span, 3);
}
bool is_cubic(const RotationSpan&) {
  return false;
}

// Stretches that no key can express are cut finely, so that cubics with exact rates approximate them.
constexpr int fewest_cuts = 4;
constexpr double most_cuts = 256, most_cuts_of_long = 4096, cuts_per_second = 60;
constexpr double allowed_miss = 1e-7;  // of a value, or a quaternion's part

// The distance of the cubic between two times from the curve, in the middle.
template <class T>
double miss(const Curve<T>& curve, double start, double end) {
  const auto key = [&](double time, Side side) {
    Key<T> out{.time = time, .value = curve.value(time, side)};
    out.in = out.out = Tangent<T>{Tangent<T>::Kind::given, curve.rate(time, side)};
    return out;
  };
  const Curve<T> cubic = keyed_curve<T>({key(start, Side::out), key(end, Side::in)});
  const double middle = start + (end - start) / 2;
  return difference(cubic.value(middle), curve.value(middle));
}

template <class T>
int cuts_of(const Curve<T>& curve, double start, double end) {
  // Limited for any duration, so that a stray key in the year 30,000 does not make a document of a terabyte.
  const double most = std::clamp((end - start) * cuts_per_second, most_cuts, most_cuts_of_long);
  for (int count = fewest_cuts;; count *= 2) {
    if (count >= most) return count;
    double worst = 0;
    for (int i = 0; i < count && !(worst >= allowed_miss); ++i)
      worst = std::max(worst, miss(curve, start + (end - start) * i / count, start + (end - start) * (i + 1) / count));
    if (worst < allowed_miss) return count;
  }
}

template <class T>
std::vector<Piece> pieces_of(const Curve<T>& curve) {
  std::vector<Piece> out;
  const auto cut = [&](double start, double end, int count) {
    for (int i = 0; i < count; ++i) {
      const double to = i + 1 < count ? start + (end - start) * (i + 1) / count : end;
      out.push_back({i == 0 ? start : out.back().end, to, Stretch::cubic});
    }
  };
  const auto spans = curve.spans();
  for (const auto& span : spans) {
    const double end = span.start + span.duration;
    if (plain(span, 0))
      out.push_back({span.start, end, Stretch::hold});
    else if (plain(span, 1))
      out.push_back({span.start, end, Stretch::linear});
    else if (is_cubic(span))
      out.push_back({span.start, end, Stretch::cubic});
    else
      cut(span.start, end, cuts_of(curve, span.start, end));
  }
  const auto knots = curve.knots();
  if (spans.empty() && std::isfinite(curve.start()) && std::isfinite(curve.end())) {
    // A formula is only smooth between its knots.
    std::vector<double> ends{curve.start()};
    for (const double knot : knots)
      if (knot > ends.back() && knot < curve.end()) ends.push_back(knot);
    if (curve.end() > ends.back()) ends.push_back(curve.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) cut(ends[i], ends[i + 1], cuts_of(curve, ends[i], ends[i + 1]));
  }
  // Neighbors share their knot to the bit.
  if (knots.size() == out.size() + 1)
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].start = knots[i];
      out[i].end = knots[i + 1];
    }
  for (std::size_t i = 0; i + 1 < out.size(); ++i) out[i].end = out[i + 1].start;
  return out;
}

bool same_value(const Quat& a, const Quat& b) {
  return difference(a, b) < 1e-12;
}
bool same_value(const Color& a, const Color& b) {
  return a == b;
}
bool same_value(double a, double b) {
  return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}
template <class Vector>
bool same_value(const Vector& a, const Vector& b) {
  return (a - b).cwiseAbs().maxCoeff() <= 1e-12 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

// The key at one knot, between the stretch that arrives and the one that leaves; `value` and `rate` give both sides.
template <class ValueAt, class RateAt>
std::string key_json(double time, const Piece* arriving, const Piece* leaving, bool jumps, const ValueAt& value,
                     const RateAt& rate) {
  const bool in = arriving && arriving->stretch == Stretch::cubic;
  const bool out = leaving && leaving->stretch == Stretch::cubic;
  const bool tells_arrival = jumps && arriving && arriving->stretch != Stretch::hold;
  const char* ease = leaving && !out ? (leaving->stretch == Stretch::hold ? "hold" : "linear") : nullptr;
  if (!in && !out && !tells_arrival) {
    Parts row('[');
    row.add(number_text(time));
    row.add(value(Side::out));
    if (ease) row.add(json::in_quotes(ease));
    return row.whole();
  }
  Parts key('{');
  key.add("t", number_text(time));
  key.add("v", value(Side::out));
  if (ease) key.add("ease", json::in_quotes(ease));
  if (in) key.add("in", rate(Side::in));
  if (out) key.add("out", rate(Side::out));
  if (tells_arrival) key.add("v_in", value(Side::in));
  return key.whole();
}

template <class KeyAt>
std::string keys_json(const std::vector<Piece>& pieces, double only, const KeyAt& key_at) {
  Parts list('[');
  if (pieces.empty()) {
    list.add(key_at(only, nullptr, nullptr));
    return list.whole();
  }
  list.add(key_at(pieces.front().start, nullptr, &pieces.front()));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    list.add(key_at(pieces[i].end, &pieces[i], i + 1 < pieces.size() ? &pieces[i + 1] : nullptr));
  return list.whole();
}

double finite_start(double start) {
  return std::isfinite(start) ? start : 0;
}

template <class T>
std::string curve_json(const Curve<T>& curve) {
  return keys_json(pieces_of(curve), finite_start(curve.start()),
                   [&](double time, const Piece* arriving, const Piece* leaving) {
                     const bool jumps = !same_value(curve.value(time, Side::in), curve.value(time, Side::out));
                     return key_json(
                         time, arriving, leaving, jumps, [&](Side side) { return value_json(curve.value(time, side)); },
                         [&](Side side) { return rate_json<T>(curve.rate(time, side)); });
                   });
}

std::string curve_json(const WeightCurves& curves) {
  if (curves.empty()) return "[]";
  return keys_json(
      pieces_of(curves.front()), finite_start(curves.front().start()),
      [&](double time, const Piece* arriving, const Piece* leaving) {
        const auto all = [&](const auto& part) {
          Parts list('[');
          for (const Curve<double>& curve : curves) list.add(number_text(part(curve)));
          return list.whole();
        };
        const bool jumps = std::any_of(curves.begin(), curves.end(), [&](const Curve<double>& curve) {
          return !same_value(curve.value(time, Side::in), curve.value(time, Side::out));
        });
        return key_json(
            time, arriving, leaving, jumps,
            [&](Side side) { return all([&](const Curve<double>& curve) { return curve.value(time, side); }); },
            [&](Side side) { return all([&](const Curve<double>& curve) { return curve.rate(time, side); }); });
      });
}

template <class T>
std::string curve_json(const StepCurve<T>& curve) {
  Parts list('[');
  for (const auto& [time, value] : curve.steps()) {
    Parts row('[');
    row.add(number_text(time));
    if constexpr (std::is_same_v<T, bool>)
      row.add(value ? "true" : "false");
    else
      row.add(json::in_quotes(value));
    list.add(row.whole());
  }
  return list.whole();
}

const char* outside_word(Outside outside) {
  switch (outside) {
    case Outside::linear:
      return "linear";
    case Outside::repeat:
      return "repeat";
    case Outside::repeat_offset:
      return "repeat-offset";
    case Outside::pingpong:
      return "pingpong";
    case Outside::hold:
      break;
  }
  return "hold";
}

std::string track_json(const Track& track) {
  Parts out('{');
  if (track.relative) out.add("relative", "true");
  std::visit(
      [&](const auto& curve) {
        if constexpr (requires { curve.before(); }) {
          out.add("before", json::in_quotes(outside_word(curve.before())));
          out.add("after", json::in_quotes(outside_word(curve.after())));
        }
        out.add("keys", curve_json(curve));
      },
      track.curve);
  return out.whole();
}

// Makes names unique and valid for a document.
class Names {
 public:
  std::string unique(const std::string& wanted, const std::string& nameless) {
    std::string name = wanted.empty() ? nameless : is_free_name(wanted) ? "_" + wanted : wanted;
    const std::string base = name;
    for (int i = 2; !taken_.insert(name).second; ++i) name = base + "#" + std::to_string(i);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

std::string node_json(const Node& node, const std::vector<std::string>& names) {
  Parts out('{');
  if (node.parent != no_node) out.add("parent", json::in_quotes(names[node.parent]));
  out.add("position", numbers_json(node.rest.position));
  if (!same_value(node.rest.rotation, Quat(1, 0, 0, 0))) out.add("rotation", value_json(node.rest.rotation));
  const Vec3& scale = node.rest.scale;
  const bool even = scale[0] == scale[1] && scale[1] == scale[2];
  out.add("scale", even ? number_text(scale[0]) : numbers_json(scale));
  return out.whole();
}

std::string event_json(const ClipEvent& event) {
  if (!event.is_interval()) return "[" + number_text(event.from) + "," + json::in_quotes(event.name) + "]";
  Parts span('{');
  span.add("from", number_text(event.from));
  span.add("to", number_text(event.to));
  span.add("name", json::in_quotes(event.name));
  return span.whole();
}

std::string clip_json(const Clip& clip, const std::map<std::string, std::string>& renamed) {
  Parts out('{'), tracks('{'), events('[');
  if (clip.duration > 0 && std::isfinite(clip.duration)) out.add("duration", number_text(clip.duration));
  if (clip.loop.mode != LoopMode::once) {
    Parts loop('{');
    loop.add("mode", json::in_quotes(clip.loop.mode == LoopMode::pingpong        ? "pingpong"
                                     : clip.loop.mode == LoopMode::repeat_offset ? "repeat-offset"
                                                                                 : "repeat"));
    if (clip.loop.count > 0) loop.add("count", number_text(clip.loop.count));
    out.add("loop", loop.whole());
  }
  std::set<std::string> written;
  for (const Track& track : clip.tracks) {
    const auto named = renamed.find(track.node);
    const std::string name = (named == renamed.end() ? track.node : named->second) + "." + track.property;
    if (written.insert(name).second) tracks.add(name, track_json(track));
  }
  for (const ClipEvent& event : clip.events) events.add(event_json(event));
  out.add("tracks", tracks.whole());
  out.add("events", events.whole());
  return out.whole();
}

}  // namespace

std::string text_of(const Model& model) {
  Parts root('{');
  root.add("tweenfall", "1");
  if (!model.name.empty()) root.add("name", json::in_quotes(model.name));

  std::vector<std::string> names;
  std::map<std::string, std::string> renamed;
  Names node_names;
  for (const Node& node : model.nodes) {
    names.push_back(node_names.unique(node.name, "node"));
    renamed.emplace(node.name, names.back());
  }
  Parts nodes('{'), clips('{');
  for (std::size_t i = 0; i < model.nodes.size(); ++i) nodes.add(names[i], node_json(model.nodes[i], names));
  if (!model.nodes.empty()) root.add("nodes", nodes.whole());

  Names clip_names;
  for (const Clip& clip : model.clips) clips.add(clip_names.unique(clip.name, "clip"), clip_json(clip, renamed));
  root.add("clips", clips.whole());
  return root.whole();
}

}  // namespace tweenfall::document
