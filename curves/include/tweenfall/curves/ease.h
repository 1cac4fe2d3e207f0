#pragma once

/// How a curve leaves a key, as one small value: `hold`, `linear`, a tangent rule that looks
/// at the neighboring keys, or a shape that re-times the straight way to the next key.

#include <tweenfall/curves/span.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

struct SlopeProblem;
struct TurnProblem;

class Ease {
 public:
  /// What a key's ease means to the builder: no motion, a straight line, slopes from the neighboring keys
  /// (`smooth`, `smooth_clamped`, and `slopes` for all others), or a shape.
  enum class Rule { hold, linear, smooth, smooth_clamped, slopes, shape };

  /// Makes slopes from neighboring keys; `SlopeProblem` is private to the library.
  using SlopeRule = void (*)(const SlopeProblem& problem);
  /// Makes the spans of rotations for a run of keys; `TurnProblem` is private to the library.
  using TurnRule = void (*)(const TurnProblem& problem);
  /// Makes a shape for a span of `duration` seconds, for shapes that depend on the duration.
  using ShapeRule = std::vector<Span<double>> (*)(double duration, const std::array<double, 4>& parameters);

  /// One piece of a shape: on [from, to] of the span (fractions 0 to 1) the progress is the
  /// polynomial `coefficients` of the local position, through `warp`.
  using Piece = Span<double>;

  [[nodiscard]] static Ease hold();
  /// The next key's value right after this key: the curve arrives with this key's value (Side::in) and leaves with the
  /// next one's.
  [[nodiscard]] static Ease step_next();
  [[nodiscard]] static Ease linear();
  /// The slope at a key is the plain mean of the two neighboring secants; at an end that of the end's own secant.
  [[nodiscard]] static Ease smooth();
  /// As smooth, but zero at a local extreme and limited so that no span leaves its two values, per component.
  [[nodiscard]] static Ease smooth_clamped();
  /// Monotone between monotone data, per component. Source: Fritsch and Butland, 1984 ("pchip").
  [[nodiscard]] static Ease monotone();
  /// Slopes on which outliers have little effect. Source: Akima, 1970.
  [[nodiscard]] static Ease akima();
  /// As akima, but flat stretches stay flat and no step overshoots much ("modified Akima").
  [[nodiscard]] static Ease makima();
  /// Continuous acceleration over a run of such keys, zero at its ends; for rotations the angular acceleration.
  /// Source for rotations: Mayorov, "Smooth attitude interpolation", 2018.
  [[nodiscard]] static Ease natural();
  /// The same with given accelerations at the ends of the run, U/s^2, for every component: `start` of the run's first
  /// key and `end` of its last span are used.
  [[nodiscard]] static Ease natural(double start, double end);
  /// Continuous acceleration with the run's ends at rest, or at given slopes, U/s, for every component.
  [[nodiscard]] static Ease clamped();
  [[nodiscard]] static Ease clamped(double start, double end);
  /// Continuous acceleration where the run is one period: its end has the slope and acceleration of its start.
  [[nodiscard]] static Ease periodic();
  /// Continuous acceleration where the first two spans of the run are one cubic, and so are the last two.
  [[nodiscard]] static Ease not_a_knot();
  /// Catmull-Rom with the keys' own times: the slope is the mean of the secants, each weighted by the other's duration.
  /// Rotations: slerps of slerps between control rotations (De Casteljau), with those slopes at the keys.
  [[nodiscard]] static Ease catmull_rom();
  /// Catmull-Rom, zero at a local extreme and at most three times the smaller secant, per component.
  /// Source: Dougherty, Edelman, Hyman, 1989, equation 4.2.
  [[nodiscard]] static Ease catmull_rom_monotone();
  /// Catmull-Rom shaped as if every span took the same time, the square root of its distance (no cusps or loops in a
  /// path), or its distance, but at the keys' own times: directions are continuous at keys, speeds may not be.
  [[nodiscard]] static Ease uniform();
  [[nodiscard]] static Ease centripetal();
  [[nodiscard]] static Ease chordal();
  /// Kochanek and Bartels, 1984: tension, continuity and bias at this key; 0, 0, 0 is catmull_rom; -1e6 to 1e6 each.
  [[nodiscard]] static Ease tcb(double tension, double continuity, double bias);
  /// Rotations: the straight line between the two quaternions, scaled to unit length. Anything else: linear.
  [[nodiscard]] static Ease nlerp();
  /// Rotations: Shoemake's spherical quadrangle, 1987, for uneven times. Anything else: catmull_rom, its counterpart.
  [[nodiscard]] static Ease squad();
  /// Rotations: the recursion of Barry and Goldman, 1988, with slerps. Anything else: catmull_rom, its counterpart.
  [[nodiscard]] static Ease barry_goldman();
  /// An exact damped spring released at this key toward the next: undamped period in seconds, damping ratio. What is
  /// left of its motion at the next key is taken away smoothly over the span.
  /// @throws std::invalid_argument unless period lies in 1e-6 to 1e6 and damping_ratio in 0 to 1e6.
  [[nodiscard]] static Ease spring(double period, double damping_ratio);
  /// CSS cubic-bezier. @throws std::invalid_argument unless x1 and x2 lie in 0 to 1, y1 and y2 in -1e6 to 1e6.
  [[nodiscard]] static Ease bezier(double x1, double y1, double x2, double y2);

