#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pairs/bounds_tree.h"
#include "pairs/pair_filter.h"
#include "pairs/swept_bounds.h"
#include "threads/workers.h"

namespace tweenfall::pairs {

using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< indices, smaller first

/// Finds which bodies may meet within a step. A tree holds an enlarged box for each; the pairs of boxes that meet
/// are kept from step to step, and searched for again only around bodies that have left their box.
class BroadPhase {
 public:
  /// Limit for crowds: if two bodies that move by themselves may each meet at least this many such bodies, and both
  /// already have this many pairs among such bodies, they do not become a pair; even thousands at one place still
  /// separate. A large body that carries many small ones is no crowd: each of those meets few.
  static constexpr std::uint32_t most_pairs = 128;

  /// Sorted pairs that may meet and whose swept bounds overlap, of which at least one moves by itself and at least
  /// one stirs.
  /// @param changed  sorted: all bodies that move by themselves, and all others that since the last call were added,
  /// moved or handed over, had or have a target, or got another filter
  /// @param margin  pairs with a gap up to this count too, m
  /// @param search  another way to find the same pairs
  const std::vector<Pair>& find(const std::vector<state::Body>& bodies, std::span<const std::uint32_t> changed,
                                const std::vector<forces::Load>& loads, const PairFilter& filter, double margin,
                                double dt, const threads::Workers& work = {}, PairSearch search = {});
  void remove(std::uint32_t body);
  /// The enlarged box of a body; null for a body that has none yet, or a plane.
  [[nodiscard]] const Bounds* box(std::uint32_t body) const {
    return movable_.has(body) ? &movable_.of(body) : immovable_.has(body) ? &immovable_.of(body) : nullptr;
  }
  /// Calls `see(body)` for each movable body whose path through this step may lead through a box, as long as
  /// `goes_on()`.
  template <class GoesOn, class See>
  void visit_swept(const Bounds& box, const GoesOn& goes_on, const See& see) const {
    movable_.visit_while(box, goes_on, [&](std::uint32_t body) {
      if (overlap(entries_[body].swept, box)) see(body);
    });
  }
  /// Searches for all pairs of the body again, when the bodies it may meet have changed.
  void look_again(std::uint32_t body);

 private:
  enum class Kind : std::uint8_t { none, movable, immovable, plane };
  struct Entry {
    Bounds swept{Vec3::Zero(), Vec3::Zero()};
    Kind kind = Kind::none;
    bool stirs = false;          ///< awake and movable, keyed and moving, or newly placed
    bool displaces = false;      ///< keyed and moving
    bool renewed = false;        ///< has another box than when pairs were last searched for
    std::uint8_t foresight = 4;  ///< steps for which its box has room
  };

  /// Where a body may be, found before any box is changed.
  struct Look {
    Kind kind = Kind::none;
    bool leaves = true;  ///< needs another box
    bool still = false;
    Vec3 travel{0, 0, 0};
  };
  [[nodiscard]] Look look_at(const state::Body& body, std::uint32_t index, const forces::Load& load, double margin,
                             double dt);
  void follow(const Look& look, std::uint32_t index);
  void renew(std::uint32_t index);
  BoundsTree& tree_of(Kind kind) { return kind == Kind::movable ? movable_ : immovable_; }
  void keep_pairs(const PairFilter& filter, const threads::Workers& work);
  bool look_around(std::uint32_t index, const PairFilter& filter, std::size_t most, std::vector<Pair>& fresh);
  void merge_fresh(std::size_t count, const threads::Workers& work);
  [[nodiscard]] bool may_meet(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool both_move(std::uint32_t a, std::uint32_t b) const;
  bool counts(std::uint32_t a, std::uint32_t b);
  void count_out();
  [[nodiscard]] std::uint32_t count_neighbors(std::uint32_t index, const PairFilter& filter) const;
  void choose_among_kept(const threads::Workers& work);
  /// @return false in a crowd
  bool choose_by(PairSearch search, const PairFilter& filter);
  void choose_in_crowd(std::span<const std::uint32_t> changed, const PairFilter& filter);
  void add_planes(const std::vector<state::Body>& bodies, std::span<const std::uint32_t> changed,
                  const PairFilter& filter, double margin);

  std::vector<Entry> entries_;              ///< by body
  std::vector<std::uint32_t> pair_counts_;  ///< by body: pairs found so far with other bodies that have many neighbors
  std::vector<std::uint32_t> neighbor_counts_;  ///< by moving body: how many moving bodies are near
  std::vector<Look> looks_;                     ///< at the bodies that have changed
  BoundsTree movable_, immovable_;
  std::vector<std::uint32_t> planes_;
  std::vector<std::uint32_t> renewed_;
  std::vector<Pair> kept_;  ///< pairs whose enlarged boxes meet, sorted; unused in a crowd
  std::vector<Pair> fresh_, merged_;
  std::vector<std::vector<Pair>> fresh_parts_;  ///< of renewed bodies
  struct MergedPart {
    std::vector<Pair> fresh, all;
  };
  std::vector<MergedPart> merged_parts_;         ///< by the first body
  std::vector<std::vector<Pair>> chosen_parts_;  ///< of kept_, in their order
  std::vector<std::uint32_t> near_;
  bool crowded_ = false;  ///< too many pairs to keep
  std::vector<Pair> pairs_;
};

}  // namespace tweenfall::pairs
