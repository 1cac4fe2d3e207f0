#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

namespace tweenfall::models {

namespace {

/// Enough to see what is wrong; a broken file can hold millions of the same fault.
constexpr std::size_t most_told = 40;

std::string line(const std::string& place, const std::string& what) {
  return place.empty() ? what : place + ": " + what;
}

}  // namespace

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void ModelProblems::add(const std::string& place, const std::string& what) {
  keep({place, what, std::nullopt});
}

void ModelProblems::add(const json::TextPlace& place, const std::string& what) {
  keep({"", what, place});
}

void ModelProblems::keep(Fault fault) {
  ++count_;
  if (faults_.size() >= most_told) return;
  if (told_.insert(line(fault.place, fault.what)).second) faults_.push_back(std::move(fault));
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

void ModelProblems::throw_if_any(const std::filesystem::path& file, const Where& where) const {
  if (!any()) return;
  std::string text;
  for (const Fault& fault : faults_) {
    const std::optional<json::TextPlace> at = fault.at || !where ? fault.at : where(fault.place);
    text += (text.empty() ? "" : "\n") + file.string();
    if (at) text += ":" + std::to_string(at->line) + ":" + std::to_string(at->column);
    text += ": error: " + line(fault.place, fault.what);
  }
  if (faults_.size() >= most_told && count_ > faults_.size()) text += "\n... and more";
  throw ModelError(text);
}

}  // namespace tweenfall::models
