#include <tweenfall/curves/handles.h>

#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "curves/stated.h"

using namespace tweenfall;

namespace {

Handle place(const nlohmann::json& j) {
  return {TangentKind::given, j[0], j[1]};
}

// Keys of the families time_bezier and time_bezier_bold.
std::vector<HandleKey> bezier_keys(const nlohmann::json& list) {
  std::vector<HandleKey> keys;
  for (const auto& g : list) {
    HandleKey key{g["co"][0], g["co"][1]};
    key.in = key.out = {TangentKind::given, key.time, key.value};
    if (g.contains("handle_left")) key.in = place(g["handle_left"]);
    if (g.contains("handle_right")) key.out = place(g["handle_right"]);
    keys.push_back(key);
  }
  return keys;
}

// A key of Blender's; `kinds` false takes its handles as they are.
HandleKey blender_key(const nlohmann::json& g, bool kinds) {
  static const std::map<std::string, TangentKind> words = {{"FREE", TangentKind::given},
                                                           {"ALIGNED", TangentKind::aligned},
                                                           {"VECTOR", TangentKind::vector},
                                                           {"AUTO", TangentKind::automatic},
                                                           {"AUTO_CLAMPED", TangentKind::auto_clamped}};
  HandleKey key{g["co"][0], g["co"][1]};
  key.in = key.out = {TangentKind::given, key.time, key.value};
  if (g.contains("handle_left")) key.in = place(g["handle_left"]);
  if (g.contains("handle_right")) key.out = place(g["handle_right"]);
  if (kinds && g.contains("handle_left_type")) {
    key.in.kind = words.at(g["handle_left_type"]);
    key.out.kind = words.at(g["handle_right_type"]);
  }
  return key;
}

std::string exact(double v) {
  std::ostringstream text;
  text.precision(17);
  text << v;
  return text.str();
}

// Blender states an elastic's amplitude in the value's unit and its period in frames; 0 is its own choice.
Ease elastic(const nlohmann::json& g, const std::string& flow, double change, double duration) {
  const double period = g.value("period", 0.0), amplitude = g.value("amplitude", 0.0);
  const double own = flow == "-in-out" ? 0.45 : 0.3;
  return Ease::named("penner-elastic" + flow + "(" + exact(change == 0 ? 0 : amplitude / change) + "," +
                     exact(period > 0 ? period / duration : own) + ")")
      .value();
}

std::optional<Ease> blender_ease(const nlohmann::json& from, const nlohmann::json& to) {
  std::string word = from.value("interpolation", "BEZIER");
  if (word == "BEZIER") return std::nullopt;
  if (word == "CONSTANT") return Ease::hold();
  if (word == "LINEAR") return Ease::linear();
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string easing = from["easing"];
  const bool out = word == "back" || word == "bounce" || word == "elastic";
  const std::string flow = easing == "EASE_IN"       ? "-in"
                           : easing == "EASE_OUT"    ? "-out"
                           : easing == "EASE_IN_OUT" ? "-in-out"
                           : out                     ? "-out"
                                                     : "-in";
  const double change = to["co"][1].get<double>() - from["co"][1].get<double>();
  const double duration = to["co"][0].get<double>() - from["co"][0].get<double>();
  if (word == "elastic") return elastic(from, flow, change, duration);
  if (word == "back" && from.contains("back"))
    // Penner's way in and out goes farther.
    return Ease::named("back" + flow + "(" + exact(from["back"].get<double>() * (flow == "-in-out" ? 1.525 : 1)) + ")")
        .value();
  return Ease::named(word + flow).value();
}

std::vector<HandleKey> blender_keys(const nlohmann::json& list, bool kinds) {
  std::vector<HandleKey> keys;
  for (std::size_t i = 0; i < list.size(); ++i) {
    keys.push_back(blender_key(list[i], kinds));
    if (i + 1 < list.size()) keys.back().ease = blender_ease(list[i], list[i + 1]);
  }
  return keys;
}

// In Blender the end key's own interpolation decides how the curve continues.
OutsideRule<double> blender_outside(const nlohmann::json& input, const HandleKey& end, const nlohmann::json& stored,
                                    const HandleKey* neighbor) {
  const std::string kind = stored.value("interpolation", "BEZIER");
  if (input["extrapolation"] == "CONSTANT" || kind == "CONSTANT") return {};
  if (kind == "LINEAR") {
    if (!neighbor) return {};
    return {Outside::linear, (neighbor->value - end.value) / (neighbor->time - end.time)};
  }
  return {Outside::linear};
}

}  // namespace

