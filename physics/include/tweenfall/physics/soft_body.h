#pragma once

/// Soft bodies: ropes, cloth and volumes of point masses, which a world steps together with its rigid bodies.
///
/// A soft body consists of nodes and of constraints between them: edges that resist stretching, bends that resist
/// bending, and volumes that resist squeezing. One description serves two solvers: `springs` takes all of them as
/// forces and finds the end of each sub-step by backward Euler; `positions` takes them as constraints with a compliance
/// (XPBD). Only the latter supports infinite stiffness. Nodes collide with rigid bodies as balls of the soft body's
/// radius, and both are pushed. Against bodies thin enough to slip between nodes, triangles collide too, or edges
/// where there are no triangles; a body that moves by more than its own size plus that radius within a sub-step
/// may pass through. Nodes of a soft body with a `thickness` collide with each other, and with those of other soft
/// bodies that have one, at the mean of both. A rigid body that a soft one touches or holds stays awake.
///
///     World world;
///     const BodyId hand = world.add({.shape = {Sphere{0.1}}, .drive = Drive::keyed()});
///     SoftSettings line = rope({.from = {0, 0, 0}, .to = {1, 0, 0}, .links = 20});
///     line.pins = {{.node = 0, .body = hand}};
///     const SoftId id = add_soft(world, line);
///     world.step(1.0 / 240);

#include <tweenfall/curves/surface_mesh.h>
#include <tweenfall/physics/world.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace tweenfall {

enum class SoftSolver : std::uint8_t {
  positions,  ///< constraints, in many small sub-steps: Macklin, Müller, Chentanez, XPBD, 2016; Macklin et al., Small
              ///< Steps in Physics Simulation, 2019
  springs,    ///< forces, by backward Euler and conjugate gradients: Baraff, Witkin, Large Steps in Cloth Simulation,
              ///< 1998
};

/// Keeps two nodes at a distance, with energy stiffness/2 (distance - length)^2.
struct SoftEdge {
  std::uint32_t a = 0, b = 0;
  std::optional<double> length{};                              ///< at rest, m; absent: as the nodes are placed
  double stiffness = std::numeric_limits<double>::infinity();  ///< N/m
  double damping = 0;                                          ///< N s/m, along the edge
  double tear = std::numeric_limits<double>::infinity();       ///< strain (stretch over length) at which it tears
};

/// Keeps three or four nodes straight or flat, with energy stiffness/2 |sum of weight times position|^2, where the
/// weights sum to 0. Source: Bergou, Wardetzky, Harmon, Zorin, Grinspun, A Quadratic Bending Model for Inextensible
/// Surfaces, 2006.
struct SoftBend {
  std::array<std::uint32_t, 4> nodes{};
  std::array<double, 4> weights{};  ///< the last is 0 if there are only three nodes
  double stiffness = 0;             ///< N/m
};

/// Keeps the volume of a tetrahedron, with energy stiffness/2 (volume - rest)^2 / rest.
struct SoftTetrahedron {
  std::array<std::uint32_t, 4> nodes{};  ///< the first three counter-clockwise, seen from the fourth
  double stiffness = std::numeric_limits<double>::infinity();  ///< Pa
  std::optional<double> volume{};                              ///< at rest, m^3; absent: as the nodes are placed
};

/// The same for the volume inside a closed surface; gone once one of its triangles is torn.
struct SoftEnclosure {
  std::vector<std::array<std::uint32_t, 3>> triangles;         ///< counter-clockwise, seen from outside
  double stiffness = std::numeric_limits<double>::infinity();  ///< Pa
  std::optional<double> volume{};  ///< at rest, m^3; absent: as the nodes are placed. If larger, it is inflated
};

/// Holds a node to a point of a rigid body, or of the world; the node follows that point through every sub-step.
struct SoftPin {
  std::uint32_t node = 0;
  BodyId body = {};       ///< the default handle: the world
  Vec3 point{0, 0, 0};    ///< on the body's node, or in the world, m
  bool in_place = false;  ///< `point` is ignored: the node is held where it is when it is pinned
};

