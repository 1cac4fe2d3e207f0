#include "attack/stage/made.h"

#include <limits>

namespace tweenfall::attack {

double Arguments::number(double low, double high) const {
  return odd && one_in(2) ? odd_number(random, true) : random.between(low, high);
}

Vec3 Arguments::vector(double size) const {
  const double x = number(-size, size), y = number(-size, size);
  return {x, y, number(-size, size)};
}

std::string Arguments::name(const std::string& right) const {
  static constexpr const char* wrong[] = {"", "nobody", "floor", "body", "*", "body0/../\xff", "joint1 "};
  return misnames && one_in(12) ? wrong[below(random, std::size(wrong))] : right;
}

Shape made_shape(Random& random) {
  const auto size = [&] { return random.between(0.05, 0.4); };
  switch (below(random, 8)) {
    case 0:
      return {Sphere{size()}};
    case 1: {
      const double x = size(), y = size();
      return {Box{Vec3(x, y, size())}};
    }
    case 2:
      return {Capsule{random.between(0.05, 0.2), random.between(0.05, 0.3)}};
    case 3:
      return {Cylinder{0.2, size()}};
    case 4:
      return {Cone{0.2, size()}};
    case 5:
      return {TaperedCapsule{0.2, 0.1, random.between(0.11, 0.4)}};
    case 6:
      return {Compound({{Sphere{0.1}, {.position = Vec3(0.2, 0, 0)}}, {Box{Vec3(0.1, 0.1, size())}}})};
    default:
      return {Sphere{0.25}};
  }
}

NodeDescription made_node(const Arguments& arguments, const std::string& name) {
  NodeDescription node{.name = name, .rest = {.position = arguments.vector(2)}};
  if (!arguments.one_in(2)) return node;
  node.body = BodyDescription{.shape = made_shape(arguments.random), .mass = arguments.number(0.1, 5)};
  node.body->sensor = arguments.one_in(6);
  node.body->fixed = arguments.one_in(6);
  return node;
}

namespace {

JointKind made_kind(const Arguments& arguments) {
  const auto limits = [&]() -> std::optional<Limits> {
    if (arguments.one_in(2)) return std::nullopt;
    const double low = arguments.number(-1, 0);
    return Limits{low, arguments.number(0, 1), arguments.one_in(2) ? 0.0 : arguments.number(1, 20)};
  };
  const auto motor = [&]() -> std::optional<Motor> {
    if (arguments.one_in(2)) return std::nullopt;
    Motor made{.speed = arguments.number(-3, 3), .max_force = arguments.number(1, 50)};
    if (arguments.one_in(2)) made.position = arguments.number(-1, 1);
    return made;
  };
  switch (below(arguments.random, 10)) {
    case 0:
      return HingeJoint{limits(), motor()};
    case 1:
      return SliderJoint{limits(), motor()};
    case 2:
      return FixedJoint{};
    case 3:
      return DistanceJoint{{0, arguments.number(0.2, 2)}};
    case 4:
      return UniversalJoint{limits(), limits(), motor(), motor()};
    case 5:
      return SwingTwistJoint{arguments.number(0.1, 1), arguments.number(0.1, 1), {-0.5, arguments.number(0, 1)}};
    case 6:
      return WheelJoint{.hz = arguments.number(1, 5), .motor = motor()};
    case 7:
      return PulleyJoint{arguments.vector(2), arguments.vector(2), arguments.number(0.5, 2)};
    case 8:
      return SpringJoint{arguments.number(0, 1), arguments.number(1, 1e4), arguments.number(0, 10)};
    default:
      return BallJoint{};
  }
}

Trigger made_trigger(const Arguments& arguments, double time) {
  switch (below(arguments.random, 11)) {
    case 0:
      return when::Marker{"mark"};
    case 1:
      return when::Event{"span"};
    case 2:
      return when::ClipEnd{};
    case 3:
      return when::ContactHit{.impulse = arguments.number(0, 1)};
    case 4:
      return when::Asleep{arguments.number(0, 0.2)};
    case 5:
      return when::Enter{"zone", {}};
    case 6:
      return when::Leave{"zone", {}};
    case 7:
      return when::Saturated{arguments.number(0, 0.1)};
    case 8:
      return when::Error{arguments.number(0, 0.5)};
    case 9:
      return when::SpeedPeak{};
    default:
      return when::At{time + arguments.number(0, 0.1)};
  }
}

PlayKeys made_keys(const Arguments& arguments, double high) {
  PlayKeys keys{{0, arguments.number(0, high)}};
  while (arguments.one_in(2))
    keys.push_back({keys.back().time + arguments.number(0.05, 0.3), arguments.number(0, high)});
  return keys;
}

}  // namespace

JointDescription made_joint(const Arguments& arguments, std::size_t a, std::size_t b) {
  JointDescription joint{.a = a, .b = b, .kind = made_kind(arguments)};
  joint.frame_a.position = arguments.vector(a == no_node ? 1 : 0.3) + Vec3(0, a == no_node ? 1 : 0, 0);
  joint.frame_b.position = arguments.vector(0.3);
  if (arguments.one_in(3)) joint.break_force = arguments.number(10, 1e4);
  joint.collide = arguments.one_in(3);
  return joint;
}

TakeOver made_take_over(const Arguments& arguments) {
  TakeOver settings;
  settings.velocity = static_cast<TakeOver::Velocity>(below(arguments.random, 4));
  settings.overlap = static_cast<TakeOver::Overlap>(below(arguments.random, 4));
  if (arguments.one_in(3)) settings.average_over = arguments.number(0.01, 0.3);
  if (arguments.one_in(3)) settings.scale = arguments.number(0, 1.5);
  if (arguments.one_in(3)) settings.add.linear = arguments.vector(2);
  if (arguments.one_in(3)) settings.rewind_within = arguments.number(0, 1);
  return settings;
}

HandBack made_hand_back(const Arguments& arguments) {
  HandBack settings;
  if (arguments.one_in(3)) settings.clip = arguments.name("move");
  settings.clock = static_cast<HandBack::Clock>(below(arguments.random, 3));
  settings.anchor = static_cast<HandBack::Anchor>(below(arguments.random, 3));
  settings.settle = {static_cast<Settle::Kind>(below(arguments.random, 3)), arguments.number(0.05, 0.5)};
  return settings;
}

OwnerChange made_change(const Arguments& arguments) {
  OwnerChange change{.take_over = made_take_over(arguments), .hand_back = made_hand_back(arguments)};
  const std::uint64_t kind = below(arguments.random, 3);
  if (kind == 0) change.to = Drive::keyed();
  if (kind == 1)
    change.to = {.hz = arguments.number(0.1, 100),
                 .zeta = arguments.one_in(3) ? arguments.number(0.1, 2) : 1,
                 .max_force = arguments.one_in(2) ? arguments.number(1, 100) : std::numeric_limits<double>::infinity(),
                 .gravity_compensation = arguments.one_in(3) ? arguments.number(0, 1) : 0,
                 .frame = static_cast<Drive::Frame>(below(arguments.random, 3))};
  if (arguments.one_in(2)) change.ramp = arguments.number(0, 0.3);
  return change;
}

Rule made_rule(const Arguments& arguments, double time) {
  const OwnerChange first = made_change(arguments);
  Rule rule{.bodies = {arguments.one_in(3) ? "body*" : "body0"},
            .to = first.to,
            .take_over = first.take_over,
            .hand_back = first.hand_back,
            .once = !arguments.one_in(3),
            .ramp = first.ramp};
  do rule.when.triggers.push_back(made_trigger(arguments, time));
  while (arguments.one_in(3));
  rule.when.all = arguments.one_in(3);
  while (arguments.one_in(2)) rule.then.push_back({arguments.number(0, 0.2), made_change(arguments)});
  return rule;
}

PlayAction made_action(const Arguments& arguments) {
  switch (below(arguments.random, 6)) {
    case 0: {
      playing::Start start;
      if (arguments.one_in(2)) start.clip = arguments.name("move");
      start.from = arguments.number(0, 0.4);
      if (arguments.one_in(2)) start.to = arguments.number(0.5, 1);
      start.offset = arguments.number(0, 0.2);
      start.reverse = arguments.one_in(3);
      if (arguments.one_in(2))
        start.loop = Loop{static_cast<LoopMode>(below(arguments.random, 4)), arguments.number(0, 3)};
      start.speed = made_keys(arguments, 1.5);
      start.weight = made_keys(arguments, 1);
      if (arguments.one_in(2)) start.fade_in.seconds = arguments.number(0, 0.3);
      return start;
    }
    case 1:
      return playing::Stop{arguments.number(0, 0.3), {}};
    case 2:
      return playing::FadeTo{arguments.number(0, 1), arguments.number(0, 0.3), {}};
    case 3:
      return playing::Weigh{made_keys(arguments, 1)};
    case 4:
      return playing::SetSpeed{made_keys(arguments, 1.5), arguments.one_in(2) ? 0.0 : arguments.number(0, 0.3)};
    default:
      return playing::Seek{arguments.number(0, 1), arguments.one_in(2),
                           arguments.one_in(2) ? 0.0 : arguments.number(0, 0.3)};
  }
}

VehicleControl made_control(const Arguments& arguments) {
  VehicleControl control;
  if (!arguments.one_in(3)) control.throttle = arguments.number(-1, 1);
  if (arguments.one_in(3)) control.brake = arguments.number(0, 1);
  if (!arguments.one_in(3)) control.steer = arguments.number(-1, 1);
  return control;
}

Input made_input(const Arguments& arguments) {
  const std::string body = arguments.name("body" + std::to_string(below(arguments.random, 4)));
  switch (below(arguments.random, 8)) {
    case 0:
      return input::Ask{arguments.name("move"), made_action(arguments)};
    case 1:
      return input::Release{body, made_take_over(arguments)};
    case 2:
      return input::Recover{body, made_hand_back(arguments)};
    case 3:
      return input::HandOver{body, made_change(arguments)};
    case 4: {
      const Vec3 impulse = arguments.vector(2);
      return input::Push{body, impulse, arguments.vector(1)};
    }
    case 5:
      return input::Set{arguments.name("figure"), arguments.name("speed"), arguments.number(0, 1)};
    case 6:
      return input::Send{arguments.name("figure"), arguments.name("go")};
    default:
      return input::Control{arguments.name("car"), made_control(arguments)};
  }
}

}  // namespace tweenfall::attack