TEST_CASE("overlong handles are resolved as scipy's numbers say") {
  for (const auto& file : test::vector_family("anti_regression")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const HandleWidths widths{c["input"]["start_width"], c["input"]["end_width"]};
      CHECK(runs_backwards(widths) == c["regressive"].get<bool>());
      const auto agrees = [&](const char* name, Overlong rule) {
        if (!c.contains(name)) return;
        CAPTURE(name);
        const HandleWidths result = resolved(widths, rule);
        CHECK(std::abs(result.start - c[name][0].get<double>()) <= tolerance);
        CHECK(std::abs(result.end - c[name][1].get<double>()) <= tolerance);
        CHECK_FALSE(runs_backwards({result.start * (1 - 1e-12), result.end * (1 - 1e-12)}));
      };
      agrees("contain", Overlong::contain);
      agrees("keep_ratio", Overlong::keep_ratio);
      agrees("keep_start", Overlong::keep_start);
    }
  }
}

TEST_CASE("every rule makes time run forwards, by a curve whose speed is never negative") {
  test::Random random(3);
  for (int n = 0; n < 300; ++n) {
    const HandleWidths widths{random.between(0, 2.5), random.between(0, 2.5)};
    for (const Overlong rule : {Overlong::keep_ratio, Overlong::keep_start, Overlong::contain}) {
      const HandleWidths w = resolved(widths, rule);
      double least = 1;
      for (int k = 0; k <= 1000; ++k) {
        const double s = k / 1000.0, v = 1 - s;
        least = std::min(least, 3 * w.start * v * v + 6 * (1 - w.end - w.start) * s * v + 3 * w.end * s * s);
      }
      CHECK(least >= -1e-12);
    }
  }
}

TEST_CASE("absolute handles give the Bezier that scipy finds, also outside their span") {
  for (const char* family : {"time_bezier", "time_bezier_bold"})
    for (const auto& file : test::vector_family(family)) {
      const double tolerance = test::tolerance(file);
      for (const auto& c : file["cases"]) {
        CAPTURE(c["name"].get<std::string>());
        const Curve<double> curve = handle_curve(bezier_keys(c["input"]["keys"]));
        const double usual = test::largest(c["value"]) / curve.duration();
        for (std::size_t k = 0; k < c["t"].size(); ++k) {
          CAPTURE(c["t"][k].get<double>());
          const auto& rate = c["derivative"][k];
          // "near a vertical tangent 1e-5" stands in the first of the two files.
          const bool vertical = rate.is_null() || std::abs(rate.get<double>()) > 50 * usual;
          const Sample<double> s = curve.sample(c["t"][k], k + 1 == c["t"].size() ? Side::in : Side::out);
          CHECK(test::near(s.value, c["value"][k].get<double>(), vertical ? 1e-5 : tolerance));
          if (!vertical) CHECK(test::near(s.rate, rate.get<double>(), 1e-6));
        }
      }
    }
}

