// Writes the pages that the page test looks at: write_page FOLDER
//
// example.*: the example as a page and in every other form; example_fine.json: the same, four times as often.
// models/NAME.html, .svg: every model of ../shared/models or, if there is none, of the project.
// hostile/NAME.html: recordings that hardly fit a page.

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>
#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/recording_file.h>

#include "page/example_stage.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>

namespace {

using namespace tweenfall;
namespace fs = std::filesystem;

void write_example(const fs::path& folder) {
  const StageDescription stage = test::example_stage();
  const Recording recording = test::example_recording();
  for (const char* name : {"example.html", "example.json", "example.svg", "example.csv", "example.glb"})
    save_recording(recording, stage, folder / name);
  std::ofstream(folder / "example_plot.svg") << plot_svg(stage, &recording);
  save_recording(test::example_recording(240), stage, folder / "example_fine.json");
}

std::vector<fs::path> model_files() {
  const fs::path source = TWEENFALL_SOURCE_DIR, shared = source / ".." / "shared" / "models";
  std::vector<fs::path> files;
  if (fs::exists(shared)) {
    for (const char* kind : {"gltf", "fbx", "bvh", "dae"})
      for (const auto& entry : fs::directory_iterator(shared / kind))
        if (entry.path().extension() != ".bin") files.push_back(entry.path());
  } else {
    std::cerr << "SKIPPED: models of ../shared/models: there are none; the project's own are looked at\n";
  }
  files.push_back(source / "samples/documents/character.glb");
  std::sort(files.begin(), files.end());
  return files;
}

void write_models(const fs::path& folder) {
  fs::create_directories(folder);
  for (const fs::path& file : model_files()) {
    Model model = load_model(file);
    StageDescription stage;
    stage.name = model.name;
    for (const Node& node : model.nodes)
      stage.nodes.push_back(
          {.name = node.name, .parent = node.parent, .rest = node.rest, .body = {}, .group = {}, .color = {}});
    stage.clips = std::move(model.clips);
    stage.meshes = std::move(model.meshes);
    stage.skins = std::move(model.skins);
    stage.mesh_instances = std::move(model.instances);
    if (!stage.clips.empty()) stage.plays = {{.clip = 0}};
    Stage shown(stage);
    const Recording recording = record(shown, std::min(natural_length(stage), 8.0), 30);
    for (const char* ending : {".html", ".svg"})
      save_recording(recording, stage, folder / (file.filename().string() + ending));
  }
}

/// Two boxes on top of each other and one beside them, which fall asleep.
void write_stacked(const fs::path& folder) {
  StageDescription stage;
  stage.name = "stacked";
  stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}}};
  const auto lay = [&](const char* name, double x, double y, double alpha) {
    NodeDescription box;
    box.name = name;
    box.color = Color{Vec4(0.5, 0.5, 0.5, alpha)};
    box.rest.position = Vec3(x, y, 0);
    box.body = BodyDescription{.shape = {Box{{0.2, 0.2, 0.2}}}};
    stage.nodes.push_back(box);
  };
  lay("lower", 0, 0.2, 1);
  lay("upper", 0, 0.6, 0);
  lay("alone", 1.5, 0.2, 0.25);
  Stage run(stage);
  const Recording recording = record(run, 2, 30, 1e9, true);
  save_recording(recording, stage, folder / "stacked.html");
}

/// The example, and beside it a bob of another kind that falls for half as long.
void write_beside(const fs::path& folder) {
  StageDescription other;
  other.name = "the other <one>";
  NodeDescription bob{.name = "bob", .body = BodyDescription{.shape = {Sphere{0.2}}}};
  bob.rest.position = Vec3(0, 3, 0);
  other.nodes = {bob};
  Stage run(other);
  const Recording falling = record(run, 1.5, 30);
  const StageDescription stage = test::example_stage();
  std::ofstream(folder / "beside.html") << side_by_side_html({falling, other}, {test::example_recording(), stage});
}

/// A door on a hinge that swings free, and a lamp whose rope breaks under it.
void write_jointed(const fs::path& folder) {
  BodyDescription door, lamp;
  door.shape.solid = Box{Vec3(0.4, 0.9, 0.02)};
  door.twist = {Vec3(0, 0, -0.8), Vec3(0, 2, 0)};
  lamp.shape.solid = Sphere{0.1};
  lamp.mass = 1;
  StageDescription stage;
  stage.name = "jointed";
  stage.nodes = {
      {.name = "door",
       .parent = no_node,
       .rest = {.position = Vec3(0.4, 1, 0)},
       .body = door,
       .group = {},
       .color = {}},
      {.name = "lamp", .parent = no_node, .rest = {.position = Vec3(2, 1, 0)}, .body = lamp, .group = {}, .color = {}}};
  const auto add = [&](const std::string& name, std::size_t node, const Vec3& in_world, const Vec3& on_body,
                       const JointKind& kind) {
    const Pose& rest = stage.nodes[node].rest;
    JointDescription joint;
    joint.name = name;
    joint.b = node;
    joint.frame_a = joint_frames({}, rest, in_world, Vec3(0, 1, 0)).a;
    joint.frame_b = joint_frames({}, rest, on_body, Vec3(0, 1, 0)).b;
    joint.kind = kind;
    stage.joints.push_back(joint);
  };
  add("pin", 0, Vec3(0, 1, 0), Vec3(0, 1, 0), HingeJoint{.limits = Limits{-1, 1}});
  add("rope", 1, Vec3(2, 2, 0), Vec3(2, 1, 0), DistanceJoint{.limits = {0, 1}});
  stage.joints[1].until = when::At{0.5};
  Stage shown(stage);
  const Recording recording = record(shown, 1, 30);
  for (const char* ending : {".html", ".json"})
    save_recording(recording, stage, folder / ("jointed" + std::string(ending)));
}

