#include "stage/rules/drive_tracks.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall::staging {

namespace {

/// Between two frequencies the mix is even in their logarithms. There, softer than the first of these is free and
/// stiffer than the second is keyed, Hz.
constexpr double softest = 0.01, stiffest = 1000;
constexpr double most_hz = 1e9;

double mixed_hz(double from, double to, double weight) {
  if (!(weight > 0) || from == to) return from;
  if (weight >= 1) return to;
  const double low = elementary::log(std::clamp(from, softest, stiffest));
  const double high = elementary::log(std::clamp(to, softest, stiffest));
  const double hz = elementary::exp(low + weight * (high - low));
  return hz <= softest ? 0 : hz >= stiffest ? infinity : hz;
}

/// The drive as the playing clips have it at the state's time, from the body's own on in the order of the plays.
Drive played_drive(const StageState& state, const StagedBody& body, std::span<const DriveTrack> tracks) {
  Drive drive = body.drive;
  const ClockOverride& clock = body.path.clock();
  const std::string& name = (*state.nodes)[body.node].name;
  const bool alone = clock.clip != ClockOverride::every_clip;
  const double time = std::max(0.0, state.handled);
  state.animation->for_each_play(clock, no_node, [&](const Play& play) {
    const auto track = std::ranges::find(tracks, play.clip, &DriveTrack::clip);
    if (track == tracks.end()) return;
    const auto names = [&](const std::string& pattern) { return matches(pattern, name); };
    if (!alone && !play.mask.empty() && std::ranges::none_of(play.mask, names)) return;
    const ClipClock at = clock_at(play, state.animation->clips()[play.clip], time);
    const double hz = track->curve->value(at.time, at.side);
    if (!at.started || std::isnan(hz)) return;
    drive.hz = mixed_hz(drive.hz, hz == infinity ? hz : std::clamp(hz, 0.0, most_hz),
                        play.weight.value(clock.timeline_at(time)));
  });
  return drive;
}

/// Calls `visit(body, drive)` for each body whose drive a track has, with the index of the body.
template <class Visit>
void for_each_driven(const StageState& state, Visit&& visit) {
  const std::span<const DriveTrack> all = *state.drive_tracks;
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && all[last].node == all[first].node) ++last;
    const std::size_t index = state.body_of[all[first].node];
    if (index == no_body || !state.bodies[index].by_track) continue;
    visit(index, played_drive(state, state.bodies[index], all.subspan(first, last - first)));
  }
}

}  // namespace

std::shared_ptr<const std::vector<DriveTrack>> find_drive_tracks(const StageState& state) {
  auto found = std::make_shared<std::vector<DriveTrack>>();
  const std::span<const Clip> clips = state.animation->clips();
  for (std::size_t clip = 0; clip < clips.size(); ++clip)
    for (const Track& track : clips[clip].tracks) {
      if (track.property != "drive_hz") continue;
      const auto node = state.nodes->find(track.node);
      if (!node || !state.present[*node]) continue;
      const auto* curve = std::get_if<Curve<double>>(&track.curve);
      if (!curve)
        throw std::invalid_argument("\"" + track.name() + "\" takes numbers: a frequency in hertz, 0 for free");
      const StagedBody* body = state.body(*node);
      if (!body || state.world.is_fixed(body->id) || !(state.world.mass(body->id).mass > 0))
        throw std::invalid_argument("\"" + track.name() + "\" needs a node with a body that has a mass and can move");
      found->push_back({*node, clip, curve});
    }
  std::ranges::stable_sort(*found, {}, &DriveTrack::node);
  return found;
}

void start_drive_tracks(StageState& state) {
  state.drive_tracks = find_drive_tracks(state);
  for_each_driven(state,
                  [&](std::size_t index, const Drive& drive) { state.world.set_drive(state.bodies[index].id, drive); });
}

void follow_drive_tracks(StageState& state, double step, std::vector<Happening>& happenings) {
  for_each_driven(state, [&](std::size_t index, const Drive& drive) {
    StagedBody& body = state.bodies[index];
    const Drive before = state.world.drive(body.id);
    if (before == drive) return;
    if (before.owner() == drive.owner()) {
      state.world.set_drive(body.id, drive);
      return;
    }
    change_owner(state, index, drive, Cause::at, state.time, {}, {}, step, happenings);
    body.by_track = true;
  });
}

}  // namespace tweenfall::staging