  /// A progress curve over the unit interval, in pieces; from (0, 0) to (1, 1) unless it is meant to jump.
  [[nodiscard]] static Ease shape(std::string name, std::vector<Piece> pieces);

  /// The ease that a word or call names: "hold", "quad-in", "bezier(0.4,0,0.2,1)", ... as the document spells them.
  /// Empty where there is no such ease or its numbers are out of range; `reason` then says why.
  [[nodiscard]] static std::optional<Ease> named(std::string_view word, std::string* reason = nullptr);

  /// Our word for an ease that other programs call by this name: Penner's libraries ("easeInQuad", "quadIn"), CSS in
  /// camel case, Blender ("BEZIER", "SINE"), Maya ("spline", "plateau"). Empty where no such name is known.
  [[nodiscard]] static std::string ours(std::string_view foreign);

  /// All the words and call forms that `named` knows, in the order the documentation lists them.
  [[nodiscard]] static std::vector<std::string> names();

  /// The ease with any slopes or accelerations that it states, as clamped(a,b) does, multiplied by `factor`: for values
  /// that are converted to another unit.
  [[nodiscard]] Ease scaled(double factor) const;

  [[nodiscard]] Rule rule() const noexcept;
  [[nodiscard]] const std::string& name() const noexcept;  ///< as `named` would read it back
  /// The pieces of a shape over the unit interval; for a spring the pieces for a span of one second.
  [[nodiscard]] const std::vector<Piece>& pieces() const noexcept;
  /// The pieces for a span of `duration` seconds.
  [[nodiscard]] std::vector<Piece> pieces_for(double duration) const;
  [[nodiscard]] SlopeRule slope_rule() const noexcept;
  [[nodiscard]] TurnRule turn_rule() const noexcept;  ///< null: slerp, hold, shape or Hermite
  [[nodiscard]] const std::array<double, 4>& parameters() const noexcept;

  bool operator==(const Ease& other) const noexcept { return form_ == other.form_ || name() == other.name(); }

  /// Progress at `u` in 0 to 1 of a shape, with derivatives in u. Precondition: rule() == Rule::shape.
  [[nodiscard]] Sample<double> progress(double u, Side side = Side::out) const noexcept;

  struct Form;  ///< private to the library
  explicit Ease(Form form);
  [[nodiscard]] const Form& form() const noexcept { return *form_; }

  // A move is a copy: that is just as cheap, and the object moved from stays valid.
  Ease(const Ease&) noexcept = default;
  Ease& operator=(const Ease&) noexcept = default;

 private:
  std::shared_ptr<const Form> form_;
};

}  // namespace tweenfall
