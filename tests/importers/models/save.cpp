// Models written as binary glTF: read back to the same poses, and passed by Khronos' validator.

#include "importers/models/model_support.h"

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include <cstdlib>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Largest difference between two models' nodes and vertices over their clips; sizes must agree.
double difference(const Model& a, const Model& b) {
  Posed one(a), other(b);
  double largest = 0;
  const auto compare = [&] {
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
      const std::size_t same = other.find(a.nodes[i].name);
      REQUIRE(same != no_node);
      const WorldMotion &x = one.world(i), &y = other.world(same);
      const double size = std::max({1.0, x.linear.cwiseAbs().maxCoeff(), x.motion.pose.position.cwiseAbs().maxCoeff()});
      largest = std::max({largest, (x.linear - y.linear).cwiseAbs().maxCoeff() / size,
                          (x.motion.pose.position - y.motion.pose.position).cwiseAbs().maxCoeff() / size});
    }
    REQUIRE(a.instances.size() == b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
      const std::vector<Vec3> p = one.vertices(a.instances[i]), q = other.vertices(b.instances[i]);
      REQUIRE(p.size() == q.size());
      for (std::size_t k = 0; k < p.size(); ++k)
        largest = std::max(largest, (p[k] - q[k]).cwiseAbs().maxCoeff() / std::max(1.0, p[k].cwiseAbs().maxCoeff()));
    }
  };
  compare();
  for (std::size_t clip = 0; clip < std::min(a.clips.size(), b.clips.size()); ++clip) {
    one.play(clip);
    other.play(clip);
    for (int i = 0; i <= 12; ++i) {
      // Off the keys, where a jump may fall slightly earlier or later by rounding of the time.
      const double time = (0.003 + 0.0829 * i) * a.clips[clip].duration;
      one.at(time);
      other.at(time);
      compare();
    }
  }
  return largest;
}

/// A bar of two joints with a morph target, moved by every kind of curve.
Model bar() {
  Model model;
  model.name = "bar";
  model.nodes = {{"base"}, {"top", 0, {{0, 1, 0}, {1, 0, 0, 0}, {1, 1, 1}}}, {"body"}};
  Mesh mesh;
  mesh.name = "bar";
  for (int ring = 0; ring < 3; ++ring)
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back({corner == 1 ? 0.2 : 0.0, ring * 1.0, corner == 2 ? 0.2 : 0.0});
      mesh.normals.push_back({0, 1, 0});
      mesh.influences.add({{0, 1 - 0.5 * ring}, {1, 0.5 * ring}});
    }
  for (std::uint32_t i = 0; i < 6; ++i) mesh.triangles.insert(mesh.triangles.end(), {i, i + 1, i + 3});
  mesh.morphs.push_back({"swell", std::vector<Vec3>(9, Vec3(0.1, 0, 0.1)), {}});
  mesh.rest_weights = {0.25};
  mesh.base_color = Color{Vec4(0.9, 0.4, 0.1, 1)};
  model.meshes.push_back(mesh);
  Skin skin;
  skin.joints = {0, 1};
  skin.inverse_binds = {{}, {Mat3::Identity(), {0, -1, 0}}};
  model.skins.push_back(skin);
  model.instances.push_back({2, 0, 0});

  const auto step = keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::hold()},
                                       {.time = 0.4, .value = {1, 0, 0}, .ease = Ease::hold()},
                                       {.time = 1, .value = {2, 0, 0}}});
  const auto smooth = keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}, .ease = Ease::smooth()},
                                         {.time = 0.5, .value = {0, 2, 0}, .ease = Ease::smooth()},
                                         {.time = 1, .value = {0, 1, 1}}});
  const auto turn = keyed_curve<Quat>(
      {{.time = 0, .value = {1, 0, 0, 0}, .ease = Ease::linear()}, {.time = 1, .value = {0.8, 0, 0, 0.6}}});
  const auto swell = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 1, .value = 1.5}});
  Clip clip{.name = "all kinds", .duration = 1};
  clip.tracks = {{"base", "position", step},
                 {"base", "rotation", turn},
                 {"top", "position", smooth},
                 {"top", "rotation", axis_curve({0, 0, 1}, oscillator({.amplitude = 0.5, .hz = 2}))},
                 {"body", "weights", WeightCurves{swell}}};
  model.clips.push_back(clip);
  return model;
}

bool validator_is_there(std::string& module) {
  const char* given = std::getenv("TWEENFALL_GLTF_VALIDATOR");
  module = given && *given ? given : "gltf-validator";
  return std::system(("node -e \"require('" + module + "')\" > /dev/null 2>&1").c_str()) == 0;
}

}  // namespace

