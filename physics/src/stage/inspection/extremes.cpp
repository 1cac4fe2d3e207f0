#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "actors/soft/node_order.h"
#include "actors/soft/resolved.h"
#include "forces/integrators/integrators.h"
#include "forces/pace.h"
#include "queries/body_scene.h"
#include "stage/roster/staged_softs.h"
#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

constexpr double thinnest = 1e-6, farthest = 1e9;    // m
constexpr double lightest = 1e-12, heaviest = 1e18;  // kg
constexpr double fastest = 1e6;                      // m/s
constexpr double finest = 1e-6;                      // of a body's size: what numbers at its position must resolve
constexpr std::size_t most_extremes = 100;

using Part = StageFault::Part;

/// Whether a force carries a body infinitely far away in finite time, whatever the steps.
bool runs_away(const Force& force) {
  if (const auto* vortex = std::get_if<Vortex>(&force)) return vortex->acceleration != 0 && vortex->power < -1;
  if (const auto* attractor = std::get_if<Attractor>(&force))
    return attractor->acceleration < 0 && attractor->power < -1;
  return false;
}

class Finder {
 public:
  Finder(const StageState& state, const StageDescription& description, StageInspection& out)
      : state_(state), description_(description), out_(out) {}

  void find(bool try_steps) {
    if (const double gain = state_.gravity.norm() * description_.step; gain > fastest)
      tell(Part::world, 0,
           "gravity makes bodies faster by " + brief_text(gain) + " m/s in each step; up to 1e6 m/s goes well");
    for (const StagedBody& body : state_.bodies) look_at(body);
    for (std::size_t i = 0; i < description_.softs.size(); ++i) look_at(i);
    for (std::size_t i = 0; i < description_.forces.size(); ++i) follow(i);
    if (try_steps) try_first_steps();
  }

 private:
  void tell(Part part, std::size_t index, std::string message) {
    if (out_.extremes.size() < most_extremes && told_.insert({part, index}).second)
      out_.extremes.push_back({part, index, std::move(message)});
  }
  void tell_body(const StagedBody& body, const std::string& what) {
    tell(Part::node, body.node, "\"" + description_.nodes[body.node].name + "\" " + what);
  }

  // Positions, sizes, masses and speeds

  void look_at(const StagedBody& body) {
    const Shape& shape = state_.world.shape(body.id);
    const Motion motion = state_.world.motion(body.id);
    const double away = motion.pose.position.cwiseAbs().maxCoeff();
    if (is_scenery(shape.solid)) {
      if (away > farthest) tell_body(body, "is " + brief_text(away) + " m from the origin; up to 1e9 m goes well");
      return;
    }
    const Bounds room = bounds(shape, {});
    const Vec3 size = room.high - room.low;
    const double least = size.minCoeff(), most = size.maxCoeff(), mass = state_.world.mass(body.id).mass;
    const double speed = state_.world.twist(body.id).linear.norm();
    if (least < thinnest || least < finest * most)
      tell_body(body, "is " + brief_text(least) + " m thin and " + brief_text(most) +
                          " m long; others sink into what is thinner than 1e-6 m, or than a millionth of its length");
    else if (most > farthest)
      tell_body(body, "is " + brief_text(most) + " m large; up to 1e9 m goes well");
    else if (away > farthest || away > least * finest / 1e-16)
      tell_body(body, "is " + brief_text(away) +
                          " m from the origin, where numbers are too far apart for its size of " + brief_text(least) +
                          " m; forces and contacts may throw it");
    else if (mass < lightest || mass > heaviest)
      tell_body(body, "has a mass of " + brief_text(mass) + " kg; 1e-12 to 1e18 kg go well");
    else if (speed > fastest)
      tell_body(body, "moves at " + brief_text(speed) + " m/s; up to 1e6 m/s goes well");
    const BodyDescription& described = *description_.nodes[body.node].body;
    const double damping = std::max(described.linear_damping, described.angular_damping);
    if (forces::asking(description_.world.integrator) && !forces::implicit(description_.world.integrator) &&
        damping * description_.step > 1)
      tell_body(body, "is damped at a rate of " + brief_text(damping) + beyond_step(damping));
  }

