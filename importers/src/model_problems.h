#pragma once

// What is wrong with a model file, gathered so that one reading reports everything.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tweenfall {

class ModelProblems {
 public:
  /// A fault for which the file cannot be loaded. @param place  where in the file, or empty
  void add(const std::string& place, const std::string& what);

  /// A fault that was mended, in a sentence that says how.
  void repair(const std::string& place, const std::string& what);

  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] std::vector<std::string> repairs() const;

  /// @throws ModelError listing the faults, when there are any.
  void throw_if_any(const std::filesystem::path& file) const;

 private:
  std::vector<std::string> faults_, repairs_;
  std::set<std::string> told_;
  std::size_t count_ = 0, repair_count_ = 0;
};

}  // namespace tweenfall
