#include "plot/plotted_track.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/anim/player.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/importers/track_sample.h>

#include "plot/track_angles.h"
#include "plot/track_handles.h"
#include "recording/key_lanes.h"
#include "recording/user_numbers.h"
#include "recording/words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tweenfall::plotting {

namespace {

constexpr int points_across = 400;

/// A clip on the plot's axis: by its play when there is a recording, else in clip time.
struct Shown {
  const Clip* clip;
  const Play* play;

  [[nodiscard]] TrackPoint at(const Track& track, double time, Side side) const {
    const ClipClock clock =
        play ? clock_at(*play, *clip, time, side) : ClipClock{.time = time, .rate = 1, .side = side};
    TrackSample sample = sample_track(*clip, track, clock);
    return {time, std::move(sample.value), std::move(sample.rate), false};
  }
};

std::vector<Shown> shown_clips(const StageDescription& stage, bool recorded, const std::string& name) {
  std::vector<Shown> shown;
  std::string names;
  for (const Clip& clip : stage.clips) {
    names += (names.empty() ? "" : ", ") + clip.name;
    const Play* play = nullptr;
    for (const Play& candidate : stage.plays)
      if (!play && candidate.clip < stage.clips.size() && &stage.clips[candidate.clip] == &clip) play = &candidate;
    const bool wanted = name.empty() ? play || stage.clips.size() == 1 : clip.name == name;
    if (wanted) shown.push_back({&clip, recorded ? play : nullptr});
  }
  if (shown.empty() && !name.empty())
    throw std::invalid_argument("there is no clip \"" + name + "\"" + (names.empty() ? "" : "; there are: " + names));
  if (shown.empty() && !names.empty())
    throw std::invalid_argument("no clip plays; say which one to plot, of: " + names);
  return shown;
}

/// Times at which keys are passed, once for each passage.
/// @param lanes of the stage; empty where clips are shown in clip time
std::vector<double> passed_keys(const std::vector<recordings::KeyLane>& lanes, const Shown& shown, const Track& track,
                                double from, double until) {
  std::vector<double> times;
  if (!shown.play) {
    for (const double time : recordings::key_times(track.curve))
      if (time >= from && time <= until) times.push_back(time);
    return times;
  }
  for (const recordings::KeyLane& lane : lanes)
    if (lane.node == track.node && lane.property == track.property) times = lane.times;
  return times;
}

bool jumps(const TrackPoint& in, const TrackPoint& out) {
  for (std::size_t i = 0; i < in.values.size(); ++i)
    if (std::abs(in.values[i] - out.values[i]) > 1e-9 * std::max(1.0, std::abs(in.values[i]))) return true;
  return false;
}

/// What arrives at a time on the plot's axis, or leaves it. A play's clock, as it rounds, may have passed it before or
/// only pass it later.
TrackPoint beside(const Shown& shown, const Track& track, double time, Side side) {
  const double near = shown.play ? 1e-12 * std::max(1.0, std::abs(time)) : 0;
  TrackPoint point = shown.at(track, side == Side::in ? time - near : time + near, side);
  point.time = time;
  return point;
}

/// Stage times at which a play begins, ends or changes its speed: its rates jump there.
std::vector<double> pace_changes(const Shown& shown, double from, double until) {
  std::vector<double> times;
  if (!shown.play) return times;
  const Play& play = *shown.play;
  times = {play.at, end_time(play, *shown.clip)};
  if (const std::optional<Curve<double>> speed = play.speed.curve())
    for (const double own : speed->key_times()) times.push_back(play.at + own);
  std::erase_if(times, [&](double time) { return !(time > from && time < until); });
  return times;
}

/// Stage times at which a looping play restarts, where even a formula jumps.
std::vector<double> seams(const Shown& shown, double from, double until) {
  std::vector<double> times;
  if (!shown.play) return times;
  const Loop loop = shown.play->loop.value_or(shown.clip->loop);
  const double start = shown.play->from, end = shown.play->to.value_or(shown.clip->duration);
  if (loop.mode == LoopMode::once || !(end > start)) return times;
  Clip seam;
  seam.duration = shown.clip->duration;
  seam.loop = shown.clip->loop;
  for (const double time : {start, end}) seam.events.push_back({.from = time, .to = time, .name = {}, .data = {}});
  Player(*shown.play, *shown.clip).visit_events(seam, from, until, false, [&](FiredEvent&& event) {
    const bool inside = event.time < until;
    if (inside && event.time > shown.play->at && (times.empty() || times.back() != event.time))
      times.push_back(event.time);
    return inside && times.size() < 1000;
  });
  return times;
}

template <class T>
void widen(std::pair<double, double>& stretch, const Curve<T>& curve) {
  if (!(curve.start() < curve.end()) || std::isinf(curve.start()) || std::isinf(curve.end())) return;
  stretch = {std::min(stretch.first, curve.start()), std::max(stretch.second, curve.end())};
}
void widen(std::pair<double, double>& stretch, const WeightCurves& curves) {
  for (const Curve<double>& curve : curves) widen(stretch, curve);
}
template <class T>
void widen(std::pair<double, double>&, const StepCurve<T>&) {}

/// The start and end of the keyed part; empty for constants, switches and endless curves.
std::optional<std::pair<double, double>> keyed_stretch(const TrackCurve& curve) {
  std::pair<double, double> stretch(HUGE_VAL, -HUGE_VAL);
  std::visit([&](const auto& held) { widen(stretch, held); }, curve);
  return stretch.first < stretch.second ? std::optional(stretch) : std::nullopt;
}

/// Whether a track still moves just beyond its end.
bool moves_beyond(const Clip& clip, const Track& track, double end, double step) {
  const Shown shown{&clip, nullptr};
  const TrackPoint rest = shown.at(track, end + step / 2, Side::out);
  for (int i = 1; i <= 3; ++i) {
    const TrackPoint point = shown.at(track, end + step * i, Side::out);
    if (point.values != rest.values && !point.rates.empty()) return true;
  }
  return false;
}

/// The times beyond its keys at which a repeating curve may jump.
std::vector<double> turns_beyond(const Shown& shown, const Track& track, double from, double until) {
  std::vector<double> times;
  const auto keyed = keyed_stretch(track.curve);
  if (!keyed || shown.play) return times;
  const auto [first, last] = *keyed;
  const double length = last - first;
  for (double time = last; time < until && times.size() < 200; time += length) times.push_back(time);
  for (double time = first; time > from && times.size() < 400; time -= length) times.push_back(time);
  return times;
}

void add_handles(PlottedTrack& plotted, const Shown& shown) {
  const std::vector<TrackHandle> handles = track_handles(plotted.track->curve);
  for (PlottedKey& key : plotted.keys) {
    for (const Side side : {Side::in, Side::out}) {
      double clip_time = key.time, pace = 1;
      if (shown.play) {
        const ClipClock clock = clock_at(*shown.play, *shown.clip, key.time, side);
        clip_time = clock.time;
        pace = clock.rate;
      }
      if (pace == 0) continue;
      const bool arrives = (side == Side::in) == (pace > 0);
      const double near = 1e-9 * std::max(1.0, std::abs(clip_time));
      auto handle = std::lower_bound(handles.begin(), handles.end(), clip_time - near,
                                     [](const TrackHandle& h, double time) { return h.key < time; });
      for (; handle != handles.end() && handle->key <= clip_time + near; ++handle)
        for (std::size_t i = 0; handle->arrives == arrives && i < handle->time.size(); ++i)
          key.handles.push_back({i, handle->time[i] / pace, handle->change[i]});
    }
  }
}

/// Sets names of the components, and units; for a rotation these depend on its axis.
void name_parts(PlottedTrack& plotted) {
  plotted.names = component_names(plotted.track->curve);
  plotted.rate_names = rate_names(plotted.track->curve);
  const std::optional<Component> component = component_named(plotted.track->property);
  if (component)
    plotted.names = plotted.rate_names = {plotted.track->property.substr(plotted.track->property.size() - 1)};
  switch (component ? component->property : property_named(plotted.track->property)) {
    case Property::rotation:
      if (component) turn_into_degrees(plotted);
      break;
    case Property::position:
      plotted.unit = "m";
      plotted.rate_unit = "m/s";
      break;
    case Property::color:
      plotted.unit = "linear light";
      break;
    case Property::scale:
      plotted.unit = "factors";
      break;
    default:
      break;
  }
  if (std::holds_alternative<Curve<Quat>>(plotted.track->curve)) turn_into_angles(plotted);
}

void add_curve(PlottedTrack& plotted, const Shown& shown, const std::vector<double>& keys, double from, double until) {
  std::vector<double> corners = seams(shown, from, until);
  const std::vector<double> turns = turns_beyond(shown, *plotted.track, from, until);
  corners.insert(corners.end(), turns.begin(), turns.end());
  const std::vector<double> paces = pace_changes(shown, from, until);
  corners.insert(corners.end(), paces.begin(), paces.end());
  corners.insert(corners.end(), keys.begin(), keys.end());
  std::sort(corners.begin(), corners.end());
  std::vector<double> times = corners;
  for (int i = 0; i <= points_across; ++i) times.push_back(from + (until - from) * i / points_across);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const double time : times) {
    const bool corner = std::binary_search(corners.begin(), corners.end(), time) && time > from;
    if (corner) plotted.curve.push_back(beside(shown, *plotted.track, time, Side::in));
    // At the very end only the arriving value is shown.
    if (corner && time == until) continue;
    plotted.curve.push_back(corner ? beside(shown, *plotted.track, time, Side::out)
                                   : shown.at(*plotted.track, time, time == until ? Side::in : Side::out));
    if (corner) plotted.curve.back().starts = jumps(plotted.curve[plotted.curve.size() - 2], plotted.curve.back());
  }
  if (plotted.curve.front().values.size() > 16) return;  // so many keys would hide the curves
  for (const double time : keys)
    plotted.keys.push_back({time, shown.at(*plotted.track, time, Side::in), shown.at(*plotted.track, time, Side::out),
                            time == keys.front(), time == keys.back()});
  add_handles(plotted, shown);
  if (const auto keyed = keyed_stretch(plotted.track->curve); keyed && !shown.play)
    std::tie(plotted.first_key, plotted.last_key) = *keyed;
}

