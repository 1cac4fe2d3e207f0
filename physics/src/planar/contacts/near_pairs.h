#pragma once

#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

#include "pairs/bounds_tree.h"
#include "planar/body.h"

namespace tweenfall::planar::inner {

/// Of a body's reach: what counts as touching before it does.
constexpr double close = 0.02;

using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< a < b

/// What a meeting is of.
struct Encounter {
  std::uint32_t a = 0, b = 0;  ///< a < b
  std::uint32_t part_a = 0, part_b = 0;
  auto operator<=>(const Encounter&) const = default;
};
[[nodiscard]] inline Encounter encounter_of(const Meeting& meeting) {
  return {meeting.a, meeting.b, meeting.part_a, meeting.part_b};
}

/// Which bodies are near each other. Each has a box with room to spare in a tree, and is looked around for again only
/// when it may have left it.
class NearPairs {
 public:
  /// What moves by itself and is near so many that are near so many is in a crowd; there two bodies that both have so
  /// many pairs already are no pair: thousands at one place part all the same. What is large and bears many small ones
  /// is in none.
  static constexpr std::uint32_t crowding = 96, most = 24;

  /// Brings the meetings up to date, sorted; those that stay keep what they know.
  /// @param apart  sorted pairs that joints keep from touching
  void update(std::vector<Body>& bodies, const std::vector<Makeup>& makeups, const std::vector<Pair>& apart,
              std::vector<Meeting>& meetings);
  void remove(std::uint32_t body);
  /// Makes the tree again from what bodies know of their boxes.
  void restore(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups);

 private:
  static constexpr std::uint32_t unknown = 0xffffffff;

  [[nodiscard]] std::uint32_t neighbors(std::uint32_t index, const std::vector<Body>& bodies,
                                        const std::vector<Makeup>& makeups, bool all);
  /// Whether it has as many pairs as it gets in a crowd, and is in one.
  [[nodiscard]] bool is_full(std::uint32_t index, const std::vector<Body>& bodies, const std::vector<Makeup>& makeups);
  void box(const Body& body, const Makeup& makeup, std::uint32_t index);
  void look_around(std::uint32_t index, const std::vector<Body>& bodies, const std::vector<Makeup>& makeups,
                   const std::vector<Pair>& apart);
  /// Those parts of two bodies, as both are boxed, whose boxes meet.
  void meet_parts(const Pair& pair, const std::vector<Makeup>& makeups);
  void merge(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups, std::vector<Meeting>& meetings);

  pairs::BoundsTree tree_;
  std::vector<std::uint32_t> endless_;           ///< sorted
  std::vector<std::vector<Bounds>> part_boxes_;  ///< by body; of compounds, each with the room that their box has
  std::vector<std::uint32_t> renewed_, seen_;
  std::vector<char> is_renewed_;
  std::vector<std::uint32_t> counts_;              ///< of pairs of two that move by themselves
  std::vector<std::uint32_t> neighbors_, crowds_;  ///< counted so far: near it, and of those in a crowd
  std::vector<char> closed_;
  std::vector<Encounter> fresh_;
  std::vector<Meeting> merged_;
};

}  // namespace tweenfall::planar::inner
