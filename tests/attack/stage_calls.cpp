// Calls on a Stage in any order, with any arguments: each is done or refused in words, and no body is ever nowhere.

#include "attack/mutation.h"

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/stage.h>

#include <limits>
#include <sstream>

namespace tweenfall::attack {

namespace {

constexpr int calls_per_case = 100;

class StageCalls final : public Attack {
 public:
  explicit StageCalls(std::uint64_t seed) : seed_(seed) {}

  std::string run(std::uint64_t number) override {
    ++taken_;
    return play(number, nullptr);
  }

  std::string show(std::uint64_t number) override {
    std::ostringstream log;
    const std::string fault = play(number, &log);
    return log.str() + fault;
  }

 private:
  std::string play(std::uint64_t number, std::ostringstream* log) const;

  std::uint64_t seed_;
};

Vec3 place(Random& random, double size) {
  return random.vector(size);
}

Vec3 odd_vector(Random& random) {
  return {odd_number(random, true), odd_number(random, true), odd_number(random, true)};
}

Shape some_shape(Random& random) {
  switch (below(random, 4)) {
    case 0:
      return {Sphere{random.between(0.05, 0.4)}};
    case 1:
      return {Box{Vec3(random.between(0.05, 0.4), random.between(0.05, 0.4), random.between(0.05, 0.4))}};
    case 2:
      return {Capsule{random.between(0.05, 0.2), random.between(0.05, 0.3)}};
    default:
      return {Sphere{0.25}};
  }
}

OwnerChange some_change(Random& random, bool odd) {
  OwnerChange change;
  const std::uint64_t kind = below(random, 3);
  if (kind == 0) change.to = Drive::keyed();
  if (kind == 1)
    change.to = {.hz = odd ? odd_number(random, true) : random.between(0.1, 100),
                 .max_force = below(random, 2) ? random.between(1, 100) : std::numeric_limits<double>::infinity(),
                 .frame = static_cast<Drive::Frame>(below(random, 3))};
  if (below(random, 2)) change.ramp = odd ? odd_number(random, true) : random.between(0, 0.3);
  return change;
}

/// A floor, bodies that are free, keyed and driven, one of them below another, and a clip with events that loops.
StageDescription some_stage(Random& random) {
  StageDescription description;
  description.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  const std::size_t count = 2 + below(random, 6);
  for (std::size_t i = 0; i < count; ++i) {
    BodyDescription body{.shape = some_shape(random), .mass = random.between(0.1, 5)};
    body.restitution = random.unit();
    if (below(random, 3) == 0) body.drive = Drive{.hz = random.between(0.5, 50)};
    description.nodes.push_back({.name = "body" + std::to_string(i),
                                 .parent = below(random, 4) == 0 && i > 0 ? 1 + below(random, i) : no_node,
                                 .rest = {.position = place(random, 1.5) + Vec3(0, 1.5, 0)},
                                 .body = body});
  }
  Clip clip{.name = "move", .duration = 1};
  for (std::size_t i = 0; i < count; i += 2) {
    clip.tracks.push_back(
        {"body" + std::to_string(i), "position",
         keyed_curve<Vec3>({{.time = 0, .value = place(random, 1) + Vec3(0, 1, 0)},
                            {.time = random.between(0.2, 0.8), .value = place(random, 1) + Vec3(0, 1, 0)},
                            {.time = 1, .value = place(random, 1) + Vec3(0, 1, 0)}})});
  }
  description.clips.push_back(clip);
  description.plays.push_back({.clip = 0, .at = random.between(0, 0.2), .speed = below(random, 5) ? 1 : -0.7});
  description.step = below(random, 2) ? 1.0 / 240 : 1.0 / 60;
  return description;
}

std::string StageCalls::play(std::uint64_t number, std::ostringstream* log) const {
  Random random = random_of(seed_, number);
  Stage stage(some_stage(random));
  bool strained = false;  // something odd was accepted: what follows may end in a body that is no longer finite
  const auto any_node = [&]() -> NodeId {
    return below(random, 12) ? below(random, stage.nodes().size()) : random.bits();
  };
  const auto note = [&](const char* call, double argument) {
    if (log) *log << call << ' ' << argument << " at " << stage.time() << '\n';
  };
  if (below(random, 3) == 0) {
    // What a caller does inside of a callback.
    stage.on_contact([&stage](const StageEvent& event) {
      if (event.nodes.size() == 2 && stage.has_body(event.nodes[0]))
        stage.apply_impulse(event.nodes[0], Vec3(0, 1e-3, 0), Vec3(0, 0, 0));
    });
  }
  for (int call = 0; call < calls_per_case; ++call) {
    const bool odd = below(random, 10) == 0;
    const double time = odd ? odd_number(random, true) : random.between(0, 0.05);
    try {
      switch (below(random, 14)) {
        case 0:
        case 1:
        case 2:
          // A long way is refused or takes as long as it is: here it may not be.
          if (time > 10 && time < 1e9) break;
          note("advance", time);
          stage.advance(time);
          break;
        case 3: {
          const double to = odd ? odd_number(random, true) : random.between(0, 1);
          if (to > 10 && to < 1e9) break;
          note("seek", to);
          stage.seek(to);
          break;
        }
        case 4:
          note("release", 0), stage.release(any_node());
          break;
        case 5:
          note("recover", 0), stage.recover(any_node());
          break;
        case 6: {
          const NodeId node = any_node();
          note("impulse", static_cast<double>(node));
          stage.apply_impulse(node, odd ? odd_vector(random) : place(random, 2),
                              odd ? odd_vector(random) : place(random, 1));
          strained = strained || odd;
          break;
        }
        case 7: {
          NodeDescription node{.name = "new" + std::to_string(call),
                               .rest = {.position = odd ? odd_vector(random) : place(random, 2)}};
          if (below(random, 2))
            node.body = BodyDescription{.shape = some_shape(random), .mass = odd ? odd_number(random, true) : 1};
          if (below(random, 3) == 0) node.parent = any_node();
          note("add", node.rest.position.y());
          (void)stage.add(node);
          strained = strained || odd;
          break;
        }
        case 8:
          if (stage.nodes().size() > 3 && below(random, 2)) note("remove", 0), stage.remove(any_node());
          break;
        case 9: {
          Rule rule;
          rule.bodies = {"body0"};
          const OwnerChange first = some_change(random, odd);
          if (below(random, 4)) rule.when.triggers = {when::At{stage.time() + random.between(0, 0.1)}};
          rule.to = first.to;
          rule.ramp = first.ramp;
          while (below(random, 2)) rule.then.push_back({odd ? time : random.between(0, 0.2), some_change(random, odd)});
          note("arm", rule.ramp);
          stage.arm(rule);
          break;
        }
        case 11: {
          const OwnerChange change = some_change(random, odd);
          note("hand over", change.to.hz);
          stage.hand_over(any_node(), change);
          strained = strained || odd;
          break;
        }
        case 10: {
          const NodeId node = any_node();
          (void)stage.world(node), (void)stage.twist(node), (void)stage.owner(node), (void)stage.look(node);
          (void)stage.path(node).at(time);
          break;
        }
        default:
          note("advance_to", stage.time() + time);
          if (!(time > 10 && time < 1e9)) stage.advance_to(stage.time() + time);
      }
    } catch (const std::invalid_argument&) {
    } catch (const NodeNotFinite& error) {
      // Said once with node and cause, it is said again by whoever goes on.
      if (strained && !error.cause.empty()) return {};
      return std::string("thrown, though nothing odd was asked for: ") + error.what();
    } catch (const std::exception& error) {
      return std::string("neither done nor refused: ") + error.what();
    }
    for (NodeId node = 0; node < stage.nodes().size(); ++node) {
      if (!stage.contains(node)) continue;
      const WorldMotion motion = stage.world(node);
      if (!motion.motion.pose.position.allFinite()) return "a node is nowhere after call " + std::to_string(call);
    }
  }
  return {};
}

}  // namespace

std::unique_ptr<Attack> attack_stage(std::uint64_t seed) {
  return std::make_unique<StageCalls>(seed);
}

}  // namespace tweenfall::attack
