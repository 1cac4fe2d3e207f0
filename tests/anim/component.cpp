#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/component.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Curve<double> wave(double amplitude, double hz, double center = 0) {
  return oscillator({.amplitude = amplitude, .hz = hz, .phase = 0.4, .damping = 0.1, .center = center});
}

Animation one_node(const Node& node, std::vector<Track> tracks, Loop loop = {}, double duration = 10) {
  Clip clip{.name = "clip", .duration = duration, .loop = loop};
  clip.tracks = std::move(tracks);
  return {std::make_shared<const Hierarchy>(std::vector<Node>{node}), {clip}, {Play{}}};
}

const Node box{"box", no_node, {.position = {1, 2, 3}, .scale = {2, 3, 4}}};

}  // namespace

TEST_CASE("a component is told from a property, and a node's name may have dots") {
  CHECK(component_named("position.y") == Component{Property::position, 1});
  CHECK(component_named("rotation.z") == Component{Property::rotation, 2});
  CHECK(component_named("color.a") == Component{Property::color, 3});
  for (const char* none : {"position", "position.w", "color.x", "weights.x", "offset.x", "position.xy", ".x", "x"})
    CHECK_FALSE(component_named(none));
  const auto node = [](std::string_view name) { return name.substr(0, property_dot(name)); };
  CHECK(node("a.position.y") == "a");
  CHECK(node("a.b.scale.x") == "a.b");
  CHECK(node("a.b.scale") == "a.b");
  CHECK(node("a.offset.x") == "a.offset");
  CHECK(node("position.y") == "position");
  CHECK(node(".position.y") == ".position");
  CHECK(property_dot("position") == std::string_view::npos);
}

TEST_CASE("components of position and scale drive their numbers and leave the others at rest") {
  const Animation animation =
      one_node(box, {{"box", "position.y", wave(0.7, 0.3)}, {"box", "scale.x", wave(0.5, 0.2, 2)}});
  for (const double t : {0.0, 0.7, 3.3}) {
    const Motion motion = animation.sample_node(0, t);
    const Sample<double> y = wave(0.7, 0.3).sample(t), x = wave(0.5, 0.2, 2).sample(t);
    CHECK(motion.pose.position == Vec3(1, y.value, 3));
    CHECK(motion.twist.linear == Vec3(0, y.rate, 0));
    CHECK(motion.pose.scale == Vec3(x.value, 3, 4));
    CHECK(motion.scale_rate == Vec3(x.rate, 0, 0));
    Motion whole;
    animation.sample(t, {&whole, 1});
    CHECK(whole.pose.position == motion.pose.position);
    CHECK(whole.scale_rate == motion.scale_rate);
  }
}

TEST_CASE("relative components add to the node's numbers and multiply its scale") {
  const Animation animation =
      one_node(box, {{"box", "position.y", wave(0.7, 0.3), true}, {"box", "scale.z", wave(0.5, 0.2, 2), true}});
  const Motion motion = animation.sample_node(0, 1.3);
  const Sample<double> y = wave(0.7, 0.3).sample(1.3), z = wave(0.5, 0.2, 2).sample(1.3);
  CHECK(near(motion.pose.position, Vec3(1, 2 + y.value, 3), 1e-15));
  CHECK(near(motion.twist.linear, Vec3(0, y.rate, 0), 1e-15));
  CHECK(near(motion.pose.scale, Vec3(2, 3, 4 * z.value), 1e-15));
  CHECK(near(motion.scale_rate, Vec3(0, 0, 4 * z.rate), 1e-15));
}

TEST_CASE("one angle turns a node that nothing else turns about that axis, beyond a turn too") {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("rotation.") + "xyz"[axis];
    const Animation animation = one_node(box, {{"box", name, wave(9, 0.3)}});
    const Curve<Quat> turn = axis_curve(Vec3::Unit(axis), wave(9, 0.3));
    for (const double t : {0.0, 0.7, 3.3}) {
      CHECK(animation.sample_node(0, t).pose.rotation.coeffs() == turn.value(t).coeffs());
      CHECK(animation.sample_node(0, t).twist.angular == turn.rate(t));
    }
  }
}

