#pragma once

/// How a curve leaves a key, as one small value: `hold`, `linear`, a tangent rule that looks
/// at the neighboring keys, or a shape that re-times the straight way to the next key.

#include <tweenfall/curves/span.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

class Ease {
 public:
  /// Rules that make slopes from neighbors.
  enum class Rule { hold, linear, smooth, smooth_clamped, shape };

  /// One piece of a shape: on [from, to] of the span (fractions 0 to 1) the progress is the
  /// polynomial `coefficients` of the local position, through `warp`.
  using Piece = Span<double>;

  [[nodiscard]] static Ease hold();
  [[nodiscard]] static Ease linear();
  /// Slope at a key = plain mean of the two neighboring secants; at an end the end's own secant.
  [[nodiscard]] static Ease smooth();
  /// As smooth, but zero at a local extreme and limited so that no span leaves its two values, per component.
  [[nodiscard]] static Ease smooth_clamped();
  /// A progress curve over the unit interval, in pieces; (0, 0) to (1, 1) unless it means to jump.
  [[nodiscard]] static Ease shape(std::string name, std::vector<Piece> pieces);

  /// The ease that a word or call names: "hold", "quad-in", "bezier(0.4,0,0.2,1)", ... as the document spells them.
  /// Empty where there is none of that name or its numbers are out of range; `reason` then says why.
  [[nodiscard]] static std::optional<Ease> named(std::string_view word, std::string* reason = nullptr);

  /// All the words and call forms that `named` knows, in the order the documentation lists them.
  [[nodiscard]] static std::vector<std::string> names();

  [[nodiscard]] Rule rule() const noexcept { return rule_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }  ///< as `named` would read it back
  [[nodiscard]] const std::vector<Piece>& pieces() const noexcept { return pieces_; }

  /// Progress at `u` in 0 to 1 of a shape, with derivatives in u. Precondition: rule() == Rule::shape.
  [[nodiscard]] Sample<double> progress(double u, Side side = Side::out) const noexcept;

 private:
  Ease(Rule rule, std::string name, std::vector<Piece> pieces);

  Rule rule_;
  std::string name_;
  std::vector<Piece> pieces_;
};

}  // namespace tweenfall
