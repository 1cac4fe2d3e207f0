#pragma once

/// Blend spaces: weights for poses placed along a line or on a plane, from the position of a parameter among them.
///
/// A walk at 1.5 m/s, a run at 4 m/s: a parameter of 2 m/s gives each its weight. The parameter carries its rate and
/// acceleration, and the weights carry theirs, exactly. Weights are 0 to 1, sum to 1 and are continuous everywhere; at
/// the place of an entry its weight is exactly 1 and all others are 0. Their rates jump where the parameter goes from
/// one stretch, triangle or band to the next: there they are those of the side to which it moves (`Side::out`) or from
/// which it comes (`Side::in`).

#include <tweenfall/curves/values.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tweenfall {

/// Entries along a line: two neighbors share the weight, linearly between their places; beyond an end it has all.
class BlendLine {
 public:
  /// @param places  of the entries, in any order and any unit
  /// @throws std::invalid_argument listing all problems: fewer than two, two at one place, places that are not finite
  explicit BlendLine(std::vector<double> places);

  [[nodiscard]] std::span<const double> places() const noexcept { return places_; }

  /// @param weights  written, one for each entry, in order
  void weights(const Sample<double>& parameter, std::span<Sample<double>> weights,
               Side side = Side::out) const noexcept;

 private:
  std::vector<double> places_;
  std::vector<std::size_t> order_;  ///< entries in order of their places
};

/// Entries on a plane: the three corners of the triangle around the parameter share the weight, by its barycentric
/// coordinates; outside all triangles the nearest point on their border is used instead of the parameter.
///
/// The triangles are those of Delaunay, which have no entry inside their circumcircles; where four entries or more lie
/// on one circle with none inside, as on a grid, one of several triangulations is taken. "Nearest" weights both axes
/// equally, so their units should be chosen such that equal steps on both mean equally much. Source: Lawson, "Software
/// for C1 surface interpolation", 1977.
class BlendPlane {
 public:
  /// @throws std::invalid_argument listing all problems: fewer than three, two at one place (nearer than 1e-9 of the
  /// whole), all on one line, places that are not finite
  explicit BlendPlane(std::vector<Vec2> places);

  [[nodiscard]] std::span<const Vec2> places() const noexcept { return places_; }

  /// Three entries each, counter-clockwise.
  [[nodiscard]] std::span<const std::array<std::size_t, 3>> triangles() const noexcept { return triangles_; }
  /// Entries on the border, counter-clockwise.
  [[nodiscard]] std::span<const std::size_t> border() const noexcept { return border_; }

  /// @param weights  written, one for each entry, in order
  void weights(const Sample<Vec2>& parameter, std::span<Sample<double>> weights, Side side = Side::out) const noexcept;

 private:
  [[nodiscard]] Vec2 scaled(const Vec2& place) const noexcept;

  std::vector<Vec2> places_;
  Vec2 center_{0, 0};
  double size_ = 1;                  ///< of the whole
  std::vector<Vec2> scaled_places_;  ///< relative to the center, with the whole scaled to size 1
  std::vector<std::array<std::size_t, 3>> triangles_;
  std::vector<std::size_t> border_;
};

/// Entries on a plane that share it by gradient bands: from an entry toward each other one its influence falls
/// linearly from 1 to 0; the least of these counts, and the weights are the influences divided by their sum. More than
/// three may show at once, two are enough, and all may lie on one line; weights change more smoothly than those of
/// triangles, but do not reproduce the parameter: a blend of speeds does not have exactly the speed requested.
///
/// Distances weight both axes equally. Beyond the entries the weights fade to those of the border.
/// Source: Johansen, "Automated Semi-Procedural Animation for Character Locomotion", 2009, 6.3.
class BlendBands {
 public:
  /// @throws std::invalid_argument listing all problems: fewer than two, two at one place (nearer than 1e-9 of the
  /// whole), places that are not finite
  explicit BlendBands(std::vector<Vec2> places);

  [[nodiscard]] std::span<const Vec2> places() const noexcept { return places_; }

  /// @param weights  written, one for each entry, in order
  void weights(const Sample<Vec2>& parameter, std::span<Sample<double>> weights, Side side = Side::out) const noexcept;

 private:
  std::vector<Vec2> places_;
  Vec2 center_{0, 0};
  double size_ = 1;
  std::vector<Vec2> scaled_places_;
};

}  // namespace tweenfall
