// A model's skeleton sampled at any time: where a hand is, and how fast it moves.

#include <tweenfall/anim/animation.h>
#include <tweenfall/importers/model.h>

#include <cstdio>

using namespace tweenfall;

int main(int count, char** arguments) {
  const std::filesystem::path file = count > 1 ? arguments[1] : TWEENFALL_SAMPLE_DOCUMENTS "/character.glb";
  const Model model = load_model(file);
  std::printf("%s: %zu nodes, %zu mesh%s, %zu clips\n", model.name.c_str(), model.nodes.size(), model.meshes.size(),
              model.meshes.size() == 1 ? "" : "es", model.clips.size());
  for (const Clip& clip : model.clips)
    std::printf("  %-12s %.2f s, %zu tracks\n", clip.name.c_str(), clip.duration, clip.tracks.size());
  if (model.clips.empty()) return 1;

  const auto nodes = std::make_shared<const Hierarchy>(model.nodes);
  const Animation animation(nodes, model.clips, {{.clip = 0}});
  const std::size_t last = nodes->size() - 1;
  std::printf("%s during %s:\n", (*nodes)[last].name.c_str(), model.clips[0].name.c_str());
  for (int i = 0; i <= 4; ++i) {
    const double time = model.clips[0].duration * i / 4;
    const Motion motion = animation.world(last, time).motion;
    std::printf("  %.2f s  at (%6.3f %6.3f %6.3f) m, %.3f m/s\n", time, motion.pose.position.x(),
                motion.pose.position.y(), motion.pose.position.z(), motion.twist.linear.norm());
  }
  return 0;
}
