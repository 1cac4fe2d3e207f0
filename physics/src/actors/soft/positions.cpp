// Constraints with compliance. A constraint C(x) with energy k C^2 / 2 moves the nodes along its gradients, each by its
// share of the inverse masses w, so far that the compliance 1 / k holds what is left of C:
//
//   change of the multiplier = (-C - a multiplier) / (sum of w |gradient|^2 + a),  a = 1 / (k h^2)
//
// Sources: Macklin, Mueller, Chentanez, XPBD: Position-Based Simulation of Compliant Constrained Dynamics, 2016,
// equations 18 and 26 (damping, here of chains); Macklin, Storey, Lu, Terdiman, Chentanez, Jeschke, Mueller, Small
// Steps in Physics Simulation, 2019; for rigid bodies Mueller, Macklin, Chentanez, Jeschke, Kim, Detailed Rigid Body
// Simulation with Extended Position Based Dynamics, 2020; for chains Deul, Kugelstadt, Weiler, Bender, Direct
// Position-Based Solver for Stiff Rods, 2018.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "actors/soft/chains.h"
#include "actors/soft/resolved.h"
#include "actors/soft/sub_step.h"

namespace tweenfall::soft {

namespace {

/// Part of an edge's own effect by which an edge of a chain yields: a straight chain between two fixed ends leaves no
/// way in which one edge could be corrected alone.
constexpr double yielding = 1e-7;

/// A node that something hangs on.
struct Load {
  Held* held = nullptr;
  Mat3 give = Mat3::Zero();  ///< inverse mass of both together, 1/kg
};

/// Kept from one sub-step to the next, so that none takes memory.
struct PositionsMemory {
  std::vector<Vec3> p;         ///< at the end
  std::vector<Vec3> free;      ///< at the end, if only gravity acted
  std::vector<Vec3> pull;      ///< by constraints, kg m
  std::vector<double> weight;  ///< inverse masses; 0 of led nodes
  std::vector<double> edge_multipliers, solid_multipliers, enclosure_multipliers;
  std::vector<double> solid_stiffness, enclosure_stiffness;  ///< divided by the volume, as they act, Pa/m^3
  std::vector<Vec3> bend_multipliers;
  std::vector<Load> loads;  ///< by node; empty if nothing hangs on any
  std::vector<Vec3> normals;
  std::vector<double> diagonal, beside, changes;
  std::vector<Vec3> gradients;
};

class Positions {
 public:
  Positions(SubStep& step, PositionsMemory& memory)
      : step_(step),
        made_(*step.body.made),
        chains_(step.chains.of(step.body)),
        x_(step.body.positions),
        p_(memory.p),
        free_(memory.free),
        pull_(memory.pull),
        weight_(memory.weight),
        edge_multipliers_(memory.edge_multipliers),
        solid_multipliers_(memory.solid_multipliers),
        enclosure_multipliers_(memory.enclosure_multipliers),
        solid_stiffness_(memory.solid_stiffness),
        enclosure_stiffness_(memory.enclosure_stiffness),
        bend_multipliers_(memory.bend_multipliers),
        loads_(memory.loads),
        normals_(memory.normals),
        diagonal_(memory.diagonal),
        beside_(memory.beside),
        changes_(memory.changes),
        gradients_(memory.gradients) {}

  void solve() {
    predict();
    // There and back: one direction alone takes too much energy from stiff parts where many edges meet, and speeds them
    // up.
    find_loads();
    for (int i = 0; i < *made_.iterations; ++i) {
      pass(step_.backward);
      pass(!step_.backward);
    }
    SoftBody& body = step_.body;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      body.velocities[i] = (p_[i] - x_[i]) / step_.h;
      x_[i] = p_[i];
    }
    damp();
    hold_together();
    for (Held& held : step_.held) {
      if (held.partner != Held::nobody) continue;
      // The holder gave it the difference to the momentum it would have had, including what its edges gave.
      const double mass = made_.masses[held.node] * (1 + step_.h * made_.linear_damping);
      held.pushed += pull_[held.node] - mass * (held.place - free_[held.node]);
      body.velocities[held.node] = held.velocity;
    }
  }

