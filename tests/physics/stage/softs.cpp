#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/stage/recording.h>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A rope on a hand that moves and opens, above a sheet that tears under a ball, in a wind that jumps.
StageDescription softly_hung(SoftSolver solver) {
  StageDescription stage;
  stage.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  stage.nodes.push_back({.name = "hand", .rest = {.position = Vec3(0, 2, 0)}});
  stage.nodes.push_back({.name = "ball",
                         .rest = {.position = Vec3(1.5, 1.5, 0.5)},
                         .body = BodyDescription{.shape = {Sphere{0.15}}, .mass = 2.0}});
  Clip clip{.name = "wave", .duration = 2};
  clip.tracks.push_back({"hand", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 2, 0), .ease = Ease::smooth()},
                                            {.time = 0.5, .value = Vec3(0.5, 2.2, 0), .ease = Ease::smooth()},
                                            {.time = 2, .value = Vec3(-0.5, 1.8, 0.2)}})});
  stage.clips.push_back(std::move(clip));
  stage.plays.push_back({.clip = 0});
  SoftDescription line{.name = "line",
                       .soft = rope({.from = {0, 2, 0}, .to = {0, 1, 0}, .links = 10, .stiffness = 900})};
  line.soft.thickness = 0.05;
  line.pins = {{.node = 0, .to = 1, .until = when::At{0.7713}}};
  SoftDescription sheet{.name = "sheet",
                        .soft = cloth({.corner = {1, 1, 0},
                                       .columns = 6,
                                       .rows = 6,
                                       .material = {.density = 0.3, .stretching = 150, .damping = 0.2, .tear = 0.25}})};
  sheet.soft.air_drag = 1;
  for (const std::uint32_t corner : {0u, 6u, 42u, 48u}) sheet.pins.push_back({.node = corner});
  for (SoftDescription* soft : {&line, &sheet}) soft->soft.solver = solver;
  stage.softs = {line, sheet};
  stage.forces = {{.force = Wind{.velocity = Vec3(2, 1, 0)},
                   .strength = Strength(keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::hold()},
                                                             {.time = 0.4321, .value = 1.0, .ease = Ease::hold()},
                                                             {.time = 1, .value = 0.2}}))}};
  return stage;
}

bool same(const SoftNodes& a, const SoftNodes& b) {
  return a.positions == b.positions && a.velocities == b.velocities && a.torn == b.torn;
}

}  // namespace

TEST_CASE("soft bodies on a stage go back and on, saved too, to the same bits, whoever holds, blows or tears them") {
  for (const SoftSolver solver : {SoftSolver::positions, SoftSolver::springs}) {
    CAPTURE(static_cast<int>(solver));
    const StageDescription described = softly_hung(solver);
    Stage stage(described);
    stage.advance_to(0.5117);
    const SoftNodes line = stage.soft("line"), sheet = stage.soft("sheet");
    const std::uint64_t hash = stage.state_hash();
    const std::vector<std::byte> saved = stage.save();
    stage.advance_to(1.2);
    const SoftNodes late_line = stage.soft("line"), late_sheet = stage.soft("sheet");
    const std::vector<StageEvent> events(stage.events().begin(), stage.events().end());
    CHECK(std::ranges::count(late_sheet.torn, 1) > 0);
    for (const double back : {0.5117, 0.0}) {
      stage.seek(back);
      if (back > 0) {
        CHECK(same(stage.soft("line"), line));
        CHECK(same(stage.soft("sheet"), sheet));
        CHECK(stage.state_hash() == hash);
      }
      stage.seek(1.2);
      CHECK(same(stage.soft("line"), late_line));
      CHECK(same(stage.soft("sheet"), late_sheet));
    }
    Stage loaded(described), stepped(described);
    loaded.load(saved);
    CHECK(same(loaded.soft("sheet"), sheet));
    loaded.advance_to(1.2);
    CHECK(same(loaded.soft("line"), late_line));
    CHECK(same(loaded.soft("sheet"), late_sheet));
    CHECK(loaded.events().size() == events.size());
    // Whatever the frames are.
    while (stepped.time() < 1.2 - 1e-9) stepped.advance(std::min(0.0371, 1.2 - stepped.time()));
    stepped.advance_to(1.2);
    CHECK(same(stepped.soft("sheet"), late_sheet));
    StageDescription other = described;
    other.softs[0].soft.thickness = 0.06;
    CHECK_THROWS_WITH_AS(Stage(other).load(saved), doctest::Contains("another description"), std::invalid_argument);
  }
}

TEST_CASE("each edge that tears is an event with its time, its place and its soft body's name, in order") {
  Stage stage(softly_hung(SoftSolver::positions));
  std::vector<StageEvent> told;
  stage.on_event([&](const StageEvent& event) {
    if (event.name == "torn") told.push_back(event);
    CHECK(event.time <= stage.time());
  });
  stage.advance_to(1.2);
  const SoftNodes sheet = stage.soft("sheet");
  CHECK(told.size() == static_cast<std::size_t>(std::ranges::count(sheet.torn, 1)));
  REQUIRE(!told.empty());
  double before = 0;
  for (const StageEvent& event : told) {
    CHECK(event.joint == "sheet");
    CHECK(event.nodes.empty());
    CHECK(event.time >= before);
    before = event.time;
    std::size_t edge = 0;
    double x = 0, y = 0, z = 0;
    REQUIRE(std::sscanf(event.data.c_str(), "{\"edge\": %zu, \"at\": [%lf, %lf, %lf]}", &edge, &x, &y, &z) == 4);
    CHECK(sheet.torn.at(edge) == 1);
    CHECK(x > 0.5);
    CHECK(x < 2.5);
  }
  // The ball falls on the sheet first.
  CHECK(told[0].time > std::sqrt(2 * (0.5 - 0.15 - 0.01) / 9.81));
  const Recording recording = record(stage, 1.3, 30);
  CHECK(recording.softs[1].torn_at.size() == sheet.torn.size());
}

