// Documents that once went wrong, as a user meets them: what the verbs say about each.

#include "command.h"

#include <tweenfall/importers/shown_text.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

namespace fs = std::filesystem;

/// What a bare clone does not have.
fs::path shared_faults() {
  return fs::weakly_canonical(fs::path(TWEENFALL_SOURCE_DIR) / "../shared/faults");
}

/// The documents of the project, and those of the shared folder.
std::vector<fs::path> fault_documents() {
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& folder) {
    const std::size_t before = files.size();
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(fs::canonical(entry.path()));
    CHECK_MESSAGE(files.size() > before, "no document in " << folder.string());
  };
  add(data_folder() / "documents/faults");
  if (fs::is_directory(shared_faults()))
    add(shared_faults());
  else
    MESSAGE("SKIPPED: no folder ../shared/faults; only the project's own documents with faults are tried");
  std::sort(files.begin(), files.end());
  return files;
}

/// The document of this name, of the project or shared; empty for a shared one if those are absent.
std::vector<fs::path> named(const std::string& name) {
  std::vector<fs::path> found;
  for (const fs::path& file : fault_documents())
    if (file.stem() == name) found.push_back(file);
  if (fs::is_directory(shared_faults())) CHECK(!found.empty());
  return found;
}

std::string shell_word(const fs::path& file) {
  return detail::quoted(file.string());
}

/// Whether there is nothing that a terminal would obey or that changes the order of letters.
bool is_tame(const std::string& text) {
  return terminal_lines(text) == text;
}

bool is_well_formed_svg(const std::string& svg) {
  if (utf8_text(svg) != svg || svg.find("]]>") != std::string::npos) return false;
  if (svg.find("nan") != std::string::npos || svg.find("inf") != std::string::npos) return false;
  for (const char* never : {"\xef\xbf\xbe", "\xef\xbf\xbf", "\x01"})
    if (svg.find(never) != std::string::npos) return false;
  return svg.find('\0') == std::string::npos && svg.ends_with("</svg>\n");
}

struct Verb {
  std::string arguments;  ///< with FILE for the document
  std::string writes;
};

const std::vector<Verb> five{{"check FILE", ""},
                             {"run FILE --until 0.3 --fps 30", ""},
                             {"sample FILE --at 0,0.1", ""},
                             {"plot FILE --until 0.3 -o out.svg", "out.svg"},
                             {"view FILE --until 0.3 -o out.html", "out.html"}};

std::string with_file(std::string arguments, const fs::path& file) {
  return arguments.replace(arguments.find("FILE"), 4, shell_word(file));
}

}  // namespace

TEST_CASE("what check calls valid, run, sample, plot and view take; what it refuses, they refuse") {
  std::vector<fs::path> files = fault_documents();
  for (const fs::path& folder :
       {fs::path(TWEENFALL_SOURCE_DIR) / "samples/documents", data_folder() / "documents/good"})
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
  const Folder folder;
  for (const fs::path& file : files) {
    CAPTURE(file.string());
    const int verdict = folder.run(with_file(five[0].arguments, file)).code;
    CHECK((verdict == 0 || verdict == 1));
    for (std::size_t i = 1; i < five.size(); ++i) {
      CAPTURE(five[i].arguments);
      const Ran ran = folder.run(with_file(five[i].arguments, file));
      CAPTURE(ran.err);
      // With several clips the verbs ask which one, and that is a question and no verdict.
      const bool asks = ran.code == 2 && ran.err.find("--clip") != std::string::npos;
      if (verdict == 0)
        CHECK((ran.code == 0 || asks));
      else
        CHECK(ran.code == 1);
      CHECK(is_tame(ran.err));
    }
  }
}

TEST_CASE("each shared document with a fault is held by a test here to what must come out") {
  std::string tests;
  for (const auto& entry : fs::directory_iterator(fs::path(TWEENFALL_SOURCE_DIR) / "tests/cli"))
    tests += detail::content(entry.path());
  for (const fs::path& file : fault_documents())
    if (file.parent_path() == shared_faults())
      CHECK_MESSAGE(tests.find("\"" + file.stem().string() + "\"") != std::string::npos, file.stem().string());
}

