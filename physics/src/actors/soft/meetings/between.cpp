#include "actors/soft/meetings/between.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tweenfall::soft {

namespace {

/// The point of a triangle or edge nearest to a body is found by alternating between the two.
constexpr int looks = 6;

/// A point between two or three nodes.
struct Between {
  std::array<std::uint32_t, 3> nodes{};
  std::array<double, 3> share{};
  std::size_t count = 0;
};

/// The point of a segment nearest to a given point, as the share of the segment's second end.
double nearest_share(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 along = to - from;
  const double square = along.squaredNorm();
  return square > 0 ? std::clamp(along.dot(point - from) / square, 0.0, 1.0) : 0;
}

/// The point of a triangle nearest to a given point, as shares of the corners.
std::array<double, 3> nearest_shares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 u = b - a, v = c - a, w = point - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  if (det > 1e-12 * uu * vv) {
    const double s = (vv * w.dot(u) - uv * w.dot(v)) / det, t = (uu * w.dot(v) - uv * w.dot(u)) / det;
    if (s >= 0 && t >= 0 && s + t <= 1) return {1 - s - t, s, t};
  }
  const double ab = nearest_share(a, b, point), bc = nearest_share(b, c, point), ca = nearest_share(c, a, point);
  const std::array<std::array<double, 3>, 3> sides{{{1 - ab, ab, 0}, {0, 1 - bc, bc}, {ca, 0, 1 - ca}}};
  const auto off = [&](const std::array<double, 3>& share) {
    return (share[0] * a + share[1] * b + share[2] * c - point).squaredNorm();
  };
  return *std::ranges::min_element(sides, {}, off);
}

double longest_edge(const SoftSettings& made) {
  double longest = 0;
  for (const SoftEdge& edge : made.edges) longest = std::max(longest, edge.length.value_or(0));
  return longest;
}

class Meeter {
 public:
  Meeter(SubStep& step, const std::vector<state::Body>& bodies, const std::vector<Vec3>& before, double push_out_speed)
      : step_(step),
        made_(*step.body.made),
        x_(step.body.positions),
        bodies_(bodies),
        before_(before),
        push_out_(step.h * push_out_speed) {
    for (const double mass : made_.masses) weight_.push_back(1 / mass);
    for (const Held& held : step.held) weight_[held.node] = 0;
  }

  bool meet(const Near& near) {
    bool met = false;
    const auto each = [&](Between between) {
      if (!beside(near, between)) return;
      met = push(near, between) || met;
    };
    for (std::size_t i = 0; i < made_.triangles.size(); ++i) {
      const auto& nodes = made_.triangles[i];
      if (step_.body.gone.triangles.empty() || step_.body.gone.triangles[i] == 0) each({nodes, {}, 3});
    }
    if (!made_.triangles.empty()) return met;
    for (std::size_t i = 0; i < made_.edges.size(); ++i)
      if (step_.body.torn[i] == 0) each({{made_.edges[i].a, made_.edges[i].b, 0}, {}, 2});
    return met;
  }

 private:
  [[nodiscard]] Vec3 at(const Between& between, const std::vector<Vec3>& places) const {
    Vec3 sum(0, 0, 0);
    for (std::size_t k = 0; k < between.count; ++k) sum += between.share[k] * places[between.nodes[k]];
    return sum;
  }

  [[nodiscard]] bool beside(const Near& near, const Between& between) const {
    const Vec3& first = x_[between.nodes[0]];
    Vec3 low = first, high = first;
    bool moves = false;
    for (std::size_t k = 0; k < between.count; ++k) {
      low = low.cwiseMin(x_[between.nodes[k]]);
      high = high.cwiseMax(x_[between.nodes[k]]);
      moves = moves || weight_[between.nodes[k]] > 0;
    }
    const Partner& partner = step_.partners[near.partner];
    const double beyond = made_.radius + partner.shift.norm();
    return (moves || partner.moves()) && !((low - near.around.high).array() > beyond).any() &&
           !((near.around.low - high).array() > beyond).any();
  }

  /// The ball of a node at the point of the edge or triangle that is nearest to the body, and its contact with the
  /// body.
  [[nodiscard]] std::optional<Manifold> nearest(const Near& near, const Pose& node, double reach,
                                                Between& between) const {
    const state::Body& rigid = bodies_[step_.partners[near.partner].body];
    for (std::size_t k = 0; k < between.count; ++k) between.share[k] = 1.0 / static_cast<double>(between.count);
    const auto& n = between.nodes;
    std::optional<Manifold> best;
    double deepest = 0;
    Between where = between;
    for (int look = 0; look < looks; ++look) {
      const Vec3 middle = at(where, x_);
      const Manifold found = near.touch(rigid, node, middle, made_.radius, reach);
      if (found.count == 0) break;
      const ContactPoint& point = found.points[0];
      if (!best || point.penetration > deepest) {
        best = found;
        deepest = point.penetration;
        between = where;
      }
      const Vec3 surface = point.position + 0.5 * point.penetration * found.normal;
      if (between.count == 3) {
        where.share = nearest_shares(x_[n[0]], x_[n[1]], x_[n[2]], surface);
      } else {
        const double share = nearest_share(x_[n[0]], x_[n[1]], surface);
        where.share = {1 - share, share, 0};
      }
    }
    if (!best || !(deepest > 0)) return std::nullopt;
    return best;
  }

