#include <tweenfall/curves/ease.h>
#include <tweenfall/curves/keys.h>

#include <map>

#include "curves/stated.h"

using namespace tweenfall;

namespace {

// The document's word for one of d3's functions; empty if there is none.
std::string word_of(const nlohmann::json& input) {
  static const std::map<std::string, std::string> families = {
      {"Quad", "quad"}, {"Cubic", "cubic"},     {"Sin", "sine"},      {"Exp", "expo"}, {"Circle", "circ"},
      {"Back", "back"}, {"Elastic", "elastic"}, {"Bounce", "bounce"}, {"Poly", "poly"}};
  std::string name = input["fn"].get<std::string>().substr(4);
  std::string flow;
  for (const auto& [suffix, spelled] :
       {std::pair<std::string, std::string>{"InOut", "-in-out"}, {"In", "-in"}, {"Out", "-out"}})
    if (flow.empty() && name.size() > suffix.size() && name.substr(name.size() - suffix.size()) == suffix) {
      flow = spelled;
      name = name.substr(0, name.size() - suffix.size());
    }
  if (flow.empty()) flow = name == "Elastic" || name == "Bounce" ? "-out" : "-in-out";
  const auto found = families.find(name);
  if (found == families.end()) return "";
  std::string word = found->second + flow;
  if (input.contains("exponent")) word += "(" + input["exponent"].dump() + ")";
  if (input.contains("overshoot")) word += "(" + input["overshoot"].dump() + ")";
  if (input.contains("amplitude")) word += "(" + input["amplitude"].dump() + "," + input["period"].dump() + ")";
  return word;
}

void check_progress(const Ease& ease, const nlohmann::json& c, double tolerance) {
  for (std::size_t i = 0; i < c["t"].size(); ++i) {
    CAPTURE(c["t"][i].get<double>());
    // The leaving value at the end of a shape is the next key's; if the shape ends elsewhere, that is the arriving
    // value.
    const double t = c["t"][i];
    const Side side = t == 1 && ease.name().rfind("linear(", 0) == 0 ? Side::in : Side::out;
    CHECK(std::abs(ease.progress(t, side).value - c["value"][i].get<double>()) <= tolerance);
  }
}

}  // namespace

TEST_CASE("the Penner families agree with d3-ease") {
  for (const auto& file : test::vector_family("easing_d3"))
    for (const auto& c : file["cases"]) {
      const std::string name = c["name"], word = word_of(c["input"]);
      CAPTURE(name);
      // Its linear is a rule here; the shape of that name has stops.
      const auto ease = Ease::named(word.empty() ? "linear(0,1)" : word);
      CHECK((!word.empty() || c["input"]["fn"] == "easeLinear"));
      REQUIRE(ease.has_value());
      check_progress(*ease, c, test::tolerance(file));
    }
}

TEST_CASE("steps, stops and Beziers agree with Chromium") {
  for (const auto& file : test::vector_family("css_easing"))
    for (const auto& c : file["cases"]) {
      const std::string name = c["name"];
      std::string css = c["input"]["css"];
      CAPTURE(css);
      if (css == "step-start") css = "steps(1,jump-start)";
      if (css == "step-end") css = "steps(1,jump-end)";
      if (css.rfind("cubic-", 0) == 0) css = css.substr(6);
      for (const std::string edge : {"start", "end"}) {
        const std::size_t at = css.find(", " + edge);
        if (css.rfind("steps", 0) == 0 && at != std::string::npos) css = css.substr(0, at) + ",jump-" + edge + ")";
      }
      if (css == "linear") css = "linear(0, 1)";  // the word alone is a rule, not a shape
      const auto ease = Ease::named(css);
      REQUIRE(ease.has_value());
      const bool steep = name == "bezier_steep" || name == "bezier_start_vertical";
      check_progress(*ease, c, steep ? test::stated(file, "bezier", "1e-6;") : test::tolerance(file));
    }
}

