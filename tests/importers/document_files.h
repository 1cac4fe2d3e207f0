#pragma once

// The corpus of documents below tests/data/documents: good ones load, bad ones say what is pinned beside them.

#include "support.h"

#include <tweenfall/importers/document.h>

#include <iterator>

namespace tweenfall::test {

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  REQUIRE_MESSAGE(stream.good(), "cannot read " << file.string());
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline std::vector<std::filesystem::path> documents_in(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "documents" / folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  REQUIRE_MESSAGE(!files.empty(), "no documents in " << folder);
  return files;
}

inline Document parsed(const std::string& text) {
  return Document::parse(text, "test.json", data_folder() / "documents/good");
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
