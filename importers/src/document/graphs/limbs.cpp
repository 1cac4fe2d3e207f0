#include "document/graphs/parts.h"
#include "document/report/suggestion.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>

namespace tweenfall::document::graphs {

namespace {

using fields::member;
using fields::Row;
using fields::Table;
using Kind = json::Value::Kind;

Form half_a_turn(std::string what) {
  return bounded(std::move(what), 0, false, 180);
}

template <class Thing, class Access>
Row<Thing> joint_row(const char* name, const char* help, Access access) {
  return {name, &ValueForms::name, help, member<Thing>(access), true};
}

const Form* softness_form(FormStore& store, const ValueForms&) {
  return store.add(bounded("a softness from 0 to 0.5", 0, false, 0.5));
}

// Two bones

const Table<TwoBonePose>& two_bone_table() {
  using Pose = TwoBonePose;
  static const Table<Pose> table(
      "two bones",
      {joint_row<Pose>("start", "a node, such as a thigh", &Pose::start),
       joint_row<Pose>("middle", "below it, such as a shin", &Pose::middle),
       joint_row<Pose>("end", "below that; it reaches the target", &Pose::end),
       place_row<Pose>("target", "where the end goes", true, &Pose::target),
       place_row<Pose>("pole", "to which the middle points; absent: as the pose has it", false, &Pose::pole),
       axis_row<Pose>("axis", "about which it bends, in the start's space; absent: as at rest", &Pose::axis),
       {"softness", softness_form, "share of the length over which stretching slows down",
        member<Pose>(&Pose::softness)},
       weight_row<Pose>()});
  return table;
}

// Looking

const Table<LookAtPose::Joint>& looking_joint_table() {
  using Joint = LookAtPose::Joint;
  static const Table<Joint> table(
      "a joint", {joint_row<Joint>("node", "of the graph", &Joint::node),
                  {"share", share_form(), "of the turning that is still missing", member<Joint>(&Joint::share)}});
  return table;
}

template <class Joint>
const Form* joints_form(const Table<Joint>& table, const char* what, FormStore& store, const ValueForms& values,
                        std::vector<Together> together = {}) {
  Form full = table.listing_form(store, values);
  full.together = std::move(together);
  full.on_one_line = true;
  const std::string either = "a node's name, or " + full.what;
  // The chain itself checks the number of joints.
  return store.add(list_of(store.add(choice_of(either, {values.name, store.add(std::move(full))})), what, 0));
}

template <class Joint>
void read_joints(const json::Value& value, const Table<Joint>& table, std::vector<Joint>& joints, Building& building) {
  for (const json::Value& item : value.items()) {
    Joint& joint = joints.emplace_back();
    if (item.is(Kind::text)) joint.node = item.text();
    if (item.is(Kind::object)) table.read(item, joint, building);
  }
}

const Table<LookAtPose>& look_at_table() {
  using Pose = LookAtPose;
  const fields::FormOf joints = fields::FormOf::Make([](FormStore& store, const ValueForms& values) {
    return joints_form(looking_joint_table(), "a list of joints, the last of which looks", store, values);
  });
  const auto read = [](const json::Value& value, Pose& pose, Building& building) {
    read_joints(value, looking_joint_table(), pose.joints, building);
  };
  static const Table<Pose> table(
      "a look",
      {{"joints", joints, "from the one nearest to the root to the one that looks", {read}, true},
       place_row<Pose>("target", "at which it looks", true, &Pose::target),
       axis_row<Pose>("forward", "where the last joint looks, in its own space; absent: z", &Pose::forward),
       axis_row<Pose>("up", "what is up for it, where it stays upright; absent: y", &Pose::up),
       axis_row<Pose>("upright", "of the world, that is to be up; absent: it turns the shortest way", &Pose::upright),
       {"eye", &ValueForms::vector, "from where it looks, in its own space, m", member<Pose>(&Pose::eye)},
       angle_row<Pose>("limit", half_a_turn("an angle from 0 to 180 degrees"), "of the turning, degrees", "180",
                       &Pose::limit),
       angle_row<Pose>("ease", bounded("an angle of 0 or more degrees", 0, false),
                       "over which it slows to a stop before the limit, degrees; absent: 0.2 rad", "", &Pose::ease),
       weight_row<Pose>()});
  return table;
}

// Chains

const Form* angles_form(FormStore& store, const ValueForms&) {
  Form pair;
  pair.kind = Form::Kind::tuple;
  pair.what = "two angles from -180 to 180 degrees: [least, most]";
  const Form* angle = store.add(bounded("an angle from -180 to 180 degrees", -180, false, 180));
  pair.parts = {angle, angle};
  pair.fewest = 2;
  pair.on_one_line = true;
  return store.add(std::move(pair));
}

template <class Limit>
Row<Limit> angles_row(const char* name, const char* help, double Limit::*low, double Limit::*high) {
  const auto read = [low, high](const json::Value& value, Limit& limit, Building& building) {
    if (value.items().size() != 2) return;
    const double least = value.items()[0].number(), most = value.items()[1].number();
    if (least > most) {
      building.problems.add(value, "limits must be in order, the low one first; " + number_text(least) + " is above " +
                                       number_text(most));
      return;
    }
    limit.*low = radians(least);
    limit.*high = radians(most);
  };
  return {name, angles_form, help, {read, "[-180,180]"}};
}

const Table<HingeLimit>& hinge_table() {
  static const Table<HingeLimit> table(
      "a hinge", {axis_row<HingeLimit>("axis", "in the joint's own space; absent: x", &HingeLimit::axis),
                  angles_row<HingeLimit>("limits", "from the rest pose", &HingeLimit::low, &HingeLimit::high)});
  return table;
}

const Table<ConeLimit>& cone_table() {
  static const Table<ConeLimit> table(
      "a socket", {angle_row<ConeLimit>("swing", bounded("an angle from 0 to 177 degrees", 0, false, 177),
                                        "half the opening of the cone, degrees", "90", &ConeLimit::swing),
                   angles_row<ConeLimit>("twist", "about the bone", &ConeLimit::twist_low, &ConeLimit::twist_high)});
  return table;
}

template <class Limit>
fields::Meaning<ReachPose::Joint> limit_of(const Table<Limit>& table) {
  return {[&table](const json::Value& value, ReachPose::Joint& joint, Building& building) {
    table.read(value, joint.limit.emplace<Limit>(), building);
  }};
}

const Table<ReachPose::Joint>& reaching_joint_table() {
  using Joint = ReachPose::Joint;
  static const Table<Joint> table(
      "a joint", {joint_row<Joint>("node", "of the graph", &Joint::node),
                  {"hinge", fields::form_of(hinge_table()), "it turns about one axis alone", limit_of(hinge_table())},
                  {"socket", fields::form_of(cone_table()), "its bone stays within a cone", limit_of(cone_table())}});
  return table;
}

const Table<ReachPose>& reach_table() {
  using Pose = ReachPose;
  const fields::FormOf joints = fields::FormOf::Make([](FormStore& store, const ValueForms& values) {
    return joints_form(reaching_joint_table(), "a list of joints, the last of which reaches", store, values,
                       {at_most_one({"hinge", "socket"})});
  });
  const auto read = [](const json::Value& value, Pose& pose, Building& building) {
    read_joints(value, reaching_joint_table(), pose.joints, building);
  };
  static const Table<Pose> table(
      "a chain",
      {{"joints", joints, "from the one nearest to the root to the end, which is carried", {read}, true},
       place_row<Pose>("target", "for which the end reaches", true, &Pose::target),
       fields::one_of<Pose, ChainMethod>("method", "a way to reach: \"fabrik\" or \"ccd\"",
                                         {{"fabrik", ChainMethod::fabrik}, {"ccd", ChainMethod::ccd}},
                                         "bones stay where they were, or joints near the end turn the most",
                                         &Pose::method),
       {"sweeps", bounded("a whole number from 0 to 1000", 0, false, 1000, true), "of the method",
        member<Pose>(&Pose::sweeps)},
       {"leaps", &ValueForms::boolean, "with limits: jumps to wherever it is nearer to its target; true by default",
        member<Pose>(&Pose::leaps)},
       {"follows", &ValueForms::boolean, "with limits: goes on from where it was, so that it leaps only where it must",
        member<Pose>(&Pose::follows)},
       weight_row<Pose>()});
  return table;
}

// Feet

const Table<FeetPose::Foot>& foot_table() {
  using Foot = FeetPose::Foot;
  const auto height = [](const json::Value& value, Foot& foot, Building&) { foot.ankle_height = value.number(); };
  static const Table<Foot> table(
      "a leg",
      {joint_row<Foot>("start", "the thigh", &Foot::start),
       joint_row<Foot>("middle", "the shin", &Foot::middle),
       joint_row<Foot>("end", "the foot", &Foot::end),
       axis_row<Foot>("axis", "about which it bends, in the start's space; absent: as at rest", &Foot::axis),
       {"ankle_height", &ValueForms::number, "of the foot above its sole, m; absent: above 0 at rest", {height}},
       number_row<Foot>("weight", share_form(), "how much the foot belongs on the ground", "1", &Foot::weight)});
  return table;
}

const Form* legs_form(FormStore& store, const ValueForms& values) {
  Form leg = foot_table().listing_form(store, values);
  Form list = list_of(store.add(std::move(leg)), "a list of legs", 1, most_feet_placed);
  list.one_per_line = true;
  return store.add(std::move(list));
}

// The heights of a node that is a height field, at its rest pose.
void read_ground(const json::Value& value, FeetPose& pose, Building& building) {
  pose.ground = {.columns = 2, .heights = {0, 0, 0, 0}};  // used if there is a fault, which is reported
  const auto found = building.nodes.find(value.text());
  if (found == building.nodes.end()) {
    if (!building.excused(value.text()))
      building.problems.add(value, "there is no node " + json::in_quotes(value.text()) +
                                       suggestion_or_import(value.text(), building.node_names()));
    return;
  }
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  const NodeDescription& node = nodes[found->second];
  const auto* field = node.body ? std::get_if<HeightField>(&node.body->shape.solid) : nullptr;
  if (!field) {
    building.problems.add(value, "feet are placed on a node whose body is a \"height_field\"; " +
                                     json::in_quotes(value.text()) + " is none");
    return;
  }
  if (!node.body->fixed) {
    building.problems.add(value, "feet are placed on a ground that stays where it is; " +
                                     json::in_quotes(value.text()) + " does, where its body is \"static\"");
    return;
  }
  const auto stands_straight = [](const Pose& each) {
    return each.rotation.vec().isZero(0) && each.scale == Vec3(1, 1, 1);
  };
  Vec3 middle = node.body->shape.offset.position;
  bool straight = node.body->shape.offset.rotation.vec().isZero(0);
  for (std::size_t at = found->second; at != no_node; at = nodes[at].parent) {
    straight = straight && stands_straight(nodes[at].rest);
    middle += nodes[at].rest.position;
  }
  if (!straight) {
    building.problems.add(value, "feet are placed on a ground that is neither turned nor scaled; " +
                                     json::in_quotes(value.text()) + " is");
    return;
  }
  pose.ground = {.columns = field->columns(),
                 .heights = {field->heights().begin(), field->heights().end()},
                 .spacing_x = field->spacing_x(),
                 .spacing_z = field->spacing_z(),
                 .middle = middle};
}

const Table<FeetPose>& feet_table() {
  using Pose = FeetPose;
  const auto legs = [](const json::Value& value, Pose& pose, Building& building) {
    for (const json::Value& leg : value.items()) foot_table().read(leg, pose.feet.emplace_back(), building);
  };
  Form number;
  number.kind = Form::Kind::number;
  number.what = "a height in m";
  static const Table<Pose> table(
      "feet", {joint_row<Pose>("pelvis", "a node above all legs; it is moved", &Pose::pelvis),
               {"legs", legs_form, "each ends in a foot", {legs}, true},
               {"ground",
                &ValueForms::name,
                "a node whose body is a height field, over which the feet go",
                {read_ground},
                true},
               number_row<Pose>("floor", number, "height of the floor on which the base walks, m", "0", &Pose::floor),
               {"lowest", &ValueForms::not_negative, "how far the pelvis may go down, m", member<Pose>(&Pose::lowest)},
               {"highest", &ValueForms::not_negative, "how far it may go up, m", member<Pose>(&Pose::highest)},
               {"evenness", &ValueForms::not_negative, "distance over which one foot replaces another as the lowest, m",
                member<Pose>(&Pose::evenness)},
               angle_row<Pose>("tilt", bounded("an angle from 0 to 90 degrees", 0, false, 90),
                               "of the feet at most, degrees; absent: 0.8 rad", "", &Pose::tilt),
               {"softness", softness_form, "of the legs", member<Pose>(&Pose::softness)},
               weight_row<Pose>()});
  return table;
}

}  // namespace

OperationWord two_bone_word() {
  return word_of("two_bone", two_bone_table(), "two bones bend until their end is at a target");
}

OperationWord look_at_word() {
  return word_of("look_at", look_at_table(), "joints turn until the last looks at a target");
}

OperationWord reach_word() {
  return word_of("reach", reach_table(), "a chain of joints bends until its end is at a target");
}

OperationWord feet_word() {
  return word_of("feet", feet_table(), "feet stand on uneven ground");
}

}  // namespace tweenfall::document::graphs
