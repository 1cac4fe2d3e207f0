#include "joints/figure_group.h"

#include <algorithm>
#include <cmath>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

using blocks::IslandBody;
using blocks::lane_count;
using blocks::Lanes;
using blocks::Lanes3;

namespace {

constexpr std::uint32_t moving_end = 0x80000000u;
constexpr std::size_t numbers_of_joint = 3;  ///< numbers per joint in a shape

void put(const Vec3& value, Lanes3& lanes, int lane) {
  lanes.x[lane] = value.x();
  lanes.y[lane] = value.y();
  lanes.z[lane] = value.z();
}

void put(const Quat& value, LanesQuat& lanes, int lane) {
  lanes.w[lane] = value.w();
  lanes.x[lane] = value.x();
  lanes.y[lane] = value.y();
  lanes.z[lane] = value.z();
}

/// Clears a row that the lane does not have.
void clear(FigureRow& row, int lane) {
  for (Lanes3* vector : {&row.linear_a, &row.turn_a, &row.linear_b, &row.turn_b}) put(Vec3(0, 0, 0), *vector, lane);
  for (Lanes* number : {&row.wanted, &row.wanted_after, &row.left, &row.compliance, &row.low, &row.high, &row.impulse,
                        &row.reserve, &row.inverse, &row.present, &row.bounded, &row.in})
    (*number)[lane] = 0;
}

}  // namespace

void FigureGroup::find_shape(std::span<const FigurePlan::Member> members, std::span<const std::uint32_t> kinds,
                             std::vector<std::uint32_t>& local, Shape& shape) {
  shape.clear();
  std::uint32_t bodies = 0;
  const auto number_of = [&](std::uint32_t place, bool moves) {
    // An immovable body holds nothing together.
    if (!moves) return bodies++;
    if (local[place] == 0) local[place] = ++bodies;
    return (local[place] - 1) | moving_end;
  };
  for (const FigurePlan::Member& member : members) {
    const std::uint32_t a = number_of(member.a, member.a_moves);
    const std::uint32_t b = number_of(member.b, member.b_moves);
    shape.insert(shape.end(), {a, b, kinds[member.joint]});
  }
  for (const FigurePlan::Member& member : members) local[member.a] = local[member.b] = 0;
}

void FigureGroup::begin(const FigurePlan& plan, const Shape& shape, bool whole) {
  shape_ = shape;
  whole_ = whole;
  lanes_ = {};
  const std::size_t count = plan.members().size();
  joints_.resize(count);
  if (rows_.size() < count * most_rows) {
    rows_.resize(count * most_rows);
    slots_.resize(count * most_rows);
    pushing_.resize(count * most_rows);
  }
  counts_.assign(count, {});
  holds_.assign(count, {});
  joint_of_.assign(lane_count * count, 0);
  std::uint32_t bodies = 0;
  bool in_lanes = false;
  for (std::size_t i = 0; i < count; ++i) {
    FigureJoint& joint = joints_[i];
    joint.a = shape[numbers_of_joint * i] & ~moving_end;
    joint.b = shape[numbers_of_joint * i + 1] & ~moving_end;
    bodies = std::max({bodies, joint.a + 1, joint.b + 1});
    joint.writing = static_cast<Writing>(shape[numbers_of_joint * i + 2] / kinds_room);
    in_lanes = in_lanes || joint.writing != Writing::by_kind;
    joint.push = joint.turn = {};
    joint.arm_a = joint.arm_b = {};
  }
  bodies_.assign(bodies, {});
  places_.assign(lane_count * bodies, 0);
  for (std::size_t i = 0; i < count; ++i) {
    bodies_[joints_[i].a].moves = (shape[numbers_of_joint * i] & moving_end) != 0;
    bodies_[joints_[i].b].moves = (shape[numbers_of_joint * i + 1] & moving_end) != 0;
  }
  frames_.clear();
  if (in_lanes) {
    // Lanes without a figure get straight joints.
    FigureFrame straight{};
    straight.axes_a.w = straight.axes_b.w = straight.swing_y = straight.swing_z = straight.twist_high = blocks::all(1);
    straight.twist_low = blocks::all(-1);
    frames_.assign(count, straight);
    for (FigureBody& body : bodies_) body.rotation.w = blocks::all(1);
  }
  firsts_.assign(plan.firsts().begin(), plan.firsts().end());
  links_.resize(plan.later().size());
  for (std::size_t i = 0; i < links_.size(); ++i) links_[i] = {plan.later()[i], {}};
  lanes_.body_count = bodies;
  lanes_.joint_count = static_cast<std::uint32_t>(count);
  add(plan);
}

bool FigureGroup::take(const FigurePlan& plan, const Shape& shape) {
  if (!whole_ || lanes_.used == lane_count || shape != shape_) return false;
  add(plan);
  return true;
}

void FigureGroup::add(const FigurePlan& plan) {
  const auto lane = static_cast<std::size_t>(lanes_.used++);
  for (std::uint32_t i = 0; i < lanes_.joint_count; ++i) {
    const FigurePlan::Member& member = plan.members()[i];
    joint_of_[at(i) + lane] = member.joint;
    places_[at(joints_[i].a) + lane] = member.a;
    places_[at(joints_[i].b) + lane] = member.b;
  }
}

