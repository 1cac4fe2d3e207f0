#include "gltf/physics/read_physics.h"
#include "gltf/physics/reduced_mass.h"
#include "gltf/physics/written_physics.h"

#include <tweenfall/curves/reflection.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tweenfall::gltf::physics {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// A bound of one or more axes.
struct Bound {
  bool linear = false;
  std::vector<std::size_t> axes;
  double low = -endless, high = endless;
  std::optional<double> stiffness;
  double damping = 0;

  [[nodiscard]] bool locks() const { return low == 0 && high == 0 && !stiffness; }
};

struct JointDrive {
  bool linear = false, by_acceleration = false;
  std::size_t axis = 0;
  double position = 0, velocity = 0, stiffness = 0, damping = 0, most = endless;
};

/// The freedom that limits leave for each axis.
struct Freedom {
  std::array<bool, 3> locked{};
  std::array<const Bound*, 3> bound{};  ///< of a single axis
  const Bound* shared = nullptr;        ///< of several axes that it does not lock

  [[nodiscard]] int count() const { return static_cast<int>(std::count(locked.begin(), locked.end(), true)); }
  /// The first axis that is, or is not, locked.
  [[nodiscard]] int only(bool which) const {
    const auto found = std::find(locked.begin(), locked.end(), which);
    return static_cast<int>(found - locked.begin());
  }
};

/// A frame whose x and y axes lie along two axes of another.
Quat onto(int x, int y) {
  Mat3 axes;
  axes.col(0) = Vec3::Unit(x);
  axes.col(1) = Vec3::Unit(y);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return Quat(axes);
}

class JointReader {
 public:
  JointReader(const FileScene& scene, std::span<const ModelBody> bodies)
      : scene_(scene),
        physics_(scene.root.inside("extensions").inside(bodies_extension)),
        masses_(scene.nodes.size(), bodies),
        mover_(movers(scene)),
        has_body_(scene.nodes.size(), 0) {
    for (const ModelBody& body : bodies) has_body_[body.node] = 1;
  }

