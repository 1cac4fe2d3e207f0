// A kind of ease is named in the file of its kind and nowhere else.

#include "support.h"

#include <tweenfall/curves/ease.h>

#include <map>
#include <set>

using namespace tweenfall;

namespace {

// Words that mean something else too: splines, rules beyond the keys, a key's member, the ease of a key without one,
// the degree of a polynomial, what others call restitution.
const std::set<std::string> shared_words = {
    "hold",        "linear",     "ease",   "natural",        "clamped", "uniform", "centripetal", "chordal",
    "catmull-rom", "not-a-knot", "smooth", "smooth-clamped", "spring",  "bezier",  "cubic",       "bounce"};

// The words as they occur in a source: a family's without the directions, a call's without its numbers.
std::set<std::string> source_words() {
  std::set<std::string> words;
  for (const std::string& form : Ease::names()) {
    std::string word = form.substr(0, form.find('('));
    if (!word.starts_with("ease"))
      for (const std::string direction : {"-in-out", "-in", "-out"})
        if (word.ends_with(direction)) {
          word.resize(word.size() - direction.size());
          break;
        }
    if (!shared_words.contains(word)) words.insert(word);
  }
  return words;
}

}  // namespace

TEST_CASE("each kind of ease is named in one file of the libraries") {
  std::map<std::string, std::vector<std::string>> files_of;
  const std::filesystem::path root = TWEENFALL_SOURCE_DIR;
  const std::set<std::string> words = source_words();
  REQUIRE(words.size() > 25);
  for (const char* module : {"curves", "anim", "physics", "importers"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / module / "src")) {
      const std::string extension = entry.path().extension().string();
      // The names of eases in other programs are a table of their own.
      if ((extension != ".cpp" && extension != ".h") || entry.path().filename() == "foreign_words.cpp") continue;
      const std::string text = test::text_of(entry.path());
      for (const std::string& word : words)
        if (test::count(text, "\"" + word + "\"") > 0) files_of[word].push_back(entry.path().string());
    }
  for (const std::string& word : words) {
    CAPTURE(word);
    CHECK(files_of[word].size() == 1);
  }
}
