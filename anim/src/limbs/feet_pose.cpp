#include <tweenfall/anim/foot_placement.h>

#include "limbs/place.h"
#include "operations/account.h"

namespace tweenfall::graphs {

namespace {

class PlacedFeet : public Changing {
 public:
  PlacedFeet(Changed changed, FootPlacement placement, HeightGrid ground, Number floor, std::vector<Number> feet)
      : Changing(std::move(changed)),
        placement_(std::move(placement)),
        ground_(std::move(ground)),
        floor_(std::move(floor)),
        feet_(std::move(feet)) {}

 protected:
  void change(const Log& log, const Moment& moment, const Sample<double>& weight, const Scratch&,
              std::span<Motion> pose) const noexcept override {
    std::array<Sample<double>, most_feet_placed> weights;
    for (std::size_t i = 0; i < feet_.size(); ++i)
      weights[i] = as_share(feet_[i].sample(log, moment.time, moment.side), moment.side);
    const HeightGrid* ground = &ground_;
    place_feet(
        placement_, [ground](const Sample<Vec3>& place) { return std::optional(ground->at(place)); },
        floor_.sample(log, moment.time, moment.side), weight, {weights.data(), feet_.size()}, pose);
  }

 private:
  FootPlacement placement_;
  HeightGrid ground_;
  Number floor_;
  std::vector<Number> feet_;
};

}  // namespace

void tell(const FeetPose& pose, Account& account) {
  account.words = "feet on the ground" + share_in_words(pose.weight);
  account.pose(pose.base, "base");
  account.tell(pose.pelvis);
  for (const FeetPose::Foot& foot : pose.feet)
    account.tell(foot.start, foot.middle, foot.end, foot.axis, foot.ankle_height, foot.weight);
  account.tell(pose.ground.columns, pose.ground.heights, pose.ground.spacing_x, pose.ground.spacing_z,
               pose.ground.middle, pose.floor, pose.lowest, pose.highest, pose.evenness, pose.tilt, pose.softness,
               pose.weight);
}

std::unique_ptr<Operation> bound(const FeetPose& described, Binder& binder) {
  Changed changed = bound_change(described, "feet", binder);
  const std::size_t pelvis = binder.node(described.pelvis, {"feet", "pelvis"});
  bool known = pelvis != no_node;
  FootPlacementSettings settings{.pelvis = pelvis,
                                 .feet = {},
                                 .up = {0, 1, 0},
                                 .lowest = described.lowest,
                                 .highest = described.highest,
                                 .evenness = described.evenness,
                                 .tilt = described.tilt,
                                 .softness = described.softness};
  std::vector<Number> weights;
  settings.feet.reserve(described.feet.size());
  weights.reserve(described.feet.size());
  for (std::size_t i = 0; i < described.feet.size(); ++i) {
    const FeetPose::Foot& foot = described.feet[i];
    const auto at = [&](const char* part) { return Place{"feet", "legs", std::to_string(i), part}; };
    const std::size_t start = binder.node(foot.start, at("start")), middle = binder.node(foot.middle, at("middle")),
                      end = binder.node(foot.end, at("end"));
    known = known && start != no_node && middle != no_node && end != no_node;
    settings.feet.push_back({.leg = {start, middle, end, foot.axis}, .ankle_height = foot.ankle_height});
    weights.push_back(bound_share(foot.weight, at("weight"), binder));
  }
  const std::vector<std::string> problems = described.ground.problems();
  for (const std::string& problem : problems) binder.fault({"feet", "ground"}, problem);
  if (described.feet.size() > most_feet_placed)
    binder.fault({"feet", "legs"}, "at most " + std::to_string(most_feet_placed) + " feet are placed");
  Number floor = binder.number(described.floor, {"feet", "floor"});
  if (!known || described.feet.size() > most_feet_placed) return nullptr;
  std::optional<FootPlacement> placement;
  binder.attempt({"feet"}, [&] { placement.emplace(binder.nodes(), settings); });
  if (!placement || !problems.empty() || !changed.whole) return nullptr;
  binder.moves(pelvis);
  for (const FootPlacement::Foot& foot : placement->feet())
    for (const std::size_t node : {foot.leg.start(), foot.leg.middle(), foot.leg.end()}) binder.moves(node);
  return std::make_unique<PlacedFeet>(std::move(changed), *std::move(placement), described.ground, std::move(floor),
                                      std::move(weights));
}

}  // namespace tweenfall::graphs
