#include "support.h"

#include <tweenfall/anim/play.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include <limits>

using namespace tweenfall;

namespace {

Clip two_seconds(LoopMode mode, double count = 0) {
  Clip clip;
  clip.name = "clip";
  clip.duration = 2;
  clip.loop = {mode, count};
  clip.events = {{.from = 0, .to = 0, .name = "start", .data = {}},
                 {.from = 0.5, .to = 0.5, .name = "half", .data = {}},
                 {.from = 1, .to = 1.5, .name = "loud", .data = {}},
                 {.from = 2, .to = 2, .name = "end", .data = {}}};
  return clip;
}

std::string told(const std::vector<FiredEvent>& events) {
  std::string text;
  for (const FiredEvent& event : events) {
    char number[32];
    std::snprintf(number, sizeof number, "%g:", event.time);
    text += number + event.name;
    if (event.kind == FiredEvent::Kind::begin) text += "(";
    if (event.kind == FiredEvent::Kind::end) text += ")";
    text += ' ';
  }
  return text;
}

}  // namespace

TEST_CASE("a clip played once runs from its start, then holds its end at rest") {
  const Clip clip = two_seconds(LoopMode::once);
  const Play play{.clip = 0, .at = 1};
  CHECK_FALSE(clock_at(play, clip, 0.5).started);
  CHECK(clock_at(play, clip, 0.5).rate == 0);
  CHECK(clock_at(play, clip, 1.0, Side::in).rate == 0);
  CHECK(clock_at(play, clip, 1.0).rate == 1);
  CHECK(clock_at(play, clip, 2.25).time == 1.25);
  CHECK(clock_at(play, clip, 3.0, Side::in).rate == 1);  // what arrives at the end still moves
  CHECK(clock_at(play, clip, 3.0).rate == 0);
  CHECK(clock_at(play, clip, 9.0).time == 2);
  CHECK(clock_at(play, clip, 9.0).ended);
  CHECK(end_time(play, clip) == 3);
}

TEST_CASE("at the seam of a loop the arriving side is the end and the leaving side the start") {
  const Clip clip = two_seconds(LoopMode::repeat);
  const Play play{};
  const ClipClock in = clock_at(play, clip, 4.0, Side::in), out = clock_at(play, clip, 4.0, Side::out);
  CHECK(in.time == 2);
  CHECK(in.cycle == 1);
  CHECK(in.side == Side::in);
  CHECK(out.time == 0);
  CHECK(out.cycle == 2);
  CHECK(out.side == Side::out);
}

TEST_CASE("a counted loop ends after its plays, fractions included") {
  const Clip clip = two_seconds(LoopMode::repeat, 1.5);
  const Play play{};
  CHECK(end_time(play, clip) == 3);
  CHECK(clock_at(play, clip, 10).time == 1);
  CHECK(clock_at(play, two_seconds(LoopMode::repeat, 2), 10).time == 2);
}

TEST_CASE("ping-pong runs every other play backwards") {
  const Clip clip = two_seconds(LoopMode::pingpong);
  const Play play{};
  CHECK(clock_at(play, clip, 2.5).time == 1.5);
  CHECK(clock_at(play, clip, 2.5).rate == -1);
  CHECK(clock_at(play, clip, 4.5).time == 0.5);
  CHECK(clock_at(play, clip, 4.5).rate == 1);
}

TEST_CASE("a clock of one speed is that of a play of this speed, whatever the loop and the side") {
  for (const LoopMode mode : {LoopMode::once, LoopMode::repeat, LoopMode::repeat_offset, LoopMode::pingpong})
    for (const double count : {0.0, 1.0, 2.5, 3.0, 1e17})
      for (const double speed : {1.0, -1.0, 0.0, 0.3, -2.0})
        for (double time = -1; time < 10; time += 0.25)
          for (const Side side : {Side::in, Side::out}) {
            const Clip clip = two_seconds(mode, count);
            const ClipClock a = clock_at(0.5, speed, clip, time, side),
                            b = clock_at({.at = 0.5, .speed = speed}, clip, time, side);
            const bool same = a.time == b.time && a.rate == b.rate && a.cycle == b.cycle && a.side == b.side &&
                              a.started == b.started && a.ended == b.ended;
            if (!same) FAIL("count ", count, ", speed ", speed, " at ", time, ": ", a.time, " and ", b.time);
          }
}

