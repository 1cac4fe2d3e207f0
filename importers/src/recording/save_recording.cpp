#include <tweenfall/importers/recording_file.h>

#include <tweenfall/importers/whole_file.h>

#include "recording/recording_model.h"

#include <algorithm>
#include <stdexcept>

namespace tweenfall {

void save_recording(const Recording& recording, const StageDescription& stage, const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (ending == ".json") return write_whole_file(file, recording_json(recording));
  if (ending == ".csv") return write_whole_file(file, recording_csv(recording));
  if (ending == ".svg") return write_whole_file(file, recording_svg(recording, stage));
  if (ending == ".html") return write_whole_file(file, recording_html(recording, stage));
  if (ending == ".glb") return save_glb(recordings::recording_model(recording, stage), file);
  throw std::invalid_argument("cannot tell from \"" + file.filename().string() +
                              "\" what to write; the name must end in .json, .csv, .svg, .html or .glb");
}

}  // namespace tweenfall
