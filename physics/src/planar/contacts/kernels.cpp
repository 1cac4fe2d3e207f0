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

template <class Register>
struct PlaneRows {
  using Number = blocks::Wide<Register>;

  struct Row {
    Number x, y, turn;
  };
  TWEENFALL_LANES static Row gathered(const BodyRow* bodies, const std::uint32_t* at) {
    const double* rows[lane_count];
    for (int i = 0; i < lane_count; ++i) rows[i] = &bodies[at[i]].x;
    Row row;
    Number unused;
    gather(rows, row.x.of, row.y.of, row.turn.of, unused.of);
    return row;
  }
  TWEENFALL_LANES static void put_back(const Row& row, BodyRow* bodies, const std::uint32_t* at) {
    double* rows[lane_count];
    for (int i = 0; i < lane_count; ++i) rows[i] = &bodies[at[i]].x;
    scatter(row.x.of, row.y.of, row.turn.of, Number(0.0).of, rows);
  }

  /// Applies impulses along the normal and across it to both bodies.
  TWEENFALL_LANES static void push(const ContactBlock& block, const Number& along, const Number& across, Row& a,
                                   Row& b) {
    const Number normal_x = block.normal_x, normal_y = block.normal_y;
    const Number x = along * normal_x - across * normal_y, y = along * normal_y + across * normal_x;
    const Number inverse_a = block.inverse_mass_a, inverse_b = block.inverse_mass_b;
    a.x = a.x - inverse_a * x;
    a.y = a.y - inverse_a * y;
    b.x = b.x + inverse_b * x;
    b.y = b.y + inverse_b * y;
  }

  TWEENFALL_LANES static void warm_start(ContactBlock& block, BodyRow* velocities) {
    Row a = gathered(velocities, block.a), b = gathered(velocities, block.b);
    Number along(0.0), across(0.0), turn_a(0.0), turn_b(0.0);
    for (int i = 0; i < block.points; ++i) {
      const PointRow& point = block.point[i];
      const Number normal = point.normal, sideways = point.sideways;
      along = along + normal;
      across = across + sideways;
      turn_a = turn_a + (normal * Number(point.turn_a) + sideways * Number(point.slip_a));
      turn_b = turn_b + (normal * Number(point.turn_b) + sideways * Number(point.slip_b));
    }
    a.turn = a.turn - Number(block.inverse_moment_a) * turn_a;
    b.turn = b.turn + Number(block.inverse_moment_b) * turn_b;
    push(block, along, across, a, b);
    put_back(a, velocities, block.a);
    put_back(b, velocities, block.b);
  }

  /// Friction first: normals have the last word. The relative speed along the normal and across it is stored by
  /// itself, so that a row changes numbers rather than vectors.
  /// Source of the soft rows: Catto, Solver2D, 2024.
  TWEENFALL_LANES static void solve(ContactBlock& block, BodyRow* velocities, const BodyRow* displacements,
                                    const PassRule& rule) {
    Row a = gathered(velocities, block.a), b = gathered(velocities, block.b);
    const Row moved_a = gathered(displacements, block.a), moved_b = gathered(displacements, block.b);
    const Number normal_x = block.normal_x, normal_y = block.normal_y, zero(0.0);
    const Number apart = normal_x * (moved_b.x - moved_a.x) + normal_y * (moved_b.y - moved_a.y);
    const Number x = b.x - a.x, y = b.y - a.y;
    Number along = normal_x * x + normal_y * y, across = normal_x * y - normal_y * x;
    const Number inverse_mass = Number(block.inverse_mass_a) + block.inverse_mass_b;
    const Number inverse_a = block.inverse_moment_a, inverse_b = block.inverse_moment_b;
    Number pushed = zero, dragged = zero;
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = block.point[i];
      const Number turn_a = point.turn_a, turn_b = point.turn_b, before = point.normal;
      const Number gap = Number(point.gap) + apart + (turn_b * moved_b.turn - turn_a * moved_a.turn);
      const Number speed = along + (turn_b * b.turn - turn_a * a.turn);
      const auto open = gap > zero;
      const Number ahead = select(before > zero, Number(rule.inverse_h), Number(block.ahead));
      const Number wanted = select(open, gap * ahead, greater(gap * Number(rule.rate), Number(-rule.speed)));
      const Number firm = select(open, Number(1.0), Number(rule.firm)),
                   keep = select(open, Number(1.0), Number(rule.keep));
      const Number next = greater(keep * before - firm * Number(point.mass) * (speed + wanted), zero);
      const Number change = next - before;
      next.put(point.normal);
      pushed = pushed + change;
      along = along + inverse_mass * change;
      a.turn = a.turn - inverse_a * (turn_a * change);
      b.turn = b.turn + inverse_b * (turn_b * change);
    }
    for (int i = 0; i < block.points; ++i) {
      PointRow& point = block.point[i];
      const Number slip_a = point.slip_a, slip_b = point.slip_b, before = point.sideways;
      const Number speed = across + (slip_b * b.turn - slip_a * a.turn);
      const Number limit = Number(block.friction) * Number(point.normal);
      const Number next = lesser(greater(before - Number(point.slip_mass) * speed, -limit), limit);
      const Number change = next - before;
      next.put(point.sideways);
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
      (Number(point.total_normal) + point.normal).put(point.total_normal);
      (Number(point.total_sideways) + point.sideways).put(point.total_sideways);
    }
  }
};

// The same source for each instruction set. None of them fuses a multiplication and an addition here, so the bits are
// the same.
#define TWEENFALL_PLANE_KERNELS(name, Numbers, target)                                                                 \
  target void warm_start_##name(ContactBlock* blocks, std::size_t count, BodyRow* velocities) {                        \
    for (std::size_t i = 0; i < count; ++i) PlaneRows<Numbers>::warm_start(blocks[i], velocities);                     \
  }                                                                                                                    \
  target void solve_##name(ContactBlock* blocks, std::size_t count, BodyRow* velocities, const BodyRow* displacements, \
                           const PassRule& rule) {                                                                     \
    for (std::size_t i = 0; i < count; ++i) PlaneRows<Numbers>::solve(blocks[i], velocities, displacements, rule);     \
  }                                                                                                                    \
  constexpr Kernels name = {warm_start_##name, solve_##name};

TWEENFALL_PLANE_KERNELS(plain, Halves<Halves<Two>>, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_PLANE_KERNELS(avx2, Halves<Four>, [[gnu::target("avx2")]])
TWEENFALL_PLANE_KERNELS(avx512, Eight, [[gnu::target("avx512f,avx512vl,avx512dq")]])
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
