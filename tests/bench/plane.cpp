// A pyramid of N rows in a plane, in space and, if it is installed, in Box2D 2.4, one thread, nothing asleep:
// milliseconds of process time per step. All take turns, run by run; the least median of the runs is printed.
//   bench_plane [--rows N] [--steps N] [--runs N]

#include <tweenfall/physics/planar_world.h>

#ifdef TWEENFALL_BESIDE_BOX2D
#include <box2d/box2d.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace tweenfall;

constexpr double dt = 1.0 / 60;

/// Where the boxes are, row by row, the top one last: as in ../shared/scenes/pyramid50.json.
std::vector<Vec2> boxes(int rows) {
  std::vector<Vec2> all;
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i) all.emplace_back(-0.55 * (rows - 1) + 0.55 * row + 1.1 * i, 0.5 + row);
  return all;
}

struct Pyramid {
  std::function<void()> step;
  std::function<Vec2()> top;
};

Pyramid in_plane(int rows) {
  const auto world = std::make_shared<planar::World>(planar::WorldSettings{.sleep_after = INFINITY});
  world->add(
      {.shape = {planar::Box{Vec2(100, 1)}}, .friction = 0.6, .fixed = true, .motion = {.position = Vec2(0, -1)}});
  BodyId last;
  for (const Vec2& at : boxes(rows))
    last = world->add({.shape = {planar::Box{}}, .mass = 1.0, .friction = 0.6, .motion = {.position = at}});
  return {[world] { world->step(dt); }, [world, last] { return world->motion(last).position; }};
}

Pyramid in_space(int rows) {
  const auto world = std::make_shared<World>(WorldSettings{.sleep_after = INFINITY});
  BodySettings floor{.shape = {Box{Vec3(100, 1, 100)}}, .friction = 0.6, .fixed = true};
  floor.motion.pose.position = Vec3(0, -1, 0);
  world->add(floor);
  BodyId last;
  for (const Vec2& at : boxes(rows)) {
    BodySettings box{.shape = {Box{}}, .mass = 1.0, .friction = 0.6};
    box.motion.pose.position = Vec3(at.x(), at.y(), 0);
    last = world->add(box);
  }
  return {[world] { world->step(dt); },
          [world, last] {
            const Vec3 position = world->motion(last).pose.position;
            return Vec2(position.x(), position.y());
          }};
}

#ifdef TWEENFALL_BESIDE_BOX2D
Pyramid in_box2d(int rows) {
  const auto world = std::make_shared<b2World>(b2Vec2(0, -9.81F));
  world->SetAllowSleeping(false);
  b2BodyDef floor;
  floor.position.Set(0, -1);
  b2PolygonShape shape;
  shape.SetAsBox(100, 1);
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.friction = 0.6F;
  world->CreateBody(&floor)->CreateFixture(&fixture);
  shape.SetAsBox(0.5F, 0.5F);
  fixture.density = 1;
  b2Body* last = nullptr;
  for (const Vec2& at : boxes(rows)) {
    b2BodyDef box;
    box.type = b2_dynamicBody;
    box.position.Set(static_cast<float>(at.x()), static_cast<float>(at.y()));
    last = world->CreateBody(&box);
    last->CreateFixture(&fixture);
  }
  // The passes that its manual suggests.
  return {[world] { world->Step(static_cast<float>(dt), 8, 3); },
          [world, last] { return Vec2(last->GetPosition().x, last->GetPosition().y); }};
}
#endif

struct Timed {
  const char* name;
  Pyramid (*make)(int rows);
  double median = INFINITY;
  Vec2 top{0, 0};
};

double process_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void run(Timed& timed, int rows, int steps) {
  const Pyramid pyramid = timed.make(rows);
  std::vector<double> times(static_cast<std::size_t>(steps));
  for (double& time : times) {
    const double before = process_time();
    pyramid.step();
    time = 1e3 * (process_time() - before);
  }
  std::sort(times.begin(), times.end());
  timed.median = std::min(timed.median, times[times.size() / 2]);
  timed.top = pyramid.top();
}

}  // namespace

int main(int count, char** arguments) {
  int rows = 50, steps = 300, runs = 3;
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string argument = arguments[i];
    (argument == "--rows" ? rows : argument == "--steps" ? steps : runs) = std::max(1, std::atoi(arguments[i + 1]));
  }
  std::vector<Timed> all{{"plane", in_plane}, {"space", in_space}};
#ifdef TWEENFALL_BESIDE_BOX2D
  all.push_back({"Box2D 2.4", in_box2d});
#else
  std::printf("SKIPPED: Box2D, built without it (libbox2d-dev)\n");
#endif
  for (int i = 0; i < runs; ++i)
    for (Timed& timed : all) run(timed, rows, steps);
  const Vec2 began = boxes(rows).back();
  std::printf("pyramid of %d rows, %d steps\n", rows, steps);
  for (const Timed& timed : all)
    std::printf("  %-9s %8.3f ms, %.3f of that in space; top off %.1f mm, sunk %.1f mm\n", timed.name, timed.median,
                timed.median / all[1].median, 1e3 * (timed.top.x() - began.x()), 1e3 * (began.y() - timed.top.y()));
}