std::uint32_t FigureGroup::moving_body(int lane) const {
  std::uint32_t number = 0;
  while (!bodies_[number].moves) ++number;
  return body(number, lane);
}

void FigureGroup::load_bodies(const std::vector<IslandBody>& island) {
  for (std::uint32_t i = 0; i < lanes_.body_count; ++i) {
    FigureBody& body = bodies_[i];
    if (!body.moves) continue;
    for (int lane = 0; lane < lanes_.used; ++lane) {
      const IslandBody& entry = island[this->body(i, lane)];
      const Mat3& inertia = entry.inverse_inertia;
      body.inverse_mass[lane] = entry.inverse_mass;
      body.inverse_inertia.xx[lane] = inertia(0, 0);
      body.inverse_inertia.yy[lane] = inertia(1, 1);
      body.inverse_inertia.zz[lane] = inertia(2, 2);
      body.inverse_inertia.xy[lane] = inertia(0, 1);
      body.inverse_inertia.xz[lane] = inertia(0, 2);
      body.inverse_inertia.yz[lane] = inertia(1, 2);
    }
  }
}

void FigureGroup::frame(std::uint32_t place, int lane, const state::Joint& joint, const Vec3& pivot_a,
                        const Vec3& pivot_b, const std::array<double, most_rows>& impulses) {
  FigureFrame& frame = frames_[place];
  put(pivot_a, frame.pivot_a, lane);
  put(pivot_b, frame.pivot_b, lane);
  for (std::size_t row = 0; row < most_rows; ++row) frame.impulses[row][lane] = impulses[row];
  const auto* limb = std::get_if<SwingTwistJoint>(&joint.settings.kind);
  if (!limb) return;
  put(joint.settings.frame_a.rotation, frame.axes_a, lane);
  put(joint.settings.frame_b.rotation, frame.axes_b, lane);
  frame.swing_y[lane] = std::max(limb->swing_y, narrowest_swing);
  frame.swing_z[lane] = std::max(limb->swing_z, narrowest_swing);
  frame.twist_low[lane] = limb->twist.low;
  frame.twist_high[lane] = limb->twist.high;
  frame.side_y[lane] = joint.side.y();
  frame.side_z[lane] = joint.side.z();
}

void FigureGroup::write(const std::vector<IslandBody>& island, const std::vector<blocks::BodyLanes>& velocities,
                        const Lanes& live, const WriteRule& rule) {
  if (frames_.empty()) return;
  for (std::uint32_t i = 0; i < lanes_.body_count; ++i) {
    FigureBody& body = bodies_[i];
    for (int lane = 0; lane < lanes_.used; ++lane) {
      if (live[lane] == 0) continue;
      const std::uint32_t place = this->body(i, lane);
      const IslandBody& entry = island[place];
      put(entry.center, body.center, lane);
      put(entry.rotation, body.rotation, lane);
      Vec3 spin = blocks::angular_of(velocities[place]);
      const double turn = spin.squaredNorm() * rule.h * rule.h;
      if (turn > followable * followable) spin *= followable / std::sqrt(turn);
      put(spin, body.spin, lane);
    }
  }
  point_at_own();
  fastest_figure_kernels().write(lanes_, rule);
}

void FigureGroup::keep_impulses(const Lanes& kept) {
  bool all = true;
  for (int lane = 0; lane < lane_count; ++lane) all = all && kept[lane] == 1;
  for (std::uint32_t place = 0; place < frames_.size(); ++place) {
    const FigureJoint& joint = joints_[place];
    if (joint.writing == Writing::by_kind) continue;
    for (std::size_t i = 0; i < joint.count; ++i) {
      Lanes& impulses = frames_[place].impulses[joint.sources[i]];
      const FigureRow& row = rows_[most_rows * place + i];
      // Adding 0 turns -0 into 0, and what a lane has no row for gets 0, so that other lanes do not show in the result.
      if (all) {
        for (int lane = 0; lane < lane_count; ++lane) impulses[lane] = row.impulse[lane] + 0.0;
        continue;
      }
      for (int lane = 0; lane < lane_count; ++lane) {
        const double now = row.impulse[lane] + 0.0;
        const bool wholly = kept[lane] == 1 || row.present[lane] == 0;
        impulses[lane] = wholly ? now : impulses[lane] + kept[lane] * (now - impulses[lane]);
      }
    }
  }
}

