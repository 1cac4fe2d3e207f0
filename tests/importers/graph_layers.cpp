// Where boxes and wires of a graph's picture go.

#include <tweenfall/importers/graph_plot.h>

#include "graph_picture/layers.h"

#include "support.h"

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;
using plotting::Layers;

TEST_CASE("boxes of a column and the lanes of wires that skip it lie over each other nowhere") {
  Random random(7);
  for (int graph = 0; graph < 40; ++graph) {
    const std::size_t count = 2 + random.bits() % 40;
    std::vector<std::size_t> columns{0};
    std::vector<double> heights{40};
    std::vector<Layers::Wire> wires;
    for (std::size_t thing = 1; thing < count; ++thing) {
      columns.push_back(0);
      heights.push_back(random.between(30, 120));
      for (std::uint64_t i = random.bits() % 4; i > 0; --i) {
        const std::size_t from = random.bits() % thing;
        wires.push_back({from, thing});
        columns[thing] = std::max(columns[thing], columns[from] + 1);
      }
    }
    const Layers layers(columns, heights, wires);
    struct Stretch {
      double top, bottom;
    };
    std::vector<std::vector<Stretch>> taken(count);
    for (std::size_t thing = 0; thing < count; ++thing)
      taken[columns[thing]].push_back(
          {layers.middle_of(thing) - heights[thing] / 2, layers.middle_of(thing) + heights[thing] / 2});
    for (std::size_t wire = 0; wire < wires.size(); ++wire) {
      const std::vector<double> lanes = layers.lanes_of(wire);
      REQUIRE(lanes.size() == columns[wires[wire].to] - columns[wires[wire].from] - 1);
      for (std::size_t i = 0; i < lanes.size(); ++i)
        taken[columns[wires[wire].from] + 1 + i].push_back({lanes[i] - 6, lanes[i] + 6});
    }
    for (std::vector<Stretch>& column : taken) {
      std::ranges::sort(column, {}, &Stretch::top);
      for (std::size_t i = 0; i < column.size(); ++i) {
        CHECK(column[i].top > -1e-9);
        CHECK(column[i].bottom < layers.height() + 1e-9);
        if (i > 0) CHECK(column[i].top > column[i - 1].bottom - 1e-9);
      }
    }
  }
}

TEST_CASE(
    "what leads from one to one stands at one height, and wires come to a box in the order of where they are from") {
  const Layers row({0, 1, 2}, {52, 80, 52}, {{0, 1}, {1, 2}});
  CHECK(near(row.middle_of(0), 40, 1e-9));
  CHECK(near(row.middle_of(1), 40, 1e-9));
  CHECK(near(row.middle_of(2), 40, 1e-9));
  const Layers fan({0, 0, 0, 1}, {52, 52, 52, 80}, {{2, 3}, {0, 3}, {1, 3}});
  const std::vector<std::size_t> wires = fan.wires_to(3);
  REQUIRE(wires.size() == 3);
  const std::size_t from[] = {2, 0, 1};
  CHECK(fan.middle_of(from[wires[0]]) < fan.middle_of(from[wires[1]]));
  CHECK(fan.middle_of(from[wires[1]]) < fan.middle_of(from[wires[2]]));
}

TEST_CASE("what a machine's transitions say stays within the picture, however long it is") {
  const auto waits = [](const std::string& word) {
    return std::vector<GraphCondition>{{.kind = GraphCondition::Kind::event, .name = word},
                                       {.kind = GraphCondition::Kind::time_in_state, .value = 0.5}};
  };
  for (const std::size_t count : {1U, 2U, 3U, 5U, 9U}) {
    MachinePose machine{.start = "0", .states = {}};
    for (std::size_t i = 0; i < count; ++i) {
      machine.states.push_back({std::to_string(i), "pose"});
      machine.transitions.push_back(
          {.to = std::to_string(i), .when = waits(i % 2 == 0 ? "halt" : "whatever is to be waited for")});
    }
    const GraphDescription graph{.name = "figure", .poses = {{"pose", RestPose{}}, {"machine", machine}}};
    const std::string svg = graph_svg({&graph, 1});
    const auto number = [&](std::size_t from, const std::string& name) {
      return std::stod(svg.substr(svg.find(" " + name + "=\"", from) + name.size() + 3));
    };
    const double width = number(0, "width");
    std::size_t labels = 0;
    for (std::size_t at = 0; (at = svg.find("fill-opacity=\"0.88\"", at)) != std::string::npos; ++at) {
      const std::size_t rect = svg.rfind("<rect", at);
      CHECK(number(rect, "x") >= 0);
      CHECK(number(rect, "x") + number(rect, "width") <= width);
      ++labels;
    }
    CHECK(labels == count);
  }
}

TEST_CASE("long names and words stand whole in a graph's picture, and boxes get wider for them alone") {
  const auto picture = [](const std::string& clip, const std::string& pose) {
    const GraphDescription graph{.name = "figure", .poses = {{pose, ClipPose{.clip = clip}}}};
    return graph_svg({&graph, 1});
  };
  const std::string clip = "walk forward and wave", pose = "walking over the whole of the hill";
  const std::string wide = picture(clip, pose), usual = picture("walk", "walking");
  for (const std::string& words : {clip, pose}) CHECK_MESSAGE(wide.find(">" + words + "<") != std::string::npos, words);
  const auto width = [](const std::string& svg) { return std::stod(svg.substr(svg.find(" width=\"") + 8)); };
  CHECK(width(wide) > width(usual));
  CHECK(width(picture("run", "running")) == width(usual));
  CHECK(width(picture("walk", std::string(500, 'w'))) < width(usual) + 300);
}

TEST_CASE("poses that only change one another stand below each other in a graph's picture, not in one long row") {
  GraphDescription graph{.name = "figure", .poses = {{"walking", ClipPose{.clip = "walk"}}}};
  const auto change = [&](const std::string& name, const std::string& base) {
    graph.poses.push_back({name, MirrorPose{.base = base}});
  };
  const auto place = [&](const std::string& svg, const std::string& name) {
    const std::size_t text = svg.rfind("<text", svg.find(">" + name + "<"));
    const auto number = [&](const std::string& of) {
      return std::stod(svg.substr(svg.find(of + "=\"", text) + of.size() + 2));
    };
    return Vec2(number(" x"), number(" y"));
  };
  // Written in another order than they stand in.
  change("last", "third");
  change("second", "walking");
  change("third", "second");
  graph.output = "last";
  const std::string svg = graph_svg({&graph, 1});
  const char* const names[] = {"walking", "second", "third", "last"};
  for (std::size_t i = 1; i < std::size(names); ++i) {
    CHECK(place(svg, names[i]).x() == place(svg, names[0]).x());
    CHECK(place(svg, names[i]).y() > place(svg, names[i - 1]).y() + 40);
  }
  // What two others use is the end of its stack.
  graph.poses.push_back({"both", BlendPose{{{"third", 1.0}, {"last", 1.0}}}});
  graph.output = "both";
  const std::string shared = graph_svg({&graph, 1});
  CHECK(place(shared, "third").x() == place(shared, "walking").x());
  CHECK(place(shared, "last").x() > place(shared, "third").x());
  CHECK(place(shared, "both").x() > place(shared, "last").x());
}
