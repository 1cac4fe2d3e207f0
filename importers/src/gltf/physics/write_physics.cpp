#include "figures/shape_mesh.h"
#include "gltf/physics/written_physics.h"

#include <tweenfall/curves/reflection.h>

#include <Eigen/Eigenvalues>

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <variant>

namespace tweenfall::gltf::physics {

namespace {

using Json = nlohmann::json;

Json numbers(const Vec3& v) {
  return Json::array({v[0], v[1], v[2]});
}

bool stands_still(const Pose& pose) {
  return pose.position.isZero(0) && pose.rotation.vec().isZero(0);
}

/// A rotation that takes y to a unit direction.
Quat from_up(const Vec3& direction) {
  if (direction.y() < -1 + 1e-12) return {0, 1, 0, 0};
  const Vec3 axis = Vec3(0, 1, 0).cross(direction);
  return Quat(1 + direction.y(), axis.x(), axis.y(), axis.z()).normalized();
}

/// The center of mass, and the inertia by principal axes.
void write_mass_properties(const MassProperties& mass, Json& motion) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(mass.inertia);
  Mat3 axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  const Quat turn(axes);
  motion["centerOfMass"] = numbers(mass.center);
  motion["inertiaDiagonal"] = numbers(principal.eigenvalues());
  motion["inertiaOrientation"] = Json::array({turn.x(), turn.y(), turn.z(), turn.w()});
}

/// A list of distinct things, however often they are used.
class Listed {
 public:
  std::size_t add(const Json& thing) {
    const auto [known, fresh] = known_.emplace(thing.dump(), all_.size());
    if (fresh) all_.push_back(thing);
    return known->second;
  }
  [[nodiscard]] const Json& all() const { return all_; }

 private:
  std::map<std::string, std::size_t> known_;
  Json all_ = Json::array();
};

/// A solid that the extension has a shape for; null for all others.
Json implicit_shape(const Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&solid))
    return {{"type", "sphere"}, {"sphere", {{"radius", sphere->radius}}}};
  if (const auto* box = std::get_if<Box>(&solid))
    return {{"type", "box"}, {"box", {{"size", numbers(2 * box->half_extents)}}}};
  if (std::holds_alternative<Plane>(solid)) return {{"type", "plane"}, {"plane", Json::object()}};
  const auto turned = [](const char* type, double half_height, double bottom, double top) {
    return Json{{"type", type}, {type, {{"height", 2 * half_height}, {"radiusBottom", bottom}, {"radiusTop", top}}}};
  };
  if (const auto* capsule = std::get_if<Capsule>(&solid))
    // A capsule's height must be above 0.
    return capsule->half_height > 0 ? turned("capsule", capsule->half_height, capsule->radius, capsule->radius)
                                    : Json{{"type", "sphere"}, {"sphere", {{"radius", capsule->radius}}}};
  if (const auto* tapered = std::get_if<TaperedCapsule>(&solid))
    return turned("capsule", tapered->half_height, tapered->bottom_radius, tapered->top_radius);
  if (const auto* cylinder = std::get_if<Cylinder>(&solid))
    return turned("cylinder", cylinder->half_height, cylinder->radius, cylinder->radius);
  if (const auto* cone = std::get_if<Cone>(&solid)) return turned("cylinder", cone->half_height, cone->radius, 0);
  return {};
}

const char* combine_word(Combine combine, const char* usual) {
  switch (combine) {
    case Combine::average:
      return "average";
    case Combine::minimum:
      return "minimum";
    case Combine::multiply:
      return "multiply";
    case Combine::maximum:
      return "maximum";
    case Combine::geometric_mean:
      return nullptr;
    case Combine::usual:
      break;
  }
  return usual;
}

class PhysicsWriter {
 public:
  PhysicsWriter(const Model& model, std::size_t nodes, std::size_t meshes, BufferWriter& buffer)
      : model_(model),
        masses_(model.nodes.size(), model.bodies),
        first_node_(nodes),
        first_mesh_(meshes),
        buffer_(buffer) {
    for (const Node& node : model.nodes)
      scales_.push_back(node.parent == no_node ? node.rest.scale : scales_[node.parent].cwiseProduct(node.rest.scale));
    for (const ModelBody& body : model.bodies) groups_ |= body.body.groups;
    for (const ModelBody& body : model.bodies) shunned_ |= ~body.body.collides_with & groups_;
    for (const auto& [a, b] : model.ignored) {
      // A body that has a system of its own already needs no second one.
      const bool of_b = own_.contains(b) && !own_.contains(a);
      const std::size_t owner = of_b ? b : a, other = of_b ? a : b;
      own_.insert(owner);
      passes_[other].insert(owner);
    }
  }

