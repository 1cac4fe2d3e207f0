// Plays in documents: sections, loops, fades, keys of weight and speed; and files of timed inputs.

#include "importers/document/document_files.h"
#include "processor_time.h"

#include <tweenfall/anim/graph_player.h>
#include <tweenfall/importers/inputs.h>
#include <tweenfall/physics/stage/recording.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::string with_play(const std::string& play) {
  return R"({"tweenfall": 1, "fps": 10,
 "nodes": {"ball": {"body": {"shape": {"sphere": {"radius": 0.1}}}}},
 "clips": {"walk": {"tracks": {"ball.position": [[0, [0, 0, 0], "linear"], [4, [4, 0, 0]]]}},
           "wave": {"tracks": {"ball.rotation": {"axis": "z", "keys": [[0, 0], [1, 90]]}}}},
 "play": [)" +
         play + "]}";
}

Play play_of(const std::string& text) {
  return parsed(with_play(text)).stage().plays.at(0);
}

std::string play_faults(const std::string& text) {
  return faults_of(with_play(text), "p.json", {});
}

StageDescription walking() {
  return parsed(with_play(R"({"clip": "walk"})")).stage();
}

std::string input_faults(const std::string& rows) {
  try {
    (void)parse_inputs("{\"tweenfall\": 1, \"inputs\": [\n" + rows + "]}", "i.json", walking());
  } catch (const DocumentError& error) {
    return error.what();
  }
  return "";
}

bool fault_says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a play says its section, its rounds and its fades") {
  const Play play = play_of(R"({"name": "stroll", "clip": "walk", "at": "5f", "from": "25%", "to": "30f", "offset": 0.5,
      "direction": "reverse", "loop": "pingpong", "count": 2.5, "fade_in": 0.2,
      "fade_out": {"seconds": 0.3, "ease": "sine-in-out"}})");
  CHECK(play.name == "stroll");
  CHECK(play.at == 0.5);
  CHECK(play.from == 1);
  CHECK(play.to == 3);
  CHECK(play.offset == 0.5);
  CHECK(play.reverse);
  CHECK(play.loop == Loop{LoopMode::pingpong, 2.5});
  CHECK(play.fade_in.seconds == 0.2);
  CHECK(play.fade_out.ease.name() == "sine-in-out");
  CHECK(play_of(R"({"clip": "walk", "count": 3})").loop == Loop{LoopMode::repeat, 3});
  CHECK(play_of(R"({"clip": "walk", "loop": {"mode": "repeat", "count": 2}})").loop == Loop{LoopMode::repeat, 2});
  for (const char* const loop : {"\"repeat-offset\"", "{\"mode\": \"repeat-offset\"}"}) {
    const std::string text = "{\"tweenfall\": 1, \"clips\": {\"c\": {\"loop\": " + std::string(loop) +
                             ", \"tracks\": {\"a.x\": [[0, 1], [1, 2]]}}}}";
    const Document clip = Document::parse(text, "loop.json", {});
    CHECK(clip.stage().clips.at(0).loop == Loop{LoopMode::repeat_offset, 0});
    CHECK(Document::parse(clip.text(), "again.json", {}).text() == clip.text());
  }
}

TEST_CASE("a play says what it fills, and so does an input that starts one") {
  CHECK(play_of(R"({"clip": "walk"})").fill == Fill::yielding);
  for (std::size_t i = 0; i < fill_words.size(); ++i) {
    const std::string word = "\"" + std::string(fill_words[i]) + "\"";
    CHECK(play_of("{\"clip\": \"walk\", \"fill\": " + word + "}").fill == static_cast<Fill>(i));
    const std::string row =
        "{\"tweenfall\": 1, \"inputs\": [{\"at\": 1, \"start\": {\"play\": \"w\", \"clip\": \"wave\", \"fill\": " +
        word + "}}]}";
    const std::vector<TimedInput> inputs = parse_inputs(row, "i.json", walking());
    CHECK(std::get<playing::Start>(std::get<input::Ask>(inputs.at(0).what).action).fill == static_cast<Fill>(i));
    const std::string written = inputs_json(inputs);
    CHECK(inputs_json(parse_inputs(written, "i.json", walking())) == written);
    CHECK(fault_says(written, word) == (i > 0));
  }
  CHECK(fault_says(play_faults(R"({"clip": "walk", "fill": "forward"})"), "did you mean \"forwards\"?"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "fill_mode": "both"})"), "did you mean \"fill\"?"));
}

