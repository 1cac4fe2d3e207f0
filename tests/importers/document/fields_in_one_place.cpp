// Each field of a body, a play, a rule or the world, and the word of each shape, is named in the file of its thing and
// nowhere else.

#include "support.h"

#include <tweenfall/importers/document.h>

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <sstream>

using namespace tweenfall;

namespace {

// Words that other things of a document have too: other fields, functions and modifiers of tracks, members of clips,
// keys of a document's own, ragdolls.
const std::set<std::string> words_of_others = {
    "clip",       "at",        "speed",        "weight",         "body",
    "to",         "path",      "velocity",     "offset",         "group",
    "gravity",    "step",      "shape",        "ignore",         "mesh",
    "mass",       "friction",  "restitution",  "linear_damping", "angular_damping",
    "fill",       "mask",      "when",         "settle",         "joints",
    "name",       "from",      "loop",         "count",          "once",
    "overlap",    "sweep",     "density",      "integrator",     "solver",
    "iterations", "color",     "plane",        "direction",      "forces",
    "groups",     "collision", "collides_with"};

// A source without its comments, and without the names of its forms in the schema.
std::string code_of(const std::filesystem::path& file) {
  std::istringstream text(test::text_of(file));
  std::string out;
  for (std::string line; std::getline(text, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos || line.compare(first, 2, "//") == 0) continue;
    if (line.find(".definition = ") == std::string::npos) out += line + "\n";
  }
  return out;
}

std::map<std::string, std::vector<std::string>> files_of(const std::set<std::string>& words) {
  std::map<std::string, std::vector<std::string>> files;
  const std::filesystem::path root = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "importers" / "src" / "document";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    // The document that `new` writes is a document, and files of inputs use the same words for what they ask.
    if (entry.path().parent_path().filename() == "inputs") continue;
    if ((extension != ".cpp" && extension != ".h") || entry.path().filename() == "starting_document.cpp") continue;
    const std::string code = code_of(entry.path());
    for (const std::string& word : words)
      if (test::count(code, "\"" + word + "\"") > 0) files[word].push_back(entry.path().filename().string());
  }
  return files;
}

std::set<std::string> fields_of(const std::string& definition) {
  const nlohmann::json schema = nlohmann::json::parse(document_schema());
  std::set<std::string> out;
  for (const auto& [name, form] : schema.at("definitions").at(definition).at("properties").items()) out.insert(name);
  return out;
}

}  // namespace

TEST_CASE("each field of a body, a play, a rule or the world is named in one file of the document's reader") {
  // What a rule does to its bodies is a change, which may come after other changes too.
  const std::set<std::string> of_change = fields_of("change");
  for (const char* thing : {"body", "play", "rule", "world"}) {
    std::set<std::string> fields = fields_of(thing);
    REQUIRE(fields.size() >= 5);
    const auto files = files_of(fields);
    for (const std::string& field : fields) {
      CAPTURE(thing);
      CAPTURE(field);
      REQUIRE(files.count(field) == 1);
      if (words_of_others.contains(field)) continue;
      const bool changes = thing == std::string("rule") && of_change.contains(field);
      CHECK(files.at(field) == std::vector<std::string>{(changes ? "change" : std::string(thing)) + ".cpp"});
    }
  }
}

TEST_CASE("each shape is named in the one file that reads it") {
  const std::set<std::string> shapes = fields_of("shape");
  REQUIRE(shapes.size() >= 7);
  const auto files = files_of(shapes);
  for (const std::string& shape : shapes) {
    CAPTURE(shape);
    REQUIRE(files.count(shape) == 1);
    if (words_of_others.contains(shape)) continue;
    CHECK(files.at(shape) == std::vector<std::string>{shape + ".cpp"});
  }
}
