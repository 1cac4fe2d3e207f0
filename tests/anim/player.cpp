#include "anim/moving_pose.h"
#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/player.h>
#include <tweenfall/curves/keys.h>

#include <algorithm>
#include <limits>
#include <map>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Clip clip_with_events(double duration, Loop loop = {}) {
  Clip clip{.name = "walk", .duration = duration, .loop = loop};
  clip.events = {{.from = 0, .to = 0, .name = "start", .data = {}},
                 {.from = 0.3 * duration, .to = 0.3 * duration, .name = "step", .data = {}},
                 {.from = 0.4 * duration, .to = 0.65 * duration, .name = "loud", .data = {}},
                 {.from = 0.6 * duration, .to = duration, .name = "late", .data = {}},
                 {.from = duration, .to = duration, .name = "end", .data = {}}};
  return clip;
}

std::vector<PlayKey> random_speed(Random& random) {
  std::vector<PlayKey> keys;
  double time = random.between(0, 0.5);
  const int count = 2 + static_cast<int>(random.bits() % 4);
  for (int i = 0; i < count; ++i) {
    double speed = random.between(-2, 2.5);
    if (random.bits() % 4 == 0) speed = 0;
    const Ease eases[] = {Ease::linear(), Ease::hold(), Ease::smooth(), Ease::smooth_clamped()};
    keys.push_back({time, speed, eases[random.bits() % 4]});
    time += random.between(0.1, 2);
  }
  return keys;
}

Play random_play(Random& random, const Clip& clip) {
  Play play;
  play.at = random.bits() % 2 ? 0 : random.between(0, 2);
  if (random.bits() % 3) {
    play.speed = PlaySpeed(curve_of(random_speed(random)));
  } else {
    play.speed = random.between(-2, 2);
  }
  if (random.bits() % 2) {
    play.from = random.between(0, 0.5) * clip.duration;
    play.to = play.from + random.between(0.2, 0.5) * clip.duration;
  }
  if (random.bits() % 3 == 0) play.offset = random.between(0, clip.duration);
  play.reverse = random.bits() % 3 == 0;
  const LoopMode modes[] = {LoopMode::once, LoopMode::repeat, LoopMode::repeat_offset, LoopMode::pingpong};
  const double count = random.bits() % 3 == 0 ? 0 : random.bits() % 2 ? 2 : random.between(0.5, 4);
  play.loop = Loop{modes[random.bits() % 4], count};
  return play;
}

/// A player that was asked for this and that.
Player random_player(Random& random, const Clip& clip) {
  Player player(random_play(random, clip), clip);
  double time = 0;
  for (std::uint64_t left = random.bits() % 4; left > 0; --left) {
    time += random.between(0, 3);
    const double from = player.play().from, to = player.play().to.value_or(clip.duration);
    switch (random.bits() % 5) {
      case 0:
        player = player.changed(clip, time, playing::SetSpeed{.speed = random_speed(random)});
        break;
      case 1:
        player = player.changed(clip, time, playing::SetSpeed{.speed = {{0, random.between(-2, 2)}}, .seconds = 0.5});
        break;
      case 2: {
        const double wanted = random.between(from, to);
        player = player.changed(clip, time, playing::Seek{.time = wanted, .events = random.bits() % 2 == 0});
        break;
      }
      case 3:
        player = player.changed(clip, time, playing::Start{});
        break;
      default:
        player = player.changed(clip, time, playing::Stop{.seconds = random.bits() % 2 ? 0.4 : 0});
    }
  }
  return player;
}

std::string all_told(const std::vector<FiredEvent>& events) {
  std::string text;
  for (const FiredEvent& event : events) {
    char number[40];
    std::snprintf(number, sizeof number, "%.17g:", event.time);
    text += number + event.name;
    if (event.kind == FiredEvent::Kind::begin) text += "(";
    if (event.kind == FiredEvent::Kind::end) text += ")";
    text += '\n';
  }
  return text;
}

/// Order within one time aside, which the pieces keep too.
std::vector<FiredEvent> in_pieces(const Player& player, const Clip& clip, const std::vector<double>& cuts) {
  std::vector<FiredEvent> all;
  double from = 0;
  bool first = true;
  for (const double to : cuts) {
    const std::vector<FiredEvent> piece = player.events_between(clip, from, to, first);
    all.insert(all.end(), piece.begin(), piece.end());
    from = to;
    first = false;
  }
  return all;
}

}  // namespace

