#include "importers/document/document_files.h"
#include "processor_time.h"

#include <tweenfall/curves/number_text.h>

#include <fstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// The notes of a valid document, as printed, each on one line without its excerpt.
std::string notes_of(const std::string& text) {
  std::string out;
  const Document document = Document::parse(text, "n.json", data_folder() / "documents/good");
  for (const Problem& note : document.notes()) {
    CHECK(note.severity == Severity::note);
    const std::string shown = note.text();
    CHECK(shown.find(": note: ") != std::string::npos);
    CHECK(note.line > 0);
    out += shown.substr(0, shown.find('\n')) + "\n";
  }
  return out;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string two_balls(const std::string& second, const std::string& rest) {
  const std::string body = "\"body\": {\"shape\": {\"sphere\": {\"radius\": 0.5}}, \"mass\": 1}";
  return "{\"tweenfall\": 1, \"nodes\": {\"a\": {" + body + "}, \"b\": {\"position\": " + second + ", " + body + "}}" +
         rest + "}";
}

}  // namespace

TEST_CASE("a drive that nothing above its body can carry along is noted") {
  const std::string body = "\"body\": {\"shape\": {\"sphere\": {\"radius\": 0.1}}, \"mass\": 1";
  const auto noted = [&](const std::string& drive, const std::string& parent, const std::string& rules) {
    return notes_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {" + body + "}}, \"b\": {\"position\": [5, 5, 0], " +
                    parent + body + drive + "}}}" + rules + "}");
  };
  const std::string own = ", \"drive\": {\"hz\": 2, \"frame\": \"parent\"}", below_a = "\"parent\": \"a\", ";
  CHECK(has(noted(own, "", ""), "no node above \"b\" has a body that could carry its path: this is as \"world\""));
  CHECK(noted(own, below_a, "").empty());
  const std::string rule =
      ", \"handoff\": [{\"body\": \"b\", \"when\": {\"at\": 1}, \"to\": \"free\", \"for\": 1, \"then\": "
      "{\"to\": {\"hz\": 2, \"frame\": \"anchor\"}}}]";
  CHECK(has(noted("", "", rule), "(at /handoff/0/then/to/frame)"));
  CHECK(noted("", below_a, rule).empty());
}

