#include "report/faults.h"

#include "report/counted.h"
#include "report/terminal.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>

#include <sstream>

namespace tweenfall::cli {

namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) found.push_back(line);
  return found;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "\n") + text;
  return all;
}

}  // namespace

Faults::Faults(std::vector<std::string> texts) : std::runtime_error(joined(texts)), texts_(std::move(texts)) {}

std::vector<std::string> faults_of(const std::exception& error, const std::string& source) {
  if (const auto* faults = dynamic_cast<const Faults*>(&error)) return faults->texts();
  if (const auto* document = dynamic_cast<const DocumentError*>(&error)) {
    std::vector<std::string> texts;
    for (const Problem& problem : document->problems()) texts.push_back(problem.text());
    for (const Problem& note : document->notes()) texts.push_back(note.text());
    return texts;
  }
  if (dynamic_cast<const ModelError*>(&error)) return lines(error.what());
  // Each line is a heading, or an indented text below it.
  std::vector<std::string> all = lines(error.what());
  if (all.size() > 1 && all[1].starts_with(' ')) all.erase(all.begin());
  for (std::string& text : all)
    text = source + ": error: " + text.substr(std::min(text.size(), text.find_first_not_of(' ')));
  return all;
}

std::size_t fault_count(const std::exception& error, const std::string& source) {
  const auto* document = dynamic_cast<const DocumentError*>(&error);
  if (!document) return faults_of(error, source).size();
  std::size_t count = 0;
  for (const Problem& problem : document->problems()) count += problem.count;
  return count;
}

void say_faults(const std::exception& error, const std::string& source) {
  for (const std::string& text : faults_of(error, source)) say(text);
  say(counted(fault_count(error, source), "problem"));
}

}  // namespace tweenfall::cli
