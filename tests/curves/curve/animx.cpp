// Maya's rules: tangents, spans and infinities, against numbers made by Autodesk's AnimX.

#include <tweenfall/curves/handles.h>

#include <map>

#include "curves/stated.h"

using namespace tweenfall;

namespace {

std::optional<Ease> ease_of(const std::string& span) {
  if (span == "linear") return Ease::linear();
  if (span == "step") return Ease::hold();
  // The next value at once.
  if (span == "step_next") return Ease::named("steps(1,jump-start)");
  return std::nullopt;
}

Outside outside(const std::string& infinity) {
  static const std::map<std::string, Outside> words = {{"constant", Outside::hold},
                                                       {"linear", Outside::linear},
                                                       {"cycle", Outside::repeat},
                                                       {"cycle_relative", Outside::repeat_offset},
                                                       {"oscillate", Outside::pingpong}};
  return words.at(infinity);
}

// The kind of tangent that a case's name speaks of; `given` for the others.
TangentKind kind_of(const std::string& name) {
  if (name.find("automix") != std::string::npos) return TangentKind::auto_mix;
  if (name.find("autoease") != std::string::npos) return TangentKind::auto_ease;
  return name.find("_auto_") != std::string::npos ? TangentKind::auto_chord : TangentKind::given;
}

double slope(const nlohmann::json& tangent) {
  return tangent[1].get<double>() / tangent[0].get<double>();
}

// Unweighted tangents give a direction, not a length.
Curve<double> hermite(const nlohmann::json& list, TangentKind kind) {
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& k = list[i];
    Key<double> key{k["time"], k["value"]};
    const auto ease = ease_of(k["span"]);
    const bool arrives = i > 0 && !ease_of(list[i - 1]["span"]);
    if (ease && i + 1 < list.size()) key.ease = *ease;
    if (arrives || i == 0) key.in = Tangent<double>{kind, slope(k["tan_in"])};
    if (!ease || i + 1 == list.size()) key.out = Tangent<double>{kind, slope(k["tan_out"])};
    keys.push_back(key);
  }
  return keyed_curve<double>(keys);
}

std::vector<HandleKey> bezier_keys(const nlohmann::json& list, TangentKind kind) {
  std::vector<HandleKey> keys;
  for (const auto& k : list) {
    HandleKey key{k["time"], k["value"]};
    const auto &in = k["tan_in"], &out = k["tan_out"];
    key.in = {kind, key.time - in[0].get<double>() / 3, key.value - in[1].get<double>() / 3};
    key.out = {kind, key.time + out[0].get<double>() / 3, key.value + out[1].get<double>() / 3};
    key.ease = ease_of(k["span"]);
    keys.push_back(key);
  }
  return keys;
}

// A key between a step and a step-next shows its value at one instant only, which is neither limit of the curve.
bool is_instant(const nlohmann::json& list, double t) {
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i]["time"] == t) return list[i - 1]["span"] == "step" && list[i]["span"] == "step_next";
  return false;
}

void check(const Curve<double>& curve, const nlohmann::json& c, double inside, double outside_of) {
  const Curve<double> held = curve.with_outside(Outside::hold, Outside::hold);
  for (std::size_t k = 0; k < c["t"].size(); ++k) {
    const double t = c["t"][k], expected = c["value"][k];
    CAPTURE(t);
    if (is_instant(c["input"]["keys"], t)) continue;
    const double tolerance = t >= curve.start() && t <= curve.end() ? inside : outside_of;
    bool agrees = test::near(curve.value(t), expected, tolerance);
    // At a key's own time AnimX shows that key's value, also where it is left at once for the next (our Side::in), and
    // at the ends before it begins anew.
    const auto knots = curve.knots();
    if (std::find(knots.begin(), knots.end(), t) != knots.end())
      for (const Side side : {Side::in, Side::out})
        agrees = agrees || test::near(held.value(t, side), expected, tolerance);
    // On the edge of a cycle, within the rounding of its times, either side may be meant.
    const double plays = (t - curve.start()) / curve.duration();
    if (std::abs(plays - std::round(plays)) * curve.duration() < 1e-8)
      for (const double near_by : {t - 1e-8, t, t + 1e-8})
        agrees = agrees || test::near(curve.value(near_by, Side::in), expected, 1e-6);
    CHECK(agrees);
  }
}

}  // namespace

TEST_CASE("tangents, spans and infinities agree with AnimX") {
  for (const auto& file : test::vector_family("animx")) {
    const double inside = test::tolerance(file), outside_of = test::stated(file, "tolerance", "outside the keys");
    for (const auto& c : file["cases"]) {
      const std::string name = c["name"];
      CAPTURE(name);
      const auto& input = c["input"];
      // Handles that are too long are resolved differently there; their cases are only for reading.
      if (input["overlong"].get<bool>()) continue;
      const TangentKind kind = kind_of(name);
      const auto curve = [&](TangentKind as) {
        const Curve<double> inner =
            input["weighted"].get<bool>() ? handle_curve(bezier_keys(input["keys"], as)) : hermite(input["keys"], as);
        return inner.with_outside(outside(input["pre"]), outside(input["post"]));
      };
      check(curve(TangentKind::given), c, inside, outside_of);
      if (kind != TangentKind::given) check(curve(kind), c, inside, outside_of);
    }
  }
}

TEST_CASE("automatic tangents are those that AnimX computes") {
  for (const auto& file : test::vector_family("animx"))
    for (const auto& c : file["cases"]) {
      const std::string name = c["name"];
      CAPTURE(name);
      const TangentKind kind = kind_of(name);
      if (kind == TangentKind::given) continue;
      const auto& list = c["input"]["keys"];
      const std::vector<HandleKey> placed = placed_handles(bezier_keys(list, kind));
      for (std::size_t i = 0; i < placed.size(); ++i) {
        const HandleKey& key = placed[i];
        CHECK(test::near((key.value - key.in.value) / (key.time - key.in.time), slope(list[i]["tan_in"]), 1e-9));
        CHECK(test::near((key.out.value - key.value) / (key.out.time - key.time), slope(list[i]["tan_out"]), 1e-9));
      }
    }
}
