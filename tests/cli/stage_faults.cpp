// Documents whose stages once went wrong, run by the command and checked against closed forms.

#include "command.h"

#include <chrono>
#include <optional>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// The output of `run --json` for a document of the shared folder of faults; empty, and reported loudly, in a bare
/// clone.
std::optional<nlohmann::json> shared_run(const std::string& name, const std::string& options) {
  const std::filesystem::path file =
      std::filesystem::path(TWEENFALL_SOURCE_DIR) / "../shared/faults" / (name + ".json");
  if (!std::filesystem::exists(file)) {
    MESSAGE("SKIPPED: no document ../shared/faults/" << name << ".json");
    return std::nullopt;
  }
  const Folder folder;
  const Ran ran = folder.run("run " + detail::quoted(std::filesystem::canonical(file).string()) + " --json " + options);
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  return nlohmann::json::parse(ran.out);
}

/// A list of a node, at the frame nearest to `time`.
nlohmann::json at(const nlohmann::json& recording, const std::string& node, const char* what, double time) {
  const std::vector<double> times = recording["times"];
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - time) < std::abs(times[nearest] - time)) nearest = i;
  return recording["nodes"][node][what][nearest];
}

}  // namespace

TEST_CASE("two bodies that meet at restitution 0 take the whole blow and go on at their common speed") {
  const auto run = shared_run("contact_trigger_at_restitution_0", "--until 1");
  if (!run) return;
  REQUIRE((*run)["handoffs"].size() == 1);
  // They are 2 m apart, minus their radii, and close at 6.3 m/s.
  CHECK(near(double((*run)["handoffs"][0]["time"]), 1.6 / 6.3, 1e-6));
  REQUIRE((*run)["events"].size() == 1);
  CHECK(near(double((*run)["events"][0]["impulse"]), 0.7 * 3 / 3.7 * 6.3, 1e-3));
  const double common = (0.7 * 5 - 3 * 1.3) / 3.7;
  for (const char* node : {"s", "ball"}) CHECK(near(vec(at(*run, node, "velocity", 1)), Vec3(common, 0, 0), 1e-9));
}

TEST_CASE("a body struck on a curved path leaves with the curve's own velocity at the impact") {
  const auto run = shared_run("contact_trigger_on_a_curved_path", "--until 1");
  if (!run) return;
  REQUIRE((*run)["handoffs"].size() == 1);
  const nlohmann::json& handoff = (*run)["handoffs"][0];
  const double time = handoff["time"], angle = 4 * time;
  CHECK(near(vec(handoff["after"]["linear"]), 4 * Vec3(-std::sin(angle), std::cos(angle), 0), 1e-12));
  CHECK(near(vec(handoff["after"]["angular"]), Vec3(0, 0, 4), 1e-12));
  const double apart = (Vec3(std::cos(angle), std::sin(angle), 0) - Vec3(0.5403, 0.84147, 0)).norm();
  CHECK(near(apart, 0.2, 1e-6));
}

TEST_CASE("a keyed body that meets a static one is freed as they touch, and the contact is told") {
  const auto run = shared_run("keyed_meets_static", "--until 1");
  if (!run) return;
  REQUIRE((*run)["handoffs"].size() == 1);
  CHECK(near(double((*run)["handoffs"][0]["time"]), 0.45, 1e-6));
  REQUIRE(!(*run)["events"].empty());
  // The impulse that stops 0.4 kg at 2 m/s, and nothing of its weight after that.
  CHECK(near(double((*run)["events"][0]["impulse"]), 0.8, 1e-3));
}

TEST_CASE("a body handed to a drive follows the path it was given, once it has settled") {
  const auto run = shared_run("rule_to_a_drive_with_a_path", "--until 4 --fps 60");
  if (!run) return;
  // No play had started the clip: it starts with the hand-off, at 0.3 s.
  for (const double time : {1.5, 2.0, 3.0, 4.0}) {
    const double x = vec(at(*run, "b", "position", time)).x();
    // A drive of 8 Hz feels the path's acceleration, 10.8 m/s^2 at most: 10.8 / w^2 = 4.3 mm behind.
    CHECK(std::abs(x - 0.3 * std::sin(6 * (time - 0.3))) < 0.005);
  }
}

