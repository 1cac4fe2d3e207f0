#include "importers/document/document_files.h"

#include <tweenfall/importers/inputs.h>
#include <tweenfall/physics/stage/recording.h>

#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE(
    "vehicles and particles of a document mean what it says, in radians and by what is usual where it says nothing") {
  const Document document = Document::read(data_folder() / "documents/good/actors.json");
  const StageDescription& stage = document.stage();
  REQUIRE(stage.vehicles.size() == 1);
  const VehicleDescription& rover = stage.vehicles[0];
  CHECK(stage.nodes[rover.chassis].name == "car");
  CHECK(rover.forward == Vec3(0, 0, -1));
  REQUIRE(rover.wheels.size() == 2);
  CHECK(rover.wheels[0].lock == doctest::Approx(std::numbers::pi / 6));
  CHECK(rover.wheels[0].torque == 200);
  CHECK(rover.wheels[0].wheel.side_grip == 0.7);
  CHECK(rover.wheels[1].name == "aft");
  CHECK(rover.wheels[1].wheel.stiffness == WheelSettings{}.stiffness);
  CHECK(rover.throttle.at(1) == 1);
  CHECK(rover.brake.at(std::numbers::pi / 2) == doctest::Approx(1));
  CHECK(rover.brake.at(4) == 0);
  CHECK(rover.steer.at(3) == -0.5);

  REQUIRE(stage.particles.size() == 2);
  const ParticlesDescription &spray = stage.particles[0], &plain = stage.particles[1];
  REQUIRE(spray.emitters.size() == 2);
  const EmitterDescription& nozzle = spray.emitters[0];
  CHECK(stage.nodes[nozzle.node].name == "nozzle");
  CHECK(nozzle.direction == Vec3(0, 1, 0));
  CHECK(nozzle.rate.value(0) == doctest::Approx(150));
  CHECK(nozzle.speed.value(1) == 3);
  CHECK(nozzle.spread == doctest::Approx(std::numbers::pi / 12));
  CHECK(nozzle.start == 0.5);
  CHECK(spray.emitters[1].node == no_node);
  CHECK(spray.settings.gravity == Vec3(0, -9.81, 0));
  CHECK(spray.settings.integrator == Integrator::rk4);
  CHECK(spray.settings.most == 500);
  CHECK(spray.forces.size() == 2);
  CHECK_FALSE(spray.collide);
  // The gravity of the world, for particles without their own
  CHECK(plain.settings.gravity == Vec3(0, -3.7, 0));
  CHECK(plain.emitters[0].speed.value(0) == 2);
  CHECK(plain.emitters[0].direction == Vec3(0, 1, 0));
  // It runs, and reading what is written gives the same.
  Stage run(stage);
  run.advance_to(2);
  CHECK(run.particles("plain").positions.size() == 10);
  CHECK(Document::parse(document.text(), "again.json", ".").text() == document.text());
}

namespace {

const char* const two_cars = R"({"tweenfall": 1, "nodes": {
  "road": {"body": {"shape": {"plane": {}}, "static": true}},
  "car": {"position": [0, 0.5, 0], "body": {"shape": {"box": {"size": [3, 0.2, 1.4]}}, "mass": 800}}},
  "world": {"vehicles": {
    "rover": {"chassis": "car", "wheels": {"fore": {"mount": [0, 0, 0], "torque": 900, "lock": 20}}}%s}}})";

StageDescription cars(const std::string& second = "") {
  std::string text = two_cars;
  text.replace(text.find("%s"), 2, second);
  return Document::parse(text, "cars.json", ".").stage();
}

std::string control_faults(const std::string& row, const std::string& second = "") {
  try {
    static_cast<void>(parse_inputs("{\"tweenfall\": 1, \"inputs\": [\n" + row + "]}", "i.json", cars(second)));
  } catch (const DocumentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("inputs drive a vehicle, are written so that the same are read, and lead to the same bits") {
  const StageDescription described = cars();
  const std::vector<TimedInput> inputs = parse_inputs(R"({"tweenfall": 1, "inputs": [
    {"at": 0.1003, "control": {"throttle": 0.75, "steer": -0.25}},
    {"at": 0.4, "control": {"vehicle": "rover", "throttle": 0, "brake": 1}}]})",
                                                      "i.json", described);
  REQUIRE(inputs.size() == 2);
  const input::Control first = std::get<input::Control>(inputs[0].what);
  CHECK(first.vehicle == "rover");
  CHECK(first.control.throttle == 0.75);
  CHECK(first.control.steer == -0.25);
  CHECK_FALSE(first.control.brake.has_value());
  const std::string once = inputs_json(inputs);
  CHECK(inputs_json(parse_inputs(once, "i.json", described)) == once);
  Stage played(described), again(described), alone(described);
  static_cast<void>(advance_with(played, inputs, 1));
  CHECK(inputs_json(played.inputs()) == once);
  static_cast<void>(advance_with(again, parse_inputs(once, "i.json", described), 1));
  alone.advance_to(1);
  CHECK(played.state_hash() == again.state_hash());
  CHECK(played.state_hash() != alone.state_hash());
  CHECK(played.twist(played.node("car")).linear.x() > 0.05);
}