// Ropes of eight edges of 12.5 cm and 2.5 g a node, of which each bears 14.7 N: sqrt(l m / T) is 4.6 ms.
TEST_CASE("what hangs heavier on a rope than its sub-steps can hold by positions is told, and it is right") {
  const auto hung = [](double sub_step, int iterations, SoftSolver solver) {
    StageDescription stage;
    stage.step = 1.0 / 60;
    stage.nodes.push_back({.name = "bar",
                           .rest = {.position = Vec3(0, -1, 0)},
                           .body = BodyDescription{.shape = {Box{Vec3(0.4, 0.03, 0.02)}}, .mass = 3.0}});
    for (const double x : {-0.4, 0.4}) {
      SoftDescription line{.name = x < 0 ? "left" : "right",
                           .soft = rope({.from = {x, 0, 0}, .to = {x, -1, 0}, .links = 8, .mass = 0.02})};
      line.soft.solver = solver;
      if (solver == SoftSolver::springs)
        for (SoftEdge& edge : line.soft.edges) edge.stiffness = 1e6;
      line.soft.sub_step = sub_step;
      line.soft.iterations = iterations;
      line.soft.collide = false;
      line.pins = {{.node = 0}, {.node = 8, .to = 0, .point = Vec3(x, 0, 0)}};
      stage.softs.push_back(line);
    }
    return stage;
  };
  const auto told = [](const StageDescription& stage) {
    const StageInspection found = inspect(stage, false);
    return found.extremes.empty() ? std::string() : found.extremes[0].message;
  };
  const auto fallen = [](const StageDescription& stage) {
    Stage run(stage);
    run.advance_to(2);
    return -1 - run.world(0).motion.pose.position.y();
  };
  for (const double sub_step : {1.0 / 60, 1.0 / 120}) {
    const StageDescription loose = hung(sub_step, 1, SoftSolver::positions);
    CHECK(told(loose).find("14.7") != std::string::npos);
    CHECK(std::abs(fallen(loose)) > 0.01);
  }
  for (const StageDescription& firm :
       {hung(1.0 / 240, 1, SoftSolver::positions), hung(1.0 / 120, 20, SoftSolver::positions),
        hung(1.0 / 60, 1, SoftSolver::springs)}) {
    CHECK(told(firm).empty());
    CHECK(std::abs(fallen(firm)) < 1e-3);
  }
}

// An edge between masses of 1 kg acts with at most 4 passes times (1/2 kg) (1920/s)^2. A push by the corner of a cube
// of 1 m makes it larger by 1/6 m^3 per kg: a quarter of 4 passes by (1920/s)^2 over that, times its volume of 1/6 m^3.
TEST_CASE(
    "edges and volumes that act with less than their stiffness are told, with how much, unless sub-steps resolve it") {
  const auto told = [](double edges, double volume, std::optional<double> sub_step, SoftSolver solver) {
    SoftSettings soft{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .masses = {1, 1, 1, 1}};
    for (std::uint32_t b = 1; b < 4; ++b)
      for (std::uint32_t a = 0; a < b; ++a) soft.edges.push_back({.a = a, .b = b, .stiffness = edges});
    // From the fourth, the first three run counter-clockwise.
    if (volume > 0) soft.tetrahedra.push_back({.nodes = {0, 1, 2, 3}, .stiffness = volume});
    soft.solver = solver;
    soft.sub_step = sub_step;
    StageDescription stage;
    stage.softs.push_back({.name = "frame", .soft = soft});
    const StageInspection found = inspect(stage, false);
    return found.extremes.empty() ? std::string() : found.extremes[0].message;
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const std::string of_edges = told(1e9, 0, {}, SoftSolver::positions);
  CHECK(has(of_edges, "has edges of 1e+09 N/m that act with 7.3728e+06 N/m"));
  // 1/1920 s by the root of how much too stiff they are
  CHECK(has(of_edges, "sub-steps of less than 4.4721e-05 s"));
  CHECK(told(1e9, 0, 4.47e-5, SoftSolver::positions).empty());
  CHECK(told(7.3e6, 0, {}, SoftSolver::positions).empty());
  CHECK(told(1e9, 0, {}, SoftSolver::springs).empty());
  CHECK(has(told(1, 1e8, {}, SoftSolver::positions), "has volumes of 1e+08 Pa that act with 3.6864e+06 Pa"));
  CHECK(told(1, 3.6e6, {}, SoftSolver::positions).empty());
  CHECK(told(1, 1e8, {}, SoftSolver::springs).empty());
}
