#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/component.h>
#include <tweenfall/curves/number_text.h>

#include "document/content.h"
#include "document/fields/rule.h"
#include "document/read/values.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

namespace {

class RuleReader {
 public:
  explicit RuleReader(Building& building) : building_(building) {
    for (const Clip& clip : building.stage.clips)
      for (const ClipEvent& event : clip.events)
        if (std::find(events_.begin(), events_.end(), event.name) == events_.end()) events_.push_back(event.name);
    find_animated();
  }

  void read(const json::Value& value) {
    if (!value.is(json::Value::Kind::object)) return;
    fields::RuleBeingRead read = fields::read_rule(value, events_, building_);
    check_paths(read);
    check_instants(value, read);
    building_.stage.rules.push_back(std::move(read.rule));
  }

 private:
  // Nodes that a playing clip moves, themselves or through an ancestor.
  void find_animated() {
    const StageDescription& stage = building_.stage;
    animated_.assign(stage.nodes.size(), false);
    for (const Play& play : stage.plays)
      if (play.clip < stage.clips.size()) mark_animated(stage.clips[play.clip], play.mask);
    const std::vector<std::string> everything;
    for (const GraphDescription& graph : stage.graphs)
      for (const std::string& name : clips_named_in(graph))
        if (const auto clip = building_.clips.find(name); clip != building_.clips.end())
          mark_animated(stage.clips[clip->second], everything);
    // Parents stand before their children.
    for (std::size_t i = 0; i < stage.nodes.size(); ++i)
      if (stage.nodes[i].parent != no_node && animated_[stage.nodes[i].parent]) animated_[i] = true;
  }

  void mark_animated(const Clip& clip, const std::vector<std::string>& mask) {
    for (const Track& track : clip.tracks) {
      const auto component = component_named(track.property);
      const Property property = component ? component->property : property_named(track.property);
      if (property != Property::position && property != Property::rotation && property != Property::scale) continue;
      const bool driven = mask.empty() || std::any_of(mask.begin(), mask.end(), [&](const std::string& each) {
                            return matches(each, track.node);
                          });
      if (const auto found = building_.nodes.find(track.node); driven && found != building_.nodes.end())
        animated_[found->second] = true;
    }
  }

  // Any of its changes may take the bodies back; if they follow a clip by name, they have a path.
  void check_paths(const fields::RuleBeingRead& read) {
    const fields::ChangeBeingRead* change = &read.change;
    while (!change->follows) {
      check_path(read, *change);
      if (change->then.empty()) return;
      change = &change->then.front();
    }
  }

  void check_path(const fields::RuleBeingRead& read, const fields::ChangeBeingRead& change) {
    if (!change.to || change.change.to.owner() != Owner::keyed) return;
    for (const std::size_t i : read.bodies) {
      const NodeDescription& node = building_.stage.nodes[i];
      // A body that is keyed without being animated has its rest place as its path, as its author stated.
      const bool rests = node.body->drive && node.body->drive->owner() == Owner::keyed;
      if (animated_[i] || rests) continue;
      building_.problems.add(
          change.to, json::in_quotes(node.name) +
                         " has no path to be keyed to: no playing clip animates it or its parents; give a \"path\" "
                         "with a \"clip\"");
      break;
    }
  }

  // If two rules acted on one body at the same time, the outcome would depend on their order.
  void check_instants(const json::Value& value, const fields::RuleBeingRead& read) {
    if (read.rule.when.all && read.rule.when.triggers.size() > 1) return;
    std::vector<fields::RuleInstant> instants = read.instants;
    for (fields::RuleInstant instant : read.instants)
      for (const NextChange& next : read.rule.then) {
        instant.seconds += next.after;
        instants.push_back(instant);
      }
    for (const fields::RuleInstant& instant : instants) {
      for (const std::size_t body : read.bodies) {
        const auto [other, fresh] = taken_.emplace(std::pair(instant.seconds, body), value);
        if (fresh || other->second == value) continue;
        building_.problems.add(instant.place,
                               "another rule acts on " + json::in_quotes(building_.stage.nodes[body].name) + " at " +
                                   number_text(instant.seconds) + " s already; a body changes hands once at a time");
        break;
      }
    }
  }

  Building& building_;
  std::vector<std::string> events_;
  std::vector<bool> animated_;
  std::map<std::pair<double, std::size_t>, json::Value> taken_;
};

}  // namespace

void read_rules(Building& building) {
  const json::Value rules = usable(building.root, "handoff");
  if (!rules) return;
  RuleReader reader(building);
  for (const json::Value& rule : rules.items()) reader.read(rule);
}

}  // namespace tweenfall::document
