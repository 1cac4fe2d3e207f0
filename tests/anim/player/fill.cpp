// What a play shows before its start and after its end.

#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/keys.h>

#include <memory>
#include <optional>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double rest_height = 7, below_height = 3;

std::shared_ptr<const Hierarchy> one_ball() {
  Node ball{.name = "ball"};
  ball.rest.position = Vec3(0, rest_height, 0);
  ball.color = Color{Vec4(0, 0, 0, 1)};
  return std::make_shared<const Hierarchy>(std::vector{ball});
}

/// From 1 to 2 in one second.
Clip rising() {
  Clip clip{.name = "rising", .duration = 1};
  clip.tracks = {{"ball", "position.y",
                  keyed_curve<double>({{.time = 0, .value = 1, .ease = Ease::linear()}, {.time = 1, .value = 2}})}};
  clip.tracks.push_back({"ball", "color.r", clip.tracks[0].curve});
  return clip;
}
Clip still() {
  Clip clip{.name = "still", .duration = 100};
  clip.tracks = {{"ball", "position.y", Curve<double>(below_height)}, {"ball", "color.r", Curve<double>(below_height)}};
  return clip;
}

Animation animated(const Play& play, bool over_another) {
  std::vector<Play> plays{play};
  if (over_another) plays.insert(plays.begin(), Play{.clip = 1});
  return Animation(one_ball(), {rising(), still()}, plays);
}

double height(const Animation& animation, double time, Side side = Side::out) {
  const double node = animation.sample_node(0, time, side).pose.position.y();
  std::vector<Motion> whole(1);
  animation.sample(time, whole, side);
  CHECK(whole[0].pose.position.y() == node);
  return node;
}
/// Where no clip colors the ball, it has its own color.
double red(const Animation& animation, double time, Side side = Side::out) {
  const std::optional<Sample<Color>> color = animation.look(0, time, side).color;
  return color ? color->value.rgba[0] : animation.nodes()[0].color->rgba[0];
}

}  // namespace

TEST_CASE("a play shows its first frame before its start and its last after its end as its fill says, exactly there") {
  for (const bool over_another : {false, true})
    for (const Fill fill : {Fill::yielding, Fill::none, Fill::forwards, Fill::backwards, Fill::both}) {
      const Play play{.at = 2, .fill = fill};
      const Animation animation = animated(play, over_another);
      const double nothing = over_another ? below_height : rest_height, dark = over_another ? below_height : 0;
      const bool before = fill == Fill::backwards || fill == Fill::both || (fill == Fill::yielding && !over_another);
      const bool after = fill != Fill::none && fill != Fill::backwards;
      CAPTURE(static_cast<int>(fill));
      CAPTURE(over_another);
      for (const double time : {0.0, 1.5, std::nextafter(2.0, 0.0)}) {
        CHECK(height(animation, time) == (before ? 1 : nothing));
        CHECK(red(animation, time) == (before ? 1 : dark));
      }
      CHECK(height(animation, 2, Side::in) == (before ? 1 : nothing));
      CHECK(height(animation, 2) == 1);
      CHECK(height(animation, 2.25) == 1.25);
      CHECK(red(animation, 2.25) == 1.25);
      CHECK(height(animation, 3, Side::in) == 2);
      CHECK(animation.sample_node(0, 3, Side::in).twist.linear.y() == 1);
      for (const double time : {3.0, 3.5, 1e6}) {
        CHECK(height(animation, time) == (after ? 2 : nothing));
        CHECK(red(animation, time) == (after ? 2 : dark));
        CHECK(animation.sample_node(0, time).twist.linear.y() == 0);
      }
      const Player& player = animation.players().back();
      CHECK(player.is_gone(3) == !after);
      CHECK_FALSE(player.is_gone(3, Side::in));
      CHECK_FALSE(player.is_gone(1));
      CHECK(player.weight(3.5).value == (after ? 1 : 0));
      CHECK(player.weight(1).value == (before || fill == Fill::yielding ? 1 : 0));
    }
}