 private:
  void predict() {
    // A drag of m c v at the end of the sub-step acts as if the mass were larger by c h, and fell that much less.
    const double h = step_.h, kept = 1 / (1 + h * made_.linear_damping);
    const std::size_t count = x_.size();
    p_.resize(count);
    weight_.resize(count);
    pull_.assign(count, Vec3(0, 0, 0));
    for (std::size_t i = 0; i < count; ++i) {
      p_[i] = x_[i] + h * kept * (step_.body.velocities[i] + h * step_.gravity);
      weight_[i] = kept / made_.masses[i];
    }
    free_ = p_;
    for (const Held& held : step_.held) {
      if (held.partner != Held::nobody) continue;
      p_[held.node] = held.place;
      weight_[held.node] = 0;
    }
    edge_multipliers_.assign(made_.edges.size(), 0);
    bend_multipliers_.assign(made_.bends.size(), Vec3(0, 0, 0));
    solid_multipliers_.assign(made_.tetrahedra.size(), 0);
    enclosure_multipliers_.assign(made_.enclosures.size(), 0);
    solid_stiffness_.clear();
    for (const SoftTetrahedron& solid : made_.tetrahedra)
      solid_stiffness_.push_back(resolved_stiffness(made_, solid, step_.body.pace));
    enclosure_stiffness_.clear();
    for (const SoftEnclosure& enclosure : made_.enclosures)
      enclosure_stiffness_.push_back(resolved_stiffness(made_, enclosure, step_.body.pace));
  }

  /// A sub-step in which nodes pass their neighbors many times over says nothing of what holds them together, and
  /// would throw them ever faster: relative to its center of mass, nothing moves farther in one than the sum of all
  /// edges.
  void hold_together() {
    if (made_.edges.empty()) return;
    std::vector<Vec3>& v = step_.body.velocities;
    double reach = 0, mass = 0, fastest = 0;
    for (const SoftEdge& edge : made_.edges) reach += *edge.length;
    Vec3 mean(0, 0, 0);
    for (std::size_t i = 0; i < v.size(); ++i) {
      mean += made_.masses[i] * v[i];
      mass += made_.masses[i];
    }
    mean /= mass;
    for (const Vec3& one : v) fastest = std::max(fastest, (one - mean).norm());
    if (!(fastest * step_.h > reach)) return;
    const double kept = reach / (step_.h * fastest);
    for (Vec3& one : v) one = mean + kept * (one - mean);
  }

  template <class Meet>
  static void each(std::size_t count, bool backward, const Meet& meet) {
    for (std::size_t i = 0; i < count; ++i) meet(backward ? count - 1 - i : i);
  }

  void pass(bool backward) {
    if (chains_.empty())
      each(made_.edges.size(), backward, [this](std::size_t i) { meet_edge(i); });
    else
      each(chains_.size(), backward, [this](std::size_t i) { meet_chain(chains_[i]); });
    each(made_.bends.size(), backward, [this](std::size_t i) { meet_bend(i); });
    each(made_.tetrahedra.size(), backward, [this](std::size_t i) { meet_solid(i); });
    each(made_.enclosures.size(), backward, [this](std::size_t i) { meet_enclosure(i); });
    for (Held& held : step_.held)
      if (held.partner != Held::nobody) meet_pin(held);
    for (NodeContact& contact : step_.contacts) meet_contact(contact);
  }

  /// A push on a node, kg m.
  void push(std::uint32_t node, const Vec3& by) {
    p_[node] += weight_[node] * by;
    pull_[node] += by;
  }

