#include "figures/shape_mesh.h"
#include "recording/meshes/dressed.h"

#include <algorithm>

namespace tweenfall::recordings {

namespace {

/// A disk with a bar across it on either side, which show how it turns.
Mesh wheel_mesh(const std::string& name, double radius) {
  const double half_width = 0.3 * radius;
  const Vec3 bar(0.8 * radius, 1.15 * half_width, 0.12 * radius);
  Mesh mesh = figures::shape_mesh(
      {Compound({Shape{Cylinder{radius, half_width}}, Shape{Box{bar}}, Shape{Box{Vec3(bar.z(), bar.y(), bar.x())}}})});
  mesh.name = name;
  mesh.base_color = Color{Vec4(0.08, 0.08, 0.09, 1)};
  return mesh;
}

}  // namespace

void add_wheel_meshes(Dressed& out) {
  const std::vector<VehicleRecord> vehicles = out.recording.vehicles;
  for (const VehicleRecord& vehicle : vehicles) {
    const auto described = std::ranges::find(out.stage.vehicles, vehicle.name, &VehicleDescription::name);
    if (described == out.stage.vehicles.end() || vehicle.chassis >= out.recording.nodes.size() ||
        vehicle.frame.size() != out.recording.times.size())
      continue;
    const Vec3 left = described->up.cross(described->forward);
    for (std::size_t i = 0; i < vehicle.wheels.size() && i < described->wheels.size(); ++i) {
      const NodeRecord& chassis = out.recording.nodes[vehicle.chassis];
      NodeRecord node;
      node.owner = chassis.owner;
      for (std::size_t frame = 0; frame < vehicle.frame.size(); ++frame) {
        const StageWheel& wheel = vehicle.frame[frame].at(i);
        const Motion& carrier = chassis.world[frame].motion;
        Motion motion;
        motion.pose = wheel.pose;
        const Vec3 axle = carrier.pose.rotation * left;
        motion.twist.angular = carrier.twist.angular + wheel.reading.spin * axle;
        motion.twist.linear =
            carrier.twist.linear + carrier.twist.angular.cross(wheel.pose.position - carrier.pose.position);
        node.twist.push_back(motion.twist);
        node.world.push_back(child_of({}, motion));
      }
      const std::string name = vehicle.name + "/" + vehicle.wheels[i];
      out.add(std::move(node), name, wheel_mesh(name, described->wheels[i].wheel.radius));
    }
  }
}

}  // namespace tweenfall::recordings
