#include <tweenfall/importers/document.h>
#include <tweenfall/importers/recording_file.h>

#include "page/example_stage.h"
#include "support.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

nlohmann::json example_json() {
  return nlohmann::json::parse(recording_json(example_recording()));
}

std::uint64_t bits(double number) {
  std::uint64_t result = 0;
  static_assert(sizeof result == sizeof number);
  std::memcpy(&result, &number, sizeof result);
  return result;
}

}  // namespace

TEST_CASE("a joint that comes late, or by another's name, is told with its coordinates and under a name of its own") {
  Recording recording = example_recording();
  const std::size_t frames = recording.times.size();
  JointReading reading;
  reading.coordinates = 1;
  reading.position[0] = 0.5;
  recording.joints = {{.name = "tie", .a = no_node, .b = 1, .reading = {}},
                      {.name = "tie", .a = 0, .b = 1, .reading = {}}};
  for (JointRecord& joint : recording.joints) joint.reading.resize(frames);
  recording.joints[0].reading[0] = reading;
  recording.joints[1].reading[frames - 1] = reading;
  const nlohmann::json joints = nlohmann::json::parse(recording_json(recording))["joints"];
  REQUIRE(joints.size() == 2);
  CHECK(joints["tie"]["nodes"].size() == 1);
  CHECK(joints["tie"]["position"][0][0] == 0.5);
  CHECK(joints["tie"]["position"][frames - 1].is_null());
  CHECK(joints["tie #2"]["nodes"].size() == 2);
  CHECK(joints["tie #2"]["position"][0].is_null());
  CHECK(joints["tie #2"]["position"][frames - 1][0] == 0.5);
}

TEST_CASE("a recording as JSON reads back to the same bits") {
  Recording recording = example_recording();
  recording.nodes[2].twist[3].linear = Vec3(-0.0, 5e-324, 1.7976931348623157e308);
  recording.nodes[2].twist[4].linear = Vec3(0.1, 1e-7, 123456789.123456789);
  const nlohmann::json json = nlohmann::json::parse(recording_json(recording));
  REQUIRE(json["times"].size() == recording.times.size());
  for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
    CHECK(bits(json["times"][frame].get<double>()) == bits(recording.times[frame]));
    for (const NodeRecord& node : recording.nodes) {
      const nlohmann::json& written = json["nodes"][node.name];
      const Pose& pose = node.world[frame].motion.pose;
      for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<std::size_t>(i);
        CHECK(bits(written["position"][frame][at].get<double>()) == bits(pose.position[i]));
        CHECK(bits(written["velocity"][frame][at].get<double>()) == bits(node.twist[frame].linear[i]));
        CHECK(bits(written["angular_velocity"][frame][at].get<double>()) == bits(node.twist[frame].angular[i]));
      }
      for (int i = 0; i < 4; ++i)
        CHECK(bits(written["rotation"][frame][static_cast<std::size_t>(i)].get<double>()) ==
              bits(pose.rotation.coeffs()[i]));
    }
  }
}

TEST_CASE("a recording as JSON names owners, hand-offs and events as the format says") {
  const nlohmann::json json = example_json();
  CHECK(json.size() == 5);
  CHECK(json["unfired"].is_array());
  const nlohmann::json& owners = json["nodes"]["crate"]["owner"];
  CHECK(owners[0] == "keyed");
  CHECK(owners[70] == "driven");
  CHECK(owners[120] == "free");
  REQUIRE(json["handoffs"].size() == 3);
  const nlohmann::json& handoff = json["handoffs"][0];
  CHECK(handoff["time"] == release_time);
  CHECK(handoff["body"] == "bob");
  CHECK(handoff["from"] == "keyed");
  CHECK(handoff["to"] == "free");
  CHECK(handoff["cause"] == "event");
  CHECK(handoff["before"]["linear"].size() == 3);
  CHECK(handoff["after"]["angular"].size() == 3);
  CHECK(json["events"][0] == nlohmann::json::parse(R"({"time": 0.75, "name": "let go"})"));
  CHECK(json["events"][1] ==
        nlohmann::json::parse(R"({"time": 1.2, "name": "contact", "nodes": ["bob", "floor"], "impulse": 0.125})"));
}

