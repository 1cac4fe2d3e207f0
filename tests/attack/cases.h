#pragma once

// The documents from which cases are made.

#include "attack/attack.h"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace tweenfall::attack {

/// The documents below the project's FOLDERS that are short enough, in a fixed order.
[[nodiscard]] std::vector<std::filesystem::path> documents_in(std::initializer_list<const char*> folders);

/// A document to be attacked, and the folder that its imports are relative to.
struct ChangedDocument {
  std::string text;
  std::filesystem::path folder;
};

/// Documents of the samples, the tests and ../shared, changed by structure and by byte.
class ChangedDocuments {
 public:
  /// @param part  if given, only documents with this member are taken, and only it is changed, by structure
  explicit ChangedDocuments(std::uint64_t seed, std::string part = {});
  [[nodiscard]] ChangedDocument make(std::uint64_t number) const;

 private:
  std::uint64_t seed_;
  std::string part_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace tweenfall::attack