TEST_CASE("progress and iteration are those of CSS timing") {
  std::size_t checked = 0;
  for (const nlohmann::json& family : vector_family("css_timing"))
    for (const nlohmann::json& each : family.at("cases")) {
      const nlohmann::json& input = each.at("input");
      const double duration = input.at("duration"), start = input.at("iterationStart");
      const bool endless = input.at("iterations").is_string();
      const double iterations = endless ? 0 : input.at("iterations").get<double>();
      if (!endless && iterations == 0) continue;  // a play has at least something to play
      const std::string direction = input.at("direction"), easing = input.at("easing");
      const bool alternates = direction.find("alternate") == 0;
      Clip clip{.name = "progress", .duration = duration};
      Play play{.at = input.at("delay")};
      play.offset = start * duration;
      play.reverse = direction.find("reverse") != std::string::npos;
      play.loop = Loop{alternates ? LoopMode::pingpong : LoopMode::repeat, endless ? 0 : start + iterations};
      const Ease ease = easing == "linear" ? Ease::linear() : Ease::named(easing).value();
      const Player player(play, clip);
      CAPTURE(each.at("name").get<std::string>());
      if (!endless) CHECK(near(player.end() - play.at, each.at("active_duration").get<double>(), 1e-9));
      for (std::size_t i = 0; i < each.at("t").size(); ++i) {
        if (each.at("progress")[i].is_null()) continue;
        const double time = each.at("t")[i], progress = each.at("progress")[i];
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
        CAPTURE(time);
        CHECK(right);
        ++checked;
      }
    }
  CHECK(checked > 0);
}

TEST_CASE("times and weights are those of three.js's mixer, fades, loops and time scales") {
  std::size_t times = 0, weights = 0;
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
        bool warped = false;
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
            if (op[5].get<bool>()) warped = true;
            if (who == action) late.push_back({now, playing::FadeTo{0, seconds, Ease::linear()}});
            if (other == action) late.push_back({now, playing::Weigh{{{0, 0, Ease::linear()}, {seconds, 1}}}});
            continue;
          }
          if (who != action) continue;
          if (what == "weight") play.weight = Curve<double>(std::min(1.0, op[3].get<double>()));
          if (what == "timeScale") play.speed = op[3].get<double>();
          if (what == "time") seek = op[3];
          if (what == "halt") warped = true;
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
        if (play.weight.value(0) == 1 && input.dump().find("1.0364") != std::string::npos) continue;  // above 1
        Player player(play, clip);
        for (const Late& change : late) player = player.changed(clip, change.time, change.action);
        for (std::size_t i = 0; i < each.at("value").size(); ++i) {
          const auto& frame = each.at("value")[i];
          const double now = at[i + 1];
          const bool over = now > player.end() - 1e-3;
          CAPTURE(now);
          CAPTURE(action);
          // What has faded out stands still there.
          if (!warped && !over && frame.at("weight")[action] != 0) {
            const double said = frame.at("time")[action];
            ClipClock clock = player.clock(now);
            double mine = clock.time;
            // Theirs runs forward on each way of a ping-pong.
            if (play.loop && play.loop->mode == LoopMode::pingpong && clock.cycle % 2 == 1) mine = duration - mine;
            const double apart = std::abs(mine - said);
            CHECK(std::min(apart, std::abs(duration - apart)) < 2e-5 * std::max(1.0, now));
            ++times;
          }
          if (!over && frame.contains("weight")) {
            CHECK(near(player.weight(now, Side::in).value, frame.at("weight")[action].get<double>(), 2e-5));
            ++weights;
          }
        }
      }
    }
  CHECK(times > 0);
  CHECK(weights > 0);
}

