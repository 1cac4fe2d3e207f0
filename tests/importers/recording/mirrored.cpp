// What was recorded below a node whose scale mirrors, as glTF and as tracks.

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/stage.h>

#include <Eigen/Geometry>

#include "plot/track_values.h"
#include "recording/recording_model.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

StageDescription mirrored_arm() {
  StageDescription stage;
  stage.nodes = {{.name = "side", .rest = {{0, 1, 0}, exp_map({0.3, -0.2, 0.5}), {-1, 1, 1}}},
                 {.name = "arm",
                  .parent = 0,
                  .rest = {{0.5, 0, 0}},
                  .body = BodyDescription{.shape = {Box{{0.3, 0.1, 0.2}}}, .mass = 1.0}}};
  Clip clip{.name = "wave", .duration = 1};
  clip.tracks = {{"arm", "rotation",
                  keyed_curve<Quat>(
                      {{.time = 0, .value = exp_map({0.1, 0.7, 0})}, {.time = 1, .value = exp_map({-0.4, 0.2, 1})}})}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

}  // namespace

TEST_CASE("a recording below a mirrored node keeps matrices as glTF, and the angles of its own tracks in plots") {
  const StageDescription described = mirrored_arm();
  Stage stage(described);
  const Recording recording = record(stage, 1, 20);
  const Model model = recordings::recording_model(recording, described);
  const Curve<Quat>& wave = std::get<Curve<Quat>>(described.clips[0].tracks[0].curve);
  const Pose& side = described.nodes[0].rest;
  const auto turning = std::ranges::find_if(
      model.clips[0].tracks, [](const Track& track) { return track.node == "arm" && track.property == "rotation"; });
  REQUIRE(turning != model.clips[0].tracks.end());
  const auto points = plotting::recorded_track(recording, 1, "rotation", 0, recording.times.size() - 1);
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    const double time = recording.times[frame];
    const Mat3 expected =
        side.rotation.toRotationMatrix() * side.scale.asDiagonal() * wave.value(time).toRotationMatrix();
    const Quat drawn = std::get<Curve<Quat>>(turning->curve).value(time);
    CHECK(near(Mat3(drawn.toRotationMatrix() * model.nodes[1].rest.scale.asDiagonal()), expected, 1e-12));
    const std::vector<double>&values = points[frame].values, &rates = points[frame].rates;
    CHECK(near(Quat(values[3], values[0], values[1], values[2]), wave.value(time), 1e-12));
    CHECK(near(Vec3(rates[0], rates[1], rates[2]), wave.sample(time).rate, 1e-11));
  }
}