TEST_CASE("handles lie where Blender puts them, and the curve through them is Blender's") {
  for (const auto& file : test::vector_family("blender_fcurve")) {
    const double tolerance = test::stated(file, "tolerance", "<="), steep = test::stated(file, "tolerance", "up to");
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const auto& input = c["input"];
      const bool constant = input["extrapolation"] == "CONSTANT";
      const HandleOptions options{.ends = constant ? Ends::flat : Ends::secant,
                                  .overlong = Overlong::contain,
                                  .even_acceleration = input["auto_smoothing"] == "CONT_ACCEL"};
      const std::vector<HandleKey> stored = blender_keys(input["keys"], false);
      const std::vector<HandleKey> asked = blender_keys(input["keys_authored"], true);
      const double size = std::max(1.0, test::largest(c["value"]));
      if (asked.size() > 1) {
        const std::vector<HandleKey> placed = placed_handles(asked, options);
        for (std::size_t i = 0; i < placed.size(); ++i) {
          CAPTURE(i);
          for (const bool in : {true, false}) {
            const Handle &ours = in ? placed[i].in : placed[i].out, &theirs = in ? stored[i].in : stored[i].out;
            CHECK(test::near(ours.time, theirs.time, tolerance));
            CHECK(std::abs(ours.value - theirs.value) <= tolerance * std::max(size, std::abs(theirs.value)));
          }
        }
      }
      const std::size_t last = stored.size() - 1;
      const Curve<double> curve =
          handle_curve(stored, options)
              .with_outside(
                  blender_outside(input, stored[0], input["keys"][0], last > 0 ? &stored[1] : nullptr),
                  blender_outside(input, stored[last], input["keys"][last], last > 0 ? &stored[last - 1] : nullptr));
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const double t = c["t"][k], expected = c["value"][k];
        CAPTURE(t);
        // Blender's times are float32; where the curve is steep their rounding is more than the tolerance.
        const double slip = std::abs(curve.rate(t)) * std::abs(t) * 0x1p-22;
        const double allowed = std::max(tolerance * size, std::min(slip, steep * size));
        // A float32 time that is a key's may be on either side of its jump.
        CHECK((std::abs(curve.value(t) - expected) <= allowed ||
               std::abs(curve.value(t, Side::in) - expected) <= allowed));
      }
    }
  }
}

TEST_CASE("an inserted key keeps the shape and has the handles that Blender gives it") {
  for (const auto& file : test::vector_family("blender_insert"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const HandleOptions options{.overlong = Overlong::contain};
      const std::vector<HandleKey> before = blender_keys(c["input"]["keys"], false);
      const double at = c["input"]["insert"]["time"];
      const std::vector<HandleKey> after = insert_key(before, at, options);
      const Curve<double> a = handle_curve(before, options), b = handle_curve(after);
      REQUIRE(after.size() == before.size() + 1);
      CHECK(test::near(b.value(at), c["input"]["insert"]["value"].get<double>(), 2e-5));
      const double size = std::max(1.0, test::largest(c["value"]));
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const double t = c["t"][k];
        CAPTURE(t);
        CHECK(std::abs(a.value(t) - c["value"][k].get<double>()) <= 2e-5 * size);
        CHECK(test::near(b.value(t), a.value(t), 1e-11));
        CHECK(test::near(b.rate(t), a.rate(t), 1e-8));
      }
      const std::vector<HandleKey> theirs = blender_keys(c["keys_after"], false);
      for (std::size_t i = 0; i < after.size(); ++i) {
        CAPTURE(i);
        CHECK(test::near(after[i].time, theirs[i].time, 2e-6));
        // Blender shortens handles beyond their span only when it draws.
        if (i > 0 && theirs[i].in.time >= theirs[i - 1].time) {
          CHECK(test::near(after[i].in.time, theirs[i].in.time, 1e-5));
          CHECK(std::abs(after[i].in.value - theirs[i].in.value) <= 2e-5 * size);
        }
        if (i + 1 < after.size() && theirs[i].out.time <= theirs[i + 1].time) {
          CHECK(test::near(after[i].out.time, theirs[i].out.time, 1e-5));
          CHECK(std::abs(after[i].out.value - theirs[i].out.value) <= 2e-5 * size);
        }
      }
    }
}

TEST_CASE("a key inserted into random handles changes neither value, rate nor acceleration") {
  test::Random random(8);
  for (int n = 0; n < 100; ++n) {
    std::vector<HandleKey> keys;
    double t = random.between(-5, 5);
    for (int i = 0; i < 4; ++i, t += random.between(0.5, 3)) {
      HandleKey key{t, random.between(-4, 4)};
      key.in = {TangentKind::given, t - random.between(0.1, 4), random.between(-4, 4)};
      key.out = {TangentKind::given, t + random.between(0.1, 4), random.between(-4, 4)};
      keys.push_back(key);
    }
    for (const Overlong rule : {Overlong::keep_ratio, Overlong::keep_start, Overlong::contain}) {
      const HandleOptions options{.overlong = rule};
      const Curve<double> before = handle_curve(keys, options);
      const double at = random.between(before.start(), before.end());
      const Curve<double> after = handle_curve(insert_key(keys, at, options));
      for (int k = 1; k < 50; ++k) {
        const double u = before.start() + k / 50.0 * before.duration();
        const Sample<double> a = before.sample(u), b = after.sample(u);
        // Where the tangent is vertical the slope is limited, in shares of another span.
        if (std::abs(a.rate) > 1e3) continue;
        CHECK(test::near(b.value, a.value, 1e-9));
        CHECK(test::near(b.rate, a.rate, 1e-5 * (1 + a.rate * a.rate)));
      }
    }
  }
}

