// Two clips cross-faded: the velocity of the blend includes the rate of its own weight.

#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/keys.h>

#include <cmath>
#include <cstdio>

using namespace tweenfall;

namespace {

/// A clip that holds the hand at one height: by itself it never moves.
Clip holding(const char* name, double height) {
  Clip clip;
  clip.name = name;
  clip.duration = 2;
  clip.tracks = {{"hand", "position", Curve<Vec3>(Vec3(0, height, 0))}};
  return clip;
}

}  // namespace

int main() {
  const auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{{"hand", no_node, {}}});
  const auto fade =
      keyed_curve<double>({{.time = 0.5, .value = 0.0, .ease = Ease::smooth_clamped()}, {.time = 0.7, .value = 1.0}});
  const Animation animation(nodes, {holding("low", 0.0), holding("high", 0.2)},
                            {{.clip = 0}, {.clip = 1, .weight = fade}});

  std::printf("  time    height  velocity\n");
  for (double time = 0.45; time < 0.76; time += 0.05) {
    const Motion hand = animation.sample_node(0, time);
    std::printf("%6.2f %9.4f %9.4f\n", time, hand.pose.position.y(), hand.twist.linear.y());
  }

  // Both clips stand still; half way the hand still moves at 0.2 m times the weight's rate.
  const Motion middle = animation.sample_node(0, 0.6);
  std::printf("half way: %.3f m/s\n", middle.twist.linear.y());
  return std::abs(middle.twist.linear.y() - 0.2 * fade.rate(0.6)) < 1e-12 && middle.twist.linear.y() > 0.9 ? 0 : 1;
}
