#include "gltf/physics/collision_systems.h"
#include "gltf/physics/read_physics.h"
#include "gltf/physics/written_physics.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace tweenfall::gltf::physics {

namespace {

constexpr double even_enough = 1e-6;

/// Mirrored or not.
bool is_even(const Vec3& scale) {
  const Vec3 size = scale.cwiseAbs();
  return (size.array() - size[0]).abs().maxCoeff() <= even_enough * size[0];
}

/// Whether a solid is rotationally symmetric about y.
bool is_round(const Solid& solid) {
  return !std::holds_alternative<Box>(solid) && !std::holds_alternative<Hull>(solid) &&
         !std::holds_alternative<TriangleMesh>(solid) && !std::holds_alternative<Plane>(solid);
}

std::optional<Combine> combine_of(const Fields& material, const char* name) {
  const std::string word = material.text(name);
  if (word.empty()) return std::nullopt;
  if (word == "average") return Combine::average;
  if (word == "minimum") return Combine::minimum;
  if (word == "maximum") return Combine::maximum;
  if (word == "multiply") return Combine::multiply;
  material.problems().repair(material.place_of(name), "\"" + word +
                                                          "\" is not average, minimum, maximum or multiply; "
                                                          "the default is used");
  return std::nullopt;
}

/// One collider or trigger, placed on the body it belongs to.
struct Part {
  std::size_t node = 0;
  Shape shape;
};

class BodyReader {
 public:
  explicit BodyReader(const FileScene& scene)
      : scene_(scene),
        shapes_(scene.root.inside("extensions").inside(shapes_extension)),
        physics_(scene.root.inside("extensions").inside(bodies_extension)),
        mover_(movers(scene)) {}

  std::vector<ModelBody> read() {
    find_parts();
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i)
      if (physics_of(scene_.root, i).has("motion")) static_cast<void>(colliders_[i]);
    std::map<std::size_t, bool> owners;  // whether it is a sensor
    for (const auto& [node, parts] : triggers_) owners.emplace(node, true);
    for (const auto& [node, parts] : colliders_) owners[node] = parts.empty() && owners.contains(node);
    for (const auto& [node, sensor] : owners) add(node, sensor);
    systems_.finish(bodies_);
    return std::move(bodies_);
  }

 private:
  [[nodiscard]] Fields physics_at(std::size_t node) const { return physics_of(scene_.root, node); }
  void repair(std::size_t node, const std::string& what) const {
    scene_.root.problems().repair(physics_at(node).place(), what);
  }

