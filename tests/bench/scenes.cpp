// Scenes of many bodies, one thread, nothing asleep: milliseconds of process time per step, beside Bullet if it
// is installed, and the state in which they end.
//   bench_physics [--scenes FOLDER] [--runs N] [--steps N] [--ours] [--threads N] [SCENE...]
//   bench_physics --growth: the cost of a step of 500 to 50,000 spheres, divided by n log n
//   bench_physics --stack: the cost of a step of ten boxes on top of each other
// The engines take turns, run by run; the least median and the least 99th percentile of the runs are printed. `--ours`
// leaves Bullet out, to profile one scene: perf record -g bench_physics --ours --runs 1 pyramid50

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine.h"
#include "physics/scene_file.h"

namespace {

using namespace tweenfall;
using namespace tweenfall::bench;

struct Wanted {
  std::filesystem::path folder = std::string(TWEENFALL_SOURCE_DIR) + "/../shared/scenes";
  int runs = 3;
  int steps = 0;  // 0: as many as the scene says
  bool only_ours = false;
  int threads = 0;  // if more than one, also measured with so many, in wall-clock time
  std::vector<std::string> names;
};

class OurEngine : public Engine {
 public:
  OurEngine(const test::Scene& scene, std::shared_ptr<Executor> executor)
      : world_(scene.world), bodies_(scene.bodies), dt_(scene.dt) {
    world_.set_executor(std::move(executor));
  }
  [[nodiscard]] std::uint64_t hash() const { return world_.state_hash(); }
  void step() override { world_.step(dt_); }
  [[nodiscard]] Motion motion(std::size_t body) const override {
    Motion motion = world_.motion(bodies_[body]);
    motion.twist = world_.twist(bodies_[body]);
    return motion;
  }

 private:
  World world_;
  std::vector<BodyId> bodies_;
  double dt_;
};

double process_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Measured {
  double median = INFINITY, slow = INFINITY;  // ms
  double top_off = 0;                         // how far the last body is from above where it began, m
  double overlap = 0;                         // the greatest, m
  double gap = 0;                             ///< of the joint that is widest open, m
  double energy = 0;                          // kinetic, J
};

void run(Engine& engine, int steps, Measured& measured) {
  std::vector<double> times(static_cast<std::size_t>(steps));
  for (double& time : times) {
    const double before = process_time();
    engine.step();
    time = 1e3 * (process_time() - before);
  }
  std::sort(times.begin(), times.end());
  measured.median = std::min(measured.median, times[times.size() / 2]);
  measured.slow = std::min(measured.slow, times[times.size() * 99 / 100]);
}

/// Does all parts alone and sums up their time: the rest of a step is what no number of threads makes faster.
class Accountant : public Executor {
 public:
  explicit Accountant(int threads) : threads_(static_cast<std::size_t>(threads)) {}
  void for_each(std::size_t count, const Work& work) override {
    const double before = process_time();
    for (std::size_t i = 0; i < count; ++i) work(i);
    shared += 1e3 * (process_time() - before);
    ++calls;
  }
  [[nodiscard]] std::size_t threads() const noexcept override { return threads_; }
  double shared = 0;  // ms
  int calls = 0;

