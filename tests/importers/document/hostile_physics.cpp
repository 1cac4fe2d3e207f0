#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <cmath>
#include <ctime>

// Excessive demands on physics, through a document: refused with its place, or it runs; never with a NaN, and
// never without end.

namespace tweenfall::hostile_documents {

using namespace tweenfall::test;

namespace {

const std::string floor_node = R"("floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}})";

std::string document(const std::string& nodes, const std::string& rest = "") {
  return "{\"tweenfall\": 1,\n\"nodes\": {" + nodes + "}" + (rest.empty() ? "" : ",\n" + rest) + "}";
}

std::string fault(const std::string& text) {
  return faults_of(text, "test.json", {});
}

bool is_finite(const Stage& stage) {
  std::vector<WorldMotion> world(stage.nodes().size());
  stage.world(world);
  return std::ranges::all_of(world, [](const WorldMotion& node) {
    const Motion& motion = node.motion;
    return motion.pose.position.allFinite() && motion.pose.rotation.coeffs().allFinite() &&
           motion.twist.linear.allFinite() && motion.twist.angular.allFinite();
  });
}

/// Steps it for a while; each step ends with finite numbers.
void run(Stage& stage, double seconds) {
  const double until = stage.time() + seconds;
  while (stage.time() < until) {
    stage.advance(std::max(stage.step(), seconds / 20));
    REQUIRE(is_finite(stage));
  }
}

std::size_t count_of(const Stage& stage, const std::string& event) {
  return static_cast<std::size_t>(std::ranges::count(stage.events(), event, &StageEvent::name));
}

}  // namespace

TEST_CASE("joints to oneself, crossed limits, flat hulls and steps that are none are told with their places") {
  const std::string bodies = floor_node + R"(, "a": {"body": {"shape": {"sphere": {"radius": 0.1}}}},
"b": {"position": [1, 0, 0], "body": {"shape": {"sphere": {"radius": 0.1}}}})";
  const auto place_of = [](const std::string& told) { return told.substr(0, told.find(": error")); };
  CHECK(place_of(fault(document(bodies, R"("world": {"joints": {"pin": {"ball": {}, "between": ["a", "a"]}}})"))) ==
        "test.json:4:59");
  CHECK(
      place_of(fault(document(
          bodies,
          R"("world": {"joints": {"pin": {"hinge": {"axis": "x", "limits": [30, -30]}, "between": ["a", "b"]}}})"))) ==
      "test.json:4:63");
  CHECK(place_of(fault(document(
            bodies, R"("world": {"joints": {"pin": {"distance": {"limits": [2, 1]}, "between": ["a", "b"]}}})"))) ==
        "test.json:4:53");
  CHECK(place_of(fault(document(
            R"("flat": {"body": {"shape": {"hull": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}}}})"))) !=
        "");
  CHECK(fault(document(
                  R"("line": {"body": {"shape": {"hull": {"points": [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]}}}})"))
            .starts_with("test.json:2:"));
  for (const char* step : {"0", "-1", "1e-9", "\"1/0\"", "\"0\"", "1e999"}) {
    CAPTURE(std::string(step));
    CHECK(fault(document(bodies, std::string(R"("world": {"step": )") + step + "}"))
              .starts_with("test.json:4:19: error"));
  }
}

TEST_CASE("steps of ten seconds run, and end with numbers") {
  Stage stage = Stage(
      parsed(
          document(
              floor_node +
                  R"(, "ball": {"position": [0, 3, 0], "body": {"shape": {"sphere": {"radius": 0.1}}, "restitution": 0.9}},
"lower": {"position": [0, 1, 0], "body": {"shape": {"box": {"size": [0.2, 0.2, 0.2]}}}})",
              R"("world": {"step": 10, "joints": {"rope": {"distance": {"limits": [0, 3]}, "between": "lower", "at": [[0, 3, 0], [0, 1, 0]]}}})"))
          .stage());
  run(stage, 200);
}

TEST_CASE("bodies 1e8 m away rest on what is there, and fall on each other") {
  std::string nodes;
  for (int i = 0; i < 6; ++i)
    nodes += (i > 0 ? ", \"box" : "\"box") + std::to_string(i) + "\": {\"position\": [1e8, " +
             std::to_string(0.5 + 1.2 * i) + R"(, -1e8], "body": {"shape": {"box": {"size": [1, 1, 1]}}}})";
  nodes +=
      R"(, "ground": {"position": [1e8, -0.5, -1e8], "body": {"shape": {"box": {"size": [20, 1, 20]}}, "static": true}})";
  Stage stage = Stage(parsed(document(nodes)).stage());
  run(stage, 4);
  for (int i = 0; i < 6; ++i) {
    const Vec3 place = stage.world(stage.node("box" + std::to_string(i))).motion.pose.position;
    CHECK(std::abs(place.y() - (0.5 + i)) < 0.05);
    CHECK(std::hypot(place.x() - 1e8, place.z() + 1e8) < 0.2);
  }
}

