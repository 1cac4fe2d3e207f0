#include "shapes/hulls/hull_triangles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tweenfall::shapes {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

struct Facet {
  HullTriangle triangle;
  Vec3 normal{0, 0, 0};
  double offset = 0;
  std::vector<std::uint32_t> outside{};  ///< points above this facet; each point is in the list of one facet only
  bool alive = true;
};

/// An edge of the border of what a point sees.
struct HorizonEdge {
  std::uint32_t from, to;
  std::uint32_t beyond;  ///< the facet that stays
  std::size_t side;      ///< its side along this edge
};

[[noreturn]] void refuse_flat(std::size_t count, const std::string& where) {
  throw std::invalid_argument("a convex hull needs points that enclose a volume, but all " + std::to_string(count) +
                              " points lie " + where);
}

template <class Score>
std::uint32_t greatest(std::span<const Vec3> points, Score score) {
  std::uint32_t best = 0;
  double most = score(points[0]);
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    const double value = score(points[i]);
    if (value > most) {
      most = value;
      best = i;
    }
  }
  return best;
}

class QuickHull {
 public:
  QuickHull(std::span<const Vec3> points, double flat) : points_(points), flat_(flat), starts_(points.size(), nobody) {
    begin();
    for (std::uint32_t i = 0; i < facets_.size(); ++i)
      while (facets_[i].alive && !facets_[i].outside.empty()) add_farthest_of(i);
  }

