#include "importers/document/document_files.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("every bad document says exactly what is pinned beside it") {
  for (const char* folder : {"bad/syntax", "bad/shape", "bad/meaning"}) {
    for (const std::filesystem::path& file : documents_in(folder)) {
      CAPTURE(file.string());
      const std::string said = faults_of(text_of(file), file.filename().string(), file.parent_path());
      CHECK_MESSAGE(!said.empty(), "this document loads");
      std::filesystem::path pin = file;
      pin.replace_extension(".txt");
      // Set once by hand when a message is changed on purpose; the change is then visible in the diff.
      if (const char* write = std::getenv("TWEENFALL_WRITE_PINS"); write && *write) {
        std::ofstream(pin, std::ios::binary) << said;
        continue;
      }
      CHECK(said == text_of(pin));
    }
  }
}

TEST_CASE("a key out of order is told as the design shows it") {
  const std::string text =
      "{\n  \"tweenfall\": 1,\n  \"clips\": {\"drop\": {\"tracks\": {\"ball.position\": [\n"
      "    {\"t\": 0, \"v\": [0, 3, 0]},\n    {\"t\": 0.8, \"v\": [0, 0, 0]},\n"
      "    {\"t\": 0.5, \"v\": [0, 3, 0]}\n  ]}}}\n}\n";
  CHECK(faults_of(text, "drop.json", {}) ==
        "drop.json:6:11: error: key times must increase; 0.5 s is not after the key before it, 0.8 s (at "
        "/clips/drop/tracks/ball.position/2/t)\n 6 |     {\"t\": 0.5, \"v\": [0, 3, 0]}\n   |           ^\n");
}

TEST_CASE("columns count characters, and the caret stands below tabs and letters of any length") {
  const std::string said =
      faults_of("{\"tweenfall\": 1,\n\t\"name\": \"\xc3\xa4\xe2\x82\xac\", \"fps\": 0}", "wide.json", {});
  CHECK(said ==
        "wide.json:2:23: error: expected frames per second above 0, found 0 (at /fps)\n 2 | \t\"name\": "
        "\"\xc3\xa4\xe2\x82\xac\", \"fps\": 0}\n   | \t                     ^\n");
}

TEST_CASE("a very long line is shown around the place, and the caret stands there") {
  const std::string text = "{\"tweenfall\": 1, \"name\": \"" + std::string(100000, 'a') + "\", \"fps\": 0}";
  try {
    (void)Document::parse(text, "long.json", {});
    FAIL("loads");
  } catch (const DocumentError& error) {
    const Problem& problem = error.problems().front();
    CHECK(problem.column == text.find("0}") + 1);
    CHECK(problem.excerpt.size() < 400);
    const std::string said = problem.text();
    const std::size_t caret_line = said.rfind('\n') + 1, line = said.rfind('\n', caret_line - 2) + 1;
    const std::size_t caret = said.find('^', caret_line) - caret_line;
    CHECK(said.substr(line + caret, 2) == "0}");
  }
}

TEST_CASE("hostile texts are refused, quickly and without a crash") {
  const auto refused = [](const std::string& text) {
    CHECK_THROWS_AS((void)Document::parse(text, "hostile.json", {}), DocumentError);
  };
  refused(std::string(1000000, '['));
  std::string nested;
  for (int i = 0; i < 300000; ++i) nested += "{\"a\":";
  refused(nested);
  refused(std::string("\0\x01\xff\xfe", 4));
  refused("{\"tweenfall\": 1, \"name\": \"\xff\"}");
  refused("{\"tweenfall\": 1, \"name\": \"\xed\xa0\x80\"}");
  std::string wide = "{\"tweenfall\": 1, \"nodes\": {";
  for (int i = 0; i < 20000; ++i) wide += (i ? ", \"n" : "\"n") + std::to_string(i) + "\": {\"oops\": 1}";
  refused(wide + "}}");
}

TEST_CASE("a good document cut anywhere, or with a byte changed, loads or is refused but never crashes") {
  Random random(7);
  int refused = 0;
  for (const std::filesystem::path& file : documents_in("good")) {
    const std::string text = text_of(file);
    for (int round = 0; round < 150; ++round) {
      std::string changed = text;
      const std::size_t at = random.bits() % text.size();
      if (round % 3 == 0)
        changed.resize(at);
      else
        changed[at] = round % 3 == 1 ? static_cast<char>(random.bits()) : "{}[]\",:0-x"[random.bits() % 10];
      try {
        (void)Document::parse(changed, "changed.json", file.parent_path());
      } catch (const DocumentError&) {
        ++refused;
      }
    }
  }
  CHECK(refused > 100);
}

TEST_CASE("a file that is not there is told by its name") {
  try {
    (void)Document::read("no/such.json");
    FAIL("loads");
  } catch (const DocumentError& error) {
    CHECK(std::string(error.what()).find("no/such.json") == 0);
  }
}

TEST_CASE("an import may leave the folder when the caller allows it") {
  const std::filesystem::path folder = data_folder() / "documents/good/parts";
  const std::string text = R"({"tweenfall": 1, "import": {"least": "../least.json"}})";
  CHECK(faults_of(text, "outside.json", folder).find("outside the document's folder") != std::string::npos);
  CHECK_NOTHROW((void)Document::parse(text, "outside.json", folder, {.allow_outside = true}));
}
