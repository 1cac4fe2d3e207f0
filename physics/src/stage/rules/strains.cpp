#include "stage/rules/strains.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::staging {

namespace {

/// Shortest edge of the smaller body's bounds, m.
double size_of(const World& world, const BodyId& a, const BodyId& b) {
  double size = infinity;
  for (const BodyId& id : {a, b}) {
    const Bounds room = bounds(world.shape(id), world.motion(id).pose);
    size = std::min(size, (room.high - room.low).minCoeff());
  }
  return size;
}

void tell_strain(const StageState& state, const char* name, const char* what, double depth, std::vector<NodeId> nodes,
                 const std::string& joint, std::vector<Happening>& happenings) {
  StageEvent event;
  event.time = state.time;
  event.name = name;
  event.data = std::string("{\"") + what + "\": " + number_text(depth) + "}";
  event.nodes = std::move(nodes);
  event.joint = joint;
  Happening& happening = happenings.emplace_back();
  happening.time = state.time;
  happening.what = std::move(event);
}

// What exceeds this for `lasting` is reported, and again only after it has fallen below half of it.
constexpr double too_much = 0.05;  // of the smaller body's size; rad; of a speed
constexpr double well_again = 0.5;
constexpr double lasting = 0.05;  // s
constexpr double least = 1e-3;    // m; less deep overlap is no strain, however small the body

/// Whether a strain that has lasted since then is to be reported now.
template <class Strained>
bool is_news(Strained& strain, double now) {
  if (strain.told || now - strain.since < lasting - sliver) return false;
  return strain.told = true;
}

std::pair<std::uint32_t, std::uint32_t> by_pair(const Strain& strain) {
  return {strain.a.index, strain.b.index};
}

void report_overlaps(StageState& state, std::vector<Happening>& happenings) {
  std::vector<Strain> deep;
  for (const Contact& contact : state.world.contacts()) {
    double depth = 0;
    for (int i = 0; i < contact.manifold.count; ++i)
      depth = std::max(depth, contact.manifold.points[static_cast<std::size_t>(i)].penetration);
    if (!(depth > least)) continue;
    Strain strain{contact.a, contact.b, state.time};
    if (!deep.empty() && by_pair(deep.back()) == by_pair(strain)) continue;
    const auto known = std::ranges::lower_bound(state.strained, by_pair(strain), {}, by_pair);
    if (known != state.strained.end() && known->a == contact.a && known->b == contact.b) strain = *known;
    const double most = too_much * size_of(state.world, contact.a, contact.b);
    if (!(depth > (strain.told ? well_again * most : most))) continue;
    if (is_news(strain, state.time))
      tell_strain(state, "overlap", "depth", depth, {state.node_of[contact.a.index], state.node_of[contact.b.index]},
                  {}, happenings);
    deep.push_back(strain);
  }
  state.strained = std::move(deep);
}

/// What a joint cannot hold, and how much of it: 1 is worth reporting.
struct JointStrain {
  double share = 0;
  const char* what = "gap";
  double amount = 0;

  void take(const char* of, double by, double most) {
    if (by / most > share) *this = {by / most, of, by};
  }
};

class StrainOfKind {
 public:
  /// @param turn  of b's frame relative to a's
  StrainOfKind(const JointReading& reading, const Quat& turn, double size, JointStrain& strain)
      : reading_(reading), turn_(turn), size_(size), strain_(strain) {}

  void operator()(const BallJoint&) const {}
  void operator()(const FixedJoint&) const { turned_by(angle_of(turn_)); }
  void operator()(const GearJoint& gear) const { turned_by(gear.ratio * reading_.position[0] + reading_.position[1]); }
  void operator()(const SpringJoint&) const {}
  void operator()(const PulleyJoint&) const {}    // its excess length is its gap
  void operator()(const DistanceJoint&) const {}  // likewise
  void operator()(const HingeJoint& hinge) const {
    turned_by(off_axis());
    coordinate(0, hinge.limits, hinge.motor, 1);
  }
  void operator()(const SliderJoint& slider) const {
    turned_by(angle_of(turn_));
    coordinate(0, slider.limits, slider.motor, size_);
  }
  void operator()(const UniversalJoint& universal) const {
    turned_by(std::asin(std::clamp((turn_ * Vec3::UnitY()).x(), -1.0, 1.0)));
    coordinate(0, universal.first_limits, universal.first_motor, 1);
    coordinate(1, universal.second_limits, universal.second_motor, 1);
  }
  void operator()(const WheelJoint& wheel) const {
    turned_by(off_axis());
    coordinate(0, {}, wheel.motor, 1);
    coordinate(1, wheel.suspension, {}, size_);
  }
  void operator()(const SwingTwistJoint& limb) const {
    coordinate(0, limb.twist, {}, 1);
    constexpr double narrowest = 1e-3;
    const Vec2 width(std::max(limb.swing_y, narrowest), std::max(limb.swing_z, narrowest));
    const Vec2 scaled(reading_.position[1] / width.x(), reading_.position[2] / width.y());
    // To first order, the distance to the cone's edge.
    const double share = scaled.norm();
    if (share > 1) turned_by((share - 1) * share / scaled.cwiseQuotient(width).norm());
  }

