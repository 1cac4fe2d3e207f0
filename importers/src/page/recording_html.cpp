#include <tweenfall/importers/recording_file.h>
#include <tweenfall/importers/shown_text.h>

#include "page/page_data.h"
#include "page/page_files.h"
#include "page/page_frames.h"
#include "recording/soft_meshes.h"

#include <stdexcept>

namespace tweenfall {

std::string recording_html(const Recording& recording, const StageDescription& stage) {
  check_recording(recording);
  if (recording.times.empty())
    throw std::invalid_argument("recording \"" + recording.name + "\" has no frames to show");
  const std::string three = page::part("three.js");
  if (three.empty())
    throw std::runtime_error(
        "cannot make a page: this build has no three.js inside. Install Debian's package libjs-three, configure again "
        "with -U TWEENFALL_THREE, and build");

  const std::string name = recording.name.empty() ? stage.name : recording.name;
  const std::string frame = page::part("page.html");
  std::string out;
  std::size_t at = 0;
  // Each {{PART}} of the frame gives way to its text.
  for (std::size_t open; (open = frame.find("{{", at)) != std::string::npos;) {
    const std::size_t close = frame.find("}}", open);
    out.append(frame, at, open - at);
    const std::string part = frame.substr(open + 2, close - open - 2);
    if (part == "title") {
      out += markup_text(name.empty() ? "recording" : name);
    } else if (part == "data") {
      const auto dressed = recordings::with_soft_meshes(recording, stage);
      out += dressed ? page::page_data(dressed->recording, dressed->stage) : page::page_data(recording, stage);
    } else if (part == "three.js") {
      out += three;
    } else {
      out += page::part(part);
    }
    at = close + 2;
  }
  out.append(frame, at, std::string::npos);
  return out;
}

std::size_t page_frame_count(const Recording& recording) {
  return page::page_frames(recording).size();
}

}  // namespace tweenfall
