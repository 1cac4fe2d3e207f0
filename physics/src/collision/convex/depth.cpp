#include "collision/convex/depth.h"

#include <array>
#include <cmath>

namespace tweenfall::convex {

namespace {

constexpr std::uint32_t no_facet = 0xffffffffu;
constexpr std::size_t most_points = 160, most_facets = 2 * most_points;

struct DifferencePoint {
  Vec3 apart, on_a, on_b;
};

struct DifferenceFacet {
  std::array<std::uint32_t, 3> corners, across;  ///< `across` the edge from each corner to the next
  Vec3 normal;
  double height = 0;  ///< of its plane over the origin, m
  bool alive = false;
};

/// A side of the hole that a new point makes.
struct HoleEdge {
  std::uint32_t from, to, beyond, side;
};

class Difference {
 public:
  Difference(Core& a, Core& b)
      : a_(a), b_(b), extent_(a.reach + b.reach + (a.shift - b.shift).norm()), flat_(1e-13 * extent_) {}

  Depth find() {
    best_.depth = 1e300;
    if (!begin()) return flat();
    const double enough = std::max(1e-11 * std::min(a_.reach + a_.radius, b_.reach + b_.radius), 4e-16 * extent_);
    while (count_ < most_points) {
      const std::uint32_t nearest = nearest_facet();
      if (nearest == no_facet) break;
      const DifferenceFacet facet = facets_[nearest];
      const DifferencePoint point = farthest(facet.normal);
      const double height = facet.normal.dot(point.apart);
      if (height < best_.depth) note(facet, height);
      if (height - facet.height <= enough || !grow(point, nearest)) break;
    }
    return best_;
  }

 private:
  [[nodiscard]] DifferencePoint farthest(const Vec3& direction) {
    DifferencePoint point;
    point.on_a = a_.support(direction);
    point.on_b = b_.support(-direction);
    point.apart = point.on_a - point.on_b;
    return point;
  }

  std::uint32_t add_point(const DifferencePoint& point) {
    points_[count_] = point;
    return static_cast<std::uint32_t>(count_++);
  }

  /// `no_facet` if the three points are almost on a line.
  std::uint32_t add_facet(std::uint32_t i, std::uint32_t k, std::uint32_t l) {
    const Vec3 &a = points_[i].apart, &b = points_[k].apart, &c = points_[l].apart;
    Vec3 normal = (b - a).cross(c - a);
    const double length = normal.norm();
    if (!(length > 1e-26 * extent_ * extent_) || facet_count_ == most_facets) return no_facet;
    normal /= length;
    DifferenceFacet& facet = facets_[facet_count_];
    facet = {{i, k, l}, {no_facet, no_facet, no_facet}, normal, 0, true};
    // The corner farthest back gives the best bound.
    facet.height = std::max(normal.dot(a), std::max(normal.dot(b), normal.dot(c)));
    return static_cast<std::uint32_t>(facet_count_++);
  }

  [[nodiscard]] DifferencePoint farther(const Vec3& direction, const Vec3& from) {
    const DifferencePoint ahead = farthest(direction), behind = farthest(-direction);
    return std::abs(direction.dot(ahead.apart - from)) >= std::abs(direction.dot(behind.apart - from)) ? ahead : behind;
  }

  /// Makes a tetrahedron of points far apart; false if there is none.
  bool begin() {
    int widest = 0;
    std::array<DifferencePoint, 2> ends = {farthest(-Vec3::Unit(0)), farthest(Vec3::Unit(0))};
    double most = ends[1].apart.x() - ends[0].apart.x();
    for (int i = 1; i < 3; ++i) {
      const DifferencePoint low = farthest(-Vec3::Unit(i)), high = farthest(Vec3::Unit(i));
      const double width = high.apart[i] - low.apart[i];
      if (!(width > most)) continue;
      most = width;
      widest = i;
      ends = {low, high};
    }
    if (!(most > flat_)) return false;
    const Vec3 along = (ends[1].apart - ends[0].apart).normalized();
    const Vec3 aside = along.cross(Vec3::Unit((widest + 1) % 3)).normalized();
    DifferencePoint third = farther(aside, ends[0].apart);
    const Vec3 other = along.cross(aside);
    const DifferencePoint fourth = farther(other, ends[0].apart);
    const auto off = [&](const DifferencePoint& point) { return along.cross(point.apart - ends[0].apart).norm(); };
    if (off(fourth) > off(third)) third = fourth;
    normal_ = (ends[1].apart - ends[0].apart).cross(third.apart - ends[0].apart);
    if (!(normal_.norm() > flat_ * most)) return false;
    normal_.normalize();
    const DifferencePoint top = farther(normal_, ends[0].apart);
    const double side = normal_.dot(top.apart - ends[0].apart);
    if (!(std::abs(side) > flat_)) return false;
    const std::uint32_t a = add_point(ends[0]);
    std::uint32_t b = add_point(ends[1]), c = add_point(third);
    const std::uint32_t d = add_point(top);
    if (side > 0) std::swap(b, c);  // d is behind a, b, c
    if (add_facet(a, b, c) == no_facet || add_facet(a, d, b) == no_facet || add_facet(b, d, c) == no_facet ||
        add_facet(c, d, a) == no_facet)
      return false;
    facets_[0].across = {1, 2, 3};
    facets_[1].across = {3, 2, 0};
    facets_[2].across = {1, 3, 0};
    facets_[3].across = {2, 1, 0};
    return true;
  }

  /// Without a volume, the way out is perpendicular.
  Depth flat() {
    if (!normal_.allFinite() || !(normal_.norm() > 0.5)) return {};
    if (normal_.dot(b_.shift - a_.shift) < 0) normal_ = -normal_;
    const DifferencePoint point = farthest(normal_);
    return {normal_.dot(point.apart), normal_, point.on_a, point.on_b};
  }