  [[nodiscard]] std::vector<HullTriangle> triangles() const {
    std::vector<std::uint32_t> number(facets_.size(), nobody);
    std::vector<HullTriangle> result;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      if (!facets_[i].alive) continue;
      number[i] = static_cast<std::uint32_t>(result.size());
      result.push_back(facets_[i].triangle);
    }
    for (HullTriangle& triangle : result)
      for (std::uint32_t& across : triangle.across) across = number[across];
    return result;
  }

 private:
  [[nodiscard]] double height(const Facet& facet, std::uint32_t point) const {
    return facet.normal.dot(points_[point]) - facet.offset;
  }

  std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Facet facet;
    facet.triangle.corners = {a, b, c};
    facet.normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    facet.normal /= facet.normal.norm();
    facet.offset = facet.normal.dot(points_[a]);
    facets_.push_back(std::move(facet));
    return static_cast<std::uint32_t>(facets_.size() - 1);
  }

  /// A tetrahedron of points far apart.
  void begin() {
    Vec3 low = points_[0], high = low;
    for (const Vec3& point : points_) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    int axis = 0;
    const double extent = (high - low).maxCoeff(&axis);
    if (extent == 0) refuse_flat(points_.size(), "at one place");
    const std::uint32_t a = greatest(points_, [&](const Vec3& p) { return -p[axis]; });
    const std::uint32_t b = greatest(points_, [&](const Vec3& p) { return p[axis]; });
    const Vec3 along = (points_[b] - points_[a]).normalized();
    const auto from_line = [&](const Vec3& p) { return along.cross(p - points_[a]).norm(); };
    const std::uint32_t c = greatest(points_, from_line);
    if (from_line(points_[c]) <= 16 * flat_) refuse_flat(points_.size(), "on one straight line");
    const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]).normalized();
    const std::uint32_t d = greatest(points_, [&](const Vec3& p) { return std::abs(normal.dot(p - points_[a])); });
    const double side = normal.dot(points_[d] - points_[a]);
    if (std::abs(side) <= 16 * flat_) refuse_flat(points_.size(), "in one plane");

    const std::uint32_t second = side < 0 ? b : c,
                        third = side < 0 ? c : b;  // d is behind the triangle a, second, third
    (void)add_facet(a, second, third);
    (void)add_facet(a, d, second);
    (void)add_facet(second, d, third);
    (void)add_facet(third, d, a);
    facets_[0].triangle.across = {1, 2, 3};
    facets_[1].triangle.across = {3, 2, 0};
    facets_[2].triangle.across = {1, 3, 0};
    facets_[3].triangle.across = {2, 1, 0};
    for (std::uint32_t i = 0; i < points_.size(); ++i) assign(i, 0);
  }

  /// Assigns a point to the facet, from `first` on, above which it is highest.
  void assign(std::uint32_t point, std::uint32_t first) {
    double most = flat_;
    std::uint32_t best = nobody;
    for (std::uint32_t i = first; i < facets_.size(); ++i) {
      const double above = height(facets_[i], point);
      if (above > most) {
        most = above;
        best = i;
      }
    }
    if (best != nobody) facets_[best].outside.push_back(point);
  }

  /// Finds the facets that the point sees, connected with the first, and their border; false unless that is one simple
  /// loop.
  bool look(std::uint32_t point, std::uint32_t first, double threshold) {
    visible_ = {first};
    horizon_.clear();
    std::vector<bool> seen(facets_.size(), false);
    seen[first] = true;
    for (std::size_t i = 0; i < visible_.size(); ++i)
      for (const std::uint32_t next : facets_[visible_[i]].triangle.across)
        if (!seen[next] && height(facets_[next], point) > threshold) {
          seen[next] = true;
          visible_.push_back(next);
        }
    for (const std::uint32_t index : visible_) {
      const HullTriangle& triangle = facets_[index].triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t beyond = triangle.across[k];
        if (seen[beyond]) continue;
        const std::uint32_t from = triangle.corners[k], to = triangle.corners[(k + 1) % 3];
        const auto& theirs = facets_[beyond].triangle.corners;
        const auto side = static_cast<std::size_t>(std::find(theirs.begin(), theirs.end(), to) - theirs.begin());
        horizon_.push_back({from, to, beyond, side});
      }
    }
    return is_loop();
  }

  bool is_loop() {
    if (horizon_.size() < 3) return false;
    for (const HorizonEdge& edge : horizon_) starts_[edge.from] = nobody;
    bool simple = true;
    for (std::uint32_t i = 0; i < horizon_.size(); ++i) {
      simple = simple && starts_[horizon_[i].from] == nobody;
      starts_[horizon_[i].from] = i;
    }
    if (!simple) return false;
    std::size_t length = 0;
    std::uint32_t at = 0;
    do {
      at = starts_[horizon_[at].to];
      ++length;
    } while (at != 0 && length <= horizon_.size());
    return length == horizon_.size();
  }

  void add_farthest_of(std::uint32_t index) {
    std::vector<std::uint32_t>& outside = facets_[index].outside;
    const auto farthest = std::max_element(outside.begin(), outside.end(), [&](std::uint32_t a, std::uint32_t b) {
      return height(facets_[index], a) < height(facets_[index], b);
    });
    const std::uint32_t point = *farthest;
    outside.erase(farthest);
    // Facets in one plane with the point are seen too, unless rounding tears the border.
    if (!look(point, index, -flat_) && !look(point, index, 0) && !look(point, index, flat_)) return;
    const auto first = static_cast<std::uint32_t>(facets_.size());
    for (const HorizonEdge& edge : horizon_) {
      const std::uint32_t made = add_facet(edge.from, edge.to, point);
      facets_[made].triangle.across[0] = edge.beyond;
      facets_[edge.beyond].triangle.across[edge.side] = made;
    }
    for (std::uint32_t i = 0; i < horizon_.size(); ++i) {
      const std::uint32_t next = starts_[horizon_[i].to];
      facets_[first + i].triangle.across[1] = first + next;
      facets_[first + next].triangle.across[2] = first + i;
    }
    for (const std::uint32_t gone : visible_) {
      facets_[gone].alive = false;
      for (const std::uint32_t orphan : std::exchange(facets_[gone].outside, {})) assign(orphan, first);
    }
  }

  std::span<const Vec3> points_;
  double flat_;
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> visible_;
  std::vector<HorizonEdge> horizon_;
  std::vector<std::uint32_t> starts_;  ///< by point: the horizon's edge that starts there
};

}  // namespace

double flat_distance(std::span<const Vec3> points) noexcept {
  Vec3 low = points[0], high = low;
  for (const Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return 0x1p-22 * (high - low).maxCoeff();
}

std::vector<HullTriangle> hull_triangles(std::span<const Vec3> points, double flat) {
  return QuickHull(points, flat).triangles();
}

}  // namespace tweenfall::shapes
