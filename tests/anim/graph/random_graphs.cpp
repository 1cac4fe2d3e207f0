// Random graphs of all operations: rates against differences of high order, and memory allocation.

#include "curves/counted_allocations.h"
#include "figure_support.h"
#include "processor_time.h"

#include <map>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Poses each made of those before it.
class RandomGraph {
 public:
  explicit RandomGraph(std::uint64_t seed) : random_(seed) {}

  GraphDescription make(int poses) {
    GraphDescription graph = {.parameters = {{.name = "reach", .start = 0.2, .half_life = 0.3},
                                             {.name = "weight", .start = 0.4, .half_life = 0.25}},
                              .poses = {},
                              .inputs = {{0.1, "reach", 0.6}, {0.1, "weight", 0.9}, {1.6, "weight", 0.2}}};
    names_ = {"walk", "idle", "dance"};
    for (int i = 0; i < poses; ++i) {
      GraphPose pose{"p" + std::to_string(i), operation(i % kinds)};
      names_.push_back(pose.name);
      graph.poses.push_back(std::move(pose));
    }
    return graph;
  }
  static constexpr int kinds = 13;

  /// The same with clips in phase, machines that show one pose repeatedly, and continuing paths, in any order.
  GraphDescription make_lively(int poses) {
    GraphDescription graph = make(0);
    for (int i = 0; i < poses; ++i) {
      const std::size_t kind = random_.bits() % (kinds + 3);
      GraphPose pose{"p" + std::to_string(i), kind < kinds ? operation(static_cast<int>(kind)) : lively(kind - kinds)};
      names_.push_back(pose.name);
      graph.poses.push_back(std::move(pose));
    }
    return graph;
  }

 private:
  std::string pose() { return names_[names_.size() - 1 - random_.bits() % 3]; }
  GraphNumber weight() {
    const double constant = random_.between(0.2, 1);
    switch (random_.bits() % 3) {
      case 0:
        return constant;
      case 1:
        return keyed_curve<double>({{.time = 0, .value = constant}, {.time = 4, .value = 0.1, .ease = Ease::smooth()}});
      default:
        return ByParameter{"weight"};
    }
  }
  PoseOperation operation(int kind) {
    const std::string base = pose();
    GraphNumber share = weight();
    const auto over = [&](auto made) {
      made.base = base;
      return PoseOperation(std::move(made));
    };
    switch (kind) {
      case 0:
        return over(grip(share));
      case 1:
        return over(look(share));
      case 2:
        return over(curl(share, ChainMethod::fabrik));
      case 3:
        return over(curl(share, ChainMethod::ccd));
      case 4:
        return over(stand(share));
      case 5:
        return over(mirrored(share));
      case 6:
        return over(taken_over(share));
      case 7:
        return over(on_the_spot(share));
      case 8:
        return over(on_the_spot(share, "hips"));
      case 9:
        return BlendPose{{{base, 0.7}, {pose(), share}}};
      case 10:
        return over(SpringPose{.node = "head",
                               .position = SpringSettings{.hz = 3, .damping = 0.3},
                               .rotation = SpringSettings{.hz = 2, .damping = 0.4},
                               .weight = share});
      case 11:
        return over(JigglePose{.joints = {"tail 1", "tail 2", "tail 3", "tail 4"},
                               .spring = {.hz = 2, .damping = 0.3, .gravity = {0, -5, 0}},
                               .weight = share});
      default:
        return LayersPose{.base = base,
                          .layers = {{.pose = pose(), .weight = share, .mask = {{.joints = "spine", .below = true}}},
                                     {.pose = "dance", .adds = true, .reference = "idle", .weight = 0.3}}};
    }
  }

  PoseOperation lively(std::size_t kind) {
    if (kind == 0)
      return SpacePose{
          .by = {ByParameter{"reach"}}, .entries = {{"walk", {0, 0}}, {"idle", {0.5, 0}}}, .sync = std::string()};
    if (kind == 1) return RootMotionPose{.base = pose(), .node = "hips", .accumulates = true};
    const auto after = [&] {
      return GraphCondition{GraphCondition::Kind::time_in_state, "", random_.between(0.1, 0.5)};
    };
    return MachinePose{.start = "a",
                       .states = {{"a", pose()}, {"b", pose()}, {"c", names_.back()}},
                       .transitions = {{{"a"}, "b", {after()}, {GraphChange::Kind::fade, 0.4}},
                                       {{"b"}, "c", {after()}, {GraphChange::Kind::quintic, 0.3}},
                                       {{"c"}, "a", {after()}, {GraphChange::Kind::fade, 0.2}}}};
  }

  Random random_;
  std::vector<std::string> names_;
};

}  // namespace

