// Backward Euler: the velocities v at the end of the sub-step are those at which
//
//   1/2 (v - v_free)' M (v - v_free) + V(x + h v) + loss by damping
//
// is least, found by Newton's method; v_free is what gravity alone leads to. Each of its linear systems,
// (M + h^2 K + h D) change = -gradient, is solved by conjugate gradients; the preconditioner is the matrix of the chain
// as a whole, or else the blocks. K is the second derivative of the energy without what would make it indefinite: an
// edge under pressure does not push its ends aside.
//
// Sources: Baraff, Witkin, Large Steps in Cloth Simulation, 1998; Choi, Ko, Stable but Responsive Cloth, 2002 (the edge
// under pressure); Martin, Thomaszewski, Grinspun, Gross, Example-Based Elastic Materials, 2011, equation 6 (as what is
// least); Shewchuk, An Introduction to the Conjugate Gradient Method Without the Agonizing Pain, 1994; Li, Ferguson,
// Schneider, Langlois, Zorin, Panozzo, Jiang, Kaufman, Incremental Potential Contact, 2020, section 5 (friction, as a
// loss by what pressed before).

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "actors/soft/chain_holders.h"
#include "actors/soft/energies.h"
#include "actors/soft/sub_step.h"

namespace tweenfall::soft {

namespace {

/// Newton's steps; more where each is exact: what is stiff turns along a valley as narrow as it is stiff.
constexpr int most_newton_steps = 12, most_exact_steps = 60;
/// Passes of the conjugate gradients, as many up to `many_nodes`, and in each of Newton's steps fewer where there are
/// more: a cloth of very many cells that are far longer than wide would take seconds for a step.
constexpr double most_passes = 1000, fewest_passes = 100, many_nodes = 2000;
constexpr int most_halvings = 12, most_ventured = 2;
/// How far nodes of a chain reach at most.
constexpr std::size_t reach_of_chain = 3;
/// How many times as stiff as heavy in a sub-step what is no chain is when its matrix is worth factoring, over the
/// fourth power of how far it reaches: conjugate gradients take passes with the root of the one, factoring with the
/// square of the other.
constexpr double stiff_enough = 1.0 / 400;
/// Against the mass that a contact moves in a sub-step: how stiff it is, and how many times as stiff friction is that
/// holds: what it holds creeps by its force over that in each sub-step.
constexpr double contact_stiffness = 1e4, grip_stiffness = 100;

/// Velocities of all nodes, and then of the bodies: linear and angular ones in turn.
using Rates = std::vector<Vec3>;

double dot(const Rates& a, const Rates& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

Mat3 crossing(const Vec3& arm) {
  Mat3 lever;
  lever << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  return lever;
}

class Springs {
 public:
  explicit Springs(SubStep& step)
      : step_(step),
        made_(*step.body.made),
        x_(step.body.positions),
        nodes_(x_.size()),
        energies_(step.body, step.h),
        order_(made_),
        factors_(is_worth_factoring()) {}

  void solve() {
    begin();
    settle();
    // Friction is limited by what presses, and what presses is known only now.
    if (find_grips()) settle();
    if (step_.held.empty() && !touches()) keep_momentum();
    end();
  }

 private:
  [[nodiscard]] bool is_worth_factoring() const {
    if (!can_be_factored(made_, order_)) return false;
    if (order_.reach() <= reach_of_chain) return true;
    const auto far = static_cast<double>(order_.reach());
    return std::ranges::any_of(made_.edges, [&](const SoftEdge& edge) {
      const double stiff = edge.stiffness * step_.h * step_.h * (1 / made_.masses[edge.a] + 1 / made_.masses[edge.b]);
      return stiff > stiff_enough * far * far * far * far;
    });
  }
  [[nodiscard]] std::size_t linear_of(std::uint32_t partner) const { return nodes_ + 2 * std::size_t{partner}; }

  void settle() {
    ventured_ = 0;
    for (int i = 0; i < (chained_ ? most_exact_steps : most_newton_steps) && improve(); ++i) {
    }
    if (ventured_ > 0) v_ = trusted_.v;
  }

  void begin() {
    // A drag of m c v at the end of the sub-step acts as if the mass were larger by c h, and fell that much less.
    const double h = step_.h, kept = 1 / (1 + h * made_.linear_damping);
    for (const double mass : made_.masses) mass_.push_back(mass / kept);
    const std::size_t all = nodes_ + 2 * step_.partners.size();
    free_.assign(all, Vec3(0, 0, 0));
    for (std::size_t i = 0; i < nodes_; ++i) free_[i] = kept * (step_.body.velocities[i] + h * step_.gravity);
    v_ = free_;
    for (std::size_t i = 0; i < nodes_; ++i) v_[i] = step_.body.velocities[i];
    // Bodies that only other soft bodies meet keep zeros.
    std::vector<char> meets(step_.partners.size(), 0);
    for (const NodeContact& contact : step_.contacts) meets[contact.partner] = 1;
    for (const Held& held : step_.held)
      if (held.partner != Held::nobody) meets[held.partner] = 1;
    unknowns_ = nodes_ + 2 * static_cast<std::size_t>(std::ranges::count(meets, 1));
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p) {
      if (meets[p] == 0) continue;
      const Partner& partner = step_.partners[p];
      v_[linear_of(p)] = free_[linear_of(p)] = partner.moved / h;
      v_[linear_of(p) + 1] = free_[linear_of(p) + 1] = partner.turned / h;
    }
    stiffness_.clear();
    for (const NodeContact& contact : step_.contacts) {
      const Partner& partner = step_.partners[contact.partner];
      const double give = 1 / mass_[contact.node] + partner.give_along(contact.normal, contact.arm);
      stiffness_.push_back(contact_stiffness / (give * h * h));
    }
    grips_.assign(step_.contacts.size(), 0);
    lead(v_);
  }

  /// Gives held nodes the velocities of their holders.
  void lead(Rates& v) const {
    for (const Held& held : step_.held) {
      Vec3 at = (held.place - x_[held.node]) / step_.h;
      if (held.partner != Held::nobody) at += follow(v, held);
      v[held.node] = at;
    }
  }
  [[nodiscard]] Vec3 follow(const Rates& v, const Held& held) const {
    return v[linear_of(held.partner)] + v[linear_of(held.partner) + 1].cross(held.arm);
  }
  /// Passes forces on held nodes on to their holders.
  void hand_on(Rates& forces) const {
    for (const Held& held : step_.held) {
      if (held.partner != Held::nobody) {
        forces[linear_of(held.partner)] += forces[held.node];
        forces[linear_of(held.partner) + 1] += held.arm.cross(forces[held.node]);
      }
      forces[held.node] = Vec3(0, 0, 0);
    }
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p)
      if (!step_.partners[p].moves()) forces[linear_of(p)] = forces[linear_of(p) + 1] = Vec3(0, 0, 0);
  }

