#include <tweenfall/curves/color.h>
#include <tweenfall/curves/keys.h>

#include "curves/stated.h"

#include <set>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr ColorSpace spaces[] = {ColorSpace::linear, ColorSpace::srgb, ColorSpace::oklab,
                                 ColorSpace::oklch,  ColorSpace::hsl,  ColorSpace::hsv,
                                 ColorSpace::hwb,    ColorSpace::lab,  ColorSpace::lch};

Color from_srgb(double r, double g, double b, double alpha = 1) {
  return from_space({Vec4(r, g, b, alpha), Vec4::Zero(), Vec4::Zero()}, ColorSpace::srgb).value;
}

// The spaces of the families that are offered here, by the names that culori and CSS have for them. Mixing in XYZ is
// mixing in linear light, of which it is a linear function.
ColorSpace space_of(const std::string& name) {
  static const std::pair<const char*, ColorSpace> names[] = {{"rgb", ColorSpace::srgb},
                                                             {"srgb", ColorSpace::srgb},
                                                             {"lrgb", ColorSpace::linear},
                                                             {"xyz", ColorSpace::linear},
                                                             {"srgb-linear", ColorSpace::linear},
                                                             {"xyz65", ColorSpace::linear},
                                                             {"oklab", ColorSpace::oklab},
                                                             {"oklch", ColorSpace::oklch},
                                                             {"lab", ColorSpace::lab},
                                                             {"lch", ColorSpace::lch},
                                                             {"hsl", ColorSpace::hsl},
                                                             {"hsv", ColorSpace::hsv},
                                                             {"hwb", ColorSpace::hwb}};
  for (const auto& entry : names)
    if (name == entry.first) return entry.second;
  FAIL("a space that is neither offered nor known as not offered: " << name);
  return ColorSpace::linear;
}

HueRule rule_of(const nlohmann::json& hue) {
  const std::string word = hue.is_string() ? hue.get<std::string>() : "shorter";
  return word == "longer"       ? HueRule::longer
         : word == "increasing" ? HueRule::increasing
         : word == "decreasing" ? HueRule::decreasing
                                : HueRule::shorter;
}

Color from_hex(const std::string& text) {
  const auto part = [&](std::size_t i) {
    return 1 + 2 * i < text.size() ? std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16) / 255.0 : 1.0;
  };
  return from_srgb(part(0), part(1), part(2), part(3));
}

// Whether a color without a hue is mixed with one that has a hue, the longer way: CSS goes all the way around there,
// culori does not move.
bool goes_around_from_none(const nlohmann::json& input) {
  if (rule_of(input["hue"]) != HueRule::longer) return false;
  const ColorSpace space = space_of(input["space"]);
  const auto& colors = input["colors"];
  const auto shows = [&](std::size_t i) { return has_hue(to_space(from_hex(colors[i]), space), space); };
  for (std::size_t i = 0; i + 1 < colors.size(); ++i)
    if (shows(i) != shows(i + 1)) return true;
  return false;
}

// How far culori is from the given colors at its own stops in Lab and LCH: its matrices there and back are rounded to
// eight digits and not inverse to each other (0.000004 for one part; 1e-9 in its other spaces). Ours are inverse.
double missed_stops(const nlohmann::json& file) {
  double most = 0;
  for (const auto& c : file["cases"]) {
    const auto& colors = c["input"]["colors"];
    const ColorSpace space = space_of(c["input"]["space"]);
    if (space != ColorSpace::lab && space != ColorSpace::lch) continue;
    for (const bool first : {true, false}) {
      const Vec4 given = to_space(from_hex(first ? colors.front() : colors.back()), ColorSpace::srgb);
      const auto& shown = first ? c["srgb"].front() : c["srgb"].back();
      for (std::size_t i = 0; i < 3; ++i)
        most = std::max(most, std::abs(given[static_cast<int>(i)] - shown[i].get<double>()));
    }
  }
  return most;
}

}  // namespace