 private:
  static double angle_of(const Quat& turn) { return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())); }
  /// Angle between the frames' x axes.
  [[nodiscard]] double off_axis() const {
    const Vec3 x = turn_ * Vec3::UnitX();
    return std::atan2(std::hypot(x.y(), x.z()), x.x());
  }
  /// Turned farther than the joint allows, rad.
  void turned_by(double angle) const { strain_.take("beyond_limit", std::abs(angle), too_much); }

  /// @param unit  of the coordinate: a radian, or the size of a body
  void coordinate(int index, const std::optional<Limits>& limits, const std::optional<Motor>& motor,
                  double unit) const {
    const auto i = static_cast<std::size_t>(index);
    const double position = reading_.position[i], most = too_much * unit;
    if (limits && limits->hz == 0)
      strain_.take("beyond_limit", std::max(limits->low - position, position - limits->high), most);
    if (!motor || motor->position || std::isfinite(motor->max_force)) return;
    // At the end of its range a motor rests.
    if (limits && (motor->speed > 0 ? position > limits->high - most : position < limits->low + most)) return;
    strain_.take("missing_speed", std::abs(motor->speed - reading_.rate[i]),
                 std::max(std::abs(motor->speed), unit) * too_much);
  }

  const JointReading& reading_;
  Quat turn_;
  double size_;
  JointStrain& strain_;
};

bool moves(const World& world, const BodyId& body) {
  return !world.is_fixed(body) && world.owner(body) != Owner::keyed;
}

/// Between ends that cannot move, a joint does nothing.
JointStrain strain_of(const StageState& state, const StagedJoint& joint) {
  const BodyId b = state.bodies[state.body_of[joint.b]].id;
  const BodyId a = joint.a == no_node ? b : state.bodies[state.body_of[joint.a]].id;
  if (!moves(state.world, a) && !moves(state.world, b)) return {};
  const double size = size_of(state.world, a, b);
  const JointReading reading = state.world.reading(joint.id);
  JointStrain strain;
  if (reading.gap > least) strain.take("gap", reading.gap, too_much * size);
  const JointSettings& its = state.world.joint(joint.id);
  const Quat axes_b = state.world.motion(b).pose.rotation * its.frame_b.rotation;
  const Quat axes_a =
      joint.a == no_node ? its.frame_a.rotation : Quat(state.world.motion(a).pose.rotation * its.frame_a.rotation);
  std::visit(StrainOfKind(reading, axes_a.conjugate() * axes_b, size, strain), its.kind);
  return strain;
}

void report_torn_joints(StageState& state, std::vector<Happening>& happenings) {
  std::vector<Tear> torn;
  const std::vector<StagedJoint>& joints = state.joints->list;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!state.world.contains(joints[i].id)) continue;
    const JointStrain strain = strain_of(state, joints[i]);
    if (!(strain.share > well_again)) continue;
    Tear tear{i, state.time};
    if (const auto known = std::ranges::lower_bound(state.torn, i, {}, &Tear::joint);
        known != state.torn.end() && known->joint == i)
      tear = *known;
    if (!tear.told && !(strain.share > 1)) continue;
    if (is_news(tear, state.time)) {
      std::vector<NodeId> nodes{joints[i].b};
      if (joints[i].a != no_node) nodes.insert(nodes.begin(), joints[i].a);
      tell_strain(state, "joint_strained", strain.what, strain.amount, std::move(nodes), joints[i].name, happenings);
    }
    torn.push_back(tear);
  }
  state.torn = std::move(torn);
}

void report_squeezed(StageState& state, std::vector<Happening>& happenings) {
  std::erase_if(state.squeezed, [&](const Squeeze& one) { return state.time - one.last >= lasting - sliver; });
  for (const StagedBody& body : state.bodies) {
    if (!body.present || !state.world.squeezed(body.id)) continue;
    const auto known =
        std::ranges::lower_bound(state.squeezed, body.id.index, {}, [](const Squeeze& one) { return one.body.index; });
    if (known != state.squeezed.end() && known->body == body.id) {
      known->last = state.time;
      continue;
    }
    state.squeezed.insert(known, {body.id, state.time});
    tell_strain(state, "squeezed", "speed", state.world.twist(body.id).linear.norm(), {body.node}, {}, happenings);
  }
}

}  // namespace

void report_strains(StageState& state, std::vector<Happening>& happenings) {
  report_squeezed(state, happenings);
  report_overlaps(state, happenings);
  report_torn_joints(state, happenings);
}

}  // namespace tweenfall::staging
