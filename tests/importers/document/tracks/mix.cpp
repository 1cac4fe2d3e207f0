#include "importers/document/document_files.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("a track mixes its values by weights that are tracks, each a part of their sum") {
  const std::string weights = R"("weights": [[[0, 1, "linear"], [2, 0]], [[0, 0, "linear"], [2, 3]]])";
  // At 1 s the weights are 0.5 and 1.5, so that a quarter of the first is left.
  const Curve<double> number = curve_of<double>("a.b", R"({"barycentric": {"values": [2, 6], )" + weights + "}}");
  CHECK(number.value(0) == 2);
  CHECK(number.value(1) == doctest::Approx(5).epsilon(1e-15));
  CHECK(number.value(2) == 6);
  // w = 1.5 t / (1 + t), and w' = 1.5 / (1 + t)^2, of the second, by hand.
  CHECK(number.rate(1) == doctest::Approx(4 * 1.5 / 4).epsilon(1e-14));
  CHECK(clip_of("a.b", R"({"barycentric": {"values": [2, 6], )" + weights + "}}").duration == 2);

  const Curve<Vec3> place =
      curve_of<Vec3>("a.position", R"({"barycentric": {"values": [[0, 0, 0], [4, 0, 8]], )" + weights + "}}");
  CHECK(near(place.value(1), Vec3(3, 0, 6), 1e-15));
  const Curve<Vec2> plane = curve_of<Vec2>("a.uv", R"({"barycentric": {"values": [[0, 0], [4, 8]], )" + weights + "}}");
  CHECK(near(plane.value(1), Vec2(3, 6), 1e-15));
  const Curve<Color> color = curve_of<Color>(
      "a.color", R"({"space": "linear", "barycentric": {"values": ["#000", "#fff"], )" + weights + "}}");
  CHECK(near(color.value(1).rgba, Vec4(0.75, 0.75, 0.75, 1), 1e-15));

  // Three quarters of a turn of 80 degrees, as rotations and as an angle.
  const Quat expected(std::cos(30 * degree), 0, 0, std::sin(30 * degree));
  const Curve<Quat> turn = curve_of<Quat>(
      "a.rotation", R"({"barycentric": {"values": [{"euler": [0, 0, 0]}, {"euler": [0, 0, 80]}], )" + weights + "}}");
  CHECK(near(turn.value(1), expected, 1e-12));
  const Curve<Quat> angle =
      curve_of<Quat>("a.rotation", R"({"axis": "z", "barycentric": {"values": [0, 80], )" + weights + "}}");
  CHECK(near(angle.value(1), expected, 1e-15));
  CHECK(near(angle.rate(1), Vec3(0, 0, 80 * degree * 1.5 / 4), 1e-13));
}

TEST_CASE("the weights of a mix are functions too, and a mix of functions alone is endless") {
  const std::string track = R"json({"barycentric": {"values": [0, 10], "weights": [1, {"expression": "t^2"}]}})json";
  CHECK_THROWS_AS((void)clip_of("a.b", track), DocumentError);  // a number alone is no track
  const std::string mended =
      R"json({"barycentric": {"values": [0, 10], "weights": [{"expression": "1"}, {"expression": "t^2"}]}})json";
  CHECK(curve_of<double>("a.b", mended).value(3) == doctest::Approx(9).epsilon(1e-15));
  CHECK(std::isinf(clip_of("a.b", mended).duration));
}

TEST_CASE("an aspect ratio keeps the area, and goes by its logarithm") {
  const Curve<Vec3> scale = curve_of<Vec3>("a.scale", R"({"aspect": [[0, 0.25, "linear"], [2, 4]]})");
  CHECK(near(scale.value(0), Vec3(0.5, 2, 1), 1e-15));
  CHECK(near(scale.value(1), Vec3(1, 1, 1), 1e-15));
  for (const double t : {0.0, 0.3, 1.1, 2.0}) {
    const Sample<Vec3> s = scale.sample(t);
    CHECK(s.value.x() * s.value.y() == doctest::Approx(1).epsilon(1e-15));
    CHECK(std::abs(s.rate.x() * s.value.y() + s.value.x() * s.rate.y()) < 1e-14);
  }
  CHECK(clip_of("a.scale", R"({"aspect": [[0, 0.25, "linear"], [2, 4]]})").duration == 2);
}