TEST_CASE("speed multiplies the rate, and a negative one runs from the end") {
  const Clip clip = two_seconds(LoopMode::once);
  CHECK(clock_at({.speed = 0.5}, clip, 1).time == 0.5);
  CHECK(clock_at({.speed = 0.5}, clip, 1).rate == 0.5);
  CHECK(clock_at({.speed = 0}, clip, 1).rate == 0);
  const ClipClock back = clock_at({.speed = -1}, clip, 0.5);
  CHECK(back.time == 1.5);
  CHECK(back.rate == -1);
  CHECK(back.side == Side::in);  // a clock that runs backwards leaves a key on its earlier side
  CHECK(clock_at({.speed = -1}, clip, 5).time == 0);
  CHECK(clock_at({.speed = -1}, clip, 5).rate == 0);
}

TEST_CASE("each event fires once however the time is cut, the first at 0 included") {
  const Clip clip = two_seconds(LoopMode::repeat, 2);
  const Play play{.at = 1};
  const std::string whole = told(events_between(play, clip, 0, 10, true));
  CHECK(whole == "1:start 1.5:half 2:loud( 2.5:loud) 3:end 3:start 3.5:half 4:loud( 4.5:loud) 5:end ");
  for (const double piece : {0.01, 0.1, 0.25, 0.5, 0.7, 3.0}) {
    std::string pieces;
    double from = 0;
    for (int i = 1; from < 10; ++i) {
      const double to = i * piece;
      pieces += told(events_between(play, clip, from, to, i == 1));
      from = to;
    }
    CHECK(pieces == whole);
  }
}

TEST_CASE("backwards, events fire on the way down and intervals begin at their end") {
  const Clip clip = two_seconds(LoopMode::once);
  CHECK(told(events_between({.speed = -1}, clip, 0, 3, true)) == "0:end 0.5:loud( 1:loud) 1.5:half 2:start ");
}

TEST_CASE("an endless clip of functions has an endless clock") {
  Clip clip;
  clip.duration = std::numeric_limits<double>::infinity();
  const Play play{.speed = 2};
  CHECK(clock_at(play, clip, 100).time == 200);
  CHECK(clock_at(play, clip, 100).rate == 2);
  CHECK(end_time(play, clip) == std::numeric_limits<double>::infinity());
}

TEST_CASE("an event at the turn of a ping-pong is told once") {
  Clip clip;
  clip.duration = 1;
  clip.loop = {LoopMode::pingpong, 3};
  clip.events = {{.from = 0, .to = 0, .name = "low", .data = {}}, {.from = 1, .to = 1, .name = "high", .data = {}}};
  CHECK(told(events_between({}, clip, 0, 5, true)) == "0:low 1:high 2:low 3:high ");
}

