#pragma once

#include <tweenfall/physics/contact.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "state/boxed.h"

namespace tweenfall::state {

/// What the next step needs of a contact's point.
struct PointMemory {
  std::uint32_t feature = 0;
  Vec3 arm_b{0, 0, 0};  ///< from the center of mass of b at the start of the step, world, m
  double kept_normal = 0;
  Vec3 kept_friction{0, 0, 0};
};

/// What a contact hands on from step to step, apart from its points.
struct KeptImpulses {
  Vec3 kept_rolling{0, 0, 0};
  double kept_spin = 0;    ///< of the resistance to spinning, about the normal, N m s
  double kept_step = 0;    ///< length of the sub-step that kept impulses are of, s; 0: none are
  double kept_twist = 0;   ///< about the normal, where friction acts at the middle of the points, N m s
  bool slid = false;       ///< at the end of the last step that was solved in blocks
  double passed_over = 0;  ///< time since then in sub-steps too short to be kept, s
};

/// A manifold as it was found, in the bodies' own axes: it holds while they hardly move against each other.
struct FoundManifold {
  bool holds = false;
  Quat turn{1, 0, 0, 0};  ///< of b, in a's axes
  Vec3 between{0, 0, 0};  ///< from a's center of mass to b's, in a's axes, m
  Vec3 normal{0, 1, 0};   ///< in a's axes
  struct Point {
    Vec3 anchor_a{0, 0, 0}, anchor_b{0, 0, 0};  ///< from the centers of mass, in each body's axes, m
    double gap = 0;                             ///< m
  };
  std::array<Point, 4> points{};
};

/// What the next step needs of a pair that touches at more than one point, or flat.
struct MoreOfContact {
  std::array<PointMemory, 3> points{};  ///< from the second on
  FoundManifold found;
};

/// What the next step needs of a pair in contact.
struct ContactMemory {
  std::uint32_t a = 0, b = 0;            ///< indices of the bodies, a < b
  std::uint32_t part_a = 0, part_b = 0;  ///< of compounds
  int count = 0;
  bool touching = false;  ///< an impulse passed or the shapes overlap
  bool gone = false;      ///< a body of it has left since
  KeptImpulses kept;
  PointMemory first;
  Boxed<MoreOfContact> more;

  /// The i-th of `count`.
  [[nodiscard]] const PointMemory& point(std::size_t i) const { return i == 0 ? first : more.value().points[i - 1]; }
  [[nodiscard]] PointMemory& point(std::size_t i) { return i == 0 ? first : more.own().points[i - 1]; }
  [[nodiscard]] const FoundManifold& found() const { return more.value().found; }
};

/// The memories of all contacts of the last step: each keeps its place while its pair is in contact.
class ContactMemories {
 public:
  static constexpr std::uint32_t nowhere = 0xffffffff;

  ContactMemories() = default;
  explicit ContactMemories(std::vector<ContactMemory> all);  ///< by pair

  [[nodiscard]] ContactMemory& operator[](std::uint32_t place) { return all_[place]; }
  [[nodiscard]] const ContactMemory& operator[](std::uint32_t place) const { return all_[place]; }
  /// Places, by pair; those that are gone too, until `tidy`.
  [[nodiscard]] std::span<const std::uint32_t> sorted() const { return sorted_; }
  /// Places of a body's contacts.
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t body);

  void part(std::uint32_t place) {  ///< a body of it has left
    all_[place].gone = some_gone_ = true;
  }
  void tidy();                         ///< forgets what is gone
  [[nodiscard]] std::uint32_t take();  ///< a new place, for `keep` to be given
  /// From now on these are all, by pair; exchanged for the places so far.
  void keep(std::vector<std::uint32_t>& sorted);

 private:
  std::vector<ContactMemory> all_;
  std::vector<std::uint32_t> unused_;  ///< of all_
  std::vector<std::uint32_t> sorted_;
  bool some_gone_ = false;
  std::vector<char> kept_;           ///< by place; room for `keep`
  std::vector<std::size_t> starts_;  ///< by body, in `by_body_`; empty until they are asked for
  std::vector<std::uint32_t> by_body_;
};

}  // namespace tweenfall::state
