#include <tweenfall/importers/plot.h>

#include "page/example_stage.h"
#include "support.h"

#include <tweenfall/importers/document.h>

#include <sstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A stage of one clip with one track of plain numbers: easings, a hold, given slopes and a jump.
StageDescription one_track() {
  StageDescription stage;
  stage.name = "lamp";
  Clip clip;
  clip.name = "lamp";
  clip.duration = 2;
  Key<double> last{2, 1};
  last.value_in = 0.5;
  clip.tracks.push_back(
      {"lamp", "brightness", keyed_curve<double>({{0, 0, Ease::linear()}, {0.5, 1, Ease::hold()}, {1, 0.25}, last})});
  clip.events.push_back({.from = 1.5, .to = 1.5, .name = "click", .data = ""});
  stage.clips.push_back(clip);
  return stage;
}

/// A clip of one track, which lasts as long as the track's keys.
StageDescription stage_of(Track track, double duration) {
  StageDescription stage;
  stage.name = "one";
  Clip clip;
  clip.name = "clip";
  clip.duration = duration;
  clip.tracks.push_back(std::move(track));
  stage.clips.push_back(std::move(clip));
  return stage;
}

/// Whether every number of a picture is finite, and none is written in a way that only huge ones need.
bool is_sound_picture(const std::string& svg) {
  return svg.ends_with("</svg>\n") && svg.find("nan") == std::string::npos && svg.find("inf") == std::string::npos &&
         svg.size() < 300'000;
}

}  // namespace

TEST_CASE("a plot is the golden file, byte for byte") {
  const std::filesystem::path file = data_folder() / "golden/plot.svg";
  const std::string svg = plot_svg(one_track(), nullptr);
  if (std::getenv("TWEENFALL_WRITE_GOLDEN")) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << svg;
  }
  std::ifstream stream(file, std::ios::binary);
  std::stringstream golden;
  golden << stream.rdbuf();
  REQUIRE_MESSAGE(!golden.str().empty(), "cannot read " << file.string());
  CHECK_MESSAGE(svg == golden.str(),
                "the plot differs; where that is wanted, run once with TWEENFALL_WRITE_GOLDEN=1 and look at the file");
}

TEST_CASE("a plot marks each key, the handles that keys have and the events") {
  const std::string svg = plot_svg(one_track(), nullptr);
  CHECK(count(svg, "class=\"key\"") == 4);
  CHECK(count(svg, "class=\"handle\"") == 2);  // of the one span that is a cubic
  CHECK(count(svg, "class=\"event\"") == 2);   // through both panels
  CHECK(count(svg, ">click<") == 1);
  CHECK(count(svg, "class=\"curve\"") == 2);
}

TEST_CASE("what hardly changes has its levels counted from the lowest, where all their digits would not fit") {
  const auto plotted = [](double from, double to) {
    return plot_svg(stage_of({"lamp", "energy", keyed_curve<double>({{0, from, Ease::linear()}, {1, to}})}, 1), nullptr,
                    {.rates = false});
  };
  const std::string still = plotted(2.3, 2.3 + 1e-8);
  CHECK(count(still, ">above 2.3<") == 1);
  for (const char* level : {">0<", ">+5e-9<", ">+1e-8<"}) {
    CAPTURE(level);
    CHECK(count(still, level) == 1);
  }
  const std::string wide = plotted(2.3, 2.5);
  CHECK(count(wide, ">above") == 0);
  CHECK(count(wide, ">2.4<") == 1);
}

