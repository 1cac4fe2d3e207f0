#pragma once

// A chain with limits, in coordinates of its joints, and Newton's method down to where its end is nearest to a target.
//
// A hinge has its angle; a socket the rotation vector of its swing, in a disc, and its twist; a joint without a limit
// the rotation vector from where it is. Second derivatives are exact, so the last steps double the digits even where
// the target is out of reach: there, least squares would creep.

#include "chains/chain_shape.h"
#include "chains/search/plain_or_dual.h"

namespace tweenfall::chains {

template <class Number>
class LimitedDescent {
 public:
  /// Chains of more coordinates are too slow for dense matrices.
  static constexpr std::size_t room = 72;
  static constexpr std::size_t room_joints = ChainShape::room;

  [[nodiscard]] static std::size_t coordinates_of(const ChainShape& shape) noexcept;

  /// @param shape  which must outlive it; its turns are the beginning
  LimitedDescent(const ChainShape& shape, const Arrow& target) noexcept;

  /// Begins where the shape is.
  void begin() noexcept;
  /// Begins at a pose within the limits, the same one for the same number. @param share  of the way there from the
  /// shape
  void begin(int number, double share) noexcept;

  /// Begins at a pose that another has found.
  template <class Other>
  void begin(const LimitedDescent<Other>& other) noexcept;

  enum class End { reached, nearest, tired, hopeless };
  /// @param steps     at most
  /// @param no_worse  hopeless where it seems to lead no nearer than this, m
  End run(int steps, double no_worse) noexcept;
  /// How much the turns from where the shape is count: as their square, in squares of the chain's length. 0: nothing.
  void hold(double strength) noexcept;
  /// Newton steps without care, after `run`: places that stand there anyway, but with the rates that belong to them.
  /// @param frozen  whether what stood at a limit in the step before stays there
  void settle(int steps, double damping, bool frozen) noexcept;

  [[nodiscard]] double distance() const noexcept;
  /// How far the joints are turned from where the shape is, rad: root of the sum of squares.
  [[nodiscard]] double turned() const noexcept;
  [[nodiscard]] Turning turn(std::size_t i) const noexcept;

 private:
  template <class Other>
  friend class LimitedDescent;
  using Vector = Three<Number>;
  using Rotation = Nine<Number>;
  enum class Kind { hinge, socket, free };
  struct Joint {
    Kind kind;
    std::size_t first;          // of its coordinates
    Vec3 axis, across, beside;  // of the turn or twist, and at right angles
    double low, high, swing;
    Rotation before;  // from the axes of the joint before to those of its rest pose
    Vector bone;
  };
  struct State {
    Number at[room];
    Rotation free[room_joints];  // turns of the joints without limits
  };
  // A direction in which the joints can turn from where they are.
  struct Way {
    std::size_t joint, first;  // coordinate
    bool is_swing, is_rim;     // of the two coordinates of a socket's swing; or along the rim of its disc:
    Number x, y;               // how both change
    Number rim;                // curvature of the rim, as part of the second derivative
    Vector spin, column;       // how all behind it turn, and how the end moves
    Vector slanted;            // column + miss x spin
    Number slope;
    bool is_stopped;  // by its limit, in this step
  };

  static void bound(const Joint& joint, Number* at) noexcept;
  void to_shape(State& state) const noexcept;
  void along_rim(Way& way) const noexcept;
  Way& add(std::size_t i, std::size_t k) noexcept;
  [[nodiscard]] Vector log_of_free(std::size_t i) const noexcept;
  void place() noexcept;
  void keep() noexcept;
  void restore() noexcept;
  void slopes() noexcept;
  void open() noexcept;
  void open_again() noexcept;
  void prepare(bool frozen) noexcept;
  [[nodiscard]] Number away(std::size_t i, std::size_t k) const noexcept;
  bool solve(double damping) noexcept;
  bool solve_unstopped(double damping) noexcept;
  bool stop() noexcept;
  void move() noexcept;
  [[nodiscard]] Number curvature(const Way& a, const Way& b) const noexcept;

  const ChainShape& shape_;
  const std::size_t count_;
  Vector start_, target_;
  Number square_;  // of the chain's length
  Joint joint_[room_joints];
  State state_, kept_, home_;
  double strength_ = 0;
  std::size_t coordinates_;

  // What follows from the state.
  Rotation outer_[room_joints];  // of a joint's rest pose
  Vector place_[room_joints + 1];
  Number sines_[room_joints][3];  // of a swing u: sin u / u, (1 - cos u) / u^2, (u - sin u) / u^3
  Vector miss_;
  Number worth_;  // half the square of the distance

  Number swings_[room_joints][3];  // second derivatives by x x, x y, y y of a swing
  Vector spin_[room], column_[room];
  Number slope_[room];
  std::size_t ways_ = 0;
  Way way_[room];
  Number matrix_[room][room], step_[room], pull_[room];
};

extern template class LimitedDescent<double>;
extern template class LimitedDescent<Dual>;

}  // namespace tweenfall::chains