TEST_CASE("angles make the rotation of their order, those that no track has stay the node's, rates are exact") {
  for (const EulerOrder& order : {EulerOrder{}, EulerOrder{{2, 0, 1}, true}, EulerOrder{{1, 2, 0}, false}}) {
    const Vec3 own(0.3, -0.4, 0.5);  // in the order's sequence
    Node node = box;
    node.rest.rotation = from_euler(own, order);
    Track first{"box", std::string("rotation.") + "xyz"[order.axes[0]], wave(1.1, 0.3)};
    Track last{"box", std::string("rotation.") + "xyz"[order.axes[2]], wave(0.6, 0.5), true};
    first.order = last.order = order;
    const Animation animation = one_node(node, {first, last});
    for (const double t : {0.0, 0.7, 3.3}) {
      const Sample<double> a = wave(1.1, 0.3).sample(t), c = wave(0.6, 0.5).sample(t);
      Sample<Vec3> angles{Vec3(a.value, own[1], own[2] + c.value), Vec3(a.rate, 0, c.rate), Vec3(0, 0, 0)};
      const Sample<Quat> expected = from_euler(angles, order);
      const Motion motion = animation.sample_node(0, t);
      CHECK(near(motion.pose.rotation, expected.value, 1e-14));
      CHECK(near(motion.twist.angular, expected.rate, 1e-14));
    }
  }
}

TEST_CASE("components of the color lie over what is below, and their rates are exact") {
  Node node = box;
  node.color = Color{Vec4(0.1, 0.2, 0.3, 0.4)};
  const Animation animation = one_node(node, {{"box", "color.a", wave(0.2, 0.5, 0.5)}});
  const NodeLook look = animation.look(0, 0.7);
  REQUIRE(look.color);
  const Sample<double> a = wave(0.2, 0.5, 0.5).sample(0.7);
  CHECK(look.color->value.rgba == Vec4(0.1, 0.2, 0.3, a.value));
  CHECK(look.color->rate == Vec4(0, 0, 0, a.rate));
  const Animation bare = one_node(box, {{"box", "color.g", wave(0.2, 0.5, 0.5)}});
  CHECK(bare.look(0, 0.7).color->value.rgba == Vec4(1, a.value, 1, 1));
}

TEST_CASE("a play lays one number over the whole position that a play below it drives") {
  auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{box});
  Clip below{.name = "below", .duration = 2}, above{.name = "above", .duration = 2};
  const Curve<Vec3> whole = keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}}, {.time = 2, .value = {2, 4, 6}}});
  below.tracks = {{"box", "position", whole}};
  above.tracks = {{"box", "position.y", wave(1, 0.5)}};
  const Curve<double> fade = keyed_curve<double>({{.time = 0, .value = 0}, {.time = 2, .value = 1}});
  const Animation animation(nodes, {below, above}, {Play{.clip = 0}, Play{.clip = 1, .weight = fade}});
  const double t = 0.7;
  const Motion motion = animation.sample_node(0, t);
  const Sample<Vec3> under = whole.sample(t);
  const Sample<double> over = wave(1, 0.5).sample(t), w = fade.sample(t);
  CHECK(motion.pose.position.x() == under.value.x());
  CHECK(motion.twist.linear.z() == under.rate.z());
  CHECK(near(motion.pose.position.y(), under.value.y() + w.value * (over.value - under.value.y()), 1e-15));
  CHECK(near(motion.twist.linear.y(),
             under.rate.y() + w.value * (over.rate - under.rate.y()) + w.rate * (over.value - under.value.y()), 1e-14));
}

