#pragma once

#include "physics/scene_file.h"
#include "support.h"

namespace tweenfall::test {

/// The scenes whose names begin so, from tests/data and the scenes folder; if that is missing, it is said loudly.
inline std::vector<Scene> scenes(const std::string& beginning) {
  std::vector<std::filesystem::path> found;
  for (const auto& folder : {data_folder() / "scenes", scenes_folder()}) {
    if (!std::filesystem::is_directory(folder)) {
      MESSAGE("SKIPPED: scenes " << beginning << "..., no folder " << folder.string());
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".json" && entry.path().filename().string().rfind(beginning, 0) == 0)
        found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  CHECK_MESSAGE(!found.empty(), "no scene " << beginning << "... anywhere");
  std::vector<Scene> result;
  result.reserve(found.size());
  for (const auto& path : found) {
    result.push_back(scene_from(read_json(path)));
    for (const std::string& type : result.back().left_out)
      MESSAGE("SKIPPED: bodies of scene " << path.string() << " with shape " << type);
  }
  return result;
}

}  // namespace tweenfall::test
