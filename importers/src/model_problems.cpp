#include "model_problems.h"

#include <tweenfall/importers/model.h>

namespace tweenfall {

namespace {

/// Enough to see what is wrong; a broken file can hold millions of the same fault.
constexpr std::size_t most_told = 40;

std::string line(const std::string& place, const std::string& what) {
  return place.empty() ? what : place + ": " + what;
}

}  // namespace

void ModelProblems::add(const std::string& place, const std::string& what) {
  ++count_;
  if (faults_.size() >= most_told) return;
  const std::string text = line(place, what);
  if (told_.insert(text).second) faults_.push_back(text);
}

void ModelProblems::repair(const std::string& place, const std::string& what) {
  ++repair_count_;
  if (repairs_.size() < most_told) repairs_.push_back(line(place, what));
}

std::vector<std::string> ModelProblems::repairs() const {
  std::vector<std::string> all = repairs_;
  if (repair_count_ > repairs_.size())
    all.push_back("and " + std::to_string(repair_count_ - repairs_.size()) + " more repairs of such kinds");
  return all;
}

void ModelProblems::throw_if_any(const std::filesystem::path& file) const {
  if (!any()) return;
  std::string text;
  for (const std::string& fault : faults_) text += (text.empty() ? "" : "\n") + file.string() + ": error: " + fault;
  if (faults_.size() >= most_told && count_ > faults_.size()) text += "\n... and more";
  throw ModelError(text);
}

}  // namespace tweenfall