  /// Damping of edges that are passed over: each takes from the speed of its ends along it a part of what is left. So
  /// it only ever takes energy, however hard it damps and however few the passes, as it would not among constraints.
  void damp() {
    if (!chains_.empty()) return;
    std::vector<Vec3>& v = step_.body.velocities;
    for (const Held& held : step_.held)
      if (held.partner == Held::nobody) v[held.node] = held.velocity;
    for (int i = 0; i < *made_.iterations; ++i) {
      each(made_.edges.size(), step_.backward, [this](std::size_t k) { slow_edge(k); });
      each(made_.edges.size(), !step_.backward, [this](std::size_t k) { slow_edge(k); });
    }
  }
  void slow_edge(std::size_t i) {
    const SoftEdge& edge = made_.edges[i];
    if (!(edge.damping > 0) || step_.body.torn[i] != 0) return;
    std::vector<Vec3>& v = step_.body.velocities;
    const double weights = weight_[edge.a] + weight_[edge.b];
    const Vec3 between = p_[edge.a] - p_[edge.b];
    const double length = between.norm();
    if (!(weights > 0) || !(length > 0)) return;
    const Vec3 normal = between / length;
    const double effect = resolved(step_.body, edge).damping * weights * step_.h / (2 * *made_.iterations);
    const Vec3 push = -normal.dot(v[edge.a] - v[edge.b]) * effect / (1 + effect) / weights * normal;
    v[edge.a] += weight_[edge.a] * push;
    v[edge.b] -= weight_[edge.b] * push;
    pull_[edge.a] += step_.h * push;
    pull_[edge.b] -= step_.h * push;
  }

  [[nodiscard]] double compliance(double stiffness) const { return 1 / (stiffness * step_.h * step_.h); }

  void meet_edge(std::size_t i) {
    const SoftEdge& edge = made_.edges[i];
    const double weights = weight_[edge.a] + weight_[edge.b];
    const Vec3 between = p_[edge.a] - p_[edge.b];
    const double length = between.norm();
    if (step_.body.torn[i] != 0 || !(weights > 0) || !(length > 0)) return;
    const Vec3 normal = between / length;
    const double stiffness = chains_.empty() ? resolved(step_.body, edge).stiffness : edge.stiffness;
    const double damping = chains_.empty() ? 0 : edge.damping;
    const double soft = compliance(stiffness), damped = damping / (stiffness * step_.h);
    const double drawn = normal.dot((p_[edge.a] - x_[edge.a]) - (p_[edge.b] - x_[edge.b]));
    double& multiplier = edge_multipliers_[i];
    const double change =
        (*edge.length - length - soft * multiplier - damped * drawn) / ((1 + damped) * weights + soft);
    multiplier += change;
    push(edge.a, change * normal);
    push(edge.b, -change * normal);
  }

  /// Movable bodies that chains are pinned to move with them as if they were part of the node; a body with several pins
  /// is divided among them.
  void find_loads() {
    loads_.clear();
    if (chains_.empty()) return;
    for (Held& held : step_.held) {
      if (held.partner == Held::nobody) continue;
      if (loads_.empty()) loads_.resize(p_.size());
      const Partner& partner = step_.partners[held.partner];
      const auto pins = std::ranges::count(step_.held, held.partner, &Held::partner);
      const Mat3 give = static_cast<double>(pins) * give_of(partner, held.arm);
      loads_[held.node] = {&held, (Mat3::Identity() / weight_[held.node] + give.inverse()).inverse()};
    }
  }
  [[nodiscard]] static Mat3 give_of(const Partner& partner, const Vec3& arm) {
    Mat3 lever;
    lever << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    return partner.inverse_mass * Mat3::Identity() - lever * partner.inverse_inertia * lever;
  }
  [[nodiscard]] bool is_loaded(std::uint32_t node) const { return !loads_.empty() && loads_[node].held; }
  /// How far a push moves a node of a chain.
  [[nodiscard]] Vec3 moved_by(std::uint32_t node, const Vec3& push) const {
    return is_loaded(node) ? Vec3(loads_[node].give * push) : Vec3(weight_[node] * push);
  }
  void push_chain(std::uint32_t node, const Vec3& by) {
    if (!is_loaded(node)) return push(node, by);
    const Load& load = loads_[node];
    const Vec3 moved = load.give * by, on = by - moved / weight_[node];
    p_[node] += moved;
    pull_[node] += by - on;
    step_.partners[load.held->partner].give(on, load.held->arm, step_.h);
    load.held->pushed += on;
  }

  /// Whether nodes are led farther apart than everything between them can stretch: then there is no solution,
  /// and each edge does what it can.
  [[nodiscard]] bool is_overstretched(const Chain& chain) const {
    const std::size_t no_node = chain.nodes.size();
    std::size_t led = no_node;
    double length = 0;
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
      if (k > 0) {
        const SoftEdge& edge = made_.edges[chain.edges[k - 1]];
        length += std::isinf(edge.stiffness) ? *edge.length : std::numeric_limits<double>::infinity();
      }
      if (weight_[chain.nodes[k]] > 0) continue;
      if (led != no_node && (p_[chain.nodes[k]] - p_[chain.nodes[led]]).norm() > length) return true;
      led = k;
      length = 0;
    }
    return false;
  }

