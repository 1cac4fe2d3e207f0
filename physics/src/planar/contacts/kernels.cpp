#include <array>
#include <cstddef>

#include "islands/blocks/kernels/registers.h"
#include "planar/contacts/contact_block.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::planar::inner {

namespace {

using blocks::Eight;
using blocks::Four;
using blocks::gather;
using blocks::Halves;
using blocks::scatter;
using blocks::Two;

/// The lanes from one on that fit into a register: no others depend on them.
template <class Register>
struct PlaneRows {
  using Number = blocks::Wide<Register>;
  static constexpr int width = sizeof(Register) / sizeof(double);

  int from = 0;

  [[nodiscard]] TWEENFALL_LANES Number in(const Lanes& lanes) const {
    Number numbers;
    blocks::load(lanes.lanes + from, numbers.of);
    return numbers;
  }
  TWEENFALL_LANES void put(const Number& numbers, Lanes& lanes) const { blocks::store(numbers.of, lanes.lanes + from); }

  struct Row {
    Number x, y, turn, unused;
  };
  TWEENFALL_LANES Row gathered(const BodyRow* bodies, const std::uint32_t* at) const {
    const double* rows[width];
    for (int i = 0; i < width; ++i) rows[i] = &bodies->x + at[from + i];
    Row row;
    gather(rows, row.x.of, row.y.of, row.turn.of, row.unused.of);
    return row;
  }
  TWEENFALL_LANES void put_back(const Row& row, BodyRow* bodies, const std::uint32_t* at) const {
    double* rows[width];
    for (int i = 0; i < width; ++i) rows[i] = &bodies->x + at[from + i];
    // Its own fourth number: of a known zero compilers make moves that valgrind does not run.
    scatter(row.x.of, row.y.of, row.turn.of, row.unused.of, rows);
  }

  /// Applies impulses along the normal and across it to both bodies.
  TWEENFALL_LANES void push(const ContactBlock& block, const Number& along, const Number& across, Row& a,
                            Row& b) const {
    const Number normal_x = in(block.normal_x), normal_y = in(block.normal_y);
    const Number x = along * normal_x - across * normal_y, y = along * normal_y + across * normal_x;
    const Number inverse_a = in(block.inverse_mass_a), inverse_b = in(block.inverse_mass_b);
    a.x = a.x - inverse_a * x;
    a.y = a.y - inverse_a * y;
    b.x = b.x + inverse_b * x;
    b.y = b.y + inverse_b * y;
  }

  struct Pose {
    Number x, y, cos, sin;
  };
  TWEENFALL_LANES Pose posed(const BodyRow* bodies, const std::uint32_t* at) const {
    const double* rows[width];
    for (int i = 0; i < width; ++i) rows[i] = &bodies->x + at[from + i];
    Pose pose;
    gather(rows, pose.x.of, pose.y.of, pose.cos.of, pose.sin.of);
    return pose;
  }

