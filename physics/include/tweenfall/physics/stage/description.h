#pragma once

/// Everything a stage is made of, as plain values: what a document contains, or what a program fills in.

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/handoff/rule.h>
#include <tweenfall/physics/particles.h>
#include <tweenfall/physics/soft_body.h>
#include <tweenfall/physics/vehicle.h>
#include <tweenfall/physics/world.h>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tweenfall {

struct BodyDescription {
  Shape shape = {};
  std::optional<double> mass{};                     ///< kg; absent: density times volume
  double density = 1000;                            ///< kg/m^3
  std::optional<MassProperties> mass_properties{};  ///< instead of those of an even solid; only on nodes of scale 1
  double friction = 0.5;
  double restitution = 0;
  Combine friction_combine = Combine::usual;
  Combine restitution_combine = Combine::usual;
  double rolling_friction = 0;   ///< m
  double spinning_friction = 0;  ///< m
  Twist surface_velocity = {};   ///< of the surface relative to the body, at its center of mass, node axes
  bool sensor = false;
  std::optional<Detection> collision{};             ///< absent: as the other body says, or else the world
  std::uint64_t groups = 1;                         ///< one bit each
  std::uint64_t collides_with = ~std::uint64_t{0};  ///< groups
  double linear_damping = 0;                        ///< 1/s
  double angular_damping = 0;                       ///< 1/s
  bool fixed = false;
  std::optional<Drive>
      drive{};    ///< absent: keyed when the node or an ancestor is animated by a playing clip, else free
  Twist twist{};  ///< initial velocity of a free body at its center of mass, world axes
};

struct NodeDescription {
  std::string name;
  std::size_t parent = no_node;  ///< index into the description's nodes
  Pose rest = {};
  std::optional<BodyDescription> body{};
  std::string group{};
  std::optional<Color> color{};
};

/// A force of the stage's world, from time 0. Without a list of its own it also acts on bodies that are added later.
struct ForceDescription {
  Force force = Drag{};     ///< its body handles are ignored
  std::size_t a = no_node;  ///< node with a body: where a spring, a damper or a push acts, or whose attractor it is
  std::size_t b = no_node;  ///< the other end of a spring or a damper; `no_node`: the world
  std::vector<std::size_t> bodies;  ///< nodes with bodies, the only ones it acts on; empty: all
  Strength strength = {};           ///< over the stage's time
};

/// Holds two bodies, or a body and the world, to each other, from time 0 and through every hand-off. It does nothing
/// between ends that are both keyed or static.
struct JointDescription {
  std::string name;
  std::size_t a = no_node;  ///< node with a body; `no_node`: the world
  std::size_t b = no_node;  ///< node with a body, whose motion relative to a the joint limits
  Pose frame_a = {};        ///< on a's node, without its scale; or in the world
  Pose frame_b = {};        ///< on b's node
  JointKind kind = BallJoint{};
  double break_force = std::numeric_limits<double>::infinity();   ///< N
  double break_torque = std::numeric_limits<double>::infinity();  ///< N m
  bool collide = false;                                           ///< whether a and b may touch each other
  std::variant<std::monostate, when::At, when::Event> until{};    ///< when it lets go, unless it breaks earlier
};

/// Holds a node of a soft body, from time 0 on.
struct SoftPinDescription {
  std::uint32_t node = 0;       ///< node of the stage that it follows; `no_node`: the world
  std::size_t to = no_node;     ///< on that node, m; absent: where the node of the soft body is at time 0
  std::optional<Vec3> point{};  ///< on that node, m; absent: where the soft body has its node
  std::variant<std::monostate, when::At, when::Event> until{};  ///< when it lets go
};

/// A rope, a cloth or a volume, placed in the world.
struct SoftDescription {
  std::string name;
  SoftSettings soft = {};  ///< its own pins are ignored
  std::vector<SoftPinDescription> pins{};
  std::optional<Color> color{};
};

struct WheelDescription {
  std::string name;
  WheelSettings wheel = {};
  double torque = 0;  ///< of the engine at full throttle, N m
  double brake = 0;   ///< torque of the fully pressed brake, N m
  double lock = 0;    ///< largest steering angle, rad
};

/// Wheels that carry a body, and how the vehicle is driven over the stage's time.
struct VehicleDescription {
  std::string name;
  std::size_t chassis = no_node;  ///< node with a body
  Vec3 forward{1, 0, 0};          ///< on the chassis' node, unit
  Vec3 up{0, 1, 0};               ///< likewise, perpendicular to `forward`
  std::vector<WheelDescription> wheels;
  Strength throttle = 0;  ///< -1 to 1; values beyond are clamped
  Strength brake = 0;     ///< 0 to 1
  Strength steer = 0;     ///< -1 to 1, to the left
};

/// Emits particles at a node, along its path.
struct EmitterDescription {
  std::size_t node = no_node;                ///< the node it sits on; `no_node`: the world
  Vec3 position{0, 0, 0};                    ///< on the node, m
  Vec3 direction{0, 1, 0};                   ///< in which the particles leave, node axes, unit
  Curve<double> rate = Curve<double>(0.0);   ///< particles per second over the stage's time; never negative
  Curve<double> speed = Curve<double>(0.0);  ///< m/s
  double inherit = 1;                        ///< share of the node's own velocity that the particles inherit
  double spread = 0;                         ///< half angle of the cone in which they leave, rad, 0 to pi
  double speed_spread = 0;                   ///< the speed of a particle differs by up to this share, both ways
  double size = 0;                           ///< radius of the ball in which particles start, m
  double start = 0, end = 1e30;              ///< stage time, s
};

struct ParticlesDescription {
  std::string name;
  ParticleSettings settings = {};
  bool collide = true;  ///< whether they bounce off bodies
  std::vector<EmitterDescription> emitters;
  std::vector<ForceDescription> forces;  ///< drag, winds, vortices, fields, attractors of the world
  std::optional<Color> color{};
};

struct StageDescription {
  std::string name;
  std::vector<NodeDescription> nodes;
  std::vector<Clip> clips;
  std::vector<Play> plays;
  std::vector<GraphDescription> graphs;  ///< applied after the plays, each graph on top of the one before
  WorldSettings world = {};
  double step = 1.0 / 240;  ///< s
  std::vector<ForceDescription> forces;
  std::vector<JointDescription> joints;
  std::vector<SoftDescription> softs;
  std::vector<VehicleDescription> vehicles;
  std::vector<ParticlesDescription> particles;
  std::vector<std::pair<std::size_t, std::size_t>> ignored;  ///< nodes whose bodies pass through each other
  std::vector<Rule> rules;

  // Only for drawing
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<MeshInstance> mesh_instances;
};

}  // namespace tweenfall
