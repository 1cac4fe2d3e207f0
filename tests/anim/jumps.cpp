// Where clips jump: at keys, between them by formulas and modifiers, and where plays begin, loop and end.

#include "processor_time.h"
#include "support.h"

#include <tweenfall/anim/jump_search.h>
#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/modifiers.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double endless_clip = std::numeric_limits<double>::infinity();

Curve<double> formula_of(const std::string& text) {
  return expression_curve(Expression(text));
}

Clip clip_by(TrackCurve curve, const std::string& property, double duration) {
  Clip clip{.name = "clip", .duration = duration};
  clip.tracks.push_back({"ball", property, std::move(curve)});
  return clip;
}

std::vector<double> jumps_by(const std::string& text, double duration) {
  return jumps_of(clip_by(formula_of(text), "position.x", duration));
}

bool all_near(const std::vector<double>& found, const std::vector<double>& expected) {
  if (found.size() != expected.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!near(found[i], expected[i], 1e-12)) return false;
  return true;
}

std::shared_ptr<const Hierarchy> only_a_ball() {
  return std::make_shared<const Hierarchy>(std::vector<Node>{{"ball"}});
}

}  // namespace

TEST_CASE("the jumps of a clip's formulas are found, and no others") {
  CHECK(all_near(jumps_by("floor(4*t)", 1), {0.25, 0.5, 0.75, 1}));
  CHECK(all_near(jumps_by("100*t + step(0.3, t)", 1), {0.3}));
  CHECK(all_near(jumps_by("mod(t, 0.3)", 1), {0.3, 0.6, 0.9}));
  CHECK(all_near(jumps_by("sign(sin(10*t))*cos(t)", 1), {pi / 10, 2 * pi / 10, 3 * pi / 10}));
  CHECK(all_near(jumps_by("floor(t*t)", 2.1), {1, std::sqrt(2.0), std::sqrt(3.0), 2}));
  CHECK(all_near(jumps_by("atan2(sin(t), cos(t))", 7), {pi}));
  // Two jumps that make none, and formulas that only bend.
  for (const char* text : {"fract(t) + floor(t)", "sign(t-1)*(t-1)", "abs(sin(9*t))", "tanh(1e5*(t-0.5))",
                           "mod(2, 3)*t", "min(t, 0.5)", "1/(1+t)"}) {
    CAPTURE(text);
    CHECK(jumps_by(text, 3).empty());
  }
  // Seen through a vector, a rotation and a conversion.
  const Curve<double> steps = formula_of("floor(2*t)"), still(0.0);
  CHECK(all_near(jumps_of(clip_by(parametric(still, steps, still), "position", 1.2)), {0.5, 1}));
  CHECK(all_near(jumps_of(clip_by(axis_curve(Vec3(0, 0, 1), steps), "rotation", 1.2)), {0.5, 1}));
  CHECK(all_near(jumps_of(clip_by(euler_curve(parametric(still, steps, still), {}), "rotation", 1.2)), {0.5, 1}));
  // A whole turn is no jump.
  CHECK(jumps_of(clip_by(axis_curve(Vec3(0, 0, 1), formula_of("2*pi*floor(2*t)")), "rotation", 1.2)).empty());
  const Clip filtered = clip_by(formula_of("floor(4*t)"), "heat", 1);
  CHECK(jumps_of(filtered, moves_its_node).empty());
  CHECK(jumps_of(filtered).size() == 4);
}

TEST_CASE("the jumps that modifiers make are found") {
  const Curve<double> ramp =
      keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 1, .value = 1}});
  const std::vector<Modifier> stepped{{.kind = modifiers::Stepped{.step = 0.25}}};
  CHECK(all_near(jumps_of(clip_by(modified(ramp, stepped), "position.x", 1)), {0.25, 0.5, 0.75, 1}));
  const std::vector<Modifier> noise{{.kind = modifiers::Noise{}}};
  CHECK(jumps_of(clip_by(modified(ramp, noise), "position.x", 1)).empty());
}

