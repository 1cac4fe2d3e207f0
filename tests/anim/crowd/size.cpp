#include "bench/crowd_clip.h"
#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;
using tweenfall::bench::CrowdFigure;

TEST_CASE(
    "figures of 1 to 200 joints keep a tenth of a millimeter, in no more than 5,000 bytes for each of many joints, and "
    "7,500 of few") {
  for (const std::uint32_t size : {1U, 20U, 67U, 200U}) {
    const auto nodes = CrowdFigure::nodes(size);
    const Animation exact(nodes, {CrowdFigure::clip(size, Ease::linear())}, {{.clip = 0}});
    const CrowdClip clip = compile(exact.clips()[0], *nodes);
    double farthest = 0;
    const int times = size > 100 ? 197 : 997;
    for (int i = 0; i < times; ++i) farthest = std::max(farthest, distance(exact, clip, 10.0 * (i + 0.37) / times));
    INFO("joints ", size);
    CHECK(farthest <= 1e-4);
    CHECK(clip.error() <= 1e-4);
    if (size == 67) CHECK(clip.byte_count() <= 300000);
    if (size >= 20) CHECK(clip.byte_count() <= (size < 60 ? 7500 : 5000) * size);
  }
}

TEST_CASE("asked for the smallest, a crowd's clip takes less room and keeps its tolerance") {
  const auto nodes = CrowdFigure::nodes(67);
  const Animation exact(nodes, {CrowdFigure::clip(67, Ease::linear())}, {{.clip = 0}});
  const CrowdClip quick = compile(exact.clips()[0], *nodes);
  const CrowdClip small = compile(exact.clips()[0], *nodes, {.smallest = true});
  CHECK(small.byte_count() < 0.9 * static_cast<double>(quick.byte_count()));
  for (int i = 0; i < 97; ++i) CHECK(distance(exact, small, 10.0 * (i + 0.6) / 97) <= 1e-4);
}

TEST_CASE("a figure in other units is compiled into as much room, to a tolerance in these units") {
  const auto of_unit = [](double unit) {
    const auto figure = random_figure(9, 12);
    std::vector<Node> joints(figure->nodes().begin(), figure->nodes().end());
    joints[0].rest.position = Vec3(0, 0, 0);
    const auto nodes = std::make_shared<const Hierarchy>(joints);
    Clip clip = random_clip(33, *nodes, 1);
    std::erase_if(clip.tracks, [](const Track& track) { return track.node == "joint0"; });
    clip.tracks.push_back({"joint0", "scale",
                           keyed_curve<Vec3>({{.time = 0, .value = unit * Vec3(1, 1, 1), .ease = Ease::smooth()},
                                              {.time = 0.4, .value = unit * Vec3(1.2, 0.9, 1), .ease = Ease::smooth()},
                                              {.time = 1, .value = unit * Vec3(1, 1.1, 0.8)}})});
    const Animation exact(nodes, {clip}, {{.clip = 0}});
    const CrowdClip compiled = compile(clip, *nodes, {.tolerance = 1e-3 * unit});
    for (int i = 0; i < 300; ++i) CHECK(distance(exact, compiled, (i + 0.4) / 300) <= compiled.error());
    CHECK(compiled.error() <= 1e-3 * unit);
    return static_cast<double>(compiled.byte_count());
  };
  const double in_meters = of_unit(1);
  for (const double unit : {1e-6, 1e-2, 1e3, 1e6}) CHECK(of_unit(unit) == doctest::Approx(in_meters).epsilon(0.3));
}
