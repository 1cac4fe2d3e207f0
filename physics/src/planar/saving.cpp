#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "planar/checks.h"
#include "planar/fields.h"
#include "planar/world_data.h"
#include "saving/bytes.h"
#include "saving/envelope.h"

namespace tweenfall::planar {

namespace inner {
namespace {

constexpr saving::Envelope envelope{"plane", 6};

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_row = false;
template <class T, std::size_t count>
inline constexpr bool is_row<std::array<T, count>> = true;
template <class T>
inline constexpr bool is_maybe = false;
template <class T>
inline constexpr bool is_maybe<std::optional<T>> = true;
template <class T>
inline constexpr bool is_choice = false;
template <class... T>
inline constexpr bool is_choice<std::variant<T...>> = true;

/// The state number by number, in one order, for both writing and reading.
template <class Tool>
struct NumberByNumber {
  Tool& tool;

  template <class... T>
  void operator()(T&... values) const {
    (one(values), ...);
  }

 private:
  template <class T>
  void one(T& value) const {
    using Value = std::remove_const_t<T>;
    constexpr bool reads = !std::is_const_v<T>;
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      tool.number(value);
    } else if constexpr (std::is_same_v<Value, Vec2>) {
      one(value.data()[0]);
      one(value.data()[1]);
    } else if constexpr (std::is_same_v<Value, Pair>) {
      (*this)(value.first, value.second);
    } else if constexpr (is_row<Value>) {
      for (auto& element : value) one(element);
    } else if constexpr (is_list<Value>) {
      auto size = static_cast<std::uint64_t>(value.size());
      tool.number(size);
      if constexpr (reads) {
        value.clear();
        // One by one: a wrong count meets the end of the bytes before it takes much memory.
        for (std::uint64_t i = 0; i < size; ++i) one(value.emplace_back());
      } else {
        for (const auto& element : value) one(element);
      }
    } else if constexpr (is_maybe<Value>) {
      auto there = static_cast<std::uint8_t>(value.has_value());
      tool.number(there);
      if constexpr (reads) {
        tool.require(there <= 1, "something is neither there nor absent");
        if (there == 1)
          value.emplace();
        else
          value.reset();
      }
      if (value) one(*value);
    } else if constexpr (is_choice<Value>) {
      auto index = static_cast<std::uint8_t>(value.index());
      tool.number(index);
      if constexpr (reads) choose(value, index);
      std::visit([this](auto& chosen) { this->one(chosen); }, value);
    } else {
      each_field(value, *this);
    }
  }
  template <class... Kinds>
  void choose(std::variant<Kinds...>& value, std::uint8_t index) const {
    tool.require(index < sizeof...(Kinds), "there is no such kind");
    std::uint8_t kind = 0;
    ((kind++ == index ? static_cast<void>(value.template emplace<Kinds>()) : static_cast<void>(0)), ...);
  }
};

/// Everything that affects the next steps.
template <class Tool, class State, class Contacts>
void walk_world(Tool& tool, State& world, Contacts& contacts) {
  NumberByNumber<Tool>{tool}(world.settings, world.time, world.last_h, world.passed_over, world.bodies, world.makeups,
                             world.unused, world.joints, world.unused_joints, world.meetings, contacts, world.overlaps,
                             world.ignored);
}

bool in_order(const std::vector<Meeting>& meetings) {
  return std::adjacent_find(meetings.begin(), meetings.end(), [](const Meeting& one, const Meeting& next) {
           return encounter_of(one) >= encounter_of(next);
         }) == meetings.end();
}

/// Whether these are the indices of removed things, each once.
template <class Things>
bool are_unused(const std::vector<std::uint32_t>& indices, const Things& things) {
  std::vector<char> seen(things.size(), 0);
  for (const std::uint32_t i : indices) {
    if (i >= things.size() || things[i].alive || seen[i]) return false;
    seen[i] = 1;
  }
  return std::count_if(things.begin(), things.end(), [](const auto& thing) { return !thing.alive; }) ==
         static_cast<std::ptrdiff_t>(indices.size());
}

bool all_count(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::abs(value) <= 1e30; });
}

}  // namespace
}  // namespace inner