  void find_parts() {
    std::map<std::size_t, std::size_t> whole;  // number of a trigger's nodes
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i)
      for (const std::size_t part : physics_at(i).inside("trigger").indices("nodes", scene_.nodes.size()))
        whole.emplace(part, i);
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Fields physics = physics_at(i);
      for (const char* kind : {"collider", "trigger"}) {
        if (!physics.has(kind) || !physics.inside(kind).has("geometry")) continue;
        const std::string_view word = kind;
        std::size_t owner = mover_[i] != no_node ? mover_[i] : i;
        if (const auto found = whole.find(i); word == "trigger" && owner == i && found != whole.end())
          owner = found->second;
        if (std::optional<Shape> shape = shape_of(physics.inside(kind), i, owner))
          (word == "trigger" ? triggers_ : colliders_)[owner].push_back({i, std::move(*shape)});
      }
    }
  }

  void add(std::size_t node, bool sensor) {
    const Fields physics = physics_at(node);
    ModelBody body;
    body.node = node;
    body.body.sensor = sensor;
    const std::vector<Part>& parts = sensor ? triggers_[node] : colliders_[node];
    if (!sensor && triggers_.contains(node))
      repair(node, "has colliders and triggers; a body is one or the other, and its triggers were left out");
    const bool moves = physics.has("motion");
    if (moves) read_motion(physics.inside("motion"), body);
    body.body.fixed = body.body.fixed || (!moves && !scene_.animated[node]);
    if (parts.empty()) {
      repair(node, "moves without a collider: it has a ball of 1 cm here, which meets nothing");
      body.body.shape.solid = Sphere{0.01};
      body.body.collides_with = body.body.groups = 0;
    } else if (!take_shape(parts, body)) {
      return;
    }
    if (!parts.empty()) read_surface(physics_at(parts.front().node).inside(sensor ? "trigger" : "collider"), body.body);
    bodies_.push_back(std::move(body));
  }

  /// @return whether there is such a body here
  bool take_shape(const std::vector<Part>& parts, ModelBody& body) {
    const Vec3 scale = pose_within(scene_, body.node, no_node).scale;
    std::vector<Shape> shapes;
    for (const Part& part : parts) {
      if (!is_even(scale) && (is_round(part.shape.solid) || parts.size() > 1)) {
        repair(part.node,
               "is scaled unevenly, as round bodies and those of several parts cannot be; the body was left out");
        return false;
      }
      Shape shape = part.shape;
      if (is_scenery(shape.solid) && (parts.size() > 1 || !body.body.fixed) && !make_solid(part.node, shape)) continue;
      shapes.push_back(std::move(shape));
    }
    if (shapes.empty()) return false;
    body.body.shape = shapes.size() == 1 ? shapes.front() : Shape{Compound(std::move(shapes))};
    return true;
  }

  /// Replaces a surface by a solid that can move, if possible.
  bool make_solid(std::size_t node, Shape& shape) {
    const std::string what = kind_name(shape.solid);
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape.solid)) {
      try {
        shape.solid = Hull{ConvexHull(mesh->vertices())};
        repair(node, "is " + what + " that moves or is one part of many; its convex hull is taken");
        return true;
      } catch (const std::invalid_argument&) {
      }
    }
    repair(node, "is " + what + ", as only bodies that stand still and have no other part can be; it was left out");
    return false;
  }

  void read_motion(const Fields& motion, ModelBody& body) {
    const std::optional<double> mass = number_of(motion, "mass");
    if (mass && *mass < 0)
      motion.problems().add(motion.place_of("mass"), "must be at least 0 kg, not " + number_text(*mass));
    else if (mass && *mass > 0)
      body.body.mass = mass;
    const Quat turned = pose_within(scene_, body.node, no_node).rotation;
    body.body.twist.linear = turned * vector_of(motion, "linearVelocity", {0, 0, 0});
    body.body.twist.angular = turned * vector_of(motion, "angularVelocity", {0, 0, 0});
    const bool immovable = motion.flag("isKinematic") || mass == 0.0;
    body.keyed = immovable && scene_.animated[body.node];
    // Whether or not its clips play.
    if (body.keyed) body.body.drive = Drive::keyed();
    body.body.fixed = immovable && !body.keyed;
    if (body.body.fixed && !(body.body.twist.linear.isZero(0) && body.body.twist.angular.isZero(0)))
      motion.problems().repair(motion.place(), "has a velocity that nothing can change; it stands still here");
    if (immovable) body.body.twist = {};
    if (motion.has("gravityFactor") && number_of(motion, "gravityFactor") != 1.0)
      motion.problems().repair(motion.place_of("gravityFactor"), "was not read: bodies fall alike");
    if (!body.body.fixed) read_mass_properties(motion, body);
  }

  /// Center of mass and inertia, which are only used together.
  void read_mass_properties(const Fields& motion, ModelBody& body) {
    const auto refuse = [&](const char* name, const char* why) {
      motion.problems().repair(motion.place_of(name), std::string("was not read: ") + why);
    };
    if (!motion.has("inertiaDiagonal")) {
      for (const char* name : {"centerOfMass", "inertiaOrientation"})
        if (motion.has(name)) refuse(name, "without \"inertiaDiagonal\" a body is of even density");
      return;
    }
    const Vec3 diagonal = vector_of(motion, "inertiaDiagonal", {0, 0, 0});
    const Vec3 center = vector_of(motion, "centerOfMass", {0, 0, 0});
    const std::vector<double> turn = motion.numbers("inertiaOrientation", 4);
    const Quat axes = turn.size() == 4 ? Quat(turn[3], turn[0], turn[1], turn[2]) : Quat(1, 0, 0, 0);
    const bool can_be = diagonal.minCoeff() > 0 && 2 * diagonal.maxCoeff() <= (1 + 1e-9) * diagonal.sum() &&
                        std::abs(axes.norm() - 1) < 1e-3;
    if (!body.body.mass) {
      refuse("inertiaDiagonal", "without a mass a body is of even density");
    } else if (!can_be) {
      refuse("inertiaDiagonal", "no body has such an inertia; it is of even density");
    } else if (!pose_within(scene_, body.node, no_node).scale.isApprox(Vec3(1, 1, 1), 1e-9)) {
      refuse("inertiaDiagonal", "on a node that is scaled a body is of even density");
    } else {
      const Mat3 rotation = axes.normalized().toRotationMatrix();
      body.body.mass_properties =
          MassProperties{*body.body.mass, center, rotation * diagonal.asDiagonal() * rotation.transpose()};
      body.body.mass.reset();
    }
  }

  void read_surface(const Fields& collider, BodyDescription& body) {
    if (const auto index = collider.index("physicsMaterial", physics_.list("physicsMaterials").size())) {
      const Fields material = physics_.at("physicsMaterials", *index);
      const std::optional<double> still = number_of(material, "staticFriction"),
                                  sliding = number_of(material, "dynamicFriction");
      body.friction = std::max(0.0, sliding ? *sliding : still.value_or(body.friction));
      if (still && sliding && *still != *sliding)
        material.problems().repair(material.place(), "has two frictions; that of sliding holds for standing, too");
      body.restitution = std::clamp(number_of(material, "restitution").value_or(0), 0.0, 1.0);
      body.friction_combine = combine_of(material, "frictionCombine").value_or(Combine::usual);
      body.restitution_combine = combine_of(material, "restitutionCombine").value_or(Combine::usual);
    }
    const auto index = collider.index("collisionFilter", physics_.list("collisionFilters").size());
    if (!index) return;
    systems_.add(bodies_.size(), physics_.at("collisionFilters", *index));
  }

  std::optional<Shape> shape_of(const Fields& collider, std::size_t node, std::size_t owner) {
    const Fields geometry = collider.inside("geometry");
    const std::size_t problems_before = count_;
    const Pose place = pose_within(scene_, node, owner);
    std::optional<Solid> solid = solid_of(geometry, place.scale);
    if (!solid) {
      if (count_ == problems_before) repair(node, "has a geometry of a kind that is not read");
      return std::nullopt;
    }
    try {
      validate(*solid);
    } catch (const std::invalid_argument& fault) {
      scene_.root.problems().add(geometry.place(), fault.what());
      return std::nullopt;
    }
    return Shape{std::move(*solid), {place.position, place.rotation}};
  }

  std::optional<Solid> solid_of(const Fields& geometry, const Vec3& scale) {
    if (const auto index = geometry.index("shape", shapes_.list("shapes").size()))
      return implicit_solid(shapes_.at("shapes", *index), scale);
    if (const auto node = geometry.index("node", scene_.nodes.size()))
      return solid_of_points(geometry, points_of(*node, scale), geometry.flag("convexHull"));
    // As in drafts before 2024.
    if (const auto mesh = geometry.index("mesh", scene_.meshes.size())) {
      SurfaceMesh points;
      append(points, *mesh, {{0, 0, 0}, Quat::Identity(), scale});
      return solid_of_points(geometry, points, geometry.flag("convexHull"));
    }
    return std::nullopt;
  }

  std::optional<Solid> implicit_solid(const Fields& shape, const Vec3& scale) {
    const std::string type = shape.text("type");
    const Fields size = shape.inside(type.c_str());
    const Vec3 wide = scale.cwiseAbs();
    if (type == "box") return Box{0.5 * vector_of(size, "size", {1, 1, 1}).cwiseProduct(wide)};
    if (type == "plane") {
      if (size.has("sizeX") || size.has("sizeZ"))
        size.problems().repair(size.place(), "ends somewhere; here it has no end");
      return Plane{};
    }
    const double even = std::cbrt(wide.prod());
    if (!is_even(wide))
      shape.problems().repair(shape.place(),
                              "is scaled unevenly somewhere, as round shapes cannot be; the mean is taken");
    if (type == "sphere") return Sphere{even * number_of(size, "radius").value_or(0.5)};
    const double half_height = 0.5 * even * number_of(size, "height").value_or(0.5);
    const double bottom = even * number_of(size, "radiusBottom").value_or(0.25);
    const double top = even * number_of(size, "radiusTop").value_or(0.25);
    if (type == "capsule") {
      if (bottom == top) return Capsule{bottom, half_height};
      // The larger ball may hold the smaller.
      if (std::abs(bottom - top) >= 2 * half_height) return Sphere{std::max(bottom, top)};
      return TaperedCapsule{bottom, top, half_height};
    }
    if (type == "cylinder") {
      if (bottom == top) return Cylinder{bottom, half_height};
      if (top == 0) return Cone{bottom, half_height};
      shape.problems().repair(shape.place(), "is a cylinder with two radii; the larger is taken for both");
      return Cylinder{std::max(bottom, top), half_height};
    }
    return std::nullopt;
  }

  void append(SurfaceMesh& out, std::size_t mesh, const Pose& pose) const {
    for (const Mesh& primitive : scene_.meshes[mesh].primitives) {
      const auto first = static_cast<std::uint32_t>(out.positions.size());
      for (const Vec3& position : primitive.positions)
        out.positions.push_back(pose.position + pose.rotation * pose.scale.cwiseProduct(position));
      for (const std::uint32_t corner : primitive.triangles) out.triangles.push_back(first + corner);
    }
  }

  /// The points of the meshes of the node and its descendants, in its own space, scaled.
  [[nodiscard]] SurfaceMesh points_of(std::size_t node, const Vec3& scale) const {
    SurfaceMesh out;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      if (!scene_.nodes[i].mesh) continue;
      bool below = false;
      for (std::size_t at = i; at != no_node && !below; at = scene_.nodes[at].node.parent) below = at == node;
      if (!below) continue;
      append(out, *scene_.nodes[i].mesh, compose({{0, 0, 0}, Quat::Identity(), scale}, pose_within(scene_, i, node)));
    }
    return out;
  }

  std::optional<Solid> solid_of_points(const Fields& geometry, const SurfaceMesh& points, bool convex) {
    try {
      if (convex) return Hull{ConvexHull(points.positions)};
      return TriangleMesh(points);
    } catch (const std::invalid_argument& fault) {
      ++count_;
      geometry.problems().repair(geometry.place(), std::string("was left out: ") + fault.what());
      return std::nullopt;
    }
  }

  const FileScene& scene_;
  Fields shapes_, physics_;
  std::vector<std::size_t> mover_;
  std::map<std::size_t, std::vector<Part>> colliders_, triggers_;  // by the body they belong to
  CollisionSystems systems_;
  std::vector<ModelBody> bodies_;
  std::size_t count_ = 0;  // of geometries reported
};

}  // namespace

std::vector<ModelBody> read_bodies(const FileScene& scene) {
  return BodyReader(scene).read();
}

}  // namespace tweenfall::gltf::physics