TEST_CASE("a hundred thousand loops tell every one of their events, and too many are an error that names the clip") {
  Clip clip{.name = "buzz", .duration = 1e-5, .loop = {LoopMode::repeat, 0}};
  clip.events = {{.from = 5e-6, .to = 5e-6, .name = "tick", .data = {}}};
  CHECK(events_between({}, clip, 0, 1, true).size() == 100'000);
  clip.duration = 1e-9;
  CHECK_THROWS_WITH_AS(static_cast<void>(events_between({}, clip, 0, 1, true)),
                       "clip \"buzz\" goes around every 1e-09 s and has more than a million events from 0 s to 1 s: "
                       "lengthen its loop or leave out its events",
                       std::length_error);
}

TEST_CASE("what says that events are too many is right for every stretch it speaks of, before one is asked for") {
  constexpr double stretch = 1.0 / 240;
  const auto never_throws = [](const Play& play, const Clip& clip) {
    for (const double from : {0.0, 0.1, 1.0 / 3, 7.7, 1000.0, 1e6})
      for (const double seconds : {0.0, stretch / 7, stretch})
        CHECK_NOTHROW(static_cast<void>(events_between(play, clip, from, from + seconds, true)));
  };
  Clip clip{.name = "buzz", .duration = 1, .loop = {LoopMode::repeat, 0}};
  clip.events.resize(3);
  for (const double speed : {1.0, -2.0, 1e3}) {
    // The shortest allowed loop, from above.
    const Play play{.speed = speed};
    double refused = 1e-12, taken = 10;
    while (taken - refused > 1e-9 * taken) {
      clip.duration = (refused + taken) / 2;
      (too_many_events(play, clip, stretch).empty() ? taken : refused) = clip.duration;
    }
    CHECK(taken == doctest::Approx(6e-6 * stretch * std::abs(speed)).epsilon(0.01));
    clip.duration = taken;
    never_throws(play, clip);
    clip.duration = 0.99 * refused;
    CHECK_THROWS_AS(static_cast<void>(events_between(play, clip, 1, 1 + stretch)), std::length_error);
  }
  clip.duration = 1e-12;
  CHECK(too_many_events({.speed = -2}, clip, stretch) ==
        "clip \"buzz\" goes around every 5e-13 s and has more than a million events within 0.0041667 s: "
        "lengthen its loop or leave out its events");
  CHECK(too_many_events({.speed = 0}, clip, stretch).empty());
  clip.loop.count = 100;
  CHECK(too_many_events({}, clip, stretch).empty());
  never_throws({}, clip);
  clip.loop = {LoopMode::once, 0};
  CHECK(too_many_events({}, clip, stretch).empty());
  clip.events.clear();
  clip.loop = {LoopMode::repeat, 0};
  CHECK(too_many_events({}, clip, stretch).empty());
  clip.loop = {LoopMode::once, 0};
  clip.events.resize(500'001);
  CHECK(too_many_events({}, clip, stretch) ==
        "clip \"buzz\" has more than a million events within 0.0041667 s: leave out its events");
}

TEST_CASE("the first event of a tiny loop is found at once, and of one that does not have it none") {
  Clip clip{.name = "buzz", .duration = 1e-9, .loop = {LoopMode::repeat, 0}};
  clip.events = {{.from = 5e-10, .to = 5e-10, .name = "tick", .data = {}}};
  const auto first = first_event({}, clip, 0.25, 600);
  REQUIRE(first);
  CHECK(first->time > 0.25);
  CHECK(first->time < 0.25 + 2e-9);
  CHECK(first_event({.speed = -1}, clip, 0.25, 600)->time < 0.25 + 2e-9);
  CHECK_FALSE(first_event({}, clip, 0, 600, true, "tock"));
  clip.loop = {LoopMode::repeat, 3};
  CHECK_FALSE(first_event({}, clip, 0.25, 600));
}

TEST_CASE("a loop of 1e17 plays runs backwards from its end like one of few") {
  for (const LoopMode mode : {LoopMode::repeat, LoopMode::pingpong}) {
    const Clip few = two_seconds(mode, 1000), many = two_seconds(mode, 1e17);
    const Play play{.at = 0.25, .speed = -1};
    CHECK(told(events_between(play, many, 0, 7, true)) == told(events_between(play, few, 0, 7, true)));
    for (const double time : {0.0, 0.25, 1.0, 2.25, 3.5, 6.0})
      for (const Side side : {Side::in, Side::out}) {
        CAPTURE(time);
        const ClipClock a = clock_at(play, many, time, side), b = clock_at(play, few, time, side);
        CHECK(a.time == b.time);
        CHECK(a.rate == b.rate);
        CHECK(a.side == b.side);
        CHECK_FALSE(a.ended);
      }
  }
}

TEST_CASE(
    "a clip by nature lasts to its last key or event, for ever where only formulas move it, not at all when empty") {
  const Track keyed{"ball", "position",
                    keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}}, {.time = 2, .value = {1, 0, 0}}})};
  const Track endless{"ball", "size", oscillator({})};
  CHECK(natural_duration({}) == 0);
  CHECK(natural_duration({.tracks = {keyed}}) == 2);
  CHECK(natural_duration({.tracks = {keyed, endless}}) == 2);
  CHECK(natural_duration({.tracks = {endless}}) == std::numeric_limits<double>::infinity());
  CHECK(natural_duration({.tracks = {keyed}, .events = {{.from = 1, .to = 3, .name = "late"}}}) == 3);
}
