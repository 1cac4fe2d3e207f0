// Layers as other programs blend them: numbers of Blender's and of three.js.

#include <tweenfall/anim/blend.h>
#include <tweenfall/curves/keys.h>

#include "anim/moving_pose.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;
using nlohmann::json;

namespace {

double along(const json& keys, double t) {
  if (t <= keys.front()[0].get<double>()) return keys.front()[1].get<double>();
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const double from = keys[i - 1][0].get<double>(), to = keys[i][0].get<double>();
    if (t > to) continue;
    const double u = (t - from) / (to - from), a = keys[i - 1][1].get<double>();
    return a + u * (keys[i][1].get<double>() - a);
  }
  return keys.back()[1].get<double>();
}

// A strip's place in its action, or empty if it does not act; `doubtful` at the seam of a repeat.
struct StripTime {
  bool acts = false, doubtful = false;
  double action = 0, influence = 1;
};

StripTime strip_time(const json& strip, double t) {
  const double start = strip["frame_start"], end = strip["frame_end"], from = strip["action_frame_start"],
               length = strip["action_frame_end"].get<double>() - from;
  const std::string outside = strip["extrapolation"];
  StripTime result;
  result.acts = (t >= start || outside == "HOLD") && (t <= end || outside != "NOTHING");
  const double within = std::clamp(t, start, end), run = (within - start) / strip["scale"].get<double>();
  double local = std::fmod(run, length);
  result.doubtful = run > 1e-4 && std::abs(std::remainder(run, length)) < 1e-4;
  if (result.doubtful && within == end) {  // a whole number of repeats ends at its end
    local = length;
    result.doubtful = false;
  }
  result.action = from + (strip["use_reverse"].get<bool>() ? length - local : local);
  const double blend_in = strip["blend_in"], blend_out = strip["blend_out"];
  if (strip.contains("influence"))
    result.influence = along(strip["influence"], within);
  else if (blend_in > 0 && within < start + blend_in)
    result.influence = (within - start) / blend_in;
  else if (blend_out > 0 && within > end - blend_out)
    result.influence = (end - within) / blend_out;
  return result;
}

// The effect of an action on a motion: on the channels that it has.
void act(const json& action, double t, Motion& motion) {
  for (const auto& [property, channels] : action.items())
    for (const auto& [index, keys] : channels.items()) {
      const int i = std::stoi(index);
      const double value = along(keys, t);
      if (property == "location") motion.pose.position[i] = value;
      if (property == "scale") motion.pose.scale[i] = value;
      if (property == "rotation_quaternion") motion.pose.rotation.coeffs()[(i + 3) % 4] = value;
    }
  motion.pose.rotation.normalize();
}

Motion times_by_number(const Motion& a, const Motion& b, const json& action) {
  Motion result = a;
  if (action.contains("location")) result.pose.position = a.pose.position.cwiseProduct(b.pose.position);
  if (action.contains("scale")) result.pose.scale = a.pose.scale.cwiseProduct(b.pose.scale);
  return result;
}

// A clip of three.js, sampled as it does, linearly and along shortest arcs.
Motion mixed_clip(const json& clip, double time, Motion motion) {
  for (const json& track : clip["tracks"]) {
    const json &times = track["times"], &values = track["values"];
    const bool turns = track["type"] == "quaternion";
    std::vector<Key<Vec3>> places;
    std::vector<Key<Quat>> rotations;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (turns)
        rotations.push_back({times[i], quat(values, 4 * i).normalized(), Ease::linear()});
      else
        places.push_back({times[i], Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]), Ease::linear()});
    }
    if (turns)
      motion.pose.rotation = keyed_curve<Quat>(rotations).sample(time).value;
    else
      motion.pose.position = keyed_curve<Vec3>(places).sample(time).value;
  }
  return motion;
}

}  // namespace

