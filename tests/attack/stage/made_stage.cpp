#include "attack/stage/made.h"

#include <tweenfall/curves/keys.h>

#include <array>
#include <initializer_list>
#include <limits>

namespace tweenfall::attack {

namespace {

void add_bodies(Random& random, StageDescription& stage) {
  const std::size_t count = 2 + below(random, 6);
  for (std::size_t i = 0; i < count; ++i) {
    BodyDescription body{.shape = made_shape(random), .mass = random.between(0.1, 5)};
    body.restitution = random.unit();
    if (below(random, 3) == 0) body.drive = Drive{.hz = random.between(0.5, 50)};
    if (below(random, 8) == 0) body.surface_velocity.linear = random.vector(1);
    if (below(random, 8) == 0) body.groups = 1 + below(random, 3);
    stage.nodes.push_back({.name = "body" + std::to_string(i),
                           .parent = below(random, 4) == 0 && i > 0 ? 1 + below(random, i) : no_node,
                           .rest = {.position = random.vector(1.5) + Vec3(0, 1.5, 0)},
                           .body = body});
  }
  if (below(random, 4) == 0)
    stage.nodes.push_back({.name = "zone",
                           .rest = {.position = Vec3(0, 1, 0)},
                           .body = BodyDescription{.shape = {Sphere{0.8}}, .sensor = true, .fixed = true}});
}

void add_clip(Random& random, StageDescription& stage) {
  Clip clip{.name = "move", .duration = 1, .loop = {static_cast<LoopMode>(below(random, 4)), 0}};
  for (std::size_t node = 1; node < stage.nodes.size(); node += 2) {
    if (!stage.nodes[node].name.starts_with("body")) continue;
    const auto place = [&] { return Vec3(random.vector(1) + Vec3(0, 1, 0)); };
    clip.tracks.push_back({stage.nodes[node].name, "position",
                           keyed_curve<Vec3>({{.time = 0, .value = place()},
                                              {.time = random.between(0.2, 0.8), .value = place()},
                                              {.time = 1, .value = place()}})});
  }
  clip.tracks.push_back({"body1", "color",
                         keyed_curve<Color>({{.time = 0, .value = Color{Vec4(1, 0, 0, 1)}},
                                             {.time = 1, .value = Color{Vec4(0, 0, 1, 1)}}})});
  clip.tracks.push_back({"body0", "effort", keyed_curve<double>({{.time = 0, .value = 1}, {.time = 1, .value = 2}})});
  clip.events = {{.from = 0.25, .to = 0.25, .name = "mark"}, {.from = 0.4, .to = 0.6, .name = "span"}};
  stage.clips.push_back(clip);
  stage.plays.push_back({.clip = 0, .at = random.between(0, 0.2), .speed = below(random, 5) ? 1 : -0.7});
}

/// Machines, blends, and springs after them, over the bodies that the clip moves.
void add_graph(Random& random, StageDescription& stage) {
  GraphDescription graph{.name = "figure"};
  graph.parameters = {{.name = "speed"}, {.name = "follow", .start = 0.5, .half_life = 0.1}};
  const GraphTransition starts{
      .from = {"still"},
      .to = "moves",
      .when = {{.kind = GraphCondition::Kind::above, .name = "speed", .value = 0.5}},
      .change = {.kind = static_cast<GraphChange::Kind>(below(random, 4)), .seconds = random.between(0.1, 0.4)}};
  const GraphTransition ends{.from = {},
                             .to = "still",
                             .when = {{.kind = GraphCondition::Kind::event, .name = "go"}},
                             .change = {.kind = GraphChange::Kind::quintic, .seconds = 0.3}};
  graph.poses = {{"rest", RestPose{}},
                 {"moving", ClipPose{.clip = "move", .loop = Loop{LoopMode::pingpong, 0}}},
                 {"legs", MachinePose{.start = "still",
                                      .states = {{"still", "rest"}, {"moves", "moving"}},
                                      .transitions = {starts, ends}}},
                 {"mixed", BlendPose{{{"legs", 1.0}, {"moving", ByParameter{"follow"}}}}}};
  if (below(random, 2))
    graph.poses.push_back({"swung", SpringPose{.base = "mixed", .node = "body1", .position = SpringSettings{}}});
  if (below(random, 2))
    graph.poses.push_back({"turned", LookAtPose{.base = graph.poses.back().name,
                                                .joints = {{.node = "body0"}},
                                                .target = {.at = {ByParameter{"follow"}, 1.0, 2.0}}}});
  graph.reactions = {{.event = "mark", .name = "go"}};
  stage.graphs.push_back(graph);
}

void add_joints(Random& random, StageDescription& stage) {
  const std::size_t bodies = stage.nodes.size() - 1;
  for (std::size_t count = 1 + below(random, 3); count > 0; --count) {
    const std::size_t a = below(random, 3) ? 1 + below(random, bodies) : no_node, b = 1 + below(random, bodies);
    if (a == b || stage.nodes[b].name == "zone" || (a != no_node && stage.nodes[a].name == "zone")) continue;
    JointDescription joint = made_joint({random}, a, b);
    joint.name = "joint" + std::to_string(count);
    if (below(random, 4) == 0) joint.until = when::At{random.between(0.1, 1)};
    stage.joints.push_back(joint);
  }
}

void add_forces(Random& random, StageDescription& stage) {
  const std::size_t body = 1 + below(random, 2);
  stage.forces.push_back({.force = Drag{.linear = random.between(0, 2), .quadratic = random.between(0, 1)}});
  const auto add = [&](ForceDescription force) {
    if (below(random, 3) == 0) stage.forces.push_back(std::move(force));
  };
  add({.force = Spring{.rest_length = 0.5, .stiffness = random.between(1, 1e4), .damping = 1}, .a = body});
  add({.force = Damper{.damping = random.between(0, 50)}, .a = 1, .b = 2});
  add({.force = Wind{.velocity = random.vector(5), .coefficient = 0.5}});
  add({.force = Buoyancy{.level = random.between(0, 1), .density = 1000, .drag = {.linear = 1}}});
  add({.force = Attractor{.at = random.vector(2), .acceleration = 3, .softening = 0.2}});
  add({.force = Vortex{.acceleration = 2, .softening = 0.2}});
  add({.force = ForceFormula({"sin(t)", "0", "-x"}), .strength = Strength::formula("step(0.3, t)")});
  add({.force = Push{.force = random.vector(3), .turns = true}, .a = body});
}

void add_rules(Random& random, StageDescription& stage) {
  const Arguments arguments{random};
  for (std::size_t count = 1 + below(random, 3); count > 0; --count)
    stage.rules.push_back(made_rule(arguments, random.between(0, 0.5)));
}

void add_vehicle(Random& random, StageDescription& stage) {
  stage.nodes.push_back(
      {.name = "chassis",
       .rest = {.position = Vec3(random.between(-3, 3), 1, 4)},
       .body = BodyDescription{.shape = {Box{Vec3(1, 0.25, 0.5)}}, .mass = 400, .drive = Drive::free()}});
  VehicleDescription vehicle{.name = "car", .chassis = stage.nodes.size() - 1};
  for (const double x : {-0.8, 0.8})
    for (const double z : {-0.5, 0.5})
      vehicle.wheels.push_back({.name = "wheel" + std::to_string(vehicle.wheels.size()),
                                .wheel = {.mount = Vec3(x, 0, z), .stiffness = 2e4, .damping = 2e3},
                                .torque = 100,
                                .brake = 300,
                                .lock = x > 0 ? 0.5 : 0.0});
  vehicle.throttle = keyed_curve<double>({{.time = 0, .value = 0}, {.time = 0.5, .value = 1}});
  stage.vehicles.push_back(vehicle);
}

void add_soft(Random& random, StageDescription& stage) {
  SoftDescription soft{.name = "soft"};
  if (below(random, 2)) {
    soft.soft = rope({.from = Vec3(-1, 2, 0),
                      .to = Vec3(1, 2, 0),
                      .links = 6,
                      .mass = 0.3,
                      .stiffness = 2000,
                      .tear = below(random, 2) ? 0.3 : std::numeric_limits<double>::infinity()});
    soft.pins = {{.node = 0}, {.node = 6, .to = 1, .until = when::At{random.between(0.2, 1)}}};
  } else {
    soft.soft = cloth({.corner = Vec3(-0.5, 1.5, -0.5), .columns = 3, .rows = 3});
    soft.soft.thickness = below(random, 2) ? 0.05 : 0;
    soft.soft.air_drag = 1;
    soft.pins = {{.node = 0}, {.node = 3, .until = when::Event{"mark"}}};
  }
  soft.soft.sub_step = 1.0 / 480;
  if (below(random, 3) == 0) soft.soft.solver = SoftSolver::springs;
  stage.softs.push_back(std::move(soft));
}

void add_particles(Random& random, StageDescription& stage) {
  ParticlesDescription particles{.name = "sparks"};
  particles.settings.life = 0.5;
  particles.settings.radius = 0.02;
  particles.collide = below(random, 2) == 0;
  particles.emitters = {{.node = 1,
                         .rate = Curve<double>(random.between(0, 100)),
                         .speed = Curve<double>(3.0),
                         .spread = 0.5,
                         .speed_spread = 0.2,
                         .size = 0.1}};
  particles.forces = {{.force = Drag{.linear = 1e-3}}};
  stage.particles.push_back(std::move(particles));
}

}  // namespace

StageDescription made_stage(Random& random) {
  StageDescription stage;
  stage.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  add_bodies(random, stage);
  add_clip(random, stage);
  using Part = void (*)(Random&, StageDescription&);
  // Joints before anything that brings a body of its own, which stays free.
  for (const Part part :
       std::initializer_list<Part>{add_graph, add_joints, add_forces, add_rules, add_vehicle, add_soft, add_particles})
    if (below(random, 3) == 0) part(random, stage);
  stage.ignored = {{1, 2}};
  static constexpr std::array ways{Integrator::exact_quadratic, Integrator::semi_implicit_euler, Integrator::rk4,
                                   Integrator::backward_euler, Integrator::implicit_trapezoid};
  if (below(random, 4) == 0) stage.world.integrator = ways[below(random, ways.size())];
  if (below(random, 8) == 0) stage.world.threads = 2;
  stage.step = below(random, 2) ? 1.0 / 240 : 1.0 / 60;
  return stage;
}

}  // namespace tweenfall::attack