TEST_CASE("rates are not joined where a play begins, turns, changes its speed or ends") {
  const Document document = Document::parse(R"({"tweenfall": 1, "nodes": {"there": {}, "once": {}, "slower": {}},
      "clips": {"p": {"loop": "pingpong", "tracks": {"there.position.x": [[0, 0, "linear"], [0.7, 2]]}},
                "o": {"tracks": {"once.position.x": [[0, 0, "linear"], [1, 2], [1.4, 2]]}},
                "s": {"tracks": {"slower.position.x": [[0, 0, "linear"], [3, 2]]}}},
      "play": [{"clip": "p"}, {"clip": "o", "at": 0.513, "to": 0.8},
               {"clip": "s", "at": 0.213, "speed": [[0, 1, "hold"], [1, 0.25, "hold"], [2, 0.25]]}]})",
                                            "rates.json", {});
  Stage stage(document.stage());
  const Recording recording = record(stage, 3, 60);
  const std::pair<const char*, int> pieces[] = {{"there", 5}, {"once", 3}, {"slower", 3}};
  for (const auto& [node, count_of_pieces] : pieces) {
    const std::string svg =
        plot_svg(document.stage(), &recording, {.tracks = {std::string(node) + ".position.x"}, .clip = ""});
    const std::size_t values = svg.find("class=\"curve\""), rates = svg.find("class=\"curve\"", values + 1);
    REQUIRE(rates != std::string::npos);
    const std::size_t from = svg.find(" d=\"", rates) + 4;
    const std::string path = svg.substr(from, svg.find('"', from) - from);
    CHECK(std::count(path.begin(), path.end(), 'M') == count_of_pieces);
    // Constant rates: every piece is level.
    std::istringstream places(path);
    for (std::string piece; std::getline(places, piece, 'M');) {
      std::istringstream of_piece(piece);
      std::string first;
      for (std::string place; std::getline(of_piece, place, 'L');) {
        const std::string height = place.substr(place.find(' ') + 1);
        if (first.empty()) first = height;
        CHECK(height == first);
      }
    }
  }
}

TEST_CASE("a recorded plot has the hand-off line and the simulated continuation") {
  const StageDescription stage = example_stage();
  const Recording recording = example_recording();
  const std::string crate = plot_svg(stage, &recording, {.tracks = {"crate.position"}, .clip = ""});
  CHECK(count(crate, "class=\"handoff\"") == 4);     // two hand-offs, two panels
  CHECK(count(crate, "class=\"simulated\"") == 12);  // driven and free, three components, two panels
  // The pivot's swing is keyed to the end; the bob below it is let go.
  const std::string pivot = plot_svg(stage, &recording, {.tracks = {"pivot.rotation"}, .clip = ""});
  CHECK(count(pivot, "class=\"handoff\"") == 2);
  CHECK(count(pivot, ">bob free<") == 1);
  CHECK(count(pivot, "class=\"simulated\"") == 0);
}

TEST_CASE("a body that is taken back is plotted as it was shown, not as its clip would have been") {
  const StageDescription described = Document::parse(starting_document(), "start.json", {}).stage();
  Stage stage(described);
  const Recording recording = record(stage, natural_length(described), 60);
  const std::string svg = plot_svg(described, &recording, {.tracks = {"ball.position"}, .clip = ""});
  CHECK(count(svg, "class=\"simulated\"") == 12);  // let go and taken back, three components, two panels
}

TEST_CASE("a rotation about an axis is plotted as its angle in degrees, which does not wrap") {
  StageDescription stage;
  const Curve<double> two_turns = keyed_curve<double>({{0, 0, Ease::linear()}, {2, 4 * 3.141592653589793}});
  stage.clips.push_back({.name = "turn", .duration = 2});
  stage.clips[0].tracks.push_back({"wheel", "rotation", axis_curve(Vec3(0, 1, 0), two_turns)});
  const std::string svg = plot_svg(stage, nullptr, {.tracks = {}, .clip = "", .rates = false});
  CHECK(count(svg, ">degrees<") == 1);
  CHECK(count(svg, ">600<") == 1);
  REQUIRE(count(svg, "class=\"curve\"") == 1);  // the angle alone
  const std::size_t at = svg.find(" d=\"", svg.find("class=\"curve\"")) + 4;
  const std::string line = svg.substr(at, svg.find('"', at) - at);
  // A steady turn is one straight line; a wrapped one would have corners.
  CHECK(count(line, "L") <= 10);
  CHECK(count(line, "M") == 1);
  double before = 1e9;
  for (std::size_t i = line.find('L'); i != std::string::npos; i = line.find('L', i + 1)) {
    const double y = std::stod(line.substr(line.find(' ', i) + 1));
    CHECK(y < before);
    before = y;
  }
}

