#pragma once

/// The few forms that every curve is reduced to: a polynomial over a stretch of time, seen through an optional warp of
/// that stretch.
///
/// Tangent rules, easings, Bezier handles and splines are all *builders*: they turn keys into
/// spans, and the evaluator knows none of them by name. An easing is a straight line seen through a warp; a Bezier span
/// with weighted handles is a cubic seen through the inverse of its handles' own cubic in time; bounces and steps are
/// several plain spans.

#include <tweenfall/curves/values.h>

#include <array>

namespace tweenfall {

/// A monotone or oscillating re-timing of a span: s = warp(u), with derivatives.
struct Warp {
  struct Result {
    double s, ds, dds;  ///< position, first and second derivative with respect to u
  };
  using Function = Result (*)(double u, const std::array<double, 4>& parameters) noexcept;

  Function function = nullptr;         ///< null: s = u
  std::array<double, 4> parameters{};  ///< handed to the function unchanged
  double from = 0, width = 1;          ///< the stretch of the function that is used: it is evaluated at from + width u

  /// The warp at u, 0 to 1. Precondition: `function` is set.
  [[nodiscard]] Result at(double u) const noexcept {
    const Result r = function(from + width * u, parameters);
    return {r.s, width * r.ds, width * width * r.dds};
  }

  bool operator==(const Warp&) const = default;
};

/// Highest polynomial degree a span can have.
inline constexpr int max_degree = 5;

/// value(t) = sum of coefficients[i] s^i, with s = warp((t - start) / duration).
template <class T>
struct Span {
  double start = 0;                            ///< s
  double duration = 1;                         ///< s; > 0
  int degree = 0;                              ///< 0 to max_degree
  std::array<T, max_degree + 1> coefficients;  ///< power basis in s; entries above degree are not read
  T end;                                       ///< value on arrival at start + duration, exactly
  Warp warp = {};
  bool starts_at_key = true;  ///< false inside a shape of several pieces, such as half way through quad-in-out
};

/// Rows of coefficients that a stretch of rotation has room for.
inline constexpr int rotation_rows = 8;

/// A stretch of rotation, exp(s spin) times the rotation that its form defines:
/// `exponential`: from * exp(r(s)), r a polynomial of rotation vectors in the first three parts.
/// `normalized`: the polynomial of four parts (x, y, z, w), scaled to unit length; `from` is not read.
/// `nested`: slerps of slerps. Rows 0 to 2 are rotations P (x, y, z, w), rows 3 to 5 rotation vectors V: three turns at
///     constant speed, G = P exp(s V). The first two are mixed by the weight a + b s, the last two by c + d s, where
///     row 6 is (a, b, c, d), and the two results by f s + g s^2, where row 7 is (f, g, 0, 0). The mix of A and B by w
///     is A exp(w log(A^-1 B)); the signs of the quaternions say which way. `degree` and `from` are not read.
struct RotationSpan {
  enum class Form { exponential, normalized, nested };

  double start = 0;
  double duration = 1;
  Form form = Form::exponential;
  int degree = 0;
  std::array<Vec4, rotation_rows> coefficients;
  Quat from{1, 0, 0, 0};
  Quat end{1, 0, 0, 0};
  Warp warp = {};
  Vec3 spin{0, 0, 0};  ///< outer axes; for spans to join, whole turns about the axis of the form's own turn
  bool starts_at_key = true;
};

template <class T>
struct SpanOf {
  using type = Span<T>;
};
template <>
struct SpanOf<Quat> {
  using type = RotationSpan;
};

}  // namespace tweenfall