 private:
  std::size_t threads_;
};

/// How much faster this many threads are than one, in wall-clock time: step by step, in turns.
void compare_threads(const test::Scene& scene, int steps, int threads) {
  OurEngine one(scene, nullptr), many(scene, std::make_shared<ThreadPool>(static_cast<std::size_t>(threads)));
  std::vector<double> ratios, times;
  const auto time_of = [](Engine& engine) {
    const auto before = std::chrono::steady_clock::now();
    engine.step();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
  };
  for (int i = 0; i < steps; ++i) {
    const double alone = time_of(one);
    times.push_back(time_of(many));
    ratios.push_back(alone / times.back());
  }
  std::sort(ratios.begin(), ratios.end());
  std::sort(times.begin(), times.end());
  double load[1] = {0};
  if (getloadavg(load, 1) != 1) load[0] = NAN;
  std::printf(
      "  %d threads %8.3f ms, %.2f times as fast as one in the median step (%.2f in the quarter of the fastest; "
      "load %.1f); the same state: %s\n",
      threads, times[times.size() / 2], ratios[ratios.size() / 2], ratios[ratios.size() * 3 / 4], load[0],
      one.hash() == many.hash() ? "yes" : "NO");
  const auto accountant = std::make_shared<Accountant>(threads);
  OurEngine counted(scene, accountant);
  const double before = process_time();
  for (int i = 0; i < steps; ++i) counted.step();
  const double all = 1e3 * (process_time() - before);
  std::printf("  %.0f %% of the time is shared, in %d calls a step: at most %.2f times as fast\n",
              100 * accountant->shared / all, accountant->calls / steps,
              all / (all - accountant->shared * (threads - 1) / threads));
}

void look(const Engine& engine, const test::Scene& scene, Measured& measured) {
  struct Placed {
    Bounds bounds;
    Motion motion;
    std::size_t body;
  };
  std::vector<Placed> placed;
  placed.reserve(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Motion motion = engine.motion(i);
    placed.push_back({bounds(scene.settings[i].shape, motion.pose), motion, i});
    if (scene.settings[i].fixed) continue;
    const MassProperties& mass = scene.world.mass(scene.bodies[i]);
    const Vec3 local = motion.pose.rotation.conjugate() * motion.twist.angular;
    measured.energy += 0.5 * mass.mass * motion.twist.linear.squaredNorm() + 0.5 * local.dot(mass.inertia * local);
  }
  const Vec3 off = placed.back().motion.pose.position - scene.settings.back().motion.pose.position;
  measured.top_off = std::hypot(off.x(), off.z());
  for (const JointSettings& joint : scene.joints) {
    const auto end = [&](const BodyId& id, const Pose& frame) {
      return transform_point(engine.motion(id.index).pose, frame.position);
    };
    measured.gap = std::max(measured.gap, (end(joint.b, joint.frame_b) - end(joint.a, joint.frame_a)).norm());
  }
  if (!scene.file.value("collisions", true)) return;
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.bounds.low.x() < b.bounds.low.x(); });
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (std::size_t k = i + 1; k < placed.size() && placed[k].bounds.low.x() <= placed[i].bounds.high.x(); ++k) {
      const Placed &a = placed[i], &b = placed[k];
      if (scene.settings[a.body].fixed && scene.settings[b.body].fixed) continue;
      if ((a.bounds.low.array() > b.bounds.high.array()).any() || (b.bounds.low.array() > a.bounds.high.array()).any())
        continue;
      const Manifold manifold =
          collide(scene.settings[a.body].shape, a.motion.pose, scene.settings[b.body].shape, b.motion.pose);
      const auto joins = [&](const JointSettings& joint) {
        return joint.a.index == std::min(a.body, b.body) && joint.b.index == std::max(a.body, b.body);
      };
      if (std::any_of(scene.joints.begin(), scene.joints.end(), joins)) continue;
      for (int point = 0; point < manifold.count; ++point)
        measured.overlap = std::max(measured.overlap, manifold.points[static_cast<std::size_t>(point)].penetration);
    }
}

void tell(const char* engine, const Measured& measured) {
  std::printf("  %-9s %9.3f ms (%8.3f)   last body off %8.1f mm, overlap %6.2f mm, kinetic energy %.3g J", engine,
              measured.median, measured.slow, 1e3 * measured.top_off, 1e3 * measured.overlap, measured.energy);
  if (measured.gap > 0) std::printf(", joints apart %.3f mm", 1e3 * measured.gap);
  std::printf("\n");
}

bool compare(const Wanted& wanted, const std::string& name) {
  const std::filesystem::path path = wanted.folder / (name + ".json");
  std::ifstream stream(path);
  if (!stream) {
    std::printf("SKIPPED: no scene %s\n", path.c_str());
    return false;
  }
  const test::Scene scene = test::scene_from(nlohmann::json::parse(stream));
  for (const std::string& type : scene.left_out) std::printf("SKIPPED: bodies of shape %s\n", type.c_str());
  const int steps = wanted.steps > 0 ? wanted.steps : scene.steps;
  Measured ours;
  [[maybe_unused]] Measured bullets;
  for (int i = 0; i < wanted.runs; ++i) {
    OurEngine engine(scene, nullptr);
    run(engine, steps, ours);
    if (i == 0) look(engine, scene, ours);
#ifdef TWEENFALL_BESIDE_BULLET
    if (wanted.only_ours) continue;
    const std::unique_ptr<Engine> beside = in_bullet(scene);
    run(*beside, steps, bullets);
    if (i == 0) look(*beside, scene, bullets);
#endif
  }
  if (std::isfinite(bullets.median))
    std::printf("%s, %d steps: %.3f of Bullet's time\n", name.c_str(), steps, ours.median / bullets.median);
  else
    std::printf("%s, %d steps\n", name.c_str(), steps);
  tell("tweenfall", ours);
  if (std::isfinite(bullets.median)) tell("Bullet", bullets);
  if (wanted.threads > 1) compare_threads(scene, steps, wanted.threads);
  std::fflush(stdout);
  return true;
}

