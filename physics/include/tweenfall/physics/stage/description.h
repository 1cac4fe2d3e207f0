#pragma once

/// Everything a stage is made of, as plain values: what a document says, or what a program fills in.

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/handoff/rule.h>
#include <tweenfall/physics/soft_body.h>
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
  std::optional<MassProperties> mass_properties{};  ///< instead of those of an even solid; on nodes of scale 1
  double friction = 0.5;
  double restitution = 0;
  Combine friction_combine = Combine::usual;
  Combine restitution_combine = Combine::usual;
  double rolling_friction = 0;   ///< m
  double spinning_friction = 0;  ///< m
  Twist surface_velocity = {};   ///< of the surface against the body, at its center of mass, node axes
  bool sensor = false;
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

/// A force of the stage's world, from time 0. Of those who come later one without a list of its own acts on all, too.
struct ForceDescription {
  Force force = Drag{};     ///< its handles are not read
  std::size_t a = no_node;  ///< node with a body: what a spring, a damper or a push is at, whose an attractor is
  std::size_t b = no_node;  ///< the other end of a spring or a damper; `no_node`: the world
  std::vector<std::size_t> bodies;  ///< nodes with bodies on whom alone it acts; none: all
  Strength strength = {};           ///< over the stage's time
};

/// What holds two bodies, or a body and the world, to each other, from time 0 and through every hand-off. Between ends
/// that are both keyed or static it does nothing.
struct JointDescription {
  std::string name;
  std::size_t a = no_node;  ///< node with a body; `no_node`: the world
  std::size_t b = no_node;  ///< node with a body, which moves against a
  Pose frame_a = {};        ///< on a's node, its scale left out; or in the world
  Pose frame_b = {};        ///< on b's node
  JointKind kind = BallJoint{};
  double break_force = std::numeric_limits<double>::infinity();   ///< N
  double break_torque = std::numeric_limits<double>::infinity();  ///< N m
  bool collide = false;                                           ///< whether a and b may touch each other
  std::variant<std::monostate, when::At, when::Event> until{};    ///< when it lets go, unless it breaks before
};

/// Holds a node of a soft body, from time 0 on.
struct SoftPinDescription {
  std::uint32_t node = 0;       ///< of the soft body
  std::size_t to = no_node;     ///< node of the stage, which it follows; `no_node`: the world
  std::optional<Vec3> point{};  ///< on that node, m; absent: where the soft body has its node
  std::variant<std::monostate, when::At, when::Event> until{};  ///< when it lets go
};

/// A rope, a cloth or a volume, placed in the world.
struct SoftDescription {
  std::string name;
  SoftSettings soft = {};  ///< its own pins are not read
  std::vector<SoftPinDescription> pins{};
  std::optional<Color> color{};
};

struct StageDescription {
  std::string name;
  std::vector<NodeDescription> nodes;
  std::vector<Clip> clips;
  std::vector<Play> plays;
  std::vector<GraphDescription> graphs;  ///< over the plays, each over the one before
  WorldSettings world = {};
  double step = 1.0 / 240;  ///< s
  std::vector<ForceDescription> forces;
  std::vector<JointDescription> joints;
  std::vector<SoftDescription> softs;
  std::vector<std::pair<std::size_t, std::size_t>> ignored;  ///< nodes whose bodies pass through each other
  std::vector<Rule> rules;

  // Only for drawing
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<MeshInstance> mesh_instances;
};

}  // namespace tweenfall