  /// Displacement of a node in the sub-step against that of a surface, of which `carried` is known.
  [[nodiscard]] Vec3 apart(const NodeContact& contact, const Rates& v, const Vec3& carried) const {
    const std::size_t linear = linear_of(contact.partner);
    return step_.h * (v[contact.node] - v[linear] - v[linear + 1].cross(contact.arm)) - carried;
  }
  [[nodiscard]] double gap(const NodeContact& contact, const Rates& v) const {
    const Vec3 surface = step_.partners[contact.partner].now.center + contact.arm;
    return contact.normal.dot(apart(contact, v, surface - x_[contact.node])) - made_.radius - contact.least;
  }

  [[nodiscard]] Vec3 slid(const NodeContact& contact, const Rates& v) const {
    const Vec3 way = apart(contact, v, contact.carried);
    return way - contact.normal.dot(way) * contact.normal;
  }

  struct Resistance {
    double energy = 0;  ///< or loss, J
    Vec3 force{0, 0, 0};
    Mat3 stiffness = Mat3::Zero();
  };
  /// What a contact opposes to a displacement of the node: along the normal as a spring, where the surfaces overlap;
  /// across it as a spring too, until it reaches the force by which friction holds.
  [[nodiscard]] Resistance resistance(std::size_t k, const Rates& v) const {
    const NodeContact& contact = step_.contacts[k];
    const Vec3& normal = contact.normal;
    const double stiff = stiffness_[k], depth = std::min(0.0, gap(contact, v)), grip = grips_[k];
    Resistance all;
    if (depth < 0) all = {0.5 * stiff * depth * depth, stiff * depth * normal, stiff * normal * normal.transpose()};
    if (!(grip > 0)) return all;
    const Vec3 off = slid(contact, v);
    const Mat3 across = Mat3::Identity() - normal * normal.transpose();
    const double way = off.norm(), hold = grip_stiffness * stiff, held = grip / hold;
    if (way <= held) {
      all.energy += 0.5 * hold * way * way;
      all.force += hold * off;
      all.stiffness += hold * across;
    } else {
      const Vec3 along = off / way;
      all.energy += grip * (way - 0.5 * held);
      all.force += grip * along;
      all.stiffness += grip / way * (across - along * along.transpose());
    }
    return all;
  }
  /// Nodes start out as if it held them: what starts by sliding would pass by the place where it is held, which is
  /// narrow. @return whether friction holds anything
  bool find_grips() {
    bool any = false;
    for (std::size_t k = 0; k < grips_.size(); ++k) {
      const NodeContact& contact = step_.contacts[k];
      grips_[k] = contact.friction * stiffness_[k] * std::max(0.0, -gap(contact, v_));
      if (!(grips_[k] > 0)) continue;
      any = true;
      v_[contact.node] -= slid(contact, v_) / step_.h;
    }
    return any;
  }