  void write(const ModelBody& body) {
    if (!body.body.fixed) {
      Json& motion = of_nodes_[body.node]["motion"] = Json::object();
      if (body.keyed) motion["isKinematic"] = true;
      if (!is_scenery(body.body.shape.solid)) {
        const double scaled = scales_[body.node].prod();
        motion["mass"] = body.body.mass_properties
                             ? body.body.mass_properties->mass
                             : body.body.mass.value_or(body.body.density * volume(body.body.shape.solid) * scaled);
      }
      if (body.body.mass_properties) write_mass_properties(*body.body.mass_properties, motion);
      const Quat from_world = model_.nodes[body.node].rest.rotation.conjugate();
      if (!body.body.twist.linear.isZero(0)) motion["linearVelocity"] = numbers(from_world * body.body.twist.linear);
      if (!body.body.twist.angular.isZero(0)) motion["angularVelocity"] = numbers(from_world * body.body.twist.angular);
    }
    std::vector<std::size_t> triggers;
    const Shape& shape = body.body.shape;
    if (const auto* compound = std::get_if<Compound>(&shape.solid)) {
      for (const Shape& part : compound->parts())
        write_collider(body,
                       {part.solid,
                        {shape.offset.position + shape.offset.rotation * part.offset.position,
                         shape.offset.rotation * part.offset.rotation}},
                       triggers);
      if (body.body.sensor) of_nodes_[body.node]["trigger"]["nodes"] = triggers;
    } else {
      write_collider(body, shape, triggers);
    }
  }

  void write(const JointDescription& joint) {
    const std::string form = joint_form(masses_, joint);
    if (form.empty()) return;
    const std::size_t index = joints_.add(Json::parse(form));
    const std::size_t a = add_frame(joint.name + " a", joint.a, joint.frame_a);
    const std::size_t b = add_frame(joint.name, joint.b, joint.frame_b);
    // The pose of b's frame relative to a's is limited, so a is the extension's first node.
    Json& said = of_nodes_[a]["joint"];
    said = {{"connectedNode", b}, {"joint", index}};
    if (joint.collide) said["enableCollision"] = true;
  }

  WrittenPhysics finish() {
    for (const auto& [node, physics] : of_nodes_) written_.of_nodes.emplace(node, physics.dump());
    if (!shapes_.all().empty()) written_.shapes = Json{{"shapes", shapes_.all()}}.dump();
    Json physics = Json::object();
    if (!materials_.all().empty()) physics["physicsMaterials"] = materials_.all();
    if (!filters_.all().empty()) physics["collisionFilters"] = filters_.all();
    if (!joints_.all().empty()) physics["physicsJoints"] = joints_.all();
    if (!of_nodes_.empty()) written_.physics = physics.dump();
    return std::move(written_);
  }

 private:
  std::size_t add_node(PlacedNode node) {
    written_.nodes.push_back(std::move(node));
    return first_node_ + written_.nodes.size() - 1;
  }

  std::size_t add_frame(const std::string& name, std::size_t node, const Pose& frame) {
    Pose pose{frame.position, frame.rotation};
    // A joint's frames do not include the scales of its nodes.
    if (node != no_node) {
      pose.position = pose.position.cwiseQuotient(scales_[node]);
      pose.rotation = pose::reflected_by(pose::reflection_of(scales_[node]), pose.rotation);
    }
    return add_node({name, node, pose});
  }

  /// Whether the mesh drawn for a node is exactly the solid's own surface.
  [[nodiscard]] bool wears(std::size_t node, const Shape& shape) const {
    const Mesh* worn = nullptr;
    for (const MeshInstance& instance : model_.instances) {
      if (instance.node != node) continue;
      if (worn || instance.skin != no_node) return false;
      worn = &model_.meshes[instance.mesh];
    }
    for (const Node& child : model_.nodes)
      if (child.parent == node) return false;
    return worn && worn->morphs.empty() && worn->positions == figures::shape_mesh(shape).positions;
  }

  Json geometry_of(const Solid& solid) {
    if (const Json shape = implicit_shape(solid); !shape.is_null()) return {{"shape", shapes_.add(shape)}};
    const Mesh mesh = figures::shape_mesh({solid});
    std::vector<double> positions;
    positions.reserve(3 * mesh.positions.size());
    for (const Vec3& position : mesh.positions)
      positions.insert(positions.end(), {position[0], position[1], position[2]});
    const std::size_t accessor = buffer_.add_floats(positions, "VEC3", true, vertex_target);
    written_.meshes.push_back({accessor, buffer_.add_indices(mesh.triangles, mesh.positions.size())});
    PlacedNode holder{"collider", no_node};
    holder.mesh = first_mesh_ + written_.meshes.size() - 1;
    holder.in_scene = false;
    Json geometry{{"node", add_node(std::move(holder))}};
    if (std::holds_alternative<Hull>(solid)) geometry["convexHull"] = true;
    return geometry;
  }