  void look_at(std::size_t soft) {
    double away = 0;
    for (const Vec3& place : description_.softs[soft].soft.positions)
      away = std::max(away, place.cwiseAbs().maxCoeff());
    if (away > farthest)
      tell(Part::soft, soft, "reaches " + brief_text(away) + " m from the origin; up to 1e9 m goes well");
    look_at_load(soft);
  }

  /// Nodes under tension T swing across their edge by w^2 = 4 T / (length mass). By positions that is found from the
  /// directions that edges have, as in an explicit step, which w h > 2 throws; passes over them find it anew.
  void look_at_load(std::size_t soft) {
    const auto& list = state_.softs->list;
    if (soft >= list.size()) return;
    const SoftSettings& made = soft_settings(state_.world, list[soft].second);
    double h = description_.step;
    for (const auto& [name, id] : list) h = std::min(h, *soft_settings(state_.world, id).sub_step);
    if (made.solver == SoftSolver::springs) return look_at_stiffness(soft, made, h);
    look_at_resolution(soft, made, h);
    const std::vector<state::Body>& bodies = queries::bodies_of(state_.world);
    for (const auto& [pin, force] : soft_pins(state_.world, list[soft].second)) {
      if (pin.body == BodyId{} || bodies[pin.body.index].immovable()) continue;
      std::ptrdiff_t bearing = 0;
      for (const auto& [name, id] : list)
        bearing += std::ranges::count(soft_pins(state_.world, id), pin.body,
                                      [](const SoftPinReading& reading) { return reading.pin.body; });
      const double load = bodies[pin.body.index].mass().mass * state_.gravity.norm() / static_cast<double>(bearing);
      for (const SoftEdge& edge : made.edges) {
        if (edge.a != pin.node && edge.b != pin.node) continue;
        const double mass = made.masses[edge.a == pin.node ? edge.b : edge.a];
        const double longest = std::sqrt(*edge.length * mass / load * *made.iterations);
        if (!(h > longest)) continue;
        tell(Part::soft, soft,
             "may not hold \"" + description_.nodes[state_.node_of[pin.body.index]].name + "\", whose " +
                 brief_text(load) + " N hang on nodes of " + brief_text(mass) +
                 " kg: by positions that takes sub-steps " + "of less than " + brief_text(longest) +
                 " s, or more iterations; by springs any will do");
        return;
      }
    }
  }

  /// Infinite stiffness is no number that anybody expects to read off a stretch.
  void look_at_resolution(std::size_t soft, const SoftSettings& made, double h) {
    const auto is_softer = [&](const std::string& what, double stiffness, const char* unit, double acts) {
      if (std::isinf(stiffness) || !(stiffness > acts)) return false;
      tell(Part::soft, soft,
           "has " + what + " of " + brief_text(stiffness) + unit + " that act with " + brief_text(acts) + unit +
               ": by positions more takes sub-steps of less than " + brief_text(h * std::sqrt(acts / stiffness)) +
               " s, or more iterations; by springs any will do");
      return true;
    };
    if (soft::passes_over_edges(soft::begun(made)))
      for (const SoftEdge& edge : made.edges)
        if (is_softer("edges", edge.stiffness, " N/m", soft::resolved_stiffness(made, edge, h))) return;
    for (const SoftTetrahedron& solid : made.tetrahedra)
      if (is_softer("volumes", solid.stiffness, " Pa", *solid.volume * soft::resolved_stiffness(made, solid, h)))
        return;
    for (const SoftEnclosure& enclosure : made.enclosures)
      if (is_softer("a volume", enclosure.stiffness, " Pa",
                    *enclosure.volume * soft::resolved_stiffness(made, enclosure, h)))
        return;
  }

