#include "anim/player/random_plays.h"

#include <algorithm>
#include <map>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Ignores the order within one time, which the pieces keep too.
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
      for (const double time : {event.time, std::nextafter(event.time, -std::numeric_limits<double>::infinity()),
                                std::nextafter(event.time, std::numeric_limits<double>::infinity())})
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

TEST_CASE("whatever is asked of a play, at one instant, before its start and after its end, intervals stay in pairs") {
  Random random(31);
  for (int i = 0; i < 1500; ++i) {
    CAPTURE(i);
    const Clip clip = clip_with_events(random.between(0.3, 2));
    Play play = random_play(random, clip);
    play.at = random.bits() % 2 ? 0 : 1.5;
    Player player(play, clip);
    double time = 0;
    for (int asked = 0; asked < 8; ++asked) {
      if (random.bits() % 2) time += random.between(0, random.bits() % 3 ? 1.5 : 9);
      player = randomly_changed(random, player, clip, time);
    }
    std::map<std::string, bool> open;
    const std::vector<FiredEvent> whole = player.events_between(clip, 0, 30, true);
    CAPTURE(all_told(whole));
    for (const FiredEvent& event : whole) {
      if (event.kind == FiredEvent::Kind::moment) continue;
      const bool begins = event.kind == FiredEvent::Kind::begin;
      CAPTURE(event.name);
      CAPTURE(event.time);
      REQUIRE(open[event.name] != begins);
      open[event.name] = begins;
    }
    if (player.end() < 30) {
      for (const auto& [name, is_open] : open) REQUIRE_FALSE(is_open);
    }
  }
}