TEST_CASE("rotations about changing axes are plotted as three angles that pass a gimbal lock without a jump") {
  StageDescription stage;
  stage.clips.push_back({.name = "turn", .duration = 2});
  const double right = 3.141592653589793 / 2;
  const Curve<Vec3> angles = keyed_curve<Vec3>({{0, Vec3(0.4, 0, 0), Ease::linear()}, {2, Vec3(0.4, 2 * right, 0.5)}});
  stage.clips[0].tracks.push_back({"arm", "rotation", euler_curve(angles, {})});
  const std::string svg = plot_svg(stage, nullptr, {.tracks = {}, .clip = "", .rates = false});
  REQUIRE(count(svg, "class=\"curve\"") == 3);
  for (std::size_t at = svg.find("class=\"curve\""); at != std::string::npos;
       at = svg.find("class=\"curve\"", at + 1)) {
    const std::size_t begin = svg.find(" d=\"", at) + 5;
    const std::string line = svg.substr(begin, svg.find('"', begin) - begin);
    CHECK(count(line, "L") <= 24);  // straight lines again
  }
}

TEST_CASE("what curves do beyond their keys is shown, shaded, where they do not rest there") {
  StageDescription stage = one_track();
  CHECK(count(plot_svg(stage, nullptr), "class=\"beyond\"") == 0);
  auto& curve = std::get<Curve<double>>(stage.clips[0].tracks[0].curve);
  curve = curve.with_outside(Outside::hold, Outside::repeat);
  const std::string svg = plot_svg(stage, nullptr);
  CHECK(count(svg, "class=\"beyond\"") == 2);  // after the last key, in two panels
  CHECK(count(svg, ">3 s<") == 1);             // half the clip's length more
}

TEST_CASE("of very many tracks a plot draws some and says how many more there are") {
  StageDescription stage = one_track();
  for (int i = 0; i < 75; ++i) stage.clips[0].tracks.push_back({"node" + std::to_string(i), "x", Curve<double>(1.0)});
  const std::string svg = plot_svg(stage, nullptr, {.tracks = {}, .clip = "", .columns = 4, .rates = false});
  CHECK(count(svg, "class=\"curve\"") == 64);
  CHECK(count(svg, ">and 12 more") == 1);
  CHECK_THROWS_WITH_AS((void)plot_svg(stage, nullptr, {.tracks = {}, .clip = "", .columns = 7}),
                       "a plot has 1 to 6 columns; found 7", std::invalid_argument);
}

TEST_CASE("names of events that are close stand in rows below each other") {
  StageDescription stage = one_track();
  stage.clips[0].events.push_back({.from = 1.51, .to = 1.51, .name = "clack", .data = ""});
  const std::string svg = plot_svg(stage, nullptr);
  const auto y_of = [&](const std::string& name) {
    const std::size_t at = svg.rfind(" y=\"", svg.find(">" + name + "<"));
    return std::stod(svg.substr(at + 4));
  };
  CHECK(std::abs(y_of("click") - y_of("clack")) > 10);
}

TEST_CASE("a track or clip that is not there is named with those that are") {
  CHECK_THROWS_WITH_AS((void)plot_svg(one_track(), nullptr, {.tracks = {"lamp.color"}, .clip = ""}),
                       "there is no track \"lamp.color\"; there are: lamp.brightness", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)plot_svg(one_track(), nullptr, {.tracks = {}, .clip = "walk"}),
                       "there is no clip \"walk\"; there are: lamp", std::invalid_argument);
  CHECK(count(plot_svg(StageDescription{}, nullptr), ">no tracks<") == 1);
}

