#pragma once

// A small stage whose motion is known in closed form, recorded without any simulation, so that what files and pages
// show can be checked against formulas: a pendulum that is let go and then bounces, a box that is carried, driven and
// dropped, a capsule that rolls free, and a skinned strip that waves.

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/recording.h>

#include <cmath>
#include <numbers>

namespace tweenfall::test {

inline constexpr double release_time = 0.75;
inline constexpr double example_length = 3;
inline constexpr double example_gravity = 9.81;

/// Height and rate of a ball of radius `radius` thrown from height `from` at `speed` upward, which keeps half its speed
/// at each bounce on the floor at 0.
struct Height {
  double value, rate;
};
inline Height bounced(double from, double speed, double radius, double time) {
  for (int bounce = 0; bounce < 50; ++bounce) {
    const double hit = (speed + std::sqrt(speed * speed + 2 * example_gravity * (from - radius))) / example_gravity;
    if (time <= hit) return {from + speed * time - 0.5 * example_gravity * time * time, speed - example_gravity * time};
    time -= hit;
    speed = 0.5 * (example_gravity * hit - speed);
    from = radius;
    if (speed < 1e-3) break;
  }
  return {radius, 0};
}

inline Quat turned(double angle, const Vec3& axis) {
  const Vec3 part = axis * std::sin(angle / 2);
  return Quat(std::cos(angle / 2), part.x(), part.y(), part.z());
}

inline WorldMotion placed(const Vec3& position, const Quat& rotation, const Twist& twist) {
  WorldMotion world;
  world.linear = rotation.toRotationMatrix();
  world.motion.pose = {position, rotation, Vec3(1, 1, 1)};
  world.motion.twist = twist;
  return world;
}

struct Moment {
  WorldMotion world;
  Owner owner = Owner::keyed;
};

/// Where the example's nodes are, by their index, as formulas.
inline Moment example_moment(std::size_t node, double t) {
  using std::numbers::pi;
  const auto swing = [&](double time) { return 1.0 * std::cos(2 * pi * 0.5 * time); };
  const auto swing_rate = [&](double time) { return -pi * std::sin(2 * pi * 0.5 * time); };
  const Vec3 pivot(-1.5, 2.4, 0), z(0, 0, 1);
  const auto bob_at = [&](double time) {
    const double a = swing(time), w = swing_rate(time);
    return placed(pivot + Vec3(std::sin(a), -std::cos(a), 0), turned(a, z),
                  {Vec3(std::cos(a), std::sin(a), 0) * w, Vec3(0, 0, w)});
  };
  switch (node) {
    case 0:  // floor
      return {placed({0, 0, 0}, Quat(1, 0, 0, 0), {})};
    case 1:  // pivot
      return {placed(pivot, turned(swing(t), z), {Vec3(0, 0, 0), Vec3(0, 0, swing_rate(t))})};
    case 2: {  // bob
      if (t < release_time) return {bob_at(t)};
      const Motion start = bob_at(release_time).motion;
      const double s = t - release_time;
      const Height y = bounced(start.pose.position.y(), start.twist.linear.y(), 0.2, s);
      const double w = start.twist.angular.z();
      return {placed({start.pose.position.x() + start.twist.linear.x() * s, y.value, 0},
                     turned(swing(release_time) + w * s, z),
                     {Vec3(start.twist.linear.x(), y.rate, 0), start.twist.angular}),
              Owner::free};
    }
    case 3: {  // box: carried for 1 s, driven for 0.6 s, then free
      const double s = t < 1.6 ? t : 1.6;
      const double x = -0.5 + s, lift = 0.6 + 0.5 * s;
      const double fall = t - s;
      const Height y = bounced(lift, t < 1.6 ? 0 : 0.5, 0.25, fall);
      return {placed({x + fall * 0.5, t < 1.6 ? lift : y.value, -0.8}, turned(0.6 * t, Vec3(0, 1, 0)),
                     {Vec3(t < 1.6 ? 1 : 0.5, t < 1.6 ? 0.5 : y.rate, 0), Vec3(0, 0.6, 0)}),
              t < 1     ? Owner::keyed
              : t < 1.6 ? Owner::driven
                        : Owner::free};
    }
    case 4: {  // capsule, rolling along z
      const double v = -0.5;
      const Quat lying = turned(pi / 2, Vec3(0, 0, 1));
      const double w = v / 0.15;
      return {placed({0.9, 0.15, 1 + v * t}, turned(w * t, Vec3(1, 0, 0)) * lying, {Vec3(0, 0, v), Vec3(w, 0, 0)}),
              Owner::free};
    }
    default: {  // the strip's three joints, each bent a little more
      const int joint = static_cast<int>(node) - 5;
      Vec3 at(2.0, 0, -0.4);
      Vec3 velocity(0, 0, 0);
      double angle = 0, turning = 0;
      const double bend = 0.5 * std::sin(2 * pi * t / 1.5), bending = 0.5 * (2 * pi / 1.5) * std::cos(2 * pi * t / 1.5);
      for (int i = 1; i <= joint; ++i) {
        at += Vec3(-std::sin(angle), std::cos(angle), 0) * 0.5;
        velocity += Vec3(-std::cos(angle), -std::sin(angle), 0) * (0.5 * turning);
        angle += bend;
        turning += bending;
      }
      return {placed(at, turned(angle, z), {velocity, Vec3(0, 0, turning)})};
    }
  }
}

inline StageDescription example_stage() {
  StageDescription stage;
  stage.name = "pendulum let go";
  const auto body = [](const Solid& solid, bool fixed = false) {
    BodyDescription description;
    description.shape.solid = solid;
    description.fixed = fixed;
    return description;
  };
  stage.nodes.push_back({.name = "floor", .body = body(Plane{}, true)});
  stage.nodes.push_back({.name = "pivot", .rest = {.position = Vec3(-1.5, 2.4, 0)}});
  stage.nodes.push_back({.name = "bob", .parent = 1, .rest = {.position = Vec3(0, -1, 0)}, .body = body(Sphere{0.2})});
  stage.nodes.push_back({.name = "crate", .body = body(Box{Vec3(0.25, 0.25, 0.25)})});
  stage.nodes.push_back({.name = "roller", .body = body(Capsule{0.15, 0.3})});
  for (std::size_t i = 0; i < 3; ++i)
    stage.nodes.push_back({.name = "reed/" + std::to_string(i),
                           .parent = i == 0 ? no_node : 4 + i,
                           .rest = {.position = i == 0 ? Vec3(2, 0, -0.4) : Vec3(0, 0.5, 0)}});

  Clip clip;
  clip.name = "swing";
  clip.duration = 1.5;
  clip.loop = {LoopMode::repeat, 2};
  clip.tracks.push_back({"pivot", "rotation", axis_curve(Vec3(0, 0, 1), oscillator({.amplitude = 1, .hz = 0.5}))});
  clip.tracks.push_back({"crate", "position",
                         keyed_curve<Vec3>({{0, Vec3(-0.5, 0.6, -0.8), Ease::linear()},
                                            {0.5, Vec3(0, 0.85, -0.8), Ease::linear()},
                                            {1.5, Vec3(1, 1.35, -0.8)}})});
  for (const char* joint : {"reed/1", "reed/2"})
    clip.tracks.push_back({joint, "rotation",
                           keyed_curve<Quat>({{0, turned(0, Vec3(0, 0, 1))},
                                              {0.375, turned(0.5, Vec3(0, 0, 1))},
                                              {1.125, turned(-0.5, Vec3(0, 0, 1))},
                                              {1.5, turned(0, Vec3(0, 0, 1))}})});
  clip.events.push_back({.from = release_time, .to = release_time, .name = "let go", .data = ""});
  stage.clips.push_back(clip);
  Play play;
  play.clip = 0;
  stage.plays.push_back(play);

  // A flat strip of 13 rows that follows the three joints.
  Mesh mesh;
  mesh.name = "reed";
  mesh.base_color = Color{Vec4(0.15, 0.5, 0.2, 1)};
  for (int row = 0; row <= 12; ++row)
    for (int side = -1; side <= 1; side += 2) {
      const double y = row * 1.5 / 12;
      mesh.positions.emplace_back(0.14 * side, y, 0);
      mesh.normals.emplace_back(0, 0, 1);
      const double joint = std::min(2.0, std::max(0.0, y / 0.5 - 0.25));
      const auto low = static_cast<std::uint32_t>(joint);
      const double share = joint - low;
      mesh.influences.add({{low, 1 - share}, {std::min(2u, low + 1), share}});
    }
  for (std::uint32_t row = 0; row < 12; ++row)
    for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) mesh.triangles.push_back(2 * row + corner);
  stage.meshes.push_back(mesh);
  Skin skin;
  for (std::size_t i = 0; i < 3; ++i) {
    skin.joints.push_back(5 + i);
    skin.inverse_binds.push_back({Mat3::Identity(), Vec3(0, -0.5 * static_cast<double>(i), 0)});
  }
  stage.skins.push_back(skin);
  stage.mesh_instances.push_back({.node = 5, .mesh = 0, .skin = 0});
  return stage;
}

