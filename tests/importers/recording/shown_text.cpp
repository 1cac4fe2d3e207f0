// Names that others wrote, where they are shown.

#include "page/example_stage.h"
#include "support.h"

#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/importers/shown_text.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Names that break code that does not expect them.
const std::vector<std::string> hostile_names{"]]>",
                                             "</script><script>",
                                             "a & b < c > d \" e ' f",
                                             "tab\t line\n return\r",
                                             std::string("zero\0byte", 9),
                                             "\x1b[31mred\x1b]0;title\x07",
                                             "c1 \xc2\x9b"
                                             "2J",
                                             "latin \xe9t\xe9",
                                             "cut \xe2\x82",
                                             "long \xc0\xaf",
                                             "surrogate \xed\xa0\x80",
                                             "past the end \xf4\x90\x80\x80",
                                             "\xef\xbf\xbe noncharacter \xef\xbf\xbf",
                                             "right to left \xe2\x80\xae"
                                             "gpj.exe",
                                             "isolate \xe2\x81\xa6",
                                             "zero\xe2\x80\x8bwidth",
                                             "mark \xef\xbb\xbf",
                                             "plain \xc3\xa9 \xe2\x82\xac \xf0\x9f\x99\x82"};

/// Whether every character is one that XML 1.0 allows (production 2) and no markup is left that was not written by us.
bool is_xml_text(std::string_view text) {
  while (!text.empty()) {
    const Character next = first_character(text);
    const char32_t c = next.code;
    const bool is_char = c == 9 || c == 10 || c == 13 || (c >= 0x20 && c <= 0xd7ff) || (c >= 0xe000 && c <= 0xfffd) ||
                         (c >= 0x10000 && c <= 0x10ffff);
    if (!next.is_valid || !is_char) return false;
    text.remove_prefix(next.length);
  }
  return true;
}

}  // namespace

TEST_CASE("bytes are read as RFC 3629 has it") {
  struct Case {
    std::string_view bytes;
    char32_t code;
    bool valid;
  };
  for (const Case& c : {Case{"A", 'A', true},
                        {"\x7f", 0x7f, true},
                        {"\xc2\x80", 0x80, true},
                        {"\xdf\xbf", 0x7ff, true},
                        {"\xe0\xa0\x80", 0x800, true},
                        {"\xed\x9f\xbf", 0xd7ff, true},
                        {"\xee\x80\x80", 0xe000, true},
                        {"\xef\xbf\xbf", 0xffff, true},
                        {"\xf0\x90\x80\x80", 0x10000, true},
                        {"\xf4\x8f\xbf\xbf", 0x10ffff, true},
                        {"\x80", 0xfffd, false},
                        {"\xc1\xbf", 0xfffd, false},
                        {"\xe0\x9f\xbf", 0xfffd, false},
                        {"\xed\xa0\x80", 0xfffd, false},
                        {"\xf0\x8f\xbf\xbf", 0xfffd, false},
                        {"\xf4\x90\x80\x80", 0xfffd, false},
                        {"\xff", 0xfffd, false},
                        {"\xe2\x82", 0xfffd, false}}) {
    CAPTURE(static_cast<unsigned>(c.code));
    const Character read = first_character(c.bytes);
    CHECK(read.code == c.code);
    CHECK(read.is_valid == c.valid);
    CHECK(read.length == (c.valid ? c.bytes.size() : 1));
  }
}

TEST_CASE(
    "a terminal is shown nothing that it would obey, and what is left reads in the order in which it was written") {
  CHECK(terminal_text("\x1b[31mred") == "\\u001b[31mred");
  CHECK(terminal_text("a\xe2\x80\xae"
                      "b\xe2\x81\xa9\xf3\xa0\x81\x81") == "a\\u202eb\\u2069\\u{e0041}");
  CHECK(terminal_text("caf\xe9 \xc3\xa9 \xf0\x9f\x99\x82") == "caf\\xe9 \xc3\xa9 \xf0\x9f\x99\x82");
  CHECK(terminal_text("a\nb") == "a\\u000ab");
  CHECK(terminal_lines("a\nb\r") == "a\nb\\u000d");
  for (const std::string& name : hostile_names) {
    std::string text = terminal_text(name);
    for (std::string_view rest = text; !rest.empty();) {
      const Character next = first_character(rest);
      CHECK(next.is_valid);
      CHECK((next.code >= 0x20 && (next.code < 0x7f || next.code >= 0xa0)));
      CHECK(!(next.code >= 0x200b && next.code <= 0x200f));
      CHECK(!(next.code >= 0x2028 && next.code <= 0x202e));
      CHECK(!(next.code >= 0x2060 && next.code <= 0x206f));
      rest.remove_prefix(next.length);
    }
  }
}

TEST_CASE("pictures, pages and files stay well-formed whatever things are called") {
  StageDescription stage = example_stage();
  Recording recording = example_recording();
  for (const std::string& name : hostile_names) {
    CAPTURE(name);
    stage.name = recording.name = name;
    stage.clips[0].name = name;
    recording.nodes[0].name = name;
    for (StageEvent& event : recording.events) event.name = name;
    const std::string picture = recording_svg(recording, stage), plot = plot_svg(stage, &recording);
    for (const std::string& svg : {picture, plot}) {
      CHECK(is_xml_text(svg));
      CHECK(svg.find("]]>") == std::string::npos);
      CHECK(svg.find("<script") == std::string::npos);
    }
    // The reader refuses text that is not UTF-8.
    CHECK(nlohmann::json::accept(recording_json(recording)));
    const std::string table = recording_csv(recording), page = recording_html(recording, stage);
    CHECK(utf8_text(table) == table);
    CHECK(std::none_of(table.begin(), table.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 9 || c == 0x1b; }));
    CHECK(utf8_text(page) == page);
    CHECK(count(page, "</script") == count(recording_html(example_recording(), example_stage()), "</script"));
  }
}

TEST_CASE(
    "numbers beyond floats are refused by glTF, with the node; pages open and leave the node out, other files hold "
    "them") {
  Recording recording = example_recording();
  recording.nodes[1].world[2].motion.pose.position.x() = -1e39;
  const std::string says = [&] {
    try {
      check_drawable(recording, example_stage());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  }();
  CHECK(says.find("\"" + recording.nodes[1].name + "\" is 1e+39 m from the origin") != std::string::npos);
  CHECK_NOTHROW(static_cast<void>(recording_html(recording, example_stage())));
  CHECK_THROWS_AS(save_recording(recording, example_stage(), "never.glb"), std::invalid_argument);
  CHECK(!std::filesystem::exists("never.glb"));
  CHECK(recording_json(recording).find("-1e+39") != std::string::npos);
  recording.nodes[1].world[2].motion.pose.position.x() = 3.4e38;
  CHECK_NOTHROW(check_drawable(recording, example_stage()));
}
