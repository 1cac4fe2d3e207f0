// What tracks in documents mean: kinds of values, rates, tangents, modifiers.

#include "importers/document/document_files.h"

#include <tweenfall/curves/keys.h>

#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("runs of one rule know their ends, and slopes in an ease are in the track's unit") {
  const Document document = good_document("runs");
  const Clip& clip = document.stage().clips.at(0);
  const Curve<double>& height = curve_of<double>(clip, "wheel.height");
  const Sample<double> arriving = height.sample(4, Side::in), leaving = height.sample(0);
  CHECK(near(arriving.rate, leaving.rate, 1e-12));
  CHECK(near(arriving.acceleration, leaving.acceleration, 1e-12));
  CHECK(near(curve_of<Quat>(clip, "wheel.rotation").rate(0), Vec3(0, 0, 90 * degree), 1e-12));
  CHECK(near(curve_of<Quat>(clip, "wheel.rotation").rate(2, Side::in), Vec3(0, 0, -45 * degree), 1e-12));
  CHECK(near(curve_of<Vec3>(clip, "wheel.position").rate(0), Vec3(0, 0, 0), 1e-15));
  CHECK(near(curve_of<Vec3>(clip, "wheel.position").rate(3, Side::in), Vec3(0, 0, 0), 1e-12));
  const Curve<double>& glow = curve_of<double>(clip, "wheel.glow");
  CHECK(near(glow.value(0.5), 2, 1e-15));
  CHECK(glow.value(1, Side::in) == 4);
  CHECK(glow.value(1) == 5);
  CHECK(near(glow.value(2.25), 5 - 5 * 0.125, 1e-14));
}

TEST_CASE("tracks of every kind are read as their kind") {
  const Document document = good_document("everything");
  const Clip& clip = document.stage().clips.at(0);
  CHECK(near(curve_of<Vec3>(clip, "ball.scale").value(0.5), Vec3(2, 2, 2), 1e-12));
  const WeightCurves& weights = std::get<WeightCurves>(track_of(clip, "ball.weights").curve);
  REQUIRE(weights.size() == 2);
  CHECK(near(weights[0].rate(1, Side::in), 0.5, 1e-12));
  CHECK(weights[1].value(0) == 1);
  // Half of the long way from 0 to 90 degrees is -135.
  CHECK(near(curve_of<Quat>(clip, "tower/2.rotation").value(0.5),
             Quat(std::cos(-67.5 * degree), 0, 0, std::sin(-67.5 * degree)), 1e-12));
  CHECK(near(curve_of<Quat>(clip, "late.rotation").rate(0.5), Vec3(0, 0, 720 * degree), 1e-9));
  // 10 + 30 cos(4 pi t + 90 degrees) exp(-t / 2) degrees at 0: 10 degrees, falling at 30 * 4 pi degrees per second.
  const Curve<Quat>& swing = curve_of<Quat>(clip, "base.rotation");
  CHECK(near(swing.value(0), Quat(std::cos(5 * degree), 0, std::sin(5 * degree), 0), 1e-12));
  CHECK(near(swing.rate(0), Vec3(0, -30 * degree * 4 * std::numbers::pi, 0), 1e-9));
  CHECK(near(curve_of<Vec3>(clip, "base.position").value(0.5), Vec3(-1, 1, 0), 1e-12));
  CHECK(near(curve_of<Vec3>(clip, "late.position").value(2), Vec3(2, 1 + 4 - 20, 0), 1e-12));
  CHECK(near(curve_of<double>(clip, "ball.glow").value(0.5), 2.5, 1));
  CHECK(near(curve_of<double>(clip, "ball.wobble").value(0), 2, 1e-15));
  CHECK(near(curve_of<Vec2>(clip, "ball.uv").value(1), Vec2(1, 2), 1e-15));
  CHECK(near(curve_of<Vec4>(clip, "ball.aim").value(3), Vec4(0, 0, 1, 0), 1e-15));
  CHECK(near(curve_of<Color>(clip, "ball.tint").value(0.5).rgba, Vec4(0.5, 0.5, 0.5, 1), 1e-12));
  const auto& lit = std::get<StepCurve<bool>>(track_of(clip, "ball.lit").curve);
  CHECK_FALSE(lit.value(0.4));
  CHECK(lit.value(0.6));
  CHECK(std::get<StepCurve<std::string>>(track_of(clip, "ball.word").curve).value(0.7) == "right");
  CHECK(std::get<StepCurve<std::string>>(track_of(clip, "ball.label").curve).value(1) == "#2");
  CHECK(document.stage().clips.at(1).tracks.size() == 1);  // names that are free are no tracks

  REQUIRE(clip.events.size() == 3);
  CHECK(clip.events[0].name == "early");  // equal times keep their order
  CHECK(clip.events[1].name == "loud");
  CHECK(clip.events[1].to == 1);
  CHECK(clip.events[1].data == "[1, \"two\"]");
  CHECK(clip.events[2].data == "{\"strength\": 2}");
}

