#include "document/write/from_model.h"

#include <tweenfall/curves/keys.h>

#include "document/read/values.h"
#include "document/shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tweenfall::document {

namespace {

template <class Vector>
JsonValue numbers_json(const Vector& vector) {
  JsonValue list = json_list({});
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.items.push_back(json_number(vector[i]));
  return list;
}

JsonValue value_json(double value) {
  return json_number(value);
}
JsonValue value_json(const Vec2& value) {
  return numbers_json(value);
}
JsonValue value_json(const Vec3& value) {
  return numbers_json(value);
}
JsonValue value_json(const Vec4& value) {
  return numbers_json(value);
}
JsonValue value_json(const Color& value) {
  return json_text(color_text(value));
}
JsonValue value_json(const Quat& value) {
  JsonValue out = json_object();
  add_member(out, "quat", numbers_json(value.coeffs()));
  return out;
}

template <class T>
JsonValue rate_json(const Rate<T>& rate) {
  if constexpr (std::is_same_v<T, double>) {
    return json_number(rate);
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

// How a stretch of a curve is said in a document.
enum class Stretch { hold, linear, cubic };

// One stretch between two knots, as the document can say it.
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

// Whether a cubic with the span's values and rates at its ends is the span.
template <class T>
bool is_cubic(const Span<T>& span) {
  return plain(span, 3);
}
bool is_cubic(const RotationSpan&) {
  return false;
}

// Stretches that no key can say are cut so fine that cubics with their exact rates pass for them.
constexpr int fewest_cuts = 4, most_cuts = 256;
constexpr double cuts_a_second = 60;
constexpr double allowed_miss = 1e-7;  // of a value, or a quaternion's part

// How far the cubic between two times is from the curve in its middle.
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
  for (int count = fewest_cuts; count < most_cuts; count *= 2) {
    double worst = 0;
    for (int i = 0; i < count; ++i)
      worst = std::max(worst, miss(curve, start + (end - start) * i / count, start + (end - start) * (i + 1) / count));
    if (worst < allowed_miss) return count;
  }
  return most_cuts;
}

template <class T>
std::vector<Piece> pieces_of(const Curve<T>& curve) {
  std::vector<Piece> out;
  const auto cut = [&](double start, double end, int count) {
    for (int i = 0; i < count; ++i)
      out.push_back({start + (end - start) * i / count, start + (end - start) * (i + 1) / count, Stretch::cubic});
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
  if (spans.empty() && std::isfinite(curve.start()) && std::isfinite(curve.end()) && curve.end() > curve.start())
    cut(curve.start(), curve.end(), std::max(1, static_cast<int>(std::ceil(curve.duration() * cuts_a_second))));
  // Neighbors share their knot to the bit.
  const auto knots = curve.knots();
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

// The key at one knot, between the stretch that arrives and the one that leaves; `value` and `rate` tell both sides.
template <class ValueAt, class RateAt>
JsonValue key_json(double time, const Piece* arriving, const Piece* leaving, bool jumps, const ValueAt& value,
                   const RateAt& rate) {
  const bool in = arriving && arriving->stretch == Stretch::cubic;
  const bool out = leaving && leaving->stretch == Stretch::cubic;
  const bool tells_arrival = jumps && arriving && arriving->stretch != Stretch::hold;
  const char* ease = leaving && !out ? (leaving->stretch == Stretch::hold ? "hold" : "linear") : nullptr;
  if (!in && !out && !tells_arrival) {
    JsonValue row = json_list({json_number(time), value(Side::out)});
    if (ease) row.items.push_back(json_text(ease));
    return row;
  }
  JsonValue key = json_object();
  add_member(key, "t", json_number(time));
  add_member(key, "v", value(Side::out));
  if (ease) add_member(key, "ease", json_text(ease));
  if (in) add_member(key, "in", rate(Side::in));
  if (out) add_member(key, "out", rate(Side::out));
  if (tells_arrival) add_member(key, "v_in", value(Side::in));
  return key;
}

template <class KeyAt>
JsonValue keys_json(const std::vector<Piece>& pieces, double only, const KeyAt& key_at) {
  JsonValue list = json_list({});
  if (pieces.empty()) {
    list.items.push_back(key_at(only, nullptr, nullptr));
    return list;
  }
  list.items.push_back(key_at(pieces.front().start, nullptr, &pieces.front()));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    list.items.push_back(key_at(pieces[i].end, &pieces[i], i + 1 < pieces.size() ? &pieces[i + 1] : nullptr));
  return list;
}

double finite_start(double start) {
  return std::isfinite(start) ? start : 0;
}

template <class T>
JsonValue curve_json(const Curve<T>& curve) {
  return keys_json(pieces_of(curve), finite_start(curve.start()),
                   [&](double time, const Piece* arriving, const Piece* leaving) {
                     const bool jumps = !same_value(curve.value(time, Side::in), curve.value(time, Side::out));
                     return key_json(
                         time, arriving, leaving, jumps, [&](Side side) { return value_json(curve.value(time, side)); },
                         [&](Side side) { return rate_json<T>(curve.rate(time, side)); });
                   });
}

JsonValue curve_json(const WeightCurves& curves) {
  if (curves.empty()) return json_list({});
  return keys_json(
      pieces_of(curves.front()), finite_start(curves.front().start()),
      [&](double time, const Piece* arriving, const Piece* leaving) {
        const auto all = [&](const auto& part) {
          JsonValue list = json_list({});
          for (const Curve<double>& curve : curves) list.items.push_back(json_number(part(curve)));
          return list;
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
JsonValue curve_json(const StepCurve<T>& curve) {
  JsonValue list = json_list({});
  for (const auto& [time, value] : curve.steps()) {
    if constexpr (std::is_same_v<T, bool>)
      list.items.push_back(json_list({json_number(time), json_boolean(value)}));
    else
      list.items.push_back(json_list({json_number(time), json_text(value)}));
  }
  return list;
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

JsonValue track_json(const Track& track) {
  JsonValue out = json_object();
  if (track.relative) add_member(out, "relative", json_boolean(true));
  std::visit(
      [&](const auto& curve) {
        if constexpr (requires { curve.before(); }) {
          add_member(out, "before", json_text(outside_word(curve.before())));
          add_member(out, "after", json_text(outside_word(curve.after())));
        }
        add_member(out, "keys", curve_json(curve));
      },
      track.curve);
  return out;
}

// Names that a document can hold, each once.
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

JsonValue node_json(const Node& node, const std::vector<std::string>& names) {
  JsonValue out = json_object();
  if (node.parent != no_node) add_member(out, "parent", json_text(names[node.parent]));
  add_member(out, "position", numbers_json(node.rest.position));
  if (!same_value(node.rest.rotation, Quat(1, 0, 0, 0))) add_member(out, "rotation", value_json(node.rest.rotation));
  const Vec3& scale = node.rest.scale;
  if (scale[0] == scale[1] && scale[1] == scale[2])
    add_member(out, "scale", json_number(scale[0]));
  else
    add_member(out, "scale", numbers_json(scale));
  return out;
}

}  // namespace

JsonValue tree_of(const Model& model) {
  JsonValue root = json_object();
  add_member(root, "tweenfall", json_number(1));
  if (!model.name.empty()) add_member(root, "name", json_text(model.name));

  std::vector<std::string> names;
  std::map<std::string, std::string> renamed;
  Names node_names;
  for (const Node& node : model.nodes) {
    names.push_back(node_names.unique(node.name, "node"));
    renamed.emplace(node.name, names.back());
  }
  JsonValue nodes = json_object();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) add_member(nodes, names[i], node_json(model.nodes[i], names));
  if (!model.nodes.empty()) add_member(root, "nodes", std::move(nodes));

  JsonValue clips = json_object();
  Names clip_names;
  for (const Clip& clip : model.clips) {
    JsonValue out = json_object(), tracks = json_object(), events = json_list({});
    if (clip.duration > 0 && std::isfinite(clip.duration)) add_member(out, "duration", json_number(clip.duration));
    if (clip.loop.mode != LoopMode::once) {
      JsonValue loop = json_object();
      add_member(loop, "mode",
                 json_text(clip.loop.mode == LoopMode::pingpong        ? "pingpong"
                           : clip.loop.mode == LoopMode::repeat_offset ? "repeat-offset"
                                                                       : "repeat"));
      if (clip.loop.count > 0) add_member(loop, "count", json_number(clip.loop.count));
      add_member(out, "loop", std::move(loop));
    }
    for (const Track& track : clip.tracks) {
      const auto named = renamed.find(track.node);
      const std::string name = (named == renamed.end() ? track.node : named->second) + "." + track.property;
      if (!tracks.find(name)) add_member(tracks, name, track_json(track));
    }
    for (const ClipEvent& event : clip.events) {
      JsonValue item = json_object();
      if (event.is_interval()) {
        add_member(item, "from", json_number(event.from));
        add_member(item, "to", json_number(event.to));
        add_member(item, "name", json_text(event.name));
      } else {
        item = json_list({json_number(event.from), json_text(event.name)});
      }
      events.items.push_back(std::move(item));
    }
    add_member(out, "tracks", std::move(tracks));
    add_member(out, "events", std::move(events));
    add_member(clips, clip_names.unique(clip.name, "clip"), std::move(out));
  }
  add_member(root, "clips", std::move(clips));
  return root;
}

}  // namespace tweenfall::document
