#pragma once

/// Joints: how two bodies, or a body and the world, may still move relative to each other.
///
/// A joint has a frame on each of its two ends. It holds the frames together except for the coordinates that its kind
/// leaves free: an angle about the frames' x axis, a distance along it, and so on. Coordinates describe b's frame
/// relative to a's; they can be limited and driven by motors.

#include <tweenfall/curves/pose.h>
#include <tweenfall/physics/force.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

namespace tweenfall {

struct JointId {
  std::uint32_t index = 0xffffffffu;
  std::uint32_t generation = 0;  ///< so that the handle of a removed joint is not mistaken for its successor
  bool operator==(const JointId&) const = default;
};

/// Bounds of one coordinate.
struct Limits {
  double low = 0, high = 0;  ///< rad or m; low <= high
  double hz = 0;             ///< frequency of a spring in place of the bound; 0: a hard stop
  double zeta = 1;           ///< damping ratio of that spring
};

/// Drives one coordinate: with a speed, or by a spring toward a position.
struct Motor {
  double speed = 0;                ///< rad/s or m/s; with a position: the speed of that position
  std::optional<double> position;  ///< rad or m
  double hz = 5;                   ///< of the spring toward the position, cycles per second; > 0
  double zeta = 1;                 ///< its damping ratio
  double max_force = std::numeric_limits<double>::infinity();  ///< N, or N m for an angle
};

/// The frames' origins stay together.
struct BallJoint {};

/// Turns about the x axis. Coordinate: the angle, including whole turns.
struct HingeJoint {
  std::optional<Limits> limits{};
  std::optional<Motor> motor{};
};

/// Slides along the x axis of a's frame, and does not turn. Coordinate: the displacement.
struct SliderJoint {
  std::optional<Limits> limits{};
  std::optional<Motor> motor{};
};

/// A weld: nothing moves.
struct FixedJoint {};

/// The distance of the frames' origins stays within limits (a rope has only an upper one, a rod has two equal ones).
/// Coordinate: the distance.
struct DistanceJoint {
  Limits limits{0, std::numeric_limits<double>::infinity()};  ///< m
};

/// Turns about the x axis of a's frame and the y axis of b's, which stay perpendicular. Coordinates: both angles.
struct UniversalJoint {
  std::optional<Limits> first_limits{}, second_limits{};
  std::optional<Motor> first_motor{}, second_motor{};
};

/// A ball joint for limbs: the x axis swings within an elliptic cone, and b twists about it.
/// Coordinates: the twist, and the swing's rotation vector about y and z.
struct SwingTwistJoint {
  double swing_y = 0, swing_z = 0;  ///< half angles of the cone: how far x turns about y, and about z, rad; 0 to pi
  Limits twist{};                   ///< within -pi to pi
  std::optional<Quat> toward{};     ///< rotation of b's frame in a's toward which a spring turns it
  double hz = 5, zeta = 1;          ///< of that spring
  double max_torque = std::numeric_limits<double>::infinity();  ///< of that spring, N m
};

/// A wheel b on a's suspension: turns about the x axis, and springs along the y axis of a's frame.
/// Coordinates: the angle, and the displacement along y.
struct WheelJoint {
  double hz = 2, zeta = 0.7;           ///< of the suspension toward 0
  std::optional<Limits> suspension{};  ///< m
  std::optional<Motor> motor{};        ///< of the angle
};

/// A rope from a over two pulleys to b: length at a plus ratio times length at b does not exceed `length`.
/// Coordinate: that sum.
struct PulleyJoint {
  Vec3 pulley_a{0, 0, 0}, pulley_b{0, 0, 0};  ///< in the world, m
  double ratio = 1;                           ///< > 0
  std::optional<double> length{};             ///< m; absent: as it is when added
};

/// Two bodies that each turn about the x axis of their own frame, held there by hinges of their own: b's angle is minus
/// `ratio` times a's. Coordinates: both angles since the joint was added, each along its body's own axis.
struct GearJoint {
  double ratio = 1;  ///< teeth of a's wheel divided by those of b's; negative for wheels that turn the same way; not 0
};

/// A damped spring between the frames' origins, of any stiffness. Coordinate: the distance.
struct SpringJoint {
  double length = 0;     ///< at rest, m
  double stiffness = 0;  ///< N/m
  double damping = 0;    ///< N s/m
};

using JointKind = std::variant<BallJoint, HingeJoint, SliderJoint, FixedJoint, DistanceJoint, UniversalJoint,
                               SwingTwistJoint, WheelJoint, PulleyJoint, GearJoint, SpringJoint>;

struct JointSettings {
  BodyId a = {};      ///< the default handle means the world
  BodyId b = {};      ///< the body whose motion relative to a the joint limits
  Pose frame_a = {};  ///< on a's node, or in the world; its scale is ignored
  Pose frame_b = {};  ///< on b's node
  JointKind kind = BallJoint{};
  double break_force = std::numeric_limits<double>::infinity();   ///< N: a greater force on b in a step breaks it
  double break_torque = std::numeric_limits<double>::infinity();  ///< N m
  bool collide = false;                                           ///< whether a and b may touch each other
};

/// The state of a joint after a step.
struct JointReading {
  Vec3 force{0, 0, 0};               ///< of the joint on b, mean over the last step, world axes, N
  Vec3 torque{0, 0, 0};              ///< on b about its frame's origin, N m
  int coordinates = 0;               ///< how many coordinates the kind has
  std::array<double, 3> position{};  ///< of the coordinates, rad or m
  std::array<double, 3> rate{};      ///< rad/s or m/s, exact for the velocities of the bodies
  double gap = 0;                    ///< distance between the points that the joint should hold together, m
};

/// Frames of a joint at a point of the world, with its x axis along `axis`, for bodies in their present poses.
struct JointFrames {
  Pose a, b;
};
/// @param a, b   poses of the two nodes; the identity for the world
/// @param point  world, m
/// @param axis   world, any length; not zero
/// @param second  world: the y axis points as close to it as possible; zero: anywhere
/// @throws std::invalid_argument for an axis without length or numbers that are not finite
[[nodiscard]] JointFrames joint_frames(const Pose& a, const Pose& b, const Vec3& point,
                                       const Vec3& axis = Vec3(1, 0, 0), const Vec3& second = Vec3(0, 0, 0));

}  // namespace tweenfall
