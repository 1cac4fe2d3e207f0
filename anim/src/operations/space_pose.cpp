#include <tweenfall/anim/blend.h>
#include <tweenfall/anim/blend_space.h>
#include <tweenfall/anim/marker_sync.h>
#include <tweenfall/curves/number_text.h>

#include "graph/binder.h"
#include "operations/account.h"
#include "operations/phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tweenfall::graphs {

namespace {

class Space : public Operation {
 public:
  Space(std::vector<const Operation*> poses, SpaceWeights weights)
      : poses_(std::move(poses)), weights_(std::move(weights)) {}

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    std::array<PoseLayer, most_blended> layers;
    const std::span<Sample<double>> own(weights.data(), poses_.size());
    weights_.sample(log, moment.time, moment.side, own);
    std::size_t count = 0;
    Scratch free = scratch;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (is_nothing(own[i])) continue;
      const std::span<Motion> motions = free.pose();
      free = free.rest();
      poses_[i]->pose(log, moment, free, motions);
      layers[count++] = {.pose = motions, .weight = own[i]};
    }
    blend({layers.data(), count}, scratch.below, out);
  }

  [[nodiscard]] std::span<const Operation* const> operands() const noexcept override { return poses_; }

  [[nodiscard]] double share(const Log& log, std::size_t operand, double time) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    weights_.sample(log, time, Side::out, {weights.data(), poses_.size()});
    return weights[operand].value;
  }

  void bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    weights_.sample(log, moment.time, moment.side, {weights.data(), poses_.size()});
    out.note(log, weights_, moment);
    for (std::size_t i = 0; i < poses_.size(); ++i)
      if (!is_nothing(weights[i])) poses_[i]->bearers(log, moment, node, product(weight, weights[i]), out);
  }

 private:
  std::vector<const Operation*> poses_;
  SpaceWeights weights_;
};

/// Clips that run in phase by their markers.
class SyncedSpace : public Operation {
 public:
  SyncedSpace(std::vector<const LoopedClip*> clips, const Hierarchy& nodes, Phase phase)
      : clips_(std::move(clips)), nodes_(nodes), phase_(std::move(phase)) {}

