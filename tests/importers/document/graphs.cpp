// Graphs of poses in documents: read, judged with places, written, and played by the stage.

#include "importers/document/document_files.h"

#include <tweenfall/anim/graph_player.h>
#include <tweenfall/physics/stage/recording.h>
#include <tweenfall/physics/stage/stage.h>

#include <cstring>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Document good_graph() {
  return Document::read(data_folder() / "documents/good/graph.json");
}

std::string with_poses(const std::string& poses, const std::string& more = "") {
  return "{\"tweenfall\": 1,\n\"nodes\": {\"hip\": {}, \"knee\": {\"parent\": \"hip\"}},\n\"clips\": {\"walk\": "
         "{\"tracks\": {\"hip.position\": [[0, [0, 0, 0]], [1, [1, 0, 0]]]}}},\n\"graphs\": {\"g\": {\"poses\": {\n" +
         poses + "}" + more + "}}}";
}

std::string graph_faults(const std::string& poses, const std::string& more = "") {
  return faults_of(with_poses(poses, more), "g.json", {});
}

}  // namespace

TEST_CASE("a graph of a document means what the same graph means in C++") {
  const Document document = good_graph();
  const GraphDescription& read = document.stage().graphs.at(0);
  CHECK(read.name == "body");
  REQUIRE(read.parameters.size() == 4);
  CHECK(read.parameters[1].start == 1);
  CHECK(read.parameters[2].half_life == 0.1);
  CHECK(read.parameters[3].curve->value(2) == 1);
  CHECK(read.inputs ==
        std::vector<GraphInput>{{0.2, "speed", 1.5}, {0.3, "grounded", 1}, {0.5, "jump", {}}, {1, "lean", 0.75}});
  const auto& clip = std::get<ClipPose>(read.poses.at(1).operation);
  CHECK(clip.loop->mode == LoopMode::pingpong);
  CHECK(clip.loop->count == 3);
  CHECK(clip.at == 0.1);
  const auto& legs = std::get<MachinePose>(read.poses.at(5).operation);
  REQUIRE(legs.transitions.size() == 4);
  CHECK(legs.transitions[0].from.empty());
  CHECK(legs.transitions[0].when.size() == 2);
  CHECK(legs.transitions[1].change.kind == GraphChange::Kind::dead_blend);
  CHECK(legs.transitions[2].change.ease->name() == "quad-in-out");
  CHECK(legs.transitions[2].change.seconds == 0.3);
  const auto& all = std::get<LayersPose>(read.poses.at(6).operation);
  CHECK(all.layers[0].adds);
  CHECK(all.layers[1].mask.at(0).below);
  CHECK(document.stage().plays.empty());
}

TEST_CASE("the stage shows what the graph shows, at any time, bit for bit") {
  const StageDescription description = good_graph().stage();
  std::vector<Node> nodes;
  for (const NodeDescription& node : description.nodes) nodes.push_back({node.name, node.parent, node.rest});
  const auto hierarchy = std::make_shared<const Hierarchy>(nodes);
  GraphPlayer player(std::make_shared<const Graph>(
      hierarchy, std::make_shared<const std::vector<Clip>>(description.clips), description.graphs[0]));
  Stage stage(description);
  std::vector<Motion> local(nodes.size());
  std::vector<WorldMotion> world(nodes.size());
  for (const double time : {0.0, 0.31, 0.55, 1.25, 1.7, 2.4, 0.6}) {
    stage.seek(time);
    player.pose_at(time, local);
    hierarchy->world_motions(local, world);
    for (NodeId node = 0; node < nodes.size(); ++node) {
      const WorldMotion alone = stage.world(node);
      CHECK(std::memcmp(&alone.motion, &world[node].motion, sizeof(Motion)) == 0);
    }
  }
  player.seek(2.4);
  CHECK(player.passages(0).size() >= 3);
}