TEST_CASE("a play that is started and changed at one instant fires what it starts on once") {
  const Clip clip = clip_with_events(2);
  const Player begun =
      Player({.at = 1}, clip).changed(clip, 1, playing::FadeTo{.weight = 0.5}).changed(clip, 1, playing::SetSpeed{});
  CHECK(all_told(begun.events_between(clip, 0, 1.1, true)) == "1:start\n");
  const Player again = begun.changed(clip, 2.3, playing::Start{}).changed(clip, 2.3, playing::Weigh{});
  CHECK(all_told(again.events_between(clip, 2.2, 2.4)) ==
        "2.3000000000000003:loud)\n2.3000000000000003:late)\n2.3000000000000003:start\n");
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
      // If it turns exactly there, the steps are too wide to decide.
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

TEST_CASE("a seek that is asked for events tells each that lies between once, with what the play stands on") {
  Clip clip{.name = "walk", .duration = 1};
  clip.events = {{.from = 0, .to = 0, .name = "start", .data = {}}, {.from = 1, .to = 1, .name = "end", .data = {}}};
  const auto sought = [&](const Play& play, double time, double to) {
    const Player player = Player(play, clip).changed(clip, time, playing::Seek{.time = to, .events = true});
    return all_told(player.events_between(clip, 0, time + 0.1, true));
  };
  const Play there_and_back{.loop = Loop{LoopMode::pingpong, 0}};
  CHECK(sought(there_and_back, 0.5, 1) == "0:start\n0.5:end\n");
  CHECK(sought(there_and_back, 1.5, 1) == "0:start\n1:end\n1.5:end\n");
  CHECK(sought(there_and_back, 1.5, 0) == "0:start\n1:end\n1.5:start\n");
  // Before it has moved: where it starts belongs to its path, and where it arrives does not fire again.
  CHECK(sought({}, 0, 1) == "0:start\n0:end\n");
  CHECK(sought({.speed = -1}, 0, 0) == "0:end\n0:start\n");
  CHECK(sought({.at = 2}, 0.5, 1) == "0.5:start\n0.5:end\n");
}

TEST_CASE("a seek that is asked for events meets them in the order of the way, and the intervals that it leaps over") {
  Clip clip{.name = "walk", .duration = 4};
  clip.events = {{.from = 0.5, .to = 2, .name = "left", .data = {}},
                 {.from = 1, .to = 1, .name = "step", .data = {}},
                 {.from = 2.25, .to = 2.75, .name = "heel", .data = {}},
                 {.from = 2.5, .to = 4, .name = "right", .data = {}}};
  const auto sought = [&](double from, double to, bool events) {
    const Play play{.from = 0, .offset = from};
    const Player player = Player(play, clip).changed(clip, 0.125, playing::Seek{.time = to, .events = events});
    std::string names;
    for (const FiredEvent& event : player.events_between(clip, 0.0625, 0.125))
      names += event.name + (event.kind == FiredEvent::Kind::begin ? "( "
                             : event.kind == FiredEvent::Kind::end ? ") "
                                                                   : " ");
    return names;
  };
  CHECK(sought(0, 3, true) == "left( step left) heel( right( heel) ");
  CHECK(sought(0, 3, false) == "right( ");
  CHECK(sought(3, 0.25, true) == "heel( right) heel) left( step left) ");
  CHECK(sought(3, 0.75, true) == "heel( right) heel) left( step ");
  CHECK(sought(3, 0.75, false) == "right) left( ");
  // Onto the edges: what begins where it goes on has begun, and what ends there is over.
  CHECK(sought(0, 0.5, false) == "left( ");
  CHECK(sought(0, 0.5, true) == "left( ");
  CHECK(sought(0.625, 2, false) == "left) ");
  CHECK(sought(3, 2, true) == "heel( right) heel) ");
  CHECK(sought(0.625, 0.625, true) == "");
}

TEST_CASE("a seek where two rounds meet goes on in the one into which the clock runs") {
  Clip clip{.name = "walk", .duration = 1};
  clip.events = {{.from = 0.25, .to = 0.25, .name = "step", .data = {}}};
  const auto after = [&](LoopMode mode, double to, bool events) {
    const Play play{.speed = -1, .loop = Loop{mode, 3}};
    const Player player = Player(play, clip).changed(clip, 1, playing::Seek{.time = to, .events = events});
    CHECK(player.clock(1).cycle == 1);
    CHECK(player.clock(1).time == to);
    return all_told(player.events_between(clip, 0.875, 5)) + "end " + std::to_string(player.end());
  };
  CHECK(after(LoopMode::repeat, 0.5, false) == "1.25:step\n2.25:step\nend 2.500000");
  CHECK(after(LoopMode::repeat, 0.5, true) == "1.25:step\n2.25:step\nend 2.500000");
  CHECK(after(LoopMode::repeat, 0.125, true) == "1:step\n1.875:step\nend 2.125000");
  // From the end of the second round, which runs from 1 to 0, to 0.5 and on.
  CHECK(after(LoopMode::pingpong, 0.5, true) == "1:step\n2.25:step\nend 2.500000");
  const Player endless = Player({.speed = -1, .loop = Loop{LoopMode::repeat, 0}}, clip)
                             .changed(clip, 0, playing::Seek{.time = 0.5, .events = true});
  CHECK(all_told(endless.events_between(clip, 0, 1, true)) == "0.25:step\n");
}

TEST_CASE("what a play tells of an instant stays told when it is changed then, and what had begun ends") {
  Clip clip{.name = "walk", .duration = 2};
  clip.events = {{.from = 0, .to = 0, .name = "start", .data = {}},
                 {.from = 0.5, .to = 0.5, .name = "step", .data = {}},
                 {.from = 0.5, .to = 1, .name = "loud", .data = {}}};
  const Player player(Play{}, clip);
  const auto changed = [&](double time, const PlayAction& action) {
    return all_told(player.changed(clip, time, action).events_between(clip, 0, 2.25, true));
  };
  const std::string begun = "0:start\n0.5:step\n0.5:loud(\n";
  CHECK(changed(0.5, playing::Weigh{{{0, 0.5}}}) == begun + "1:loud)\n");
  CHECK(changed(0.5, playing::SetSpeed{{{0, 2}}}) == begun + "0.75:loud)\n");
  CHECK(changed(0.5, playing::SetSpeed{{{0, 0}}}) == begun + "0.5:loud)\n");
  CHECK(changed(0.5, playing::SetSpeed{{{0, -1}}}) == begun + "0.5:loud)\n1:start\n");
  CHECK(changed(0.5, playing::Seek{1.5}) == begun + "0.5:loud)\n");
  CHECK(changed(0.5, playing::Stop{}) == begun + "0.5:loud)\n");
  CHECK(changed(0, playing::Seek{0.5}) == "0:start\n0:loud(\n0.5:loud)\n");
  CHECK(changed(0, playing::Stop{}) == "0:start\n");
}

TEST_CASE("a change at the very time of an event, as it rounds, neither loses nor repeats one") {
  Random random(47);
  std::size_t asked = 0;
  for (int i = 0; i < 3000; ++i) {
    CAPTURE(i);
    const Clip clip = clip_with_events(random.between(0.3, 2), Loop{LoopMode::repeat, 0});
    const Play play{.at = random.between(0, 2), .speed = random.between(-3, 3), .offset = random.between(0, 40)};
    const Player player(play, clip);
    const std::vector<FiredEvent> whole = player.events_between(clip, 0, 8, true);
    if (whole.empty()) continue;
    const double time = whole[random.bits() % whole.size()].time;
    // As a stage tells them: until the change, at it, and on from there.
    const Player same = player.changed(clip, time, playing::SetSpeed{.speed = {{0, play.speed.at(0)}}});
    const std::size_t before = player.events_between(clip, 0, time, true).size();
    CHECK(same.events_between(clip, 0, time, true).size() == before);
    const std::vector<FiredEvent> after = same.events_between(clip, time, 8);
    REQUIRE(before + after.size() == whole.size());
    for (std::size_t k = 0; k < after.size(); ++k) {
      CHECK(after[k].name == whole[before + k].name);
      CHECK(near(after[k].time, whole[before + k].time, 1e-12));
    }
    ++asked;
  }
  CHECK(asked > 2000);
}

TEST_CASE("a play that is stopped fires nothing, neither by a seek nor where it would begin to move") {
  const Clip clip = clip_with_events(2);
  const Player resting = Player({.speed = 0}, clip).changed(clip, 1, playing::Stop{});
  CHECK(resting.changed(clip, 1, playing::SetSpeed{}).events_between(clip, 0, 9, true).empty());
  CHECK(resting.changed(clip, 3, playing::Seek{.time = 2, .events = true}).events_between(clip, 0, 9, true).empty());
  CHECK(Player({.at = 1}, clip).changed(clip, 0.5, playing::Stop{}).events_between(clip, 0, 9, true).empty());
}

TEST_CASE("what a resting play is sought onto does not fire as it moves off, unless the seek is asked for events") {
  Clip clip{.name = "walk", .duration = 2};
  clip.events = {{.from = 0, .to = 0, .name = "start", .data = {}},
                 {.from = 1, .to = 1, .name = "step", .data = {}},
                 {.from = 1, .to = 1.5, .name = "loud", .data = {}}};
  const auto told = [&](const Play& play, bool events, double again) {
    const Player sought = Player(play, clip).changed(clip, 0.5, playing::Seek{.time = 1, .events = events});
    const Player once_more = again < 0 ? sought : sought.changed(clip, 0.5, playing::Seek{again, true});
    return all_told(once_more.changed(clip, 1, playing::SetSpeed{}).events_between(clip, 0, 9, true));
  };
  CHECK(told({.speed = 0}, false, -1) == "1:loud(\n1.5:loud)\n");
  CHECK(told({.at = 1}, false, -1) == "1:loud(\n1.5:loud)\n");
  CHECK(told({.speed = 0}, true, -1) == "0.5:start\n0.5:step\n1:loud(\n1.5:loud)\n");
  CHECK(told({.speed = 0}, false, 1.75) == "0.5:loud(\n0.5:loud)\n");
  // A seek to where it stands already changes nothing: as it begins, its left end is closed.
  const Player waits = Player({.at = 1}, clip).changed(clip, 0.5, playing::Seek{.time = 0});
  CHECK(all_told(waits.events_between(clip, 0, 1.5)) == "1:start\n");
}

TEST_CASE("an interval that touches the turn of a ping-pong stays entered there, by running, resting and leaping") {
  Clip clip{.name = "swing", .duration = 1};
  clip.events = {{.from = 0, .to = 0.25, .name = "low", .data = {}},
                 {.from = 0.5, .to = 1, .name = "high", .data = {}},
                 {.from = 0, .to = 1, .name = "on", .data = {}}};
  const Play play{.loop = Loop{LoopMode::pingpong, 3}};
  CHECK(all_told(events_between(play, clip, 0, 9, true)) ==
        "0:low(\n0:on(\n0.25:low)\n0.5:high(\n1.5:high)\n1.75:low(\n2.25:low)\n2.5:high(\n3:high)\n3:on)\n");
  const Play back{.speed = -1, .loop = Loop{LoopMode::pingpong, 2.75}};
  CHECK(all_told(events_between(back, clip, 0, 9, true)) ==
        "0:on(\n0:high(\n0.25:high)\n0.5:low(\n1:low)\n1.25:high(\n2.25:high)\n2.5:low(\n2.75:low)\n2.75:on)\n");
  // In two steps that meet at the turn, and where a change stops it there, turns it, or moves it over the turn.
  CHECK(all_told(events_between(play, clip, 0.5, 1)).empty());
  CHECK(all_told(events_between(play, clip, 1, 1.5)) == "1.5:high)\n");
  const auto changed = [&](double time, const PlayAction& action, double to) {
    return all_told(Player(play, clip).changed(clip, time, action).events_between(clip, 0.75, to));
  };
  CHECK(changed(1, playing::SetSpeed{{{0, 0}}}, 9).empty());
  CHECK(changed(1, playing::SetSpeed{{{0, -1}}}, 1.75) == "1.5:high)\n1.75:low(\n");
  CHECK(changed(1, playing::Seek{0.625}, 1.25) == "1.125:high)\n");
  CHECK(changed(1.5, playing::Seek{.time = 0.75, .events = true}, 1.5) == "1.5:high)\n1.5:high(\n");
  CHECK(changed(2, playing::Seek{.time = 0.75, .events = true}, 2) == "1.5:high)\n1.75:low(\n2:low)\n2:high(\n");

  Random random(53);
  int looked_at = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    Play swings{.speed = random.between(0.3, 3), .offset = random.between(0, 3), .reverse = random.bits() % 2 == 0};
    if (random.bits() % 2) swings.speed = -swings.speed.at(0);
    swings.loop = Loop{LoopMode::pingpong, random.between(4, 12)};
    const Player player(swings, clip);
    const double t = random.between(0, player.end());
    std::map<std::string, bool> open;
    for (const FiredEvent& event : player.events_between(clip, 0, t, true)) {
      CHECK(open[event.name] != (event.kind == FiredEvent::Kind::begin));
      open[event.name] = event.kind == FiredEvent::Kind::begin;
    }
    const double place = player.clock(t).time;
    for (const ClipEvent& event : clip.events) {
      if (std::min(std::abs(place - event.from), std::abs(place - event.to)) < 1e-9) continue;
      CHECK(open[event.name] == (event.from < place && place < event.to));
      ++looked_at;
    }
  }
  CHECK(looked_at > 800);
}