/// Checks what was read and recomputes what follows from it. @throws std::invalid_argument
void World::Implementation::settle_in() {
  const auto expect = [](bool holds, const char* what) {
    inner::demand(holds, std::string("these bytes are no saved plane: ") + what);
  };
  inner::demand_settings(settings);
  expect(time >= 0 && last_h >= 0 && passed_over >= 0 && inner::all_count({time, last_h, passed_over}),
         "its times are impossible");
  expect(bodies.size() == makeups.size(), "its lists differ in length");
  expect(inner::are_unused(unused, bodies) && inner::are_unused(unused_joints, joints), "its free places are taken");
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    inner::Body& body = bodies[i];
    inner::Makeup& makeup = makeups[i];
    if (!body.alive) continue;
    BodySettings its;
    its.shape = makeup.shape;
    its.friction = makeup.friction;
    its.restitution = makeup.restitution;
    its.rolling_friction = makeup.rolling_friction;
    its.linear_damping = makeup.linear_damping;
    its.angular_damping = makeup.angular_damping;
    its.fixed = makeup.fixed;
    its.drive = makeup.drive;
    its.motion = makeup.motion;
    const bool endless = std::holds_alternative<HalfPlane>(makeup.shape.outline);
    if (!endless) its.mass = makeup.mass.mass;
    if (!endless) its.moment = makeup.mass.moment;
    if (!endless) its.center = makeup.mass.center;
    inner::demand_body(its);
    its.motion = {body.center, body.angle, body.velocity, body.spin};
    inner::demand_body(its);
    its.motion = makeup.target;
    inner::demand_body(its);
    makeup.mass = inner::mass_of(its);
    makeup.plates = inner::plates_of(makeup.shape, makeup.mass.center);
    expect(makeup.friction_combine <= Combine::maximum && makeup.restitution_combine <= Combine::maximum,
           "there is no such rule");
    expect(inner::all_count({body.borne.x(), body.borne.y(), body.borne_torque}), "a number is not finite");
    expect(inner::all_count({body.force.x(), body.force.y(), body.torque, body.boxed_center.x(), body.boxed_center.y(),
                             body.boxed_angle, body.boxed_room, body.still_for}),
           "a number is not finite");
    body.turn = inner::Turn::of(body.angle);
    give_mass(i);
    sleepers += body.asleep ? 1 : 0;
  }
  for (const inner::Joint& joint : joints) {
    if (!joint.alive) continue;
    inner::validate_joint(joint.settings);
    for (const BodyId& end : {joint.settings.a, joint.settings.b})
      if (end != BodyId{}) static_cast<void>(at(end));
    expect(inner::all_count({joint.held[0], joint.held[1], joint.held[2], joint.motor, joint.lower, joint.upper,
                             joint.spring, joint.turned_a, joint.turned_b, joint.total.x(), joint.total.y(),
                             joint.total_turn}),
           "a number is not finite");
    if (const auto* const pulley = std::get_if<Pulley>(&joint.settings.kind))
      expect(pulley->length.has_value(), "a pulley's rope must have a length");
  }
  expect(inner::in_order(meetings), "its pairs are not in order");
  for (const inner::Meeting& meeting : meetings) {
    expect(meeting.b < bodies.size() && meeting.a < meeting.b && bodies[meeting.a].alive && bodies[meeting.b].alive,
           "the bodies of a pair do not exist");
    expect(meeting.part_a < makeups[meeting.a].plates.size() && meeting.part_b < makeups[meeting.b].plates.size(),
           "the parts of a pair do not exist");
    // One that was just handed to a script is looked at again in the next step, and its pairs with it.
    const bool looked_at_again = !bodies[meeting.a].boxed || !bodies[meeting.b].boxed;
    expect(meeting.sensing || bodies[meeting.a].movable || bodies[meeting.b].movable || looked_at_again,
           "a pair never moves");
    expect(meeting.count >= 0 && meeting.count <= 2, "a contact has 0 to 2 points");
    expect(
        meeting.friction >= 0 && meeting.restitution >= 0 && meeting.restitution <= 1 && meeting.rolling_friction >= 0,
        "a surface is impossible");
    expect(inner::all_count({meeting.friction, meeting.rolling_friction, meeting.rolling, meeting.clear,
                             meeting.apart.x(), meeting.apart.y(), meeting.relative.cos, meeting.relative.sin,
                             meeting.normal.x(), meeting.normal.y()}),
           "a number is not finite");
    for (std::size_t i = 0; i < 2; ++i)
      expect(inner::all_count({meeting.core_a[i].x(), meeting.core_a[i].y(), meeting.core_b[i].x(),
                               meeting.core_b[i].y(), meeting.pressing[i], meeting.dragging[i]}),
             "a number is not finite");
  }
  for (const auto& [first, second] : ignored)
    expect(first < second && second < bodies.size() && bodies[first].alive && bodies[second].alive,
           "bodies that do not exist ignore each other");
  expect(std::is_sorted(ignored.begin(), ignored.end()), "its ignored pairs are not in order");
  keep_apart();
  near.restore(bodies, makeups);
}

std::uint64_t World::state_hash() const {
  saving::ByteWriter saved;
  inner::walk_world(saved, inside(), inside().contacts());
  return saving::checksum(saved.bytes);
}

std::vector<std::byte> World::save() const {
  inner::demand(!inside().failed, "a plane of which a body is not finite cannot be saved");
  saving::ByteWriter saved;
  inner::walk_world(saved, inside(), inside().contacts());
  return saving::sealed(inner::envelope, saved.bytes);
}

void World::load(std::span<const std::byte> saved) {
  saving::ByteReader reader(saving::opened(inner::envelope, saved), inner::envelope.kind);
  auto loaded = std::make_unique<Implementation>();
  std::vector<Contact> contacts;
  inner::walk_world(reader, *loaded, contacts);
  reader.require(reader.at_end(), "there is more data than a plane");
  loaded->settle_in();
  loaded->recall(contacts);
  implementation_ = std::move(loaded);
}

}  // namespace tweenfall::planar