TEST_CASE("a loop with offset climbs by what each of its numbers gains") {
  const Curve<double> up = keyed_curve<double>({{.time = 0, .value = 1}, {.time = 2, .value = 4}});
  const Animation animation =
      one_node(box, {{"box", "position.x", up}, {"box", "rotation.z", up}}, {LoopMode::repeat_offset, 0}, 2);
  const Motion motion = animation.sample_node(0, 5);
  CHECK(near(motion.pose.position, Vec3(8.5, 2, 3), 1e-14));
  CHECK(near(motion.pose.rotation, exp_map(Vec3(0, 0, 8.5)), 1e-14));
}

TEST_CASE("two tracks that drive one number, or angles in two orders, are told with both names") {
  const auto said = [](std::vector<Track> tracks) -> std::string {
    try {
      static_cast<void>(one_node(box, std::move(tracks)));
    } catch (const std::invalid_argument& fault) {
      return fault.what();
    }
    return "";
  };
  const Curve<Vec3> place(Vec3(0, 0, 0));
  const Curve<double> number(0.0);
  CHECK(said({{"box", "position", place}, {"box", "position.y", number}}) ==
        "clips do not fit their nodes:\n  clip \"clip\": the tracks \"box.position\" and \"box.position.y\" drive the "
        "same number");
  CHECK(said({{"box", "color.a", number}, {"box", "color.a", number}}).find("same number") != std::string::npos);
  CHECK(said({{"box", "position.x", number}, {"box", "position.y", number}, {"box", "scale.x", number}}).empty());
  Track other{"box", "rotation.y", number};
  other.order = {{2, 1, 0}, true};
  CHECK(said({{"box", "rotation.x", number}, other}).find("two orders") != std::string::npos);
  other.order = {{2, 1, 2}, true};
  CHECK(said({other}).find("twice about one axis") != std::string::npos);
  CHECK(said({{"box", "position.x", place}}).find("must carry numbers") != std::string::npos);
}

TEST_CASE("components made into whole tracks move a node as they do themselves") {
  Node node = box;
  node.rest.rotation = from_euler(Vec3(0.1, 0.2, 0.3));
  node.color = Color{Vec4(0.1, 0.2, 0.3, 0.4)};
  Clip clip{.name = "clip", .duration = 10};
  clip.tracks = {{"box", "position.y", wave(0.7, 0.3), true},
                 {"box", "rotation.x", wave(1, 0.2)},
                 {"box", "scale.z", wave(0.2, 0.4, 1)},
                 {"box", "color.b", wave(0.1, 0.4, 0.5)},
                 {"box", "mood", wave(1, 1)},
                 {"other", "position.x", wave(1, 1)}};
  const Clip whole = with_whole_tracks(clip, [&](std::string_view name) { return name == "box" ? &node : nullptr; });
  REQUIRE(whole.tracks.size() == 6);
  CHECK(whole.tracks[0].name() == "box.mood");
  CHECK(whole.tracks[1].name() == "other.position.x");
  clip.tracks.pop_back();
  Clip alone = whole;
  alone.tracks.erase(alone.tracks.begin() + 1);
  const auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{node});
  const Animation parts(nodes, {clip}, {Play{}}), made(nodes, {alone}, {Play{}});
  for (const double t : {0.0, 1.7, 4.4}) {
    const Motion a = parts.sample_node(0, t), b = made.sample_node(0, t);
    CHECK(near(a.pose.position, b.pose.position, 1e-15));
    CHECK(near(a.twist.linear, b.twist.linear, 1e-15));
    CHECK(near(a.pose.rotation, b.pose.rotation, 1e-15));
    CHECK(near(a.twist.angular, b.twist.angular, 1e-15));
    CHECK(near(a.pose.scale, b.pose.scale, 1e-15));
    CHECK(near(a.scale_rate, b.scale_rate, 1e-15));
    CHECK(parts.look(0, t).color->value.rgba == made.look(0, t).color->value.rgba);
    CHECK(parts.look(0, t).color->rate == made.look(0, t).color->rate);
  }
}