TEST_CASE("a dead blend of many turns unwinds them all, never faster than it came") {
  const auto run = shared_run("dead_blend_of_many_turns", "--until 1 --fps 2000");
  if (!run) return;
  const double rate = 900 * pi / 180, seconds = 0.5;
  const std::vector<double> times = (*run)["times"];
  for (std::size_t i = 0; i < times.size(); ++i) {
    // The turn from the path is (1 - fade)(pi/2 + rate t); by the product rule this is its rate, t after 0.1 s.
    const double since = times[i] - 0.1, u = since / seconds;
    double expected =
        u < 1 ? rate * (1 - u * u * (3 - 2 * u)) - 6 * u * (1 - u) / seconds * (pi / 2 + rate * since) : 0;
    if (u < 0) expected = rate;
    CHECK(near(vec((*run)["nodes"]["b"]["angular_velocity"][i]), Vec3(0, 0, expected), 1e-9));
    CHECK(std::abs(expected) <= rate);
  }
}

TEST_CASE("a body of 0.4 m on a node scaled by 3 rests as one of 1.2 m") {
  const auto run = shared_run("scaled_node_with_a_body", "--until 4");
  if (!run) return;
  CHECK(std::abs(vec(at(*run, "b", "position", 4)).y() - 0.6) < 1e-3);
}

TEST_CASE("an instant of 1e-310 s is as one of 0") {
  const auto run = shared_run("instant_near_zero", "--until 2");
  if (!run) return;
  REQUIRE((*run)["handoffs"].size() == 1);
  CHECK(near(vec((*run)["handoffs"][0]["after"]["linear"]), Vec3(1, 0, 0), 1e-12));
  for (const char* node : {"pusher", "ball"})
    for (const nlohmann::json& place : (*run)["nodes"][node]["position"]) CHECK(vec(place).allFinite());
  CHECK(std::abs(vec(at(*run, "pusher", "position", 2)).y() - 0.5) < 1e-3);
}

TEST_CASE("a loop counted backwards from 1e17 plays is there at once, in run and in view") {
  const auto start = std::chrono::steady_clock::now();
  const auto run = shared_run("loop_counted_backwards", "--until 4");
  if (!run) return;
  REQUIRE((*run)["events"].size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(near(double((*run)["events"][i]["time"]), 0.5 + double(i), 1e-12));
  CHECK(near(vec(at(*run, "a", "position", 3.25)), Vec3(0.75, 0, 0), 1e-12));
  const Folder folder;
  const std::string file = std::filesystem::canonical(std::filesystem::path(TWEENFALL_SOURCE_DIR) /
                                                      "../shared/faults/loop_counted_backwards.json")
                               .string();
  CHECK(folder.run("view " + detail::quoted(file) + " --until 4 -o out.html").code == 0);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
}

TEST_CASE("run --json lists the rules that waited in vain, with the body and why") {
  const Folder folder;
  folder.write("idle.json", R"({"tweenfall": 1,
    "nodes": {"lamp": {"body": {"shape": {"sphere": {"radius": 0.1}}, "drive": "keyed"}}},
    "handoff": [{"body": "lamp", "when": {"at": 0.1}, "to": "free"},
                {"body": "lamp", "when": {"contact": {"impulse": 2}}, "to": {"hz": 3}}]})");
  const Ran ran = folder.run("run idle.json --until 0.5 --json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  const nlohmann::json unfired = nlohmann::json::parse(ran.out)["unfired"];
  REQUIRE(unfired.size() == 1);
  CHECK(unfired[0]["rule"] == 1);
  CHECK(unfired[0]["body"] == "lamp");
  CHECK(unfired[0]["reason"] == "nothing touched the body");
}
