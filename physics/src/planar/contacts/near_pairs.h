#pragma once

#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

#include "pairs/bounds_tree.h"
#include "planar/body.h"

namespace tweenfall::planar::inner {

/// A gap below this part of a body's reach counts as touching.
constexpr double close = 0.02;

using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< a < b

/// What a meeting is between.
struct Encounter {
  std::uint32_t a = 0, b = 0;  ///< a < b
  std::uint32_t part_a = 0, part_b = 0;
  auto operator<=>(const Encounter&) const = default;
};
[[nodiscard]] inline Encounter encounter_of(const Meeting& meeting) {
  return {meeting.a, meeting.b, meeting.part_a, meeting.part_b};
}

/// Which bodies are near each other. A tree holds an enlarged box for each; around a body, pairs are searched for again
/// only when it may have left its box.
class NearPairs {
 public:
  /// A moving body is in a crowd if it is near so many that are near so many; there, two bodies that both have `most`
  /// pairs already do not become a pair; even thousands at one place still separate. A large body that carries many
  /// small ones is in none.
  static constexpr std::uint32_t crowding = 96, most = 24;

  /// Brings the meetings up to date, sorted; those that remain keep their data.
  /// @param apart  sorted pairs that joints keep from touching
  void update(std::vector<Body>& bodies, const std::vector<Makeup>& makeups, const std::vector<Pair>& apart,
              std::vector<Meeting>& meetings);
  void remove(std::uint32_t body);
  /// Rebuilds the tree from the boxes stored in the bodies.
  void restore(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups);

 private:
  static constexpr std::uint32_t unknown = 0xffffffff;

  [[nodiscard]] std::uint32_t neighbors(std::uint32_t index, const std::vector<Body>& bodies,
                                        const std::vector<Makeup>& makeups, bool all);
  /// Whether it is in a crowd and already has as many pairs as it gets there.
  [[nodiscard]] bool is_full(std::uint32_t index, const std::vector<Body>& bodies, const std::vector<Makeup>& makeups);
  void box(const Body& body, const Makeup& makeup, std::uint32_t index);
  void look_around(std::uint32_t index, const std::vector<Body>& bodies, const std::vector<Makeup>& makeups,
                   const std::vector<Pair>& apart);
  /// Those parts of two bodies whose boxes meet, for both bodies' boxed positions.
  void meet_parts(const Pair& pair, const std::vector<Makeup>& makeups);
  void merge(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups, std::vector<Meeting>& meetings);

  pairs::BoundsTree tree_;
  std::vector<std::uint32_t> endless_;           ///< sorted
  std::vector<std::vector<Bounds>> part_boxes_;  ///< by body; for compounds, each enlarged like the body's box
  std::vector<std::uint32_t> renewed_, seen_;
  std::vector<char> is_renewed_;
  std::vector<std::uint32_t> counts_;              ///< of pairs of two moving bodies
  std::vector<std::uint32_t> neighbors_, crowds_;  ///< counted so far: bodies near it, and those of them in a crowd
  std::vector<char> closed_;
  std::vector<Encounter> fresh_;
  std::vector<Meeting> merged_;
};

}  // namespace tweenfall::planar::inner
