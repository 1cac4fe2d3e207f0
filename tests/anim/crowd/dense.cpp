// Crowds of clips whose joints have many keys, none at the time of another: what is measured of them.

#include <tweenfall/anim/crowd.h>

#include "compiling/measuring.h"
#include "figures.h"

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE(
    "errors are measured at bends from both sides, within each piece three times or more, and hardly more often") {
  Random random(11);
  std::vector<std::vector<double>> channels(20);
  for (std::vector<double>& knots : channels) {
    knots = {0, 10};
    for (int i = 0; i < 400; ++i) knots.push_back(random.between(0, 10));
    std::ranges::sort(knots);
  }
  channels[3].insert(channels[3].begin() + 7, channels[3][7]);  // a jump
  const double jump = channels[3][7], bend = 3.21;
  std::vector<const std::vector<double>*> all;
  for (const std::vector<double>& knots : channels) all.push_back(&knots);
  const std::vector<crowd::Instant> instants = crowd::telling_instants(all, {bend}, 10);
  for (const double time : {0.0, jump, bend, 10.0})
    for (const Side side : {Side::in, Side::out}) {
      const auto is_it = [&](const crowd::Instant& each) { return each.time == time && each.side == side; };
      CHECK(std::ranges::count_if(instants, is_it) == (time == 0 && side == Side::in ? 0 : 1));
    }
  REQUIRE(std::ranges::is_sorted(instants, {}, &crowd::Instant::time));
  std::size_t pieces = 0;
  double farthest = 0;  // between neighbors, of the piece
  for (const std::vector<double>& knots : channels)
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const double from = knots[i - 1], to = knots[i];
      if (!(to > from)) continue;
      ++pieces;
      double last = from;
      for (auto at = std::ranges::upper_bound(instants, from, {}, &crowd::Instant::time);
           at != instants.end() && at->time < to; ++at) {
        farthest = std::max(farthest, (at->time - last) / (to - from));
        last = at->time;
      }
      farthest = std::max(farthest, (to - last) / (to - from));
    }
  CHECK(farthest < 0.58);
  // Twenty channels share them.
  CHECK(instants.size() < 2 * pieces);
}

TEST_CASE("many keys at times of their own are compiled within the tolerance at any time") {
  Random random(17);
  const auto nodes = random_figure(4, 24);
  Clip clip{.name = "dense", .duration = 4};
  for (const Node& node : nodes->nodes()) {
    std::vector<Key<Quat>> keys;
    for (double time = 0; time < 4; time += random.between(1e-3, 0.07)) {
      const Ease ease = Ease::bezier(random.unit(), random.unit(), random.unit(), random.unit());
      keys.push_back({.time = time, .value = exp_map(random.vector(0.3)), .ease = ease});
    }
    clip.tracks.push_back({node.name, "rotation", keyed_curve<Quat>(keys)});
  }
  const Animation exact(nodes, {clip}, {{.clip = 0}});
  const CrowdClip compiled = compile(clip, *nodes);
  CHECK(compiled.error() <= 1e-4);
  double farthest = 0;
  for (int i = 0; i < 20000; ++i) farthest = std::max(farthest, distance(exact, compiled, random.between(0, 4)));
  CHECK(farthest <= 1e-4);
  CHECK(farthest > 0.7 * compiled.error());
}