TEST_CASE("graphs of any operations have the exact rates of what they show") {
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    GraphPlayer player(figure_graph(RandomGraph(seed).make(RandomGraph::kinds)));
    // In the middle of the steps of springs, which start over at 0.1 s and 1.6 s.
    for (const double time : {0.1 + 26.5 / 120, 0.1 + 140.5 / 120, 1.6 + 73.5 / 120}) {
      std::map<double, std::vector<Motion>> seen;  // the differences ask node by node
      const auto show = [&](double t) {
        std::vector<Motion>& pose = seen[t];
        if (pose.empty()) pose = shown(player, t);
        return pose;
      };
      const double error = worst_rate(show, time, 5e-4);
      CAPTURE(time);
      CHECK(error < 1e-2);
      errors.push_back(error);
    }
  }
  // A limit or a stretch that begins within the eight points of the differences is seen in them, not in the rates.
  std::ranges::sort(errors);
  CHECK(errors[errors.size() * 8 / 10] < 1e-6);
  MESSAGE("rates: half within " << errors[errors.size() / 2] << ", nine of ten within "
                                << errors[errors.size() * 9 / 10] << ", all within " << errors.back());
}

TEST_CASE("a graph of any operations gives the same bits whatever was asked before") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    const auto graph = figure_graph(RandomGraph(seed).make_lively(8));
    GraphPlayer first(graph), back(graph);
    std::vector<double> times;
    Random random(seed);
    for (int i = 0; i < 6; ++i) times.push_back(random.between(0, 2.4));
    std::vector<std::vector<Motion>> seen;
    for (const double time : times) seen.push_back(shown(first, time));
    for (int frame = 0; frame < 30; ++frame) static_cast<void>(shown(back, frame / 12.0, Side::in));
    for (std::size_t i = times.size(); i-- > 0;) CHECK(same_bits(shown(back, times[i]), seen[i]));
    GraphPlayer loaded(graph);
    first.seek(1.3);
    loaded.load(first.save());
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(same_bits(shown(loaded, times[i]), seen[i]));
  }
}

TEST_CASE("springs over springs, named again and again, take no longer than their number") {
  // Without caching, each would evaluate the one below for its whole way, several times: 6^8 poses per frame.
  GraphDescription graph = {.poses = {{"p0", BlendPose{{{"walk", 0.5}, {"idle", 0.5}}}}}};
  for (int i = 1; i <= 8; ++i) {
    const std::string base = "p" + std::to_string(i - 1), springy = "s" + std::to_string(i);
    graph.poses.push_back({springy, SpringPose{.base = base,
                                               .node = i % 2 == 0 ? "head" : "spine",
                                               .position = SpringSettings{.hz = 3, .damping = 0.3},
                                               .rotation = SpringSettings{.hz = 2}}});
    graph.poses.push_back({"p" + std::to_string(i), BlendPose{{{springy, 0.8}, {base, 0.2}}}});
  }
  GraphPlayer player(figure_graph(graph));
  const double before = processor_seconds();
  CHECK(std::isfinite(shown(player, 1.5)[8].pose.position.x()));
  CHECK(processor_seconds() - before < 1);  // 0.03 s where nothing else runs
}

TEST_CASE("a graph of any operations asks for no memory while it is evaluated") {
  GraphPlayer player(figure_graph(RandomGraph(3).make(2 * RandomGraph::kinds)));
  player.seek(5);
  std::vector<Motion> pose(player.graph().nodes().size());
  player.pose(pose);
  const std::size_t before = allocations();
  for (int frame = 0; frame < 8; ++frame) {
    player.seek(5 - 0.6 * frame);
    player.pose(pose);
    player.pose(pose, Side::in);
  }
  CHECK(allocations() == before);
}

TEST_CASE("a machine with blends, layers and clips in phase asks for no memory while what happened is known") {
  const GraphDescription described = {
      .parameters = {{.name = "speed", .half_life = 0.1}},
      .poses = {{"pace",
                 SpacePose{.by = {ByParameter{"speed"}}, .entries = {{"walk", {0, 0}}, {"idle", {1, 0}}}, .sync = ""}},
                {"legs",
                 MachinePose{.start = "pace",
                             .states = {{"pace", "pace"}, {"dance", "dance"}},
                             .transitions = {{{"pace"},
                                              "dance",
                                              {{GraphCondition::Kind::event, "go"}},
                                              {GraphChange::Kind::quintic, 0.4}},
                                             {{"dance"}, "pace", {{GraphCondition::Kind::time_in_state, "", 0.7}}}}}}},
      .inputs = {{0.4, "speed", 1}, {0.9, "go"}}};
  GraphPlayer player(figure_graph(described));
  player.seek(3);
  std::vector<Motion> pose(player.graph().nodes().size());
  player.pose(pose);
  const std::size_t before = allocations();
  for (int frame = 0; frame <= 180; ++frame) {
    player.seek(frame / 60.0);
    player.pose(pose);
  }
  CHECK(allocations() == before);
}
