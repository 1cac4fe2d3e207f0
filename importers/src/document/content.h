#pragma once

// A document being read: the state shared by its parts while they fill in the stage's description.

#include <tweenfall/importers/document.h>

#include "document/report/problems.h"
#include "json/json_tree.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tweenfall::document {

// The content of an imported file of any kind.
struct Brought {
  StageDescription stage;
  bool names_are_free = false;
  bool is_model = false;
};

// The state shared by all files of one reading.
struct Reading {
  ReadOptions options;
  std::vector<std::filesystem::path> open{};  // the chain of importing files, the outermost first
  // Each file is read once, however often it is imported; null where it has problems, which are reported.
  std::map<std::filesystem::path, std::shared_ptr<const Brought>> brought{};

  std::vector<std::string> groups{"default"};  // of bodies: the first has the lowest bit
  std::uint64_t given_groups = 1;              // groups that some body belongs to; always includes the default one

  [[nodiscard]] bool is_outermost() const { return open.size() <= 1; }
};

struct Building {
  const json::Value root;
  std::filesystem::path folder;
  Reading& reading;
  Problems& problems;
  StageDescription stage{};
  std::optional<double> fps{};

  bool names_are_free = false;                              // neither nodes nor imports: tracks may use any name
  std::map<std::string, std::size_t, std::less<>> nodes{};  // index of each node
  std::map<std::string, std::size_t, std::less<>> clips{};
  std::set<std::string, std::less<>> imports{};         // names of imports
  std::set<std::string, std::less<>> failed_imports{};  // names of imports with unknown nodes and clips
  std::vector<ExpressionSystem> systems{};
  std::vector<json::Value> asked_groups{};     // names of groups that bodies collide with
  std::vector<std::string> clips_of_others{};  // clips of imports without nodes: their tracks name nodes of this file

  [[nodiscard]] std::vector<std::string> node_names() const;
  [[nodiscard]] std::vector<std::string> body_names() const;
  [[nodiscard]] std::vector<std::string> clip_names() const;
  // Whether a missing name may belong to an import that failed.
  [[nodiscard]] bool excused(std::string_view name) const;
  // The same of a name without that import's: "; ..." with how it would be called, or nothing.
  [[nodiscard]] std::string said_of_failed_import(std::string_view name) const;
  // Nodes of a name, or of a pattern with '*'.
  [[nodiscard]] std::vector<std::size_t> nodes_named(std::string_view name_or_pattern) const;
};

// A document's tree and its meaning.
struct ReadDocument {
  std::string name;  // in problems
  json::Tree tree;
  StageDescription stage;
  std::vector<ExpressionSystem> systems{};
  bool names_are_free = false;
  std::vector<Problem> notes{};
};

// @throws DocumentError
[[nodiscard]] ReadDocument read_document(std::string text, const std::string& name, const std::filesystem::path& folder,
                                         Reading& reading);
[[nodiscard]] ReadDocument read_document_file(const std::filesystem::path& file, Reading& reading);

// The parts, in the order in which they must be read
void read_imports(Building& building);
void read_nodes(Building& building);
void read_clips(Building& building);
void read_plays(Building& building);
void read_rules(Building& building);
void judge(Building& building);  // only if no part has a fault

}  // namespace tweenfall::document