TEST_CASE("numbers that no axis can hold are left out of the picture, which says so") {
  const double huge = 1.7e308;
  for (const double size : {1e155, 1e200, 1e301, huge}) {
    CAPTURE(size);
    const StageDescription colored =
        stage_of({"a", "color", keyed_curve<Color>({{0, Color{{0, 1, 0, 1}}}, {1, Color{{size, -size, 0, 1}}}})}, 1);
    CHECK(is_sound_picture(plot_svg(colored, nullptr)));
    const StageDescription steep =
        stage_of({"a", "x", keyed_curve<double>({{0, 0, Ease::linear()}, {0.5, size / 4, Ease::linear()}, {1, 0}})}, 1);
    CHECK(is_sound_picture(plot_svg(steep, nullptr)));
  }
  const std::string svg = plot_svg(
      stage_of(
          {"a", "x",
           keyed_curve<double>({{0, 0, Ease::hold()}, {0.5, 1e301, Ease::hold()}, {0.7, 1, Ease::linear()}, {1, 2}})},
          1),
      nullptr);
  CHECK(is_sound_picture(svg));
  CHECK(count(svg, ">beyond 1e300 not drawn<") == 1);
  CHECK(count(svg, ">2<") >= 1);  // the rest has an axis of its own size
}

TEST_CASE("a clip of any length has a picture with a time axis that ends") {
  for (const double length : {1e-150, 1e-99, 1e-12, 1e-3, 1e6, 1e15, 1e300}) {
    CAPTURE(length);
    const std::string svg =
        plot_svg(stage_of({"a", "x", keyed_curve<double>({{0, 0, Ease::hold()}, {length, 1}})}, length), nullptr);
    CHECK(is_sound_picture(svg));
    CHECK(count(svg, " s</text>") >= 2);
    CHECK(count(svg, " s</text>") <= 40);
  }
}

TEST_CASE("ticks that need many digits are told with an exponent") {
  const std::string svg = plot_svg(stage_of({"a", "x", keyed_curve<double>({{0, 0, Ease::linear()}, {1, 4e7}})}, 1),
                                   nullptr, {.rates = false});
  CHECK(count(svg, ">1e7<") == 1);
  CHECK(count(svg, ">4e7<") == 1);
  const std::string tiny = plot_svg(stage_of({"a", "x", keyed_curve<double>({{0, 0, Ease::linear()}, {1, 4e-7}})}, 1),
                                    nullptr, {.rates = false});
  CHECK(count(tiny, ">4e-7<") == 1);
}

TEST_CASE("a loop that starts from where it ended is plotted with what it gained") {
  StageDescription stage =
      stage_of({"ball", "position", keyed_curve<Vec3>({{0, Vec3(0, 0, 0), Ease::linear()}, {1, Vec3(2, 0, 0)}})}, 1);
  stage.clips[0].loop = {.mode = LoopMode::repeat_offset, .count = 3};
  stage.nodes.push_back({.name = "ball"});
  stage.plays = {{.clip = 0}};
  Stage run(stage);
  const Recording recording = record(run, 3, 30);
  CHECK(recording.nodes[0].world.back().motion.pose.position.x() == doctest::Approx(6));
  const std::string svg = plot_svg(stage, &recording);
  CHECK(count(svg, ">6<") == 1);  // the axis goes to where it ends
  CHECK(count(svg, ">7<") == 0);
}

