// The same stack under each contact solver: how well it stands, in numbers.

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/detail.h>
#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

using namespace tweenfall;

int main() {
  const std::filesystem::path folder = std::filesystem::path(TWEENFALL_SAMPLE_DOCUMENTS) / "lectures" / "stacking";
  std::printf("solver       deepest overlap   weight sinks   fastest at last\n");
  double exact = 1, sequential = 0;
  for (const std::string name : {"sequential", "iterative", "shock", "lcp"}) {
    Stage stage(Document::read(folder / (name + ".json")).stage());
    double deepest = 0, fastest = 0;
    for (int step = 1; step <= 180; ++step) {
      stage.advance_to(step / 60.0);
      fastest = 0;
      for (int box = 1; box <= 8; ++box) {
        const std::size_t here = stage.node("box " + std::to_string(box));
        const double y = stage.world(here).motion.pose.position.y();
        const double below =
            box == 1 ? -0.25 : stage.world(stage.node("box " + std::to_string(box - 1))).motion.pose.position.y();
        deepest = std::max(deepest, 0.5 - (y - below));
        fastest = std::max(fastest, stage.twist(here).linear.norm());
      }
    }
    const double sunk = 4.25 - stage.world(stage.node("weight")).motion.pose.position.y();
    std::printf("%-12s %12.6f m %12.6f m %14.6f m/s\n", name.c_str(), deepest, sunk, fastest);
    if (name == "lcp") exact = deepest;
    if (name == "sequential") sequential = deepest;
  }
  return sequential > exact ? 0 : 1;
}