TEST_CASE("rates of angles give the angular velocity that was asked for, in every order") {
  for (const std::string order : {"XYZ", "ZXY", "YXY", "xyz", "zyx", "yzy"}) {
    CAPTURE(order);
    const Document document =
        parsed(R"({"tweenfall": 1, "clips": {"a": {"tracks": {"b.rotation": {"order": ")" + order +
               R"(", "keys": [[0, {"euler": [0, 0, 0]}], {"t": 1, "v": {"euler": [20, 40, -30]},
                                     "in": [10, -20, 30]}]}}}}})");
    const Curve<Quat>& rotation = curve_of<Quat>(document.stage().clips.at(0), "b.rotation");
    CHECK(near(rotation.rate(1, Side::in), Vec3(10 * degree, -20 * degree, 30 * degree), 1e-9));
  }
}

TEST_CASE("a key of quaternions says the way around and the whole turns to the next") {
  const auto mean_rate = [](const std::string& track, const std::string& first) {
    const Document document = parsed(R"({"tweenfall": 1, "clips": {"a": {"tracks": {"b.rotation": {)" + track +
                                     R"("keys": [{"t": 0, "v": {"quat": [0, 0, 0, 1]}, "ease": "linear")" + first +
                                     R"(}, [2, {"quat": [0, 0, 1, 1]}]]}}}}})");
    return curve_of<Quat>(document.stage().clips.at(0), "b.rotation").rate(1).z() / degree;
  };
  CHECK(near(mean_rate("", ""), 45, 1e-12));
  CHECK(near(mean_rate("", R"(, "turn": "long")"), -135, 1e-12));
  CHECK(near(mean_rate(R"("turn": "long", )", ""), -135, 1e-12));
  CHECK(near(mean_rate(R"("turn": "long", )", R"(, "turn": "short")"), 45, 1e-12));
  CHECK(near(mean_rate("", R"(, "turn": {"turns": 2})"), 405, 1e-12));
  CHECK(near(mean_rate(R"("turn": "long", )", R"(, "turn": {"turns": 1})"), -315, 1e-12));
  CHECK(near(mean_rate("", R"(, "turn": {"axis": "z", "turns": 1})"), 225, 1e-12));
  CHECK(near(mean_rate("", R"(, "turn": {"axis": [0, 0, -1]})"), -135, 1e-12));
  CHECK_THROWS_AS((void)mean_rate("", R"(, "turn": {"axis": "z", "way": "long"})"), DocumentError);
  CHECK_THROWS_AS((void)mean_rate("", R"(, "turn": {"turns": 1.5})"), DocumentError);
}

