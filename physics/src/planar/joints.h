#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planar/body.h"
#include "planar/contacts/contact_block.h"

namespace tweenfall::planar::inner {

/// The speed that a row of a joint sees, and moves: along_b . v_b - along_a . v_a + turn_b w_b - turn_a w_a.
struct Line {
  Vec2 along_a{0, 0}, along_b{0, 0};
  double turn_a = 0, turn_b = 0;

  /// Two points along one line.
  [[nodiscard]] static Line apart(const Vec2& along, double turn_a, double turn_b) {
    return {along, along, turn_a, turn_b};
  }
  /// Of angles alone.
  [[nodiscard]] static Line turning(double turn_a, double turn_b) { return {Vec2(0, 0), Vec2(0, 0), turn_a, turn_b}; }
};

/// Joints through a step, one after the other. What a joint holds is solved at once; what drives and bounds its
/// coordinate is solved for bodies that are held like this, and does not move what is held.
class JointRows {
 public:
  JointRows(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups, std::vector<Joint>& joints, double h,
            double warmth, double parts);

  [[nodiscard]] bool empty() const { return rows_.empty(); }
  /// Applies the impulses of the sub-step before.
  void begin_sub_step(const std::vector<BodyRow>& displacements, std::vector<BodyRow>& velocities);
  void solve(std::vector<BodyRow>& velocities, bool soft);
  void end_sub_step();
  void end_step(const std::vector<BodyRow>& displacements);
  /// Keeps `times` times the impulses for the next step; for 0 it keeps the earlier ones.
  void keep(double times);

 private:
  static constexpr std::size_t most_held = Joint::most_held;
  using Held = std::array<double, most_held>;

  /// How a coordinate moves.
  struct Way {
    Line line;
    double position = 0;      ///< m or rad
    Held carried{};           ///< the impulses that hold the rest, per unit of impulse along the coordinate
    double inverse_mass = 0;  ///< along the coordinate, while the rest is held; 0: nothing moves that way
  };
  struct Row {
    Joint* joint = nullptr;
    Held held_before{};  ///< at the start of the step, of the rows that hold, and of those that drive or bound
    double motor_before = 0, spring_before = 0, lower_before = 0, upper_before = 0;
    std::uint32_t a = 0, b = 0;
    double inverse_mass_a = 0, inverse_mass_b = 0, inverse_moment_a = 0, inverse_moment_b = 0;
    Vec2 center_a{0, 0}, center_b{0, 0};  ///< at the start of the step; for the world its anchor
    double angle_a = 0, angle_b = 0;
    Vec2 local_a{0, 0}, local_b{0, 0};  ///< anchors from the centers of mass, node axes
    // For the positions of the bodies in the sub-step
    Vec2 arm_a{0, 0}, arm_b{0, 0}, apart{0, 0};
    Vec2 point_a{0, 0};               ///< world
    double turned_a = 0, turned = 0;  ///< angle of a, and of b relative to a
    double moved_a = 0, moved_b = 0;  ///< angles by which they turned in the step
    std::size_t count = 0;            ///< number of rows that hold
    std::array<Line, most_held> held{};
    Held off{};                          ///< their errors, m or rad
    std::array<Held, most_held> root{};  ///< Cholesky factor of the rows that hold
    Way way;                             ///< of the coordinate
    std::optional<Way> turning;          ///< second coordinate of a wheel
  };

  void place(Row& row, const std::vector<BodyRow>& displacements) const;
  void hold(Row& row, const Line& line, double off) const;
  void hold_point(Row& row) const;
  void hold_on_line(Row& row, const Vec2& axis) const;
  void lay_out(Row& row, const Hinge& hinge) const;
  void lay_out(Row& row, const Distance& distance) const;
  void lay_out(Row& row, const Slider& slider) const;
  void lay_out(Row& row, const Weld& weld) const;
  void lay_out(Row& row, const Spring& spring) const;
  void lay_out(Row& row, const Pulley& pulley) const;
  void lay_out(Row& row, const Gear& gear) const;
  void lay_out(Row& row, const Wheel& wheel) const;
  void lay_out_distance(Row& row) const;
  void weigh(Row& row) const;
  void weigh(const Row& row, Way& way) const;

  [[nodiscard]] static double coupling(const Row& row, const Line& one, const Line& other);
  [[nodiscard]] static double speed_of(const Row& row, const Line& line, const std::vector<BodyRow>& velocities);
  static void push(const Row& row, const Line& line, double impulse, std::vector<BodyRow>& velocities);
  [[nodiscard]] static Held solved(const Row& row, Held right);

  [[nodiscard]] static double along_way(const Row& row);
  /// Changes an impulse along a coordinate, and with it all rows that hold.
  void give(Row& row, const Way& way, double& impulse, double next, std::vector<BodyRow>& velocities) const;
  void hold(Row& row, std::vector<BodyRow>& velocities, bool soft) const;
  void bound(Row& row, const Limits& limits, std::vector<BodyRow>& velocities, bool soft) const;
  void drive(Row& row, const Way& way, const Motor& motor, std::vector<BodyRow>& velocities) const;
  void suspend(Row& row, const Wheel& wheel, std::vector<BodyRow>& velocities) const;
  void pull(Row& row, const Spring& spring, std::vector<BodyRow>& velocities) const;
  /// The impulse of a spring with the force at the end of the sub-step.
  [[nodiscard]] double drawn(const Way& way, double impulse, double speed, double error, double wanted, double hz,
                             double zeta) const;

  std::vector<Row> rows_;
  double h_ = 0;
  double rate_ = 0, firm_ = 1, giving_ = 0;
};

}  // namespace tweenfall::planar::inner