  /// Solves all edges of a chain at once, for the changes d of their multipliers:
  ///
  ///   sum over k of (gradient of i) . w (gradient of k) d_k + a_i d_i = -C_i - a_i multiplier_i
  ///
  /// Each edge shares nodes only with its neighbors, so that the matrix is tridiagonal. Solved one by one, edges
  /// would need as many passes as there are links to affect each other.
  void meet_chain(const Chain& chain) {
    if (is_overstretched(chain)) {
      for (const std::uint32_t edge : chain.edges) meet_edge(edge);
      return;
    }
    for (const std::uint32_t node : chain.nodes)
      if (is_loaded(node)) meet_pin(*loads_[node].held);
    const std::size_t count = chain.edges.size();
    normals_.assign(count, Vec3(0, 0, 0));
    diagonal_.assign(count, 0);
    beside_.assign(count, 0);
    changes_.assign(count, 0);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t from = chain.nodes[k], to = chain.nodes[k + 1];
      const SoftEdge& edge = made_.edges[chain.edges[k]];
      const Vec3 between = p_[from] - p_[to];
      const double length = between.norm();
      if (!(length > 0)) continue;
      const Vec3 normal = normals_[k] = between / length;
      const double soft = compliance(edge.stiffness), damped = edge.damping / (edge.stiffness * step_.h);
      const double drawn = normal.dot((p_[from] - x_[from]) - (p_[to] - x_[to]));
      const double off = *edge.length - length - soft * edge_multipliers_[chain.edges[k]] - damped * drawn;
      changes_[k] = off / (1 + damped);
      const Vec3 moved = moved_by(from, normal);
      diagonal_[k] = (1 + yielding) * (normal.dot(moved + moved_by(to, normal)) + soft / (1 + damped));
      if (k > 0) beside_[k] = -normals_[k - 1].dot(moved);
    }
    solve_three_diagonals(diagonal_, beside_, changes_);
    for (std::size_t k = 0; k < count; ++k) {
      edge_multipliers_[chain.edges[k]] += changes_[k];
      push_chain(chain.nodes[k], changes_[k] * normals_[k]);
      push_chain(chain.nodes[k + 1], -changes_[k] * normals_[k]);
    }
  }

  void meet_bend(std::size_t i) {
    const SoftBend& bend = made_.bends[i];
    if (step_.body.gone.bends[i] != 0) return;
    Vec3 off(0, 0, 0);
    double weights = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      off += bend.weights[k] * p_[bend.nodes[k]];
      weights += bend.weights[k] * bend.weights[k] * weight_[bend.nodes[k]];
    }
    if (!(weights > 0)) return;
    const double soft = compliance(resolved_stiffness(step_.body, bend));
    const Vec3 change = (-off - soft * bend_multipliers_[i]) / (weights + soft);
    bend_multipliers_[i] += change;
    for (std::size_t k = 0; k < 4; ++k)
      if (bend.weights[k] != 0) push(bend.nodes[k], bend.weights[k] * change);
  }

  void meet_solid(std::size_t i) {
    const SoftTetrahedron& solid = made_.tetrahedra[i];
    if (step_.body.gone.tetrahedra[i] != 0) return;
    const auto& n = solid.nodes;
    const Vec3 b = p_[n[1]] - p_[n[0]], c = p_[n[2]] - p_[n[0]], d = p_[n[3]] - p_[n[0]];
    std::array<Vec3, 4> gradients{Vec3(0, 0, 0), c.cross(d) / 6, d.cross(b) / 6, b.cross(c) / 6};
    gradients[0] = -(gradients[1] + gradients[2] + gradients[3]);
    double weights = 0;
    for (std::size_t k = 0; k < 4; ++k) weights += weight_[n[k]] * gradients[k].squaredNorm();
    if (!(weights > 0)) return;
    const double soft = compliance(solid_stiffness_[i]);
    const double volume = b.dot(c.cross(d)) / 6;
    double& multiplier = solid_multipliers_[i];
    const double change = (*solid.volume - volume - soft * multiplier) / (weights + soft);
    multiplier += change;
    for (std::size_t k = 0; k < 4; ++k) push(n[k], change * gradients[k]);
  }

  void meet_enclosure(std::size_t i) {
    const SoftEnclosure& enclosure = made_.enclosures[i];
    if (step_.body.gone.enclosures[i] != 0) return;
    gradients_.assign(p_.size(), Vec3(0, 0, 0));
    const Vec3 origin = p_[enclosure.triangles[0][0]];
    double volume = 0;
    for (const auto& triangle : enclosure.triangles) {
      const Vec3 a = p_[triangle[0]] - origin, b = p_[triangle[1]] - origin, c = p_[triangle[2]] - origin;
      volume += a.dot(b.cross(c)) / 6;
      gradients_[triangle[0]] += b.cross(c) / 6;
      gradients_[triangle[1]] += c.cross(a) / 6;
      gradients_[triangle[2]] += a.cross(b) / 6;
    }
    double weights = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) weights += weight_[k] * gradients_[k].squaredNorm();
    if (!(weights > 0)) return;
    const double soft = compliance(enclosure_stiffness_[i]);
    double& multiplier = enclosure_multipliers_[i];
    const double change = (*enclosure.volume - volume - soft * multiplier) / (weights + soft);
    multiplier += change;
    for (std::uint32_t k = 0; k < p_.size(); ++k)
      if (gradients_[k] != Vec3::Zero()) push(k, change * gradients_[k]);
  }

  void meet_pin(Held& held) {
    Partner& partner = step_.partners[held.partner];
    const Mat3 give = weight_[held.node] * Mat3::Identity() + give_of(partner, held.arm);
    const Vec3 change = give.inverse() * (partner.point(held.arm) - p_[held.node]);
    push(held.node, change);
    partner.give(-change, held.arm, step_.h);
    held.pushed -= change;
  }

  void meet_contact(NodeContact& contact) {
    Partner& partner = step_.partners[contact.partner];
    const double weight = weight_[contact.node];
    const Vec3& normal = contact.normal;
    const double gap = normal.dot(p_[contact.node] - partner.point(contact.arm)) - made_.radius - contact.least;
    const double change = std::max(-gap / (weight + partner.give_along(normal, contact.arm)), -contact.pressed);
    if (change == 0) return;
    contact.pressed += change;
    push(contact.node, change * normal);
    partner.give(-change * normal, contact.arm, step_.h);
    // A sliding node is held back by at most friction times that.
    const Vec3 carried = contact.carried + partner.moved + partner.turned.cross(contact.arm);
    Vec3 slid = p_[contact.node] - x_[contact.node] - carried;
    slid -= normal.dot(slid) * normal;
    const double way = slid.norm();
    const double room = contact.friction * contact.pressed - contact.rubbed;
    if (!(way > 0) || !(room > 0)) return;
    const Vec3 along = slid / way;
    const double rub = std::min(way / (weight + partner.give_along(along, contact.arm)), room);
    contact.rubbed += rub;
    push(contact.node, -rub * along);
    partner.give(rub * along, contact.arm, step_.h);
  }

  SubStep& step_;
  const SoftSettings& made_;
  const std::vector<Chain>& chains_;
  std::vector<Vec3>& x_;  ///< at the start
  // Memory that is kept
  std::vector<Vec3>&p_, &free_, &pull_;
  std::vector<double>& weight_;
  std::vector<double>&edge_multipliers_, &solid_multipliers_, &enclosure_multipliers_;
  std::vector<double>&solid_stiffness_, &enclosure_stiffness_;
  std::vector<Vec3>& bend_multipliers_;
  std::vector<Load>& loads_;
  std::vector<Vec3>& normals_;
  std::vector<double>&diagonal_, &beside_, &changes_;
  std::vector<Vec3>& gradients_;
};

}  // namespace

void solve_positions(SubStep& step) {
  thread_local PositionsMemory memory;
  Positions(step, memory).solve();
}

}  // namespace tweenfall::soft
