#include "pairs/swept_bounds.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::pairs {

namespace {

/// Part of a body's radius by which its box reaches back behind it, at most.
constexpr double thrown_back = 0.1;

}  // namespace

Vec3 travel(const state::Body& body, const forces::Load& load, double dt) {
  if (body.immovable())
    return body.has_target ? Vec3(body.target().pose.position - body.motion.pose.position) : Vec3(0, 0, 0);
  if (body.asleep) return {0, 0, 0};
  return (body.drive.owner() == Owner::driven ? load.pulled : body.twist).linear * dt;
}

Bounds swept_bounds(const state::Body& body, const forces::Load& load, double room, double dt) {
  // The shape of a ball need not be read.
  const bool ball = body.makeup->roundness == body.radius() && !body.immovable();
  const Vec3 reach = Vec3::Constant(body.radius());
  Bounds swept = ball ? Bounds{body.center - reach, body.center + reach} : bounds(body.shape(), body.motion.pose);
  double swing = 0;
  Vec3 way(0, 0, 0);
  if (body.immovable()) {
    if (body.has_target) {
      const Bounds end = bounds(body.shape(), body.target().pose);
      swept.low = swept.low.cwiseMin(end.low);
      swept.high = swept.high.cwiseMax(end.high);
      // Between its ends, an arc bulges out over both.
      const double cosine = std::abs(body.target().pose.rotation.dot(body.motion.pose.rotation));
      swing = body.radius() * (1 - std::min(1.0, cosine));
    }
  } else if (!body.asleep) {
    const Twist& twist = body.drive.owner() == Owner::driven ? load.pulled : body.twist;
    way = twist.linear * dt;
    // A ball turns in place.
    if (!ball) swing = std::min(twist.angular.norm() * dt, 2.0) * body.radius();
    swing += load.acceleration.norm() * dt * dt;
  }
  const Vec3 around = Vec3::Constant(room + swing);
  // A body that hits it from behind may throw it back that far.
  const double most = thrown_back * body.radius();
  swept.low += way.cwiseMin(0.0).cwiseMin((-way).cwiseMax(-most)) - around;
  swept.high += way.cwiseMax(0.0).cwiseMax((-way).cwiseMin(most)) + around;
  return swept;
}

}  // namespace tweenfall::pairs
