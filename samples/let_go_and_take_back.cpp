// A pendulum follows its script, is let go at an exact instant, and is taken back smoothly.

#include <tweenfall/curves/functions.h>
#include <tweenfall/physics/stage/stage.h>

#include <cstdio>
#include <limits>

using namespace tweenfall;

int main() {
  Clip swing;
  swing.name = "swing";
  swing.duration = std::numeric_limits<double>::infinity();
  swing.tracks = {{"pivot", "rotation", axis_curve({0, 0, 1}, oscillator({.amplitude = 1, .hz = 0.5}))}};

  Stage stage({.nodes = {{.name = "pivot", .rest = {.position = {0, 2, 0}}},
                         {.name = "bob",
                          .parent = 0,
                          .rest = {.position = {0, -1, 0}},
                          .body = BodyDescription{.shape = {Sphere{.radius = 0.05}}, .mass = 0.5}}},
               .clips = {swing},
               .plays = {{.clip = 0}}});
  stage.on_handoff([&](const HandOff& handoff) {
    const Vec3 before = handoff.before.twist.linear, after = handoff.after.twist.linear;
    std::printf("%.4f s: the bob becomes %s; its velocity was (%.4f, %.4f), is (%.4f, %.4f) m/s\n", handoff.time,
                handoff.to == Owner::free ? "free" : "keyed", before.x(), before.y(), after.x(), after.y());
  });

  const NodeId bob = stage.node("bob");
  stage.advance_to(0.4937);  // any time: the step is split here
  stage.release(bob);        // physics goes on with the curve's own velocity
  stage.advance_to(0.8);
  stage.recover(bob, {.settle = {.seconds = 0.4}});
  stage.advance_to(1.3);

  const Vec3 shown = stage.world(bob).motion.pose.position, wanted = stage.path(bob).at(1.3).pose.position;
  std::printf("at 1.3 s it is back on its curve, %.1e m from it\n", (shown - wanted).norm());
  const HandOff& back = stage.handoffs()[1];
  const bool smooth = (back.after.twist.linear - back.before.twist.linear).norm() < 1e-9;
  return smooth && (shown - wanted).norm() < 1e-12 ? 0 : 1;
}