TEST_CASE("ten thousand bodies at one point part, and a hundred thousand in one document are read and stepped") {
  const auto spheres = [](int count, bool apart) {
    std::string nodes = floor_node;
    for (int i = 0; i < count; ++i) {
      const double x = apart ? 0.3 * (i % 317) : 0, z = apart ? 0.3 * (i / 317) : 0;
      nodes += ",\n\"" + std::to_string(i) + "\": {\"position\": [" + std::to_string(x) + ", 1, " + std::to_string(z) +
               R"(], "body": {"shape": {"sphere": {"radius": 0.1}}}})";
    }
    return document(nodes, R"("world": {"step": "1/60"})");
  };
  const std::clock_t start = std::clock();
  {
    Stage stage = Stage(parsed(spheres(10'000, false)).stage());
    for (int i = 0; i < 5; ++i) stage.advance(stage.step());
    CHECK(is_finite(stage));
  }
  const std::clock_t between = std::clock();
  {
    Stage stage = Stage(parsed(spheres(100'000, true)).stage());
    for (int i = 0; i < 3; ++i) stage.advance(stage.step());
    CHECK(is_finite(stage));
    CHECK(stage.world(stage.node("99999")).motion.pose.position.y() < 1);
  }
  const auto seconds = [](std::clock_t ticks) { return static_cast<double>(ticks) / CLOCKS_PER_SEC; };
  MESSAGE("10,000 at one point: " << seconds(between - start) << " s; 100,000: " << seconds(std::clock() - between)
                                  << " s");
  CHECK(seconds(std::clock() - start) < 120);
}

TEST_CASE(
    "motors against each other, limits that exclude each other, and what keyed bodies pinch stay finite and are told") {
  const std::string two =
      floor_node + R"(, "a": {"position": [0, 3, 0], "body": {"shape": {"box": {"size": [0.4, 0.4, 0.4]}}}},
"b": {"position": [1, 3, 0], "body": {"shape": {"box": {"size": [0.4, 0.4, 0.4]}}}})";
  {
    Stage stage = Stage(parsed(document(two, R"("world": {"joints": {
      "one": {"hinge": {"axis": "z", "motor": {"speed": 3000}}, "between": ["a", "b"], "at": [0.3, 3, 0]},
      "other": {"hinge": {"axis": "z", "motor": {"speed": -3000}}, "between": ["a", "b"], "at": [0.7, 3, 0]}}})"))
                            .stage());
    run(stage, 3);
    CHECK(count_of(stage, "joint_strained") == 2);
  }
  {
    Stage stage = Stage(parsed(document(two, R"("world": {"joints": {
      "one": {"hinge": {"axis": "z", "limits": [10, 20]}, "between": ["a", "b"], "at": [0.5, 3, 0]},
      "other": {"hinge": {"axis": "z", "limits": [-40, -30]}, "between": ["a", "b"], "at": [0.5, 3, 0]}}})"))
                            .stage());
    run(stage, 3);
    CHECK(count_of(stage, "joint_strained") >= 1);
  }
  {
    Stage stage = Stage(parsed(document(two, R"("world": {"joints": {
      "turns": {"hinge": {"axis": "z", "motor": {"speed": 300}}, "between": ["a", "b"], "at": [0.5, 3, 0]},
      "stops": {"hinge": {"axis": "z", "limits": [-10, 10], "motor": {"speed": 90}}, "between": "a", "at": [0, 3, 0]}}})"))
                            .stage());
    run(stage, 3);
    CHECK(count_of(stage, "joint_strained") == 0);
  }
  {
    Stage stage = Stage(parsed(document(two, R"("world": {"joints": {
      "near": {"distance": {"limits": [0, 0.5]}, "between": ["a", "b"]},
      "far": {"distance": {"limits": [2, 3]}, "between": ["a", "b"]}}})"))
                            .stage());
    run(stage, 3);
    CHECK(count_of(stage, "joint_strained") >= 1);
  }
  {
    Stage stage = Stage(parsed("{\"tweenfall\": 1, \"nodes\": {" + floor_node + R"(,
      "left": {"position": [-1, 0.3, 0], "body": {"shape": {"box": {"size": [0.2, 1, 1]}}}},
      "right": {"position": [1, 0.3, 0], "body": {"shape": {"box": {"size": [0.2, 1, 1]}}}},
      "between": {"position": [0, 0.25, 0], "body": {"shape": {"box": {"size": [0.5, 0.5, 0.5]}}}}},
      "clips": {"close": {"tracks": {"left.position": [[0, [-1, 0.3, 0], "linear"], [1, [-0.02, 0.3, 0]]], "right.position": [[0, [1, 0.3, 0], "linear"], [1, [0.02, 0.3, 0]]]}}}})")
                            .stage());
    run(stage, 3);
    CHECK(count_of(stage, "overlap") >= 1);
    CHECK(stage.world(stage.node("between")).motion.pose.position.norm() < 100);
  }
}

}  // namespace tweenfall::hostile_documents
