#include <tweenfall/anim/play.h>
#include <tweenfall/curves/number_text.h>

#include "clip/life.h"
#include "graph/binder.h"
#include "operations/account.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::graphs {

namespace {

class PlayedClip : public Operation {
 public:
  PlayedClip(const ClipPose& described, const LoopedClip& clip, const Hierarchy& nodes)
      : clip_(*clip.bound),
        jumps_(clip.jumps),
        formulas_(clip.formulas.get()),
        number_(clip.number),
        nodes_(nodes),
        at_(described.at),
        speed_(described.speed) {}

  void pose(const Log&, const Moment& moment, const Scratch& scratch, std::span<Motion> out) const noexcept override {
    std::ranges::copy(scratch.below, out.begin());
    clip_.sample(nodes_, clock(moment), out);
  }

  void events(const Log&, const Stretch& stretch, std::vector<GraphEvent>& out) const override {
    const bool begins = stretch.from < stretch.start && at_ < 0;
    if (begins) enter(stretch.start, out);
    for (FiredEvent& event :
         events_between(play(stretch.start), clip_.clip(), begins ? stretch.start : stretch.from, stretch.to))
      out.push_back({event.time, std::move(event.name), std::move(event.data), number_, kind_of(event.kind), 1});
  }

  [[nodiscard]] std::optional<double> next_event(const Log&, std::string_view name, double start, double after,
                                                 double until) const override {
    const std::vector<ClipEvent>& events = clip_.clip().events;
    if (std::ranges::find(events, name, &ClipEvent::name) == events.end()) return std::nullopt;
    if (const auto event = first_event(play(start), clip_.clip(), after, until, false, name)) return event->time;
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> next_jump(const Log&, double start, const Search& search) const override {
    const auto [since, after, until] = search;
    double jump = clips::next_moment(rounds(), jumps_.events, start + at_, speed_, after);
    if (formulas_ && speed_ > 0) jump = std::min(jump, next_leap(start + at_, after, std::min(jump, until)));
    return jump <= until ? std::optional(jump) : std::nullopt;
  }

  [[nodiscard]] double end(const Log&, double start) const noexcept override {
    return end_time(start + at_, speed_, clip_.clip());
  }

  void bearers(const Log&, const Moment& moment, std::size_t, const Sample<double>& weight,
               Bearers& out) const noexcept override {
    out.add({this, 0, moment.start, weight});
  }
  [[nodiscard]] std::vector<const pose::BoundClip*> own_clips() const override { return {&clip_}; }
  [[nodiscard]] ClipClock clock_of(const Log&, std::size_t, const Moment& moment) const noexcept override {
    return clock(moment);
  }
  [[nodiscard]] double round_of(const Log&, std::size_t, const Moment& moment) const noexcept override {
    if (speed_ == 0) return 0;
    const clips::Rounds all = rounds();
    if (moment.time < moment.start + at_ || !all.loops() || std::isfinite(all.total)) return clips::infinity;
    return (all.mode == LoopMode::pingpong ? 2 : 1) * all.length / std::abs(speed_);
  }

 private:
  [[nodiscard]] double next_leap(double began, double after, double until) const {
    // What is found before `after` is its own leap, rounded.
    double leap = std::max(0.0, after - began) * speed_ * (1 - 1e-12) - 1e-12;
    for (;;) {
      leap = formulas_->next(leap, (until - began) * speed_);
      if (!std::isfinite(leap)) return leap;
      const ClipEvent moment{.from = leap, .to = leap, .name = {}, .data = {}};
      const double time = clips::next_moment(rounds(), {&moment, 1}, began, speed_, after);
      if (time <= until) return time;
    }
  }
  /// Adds what a clip that started before `start` does there: events, and begins of the intervals that it is in.
  void enter(double start, std::vector<GraphEvent>& out) const {
    const double round = speed_ != 0 ? clip_.clip().duration / std::abs(speed_) : 0;
    std::vector<FiredEvent> open;
    for (FiredEvent& event :
         events_between(play(start), clip_.clip(), start - std::min(-at_, round), start, -at_ <= round)) {
      if (event.kind == FiredEvent::Kind::end)
        std::erase_if(open, [&](const FiredEvent& begun) { return begun.name == event.name; });
      else if (event.kind == FiredEvent::Kind::begin || event.time == start)
        open.push_back(std::move(event));
    }
    for (FiredEvent& event : open)
      out.push_back({start, std::move(event.name), std::move(event.data), number_, kind_of(event.kind), 1});
  }
  [[nodiscard]] ClipClock clock(const Moment& moment) const noexcept {
    return clips::steady_clock(rounds(), moment.start + at_, speed_, moment.time, moment.side);
  }
  [[nodiscard]] clips::Rounds rounds() const noexcept {
    return clips::rounds_of(clip_.clip().duration, clip_.clip().loop, speed_ < 0, clip_.lands());
  }
  [[nodiscard]] Play play(double start) const { return {.clip = number_, .at = start + at_, .speed = speed_}; }
  static GraphEvent::Kind kind_of(FiredEvent::Kind kind) {
    if (kind == FiredEvent::Kind::begin) return GraphEvent::Kind::begin;
    return kind == FiredEvent::Kind::end ? GraphEvent::Kind::end : GraphEvent::Kind::moment;
  }

  const pose::BoundClip& clip_;
  const Clip& jumps_;
  const clips::FormulaJumps* formulas_;  // null for none
  std::size_t number_;
  const Hierarchy& nodes_;
  double at_, speed_;
};

}  // namespace

void tell(const ClipPose& pose, Account& account) {
  account.words = "clip";
  if (pose.speed != 1) account.words += " at " + brief_text(pose.speed) + " x";
  if (pose.at != 0) account.words += " after " + brief_text(pose.at) + " s";
  constexpr const char* modes[] = {", once", ", repeat", ", repeat-offset", ", pingpong"};
  if (pose.loop) account.words += modes[static_cast<int>(pose.loop->mode)];
  if (pose.loop && pose.loop->count > 0) account.words += " x " + brief_text(pose.loop->count);
  account.clip(pose.clip);
  account.tell(pose.at, pose.speed, pose.loop);
}

std::unique_ptr<Operation> bound(const ClipPose& described, Binder& binder) {
  const LoopedClip* clip = binder.clip(described.clip, described.loop, {"clip"});
  if (!std::isfinite(described.at)) binder.fault({"at"}, "a clip starts at a finite time");
  if (!std::isfinite(described.speed)) binder.fault({"speed"}, "a speed is a finite number");
  if (described.loop && (!(described.loop->count >= 0) || !std::isfinite(described.loop->count)))
    binder.fault({"count"}, "a count of plays is 0 or more");
  if (!clip) return nullptr;
  if (described.speed < 0 && std::isinf(clip->clip.duration))
    binder.fault({"speed"}, "an endless clip has no end from which to run backwards");
  return std::make_unique<PlayedClip>(described, *clip, binder.nodes());
}

}  // namespace tweenfall::graphs
