#include "blending/delaunay.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace tweenfall::blending {
namespace {

constexpr double flat = 1e-12;  // of the unit square's area

double crossed(const Vec2& a, const Vec2& b) noexcept {
  return a[0] * b[1] - a[1] * b[0];
}

// Above 0 where d lies inside the circle through a, b, c, which are counter-clockwise.
double inside_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  const Vec2 u = a - d, v = b - d, w = c - d;
  return u.squaredNorm() * crossed(v, w) - v.squaredNorm() * crossed(u, w) + w.squaredNorm() * crossed(u, v);
}

class Sweep {
 public:
  explicit Sweep(std::span<const Vec2> points) : points_(points) {}

  // Point by point from left to right, each joined to the border's edges that it sees.
  void run() {
    std::vector<std::size_t> order(points_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return std::pair(points_[a][0], points_[a][1]) < std::pair(points_[b][0], points_[b][1]);
    });
    std::vector<std::size_t>& border = result.border;
    for (const std::size_t p : order) {
      if (result.triangles.empty())
        start(p);
      else
        join(p);
    }
    if (result.triangles.empty()) border.clear();
  }

  // Edges whose opposite corner lies inside the circumcircle are flipped, until there are none.
  void turn_edges() {
    using Edge = std::pair<std::size_t, std::size_t>;
    std::vector<Triangle>& triangles = result.triangles;
    std::map<Edge, std::array<std::size_t, 2>> sides;
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<Edge> waiting;
    const auto edge = [](std::size_t a, std::size_t b) { return a < b ? Edge(a, b) : Edge(b, a); };
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [at, fresh] =
            sides.try_emplace(edge(triangles[t][i], triangles[t][(i + 1) % 3]), std::array{t, none});
        if (!fresh) at->second[1] = t;
        if (!fresh) waiting.push_back(at->first);
      }
    // Each flip improves the triangulation by more than rounding, so this ends; the bound is only a
    // safeguard.
    std::size_t turns = 0;
    const std::size_t most = 100 * points_.size() * points_.size();
    while (!waiting.empty() && turns < most) {
      const Edge shared = waiting.back();
      waiting.pop_back();
      const auto found = sides.find(shared);
      if (found == sides.end() || found->second[1] == none) continue;
      const std::size_t first = found->second[0], second = found->second[1];
      const auto place = std::ranges::find_if(triangles[first],
                                              [&](std::size_t v) { return v != shared.first && v != shared.second; });
      const std::size_t i = static_cast<std::size_t>(place - triangles[first].begin());
      const std::size_t c = triangles[first][i], a = triangles[first][(i + 1) % 3], b = triangles[first][(i + 2) % 3];
      const std::size_t d = *std::ranges::find_if(
          triangles[second], [&](std::size_t v) { return v != shared.first && v != shared.second; });
      if (!(inside_circle(points_[a], points_[b], points_[c], points_[d]) > flat)) continue;
      if (!(turn_of(points_, c, a, points_[d]) > flat && turn_of(points_, d, b, points_[c]) > flat)) continue;
      ++turns;
      triangles[first] = {c, a, d};
      triangles[second] = {d, b, c};
      sides.erase(found);
      sides[edge(c, d)] = {first, second};
      replace(sides[edge(a, d)], second, first);
      replace(sides[edge(b, c)], first, second);
      for (const Edge& around : {edge(c, a), edge(a, d), edge(d, b), edge(b, c)}) waiting.push_back(around);
    }
  }

  Triangulation result;

 private:
  static void replace(std::array<std::size_t, 2>& sides, std::size_t from, std::size_t to) noexcept {
    for (std::size_t& side : sides)
      if (side == from) side = to;
  }

  void start(std::size_t p) {
    std::vector<std::size_t>& line = result.border;
    const std::size_t count = line.size();
    const double turn = count < 2 ? 0 : turn_of(points_, line.front(), line.back(), points_[p]);
    if (std::abs(turn) > flat) {
      if (turn < 0) std::ranges::reverse(line);
      for (std::size_t i = 0; i + 1 < count; ++i) result.triangles.push_back({line[i], line[i + 1], p});
    }
    line.push_back(p);
  }

  void join(std::size_t p) {
    std::vector<std::size_t>& border = result.border;
    const std::size_t count = border.size();
    const auto sees = [&](std::size_t i) {
      return turn_of(points_, border[i % count], border[(i + 1) % count], points_[p]) < -flat;
    };
    std::size_t first = 0;
    while (first < count && !(sees(first) && !sees(first + count - 1))) ++first;
    if (first == count) return;  // within rounding of the border
    std::size_t last = first;
    while (last < first + count && sees(last)) {
      result.triangles.push_back({border[(last + 1) % count], border[last % count], p});
      ++last;
    }
    std::vector<std::size_t> next{p};
    for (std::size_t i = last; i % count != first; ++i) next.push_back(border[i % count]);
    next.push_back(border[first]);
    border = std::move(next);
  }

  std::span<const Vec2> points_;
};

}  // namespace

double turn_of(std::span<const Vec2> points, std::size_t a, std::size_t b, const Vec2& p) noexcept {
  if (a > b) return -turn_of(points, b, a, p);
  return crossed(points[b] - points[a], p - points[a]);
}

Triangulation delaunay(std::span<const Vec2> points) {
  Sweep sweep(points);
  sweep.run();
  sweep.turn_edges();
  return std::move(sweep.result);
}

}  // namespace tweenfall::blending
