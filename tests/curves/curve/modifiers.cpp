#include <tweenfall/curves/handles.h>
#include <tweenfall/curves/modifiers.h>

#include <limits>
#include <map>
#include <stdexcept>

#include "curves/stated.h"

using namespace tweenfall;
using namespace tweenfall::modifiers;

namespace {

Curve<double> blender_curve(const nlohmann::json& input) {
  std::vector<HandleKey> keys;
  for (const auto& g : input["keys"]) {
    HandleKey key{g["co"][0], g["co"][1]};
    key.in = {TangentKind::given, g["handle_left"][0], g["handle_left"][1]};
    key.out = {TangentKind::given, g["handle_right"][0], g["handle_right"][1]};
    if (g["interpolation"] == "LINEAR") key.ease = Ease::linear();
    keys.push_back(key);
  }
  return handle_curve(keys, {.overlong = Overlong::contain});
}

Cycles::Mode mode(const nlohmann::json& j, const char* name) {
  static const std::map<std::string, Cycles::Mode> words = {{"NONE", Cycles::Mode::none},
                                                            {"REPEAT", Cycles::Mode::repeat},
                                                            {"REPEAT_OFFSET", Cycles::Mode::repeat_offset},
                                                            {"MIRROR", Cycles::Mode::mirror}};
  return words.at(j[name]);
}

BuiltIn::Function function(const std::string& word) {
  static const std::map<std::string, BuiltIn::Function> words = {
      {"SIN", BuiltIn::Function::sin},   {"COS", BuiltIn::Function::cos}, {"TAN", BuiltIn::Function::tan},
      {"SQRT", BuiltIn::Function::sqrt}, {"LN", BuiltIn::Function::ln},   {"SINC", BuiltIn::Function::sinc}};
  return words.at(word);
}

std::optional<double> used(const nlohmann::json& j, const char* flag, const char* value) {
  if (!j.value(flag, false)) return std::nullopt;
  return j[value].get<double>();
}

Kind kind_of(const nlohmann::json& j) {
  const std::string type = j["type"];
  if (type == "CYCLES")
    return Cycles{mode(j, "mode_before"), mode(j, "mode_after"), j.value("cycles_before", 0),
                  j.value("cycles_after", 0)};
  if (type == "GENERATOR")
    return Generator{j["coefficients"].get<std::vector<double>>(), j["mode"] != "POLYNOMIAL",
                     j.value("use_additive", false)};
  if (type == "FNGENERATOR")
    return BuiltIn{function(j["function_type"]), j.value("amplitude", 1.0),    j.value("phase_multiplier", 1.0),
                   j.value("phase_offset", 0.0), j.value("value_offset", 0.0), j.value("use_additive", false)};
  if (type == "STEPPED")
    return Stepped{j["frame_step"], j.value("frame_offset", 0.0), used(j, "use_frame_start", "frame_start"),
                   used(j, "use_frame_end", "frame_end"), true};
  if (type == "LIMITS")
    return Limits{used(j, "use_min_y", "min_y"), used(j, "use_max_y", "max_y"), used(j, "use_min_x", "min_x"),
                  used(j, "use_max_x", "max_x")};
  REQUIRE(type == "ENVELOPE");
  Envelope envelope{j["reference_value"], j["default_min"], j["default_max"], {}};
  for (const auto& p : j["control_points"]) envelope.points.push_back({p["frame"], p["min"], p["max"]});
  return envelope;
}

Modifier modifier(const nlohmann::json& j) {
  Modifier result{kind_of(j)};
  if (j.value("use_restricted_range", false))
    result.range = ModifierRange{j["frame_start"], j["frame_end"], j.value("blend_in", 0.0), j.value("blend_out", 0.0)};
  if (j.value("use_influence", false)) result.influence = j["influence"];
  return result;
}

}  // namespace

