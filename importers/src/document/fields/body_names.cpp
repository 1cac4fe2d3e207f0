#include "document/fields/things.h"
#include "document/report/suggestion.h"

namespace tweenfall::document::fields {

std::size_t body_called(const json::Value& name, Building& building) {
  const auto found = building.nodes.find(name.text());
  if (found != building.nodes.end() && building.stage.nodes[found->second].body) return found->second;
  if (building.excused(name.text())) return no_node;
  building.problems.add(name,
                        (found == building.nodes.end() ? "there is no node " + json::in_quotes(name.text())
                                                       : "the node " + json::in_quotes(name.text()) + " has no body") +
                            suggestion_or_import(name.text(), building.body_names()));
  return no_node;
}

std::vector<std::size_t> bodies_named(const json::Value& name, Building& building) {
  if (!name.is(json::Value::Kind::text)) return {};
  if (name.text().find('*') == std::string::npos) {
    const std::size_t node = body_called(name, building);
    return node == no_node ? std::vector<std::size_t>{} : std::vector{node};
  }
  std::vector<std::size_t> named = building.nodes_named(name.text());
  std::erase_if(named, [&](std::size_t node) { return !building.stage.nodes[node].body; });
  if (named.empty() && !building.excused(name.text()))
    building.problems.add(name, "no node with a body matches " + json::in_quotes(name.text()));
  return named;
}

}  // namespace tweenfall::document::fields
