#include "importers/document/document_files.h"
#include "processor_time.h"

#include <cmath>
#include <functional>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::vector<Problem> problems_in(const std::string& text) {
  try {
    (void)Document::parse(text, "text.json", {});
  } catch (const DocumentError& error) {
    return error.problems();
  }
  return {};
}

double seconds_for(const std::string& text) {
  const double from = test::processor_seconds();
  (void)problems_in(text);
  return test::processor_seconds() - from;
}

}  // namespace

TEST_CASE("names and texts with escapes are those without") {
  const Document document = Document::parse(
      R"({"tweenf\u0061ll": 1, "name": "\ud83d\ude00 \"a\"\/\n\u0000", "nodes": {"b\u0061ll": {"group": "\u0067"}}})",
      "a", {});
  CHECK(document.stage().name == std::string("\xf0\x9f\x98\x80 \"a\"/\n\0", 11));
  CHECK(document.stage().nodes.front().name == "ball");
  CHECK(document.stage().nodes.front().group == "g");
  const std::vector<Problem> twice = problems_in(R"({"tweenfall": 1, "nodes": {"b\u0061ll": {}, "ball": {}}})");
  REQUIRE(twice.size() == 1);
  CHECK(twice.front().column == 45);
  CHECK(twice.front().message == "\"ball\" is given twice in one object; keep one of them");
}

TEST_CASE("of names given twice among very many each is told") {
  std::string text = "{\"tweenfall\": 1, \"nodes\": {";
  for (int i = 0; i < 5000; ++i) text += "\"n" + std::to_string(i % 4990) + "\": {}, ";
  const std::vector<Problem> problems = problems_in(text + "\"last\": {}}}");
  REQUIRE(problems.size() == 10);
  CHECK(problems.front().message == "\"n0\" is given twice in one object; keep one of them");
}

TEST_CASE("numbers are read to the bit, with the sign of 0 and the smallest there is") {
  const Document document =
      Document::parse(R"({"tweenfall": 1, "nodes": {"a": {"position": [-0, 5e-324, 1e-400]}, "b": {"position":
      [-0.0, 9007199254740993, -123456789012345678901234567890]}, "c": {"position": [1E2, 0.1, 0]}},
      "clips": {"k": {"tracks": {"c.x": [[0, 1.7976931348623157e308]]}}}})",
                      "a", {});
  const auto& nodes = document.stage().nodes;
  CHECK(std::signbit(nodes[0].rest.position.x()));
  CHECK(nodes[0].rest.position.y() == 5e-324);
  CHECK(nodes[0].rest.position.z() == 0);
  CHECK(std::signbit(nodes[1].rest.position.x()));
  CHECK(nodes[1].rest.position.y() == 9007199254740992);
  CHECK(nodes[1].rest.position.z() == -123456789012345678901234567890.0);
  CHECK(nodes[2].rest.position.x() == 100);
  const TrackCurve& curve = document.stage().clips.front().tracks.front().curve;
  CHECK(std::get<Curve<double>>(curve).value(0) == 1.7976931348623157e308);
}

TEST_CASE("a comment ends where any line does, and at a zero byte, which is no text") {
  for (const char* end : {"\n", "\r", "\r\n"})
    CHECK(problems_in("{ // \"x\": 2," + std::string(end) + "\"tweenfall\": 1}").empty());
  const std::string zero = std::string("{ //\"}\x1f\0\"body\"\0\0", 17);
  CHECK_FALSE(problems_in(zero).empty());
}

TEST_CASE("comments stand anywhere between values and hide nothing") {
  const Document document = Document::parse(
      "// [{\"',\n/* , */{/**/\"tweenfall\"/*:*/:// 2\n1/*,*/,\"name\" : /*\"b\"*/ \"a//b/*c*/\" //\n}//", "a", {});
  CHECK(document.stage().name == "a//b/*c*/");
  const std::vector<Problem> problems = problems_in("{\"tweenfall\": 1, /*:*/ \"fps\" /* : */ : /* 1 */ -1}");
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().column == 48);
}

TEST_CASE("brackets are nested two hundred deep and no deeper") {
  const auto nested = [](int depth) {
    return "{\"tweenfall\": 1, \"x-deep\": " + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  CHECK(problems_in(nested(199)).empty());
  for (const int depth : {200, 100000}) {
    const std::vector<Problem> problems = problems_in(nested(depth));
    REQUIRE(problems.size() == 1);
    CHECK(problems.front().message == "nested more than 200 deep; no document needs that");
    CHECK(problems.front().column == 227);
  }
}

TEST_CASE("of very many problems the first are listed and the others counted, in time that does not grow faster") {
  // Each on one line, as programs write them.
  const auto tracks = [](int count) {
    std::string text = "{\"tweenfall\": 1, \"nodes\": {\"a\": {}";
    for (int i = 0; i < count; ++i) text += ", \"node " + std::to_string(i) + "\": {}";
    text += "}, \"clips\": {\"c\": {\"tracks\": {\"a.x\": [[0, 1]]";
    for (int i = 0; i < count; ++i) text += ", \"mode " + std::to_string(i) + ".position\": [[0, [1, 2, 3]]]";
    return text + "}}}}";
  };
  const auto parents = [](int count) {
    std::string text = "{\"tweenfall\": 1, \"nodes\": {\"a\": {}";
    for (int i = 0; i < count; ++i)
      text += ", \"node " + std::to_string(i) + "\": {\"parent\": \"mode " + std::to_string(i) + "\"}";
    return text + "}}";
  };
  const auto fields = [](int count) {
    std::string text = "{\"tweenfall\": 1, \"nodes\": {\"a\": {}";
    for (int i = 0; i < count; ++i) text += ", \"node " + std::to_string(i) + "\": {\"oops\": [1, 2, 3]}";
    return text + "}}";
  };
  for (const auto& make : {std::function(tracks), std::function(parents), std::function(fields)}) {
    const std::vector<Problem> problems = problems_in(make(8000));
    REQUIRE(problems.size() > 100);
    CHECK(problems.size() < 1000);
    CHECK(problems.back().message.find(" more problems are not listed") != std::string::npos);
    // Generous, for machines that do other things too; it took 7 s and 32 s.
    CHECK(seconds_for(make(8000)) < 2.5);
    CHECK(seconds_for(make(64000)) < 10);
  }
}

TEST_CASE("text in UTF-16 is told to be that, with a mark or without, either end first") {
  using namespace std::string_literals;
  for (const std::string& text : {"\xff\xfe{\0}\0"s, "\xfe\xff\0{\0}"s, "{\0}\0"s, "\0{\0}"s}) {
    const std::vector<Problem> problems = problems_in(text);
    REQUIRE(problems.size() == 1);
    CHECK(problems.front().message == "this text is UTF-16; save it as UTF-8");
  }
}

TEST_CASE("of a number too long to be shown it is told that there is more of it") {
  const std::vector<Problem> problems = problems_in("{\"tweenfall\": 1, \"x-a\": 1" + std::string(400, '0') + "}");
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().message ==
        "1" + std::string(39, '0') + "... is too large for a number; the largest is about 1.8e308");
}