  std::vector<JointDescription> read() {
    std::vector<JointDescription> joints;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Fields physics = physics_of(scene_.root, i);
      if (!physics.has("joint")) continue;
      if (std::optional<JointDescription> joint = joint_at(physics.inside("joint"), i))
        joints.push_back(std::move(*joint));
    }
    return joints;
  }

 private:
  struct End {
    std::size_t body = no_node;
    Pose frame;
  };

  [[nodiscard]] End end_at(std::size_t node) const {
    const std::size_t mover = mover_[node] != no_node && has_body_[mover_[node]] ? mover_[node] : no_node;
    Pose frame = pose_within(scene_, node, mover);
    // Frames of joints do not include the scale of the body's node.
    if (mover != no_node) {
      const Vec3 scale = pose_within(scene_, mover, no_node).scale;
      frame.position = frame.position.cwiseProduct(scale);
      frame.rotation = pose::reflected_by(pose::reflection_of(scale), frame.rotation);
    }
    return {mover, {frame.position, frame.rotation}};
  }

  std::optional<JointDescription> joint_at(const Fields& said, std::size_t node) {
    const auto connected = said.required_index("connectedNode", scene_.nodes.size());
    const auto index = said.required_index("joint", physics_.list("physicsJoints").size());
    if (!connected || !index) return std::nullopt;
    const auto left_out = [&](const std::string& why) {
      said.problems().repair(said.place(), why + "; the joint was left out");
      return std::nullopt;
    };
    const End a = end_at(node), b = end_at(*connected);
    if (a.body == b.body) return left_out(a.body == no_node ? "holds nothing that moves" : "holds a body to itself");

    JointDescription joint;
    joint.name = scene_.nodes[node].node.name;
    joint.collide = said.flag("enableCollision");
    const bool turned_about = b.body == no_node;  // the world is always the first end
    const End &first = turned_about ? b : a, &second = turned_about ? a : b;
    joint.a = first.body;
    joint.b = second.body;
    joint.frame_a = first.frame;
    joint.frame_b = second.frame;
    const Fields form = physics_.at("physicsJoints", *index);
    read_form(form, turned_about);
    if (!name_kind(joint)) return left_out("has limits that make no joint known here");
    return joint;
  }

  /// Bounds and drives of b relative to a.
  void read_form(const Fields& form, bool turned_about) {
    bounds_.clear();
    drives_.clear();
    for (std::size_t i = 0; i < form.list("limits").size(); ++i) {
      const Fields limit = form.at("limits", i);
      Bound bound;
      bound.linear = limit.has("linearAxes");
      bound.axes = limit.indices(bound.linear ? "linearAxes" : "angularAxes", 3);
      bound.low = number_of(limit, "min").value_or(-endless);
      bound.high = number_of(limit, "max").value_or(endless);
      bound.stiffness = number_of(limit, "stiffness");
      bound.damping = number_of(limit, "damping").value_or(0);
      if (bound.low > bound.high) limit.problems().add(limit.place(), "has a \"min\" above its \"max\"");
      if (bound.stiffness && !(*bound.stiffness > 0)) bound.stiffness.reset();
      if (turned_about && bound.axes.size() == 1) {
        std::swap(bound.low, bound.high);
        bound.low = -bound.low;
        bound.high = -bound.high;
      }
      bounds_.push_back(std::move(bound));
    }
    const double sign = turned_about ? -1 : 1;
    for (std::size_t i = 0; i < form.list("drives").size(); ++i) {
      const Fields drive = form.at("drives", i);
      JointDrive read;
      read.linear = drive.text("type") == "linear";
      read.by_acceleration = drive.text("mode", "acceleration") == "acceleration";
      read.axis = drive.index("axis", 3).value_or(0);
      read.position = sign * number_of(drive, "positionTarget").value_or(0);
      read.velocity = sign * number_of(drive, "velocityTarget").value_or(0);
      read.stiffness = number_of(drive, "stiffness").value_or(0);
      read.damping = number_of(drive, "damping").value_or(0);
      read.most = number_of(drive, "maxForce").value_or(endless);
      drives_.push_back(read);
    }
  }

  [[nodiscard]] Freedom freedom(bool linear) const {
    Freedom out;
    for (const Bound& bound : bounds_) {
      if (bound.linear != linear) continue;
      if (bound.locks())
        for (const std::size_t axis : bound.axes) out.locked[axis] = true;
      else if (bound.axes.size() == 1)
        out.bound[bound.axes[0]] = &bound;
      else
        out.shared = &bound;
    }
    return out;
  }

  [[nodiscard]] std::optional<Limits> limits(const Bound* bound, bool linear, const JointDescription& joint) const {
    if (!bound) return std::nullopt;
    Limits limits{bound->low, bound->high};
    const auto mass = masses_.reduced(joint);
    if (!bound->stiffness || !mass) return limits;
    const double moved = linear ? mass->linear : mass->angular, rate = std::sqrt(*bound->stiffness / moved);
    limits.hz = rate / (2 * std::numbers::pi);
    limits.zeta = bound->damping / (2 * moved * rate);
    return limits;
  }

  [[nodiscard]] std::optional<Motor> motor(bool linear, int axis, const JointDescription& joint) const {
    for (const JointDrive& drive : drives_) {
      if (drive.linear != linear || static_cast<int>(drive.axis) != axis) continue;
      const auto mass = masses_.reduced(joint);
      const double moved = drive.by_acceleration || !mass ? 1 : linear ? mass->linear : mass->angular;
      Motor motor;
      motor.speed = drive.velocity;
      motor.max_force = drive.most;
      if (drive.stiffness > 0) {
        const double rate = std::sqrt(drive.stiffness / moved);
        motor.position = drive.position;
        motor.hz = rate / (2 * std::numbers::pi);
        motor.zeta = drive.damping / (2 * moved * rate);
      }
      return motor;
    }
    return std::nullopt;
  }

  static void turn_frames(JointDescription& joint, int x, int y) {
    const Quat turn = onto(x, y);
    joint.frame_a.rotation = joint.frame_a.rotation * turn;
    joint.frame_b.rotation = joint.frame_b.rotation * turn;
  }

  /// @return whether the bounds make a kind of joint
  bool name_kind(JointDescription& joint) const {
    const Freedom ways = freedom(true), turns = freedom(false);
    if (ways.count() == 3) return name_turning(joint, turns);
    if (ways.count() == 2 && turns.count() == 3) {
      const int axis = ways.only(false);
      turn_frames(joint, axis, (axis + 1) % 3);
      joint.kind =
          SliderJoint{limits(ways.bound[static_cast<std::size_t>(axis)], true, joint), motor(true, axis, joint)};
      return true;
    }
    if (ways.count() == 2 && turns.count() == 2 && ways.only(false) != turns.only(false))
      return name_wheel(joint, ways, turns);
    if (ways.count() == 0 && turns.count() == 0 && ways.shared && ways.shared->axes.size() == 3 && !turns.shared) {
      const Bound& way = *ways.shared;
      if (way.stiffness && way.low == way.high)
        joint.kind = SpringJoint{way.low, *way.stiffness, way.damping};
      else
        joint.kind = DistanceJoint{*limits(&way, true, joint)};
      if (auto* held = std::get_if<DistanceJoint>(&joint.kind)) held->limits.low = std::max(0.0, held->limits.low);
      return true;
    }
    return false;
  }

  bool name_turning(JointDescription& joint, const Freedom& turns) const {
    const auto bound_of = [&](int axis) { return turns.bound[static_cast<std::size_t>(axis)]; };
    if (turns.count() == 3) {
      joint.kind = FixedJoint{};
    } else if (turns.count() == 2) {
      const int axis = turns.only(false);
      turn_frames(joint, axis, (axis + 1) % 3);
      joint.kind = HingeJoint{limits(bound_of(axis), false, joint), motor(false, axis, joint)};
    } else if (turns.count() == 1) {
      const int first = (turns.only(true) + 1) % 3, second = (first + 1) % 3;
      turn_frames(joint, first, second);
      joint.kind = UniversalJoint{limits(bound_of(first), false, joint), limits(bound_of(second), false, joint),
                                  motor(false, first, joint), motor(false, second, joint)};
    } else if (!turns.shared && !turns.bound[0] && !turns.bound[1] && !turns.bound[2]) {
      joint.kind = BallJoint{};
    } else {
      return name_limb(joint, turns);
    }
    return true;
  }

  bool name_limb(JointDescription& joint, const Freedom& turns) const {
    if (turns.shared && turns.shared->axes.size() != 2) return false;
    int axis = 0;  // of the twist
    if (turns.shared)
      axis = static_cast<int>(3 - turns.shared->axes[0] - turns.shared->axes[1]);
    else
      // An axis with different bounds on both sides, or without bounds, can only be the twist.
      for (int i = 2; i >= 0; --i) {
        const Bound* bound = turns.bound[static_cast<std::size_t>(i)];
        if (!bound || bound->low != -bound->high) axis = i;
      }
    turn_frames(joint, axis, (axis + 1) % 3);
    const auto half_angle = [&](int i) {
      const Bound* bound = turns.shared ? turns.shared : turns.bound[static_cast<std::size_t>(i)];
      return bound ? std::clamp(std::max(std::abs(bound->high), turns.shared ? 0 : std::abs(bound->low)), 0.0,
                                std::numbers::pi)
                   : std::numbers::pi;
    };
    SwingTwistJoint limb;
    limb.swing_y = half_angle((axis + 1) % 3);
    limb.swing_z = half_angle((axis + 2) % 3);
    limb.twist = limits(turns.bound[static_cast<std::size_t>(axis)], false, joint)
                     .value_or(Limits{-std::numbers::pi, std::numbers::pi});
    limb.twist.low = std::clamp(limb.twist.low, -std::numbers::pi, std::numbers::pi);
    limb.twist.high = std::clamp(limb.twist.high, -std::numbers::pi, std::numbers::pi);
    joint.kind = limb;
    return true;
  }

  bool name_wheel(JointDescription& joint, const Freedom& ways, const Freedom& turns) const {
    const int up = ways.only(false), axle = turns.only(false);
    const std::optional<Motor> spring = motor(true, up, joint);
    if (!spring || !spring->position) return false;
    turn_frames(joint, axle, up);
    joint.kind = WheelJoint{spring->hz, spring->zeta, limits(ways.bound[static_cast<std::size_t>(up)], true, joint),
                            motor(false, axle, joint)};
    return true;
  }

  const FileScene& scene_;
  Fields physics_;
  Masses masses_;
  std::vector<std::size_t> mover_;
  std::vector<char> has_body_;
  std::vector<Bound> bounds_;  // of the joint that is being read
  std::vector<JointDrive> drives_;
};

}  // namespace

std::vector<JointDescription> read_joints(const FileScene& scene, std::span<const ModelBody> bodies) {
  return JointReader(scene, bodies).read();
}

}  // namespace tweenfall::gltf::physics
