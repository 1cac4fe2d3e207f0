#include "anim/moving_pose.h"
#include "anim/player/random_plays.h"

#include <tweenfall/anim/animation.h>

#include <stdexcept>

using namespace tweenfall;
using namespace tweenfall::test;

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

TEST_CASE("a weight that a play is asked to take is from 0 to 1, at each of its keys") {
  const Clip clip{.name = "clip", .duration = 2};
  for (const double weight : {1e308, 1.01, -0.01}) {
    CHECK_THROWS_AS((void)Player(Play{}, clip).changed(clip, 1, playing::Weigh{{{0, 1}, {1, weight}}}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)play_of(playing::Start{.weight = {{0, weight}}}, 0), std::invalid_argument);
  }
  CHECK(Player(Play{}, clip).changed(clip, 1, playing::Weigh{{{0, 0.5}}}).weight(1).value == 0.5);
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
  // What was over continues.
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

TEST_CASE("a play is changed after more rounds than can be told apart") {
  Clip clip{.name = "clip", .duration = 2, .loop = {LoopMode::repeat, 0}};
  clip.events = {{.from = 0.5, .to = 1.5, .name = "span"}, {.from = 1, .to = 1, .name = "mark"}};
  for (const double time : {1e15, 1e17, 3.5e38, 1e300}) {
    const Player player(Play{}, clip);
    const Player stopped = player.changed(clip, time, playing::Stop{.seconds = 0.5});
    CHECK(stopped.is_gone(2 * time));
    const Player sought = player.changed(clip, time, playing::Seek{.time = 1.2, .events = true});
    CHECK(sought.clock(time).time >= 0);
    CHECK(sought.clock(time).time <= 2);
    CHECK(sought.events_between(clip, time, time, true).size() < 8);
  }
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