/// Numbers too large for an axis become NaN, which is not drawn.
void leave_out_unplottable(PlottedTrack& plotted) {
  const auto leave_out = [&](std::vector<double>& numbers, bool& some) {
    for (double& number : numbers)
      if (!(std::abs(number) <= largest_plotted)) {
        number = std::numeric_limits<double>::quiet_NaN();
        some = true;
      }
  };
  const auto leave_out_of = [&](TrackPoint& point) {
    leave_out(point.values, plotted.lacks_values);
    leave_out(point.rates, plotted.lacks_rates);
  };
  for (TrackPoint& point : plotted.curve) leave_out_of(point);
  for (PlottedKey& key : plotted.keys) {
    leave_out_of(key.in);
    leave_out_of(key.out);
  }
  for (std::vector<TrackPoint>& points : plotted.simulated)
    for (TrackPoint& point : points) leave_out_of(point);
}

bool is_below(const Recording& recording, std::size_t node, const std::string& name) {
  for (; node != no_node; node = recording.nodes[node].parent)
    if (recording.nodes[node].name == name) return true;
  return false;
}

void add_recorded(PlottedTrack& plotted, const Recording& recording) {
  for (const HandOff& handoff : recording.handoffs)
    if (handoff.cause != Cause::start && is_below(recording, handoff.node, plotted.track->node))
      plotted.moments.push_back(
          {handoff.time, recording.nodes[handoff.node].name + " " + owner_word(handoff.to), true});
  const auto found = std::find_if(recording.nodes.begin(), recording.nodes.end(),
                                  [&](const NodeRecord& node) { return node.name == plotted.track->node; });
  if (found == recording.nodes.end()) return;
  const auto node = static_cast<std::size_t>(found - recording.nodes.begin());
  // Once it has left its script, its motion may differ from the script even when keyed: it settles, or starts over.
  bool has_left = false;
  for (std::size_t first = 0; first < found->owner.size();) {
    std::size_t last = first;
    while (last + 1 < found->owner.size() && found->owner[last + 1] == found->owner[first]) ++last;
    has_left = has_left || found->owner[first] != Owner::keyed;
    if (has_left) {
      std::vector<TrackPoint> points = recorded_track(recording, node, plotted.track->property, first, last);
      if (!points.empty()) plotted.simulated.push_back(std::move(points));
    }
    first = last + 1;
  }
}

