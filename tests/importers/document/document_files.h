#pragma once

// The corpus of documents below tests/data/documents: good ones load, bad ones say what is pinned beside them.

#include "support.h"

#include <tweenfall/importers/document.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace tweenfall::test {

inline std::vector<std::filesystem::path> documents_in(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "documents" / folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  REQUIRE_MESSAGE(!files.empty(), "no documents in " << folder);
  return files;
}

/// The document NAME of the good ones.
inline Document good_document(const std::string& name) {
  return Document::read(data_folder() / "documents/good" / (name + ".json"));
}

inline const Track& track_of(const Clip& clip, const std::string& name) {
  for (const Track& each : clip.tracks)
    if (each.name() == name) return each;
  FAIL("no track " << name);
  return clip.tracks.front();
}

template <class T>
const Curve<T>& curve_of(const Clip& clip, const std::string& name) {
  return std::get<Curve<T>>(track_of(clip, name).curve);
}

inline Document parsed(const std::string& text) {
  return Document::parse(text, "test.json", data_folder() / "documents/good");
}

inline constexpr double degree = pi / 180;

inline double turn_about_z(const Quat& q) {
  return 2 * std::atan2(q.z(), q.w());
}

/// The clip of a document of one track.
inline Clip clip_of(const std::string& name, const std::string& track) {
  const std::string text = "{\"tweenfall\": 1, \"clips\": {\"only\": {\"tracks\": {\"" + name + "\": " + track + "}}}}";
  return Document::parse(text, "clip.json", {}).stage().clips.at(0);
}

template <class T>
Curve<T> curve_of(const std::string& name, const std::string& track) {
  return std::get<Curve<T>>(clip_of(name, track).tracks.at(0).curve);
}

/// All problems of a text that must not load, as printed.
inline std::string faults_of(const std::string& text, const std::string& name, const std::filesystem::path& folder) {
  try {
    (void)Document::parse(text, name, folder);
  } catch (const DocumentError& error) {
    REQUIRE(!error.problems().empty());
    std::string out = error.what();
    // Problems of imported files name them with their folder.
    if (folder.empty()) return out + "\n";
    const std::string prefix = folder.generic_string() + "/";
    for (std::size_t at; (at = out.find(prefix)) != std::string::npos;) out.erase(at, prefix.size());
    return out + "\n";
  }
  return "";
}

}  // namespace tweenfall::test