/// Spheres dropped into an open box from the same height, however many they are: their median step while they settle.
double step_of_spheres(int count) {
  World world({.sleep_after = INFINITY});
  const int side = static_cast<int>(std::ceil(std::sqrt(count / 16.0)));
  const double half = 0.5 * 0.55 * side + 0.25;
  const auto fixed = [&](const Vec3& half_extents, const Vec3& position) {
    BodySettings body{.shape = {Box{half_extents}}, .fixed = true};
    body.motion.pose.position = position;
    world.add(body);
  };
  fixed(Vec3(half + 2, 1, half + 2), Vec3(0, -1, 0));
  for (const double to : {-1.0, 1.0}) {
    fixed(Vec3(0.5, 20, half + 1), Vec3(to * (half + 0.5), 20, 0));
    fixed(Vec3(half + 1, 20, 0.5), Vec3(0, 20, to * (half + 0.5)));
  }
  for (int i = 0; i < count; ++i) {
    const int across = i % side, along = i / side % side, up = i / side / side;
    BodySettings body{.shape = {Sphere{0.25}}, .friction = 0.5, .restitution = 0.2};
    body.motion.pose.position =
        Vec3(0.55 * (across - 0.5 * (side - 1)) + 0.01 * ((7 * up + across) % 3 - 1), 1 + 0.55 * up,
             0.55 * (along - 0.5 * (side - 1)) + 0.01 * ((5 * up + along) % 3 - 1));
    world.add(body);
  }
  constexpr int falling = 60, measured = 60;
  std::vector<double> times;
  times.reserve(measured);
  for (int i = 0; i < falling + measured; ++i) {
    const double before = process_time();
    world.step(1.0 / 60);
    if (i >= falling) times.push_back(1e3 * (process_time() - before));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void tell_growth() {
  double first = 0;
  for (const int count : {500, 1000, 2000, 5000, 10000, 20000, 50000}) {
    const double time = step_of_spheres(count), part = time / (count * std::log2(count));
    if (first == 0) first = part;
    std::printf("%6d spheres %9.3f ms, %.2f times as much for n log n as of 500\n", count, time, part / first);
    std::fflush(stdout);
  }
}

/// Ten boxes at rest on top of each other, nothing asleep: the world that a game steps most often.
void tell_stack() {
  World world({.sleep_after = INFINITY});
  world.add({.shape = {Box{{5, 1, 5}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
  for (int i = 0; i < 10; ++i)
    world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
               .friction = 0.5,
               .motion = {.pose = {.position = {0.01 * (i % 3), 0.5 + i, 0.01 * (i % 2)}}}});
  constexpr int settling = 120, measured = 2000;
  std::vector<double> times;
  times.reserve(measured);
  for (int i = 0; i < settling + measured; ++i) {
    const double before = process_time();
    world.step(1.0 / 60);
    if (i >= settling) times.push_back(1e6 * (process_time() - before));
  }
  std::sort(times.begin(), times.end());
  std::printf("ten boxes %9.2f us (%.2f)\n", times[times.size() / 2], times[times.size() * 99 / 100]);
}

}  // namespace

int main(int count, char** arguments) try {
  Wanted wanted;
  if (const char* folder = std::getenv("TWEENFALL_SCENES")) wanted.folder = folder;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    const auto value = [&] { return i + 1 < count ? arguments[++i] : throw std::runtime_error(argument + " what?"); };
    if (argument == "--scenes")
      wanted.folder = value();
    else if (argument == "--runs")
      wanted.runs = std::max(1, std::atoi(value()));
    else if (argument == "--steps")
      wanted.steps = std::atoi(value());
    else if (argument == "--threads")
      wanted.threads = std::atoi(value());
    else if (argument == "--growth") {
      tell_growth();
      return 0;
    } else if (argument == "--stack") {
      tell_stack();
      return 0;
    } else if (argument == "--ours")
      wanted.only_ours = true;
    else
      wanted.names.push_back(argument);
  }
#ifndef TWEENFALL_BESIDE_BULLET
  if (!wanted.only_ours) std::printf("SKIPPED: Bullet, built without it (libbullet-dev)\n");
#endif
  if (wanted.names.empty())
    wanted.names = {"pyramid20", "pyramid50", "spheres1000", "spheres5000", "mixed1000", "free10000", "ragdolls100"};
  bool all = true;
  for (const std::string& name : wanted.names) all = compare(wanted, name) && all;
  return all ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_physics: %s\n", error.what());
  return 2;
}
