// Documents that once broke the world, run through the command: the resulting numbers, frame by frame. They come from
// the shared folder, each with a variant that has other numbers.

#include "command.h"

#include <tweenfall/physics/shape.h>

#include <cmath>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

namespace fs = std::filesystem;

/// The document of this name in the shared folder, when it is there, and a variant of it.
std::vector<std::string> shared_and(const std::string& name, const std::string& variant) {
  const fs::path file = fs::path(TWEENFALL_SOURCE_DIR) / "../shared/faults" / (name + ".json");
  if (fs::exists(file)) return {detail::content(file), variant};
  MESSAGE("SKIPPED: no ../shared/faults/" << name << ".json; only the variant of it is run");
  return {variant};
}

/// The recording of a run, which must end well, with an output file and without.
nlohmann::json recorded(const std::string& document, const std::string& options) {
  const Folder folder;
  folder.write("fault.json", document);
  const Ran summary = folder.run("run fault.json " + options);
  CHECK_MESSAGE(summary.code == 0, summary.err);
  const Ran ran = folder.run("run fault.json " + options + " -o out.json");
  REQUIRE_MESSAGE(ran.code == 0, ran.err);
  return nlohmann::json::parse(folder.read("out.json"));
}

/// A vector of a node in a frame.
Vec3 vector_of(const nlohmann::json& recording, const char* node, const char* what, std::size_t frame) {
  const nlohmann::json& value = recording.at("nodes").at(node).at(what).at(frame);
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

std::size_t frames_of(const nlohmann::json& recording) {
  return recording.at("times").size();
}

double time_of(const nlohmann::json& recording, std::size_t frame) {
  return recording.at("times").at(frame).get<double>();
}

/// The farthest that a body moves from where it is in the first frame, m.
double strayed(const nlohmann::json& recording, const char* node) {
  double most = 0;
  for (std::size_t i = 0; i < frames_of(recording); ++i)
    most =
        std::max(most, (vector_of(recording, node, "position", i) - vector_of(recording, node, "position", 0)).norm());
  return most;
}

}  // namespace

TEST_CASE("a stack stands where it stood when something far from it leaves its script beside a step's end") {
  const std::string other = R"({"tweenfall": 1,
    "nodes": {
      "floor": {"body": {"shape": {"plane": {}}, "static": true}},
      "a": {"position": [0, 0.25, 0], "body": {"shape": {"box": {"size": [1, 0.5, 1]}}}},
      "b": {"position": [0, 0.75, 0], "body": {"shape": {"box": {"size": [1, 0.5, 1]}}}},
      "k": {"position": [9, 1, 0], "body": {"shape": {"sphere": {"radius": 0.1}}, "drive": "keyed"}}},
    "world": {"sleep_after": "never"},
    "handoff": [{"body": "k", "when": {"at": 2.3000000000000003}, "to": "free"}]})";
  for (const std::string& document : shared_and("split_near_a_boundary", other)) {
    const nlohmann::json recording = recorded(document, "--until 4");
    for (const char* box : {"a", "b"}) CHECK(strayed(recording, box) < 1e-4);
    CHECK(recording.at("handoffs").size() == 1);
  }
}

TEST_CASE("a loop of something without a body moves nothing of a stack beside it") {
  const auto stack = [](const std::string& duration) {
    return R"({"tweenfall": 1, "nodes": {"floor": {"body": {"shape": {"plane": {}}, "static": true}}, "deco": {},
      "b0": {"position": [0, 0.5, 0], "body": {"shape": {"box": {"size": [1, 1, 1]}}}},
      "b1": {"position": [0.05, 1.5, 0], "body": {"shape": {"box": {"size": [1, 1, 1]}}}},
      "b2": {"position": [0.1, 2.5, 0], "body": {"shape": {"box": {"size": [1, 1, 1]}}}}},
      "clips": {"spin": {"duration": )" +
           duration + R"(, "loop": {"mode": "repeat"},
        "tracks": {"deco.position": [[0, [0, 9, 0]], [)" +
           duration + R"(, [1, 9, 0]]]}}}})";
  };
  for (const std::string& document : shared_and("loop_beside_a_stack", stack("0.0166666667"))) {
    const nlohmann::json recording = recorded(document, "--until 4");
    for (const char* box : {"b0", "b1", "b2"}) {
      CHECK(strayed(recording, box) < 1e-3);
      CHECK(vector_of(recording, box, "velocity", frames_of(recording) - 1).norm() < 0.01);
    }
  }
}

TEST_CASE("a tumbling box at restitution 1 has in no frame more energy than in the first") {
  const std::string other = R"({"tweenfall": 1,
    "nodes": {
      "floor": {"body": {"shape": {"plane": {}}, "static": true, "friction": 0}},
      "box": {"position": [0, 1.4, 0],
        "body": {"shape": {"box": {"size": [0.3, 0.2, 0.5]}}, "mass": 1, "friction": 0, "restitution": 1,
                 "angular_velocity": [-300, 500, 20]}}},
    "world": {"step": "1/100", "sleep_after": "never"}})";
  const Mat3 inertia = mass_properties({Box{Vec3(0.15, 0.1, 0.25)}}, 1).inertia;
  for (const std::string& document : shared_and("energy_of_a_tumbling_box", other)) {
    const std::string rate = document == other ? "100" : "60";
    const nlohmann::json recording = recorded(document, "--until 4 --fps " + rate);
    const auto energy = [&](std::size_t frame) {
      const nlohmann::json& q = recording.at("nodes").at("box").at("rotation").at(frame);
      const Mat3 axes = Quat(q.at(3), q.at(0), q.at(1), q.at(2)).toRotationMatrix();
      const Vec3 spin = axes.transpose() * vector_of(recording, "box", "angular_velocity", frame);
      return 0.5 * vector_of(recording, "box", "velocity", frame).squaredNorm() + 0.5 * spin.dot(inertia * spin) +
             9.81 * vector_of(recording, "box", "position", frame).y();
    };
    const double start = energy(0);
    double most = 0;
    for (std::size_t i = 0; i < frames_of(recording); ++i) most = std::max(most, energy(i));
    CHECK(most <= start * (1 + 1e-9));
    CHECK(energy(frames_of(recording) - 1) > 0.9 * start);
  }
}