  [[nodiscard]] std::uint32_t nearest_facet() const {
    std::uint32_t best = no_facet;
    double least = 1e300;
    for (std::uint32_t i = 0; i < facet_count_; ++i) {
      if (!facets_[i].alive || !(facets_[i].height < least)) continue;
      least = facets_[i].height;
      best = i;
    }
    return best;
  }

  /// Notes the depth along a facet's normal, and the points behind its corners, if the origin is below the facet.
  void note(const DifferenceFacet& facet, double height) {
    best_.depth = height;
    best_.normal = facet.normal;
    const DifferencePoint &a = points_[facet.corners[0]], &b = points_[facet.corners[1]],
                          &c = points_[facet.corners[2]];
    const Vec3 foot = facet.height * facet.normal;
    const Vec3 across = (b.apart - a.apart).cross(c.apart - a.apart);
    const double all = across.squaredNorm();
    double of_b = across.dot((foot - a.apart).cross(c.apart - a.apart)) / all;
    double of_c = across.dot((b.apart - a.apart).cross(foot - a.apart)) / all;
    of_b = std::min(1.0, std::max(0.0, of_b));
    of_c = std::min(1.0 - of_b, std::max(0.0, of_c));
    const double of_a = 1 - of_b - of_c;
    best_.on_a = of_a * a.on_a + of_b * b.on_a + of_c * c.on_a;
    best_.on_b = of_a * a.on_b + of_b * b.on_b + of_c * c.on_b;
  }

  /// Finds the facets that the point sees, connected with the first, and their border; false unless that is one simple
  /// loop.
  bool look(const Vec3& point, std::uint32_t first, double threshold) {
    seen_count_ = hole_count_ = 0;
    ++mark_;
    seen_[seen_count_++] = first;
    marks_[first] = mark_;
    for (std::size_t i = 0; i < seen_count_; ++i)
      for (const std::uint32_t next : facets_[seen_[i]].across) {
        const DifferenceFacet& facet = facets_[next];
        if (marks_[next] == mark_ || !(facet.normal.dot(point) - facet.height > threshold)) continue;
        marks_[next] = mark_;
        seen_[seen_count_++] = next;
      }
    for (std::size_t i = 0; i < seen_count_; ++i) {
      const DifferenceFacet& facet = facets_[seen_[i]];
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t beyond = facet.across[k];
        if (marks_[beyond] == mark_) continue;
        const std::uint32_t to = facet.corners[(k + 1) % 3];
        std::uint32_t side = 0;
        while (side < 2 && facets_[beyond].corners[side] != to) ++side;
        hole_[hole_count_++] = {facet.corners[k], to, beyond, side};
      }
    }
    return is_loop();
  }

  [[nodiscard]] bool is_loop() {
    if (hole_count_ < 3) return false;
    for (std::size_t i = 0; i < hole_count_; ++i) starts_[hole_[i].from] = no_facet;
    for (std::size_t i = 0; i < hole_count_; ++i) {
      if (starts_[hole_[i].from] != no_facet) return false;
      starts_[hole_[i].from] = static_cast<std::uint32_t>(i);
    }
    std::size_t length = 0;
    std::uint32_t at = 0;
    do {
      at = starts_[hole_[at].to];
      ++length;
    } while (at != 0 && at != no_facet && length <= hole_count_);
    return at == 0 && length == hole_count_;
  }

  bool grow(const DifferencePoint& point, std::uint32_t first) {
    // Facets in one plane with the point are seen too, unless rounding tears the border.
    if (!look(point.apart, first, -flat_) && !look(point.apart, first, 0) && !look(point.apart, first, flat_))
      return false;
    pack();
    const std::uint32_t tip = add_point(point);
    std::array<std::uint32_t, most_facets> made;
    for (std::size_t i = 0; i < hole_count_; ++i) {
      made[i] = add_facet(hole_[i].from, hole_[i].to, tip);
      if (made[i] == no_facet) return false;
      facets_[made[i]].across[0] = hole_[i].beyond;
      facets_[hole_[i].beyond].across[hole_[i].side] = made[i];
    }
    for (std::size_t i = 0; i < hole_count_; ++i) {
      const std::uint32_t next = made[starts_[hole_[i].to]];
      facets_[made[i]].across[1] = next;
      facets_[next].across[2] = made[i];
    }
    return true;
  }

  /// Fills the places of removed facets with later ones.
  void pack() {
    for (std::size_t i = 0; i < seen_count_; ++i) facets_[seen_[i]].alive = false;
    std::array<std::uint32_t, most_facets> moved;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < facet_count_; ++i) {
      moved[i] = count;
      if (facets_[i].alive) facets_[count++] = facets_[i];
    }
    facet_count_ = count;
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t& across : facets_[i].across) across = moved[across];
    for (std::size_t i = 0; i < hole_count_; ++i) hole_[i].beyond = moved[hole_[i].beyond];
    marks_.fill(0);
  }

  Core& a_;
  Core& b_;
  double extent_, flat_;
  std::array<DifferencePoint, most_points> points_;
  std::array<DifferenceFacet, most_facets> facets_;
  std::size_t count_ = 0, facet_count_ = 0;
  std::array<std::uint32_t, most_facets> seen_, marks_{};
  std::size_t seen_count_ = 0, hole_count_ = 0;
  std::uint32_t mark_ = 0;
  std::array<HoleEdge, 3 * most_facets> hole_;
  std::array<std::uint32_t, most_points> starts_;
  Vec3 normal_{0, 0, 0};
  Depth best_;
};

}  // namespace

Depth depth_of(Core& a, Core& b) {
  return Difference(a, b).find();
}

}  // namespace tweenfall::convex
