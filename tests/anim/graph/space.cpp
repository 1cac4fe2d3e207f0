#include "graph_support.h"

#include <tweenfall/anim/marker_sync.h>

#include <map>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Loops of different lengths with the same steps.
std::shared_ptr<const std::vector<Clip>> stepping_clips() {
  std::vector<Clip> clips = {moving("walk", 4, LoopMode::repeat), moving("run", 5, LoopMode::repeat),
                             moving("lean", 6, LoopMode::repeat)};
  clips[0].events = {{0.2, 0.2, "left", ""}, {1.2, 1.2, "right", ""}};
  clips[1].events = {{0.1, 0.1, "left", ""}, {0.9, 0.9, "right", ""}};
  clips[2].events = {{0.5, 0.5, "left", ""}, {1.5, 1.5, "right", ""}};
  return std::make_shared<const std::vector<Clip>>(std::move(clips));
}

GraphDescription by_speed(const std::optional<std::string>& sync, double half_life = 0) {
  return {.parameters = {{.name = "speed", .half_life = half_life}},
          .poses = {
              {"move",
               SpacePose{.by = {ByParameter{"speed"}}, .entries = {{"walk", {1, 0}}, {"run", {4, 0}}}, .sync = sync}}}};
}

}  // namespace

TEST_CASE("at the place of a pose a space shows that pose bit for bit, and beyond the ends the last") {
  GraphPlayer player(graph_of(by_speed({}), stepping_clips()));
  std::vector<Motion> walk(4), run(4);
  Animation(limb(), *stepping_clips(), {{.clip = 0}}).sample(0.7, walk);
  Animation(limb(), *stepping_clips(), {{.clip = 1}}).sample(0.7, run);
  CHECK(same_bits(pose_at(player, 0.7), walk));
  player.set("speed", 1);
  CHECK(same_bits(pose_at(player, 0.7), walk));
  player.set("speed", 4);
  CHECK(same_bits(pose_at(player, 0.7), run));
  player.set("speed", 9);
  CHECK(same_bits(pose_at(player, 0.7), run));
}

TEST_CASE("a space on a line and on a plane has the exact rate of what it shows, the parameters moving") {
  GraphPlayer line(graph_of(by_speed({}, 0.2), stepping_clips()));
  line.seek(0.1);
  line.set("speed", 3);
  GraphDescription plane = {
      .parameters = {{.name = "x", .half_life = 0.2}, {.name = "y", .half_life = 0.3}},
      .poses = {{"move", SpacePose{.by = {ByParameter{"x"}, ByParameter{"y"}},
                                   .entries = {{"walk", {0, 0}}, {"run", {2, 0}}, {"lean", {0, 2}}}}}}};
  GraphPlayer both(graph_of(plane, stepping_clips()));
  both.seek(0.1);
  both.set("x", 0.9);
  both.set("y", 0.8);
  for (const double time : {0.3, 0.44, 0.61, 0.87}) {
    CHECK(rate_error(line, time) < 1e-6);
    CHECK(rate_error(both, time) < 1e-6);
  }
}

TEST_CASE("clips in phase run on with exact rates, whatever the frames and back") {
  for (const double half_life : {0.0, 0.15}) {
    GraphPlayer player(graph_of(by_speed("*", half_life), stepping_clips())),
        fine(graph_of(by_speed("*", half_life), stepping_clips()));
    for (GraphPlayer* each : {&player, &fine}) {
      for (const double time : {0.3, 0.8, 1.7}) {
        while (each == &fine && each->time() + 0.021 < time) {
          each->advance(0.021);
          static_cast<void>(pose_at(*each, each->time()));
        }
        each->seek(time);
        each->set("speed", time * 2);
      }
    }
    for (const double time : {2.9, 0.55, 1.31, 0.1, 2.2}) CHECK(same_bits(pose_at(player, time), pose_at(fine, time)));
    // Few times are so near to a key that a stencil reaches over it.
    std::vector<double> errors;
    for (int i = 0; i < 60; ++i) {
      const double time = 0.011 + 0.0471 * i;
      bool clear = true;
      for (const double setting : {0.3, 0.8, 1.7}) clear = clear && std::abs(time - setting) > 1e-3;
      if (clear) errors.push_back(rate_error(player, time));
    }
    std::ranges::sort(errors);
    CHECK(errors[errors.size() * 9 / 10] < 5e-6);
    MESSAGE("half of the rates within " << errors[errors.size() / 2] << ", nine of ten within "
                                        << errors[errors.size() * 9 / 10]);
  }
}

