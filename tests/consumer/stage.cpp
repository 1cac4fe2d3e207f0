// Uses all modules: reads a document, runs its physics, reads the result.

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/stage/stage.h>

#include <cmath>
#include <cstdio>

int main() {
  const tweenfall::Document document = tweenfall::Document::parse(
      R"({"tweenfall": 1, "nodes": {"ball": {"position": [0, 5, 0], "body": {"shape": {"sphere": {"radius": 0.1}}}}}})",
      "ball.json", ".");
  tweenfall::Stage stage(document.stage());
  stage.advance(0.5);
  const tweenfall::Vec3 position = stage.world(stage.node("ball")).motion.pose.position;
  std::printf("%a %a %a\n", position.x(), position.y(), position.z());
  return std::abs(position.y() - (5.0 - 0.5 * 9.81 * 0.25)) < 1e-9 ? 0 : 1;
}
