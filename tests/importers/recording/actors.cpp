#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>
#include <tweenfall/importers/recording_file.h>

#include "support.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// For the element after the title of `name`: its first path, as points in order, and where lines begin.
std::vector<Vec2> drawn_points(const std::string& svg, const std::string& name, std::size_t* lines = nullptr) {
  const std::size_t title = svg.find("<title>" + name + "</title>");
  REQUIRE(title != std::string::npos);
  const std::size_t from = svg.find(" d=\"", title) + 4;
  const std::string path = svg.substr(from, svg.find('"', from) - from);
  std::vector<Vec2> points;
  const std::regex point("([ML])(-?[0-9.]+) (-?[0-9.]+)");
  for (auto it = std::sregex_iterator(path.begin(), path.end(), point); it != std::sregex_iterator(); ++it) {
    points.emplace_back(std::stod((*it)[2]), std::stod((*it)[3]));
    if (lines && (*it)[1] == "M") ++*lines;
  }
  return points;
}

Document of_lecture(const std::string& name) {
  return Document::read(std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/lectures" / (name + ".json"));
}

struct Run {
  StageDescription stage;
  Recording recording;
  Run(const std::string& lecture, double until, double fps) : stage(of_lecture(lecture).stage()) {
    Stage running(stage);
    recording = record(running, until, fps);
  }
};

/// A rope of ten links that hangs straight and then is laid along x, and tears in the middle on the way.
Run laid_rope(bool tears) {
  Run run("soft/rope_positions", 0, 1);
  run.stage = {};
  run.stage.softs.push_back({.name = "rope", .soft = rope({.from = {0, 1, 0}, .to = {0, 0, 0}, .links = 10})});
  run.recording = {};
  run.recording.times = {0, 1};
  SoftRecord record{.name = "rope", .positions = {{}, {}}, .torn_at = std::vector<std::size_t>(10, 2)};
  for (int i = 0; i <= 10; ++i) {
    record.positions[0].emplace_back(0, 1 - 0.1 * i, 0);
    record.positions[1].emplace_back(0.1 * i, 0, 0);
  }
  if (tears) record.torn_at[5] = 1;
  run.recording.softs.push_back(std::move(record));
  return run;
}

}  // namespace

TEST_CASE("a recording as JSON gives the energies of soft bodies and particles by name, and the total of all") {
  const Run rope("soft/rope_positions", 0.5, 10), water("particles/fountain", 0.5, 10);
  const auto json_of = [](const Run& run) { return nlohmann::json::parse(recording_json(run.recording)); };
  const nlohmann::json hung = json_of(rope)["energy"], flown = json_of(water)["energy"];
  const std::size_t last = rope.recording.times.size() - 1;
  const StageEnergy& energy = rope.recording.energy[last];
  CHECK(hung["soft"]["rope"]["kinetic"][last] == energy.softs[0].kinetic);
  CHECK(hung["soft"]["rope"]["elastic"][last] == energy.softs[0].elastic);
  CHECK(hung["soft"]["rope"]["weight"][last] == energy.softs[0].weight);
  CHECK(hung["total"][last] == energy.total());
  CHECK(!hung.contains("particles"));
  CHECK(flown["particles"]["water"]["kinetic"][0] == 0);
  CHECK(flown["particles"]["water"]["kinetic"][last] == water.recording.energy[last].particles[0].kinetic);
  CHECK(flown["particles"]["water"]["weight"][last] == water.recording.energy[last].particles[0].weight);
  CHECK(flown["total"][last] == water.recording.energy[last].total());
  CHECK(!flown.contains("soft"));
  Run odd = rope;
  odd.recording.energy[1].softs.clear();
  CHECK_THROWS_WITH(
      static_cast<void>(recording_json(odd.recording)),
      doctest::Contains("the energy tells of more or fewer soft bodies or kinds of particles than there are"));
}