TEST_CASE("the rate of a phase is that of its value in a step in which weights kink too, events once each") {
  // The parameter kinks, passes the place of a pose and is set, each within a step of 1/480 s.
  GraphDescription keyed = by_speed("*");
  keyed.parameters[0].curve = keyed_curve<double>({{.time = 0, .value = 0.2, .ease = Ease::linear()},
                                                   {.time = 0.3007, .value = 4.3, .ease = Ease::linear()},
                                                   {.time = 0.9, .value = 1.1}});
  GraphDescription set = by_speed("*", 0.1);
  set.inputs = {{0.2004, "speed", 5}, {0.6003, "speed", 0.5}};
  for (const GraphDescription& description : {keyed, set}) {
    GraphPlayer player(graph_of(description, stepping_clips()));
    std::vector<double> kinks = {0.3007, 0.2004, 0.6003, 0.2, 1.2};  // and where markers are
    std::vector<GraphEvent> apart_told;
    for (double from = -1, to = 0.0037; from < 0.9; from = to, to += 0.0037)
      for (const GraphEvent& event : player.events(from, to)) apart_told.push_back(event);
    const std::vector<GraphEvent> told = player.events(-1, apart_told.empty() ? 0 : apart_told.back().time);
    REQUIRE(told.size() == apart_told.size());
    for (std::size_t i = 0; i < told.size(); ++i) {
      CHECK(near(told[i].time, apart_told[i].time, 1e-12));
      kinks.push_back(told[i].time);
    }
    // Where else rates of weights change at once: the parameter at 1 and at 4.
    double before = -1;
    for (int i = 1; i < 18'000; ++i) {
      const double time = 0.9 * i / 18'000;
      player.seek(time);
      const double speed = player.parameter("speed").value, zone = speed < 1 ? 0 : speed < 4 ? 1 : 2;
      if (before >= 0 && zone != before) kinks.push_back(time - 0.9 / 36'000);
      before = zone;
    }
    CHECK(kinks.size() >= 8);
    double most = 0;
    for (const double kink : kinks)
      for (int i = -24; i <= 24; ++i)
        if (const double time = kink + 1e-4 * i + 3e-5; time > 1e-3)
          if (std::ranges::none_of(kinks, [&](double each) { return std::abs(each - time) < 2.8e-5; }))
            most = std::max(most, rate_error(player, time, 1e-6));
    CAPTURE(most);
    CHECK(most < 2e-7);
  }
}

TEST_CASE("a gliding parameter that is set changes no rate at once, wherever in a step a weight kinks") {
  // It glides back and forth over the places of the poses, and is set repeatedly during the motion.
  const GraphDescription plane = {
      .parameters = {{.name = "x", .half_life = 0.05}, {.name = "y", .half_life = 0.08}},
      .poses = {{"move", SpacePose{.by = {ByParameter{"x"}, ByParameter{"y"}},
                                   .entries = {{"walk", {0, 0}}, {"run", {2, 0}}, {"lean", {0, 2}}},
                                   .sync = "*"}}}};
  GraphDescription bands = plane;
  std::get<SpacePose>(bands.poses[0].operation).bands = true;
  GraphDescription line = by_speed("*", 0.05);
  line.parameters.push_back({.name = "weight", .start = 0.5, .half_life = 0.1});
  line.poses.push_back({"mixed", BlendPose{{{"move", ByParameter{"weight"}}, {"lean", 1.0}}}});
  for (GraphDescription description : {line, plane, bands}) {
    Random random(11);
    for (int i = 1; i <= 600; ++i) {
      const std::string& name = description.parameters[static_cast<std::size_t>(i % 2)].name;
      description.inputs.push_back({0.0037 * i, name, random.between(-2, 5)});
    }
    GraphPlayer player(graph_of(description, stepping_clips()));
    Apart most;
    for (const GraphInput& input : description.inputs) {
      const Apart here = apart(pose_at(player, input.time, Side::in), pose_at(player, input.time, Side::out));
      most.value = std::max(most.value, here.value);
      most.rate = std::max(most.rate, here.rate);
    }
    CHECK(most.value < 1e-12);
    CHECK(most.rate < 1e-12);
    // On either side of a setting the rate is that of the value, seen from within the piece.
    double error = 0;
    for (std::size_t i = 20; i < 600; i += 29)
      for (const double part : {0.1, 0.3, 0.7, 0.9})
        error = std::max(error, rate_error(player, description.inputs[i].time + 0.0037 * part, 2e-6));
    MESSAGE("jumps of rates up to " << most.rate << ", rates within " << error);
    CHECK(error < 1e-7);
  }
}

TEST_CASE("clips in phase have exact rates where one runs a thousand times as fast as another") {
  std::vector<Clip> clips = {moving("walk", 4, LoopMode::repeat)};
  clips[0].events = {{0, 0, "left", ""}, {0.6, 0.6, "right", ""}};
  Clip slow{.name = "run", .duration = 2000, .loop = {.mode = LoopMode::repeat}};
  slow.tracks.push_back({"root", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}, .ease = Ease::linear()},
                                            {.time = 2000, .value = {0, 2, 0}, .ease = Ease::linear()}})});
  slow.events = {{0, 0, "left", ""}, {1200, 1200, "right", ""}};
  clips.push_back(slow);
  GraphDescription set = by_speed("*", 0.02);
  set.inputs = {{0.1001, "speed", 4}, {0.3003, "speed", 1}};
  GraphPlayer player(graph_of(set, std::make_shared<const std::vector<Clip>>(clips)));
  double most = 0;
  for (int i = 0; i < 700; ++i)
    if (const double time = 0.05 + 0.00071 * i; std::abs(time - 0.1001) > 1e-5 && std::abs(time - 0.3003) > 1e-5)
      most = std::max(most, rate_error(player, time, 1e-6));
  CHECK(most < 1e-8);
}