TEST_CASE("Beziers agree with bezier-easing") {
  for (const auto& file : test::vector_family("easing_bezier")) {
    const double tolerance = test::stated(file, "note", "allow"), steep = test::stated(file, "note", "and");
    for (const auto& c : file["cases"]) {
      const auto& in = c["input"];
      CAPTURE(c["name"].get<std::string>());
      const Ease ease = Ease::bezier(in["x1"], in["y1"], in["x2"], in["y2"]);
      for (std::size_t i = 0; i < c["t"].size(); ++i) {
        const double t = c["t"][i];
        CAPTURE(t);
        const Sample<double> s = ease.progress(t);
        CHECK(std::abs(s.value - c["value"][i].get<double>()) <= (std::abs(s.rate) > 10 ? steep : tolerance));
      }
    }
  }
}

TEST_CASE("every plain word is known, and its name reads back as the same ease") {
  for (const std::string& form : Ease::names()) {
    CAPTURE(form);
    std::string word = form.substr(0, form.find('('));
    if (form.ends_with("bezier(x1,y1,x2,y2)")) word = "bezier(0.4, 0, 0.2, 1)";
    if (form == "steps(count,jump)") word = "steps(4,jump-end)";
    if (form == "spring(period,damping)") word = "spring(0.3s,0.5)";
    if (form == "tcb(tension,continuity,bias)") word = "tcb(0,0.5,-1)";
    if (form == "natural(start,end)") word = "natural(0.5, -2)";
    if (form == "clamped(start,end)") word = "clamped(0.1, 7)";
    if (form == "linear(stop,...)") word = "linear(0, 25% 0.1 33.9%, 0.7, 1.5 60%)";
    if (form == "poly-in(exponent)") word = "poly-in(1.3)";
    const auto ease = Ease::named(word);
    REQUIRE(ease.has_value());
    const auto again = Ease::named(ease->name());
    REQUIRE(again.has_value());
    CHECK(*again == *ease);
  }
}

TEST_CASE("a word that is none, or a number out of range, is refused with a reason") {
  const auto reason = [](const char* word) {
    std::string text;
    CHECK_FALSE(Ease::named(word, &text).has_value());
    return text;
  };
  CHECK(reason("wobble").find("\"wobble\"") != std::string::npos);
  CHECK(reason("bezier(2,0,0,1)").find("0 to 1") != std::string::npos);
  CHECK(reason("bezier(0,0,1)").find("3 values were given") != std::string::npos);
  CHECK(reason("steps(1.5,jump-end)").find("whole number") != std::string::npos);
  CHECK(reason("steps(1,jump-none)").find("from 2") != std::string::npos);
  CHECK(reason("steps(3,sideways)").find("jump-start") != std::string::npos);
  CHECK(reason("back-in(x)").find("not a number") != std::string::npos);
  CHECK(reason("quad-in(2)").find("takes no numbers") != std::string::npos);
  CHECK(reason("spring(0s,1)").find("period") != std::string::npos);
  CHECK(reason("").find("no ease") != std::string::npos);
  CHECK(reason("linear()").find("at least one stop") != std::string::npos);
  CHECK(reason("linear(0, 10%, 1)").find("no output") != std::string::npos);
  CHECK(reason("linear(0, 0.5 10% 20% 30%, 1)").find("one or two percentages") != std::string::npos);
  CHECK(reason("linear(0, 0.5 0.6, 1)").find("\"0.5 0.6\"") != std::string::npos);
  CHECK(reason("linear(0, , 1)").find("no output") != std::string::npos);
  CHECK(reason("poly-in(0)").find("exponent") != std::string::npos);
  CHECK(reason("natural(1)").find("1 value was given") != std::string::npos);
  CHECK(reason("clamped(x,1)").find("not a number") != std::string::npos);
}