TEST_CASE("the moving picture draws a rope as one line through its nodes, and one that tears in pieces") {
  const Run whole = laid_rope(false);
  std::size_t lines = 0;
  const std::vector<Vec2> points = drawn_points(recording_svg(whole.recording, whole.stage), "rope", &lines);
  CHECK(lines == 1);
  REQUIRE(points.size() == 11);
  // It may be drawn from either end: nodes are 0.1 m apart, and it is 1 m long.
  const double scale = (points.back() - points.front()).norm();
  CHECK(scale > 100);
  for (std::size_t i = 1; i < points.size(); ++i)
    CHECK((points[i] - points[i - 1]).norm() == doctest::Approx(0.1 * scale).epsilon(0.02));
  const Run torn = laid_rope(true);
  const std::string svg = recording_svg(torn.recording, torn.stage);
  lines = 0;
  CHECK(drawn_points(svg, "rope", &lines).size() == 20);
  CHECK(lines == 10);
  // In the second frame the torn link is a point.
  const std::size_t values = svg.find(';', svg.find(" values=\"", svg.find("<title>rope</title>"))) + 1;
  const std::string second = svg.substr(values, svg.find(';', values) - values);
  const std::regex link("M([-0-9.]+ [-0-9.]+)L([-0-9.]+ [-0-9.]+)");
  std::size_t points_only = 0, links = 0;
  for (auto it = std::sregex_iterator(second.begin(), second.end(), link); it != std::sregex_iterator(); ++it, ++links)
    if ((*it)[1] == (*it)[2]) ++points_only;
  CHECK(links == 10);
  CHECK(points_only == 1);
}

TEST_CASE("the moving picture of a cloth shows its hem and some of its threads, and stays small") {
  const Run run("soft/cloth_positions", 1.5, 60);
  const std::string svg = recording_svg(run.recording, run.stage);
  CHECK(svg.size() < 300000);
  std::size_t lines = 0;
  const std::vector<Vec2> points = drawn_points(svg, "sheet", &lines);
  CHECK(lines > 4);
  CHECK(points.size() > 4 * 17);
  CHECK(points.size() < 400);
}

TEST_CASE("wheels are drawn where they are, in the moving picture and as nodes of a model") {
  const Run run("vehicle/brakes", 1, 30);
  const std::string svg = recording_svg(run.recording, run.stage);
  for (const char* wheel : {"car/front left", "car/front right", "car/rear left", "car/rear right"})
    CHECK(count(svg, std::string("<title>") + wheel + "</title>") == 1);
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "tweenfall_wheels.glb";
  save_recording(run.recording, run.stage, file);
  const Model model = load_model(file);
  std::filesystem::remove(file);
  const auto wheel = std::ranges::find(model.nodes, std::string("car/front left"), &Node::name);
  REQUIRE(wheel != model.nodes.end());
  // 1.3 m in front of the middle, 0.75 m to its left, and as low as the springs carry 1000 kg
  CHECK(near(wheel->rest.position, Vec3(1.3, 0.518 - 0.3, -0.75), 2e-2));
}

TEST_CASE("what vehicles, particles and energies were is in a recording's text") {
  const Run fountain("particles/fountain", 1, 20), car("vehicle/brakes", 1, 20);
  const nlohmann::json water = nlohmann::json::parse(recording_json(fountain.recording));
  const nlohmann::json& last = water.at("particles").at("water").at("positions").back();
  // 400 t from 0 to 1 s, smoothed at its ends: half of 400
  CHECK(last.size() == 200);
  CHECK(water.at("particles").at("water").at("numbers").back().size() == last.size());
  CHECK(last[7][1].get<double>() == fountain.recording.particles[0].frame.back().positions[7].y());
  const nlohmann::json drive = nlohmann::json::parse(recording_json(car.recording));
  const nlohmann::json& wheel = drive.at("vehicles").at("car").at("front left");
  CHECK(wheel.at("position").size() == car.recording.times.size());
  CHECK(wheel.at("load").back().get<double>() == doctest::Approx(1000 * 9.81 / 4).epsilon(0.02));
}