  /// What is too wide to be solved at once is left to conjugate gradients, which have an end.
  void look_at_stiffness(std::size_t soft, const SoftSettings& made, double h) {
    constexpr double stiffest = 1e6;  // against the mass of a node
    if (soft::can_be_factored(made, soft::NodeOrder(made))) return;
    for (const SoftEdge& edge : made.edges) {
      const double most = stiffest / (h * h * (1 / made.masses[edge.a] + 1 / made.masses[edge.b]));
      if (!(edge.stiffness > most)) continue;
      tell(Part::soft, soft,
           "has springs of " + brief_text(edge.stiffness) + " N/m; between nodes as light, sub-steps of " +
               brief_text(h) + " s bear up to " + brief_text(most) + " N/m: beyond that it may gain energy");
      return;
    }
  }

  // Forces that change faster than steps can follow

  class Present : public forces::Moment {
   public:
    using Moment::Moment;
    [[nodiscard]] forces::Glimpse of(std::uint32_t body) const override { return forces::now(bodies[body]); }
  };

  [[nodiscard]] std::string beyond_step(double rate) const {
    return "/s, which steps of " + brief_text(description_.step) +
           " s cannot follow: the motion may grow until the run fails. Steps of less than " + brief_text(1 / rate) +
           " s show it";
  }

  void follow(std::size_t index) {
    if (runs_away(description_.forces[index].force))
      tell(Part::force, index,
           "this force drives outward and grows faster than the distance: it carries bodies infinitely far away "
           "in a finite time");
    constexpr std::uint32_t most_looked_at = 1000;
    const Integrator integrator = description_.world.integrator;
    const forces::NumberedForce& force = queries::forces_of(state_.world)[index];
    if (forces::implicit(integrator) || std::holds_alternative<Field>(force.force)) return;
    const std::vector<state::Body>& bodies = queries::bodies_of(state_.world);
    const bool resistance = forces::asking(integrator) != nullptr;
    const Present moment(bodies, state_.gravity, 0);
    std::vector<std::uint32_t> all;
    for (const StagedBody& body : state_.bodies)
      if (all.size() < most_looked_at && !bodies[body.id.index].immovable()) all.push_back(body.id.index);
    forces::Pace pace;
    std::uint32_t whom = 0;
    forces::each_acted(force, bodies, all, [&](std::uint32_t i) {
      const state::Body& body = bodies[i];
      if (body.immovable()) return;
      const auto see = [&](const Vec3& linear) {
        const forces::Pace other = forces::pace_of(force, body, linear, moment, resistance);
        if (std::max(other.damping, other.swing) > std::max(pace.damping, pace.swing)) pace = other, whom = i;
      };
      see(body.twist.linear);
      if (!resistance) return;
      if (const double speed = forces::falling_speed(force, body, moment); std::isfinite(speed))
        see(state_.gravity.normalized() * speed);
    });
    const double rate = std::max(pace.damping, pace.swing);
    if (!(rate * description_.step > 1)) return;
    tell(Part::force, index,
         std::string("this force ") + (pace.damping > pace.swing ? "slows" : "swings") + " \"" +
             description_.nodes[state_.node_of[whom]].name + "\" at a rate of " + brief_text(rate) + beyond_step(rate) +
             (pace.damping > pace.swing && resistance ? ", and exact-quadratic is stable at any" : ""));
  }

  // What none of that shows: the first steps of a copy, without clips and rules

