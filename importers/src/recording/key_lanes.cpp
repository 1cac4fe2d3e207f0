#include "recording/key_lanes.h"

#include <tweenfall/anim/player.h>

#include "recording/key_words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

namespace tweenfall::recordings {

namespace {

constexpr std::size_t most_keys = 20000;

template <class T>
std::vector<double> times_of(const Curve<T>& curve) {
  const std::span<const double> keys = curve.key_times();
  return {keys.begin(), keys.end()};
}

template <class T>
std::vector<double> times_of(const StepCurve<T>& curve) {
  std::vector<double> times;
  for (const auto& step : curve.steps()) times.push_back(step.first);
  return times;
}

std::vector<double> times_of(const WeightCurves& curves) {
  std::vector<double> times;
  for (const Curve<double>& curve : curves) {
    const std::vector<double> keys = times_of(curve);
    times.insert(times.end(), keys.begin(), keys.end());
  }
  return times;
}

void sort_and_unite(std::vector<double>& times) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

bool drives(const Play& play, const std::string& node) {
  return play.mask.empty() || std::any_of(play.mask.begin(), play.mask.end(),
                                          [&](const std::string& pattern) { return matches(pattern, node); });
}

/// A key passed: its time, and its index among the lane's keys.
struct Pass {
  double time;
  std::uint32_t key;
};

/// Whether the whole clip is played with its own loop, at one speed.
bool is_plain(const Play& play) {
  return play.speed.is_constant() && play.from == 0 && !play.to && play.offset == 0 && !play.reverse && !play.loop;
}

/// The same for any play, with keys as events of the clip.
bool add_met_passes(const Play& play, const Clip& clip, const std::vector<double>& keys, std::uint32_t first_key,
                    double from, double until, std::vector<Pass>& out) {
  Clip of_keys;
  of_keys.duration = clip.duration;
  of_keys.loop = clip.loop;
  of_keys.events.reserve(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    of_keys.events.push_back({.from = keys[i], .to = keys[i], .name = std::to_string(i), .data = {}});
  bool is_cut = false;
  Player(play, clip).visit_events(of_keys, from, until, true, [&](FiredEvent&& event) {
    is_cut = out.size() >= most_keys;
    if (!is_cut) out.push_back({event.time, first_key + static_cast<std::uint32_t>(std::stoul(event.name))});
    return !is_cut;
  });
  return is_cut;
}

/// Adds the stage times at which `play` passes the clip times `keys`, which are numbered from `first_key` on.
/// @return whether some rounds were left out, because there are too many
bool add_passes(const Play& play, const Clip& clip, const std::vector<double>& keys, std::uint32_t first_key,
                double from, double until, std::vector<Pass>& out) {
  if (!is_plain(play)) return add_met_passes(play, clip, keys, first_key, from, until, out);
  const double pace = play.speed.at(0), speed = std::abs(pace), length = clip.duration;
  const auto outside = [&](double key) { return key < 0 || (std::isfinite(length) && key > length); };
  const auto inside = keys.size() - static_cast<std::size_t>(std::count_if(keys.begin(), keys.end(), outside));
  if (inside == 0 || speed == 0) return false;
  const bool cycles = clip.loop.mode != LoopMode::once && std::isfinite(length) && length > 0;
  const double plays = !cycles ? 1 : clip.loop.count > 0 ? clip.loop.count : HUGE_VAL;
  // The first and the last round that are partly visible.
  const double around = cycles ? length / speed : 0;
  const double first = cycles ? std::max(0.0, std::floor((from - play.at) / around) - 1) : 0;
  const double last = cycles ? std::min(std::ceil(plays) - 1, std::floor((until - play.at) / around) + 1) : 0;
  const double room = std::max(1.0, std::floor(most_keys / static_cast<double>(inside)));
  const double stride = std::max(1.0, std::ceil((last - first + 1) / room));
  for (double cycle = first; cycle <= last; cycle += stride) {
    const bool odd = std::fmod(cycle, 2) == 1;
    const bool backwards = (pace < 0) != (clip.loop.mode == LoopMode::pingpong && odd);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (outside(keys[i])) continue;
      const double passed =
          (cycles ? cycle * length : 0) + (backwards && std::isfinite(length) ? length - keys[i] : keys[i]);
      if (cycles && passed > plays * length) continue;
      const double time = play.at + passed / speed;
      if (time >= from && time <= until && out.size() < most_keys)
        out.push_back({time, first_key + static_cast<std::uint32_t>(i)});
    }
    if (!(cycle + stride > cycle)) break;
  }
  return stride > 1;
}

}  // namespace

std::vector<double> key_times(const TrackCurve& curve) {
  std::vector<double> times = std::visit([](const auto& held) { return times_of(held); }, curve);
  sort_and_unite(times);
  return times;
}

std::vector<KeyLane> key_lanes(const StageDescription& stage, double from, double until) {
  std::vector<KeyLane> lanes;
  std::vector<std::vector<Pass>> passes;
  std::map<std::string, std::size_t> lane_of;
  for (const Play& play : stage.plays) {
    if (play.clip >= stage.clips.size()) continue;
    const Clip& clip = stage.clips[play.clip];
    for (const Track& track : clip.tracks) {
      if (!drives(play, track.node)) continue;
      const auto [place, is_new] = lane_of.try_emplace(track.name(), lanes.size());
      if (is_new) {
        lanes.push_back({.node = track.node,
                         .property = track.property,
                         .times = {},
                         .key_of = {},
                         .keys = {},
                         .is_thinned = false});
        passes.emplace_back();
      }
      KeyLane& lane = lanes[place->second];
      std::vector<double> keys = key_times(track.curve);
      if (keys.size() > most_keys) keys.resize(most_keys);
      if (add_passes(play, clip, keys, static_cast<std::uint32_t>(lane.keys.size()), from, until,
                     passes[place->second]))
        lane.is_thinned = true;
      const std::vector<std::string> eases = key_ease_texts(track, keys);
      for (std::size_t k = 0; k < keys.size(); ++k) lane.keys.push_back({key_value_text(track, keys[k]), eases[k]});
    }
  }
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    // Where two rounds meet, the first key of the later one counts.
    std::stable_sort(passes[i].begin(), passes[i].end(), [](const Pass& a, const Pass& b) { return a.time < b.time; });
    for (const Pass& pass : passes[i]) {
      const bool again = !lanes[i].times.empty() && lanes[i].times.back() == pass.time;
      if (!again) {
        lanes[i].times.push_back(pass.time);
        lanes[i].key_of.push_back(pass.key);
      } else {
        lanes[i].key_of.back() = pass.key;
      }
    }
  }
  return lanes;
}

}  // namespace tweenfall::recordings
