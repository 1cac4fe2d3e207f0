#include "anim/player/random_plays.h"

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("progress, iteration and fill are those of CSS timing") {
  std::size_t checked = 0, nothing = 0;
  for (const nlohmann::json& family : vector_family("css_timing"))
    for (const nlohmann::json& each : family.at("cases")) {
      const nlohmann::json& input = each.at("input");
      const double duration = input.at("duration"), start = input.at("iterationStart");
      const bool endless = input.at("iterations").is_string();
      const double iterations = endless ? 0 : input.at("iterations").get<double>();
      const std::string direction = input.at("direction"), easing = input.at("easing");
      const bool alternates = direction.find("alternate") == 0;
      Clip clip{.name = "progress", .duration = duration};
      Play play{.at = input.at("delay")};
      play.offset = start * duration;
      play.reverse = direction.find("reverse") != std::string::npos;
      // A count of 0 is one without end: rounds that are none are the least that numbers tell.
      const double rounds = iterations > 0 ? start + iterations : std::nextafter(start, 1e9);
      play.loop = Loop{alternates ? LoopMode::pingpong : LoopMode::repeat, endless ? 0 : rounds};
      const auto word = std::ranges::find(fill_words, input.at("fill").get<std::string>());
      REQUIRE(word != fill_words.end());
      play.fill = static_cast<Fill>(word - fill_words.begin());
      const Ease ease = easing == "linear" ? Ease::linear() : Ease::named(easing).value();
      const Player player(play, clip);
      CAPTURE(each.at("name").get<std::string>());
      if (!endless) CHECK(near(player.end() - play.at, each.at("active_duration").get<double>(), 1e-9));
      for (std::size_t i = 0; i < each.at("t").size(); ++i) {
        const double time = each.at("t")[i];
        CAPTURE(time);
        const bool shown = !each.at("progress")[i].is_null();
        // At an edge either side may be meant; and before time 0 nothing runs there yet, whatever its delay.
        const auto shows = [&](double at) { return player.shows(at) && (at >= 0 || fills_before(play.fill)); };
        CHECK((shows(time - 1e-6) == shown || shows(time + 1e-6) == shown));
        if (!shown) {
          ++nothing;
          continue;
        }
        const double progress = each.at("progress")[i];
        const int iteration = each.at("iteration")[i];
        bool right = false;
        for (const double beside : {0.0, 1e-6, -1e-6})
          for (const Side side : {Side::out, Side::in}) {
            const ClipClock clock = player.clock(time + beside, side);
            const double u = std::clamp(clock.time / duration, 0.0, 1.0);
            for (const Side eased : {Side::out, Side::in}) {
              const double value = easing == "linear" ? u : ease.progress(u, eased).value;
              right = right || (std::abs(value - progress) < 2e-5 && clock.cycle == iteration);
            }
          }
        CHECK(right);
        ++checked;
      }
    }
  CHECK(checked > 0);
  CHECK(nothing > 0);
}

