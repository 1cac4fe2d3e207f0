#include "support.h"

#include <cstdlib>
#include <iterator>

template class nlohmann::basic_json<>;

namespace tweenfall::test {

namespace {

std::filesystem::path folder(const char* variable, const char* fallback) {
  const char* given = std::getenv(variable);
  return given && *given ? std::filesystem::path(given) : std::filesystem::path(TWEENFALL_SOURCE_DIR) / fallback;
}

}  // namespace

std::filesystem::path vectors_folder() {
  return folder("TWEENFALL_VECTORS", "../shared/vectors");
}

std::filesystem::path models_folder() {
  return folder("TWEENFALL_MODELS", "../shared/models");
}

std::filesystem::path scenes_folder() {
  return folder("TWEENFALL_SCENES", "../shared/scenes");
}

std::filesystem::path data_folder() {
  return std::filesystem::path(TWEENFALL_SOURCE_DIR) / "tests/data";
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  REQUIRE_MESSAGE(stream.good(), "cannot read " << file.string());
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

nlohmann::json read_json(const std::filesystem::path& file) {
  return nlohmann::json::parse(text_of(file));
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

std::vector<nlohmann::json> vector_family(const std::string& name) {
  std::vector<nlohmann::json> files;
  for (const auto& place : {data_folder() / "vectors", vectors_folder()}) {
    if (!std::filesystem::is_directory(place)) {
      MESSAGE("SKIPPED: vectors of family " << name << ", no folder " << place.string());
      continue;
    }
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(place))
      if (entry.path().extension() == ".json") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    for (const auto& path : found) {
      auto content = read_json(path);
      if (content.is_object() && content.value("family", "") == name) files.push_back(std::move(content));
    }
  }
  CHECK_MESSAGE(!files.empty(), "no file of vector family " << name << " anywhere");
  return files;
}

Vec3 vec(const nlohmann::json& list) {
  REQUIRE(list.size() == 3);
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

Quat quat(const nlohmann::json& list, std::size_t at) {
  REQUIRE(list.size() >= at + 4);
  return Quat(list[at + 3].get<double>(), list[at].get<double>(), list[at + 1].get<double>(),
              list[at + 2].get<double>());
}

}  // namespace tweenfall::test