/// A user track as plays and graphs mix it, where they do.
void add_mixed(PlottedTrack& plotted, const StageDescription& stage, const Recording& recording) {
  if (stage.graphs.empty() && stage.plays.size() < 2) return;
  const auto found = std::ranges::find(recording.user_tracks, plotted.track->name(), &UserTrackRecord::name);
  if (found == recording.user_tracks.end() || recordings::number_names(*found).size() != plotted.names.size()) return;
  const std::size_t width = plotted.names.size();
  std::vector<TrackPoint> points;
  for (std::size_t frame = 0; frame < found->value.size(); ++frame)
    points.push_back({recording.times[frame], recordings::numbers_at(*found, frame, width),
                      recordings::rates_at(*found, frame, width)});
  if (!points.empty()) plotted.simulated.push_back(std::move(points));
}

void add_events(PlottedTrack& plotted, const Shown& shown, const Recording* recording) {
  if (!recording) {
    for (const ClipEvent& event : shown.clip->events) plotted.moments.push_back({event.from, event.name, false});
    return;
  }
  for (const StageEvent& event : recording->events) {
    const bool ours = event.nodes.empty() || std::any_of(event.nodes.begin(), event.nodes.end(), [&](NodeId node) {
                        return recording->nodes[node].name == plotted.track->node;
                      });
    if (ours) plotted.moments.push_back({event.time, event.name, false});
  }
}

}  // namespace