  TWEENFALL_LANES void prepare(ContactBlock& block, const BodyStarts& bodies) const {
    const Pose a = posed(bodies.poses, block.a), b = posed(bodies.poses, block.b);
    const Row mass_a = gathered(bodies.masses, block.a), mass_b = gathered(bodies.masses, block.b);
    const Row v_a = gathered(bodies.velocities, block.a), v_b = gathered(bodies.velocities, block.b);
    const Number local_x = in(block.normal_x), local_y = in(block.normal_y), zero(0.0), one(1.0);
    const Number normal_x = a.cos * local_x - a.sin * local_y, normal_y = a.sin * local_x + a.cos * local_y;
    const Number apart_x = b.x - a.x, apart_y = b.y - a.y;
    const Number along = normal_x * (v_a.x - v_b.x) + normal_y * (v_a.y - v_b.y);
    const Number skin_a = in(block.skin_a), skin_b = in(block.skin_b), skins = skin_a + skin_b;
    const Number inverse_mass = mass_a.x + mass_b.x;
    Number approach = zero;
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = block.point[i];
      const auto there = in(point.mass) > zero;
      const Number at_a_x = in(point.turn_a), at_a_y = in(point.turn_b), at_b_x = in(point.slip_a),
                   at_b_y = in(point.slip_b);
      const Number a_x = a.cos * at_a_x - a.sin * at_a_y, a_y = a.sin * at_a_x + a.cos * at_a_y;
      const Number b_x = b.cos * at_b_x - b.sin * at_b_y, b_y = b.sin * at_b_x + b.cos * at_b_y;
      const Number turn_a = a_x * normal_y - a_y * normal_x, turn_b = b_x * normal_y - b_y * normal_x;
      const Number slip_a = (a_x * normal_x + a_y * normal_y) + skin_a;
      const Number slip_b = (b_x * normal_x + b_y * normal_y) - skin_b;
      const Number closing = along + (turn_a * v_a.turn - turn_b * v_b.turn);
      approach = select(there, greater(approach, closing), approach);
      const Number gap = (normal_x * (apart_x + (b_x - a_x)) + normal_y * (apart_y + (b_y - a_y))) - skins;
      const Number mass = one / (inverse_mass + (mass_a.y * turn_a * turn_a + mass_b.y * turn_b * turn_b));
      const Number slip_mass = one / (inverse_mass + (mass_a.y * slip_a * slip_a + mass_b.y * slip_b * slip_b));
      put(turn_a, point.turn_a);
      put(turn_b, point.turn_b);
      put(slip_a, point.slip_a);
      put(slip_b, point.slip_b);
      put(gap, point.gap);
      put(select(there, mass, zero), point.mass);
      put(select(there, slip_mass, zero), point.slip_mass);
      put(zero, point.total_normal);
      put(zero, point.total_sideways);
    }
    put(normal_x, block.normal_x);
    put(normal_y, block.normal_y);
    put(mass_a.x, block.inverse_mass_a);
    put(mass_b.x, block.inverse_mass_b);
    put(mass_a.y, block.inverse_moment_a);
    put(mass_b.y, block.inverse_moment_b);
    put(approach, block.approach);
  }

  TWEENFALL_LANES void warm_start(ContactBlock& block, BodyRow* velocities) const {
    Row a = gathered(velocities, block.a), b = gathered(velocities, block.b);
    const PointRow& first = block.point[0];
    Number along = in(first.normal), across = in(first.sideways);
    Number turn_a = along * in(first.turn_a) + across * in(first.slip_a);
    Number turn_b = along * in(first.turn_b) + across * in(first.slip_b);
    if (block.points > 1) {
      const PointRow& second = block.point[1];
      const Number normal = in(second.normal), sideways = in(second.sideways);
      along = along + normal;
      across = across + sideways;
      turn_a = turn_a + (normal * in(second.turn_a) + sideways * in(second.slip_a));
      turn_b = turn_b + (normal * in(second.turn_b) + sideways * in(second.slip_b));
    }
    a.turn = a.turn - in(block.inverse_moment_a) * turn_a;
    b.turn = b.turn + in(block.inverse_moment_b) * turn_b;
    push(block, along, across, a, b);
    put_back(a, velocities, block.a);
    put_back(b, velocities, block.b);
  }