/// Lectures with particles, wheels and a cloth.
void write_actors(const fs::path& folder) {
  const fs::path lectures = fs::path(TWEENFALL_SOURCE_DIR) / "samples/documents/lectures";
  const auto write = [&](const char* lecture, const std::string& name, double until) {
    const StageDescription stage = Document::read(lectures / lecture).stage();
    Stage run(stage);
    const Recording recording = record(run, until, 30);
    for (const char* ending : {".html", ".json"}) save_recording(recording, stage, folder / (name + ending));
  };
  write("particles/fountain.json", "fountain", 1.5);
  write("vehicle/slides.json", "car", 1.5);
  write("soft/cloth_positions.json", "cloth", 0.6);
}

/// Held values that change between frames, a chain of bare nodes with a lone one far off, and equal names.
void write_documents(const fs::path& folder) {
  const auto write = [&](const std::string& name, const std::string& text) {
    const StageDescription stage = Document::parse(text, name + ".json", folder).stage();
    Stage run(stage);
    save_recording(record(run, 2, 30), stage, folder / (name + ".html"));
  };
  write("held", R"({"tweenfall": 1, "nodes": {"lamp": {}, "shade": {"parent": "lamp", "position": [0, 1, 0]}},
    "clips": {"c": {"tracks": {
      "lamp.position": [[0, [0, 0, 0], "hold"], [0.51, [1, 0, 0], "hold"], [1.19, [3, 0, 0], "linear"], [2, [3, 0, 0]]],
      "lamp.scale": [[0, 1, "hold"], [0.51, 2, "hold"], [1.19, 4, "hold"], [2, 4]],
      "lamp.color": [[0, "#000", "step-next"], [0.51, "#fff", "hold"], [1.19, "#000", "hold"], [2, "#fff"]]}}}})");
  write("leaps",
        R"document({"tweenfall": 1, "nodes": {"stairs": {}, "round": {}, "given": {}, "fading": {}},
    "clips": {"c": {"tracks": {
        "stairs.position": [[0, [0, 0, 0], "steps(3,jump-end)"], [1.37, [3, 0, 0]]],
        "stairs.color": [[0, "#000", "steps(3,jump-end)"], [1.37, "#fff"], [2, "#fff"]],
        "given.position": [[0, [0, 0, 0], "linear"],
          {"t": 0.51, "v": [5, 0, 0], "v_in": [0.51, 0, 0], "ease": "linear"}, [2, [6.49, 0, 0]]]}},
      "turns": {"loop": "repeat", "tracks": {"round.position": [[0, [0, 0, 0], "linear"], [0.77, [0.77, 0, 0]]]}},
      "whole": {"tracks": {"fading.position": [[0, [1, 0, 0]]]}}},
    "play": [{"clip": "c"}, {"clip": "turns"}, {"clip": "whole",
      "weight": {"keys": [[0, 0.25, "hold"], [0.51, 1, "hold"], [2, 1]], "clock": "stage"}}]})document");
  write("lone", R"({"tweenfall": 1, "nodes": {"eye": {"position": [5, 3, 0]}, "hip": {}, "knee": {"parent": "hip",
    "position": [0, -1, 0]}}, "clips": {"c": {"tracks": {"hip.rotation": {"axis": "z", "keys": [[0, 0], [2, 60]]}}}}})");
  std::string nodes;
  for (int i = 0; i < 300; ++i)
    nodes += (i > 0 ? ", " : "") +
             ("\"the left front wheel of the second wagon behind the locomotive, number " + std::to_string(i)) +
             ".position\": [[0, [" + std::to_string(i % 20) +
             ", 0, 0], \"sine-in-out\"], [1, [0, 1, 0], \"sine-in-out\"], " + "[2, [0, 0, 0]]]";
  write("names", R"({"tweenfall": 1, "clips": {"c": {"tracks": {)" + nodes + "}}}}");
}

Recording still(const StageDescription& stage, const std::vector<double>& times) {
  Recording recording{.name = stage.name, .times = times, .nodes = {}, .handoffs = {}, .events = {}};
  for (const NodeDescription& node : stage.nodes) {
    NodeRecord record{
        .name = node.name, .parent = node.parent, .world = {}, .twist = {}, .owner = {}, .color = {}, .weights = {}};
    record.world.assign(times.size(), test::placed(node.rest.position, node.rest.rotation, {}));
    record.twist.resize(times.size());
    record.owner.assign(times.size(), Owner::keyed);
    recording.nodes.push_back(record);
  }
  return recording;
}