TEST_CASE("coordinates agree with culori") {
  constexpr double degree = pi / 180;
  const std::set<std::string> not_offered = {"lab65", "lch65", "xyz65", "xyz50", "p3", "rec2020", "okhsl", "okhsv"};
  for (const auto& file : test::vector_family("color_convert")) {
    const double plain = test::tolerance(file), fine = test::stated(file, "tolerance", "lrgb");
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const std::vector<double> s = c["input"]["srgb"];
      // culori sets a and b of a gray to 0 by hand (convertRgbToLab.js); the matrices of CSS leave 8e-6 there.
      const bool gray = s[0] == s[1] && s[1] == s[2];
      for (const auto& member : c["value"].items()) {
        const std::string name = member.key();
        const auto& value = member.value();
        CAPTURE(name);
        if (not_offered.count(name) > 0) continue;
        if (name == "oklab_colorjs") {
          // The second implementation, whose matrices have other digits: 1e-5 off culori's, as the README says.
          const Vec4 found = to_space(from_srgb(s[0], s[1], s[2]), ColorSpace::oklab);
          for (int i = 0; i < 3; ++i)
            CHECK(test::near(found[i], value[static_cast<std::size_t>(i)].get<double>(), 1e-5));
          continue;
        }
        const ColorSpace space = space_of(name);
        const Vec4 found = to_space(from_srgb(s[0], s[1], s[2]), space);
        const int hue = hue_index(space);
        if (hue >= 0) CHECK(has_hue(found, space) == !value[static_cast<std::size_t>(hue)].is_null());
        for (int i = 0; i < 3; ++i) {
          const auto& number = value[static_cast<std::size_t>(i)];
          if (number.is_null()) continue;  // no hue
          const double expected = number;
          if (i == hue) {
            const double chroma = space == ColorSpace::hwb ? 1 - found[1] - found[2] : found[1];
            if (chroma < 1e-4) continue;
            CHECK(std::abs(std::remainder(found[i] / degree - expected, 360)) <= 1e-3);
          } else {
            const bool culoris_zero = gray && (space == ColorSpace::lab || space == ColorSpace::lch) && i > 0;
            const bool is_fine = space == ColorSpace::oklab || space == ColorSpace::linear;
            CHECK(test::near(found[i], expected, culoris_zero ? 1.2e-5 : is_fine ? fine : plain));
          }
        }
      }
    }
  }
}

TEST_CASE("mixing several colors agrees with culori in every space and by every hue rule") {
  for (const auto& file : test::vector_family("color_interpolate")) {
    const double tolerance = test::tolerance(file), lab_tolerance = tolerance + 2 * missed_stops(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      if (goes_around_from_none(c["input"])) continue;
      const ColorSpace space = space_of(c["input"]["space"]);
      const bool is_lab = space == ColorSpace::lab || space == ColorSpace::lch;
      std::vector<Key<Color>> keys;
      const auto& colors = c["input"]["colors"];
      for (std::size_t i = 0; i < colors.size(); ++i)
        keys.push_back(
            {static_cast<double>(i) / static_cast<double>(colors.size() - 1), from_hex(colors[i]), Ease::linear()});
      const Curve<Color> curve = keyed_curve<Color>(keys, {.space = space, .hue = rule_of(c["input"]["hue"])});
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        CAPTURE(c["t"][k].get<double>());
        const Vec4 found = to_space(curve.value(c["t"][k]), ColorSpace::srgb);
        for (int i = 0; i < 3; ++i)
          CHECK(test::near(found[i], c["srgb"][k][static_cast<std::size_t>(i)].get<double>(),
                           is_lab ? lab_tolerance : tolerance));
      }
    }
  }
}

TEST_CASE("mixing two colors with alpha agrees with Chromium in every space and by every hue rule") {
  for (const auto& file : test::vector_family("css_color_mix"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const ColorSpace space = space_of(c["input"]["space"]);
      const bool polar = space == ColorSpace::oklch || space == ColorSpace::lch;
      const double tolerance = polar ? test::stated(file, "tolerance", "lch") : test::tolerance(file);
      const Curve<Color> curve =
          keyed_curve<Color>({{0, from_hex(c["input"]["from"]), Ease::linear()}, {1, from_hex(c["input"]["to"])}},
                             {.space = space, .hue = rule_of(c["input"]["hue"])});
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        CAPTURE(c["t"][k].get<double>());
        const Vec4 found = to_space(curve.value(c["t"][k]), ColorSpace::srgb);
        const auto& expected = c["srgb"][k];
        for (std::size_t i = 0; i < expected.size(); ++i)
          CHECK(test::near(found[static_cast<int>(i)], expected[i].get<double>(), tolerance));
        if (expected.size() == 3) CHECK(found[3] == 1);
      }
    }
}

TEST_CASE("every space leads back to the color, with its rates") {
  test::Random random(6);
  for (const ColorSpace space : spaces)
    for (int n = 0; n < 50; ++n) {
      const Sample<Color> color{{Vec4(random.between(0.05, 1), random.between(0.05, 1), random.between(0.05, 1), 0.7)},
                                Vec4(0.3, -0.2, 0.5, 0.1),
                                Vec4(1, 2, -1, 0)};
      const Sample<Color> back = from_space(to_space(color, space), space);
      CHECK(test::near(back.value.rgba, color.value.rgba, 1e-12));
      CHECK(test::near(back.rate, color.rate, 1e-9));
      CHECK(test::near(back.acceleration, color.acceleration, 1e-6));
    }
}

