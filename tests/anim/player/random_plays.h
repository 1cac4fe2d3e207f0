#pragma once

#include "support.h"

#include <tweenfall/anim/player.h>
#include <tweenfall/curves/keys.h>

#include <cstdio>
#include <limits>

namespace tweenfall::test {

inline Clip clip_with_events(double duration, Loop loop = {}) {
  Clip clip{.name = "walk", .duration = duration, .loop = loop};
  clip.events = {{.from = 0, .to = 0, .name = "start", .data = {}},
                 {.from = 0.3 * duration, .to = 0.3 * duration, .name = "step", .data = {}},
                 {.from = 0.4 * duration, .to = 0.65 * duration, .name = "loud", .data = {}},
                 {.from = 0.6 * duration, .to = duration, .name = "late", .data = {}},
                 {.from = duration, .to = duration, .name = "end", .data = {}}};
  return clip;
}

inline std::vector<PlayKey> random_speed(Random& random) {
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

inline Play random_play(Random& random, const Clip& clip) {
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

/// A player that was asked for random changes.
inline Player random_player(Random& random, const Clip& clip) {
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

/// Asked for anything at a time.
inline Player randomly_changed(Random& random, const Player& player, const Clip& clip, double time) {
  const double from = player.play().from, to = player.play().to.value_or(clip.duration);
  switch (random.bits() % 8) {
    case 0:
      return player.changed(clip, time, playing::Start{});
    case 1:
      return player.changed(clip, time, playing::Stop{.seconds = random.bits() % 2 ? 0.3 : 0});
    case 2:
      return player.changed(clip, time, playing::FadeTo{.weight = random.between(0, 1), .seconds = 0.4});
    case 3:
      return player.changed(clip, time, playing::Weigh{{{0, random.between(0, 1)}}});
    case 4:
      return player.changed(clip, time, playing::SetSpeed{.speed = random_speed(random)});
    case 5:
      return player.changed(clip, time, playing::SetSpeed{.speed = {{0, random.between(-2, 2)}}, .seconds = 0.5});
    default:
      const double wanted = random.between(from, to);
      return player.changed(clip, time, playing::Seek{.time = wanted, .events = random.bits() % 2 == 0});
  }
}

inline std::string all_told(const std::vector<FiredEvent>& events) {
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

}  // namespace tweenfall::test