TEST_CASE("clip time is the integral of the speed's keys, and its rate the speed itself") {
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    const std::vector<PlayKey> keys = random_speed(random);
    const Curve<double> speed = curve_of(keys);
    Clip clip{.name = "endless", .duration = infinity};
    Play play{.at = 1, .speed = PlaySpeed(speed)};
    const Player player(play, clip);
    double way = 0;
    const double start = player.clock(1).time;
    constexpr int steps = 4000;
    const double dt = 4.0 / steps;
    for (int k = 0; k < steps; ++k) {
      const double own = k * dt;
      // Simpson within pieces; where a key jumps inside one, that costs its width.
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

TEST_CASE("however time is cut, at events and one ulp beside them too, the same events fire, and intervals in pairs") {
  Random random(5);
  std::size_t fired = 0;
  for (int i = 0; i < 1500; ++i) {
    CAPTURE(i);
    const Clip clip = clip_with_events(random.bits() % 2 ? 1.0 : random.between(0.3, 2));
    const Player player = random_player(random, clip);
    const std::vector<FiredEvent> whole = player.events_between(clip, 0, 12, true);
    fired += whole.size();
    CHECK(std::ranges::is_sorted(whole, {}, &FiredEvent::time));
    std::vector<double> cuts{12};
    for (int k = 0; k < 6; ++k) cuts.push_back(random.between(0, 12));
    for (const FiredEvent& event : whole)
      for (const double time :
           {event.time, std::nextafter(event.time, -infinity), std::nextafter(event.time, infinity)})
        if (random.bits() % 2 && time > 0 && time < 12) cuts.push_back(time);
    std::ranges::sort(cuts);
    CHECK(all_told(in_pieces(player, clip, cuts)) == all_told(whole));
    std::map<std::string, bool> open;
    for (const FiredEvent& event : whole) {
      if (event.kind == FiredEvent::Kind::moment) continue;
      const bool begins = event.kind == FiredEvent::Kind::begin;
      CAPTURE(event.name);
      CAPTURE(event.time);
      CHECK(open[event.name] != begins);
      open[event.name] = begins;
    }
    if (player.end() < 12) {
      for (const auto& [name, is_open] : open) CHECK_FALSE(is_open);
    }
  }
  CHECK(fired > 3000);
}

TEST_CASE("an event fires as often as the clock passes it, and then it is there") {
  Random random(17);
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    Clip clip{.name = "walk", .duration = 1};
    const double mark = random.between(0.05, 0.95);
    clip.events = {{.from = mark, .to = mark, .name = "mark", .data = {}}};
    Play play = random_play(random, clip);
    play.loop = Loop{random.bits() % 2 ? LoopMode::once : LoopMode::pingpong, 3};
    play.from = 0;
    play.to.reset();
    play.offset = 0;
    const Player player(play, clip);
    const std::vector<FiredEvent> fired = player.events_between(clip, 0, 8, true);
    for (const FiredEvent& event : fired) CHECK(near(player.clock(event.time).time, mark, 1e-9));
    int passed = 0;
    bool close = false;
    double before = player.clock(0).time - mark;
    for (double t = 1e-3; t <= 8; t += 1e-3) {
      const double now = player.clock(t).time - mark;
      if (before * now < 0) ++passed;
      // Where it turns just there, the steps are too wide to tell.
      close = close || (std::abs(now) < 2e-3 && std::abs(player.clock(t).rate) < 0.3);
      before = now;
    }
    if (!close) CHECK(static_cast<int>(fired.size()) == passed);
  }
}

TEST_CASE("at speed 0 nothing fires, and what a clock stands on fires when it begins to move") {
  const Clip clip = clip_with_events(2);
  CHECK(events_between({.speed = 0}, clip, 0, 100, true).empty());
  const PlayKeys waits{{0, 0, Ease::hold()}, {3, 1}};
  CHECK(all_told(events_between({.speed = PlaySpeed(curve_of(waits))}, clip, 0, 3.2, true)) == "3:start\n");
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
  Play play{.at = infinity};
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
                      0, infinity)),
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

TEST_CASE("asked for another speed, a clock goes on from where it is; the time before stays as it was") {
  const Clip clip = clip_with_events(2, {LoopMode::repeat, 0});
  const Player slow(Play{}, clip);
  const Player fast = slow.changed(clip, 1.3, playing::SetSpeed{.speed = {{0, 3}}});
  const Player ramp = fast.changed(clip, 4, playing::SetSpeed{.speed = {{0, 0}}, .seconds = 2});
  CHECK(fast.clock(1.3, Side::in).time == fast.clock(1.3).time);
  CHECK(fast.clock(1.3, Side::in).rate == 1);
  CHECK(fast.clock(1.3).rate == 3);
  CHECK(near(fast.clock(1.5).time, 1.9, 1e-14));
  CHECK(ramp.clock(4).rate == 3);
  CHECK(near(ramp.clock(5).rate, 1.5, 1e-14));
  CHECK(ramp.clock(7).rate == 0);
  for (const double time : {0.0, 0.9, 1.2999}) {
    CHECK(ramp.clock(time).time == slow.clock(time).time);
    CHECK(ramp.clock(time).rate == slow.clock(time).rate);
  }
  for (const double time : {1.3, 2.0, 3.9}) CHECK(ramp.clock(time).time == fast.clock(time).time);
}

