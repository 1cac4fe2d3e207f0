#include "plot/track_angles.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace tweenfall::plotting {

namespace {

constexpr double in_degrees = 180 / std::numbers::pi;

Quat rotation_of(const TrackPoint& point) {
  return {point.values[3], point.values[0], point.values[1], point.values[2]};
}
Vec3 velocity_of(const TrackPoint& point) {
  return {point.rates[0], point.rates[1], point.rates[2]};
}

template <class Use>
void for_all_points(PlottedTrack& plotted, const Use& use) {
  for (TrackPoint& point : plotted.curve) use(point);
  for (PlottedKey& key : plotted.keys) {
    use(key.in);
    use(key.out);
  }
  for (auto& points : plotted.simulated)
    for (TrackPoint& point : points) use(point);
}

/// The common axis of all turns, with its largest part positive; empty where there is none.
std::optional<Vec3> common_axis(PlottedTrack& plotted) {
  Vec3 axis(0, 0, 0);
  for_all_points(plotted, [&](const TrackPoint& point) {
    const Vec3 part(point.values[0], point.values[1], point.values[2]);
    if (part.norm() > axis.norm()) axis = part;
  });
  if (!(axis.norm() > 1e-9)) return {};
  Eigen::Index largest = 0;
  (void)axis.cwiseAbs().maxCoeff(&largest);
  axis = Vec3(axis / (axis[largest] < 0 ? -axis.norm() : axis.norm()));
  bool common = true;
  for_all_points(plotted, [&](const TrackPoint& point) {
    const Vec3 part(point.values[0], point.values[1], point.values[2]), velocity = velocity_of(point);
    common = common && part.cross(axis).norm() < 1e-7 && velocity.cross(axis).norm() < 1e-6 * (1 + velocity.norm());
  });
  return common ? std::optional(axis) : std::nullopt;
}

double nearest_turn(double angle, double reference) {
  return angle + 360 * std::floor((reference - angle) / 360 + 0.5);
}

class Angles {
 public:
  explicit Angles(const std::optional<Vec3>& axis) : axis_(axis) {}

  /// The angles nearest to `expected`; the plain ones where there are none yet.
  [[nodiscard]] std::vector<double> of(const Quat& q, const std::vector<double>& expected) const {
    if (axis_) {
      const double angle = 2 * elementary::atan2(q.vec().dot(*axis_), q.w()) * in_degrees;
      return {expected.empty() ? angle : nearest_turn(angle, expected[0])};
    }
    const Vec3 plain = to_euler(q) * in_degrees;
    if (expected.empty()) return {plain[0], plain[1], plain[2]};
    // Where the second is a right angle, the first and third turn about the same axis: only their sum or difference is
    // known.
    if (std::abs(std::abs(plain[1]) - 90) < 1e-5) {
      const double sign = plain[1] < 0 ? -1 : 1, sum = expected[0] + sign * expected[2];
      const double change = nearest_turn(plain[0] + sign * plain[2], sum) - sum;
      return {expected[0] + change / 2, nearest_turn(plain[1], expected[1]), expected[2] + sign * change / 2};
    }
    // The two triples of angles for the same rotation, each up to whole turns.
    std::vector<double> best;
    double least = HUGE_VAL;
    for (const Vec3& way : {plain, Vec3(plain[0] + 180, 180 - plain[1], plain[2] + 180)}) {
      std::vector<double> angles;
      double distance = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        angles.push_back(nearest_turn(way[static_cast<Eigen::Index>(i)], expected[i]));
        distance += std::abs(angles[i] - expected[i]);
      }
      // NaN is never nearer than anything, but must still give a result.
      if (best.empty() || distance < least) {
        least = distance;
        best = angles;
      }
    }
    return best;
  }

  [[nodiscard]] std::vector<double> rates(const Vec3& velocity) const {
    const Vec3 v = velocity * in_degrees;
    if (axis_) return {v.dot(*axis_)};
    return {v[0], v[1], v[2]};
  }

  void change(TrackPoint& point, const std::vector<double>& expected) const {
    const Vec3 velocity = velocity_of(point);
    point.values = of(rotation_of(point), expected);
    point.rates = rates(velocity);
  }

  /// Point after point; about a common axis the rate tells how far a fast turn went in between.
  void change(std::vector<TrackPoint>& points, std::vector<double> expected) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) {
        expected = points[i - 1].values;
        if (axis_ && !points[i].starts)
          expected[0] += (points[i].time - points[i - 1].time) *
                         (points[i - 1].rates[0] + velocity_of(points[i]).dot(*axis_) * in_degrees) / 2;
      }
      change(points[i], expected);
    }
  }

 private:
  std::optional<Vec3> axis_;
};

}  // namespace

void turn_into_angles(PlottedTrack& plotted) {
  const std::optional<Vec3> axis = common_axis(plotted);
  const Angles angles(axis);
  angles.change(plotted.curve, {});
  const auto shown_at = [&](double time) {
    const auto after = std::lower_bound(plotted.curve.begin(), plotted.curve.end(), time,
                                        [](const TrackPoint& point, double t) { return point.time < t; });
    return after == plotted.curve.end() ? plotted.curve.back().values : after->values;
  };
  for (PlottedKey& key : plotted.keys) {
    angles.change(key.in, shown_at(key.time));
    angles.change(key.out, key.in.values);
  }
  // Angles continue from one owner to the next.
  const std::vector<TrackPoint>* before = nullptr;
  for (auto& points : plotted.simulated) {
    if (points.empty()) continue;
    angles.change(points, before ? before->back().values : shown_at(points.front().time));
    before = &points;
  }
  plotted.names = {"x", "y", "z"};
  plotted.unit = "degrees";
  plotted.rate_unit = "degrees/s";
  if (axis) {
    plotted.names = {"angle"};
    for (Eigen::Index i = 0; i < 3; ++i)
      if ((*axis)[i] > 1 - 1e-9) plotted.names = {std::string(1, "xyz"[i])};
  }
  plotted.rate_names = plotted.names;
}

void turn_into_degrees(PlottedTrack& plotted) {
  for_all_points(plotted, [](TrackPoint& point) {
    for (double& value : point.values) value *= in_degrees;
    for (double& rate : point.rates) rate *= in_degrees;
  });
  for (PlottedKey& key : plotted.keys)
    for (PlottedHandle& handle : key.handles) handle.change *= in_degrees;
  plotted.unit = "degrees";
  plotted.rate_unit = "degrees/s";
}

}  // namespace tweenfall::plotting