  /// Friction first: normals have the last word. The relative speed along the normal and across it is stored by
  /// itself, so that a row changes numbers rather than vectors.
  /// Source of the soft rows: Catto, Solver2D, 2024.
  TWEENFALL_LANES void solve(ContactBlock& block, BodyRow* velocities, const BodyRow* displacements,
                             const PassRule& rule) const {
    Row a = gathered(velocities, block.a), b = gathered(velocities, block.b);
    const Row moved_a = gathered(displacements, block.a), moved_b = gathered(displacements, block.b);
    const Number normal_x = in(block.normal_x), normal_y = in(block.normal_y), zero(0.0);
    const Number apart = normal_x * (moved_b.x - moved_a.x) + normal_y * (moved_b.y - moved_a.y);
    const Number x = b.x - a.x, y = b.y - a.y;
    Number along = normal_x * x + normal_y * y, across = normal_x * y - normal_y * x;
    const Number inverse_mass = in(block.inverse_mass_a) + in(block.inverse_mass_b);
    const Number inverse_a = in(block.inverse_moment_a), inverse_b = in(block.inverse_moment_b);
    Number pushed = zero, dragged = zero;
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = block.point[i];
      const Number turn_a = in(point.turn_a), turn_b = in(point.turn_b), before = in(point.normal);
      const Number gap = in(point.gap) + apart + (turn_b * moved_b.turn - turn_a * moved_a.turn);
      const Number speed = along + (turn_b * b.turn - turn_a * a.turn);
      const auto open = gap > zero;
      const Number ahead = select(before > zero, Number(rule.inverse_h), in(block.ahead));
      const Number wanted = select(open, gap * ahead, greater(gap * Number(rule.rate), Number(-rule.speed)));
      const Number firm = select(open, Number(1.0), Number(rule.firm)),
                   keep = select(open, Number(1.0), Number(rule.keep));
      const Number next = greater(keep * before - firm * in(point.mass) * (speed + wanted), zero);
      const Number change = next - before;
      put(next, point.normal);
      pushed = pushed + change;
      along = along + inverse_mass * change;
      a.turn = a.turn - inverse_a * (turn_a * change);
      b.turn = b.turn + inverse_b * (turn_b * change);
    }
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = block.point[i];
      const Number slip_a = in(point.slip_a), slip_b = in(point.slip_b), before = in(point.sideways);
      const Number speed = across + (slip_b * b.turn - slip_a * a.turn);
      const Number limit = in(block.friction) * in(point.normal);
      const Number next = lesser(greater(before - in(point.slip_mass) * speed, -limit), limit);
      const Number change = next - before;
      put(next, point.sideways);
      dragged = dragged + change;
      across = across + inverse_mass * change;
      a.turn = a.turn - inverse_a * (slip_a * change);
      b.turn = b.turn + inverse_b * (slip_b * change);
    }
    push(block, pushed, dragged, a, b);
    put_back(a, velocities, block.a);
    put_back(b, velocities, block.b);
    if (!rule.sum_up) return;
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = block.point[i];
      put(in(point.total_normal) + in(point.normal), point.total_normal);
      put(in(point.total_sideways) + in(point.sideways), point.total_sideways);
    }
  }

  TWEENFALL_LANES static void prepare_all(ContactBlock* blocks, std::size_t count, const BodyStarts& bodies) {
    for (std::size_t i = 0; i < count; ++i)
      for (int from = 0; from < lane_count; from += width) PlaneRows{from}.prepare(blocks[i], bodies);
  }

  TWEENFALL_LANES static void warm_start_all(ContactBlock* blocks, std::size_t count, BodyRow* velocities) {
    for (std::size_t i = 0; i < count; ++i)
      for (int from = 0; from < lane_count; from += width) PlaneRows{from}.warm_start(blocks[i], velocities);
  }

  TWEENFALL_LANES static void solve_all(ContactBlock* blocks, std::size_t count, BodyRow* velocities,
                                        const BodyRow* displacements, const PassRule& rule) {
    for (std::size_t i = 0; i < count; ++i)
      for (int from = 0; from < lane_count; from += width)
        PlaneRows{from}.solve(blocks[i], velocities, displacements, rule);
  }
};

/// @param Register  of four numbers
template <class Register>
struct BodyMotion {
  using Numbers = blocks::Wide<Register>;

  TWEENFALL_LANES static Numbers taken(const BodyRow& row) {
    Numbers numbers;
    blocks::load(&row.x, numbers.of);
    return numbers;
  }
  TWEENFALL_LANES static void put(const Numbers& numbers, BodyRow& row) { blocks::store(numbers.of, &row.x); }