  void write_collider(const ModelBody& body, const Shape& shape, std::vector<std::size_t>& triggers) {
    Pose place = shape.offset;
    if (const auto* plane = std::get_if<Plane>(&shape.solid)) {
      place.position += place.rotation * (plane->normal * plane->offset);
      place.rotation = place.rotation * from_up(plane->normal);
    }
    const bool part = std::holds_alternative<Compound>(body.body.shape.solid);
    const bool worn = !part && implicit_shape(shape.solid).is_null() && wears(body.node, shape);
    std::size_t node = body.node;
    if (worn) place = {};
    if (part || !stands_still(place))
      node = add_node({model_.nodes[body.node].name + " collider", body.node, {place.position, place.rotation}});
    Json collider{{"geometry", worn ? Json{{"node", node}} : geometry_of(shape.solid)}};
    if (worn && std::holds_alternative<Hull>(shape.solid)) collider["geometry"]["convexHull"] = true;
    if (const Json filter = filter_of(body); !filter.is_null()) collider["collisionFilter"] = filters_.add(filter);
    if (!body.body.sensor) collider["physicsMaterial"] = materials_.add(material_of(body.body));
    of_nodes_[node][body.body.sensor ? "trigger" : "collider"] = std::move(collider);
    triggers.push_back(node);
  }

  static Json material_of(const BodyDescription& body) {
    Json material{
        {"staticFriction", body.friction}, {"dynamicFriction", body.friction}, {"restitution", body.restitution}};
    // Frictions are usually combined by their geometric mean, for which the extension has no word.
    if (const char* word = combine_word(body.friction_combine, nullptr)) material["frictionCombine"] = word;
    if (const char* word = combine_word(body.restitution_combine, "maximum")) material["restitutionCombine"] = word;
    return material;
  }

  /// Bodies that pass through a single other one do not collide with the system that this one has for itself.
  [[nodiscard]] Json filter_of(const ModelBody& body) const {
    const auto systems = [](std::uint64_t groups) {
      Json names = Json::array();
      for (int bit = 0; bit < 64; ++bit)
        if (groups >> bit & 1) names.push_back("group " + std::to_string(bit));
      return names;
    };
    const auto own_system = [this](std::size_t node) { return "body " + model_.nodes[node].name; };
    const std::uint64_t groups = body.body.groups;
    Json in = systems(groups), apart = systems(~body.body.collides_with & groups_);
    if (own_.contains(body.node)) in.push_back(own_system(body.node));
    if (const auto passes = passes_.find(body.node); passes != passes_.end())
      for (const std::size_t other : passes->second) apart.push_back(own_system(other));
    // Where others do not collide with the first group, its bodies must name it.
    if (groups == 1 && in.size() == 1 && apart.empty() && (shunned_ & 1) == 0) return {};
    Json filter = Json::object();
    if (!in.empty()) filter["collisionSystems"] = in;
    // A body in no group meets nothing.
    if (groups == 0) filter["collideWithSystems"] = Json::array();
    if (!apart.empty()) filter["notCollideWithSystems"] = apart;
    return filter;
  }

  const Model& model_;
  Masses masses_;
  std::size_t first_node_, first_mesh_;
  BufferWriter& buffer_;
  std::vector<Vec3> scales_;                ///< of each node's space, including those of its ancestors
  std::uint64_t groups_ = 0, shunned_ = 0;  ///< that contain some body; of these, with which some body does not collide
  std::set<std::size_t> own_;               ///< nodes with a system of their own
  std::map<std::size_t, std::set<std::size_t>> passes_;  ///< by node, which of these its body passes through
  std::map<std::size_t, Json> of_nodes_;
  Listed shapes_, materials_, filters_, joints_;
  WrittenPhysics written_;
};

}  // namespace

WrittenPhysics write_physics(const Model& model, std::size_t nodes, std::size_t meshes, BufferWriter& buffer) {
  PhysicsWriter writer(model, nodes, meshes, buffer);
  for (const ModelBody& body : model.bodies) writer.write(body);
  for (const JointDescription& joint : model.joints) writer.write(joint);
  return writer.finish();
}

}  // namespace tweenfall::gltf::physics