  void try_first_steps() {
    constexpr std::size_t worth = 20'000, most_steps = 256;
    const auto asks_caller = [](const ForceDescription& force) { return std::holds_alternative<Field>(force.force); };
    if (!out_.extremes.empty() || std::ranges::any_of(description_.forces, asks_caller)) return;
    World trial = state_.world;
    std::size_t parts = 1 + state_.bodies.size();
    for (const SoftDescription& soft : description_.softs) parts += soft.soft.positions.size();
    // Long steps are solved in pieces, whose number grows with their length.
    constexpr double longest = 120;  // s
    const auto affordable = static_cast<std::size_t>(std::clamp(longest / description_.step, 1.0, double{most_steps}));
    const std::size_t steps = std::clamp(worth / parts, std::size_t{1}, affordable);
    const auto node_of = [&](const BodyId& body) -> const StagedBody& {
      return *state_.body(state_.node_of[body.index]);
    };
    for (std::size_t i = 1; i <= steps; ++i) {
      std::vector<Vec3> before;
      for (const state::Body& body : queries::bodies_of(trial)) before.push_back(body.center);
      const double began = trial.time();
      try {
        trial.step(description_.step);
      } catch (const SoftNotFinite& fault) {
        for (std::size_t soft = 0; soft < state_.softs->list.size(); ++soft)
          if (state_.softs->list[soft].second == fault.soft) tell(Part::soft, soft, "will not last: " + fault.cause);
        return;
      } catch (const NotFinite& fault) {
        tell_body(node_of(fault.body), "will not last: at " + brief_text(fault.time) + " s " + fault.cause);
        return;
      }
      for (const StagedBody& body : state_.bodies)
        if (const double speed = trial.twist(body.id).linear.norm(); speed > fastest)
          tell_body(body, "is thrown: after " + brief_text(trial.time()) + " s it moves at " + brief_text(speed) +
                              " m/s, by forces, joints or contacts that are too strong for the step");
      for (std::size_t soft = 0; soft < state_.softs->list.size(); ++soft)
        for (const Vec3& velocity : soft_velocities(trial, state_.softs->list[soft].second))
          if (velocity.norm() > fastest)
            tell(Part::soft, soft,
                 "is thrown: after " + brief_text(trial.time()) + " s it moves at " + brief_text(velocity.norm()) +
                     " m/s, by what is too strong for the step");
      for (std::size_t force = 0; force < description_.forces.size(); ++force)
        if (const auto* field = std::get_if<ForceFormula>(&description_.forces[force].force))
          follow_through(*field, force, trial, before, began);
      if (!out_.extremes.empty()) return;
    }
  }

  /// Whether a body went, in a step, all the way through a place where a field is another than before it and behind.
  void follow_through(const ForceFormula& field, std::size_t index, const World& trial, const std::vector<Vec3>& before,
                      double began) {
    const std::vector<state::Body>& bodies = queries::bodies_of(trial);
    std::vector<std::uint32_t> all;
    for (const StagedBody& body : state_.bodies) all.push_back(body.id.index);
    forces::each_acted(queries::forces_of(trial)[index], bodies, all, [&](std::uint32_t i) {
      const state::Body& body = bodies[i];
      if (body.immovable()) return;
      const Vec3 way = body.center - before[i], velocity = way / description_.step;
      const double mass = body.mass().mass;
      const std::vector<double> leaps = field.leaps_on_way(mass, before[i], body.center, began, description_.step);
      for (std::size_t k = 1; k < leaps.size(); ++k) {
        const auto force_at = [&](double since) {
          return field.force(mass, before[i] + since * velocity, velocity, began + since);
        };
        const double within = leaps[k] - leaps[k - 1];
        const Vec3 inside = force_at(leaps[k - 1] + 0.5 * within);
        if (!(within > 1e-9) || inside == force_at(leaps[k - 1] - 1e-9) || inside == force_at(leaps[k] + 1e-9))
          continue;
        tell(Part::force, index,
             "\"" + description_.nodes[state_.node_of[i]].name +
                 "\" goes through a place where this field is another, " + brief_text(within * velocity.norm()) +
                 " m long, within one step, in which it goes " + brief_text(way.norm()) +
                 " m: what the field does there may be passed by. Steps of less than " + brief_text(within) +
                 " s show it");
        return;
      }
    });
  }

  const StageState& state_;
  const StageDescription& description_;
  StageInspection& out_;
  std::set<std::pair<Part, std::size_t>> told_;
};

}  // namespace

void find_extremes(const StageState& state, const StageDescription& description, bool try_steps, StageInspection& out) {
  Finder(state, description, out).find(try_steps);
}

}  // namespace tweenfall::staging