TEST_CASE("fades longer than their play are noted") {
  const auto noted = [](const std::string& play) {
    return notes_of(
        R"({"tweenfall": 1, "nodes": {"a": {}}, "clips": {"c": {"duration": 2, "tracks": {"a.position.x": [[0, 0], [2, 1]]}}},
      "play": [{"clip": "c", )" +
        play + "}]}");
  };
  CHECK(has(noted("\"fade_in\": 2.5"), "takes 2.5 s, but the play is over after 2 s"));
  CHECK(has(noted("\"fade_in\": 2.5"), "(at /play/0/fade_in)"));
  CHECK(has(noted("\"fade_out\": 1.5, \"speed\": 2"), "the play is over after 1 s"));
  CHECK(noted("\"fade_in\": 2, \"fade_out\": 2").empty());
  CHECK(noted("\"fade_in\": 3.5, \"loop\": \"repeat\", \"count\": 2").empty());
  CHECK(noted("\"fade_in\": 35, \"loop\": \"repeat\"").empty());
}

TEST_CASE("states of a machine that never show are noted") {
  const auto noted = [](const std::string& transitions) {
    return notes_of(
        R"({"tweenfall": 1, "nodes": {"a": {}}, "graphs": {"g": {"parameters": {"p": 0}, "poses": {"low": {"rest": true},
      "m": {"machine": {"start": "s", "states": {"s": "low", "t": "low", "u": "low"}, "transitions": [)" +
        transitions + "]}}}}}}");
  };
  const std::string to_t = R"({"from": "s", "to": "t", "when": {"parameter": "p", "above": 1}})";
  const std::string u_and_back = R"({"from": "u", "to": "s", "when": {"parameter": "p", "above": 2}})";
  const std::string never = noted(to_t + ", " + u_and_back);
  CHECK(has(never, "never shows: no transitions lead to it from the start, \"s\""));
  CHECK(has(never, "(at /graphs/g/poses/m/machine/states/u)"));
  CHECK_FALSE(has(never, "states/t)"));
  CHECK(noted(to_t + R"(, {"from": "t", "to": "u"})").empty());
  CHECK(noted(to_t + R"(, {"to": "u", "when": {"parameter": "p", "below": -1}})").empty());
}

TEST_CASE("a property that nothing reads is noted with the one of ours that it stands for") {
  const auto noted = [](const std::string& property) {
    return notes_of("{\"tweenfall\": 1, \"clips\": {\"c\": {\"tracks\": {\"lamp." + property + "\": [[0, 1]]}}}}");
  };
  CHECK(has(noted("translation"), "did you mean \"lamp.position\"?"));
  CHECK(has(noted("rotate"), "did you mean \"lamp.rotation\"?"));
  CHECK(has(noted("rot"), "did you mean \"lamp.rotation\"?"));
  CHECK(has(noted("colour"), "did you mean \"lamp.color\"?"));
  CHECK(has(noted("Scale"), "did you mean \"lamp.scale\"?"));
  for (const char* word : {"location", "locaton", "tanslation", "loc", "localPosition", "m_LocalPosition",
                           "delta_location", "Lcl Translation", "coords", "global_position"})
    CHECK_MESSAGE(has(noted(word), "did you mean \"lamp.position\"?"), word);
  for (const char* word : {"euler", "eulerAngles", "localEulerAngles", "quat", "rotation_quaternion",
                           "rotation_axis_angle", "rotation_degrees", "Lcl Rotation", "orientation"})
    CHECK_MESSAGE(has(noted(word), "did you mean \"lamp.rotation\"?"), word);
  for (const char* word : {"localScale", "lossyScale", "Lcl Scaling", "zoom", "size", "scl"})
    CHECK_MESSAGE(has(noted(word), "did you mean \"lamp.scale\"?"), word);
  for (const char* word : {"tint", "albedo", "base_color", "diffuse_color", "background-color", "emission", "rgba"})
    CHECK_MESSAGE(has(noted(word), "did you mean \"lamp.color\"?"), word);
  for (const char* word : {"morphTargetInfluences", "shape_keys", "blendShapes", "weight"})
    CHECK_MESSAGE(has(noted(word), "did you mean \"lamp.weights\"?"), word);
  CHECK(has(noted("opacity"), "did you mean \"lamp.color.a\"?"));
  CHECK(has(noted("rotateX"), "did you mean \"lamp.rotation.x\"?"));
  CHECK(has(noted("position[y]"), "did you mean \"lamp.position.y\"?"));
  for (const char* word : {"visible", "visibility", "hide", "hidden", "hide_viewport", "isVisible", "display"})
    CHECK_MESSAGE(has(noted(word), "nodes are always shown, and \"lamp.color.a\" at 0 hides one"), word);
  CHECK(has(noted("transform"), "are tracks of their own"));
  CHECK(has(noted("velocity"), "velocities follow from \"lamp.position\" and \"lamp.rotation\""));
  CHECK(noted("brightness").empty());
  CHECK(noted("angle").empty());
}

TEST_CASE("a number of the author's own that a graph follows is not taken for another program's word") {
  const std::string clip =
      "{\"tweenfall\": 1, \"nodes\": {\"lamp\": {}}, \"clips\": {\"c\": {\"tracks\": {\"lamp.weight\": [[0, 1]]}}}";
  CHECK(has(notes_of(clip + "}"), "did you mean \"lamp.weights\"?"));
  CHECK(notes_of(clip +
                 ", \"graphs\": {\"g\": {\"parameters\": {\"w\": {\"track\": \"lamp.weight\"}}, \"poses\": {\"p\": "
                 "{\"rest\": true}}}}}")
            .empty());
}

TEST_CASE("a track of sizes is noted where it scales what is drawn of a body and not what collides") {
  const auto noted = [](const std::string& body, const std::string& track) {
    return notes_of(
        "{\"tweenfall\": 1, \"nodes\": {\"top\": {\"scale\": 2}, \"ball\": {\"parent\": \"top\", \"body\": " + body +
        "}, \"lamp\": {}}, \"clips\": {\"c\": {\"tracks\": {" + track + "}}}}");
  };
  const std::string ball = "{\"shape\": {\"sphere\": {\"radius\": 0.1}}}",
                    squash = "[[0, 1], [1, [1.2, 0.7, 1.2]], [2, 1]]";
  const std::string own = noted(ball, "\"ball.scale\": " + squash);
  CHECK(has(own,
            "\"ball.scale\" scales only what is drawn: the body of \"ball\" collides in the size that it has at rest"));
  CHECK(has(own, "(at /clips/c/tracks/ball.scale)"));
  CHECK(has(noted(ball, "\"ball.scale.y\": [[0, 1], [1, 0.5]]"), "\"ball.scale.y\" scales"));
  CHECK(has(noted(ball, "\"ball.scale\": {\"relative\": true, \"keys\": [[0, 1], [1, 2]]}"), "\"ball.scale\" scales"));
  // What hangs below is drawn in another size, too.
  CHECK(has(noted(ball, "\"top.scale\": [[0, 2], [1, 3]]"), "the body of \"ball\" collides"));
  CHECK(noted(ball, "\"top.scale\": [[0, 2], [1, 2]]").empty());
  CHECK(noted(ball, "\"ball.scale\": {\"relative\": true, \"keys\": [[0, 1], [1, 1]]}").empty());
  CHECK(noted(ball, "\"lamp.scale\": " + squash).empty());
  CHECK(noted("{\"shape\": {\"sphere\": {\"radius\": 0.1}}, \"sensor\": true}", "\"ball.scale\": " + squash).empty());
  CHECK(noted("{\"shape\": {\"sphere\": {\"radius\": 0.1}}, \"collides_with\": []}", "\"ball.scale\": " + squash)
            .empty());
}

TEST_CASE("angles that are quarter turns in radians are noted, whole degrees are not") {
  const auto track = [](const std::string& value) {
    return notes_of("{\"tweenfall\": 1, \"clips\": {\"c\": {\"tracks\": {" + value + "}}}}");
  };
  CHECK(has(track("\"a.rotation\": {\"axis\": \"z\", \"keys\": [[0, 0], [1, 3.14159]]}"),
            "turns by 3.1416, a number of quarter turns in radians; angles here are degrees, a quarter turn is 90"));
  CHECK(has(track("\"a.rotation\": [[0, {\"euler\": [0, 0, 0]}], [1, {\"euler\": [0, 1.5708, -3.1416]}]]"),
            "(at /clips/c/tracks/a.rotation)"));
  CHECK(has(track("\"a.rotation.y\": [[0, 0], {\"t\": 1, \"v\": 6.2832}]"), "in radians"));
  CHECK(track("\"a.rotation\": {\"axis\": \"z\", \"keys\": [[0, 0], [1, 3.14159], [2, 5]]}").empty());
  CHECK(track("\"a.rotation\": {\"axis\": \"z\", \"keys\": [[0, 0], [1, 11], [2, 22]]}").empty());
  CHECK(track("\"a.angle\": [[0, 0], [1, 3.14159]]").empty());
  const auto node = [](const std::string& rotation) {
    return notes_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {\"rotation\": " + rotation + "}}}");
  };
  CHECK(has(node("{\"axis\": \"y\", \"angle\": 1.5708}"), "(at /nodes/a/rotation)"));
  CHECK(node("{\"axis\": \"y\", \"angle\": 90}").empty());
}

TEST_CASE("keys after the end that a clip is given are noted") {
  const auto noted = [](const std::string& clip) {
    return notes_of("{\"tweenfall\": 1, \"clips\": {\"c\": {" + clip +
                    "\"tracks\": {\"a.position\": [[0, [0, 0, 0]], [3, [1, 0, 0]]]}}}}");
  };
  CHECK(has(noted("\"duration\": 1, "), "goes on to 3 s, but the clip ends at 1 s: what comes after is never reached"));
  CHECK(noted("\"duration\": 3, ").empty());
  CHECK(noted("\"duration\": 4, ").empty());
  CHECK(noted("").empty());
}

TEST_CASE("a step that is a rate is noted, and so is one too long for bodies") {
  const auto noted = [](const std::string& step) {
    return notes_of("{\"tweenfall\": 1, \"world\": {\"step\": " + step + "}}");
  };
  CHECK(has(noted("240"), "did you mean \"1/240\"?"));
  CHECK(has(noted("240"), "(at /world/step)"));
  CHECK(has(noted("0.11"), "1/240 is usual"));
  // As a rate it would be refused.
  CHECK(has(noted("1e300"), "steps of 1e+300 s are too long for bodies that move; 1/240 is usual"));
  CHECK(has(noted("\"1/100000\""),
            "steps of 1e-05 s are 1e+05 per second, each of which takes its time; 1/240 is usual"));
  CHECK(noted("\"1/10000\"").empty());
  // A spin too fast for such steps is a consequence of them, and not noted again.
  const std::string spinning = notes_of(
      "{\"tweenfall\": 1, \"world\": {\"step\": 240}, \"nodes\": {\"top\": {\"body\": {\"shape\": {\"sphere\": "
      "{\"radius\": "
      "1}}, \"angular_velocity\": [0, 90, 0]}}}}");
  CHECK(std::count(spinning.begin(), spinning.end(), '\n') == 1);
  CHECK(noted("0.1").empty());
  CHECK(noted("\"1/1000\"").empty());
}

TEST_CASE("bodies that start in each other are noted, those side by side are not") {
  const std::string still = ", \"world\": {\"gravity\": [0, 0, 0]}";
  const std::string deep = notes_of(two_balls("[0, 0.4, 0]", still));
  CHECK(has(deep, "starts 0.6 m deep in"));
  CHECK(has(deep, "at 0.5 m/s at most"));
  CHECK(notes_of(two_balls("[0, 1, 0]", still)).empty());
  const auto parted = [](const std::string& separation) {
    return notes_of(
        two_balls("[0, 0.4, 0]", ", \"world\": {\"gravity\": [0, 0, 0], \"separation\": \"" + separation + "\"}"));
  };
  CHECK(has(parted("half"), "; they are moved apart at once"));
  CHECK(has(parted("closest-point"), "; one of them is moved out at once"));
}

TEST_CASE("springs that the step cannot show and turns of more than half a turn in a step are noted") {
  const auto spring = [](const std::string& stiffness) {
    return notes_of(two_balls(
        "[3, 0, 0]", ", \"world\": {\"forces\": [{\"spring\": {\"a\": \"a\", \"stiffness\": " + stiffness + "}}]}"));
  };
  CHECK(has(spring("1e6"), "(at /world/forces/0/spring/stiffness)"));
  CHECK(has(spring("1e6"), "Steps of 1/1000 s or less show it"));
  CHECK(spring("50000").empty());
  const auto turn = [](const std::string& degrees) {
    return notes_of(
        "{\"tweenfall\": 1, \"clips\": {\"c\": {\"tracks\": {\"a.rotation\": {\"axis\": \"z\", \"keys\": [[0, 0, "
        "\"linear\"], [1, " +
        degrees + "]]}}}}}");
  };
  CHECK(has(turn("1e7"), "turns by 1e+07 degrees per second"));
  CHECK(has(turn("1e7"), "(at /clips/c/tracks/a.rotation)"));
  CHECK(turn("43000").empty());
  CHECK(has(turn("43300"), "half a turn"));
}

TEST_CASE("a clip of ages is noted, and what a pattern leaves out") {
  CHECK(has(notes_of("{\"tweenfall\": 1, \"clips\": {\"c\": {\"duration\": 1e300}}}"), "(at /clips/c/duration)"));
  const std::string rule = notes_of(
      "{\"tweenfall\": 1, \"nodes\": {\"floor\": {\"body\": {\"shape\": {\"plane\": {}}, \"static\": true}}, \"ball\": "
      "{\"position\": [0, 1, 0], \"body\": {\"shape\": {\"sphere\": {\"radius\": 0.2}}}}}, \"handoff\": [{\"body\": "
      "\"*\", "
      "\"when\": {\"at\": 0.5}, \"to\": {\"hz\": 2}}]}");
  CHECK(has(rule, "\"*\" leaves out \"floor\""));
  CHECK(has(rule, "(at /handoff/0/body)"));
}

TEST_CASE("a loop with more events than a recording holds is noted, whether it is played by name or alone") {
  const auto noted = [](double loop, const std::string& play) {
    const std::string length = number_text(loop);
    return notes_of("{\"tweenfall\": 1, \"nodes\": {\"a\": {}}, \"clips\": {\"c\": {\"duration\": " + length +
                    ", \"loop\": \"repeat\", \"tracks\": {\"a.position\": [[0, [0, 0, 0]], [" + length +
                    ", [1e-9, 0, 0]]]}, \"events\": [[0, \"e\"]]}}" + play + "}");
  };
  for (const char* const play : {"", ", \"play\": [{\"clip\": \"c\"}]"}) {
    CAPTURE(play);
    CHECK(has(noted(1e-6, play), "has more than a million events within"));
    CHECK(noted(1e-3, play) == "");
  }
}

TEST_CASE("a drive's track without a body to drive, or of negative frequencies, is told at the track") {
  const auto told = [](const std::string& track) {
    try {
      (void)Document::parse(
          "{\"tweenfall\": 1,\n\"nodes\": {\"a\": {}, \"b\": {\"position\": [0, 1, 0], \"body\": {\"shape\": "
          "{\"sphere\": {\"radius\": 1}}}}, \"floor\": {\"body\": {\"shape\": {\"plane\": {}}, "
          "\"static\": true}}},\n\"clips\": {\"c\": {\"tracks\": {\n" +
              track + "}}}}",
          "d.json", data_folder());
    } catch (const DocumentError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(has(told("\"a.drive_hz\": [[0, 1]]"), "d.json:4:15: error: \"a\" has no body that could be driven"));
  CHECK(has(told("\"floor.drive_hz\": [[0, 1]]"), "d.json:4:19: error: \"floor\" has no body that could be driven"));
  CHECK(has(told("\"b.drive_hz\": [[0, 1], [2, -3]]"), "at 2 s it is -3 Hz"));
  CHECK(told("\"b.drive_hz\": [[0, 0], [2, 3]]") == "");
}

TEST_CASE("of a group, too, what is static is left out with a note") {
  const std::string body = "\"body\": {\"shape\": {\"sphere\": {\"radius\": 0.2}}";
  const std::string rule =
      notes_of("{\"tweenfall\": 1, \"nodes\": {\"post\": {\"group\": \"fence\", " + body +
               ", \"static\": true}}, \"rail\": {\"position\": [0, 1, 0], \"group\": \"fence\", " + body +
               "}}}, \"handoff\": [{\"group\": \"fence\", \"when\": {\"at\": 0.5}, \"to\": {\"hz\": 2}}]}");
  CHECK(has(rule, "\"fence\" leaves out \"post\""));
  CHECK(has(rule, "(at /handoff/0/group)"));
}

TEST_CASE("what the stage would refuse is told with its place, all at once") {
  const std::string said = faults_of(
      "{\"tweenfall\": 1, \"world\": {\"gravity\": [0, 1e300, 0]}, \"nodes\": {\n"
      "  \"far\": {\"position\": [1e39, 0, 0],\n    \"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}}},\n"
      "  \"light\": {\n    \"body\": {\"shape\": {\"sphere\": {\"radius\": 1}}, \"mass\": 1e-40}}}}",
      "n.json", {});
  CHECK(has(said, "n.json:1:39: error: gravity must be finite and at most 1e30"));
  CHECK(has(said, "n.json:3:13: error: the body of \"far\": position must be"));
  CHECK(has(said, "n.json:5:13: error: the body of \"light\": mass must lie"));
  CHECK(has(
      faults_of(two_balls("[3, 0, 0]",
                          ", \"world\": {\"forces\": [{\"drag\": {}}, {\"spring\": {\"a\": \"a\", \"stiffness\": 1, "
                          "\"rest_length\": 1e200}}]}"),
                "n.json", {}),
      "(at /world/forces/1)"));
}

TEST_CASE("files that import each other twice are read once each, and what they bring is bounded") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "tweenfall-doubling-imports";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto write = [&](int level, const std::string& text) {
    std::ofstream(folder / ("level" + std::to_string(level) + ".json")) << "{\"tweenfall\": 1, " << text << "}";
  };
  constexpr int levels = 30;
  write(levels, "\"nodes\": {\"leaf\": {}}");
  for (int i = 0; i < levels; ++i) {
    const std::string next = "\"level" + std::to_string(i + 1) + ".json\"";
    write(i, "\"import\": {\"a\": " + next + ", \"b\": " + next + "}");
  }
  CHECK(Document::read(folder / "level20.json").stage().nodes.size() == 1024);
  const double start = test::processor_seconds();
  try {
    (void)Document::read(folder / "level0.json");
    FAIL("a thousand million nodes were read");
  } catch (const DocumentError& error) {
    CHECK(error.problems().size() < 100);
    CHECK(has(error.what(), "more than 100000 nodes and tracks would be imported"));
    CHECK(has(error.what(), "(at /import/b)"));
  }
  CHECK(test::processor_seconds() - start < 5);
  std::filesystem::remove_all(folder);
}

TEST_CASE("what numbers or steps cannot follow is noted where it stands") {
  const auto ball = [](const std::string& rest) {
    return notes_of(
        "{\"tweenfall\": 1, \"nodes\": {\"b\": {\"body\": {\"shape\": {\"sphere\": {\"radius\": 0.5}}, "
        "\"mass\": 2, \"velocity\": [12, 0, 0]}}}, \"world\": {" +
        rest + "}}");
  };
  const std::string drag = "\"forces\": [{\"drag\": {\"quadratic\": 200}}]";
  CHECK(ball(drag).empty());
  CHECK(has(ball("\"integrator\": \"rk4\", " + drag), "this force slows \"b\" at a rate of 2400/s"));
  CHECK(has(ball("\"integrator\": \"rk4\", " + drag), "(at /world/forces/0)"));
  CHECK(has(ball("\"gravity\": [0, -1e30, 0]"), "(at /world/gravity)"));
  const auto rope = [](const std::string& length) {
    return notes_of("{\"tweenfall\": 1, \"world\": {\"soft\": {\"r\": {\"rope\": {\"from\": [0, 0, 0], \"to\": [" +
                    length + ", 0, 0]}}}}}");
  };
  CHECK(rope("10").empty());
  CHECK(has(rope("1e12"), "(at /world/soft/r)"));
}

TEST_CASE("steps are not tried for who does not ask for them") {
  const std::string pushed =
      R"({"tweenfall": 1, "nodes": {"b": {"body": {"shape": {"sphere": {"radius": 0.5}}, "mass": 1}}},
          "world": {"forces": [{"push": {"body": "b", "force": [1e12, 0, 0]}}]}})";
  CHECK(Document::parse(pushed, "pushed.json", "").notes().size() == 1);
  CHECK(Document::parse(pushed, "pushed.json", "", {.try_steps = false}).notes().empty());
}

TEST_CASE("weights of a blend that fall to zero are noted where they stand") {
  const auto blend = [](const std::string& parts) {
    return notes_of(
        R"({"tweenfall": 1, "nodes": {"b": {}}, "clips": {"w": {"tracks": {"b.position": [[0, [0, 0, 0]], [1, [1, 0, 0]]]}}},
      "graphs": {"g": {"poses": {"p": {"blend": )" +
        parts + "}}}}}");
  };
  CHECK(blend("[[\"w\", [[0, 1], [1, 0]]], [\"w\", 0]]") ==
        "n.json:2:49: note: these weights sum to zero from 1 s on: the pose below the graph shows then (at "
        "/graphs/g/poses/p/blend)\n");
  CHECK(blend("[[\"w\", [[0, 1], [1, 0.1]]]]").empty());
}

TEST_CASE("a formula without a value somewhere in its first second is noted, with the first such time") {
  const auto noted = [](const std::string& expression) {
    return notes_of(
        "{\"tweenfall\": 1, \"clips\": {\"c\": {\"duration\": 2, \"tracks\": {\"lamp.energy\": {\"expression\": \"" +
        expression + "\"}}}}}");
  };
  CHECK(has(noted("sqrt(-1-t)"), "no finite value at 0 s; where it has none, it is 0"));
  CHECK(has(noted("1/(t-1)"), "no finite value at 1 s"));
  CHECK(has(noted("exp(1000*t)"), "no finite value at 0.75 s"));
  CHECK(noted("1/(t+1)").empty());
  CHECK(noted("sqrt(t)").empty());
}
