#include "document/fields/change.h"
#include "document/fields/things.h"
#include "document/judge/judge.h"
#include "document/read/values.h"

namespace tweenfall::document::judging {

namespace {

// Whether a node above has a body, which can carry the path of this one.
bool can_be_carried(const Building& building, std::size_t node) {
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  for (std::size_t above = nodes[node].parent; above != no_node; above = nodes[above].parent)
    if (nodes[above].body) return true;
  return false;
}

void note(Building& building, const json::Value& drive, const std::string& whose) {
  building.problems.note(
      fields::place_of_frame(drive),
      "no node above " + json::in_quotes(whose) + " has a body that could carry its path: this is as \"world\"");
}

void judge_rule(Building& building, const Rule& rule, json::Value written) {
  bool any = false;
  for (const std::string& name : rule.bodies)
    for (const std::size_t node : building.nodes_named(name))
      any = any || (building.stage.nodes[node].body && can_be_carried(building, node));
  if (any || rule.bodies.empty()) return;
  const auto judge_change = [&](const Drive& to) {
    if (to.frame != Drive::Frame::world) note(building, fields::place_of_owner(written), rule.bodies.front());
  };
  judge_change(rule.to);
  for (const NextChange& next : rule.then) {
    written = fields::place_of_next(written);
    judge_change(next.change.to);
  }
}

}  // namespace

void judge_frames(Building& building) {
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].body && nodes[i].body->drive && nodes[i].body->drive->frame != Drive::Frame::world &&
        !can_be_carried(building, i))
      note(building, fields::place_of_drive(below(place_of_node(building, i), {"body"})), nodes[i].name);
  const json::Value rules = below(building.root, {"handoff"});
  for (std::size_t i = 0; i < building.stage.rules.size(); ++i)
    if (i < rules.items().size()) judge_rule(building, building.stage.rules[i], rules.items()[i]);
}

}  // namespace tweenfall::document::judging