TEST_CASE("a rule for all of a pattern leaves out what is static, and every verb says so") {
  const Folder folder;
  for (const fs::path& file : named("pattern_that_takes_a_static_body")) {
    for (const Verb& verb : five) {
      CAPTURE(verb.arguments);
      const Ran ran = folder.run(with_file(verb.arguments, file));
      CHECK(ran.code == 0);
      CHECK_MESSAGE(ran.err.find(": note: \"*\" leaves out \"floor\"") != std::string::npos, ran.err);
    }
    const Ran ran = folder.run("run --until 1 --json " + shell_word(file));
    const nlohmann::json handoffs = nlohmann::json::parse(ran.out)["handoffs"];
    REQUIRE(handoffs.size() == 1);
    CHECK(handoffs[0]["body"] == "ball");
    CHECK(handoffs[0]["to"] == "driven");
  }
}

TEST_CASE("keys so far from each other that no number is the way between them are refused by every verb") {
  const Folder folder;
  for (const fs::path& file : named("plot_of_a_huge_range"))
    for (const Verb& verb : five) {
      CAPTURE(verb.arguments);
      const Ran ran = folder.run(with_file(verb.arguments, file));
      CHECK(ran.code == 1);
      CHECK_MESSAGE(
          ran.err.find(".json:1:52: error: key 1 (time 1 s, value 1e+308) is too far from the key before it") !=
              std::string::npos,
          ran.err);
      CHECK(folder.names().empty());
    }
}