TEST_CASE("modifiers agree with Blender's") {
  for (const auto& file : test::vector_family("blender_modifiers")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      const std::string name = c["name"];
      CAPTURE(name);
      // Blender's noise is its own; its cases are only for reading.
      if (name.find("informative") != std::string::npos) continue;
      std::vector<Modifier> list;
      for (const auto& j : c["input"]["modifiers"]) list.push_back(modifier(j));
      const Curve<double> curve = modified(blender_curve(c["input"]), list);
      const double size = std::max(1.0, test::largest(c["value"]));
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const double t = c["t"][k], expected = c["value"][k];
        CAPTURE(t);
        // Times are float32: an edge may lie on either side of them.
        const double slip = std::abs(t) * 0x1p-23;
        const double allowed = tolerance * size + 2 * slip * std::abs(curve.rate(t));
        bool agrees = false;
        for (const double at : {t - slip, t, t + slip})
          for (const Side side : {Side::in, Side::out})
            agrees = agrees || std::abs(curve.value(at, side) - expected) <= allowed;
        CHECK(agrees);
      }
    }
  }
}

namespace {

Curve<double> jagged() {
  return keyed_curve<double>({{0, 1, Ease::smooth()}, {1, 3, Ease::hold()}, {1.5, -2, Ease::smooth()}, {3, 2}});
}

// Derivatives against five-point stencils, at a time away from knots and edges.
void check_rates(const Curve<double>& curve, double t) {
  CAPTURE(t);
  constexpr double h = 1e-4;
  const auto at = [&](double x) { return curve.sample(x); };
  const Sample<double> s = at(t);
  const double rate =
      (8 * (at(t + h).value - at(t - h).value) - (at(t + 2 * h).value - at(t - 2 * h).value)) / (12 * h);
  const double acceleration =
      (8 * (at(t + h).rate - at(t - h).rate) - (at(t + 2 * h).rate - at(t - 2 * h).rate)) / (12 * h);
  CHECK(test::near(s.rate, rate, 1e-7));
  CHECK(test::near(s.acceleration, acceleration, 1e-6));
}

}  // namespace

TEST_CASE("rates and accelerations pass through every modifier and through stacks of them") {
  const Curve<double> curve = jagged();
  const Curve<double> clock = keyed_curve<double>({{-9, 4, Ease::smooth()}, {0, -1, Ease::smooth()}, {9, 5}});
  const std::vector<Kind> kinds = {
      Cycles{Cycles::Mode::mirror, Cycles::Mode::repeat_offset},
      Noise{.seed = 5, .strength = 2, .scale = 0.7, .layers = 3},
      Noise{.mix = Noise::Mix::multiply, .seed = 6},
      Generator{{0.3, -1, 0.25, 0.1}, false, true},
      Generator{{0.3, -1, 0.25, 0.1}, true},
      BuiltIn{BuiltIn::Function::sin, 2, 3, 0.5, 0.1, true},
      BuiltIn{BuiltIn::Function::sinc, 2, 0.3, 0.001},
      BuiltIn{BuiltIn::Function::tan, 2, 0.03, 0.4},
      BuiltIn{BuiltIn::Function::ln, 2, 0.3, 9},
      BuiltIn{BuiltIn::Function::sqrt, 2, 0.3, 9, 0, true},
      Limits{-1.5, 2.5, 0.5, 2.6},
      Envelope{0.2, -1, 2, {{0, -1, 3}, {2, -2, 1}, {5, 0, 1}}},
      TimeWarp{clock},
      Placement{0.3, -1.7, 2, 0.5},
  };
  test::Random random(11);
  for (std::size_t i = 0; i < kinds.size(); ++i)
    for (std::size_t j = 0; j < kinds.size(); ++j) {
      CAPTURE(i);
      CAPTURE(j);
      const Modifier stack[] = {{kinds[i], ModifierRange{-5.05, 4.05, 3, 2}, 0.8}, {kinds[j]}};
      const Curve<double> both = modified(curve, stack);
      for (int n = 0; n < 4; ++n) {
        const double t = random.between(-6, 6);
        // Not where a stencil would reach over an edge.
        const auto steady = [&](double x) { return both.sample(x).acceleration; };
        const double a = steady(t - 4e-4), b = steady(t + 4e-4);
        if (std::abs(a - b) > 0.3 * (1 + std::abs(a))) continue;
        if (std::abs(both.value(t - 4e-4) - both.value(t + 4e-4)) > 0.1) continue;
        check_rates(both, t);
      }
    }
}

