#include "physics/handoff/scenes.h"
#include "physics/saved_bytes.h"

#include <algorithm>
#include <cstring>
#include <numbers>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

NodeDescription solid(const std::string& name, const Shape& shape, const Vec3& place, std::size_t parent = no_node) {
  return {.name = name,
          .parent = parent,
          .rest = {.position = place},
          .body = BodyDescription{.shape = shape, .density = 300, .friction = 0.6, .restitution = 0.3}};
}

/// Two plays that fade, events that loop, a figure that is let go and taken back to settle, a chain of joints of which
/// one breaks and one ends, rules of every trigger, pairs that ignore each other, a spring and drag.
StageDescription busy(double step = 1.0 / 240) {
  StageDescription stage = tumbler(step);
  stage.nodes.push_back({.name = "tip", .parent = 1, .rest = {.position = {0.5, 0, 0}}});
  stage.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  for (int i = 0; i < 6; ++i)
    stage.nodes.push_back(solid("box" + std::to_string(i), {Box{{0.2, 0.2, 0.2}}}, {2.0, 0.25 + 0.5 * i, 0}));
  stage.nodes.push_back(solid("hanging", {Sphere{0.2}}, {-2, 2, 0}));
  stage.nodes.push_back(solid("lower", {Capsule{0.1, 0.2}}, {-2, 1.4, 0}));
  stage.nodes.push_back(solid("ghost", {Box{{0.3, 0.1, 0.3}}}, {2.1, 4, 0.1}));
  stage.nodes.push_back(solid("zone", {Box{{0.4, 0.4, 0.4}}}, {2, 2.5, 0}));
  stage.nodes.back().body->sensor = stage.nodes.back().body->fixed = true;
  stage.nodes.push_back(solid("sunk", {Box{{0.3, 0.3, 0.3}}}, {5, 0.1, 0}));
  stage.nodes.push_back(solid("weak", {Sphere{0.3}}, {-5, 2, 0}));
  for (const std::size_t keyed : {1, 2}) stage.nodes[stage.nodes.size() - keyed].body->drive = Drive::keyed();
  const auto named = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(stage.nodes, name, &NodeDescription::name) - stage.nodes.begin());
  };
  Clip sway{.name = "sway", .duration = 0.7, .loop = {.mode = LoopMode::repeat}};
  sway.tracks = {{"arm", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 3, 0), .ease = Ease::smooth()},
                                     {.time = 0.35, .value = Vec3(0.4, 3.2, 0), .ease = Ease::smooth()},
                                     {.time = 0.7, .value = Vec3(0, 3, 0)}})}};
  sway.events = {{.from = 0.2, .to = 0.2, .name = "beat", .data = "{\"loud\": true}"}};
  stage.clips.push_back(sway);
  stage.plays.push_back({.clip = 1,
                         .at = 0.1,
                         .weight = keyed_curve<double>({{.time = 0.1, .value = 0.0, .ease = Ease::linear()},
                                                        {.time = 1.5, .value = 0.6, .ease = Ease::linear()},
                                                        {.time = 2.5, .value = 0.0}})});
  stage.forces = {ForceDescription{},
                  ForceDescription{.force = Spring{.rest_length = 0.5, .stiffness = 30, .damping = 0.2},
                                   .a = named("lower"),
                                   .b = named("box2")}};
  stage.joints = {{.name = "rope",
                   .b = named("hanging"),
                   .frame_a = {.position = {-2, 3, 0}},
                   .kind = DistanceJoint{{0, 1}},
                   .break_force = 300},
                  {.name = "link",
                   .a = named("hanging"),
                   .b = named("lower"),
                   .frame_a = {.position = {0, -0.3, 0}},
                   .frame_b = {.position = {0, 0.3, 0}},
                   .kind = BallJoint{},
                   .until = when::At{1.4321}}};
  stage.ignored = {{named("ghost"), named("box5")}, {named("ghost"), named("box4")}};
  HandBack back;
  back.clock = HandBack::Clock::hold;
  back.settle = {Settle::Kind::dead_blend, 0.45};
  stage.rules = {release_at(0.3137, "body"), recover_at(1.2071, "body", back)};
  stage.rules.push_back({.bodies = {"box*"}, .when = {{when::Event{"beat"}}}, .to = {.hz = 1.5, .zeta = 0.6}});
  stage.rules.push_back(
      {.bodies = {"body"}, .when = {{when::At{1.5}, when::ContactHit{.impulse = 1e-3}}, true}, .to = {.hz = 3}});
  stage.rules.push_back({.bodies = {"box3"}, .when = {{when::Asleep{0.2}}}, .to = Drive::keyed()});
  stage.rules.push_back(
      {.bodies = {"weak"}, .when = {{when::Enter{"zone", "ghost"}}}, .to = {.hz = 3, .max_force = 50}});
  stage.rules.push_back({.bodies = {"weak"}, .when = {{when::Saturated{0.2}}}, .to = Drive::keyed()});
  stage.rules.push_back({.bodies = {"sunk"},
                         .when = {{when::At{0.9}}},
                         .to = Drive::free(),
                         .take_over = {.overlap = TakeOver::Overlap::ignore}});
  return stage;
}