TEST_CASE("times and weights are those of three.js's mixer, fades, loops and time scales") {
  std::size_t times = 0, weights = 0, steps = 0;
  for (const nlohmann::json& family : vector_family("three_mixer"))
    for (const nlohmann::json& each : family.at("cases")) {
      const nlohmann::json& input = each.at("input");
      CAPTURE(each.at("name").get<std::string>());
      const auto& clips = input.at("clips");
      for (std::size_t action = 0; action < clips.size(); ++action) {
        const double duration = clips[action].at("duration");
        Clip clip{.name = "clip", .duration = duration, .loop = {LoopMode::repeat, 0}};
        Play play;
        double seek = 0;
        bool warped = false, above_one = false;
        std::vector<double> at{0};
        for (const double dt : input.at("dt")) at.push_back(at.back() + dt);
        struct Late {
          double time;
          PlayAction action;
        };
        std::vector<Late> late;
        for (const auto& op : input.at("ops")) {
          const std::string what = op[op[0].is_number() && op[1].is_number() ? 2 : 1];
          const double now = at[op[0].get<std::size_t>()];
          const std::size_t who = op[1];
          if (what == "crossFadeTo") {
            const double seconds = op[4];
            const std::size_t other = op[3];
            if (who == action) late.push_back({now, playing::FadeTo{0, seconds, Ease::linear()}});
            if (other == action) late.push_back({now, playing::Weigh{{{0, 0, Ease::linear()}, {seconds, 1}}}});
            if (!op[5].get<bool>()) continue;
            // Their speeds blend: at first both clips last as long as the leaving one, in the end as the arriving one.
            const double ratio = clips[who].at("duration").get<double>() / clips[other].at("duration").get<double>();
            warped = warped || who == action || other == action;
            if (who == action) late.push_back({now, playing::SetSpeed{{{0, 1, Ease::linear()}, {seconds, ratio}}}});
            if (other == action)
              late.push_back({now, playing::SetSpeed{{{0, 1 / ratio, Ease::linear()}, {seconds, 1}}}});
            continue;
          }
          if (who != action) continue;
          if (what == "weight") {
            const double weight = op[3];
            above_one = weight > 1;
            play.weight = Curve<double>(std::min(1.0, weight));
          }
          if (what == "timeScale") play.speed = op[3].get<double>();
          if (what == "time") seek = op[3];
          if (what == "halt") {
            warped = true;
            late.push_back({now, playing::SetSpeed{{{0, 0}}, op[3].get<double>()}});
          }
          if (what == "fadeIn") play.fade_in = {op[3].get<double>()};
          if (what == "fadeOut") late.push_back({now, playing::FadeTo{0, op[3].get<double>(), Ease::linear()}});
          if (what == "loop") {
            const std::string mode = op[3];
            play.loop = Loop{mode == "once"     ? LoopMode::once
                             : mode == "repeat" ? LoopMode::repeat
                                                : LoopMode::pingpong,
                             op[4].is_number() ? op[4].get<double>() : 0.0};
          }
        }
        // Their actions begin at 0 whichever way they run.
        if (play.speed.at(0) < 0) {
          play.loop = Loop{LoopMode::repeat, 0};
          play.offset = duration - seek;
        } else {
          play.offset = seek;
        }
        Player player(play, clip);
        for (const Late& change : late) player = player.changed(clip, change.time, change.action);
        for (std::size_t i = 0; i < each.at("value").size(); ++i) {
          const auto& frame = each.at("value")[i];
          const double now = at[i + 1];
          const bool over = now > player.end() - 1e-3;
          CAPTURE(now);
          CAPTURE(action);
          // There, what has faded out stands still.
          if (!over && frame.at("weight")[action] != 0) {
            const double said = frame.at("time")[action];
            if (warped) {
              // A changing speed acts step by step there, with its value at the step's end.
              const double before = i == 0 ? seek : each.at("value")[i - 1].at("time")[action].get<double>(),
                           step = player.clock(now, Side::in).rate * (now - at[i]);
              CHECK(std::abs(std::remainder(said - before - step, duration)) < 2e-5 * std::max(1.0, now));
              ++steps;
            } else {
              const ClipClock clock = player.clock(now);
              double mine = clock.time;
              // Theirs runs forward on each way of a ping-pong.
              if (play.loop && play.loop->mode == LoopMode::pingpong && clock.cycle % 2 == 1) mine = duration - mine;
              const double apart = std::abs(mine - said);
              CHECK(std::min(apart, std::abs(duration - apart)) < 2e-5 * std::max(1.0, now));
              ++times;
            }
          }
          // Theirs goes beyond 1, a play's weight does not.
          if (!over && !above_one && frame.contains("weight")) {
            CHECK(near(player.weight(now, Side::in).value, frame.at("weight")[action].get<double>(), 2e-5));
            ++weights;
          }
        }
      }
    }
  CHECK(times > 0);
  CHECK(weights > 0);
  CHECK(steps > 0);
}

