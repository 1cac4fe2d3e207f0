#pragma once

// Collects the faults of a model file, so that one reading reports all of them.

#include "json/json_tree.h"
#include "json/text_place.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tweenfall::models {

/// "1 light is read as a plain node", "3 lights are read as plain nodes".
[[nodiscard]] std::string counted(std::size_t count, const std::string& one, const std::string& many);

class ModelProblems {
 public:
  /// A fault for which the file cannot be loaded. @param place  where in the file, or empty
  void add(const std::string& place, const std::string& what);
  void add(const json::TextPlace& place, const std::string& what);

  /// A fault that was repaired, with a sentence that says how.
  void repair(const std::string& place, const std::string& what);

  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] std::vector<std::string> repairs() const;

  /// The line and column of a place, if known.
  using Where = std::function<std::optional<json::TextPlace>(const std::string& place)>;

  /// @throws ModelError listing the faults, when there are any.
  void throw_if_any(const std::filesystem::path& file, const Where& where = {}) const;

 private:
  struct Fault {
    std::string place, what;
    std::optional<json::TextPlace> at;
  };

  void keep(Fault fault);

  std::vector<Fault> faults_;
  std::vector<std::string> repairs_;
  std::set<std::string> told_;
  std::size_t count_ = 0, repair_count_ = 0;
};

}  // namespace tweenfall::models
