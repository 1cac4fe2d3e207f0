#include "attack/cases.h"

#include "attack/mutation.h"

#include <algorithm>

namespace tweenfall::attack {

std::vector<std::filesystem::path> documents_in(std::initializer_list<const char*> folders) {
  const std::filesystem::path source = TWEENFALL_SOURCE_DIR;
  std::vector<std::filesystem::path> files;
  for (const char* folder : folders) {
    if (!std::filesystem::exists(source / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder))
      if (entry.path().extension() == ".json" && entry.file_size() < 40'000) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

ChangedDocuments::ChangedDocuments(std::uint64_t seed, std::string part)
    : seed_(seed),
      part_(std::move(part)),
      files_(documents_in({"samples/documents", "tests/data/documents/good", "../shared/faults"})) {
  if (part_.empty()) return;
  std::erase_if(files_, [&](const auto& file) { return bytes_of(file).find('"' + part_ + '"') == std::string::npos; });
}

ChangedDocument ChangedDocuments::make(std::uint64_t number) const {
  Random random = random_of(seed_, number);
  const std::filesystem::path& file = files_[below(random, files_.size())];
  std::string text = bytes_of(file);
  if (!part_.empty() || below(random, 4) != 0) {
    nlohmann::ordered_json document = nlohmann::ordered_json::parse(text, nullptr, false, true);
    if (!document.is_discarded()) {
      mutate_structure(random, part_.empty() ? document : document[part_]);
      return {document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), file.parent_path()};
    }
  }
  mutate_bytes(random, text);
  return {text, file.parent_path()};
}

}  // namespace tweenfall::attack