TEST_CASE("the jumps of an endless clip are found at any speed, however far away, whatever the stretch asked for") {
  const Clip clip = clip_by(formula_of("floor(t/3) + t"), "position.x", endless_clip);
  CHECK(jumps_of(clip).empty());
  for (const double speed : {0.5, 1.0, 2.0}) {
    CAPTURE(speed);
    const Animation animation(only_a_ball(), {clip}, {{.clip = 0, .at = 0.7, .speed = speed}});
    const JumpSearch search(animation);
    std::vector<double> seen, expected{0.7};
    for (double time = 0, to = 0; time < 40;) {
      to = search.first(animation, time, time + 100);
      seen.push_back(to);
      time = to;
      expected.push_back(0.7 + 3 * static_cast<double>(expected.size()) / speed);
    }
    expected.pop_back();
    CHECK(all_near(seen, expected));
    std::vector<double> by_steps;
    for (int i = 0; i < 60 * 44; ++i)
      for (double from = i / 60.0; (from = search.first(animation, from, (i + 1) / 60.0)) <= (i + 1) / 60.0;)
        by_steps.push_back(from);
    by_steps.resize(std::min(by_steps.size(), seen.size()));
    CHECK(by_steps == seen);
    CHECK(near(search.first(animation, 1e6, 1e6 + 10), 0.7 + 3 / speed * std::ceil((1e6 - 0.7) * speed / 3), 1e-8));
  }
  // A speed by keys, from 0 to 2 within four seconds: clip time t * t / 4.
  const Curve<double> speed =
      keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 4, .value = 2}});
  const Animation animation(only_a_ball(), {clip}, {{.clip = 0, .speed = PlaySpeed(speed)}});
  const JumpSearch search(animation);
  CHECK(near(search.first(animation, 0.1, 10), std::sqrt(12.0), 1e-9));
  CHECK(near(search.first(animation, 3.5, 10), 5, 1e-9));
}

TEST_CASE("jumps of a weight before it was changed are found, and none of what it would have done") {
  const Clip clip = clip_by(formula_of("t"), "position.x", 9);
  const Curve<double> weight = keyed_curve<double>({{.time = 0, .value = 1, .ease = Ease::hold()},
                                                    {.time = 0.5, .value = 0.25, .ease = Ease::hold()},
                                                    {.time = 3, .value = 1}});
  Animation animation(only_a_ball(), {clip}, {{.clip = 0, .weight = weight}});
  animation = animation.with_change({.time = 2, .play = "clip", .action = playing::Weigh{.weight = {{0, 0.5}}}});
  animation = animation.with_change({.time = 2.5, .play = "clip", .action = playing::Seek{.time = 1}});
  const Player& player = animation.players()[0];
  CHECK(player.first_weight_jump(0, 1) == 0.5);
  CHECK(std::isinf(player.first_weight_jump(0.5, 9)));  // the key at 3 s is gone
}

TEST_CASE("what a change to a play fires is no jump, whatever the clip's events are called") {
  Clip clip{.name = "clip", .duration = 4, .loop = {LoopMode::repeat, 0}};
  clip.tracks.push_back({"ball", "position.x",
                         keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::hold()},
                                              {.time = 3, .value = 1, .ease = Ease::hold()},
                                              {.time = 4, .value = 0}})});
  for (const std::string name : {"step", "0", "7"}) {
    CAPTURE(name);
    clip.events = {{.from = 0.5, .to = 0.5, .name = name, .data = {}},
                   {.from = 1, .to = 2.9, .name = name, .data = {}}};
    Animation animation(only_a_ball(), {clip}, {{.clip = 0}});
    animation =
        animation.with_change({.time = 0.2, .play = "clip", .action = playing::Seek{.time = 2, .events = true}});
    animation = animation.with_change({.time = 0.3, .play = "clip", .action = playing::Seek{.time = 0.6}});
    const JumpSearch search(animation);
    CHECK(search.first(animation, 0, 9) == doctest::Approx(2.7));
    CHECK(search.first_behind(animation, 0, 9) == doctest::Approx(2.7));
  }
}