TEST_CASE("a recording as JSON says of an interval whether it begins or ends") {
  Recording recording = example_recording(10);
  recording.events = {{.time = 0.25, .name = "loud", .data = {}, .nodes = {}, .kind = EventKind::begin},
                      {.time = 0.5, .name = "loud", .data = {}, .nodes = {}, .kind = EventKind::end}};
  const nlohmann::json events = nlohmann::json::parse(recording_json(recording))["events"];
  CHECK(events[0] == nlohmann::json::parse(R"({"time": 0.25, "name": "loud", "kind": "begin"})"));
  CHECK(events[1] == nlohmann::json::parse(R"({"time": 0.5, "name": "loud", "kind": "end"})"));
}

TEST_CASE("a recording as JSON tells user tracks as plays and graphs mix them, frame by frame, with rates") {
  const Document document = Document::parse(R"({
    "tweenfall": 1,
    "nodes": {"hips": {}, "lamp": {}, "ball": {"body": {"shape": {"sphere": {"radius": 0.1}}, "mass": 1}}},
    "clips": {
      "walk": {"duration": 2, "tracks": {"hips.effort": [[0, 0, "linear"], [2, 4]], "hips.wind": [[0, [1, 2, 3]]],
                                         "lamp.on": [[0, true]], "lamp.word": [[0, "\"go\""]], "lamp.glow": [[0, "#ff0000"]]}},
      "stand": {"duration": 2, "tracks": {"hips.effort": [[0, 1]]}},
      "late": {"duration": 1, "tracks": {"hips.late": [[0, 7]], "ball.drive_hz": [[0, 7]]}},
      "never": {"duration": 1, "tracks": {"hips.never": [[0, 7]]}}
    },
    "play": [{"clip": "stand"}, {"clip": "late", "at": 1, "fill": "forwards"}],
    "graphs": {"g": {
      "parameters": {"speed": 0},
      "poses": {"gait": {"space": {"by": "speed", "poses": [[0, "stand"], [1, "walk"]]}}},
      "inputs": [[0.5, "speed", 0.75]]
    }}
  })",
                                            "values.json", ".");
  Stage stage(document.stage());
  const nlohmann::json tracks = nlohmann::json::parse(recording_json(record(stage, 1, 2)))["tracks"];
  CHECK(tracks["hips.effort"]["value"] == nlohmann::json({1, 0.25 * 1 + 0.75 * 1, 0.25 * 1 + 0.75 * 2}));
  CHECK(tracks["hips.effort"]["rate"] == nlohmann::json({0, 0.75 * 2, 0.75 * 2}));
  CHECK(tracks["hips.wind"]["value"][2] == nlohmann::json({0.75, 1.5, 2.25}));
  CHECK(tracks["hips.wind"]["rate"][2] == nlohmann::json({0, 0, 0}));
  CHECK(tracks["lamp.on"] == nlohmann::json({{"value", {false, true, true}}}));
  CHECK(tracks["lamp.word"]["value"] == nlohmann::json({"", "\"go\"", "\"go\""}));
  CHECK(tracks["lamp.glow"]["value"][1] == nlohmann::json({1, 0, 0, 0.75}));
  CHECK(tracks["hips.late"]["value"] == nlohmann::json({0, 0, 7}));
  CHECK(tracks.size() == 6);
  CHECK(stage.user_tracks().size() == 6);
  CHECK(std::get<Sample<double>>(stage.user_value("hips.effort")).rate == 1.5);
  CHECK_THROWS_WITH(static_cast<void>(stage.user_value("hips.efort")), doctest::Contains("hips.effort"));
}