TEST_CASE("keys of weight and speed run on the play's own time, unless they say the stage's") {
  const Play own = play_of(R"({"clip": "walk", "at": 2, "weight": [[0, 0, "linear"], [1, 1]],
                              "speed": [[0, 0, "linear"], [2, 2]]})");
  CHECK(own.weight.value(0.5) == 0.5);
  CHECK(near(end_time(own, walking().clips[0]), 2 + 3, 1e-12));  // 2 m by 2 s, then 2 m at 2 m/s
  CHECK(own.speed.at(1) == 1);
  const Play stage =
      play_of(R"({"clip": "walk", "at": 2, "weight": {"clock": "stage", "keys": [[2, 0, "linear"], [3, 1]]}})");
  CHECK(near(stage.weight.value(0.5), 0.5, 1e-15));
}

TEST_CASE("what is wrong with a play is told at its place") {
  CHECK(fault_says(play_faults(R"({"clip": "walk", "to": 5})"), "its section reaches to 5 s, and the clip to 4 s"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "from": 3, "to": 2})"), "not after its start"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "fadein": 1})"), "did you mean \"fade_in\"?"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "fade_in": -1})"), "p.json:"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "loop": "once", "count": 2})"), "\"count\" means nothing"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "speed": [[0, 1], [0, 2]]})"), "key times must increase"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "weight": [[0, 2]]})"), "expected a weight from 0 to 1"));
  CHECK(fault_says(play_faults(R"({"name": "a", "clip": "walk"}, {"name": "a", "clip": "wave"})"),
                   "another play is called"));
  CHECK(fault_says(play_faults(R"({"clip": "walk", "weight": {"clock": "stag", "keys": [[0, 1]]}})"),
                   "did you mean \"stage\"?"));
}

TEST_CASE("inputs are read with their settings, and written so that the same are read") {
  const std::string text = R"({"tweenfall": 1, "inputs": [
    {"at": 0.5, "start": {"play": "wave", "fade_in": 0.2}},
    {"at": 0.5, "speed": {"play": "walk", "speed": 1.5, "seconds": 0.3}},
    {"at": 0.7, "speed": {"play": "walk", "speed": [[0, 1.5, "quad-in"], [1, 0.1]]}},
    {"at": 1, "fade": {"play": "wave", "weight": 0.25, "seconds": 0.1, "ease": "sine-in-out"}},
    {"at": 1, "weigh": {"play": "wave", "weight": [[0, 0.25], [1, 1]]}},
    {"at": 1.1, "seek": {"play": "walk", "to": 3, "events": true, "fade": 0.25}},
    {"at": 1.2, "stop": {"play": "wave", "seconds": 0.1}},
    {"at": 1.3, "start": {"play": "again", "clip": "walk", "from": 1, "to": 3, "direction": "reverse", "loop": "repeat", "count": 2, "mask": "ball"}},
    {"at": 2, "release": {"body": "ball", "velocity": {"scale": 0.5, "add": {"linear": [0, 1, 0], "angular": [0, 0, 33.3]}}, "overlap": "ignore"}},
    {"at": 2, "push": {"body": "ball", "impulse": [0, 0.1, 0], "point": [0, 0, 0]}},
    {"at": 3, "recover": {"body": "ball", "path": {"time": "hold", "anchor": "here"}, "settle": {"half_life": 0.1}}},
    {"at": 3.1, "hand_over": {"body": "ball", "to": {"hz": 4, "max_force": 20, "frame": "anchor"}, "ramp": 0.25, "velocity": {"source": "zero"}, "settle": {"quintic": 0.1}}},
    {"at": 3.7, "hand_over": {"body": "ball", "to": "free"}}]})";
  const StageDescription stage = walking();
  const std::vector<TimedInput> inputs = parse_inputs(text, "i.json", stage);
  REQUIRE(inputs.size() == 13);
  const auto& speed = std::get<playing::SetSpeed>(std::get<input::Ask>(inputs[2].what).action);
  CHECK(speed.speed == PlayKeys{{0, 1.5, Ease::named("quad-in").value()}, {1, 0.1}});
  const auto& start = std::get<playing::Start>(std::get<input::Ask>(inputs[7].what).action);
  CHECK(start.clip == "walk");
  CHECK(start.reverse);
  CHECK(std::get<input::Release>(inputs[8].what).settings.scale == 0.5);
  CHECK(std::get<input::Recover>(inputs[10].what).settings.clock == HandBack::Clock::hold);
  const OwnerChange change = std::get<input::HandOver>(inputs[11].what).change;
  CHECK(change.to == Drive{.hz = 4, .max_force = 20, .frame = Drive::Frame::anchor});
  CHECK(change.ramp == 0.25);
  CHECK(change.take_over.velocity == TakeOver::Velocity::zero);
  const std::string once = inputs_json(inputs);
  const std::vector<TimedInput> again = parse_inputs(once, "i.json", stage);
  CHECK(inputs_json(again) == once);
  // They do the same, to the bit.
  Stage first(stage), second(stage);
  static_cast<void>(advance_with(first, inputs, 4));
  static_cast<void>(advance_with(second, again, 4));
  CHECK(first.state_hash() == second.state_hash());
  CHECK(inputs_json(first.inputs()) == once);
}

