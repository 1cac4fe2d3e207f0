#include <tweenfall/importers/model.h>
#include <tweenfall/importers/recording_file.h>

#include "page/example_stage.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("tweenfall-recording-" + std::to_string(std::rand()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("the ending of the name chooses the form, and nothing else is left beside the file") {
  const Folder folder;
  const Recording recording = example_recording(20);
  const StageDescription stage = example_stage();
  save_recording(recording, stage, folder.path / "a.json");
  save_recording(recording, stage, folder.path / "a.CSV");
  save_recording(recording, stage, folder.path / "a.svg");
  CHECK(content(folder.path / "a.json") == recording_json(recording));
  CHECK(content(folder.path / "a.CSV") == recording_csv(recording));
  CHECK(content(folder.path / "a.svg") == recording_svg(recording, stage));
  CHECK(files_in(folder.path) == 3);
}

TEST_CASE("a file that cannot be written leaves what was there and says why") {
  const Folder folder;
  Recording recording = example_recording(20);
  const StageDescription stage = example_stage();
  CHECK_THROWS_WITH_AS(save_recording(recording, stage, folder.path / "a.mp4"),
                       doctest::Contains(".json, .csv, .svg, .html or .glb"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(save_recording(recording, stage, folder.path / "none/a.json"),
                       doctest::Contains("there is no folder"), std::runtime_error);
  save_recording(recording, stage, folder.path / "a.json");
  const std::string before = content(folder.path / "a.json");
  recording.nodes[2].twist[5].linear.x() = HUGE_VAL;
  CHECK_THROWS_AS(save_recording(recording, stage, folder.path / "a.json"), std::invalid_argument);
  CHECK(content(folder.path / "a.json") == before);
  CHECK(files_in(folder.path) == 1);
}

TEST_CASE("a recording as glTF comes back with every node where it was recorded") {
  const Folder folder;
  const Recording recording = example_recording(30);
  save_recording(recording, example_stage(), folder.path / "a.glb");
  const Model model = load_model(folder.path / "a.glb");
  REQUIRE(model.clips.size() == 1);
  CHECK(model.instances.size() == 5);  // floor, bob, crate, roller and the skinned strip
  std::size_t positions = 0;
  for (const Track& track : model.clips[0].tracks) {
    for (const NodeRecord& node : recording.nodes) {
      if (node.name != track.node) continue;
      for (std::size_t frame = 0; frame < recording.times.size(); ++frame) {
        const Pose& pose = node.world[frame].motion.pose;
        // glTF holds single precision; times are keys, so nothing is interpolated by more than their rounding.
        if (track.property == "position") {
          CHECK(near(std::get<Curve<Vec3>>(track.curve).value(recording.times[frame]), pose.position, 1e-5));
        } else if (track.property == "rotation") {
          CHECK(near(std::get<Curve<Quat>>(track.curve).value(recording.times[frame]), pose.rotation, 1e-5));
        }
      }
      positions += track.property == "position";
    }
  }
  CHECK(positions == recording.nodes.size());
}