TEST_CASE("names with quotes, line breaks and angle brackets survive JSON and CSV") {
  Recording recording = example_recording(10);
  recording.nodes[2].name = "a \"b\", <c>\n\\d";
  CHECK(nlohmann::json::parse(recording_json(recording))["nodes"].contains("a \"b\", <c>\n\\d"));
  CHECK(recording_csv(recording).find(",\"a \"\"b\"\", <c>\n\\d\",") != std::string::npos);
}

TEST_CASE("a recording as CSV has a row for each time and node under a header of as many columns") {
  const Recording recording = example_recording(20);
  std::istringstream lines(recording_csv(recording));
  std::string line;
  std::getline(lines, line);
  CHECK(line.substr(0, 27) == "time,node,owner,position_x,");
  std::size_t rows = 0;
  while (std::getline(lines, line)) {
    CHECK(std::count(line.begin(), line.end(), ',') == 15);
    const std::size_t frame = rows / recording.nodes.size(), node = rows % recording.nodes.size();
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    REQUIRE(row.size() == 16);
    CHECK(std::stod(row[0]) == recording.times[frame]);
    CHECK(row[1] == recording.nodes[node].name);
    CHECK(std::stod(row[4]) == recording.nodes[node].world[frame].motion.pose.position.y());
    CHECK(std::stod(row[10]) == recording.nodes[node].twist[frame].linear.x());
    ++rows;
  }
  CHECK(rows == recording.times.size() * recording.nodes.size());
}

TEST_CASE("a recording that went astray is refused with the node and the time") {
  Recording recording = example_recording(20);
  recording.nodes[3].world[10].motion.pose.position.y() = std::nan("");
  CHECK_THROWS_WITH_AS((void)recording_json(recording),
                       doctest::Contains("node \"crate\" is not at a finite place or speed at 0.5 s"),
                       std::invalid_argument);
  recording = example_recording(20);
  recording.nodes[2].owner.pop_back();
  CHECK_THROWS_WITH_AS((void)recording_csv(recording), doctest::Contains("60 entries in owner, but there are 61 times"),
                       std::invalid_argument);
  recording = example_recording(20);
  recording.events[1].nodes[1] = 99;
  CHECK_THROWS_WITH_AS((void)recording_html(recording, example_stage()), doctest::Contains("names node 99"),
                       std::invalid_argument);
}

TEST_CASE("a recording whose user tracks are not one finite value of one kind for each frame is refused") {
  const auto refused = [](UserValue value, std::size_t at, std::size_t frames, const char* why) {
    Recording recording = example_recording(20);
    const UserValue one = Sample<double>{1, 0, 0};
    recording.user_tracks = {{.name = "hips.effort", .value = std::vector<UserValue>(frames, one)}};
    recording.user_tracks[0].value[at] = std::move(value);
    CHECK_THROWS_WITH_AS((void)recording_json(recording), doctest::Contains(why), std::invalid_argument);
  };
  const double infinite = std::numeric_limits<double>::infinity();
  refused(Sample<double>{1, 0, 0}, 0, 60, "user track \"hips.effort\" has 60 values for 61 frames");
  refused(true, 10, 61, "user track \"hips.effort\" is of another kind than before at 0.5 s");
  refused(Sample<double>{std::nan(""), 0, 0}, 10, 61, "\"hips.effort\" has no finite value or rate at 0.5 s");
  refused(Sample<double>{1, infinite, 0}, 10, 61, "\"hips.effort\" has no finite value or rate at 0.5 s");
  const Sample<Vec2> wrong{{0, infinite}, {0, 0}, {0, 0}};
  refused(wrong, 0, 61, "\"hips.effort\" has no finite value or rate at 0 s");
  refused(std::vector<Sample<double>>{{1, 0, 0}, {0, infinite, 0}}, 0, 61, "no finite value or rate at 0 s");
  refused(Sample<Color>{{{0, 0, infinite, 1}}, {0, 0, 0, 0}, {0, 0, 0, 0}}, 0, 61, "no finite value or rate at 0 s");
}