TEST_CASE("inputs say after how many blows of their time they come") {
  const StageDescription stage = walking();
  const std::vector<TimedInput> inputs{{0.25, input::Push{"ball", Vec3(0, 1, 0), Vec3(0, 0, 0)}},
                                       {0.25, input::Push{"ball", Vec3(0, 2, 0), Vec3(0, 0, 0)}, 3}};
  const std::string written = inputs_json(inputs);
  CHECK(written.find(R"({"at": 0.25, "after_blows": 3, "push": )") != std::string::npos);
  const std::vector<TimedInput> read = parse_inputs(written, "i.json", stage);
  REQUIRE(read.size() == 2);
  CHECK(read[0].after_blows == 0);
  CHECK(read[1].after_blows == 3);
  CHECK_THROWS_WITH_AS(
      (void)parse_inputs(R"({"tweenfall": 1, "inputs": [{"at": 0, "after_blows": 0.5, "release": {"body": "ball"}}]})",
                         "i.json", stage),
      doctest::Contains("i.json:1:54: error: expected a whole number from 0 to 1000000"), DocumentError);
}

TEST_CASE("whatever a program asks of a body is written so that the same is read, to the bit") {
  const StageDescription stage = walking();
  Random random(61);
  for (int i = 0; i < 200; ++i) {
    // Few angles in radians are given by a number of degrees.
    TakeOver settings{.overlap = TakeOver::Overlap::rewind, .rewind_within = random.between(0, 2)};
    settings.add = {random.vector(3), random.vector(3)};
    Stage told(stage), given(stage);
    told.advance(random.between(0.1, 1));
    told.release(0, settings);
    told.advance(0.2);
    told.hand_over(0, {.to = {.hz = 3}, .take_over = settings});
    const std::string written = inputs_json(told.inputs());
    const std::vector<TimedInput> read = parse_inputs(written, "i.json", stage);
    CHECK(inputs_json(read) == written);
    const TakeOver& again = std::get<input::Release>(read.at(0).what).settings;
    CHECK(again.rewind_within == settings.rewind_within);
    CHECK(near(again.add.angular, settings.add.angular, 1e-15));
    told.advance(0.1);
    static_cast<void>(advance_with(given, read, told.time()));
    CHECK(given.state_hash() == told.state_hash());
  }
}

TEST_CASE("whatever a program starts is written so that the same is read") {
  const StageDescription stage = walking();
  const playing::Start faded{.weight = {{0, 0.5}}, .fade_in = {.seconds = 0.5}};
  playing::Start counted = faded;
  counted.clip = "wave";
  counted.loop = Loop{LoopMode::once, 3};  // a count that means nothing
  for (const playing::Start& start : {faded, counted})
    for (const std::string name : {"wave", "walk"}) {
      CAPTURE(name);
      if (start.clip == "wave" && name == "walk") continue;
      Stage told(stage), given(stage);
      told.advance(0.3);
      told.ask(name, start);
      told.advance(0.2);
      const std::string written = inputs_json(told.inputs());
      const std::vector<TimedInput> read = parse_inputs(written, "i.json", stage);
      CHECK(inputs_json(read) == written);
      static_cast<void>(advance_with(given, read, told.time()));
      const WorldMotion one = told.world(0), other = given.world(0);
      CHECK(one.motion.pose.rotation.coeffs() == other.motion.pose.rotation.coeffs());
      CHECK(one.motion.pose.position == other.motion.pose.position);
      CHECK(one.motion.twist.angular == other.motion.twist.angular);
    }
}