TEST_CASE("a fade that says no ease keeps the weight's rate, stays within 0 and 1 and comes to rest") {
  const Clip clip{.name = "clip", .duration = 100};
  Play play;
  play.fade_in = {1};
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const double when = random.between(0, 1), to = random.unit(), seconds = random.between(0.05, 3);
    const Player fading = Player(play, clip).changed(clip, when, playing::FadeTo{.weight = to, .seconds = seconds});
    CHECK(near(fading.weight(when).value, when, 1e-15));
    const double rate = fading.weight(when).rate;
    CHECK(rate >= 0);
    CHECK(rate <= 1);
    bool overshoots = false;
    for (double u = 0; u <= 1; u += 1e-3) {
      const double value = fading.weight(when + u * seconds).value;
      CHECK(value >= -1e-12);
      CHECK(value <= 1 + 1e-12);
      const double plain = (2 * u * u * u - 3 * u * u + 1) * when + (u * u * u - 2 * u * u + u) * seconds +
                           (3 * u * u - 2 * u * u * u) * to;
      overshoots = overshoots || plain > 1 - 1e-4;
    }
    if (!overshoots) CHECK(near(rate, 1, 1e-12));
    CHECK(near(fading.weight(when + seconds).value, to, 1e-14));
    CHECK(near(fading.weight(when + seconds, Side::in).rate, 0, 1e-12));
  }
}

TEST_CASE("what was stopped has no say and ends what was open, and may start again") {
  const Clip clip = clip_with_events(2, {LoopMode::repeat, 0});
  Player player(Play{}, clip);
  player = player.changed(clip, 0.9, playing::Stop{});
  CHECK(player.weight(0.9).value == 0);
  CHECK(player.weight(0.9, Side::in).value == 1);
  CHECK(player.end() == 0.9);
  CHECK(all_told(player.events_between(clip, 0.7, 5)) == "0.80000000000000004:loud(\n0.90000000000000002:loud)\n");
  player = player.changed(clip, 3, playing::Start{});
  CHECK(player.clock(3.25).time == 0.25);
  CHECK(player.weight(3.25).value == 1);
  CHECK(player.weight(2).value == 0);
  CHECK(all_told(player.events_between(clip, 2, 3)) == "3:start\n");
  CHECK(all_told(player.events_of_change(clip)) == "3:start\n");
}

TEST_CASE("a seek fires what lies between only if asked, but leaves and enters intervals in any case") {
  const Clip clip = clip_with_events(2);
  const Player before(Play{}, clip);
  const auto sought = [&](double to, bool events) {
    std::string names;
    for (const FiredEvent& event : before.changed(clip, 0.25, playing::Seek{to, events}).events_between(clip, 0.2, 0.3))
      names += event.name + (event.kind == FiredEvent::Kind::begin ? "( "
                             : event.kind == FiredEvent::Kind::end ? ") "
                                                                   : " ");
    return names;
  };
  CHECK(sought(0.7, false) == "");
  CHECK(sought(0.7, true) == "step ");
  CHECK(sought(1, false) == "loud( ");
  CHECK(sought(0.1, true) == "");
  CHECK(before.changed(clip, 0.25, playing::Seek{0.7}).clock(0.35).time == doctest::Approx(0.8));
  CHECK_THROWS_AS(static_cast<void>(before.changed(clip, 0.25, playing::Seek{2.5})), std::invalid_argument);
  // What was over goes on.
  CHECK_FALSE(before.changed(clip, 5, playing::Seek{1}).clock(5.5).ended);
}