NodeDescription ball(const std::string& name, const Vec3& position) {
  BodyDescription body;
  body.shape.solid = Sphere{0.2};
  return {.name = name, .parent = no_node, .rest = {.position = position}, .body = body, .group = {}, .color = {}};
}

void write_hostile(const fs::path& folder) {
  fs::create_directories(folder);
  const auto save = [&](const std::string& name, StageDescription stage, const Recording& recording) {
    stage.name = recording.name;
    save_recording(recording, stage, folder / (name + ".html"));
  };
  StageDescription stage;
  stage.name = "beyond float";
  stage.nodes = {ball("near", {0, 1, 0}), ball("far", {1e200, 0, 0}), ball("wide", {1, 1, 0})};
  Recording recording = still(stage, {0, 0.5, 1});
  recording.nodes[2].world[1].linear *= 1e60;
  recording.nodes[0].twist[1].linear = Vec3(1e308, -1e308, 0);
  save("beyond_float", stage, recording);

  stage.nodes.clear();
  for (int i = 0; i < 20000; ++i)
    stage.nodes.push_back({.name = "node " + std::to_string(i),
                           .parent = i % 3 == 0 ? no_node : static_cast<std::size_t>(i - 1),
                           .rest = {.position = Vec3(i % 141, 0.1 * (i % 7), i / 141)},
                           .body = {},
                           .group = {},
                           .color = {}});
  recording = still(stage, {0, 0.5, 1});
  recording.name = "20,000 nodes";
  for (std::size_t i = 0; i < recording.nodes.size(); ++i)
    recording.nodes[i].world[2].motion.pose.position.y() += 0.01 * static_cast<double>(i % 100);
  save("many_nodes", stage, recording);

  stage.nodes = {ball("in centimeters", {-4.0237, 307.1234, -1234.5678})};
  recording = still(stage, {0, 1});
  recording.name = "large numbers";
  save("large_numbers", stage, recording);

  stage.nodes = {ball("alone", {0, 0, 0})};
  recording = still(stage, {2.5});
  recording.name = "one frame";
  save("one_frame", stage, recording);

  stage.nodes.clear();
  recording = still(stage, {0, 1});
  recording.name = "";
  save("no_nodes", stage, recording);

  const std::string markup =
      "</script><script>window.hurt = 1</script><img src=x onerror='window.hurt = 1'>]]>&\" {{data}}";
  stage.nodes = {ball(markup, {0, 0, 0}), ball(std::string(5000, 'w'), {1, 0, 0}), ball("", {2, 0, 0})};
  stage.clips = {{.name = markup, .duration = 1, .tracks = {}, .events = {}},
                 {.name = "empty", .duration = 0, .tracks = {}, .events = {}}};
  stage.plays = {{.clip = 0}, {.clip = 1}};
  recording = still(stage, {0, 1});
  recording.name = markup;
  recording.events.push_back({.time = 0.5, .name = markup, .data = "", .nodes = {0, 1}, .impulse = 1});
  save("markup", stage, recording);

  // Ten minutes of a hundred balls at 60 frames per second.
  stage = {};
  for (int i = 0; i < 100; ++i) stage.nodes.push_back(ball("ball " + std::to_string(i), Vec3(i, 0, 0)));
  std::vector<double> times;
  for (int frame = 0; frame <= 36000; ++frame) times.push_back(frame / 60.0);
  recording = still(stage, times);
  recording.name = "long";
  for (std::size_t i = 0; i < recording.nodes.size(); ++i)
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
      Motion& motion = recording.nodes[i].world[frame].motion;
      motion.pose.position.y() = std::sin(times[frame]);
      motion.twist.linear.y() = std::cos(times[frame]);
      recording.nodes[i].twist[frame] = motion.twist;
    }
  save("long", stage, recording);

  // Far from the origin, and very small.
  stage.nodes = {ball("speck", {1e6, 0, 0}), ball("other", {1e6 + 1e-3, 0, 0})};
  for (NodeDescription& node : stage.nodes) std::get<Sphere>(node.body->shape.solid).radius = 1e-4;
  stage.nodes[0].rest.position = Vec3(1, 0, 0);
  stage.nodes[1].rest.position = Vec3(1 + 1e-3, 0, 0);
  recording = still(stage, {0, 1});
  recording.name = "small";
  save("small", stage, recording);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: write_page FOLDER\n";
    return 2;
  }
  try {
    const fs::path folder = arguments[1];
    fs::create_directories(folder);
    write_example(folder);
    write_jointed(folder);
    write_actors(folder);
    write_stacked(folder);
    write_beside(folder);
    write_documents(folder);
    write_models(folder / "models");
    write_hostile(folder / "hostile");
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << "\n";
    return 1;
  }
}
