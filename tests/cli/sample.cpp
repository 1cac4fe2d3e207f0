#include "command.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>

#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;
using nlohmann::json;

namespace {

json sampled(const Folder& folder, const std::string& arguments, const std::string& input = "") {
  const Ran ran = folder.run("sample --json " + arguments, input);
  CHECK(ran.code == 0);
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  return json::parse(ran.out);
}

std::string clip_document(const std::string& tracks, const std::string& more = "") {
  return R"({"tweenfall": 1, "clips": {"c": {)" + more + R"("tracks": {)" + tracks + "}}}}";
}

}  // namespace

TEST_CASE("sampled values and rates are those of the lines between the keys") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const json found = sampled(folder, "ball.json --at 0.5,2 --rates");
  CHECK(found["clip"] == "roll");
  CHECK(found["times"] == json{0.5, 2.0});
  CHECK(!found.contains("world"));
  const json& position = found["tracks"]["ball.position"];
  CHECK(near(vec(position["value"][0]), Vec3(1, 0, 0), 1e-15));
  CHECK(near(vec(position["value"][1]), Vec3(2, 2, 0), 1e-15));
  CHECK(near(vec(position["rate"][0]), Vec3(2, 0, 0), 1e-15));
  CHECK(near(vec(position["rate"][1]), Vec3(0, 2, 0), 1e-15));
  const json& lit = found["tracks"]["ball.lit"];
  CHECK(lit["value"] == json{false, true});
  CHECK(!lit.contains("rate"));
  const std::vector<double> color = found["tracks"]["ball.color"]["value"][0];
  CHECK(near(Vec4(color.at(0), color.at(1), color.at(2), color.at(3)), Vec4(1, 0, 0, 1), 1e-12));
}

TEST_CASE("a rotation is x y z w and its rate the angular velocity in radians") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const json found = sampled(folder, "ball.json --at 1 --rates --track pivot.rotation");
  CHECK(found["tracks"].size() == 1);
  const json& turn = found["tracks"]["pivot.rotation"];
  CHECK(near(turn["value"][0][2].get<double>(), std::numbers::sqrt2 / 2, 1e-15));
  CHECK(near(turn["value"][0][3].get<double>(), std::numbers::sqrt2 / 2, 1e-15));
  CHECK(near(vec(turn["rate"][0]), Vec3(0, 0, std::numbers::pi / 2), 1e-15));
}

TEST_CASE("world matrices are column-major and hold the whole chain of parents") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const json found = sampled(folder, "ball.json --at 1 --world");
  // A quarter turn about z at (1, 2, 3); the ball 2 along the turned x.
  const double pivot[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
  const double ball[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 4, 3, 1};
  REQUIRE(found["world"].size() == 2);
  for (int i = 0; i < 16; ++i) {
    CHECK(near(found["world"]["pivot"][0][i].get<double>(), pivot[i], 1e-14));
    CHECK(near(found["world"]["ball"][0][i].get<double>(), ball[i], 1e-14));
  }
}

TEST_CASE("the numbers printed read back to the bits of the library's") {
  const Folder folder;
  const std::string text = clip_document(
      R"("a.position": [[0, [0.1, 0, 7e9]], [0.7, [1, -3, 0.3]], [1.9, [-2.7, 0.01, 1e-9]]],
         "a.rotation": [[0, {"euler": [10, 20, 30]}], [1.3, {"euler": [-70, 120, 250]}]],
         "a.color": [[0, "#123456"], [1, "#fedcba80"]], "a.wave": {"oscillator": {"amplitude": 0.3, "hz": 1.7}})");
  folder.write("curves.json", text);
  const json found = sampled(folder, "curves.json --at 0,0.123456789,0.7,1.1 --rates");
  const Document document = Document::parse(text, "curves.json", folder.path());
  const Clip& clip = document.stage().clips.at(0);
  REQUIRE(clip.tracks.size() == found["tracks"].size());
  for (const Track& track : clip.tracks) {
    for (std::size_t i = 0; i < found["times"].size(); ++i) {
      const double time = found["times"][i];
      const json& value = found["tracks"][track.name()]["value"][i];
      const json& rate = found["tracks"][track.name()]["rate"][i];
      if (const auto* curve = std::get_if<Curve<Vec3>>(&track.curve)) {
        CHECK(vec(value) == curve->value(time));
        CHECK(vec(rate) == curve->rate(time));
      } else if (const auto* rotation = std::get_if<Curve<Quat>>(&track.curve)) {
        const Quat q = rotation->value(time);
        CHECK(value == json{q.x(), q.y(), q.z(), q.w()});
        CHECK(vec(rate) == rotation->rate(time));
      } else if (const auto* color = std::get_if<Curve<Color>>(&track.curve)) {
        const Vec4 rgba = color->value(time).rgba;
        CHECK(value == json{rgba[0], rgba[1], rgba[2], rgba[3]});
      } else {
        const Sample<double> sample = std::get<Curve<double>>(track.curve).sample(time);
        CHECK(value.get<double>() == sample.value);
        CHECK(rate.get<double>() == sample.rate);
      }
    }
  }
}