TEST_CASE("a seek that fades goes on without a jump in place or velocity, interrupted too, and ends as a plain one") {
  const auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{{"ball"}});
  const auto course = [](const char* name, double pace) {
    return Clip{
        .name = name,
        .duration = 10,
        .tracks = {
            {"ball", "position",
             Curve<Vec3>(
                 [pace](double t, Side) {
                   return Sample<Vec3>{{std::sin(pace * t), 0.1 * t, 0}, {pace * std::cos(pace * t), 0.1, 0}, {}};
                 },
                 0, 10)}}};
  };
  Play over{.clip = 1};
  for (const double weight : {1.0, 0.6, 0.0}) {
    over.weight = Curve<double>(weight);
    const Animation plain(nodes, {course("below", 1), course("over", 2.3)}, {Play{}, over});
    const PlayChange first{1.3, "over", playing::Seek{.time = 5, .fade = 0.5}};
    const PlayChange second{1.5, "over", playing::Seek{.time = 2.2, .fade = 0.4}};
    const Animation fading = plain.with_change(first), again = fading.with_change(second);
    const Animation jumping = plain.with_change({1.3, "over", playing::Seek{.time = 5}});
    const auto at = [](const Animation& animation, double time, Side side = Side::out) {
      return animation.sample_node(0, time, side);
    };
    for (const Animation* each : {&fading, &again})
      for (const double time : {1.3, 1.5, 1.8, 1.9}) {
        CHECK(near(at(*each, time, Side::in), at(*each, time), 1e-12));
        CHECK(near(at(*each, time).pose.position, at(*each, time - 1e-7).pose.position, 1e-6));
      }
    for (double time = 1.21; time < 2.1; time += 0.0437) {
      const double h = 1e-5;
      const Vec3 slope = (at(again, time + h).pose.position - at(again, time - h).pose.position) / (2 * h);
      CHECK(near(at(again, time).twist.linear, slope, 1e-7));
    }
    for (const double time : {0.4, 1.2999, 1.8, 2.5}) CHECK(near(at(fading, time), at(jumping, time), 0));
    // Half way through the fade, half of each: sin is that of a pace of 2.3, from 1.55 s and from 5.25 s.
    const double there = 0.5 * std::sin(2.3 * 1.55) + 0.5 * std::sin(2.3 * 5.25);
    CHECK(near(at(fading, 1.55).pose.position.x(), (1 - weight) * std::sin(1.55) + weight * there, 1e-12));
  }
}

TEST_CASE("ten thousand changes are found again at any time, and leave no stack behind") {
  const Clip clip = clip_with_events(2, {LoopMode::repeat, 0});
  Player player(Play{}, clip);
  for (int i = 1; i <= 100'000; ++i)
    player = player.changed(clip, i * 1e-3, playing::SetSpeed{.speed = {{0, i % 2 ? 2.0 : 1.0}}});
  CHECK(player.clock(100).started);
  CHECK(near(player.clock(0.0005).time, 0.0005, 1e-15));
  player = Player(Play{}, clip);
}

TEST_CASE("a play by name is changed in an animation, unknown names are told with the nearest") {
  auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{{"box"}});
  Clip low{.name = "low", .duration = 1}, high{.name = "high", .duration = 1};
  low.tracks = {{"box", "position", Curve<Vec3>(Vec3(1, 0, 0))}};
  high.tracks = {{"box", "position", Curve<Vec3>(Vec3(5, 0, 0))}};
  const Animation first(nodes, {low, high}, {Play{.clip = 0}});
  const Animation started = first.with_change({1, "high", playing::Start{.fade_in = {1}}});
  CHECK(started.players().size() == 2);
  CHECK(started.sample_node(0, 0.5).pose.position.x() == 1);
  CHECK(started.sample_node(0, 1.5).pose.position.x() == 3);
  CHECK(near(started.sample_node(0, 1.5).twist.linear.x(), 4, 1e-15));
  const Animation stopped = started.with_change({3, "high", playing::Stop{}});
  CHECK(stopped.sample_node(0, 2.5).pose.position.x() == 5);
  CHECK(stopped.sample_node(0, 3.5).pose.position.x() == 1);
  CHECK_THROWS_WITH_AS(static_cast<void>(first.with_change({1, "lo", playing::Stop{}})),
                       "there is no play \"lo\"; did you mean \"low\"?", std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(first.with_change({1, "x", playing::Start{.clip = "hihg"}})),
                       "there is no clip \"hihg\"; did you mean \"high\"?", std::invalid_argument);
}