/// What a caller does during the run, by the number of the frame.
void meddle(Stage& stage, int frame) {
  if (frame == 12) {
    stage.add(solid("late", {Sphere{0.15}}, {1.8, 3.4, 0.1}));
    stage.add_joint({.name = "tether",
                     .a = stage.node("box5"),
                     .b = stage.node("late"),
                     .frame_a = {.position = {0, 0.3, 0}},
                     .kind = DistanceJoint{{0, 0.6}}});
    stage.arm({.bodies = {"late"}, .when = {{when::ContactHit{.impulse = 0.01}}}, .to = {.hz = 2}, .once = false});
  }
  if (frame == 20) stage.remove(stage.node("box1"));
  if (frame == 21) stage.apply_impulse(stage.node("hanging"), Vec3(30, 0, 4), Vec3(-2, 2, 0));
  if (frame == 30) stage.release(stage.node("body"), {.velocity = TakeOver::Velocity::zero});
  if (frame == 36) stage.recover(stage.node("body"), {.settle = {Settle::Kind::half_life, 0.1}});
  if (frame == 40) stage.ignore(stage.node("late"), stage.node("box5"));
  if (frame == 55) stage.collide(stage.node("ghost"), stage.node("box5"));
  if (frame == 60) stage.remove_joint("tether");
  if (frame == 62) stage.add(solid("box1", {Box{{0.1, 0.1, 0.1}}}, {2, 5, 0}));
}

constexpr int frames = 100;
constexpr double frame_time = 0.0317;  // off every grid

struct Seen {
  std::uint64_t hash = 0;
  std::size_t events = 0, handoffs = 0, unfired = 0;
  std::vector<double> places;
  bool operator==(const Seen&) const = default;
};

Seen seen(const Stage& stage) {
  Seen out{stage.state_hash(), stage.events().size(), stage.handoffs().size(), stage.unfired_rules().size(), {}};
  std::vector<WorldMotion> world(stage.nodes().size());
  stage.world(world);
  for (NodeId node = 0; node < world.size(); ++node) {
    if (!stage.contains(node)) continue;
    const Motion& motion = world[node].motion;
    for (int i = 0; i < 3; ++i) out.places.insert(out.places.end(), {motion.pose.position[i], motion.twist.linear[i]});
    out.places.push_back(motion.pose.rotation.x());
  }
  return out;
}

}  // namespace

TEST_CASE("a stage that was saved and loaded at every frame goes on in the same bits, whatever goes on") {
  Stage original(busy());
  Stage relay(busy());
  std::vector<Stage> branches;
  for (int frame = 0; frame < frames; ++frame) {
    CAPTURE(frame);
    const std::vector<std::byte> saved = relay.save();
    REQUIRE(saved == original.save());
    Stage fresh(busy());
    fresh.load(saved);
    REQUIRE(seen(fresh) == seen(original));
    REQUIRE(fresh.save() == saved);
    relay = std::move(fresh);
    if (frame % 30 == 15) {
      branches.emplace_back(busy());
      branches.back().advance(0.7);
      branches.back().load(saved);
    }
    const auto go_on = [&](Stage& stage) {
      meddle(stage, frame);
      stage.advance(frame_time);
    };
    go_on(original);
    go_on(relay);
    REQUIRE(seen(relay) == seen(original));
    for (Stage& branch : branches) {
      go_on(branch);
      REQUIRE(seen(branch) == seen(original));
    }
  }
  const auto happened = [&](const std::string& name) {
    return std::ranges::count(original.events(), name, &StageEvent::name) > 0;
  };
  for (const char* const name : {"beat", "contact", "entered", "left", "joint_broke", "joint_ended"}) {
    CAPTURE(std::string(name));
    CHECK(happened(name));
  }
  CHECK(original.handoffs().size() > 8);
  // And back, including what the caller changed before it was saved.
  for (const double time : {0.0, 1.1, 0.3}) {
    original.seek(time);
    relay.seek(time);
    CHECK(seen(relay) == seen(original));
  }
  original.seek(frames * frame_time);
  relay.seek(frames * frame_time);
  CHECK(seen(relay) == seen(original));
}

TEST_CASE("a stage saved at any of a hand-off's instants, a hair before and after, steps to the same bits") {
  Stage original(busy());
  original.advance_to(2);
  std::vector<double> times{0};
  for (const HandOff& handoff : original.handoffs())
    for (const double aside : {-1e-3, -1e-10, 0.0, 1e-10, 1e-3}) times.push_back(handoff.time + aside);
  const std::uint64_t end = original.state_hash();
  for (const double time : times) {
    if (time < 0) continue;
    CAPTURE(time);
    Stage stage(busy());
    stage.advance_to(time);
    Stage again(busy());
    again.load(stage.save());
    CHECK(again.time() == time);
    again.advance_to(2);
    CHECK(again.state_hash() == end);
    CHECK(again.events().size() == original.events().size());
  }
}