TEST_CASE("a stage with a graph tells the events of clips that show, and saves and loads to the same bits") {
  const StageDescription description = good_graph().stage();
  Stage stage(description), other(description);
  stage.advance_to(1.6);
  std::vector<std::string> names;
  for (const StageEvent& event : stage.events()) names.push_back(event.name);
  CHECK(std::count(names.begin(), names.end(), "landed") == 1);
  CHECK(std::count(names.begin(), names.end(), "right") >= 1);
  other.load(stage.save());
  stage.advance_to(2.5);
  other.advance_to(2.5);
  const WorldMotion a = stage.world(1), b = other.world(1);
  CHECK(std::memcmp(&a.motion, &b.motion, sizeof(Motion)) == 0);
  StageDescription changed = description;
  std::get<MachinePose>(changed.graphs[0].poses[5].operation).transitions[0].change.seconds = 0.16;
  Stage stranger(changed);
  CHECK_THROWS_AS(stranger.load(stage.save()), std::invalid_argument);
}

TEST_CASE("a body follows the graph keyed, and leaves it at an event with the graph's own velocity") {
  const std::string text = R"({"tweenfall": 1,
    "nodes": {"ball": {"body": {"shape": {"sphere": {"radius": 0.1}}, "mass": 1}}},
    "clips": {"swing": {"tracks": {"ball.position": [[0, [0, 1, 0], "smooth"], [1, [2, 3, 0], "smooth"], [2, [3, 1, 0]]]},
                        "events": [[0.8, "throw"]]},
              "wait": {"tracks": {"ball.position": [[0, [0, 1, 0]]]}}},
    "graphs": {"arm": {"poses": {"all": {"machine": {"start": "wait", "states": {"wait": "wait", "swing": "swing"},
      "transitions": [{"from": "wait", "to": "swing", "when": {"event": "go"}, "fade": 0.2}]}}},
      "inputs": [[0.25, "go"]]}},
    "handoff": [{"body": "ball", "when": {"event": "throw"}, "to": "free"}]})";
  Stage stage(parsed(text).stage());
  CHECK(stage.owner(0) == Owner::keyed);
  stage.advance_to(1.5);
  REQUIRE(stage.handoffs().size() == 1);
  CHECK(near(stage.handoffs()[0].time, 1.05, 1e-12));
  const Curve<Vec3> path = std::get<Curve<Vec3>>(parsed(text).stage().clips[0].tracks[0].curve);
  CHECK(near(stage.handoffs()[0].after.twist.linear, path.rate(0.8), 1e-9));
}

TEST_CASE("a fault of one pose does not hide names that nothing has elsewhere") {
  const std::string faults =
      graph_faults(R"("a": {"blend": []}, "b": {"feet": {"pelvis": "hip", "ground": "hill", "legs": [
        {"start": "hip", "middle": "knee", "end": "knee"}]}})",
                   R"(, "parameters": {"p": "one"}, "output": "nope", "inputs": [[1, "v", 2], [1, "p", 2]])");
  for (const char* told :
       {"/graphs/g/poses/a/blend)", "/graphs/g/poses/b/feet/ground)", "there is no pose \"nope\" (at /graphs/g/output)",
        "there is no parameter \"v\" (at /graphs/g/inputs/0)", "/graphs/g/parameters/p)"}) {
    CAPTURE(told);
    CHECK(faults.find(told) != std::string::npos);
  }
  // What was left out because it is faulty itself is there.
  CHECK(faults.find("there is no parameter \"p\"") == std::string::npos);
  CHECK(graph_faults("\"a\": {\"blend\": []}", ", \"output\": \"a\"").find("there is no pose") == std::string::npos);
}

