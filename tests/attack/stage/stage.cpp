// Calls on a Stage in any order, with any arguments: each is done or refused in words, a refused call changes nothing,
// and no position is ever NaN.

#include "attack/stage/calls.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace tweenfall::attack {

namespace {

constexpr int calls_per_case = 100;

class StageCalls final : public Attack {
 public:
  explicit StageCalls(std::uint64_t seed) : seed_(seed) {
    for (const auto calls : {calls_of_time(), calls_that_read(), calls_that_change()})
      for (const Call& call : calls) calls_.insert(calls_.end(), static_cast<std::size_t>(call.share), &call);
  }

  std::string run(std::uint64_t number) override {
    ++taken_;
    return play(number, nullptr);
  }

  std::string show(std::uint64_t number) override {
    std::ostringstream log;
    const std::string fault = play(number, &log);
    return log.str() + fault;
  }

 private:
  std::string play(std::uint64_t number, std::ostringstream* log) const;

  std::uint64_t seed_;
  std::vector<const Call*> calls_;  ///< each as often as its share
};

/// What is not a number, or empty, on a stage.
std::string lost_in(const Stage& stage, const StageDescription& description) {
  std::vector<WorldMotion> world(stage.nodes().size());
  stage.world(world);
  for (NodeId node = 0; node < world.size(); ++node) {
    if (!stage.contains(node)) continue;
    const Motion& motion = stage.world(node).motion;
    if (!motion.pose.position.allFinite() || !motion.pose.rotation.coeffs().allFinite())
      return stage.nodes()[node].name + " is nowhere";
    if (motion.pose.position != world[node].motion.pose.position) return "a node is somewhere else among all";
    const Twist twist = stage.twist(node);
    if (!twist.linear.allFinite() || !twist.angular.allFinite()) return "a node has a velocity that is no number";
  }
  const auto all_finite = [](const std::vector<Vec3>& places) {
    return std::all_of(places.begin(), places.end(), [](const Vec3& place) { return place.allFinite(); });
  };
  for (const SoftDescription& soft : description.softs)
    if (!all_finite(stage.soft(soft.name).positions)) return "a soft body is nowhere";
  for (const ParticlesDescription& particles : description.particles)
    if (!all_finite(stage.particles(particles.name).positions)) return "a particle is nowhere";
  for (const VehicleDescription& vehicle : description.vehicles)
    for (const StageWheel& wheel : stage.vehicle(vehicle.name))
      if (!wheel.pose.position.allFinite()) return "a wheel is nowhere";
  return {};
}

std::string StageCalls::play(std::uint64_t number, std::ostringstream* log) const {
  Random random = random_of(seed_, number);
  Caller caller{random};
  caller.log = log;
  bool strained = false;  // something odd was accepted: later a body may stop being finite
  for (int call = 0; call < calls_per_case; ++call) {
    const Call& chosen = *calls_[below(random, calls_.size())];
    caller.arguments.odd = below(random, 10) == 0;
    if (log) *log << chosen.name << (caller.arguments.odd ? ", oddly," : "") << " at " << caller.stage.time() << '\n';
    const double time = caller.stage.time();
    const std::uint64_t hash = caller.stage.state_hash();
    try {
      chosen.make(caller);
      strained = strained || caller.arguments.odd;
    } catch (const std::invalid_argument& refusal) {
      if (log) *log << "  refused: " << refusal.what() << '\n';
      if (caller.stage.time() != time || caller.stage.state_hash() != hash) return "refused, and yet something changed";
    } catch (const NotFinite& error) {
      // Once reported with node and cause, it is reported again when the run goes on.
      if ((strained || caller.arguments.odd) && !error.cause.empty()) return {};
      return std::string("thrown, though nothing odd was asked for: ") + error.what();
    } catch (const std::exception& error) {
      return std::string(chosen.name) + " is neither done nor refused: " + error.what();
    }
    if (caller.fault.empty()) caller.fault = lost_in(caller.stage, caller.description);
    if (!caller.fault.empty()) return caller.fault + " after call " + std::to_string(call) + ", " + chosen.name;
  }
  return {};
}

}  // namespace

std::unique_ptr<Attack> attack_stage(std::uint64_t seed) {
  return std::make_unique<StageCalls>(seed);
}

}  // namespace tweenfall::attack