TEST_CASE("faults of inputs are told at their places") {
  CHECK(fault_says(input_faults(R"({"at": 1, "stop": {"play": "wlak"}})"),
                   "i.json:2:28: error: there is no play \"wlak\"; did you mean \"walk\"?"));
  CHECK(fault_says(input_faults(R"({"at": 1, "stop": {"play": "walk"}}, {"at": 0.5, "stop": {"play": "walk"}})"),
                   "times do not go back; 0.5 s is before the input before it, at 1 s"));
  CHECK(fault_says(input_faults(R"({"at": 1, "stop": {"play": "walk", "secnds": 1}})"), "did you mean \"seconds\"?"));
  CHECK(fault_says(input_faults(R"({"at": 1, "stopp": {"play": "walk"}})"), "did you mean \"stop\"?"));
  CHECK(fault_says(input_faults(R"({"at": 1})"), "\"start\", \"stop\""));
  CHECK(fault_says(input_faults(R"({"at": 1, "stop": {"play": "walk"}, "seek": {"play": "walk", "to": 1}})"),
                   "give one of them"));
  CHECK(fault_says(input_faults(R"({"at": 1, "push": {"body": "bal", "impulse": [0, 0, 0], "point": [0, 0, 0]}})"),
                   "did you mean \"ball\"?"));
  CHECK(
      fault_says(input_faults(R"({"at": 1, "fade": {"play": "walk", "weight": 2}})"), "expected a weight from 0 to 1"));
  CHECK(fault_says(input_faults(R"({"at": -1, "stop": {"play": "walk"}})"), "i.json:2"));
  // A started play is known from then on.
  CHECK(input_faults(R"({"at": 1, "start": {"play": "w", "clip": "wave"}}, {"at": 2, "stop": {"play": "w"}})").empty());
  CHECK(fault_says(input_faults(R"({"at": 1, "start": {"play": "w", "clip": "wav"}})"), "there is no clip \"wav\""));
  // An input that could not start it makes its later inputs no further faults.
  const std::string twice = input_faults(
      R"({"at": 1, "start": {"play": "w", "clip": "wave", "from": 99}}, {"at": 2, "stop": {"play": "w"}})");
  CHECK(fault_says(twice, "its section reaches to 99 s"));
  CHECK(twice.find(" error: ") == twice.rfind(" error: "));
  CHECK(fault_says(input_faults(R"({"at": 1, "speed": {"play": 0.96, "speed": 0.5}})"), "i.json:2"));
}

TEST_CASE("a seek beyond what is played is told at its place, whatever the play was asked for before") {
  CHECK(input_faults(R"({"at": 1, "seek": {"play": "walk", "to": 4}})").empty());
  CHECK(fault_says(input_faults(R"({"at": 1, "seek": {"play": "walk", "to": 4.5}})"),
                   "i.json:2:42: error: \"walk\" has no time 4.5 s in the section that is played, 0 s to 4 s"));
  CHECK(fault_says(input_faults(R"({"at": 1, "start": {"play": "walk", "from": 1, "to": 2}},
{"at": 1.5, "seek": {"play": "walk", "to": 3}})"),
                   "i.json:3:44: error: \"walk\" has no time 3 s in the section that is played, 1 s to 2 s"));
  CHECK(fault_says(input_faults(R"({"at": 1, "start": {"play": "walk", "from": 1, "to": 9}})"),
                   "i.json:2:20: error: a play of clip \"walk\": its section reaches to 9 s, and the clip to 4 s"));
  CHECK(fault_says(input_faults(R"({"at": 1, "speed": {"play": "walk", "speed": [[0, 1], [1, 2]], "seconds": 1}})"),
                   "a speed with several keys takes no time to change: its keys say how it changes"));
}