TEST_CASE("a spring follows its differential equation once what is left over is negligible") {
  const Ease ease = Ease::spring(0.1, 0.5);
  const double w = 2 * std::acos(-1.0) / 0.1;
  for (const double t : {0.01, 0.05, 0.2, 0.6}) {
    const Sample<double> s = ease.progress(t);
    CHECK(std::abs(s.acceleration + 2 * 0.5 * w * s.rate + w * w * (s.value - 1)) < 1e-8);
  }
  CHECK(ease.progress(0).value == 0);
  CHECK(ease.progress(1, Side::in).value == 1);
}

TEST_CASE("a power's rates are those of its exponent, and stay finite where they would not be") {
  const Ease ease = Ease::named("poly-in(2.5)").value();
  for (const double u : {0.1, 0.5, 1.0}) {
    const Sample<double> s = ease.progress(u, Side::in);
    CHECK(s.value == doctest::Approx(std::pow(u, 2.5)).epsilon(1e-14));
    CHECK(s.rate == doctest::Approx(2.5 * std::pow(u, 1.5)).epsilon(1e-14));
    CHECK(s.acceleration == doctest::Approx(3.75 * std::sqrt(u)).epsilon(1e-14));
  }
  for (const char* word : {"poly-in(0.2)", "poly-out(0.2)", "poly-in(1.01)", "poly-in-out(300)"})
    for (const double u : {0.0, 1e-300, 1e-9, 0.5, 1 - 1e-9, 1.0}) {
      const Sample<double> s = Ease::named(word).value().progress(u, Side::in);
      CHECK(std::isfinite(s.value));
      CHECK(std::isfinite(s.rate));
      CHECK(std::isfinite(s.acceleration));
    }
}

TEST_CASE("one stop holds its output, and a stop at the wrong place moves to the one before it") {
  const Ease still = Ease::named("linear(0.25)").value();
  CHECK(still.progress(0).value == 0.25);
  CHECK(still.progress(1, Side::in).value == 0.25);
  const Ease pushed = Ease::named("linear(0, 0.5 60%, 0.75 40%, 1)").value();
  CHECK(pushed.progress(0.6, Side::in).value == doctest::Approx(0.5));
  CHECK(pushed.progress(0.6).value == doctest::Approx(0.75));
}

TEST_CASE("the names that CSS has for eases are read") {
  const auto name = [](const char* word) { return Ease::named(word).value().name(); };
  CHECK(name("cubic-bezier(0.4, 0, 0.2, 1)") == "bezier(0.4,0,0.2,1)");
  CHECK(name("steps(3, start)") == "steps(3,jump-start)");
  CHECK(name("steps(3, end)") == "steps(3,jump-end)");
  CHECK(Ease::named("step-start")->progress(0.3).value == 1);
  CHECK(Ease::named("step-end")->progress(0.7).value == 0);
  for (const char* word : {"ease", "ease-in", "ease-out", "ease-in-out", "step-start", "step-end"})
    CHECK(name(word) == word);
}