struct SoftSettings {
  std::vector<Vec3> positions;   ///< world, m
  std::vector<Vec3> velocities;  ///< m/s, one per node, or empty: at rest
  std::vector<double> masses;    ///< kg, one per node; each > 0
  std::vector<SoftEdge> edges;
  std::vector<SoftBend> bends;
  std::vector<SoftTetrahedron> tetrahedra;
  std::vector<SoftEnclosure> enclosures;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of the surface, for drawing; torn together with their edges
  std::vector<SoftPin> pins;
  SoftSolver solver = SoftSolver::positions;
  /// Longest sub-step, s; absent: 1/1920 for constraints, 1/240 for springs. All soft bodies of a world use the
  /// shortest; no step takes more than 1000 sub-steps.
  std::optional<double> sub_step{};
  /// Passes over all constraints in a sub-step of h seconds, there and back, 1 to 1000; absent: 1, or the 2 to 4 that
  /// stiff edges, bends and volumes take. Springs do not read it. An edge acts with at most iterations m / h^2 newtons
  /// per meter, where 1 / m is the sum of its ends' inverse masses; bends and enclosures likewise. Where there are
  /// tetrahedra, these and edges act with at most a quarter of that, and edges are damped by at most iterations m / 16
  /// h; by a single pass by a twentieth of m / h^2 and of m / h. `inspect` tells of what is stiffer. Only the edges of
  /// ropes and other chains, solved all at once, are as stiff as they are made. What bears far more than its own mass
  /// gives way by more than it should. What hangs with T newtons on nodes of mass m, its edges l long, falls where a
  /// sub-step is longer than about sqrt(iterations l m / T); `inspect` tells.
  std::optional<int> iterations{};
  double radius = 0.01;       ///< of the nodes when they collide with bodies, m; > 0
  double friction = 0.5;      ///< with bodies: sqrt(f1 f2)
  double linear_damping = 0;  ///< 1/s: how fast the speed of a free node decays
  bool collide = true;        ///< whether it collides with other bodies; pinned nodes never collide with rigid ones
  std::uint64_t groups = 1;   ///< as for bodies
  std::uint64_t collides_with = ~std::uint64_t{0};
  /// How near its nodes come to each other, m, or as near as they are at rest if that is less; 0: as near as they like.
  /// Nodes that move by more than this within a sub-step pass each other, and each heeds at most 64 others.
  double thickness = 0;
  /// Drag coefficient of its triangles: the world's winds press on them along their normals by 1/2 rho C A |v| v, v
  /// being the speed of the wind through the triangle. Only winds that name no bodies count; still air needs a wind of
  /// velocity 0.
  double air_drag = 0;
};

// Makers. All throw std::invalid_argument naming what is wrong; their result can be changed before it is added

struct RopeSettings {
  Vec3 from{0, 0, 0}, to{1, 0, 0};  ///< m
  int links = 20;                   ///< edges; 1 to 100,000
  double slack = 0;                 ///< extra length as a share of the distance between the ends; >= 0
  Vec3 down{0, -1, 0};              ///< the side to which the slack hangs at first; any length but 0
  double mass = 0.1;  ///< of the whole rope, kg; > 0. The two end nodes have half the mass of an inner one
  double stiffness = std::numeric_limits<double>::infinity();  ///< force at a strain of 1, N
  double damping = 0;                                          ///< the same at a strain rate of 1/s, N s
  double bending = 0;                                          ///< moment times radius of curvature, N m^2
  double tear = std::numeric_limits<double>::infinity();       ///< strain
};
/// A chain of nodes from one point to another, straight at rest.
[[nodiscard]] SoftSettings rope(const RopeSettings& settings);

struct ClothMaterial {
  double density = 0.2;                                   ///< kg/m^2; > 0
  double stretching = 2000;                               ///< force over width at a strain of 1, N/m
  double damping = 0;                                     ///< the same at a strain rate of 1/s, N s/m
  double bending = 0;                                     ///< energy over area at a curvature of 1/m, doubled: N m
  double tear = std::numeric_limits<double>::infinity();  ///< strain
};
struct ClothSettings {
  Vec3 corner{0, 0, 0};                  ///< m
  Vec3 along{1, 0, 0}, across{0, 0, 1};  ///< its two sides, from the corner, m
  int columns = 20, rows = 20;           ///< cells along and across; 1 to 1000
  ClothMaterial material = {};
};
/// A parallelogram; node (i, j) is number j (columns + 1) + i.
[[nodiscard]] SoftSettings cloth(const ClothSettings& settings);
/// A cloth from the surface of a mesh, flat at rest in bending; vertices at the same place become one node.
/// Source of the edges' stiffness: Van Gelder, Approximate Simulation of Elastic Membranes by Triangulated Spring
/// Meshes, 1998.
[[nodiscard]] SoftSettings cloth(const SurfaceMesh& mesh, const ClothMaterial& material = {});