inline Recording example_recording(double fps = 60) {
  const StageDescription stage = example_stage();
  Recording recording;
  recording.name = stage.name;
  const int frames = static_cast<int>(std::lround(example_length * fps));
  for (int frame = 0; frame <= frames; ++frame) recording.times.push_back(frame / fps);
  for (std::size_t node = 0; node < stage.nodes.size(); ++node) {
    NodeRecord record;
    record.name = stage.nodes[node].name;
    record.parent = stage.nodes[node].parent;
    for (const double time : recording.times) {
      const Moment moment = example_moment(node, time);
      record.world.push_back(moment.world);
      record.twist.push_back(moment.world.motion.twist);
      record.owner.push_back(moment.owner);
    }
    recording.nodes.push_back(record);
  }
  // A machine that passes at 1 s, and is through 0.5 s later; a parameter that rises evenly.
  GraphRecord graph{.name = "figure", .parameters = {{"speed", {}}}, .machines = {{.name = "legs"}}};
  graph.machines[0].states = {"stand", "walk"};
  graph.machines[0].passages = {{0, 0, "", ""}, {1, 1, "fade 0.5 s", "speed > 0.1"}};
  for (const double time : recording.times) {
    const double walk = std::clamp((time - 1) / 0.5, 0.0, 1.0);
    graph.parameters[0].value.push_back(2 * time);
    graph.machines[0].weight.insert(graph.machines[0].weight.end(), {1 - walk, walk});
    graph.machines[0].is_settling.push_back(0);
  }
  recording.graphs = {graph};
  const auto handoff = [&](std::size_t node, Owner from, Owner to, double time, Cause cause) {
    const Motion before = example_moment(node, time - 1e-9).world.motion;
    const Motion after = example_moment(node, time + 1e-9).world.motion;
    recording.handoffs.push_back({node, from, to, time, cause, before, after});
  };
  handoff(2, Owner::keyed, Owner::free, release_time, Cause::event);
  handoff(3, Owner::keyed, Owner::driven, 1.0, Cause::at);
  handoff(3, Owner::driven, Owner::free, 1.6, Cause::caller);
  recording.events.push_back({.time = release_time, .name = "let go", .data = "", .nodes = {}, .impulse = 0});
  recording.events.push_back({.time = 1.2, .name = "contact", .data = "", .nodes = {2, 0}, .impulse = 0.125});
  return recording;
}

}  // namespace tweenfall::test