  /// The quantity to minimize.
  [[nodiscard]] double measure(const Rates& v) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes_; ++i) sum += 0.5 * mass_[i] * (v[i] - free_[i]).squaredNorm();
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p) {
      const Partner& partner = step_.partners[p];
      const Vec3 linear = v[linear_of(p)] - free_[linear_of(p)];
      const Vec3 angular = v[linear_of(p) + 1] - free_[linear_of(p) + 1];
      sum += 0.5 * (partner.mass * linear.squaredNorm() + angular.dot(partner.inertia * angular));
    }
    for (std::size_t k = 0; k < step_.contacts.size(); ++k) sum += resistance(k, v).energy;
    return sum + energies_.at(x_, v);
  }

  /// Its derivative, by the velocity of each node as if nothing held it.
  void find_gradient(const Rates& v, Rates& gradient) {
    gradient.assign(v.size(), Vec3(0, 0, 0));
    energies_.add_gradient(gradient);
    for (std::size_t i = 0; i < nodes_; ++i) gradient[i] += mass_[i] * (v[i] - free_[i]);
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p) {
      const Partner& partner = step_.partners[p];
      gradient[linear_of(p)] += partner.mass * (v[linear_of(p)] - free_[linear_of(p)]);
      gradient[linear_of(p) + 1] += partner.inertia * (v[linear_of(p) + 1] - free_[linear_of(p) + 1]);
    }
    resisting_.assign(step_.contacts.size(), Mat3::Zero());
    for (std::size_t k = 0; k < step_.contacts.size(); ++k) {
      const Resistance against = resistance(k, v);
      resisting_[k] = step_.h * step_.h * against.stiffness;
      add_between(step_.contacts[k], step_.h * against.force, gradient);
    }
  }
  /// Adds a push on a contact's node, against the body.
  void add_between(const NodeContact& contact, const Vec3& push, Rates& out) const {
    out[contact.node] += push;
    out[linear_of(contact.partner)] -= push;
    out[linear_of(contact.partner) + 1] -= contact.arm.cross(push);
  }

  /// The second derivative times a change.
  void multiply(const Rates& change, Rates& out) {
    spread_ = change;
    for (const Held& held : step_.held)
      spread_[held.node] = held.partner == Held::nobody ? Vec3(0, 0, 0) : follow(change, held);
    out.assign(change.size(), Vec3(0, 0, 0));
    for (std::size_t i = 0; i < nodes_; ++i) out[i] = mass_[i] * spread_[i];
    energies_.add_product(spread_, out);
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p) {
      const Partner& partner = step_.partners[p];
      out[linear_of(p)] += partner.mass * spread_[linear_of(p)];
      out[linear_of(p) + 1] += partner.inertia * spread_[linear_of(p) + 1];
    }
    for (std::size_t k = 0; k < step_.contacts.size(); ++k) {
      const NodeContact& contact = step_.contacts[k];
      const std::size_t linear = linear_of(contact.partner);
      const Vec3 apart = spread_[contact.node] - spread_[linear] - spread_[linear + 1].cross(contact.arm);
      add_between(contact, resisting_[k] * apart, out);
    }
    hand_on(out);
  }

  /// The inverse of its three-by-three blocks.
  void find_blocks() {
    blocks_.assign(v_.size(), Mat3::Zero());
    for (std::size_t i = 0; i < nodes_; ++i) blocks_[i] = mass_[i] * Mat3::Identity();
    energies_.add_blocks(blocks_);
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p) {
      const Partner& partner = step_.partners[p];
      blocks_[linear_of(p)] = partner.moves() ? Mat3(partner.mass * Mat3::Identity()) : Mat3(Mat3::Identity());
      blocks_[linear_of(p) + 1] = partner.moves() ? partner.inertia : Mat3(Mat3::Identity());
    }
    for (std::size_t k = 0; k < step_.contacts.size(); ++k) {
      const NodeContact& contact = step_.contacts[k];
      blocks_[contact.node] += resisting_[k];
      if (!step_.partners[contact.partner].moves()) continue;
      const Mat3 lever = crossing(contact.arm);
      blocks_[linear_of(contact.partner)] += resisting_[k];
      blocks_[linear_of(contact.partner) + 1] += lever.transpose() * resisting_[k] * lever;
    }
    chained_ = factors_ && factor_chain();
    for (const Held& held : step_.held) {
      if (held.partner == Held::nobody) continue;
      const Mat3 lever = crossing(held.arm);
      blocks_[linear_of(held.partner)] += blocks_[held.node];
      blocks_[linear_of(held.partner) + 1] += lever.transpose() * blocks_[held.node] * lever;
    }
    for (Mat3& block : blocks_) block = block.inverse().eval();
  }

  /// Factors the matrix of all nodes together, with their holders.
  [[nodiscard]] bool factor_chain() {
    ChainFactor& chain = all_.chain();
    chain.clear(order_);
    for (std::size_t i = 0; i < nodes_; ++i) chain.add(i, i, mass_[i] * Mat3::Identity());
    energies_.add_all_blocks(chain);
    for (std::size_t k = 0; k < step_.contacts.size(); ++k)
      chain.add(step_.contacts[k].node, step_.contacts[k].node, resisting_[k]);
    return all_.factor(step_.held, blocks_, nodes_);
  }

  /// Solves for the change against a gradient.
  void find_change(const Rates& gradient) {
    const std::size_t size = gradient.size();
    change_.assign(size, Vec3(0, 0, 0));
    rest_.resize(size);
    toward_.resize(size);
    for (std::size_t i = 0; i < size; ++i) rest_[i] = -gradient[i];
    const auto steer = [&] {
      if (chained_) {
        steered_ = rest_;
        all_.solve(steered_);
      }
      for (std::size_t i = chained_ ? nodes_ : 0; i < size; ++i)
        if (!chained_ || !all_.solves(i)) steered_[i] = blocks_[i] * rest_[i];
    };
    steered_.resize(size);
    steer();
    toward_ = steered_;
    double left = dot(rest_, steered_);
    const double enough = 1e-16 * left;
    const auto all = static_cast<double>(unknowns_);
    const double of_many = most_passes * many_nodes * many_nodes / (all * all);
    const double most = std::min({3 * all + 20, most_passes, std::max(fewest_passes, of_many)});
    for (int i = 0; i < most && left > enough; ++i) {
      multiply(toward_, product_);
      const double curve = dot(toward_, product_);
      if (!(curve > 0)) break;
      const double way = left / curve;
      for (std::size_t k = 0; k < size; ++k) {
        change_[k] += way * toward_[k];
        rest_[k] -= way * product_[k];
      }
      steer();
      const double next = dot(rest_, steered_), keep = next / left;
      for (std::size_t k = 0; k < size; ++k) toward_[k] = steered_[k] + keep * toward_[k];
      left = next;
    }
  }

  /// @return whether another step may be worth it
  bool improve() {
    const double now = measure(v_);
    find_gradient(v_, gradient_);
    hand_on(gradient_);
    find_blocks();
    find_change(gradient_);
    double fastest = 0, largest = 0;
    for (std::size_t i = 0; i < v_.size(); ++i) {
      fastest = std::max(fastest, v_[i].norm());
      largest = std::max(largest, change_[i].norm());
    }
    const bool last = largest <= 1e-9 * fastest + 1e-11;
    if (ventured_ == 0) trusted_ = {v_, change_, now};
    if (take(v_, change_, 1)) return !last;
    // A straight step across stiff edges that turn stretches them: the minimum lies in a narrow valley that bends. A
    // step or two more lead back into it, farther on; if not, a shorter step from where it was left does.
    if (ventured_ < most_ventured && !last) {
      ++ventured_;
      v_ = trial_;
      return true;
    }
    return step_back();
  }
  bool step_back() {
    ventured_ = 0;
    double part = 0.5;
    v_ = trusted_.v;
    for (int i = 1; i < most_halvings; ++i, part *= 0.5)
      if (take(trusted_.v, trusted_.change, part)) return true;
    return false;
  }
  /// Whether the quantity there is less than at the last place that was trusted.
  bool take(const Rates& from, const Rates& change, double part) {
    trial_ = from;
    for (std::size_t k = 0; k < from.size(); ++k) trial_[k] += part * change[k];
    lead(trial_);
    const double after = measure(trial_);
    if (!(after <= trusted_.measure + 1e-13 * std::abs(trusted_.measure))) return false;
    v_ = trial_;
    ventured_ = 0;
    return true;
  }

  [[nodiscard]] bool touches() {
    for (const NodeContact& contact : step_.contacts)
      if (gap(contact, v_) < 0) return true;
    return false;
  }

  /// A body that nothing holds or touches keeps its momentum, whatever error remains inside.
  void keep_momentum() {
    Vec3 off(0, 0, 0);
    double mass = 0;
    for (std::size_t i = 0; i < nodes_; ++i) {
      off += mass_[i] * (v_[i] - free_[i]);
      mass += mass_[i];
    }
    for (std::size_t i = 0; i < nodes_; ++i) v_[i] -= off / mass;
  }

  void end() {
    static_cast<void>(measure(v_));
    find_gradient(v_, gradient_);
    for (Held& held : step_.held) held.pushed -= step_.h * gradient_[held.node];
    for (std::uint32_t p = 0; p < step_.partners.size(); ++p) {
      Partner& partner = step_.partners[p];
      if (!partner.moves()) continue;
      const Vec3 linear = v_[linear_of(p)] - free_[linear_of(p)];
      partner.moved += step_.h * linear;
      partner.turned += step_.h * (v_[linear_of(p) + 1] - free_[linear_of(p) + 1]);
      partner.taken += partner.mass * linear;
    }
    for (std::size_t k = 0; k < step_.contacts.size(); ++k) {
      NodeContact& contact = step_.contacts[k];
      contact.pressed = step_.h * step_.h * stiffness_[k] * std::max(0.0, -gap(contact, v_));
      Partner& partner = step_.partners[contact.partner];
      if (!partner.moves()) partner.taken += step_.h * resistance(k, v_).force;
    }
    for (std::size_t i = 0; i < nodes_; ++i) x_[i] += step_.h * v_[i];
    for (const Held& held : step_.held) {
      if (held.partner != Held::nobody) continue;
      x_[held.node] = held.place;
      v_[held.node] = held.velocity;
    }
    for (std::size_t i = 0; i < nodes_; ++i) step_.body.velocities[i] = v_[i];
  }

  SubStep& step_;
  const SoftSettings& made_;
  std::vector<Vec3>& x_;              ///< at the start
  std::size_t nodes_, unknowns_ = 0;  ///< unknown are velocities of nodes, and of the bodies that they meet
  std::vector<double> mass_;
  Energies energies_;
  Rates v_, free_, gradient_, change_, rest_, steered_, toward_, product_, trial_, spread_;
  std::vector<Mat3> blocks_;
  std::vector<double> stiffness_;  ///< by contact, N/m
  std::vector<double> grips_;      ///< by contact: what friction holds, N
  std::vector<Mat3> resisting_;    ///< by contact, kg
  NodeOrder order_;
  bool factors_;
  ChainAndHolders all_;
  bool chained_ = false;
  /// The last position of Newton's method that was an improvement, and the step from there.
  struct {
    Rates v, change;
    double measure = 0;
  } trusted_;
  int ventured_ = 0;  ///< steps since
};

}  // namespace

void solve_springs(SubStep& step) {
  Springs(step).solve();
}

}  // namespace tweenfall::soft
