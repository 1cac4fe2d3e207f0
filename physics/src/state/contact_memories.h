#pragma once

#include <tweenfall/physics/contact.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "state/pool.h"

namespace tweenfall::state {

/// Where a body was at the start of a step.
struct Stand {
  Vec3 center{0, 0, 0};  ///< of mass, world, m
  Quat rotation{1, 0, 0, 0};
};

/// What is kept of a contact's point.
struct PointMemory {
  Vec3 position{0, 0, 0};  ///< as it was found, world, m
  double penetration = 0;  ///< as it was found, m
  double kept_normal = 0;  ///< N s
  Vec3 kept_friction{0, 0, 0};
};

/// What a contact passes on from step to step, besides its points.
struct KeptImpulses {
  Vec3 kept_rolling{0, 0, 0};
  double kept_spin = 0;    ///< of the resistance to spinning, about the normal, N m s
  double kept_step = 0;    ///< length of the sub-step in which the kept impulses acted, s; 0: none are kept
  double kept_twist = 0;   ///< about the normal, if friction acts at the middle of the points, N m s
  bool slid = false;       ///< at the end of the last step that was solved in blocks
  double passed_over = 0;  ///< time since then, in sub-steps too short to keep their impulses, s
};

/// What is kept of a pair in contact: what the next step needs, and what the caller sees.
struct ContactMemory {
  enum Mark : std::uint8_t {
    touching = 1,   ///< an impulse passed or the shapes overlap
    gone = 2,       ///< one of its bodies has been removed since
    began = 4,      ///< it did not touch in the step before
    slid = 8,       ///< see KeptImpulses
    holds = 16,     ///< its manifold may be used again while the bodies hardly move relative to each other
    taken_up = 32,  ///< it was used again in the last step, and lay where the bodies had brought it
    within = 64     ///< the two lay in each other when they met, and still do
  };
  std::uint32_t a = 0, b = 0;  ///< indices of the bodies, a < b
  std::uint32_t feature = 0;   ///< of the first point
  std::uint32_t more = nowhere, rare = nowhere;
  std::uint8_t count = 0;  ///< points
  std::uint8_t marks = 0;
  double kept_step = 0;
  Vec3 normal{0, 1, 0};  ///< as it was found, world
  double impulse = 0;    ///< along the normal, of the whole step, N s
  double approach = 0;   ///< m/s
  Vec3 total_impulse{0, 0, 0};
  PointMemory first;

  [[nodiscard]] bool is(Mark mark) const { return (marks & mark) != 0; }
  void mark(Mark mark, bool on) { marks = static_cast<std::uint8_t>(on ? marks | mark : marks & ~mark); }
};

/// What is kept of a pair that touches at more than one point, or flat.
struct MoreOfContact {
  std::array<PointMemory, 3> points{};  ///< from the second one on
  std::array<std::uint32_t, 3> features{};
  double kept_twist = 0;
  Stand a, b;  ///< where the bodies were when its manifold was found, if it may be used again
};

/// What is kept of few pairs.
struct RareOfContact {
  std::uint32_t part_a = 0, part_b = 0;  ///< of compounds
  bool has_arms = false;  ///< its points were found for other positions than those at the start of the step
  double kept_spin = 0, passed_over = 0;
  Vec3 kept_rolling{0, 0, 0};
  std::array<Vec3, 4> arms_b{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< as if found there, m
};

/// All that is kept of a pair.
struct WholeContact {
  ContactMemory memory;
  MoreOfContact more;
  RareOfContact rare;
};

/// The memories of all contacts of the last step: each keeps its place as long as its pair is in contact.
class ContactMemories {
 public:
  static constexpr std::uint32_t nowhere = state::nowhere;

  ContactMemories() = default;
  explicit ContactMemories(std::span<const WholeContact> all);  ///< by pair

  [[nodiscard]] ContactMemory& operator[](std::uint32_t place) { return all_[place]; }
  [[nodiscard]] const ContactMemory& operator[](std::uint32_t place) const { return all_[place]; }
  [[nodiscard]] WholeContact whole(std::uint32_t place) const;

  /// The i-th of `count`.
  [[nodiscard]] const PointMemory& point(const ContactMemory& memory, std::size_t i) const {
    return i == 0 ? memory.first : more_[memory.more].points[i - 1];
  }
  [[nodiscard]] PointMemory& point(ContactMemory& memory, std::size_t i) {
    return i == 0 ? memory.first : more_[memory.more].points[i - 1];
  }
  [[nodiscard]] std::uint32_t feature(const ContactMemory& memory, std::size_t i) const {
    return i == 0 ? memory.feature : more_[memory.more].features[i - 1];
  }
  /// Null if there is none.
  [[nodiscard]] const MoreOfContact* more(const ContactMemory& memory) const { return more_.find(memory.more); }
  [[nodiscard]] MoreOfContact* more(const ContactMemory& memory) { return more_.find(memory.more); }
  [[nodiscard]] const RareOfContact* rare(const ContactMemory& memory) const { return rare_.find(memory.rare); }
  [[nodiscard]] RareOfContact* rare(const ContactMemory& memory) { return rare_.find(memory.rare); }
  // Created if there is none.
  MoreOfContact& own_more(ContactMemory& memory) { return more_.own(memory.more); }
  RareOfContact& own_rare(ContactMemory& memory) { return rare_.own(memory.rare); }

  [[nodiscard]] KeptImpulses kept(const ContactMemory& memory) const;
  /// Which parts of compounds touch.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> parts(const ContactMemory& memory) const {
    const RareOfContact* its = rare(memory);
    return its ? std::pair(its->part_a, its->part_b) : std::pair<std::uint32_t, std::uint32_t>(0, 0);
  }

  /// Places, by pair; includes those that are gone until `tidy`.
  [[nodiscard]] std::span<const std::uint32_t> sorted() const { return sorted_; }
  /// Places of a body's contacts, by pair.
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t body);

  void part(std::uint32_t place) {  ///< one of its bodies has been removed
    all_[place].mark(ContactMemory::gone, true);
    some_gone_ = true;
  }
  void tidy();                         ///< removes those that are gone
  [[nodiscard]] std::uint32_t take();  ///< a new place, to be passed to `keep`
  /// From now on these are all, by pair; swapped with the previous places. Calls let_go(memory) for each one dropped.
  template <class LetGo>
  void keep(std::vector<std::uint32_t>& sorted, const LetGo& let_go) {
    kept_.assign(all_.size(), 0);
    for (const std::uint32_t place : sorted) kept_[place] = 1;
    for (const std::uint32_t place : sorted_) {
      if (kept_[place] != 0) continue;
      let_go(all_[place]);
      free(place);
    }
    std::swap(sorted_, sorted);
    starts_.clear();
  }

 private:
  void free(std::uint32_t place);

  std::vector<ContactMemory> all_;
  Pool<MoreOfContact> more_;
  Pool<RareOfContact> rare_;
  std::vector<std::uint32_t> unused_;  ///< of all_
  std::vector<std::uint32_t> sorted_;
  bool some_gone_ = false;
  std::vector<char> kept_;           ///< by place; working memory of `keep`
  std::vector<std::size_t> starts_;  ///< by body, in `by_body_`; empty until they are needed
  std::vector<std::uint32_t> by_body_;
};

}  // namespace tweenfall::state