TEST_CASE("both sides of an edge can be asked for") {
  const Curve<double> curve = jagged();
  const auto with = [&](Kind kind) { return modified(curve, std::vector<Modifier>{{std::move(kind)}}); };
  const Curve<double> cycled = with(Cycles{Cycles::Mode::repeat, Cycles::Mode::repeat_offset});
  CHECK(cycled.value(3, Side::in) == 2);
  CHECK(cycled.value(3) == 2);
  CHECK(cycled.value(-3) == 1);
  CHECK(cycled.value(0, Side::in) == 2);
  CHECK(cycled.value(0) == 1);
  CHECK(cycled.value(6) == 3);
  // Run backwards, the arriving side is the forward leaving side.
  const Curve<double> mirrored = with(Cycles{Cycles::Mode::mirror, Cycles::Mode::mirror});
  CHECK(curve.value(1.5, Side::in) == 3);
  CHECK(mirrored.value(4.5, Side::in) == -2);
  CHECK(mirrored.value(4.5) == 3);
  CHECK(mirrored.value(-1.5, Side::in) == -2);
  const Curve<double> turned = with(Placement{.time_scale = -1});
  CHECK(turned.value(-1.5, Side::in) == -2);
  CHECK(turned.value(-1.5) == 3);
  const Curve<double> stepped = with(Stepped{0.5});
  CHECK(stepped.value(1.5) == -2);
  CHECK(stepped.value(1.5, Side::in) == 3);
  CHECK(stepped.rate(1.7) == 0);
  const Modifier late{Generator{{5}}, ModifierRange{1, 2}};
  const Curve<double> ranged = modified(curve, std::span(&late, 1));
  CHECK(ranged.value(1, Side::in) == 3);
  CHECK(ranged.value(1) == 5);
  CHECK(ranged.value(2, Side::in) == 5);
  CHECK(ranged.value(2) == curve.value(2));
}

TEST_CASE("cycles that are counted leave the curve to itself beyond their last") {
  const Curve<double> curve = jagged().with_outside(Outside::linear, Outside::hold);
  const Modifier counted{Cycles{Cycles::Mode::repeat, Cycles::Mode::repeat_offset, 1, 2}};
  const Curve<double> c = modified(curve, std::span(&counted, 1));
  CHECK(c.value(8.5) == doctest::Approx(curve.value(2.5) + 2));
  CHECK(c.value(9.5) == curve.value(9.5));
  CHECK(c.value(-2.5) == curve.value(0.5));
  CHECK(c.value(-3.5) == curve.value(-3.5));
}

TEST_CASE("noise stays within its strength, differs by its seed and is the same every time") {
  const Curve<double> nothing = keyed_curve<double>({{0, 0}});
  const auto noise = [&](Noise n) { return modified(nothing, std::vector<Modifier>{{n}}); };
  const Curve<double> a = noise({.seed = 1, .strength = 3, .scale = 0.3, .layers = 4});
  const Curve<double> b = noise({.seed = 2, .strength = 3, .scale = 0.3, .layers = 4});
  double most = 0, apart = 0, previous = a.value(-10);
  for (int k = 0; k <= 20000; ++k) {
    const double t = -10 + k * 1e-3;
    most = std::max(most, std::abs(a.value(t)));
    apart = std::max(apart, std::abs(a.value(t) - b.value(t)));
    CHECK(std::abs(a.value(t) - previous) < 0.2);
    previous = a.value(t);
  }
  CHECK(most <= 3);
  CHECK(most > 0.5);
  CHECK(apart > 0.5);
  // Splitmix64 of seed and cell in exact arithmetic: these digits are the same on every machine.
  const Curve<double> one = noise({.seed = 7});
  CHECK(one.value(0.5) == noise({.seed = 7}).value(0.5));
  CHECK(one.value(4) == 0);
  CHECK(one.rate(4) != 0);
  // Acceleration does not jump at a cell's edge.
  CHECK(one.sample(4 - 1e-9).acceleration == doctest::Approx(one.sample(4).acceleration).epsilon(1e-6));
}

