#pragma once

#include <span>
#include <vector>

#include "islands/blocks/island_body.h"
#include "joints/figure_lanes.h"
#include "joints/figure_plan.h"
#include "joints/joint_rows.h"

namespace tweenfall::joints {

/// Up to eight figures of one shape: with the same number of joints of the same kinds, connected in the same way, one
/// figure per lane. Lanes do not depend on each other.
class FigureGroup {
 public:
  /// A key for the shapes of figures.
  using Shape = std::vector<std::uint32_t>;

  /// Starts with one figure. @param whole  no other figure has any of its bodies
  void begin(const FigurePlan& plan, const Shape& shape, bool whole);
  /// Adds a figure. @return false if it has another shape, or no lane is left
  [[nodiscard]] bool take(const FigurePlan& plan, const Shape& shape);
  /// The shape: bodies at the ends of each joint, whether they move, the kind of the joint and how it is written.
  /// @param kinds  by the members' joint; see kind_number
  /// @param local  working memory: by place, 0 between calls
  static void find_shape(std::span<const FigurePlan::Member> members, std::span<const std::uint32_t> kinds,
                         std::vector<std::uint32_t>& local, Shape& shape);

  [[nodiscard]] static std::uint32_t kind_number(std::size_t kind, Writing writing) {
    return static_cast<std::uint32_t>(kind) + kinds_room * static_cast<std::uint32_t>(writing);
  }
  /// No other figure has any of its bodies.
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] int lanes() const { return lanes_.used; }
  [[nodiscard]] std::uint32_t size() const { return lanes_.joint_count; }
  [[nodiscard]] std::uint32_t body_count() const { return lanes_.body_count; }
  /// The index of the joint.
  [[nodiscard]] std::uint32_t joint(std::uint32_t place, int lane) const {
    return joint_of_[at(place) + static_cast<std::size_t>(lane)];
  }
  /// The body's place in the island.
  [[nodiscard]] std::uint32_t body(std::uint32_t number, int lane) const {
    return places_[at(number) + static_cast<std::size_t>(lane)];
  }
  /// The place of some body of the figure that moves.
  [[nodiscard]] std::uint32_t moving_body(int lane) const;
  [[nodiscard]] const FigureBody& body(std::uint32_t number) const { return bodies_[number]; }

  void load_bodies(const std::vector<blocks::IslandBody>& island);
  /// For a joint whose rows are written in lanes. @param pivot_a, pivot_b  from the centers of mass
  void frame(std::uint32_t place, int lane, const state::Joint& joint, const Vec3& pivot_a, const Vec3& pivot_b,
             const std::array<double, most_rows>& impulses);
  /// Writes the rows of all joints that are written in lanes.
  /// @param live  lanes whose bodies may have moved since
  void write(const std::vector<blocks::IslandBody>& island, const std::vector<blocks::BodyLanes>& velocities,
             const blocks::Lanes& live, const WriteRule& rule);
  [[nodiscard]] Writing writing(std::uint32_t place) const { return joints_[place].writing; }
  /// Keeps the impulses of rows that were written in lanes for the start of the next sub-step.
  /// @param kept  share of the change in each lane
  void keep_impulses(const blocks::Lanes& kept);
  /// Unit; see state::Joint.
  [[nodiscard]] Vec3 side(std::uint32_t place, int lane) const {
    return {0, frames_[place].side_y[lane], frames_[place].side_z[lane]};
  }
  /// Loads the rows of a joint; call `end_load` once all changed joints are loaded.
  void load(std::uint32_t place, int lane, const JointRows& rows, const Vec3& arm_a, const Vec3& arm_b);
  void end_load();
  /// Impulses of the rows that were loaded, by row of the joint. @param kept  share of the change
  void unload(std::uint32_t place, int lane, std::array<double, most_rows>& impulses, double kept) const;
  [[nodiscard]] bool acts(std::uint32_t place, int lane) const;
  /// Starts the next sub-step without impulses.
  void forget(int lane);
  [[nodiscard]] Vec3 push(std::uint32_t place, int lane) const { return blocks::lane_of(joints_[place].push, lane); }
  [[nodiscard]] Vec3 turn(std::uint32_t place, int lane) const { return blocks::lane_of(joints_[place].turn, lane); }

  [[nodiscard]] Figures& figures() { return lanes_; }
  [[nodiscard]] Figures& figures(std::vector<blocks::BodyLanes>& velocities) {
    lanes_.velocities = velocities.data();
    return lanes_;
  }

 private:
  static constexpr std::uint32_t kinds_room = 256;
  [[nodiscard]] static std::size_t at(std::uint32_t number) { return std::size_t{blocks::lane_count} * number; }
  void add(const FigurePlan& plan);
  void point_at_own();

  Figures lanes_;
  Shape shape_;
  bool whole_ = true;
  std::vector<FigureBody> bodies_;
  std::vector<FigureJoint> joints_;
  std::vector<FigureRow> rows_;
  std::vector<std::uint32_t> firsts_;
  std::vector<FigureLink> links_;
  std::vector<FigureFrame> frames_;  ///< parallel to joints_, or empty
  std::vector<blocks::Lanes> blocks_, values_;
  std::vector<std::uint32_t> places_, joint_of_;
  std::vector<std::array<std::uint8_t, blocks::lane_count>> counts_, holds_;  ///< number of rows of each lane
  std::vector<std::array<std::uint8_t, blocks::lane_count>> slots_;  ///< of each row: its index in the lane's joint
  std::vector<std::uint8_t> pushing_;  ///< of each row: the lanes in which it has a linear part, bit by bit
};

}  // namespace tweenfall::joints
