#pragma once

/// The functions that weight control points, for plotting and for sums; `hermite.h` has those of Hermite's cubic. The
/// weights of one degree are never negative and sum to 1, so a curve stays in the convex hull of its points.

#include <tweenfall/curves/values.h>

#include <cstddef>
#include <span>

namespace tweenfall {

/// Bernstein polynomial number `index` of `degree`: C(degree, index) u^index (1 - u)^(degree - index).
/// @param u  any number; the weight of a Bezier control point for 0 to 1
/// @return value and two derivatives with respect to u.
/// @throws std::invalid_argument unless degree is 0 to max_degree and index 0 to degree.
[[nodiscard]] Sample<double> bernstein(int degree, int index, double u);

/// B-spline basis function number `index` of `degree` over a full knot vector.
/// @param knots  not decreasing; index + degree + 2 of them or more
/// @param side   which limit at a knot; at the last knot always the arriving one
/// @return value and two derivatives with respect to t; 0 outside its knots.
/// Source: de Boor, "A Practical Guide to Splines", chapter IX.
/// @throws std::invalid_argument unless degree is 0 to max_degree and the knots suffice.
[[nodiscard]] Sample<double> b_spline_basis(std::span<const double> knots, int degree, std::size_t index, double t,
                                            Side side = Side::out);

}  // namespace tweenfall