TEST_CASE("clips in phase that are too short to be seen take no time to be counted") {
  std::vector<Clip> clips = {moving("walk", 4, LoopMode::repeat), moving("run", 5, LoopMode::repeat)};
  for (Clip& clip : clips) clip.duration = 1e-12;
  GraphDescription set = by_speed("*", 0.02);
  set.inputs = {{0.1001, "speed", 4}, {0.3003, "speed", 1}};
  GraphPlayer player(graph_of(set, std::make_shared<const std::vector<Clip>>(clips)));
  for (const double time : {0.2, 0.4})
    for (const Motion& motion : pose_at(player, time)) CHECK(std::isfinite(motion.pose.position.x()));
}

TEST_CASE("clips in phase of a nanosecond have too many events to be told, and few are where they belong") {
  std::vector<Clip> clips = {moving("walk", 4, LoopMode::repeat), moving("run", 5, LoopMode::repeat)};
  clips[0].duration = 1e-9;
  clips[1].duration = 3e-9;
  clips[0].events = {{2.5e-10, 2.5e-10, "hit", ""}};
  GraphPlayer player(graph_of(by_speed(""), std::make_shared<const std::vector<Clip>>(clips)));
  player.set("speed", 2.5);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(player.events(0, 0.005)),
      "clip \"walk\", in phase, goes around every 2e-09 s and has more than a million events from 0 s to "
      "0.005 s: lengthen its loop or leave out its events",
      std::length_error);
  // Both have half the weight, so that a round takes 2 ns.
  const std::vector<GraphEvent> events = player.events(0.001, 0.0010002);
  CHECK(events.size() == 100);
  for (std::size_t i = 0; i < events.size(); ++i)
    CHECK(near(events[i].time, 0.001 + 5e-10 + 2e-9 * static_cast<double>(i), 1e-15));
}