  void pose(const Log& log, const Moment& moment, const Scratch& scratch,
            std::span<Motion> out) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    std::array<PoseLayer, most_blended> layers;
    const std::span<Sample<double>> own(weights.data(), clips_.size());
    phase_.weights().sample(log, moment.time, moment.side, own);
    const Sample<double> phase = phase_.at(log, moment);
    std::size_t count = 0;
    Scratch free = scratch;
    for (std::size_t i = 0; i < clips_.size(); ++i) {
      if (is_nothing(own[i])) continue;
      const std::span<Motion> motions = free.pose();
      free = free.rest();
      std::ranges::copy(scratch.below, motions.begin());
      clips_[i]->bound->sample(nodes_, clock_in(i, phase, moment.side), motions);
      layers[count++] = {.pose = motions, .weight = own[i]};
    }
    blend({layers.data(), count}, scratch.below, out);
  }

  void bearers(const Log& log, const Moment& moment, std::size_t, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    phase_.weights().sample(log, moment.time, moment.side, {weights.data(), clips_.size()});
    out.note(log, phase_.weights(), moment);
    for (std::size_t i = 0; i < clips_.size(); ++i)
      if (!is_nothing(weights[i])) out.add({this, i, moment.start, product(weight, weights[i])});
  }
  [[nodiscard]] std::vector<const pose::BoundClip*> own_clips() const override {
    std::vector<const pose::BoundClip*> own;
    own.reserve(clips_.size());
    for (const LoopedClip* clip : clips_) own.push_back(&*clip->bound);
    return own;
  }
  [[nodiscard]] ClipClock clock_of(const Log& log, std::size_t clip, const Moment& moment) const noexcept override {
    return clock_in(clip, phase_.at(log, moment), moment.side);
  }
  [[nodiscard]] double round_of(const Log& log, std::size_t, const Moment& moment) const noexcept override {
    std::array<Sample<double>, most_blended> weights;
    std::array<double, most_blended> held;
    phase_.weights().sample(log, moment.time, moment.side, {weights.data(), clips_.size()});
    for (std::size_t i = 0; i < clips_.size(); ++i) held[i] = weights[i].value;
    return phase_.sync().seconds({held.data(), clips_.size()});
  }

  void events(const Log& log, const Stretch& stretch, std::vector<GraphEvent>& out) const override {
    const Asked clips = asked([](const LoopedClip& each) { return &each.clip; });
    require_countable(log, stretch);
    phase_.each_event(log, {clips.data(), clips_.size()}, stretch.start, stretch.from, stretch.to,
                      [&](double time, std::size_t i, const ClipEvent& event, GraphEvent::Kind kind) {
                        std::array<Sample<double>, most_blended> weights;
                        phase_.weights().sample(log, time, Side::out, {weights.data(), clips_.size()});
                        out.push_back({time, event.name, event.data, clips_[i]->number, kind, weights[i].value});
                        return true;
                      });
  }

  [[nodiscard]] std::optional<double> next_event(const Log& log, std::string_view name, double start, double after,
                                                 double until) const override {
    const Asked clips = asked([&](const LoopedClip& each) {
      const std::vector<ClipEvent>& events = each.clip.events;
      return std::ranges::find(events, name, &ClipEvent::name) == events.end() ? nullptr : &each.clip;
    });
    std::optional<double> first;
    phase_.each_event(log, {clips.data(), clips_.size()}, start, after, until,
                      [&](double time, std::size_t, const ClipEvent& event, GraphEvent::Kind kind) {
                        if (event.name != name || kind == GraphEvent::Kind::end) return true;
                        first = std::min(first.value_or(time), time);
                        return false;
                      });
    return first;
  }

  [[nodiscard]] std::optional<double> next_jump(const Log& log, double start, const Search& search) const override {
    const Asked clips = asked([](const LoopedClip& each) { return &each.jumps; });
    std::optional<double> first;
    phase_.each_event(log, {clips.data(), clips_.size()}, start, search.after, search.until,
                      [&](double time, std::size_t, const ClipEvent&, GraphEvent::Kind) {
                        if (!(time > search.after)) return true;
                        first = std::min(first.value_or(time), time);
                        return false;
                      });
    return first;
  }

  [[nodiscard]] double end(const Log&, double) const noexcept override {
    return std::numeric_limits<double>::infinity();
  }

 private:
  [[nodiscard]] ClipClock clock_in(std::size_t clip, const Sample<double>& phase, Side side) const noexcept {
    const SyncedTime at = phase_.sync().time(clip, phase);
    ClipClock clock;
    clock.time = at.time.value;
    clock.rate = at.time.rate;
    clock.cycle = static_cast<int>(std::clamp(at.cycle, -2e9, 2e9));
    clock.started = true;
    clock.side = side;
    return clock;
  }

  /// @throws std::length_error
  void require_countable(const Log& log, const Stretch& stretch) const {
    constexpr double most_events = 1e6;
    const double from = std::max(stretch.from, stretch.start);
    if (!(stretch.to > from)) return;
    double events = 0;
    for (std::size_t i = 0; i < clips_.size(); ++i) {
      const Clip& clip = clips_[i]->clip;
      if (clip.events.empty()) continue;
      const double rounds = phase_.rounds(log, i, clip.duration, stretch.start, from, stretch.to);
      for (const ClipEvent& event : clip.events) events += event.is_interval() ? 2 * rounds : rounds;
      if (events > most_events)
        throw std::length_error("clip \"" + clip.name + "\", in phase, goes around every " +
                                brief_text((stretch.to - from) / rounds) +
                                " s and has more than a million events from " + number_text(stretch.from) + " s to " +
                                number_text(stretch.to) + " s: lengthen its loop or leave out its events");
    }
  }

  using Asked = std::array<const Clip*, most_blended>;
  /// @param of  what is asked for of a clip; null for nothing
  template <class Of>
  [[nodiscard]] Asked asked(const Of& of) const {
    Asked clips{};
    for (std::size_t i = 0; i < clips_.size(); ++i) clips[i] = of(*clips_[i]);
    return clips;
  }

  std::vector<const LoopedClip*> clips_;
  const Hierarchy& nodes_;
  Phase phase_;
};

