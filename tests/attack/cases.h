#pragma once

// The documents that cases are made of.

#include "attack/attack.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tweenfall::attack {

/// A document to be attacked, and the folder that its imports are relative to.
struct ChangedDocument {
  std::string text;
  std::filesystem::path folder;
};

/// Documents of the samples, the tests and ../shared, changed by structure and by byte.
class ChangedDocuments {
 public:
  /// @param part  where given, only documents that have this member are taken, and only it is changed, by structure
  explicit ChangedDocuments(std::uint64_t seed, std::string part = {});
  [[nodiscard]] ChangedDocument make(std::uint64_t number) const;

 private:
  std::uint64_t seed_;
  std::string part_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace tweenfall::attack