TEST_CASE("a color curve is exact at its keys and its rates are those of its values") {
  const Color a = from_srgb(0.9, 0.2, 0.1), b = from_srgb(0.1, 0.3, 0.8, 0.5), c = from_srgb(0.4, 0.9, 0.3);
  for (const ColorSpace space : spaces) {
    const Curve<Color> curve =
        keyed_curve<Color>({{0, a, Ease::smooth()}, {1, b, Ease::smooth()}, {2, c}}, {.space = space});
    CHECK(curve.value(0) == a);
    CHECK(curve.value(1) == b);
    CHECK(curve.value(1, Side::in) == b);
    CHECK(curve.value(7) == c);
    CHECK(curve.knots().size() == 3);
    for (const double t : {0.137, 0.731, 1.519}) {
      const double h = 1e-5;
      const Vec4 stencil = (8 * (curve.value(t + h).rgba - curve.value(t - h).rgba) -
                            (curve.value(t + 2 * h).rgba - curve.value(t - 2 * h).rgba)) /
                           (12 * h);
      CHECK(test::near(curve.rate(t), stencil, 1e-7));
    }
  }
}

TEST_CASE("alpha is premultiplied: an invisible color lends nothing") {
  const Curve<Color> c = keyed_curve<Color>({{0, from_srgb(1, 0, 0), Ease::linear()}, {1, from_srgb(0, 0, 1, 0)}},
                                            {.space = ColorSpace::linear});
  CHECK(test::near(c.value(0.5).rgba, Vec4(1, 0, 0, 0.5), 1e-14));
}

TEST_CASE("a gray and an invisible color take the hue of the other end, on each side its own") {
  const Color red = from_srgb(1, 0, 0), gray = from_srgb(0.5, 0.5, 0.5), blue = from_srgb(0, 0, 1);
  for (const ColorSpace space :
       {ColorSpace::oklch, ColorSpace::hsl, ColorSpace::hsv, ColorSpace::hwb, ColorSpace::lch}) {
    const int hue = hue_index(space);
    const double red_hue = to_space(red, space)[hue], blue_hue = to_space(blue, space)[hue];
    for (const Ease& ease : {Ease::linear(), Ease::smooth()}) {
      const Curve<Color> curve = keyed_curve<Color>({{0, red, ease}, {1, gray, ease}, {2, blue}}, {.space = space});
      CHECK(std::abs(std::remainder(to_space(curve.value(0.5), space)[hue] - red_hue, 6.283185307179586)) < 1e-6);
      CHECK(std::abs(std::remainder(to_space(curve.value(1.5), space)[hue] - blue_hue, 6.283185307179586)) < 1e-6);
      CHECK(curve.value(1) == gray);
    }
    const Color invisible = from_srgb(0, 1, 0, 0);
    const Curve<Color> fading = keyed_curve<Color>({{0, red, Ease::linear()}, {1, invisible}}, {.space = space});
    const Vec4 half = to_space(fading.value(0.5), ColorSpace::srgb);
    CHECK(test::near(half, Vec4(1, 0, 0, 0.5), 1e-6));
  }
}

TEST_CASE("a color out of gamut is told, and brought in by clipping or by less chroma") {
  const Vec4 none = Vec4::Zero();
  CHECK(in_gamut(from_srgb(1, 0, 0.3)));
  CHECK_FALSE(in_gamut(from_srgb(1.01, 0, 0.3)));
  CHECK(in_gamut(from_srgb(1.01, 0, 0.3), 0.03));
  CHECK(clipped(Color{Vec4(1.5, -0.2, 0.4, 2)}) == Color{Vec4(1, 0, 0.4, 1)});
  const Color inside = from_srgb(0.2, 0.9, 0.4, 0.5);
  CHECK(reduced_chroma(inside) == inside);
  test::Random random(8);
  for (int n = 0; n < 100; ++n) {
    const Vec4 polar(random.between(0.1, 0.95), random.between(0.1, 0.4), random.between(-3, 3), 1);
    const Color vivid = from_space({polar, none, none}, ColorSpace::oklch).value;
    const Color shown = reduced_chroma(vivid);
    CHECK(in_gamut(shown));
    if (in_gamut(vivid)) continue;
    const Vec4 found = to_space(shown, ColorSpace::oklch);
    CHECK(found[1] < polar[1] + 0.02);
    // Clipping what is left moves by less than a just noticeable difference, 0.02 in OKLab.
    CHECK(std::abs(found[0] - polar[0]) < 0.02);
    CHECK(std::abs(std::remainder(found[2] - polar[2], 6.283185307179586)) * found[1] < 0.02);
  }
  CHECK(reduced_chroma(from_space({Vec4(1.2, 0.1, 1, 1), none, none}, ColorSpace::oklch).value) ==
        Color{Vec4(1, 1, 1, 1)});
}

