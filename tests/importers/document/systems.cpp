#include <tweenfall/importers/portrait_plot.h>

#include "importers/document/document_files.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::string spring(const std::string& integrator) {
  return R"json({"tweenfall": 1, "systems": {"spring": {
    "state": {"x": 1, "v": 0}, "rates": {"x": "v", "v": "-k*x"}, "parameters": {"k": 4},
    "energy": "(v^2 + k*x^2)/2", "integrator": ")json" +
         integrator + R"json(", "step": "1/100", "duration": 10}}})json";
}

const Curve<double>& track(const Document& document, const std::string& name) {
  for (const Track& each : document.stage().clips.at(0).tracks)
    if (each.name() == name) return std::get<Curve<double>>(each.curve);
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("a system written as formulas goes as its closed form, with its rates") {
  const Document document = parsed(spring("rk4"));
  REQUIRE(document.stage().clips.size() == 1);
  CHECK(document.stage().clips[0].name == "spring");
  CHECK(document.stage().clips[0].duration == 10);
  const Curve<double>&x = track(document, "spring.x"), &v = track(document, "spring.v");
  for (int k = 0; k <= 1000; k += 7) {
    const double t = k / 100.0;
    CHECK(near(x.value(t), std::cos(2 * t), 1e-7));
    CHECK(near(v.value(t), -2 * std::sin(2 * t), 1e-7));
    // The rate is the formula's, not a difference: that of x is v to the bit.
    CHECK(x.sample(t).rate == doctest::Approx(v.value(t)).epsilon(1e-12));
  }
  CHECK(near(x.value(3.14159), std::cos(6.28318), 1e-7));
  CHECK(near(track(document, "spring.energy").value(10), 2, 1e-7));
}

TEST_CASE("explicit Euler spirals out by 1 + (h w)^2 per step, backward Euler in, and verlet stays") {
  const double grown = std::pow(1 + 0.02 * 0.02, 1000);
  CHECK(near(track(parsed(spring("explicit-euler")), "spring.energy").value(10), 2 * grown, 1e-11));
  CHECK(near(track(parsed(spring("backward-euler")), "spring.energy").value(10), 2 / grown, 1e-9));
  CHECK(near(track(parsed(spring("verlet")), "spring.energy").value(10), 2, 1e-3));
}

TEST_CASE("hunters and prey come round: Lotka and Volterra's constant is kept") {
  // V = d x - c ln x + b y - a ln y. Source: Volterra, 1926; Hairer, Lubich, Wanner, Geometric Numerical Integration,
  // I.1.
  const Document document = parsed(R"json({"tweenfall": 1, "systems": {"island": {
    "state": {"prey": 2, "hunters": 1}, "rates": {"prey": "prey*(a - hunters)", "hunters": "hunters*(prey - 1)"},
    "parameters": {"a": 2}, "energy": "prey - log(prey) + hunters - a*log(hunters)", "step": 0.005, "duration": 20}}})json");
  const Curve<double>& constant = track(document, "island.energy");
  for (double t = 0; t <= 20; t += 0.5) CHECK(near(constant.value(t), constant.value(0), 1e-9));
}

TEST_CASE("a system drives nodes: places, and an angle in degrees") {
  const Document document = parsed(R"json({"tweenfall": 1,
    "nodes": {"bob": {}, "arm": {}},
    "systems": {"swing": {"state": {"angle": 1, "rate": 0}, "rates": {"angle": "rate", "rate": "-9.81*sin(angle)"},
      "duration": 3, "tracks": {"bob.position": ["sin(angle)", "-cos(angle)", 0], "arm.rotation.z": "angle*180/pi",
                                "arm.height": "1-cos(angle)"}}}})json");
  const std::vector<Track>& tracks = document.stage().clips.at(0).tracks;
  REQUIRE(tracks.size() == 3);
  REQUIRE(document.stage().plays.size() == 1);
  const Sample<double> angle = std::get<Curve<double>>(tracks[1].curve).sample(1.2);
  const Sample<Vec3> bob = std::get<Curve<Vec3>>(tracks[0].curve).sample(1.2);
  CHECK(near(bob.value, Vec3(std::sin(angle.value), -std::cos(angle.value), 0), 1e-12));
  CHECK(near(bob.rate, Vec3(std::cos(angle.value), std::sin(angle.value), 0) * angle.rate, 1e-12));
  // At any amplitude the pendulum has a closed form, which the curves have.
  const Document exact = parsed(
      R"json({"tweenfall": 1, "clips": {"a": {"duration": 3, "tracks": {"b.c": {"pendulum": {"angle": 57.29577951308232}}}}}})json");
  for (double t = 0; t <= 3; t += 0.25) {
    const double degrees = std::get<Curve<double>>(exact.stage().clips[0].tracks[0].curve).value(t);
    CHECK(near(std::get<Curve<double>>(tracks[1].curve).value(t), degrees * pi / 180, 1e-6));
  }
}

TEST_CASE("a portrait shows the ways, the field and the energy, the same text each time") {
  const Document document = parsed(R"json({"tweenfall": 1, "systems": {
    "spiral": {"state": {"x": 1, "v": 0}, "rates": {"x": "v", "v": "-x - 0.2*v"}, "starts": [{"x": 2}, {"v": -1.5}],
               "energy": "(x^2 + v^2)/2"},
    "growth": {"state": {"n": 0.01}, "rates": {"n": "n*(1-n)"}},
    "blown": {"state": {"x": 1}, "rates": {"x": "x"}, "starts": [{"x": 1e300}], "portrait": ["t", "x"], "duration": 30}}})json");
  REQUIRE(document.systems().size() == 3);
  CHECK(document.systems()[1].across == 0);
  const std::string svg = portrait_svg(document.systems());
  CHECK(svg == portrait_svg(document.systems()));
  CHECK(count(svg, "<polyline") == 3 + 1 + 1 + 2);
  CHECK(count(svg, "<path") == 3);
  CHECK(count(svg, "nan") + count(svg, "inf") == 0);
  CHECK(svg.size() < 400000);
}
