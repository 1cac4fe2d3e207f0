#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

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
  // The world's, where particles say none
  CHECK(plain.settings.gravity == Vec3(0, -3.7, 0));
  CHECK(plain.emitters[0].speed.value(0) == 2);
  CHECK(plain.emitters[0].direction == Vec3(0, 1, 0));
  // It runs, and what is written is read again as the same.
  Stage run(stage);
  run.advance_to(2);
  CHECK(run.particles("plain").positions.size() == 10);
  CHECK(Document::parse(document.text(), "again.json", ".").text() == document.text());
}