  TWEENFALL_LANES static void begin(const BodyRows& rows, std::uint32_t i, const Numbers& velocity,
                                    const Numbers& unpushed, double h, bool again) {
    const Numbers next = velocity + taken(rows.gains[i]) * Numbers(h);
    put(velocity, rows.starts[i]);
    put(next, rows.unpushed[i]);
    put(again ? next + (velocity - unpushed) : next, rows.velocities[i]);
  }
  TWEENFALL_LANES static void move(const BodyRows& rows, std::uint32_t i, const Numbers& velocity,
                                   const Numbers& unpushed, double h) {
    const bool flies = !((velocity > unpushed) | (velocity < unpushed)).any();
    const Numbers moved = taken(rows.displacements[i]);
    const Numbers mean = flies ? Numbers(0.5) * (taken(rows.starts[i]) + velocity) : velocity;
    put(moved + mean * Numbers(h), rows.displacements[i]);
  }

  template <bool moves, bool begins>
  TWEENFALL_LANES static void all(const BodyRows& rows, std::span<const std::uint32_t> moving, double h, bool again) {
    for (const std::uint32_t i : moving) {
      const Numbers velocity = taken(rows.velocities[i]), unpushed = taken(rows.unpushed[i]);
      if constexpr (moves) move(rows, i, velocity, unpushed, h);
      if constexpr (begins) begin(rows, i, velocity, unpushed, h, again);
    }
  }
};

// The same source for each instruction set. None of them fuses a multiplication and an addition here, so the bits are
// the same.
#define TWEENFALL_PLANE_KERNELS(name, Numbers, Row, target)                                                            \
  target void prepare_##name(ContactBlock* blocks, std::size_t count, const BodyStarts& bodies) {                      \
    PlaneRows<Numbers>::prepare_all(blocks, count, bodies);                                                            \
  }                                                                                                                    \
  target void warm_start_##name(ContactBlock* blocks, std::size_t count, BodyRow* velocities) {                        \
    PlaneRows<Numbers>::warm_start_all(blocks, count, velocities);                                                     \
  }                                                                                                                    \
  target void solve_##name(ContactBlock* blocks, std::size_t count, BodyRow* velocities, const BodyRow* displacements, \
                           const PassRule& rule) {                                                                     \
    PlaneRows<Numbers>::solve_all(blocks, count, velocities, displacements, rule);                                     \
  }                                                                                                                    \
  target void begin_##name(const BodyRows& rows, std::span<const std::uint32_t> moving, double h, bool again) {        \
    BodyMotion<Row>::all<false, true>(rows, moving, h, again);                                                         \
  }                                                                                                                    \
  target void move_##name(const BodyRows& rows, std::span<const std::uint32_t> moving, double h) {                     \
    BodyMotion<Row>::all<true, false>(rows, moving, h, false);                                                         \
  }                                                                                                                    \
  target void move_on_##name(const BodyRows& rows, std::span<const std::uint32_t> moving, double h) {                  \
    BodyMotion<Row>::all<true, true>(rows, moving, h, true);                                                           \
  }                                                                                                                    \
  constexpr Kernels name = {prepare_##name, warm_start_##name, solve_##name, begin_##name, move_##name, move_on_##name};

TWEENFALL_PLANE_KERNELS(plain, Two, Halves<Two>, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_PLANE_KERNELS(avx2, Four, Four, [[gnu::target("avx2")]])
TWEENFALL_PLANE_KERNELS(avx512, Eight, Four, [[gnu::target("avx512f,avx512vl,avx512dq")]])
#endif

}  // namespace

std::span<const Kernels* const> possible_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain, &avx2, &avx512};
#else
  static constexpr std::array all = {&plain};
#endif
  return std::span(all).first(blocks::possible_versions());
}

const Kernels& kernels() {
  static const Kernels& fastest = *possible_kernels().back();
  return fastest;
}

}  // namespace tweenfall::planar::inner