struct VolumeMaterial {
  double density = 100;                                   ///< kg/m^3 of the filled volume; > 0
  double stiffness = 20'000;                              ///< of its edges: about Young's modulus, Pa
  double bulk = 100'000;                                  ///< against a change of volume, Pa
  double damping = 0;                                     ///< of its edges, Pa s
  double tear = std::numeric_limits<double>::infinity();  ///< strain
};
struct SoftBoxSettings {
  Pose pose = {};                     ///< of its center; scale is ignored
  Vec3 half_extents{0.5, 0.5, 0.5};   ///< m; each > 0
  std::array<int, 3> cells{4, 4, 4};  ///< 1 to 100 per axis; each cell is five tetrahedra
  VolumeMaterial material = {};
};
/// A box of tetrahedra; node (i, j, k) along x, y, z is number (k (cells y + 1) + j) (cells x + 1) + i.
[[nodiscard]] SoftSettings soft_box(const SoftBoxSettings& settings);

struct BalloonMaterial {
  ClothMaterial skin = {};
  double bulk = 100'000;  ///< of the volume inside against a change of volume, Pa
  double pressure = 1;    ///< volume at rest divided by that of the mesh; > 0
};
/// A closed mesh as a skin around a volume. @throws std::invalid_argument also for a mesh that is open or inside out
[[nodiscard]] SoftSettings balloon(const SurfaceMesh& mesh, const BalloonMaterial& material = {});

// In a world

struct SoftId {
  std::uint32_t index = 0xffffffffu;
  std::uint32_t generation = 0;
  bool operator==(const SoftId&) const = default;
};

// All below throw std::invalid_argument for a stale handle, and for impossible values, naming them. Those that change
// something throw std::logic_error when a field calls them.
SoftId add_soft(World& world, const SoftSettings& settings);
void remove_soft(World& world, SoftId soft);
[[nodiscard]] std::vector<SoftId> soft_bodies(const World& world);

[[nodiscard]] std::span<const Vec3> soft_positions(const World& world, SoftId soft);   ///< m, valid until a change
[[nodiscard]] std::span<const Vec3> soft_velocities(const World& world, SoftId soft);  ///< m/s
/// As it was added, with all rest lengths, rest volumes, sub-steps and iterations filled in.
[[nodiscard]] const SoftSettings& soft_settings(const World& world, SoftId soft);
[[nodiscard]] bool torn(const World& world, SoftId soft, std::size_t edge);
struct SoftTear {
  std::size_t edge = 0;
  double time = 0;      ///< of the world, at the end of the sub-step in which it tore, s
  Vec3 place{0, 0, 0};  ///< the middle of the edge then, m
};
/// What tore in the last step, in order; empty after the world was loaded.
[[nodiscard]] std::span<const SoftTear> soft_tears(const World& world, SoftId soft);
/// Triangles that are not torn.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> soft_triangles(const World& world, SoftId soft);

struct SoftEnergy {
  double kinetic = 0;  ///< J
  double elastic = 0;  ///< of everything of finite stiffness, with the stiffness with which it acts, J
  double weight = 0;   ///< against the world's gravity, 0 at the origin, J
};
[[nodiscard]] SoftEnergy soft_energy(const World& world, SoftId soft);

void apply_impulse(World& world, SoftId soft, std::uint32_t node, const Vec3& impulse);  ///< N s, at once

// Pins, by node
void pin(World& world, SoftId soft, const SoftPin& pin);    ///< replaces the pin of that node, if it has one
void unpin(World& world, SoftId soft, std::uint32_t node);  ///< the node keeps its velocity; without a pin, nothing
/// Where a pin to the world must be at the end of the next step, and its velocity there.
void lead_pin(World& world, SoftId soft, std::uint32_t node, const Vec3& point, const Vec3& velocity);
struct SoftPinReading {
  SoftPin pin;
  /// By the node on what holds it, mean over the last step, N. Where the world goes by explicit Euler this is of
  /// first order: what hangs at rest under a drag of c per second weighs c dt / (1 + c dt) of its weight too little.
  /// By all other integrators it weighs what it weighs.
  Vec3 force{0, 0, 0};
};
[[nodiscard]] std::vector<SoftPinReading> soft_pins(const World& world, SoftId soft);  ///< by node

/// Thrown when the position or velocity of a node is no longer a number, or exceeds 1e30.
class SoftNotFinite : public NotFinite {
 public:
  SoftNotFinite(SoftId soft, std::uint32_t node, double time);
  SoftId soft;
};

}  // namespace tweenfall
