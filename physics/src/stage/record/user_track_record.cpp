#include "stage/record/user_track_record.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "stage/rules/played_tracks.h"

namespace tweenfall::staging {
namespace {

double bytes_of(const UserValue& value) {
  std::size_t apart = 0;
  if (const auto* text = std::get_if<std::string>(&value)) apart = text->size();
  if (const auto* weights = std::get_if<std::vector<Sample<double>>>(&value))
    apart = weights->size() * sizeof(Sample<double>);
  return static_cast<double>(sizeof(UserValue) + apart);
}

}  // namespace

UserTrackRecorder::UserTrackRecorder(const Stage& stage) {
  std::set<std::string> known;
  for (const Clip& clip : stage.description().clips)
    for (const Track& track : clip.tracks)
      if (property_named(track.property) == Property::user && !component_named(track.property) &&
          !drives_a_body(track.name()) && known.insert(track.name()).second) {
        tracks_.push_back({.name = track.name(), .value = {}});
        at_first_.push_back(stage.user_value(tracks_.back().name));
      }
  is_played_.resize(tracks_.size());
}

void UserTrackRecorder::find_played(const Stage& stage) {
  if (std::ranges::find(is_played_, 0) == is_played_.end()) return;
  const std::vector<std::string> names = stage.user_tracks();
  const std::set<std::string_view> played(names.begin(), names.end());
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (played.contains(tracks_[i].name)) is_played_[i] = 1;
}

void UserTrackRecorder::push(std::size_t track, UserValue value, double& room) {
  room -= bytes_of(value);
  tracks_[track].value.push_back(std::move(value));
}

void UserTrackRecorder::take(const Stage& stage, double& room) {
  find_played(stage);
  for (std::size_t i = 0; i < tracks_.size() && room >= 0; ++i) {
    if (!is_played_[i]) continue;
    while (tracks_[i].value.size() < frames_ && room >= 0) push(i, at_first_[i], room);
    push(i, stage.user_value(tracks_[i].name), room);
  }
  if (room < 0)
    throw std::invalid_argument("by " + number_text(stage.time()) +
                                " s a recording of the user tracks takes more memory than is allowed: end it earlier, "
                                "or take fewer frames per second");
  ++frames_;
}

std::vector<UserTrackRecord> UserTrackRecorder::records() && {
  std::erase_if(tracks_, [](const UserTrackRecord& track) { return track.value.empty(); });
  return std::move(tracks_);
}

}  // namespace tweenfall::staging
