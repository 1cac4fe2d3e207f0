#include "document/content.h"
#include "document/read/read_hull.h"
#include "document/read/values.h"

#include <limits>

namespace tweenfall::document {

namespace {

Solid read_solid(const JsonValue& shape, Problems& problems) {
  if (const JsonValue sphere = usable(shape, "sphere")) return Sphere{number_in(sphere, "radius", 0.5)};
  if (const JsonValue box = usable(shape, "box")) return Box{Vec3(vector_in(box, "size", Vec3(1, 1, 1)) / 2)};
  if (const JsonValue capsule = usable(shape, "capsule"))
    return Capsule{number_in(capsule, "radius", 0.25), number_in(capsule, "height", 1) / 2};
  if (const JsonValue plane = usable(shape, "plane")) {
    Plane out;
    out.offset = number_in(plane, "offset", 0);
    if (const JsonValue normal = usable(plane, "normal"))
      if (const std::optional<Vec3> unit = axis_of(normal, problems)) out.normal = *unit;
    return out;
  }
  if (const std::optional<Hull> hull = read_hull(shape, problems)) return *hull;
  return Sphere{};
}

}  // namespace

Drive read_drive(const JsonValue& drive) {
  if (drive.is(JsonValue::Kind::text)) return drive.text() == "keyed" ? Drive::keyed() : Drive::free();
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return {.hz = number_in(drive, "hz", 1),
          .zeta = number_in(drive, "zeta", 1),
          .max_force = number_in(drive, "max_force", unlimited),
          .max_torque = number_in(drive, "max_torque", unlimited)};
}

BodyDescription read_body(const JsonValue& value, Problems& problems) {
  BodyDescription body;
  const JsonValue shape = usable(value, "shape");
  if (shape) body.shape.solid = read_solid(shape, problems);
  if (const JsonValue offset = usable(value, "offset")) {
    body.shape.offset.position = vector_in(offset, "position", Vec3(0, 0, 0));
    if (const JsonValue rotation = usable(offset, "rotation"))
      body.shape.offset.rotation =
          rotation_of(rotation, order_of(text_in(rotation, "order", "XYZ")), problems).value_or(Quat(1, 0, 0, 0));
  }
  if (const JsonValue mass = usable(value, "mass")) body.mass = mass.number();
  body.density = number_in(value, "density", body.density);
  body.friction = number_in(value, "friction", body.friction);
  body.restitution = number_in(value, "restitution", body.restitution);
  body.rolling_friction = number_in(value, "rolling_friction", body.rolling_friction);
  body.linear_damping = number_in(value, "linear_damping", body.linear_damping);
  body.angular_damping = number_in(value, "angular_damping", body.angular_damping);
  body.fixed = flag_in(value, "static", false);
  if (const JsonValue drive = usable(value, "drive")) body.drive = read_drive(drive);
  body.twist.linear = vector_in(value, "velocity", Vec3(0, 0, 0));
  const Vec3 spin = vector_in(value, "angular_velocity", Vec3(0, 0, 0));
  body.twist.angular = Vec3(radians(spin[0]), radians(spin[1]), radians(spin[2]));

  if (shape && std::holds_alternative<Plane>(body.shape.solid) && !body.fixed) {
    problems.add(shape, "a plane has no mass, so it cannot move; say \"static\": true");
  }
  if (body.fixed) {
    for (const char* moving : {"drive", "velocity", "angular_velocity", "mass", "density"})
      if (const JsonValue given = usable(value, moving))
        problems.add(given, in_quotes(moving) + " means nothing for a static body; leave it or \"static\" out");
  }
  return body;
}

}  // namespace tweenfall::document