TEST_CASE("clips in phase step together: their markers fall at the same times, each told once") {
  GraphPlayer player(graph_of(by_speed("*"), stepping_clips()));
  player.set("speed", 2.5);
  std::vector<GraphEvent> events;
  for (double from = -1, to = 0.1; to < 8; from = to, to += 0.17)
    for (const GraphEvent& event : player.events(from, to)) events.push_back(event);
  REQUIRE(events.size() > 12);
  REQUIRE(events.size() % 2 == 0);
  for (std::size_t i = 0; i + 1 < events.size(); i += 2) {
    CHECK(events[i].name == events[i + 1].name);
    CHECK(near(events[i].time, events[i + 1].time, 1e-9));
    CHECK(near(events[i].weight + events[i + 1].weight, 1.0, 1e-12));
    if (i >= 2) CHECK(events[i].name != events[i - 2].name);
  }
}

TEST_CASE("clips in phase without a pattern step together by the events that all of them share") {
  std::vector<Clip> clips = *stepping_clips();
  clips[1].events.insert(clips[1].events.begin() + 1, {0.3, 0.3, "whoosh", ""});
  GraphPlayer player(graph_of(by_speed(""), std::make_shared<const std::vector<Clip>>(std::move(clips))));
  player.set("speed", 2.5);
  std::map<std::string, std::vector<double>> times;
  for (const GraphEvent& event : player.events(-1, 8)) times[event.name].push_back(event.time);
  CHECK(times["whoosh"].size() > 3);
  for (const char* step : {"left", "right"}) {
    REQUIRE(times[step].size() > 6);
    for (std::size_t i = 0; i + 1 < times[step].size(); i += 2) CHECK(near(times[step][i], times[step][i + 1], 1e-9));
  }
}

TEST_CASE("what is no space is refused with its place") {
  const auto told_of = [](const SpacePose& space) {
    std::string text;
    for (const GraphFault& fault : inspect({.parameters = {{.name = "v"}},
                                   .poses = {{"s", space},
                                             {"q", ClipPose{"walk", 0, 2}},
                                             {"p", ClipPose{"walk", 0, 1, Loop{.mode = LoopMode::pingpong}}}}},
                                           *limb(), *stepping_clips())) {
      for (const std::string& part : fault.place) text += "/" + part;
      text += ": " + fault.message + "\n";
    }
    return text;
  };
  const GraphNumber v = ByParameter{"v"};
  CHECK(told_of({.by = {v}, .entries = {{"walk", {1, 0}}}}).find("/poses/s/space/poses: ") == 0);
  CHECK(told_of({.by = {v}, .entries = {{"walk", {1, 0}}, {"run", {1, 0}}}}).find("/poses/s/space/poses: ") == 0);
  CHECK(told_of({.by = {}, .entries = {{"walk", {1, 0}}, {"run", {2, 0}}}}).find("/poses/s/space/by: ") == 0);
  CHECK(told_of({.by = {v}, .entries = {{"walk", {1, 0}}, {"rn", {2, 0}}}})
            .find("/poses/s/space/poses/1: there is no pose") == 0);
  CHECK(told_of({.by = {v}, .entries = {{"walk", {1, 0}}, {"q", {2, 0}}}, .sync = ""})
            .find("/poses/s/space/poses/1: only clips") == 0);
  CHECK(told_of({.by = {v}, .entries = {{"walk", {1, 0}}, {"p", {2, 0}}}, .sync = ""})
            .find("/poses/s/space/poses/1: clips in phase go around without end") == 0);
  CHECK(told_of({.by = {v}, .entries = {{"walk", {1, 0}}, {"run", {2, 0}}}, .sync = "zz*"})
            .find("/poses/s/space/sync: no event of its clips matches \"zz*\"") == 0);
}
