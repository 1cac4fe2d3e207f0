#include <tweenfall/anim/foot_placement.h>

#include "chains/angle_limit.h"
#include "chains/moving.h"
#include "chains/problems.h"

namespace tweenfall {
namespace chains {
namespace {

constexpr double steepest = 0.1;    // least part of the normal along up
constexpr double taken_over = 0.1;  // weight from which on the legs bend as they must to stand

// The goal of a foot: how much higher the ground is than the floor, and the orientation of its sole.
struct Step {
  Arrow ankle;       // by the script
  Turning rotation;  // by the script
  Dual rise;
  Turning tilt;
};

Dual number(const Sample<double>& sample) noexcept {
  return {sample.value, sample.rate};
}

Step step_of(const FootPlacement& placement, std::size_t foot, const GroundAt& ground, const Dual& floor,
             const Dual& weight, std::span<const Motion> pose) noexcept {
  const Vec3 still(0, 0, 0), &up = placement.up();
  const std::size_t end = placement.feet()[foot].leg.end();
  const Motion world = in_world(placement.nodes(), end, pose);
  Step step;
  step.ankle = position_of(world);
  step.rotation = rotation_of(world);
  const std::optional<Ground> below = ground({step.ankle.v, step.ankle.d, still});
  if (!below) return step;
  const Measured normal = measured({below->normal, below->normal_rate});
  const double steepness = normal.unit.v.dot(up);
  if (!normal.any || !(steepness > steepest)) return step;
  // The ground is the plane perpendicular to its normal, which gives the change of its height below a moving foot.
  const Vec3 sideways = step.ankle.d - step.ankle.d.dot(up) * up;
  const Dual height(below->height, below->height_rate - normal.unit.v.dot(sideways) / steepness);
  step.rise = weight * (height - floor);
  const Arrow lain = within_angle(normal.unit, {up, still}, placement.tilt(), 0.25 * placement.tilt());
  const Turning whole = arc({up, still}, lain, any_across(up));
  step.tilt = exp_turn(weight * log_turn(whole));
  return step;
}

// The height that the lowest foot allows the pelvis.
Dual lowest_of(std::span<const Step> steps, double evenness) noexcept {
  Dual lowest = steps.front().rise;
  for (const Step& step : steps)
    if (step.rise.v < lowest.v) lowest = step.rise;
  constexpr double least = 1e-9;  // m; smaller ones would be invisible, with rates too large
  if (!(evenness > least)) return lowest;
  // The mean of exp(-rise / evenness), relative to the lowest so that nothing overflows.
  Dual mean;
  for (const Step& step : steps) mean = mean + exponential((lowest - step.rise) / Dual(evenness));
  mean = mean / Dual(static_cast<double>(steps.size()));
  return lowest - Dual(evenness) * Dual(elementary::log(mean.v), mean.d / mean.v);
}

}  // namespace
}  // namespace chains

FootPlacement::FootPlacement(const Hierarchy& nodes, const FootPlacementSettings& settings)
    : nodes_(nodes),
      up_(settings.up),
      lowest_(settings.lowest),
      highest_(settings.highest),
      evenness_(settings.evenness),
      tilt_(settings.tilt),
      softness_(settings.softness) {
  chains::Problems problems("foot placement");
  pelvis_ = problems.at({"pelvis"}).node(nodes, settings.pelvis, "pelvis");
  problems.at({"legs"}).require(!settings.feet.empty() && settings.feet.size() <= most_feet_placed,
                                "it has " + std::to_string(settings.feet.size()) + " feet; it needs from 1 to " +
                                    std::to_string(most_feet_placed));
  problems.at({}).require_finite(up_, "up");
  problems.require(up_.squaredNorm() > 0, "up is zero");
  problems.at({"lowest"}).require_in(lowest_, 0, chains::largest, "lowest");
  problems.at({"highest"}).require_in(highest_, 0, chains::largest, "highest");
  problems.at({"evenness"}).require_in(evenness_, 0, chains::largest, "evenness");
  problems.at({"tilt"}).require_in(tilt_, 0, 0.5 * std::numbers::pi, "tilt");
  problems.at({"softness"}).require_in(softness_, 0, 0.5, "softness");
  up_ = up_ / std::sqrt(up_.squaredNorm());
  std::vector<Motion> rest(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) rest[i].pose = nodes[i].rest;
  for (std::size_t i = 0; i < settings.feet.size(); ++i) {
    const FootSettings& told = settings.feet[i];
    const std::string name = "foot " + std::to_string(i + 1);
    const std::string number = std::to_string(i);
    problems.at({"legs", number});
    problems.include(
        [&] {
          Foot foot{TwoBoneChain(nodes, told.leg), 0};
          const WorldMotion world =
              nodes.world_motion(foot.leg.end(), [&](std::size_t node) -> const Motion& { return rest[node]; });
          foot.ankle_height = told.ankle_height.value_or(std::max(0.0, world.motion.pose.position.dot(up_)));
          problems.at({"legs", number, "ankle_height"})
              .require_in(foot.ankle_height, -chains::largest, chains::largest, "ankle_height of " + name);
          if (pelvis_ != no_node)
            problems.at({"legs", number, "start"})
                .require(chains::is_below(nodes, foot.leg.start(), pelvis_),
                         name + ": its leg must be below the pelvis (" + chains::called(nodes, settings.pelvis) + ")");
          for (const Foot& other : feet_)
            problems.at({"legs", number})
                .require(!chains::is_below(nodes, foot.leg.end(), other.leg.start()) &&
                             !chains::is_below(nodes, other.leg.end(), foot.leg.start()),
                         name + ": its leg shares joints with one before");
          feet_.push_back(std::move(foot));
        },
        name + ":");
  }
  problems.report();
}

void place_feet(const FootPlacement& placement, const GroundAt& ground, const Sample<double>& floor,
                const Sample<double>& weight, std::span<const Sample<double>> weights,
                std::span<Motion> pose) noexcept {
  using namespace chains;
  if (is_nothing(weight)) return;
  const Hierarchy& nodes = placement.nodes();
  const Arrow up{placement.up(), Vec3(0, 0, 0)};
  const std::size_t count = placement.feet().size();
  Step steps[most_feet_placed];
  for (std::size_t i = 0; i < count; ++i) {
    const Dual own = i < weights.size() ? number(weights[i]) : Dual(1);
    steps[i] = step_of(placement, i, ground, number(floor), number(weight) * own, pose);
  }

  const WorldMotion above_pelvis = above(nodes, placement.pelvis(), pose);
  const Inward around(above_pelvis);
  if (around.flat()) return;
  Dual fall = lowest_of(std::span(steps).first(count), placement.evenness());
  if (fall.v < -placement.lowest()) fall = Dual(-placement.lowest());
  if (fall.v > placement.highest()) fall = Dual(placement.highest());
  const Arrow way = around.direction(fall * up);
  Motion& pelvis = pose[placement.pelvis()];
  pelvis.pose.position += way.v;
  pelvis.twist.linear += way.d;

  // A leg that the script bends otherwise, or stretches beyond its softness, would jump at the least weight.
  const Dual leg = smooth_step(number(weight) / Dual(taken_over));
  for (std::size_t i = 0; i < count; ++i) {
    const FootPlacement::Foot& foot = placement.feet()[i];
    const Step& step = steps[i];
    const Arrow ankle = Dual(foot.ankle_height) * up;
    const Arrow target = step.ankle + step.rise * up + step.tilt * ankle - ankle;
    reach(foot.leg, {.target = {target.v, target.d, Vec3(0, 0, 0)}, .softness = placement.softness()},
          {leg.v, leg.d, 0}, pose);
    const Motion outer = in_world(nodes, nodes[foot.leg.end()].parent, pose);
    const Turning local = chains::inverse(rotation_of(outer)) * step.tilt * step.rotation;
    turn_to(pose[foot.leg.end()], reflected_by(tweenfall::pose::reflection_of(outer.pose.scale), local), {1, 0, 0});
  }
}

}  // namespace tweenfall
