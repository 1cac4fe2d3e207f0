#pragma once

/// What holds a body to its path: one implicit spring, from infinitely stiff to absent.
///
/// Infinite frequency is *keyed*: the body is where its curve says, pushes and is not pushed.
/// Zero is *free*: physics alone moves it. Between, the body is *driven*: pulled toward its
/// path. The owner is derived from the drive and stored nowhere else.

#include <limits>

namespace tweenfall {

enum class Owner { keyed, driven, free };

struct Drive {
  /// What carries along the path of a driven body. A world alone knows of no parents: a stage leads the
  /// targets of its bodies.
  enum class Frame {
    world,   ///< nothing: the path stays where it was authored
    parent,  ///< the nearest ancestor that has a body, as that body really moves
    anchor,  ///< the topmost ancestor that has a body: a figure keeps its pose wherever its root really is
  };
  double hz = 0;    ///< undamped frequency of the pull, cycles per second; 0 free, infinity keyed
  double zeta = 1;  ///< damping ratio; 1 is critical
  double max_force = std::numeric_limits<double>::infinity();   ///< N
  double max_torque = std::numeric_limits<double>::infinity();  ///< N m
  double gravity_compensation = 0;  ///< share of a driven body's weight that is carried in addition to the pull, 0 to 1
  Frame frame = Frame::world;       ///< of a driven body; the body that carries it does not feel the pull

  [[nodiscard]] static constexpr Drive keyed() { return {.hz = std::numeric_limits<double>::infinity()}; }
  [[nodiscard]] static constexpr Drive free() { return {.hz = 0}; }
  [[nodiscard]] constexpr Owner owner() const {
    return hz == 0 ? Owner::free : hz == std::numeric_limits<double>::infinity() ? Owner::keyed : Owner::driven;
  }
  bool operator==(const Drive&) const = default;
};

}  // namespace tweenfall