/// The clip of an entry of a synced space; if it is something else, null, and that is reported.
const LoopedClip* synced_clip(const std::string& name, const Place& place, Binder& binder) {
  const Loop around{.mode = LoopMode::repeat};
  for (const GraphPose& pose : binder.description().poses) {
    if (pose.name != name) continue;
    const auto* clip = std::get_if<ClipPose>(&pose.operation);
    if (!clip || clip->speed != 1 || clip->at != 0)
      binder.fault(place, "only clips at their own speed run in phase; \"" + name + "\" is none");
    else if (clip->loop && *clip->loop != around)
      binder.fault(place, "clips in phase go around without end; \"" + name + "\" has another loop");
    else
      return binder.clip(clip->clip, around, place);
    return nullptr;
  }
  return binder.clip(name, around, place);
}

/// The clips with those events as markers that match the pattern or, if it is empty, whose names all clips that have
/// events share.
std::vector<SyncClip> marked(std::span<const LoopedClip* const> clips, const std::string& pattern) {
  const auto has = [](const Clip& clip, const std::string& name) {
    return clip.events.empty() || std::ranges::find(clip.events, name, &ClipEvent::name) != clip.events.end();
  };
  std::vector<SyncClip> all;
  all.reserve(clips.size());
  for (const LoopedClip* clip : clips) {
    SyncClip& one = all.emplace_back(sync_clip(clip->clip, pattern.empty() ? "*" : pattern));
    if (pattern.empty())
      std::erase_if(one.markers, [&](const SyncMarker& marker) {
        return !std::ranges::all_of(clips, [&](const LoopedClip* other) { return has(other->clip, marker.name); });
      });
  }
  return all;
}

}  // namespace

void tell(const SpacePose& pose, Account& account) {
  account.words = "space";
  for (const GraphNumber& number : pose.by)
    account.words += (&number == &pose.by.front() ? " by " : ", ") + words_of(number);
  if (pose.sync) account.words += ", in phase";
  if (pose.bands) account.words += ", in bands";
  for (const SpacePose::Entry& entry : pose.entries) {
    const std::string x = brief_text(entry.place.x());
    account.pose(entry.pose, pose.by.size() == 2 ? x + ", " + brief_text(entry.place.y()) : x);
    account.tell(entry.place);
  }
  account.tell(pose.by, pose.sync, pose.bands);
}

std::unique_ptr<Operation> bound(const SpacePose& described, Binder& binder) {
  const Place here = {"space"};
  const auto at = [&](std::size_t entry) { return Place{"space", "poses", std::to_string(entry)}; };
  if (described.entries.size() > most_blended) {
    binder.fault(here, "a space takes " + std::to_string(most_blended) + " poses at most");
    return nullptr;
  }
  std::vector<Number> by;
  for (const GraphNumber& number : described.by) by.push_back(binder.number(number, {"space", "by"}));
  std::vector<const Operation*> poses;
  std::vector<const LoopedClip*> clips;
  for (std::size_t i = 0; i < described.entries.size(); ++i) {
    const std::string& name = described.entries[i].pose;
    if (described.sync)
      clips.push_back(synced_clip(name, at(i), binder));
    else
      poses.push_back(binder.pose(name, at(i)));
  }
  if (by.empty() || by.size() > 2) {
    binder.fault({"space", "by"}, "a space is along one number or on a plane of two");
    return nullptr;
  }
  if (described.bands && by.size() != 2) binder.fault({"space", "bands"}, "bands are for a plane of two numbers");
  std::optional<SpaceWeights> weights;
  if (!binder.attempt({"space", "poses"}, [&] { weights.emplace(described, std::move(by)); })) return nullptr;
  if (std::ranges::find(poses, nullptr) != poses.end() || std::ranges::find(clips, nullptr) != clips.end())
    return nullptr;
  std::unique_ptr<Operation> operation;
  if (described.sync) {
    std::vector<SyncClip> markers = marked(clips, *described.sync);
    const bool names_some = !described.sync->empty() && *described.sync != "*";
    if (names_some && std::ranges::all_of(markers, [](const SyncClip& clip) { return clip.markers.empty(); })) {
      binder.fault({"space", "sync"}, "no event of its clips matches \"" + *described.sync + "\"");
      return nullptr;
    }
    const bool fits = binder.attempt({"space", "sync"}, [&] {
      operation =
          std::make_unique<SyncedSpace>(std::move(clips), binder.nodes(),
                                        Phase(MarkerSync(std::move(markers)), *std::move(weights), binder.new_phase()));
    });
    if (!fits) return nullptr;
  } else {
    operation = std::make_unique<Space>(std::move(poses), *std::move(weights));
  }
  operation->set_rooms(described.entries.size());
  return operation;
}

}  // namespace tweenfall::graphs
