#include "stage/rules/played_tracks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stage/rules/ramps.h"
#include "state/countable.h"

namespace tweenfall::staging {

namespace {

constexpr double most_hz = 1e9;

double mixed_hz(double from, double to, double weight) {
  if (!(weight > 0) || from == to) return from;
  if (weight >= 1) return to;
  const double hz = hz_between(from, to, weight);
  return hz <= softest_hz ? 0 : hz >= stiffest_hz ? infinity : hz;
}

/// Calls `visit(value, weight)` with what each playing clip has for the body at the state's time, in the order of the
/// plays.
template <class T, class Visit>
void for_each_played(const StageState& state, const StagedBody& body, std::span<const PlayedTrack<T>> tracks,
                     const Visit& visit) {
  const ClockOverride& clock = body.path.clock();
  const std::string& name = (*state.nodes)[body.node].name;
  const bool alone = clock.clip != ClockOverride::every_clip;
  const double time = std::max(0.0, state.handled);
  state.animation->for_each_play(clock, no_node, [&](const RunningPlay& running) {
    if (!alone && !running.shows(time)) return;
    const Play& play = running.play();
    const auto track = std::ranges::find(tracks, play.clip, &PlayedTrack<T>::clip);
    if (track == tracks.end()) return;
    const auto names = [&](const std::string& pattern) { return matches(pattern, name); };
    if (!alone && !play.mask.empty() && std::ranges::none_of(play.mask, names)) return;
    const ClipClock at = running.clock(time);
    if (at.started || fills_before(play.fill)) visit(track->curve->value(at.time, at.side), running.weight(time).value);
  });
}

/// Calls `visit(body, tracks)` for each body that has tracks, with the index of the body.
template <class T, class Visit>
void for_each_tracked(const StageState& state, std::span<const PlayedTrack<T>> all, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && all[last].node == all[first].node) ++last;
    const std::size_t index = state.body_of[all[first].node];
    if (index != no_body) visit(index, all.subspan(first, last - first));
  }
}

/// The drive that the playing clips give at the state's time, mixed over the body's own.
Drive played_drive(const StageState& state, const StagedBody& body, std::span<const PlayedTrack<double>> tracks) {
  Drive drive = body.drive;
  for_each_played(state, body, tracks, [&](double hz, double weight) {
    if (!std::isnan(hz)) drive.hz = mixed_hz(drive.hz, hz == infinity ? hz : std::clamp(hz, 0.0, most_hz), weight);
  });
  return drive;
}

/// Calls `visit(body, drive)` for each body whose drive has a track.
template <class Visit>
void for_each_driven(const StageState& state, const Visit& visit) {
  for_each_tracked<double>(state, state.tracks->drives,
                           [&](std::size_t index, std::span<const PlayedTrack<double>> tracks) {
                             if (state.bodies[index].by_track)
                               visit(index, played_drive(state, state.bodies[index], tracks));
                           });
}

void follow_surface_tracks(StageState& state) {
  for_each_tracked<Vec3>(state, state.tracks->surfaces,
                         [&](std::size_t index, std::span<const PlayedTrack<Vec3>> tracks) {
                           const StagedBody& body = state.bodies[index];
                           const Twist before = state.world.surface_velocity(body.id);
                           Vec3 velocity = body.surface;
                           for_each_played(state, body, tracks, [&](const Vec3& played, double weight) {
                             if (state::countable(played))
                               velocity = weight >= 1 ? played : Vec3(velocity + weight * (played - velocity));
                           });
                           if (velocity != before.linear)
                             state.world.set_surface_velocity(body.id, {velocity, before.angular});
                         });
}

/// The tracks of a property among all clips, in order of their nodes.
/// @param checked  called with track and body, null for none; throws if the property does not apply
template <class T, class Check>
std::vector<PlayedTrack<T>> tracks_of(const StageState& state, const char* property, const char* kind,
                                      const Check& checked) {
  std::vector<PlayedTrack<T>> found;
  const std::span<const Clip> clips = state.animation->clips();
  for (std::size_t clip = 0; clip < clips.size(); ++clip)
    for (const Track& track : clips[clip].tracks) {
      if (track.property != property) continue;
      const auto node = state.nodes->find(track.node);
      if (!node || !state.present[*node]) continue;
      const auto* curve = std::get_if<Curve<T>>(&track.curve);
      if (!curve) throw std::invalid_argument("\"" + track.name() + "\" takes " + kind);
      checked(track, state.body(*node));
      found.push_back({*node, clip, curve});
    }
  std::ranges::stable_sort(found, {}, &PlayedTrack<T>::node);
  return found;
}

}  // namespace

bool drives_a_body(std::string_view track) {
  return track.ends_with(".drive_hz") || track.ends_with(".surface_velocity");
}

void start_played_tracks(StageState& state) {
  auto tracks = std::make_shared<PlayedTracks>();
  tracks->drives = tracks_of<double>(
      state, "drive_hz", "numbers: a frequency in hertz, 0 for free", [&](const Track& track, const StagedBody* body) {
        if (!body || state.world.is_fixed(body->id) || !(state.world.mass(body->id).mass > 0))
          throw std::invalid_argument("\"" + track.name() + "\" needs a node with a body that has a mass and can move");
      });
  tracks->surfaces =
      tracks_of<Vec3>(state, "surface_velocity", "vectors: m/s against the body, in the node's axes",
                      [&](const Track& track, const StagedBody* body) {
                        if (!body) throw std::invalid_argument("\"" + track.name() + "\" needs a node with a body");
                      });
  state.tracks = std::move(tracks);
  for_each_driven(state,
                  [&](std::size_t index, const Drive& drive) { state.world.set_drive(state.bodies[index].id, drive); });
  follow_surface_tracks(state);
}

void follow_played_tracks(StageState& state, double step, std::vector<Happening>& happenings) {
  for_each_driven(state, [&](std::size_t index, const Drive& drive) {
    StagedBody& body = state.bodies[index];
    const Drive before = state.world.drive(body.id);
    if (before == drive) return;
    if (before.owner() == drive.owner()) {
      state.world.set_drive(body.id, drive);
      return;
    }
    static_cast<void>(change_owner(state, index, {.to = drive}, Cause::at, state.time, step, happenings));
    body.by_track = true;
  });
  follow_surface_tracks(state);
}

}  // namespace tweenfall::staging