TEST_CASE("keys go into held and straight spans too, but not into easings or beyond the ends") {
  std::vector<HandleKey> keys = {
      {0, 1, {}, {}, Ease::hold()}, {1, 3, {}, {}, Ease::linear()}, {2, 7, {}, {}, Ease::named("bounce-out")}, {3, 0}};
  for (HandleKey& key : keys) key.in = key.out = {TangentKind::given, key.time, key.value};
  CHECK(insert_key(keys, 0.5)[1].value == 1);
  CHECK(insert_key(keys, 1.5)[2].value == 5);
  CHECK(handle_curve(insert_key(keys, 0.5)).value(0.9) == 1);
  CHECK(handle_curve(insert_key(keys, 1.5)).rate(1.7) == doctest::Approx(4));
  CHECK(insert_key(keys, 2).size() == 4);
  CHECK_THROWS_WITH_AS((void)insert_key(keys, 2.5), doctest::Contains("into the ease \"bounce-out\" that leaves key 2"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)insert_key(keys, 3.5), doctest::Contains("from 0 s to 3 s, not at 3.5 s"),
                       std::invalid_argument);
}

TEST_CASE("handles that cannot be are refused with their key") {
  const auto refused = [](std::vector<HandleKey> keys, const char* text) {
    CHECK_THROWS_WITH_AS((void)handle_curve(keys), doctest::Contains(text), std::invalid_argument);
  };
  const auto at = [](double time, double value) { return Handle{TangentKind::given, time, value}; };
  const double infinite = std::numeric_limits<double>::infinity();
  refused({}, "at least one key");
  refused({{0, 1, at(0, 1), at(0, 1)}, {0, 2, at(0, 1), at(0, 1)}}, "key 1 (time 0 s, value 2) must come after");
  refused({{0, 1, at(0, 1), at(-1, 1)}, {1, 2, at(1, 2), at(1, 2)}},
          "key 0 (time 0 s, value 1) has its handle \"out\" at -1 s");
  refused({{0, 1, at(0, 1), at(0, infinite)}, {1, 2, at(1, 2), at(1, 2)}}, "non-finite handle (0, inf) in \"out\"");
  CHECK_THROWS_WITH_AS((void)resolved({-1, 0.5}, Overlong::contain), doctest::Contains("must be >= 0; it is -1"),
                       std::invalid_argument);
}

TEST_CASE("automatic handles join smoothly over a loop") {
  for (const bool even : {false, true})
    for (const TangentKind kind : {TangentKind::automatic, TangentKind::auto_clamped, TangentKind::plateau,
                                   TangentKind::auto_chord, TangentKind::auto_mix, TangentKind::auto_ease}) {
      std::vector<HandleKey> keys = {{0, 1}, {1, 2.5}, {1.7, 4}, {3, -1}, {4, 1}};
      for (HandleKey& key : keys) key.in.kind = key.out.kind = kind;
      const Curve<double> curve = handle_curve(keys, {.ends = Ends::wrap, .even_acceleration = even})
                                      .with_outside(Outside::repeat, Outside::repeat);
      CAPTURE(static_cast<int>(kind));
      CHECK(curve.rate(4, Side::in) == doctest::Approx(curve.rate(4)).epsilon(1e-12));
      CHECK(curve.rate(4) != 0);
      if (even && kind == TangentKind::automatic)
        for (const double t : {1.0, 1.7, 3.0, 4.0})
          CHECK(curve.sample(t, Side::in).acceleration == doctest::Approx(curve.sample(t).acceleration).epsilon(1e-9));
    }
}