TEST_CASE("faults of graphs are told with their places") {
  CHECK(graph_faults("\"a\": {\"clip\": \"wlak\"}") ==
        "g.json:5:15: error: there is no clip \"wlak\"; did you mean \"walk\"? (at /graphs/g/poses/a/clip)\n"
        " 5 | \"a\": {\"clip\": \"wlak\"}}}}}\n   |               ^\n");
  CHECK(
      graph_faults("\"a\": {\"blend\": [[\"b\", 1], [\"walk\", 1]]},\n\"b\": {\"base\": \"a\", \"layers\": [{\"over\": "
                   "\"walk\"}]}")
          .find("g.json:6:15: error: poses go around in a circle: \"a\" -> \"b\" -> \"a\"") == 0);
  CHECK(graph_faults("\"a\": {\"layers\": [{\"over\": \"walk\", \"mask\": [\"knee\", \"ankle\"]}]}")
            .find("error: no joint is named \"ankle\" (at /graphs/g/poses/a/layers/0/mask/1)") != std::string::npos);
  CHECK(graph_faults("\"a\": {\"blend\": [[\"walk\", 0]]}").find("g.json:5:16: error: these weights sum to zero") == 0);
  CHECK(
      graph_faults("\"a\": {\"machine\": {\"start\": \"s\", \"states\": {\"s\": \"walk\"}, \"transitions\": [{\"to\": "
                   "\"t\", \"when\": {\"parameter\": \"v\", \"above\": 1}}]}}")
          .find("there is no state \"t\"") != std::string::npos);
  CHECK(graph_faults("\"a\": {\"rest\": true}", ", \"inputs\": [[1, \"v\", 2]]")
            .find("there is no parameter \"v\" (at /graphs/g/inputs/0)") != std::string::npos);
  const std::string reacting =
      R"({"tweenfall": 1, "nodes": {"hip": {}}, "clips": {
    "walk": {"tracks": {"hip.position": [[0, [0, 0, 0]], [1, [1, 0, 0]]]}, "events": [[0.5, "step"]]}},
  "graphs": {"g": {"parameters": {"v": 0}, "poses": {"a": {"clip": "walk"}},
    "on": [["stpe", "v", 1], ["step", "v", 2], ["step", "halt"]]}}})";
  std::string told;
  try {
    (void)parsed(reacting).stage();
  } catch (const DocumentError& error) {
    told = error.what();
  }
  CHECK(told.find("4:13: error: no clip has an event \"stpe\"; did you mean \"step\"?") != std::string::npos);
  CHECK(told.find("error: no machine waits for an event \"halt\" (at /graphs/g/on/2)") != std::string::npos);
  CHECK(count(told, "error:") == 2);
}

TEST_CASE("faults of shape in graphs are told as everywhere") {
  CHECK(graph_faults("\"a\": {\"clip\": \"walk\", \"blend\": []}") != "");
  CHECK(graph_faults("\"a\": {\"clip\": \"walk\", \"sped\": 2}").find("did you mean \"speed\"") != std::string::npos);
  CHECK(graph_faults("\"a\": {\"rest\": true, \"speed\": 2}") != "");
  CHECK(
      graph_faults("\"a\": {\"machine\": {\"start\": \"s\", \"states\": {\"s\": \"walk\"}, \"transitions\": [{\"to\": "
                   "\"s\", \"from\": \"s\", \"when\": {\"above\": 1}}]}}") != "");
  CHECK(graph_faults(
            "\"a\": {\"machine\": {\"start\": \"s\", \"states\": {\"s\": \"walk\"}, \"transitions\": [{\"to\": "
            "\"s\", \"from\": \"s\", \"when\": {\"event\": \"e\"}, \"fade\": 1, \"settle\": {\"quintic\": 1}}]}}") !=
        "");
  CHECK(graph_faults("\"a\": {\"rest\": true}", ", \"inputs\": [[-1, \"jump\"]]") != "");
}

TEST_CASE("keys of a graph's numbers count frames by the document's fps, and keep to what the number may be") {
  const auto shown = [](const std::string& head) {
    const std::string text = R"({"tweenfall": 1, )" + head + R"("nodes": {"hip": {}},
      "clips": {"far": {"tracks": {"hip.position": [[0, [8, 0, 0]]]}}},
      "graphs": {"g": {"parameters": {"p": [[0, 0, "linear"], ["24f", 1]]}, "poses": {
        "q": {"rest": true},
        "r": {"base": "q", "layers": [{"over": "far", "weight": [[0, 0, "linear"], ["12f", 1, "linear"], ["24f", 0.5]]}]},
        "s": {"base": "r", "layers": [{"over": "far", "weight": {"parameter": "p"}}]}}}}})";
    return parsed(text).stage();
  };
  Stage stage(shown(R"("fps": 24, )"));
  for (const auto& [time, below] : {std::pair(0.25, 4.0), std::pair(0.75, 6.0)}) {
    stage.seek(time);
    CHECK(near(stage.world(0).motion.pose.position.x(), below + time * (8 - below), 1e-12));
  }
  const auto weighed = [](const std::string& keys) {
    return graph_faults("\"a\": {\"base\": \"walk\", \"layers\": [{\"over\": \"walk\", \"weight\": " + keys + "}]}");
  };
  CHECK(weighed("[[0, 0], [1, 3]]")
            .find("error: expected a weight from 0 to 1, found 3 (at /graphs/g/poses/a/layers/0/weight/1/1)") !=
        std::string::npos);
  CHECK(graph_faults("\"a\": {\"blend\": [[\"walk\", [[0, 1], [1, -1]]]]}")
            .find("error: expected a weight of 0 or more, found -1 (at /graphs/g/poses/a/blend/0/1/1/1)") !=
        std::string::npos);
  CHECK(weighed("[[0, 0], [\"50%\", 1]]").find("these keys run on a clock that has none") != std::string::npos);
}