  bool push(const Near& near, Between& between) {
    Partner& partner = step_.partners[near.partner];
    const state::Body& rigid = bodies_[partner.body];
    const Vec3 center = partner.now.center + partner.moved;
    const Quat rotation = partner.now.rotation;
    const Pose node{center - rotation * rigid.mass().center, rotation, Vec3(1, 1, 1)};
    double reach = made_.radius;
    for (std::size_t k = 1; k < between.count; ++k)
      reach = std::max(reach, (x_[between.nodes[k]] - x_[between.nodes[0]]).norm());
    const std::optional<Manifold> found = nearest(near, node, reach, between);
    if (!found) return false;
    const Vec3 normal = found->normal;
    const ContactPoint& point = found->points[0];
    const Vec3 arm = point.position + 0.5 * point.penetration * normal - center;
    double weight = 0, most = 0;
    bool held = false;
    for (std::size_t k = 0; k < between.count; ++k) {
      const double share = between.share[k], its = weight_[between.nodes[k]];
      weight += share * share * its;
      most = std::max(most, share * its);
      held = held || (its == 0 && share > 0);
    }
    // Beside a node that is held, the others would have to move many times as far as what is beside it: they would be
    // thrown, and do not go farther than it should.
    const double give = (held ? std::max(weight, most) : weight) + partner.give_along(normal, arm);
    if (!(give > 0)) return false;
    // Everything that came in this sub-step, and of the earlier overlap as much as may be removed.
    const Vec3 came = at(between, x_) - at(between, before_) - (center + arm - before_place(partner, arm));
    const double depth = std::min(point.penetration, std::max(0.0, -normal.dot(came)) + push_out_);
    const double pressed = depth / give;
    hand(between, partner, pressed * normal, arm);
    Vec3 slid = came - normal.dot(came) * normal;
    if (rigid.conveys) slid -= step_.h * velocity_at(rigid.surface(), arm);
    slid -= normal.dot(slid) * normal;
    const double way = slid.norm();
    if (!(way > 0)) return true;
    const Vec3 along = slid / way;
    const double rub = std::min(way / (weight + partner.give_along(along, arm)), near.friction * pressed);
    hand(between, partner, -rub * along, arm);
    return true;
  }

  [[nodiscard]] static Vec3 before_place(const Partner& partner, const Vec3& arm) {
    return partner.before.center + partner.before.rotation * (partner.now.rotation.conjugate() * arm);
  }

  /// A push on the nodes in between, kg m, and the opposite one on the body.
  void hand(const Between& between, Partner& partner, const Vec3& push, const Vec3& arm) {
    for (std::size_t k = 0; k < between.count; ++k) {
      const std::uint32_t node = between.nodes[k];
      const Vec3 own = between.share[k] * push;
      x_[node] += weight_[node] * own;
      step_.body.velocities[node] += weight_[node] / step_.h * own;
      if (weight_[node] > 0) continue;
      for (Held& held : step_.held) {
        if (held.node != node) continue;
        held.pushed += own;
        if (held.partner != Held::nobody) step_.partners[held.partner].give(own, held.arm, step_.h);
      }
    }
    partner.give(-push, arm, step_.h);
  }

  SubStep& step_;
  const SoftSettings& made_;
  std::vector<Vec3>& x_;
  const std::vector<state::Body>& bodies_;
  const std::vector<Vec3>& before_;
  double push_out_;
  std::vector<double> weight_;  ///< inverse masses; 0 of held nodes
};

}  // namespace

bool may_slip_between(const SoftSettings& made, const Shape& shape) {
  if (std::holds_alternative<Plane>(shape.solid)) return false;
  const double longest = longest_edge(made);
  if (!(longest > 2 * made.radius)) return false;
  const Bounds own = bounds(Shape{shape.solid, {}}, Pose{});
  // A ball that just fits through a triangle or a square of such edges is about as wide as these are long.
  return (own.high - own.low).minCoeff() < 1.5 * longest;
}

bool meet_between(SubStep& step, const std::vector<Near>& near, const std::vector<state::Body>& bodies,
                  const std::vector<Vec3>& before, double push_out_speed) {
  Meeter meeter(step, bodies, before, push_out_speed);
  bool met = false;
  for (const Near& other : near)
    if (other.slips) met = meeter.meet(other) || met;
  return met;
}

}  // namespace tweenfall::soft
