// User tracks as plays and graphs mix them: in tables, on the page, and over the curves of a plot.

#include "support.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/recording.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const char* const mixed_document = R"({
  "tweenfall": 1,
  "nodes": {"hips": {}, "hips.tail": {}, "lamp": {}},
  "clips": {
    "walk": {"duration": 2, "tracks": {"hips.effort": [[0, 0, "linear"], [2, 4]], "hips.wind": [[0, [1, 2, 3]]],
                                       "hips.tail.wag": [[0, 3]], "lamp.on": [[0, true]], "lamp.word": [[0, "go, on"]],
                                       "lamp.glow": [[0, "#ff0000"]]}},
    "stand": {"duration": 2, "tracks": {"hips.effort": [[0, 1]]}}
  },
  "play": [{"clip": "stand"}],
  "graphs": {"g": {
    "parameters": {"speed": 0},
    "poses": {"gait": {"space": {"by": "speed", "poses": [[0, "stand"], [1, "walk"]]}}},
    "inputs": [[0.5, "speed", 0.75]]
  }}
})";

/// The fields of a row without quoted commas but one, "go, on".
std::vector<std::string> fields_of(std::string row) {
  if (const std::size_t quoted = row.find("\"go, on\""); quoted != std::string::npos) row.replace(quoted, 8, "go; on");
  std::vector<std::string> fields;
  std::istringstream in(row + ",");
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

TEST_CASE("a table has columns for user tracks, filled in the rows of their nodes, as plays and graphs mix them") {
  Stage stage(Document::parse(mixed_document, "mixed.json", ".").stage());
  const Recording recording = record(stage, 1, 2);
  std::istringstream lines(recording_csv(recording));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> header = fields_of(line);
  for (const char* name : {"hips.effort", "hips.wind_x", "hips.wind_y", "hips.wind_z", "hips.tail.wag", "lamp.on",
                           "lamp.word", "lamp.glow_r", "lamp.glow_g", "lamp.glow_b", "lamp.glow_a"}) {
    CAPTURE(name);
    CHECK(std::ranges::count(header, name) == 1);
  }
  std::map<std::string, std::map<std::string, std::string>> at_end;  // by node, by column
  while (std::getline(lines, line)) {
    const std::vector<std::string> row = fields_of(line);
    REQUIRE(row.size() == header.size());
    for (std::size_t i = 0; i < row.size(); ++i) at_end[row[1]][header[i]] = row[i];
  }
  CHECK(at_end["hips"]["time"] == "1");
  CHECK(at_end["hips"]["hips.effort"] == "1.75");  // a quarter of 1, three quarters of 2
  CHECK(at_end["hips"]["hips.wind_y"] == "1.5");
  CHECK(at_end["hips"]["lamp.on"].empty());
  CHECK(at_end["hips"]["hips.tail.wag"].empty());
  CHECK(at_end["hips.tail"]["hips.tail.wag"] == "2.25");
  CHECK(at_end["hips.tail"]["hips.effort"].empty());
  CHECK(at_end["lamp"]["lamp.on"] == "1");
  CHECK(at_end["lamp"]["lamp.word"] == "go; on");
  CHECK(at_end["lamp"]["lamp.glow_a"] == "0.75");
}

TEST_CASE("the page shows user tracks among the graphs: numbers as curves, texts as they follow each other") {
  const StageDescription described = Document::parse(mixed_document, "mixed.json", ".").stage();
  Stage stage(described);
  const std::string page = recording_html(record(stage, 1, 4), described);
  CHECK(page.find(R"({"name":"user tracks","parameters":[)") != std::string::npos);
  for (const char* name : {"hips.effort", "hips.wind.x", "hips.tail.wag", "lamp.on", "lamp.glow.a"})
    CHECK(page.find(std::string(R"({"name":")") + name + R"(","values":)") != std::string::npos);
  // The word comes with the clip that has it.
  CHECK(page.find(R"({"states":["","go, on"],"name":"lamp.word")") != std::string::npos);
  CHECK(page.find(R"("passages":[{"time":0,"state":0,"how":"","when":""},{"time":0.5,"state":1)") != std::string::npos);
}

TEST_CASE("a plot shows a user track as graphs mix it over its curve") {
  const StageDescription described = Document::parse(mixed_document, "mixed.json", ".").stage();
  Stage stage(described);
  const Recording recording = record(stage, 2, 4);
  const PlotOptions options{.tracks = {"hips.effort"}, .clip = "walk"};
  CHECK(plot_svg(described, &recording, options).find("class=\"simulated\"") != std::string::npos);
  CHECK(plot_svg(described, nullptr, options).find("class=\"simulated\"") == std::string::npos);
}