TEST_CASE("a stage can be saved from inside a callback, and not loaded there") {
  std::vector<std::byte> saved;
  std::size_t told = 0;
  Stage stage(busy());
  stage.on_contact([&](const StageEvent&) {
    if (++told != 7) return;
    saved = stage.save();
    CHECK_THROWS_AS(stage.load(saved), std::logic_error);
  });
  stage.advance_to(2);
  REQUIRE(!saved.empty());
  Stage again(busy());
  again.load(saved);
  CHECK(std::ranges::count(again.events(), std::string("contact"), &StageEvent::name) == 7);
  again.advance_to(2);
  CHECK(seen(again) == seen(stage));
}

TEST_CASE("what is loaded calls the callbacks of the stage that loads it, for what comes after") {
  Stage stage(busy());
  stage.advance_to(0.5);
  Stage again(busy());
  std::size_t beats = 0;
  again.on_event([&](const StageEvent& event) { beats += event.name == "beat" ? 1 : 0; });
  again.load(stage.save());
  CHECK(beats == 0);
  again.advance_to(1.2);
  CHECK(beats == 1);  // at 1.0; that at 0.3 was before
}

TEST_CASE("bytes of another description, of a world, of nothing, or damaged ones are refused and change nothing") {
  Stage stage(busy());
  stage.advance_to(0.4);
  const std::vector<std::byte> saved = stage.save();
  Stage other(busy(1.0 / 120));
  CHECK_THROWS_WITH_AS(other.load(saved), "this saved stage has another description than the stage that would load it",
                       std::invalid_argument);
  StageDescription moved = busy();
  moved.clips[0].tracks[0].curve = Curve<Vec3>(Vec3(0, 3, 1e-9));
  Stage another(moved);
  CHECK_THROWS_AS(another.load(saved), std::invalid_argument);
  CHECK_THROWS_WITH_AS(stage.load(World().save()),
                       "these bytes are no saved stage: they do not begin with \"tweenfall stage\"",
                       std::invalid_argument);
  CHECK_THROWS_AS(World().load(saved), std::invalid_argument);
  CHECK_THROWS_AS(stage.load({}), std::invalid_argument);
  for (std::size_t i = 0; i < saved.size(); i += 17) {
    std::vector<std::byte> damaged = saved;
    damaged[i] ^= std::byte{4};
    CHECK_THROWS_AS(stage.load(damaged), std::invalid_argument);
    damaged.resize(i);
    CHECK_THROWS_AS(stage.load(damaged), std::invalid_argument);
  }
  CHECK(stage.save() == saved);
}

TEST_CASE("a stage that was loaded at the end of a step shows it, though its time be a hair before that") {
  Stage stage(busy());
  stage.advance_to(72 * stage.step() - 1e-10);
  Stage again(busy());
  again.load(stage.save());
  for (NodeId node = 0; node < stage.nodes().size(); ++node) {
    CAPTURE(stage.nodes()[node].name);
    const Pose then = stage.world(node).motion.pose, now = again.world(node).motion.pose;
    CHECK((then.position - now.position).norm() < 1e-8);
    CHECK((then.rotation.coeffs() - now.rotation.coeffs()).norm() < 1e-8);
  }
  CHECK(again.energy().kinetic == doctest::Approx(stage.energy().kinetic));
}

TEST_CASE("bytes that lie with a right checksum are refused, or make a stage that runs on or says why not") {
  Stage stage(busy());
  for (int frame = 0; frame < 45; ++frame) {
    meddle(stage, frame);
    stage.advance(frame_time);
  }
  const std::vector<std::byte> saved = stage.save();
  Random random(5);
  std::size_t refused = 0, taken = 0;
  for (int n = 0; n < 1500; ++n) {
    std::vector<std::byte> bytes = saved;
    const int kind = n % 3;
    const auto place =
        header + static_cast<std::size_t>(random.unit() * static_cast<double>(bytes.size() - header - 9));
    if (kind == 0) bytes[place] ^= static_cast<std::byte>(1 + static_cast<int>(random.unit() * 254));
    if (kind == 1)
      for (std::size_t i = 0; i < 8; ++i) bytes[place + i] = std::byte{0xff};  // not a number, no node, far too many
    if (kind == 2) bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(place));
    seal(bytes);
    try {
      stage.load(bytes);
    } catch (const std::invalid_argument&) {
      ++refused;
      if (n % 100 == 0) CHECK(stage.time() >= 0);
      continue;
    }
    ++taken;
    try {
      stage.advance(0.05);
      static_cast<void>(seen(stage));
      stage.seek(0.2);
    } catch (const NotFinite&) {
    } catch (const std::invalid_argument&) {
    }
  }
  MESSAGE(refused << " refused, " << taken << " taken");
  CHECK(refused > 500);
  CHECK(taken > 50);
}