TEST_CASE("a modified curve keeps its knots, and its rules outside can be changed") {
  const Modifier doubled{Placement{.value_scale = 2}};
  const Curve<double> c = modified(jagged(), std::span(&doubled, 1));
  CHECK(c.start() == 0);
  CHECK(c.end() == 3);
  CHECK(c.knots().size() == 4);
  CHECK(c.value(100) == 4);
  CHECK(c.with_outside(Outside::hold, Outside::repeat).value(3.5) == 2 * jagged().value(0.5));
}

TEST_CASE("modifiers that cannot be are refused with their place in the list") {
  const auto refused = [](Modifier m, const char* text) {
    const Modifier list[] = {{Placement{}}, std::move(m)};
    CHECK_THROWS_WITH_AS((void)modified(jagged(), list), doctest::Contains(text), std::invalid_argument);
  };
  refused({Stepped{0}}, "modifier 1: a step must be > 0 s; it is 0");
  refused({Noise{.scale = -1}}, "the scale of noise must be > 0 s; it is -1");
  refused({Noise{.layers = 0}}, "1 to 16 layers");
  refused({Generator{}}, "at least one coefficient");
  refused({Generator{{1, 2, 3}, true}}, "in pairs; there are 3");
  refused({Limits{2, 1}}, "the low limit, 2, must not lie above the high one, 1");
  refused({Envelope{}}, "at least one point");
  refused({Envelope{0, -1, 1, {{1, 0, 1}, {1, 0, 1}}}}, "point 1 lies at 1 s");
  refused({Placement{.time_scale = 0}}, "the time scale must not be 0");
  refused({Cycles{.plays_after = -1}}, "the plays of cycles must be >= 0");
  refused({Placement{}, ModifierRange{2, 1}}, "the range must not end before it starts");
  refused({Placement{}, std::nullopt, 1.5}, "the influence must lie in 0 to 1; it is 1.5");
  refused({BuiltIn{.amplitude = std::numeric_limits<double>::infinity()}}, "amplitude must be finite");
}

TEST_CASE("modifiers of a vector change their component alone, and repeat with the curve") {
  const Curve<Vec2> line = keyed_curve<Vec2>({{0, Vec2(0, 0), Ease::linear()}, {1, Vec2(1, 3)}});
  const std::vector<Modifier> lists[] = {{}, {{modifiers::Limits{.high = 2}}}};
  const Curve<Vec2> limited = modified<Vec2>(line, lists);
  CHECK(limited.value(0.5) == Vec2(0.5, 1.5));
  CHECK(limited.value(0.9) == Vec2(0.9, 2));
  CHECK(limited.rate(0.9) == Vec2(1, 0));
  CHECK(limited.with_outside(Outside::hold, Outside::repeat_offset).value(1.25) == Vec2(1.25, 2));
  CHECK_THROWS_WITH_AS((void)modified<Vec2>(line, std::span(lists, 1)),
                       "a vector of 2 needs one list of modifiers per component; 1 were given", std::invalid_argument);
  const std::vector<Modifier> bad[] = {{}, {{modifiers::Stepped{.step = 0}}}};
  CHECK_THROWS_WITH_AS((void)modified<Vec2>(line, bad), doctest::Contains("component 1, modifier 0: "),
                       std::invalid_argument);
}
