#include <tweenfall/anim/animation.h>

#include <tweenfall/curves/number_text.h>

#include "document/content.h"
#include "document/fields/things.h"
#include "document/read/clip_times.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

namespace {

using Kind = JsonValue::Kind;

class RuleReader {
 public:
  explicit RuleReader(Building& building) : building_(building), problems_(building.problems) {
    for (const Clip& clip : building.stage.clips)
      for (const ClipEvent& event : clip.events)
        if (std::find(events_.begin(), events_.end(), event.name) == events_.end()) events_.push_back(event.name);
    find_animated();
  }

  void read(const JsonValue& value) {
    if (!value.is(Kind::object)) return;
    Rule rule;
    const std::vector<std::size_t> bodies = read_bodies(value, rule);
    if (const JsonValue when = usable(value, "when")) read_when(when, rule.when);
    if (const JsonValue to = usable(value, "to")) {
      rule.to = fields::read_owner(to, building_);
      check_owner(value, rule, to, bodies);
    }
    if (const JsonValue velocity = usable(value, "velocity")) rule.take_over = read_velocity(velocity);
    if (const JsonValue path = usable(value, "path")) read_path(path, rule.hand_back);
    if (const JsonValue settle = usable(value, "settle")) rule.hand_back.settle = read_settle(settle);
    rule.once = flag_in(value, "once", true);
    check_instants(value, rule, bodies);
    building_.stage.rules.push_back(std::move(rule));
  }

 private:
  // Nodes that a playing clip moves, themselves or through an ancestor.
  void find_animated() {
    const StageDescription& stage = building_.stage;
    animated_.assign(stage.nodes.size(), false);
    for (const Play& play : stage.plays) {
      if (play.clip >= stage.clips.size()) continue;
      for (const Track& track : stage.clips[play.clip].tracks) {
        const Property property = property_named(track.property);
        if (property != Property::position && property != Property::rotation && property != Property::scale) continue;
        const bool driven =
            play.mask.empty() || std::any_of(play.mask.begin(), play.mask.end(),
                                             [&](const std::string& each) { return matches(each, track.node); });
        if (const auto found = building_.nodes.find(track.node); driven && found != building_.nodes.end())
          animated_[found->second] = true;
      }
    }
    // Parents stand before their children.
    for (std::size_t i = 0; i < stage.nodes.size(); ++i)
      if (stage.nodes[i].parent != no_node && animated_[stage.nodes[i].parent]) animated_[i] = true;
  }

