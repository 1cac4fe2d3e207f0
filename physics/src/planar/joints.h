#pragma once

#include <cstdint>
#include <vector>

#include "planar/body.h"
#include "planar/contacts/contact_block.h"

namespace tweenfall::planar::inner {

/// Joints through a step, one after the other.
class JointRows {
 public:
  JointRows(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups, std::vector<Joint>& joints, double h,
            double warmth);

  /// With the impulses of the sub-step before.
  void begin_sub_step(const std::vector<BodyRow>& displacements, std::vector<BodyRow>& velocities);
  void solve(std::vector<BodyRow>& velocities, bool soft);
  void end_sub_step();

 private:
  struct Row {
    Joint* joint = nullptr;
    std::uint32_t a = 0, b = 0;
    double inverse_mass_a = 0, inverse_mass_b = 0, inverse_moment_a = 0, inverse_moment_b = 0;
    Vec2 center_a{0, 0}, center_b{0, 0};  ///< at the start of the step; of the world its anchor
    double angle_a = 0, angle_b = 0;
    Vec2 local_a{0, 0}, local_b{0, 0};  ///< anchors from the centers of mass, node axes
    // As the bodies lie in the sub-step
    Vec2 arm_a{0, 0}, arm_b{0, 0}, apart{0, 0};
    double turned = 0;            ///< b against a
    Vec2 along{1, 0};             ///< of a distance
    double length = 0, mass = 0;  ///< of a distance
  };
  void push(const Row& row, const Vec2& impulse, std::vector<BodyRow>& velocities) const;
  void twist(const Row& row, double impulse, std::vector<BodyRow>& velocities) const;
  [[nodiscard]] Vec2 parting(const Row& row, const std::vector<BodyRow>& velocities) const;
  void hold(Row& row, const Hinge& hinge, std::vector<BodyRow>& velocities, bool soft) const;
  void hold(Row& row, const Distance& distance, std::vector<BodyRow>& velocities, bool soft) const;

  std::vector<Row> rows_;
  double h_ = 0;
  double rate_ = 0, firm_ = 1, giving_ = 0;
};

}  // namespace tweenfall::planar::inner
