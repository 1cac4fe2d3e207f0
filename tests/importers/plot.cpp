#include <tweenfall/importers/plot.h>

#include "page/example_stage.h"
#include "support.h"

#include <sstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

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

TEST_CASE("a plot marks each key, the slopes on its sides and the events") {
  const std::string svg = plot_svg(one_track(), nullptr);
  CHECK(count(svg, "class=\"key\"") == 4);
  CHECK(count(svg, "class=\"tangent\"") == 6);  // two a key, one at the ends
  CHECK(count(svg, "class=\"event\"") == 2);    // through both panels
  CHECK(count(svg, ">click<") == 1);
  CHECK(count(svg, "class=\"curve\"") == 2);
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

TEST_CASE("a track or clip that is not there is named with those that are") {
  CHECK_THROWS_WITH_AS((void)plot_svg(one_track(), nullptr, {.tracks = {"lamp.color"}, .clip = ""}),
                       "there is no track \"lamp.color\"; there are: lamp.brightness", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)plot_svg(one_track(), nullptr, {.tracks = {}, .clip = "walk"}),
                       "there is no clip \"walk\"; there are: lamp", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)plot_svg(StageDescription{}, nullptr), "there are no tracks to plot",
                       std::invalid_argument);
}