TEST_CASE("clip time is the integral of the speed's keys, and its rate the speed itself") {
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    const std::vector<PlayKey> keys = random_speed(random);
    const Curve<double> speed = curve_of(keys);
    Clip clip{.name = "endless", .duration = std::numeric_limits<double>::infinity()};
    Play play{.at = 1, .speed = PlaySpeed(speed)};
    const Player player(play, clip);
    double way = 0;
    const double start = player.clock(1).time;
    constexpr int steps = 4000;
    const double dt = 4.0 / steps;
    for (int k = 0; k < steps; ++k) {
      const double own = k * dt;
      // Simpson's rule within pieces; if a key jumps inside one, that costs its width.
      way += dt / 6 * (speed.value(own) + 4 * speed.value(own + dt / 2) + speed.value(own + dt, Side::in));
      if (k % 500 != 499) continue;
      const ClipClock clock = player.clock(1 + own + dt);
      CHECK(near(clock.time - start, way, 5e-3));
      CHECK(clock.rate == speed.value(1 + own + dt - 1));
    }
  }
  // In closed form: from 0 to 2 within 2 s, evenly: t^2 / 2.
  const Clip clip{.name = "once", .duration = 10};
  const Player player(
      {.speed =
           PlaySpeed(keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 2, .value = 2}}))},
      clip);
  for (const double t : {0.25, 1.0, 1.75}) CHECK(near(player.clock(t).time, t * t / 2, 1e-15));
  CHECK(near(player.clock(3).time, 4, 1e-15));
  CHECK(near(player.end(), 6, 1e-15));
}

TEST_CASE("a play is over where its clock first comes to an end, whatever its speed does then") {
  const Clip clip = clip_with_events(2);
  const Curve<double> back =
      keyed_curve<double>({{.time = 0, .value = 1, .ease = Ease::linear()}, {.time = 2, .value = -1}});
  const Player turns({.speed = PlaySpeed(back)}, clip);  // t - t^2 / 2: to 0.5 at 1 s and back to 0 at 2 s
  CHECK(near(turns.clock(1).time, 0.5, 1e-15));
  CHECK(turns.clock(1.5).rate == -0.5);
  CHECK(near(turns.end(), 2, 1e-12));
  CHECK(turns.clock(2.5).ended);
  CHECK(turns.clock(2.5).rate == 0);
  CHECK(all_told(turns.events_between(clip, 0, 5, true)) == "0:start\n2:start\n");
}

TEST_CASE("a section plays its part, clips intervals to it and loops within it") {
  Clip clip = clip_with_events(2);
  Play play;
  play.from = 0.5;
  play.to = 1;
  play.loop = Loop{LoopMode::repeat, 2};
  CHECK(clock_at(play, clip, 0.25).time == 0.75);
  CHECK(clock_at(play, clip, 0.75).time == 0.75);
  CHECK(clock_at(play, clip, 0.5, Side::in).time == 1);
  CHECK(end_time(play, clip) == 1);
  // "step" is at 0.6, "loud" from 0.8 to 1.3.
  std::string said;
  for (const FiredEvent& event : events_between(play, clip, 0, 3, true)) said += event.name + " ";
  CHECK(said == "step loud loud step loud loud ");
  play.reverse = true;
  CHECK(clock_at(play, clip, 0.25).time == 0.75);
  CHECK(clock_at(play, clip, 0.125).time == 0.875);
  CHECK(clock_at(play, clip, 0.125).rate == -1);
  CHECK(clock_at(play, clip, 0.125).side == Side::in);
}

TEST_CASE("what is wrong with a play is listed") {
  const Clip clip = clip_with_events(2);
  Play play{.at = std::numeric_limits<double>::infinity()};
  play.from = -1;
  play.to = 3;
  play.offset = -1;
  play.fade_in = {-1};
  CHECK(problems_of(play, clip).size() == 5);
  CHECK_THROWS_AS(Player(play, clip), std::invalid_argument);
  CHECK_THROWS_AS(PlaySpeed(Curve<double>(
                      [](double, Side) {
                        return Sample<double>{1, 0, 0};
                      },
                      0, std::numeric_limits<double>::infinity())),
                  std::invalid_argument);
}

TEST_CASE("fades multiply the weight from the start and to the end, with their rates") {
  const Clip clip{.name = "clip", .duration = 2};
  Play play{.at = 1, .weight = Curve<double>(0.5)};
  play.fade_in = {0.5};
  play.fade_out = {1};
  const Player player(play, clip);
  CHECK(player.weight(0.5).value == 0);
  CHECK(near(player.weight(1.25).value, 0.25, 1e-15));
  CHECK(near(player.weight(1.25).rate, 1, 1e-15));
  CHECK(player.weight(1.75).value == 0.5);
  CHECK(near(player.weight(2.5).value, 0.25, 1e-15));
  CHECK(near(player.weight(2.5).rate, -0.5, 1e-15));
  CHECK(player.weight(3).value == 0);
  CHECK(player.weight(9).value == 0);
}