  std::vector<std::size_t> read_bodies(const JsonValue& value, Rule& rule) {
    std::vector<std::size_t> bodies;
    const std::vector<NodeDescription>& nodes = building_.stage.nodes;
    if (const JsonValue group = usable(value, "group")) {
      std::vector<std::string> groups;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].group.empty()) groups.push_back(nodes[i].group);
        if (nodes[i].group == group.text() && nodes[i].body && !nodes[i].body->fixed) {
          bodies.push_back(i);
          rule.bodies.push_back(nodes[i].name);
        }
      }
      std::sort(groups.begin(), groups.end());
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
      if (bodies.empty())
        problems_.add(group, "no node with a body that can move is in a group " + in_quotes(group.text()) +
                                 suggestion(group.text(), groups));
    }
    const JsonValue body = usable(value, "body");
    if (!body) return bodies;
    const auto add = [&](const JsonValue& name) {
      if (!name.is(Kind::text)) return;
      rule.bodies.emplace_back(name.text());
      const std::vector<std::size_t> named = building_.nodes_named(name.text());
      const bool pattern = name.text().find('*') != std::string::npos;
      std::size_t movable = 0;
      for (const std::size_t i : named) {
        if (!nodes[i].body || nodes[i].body->fixed) continue;
        ++movable;
        bodies.push_back(i);
      }
      if (movable > 0 || building_.excused(name.text())) return;
      if (pattern)
        problems_.add(name, "no node with a body that can move matches " + in_quotes(name.text()));
      else if (named.empty())
        problems_.add(name,
                      "there is no node " + in_quotes(name.text()) + suggestion(name.text(), building_.body_names()));
      else if (!nodes[named.front()].body)
        problems_.add(name, "the node " + in_quotes(name.text()) + " has no body, so there is nothing to hand over");
      else
        problems_.add(name, "the body of " + in_quotes(name.text()) + " is static and has one owner for good");
    };
    if (body.is(Kind::text)) add(body);
    for (const JsonValue& item : body.items()) add(item);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    return bodies;
  }

  void read_when(const JsonValue& value, When& when) {
    when.all = static_cast<bool>(value.find("all"));
    const JsonValue list = usable(value, when.all ? "all" : "any");
    if (!list) {
      read_trigger(value, when);
      return;
    }
    for (const JsonValue& trigger : list.items()) read_trigger(trigger, when);
  }

  void read_trigger(const JsonValue& value, When& when) {
    if (const JsonValue at = usable(value, "at")) {
      const ClipTimes times(building_.fps, {}, "stage time has none");
      if (const std::optional<double> seconds = times.seconds(at, {}, problems_)) {
        when.triggers.emplace_back(when::At{*seconds});
        instants_.push_back({at, *seconds});
      }
    }
    if (const JsonValue marker = usable(value, "marker")) when.triggers.emplace_back(when::Marker{known_event(marker)});
    if (const JsonValue event = usable(value, "event")) when.triggers.emplace_back(when::Event{known_event(event)});
    if (usable(value, "clip_end")) when.triggers.emplace_back(when::ClipEnd{});
    if (const JsonValue contact = usable(value, "contact")) {
      when::ContactHit hit{number_in(contact, "impulse", 0), number_in(contact, "speed", 0), text_in(contact, "with")};
      if (const JsonValue with = usable(contact, "with")) {
        const std::vector<std::size_t> named = building_.nodes_named(with.text());
        if (!building_.excused(with.text()) && std::none_of(named.begin(), named.end(), [&](std::size_t i) {
              return building_.stage.nodes[i].body.has_value();
            }))
          problems_.add(with, "no node with a body is called " + in_quotes(with.text()) +
                                  suggestion(with.text(), building_.body_names()));
      }
      when.triggers.emplace_back(std::move(hit));
    }
    if (const JsonValue asleep = usable(value, "asleep")) when.triggers.emplace_back(when::Asleep{asleep.number()});
  }

  std::string known_event(const JsonValue& name) {
    if (building_.failed_imports.empty() && std::find(events_.begin(), events_.end(), name.text()) == events_.end())
      problems_.add(name, "no clip has an event " + in_quotes(name.text()) + suggestion(name.text(), events_));
    return std::string(name.text());
  }

  void check_owner(const JsonValue& value, const Rule& rule, const JsonValue& to,
                   const std::vector<std::size_t>& bodies) {
    const auto useless = [&](const char* name, const char* why) {
      if (const JsonValue given = usable(value, name)) problems_.add(given, in_quotes(name) + why);
    };
    if (rule.to.owner() == Owner::free) {
      useless("path", " means nothing for a body that is let go; it follows none");
      useless("settle", " means nothing for a body that is let go; nothing settles");
    }
    if (rule.to.owner() != Owner::keyed) return;
    useless("velocity", " means nothing for a keyed body; it has its path's");
    const JsonValue path = usable(value, "path");
    if (path && path.find("clip")) return;
    for (const std::size_t i : bodies) {
      const NodeDescription& node = building_.stage.nodes[i];
      // A body that is keyed without being animated has its place of rest for a path, and its author said so.
      const bool rests = node.body->drive && node.body->drive->owner() == Owner::keyed;
      if (animated_[i] || rests) continue;
      problems_.add(to, in_quotes(node.name) +
                            " has no path to be keyed to: no playing clip animates it or its parents; give a \"path\" "
                            "with a \"clip\"");
      break;
    }
  }

  TakeOver read_velocity(const JsonValue& value) {
    TakeOver out;
    const std::string source = value.is(Kind::text) ? std::string(value.text()) : text_in(value, "source", "curve");
    out.velocity = source == "step"   ? TakeOver::Velocity::step
                   : source == "zero" ? TakeOver::Velocity::zero
                                      : TakeOver::Velocity::curve;
    if (const JsonValue average = usable(value, "average")) {
      out.velocity = TakeOver::Velocity::average;
      out.average_over = average.number();
    }
    out.scale = number_in(value, "scale", 1);
    if (const JsonValue add = usable(value, "add")) {
      out.add.linear = vector_in(add, "linear", Vec3(0, 0, 0));
      const Vec3 spin = vector_in(add, "angular", Vec3(0, 0, 0));
      out.add.angular = Vec3(radians(spin[0]), radians(spin[1]), radians(spin[2]));
    }
    return out;
  }

  void read_path(const JsonValue& value, HandBack& out) {
    if (const JsonValue clip = usable(value, "clip")) {
      out.clip = clip.text();
      if (building_.clips.count(out.clip) == 0 && !building_.excused(out.clip))
        problems_.add(clip, "there is no clip " + in_quotes(out.clip) + suggestion(out.clip, building_.clip_names()));
    }
    const std::string clock = text_in(value, "time"), anchor = text_in(value, "anchor");
    out.clock = clock == "hold"      ? HandBack::Clock::hold
                : clock == "restart" ? HandBack::Clock::restart
                                     : HandBack::Clock::run;
    out.anchor = anchor == "here"     ? HandBack::Anchor::here
                 : anchor == "ground" ? HandBack::Anchor::ground
                                      : HandBack::Anchor::keep;
  }

  static Settle read_settle(const JsonValue& value) {
    if (const JsonValue seconds = usable(value, "half_life")) return {Settle::Kind::half_life, seconds.number()};
    if (const JsonValue seconds = usable(value, "dead_blend")) return {Settle::Kind::dead_blend, seconds.number()};
    return {Settle::Kind::quintic, number_in(value, "quintic", 0.3)};
  }

  // Two rules that act on one body at one time would leave the outcome to their order.
  void check_instants(const JsonValue& value, const Rule& rule, const std::vector<std::size_t>& bodies) {
    const std::vector<Instant> instants = std::exchange(instants_, {});
    if (rule.when.all && rule.when.triggers.size() > 1) return;
    for (const Instant& instant : instants) {
      for (const std::size_t body : bodies) {
        const auto [other, fresh] = taken_.emplace(std::pair(instant.seconds, body), value);
        if (fresh || other->second == value) continue;
        problems_.add(instant.place, "another rule acts on " + in_quotes(building_.stage.nodes[body].name) + " at " +
                                         number_text(instant.seconds) +
                                         " s already; a body changes hands once at a time");
        break;
      }
    }
  }

  struct Instant {
    JsonValue place;
    double seconds;
  };

  Building& building_;
  Problems& problems_;
  std::vector<std::string> events_;
  std::vector<bool> animated_;
  std::vector<Instant> instants_;
  std::map<std::pair<double, std::size_t>, JsonValue> taken_;
};

}  // namespace

void read_rules(Building& building) {
  const JsonValue rules = usable(building.root, "handoff");
  if (!rules) return;
  RuleReader reader(building);
  for (const JsonValue& rule : rules.items()) reader.read(rule);
}

}  // namespace tweenfall::document
