#include "command.h"

using namespace tweenfall::test;

namespace {

/// The line of a text that begins with `start` after blanks.
std::string line_of(const std::string& text, const std::string& start) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line.compare(first, start.size(), start) == 0) return line;
  }
  return "";
}

std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) found.push_back(word);
  return found;
}

Ran inspected(const Folder& folder, const std::string& tracks) {
  return folder.run("inspect -", R"({"tweenfall": 1, "clips": {"c": {"tracks": {)" + tracks + "}}}}");
}

}  // namespace

TEST_CASE("inspect shows nodes, clips, tracks with keys and top speed, events, and where a slope jumps") {
  const Folder folder;
  folder.write("ball.json", ball_document);
  const Ran ran = folder.run("inspect ball.json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  CHECK(ran.out.starts_with("2 nodes\n"));
  CHECK(line_of(ran.out, "ball  ") != "");
  CHECK(words(line_of(ran.out, "roll ")) ==
        std::vector<std::string>{"roll", "3", "once", "4", "9", "1", "from", "0", "s"});
  CHECK(words(line_of(ran.out, "ball.position")) ==
        std::vector<std::string>{"ball.position", "vector", "3", "0", "3", "2", "0", "at", "1"});
  CHECK(words(line_of(ran.out, "ball.lit")) == std::vector<std::string>{"ball.lit", "switch", "2", "0", "1.5"});
  CHECK(line_of(ran.out, "1  ").find("corner") != std::string::npos);
}

TEST_CASE("the top speed is that of the curve, also between keys") {
  const Folder folder;
  // A Hermite cubic from 0 to 1 with flat ends is fastest halfway: 6u(1-u) = 1.5.
  const Ran hermite = inspected(folder, R"("a.x": [{"t": 0, "v": 0, "out": "flat"}, {"t": 1, "v": 1, "in": "flat"}])");
  CHECK(words(line_of(hermite.out, "a.x")) == std::vector<std::string>{"a.x", "number", "2", "0", "1", "1.5", "0.5"});
}

TEST_CASE("a value that jumps and a slope that jumps are told apart") {
  const Folder folder;
  const Ran ran =
      inspected(folder, R"("a.jump": [[0, 0, "linear"], {"t": 1, "v": 5, "v_in": 2, "ease": "linear"}, [2, 7]],
    "a.smooth": [[0, 0, "smooth"], [1, 2, "smooth"], [2, 3]])");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  CHECK(line_of(ran.out, "a.jump").ends_with("at 1"));
  CHECK(words(line_of(ran.out, "a.smooth")).size() == 7);
}

TEST_CASE("bodies come with shape, mass and the owner they start with") {
  const Folder folder;
  folder.write("thrown.json", thrown_document);
  const Ran ran = folder.run("inspect thrown.json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  const std::string ball = line_of(ran.out, "ball   sphere");
  // 1000 kg/m^3 times 4/3 pi 0.1^3.
  CHECK(ball.find("4.1888") != std::string::npos);
  CHECK(ball.ends_with("keyed"));
  CHECK(line_of(ran.out, "floor  plane").ends_with("static"));
}

TEST_CASE("a model is inspected: its clips, joints and skinned mesh") {
  const std::filesystem::path fox = models_folder() / "gltf" / "Fox.glb";
  if (!std::filesystem::exists(fox)) {
    MESSAGE("SKIPPED: inspecting a model, no file " << fox.string());
    return;
  }
  const Folder folder;
  const Ran ran = folder.run("inspect '" + fox.string() + "'");
  CHECK_MESSAGE(ran.code == 0, ran.err);
  for (const std::string part : {"3 clips", "Survey", "Walk", "Run", "skinned mesh, 576 triangles"})
    CHECK_MESSAGE(ran.out.find(part) != std::string::npos, part);
}

TEST_CASE("a scaled body is shown with its scale, and weighs what collides") {
  const Folder folder;
  const Ran ran = folder.run("inspect -", R"({"tweenfall": 1, "nodes": {
    "cart": {"scale": 3, "rotation": {"axis": "z", "angle": 90}},
    "crate": {"parent": "cart", "scale": [1, 0.5, 1], "body": {"shape": {"box": {"size": [0.4, 0.4, 0.4]}}}},
    "ball": {"parent": "cart", "body": {"shape": {"sphere": {"radius": 0.5}}, "mass": 2}},
    "plain": {"body": {"shape": {"sphere": {"radius": 0.5}}}}}})");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  // 1.2 m by 0.6 m by 1.2 m of 1000 kg/m^3.
  CHECK(ran.out.find("crate  box, half 0.2 0.2 0.2, times 3 1.5 3       864") != std::string::npos);
  CHECK(ran.out.find("ball   sphere, radius 0.5, times 3                  2") != std::string::npos);
  CHECK(ran.out.find("plain  sphere, radius 0.5                       523.6") != std::string::npos);
}

TEST_CASE("inspect shows how clips are played, which nodes layers reach, what a graph does on events, and its inputs") {
  const Folder folder;
  const Ran ran = folder.run("inspect -", R"({"tweenfall": 1, "nodes": {"hip": {}, "arm": {"parent": "hip"}},
    "clips": {"wave": {"tracks": {"arm.rotation": {"axis": "z", "keys": [[0, 0], [1, 90]]}}, "events": [[0.5, "up"]]}},
    "play": [{"name": "hello", "clip": "wave", "at": 0.5, "weight": 0.75, "fade_in": 0.25, "mask": "ar*"},
             {"clip": "wave", "weight": [[0, 0], [1, 1]]}],
    "graphs": {"figure": {"parameters": {"speed": 0}, "poses": {
      "all": {"layers": [{"over": "wave", "mask": {"joints": "hip", "below": true}}]}}, "on": [["up", "speed", 2]], "inputs": [[0.375, "speed", 1.5]]}}})");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  CHECK(line_of(ran.out, "wave  ")
            .ends_with("hello from 0.5 s, weight 0.75, fades in 0.25 s, on ar*; from 0 s, weight by keys"));
  CHECK(words(line_of(ran.out, "all     wave")) == std::vector<std::string>{"all", "wave", "hip", "and", "below", "1"});
  CHECK(line_of(ran.out, "up  ").ends_with("sets speed to 2"));
  CHECK(line_of(ran.out, "0.375").ends_with("sets speed to 1.5"));
}