TEST_CASE("layers of whole poses are Blender's strips: replaced, added, subtracted, multiplied and combined") {
  int checked = 0, rotations = 0;
  for (const json& family : vector_family("blender_nla"))
    for (const json& one : family["cases"]) {
      CAPTURE(one["name"].get<std::string>());
      for (std::size_t k = 0; k < one["t"].size(); ++k) {
        const double t = one["t"][k];
        CAPTURE(t);
        Motion shown;
        bool comparable = true, turns_comparable = true;
        for (const json& strip : one["input"]["strips"]) {
          const StripTime at = strip_time(strip, t);
          comparable &= !at.doubtful;
          if (!at.acts) continue;
          const json& action = one["input"]["actions"][strip["action"].get<std::size_t>()];
          const std::string blend_type = strip["blend_type"];
          const bool replaces = blend_type == "REPLACE" || blend_type == "MULTIPLY";
          Motion own = replaces ? shown : Motion{};
          act(action, at.action, own);
          // Blender treats components of quaternions as numbers, and goes the long way if w is below 0.
          const bool whole = at.influence == 0 || at.influence == 1;
          if (action.contains("rotation_quaternion") && !whole)
            turns_comparable &= blend_type == "COMBINE" && own.pose.rotation.w() >= 0;
          const Sample<double> weight{blend_type == "SUBTRACT" ? -at.influence : at.influence, 0, 0};
          if (blend_type == "MULTIPLY") own = times_by_number(shown, own, action);
          const Motion below[]{shown}, above[]{own}, none[]{Motion{}};
          Motion out[1], apart[1];
          if (replaces) {
            cross_fade(below, above, weight, out);
          } else {
            difference(none, above, apart);
            add(below, apart, weight, out);
          }
          shown = out[0];
        }
        if (!comparable) continue;
        ++checked;
        const json& value = one["value"];
        if (value.contains("location")) CHECK(near(shown.pose.position, vec(value["location"][k]), 3e-5));
        if (value.contains("scale")) CHECK(near(shown.pose.scale, vec(value["scale"][k]), 3e-5));
        if (value.contains("rotation_quaternion_wxyz") && turns_comparable) {
          const json& q = value["rotation_quaternion_wxyz"][k];
          Quat expected(q[0], q[1], q[2], q[3]);
          expected.normalize();
          CHECK(near(shown.pose.rotation, expected, 3e-5));
          ++rotations;
        }
      }
    }
  CHECK(checked > 50);
  CHECK(rotations > 5);
}

TEST_CASE("a blend whose weights are shares of the whole is that of three.js's mixer, differences added after") {
  int checked = 0, rotations = 0;
  for (const json& family : vector_family("three_mixer"))
    for (const json& one : family["cases"]) {
      CAPTURE(one["name"].get<std::string>());
      const json& input = one["input"];
      // The time reported for an action runs forward; on each way back of a ping-pong another is sampled.
      std::vector<char> turns_back(input["clips"].size());
      for (const json& op : input["ops"])
        if (op.size() > 3 && op[2] == "loop" && op[3] == "pingpong") turns_back[op[1].get<std::size_t>()] = 1;
      std::vector<double> told(turns_back.size());
      std::vector<int> rounds(turns_back.size());
      Motion original;
      original.pose.position = vec(input["original"]["position"]);
      original.pose.rotation = quat(input["original"]["quaternion"]);
      for (const json& value : one["value"]) {
        std::vector<Motion> motions;
        std::vector<PoseLayer> layers;
        motions.reserve(input["clips"].size());
        double sum = 0;
        Motion apart;
        Sample<double> added{0, 0, 0};
        bool ends = false;
        for (std::size_t i = 0; i < input["clips"].size(); ++i) {
          const json& clip = input["clips"][i];
          const Sample<double> weight{value["weight"][i], 0, 0};
          const double time = value["time"][i], duration = clip["duration"];
          if (time < told[i]) ++rounds[i];
          ends = ends || (turns_back[i] && time > told[i] && time > duration - 1e-6);
          told[i] = time;
          const bool back = turns_back[i] && rounds[i] % 2 == 1;
          const Motion motion = mixed_clip(clip, back ? duration - time : time, original);
          if (clip.contains("blendMode")) {
            apart = difference(mixed_clip(clip, 0, original), motion);
            added = weight;
            continue;
          }
          motions.push_back(motion);
          layers.push_back({std::span<const Motion>(&motions.back(), 1), weight});
          sum += weight.value;
        }
        // On the step on which a ping-pong ends, three.js samples the way that would come next, and on the one after
        // does not.
        if (ends) continue;
        const Motion rest[]{original};
        Motion out[1];
        blend(layers, rest, out, 1);
        out[0] = add(out[0], apart, added);
        ++checked;
        CHECK(near(out[0].pose.position, vec(value["position"]), 2e-5));
        // Rotations, which three.js blends one after the other, in some order.
        Motion folded = original;
        double so_far = 0;
        for (std::size_t i = 0; i < layers.size(); ++i) {
          const double weight = layers[i].weight.value;
          so_far += weight;
          if (weight > 0) folded = mix(folded, motions[i], weight / so_far, 0);
        }
        if (sum < 1) folded = mix(original, folded, sum, 0);
        folded = add(folded, apart, added);
        const Quat expected = quat(value["quaternion_xyzw"]).normalized();
        CHECK(near(folded.pose.rotation, expected, 3e-4));
        // With two of them it makes no difference.
        const auto counting =
            std::ranges::count_if(layers, [](const PoseLayer& layer) { return layer.weight.value > 0; });
        if (counting + (sum < 1 ? 1 : 0) > 2) continue;
        ++rotations;
        CHECK(near(out[0].pose.rotation, expected, 3e-4));
      }
    }
  CHECK(checked > 40);
  CHECK(rotations > 30);
}