TEST_CASE("rotation keys take the words of rotations") {
  for (const std::string word : {"nlerp", "squad", "barry-goldman", "natural", "tcb(0,0.5,0)"}) {
    CAPTURE(word);
    const std::string ease = ", \"" + word + "\"]";
    const Document document =
        parsed(R"({"tweenfall": 1, "clips": {"a": {"tracks": {"b.rotation": [
      [0, {"quat": [0, 0, 0, 1]})" +
               ease + R"(, [1, {"quat": [0, 0, 1, 1]})" + ease + R"(, [2, {"quat": [1, 0, 0, 1]}]]}}}})");
    const Curve<Quat>& rotation = curve_of<Quat>(document.stage().clips.at(0), "b.rotation");
    Key<Quat> keys[] = {
        {0, Quat(1, 0, 0, 0), *Ease::named(word)}, {1, Quat(1, 0, 0, 1), *Ease::named(word)}, {2, Quat(1, 1, 0, 0)}};
    CHECK(near(rotation.value(0.7), keyed_curve<Quat>(keys).value(0.7), 1e-15));
  }
}

TEST_CASE("tangent kinds, overlong handles and what lies outside are read as they say") {
  const Document document = good_document("handles");
  const Clip& clip = document.stage().clips[0];
  const Curve<double>& mirrored = curve_of<double>(clip, "a.mirrored");
  CHECK(mirrored.rate(0) == 0);
  CHECK(mirrored.rate(1, Side::in) == doctest::Approx(3));
  CHECK(mirrored.rate(1) == doctest::Approx(3));
  CHECK(mirrored.rate(3, Side::in) == doctest::Approx(1));
  // A loop: the rate is the same on both sides of the seam, and zero where a component turns.
  const Curve<Vec2>& clamped = curve_of<Vec2>(clip, "a.clamped");
  CHECK(near(clamped.rate(4, Side::in), clamped.rate(4), 1e-13));
  CHECK(clamped.rate(1)[1] == 0);
  const Curve<double>&over = curve_of<double>(clip, "a.long"), &same = curve_of<double>(clip, "a.same");
  for (const double t : {0.2, 0.5, 0.7}) CHECK(over.value(t) == doctest::Approx(same.value(t)).epsilon(1e-12));
  const Curve<double>& counted = curve_of<double>(clip, "a.counted");
  CHECK(counted.value(-1) == 3);
  CHECK(counted.value(2.5) == doctest::Approx(6));
  CHECK(counted.value(3.5) == 7);
  CHECK(near(curve_of<Vec3>(clip, "a.position").value(3), Vec3(3, 5, 7), 1e-14));
  const Curve<Quat>& rotation = curve_of<Quat>(clip, "a.rotation");
  CHECK(turn_about_z(rotation.value(3)) == doctest::Approx(45 * degree));
  CHECK(turn_about_z(rotation.value(7)) == doctest::Approx(45 * degree));
}

TEST_CASE("modifiers are laid over tracks of numbers in their order") {
  const Document document = good_document("handles");
  const Clip& clip = document.stage().clips[1];
  const Curve<double>& cycled = curve_of<double>(clip, "b.cycled");
  CHECK(cycled.value(-1) == 0);
  CHECK(cycled.value(1.5) == doctest::Approx(3));
  // The sine sees the cycled time, which never reaches its range.
  CHECK(cycled.value(3.25) == doctest::Approx(6.5));
  CHECK(cycled.value(9) == doctest::Approx(2));
  const Curve<double>& swing = curve_of<double>(clip, "b.swing");
  CHECK(swing.value(0) == 1);
  CHECK(swing.rate(0) == 0);
  CHECK(swing.value(0.25) == doctest::Approx(0));
  const Curve<double>& warped = curve_of<double>(clip, "b.warped");
  CHECK(warped.value(0.5) == doctest::Approx(1.5));
  CHECK(warped.rate(0.5) == doctest::Approx(-1));
  CHECK(std::isfinite(curve_of<double>(clip, "b.all").value(1.3)));
}
