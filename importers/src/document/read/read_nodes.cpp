#include <tweenfall/anim/animation.h>

#include "document/content.h"
#include "document/fields/things.h"
#include "document/form.h"
#include "document/read/parents_first.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

namespace {

NodeDescription new_node(const json::Member& member, Building& building) {
  NodeDescription node;
  node.name = member.name;
  fields::read_place(member.value, node, building);
  fields::read_look(member.value, node, building);
  return node;
}

// The root of an import that is given a parent here.
struct HungNode {
  std::size_t node;
  json::Value parent;
};

void hang(const std::vector<HungNode>& hung, Building& building) {
  std::vector<NodeDescription>& nodes = building.stage.nodes;
  for (const auto& [node, parent] : hung) {
    const auto found = building.nodes.find(parent.text());
    if (nodes[node].parent != no_node) {
      building.problems.add(parent, "only the root of an import can be given a parent; " +
                                        json::in_quotes(nodes[node].name) + " hangs on " +
                                        json::in_quotes(nodes[nodes[node].parent].name) + " in its file");
    } else if (found == building.nodes.end()) {
      if (!building.excused(parent.text()))
        building.problems.add(parent, "there is no node " + json::in_quotes(parent.text()) +
                                          suggestion_or_import(parent.text(), building.node_names()));
    } else {
      std::size_t at = found->second;
      while (at != no_node && at != node) at = nodes[at].parent;
      if (at == node)
        building.problems.add(parent, json::in_quotes(nodes[node].name) + " would hang on itself");
      else
        nodes[node].parent = found->second;
    }
  }
}

// The document's own nodes may name parents that come later; the stage needs parents first.
struct OwnNodes {
  std::vector<json::Member> members;
  std::map<std::string, std::size_t, std::less<>> index;
};

}  // namespace

std::vector<std::string> Building::node_names() const {
  std::vector<std::string> names;
  if (problems.crowded()) return names;
  for (const NodeDescription& node : stage.nodes) names.push_back(node.name);
  problems.look_at(names.size());
  return names;
}

std::vector<std::string> Building::body_names() const {
  std::vector<std::string> names;
  if (problems.crowded()) return names;
  for (const NodeDescription& node : stage.nodes)
    if (node.body) names.push_back(node.name);
  problems.look_at(names.size());
  return names;
}

std::vector<std::string> Building::clip_names() const {
  std::vector<std::string> names;
  if (problems.crowded()) return names;
  for (const Clip& clip : stage.clips) names.push_back(clip.name);
  problems.look_at(names.size());
  return names;
}

bool Building::excused(std::string_view name) const {
  return failed_imports.count(name.substr(0, name.find('/'))) > 0;
}

std::string Building::said_of_failed_import(std::string_view name) const {
  if (failed_imports.empty() || name.find('/') != std::string_view::npos) return {};
  const std::string import(*failed_imports.begin());
  return "; what comes with " + json::in_quotes(import) + " is called " +
         json::in_quotes(import + "/" + std::string(name));
}

std::vector<std::size_t> Building::nodes_named(std::string_view name) const {
  std::vector<std::size_t> out;
  if (name.find('*') == std::string::npos) {
    if (const auto found = nodes.find(name); found != nodes.end()) out.push_back(found->second);
    return out;
  }
  for (std::size_t i = 0; i < stage.nodes.size(); ++i)
    if (matches(name, stage.nodes[i].name)) out.push_back(i);
  return out;
}

void read_nodes(Building& building) {
  const json::Value nodes = usable(building.root, "nodes");
  if (!nodes) return;
  Problems& problems = building.problems;
  OwnNodes own;
  std::vector<HungNode> hung;
  for (const json::Member& member : nodes.members()) {
    if (is_free_name(member.name)) continue;
    if (const auto known = building.nodes.find(member.name); known != building.nodes.end()) {
      // A node of an import keeps its content from the file, and this adds to it.
      for (const std::string& given : fields::place_names())
        if (const json::Value value = usable(member.value, given))
          problems.add(value, json::in_quotes(given) +
                                  " of an imported node is its file's; only \"body\", \"color\" and \"group\" can be "
                                  "added, and to a root a \"parent\"");
      if (const json::Value parent = usable(member.value, "parent")) hung.push_back({known->second, parent});
      fields::read_look(member.value, building.stage.nodes[known->second], building);
      continue;
    }
    const std::size_t slash = member.name.find('/');
    if (slash != std::string::npos && building.imports.count(member.name.substr(0, slash)) > 0) {
      std::vector<std::string> imported;
      for (const std::string& name : building.node_names())
        if (name.compare(0, slash + 1, member.name, 0, slash + 1) == 0) imported.push_back(name);
      problems.add_name(member, "the import " + json::in_quotes(member.name.substr(0, slash)) + " has no node " +
                                    json::in_quotes(member.name.substr(slash + 1)) + suggestion(member.name, imported));
      continue;
    }
    own.index.emplace(member.name, own.members.size());
    own.members.push_back(member);
  }

  std::vector<std::string> names = building.node_names();
  for (json::Member member : own.members) names.emplace_back(member.name);
  // The parent of each among the document's own nodes, if any; unknown parents are reported.
  std::vector<std::optional<std::size_t>> parent(own.members.size());
  for (std::size_t i = 0; i < own.members.size(); ++i) {
    const json::Value given = usable(own.members[i].value, "parent");
    if (!given) continue;
    const auto found = own.index.find(given.text());
    if (found != own.index.end())
      parent[i] = found->second;
    else if (building.nodes.count(given.text()) == 0 && !building.excused(given.text())) {
      if (problems.crowded()) names.clear();
      problems.look_at(names.size());
      problems.add(given,
                   "there is no node " + json::in_quotes(given.text()) + suggestion_or_import(given.text(), names));
    }
  }

  enum class State { waiting, open, placed };
  std::vector<State> state(own.members.size(), State::waiting);
  std::vector<std::size_t> chain;
  for (std::size_t i = 0; i < own.members.size(); ++i) {
    chain.clear();
    std::optional<std::size_t> at = i;
    while (at && state[*at] == State::waiting) {
      state[*at] = State::open;
      chain.push_back(*at);
      at = parent[*at];
    }
    if (at && state[*at] == State::open) {
      std::string circle;
      for (auto link = std::find(chain.begin(), chain.end(), *at); link != chain.end(); ++link)
        circle += json::in_quotes(own.members[*link].name) + " in ";
      problems.add(usable(own.members[*at].value, "parent"),
                   "these parents go around in a circle: " + circle + json::in_quotes(own.members[*at].name));
    }
    for (auto link = chain.rbegin(); link != chain.rend(); ++link) {
      const json::Member& member = own.members[*link];
      NodeDescription node = new_node(member, building);
      if (const json::Value given = usable(member.value, "parent"))
        if (const auto found = building.nodes.find(given.text()); found != building.nodes.end())
          node.parent = found->second;
      building.nodes.emplace(member.name, building.stage.nodes.size());
      building.stage.nodes.push_back(std::move(node));
      state[*link] = State::placed;
    }
  }
  hang(hung, building);
  parents_first(building);
}

}  // namespace tweenfall::document