TEST_CASE(
    "labels stand beside curves where there is room, and below them in the order of drawing where there is none") {
  StageDescription stage =
      stage_of({"a", "x", keyed_curve<double>({{0, 0, Ease::linear()}, {0.5, 0, Ease::linear()}, {1, 1}})}, 1);
  stage.clips[0].events.push_back({.from = 0.1, .to = 0.1, .name = "beside", .data = ""});
  const std::string svg = plot_svg(stage, nullptr, {.rates = false});
  const std::size_t label = svg.find("class=\"moment\""), curve = svg.find("class=\"curve\"");
  REQUIRE(label != std::string::npos);
  CHECK(label < curve);
  CHECK(svg.find("paint-order") == std::string::npos);
  // The curve runs along the lowest rows, where the label would be placed first.
  const std::size_t y = svg.find("y=\"", label) + 3;
  const std::size_t frame = svg.find("height=\"150\"");
  REQUIRE(frame != std::string::npos);
  const double baseline = std::stod(svg.substr(y, 8)), bottom = 52 + 26 + 150;
  CHECK(baseline <= bottom - 5 - 11);
}

TEST_CASE("labels stand beside the handles of keys") {
  const auto baseline_of = [](const char* tangents) {
    const Document document = Document::parse(R"({"tweenfall": 1, "clips": {"c": {
      "tracks": {"a.x": [[0, 1, "linear"], {"t": 0.5, "v": 0)" +
                                                  std::string(tangents) + R"(}, [1, 1]]},
      "events": [[0.61, "by"]]}}})",
                                              "label.json", {});
    const std::string svg = plot_svg(document.stage(), nullptr, {.rates = false});
    const std::size_t label = svg.find("class=\"moment\"");
    REQUIRE(label != std::string::npos);
    return std::stod(svg.substr(svg.find("y=\"", label) + 3, 8));
  };
  // Neither curve comes near, but the handle runs through where the label would be.
  CHECK(baseline_of(R"(, "out": {"rate": 0, "weight": 0.3333})") <= baseline_of(R"(, "ease": "linear")") - 11);
}

TEST_CASE("no label lies over another, however close events are: equal ones are counted, further ones too") {
  // A ball that bounces ever more often, and twenty things that begin at once.
  std::string events;
  for (int i = 0; i < 20; ++i) events += "[0.5, \"light " + std::to_string(i) + "\"], ";
  double time = 1;
  for (double gap = 0.6; gap > 1e-3; gap *= 0.7) {
    events += "[" + std::to_string(time) + ", \"bounce\"], ";
    time += gap;
  }
  for (int i = 0; i < 40; ++i)
    events +=
        "[" + std::to_string(3 + 0.01 * i) + ", \"step number " + std::to_string(i) + "\"]" + (i < 39 ? ", " : "");
  const Document document = Document::parse(
      R"({"tweenfall": 1, "clips": {"c": {"tracks": {"a.position": [[0, [0, 0, 0]], [4, [1, 2, 3]]]}, "events": [)" +
          events + "]}}}",
      "labels.json", {});
  const std::string svg = plot_svg(document.stage(), nullptr, {.rates = false});
  struct Label {
    double from, to, y;
    std::string text;
  };
  std::vector<Label> labels;
  for (std::size_t at = svg.find("class=\"moment\""); at != std::string::npos;
       at = svg.find("class=\"moment\"", at + 1)) {
    const auto number = [&](const char* name) { return std::stod(svg.substr(svg.find(name, at) + 4, 8)); };
    const std::size_t begin = svg.find('>', at) + 1;
    const std::string text = svg.substr(begin, svg.find('<', begin) - begin);
    labels.push_back(
        {number(" x=\""), number(" x=\"") + 5.5 * static_cast<double>(text.size()), number(" y=\""), text});
  }
  CHECK(labels.size() > 8);
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const bool apart =
          std::abs(labels[i].y - labels[k].y) > 9 || labels[i].from > labels[k].to || labels[k].from > labels[i].to;
      CHECK_MESSAGE(apart, labels[i].text << " lies over " << labels[k].text);
    }
  const auto says = [&](const std::string& text) {
    return std::any_of(labels.begin(), labels.end(),
                       [&](const Label& label) { return label.text.find(text) != std::string::npos; });
  };
  CHECK(says("light 2 +17"));
  CHECK(says("bounce \xc3\x97"));
}