namespace {

StageDescription with_graphs(const std::string& graphs) {
  return parsed(R"({"tweenfall": 1, "nodes": {"hip": {}}, "clips": {
    "walk": {"tracks": {"hip.position": [[0, [0, 0, 0]], [1, [1, 0, 0]]]}, "events": [[0.5, "step"]]}},
  "graphs": {)" +
                graphs + "}}")
      .stage();
}
const char* const figure_graph = R"("figure": {"parameters": {"speed": 0, "armed": false, "wind": [[0, 0], [1, 1]]},
    "poses": {"stand": {"rest": true}, "all": {"machine": {"start": "stand", "states": {"stand": "stand", "walk": "walk"},
      "transitions": [{"to": "walk", "when": {"event": "go"}}]}}},
    "on": [["step", "speed", 2], ["step", "go"]]})";

std::string graph_input_faults(const std::string& rows, const std::string& graphs) {
  try {
    (void)parse_inputs("{\"tweenfall\": 1, \"inputs\": [\n" + rows + "]}", "i.json", with_graphs(graphs));
  } catch (const DocumentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("inputs set parameters of graphs and send them events, and are written so that the same are read") {
  const StageDescription stage = with_graphs(figure_graph);
  CHECK(stage.graphs[0].reactions == std::vector<GraphReaction>{{"step", "speed", 2}, {"step", "go"}});
  const std::vector<TimedInput> inputs = parse_inputs(R"({"tweenfall": 1, "inputs": [
    {"at": 0.1, "set": {"parameter": "speed", "value": 0.3}},
    {"at": 0.2, "set": {"graph": "figure", "parameter": "armed", "value": true}},
    {"at": 0.3, "send": {"event": "go"}}]})",
                                                      "i.json", stage);
  REQUIRE(inputs.size() == 3);
  CHECK(std::get<input::Set>(inputs[0].what).graph == "figure");
  CHECK(std::get<input::Set>(inputs[1].what).value == 1);
  CHECK(std::get<input::Send>(inputs[2].what).event == "go");
  const std::string once = inputs_json(inputs);
  CHECK(inputs_json(parse_inputs(once, "i.json", stage)) == once);
  Stage first(stage), second(stage);
  static_cast<void>(advance_with(first, inputs, 2));
  CHECK(inputs_json(first.inputs()) == once);
  static_cast<void>(advance_with(second, parse_inputs(once, "i.json", stage), 2));
  CHECK(first.graph("figure").hash() == second.graph("figure").hash());
  CHECK(first.graph("figure").parameter("speed").value == 2);  // since its step at 0.8 s
}

TEST_CASE("names in inputs of graphs that mean nothing are told with the nearest") {
  const auto says = [](const std::string& rows, const std::string& part, const std::string& graphs = figure_graph) {
    const std::string faults = graph_input_faults(rows, graphs);
    CAPTURE(faults);
    CHECK(fault_says(faults, part));
  };
  says(R"({"at": 1, "set": {"parameter": "sped", "value": 1}})",
       "i.json:2:32: error: there is no parameter \"sped\"; did you mean \"speed\"?");
  says(R"({"at": 1, "set": {"graph": "figrue", "parameter": "speed", "value": 1}})",
       "i.json:2:28: error: there is no graph \"figrue\"; did you mean \"figure\"?");
  says(R"({"at": 1, "set": {"parameter": "wind", "value": 1}})",
       "i.json:2:32: error: the parameter \"wind\" has keys and cannot be set");
  says(R"({"at": 1, "send": {"event": "og"}})",
       "i.json:2:29: error: nothing in the graph \"figure\" waits for \"og\"; did you mean \"go\"?");
  says(R"({"at": 1, "set": {"parameter": "speed", "value": "fast"}})", "a number, true or false");
  says(R"({"at": 1, "set": {"parameter": "speed"}})", "value");
  says(R"({"at": 1, "send": {"event": "go"}})", "i.json:2:19: error: the stage has no graph", "");
  says(R"({"at": 1, "send": {"event": "go"}})", "the stage has several graphs, \"a\", \"b\"; say which \"graph\"",
       R"("a": {"poses": {"stand": {"rest": true}}}, "b": {"poses": {"stand": {"rest": true}}})");
}

TEST_CASE("a document with many plays is judged in a time that grows with their number alone") {
  std::string plays;
  for (int i = 0; i < 32000; ++i)
    plays += (i > 0 ? ",\n" : "") + std::string(R"({"name": "p)") + std::to_string(i) + R"(", "clip": "walk", "at": )" +
             std::to_string(i) + "e-3}";
  const double begin = processor_seconds();
  CHECK(parsed(with_play(plays)).stage().plays.size() == 32000);
  CHECK(processor_seconds() - begin < 5);
}