TEST_CASE("a loop wraps the time before the tracks see it, and an offset loop goes on from where it ended") {
  const Folder folder;
  const std::string track = R"("a.position": [[0, [0, 0, 0], "linear"], [2, [4, 0, 0]]])";
  const json repeated = sampled(folder, "- --at 2.5 --rates", clip_document(track, R"("loop": {"mode": "repeat"}, )"));
  CHECK(near(vec(repeated["tracks"]["a.position"]["value"][0]), Vec3(1, 0, 0), 1e-15));
  CHECK(near(vec(repeated["tracks"]["a.position"]["rate"][0]), Vec3(2, 0, 0), 1e-15));
  const json offset =
      sampled(folder, "- --at 4.5 --rates", clip_document(track, R"("loop": {"mode": "repeat-offset"}, )"));
  CHECK(near(vec(offset["tracks"]["a.position"]["value"][0]), Vec3(9, 0, 0), 1e-15));
  const json pingpong =
      sampled(folder, "- --at 2.5 --rates", clip_document(track, R"("loop": {"mode": "pingpong"}, )"));
  CHECK(near(vec(pingpong["tracks"]["a.position"]["value"][0]), Vec3(3, 0, 0), 1e-15));
  CHECK(near(vec(pingpong["tracks"]["a.position"]["rate"][0]), Vec3(-2, 0, 0), 1e-15));
}

TEST_CASE("without a loop a track goes on after its last key as the track says, in tracks and in the world") {
  const Folder folder;
  const std::string keys = R"("keys": [[0, [0, 0, 0], "linear"], [2, [4, 0, 0], "linear"]])";
  const json held = sampled(folder, "- --at 3 --rates --world", clip_document(R"("a.position": {)" + keys + "}"));
  CHECK(near(vec(held["tracks"]["a.position"]["value"][0]), Vec3(4, 0, 0), 1e-15));
  CHECK(near(vec(held["tracks"]["a.position"]["rate"][0]), Vec3(0, 0, 0), 1e-15));
  CHECK(near(held["world"]["a"][0][12].get<double>(), 4, 1e-15));
  const json line =
      sampled(folder, "- --at 3 --rates --world", clip_document(R"("a.position": {"after": "linear", )" + keys + "}"));
  CHECK(near(vec(line["tracks"]["a.position"]["value"][0]), Vec3(6, 0, 0), 1e-15));
  CHECK(near(vec(line["tracks"]["a.position"]["rate"][0]), Vec3(2, 0, 0), 1e-15));
  CHECK(near(line["world"]["a"][0][12].get<double>(), 6, 1e-15));
}

TEST_CASE("frames stand every 1/N s from 0, with the clip's end among them") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  CHECK(sampled(folder, "ball.json --fps 2")["times"] == json{0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0});
  CHECK(sampled(folder, "ball.json --fps 2 --until 0.75")["times"] == json{0.0, 0.5, 0.75});
}

TEST_CASE("an endless clip must be told how far") {
  const Folder folder;
  const std::string endless = clip_document(R"("a.x": {"oscillator": {"amplitude": 1, "hz": 1}})");
  const Ran ran = folder.run("sample - --fps 10", endless);
  CHECK(ran.code == 2);
  CHECK(ran.err.find("--until") != std::string::npos);
  CHECK(sampled(folder, "- --fps 2 --until 1", endless)["times"] == json{0.0, 0.5, 1.0});
}