TEST_CASE("a control of no vehicle, or that says nothing, is told at its place") {
  const auto says = [](const std::string& row, const std::string& part, const std::string& second = "") {
    const std::string faults = control_faults(row, second);
    CAPTURE(faults);
    CHECK(faults.find(part) != std::string::npos);
  };
  says(R"({"at": 1, "control": {"vehicle": "rovr", "brake": 1}})",
       "i.json:2:34: error: there is no vehicle \"rovr\"; did you mean \"rover\"?");
  says(R"({"at": 1, "control": {}})", "i.json:2:22: error: a control needs a \"throttle\", a \"brake\" or a \"steer\"");
  says(R"({"at": 1, "control": {"brake": -0.5}})", "a number from 0 to 1");
  CHECK(control_faults(R"({"at": 1, "control": {"brake": -0.5}})", "").find("a control needs") == std::string::npos);
  says(R"({"at": 1, "control": {"steer": 1.5}})", "a number from -1 to 1");
  says(R"({"at": 1, "control": {"throtle": 1}})", "did you mean \"throttle\"?");
  says(R"({"at": 1, "control": {"brake": 1}})",
       "the stage has several vehicles, \"rover\", \"other\"; say which \"vehicle\"",
       R"(, "other": {"chassis": "car", "wheels": {"aft": {"mount": [-1, 0, 0]}}})");
}

TEST_CASE("soft bodies of a document have groups, a thickness and air drag; in vain they are noted") {
  const StageDescription stage = Document::read(data_folder() / "documents/good/everything.json").stage();
  const SoftSettings& sheet = stage.softs[1].soft;
  CHECK(sheet.thickness == 0.3);
  CHECK(sheet.air_drag == 1.2);
  CHECK(sheet.collides_with != ~std::uint64_t{0});
  CHECK((sheet.groups & sheet.collides_with) != 0);
  CHECK((sheet.groups & 1) == 1);
  const auto notes = [](const std::string& world) {
    const Document document = Document::parse("{\"tweenfall\": 1, \"world\": {" + world + "}}", "n.json", ".");
    std::string out;
    for (const Problem& note : document.notes()) out += note.text();
    return out;
  };
  const std::string cloth =
      R"("soft": {"flag": {"cloth": {"corner": [0, 2, 0], "along": [1, 0, 0], "across": [0, 1, 0], "cells": [10, 10]})";
  CHECK(notes(cloth + "}}").empty());
  CHECK(notes(cloth + R"(, "air_drag": 1}})").find("(at /world/soft/flag/air_drag)") != std::string::npos);
  CHECK(notes(cloth + R"(, "air_drag": 1}}, "forces": [{"wind": {"velocity": [5, 0, 0]}}])").empty());
  const std::string line = R"("soft": {"line": {"rope": {"from": [0, 0, 0], "to": [1, 0, 0], "links": )";
  CHECK(notes(line + "60000}}}").find("60001 nodes are slow") != std::string::npos);
  CHECK(notes(line + "600}}}").empty());
  CHECK(notes(cloth + R"(, "thickness": 0.01}})").find("slips through itself") != std::string::npos);
  CHECK(notes(cloth + R"(, "thickness": 0.1}})").empty());
  const std::string emitters = R"("particles": {"rain": {"emitters": [{"rate": 1e9}], "life": 2)";
  const std::string crowded = notes(emitters + "}}");
  CHECK(crowded.find("up to 2000000000 particles would be there at a time; those beyond \"most\", 1000000") !=
        std::string::npos);
  CHECK(crowded.find("slow") != std::string::npos);
  CHECK(notes(emitters + R"(, "most": 1000}})").find("slow") == std::string::npos);
  CHECK(notes(R"("particles": {"rain": {"emitters": [{"rate": 100}], "life": 2}})").empty());
}

TEST_CASE("controls of a vehicle beyond their range are refused, as constants and as keys") {
  const auto said = [](const std::string& control) {
    try {
      (void)Document::parse(
          "{\"tweenfall\": 1, \"nodes\": {\"cart\": {\"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}}}, "
          "\"world\": "
          "{\"vehicles\": {\"car\": {\"chassis\": \"cart\", \"wheels\": {\"w\": {\"mount\": [0, 0, 0]}},\n" +
              control + "}}}}",
          "n.json", {});
      return std::string();
    } catch (const DocumentError& error) {
      return std::string(error.what());
    }
  };
  const auto starts = [](const std::string& text, const std::string& start) {
    CAPTURE(text);
    CHECK(text.find(start) != std::string::npos);
  };
  starts(said("\"steer\": 30"), "n.json:2:10: error: expected a number from -1 to 1, found 30");
  starts(said("\"throttle\": 2"), "n.json:2:13: error: expected a number from -1 to 1, found 2");
  starts(said("\"brake\": -0.5"), "n.json:2:10: error: expected a number from 0 to 1, found -0.5");
  starts(said("\"steer\": [[0, 0], [1, 30]]"), "n.json:2:23: error: expected a number from -1 to 1, found 30");
  starts(said("\"brake\": [[0, 0], {\"t\": 1, \"v\": 1.5}]"), "expected a number from 0 to 1, found 1.5");
  CHECK(said("\"steer\": [[0, -1], [1, 1]], \"throttle\": -1, \"brake\": {\"expression\": \"2 * t\"}").empty());
}