void FigureGroup::load(std::uint32_t place, int lane, const JointRows& rows, const Vec3& arm_a, const Vec3& arm_b) {
  FigureJoint& joint = joints_[place];
  joint.point = rows.point;
  put(arm_a, joint.arm_a, lane);
  put(arm_b, joint.arm_b, lane);
  std::uint8_t count = 0;
  for (std::size_t slot = 0; slot < rows.count; ++slot) {
    if (rows.parts[slot] == Part::idle) continue;
    const Row& from = rows.rows[slot];
    const std::size_t number = most_rows * place + count;
    slots_[number][static_cast<std::size_t>(lane)] = static_cast<std::uint8_t>(slot);
    FigureRow& to = rows_[number];
    const bool bounded = slot >= rows.together;
    // The arms give the directions of rows that hold the point.
    if (!rows.point || slot >= 3) {
      put(from.direction.linear_a, to.linear_a, lane);
      put(from.direction.turn_a, to.turn_a, lane);
      put(from.direction.linear_b, to.linear_b, lane);
      put(from.direction.turn_b, to.turn_b, lane);
      const bool pushes = from.direction.linear_a != Vec3::Zero() || from.direction.linear_b != Vec3::Zero();
      const auto its = static_cast<std::uint8_t>(1u << static_cast<unsigned>(lane));
      pushing_[number] = static_cast<std::uint8_t>(pushes ? pushing_[number] | its : pushing_[number] & ~its);
    }
    to.wanted[lane] = from.wanted;
    to.wanted_after[lane] = from.wanted_after;
    to.left[lane] = from.left;
    to.compliance[lane] = from.compliance;
    to.low[lane] = from.low;
    to.high[lane] = from.high;
    to.impulse[lane] = rows.impulses[slot];
    to.reserve[lane] = bounded && from.compliance == 0 ? caution : give;
    to.present[lane] = 1;
    to.bounded[lane] = bounded ? 1 : 0;
    to.in[lane] = rows.parts[slot] == Part::in ? 1 : 0;
    ++count;
  }
  counts_[place][static_cast<std::size_t>(lane)] = count;
  holds_[place][static_cast<std::size_t>(lane)] = static_cast<std::uint8_t>(rows.together);
}

/// A copy points at its own data.
void FigureGroup::point_at_own() {
  lanes_.bodies = bodies_.data();
  lanes_.joints = joints_.data();
  lanes_.frames = frames_.data();
  lanes_.rows = rows_.data();
  lanes_.firsts = firsts_.data();
  lanes_.links = links_.data();
  lanes_.places = places_.data();
  lanes_.blocks = blocks_.data();
  lanes_.values = values_.data();
}

void FigureGroup::end_load() {
  const auto used = static_cast<std::ptrdiff_t>(lanes_.used);
  std::size_t blocks = 0;
  std::size_t values = 0;
  for (std::uint32_t place = 0; place < lanes_.joint_count; ++place) {
    FigureJoint& joint = joints_[place];
    if (joint.writing != Writing::by_kind) continue;
    const auto& counts = counts_[place];
    joint.count = *std::max_element(counts.begin(), counts.begin() + used);
    joint.holds = *std::min_element(holds_[place].begin(), holds_[place].begin() + used);
    for (std::size_t i = 0; i < joint.count; ++i) {
      const std::size_t number = most_rows * place + i;
      unsigned having = 0;
      for (int lane = 0; lane < lane_count; ++lane)
        if (i < counts[static_cast<std::size_t>(lane)])
          having |= 1u << static_cast<unsigned>(lane);
        else
          clear(rows_[number], lane);
      joint.turning[i] = (pushing_[number] & having) == 0;
    }
  }
  for (std::uint32_t place = 0; place < lanes_.joint_count; ++place) {
    blocks += std::size_t{joints_[place].count} * joints_[place].count;
    values += joints_[place].count;
    for (std::uint32_t n = firsts_[place]; n < firsts_[place + 1]; ++n)
      blocks += std::size_t{joints_[place].count} * joints_[links_[n].place].count;
  }
  if (blocks_.size() < blocks) blocks_.resize(blocks);
  if (values_.size() < values) values_.resize(values);
  point_at_own();
  for (FigurePart& part : lanes_.parts) part.stale = true;
}

void FigureGroup::unload(std::uint32_t place, int lane, std::array<double, most_rows>& impulses, double kept) const {
  if (joints_[place].writing != Writing::by_kind) {
    for (std::size_t row = 0; row < most_rows; ++row) impulses[row] = frames_[place].impulses[row][lane];
    return;
  }
  for (std::size_t i = 0; i < counts_[place][static_cast<std::size_t>(lane)]; ++i) {
    const std::size_t number = most_rows * place + i;
    // Adding 0 turns -0 into 0, so that other lanes do not show in the result.
    double& impulse = impulses[slots_[number][static_cast<std::size_t>(lane)]];
    const double now = rows_[number].impulse[lane] + 0.0;
    impulse = kept == 1 ? now : impulse + kept * (now - impulse);
  }
}

bool FigureGroup::acts(std::uint32_t place, int lane) const {
  for (std::size_t i = 0; i < joints_[place].count; ++i)
    if (rows_[most_rows * place + i].impulse[lane] != 0) return true;
  return false;
}

void FigureGroup::forget(int lane) {
  for (std::uint32_t place = 0; place < lanes_.joint_count; ++place)
    for (std::size_t i = 0; i < joints_[place].count; ++i) rows_[most_rows * place + i].impulse[lane] = 0;
  for (FigureFrame& frame : frames_)
    for (Lanes& impulses : frame.impulses) impulses[lane] = 0;
}

}  // namespace tweenfall::joints