TEST_CASE("what a play fills is what it is held on: backwards, in sections, in rounds and at a standstill") {
  Play back{.at = 1, .speed = -2, .fill = Fill::both};
  CHECK(height(animated(back, true), 0) == 2);
  CHECK(height(animated(back, true), 1.25) == 1.5);
  CHECK(height(animated(back, true), 1.5) == 1);
  back.fill = Fill::forwards;
  CHECK(height(animated(back, true), 0.5) == below_height);
  CHECK(height(animated(back, true), 9) == 1);
  back.fill = Fill::backwards;
  CHECK(height(animated(back, true), 0.5) == 2);
  CHECK(height(animated(back, true), 1.5, Side::in) == 1);
  CHECK(height(animated(back, true), 1.5) == below_height);

  Play part{
      .at = 1, .from = 0.25, .to = 0.75, .offset = 0.125, .loop = Loop{LoopMode::pingpong, 1.5}, .fill = Fill::both};
  CHECK(height(animated(part, true), 0) == 1.375);
  CHECK(height(animated(part, true), 9) == 1.5);
  part.fill = Fill::none;
  CHECK(height(animated(part, true), 1) == 1.375);
  CHECK(height(animated(part, true), 1.625, Side::in) == 1.5);
  CHECK(height(animated(part, true), 1.625) == below_height);

  const Animation stands = animated({.at = 1, .speed = 0, .fill = Fill::none}, true);
  CHECK(height(stands, 0.5) == below_height);
  for (const double time : {1.0, 5.0, 1e9}) CHECK(height(stands, time) == 1);
}

TEST_CASE("a play that is over and shows nothing goes on where it is sought back, and fades in over what is below") {
  const Animation over = animated({.fill = Fill::none}, true);
  const Animation again = over.with_change({.time = 2, .play = "rising", .action = playing::Seek{0.5}});
  CHECK(height(again, 1.5) == below_height);
  CHECK(height(again, 2, Side::in) == below_height);
  CHECK(height(again, 2) == 1.5);
  CHECK(height(again, 2.5, Side::in) == 2);
  CHECK(height(again, 2.5) == below_height);
  const Animation faded = over.with_change({.time = 2, .play = "rising", .action = playing::Seek{0.5, false, 0.25}});
  CHECK(height(faded, 2) == below_height);
  CHECK(near(height(faded, 2.125), (below_height + 1.625) / 2, 1e-15));
  CHECK(height(faded, 2.375) == 1.875);
  // What is left in the middle of its way runs on, and stays on its last frame until it has faded.
  const Animation left = animated({.fill = Fill::none}, true)
                             .with_change({.time = 0.75, .play = "rising", .action = playing::Seek{0, false, 0.5}});
  CHECK(near(height(left, 1), (2 + 1.25) / 2, 1e-15));
  CHECK(near(height(left, 1, Side::in), (2 + 1.25) / 2, 1e-15));
  for (double time = 0.75; time < 1.5; time += 0.01)
    CHECK(std::abs(height(left, time + 0.01) - height(left, time)) < 0.05);
  // A weight that is asked for before the start goes on from where it would be.
  const Animation early =
      animated({.at = 2, .fill = Fill::none}, true)
          .with_change({.time = 1, .play = "rising", .action = playing::FadeTo{0.5, 2, Ease::linear()}});
  CHECK(height(early, 1.75) == below_height);
  CHECK(near(height(early, 2), 0.25 * below_height + 0.75 * 1, 1e-15));
}

TEST_CASE("events of a play are the same, whatever it fills") {
  Clip clip = rising();
  clip.events = {{.from = 0, .to = 0, .name = "first", .data = {}},
                 {.from = 0.5, .to = 1, .name = "long", .data = {}},
                 {.from = 1, .to = 1, .name = "last", .data = {}}};
  for (const Fill fill : {Fill::yielding, Fill::none, Fill::forwards, Fill::backwards, Fill::both}) {
    std::string told;
    for (const FiredEvent& event : Player({.at = 2, .fill = fill}, clip).events_between(clip, 0, 9, true))
      told += event.name + " ";
    CHECK(told == "first long long last ");
  }
}

TEST_CASE("before it starts, a play that runs backwards shows what it starts with, however often it loops") {
  Clip clip{.name = "clip", .duration = 2};
  clip.tracks = {{"node", "height",
                  keyed_curve<double>({{.time = 0, .value = 5.0, .ease = Ease::linear()}, {.time = 2, .value = 9.0}})}};
  for (const LoopMode mode : {LoopMode::once, LoopMode::repeat, LoopMode::repeat_offset, LoopMode::pingpong})
    for (const double offset : {0.0, 0.5, 2.0})
      for (const double count : {0.0, 3.0, 3.5}) {
        if (mode == LoopMode::once && (count > 0 || offset > 1)) continue;
        CAPTURE(static_cast<int>(mode));
        CAPTURE(offset);
        CAPTURE(count);
        Play play{.clip = 0, .at = 1, .speed = -1};
        play.offset = offset;
        play.loop = Loop{mode, count};
        const ClipClock before = clock_at(play, clip, 0.25, Side::out), starts = clock_at(play, clip, 1, Side::out);
        CHECK(before.time == starts.time);
        CHECK(before.cycle == starts.cycle);
      }
}