TEST_CASE("a lift presses on what rides on it with gravity and its own acceleration, within one percent") {
  // Height -amplitude cos(w t): the rider weighs g + amplitude w^2 cos(w t) per kilogram.
  struct Lift {
    double amplitude, hz;
  };
  const auto lift = [](const Lift& of) {
    return R"({"tweenfall": 1, "nodes": {
      "lift": {"body": {"shape": {"box": {"size": [1, 0.2, 1]}}, "mass": 50}},
      "box": {"position": [0, )" +
           std::to_string(0.25 - of.amplitude) +
           R"(, 0], "body": {"shape": {"box": {"size": [0.3, 0.3, 0.3]}}, "mass": 1.2}}},
      "clips": {"c": {"tracks": {"lift.position": {"oscillator": {"amplitude": [0, )" +
           std::to_string(-of.amplitude) + R"(, 0], "hz": )" + std::to_string(of.hz) + "}}}}}}";
  };
  const Lift ours{0.12, 1.25}, theirs{0.5, 0.5};
  for (const std::string& text : shared_and("elevator", lift(ours))) {
    const Lift& of = text == lift(ours) ? ours : theirs;
    const double w = 2 * pi * of.hz;
    std::string document = text;
    document.insert(document.rfind('}'), R"(, "world": {"step": "1/240"})");
    const nlohmann::json recording = recorded(document, "--until 4 --fps 240");
    double worst = 0;
    for (std::size_t i = 121; i < frames_of(recording); ++i) {
      const double before = time_of(recording, i - 1), time = time_of(recording, i);
      const double gained =
          vector_of(recording, "box", "velocity", i).y() - vector_of(recording, "box", "velocity", i - 1).y();
      const double force = 9.81 + gained / (time - before);
      const double right = 9.81 + of.amplitude * w * (std::sin(w * time) - std::sin(w * before)) / (time - before);
      worst = std::max(worst, std::abs(force / right - 1));
    }
    CHECK(worst < 0.01);
  }
}

TEST_CASE("a driven body keeps up with a slow path and never falls asleep on it") {
  const std::string other = R"({"tweenfall": 1, "world": {"gravity": [0, 0, 0]},
    "nodes": {"b": {"body": {"shape": {"sphere": {"radius": 0.2}}, "mass": 1, "drive": {"hz": 4}}}},
    "clips": {"c": {"tracks": {"b.position": [[0, [0, 1, 0], "linear"], [10, [0.1, 1.003, 0], "linear"]]}}}})";
  for (const std::string& document : shared_and("slow_drive_falls_asleep", other)) {
    const nlohmann::json recording = recorded(document, "--until 4");
    double lag = 0;
    for (std::size_t i = 0; i < frames_of(recording); ++i)
      lag = std::max(lag, std::abs(vector_of(recording, "b", "position", i).x() - 0.01 * time_of(recording, i)));
    CHECK(lag < 1e-12);
    CHECK(vector_of(recording, "b", "velocity", frames_of(recording) - 1).x() == doctest::Approx(0.01));
  }
}

TEST_CASE("what starts half in the floor comes out of it at the speed for that, and then rests") {
  const std::string other = R"({"tweenfall": 1, "nodes": {
    "floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}},
    "crate": {"position": [0, 0.2, 0], "body": {"shape": {"box": {"size": [1, 1, 1]}}}}}})";
  for (const std::string& document : shared_and("asleep_in_the_floor", other)) {
    const nlohmann::json recording = recorded(document, "--until 4");
    const std::size_t last = frames_of(recording) - 1;
    CHECK(std::abs(vector_of(recording, "crate", "position", last).y() - 0.5) < 1e-3);
    CHECK(vector_of(recording, "crate", "velocity", last) == Vec3(0, 0, 0));
    for (std::size_t i = 1; i <= last; ++i) {
      const double risen =
          vector_of(recording, "crate", "position", i).y() - vector_of(recording, "crate", "position", i - 1).y();
      CHECK(risen <= 0.5 * (time_of(recording, i) - time_of(recording, i - 1)) + 1e-6);
    }
  }
}

TEST_CASE("bodies that start in each other part at the speed for that, and only then sleep") {
  const std::string other = R"({"tweenfall": 1, "world": {"gravity": [0, 0, 0]}, "nodes": {
    "a": {"body": {"shape": {"sphere": {"radius": 0.5}}, "mass": 1}},
    "b": {"position": [0.3, 0.1, 0], "body": {"shape": {"sphere": {"radius": 0.5}}, "mass": 4}}}})";
  for (const std::string& document : shared_and("asleep_in_each_other", other)) {
    const nlohmann::json recording = recorded(document, "--until 5");
    const auto apart = [&](std::size_t frame) {
      return (vector_of(recording, "a", "position", frame) - vector_of(recording, "b", "position", frame)).norm();
    };
    const std::size_t last = frames_of(recording) - 1;
    CHECK(apart(last) > 1 - 2e-3);
    CHECK(apart(last) < 1 + 1e-3);
    for (const char* ball : {"a", "b"}) CHECK(vector_of(recording, ball, "velocity", last) == Vec3(0, 0, 0));
    for (std::size_t i = 1; i <= last; ++i)
      CHECK(apart(i) - apart(i - 1) <= 0.5 * (time_of(recording, i) - time_of(recording, i - 1)) + 1e-6);
  }
}

