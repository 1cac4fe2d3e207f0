// Whole glTF files with the values that three.js samples from their animations.

#include "importers/models/model_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

template <class T>
const T* curve_of(const Clip& clip, const std::string& property) {
  for (const Track& track : clip.tracks)
    if (track.property == property) return std::get_if<T>(&track.curve);
  return nullptr;
}

Vec3 vector_of(const nlohmann::json& v) {
  return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

void check_case(const nlohmann::json& one, const ScratchFolder& folder) {
  const auto& gltf = one.contains("gltf") ? one["gltf"] : one["input"]["gltf"];
  const auto file = folder.file("case.gltf", gltf.is_string() ? gltf.get<std::string>() : gltf.dump());
  const Model model = load_model(file);
  REQUIRE(model.clips.size() == 1);
  const auto& times = one["t"];
  const bool linear = one["input"]["interpolation"] == "LINEAR";
  for (const auto& entry : one["value"].items()) {
    const std::string path = entry.key();
    const auto& values = entry.value();
    CAPTURE(path);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double time = times[i].get<double>();
      CAPTURE(time);
      const auto& wanted = values[i];
      if (path == "rotation_xyzw") {
        const auto* curve = curve_of<Curve<Quat>>(model.clips[0], "rotation");
        REQUIRE(curve != nullptr);
        const Quat expected(wanted[3].get<double>(), wanted[0].get<double>(), wanted[1].get<double>(),
                            wanted[2].get<double>());
        // three.js mixes nearly equal quaternions without the sphere's correction.
        CHECK(near(curve->value(time), expected, linear ? 2e-4 : 1e-5));
      } else if (path == "weights") {
        const auto* curves = curve_of<WeightCurves>(model.clips[0], "weights");
        REQUIRE(curves != nullptr);
        REQUIRE(curves->size() == wanted.size());
        for (std::size_t k = 0; k < curves->size(); ++k)
          CHECK(near((*curves)[k].value(time), wanted[k].get<double>(), 1e-5));
      } else {
        const auto* curve = curve_of<Curve<Vec3>>(model.clips[0], path == "translation" ? "position" : path);
        REQUIRE(curve != nullptr);
        CHECK(near(curve->value(time), vector_of(wanted), 1e-5));
      }
    }
  }
}

}  // namespace

TEST_CASE("STEP, LINEAR and CUBICSPLINE animations have the values that three.js samples") {
  const ScratchFolder folder("gltf-vectors");
  for (const auto& file : vector_family("gltf_animation"))
    for (const auto& one : file["cases"]) {
      if (one.value("informative", false)) continue;
      CAPTURE(one["name"].get<std::string>());
      check_case(one, folder);
    }
}