TEST_CASE("of several clips one must be named, and the message names them") {
  const Folder folder;
  const std::string two = R"({"tweenfall": 1, "clips": {"up": {"tracks": {"a.y": [[0, 0], [1, 1]]}},
    "down": {"tracks": {"a.y": [[0, 1], [1, 0]]}}}})";
  const Ran ran = folder.run("sample - --at 0", two);
  CHECK(ran.code == 2);
  CHECK(ran.err.find("up") != std::string::npos);
  CHECK(ran.err.find("down") != std::string::npos);
  const json found = sampled(folder, "- --at 0 --clip down", two);
  CHECK(found["clip"] == "down");
  CHECK(found["tracks"]["a.y"]["value"] == json::array({1.0}));
}

TEST_CASE("a pattern chooses tracks, and the table shows them with their times") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const json found = sampled(folder, "ball.json --at 0 --track 'ball.*'");
  CHECK(found["tracks"].size() == 3);
  const json two = sampled(folder, "--track ball.position --at 0,1 --track pivot.rotation --at 2 ball.json");
  CHECK(two["tracks"].size() == 2);
  CHECK(two["times"] == json{0.0, 1.0, 2.0});
  const Ran table = folder.run("sample ball.json --at 0.5 --track ball.position --rates");
  CHECK(table.code == 0);
  CHECK(table.out.find("ball.position (vector)") != std::string::npos);
  CHECK(table.out.find("0.5  1  0  0  2  0  0") != std::string::npos);
}

TEST_CASE("names that JSON must escape come out as JSON") {
  const Folder folder;
  const std::string strange =
      R"({"tweenfall": 1, "clips": {"q\"\\\n\u00e9": {"tracks": {"a\tb.y": [[0, 0], [1, 1]]}}}})";
  const json found = sampled(folder, "- --at 0", strange);
  CHECK(found["clip"] == "q\"\\\n\u00e9");
  CHECK(found["tracks"].contains("a\tb.y"));
}

TEST_CASE("a model's clips are sampled to the library's bits") {
  const std::filesystem::path fox = models_folder() / "gltf" / "Fox.glb";
  if (!std::filesystem::exists(fox)) {
    MESSAGE("SKIPPED: sampling a model, no file " << fox.string());
    return;
  }
  const Folder folder;
  const Model model = load_model(fox);
  const Clip& clip = model.clips.at(1);
  const json found = sampled(folder, "'" + fox.string() + "' --at 0.3 --clip " + clip.name);
  CHECK(found["clip"] == clip.name);
  for (const Track& track : clip.tracks) {
    if (!std::holds_alternative<Curve<Quat>>(track.curve)) continue;
    const Quat q = std::get<Curve<Quat>>(track.curve).value(0.3);
    CHECK(found["tracks"][track.name()]["value"][0] == json{q.x(), q.y(), q.z(), q.w()});
  }
}

TEST_CASE("at a clip's last instant sample tells the motion with which a hand-off there lets go") {
  const Folder folder;
  const std::string thrown = R"({"tweenfall": 1,
    "nodes": {"ball": {"body": {"shape": {"sphere": {"radius": 0.1}}}}},
    "clips": {"throw": {"tracks": {"ball.position": [[0, [0, 2, 0], "quad-in"], [0.7, [3, 2, 0]]]}}},
    "handoff": [{"body": "ball", "when": {"clip_end": true}, "to": "free"}]})";
  folder.write("thrown.json", thrown);
  const Ran sampled = folder.run("sample thrown.json --at 0.7 --rates --json");
  REQUIRE_MESSAGE(sampled.code == 0, sampled.err);
  const Vec3 rate = vec(json::parse(sampled.out)["tracks"]["ball.position"]["rate"][0]);
  const Ran ran = folder.run("run thrown.json --until 1 --json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  const json handoffs = json::parse(ran.out)["handoffs"];
  REQUIRE(handoffs.size() == 1);
  CHECK(near(rate, Vec3(2 * 3 / 0.7, 0, 0), 1e-12));
  CHECK(near(vec(handoffs[0]["after"]["linear"]), rate, 1e-12));
}