TEST_CASE("a name that other programs have for an ease is answered with ours") {
  constexpr const char* cases[][2] = {{"easeInQuad", "quad-in"},
                                      {"Linear.easeNone", "linear"},
                                      {"Linear.easeInOut", "linear"},
                                      {"easeLinear", "linear"},
                                      {"Strong.easeOut", "quint-out"},
                                      {"Regular.easeIn", "quad-in"},
                                      {"easeOutBounce", "bounce-out"},
                                      {"InOutCubic", "cubic-in-out"},
                                      {"quadIn", "quad-in"},
                                      {"Sine.easeInOut", "sine-in-out"},
                                      {"power2.inOut", "cubic-in-out"},
                                      {"SINE", "sine-in"},
                                      {"BACK", "back-out"},
                                      {"BEZIER", "smooth-clamped"},
                                      {"AUTO_CLAMPED", "smooth-clamped"},
                                      {"VECTOR", "linear"},
                                      {"easy ease", "ease-in-out"},
                                      {"CONSTANT", "hold"},
                                      {"LINEAR", "linear"},
                                      {"spline", "smooth"},
                                      {"plateau", "smooth-clamped"},
                                      {"stepped", "hold"},
                                      {"fixed", "smooth"},
                                      {"easeInOut", "ease-in-out"},
                                      {"stepStart", "step-start"},
                                      {"catmullRom", "catmull-rom"},
                                      {"InterpolateSmooth", "smooth"},
                                      {"InterpolateDiscrete", "hold"},
                                      {"TWEEN.Easing.Quadratic.Out", "quad-out"},
                                      {"easeOutElastic(1,.6)", "elastic-out(1,.6)"},
                                      {"cubicBezier(0.1,0,1,1)", "cubic-bezier(0.1,0,1,1)"}};
  for (const auto& names : cases) {
    const char *theirs = names[0], *ours = names[1];
    CAPTURE(theirs);
    std::string reason;
    CHECK_FALSE(Ease::named(theirs, &reason).has_value());
    CHECK(reason.find("\"" + std::string(ours) + "\"") != std::string::npos);
    CHECK(Ease::ours(theirs) == ours);
    CHECK(Ease::named(ours).has_value());
  }
  for (const char* word : {"", "wobble", "in", "ease", "quad-in", "(", "in-out"}) CHECK(Ease::ours(word).empty());
}

TEST_CASE("eases with absurd numbers are refused, those at the edge of what is taken are finite everywhere") {
  for (const char* word :
       {"spring(0.3s,1e300)", "spring(1e-300s,1)", "spring(1e300s,1)", "back-in(-1e300)", "poly-in(1e300)",
        "poly-in(1e-300)", "elastic-in(1e300,1)", "elastic-in(1,1e-300)", "penner-elastic-out(-1e300,1)",
        "bezier(0,1e300,1,1)", "linear(0,1e300)", "linear(0,0.5 1e300%,1)", "tcb(1e300,0,0)"}) {
    CAPTURE(word);
    std::string reason;
    CHECK_FALSE(Ease::named(word, &reason).has_value());
    CHECK(reason.find("must lie in") != std::string::npos);
  }
  for (const char* word :
       {"spring(1e-6s,1e6)", "spring(1e6s,0)", "spring(1e-6s,5e-324)", "back-in-out(-1e6)", "back-out(5e-324)",
        "poly-in(1e6)", "poly-out(1e-6)", "poly-in(1.0000000000000002)", "elastic-in-out(1e6,1e-6)",
        "penner-elastic-in(1e6,1e-6)", "penner-elastic-in(0,1)", "penner-elastic-in(5e-324,1e6)",
        "bezier(0,1e6,0,-1e6)", "bezier(1,0,0,1)", "bezier(5e-324,0,1,1)", "linear(-1e6,1e6 5e-324%,1)",
        "linear(0,1 50%,2 50.00000000000001%,3)", "steps(100000,jump-both)"}) {
    CAPTURE(word);
    const Ease ease = Ease::named(word).value();
    const auto is_finite = [](const Sample<double>& s) {
      return std::isfinite(s.value) && std::isfinite(s.rate) && std::isfinite(s.acceleration);
    };
    bool finite = true;
    const Curve<double> slow = keyed_curve<double>({{0, -1e6, ease}, {1e6, 1e6}});
    const Curve<double> fast = keyed_curve<double>({{1, -1e6, ease}, {1 + 0x1p-52, 1e6}});
    for (int i = 0; i <= 2000; ++i)
      for (const Side side : {Side::in, Side::out}) {
        const double u = i / 2000.0;
        finite = finite && is_finite(ease.progress(u, side)) && is_finite(slow.sample(1e6 * u, side)) &&
                 is_finite(fast.sample(1 + u * 0x1p-52, side));
      }
    CHECK(finite);
  }
}
