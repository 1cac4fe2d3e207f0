#include "geometry/profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/components.h"

namespace tweenfall::geometry {
namespace {

// Cosine of two degrees: a sharper bend is an edge, a lesser one is smooth.
constexpr double smooth = 0.9994;

Vec2 direction(const Sample<Vec2>& s, double sign, const Vec2& fallback) {
  const double speed = s.rate.norm(), pull = s.acceleration.norm();
  if (speed > 0) return s.rate / speed;
  return pull > 0 ? Vec2((sign / pull) * s.acceleration) : fallback;
}

double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace

template <class T>
std::vector<double> step_times(const Curve<T>& curve, int steps, bool keep_straight, const std::string& what) {
  if (steps < 1) throw std::invalid_argument(what + " needs at least one step; " + std::to_string(steps) + " given");
  if (!(curve.duration() > 0) || !std::isfinite(curve.duration()))
    throw std::invalid_argument(what + " must begin and end; it leads from " + spans::text_of(curve.start()) +
                                " s to " + spans::text_of(curve.end()) + " s");
  std::vector<double> knots(curve.knots().begin(), curve.knots().end());
  if (knots.size() < 2) knots = {curve.start(), curve.end()};
  const auto spans = curve.spans();
  std::vector<double> times = {knots[0]};
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double duration = knots[i + 1] - knots[i];
    const bool straight = keep_straight && i < spans.size() && spans[i].degree <= 1 && !spans[i].warp.function;
    const int parts = straight ? 1 : static_cast<int>(std::ceil(steps * (duration / curve.duration()) - 1e-9));
    for (int k = 1; k < parts; ++k) times.push_back(knots[i] + duration * k / parts);
    times.push_back(knots[i + 1]);
  }
  return times;
}

template std::vector<double> step_times(const Curve<Vec2>&, int, bool, const std::string&);
template std::vector<double> step_times(const Curve<Vec3>&, int, bool, const std::string&);

Profile::Profile(const Curve<Vec2>& curve, int steps, bool keep_straight) {
  const std::vector<double> times = step_times(curve, steps, keep_straight, "a profile");
  std::vector<Vec2> points;
  points.reserve(times.size());
  for (const double t : times) points.push_back(curve.value(t, t == times.front() ? Side::out : Side::in));
  double length = 0, size = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  for (const Vec2& p : points) {
    if (!spans::all_finite(p)) throw std::invalid_argument("a profile must be finite; it reaches " + spans::text_of(p));
    size = std::max(size, p.norm());
  }
  if (!(length > 0))
    throw std::invalid_argument("a profile must have a length; it stays at " + spans::text_of(points[0]));
  closed = points.size() > 3 && (points.front() - points.back()).norm() <= 1e-9 * std::max(size, length);
  if (closed) points.back() = points.front();

  double along = 0;
  const auto add = [&](std::size_t i, Side side, const Vec2& chord) {
    const double t = times[i];
    columns.push_back({points[i], direction(curve.sample(t, side), side == Side::out ? 1 : -1, chord), along / length});
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 step = points[i + 1] - points[i];
    const double reach = step.norm();
    if (!(reach > 0)) continue;
    const Vec2 chord = step / reach;
    if (columns.empty() || direction(curve.sample(times[i], Side::out), 1, chord).dot(columns.back().tangent) < smooth)
      add(i, Side::out, chord);
    corners.push_back(static_cast<std::uint32_t>(columns.size() - 1));
    sides.push_back(static_cast<std::uint32_t>(columns.size() - 1));
    along = std::min(along + reach, length);
    add(i + 1, Side::in, chord);
  }
  columns.back().share = 1;
  if (closed) {
    // Where the profile closes smoothly, both columns there share one tangent.
    if (columns.front().tangent.dot(columns.back().tangent) >= smooth) columns.back().tangent = columns.front().tangent;
  } else {
    corners.push_back(static_cast<std::uint32_t>(columns.size() - 1));
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += 0.5 * cross(columns[corners[i]].position, columns[corners[(i + 1) % corners.size()]].position);
}

void Profile::reverse() {
  const auto last = static_cast<std::uint32_t>(columns.size() - 1);
  std::reverse(columns.begin(), columns.end());
  for (Column& each : columns) {
    each.tangent = -each.tangent;
    each.share = 1 - each.share;
  }
  for (std::uint32_t& side : sides) side = last - (side + 1);
  std::reverse(sides.begin(), sides.end());
  for (std::uint32_t& corner : corners) corner = last - corner;
  std::reverse(corners.begin(), corners.end());
  area = -area;
}

std::vector<std::uint32_t> polygon_triangles(const std::vector<Vec2>& points) {
  std::vector<std::uint32_t> left(points.size()), triangles;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
  double twice_area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) twice_area += cross(points[i], points[(i + 1) % points.size()]);
  const double way = twice_area < 0 ? -1 : 1;
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return way * cross(points[b] - points[a], points[c] - points[a]);
  };
  const auto is_ear = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t p : left)
      if (p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    return true;
  };
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t best = 0;
    double widest = -1;
    bool found = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
      const double width = turn(a, b, c);
      // The widest ear first; where every ear touches other points, the widest corner.
      const bool ear = width > 0 && (width > widest || !found) && is_ear(a, b, c);
      if (ear || (!found && width > widest)) {
        best = i;
        widest = width;
        found = found || ear;
      }
    }
    triangles.insert(triangles.end(), {left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

}  // namespace tweenfall::geometry