TEST_CASE("what is in the other order in a space or a blend is told with the right one, once for each") {
  const std::string swapped =
      graph_faults(R"("a": {"space": {"by": "v", "poses": [["walk", 0], ["walk", 1]]}}}, "parameters": {"v": 0)");
  CHECK(count(swapped, "error:") == 2);
  CHECK(swapped.find("error: the place comes before the pose: [place, \"walk\"] (at "
                     "/graphs/g/poses/a/space/poses/0)") != std::string::npos);
  const std::string blend = graph_faults(R"("a": {"blend": [[0.5, "walk"], ["walk", 1]]})");
  CHECK(count(blend, "error:") == 1);
  CHECK(blend.find("error: the pose comes before its weight: [\"walk\", weight] (at /graphs/g/poses/a/blend/0)") !=
        std::string::npos);
  const std::string by = graph_faults(
      R"("a": {"space": {"by": {"parameter": "v"}, "poses": [[0, "walk"], [1, "walk"]]}}}, "parameters": {"v": 0)");
  CHECK(count(by, "error:") == 1);
  CHECK(by.find("; write its name alone, \"v\" (at") != std::string::npos);
}

TEST_CASE("a clip with faults is told of once, not again by the graphs that play it") {
  const std::string text =
      R"({"tweenfall": 1, "nodes": {"hip": {}}, "clips": {"walk": {"tracks": {"hipp.position": [[0, [0, 0, 0]]]}}},
"graphs": {"g": {"poses": {"a": {"clip": "walk"}}}}})";
  CHECK(count(faults_of(text, "g.json", {}), "error:") == 1);
}

TEST_CASE("what a fault leaves out of a graph is not told as missing beside it") {
  const std::string parts[] = {
      // An entry of a space, its parameters, its places; a parameter; a transition that waits for an event; an addition
      R"("a": {"space": {"by": "v", "poses": [[0, 7], [1, "walk"]]}}}, "parameters": {"v": 0)",
      R"("a": {"space": {"by": ["v", 7], "poses": [[[0, 0], "walk"], [[1, 0], "walk"]]}}}, "parameters": {"v": 0)",
      R"("a": {"space": {"by": ["v", "v"], "poses": [[true, "walk"], [[1, 0], "walk"]]}}}, "parameters": {"v": 0)",
      R"("a": {"base": "walk", "layers": [{"over": "walk", "weight": {"parameter": "v"}}]}}, "parameters": {"v": "none")",
      R"("a": {"machine": {"start": "s", "states": {"s": "walk"}, "transitions": [{"to": "s", "when": {"event": 7}}]}}},
         "inputs": [[0, "go"]], "parameters": {)",
      R"("a": {"base": "walk", "layers": [{"add": 7, "reference": "walk"}]}}, "parameters": {)"};
  for (const std::string& part : parts) {
    const std::string told = graph_faults(part);
    CAPTURE(told);
    CHECK(count(told, "error:") == 1);
  }
  // Faults elsewhere in the graph are reported all the same.
  CHECK(count(graph_faults(R"("a": {"space": {"by": "v", "poses": [[0, 7], [1, "walk"]]}}, "b": {"clip": "wlak"}},
                              "parameters": {"v": 0)"),
              "error:") == 2);
}
