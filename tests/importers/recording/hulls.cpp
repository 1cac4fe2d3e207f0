#include <tweenfall/importers/model.h>
#include <tweenfall/importers/recording_file.h>

#include "page/example_stage.h"
#include "support.h"

#include <sstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A pyramid of 2 m by 2 m by 3 m that slides 4 m along x in a second.
struct Pyramid {
  StageDescription stage;
  Recording recording;
  Pyramid() {
    NodeDescription node{.name = "pyramid"};
    node.body = BodyDescription{};
    node.body->shape.solid =
        Hull{ConvexHull(std::vector<Vec3>{{1, 0, 1}, {-1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {0, 3, 0}})};
    stage.nodes.push_back(node);
    NodeRecord record{.name = "pyramid"};
    for (int frame = 0; frame <= 10; ++frame) {
      recording.times.push_back(frame / 10.0);
      record.world.push_back(placed({0.4 * frame, 0, 0}, Quat(1, 0, 0, 0), {Vec3(4, 0, 0), Vec3(0, 0, 0)}));
      record.twist.push_back({Vec3(4, 0, 0), Vec3(0, 0, 0)});
      record.owner.push_back(Owner::free);
    }
    recording.nodes.push_back(record);
  }
};

}  // namespace

TEST_CASE("a hull is drawn as its outline and its sharp edges") {
  const Pyramid slid;
  const std::string svg = recording_svg(slid.recording, slid.stage);
  const std::size_t title = svg.find("<title>pyramid</title>");
  REQUIRE(title != std::string::npos);
  const std::size_t start = svg.find(" d=\"", title) + 4;
  const std::string path = svg.substr(start, svg.find('"', start) - start);
  const std::size_t closed = path.find('Z');
  REQUIRE(closed != std::string::npos);
  CHECK(count(path.substr(0, closed), "L") == 23);
  CHECK(count(path.substr(closed), "M") == 8);
  // The outline from the side is the triangle: as wide as two thirds of its height.
  double left = 1e9, right = -1e9, low = -1e9, high = 1e9;
  std::string numbers = path.substr(0, closed);
  for (char& c : numbers)
    if (c == 'M' || c == 'L') c = ' ';
  std::istringstream stream(numbers);
  for (double x = 0, y = 0; stream >> x >> y;) {
    left = std::min(left, x);
    right = std::max(right, x);
    high = std::min(high, y);
    low = std::max(low, y);
  }
  CHECK(near((right - left) / (low - high), 2.0 / 3, 0.02));
}

TEST_CASE("a hull's faces are in the model that a recording makes, flat and as large as they are") {
  const Pyramid slid;
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "tweenfall_pyramid.glb";
  save_recording(slid.recording, slid.stage, file);
  const Model model = load_model(file);
  std::filesystem::remove(file);
  REQUIRE(model.meshes.size() == 1);
  const Mesh& mesh = model.meshes[0];
  CHECK(mesh.triangles.size() == 3 * 6);
  CHECK(mesh.positions.size() == 4 + 4 * 3);
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3& a = mesh.positions[mesh.triangles[i]];
    const Vec3 out = (mesh.positions[mesh.triangles[i + 1]] - a).cross(mesh.positions[mesh.triangles[i + 2]] - a);
    area += 0.5 * out.norm();
    CHECK(near(mesh.normals[mesh.triangles[i]], Vec3(out / out.norm()), 1e-6));
  }
  CHECK(near(area, 4 + 4 * std::sqrt(10.0), 1e-6));
}

TEST_CASE("a page holds a hull's vertices and faces") {
  const Pyramid slid;
  std::string html;
  try {
    html = recording_html(slid.recording, slid.stage);
  } catch (const std::runtime_error&) {
    MESSAGE("SKIPPED: the page, this build has no three.js inside");
    return;
  }
  const std::size_t start = html.find("id=\"data\">") + 10;
  const nlohmann::json data = nlohmann::json::parse(html.substr(start, html.find("</script>", start) - start));
  const nlohmann::json hull = data["nodes"][0]["shape"]["hull"];
  CHECK(hull["vertices"].size() == 5);
  CHECK(hull["vertices"][4] == nlohmann::json::parse("[0, 3, 0]"));
  CHECK(hull["faces"].size() == 5);
}
