#include "gltf/physics/reduced_mass.h"
#include "gltf/physics/written_physics.h"

#include <nlohmann/json.hpp>

#include <numbers>

namespace tweenfall::gltf::physics {

namespace {

using Json = nlohmann::json;
using Axes = std::vector<int>;

/// A motor that holds its speed exactly is written as a damper: for a reduced mass of 1, 1/s.
constexpr double stiffest_damping = 1e6;

/// Collects the limits and drives of a joint.
class Form {
 public:
  explicit Form(const std::optional<ReducedMass>& mass) : mass_(mass) {}

  void lock(const char* kind, Axes axes) { limits_.push_back({{kind, std::move(axes)}, {"min", 0}, {"max", 0}}); }
  void lock_places() { lock("linearAxes", {0, 1, 2}); }

  void limit(const char* kind, Axes axes, const Limits& limits) {
    Json limit{{kind, std::move(axes)}};
    if (std::isfinite(limits.low)) limit["min"] = limits.low;
    if (std::isfinite(limits.high)) limit["max"] = limits.high;
    if (limits.hz > 0 && mass_) {
      const double mass = kind == std::string_view("linearAxes") ? mass_->linear : mass_->angular;
      const double rate = 2 * std::numbers::pi * limits.hz;
      limit["stiffness"] = mass * rate * rate;
      limit["damping"] = 2 * limits.zeta * mass * rate;
    }
    limits_.push_back(std::move(limit));
  }
  void limit(const char* kind, int axis, const std::optional<Limits>& limits) {
    if (limits) limit(kind, Axes{axis}, *limits);
  }

  void drive(const char* type, int axis, const std::optional<Motor>& motor) {
    if (!motor) return;
    Json drive{{"type", type}, {"mode", "acceleration"}, {"axis", axis}, {"velocityTarget", motor->speed}};
    if (motor->position) {
      const double rate = 2 * std::numbers::pi * motor->hz;
      drive["positionTarget"] = *motor->position;
      drive["stiffness"] = rate * rate;
      drive["damping"] = 2 * motor->zeta * rate;
    } else {
      drive["damping"] = stiffest_damping;
    }
    if (std::isfinite(motor->max_force)) drive["maxForce"] = motor->max_force;
    drives_.push_back(std::move(drive));
  }

  void spring(const SpringJoint& spring) {
    limits_.push_back({{"linearAxes", {0, 1, 2}},
                       {"min", spring.length},
                       {"max", spring.length},
                       {"stiffness", spring.stiffness},
                       {"damping", spring.damping}});
  }

  [[nodiscard]] std::string text() const {
    Json form = Json::object();
    if (!limits_.empty()) form["limits"] = limits_;
    if (!drives_.empty()) form["drives"] = drives_;
    return form.dump();
  }

 private:
  std::optional<ReducedMass> mass_;
  Json limits_ = Json::array(), drives_ = Json::array();
};

void tell(Form& form, const BallJoint&) {
  form.lock_places();
}
void tell(Form& form, const FixedJoint&) {
  form.lock_places();
  form.lock("angularAxes", {0, 1, 2});
}
void tell(Form& form, const HingeJoint& hinge) {
  form.lock_places();
  form.lock("angularAxes", {1, 2});
  form.limit("angularAxes", 0, hinge.limits);
  form.drive("angular", 0, hinge.motor);
}
void tell(Form& form, const SliderJoint& slider) {
  form.lock("angularAxes", {0, 1, 2});
  form.lock("linearAxes", {1, 2});
  form.limit("linearAxes", 0, slider.limits);
  form.drive("linear", 0, slider.motor);
}
void tell(Form& form, const DistanceJoint& distance) {
  form.limit("linearAxes", Axes{0, 1, 2}, distance.limits);
}
void tell(Form& form, const UniversalJoint& universal) {
  form.lock_places();
  form.lock("angularAxes", {2});
  form.limit("angularAxes", 0, universal.first_limits);
  form.limit("angularAxes", 1, universal.second_limits);
  form.drive("angular", 0, universal.first_motor);
  form.drive("angular", 1, universal.second_motor);
}
void tell(Form& form, const SwingTwistJoint& limb) {
  form.lock_places();
  if (limb.swing_y == limb.swing_z) {
    form.limit("angularAxes", Axes{1, 2}, {.low = 0, .high = limb.swing_y});
  } else {
    form.limit("angularAxes", 1, Limits{.low = -limb.swing_y, .high = limb.swing_y});
    form.limit("angularAxes", 2, Limits{.low = -limb.swing_z, .high = limb.swing_z});
  }
  form.limit("angularAxes", 0, limb.twist);
}
void tell(Form& form, const WheelJoint& wheel) {
  form.lock("linearAxes", {0});
  form.lock("linearAxes", {2});
  form.lock("angularAxes", {1, 2});
  form.limit("linearAxes", 1, wheel.suspension);
  form.drive("linear", 1, Motor{.position = 0.0, .hz = wheel.hz, .zeta = wheel.zeta});
  form.drive("angular", 0, wheel.motor);
}
void tell(Form& form, const SpringJoint& spring) {
  form.spring(spring);
}

}  // namespace

std::string joint_form(const Masses& masses, const JointDescription& joint) {
  if (std::holds_alternative<PulleyJoint>(joint.kind) || std::holds_alternative<GearJoint>(joint.kind)) return {};
  Form form(masses.reduced(joint));
  std::visit(
      [&](const auto& kind) {
        if constexpr (requires { tell(form, kind); }) tell(form, kind);
      },
      joint.kind);
  return form.text();
}

}  // namespace tweenfall::gltf::physics