TEST_CASE("the longer way between equal hues is all the way around, upward, as CSS has it") {
  const auto hue_at = [](const Curve<Color>& curve, double t, ColorSpace space) {
    return to_space(curve.value(t), space)[hue_index(space)];
  };
  const Color red = from_srgb(1, 0, 0), dark = from_srgb(0.5, 0, 0), gray = from_srgb(0.5, 0.5, 0.5),
              unseen = from_srgb(0, 0, 1, 0);
  for (const ColorSpace space : {ColorSpace::hsl, ColorSpace::hsv, ColorSpace::hwb, ColorSpace::lch, ColorSpace::oklch})
    for (const auto& pair :
         {std::pair{red, red}, {red, dark}, {dark, red}, {red, gray}, {gray, red}, {red, unseen}, {unseen, red}}) {
      const Color from = pair.first, to = pair.second;
      CAPTURE(static_cast<int>(space));
      // A darker red has another hue in CIE LCH.
      if (space == ColorSpace::lch && from.rgba != to.rgba && from.rgba[3] > 0 && to.rgba[3] > 0 &&
          has_hue(to_space(from, space), space) && has_hue(to_space(to, space), space))
        continue;
      const Color& shown = has_hue(to_space(from, space), space) && from.rgba[3] > 0 ? from : to;
      const double start = to_space(shown, space)[hue_index(space)];
      const auto turned = [&](HueRule rule, double t) {
        const std::vector<Key<Color>> keys = {{0, from, Ease::linear()}, {1, to}};
        return std::remainder(hue_at(keyed_curve<Color>(keys, {.space = space, .hue = rule}), t, space) - start,
                              2 * pi);
      };
      CHECK(turned(HueRule::longer, 0.25) == doctest::Approx(pi / 2).epsilon(1e-4));
      CHECK(std::abs(turned(HueRule::longer, 0.5)) == doctest::Approx(pi).epsilon(1e-4));
      CHECK(turned(HueRule::longer, 0.75) == doctest::Approx(-pi / 2).epsilon(1e-4));
      for (const HueRule rule : {HueRule::shorter, HueRule::increasing, HueRule::decreasing})
        CHECK(std::abs(turned(rule, 0.5)) < 1e-4);
    }
  // Two colors without a hue have none to turn, and every span of equal colors turns once more.
  const std::vector<Key<Color>> grays = {{0, gray, Ease::linear()}, {1, from_srgb(1, 1, 1)}};
  const Color between = keyed_curve<Color>(grays, {.space = ColorSpace::hsl, .hue = HueRule::longer}).value(0.5);
  CHECK(between.rgba[0] == doctest::Approx(between.rgba[2]));
  std::vector<Key<Color>> many;
  for (int i = 0; i < 200; ++i) many.push_back({static_cast<double>(i), red, Ease::linear()});
  const Curve<Color> around = keyed_curve<Color>(many, {.space = ColorSpace::hsl, .hue = HueRule::longer});
  for (int i = 0; i < 199; ++i) CHECK(test::near(around.value(i + 0.5).rgba, Vec4(0, 1, 1, 1), 1e-9));
}

TEST_CASE("between opposite hues the shorter and the longer way are as the numbers go, as CSS has it") {
  const Color red = from_srgb(1, 0, 0), cyan = from_srgb(0, 1, 1), blue = from_srgb(0, 0, 1),
              yellow = from_srgb(1, 1, 0);
  const auto hue_between = [](const Color& from, const Color& to, HueRule rule) {
    const std::vector<Key<Color>> keys = {{0, from, Ease::linear()}, {1, to}};
    const Curve<Color> curve = keyed_curve<Color>(keys, {.space = ColorSpace::hsl, .hue = rule});
    const double hue = to_space(curve.value(0.5), ColorSpace::hsl)[hue_index(ColorSpace::hsl)] * 180 / pi;
    return hue < 0 ? hue + 360 : hue;
  };
  for (const HueRule rule : {HueRule::shorter, HueRule::longer}) {
    CHECK(hue_between(red, cyan, rule) == doctest::Approx(90));
    CHECK(hue_between(cyan, red, rule) == doctest::Approx(90));
    CHECK(hue_between(yellow, blue, rule) == doctest::Approx(150));
    CHECK(hue_between(blue, yellow, rule) == doctest::Approx(150));
  }
}