TEST_CASE("a spring too stiff for the step settles and never swings wider than it was drawn") {
  const std::string other = R"({"tweenfall": 1,
    "world": {"gravity": [0, 0, 0], "forces": [{"spring": {"a": "a", "stiffness": 3e8}}]},
    "nodes": {"a": {"position": [0.6, -0.3, 0.2], "body": {"shape": {"sphere": {"radius": 0.2}}, "mass": 0.7}}}})";
  for (const std::string& document : shared_and("stiff_spring", other)) {
    const nlohmann::json recording = recorded(document, "--until 4");
    const double drawn = vector_of(recording, "a", "position", 0).norm();
    for (std::size_t i = 0; i < frames_of(recording); ++i)
      CHECK(vector_of(recording, "a", "position", i).norm() <= drawn * (1 + 1e-9));
    CHECK(vector_of(recording, "a", "position", frames_of(recording) - 1).norm() < 1e-3);
  }
}

TEST_CASE("what spins by ten million degrees per second stays where it is, and finite") {
  const std::string other =
      R"({"tweenfall": 1, "nodes": {"b": {"body": {"shape": {"capsule": {"radius": 0.1, "height": 0.4}},
    "angular_velocity": [-3e7, 1e6, 2e7]}}}, "world": {"gravity": [0, 0, 0]}})";
  for (const std::string& document : shared_and("spin_of_ten_million_degrees", other)) {
    const nlohmann::json recording = recorded(document, "--until 4");
    CHECK(strayed(recording, "b") == 0);
    const double spin = vector_of(recording, "b", "angular_velocity", 0).norm();
    for (std::size_t i = 0; i < frames_of(recording); ++i)
      CHECK(vector_of(recording, "b", "angular_velocity", i).norm() < 3 * spin);
  }
}

TEST_CASE("a force that no body can bear is refused by check and by run, with its numbers") {
  const std::string other = R"({"tweenfall": 1,
    "nodes": {"n": {"position": [1, 1, 2], "body": {"shape": {"capsule": {"radius": 0.01, "height": 0.1}}}}},
    "world": {"forces": [{"spring": {"a": "n", "rest_length": 3e40, "stiffness": 1}}]}})";
  for (const std::string& document : shared_and("hull_and_capsule", other)) {
    const Folder folder;
    folder.write("fault.json", document);
    for (const char* verb : {"check fault.json", "run fault.json --until 1", "run fault.json --until 1 -o out.json"}) {
      const Ran ran = folder.run(verb);
      CHECK(ran.code == 1);
      CHECK_MESSAGE(ran.err.find("rest length of a spring must lie in 0 to 1e30") != std::string::npos, ran.err);
    }
    CHECK(!folder.has("out.json"));
  }
}

TEST_CASE("the node whose motion is no longer finite is named, with the time and the cause, and run exits with 1") {
  const Folder folder;
  folder.write("thrown.json", R"({"tweenfall": 1,
    "world": {"gravity": [0, 1e29, 0]},
    "nodes": {"first": {}, "anvil": {"body": {"shape": {"sphere": {"radius": 0.2}}}}}})");
  for (const char* verb : {"run thrown.json --until 30", "run thrown.json --until 30 -o out.json"}) {
    const Ran ran = folder.run(verb);
    CHECK(ran.code == 1);
    CHECK_MESSAGE(ran.err.find("the motion of \"anvil\" is no longer finite at ") != std::string::npos, ran.err);
    CHECK_MESSAGE(ran.err.find("/s") != std::string::npos, ran.err);
  }
  CHECK(!folder.has("out.json"));
}