TEST_CASE("energies of a run: a swing's is its spring's and its speed's, and together they stay") {
  const Run run("integrators/implicit_trapezoid", 3, 30);
  const nlohmann::json text = nlohmann::json::parse(recording_json(run.recording));
  const nlohmann::json& energy = text.at("energy");
  REQUIRE(energy.at("kinetic").size() == run.recording.times.size());
  REQUIRE(energy.at("forces").size() == 1);
  const double first = energy.at("kinetic")[0].get<double>() + energy.at("forces")[0][0].get<double>();
  CHECK(first == doctest::Approx(16));
  double swings = 0;
  for (std::size_t frame = 0; frame < run.recording.times.size(); ++frame) {
    const double kinetic = energy.at("kinetic")[frame].get<double>();
    CHECK(kinetic + energy.at("forces")[0][frame].get<double>() == doctest::Approx(first).epsilon(1e-9));
    swings = std::max(swings, kinetic);
  }
  CHECK(swings > 0.9 * first);
}

TEST_CASE("a table has a row for each particle, wheel and soft node of each frame, with what each has") {
  const Run fountain("particles/fountain", 0.5, 20), car("vehicle/brakes", 0.2, 10),
      rope("soft/rope_positions", 0.1, 10);
  const std::string table = recording_csv(fountain.recording);
  std::size_t all = 0;
  for (const StageParticles& there : fountain.recording.particles[0].frame) all += there.numbers.size();
  REQUIRE(all > 50);
  CHECK(count(table, ",particle,") == all);
  // Every row has as many fields as the header.
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) CHECK(std::ranges::count(line, ',') == 15);
  const StageParticles& last = fountain.recording.particles[0].frame.back();
  CHECK(table.find(number_text(fountain.recording.times.back()) + ",water:" + std::to_string(last.numbers[0]) +
                   ",particle," + number_text(last.positions[0].x()) + ",") != std::string::npos);
  CHECK(count(recording_csv(car.recording), "car/front left,wheel,") == car.recording.times.size());
  CHECK(count(recording_csv(rope.recording), ",soft,") ==
        rope.recording.times.size() * rope.recording.softs[0].positions[0].size());
}

TEST_CASE("a .glb shows particles where they are at each frame, and of too many every second or third") {
  const Run fountain("particles/fountain", 1, 20);
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "tweenfall_fountain.glb";
  save_recording(fountain.recording, fountain.stage, file);
  const Model model = load_model(file);
  std::filesystem::remove(file);
  std::vector<std::string> dots;
  for (const Node& node : model.nodes)
    if (node.name.starts_with("water/")) dots.push_back(node.name);
  REQUIRE(model.clips.size() == 1);
  const Clip& clip = model.clips[0];
  const auto shown_at = [&](double time) {
    std::vector<Vec3> places;
    for (const std::string& name : dots) {
      Vec3 place(0, 0, 0), scale(1, 1, 1);
      for (const Track& track : clip.tracks) {
        if (track.node != name || track.property == "rotation") continue;
        (track.property == "scale" ? scale : place) = std::get<Curve<Vec3>>(track.curve).value(time);
      }
      if (scale.x() > 0.5) places.push_back(place);
    }
    return places;
  };
  for (const std::size_t frame : {std::size_t{4}, std::size_t{11}, std::size_t{20}}) {
    const StageParticles& there = fountain.recording.particles[0].frame[frame];
    REQUIRE(there.positions.size() <= most_particles_in_glb);
    const std::vector<Vec3> places = shown_at(fountain.recording.times[frame]);
    CHECK(places.size() == there.positions.size());
    for (const Vec3& place : there.positions)
      CHECK(std::ranges::any_of(places, [&](const Vec3& other) { return (other - place).norm() < 1e-5; }));
  }
  // Of 1,200 at a time, every third.
  Run crowd("particles/fountain", 0.1, 20);
  for (StageParticles& there : crowd.recording.particles[0].frame) {
    there = {};
    for (std::uint64_t i = 0; i < 1200; ++i) {
      there.positions.emplace_back(0.001 * static_cast<double>(i), 1, 0);
      there.velocities.emplace_back(0, 0, 0);
      there.numbers.push_back(i);
    }
  }
  save_recording(crowd.recording, crowd.stage, file);
  const Model thinned = load_model(file);
  std::filesystem::remove(file);
  CHECK(std::ranges::count_if(thinned.nodes, [](const Node& node) { return node.name.starts_with("water/"); }) == 400);
}
