// tweenfall sample: a clip's tracks, and where its nodes are, at given times.

#include "files/stage_file.h"
#include "motion/clip_sampling.h"
#include "motion/frame_times.h"
#include "report/faults.h"
#include "report/json_text.h"
#include "report/table.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::cli {

namespace {

struct SampleOptions {
  std::string file;
  std::optional<std::string> clip;
  std::vector<double> at;
  std::optional<double> fps, until;
  std::vector<std::string> tracks;
  bool rates = false, world = false, json = false;
};

std::vector<double> times_of(const SampleOptions& options, const Clip& clip) {
  if (!options.at.empty() && options.fps) throw UsageError("use either --at or --fps, not both");
  if (options.at.empty() && !options.fps) throw UsageError("say when: --at 0,0.5,1 or --fps 30");
  if (options.until && !options.fps) throw UsageError("--until needs --fps");
  if (options.world && std::any_of(options.at.begin(), options.at.end(), [](double time) { return time < 0; }))
    throw UsageError("--world has no time before 0");
  if (!options.fps) return options.at;
  const bool counted_loop = clip.loop.mode != LoopMode::once && clip.loop.count > 0;
  const double end = options.until.value_or(clip.duration * (counted_loop ? clip.loop.count : 1));
  if (std::isinf(end)) throw UsageError("clip \"" + clip.name + "\" is endless; say how far with --until");
  require_frames(*options.fps, end);
  return frame_times(end, *options.fps);
}

std::vector<double> matrix(const WorldMotion& world) {
  std::vector<double> numbers;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) numbers.push_back(world.linear(row, column));
    numbers.push_back(0);
  }
  for (int row = 0; row < 3; ++row) numbers.push_back(world.motion.pose.position[row]);
  numbers.push_back(1);
  return numbers;
}

std::string samples_json(const Clip& clip, const std::vector<std::size_t>& tracks, const std::vector<double>& times,
                         bool rates, const Animation* world) {
  std::string out = "{\"clip\": " + json_string(clip.name) + ", \"times\": " + json_array(times) + ",\n \"tracks\": {";
  const char* gap = "\n  ";
  for (const std::size_t index : tracks) {
    const Track& track = clip.tracks[index];
    std::vector<std::string> values, changes;
    for (const double time : times) {
      const TrackSample sample = sample_track(clip, track, time);
      values.push_back(value_json(track.curve, sample));
      if (rates && !sample.rate.empty()) changes.push_back(rate_json(track.curve, sample));
    }
    out += gap + json_string(track.name()) + ": {\"value\": " + json_array(values);
    if (!changes.empty()) out += ", \"rate\": " + json_array(changes);
    out += "}";
    gap = ",\n  ";
  }
  out += "}";
  if (world) {
    std::vector<std::vector<std::string>> matrices(world->nodes().size());
    for (const double time : times) {
      const std::vector<WorldMotion> nodes = sample_world(*world, time);
      for (std::size_t i = 0; i < nodes.size(); ++i) matrices[i].push_back(json_array(matrix(nodes[i])));
    }
    out += ",\n \"world\": {";
    gap = "\n  ";
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      out += gap + json_string(world->nodes()[i].name) + ": " + json_array(matrices[i]);
      gap = ",\n  ";
    }
    out += "}";
  }
  return out + "}\n";
}

std::string numbers_text(const std::vector<double>& numbers) {
  std::string out;
  for (const double number : numbers) out += (out.empty() ? "" : "  ") + brief_text(number);
  return out;
}

std::string value_text(const TrackCurve& curve, const TrackSample& sample) {
  if (std::holds_alternative<StepCurve<std::string>>(curve)) return sample.text;
  if (std::holds_alternative<StepCurve<bool>>(curve)) return sample.value[0] != 0 ? "on" : "off";
  return numbers_text(sample.value);
}

std::string samples_tables(const Clip& clip, const std::vector<std::size_t>& tracks, const std::vector<double>& times,
                           bool rates, const Animation* world) {
  std::string out;
  for (const std::size_t index : tracks) {
    const Track& track = clip.tracks[index];
    std::vector<std::string> head{">time, s", "value"};
    if (rates) head.emplace_back(std::holds_alternative<Curve<Quat>>(track.curve) ? "rate, rad/s" : "rate, 1/s");
    Table table(track.name() + " (" + kind_of(track.curve) + ")", head);
    for (const double time : times) {
      const TrackSample sample = sample_track(clip, track, time);
      table.row({brief_text(time), value_text(track.curve, sample), numbers_text(sample.rate)});
    }
    out += table.text(styled_output());
  }
  if (!world) return out;
  for (std::size_t i = 0; i < world->nodes().size(); ++i) {
    Table table(world->nodes()[i].name + " in the world", {">time, s", "position, m", "rotation x y z w", "scale"});
    for (const double time : times) {
      const Pose pose = world->world(i, time).motion.pose;
      const Quat& q = pose.rotation;
      table.row({brief_text(time), brief_text(pose.position), numbers_text({q.x(), q.y(), q.z(), q.w()}),
                 brief_text(pose.scale)});
    }
    out += table.text(styled_output());
  }
  return out;
}

int sample_file(const SampleOptions& options) {
  const StageFile read = read_stage_file(options.file);
  StageDescription stage = read.stage;
  if (stage.clips.empty() && !options.clip) {
    say(options.file + ": note: there is no clip in it; this is its rest pose");
    stage.clips.emplace_back();
  }
  const std::size_t index = choose_clip(stage, options.clip, options.file);
  const Clip& clip = stage.clips[index];
  const std::vector<std::size_t> tracks = choose_tracks(clip, options.tracks);
  const std::vector<double> times = times_of(options, clip);
  std::optional<Animation> world;
  try {
    if (options.world) world = animation_of(stage, index);
  } catch (const std::invalid_argument& error) {
    throw Faults(faults_of(error, options.file));
  }
  const auto write = options.json ? samples_json : samples_tables;
  print(write(clip, tracks, times, options.rates, world ? &*world : nullptr));
  return 0;
}

Run declare_sample(Arguments& arguments) {
  auto options = std::make_shared<SampleOptions>();
  arguments.file("FILE", options->file, "a document or a model; - is a document on standard input");
  arguments.text("--clip", "NAME", options->clip, "the clip; needed when there are several");
  arguments.numbers("--at", "T,T,...", options->at,
                    "times on the clip's timeline, s; at a jump or a bend, the values just after it");
  arguments.number("--fps", "N", options->fps, "every 1/N s from 0 to the clip's end, both included");
  arguments.number("--until", "T", options->until, "with --fps: to T instead of the clip's end, s");
  arguments.texts("--track", "NAME", options->tracks,
                  "only this track, or those of a pattern like \"arm.*\"; may be repeated");
  arguments.flag("--rates", options->rates, "also rates, per second; for rotations the angular velocity, rad/s");
  arguments.flag("--world", options->world, "also world matrices of the nodes (with --json 16 numbers, column-major)");
  arguments.flag("--json", options->json, "one JSON object for tools");
  return [options] { return sample_file(*options); };
}

}  // namespace

const Verb sample_verb{"sample", "evaluate a clip's tracks, and where its nodes are in the world",
                       "tweenfall sample swing.json --at 0,0.25,0.5 --rates", declare_sample};

}  // namespace tweenfall::cli