TEST_CASE("a saved model reads back to the same poses") {
  const ScratchFolder folder("save");
  const Model model = bar();
  save_glb(model, folder / "bar.glb", 240);
  const Model back = load_model(folder / "bar.glb");
  CHECK(back.repairs.empty());
  REQUIRE(back.clips.size() == 1);
  CHECK(back.clips[0].tracks.size() == 5);
  CHECK(back.clips[0].duration == doctest::Approx(1));
  // The oscillator alone is not exact: 240 straight lines per second under a curvature of 79 rad/s^2.
  CHECK(difference(model, back) < 0.5 * 79.0 / 4 / 240 / 240 + 1e-6);
}

TEST_CASE("vertices that follow nine joints follow all nine when saved and read back") {
  const ScratchFolder folder("many-joints");
  Model model = bar();
  model.clips.clear();
  Skin& skin = model.skins[0];
  while (skin.joints.size() < 9) {
    model.nodes.push_back({"joint" + std::to_string(skin.joints.size()), 0, {}});
    skin.joints.push_back(model.nodes.size() - 1);
    skin.inverse_binds.push_back({});
  }
  Mesh& mesh = model.meshes[0];
  mesh.influences = {};
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    std::vector<Influence> pulls;
    for (std::uint32_t joint = 0; joint < 9; ++joint) pulls.push_back({joint, (joint + 1) / 45.0});
    mesh.influences.add(pulls);
  }
  save_glb(model, folder / "many.glb");
  const Model back = load_model(folder / "many.glb");
  CHECK(back.repairs.empty());
  const Influences& influences = back.meshes.at(0).influences;
  REQUIRE(influences.size() == mesh.positions.size());
  for (std::size_t vertex = 0; vertex < influences.size(); ++vertex) {
    REQUIRE(influences[vertex].size() == 9);
    for (const Influence& influence : influences[vertex])
      CHECK(near(influence.weight, (influence.joint + 1) / 45.0, 1e-7));
  }
}

TEST_CASE("step, linear and cubic keys keep their kind when saved") {
  const ScratchFolder folder("kinds-kept");
  save_glb(bar(), folder / "bar.glb");
  const Model back = load_model(folder / "bar.glb");
  for (const Track& track : back.clips[0].tracks) {
    CAPTURE(track.name());
    if (track.name() == "base.position") {
      const auto& curve = std::get<Curve<Vec3>>(track.curve);
      CHECK(curve.knots().size() == 3);
      CHECK(curve.value(0.39) == Vec3(0, 0, 0));
      CHECK(curve.value(0.41) == Vec3(1, 0, 0));
    } else if (track.name() == "top.position") {
      const auto& curve = std::get<Curve<Vec3>>(track.curve);
      CHECK(curve.knots().size() == 3);
      CHECK(curve.rate(0.5).isApprox(Vec3(0, 0, 1), 1e-6));
    } else if (track.name() == "base.rotation") {
      CHECK(std::get<Curve<Quat>>(track.curve).knots().size() == 2);
    }
  }
}

TEST_CASE("every glTF model reads back from what was saved of it to the same poses") {
  const ScratchFolder folder("resave");
  for (const auto& file : files_in(models_folder() / "gltf", {".gltf", ".glb"})) {
    CAPTURE(file.filename().string());
    const Model model = load_model(file);
    save_glb(model, folder / "again.glb");
    CHECK(difference(model, load_model(folder / "again.glb")) < 2e-4);
  }
}

TEST_CASE("Khronos' validator finds no error in saved models") {
  std::string module;
  if (!validator_is_there(module)) {
    MESSAGE(
        "SKIPPED: no node with gltf-validator here (npm install gltf-validator; TWEENFALL_GLTF_VALIDATOR names "
        "its folder)");
    return;
  }
  const ScratchFolder folder("validate");
  save_glb(bar(), folder / "bar.glb");
  for (const auto& file : files_in(models_folder() / "gltf", {".gltf", ".glb"})) {
    const Model model = load_model(file);
    save_glb(model, folder / (file.filename().string() + ".glb"));
  }
  const auto script = folder.file("validate.js", "const validator = require('" + module + R"(');
const fs = require('fs');
(async () => {
  let errors = 0;
  for (const name of fs.readdirSync(process.argv[2]).filter(n => n.endsWith('.glb'))) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2] + '/' + name)));
    for (const m of report.issues.messages.filter(m => m.severity == 0)) {
      console.log(name, m.code, m.pointer, m.message);
      ++errors;
    }
  }
  process.exit(errors ? 1 : 0);
})();
)");
  CHECK(std::system(("node '" + script.string() + "' '" + folder.path().string() + "' 1>&2").c_str()) == 0);
}

TEST_CASE("a model that cannot be written leaves no file and keeps the old one") {
  const ScratchFolder folder("whole");
  const auto file = folder.file("old.glb", "old");
  Model endless = bar();
  endless.clips[0].duration = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(save_glb(endless, file), std::runtime_error);
  CHECK(std::filesystem::file_size(file) == 3);
  CHECK_THROWS_AS(save_glb(bar(), folder / "no such folder" / "bar.glb"), std::runtime_error);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) files += entry.is_regular_file();
  CHECK(files == 1);
}