TEST_CASE("jumps of the pose that shows below a fading seek are found, until it has faded") {
  Clip clip{.name = "clip", .duration = 9};
  clip.tracks.push_back({"ball", "position.x",
                         keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::hold()},
                                              {.time = 1, .value = 1, .ease = Ease::hold()},
                                              {.time = 1.6, .value = 2, .ease = Ease::hold()},
                                              {.time = 7, .value = 3, .ease = Ease::hold()}})});
  Clip endless = clip_by(formula_of("step(1, t) + step(1.6, t) + step(7, t)"), "position.x", endless_clip);
  for (const Clip& each : {clip, endless}) {
    const Animation plain(only_a_ball(), {each}, {{.clip = 0}});
    const Animation fading =
        plain.with_change({.time = 0.75, .play = "clip", .action = playing::Seek{.time = 6.5, .fade = 0.7}});
    const JumpSearch search(fading);
    for (const bool behind : {false, true}) {
      const auto first = [&](double from) {
        return behind ? search.first_behind(fading, from, 9) : search.first(fading, from, 9);
      };
      CHECK(near(first(0.1), 1, 1e-12));   // what was shown comes to its key
      CHECK(near(first(1), 1.25, 1e-12));  // what is shown to its own
      CHECK(std::isinf(first(1.25)));      // at 1.6 s the first is gone
    }
    // A change meanwhile leaves both as they are.
    const Animation faster =
        fading.with_change({.time = 0.9, .play = "clip", .action = playing::SetSpeed{.speed = {{0, 4}}}});
    const JumpSearch again(faster);
    CHECK(near(again.first(faster, 0.1, 9), 0.9 + 0.35 / 4, 1e-12));
    CHECK(near(again.first(faster, 0.99, 9), 1, 1e-12));
    CHECK(std::isinf(again.first(faster, 1, 9)));
    // And again: three clocks run.
    const Animation thrice =
        fading.with_change({.time = 0.95, .play = "clip", .action = playing::Seek{.time = 0.9, .fade = 0.2}});
    const JumpSearch last(thrice);
    CHECK(near(last.first(thrice, 0.1, 9), 1, 1e-12));
    CHECK(near(last.first(thrice, 1, 9), 1.05, 1e-12));
    CHECK(near(last.first(thrice, 1.05, 9), 1.65, 1e-12));
  }
}

TEST_CASE("the jumps of a play are found as they were, whatever is asked of it later") {
  Clip clip{.name = "clip", .duration = 1, .loop = {LoopMode::repeat, 0}};
  clip.tracks.push_back(
      {"ball", "position.x",
       keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 1, .value = 1}})});
  const Animation plain(only_a_ball(), {clip}, {{.clip = 0, .at = 0.25}});
  const Animation changed =
      plain
          .with_change(
              {.time = 2.5,
               .play = "clip",
               .action = playing::Start{.clip = "clip", .from = 0.5, .to = 0.75, .loop = Loop{LoopMode::repeat, 0}}})
          .with_change({.time = 2.9, .play = "clip", .action = playing::Stop{}})
          .with_change({.time = 4,
                        .play = "clip",
                        .action = playing::Start{.clip = "clip", .loop = Loop{LoopMode::pingpong, 0}}});
  const JumpSearch search(changed);
  std::vector<double> seen;
  for (double time = 0; (time = search.first(changed, time, 9)) < 9;) seen.push_back(time);
  CHECK(all_near(seen, {0.25, 1.25, 2.25, 2.5, 2.75, 2.9, 4}));
}

TEST_CASE("a jump outside of the section that is played is not looked for round by round") {
  Clip clip{.name = "clip", .duration = 1};
  clip.tracks.push_back({"ball", "position.x",
                         keyed_curve<double>({{.time = 0, .value = 0},
                                              {.time = 0.5, .value = 0, .ease = Ease::hold()},
                                              {.time = 0.75, .value = 1, .ease = Ease::hold()},
                                              {.time = 1, .value = 1}})});
  const Animation animation(only_a_ball(), {clip}, {{.clip = 0, .to = 1e-9, .loop = Loop{LoopMode::repeat, 0}}});
  const JumpSearch search(animation);
  const double begun = processor_seconds();
  CHECK(std::isinf(search.first(animation, 1, 1000)));
  CHECK(processor_seconds() - begun < 0.5);
}
