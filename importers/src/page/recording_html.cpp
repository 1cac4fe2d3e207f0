#include <tweenfall/importers/recording_file.h>
#include <tweenfall/importers/shown_text.h>

#include <functional>
#include <stdexcept>

#include "json/json_string.h"
#include "page/content/page_data.h"
#include "page/content/page_frames.h"
#include "page/page_files.h"
#include "recording/meshes/dressed.h"

namespace tweenfall {

namespace page {
namespace {

/// Replaces each {{PART}} of a frame by its text.
std::string filled(const std::string& frame, const std::function<std::string(const std::string&)>& text_of) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t open; (open = frame.find("{{", at)) != std::string::npos;) {
    const std::size_t close = frame.find("}}", open);
    out.append(frame, at, open - at);
    out += text_of(frame.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  out.append(frame, at, std::string::npos);
  return out;
}

std::string three_js() {
  std::string three = part("three.js");
  if (three.empty())
    throw std::runtime_error(
        "cannot make a page: this build has no three.js inside. Install Debian's package libjs-three, configure again "
        "with -U TWEENFALL_THREE, and build");
  return three;
}

void require_frames(const Recording& recording) {
  check_recording(recording);
  if (recording.times.empty())
    throw std::invalid_argument("recording \"" + recording.name + "\" has no frames to show");
}

std::string title_of(const Recording& recording, const StageDescription& stage) {
  const std::string name = recording.name.empty() ? stage.name : recording.name;
  return markup_text(name.empty() ? "recording" : name);
}

/// The page data, with soft bodies and wheels as meshes.
std::string data_of(const Recording& recording, const StageDescription& stage) {
  const auto dressed = recordings::with_own_meshes(recording, stage);
  return dressed ? page_data(dressed->recording, dressed->stage) : page_data(recording, stage);
}

/// A page in two parts: its own part, and the one in common with all others.
struct Halves {
  std::string own, common;
};

Halves halves_of(const Recording& recording, const StageDescription& stage) {
  const std::string frame = part("page.html"), mark = "{{data}}";
  const std::size_t cut = frame.find(mark) + mark.size();
  const auto text_of = [&](const std::string& name) {
    return name == "title"      ? title_of(recording, stage)
           : name == "data"     ? data_of(recording, stage)
           : name == "three.js" ? three_js()
                                : part(name);
  };
  return {filled(frame.substr(0, cut), text_of), filled(frame.substr(cut), text_of)};
}

/// A text for use inside a script as data: nothing in it can end the script.
std::string quoted(const std::string& text) {
  std::string plain, out;
  json::append_string(plain, text);
  out.reserve(plain.size());
  for (const char c : plain)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

}  // namespace
}  // namespace page

std::string recording_html(const Recording& recording, const StageDescription& stage) {
  page::require_frames(recording);
  static_cast<void>(page::three_js());
  page::Halves halves = page::halves_of(recording, stage);
  return std::move(halves.own) + halves.common;
}

std::string side_by_side_html(const ShownRecording& left, const ShownRecording& right) {
  for (const ShownRecording* shown : {&left, &right}) page::require_frames(shown->recording);
  static_cast<void>(page::three_js());
  const page::Halves first = page::halves_of(left.recording, left.stage),
                     second = page::halves_of(right.recording, right.stage);
  const std::string left_title = page::title_of(left.recording, left.stage),
                    right_title = page::title_of(right.recording, right.stage);
  return page::filled(page::part("beside.html"), [&](const std::string& name) {
    return name == "title"   ? left_title + " | " + right_title
           : name == "left"  ? left_title
           : name == "right" ? right_title
           : name == "pages" ? "{\"before\":[" + page::quoted(first.own) + "," + page::quoted(second.own) +
                                   "],\"after\":" + page::quoted(first.common) + "}"
                             : page::part(name);
  });
}

std::size_t page_frame_count(const Recording& recording) {
  return page::page_frames(recording).size();
}

}  // namespace tweenfall