TEST_CASE("plots of steep curves are pictures") {
  const Folder folder;
  for (const char* name : {"plot_of_a_huge_slope", "plot_of_a_steep_color"}) {
    CAPTURE(name);
    for (const fs::path& file : fault_documents()) {
      if (file.stem() != name) continue;
      const Ran ran = folder.run("plot " + shell_word(file) + " -o out.svg");
      CHECK_MESSAGE(ran.code == 0, ran.err);
      CHECK(is_well_formed_svg(folder.read("out.svg")));
      CHECK(folder.read("out.svg").size() < 300'000);
    }
  }
}

TEST_CASE("eases of numbers without bound are refused by every verb, each with the range of its number") {
  const Folder folder;
  for (const fs::path& file : named("plot_of_eases_without_bound"))
    for (const Verb& verb : five) {
      CAPTURE(verb.arguments);
      const Ran ran = folder.run(with_file(verb.arguments, file));
      CHECK(ran.code == 1);
      CHECK_MESSAGE(ran.err.find("damping ratio must lie in 0 to 1e+06; it is 1e+300") != std::string::npos, ran.err);
      CHECK_MESSAGE(ran.err.find("the overshoot of back-in must lie in -1e+06 to 1e+06") != std::string::npos, ran.err);
      CHECK(folder.names().empty());
    }
}

TEST_CASE("keys so near each other that no number is the rate between them are refused where they stand") {
  const Folder folder;
  for (const char* name : {"plot_of_a_tiny_duration", "plot_of_a_short_clip"})
    for (const fs::path& file : fault_documents()) {
      if (file.stem() != name) continue;
      for (const Verb& verb : five) {
        CAPTURE(verb.arguments);
        const Ran ran = folder.run(with_file(verb.arguments, file));
        CHECK(ran.code == 1);
        CHECK_MESSAGE(ran.err.find(".json:1:") != std::string::npos, ran.err);
        CHECK_MESSAGE(ran.err.find("changes faster than a number can tell, within ") != std::string::npos, ran.err);
      }
    }
}

TEST_CASE("angles of which no digit is left below a turn are refused by every verb, each at its track") {
  const Folder folder;
  for (const fs::path& file : named("angles_too_large_to_tell"))
    for (const Verb& verb : five) {
      CAPTURE(verb.arguments);
      const Ran ran = folder.run(with_file(verb.arguments, file));
      CHECK(ran.code == 1);
      for (const char* place : {":2:20", ":3:21", ":4:21", ":5:22"})
        CHECK_MESSAGE(
            ran.err.find(place + std::string(": error: angles must stay within 1e15 rad")) != std::string::npos,
            ran.err);
    }
}

TEST_CASE("pictures are well-formed whatever names hold") {
  const Folder folder;
  for (const char* name : {"markup_in_names", "noncharacter_in_a_name"})
    for (const fs::path& file : named(name)) {
      CAPTURE(file.string());
      CHECK(folder.run("plot " + shell_word(file) + " -o plot.svg").code == 0);
      CHECK(folder.run("run " + shell_word(file) + " -o run.svg").code == 0);
      CHECK(is_well_formed_svg(folder.read("plot.svg")));
      CHECK(is_well_formed_svg(folder.read("run.svg")));
    }
}

TEST_CASE("names that would drive a terminal are spelled out in tables and messages") {
  const Folder folder;
  for (const fs::path& file : named("terminal_codes_in_names"))
    for (const char* verb : {"inspect ", "run --until 1 ", "sample --at 0.5 "}) {
      CAPTURE(verb);
      const Ran ran = folder.run(verb + shell_word(file));
      CHECK(is_tame(ran.out));
      CHECK(is_tame(ran.err));
      CHECK((ran.out + ran.err).find("\\u") != std::string::npos);
    }
}

TEST_CASE("what no page can hold is refused with the node, by check as well") {
  const Folder folder;
  for (const fs::path& file : named("beyond_float_in_the_page"))
    for (const char* verb : {"check ", "view --until 0.1 -o out.html ", "run --until 0.1 -o out.glb "}) {
      CAPTURE(verb);
      const Ran ran = folder.run(verb + shell_word(file));
      CHECK(ran.code == 1);
      CHECK_MESSAGE((ran.err.find("\"a\"") != std::string::npos || ran.err.find("\"far\"") != std::string::npos),
                    ran.err);
      CHECK(folder.names().empty());
    }
}

TEST_CASE("very long and very short clips take memory and time that can be had, and say what is left out") {
  const Folder folder;
  for (const fs::path& file : named("clip_without_end_in_sight")) {
    const Ran ran = folder.run("run -o out.json " + shell_word(file));
    CHECK_MESSAGE(ran.code == 0, ran.err);
    CHECK(ran.err.find("plays until 1e+300 s, of which the first 4 s are shown") != std::string::npos);
  }
  for (const fs::path& file : named("loop_of_a_nanosecond"))
    for (const Verb& verb : five) {
      CAPTURE(verb.arguments);
      const Ran ran = folder.run(with_file(verb.arguments, file));
      CHECK(ran.code == 1);
      CHECK(ran.err.find(".json:1:45: error: clip \"buzz\" goes around every 1e-09 s and has more than 20000 events") !=
            std::string::npos);
    }
}

TEST_CASE("names that are not UTF-8 are taken for Latin-1, and every file of them is one that others read") {
  const Folder folder;
  const std::string joint = "h\xe9p\xe9";
  folder.write("old.bvh",
               "HIERARCHY\nROOT " + joint +
                   "\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n"
                   "MOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0\n1 0 0\n");
  folder.write("old.obj", "o caf\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(folder.run("inspect old.bvh").out.find("h\xc3\xa9p\xc3\xa9") != std::string::npos);
  for (const std::string model : {"old.bvh", "old.obj"}) {
    CAPTURE(model);
    CHECK(folder.run("run " + model + " --until 0.1 -o run.json").code == 0);
    CHECK(nlohmann::json::accept(folder.read("run.json")));
    CHECK(folder.run("run " + model + " --until 0.1 -o run.svg").code == 0);
    CHECK(is_well_formed_svg(folder.read("run.svg")));
  }
  CHECK(folder.run("import old.bvh -o old.json").code == 0);
  CHECK(folder.run("check old.json").code == 0);
}