PlottedStage plotted_tracks(const StageDescription& stage, const Recording* recording, const PlotOptions& options) {
  if (recording) check_recording(*recording);
  PlottedStage result;
  const std::vector<Shown> clips = shown_clips(stage, recording != nullptr, options.clip);
  if (recording && !recording->times.empty()) {
    result.from = recording->times.front();
    result.until = recording->times.back();
  } else {
    result.until = 0;
    for (const Shown& shown : clips)
      if (std::isfinite(shown.clip->duration)) result.until = std::max(result.until, shown.clip->duration);
  }
  // A formula has no end, a single moment no length: show ten seconds, or one.
  if (!(result.until > result.from)) result.until = result.from + (recording ? 1 : 10);
  // A time too short to distinguish points within it is lengthened a little.
  constexpr double shortest = 1e-100, finest = 1e-12;
  result.until =
      std::max(result.until, result.from + std::max(shortest, finest * std::max(std::abs(result.from), result.until)));
  const auto is_wanted = [&](const Track& track) {
    return options.tracks.empty() ||
           std::find(options.tracks.begin(), options.tracks.end(), track.name()) != options.tracks.end();
  };
  const double clip_end = result.until;
  if (!recording) {
    const double length = clip_end;
    for (const Shown& shown : clips)
      for (const Track& track : shown.clip->tracks) {
        const auto keyed = keyed_stretch(track.curve);
        if (!keyed || !is_wanted(track)) continue;
        if (keyed->second > 0.75 * length && moves_beyond(*shown.clip, track, keyed->second, length / 17))
          result.until = std::max(result.until, length * 1.5);
        if (keyed->first < 0.25 * length && moves_beyond(*shown.clip, track, keyed->first, -length / 17))
          result.from = std::min(result.from, -length / 4);
      }
  }

  const std::vector<recordings::KeyLane> lanes =
      recording ? recordings::key_lanes(stage, result.from, result.until) : std::vector<recordings::KeyLane>();
  std::vector<std::string> missing = options.tracks;
  std::string names;
  for (const Shown& shown : clips) {
    for (const Track& track : shown.clip->tracks) {
      names += (names.empty() ? "" : ", ") + track.name();
      if (!is_wanted(track)) continue;
      missing.erase(std::remove(missing.begin(), missing.end(), track.name()), missing.end());
      if (options.tracks.empty() && result.tracks.size() >= options.most) {
        ++result.left_out;
        continue;
      }
      PlottedTrack plotted;
      plotted.track = &track;
      plotted.title = track.name() + (clips.size() > 1 ? " in " + shown.clip->name : "");
      // Curves without keys are not shown outside the time of their clip.
      const bool is_cut = !recording && !keyed_stretch(track.curve);
      const double from = is_cut ? 0 : result.from, until = is_cut ? clip_end : result.until;
      add_curve(plotted, shown, passed_keys(lanes, shown, track, from, until), from, until);
      if (is_cut) std::tie(plotted.first_key, plotted.last_key) = std::pair(from, until);
      add_events(plotted, shown, recording);
      if (recording) add_recorded(plotted, *recording);
      name_parts(plotted);
      if (recording) add_mixed(plotted, stage, *recording);
      leave_out_unplottable(plotted);
      result.tracks.push_back(std::move(plotted));
    }
  }
  if (!missing.empty())
    throw std::invalid_argument("there is no track \"" + missing.front() + "\"" +
                                (names.empty() ? "" : "; there are: " + names));
  return result;
}

}  // namespace tweenfall::plotting
