// Tracks of single numbers: "ball.position.y", "hinge.rotation.z", "lamp.color.a", "box.scale.x".

#include "importers/document/document_files.h"

#include <tweenfall/importers/track_sample.h>
#include <tweenfall/physics/stage/stage.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::string with_tracks(const std::string& tracks) {
  return "{\"tweenfall\": 1,\n \"nodes\": {\"hinge\": {\"position\": [1, 2, 3]}},\n \"clips\": {\"only\": {\"tracks\": "
         "{\n" +
         tracks + "}}}}";
}

std::string faults(const std::string& tracks) {
  return faults_of(with_tracks(tracks), "c.json", {});
}

}  // namespace

TEST_CASE("a hinge turns by one angle in degrees, a place moves along one axis") {
  const Document document = parsed(with_tracks(
      "\"hinge.rotation.z\": [[0, 0, \"linear\"], [2, 720]],\n\"hinge.position.y\": [[0, 5, \"linear\"], [2, 9]],\n"
      "\"hinge.scale.x\": {\"oscillator\": {\"amplitude\": 0.5, \"hz\": 1, \"center\": 2}},\n"
      "\"hinge.color.a\": [[0, 1], [2, 0]]"));
  const Stage stage(document.stage());
  Stage at = Stage(document.stage());
  at.seek(0.5);
  const WorldMotion world = at.world(0);
  CHECK(near(world.motion.pose.position, Vec3(1, 6, 3), 1e-14));
  CHECK(near(world.motion.twist.linear, Vec3(0, 2, 0), 1e-14));
  CHECK(near(world.motion.pose.rotation, Quat(0, 0, 0, 1), 1e-14));
  CHECK(near(world.motion.twist.angular, Vec3(0, 0, 2 * pi), 1e-13));
  CHECK(near(world.motion.pose.scale, Vec3(1.5, 1, 1), 1e-14));
  REQUIRE(at.look(0).color);
  CHECK(near(at.look(0).color->value.rgba[3], 0.75, 0.2));
  const Clip& clip = document.stage().clips[0];
  CHECK(near(sample_track(clip, clip.tracks[0], {.time = 1, .rate = 1}).rate.at(0), 2 * pi, 1e-13));
}

TEST_CASE("angles beside each other turn in the order that they say") {
  const Document document =
      parsed(with_tracks("\"hinge.rotation.x\": {\"order\": \"ZYX\", \"keys\": [[0, 90]]},\n"
                         "\"hinge.rotation.z\": {\"order\": \"ZYX\", \"keys\": [[0, 90]]}"));
  Stage stage(document.stage());
  const Quat z(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), x(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  CHECK(near(stage.world(0).motion.pose.rotation, z * x, 1e-14));
}

TEST_CASE("two tracks that drive one number are an error that names both with their places") {
  CHECK(faults("\"hinge.position\": [[0, [0, 0, 0]]],\n\"hinge.position.y\": [[0, 1]]") ==
        "c.json:5:1: error: the tracks \"hinge.position\" and \"hinge.position.y\" drive the same number; the first "
        "stands at line 4, column 1 (at /clips/only/tracks/hinge.position.y)\n"
        " 5 | \"hinge.position.y\": [[0, 1]]}}}}\n   | ^\n");
  const std::string orders =
      faults("\"hinge.rotation.y\": {\"order\": \"ZYX\", \"keys\": [[0, 90]]},\n\"hinge.rotation.z\": [[0, 90]]");
  CHECK(orders.find("\"hinge.rotation.y\" and \"hinge.rotation.z\" are angles of one rotation in two orders") !=
        std::string::npos);
  CHECK(faults("\"hinge.position.x\": [[0, 1]],\n\"hinge.position.y\": [[0, 1]]").empty());
}

TEST_CASE("what is no component is told with those that there are") {
  CHECK(faults("\"hinge.position.w\": [[0, 1]]").find("; the components of a position are \"x\", \"y\" and \"z\"") !=
        std::string::npos);
  CHECK(faults("\"hinge.color.x\": [[0, 1]]").find("\"r\", \"g\", \"b\" and \"a\"") != std::string::npos);
  CHECK(faults("\"hinge.translation.Y\": [[0, 1]]").find("did you mean \"hinge.position.y\"?") != std::string::npos);
  CHECK(faults("\"hinge.position.y\": [[0, [1, 2, 3]]]").find("expected a number") != std::string::npos);
  CHECK(faults("\"hinge.rotation.y\": {\"order\": \"XYX\", \"keys\": [[0, 1]]}").find("an order of three axes") !=
        std::string::npos);
}

TEST_CASE("a document with components is written as it was read") {
  const Document document =
      parsed(with_tracks("\"hinge.rotation.z\": {\"order\": \"ZYX\", \"keys\": [[0, 0], [2, 720]]}"));
  const std::string once = document.text();
  CHECK(once.find("hinge.rotation.z") != std::string::npos);
  CHECK(parsed(once).text() == once);
}
