#include "document/actors/actors.h"
#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/forces/forces.h"
#include "document/joints/joints.h"
#include "document/ragdolls/ragdolls.h"
#include "document/report/spellings.h"
#include "document/soft/soft.h"

#include <tweenfall/physics/strategies.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace tweenfall::document::fields {

namespace {

using Kind = json::Value::Kind;

void read_step(const json::Value& value, StageDescription& stage, Building&) {
  stage.step = seconds_of_step(value);
}

const Form* gravity_form(FormStore& store, const ValueForms& values) {
  Form form = *values.vector;
  form.definition.clear();
  form.instead = gravity_meant;
  return store.add(std::move(form));
}

const Form* sleep_form(FormStore& store, const ValueForms& values) {
  return store.add(
      choice_of("seconds above 0, or \"never\"", {values.positive, store.add(words_of("\"never\"", {"never"}))}));
}

const Form* forces_form(FormStore& store, const ValueForms& values) {
  Form forces = list_of(forces::form(store, values), "a list of forces", 0);
  forces.one_per_line = true;
  return store.add(std::move(forces));
}

void read_forces(const json::Value& value, StageDescription& stage, Building& building) {
  for (const json::Value& force : value.items()) forces::read(force, stage.forces, building);
}

void read_joints(const json::Value& value, StageDescription&, Building& building) {
  joints::read(value, building);
}

void read_soft(const json::Value& value, StageDescription&, Building& building) {
  soft::read(value, building);
}

void read_vehicles(const json::Value& value, StageDescription&, Building& building) {
  actors::read_vehicles(value, building);
}

void read_particles(const json::Value& value, StageDescription&, Building& building) {
  actors::read_particles(value, building);
}

void read_ragdolls(const json::Value& value, StageDescription&, Building& building) {
  ragdolls::read(value, building);
}

const Form* ignore_form(FormStore& store, const ValueForms& values) {
  const Form* const pair =
      store.add(list_of(values.name, "a list of two names or patterns of nodes with bodies", 2, 2));
  return store.add(list_of(pair, "a list of pairs of names or patterns", 0));
}

void read_ignored(const json::Value& value, StageDescription& stage, Building& building) {
  constexpr std::size_t most = 1'000'000;
  for (const json::Value& pair : value.items()) {
    if (!pair.is(Kind::list) || pair.items().size() != 2) continue;
    const std::vector<std::size_t> first = bodies_named(pair.items()[0], building);
    const std::vector<std::size_t> second = bodies_named(pair.items()[1], building);
    if (first.size() == 1 && first == second) building.problems.add(pair.items()[1], "a body cannot ignore itself");
    if (stage.ignored.size() + first.size() * second.size() > most) {
      building.problems.add(pair, "more than a million pairs would ignore each other; give the bodies \"groups\"");
      return;
    }
    for (const std::size_t a : first)
      for (const std::size_t b : second)
        if (a != b) stage.ignored.emplace_back(a, b);
  }
}

const Table<StageDescription>& world_table() {
  using Stage = StageDescription;
  const auto of_world = [](auto WorldSettings::*part) {
    return [part](Stage & stage) -> auto& {
      return stage.world.*part;
    };
  };
  Meaning<Stage> sleep_after = member<Stage>(of_world(&WorldSettings::sleep_after));
  sleep_after.read = [](const json::Value& value, Stage& stage, Building&) {
    stage.world.sleep_after = value.is(Kind::text) ? std::numeric_limits<double>::infinity() : value.number();
  };
  static const Table<Stage> table(
      "a world",
      {{"gravity", gravity_form, "m/s^2", member<Stage>(of_world(&WorldSettings::gravity))},
       {"step", step_form, "s", {read_step, "\"1/240\""}, false, {}, {"dt", "timestep", "time_step"}},
       one_of<Stage, Integrator>("integrator", "an integrator", integrator_words(), "",
                                 of_world(&WorldSettings::integrator)),
       one_of<Stage, ContactSolver>("solver", "a solver",
                                    {{"iterative", ContactSolver::iterative},
                                     {"sequential", ContactSolver::sequential},
                                     {"shock", ContactSolver::shock},
                                     {"lcp", ContactSolver::lcp}},
                                    "how the contacts of an island are met", of_world(&WorldSettings::solver)),
       one_of<Stage, Parting>("separation", "a way to take overlap apart",
                              {{"soft", Parting::soft},
                               {"half", Parting::half},
                               {"by-mass", Parting::by_mass},
                               {"positional-impulse", Parting::positional_impulse},
                               {"closest-point", Parting::closest_point}},
                              "how overlap is taken apart", of_world(&WorldSettings::separation)),
       one_of<Stage, Detection>("collision", "a way to find that bodies meet", detection_words(),
                                "when bodies are found to meet", of_world(&WorldSettings::collision)),
       one_of<Stage, PairSearch>("broad_phase", "a way to find pairs",
                                 {{"tree", PairSearch::tree},
                                  {"all-pairs", PairSearch::all_pairs},
                                  {"sweep", PairSearch::sweep},
                                  {"grid", PairSearch::grid},
                                  {"quadtree", PairSearch::quadtree},
                                  {"octree", PairSearch::octree},
                                  {"kd-tree", PairSearch::kd_tree},
                                  {"bvh", PairSearch::bvh}},
                                 "how pairs are found that may meet", of_world(&WorldSettings::broad_phase)),
       one_of<Stage, WorldPlane>(
           "plane", "a plane",
           {{"none", WorldPlane::none}, {"xy", WorldPlane::xy}, {"xz", WorldPlane::xz}, {"yz", WorldPlane::yz}},
           "in which all bodies lie and turn", of_world(&WorldSettings::plane)),
       {"iterations", bounded("a whole number from 1 to 10000", 1, false, 10000, true), "passes of the contact solver",
        member<Stage>(of_world(&WorldSettings::iterations))},
       {"sleep_speed", &ValueForms::not_negative, "m/s below which a body counts as still",
        member<Stage>(of_world(&WorldSettings::sleep_speed))},
       {"sleep_after", sleep_form, "seconds of stillness", sleep_after},
       {"push_out_speed", &ValueForms::not_negative, "m/s at which overlap is taken apart",
        member<Stage>(of_world(&WorldSettings::push_out_speed))},
       {"threads", bounded("a whole number from 0 to 256", 0, false, 256, true),
        "that share a step; nothing that is recorded depends on it", member<Stage>(of_world(&WorldSettings::threads))},
       {"forces", forces_form, "", {read_forces, "[]"}},
       {"ragdolls", ragdolls::form, "fitted to imported figures, by the names of imports", {read_ragdolls, "{}"}},
       {"joints", joints::form, "what holds bodies together", {read_joints, "{}"}},
       {"soft", soft::form, "ropes, cloth and volumes", {read_soft, "{}"}},
       {"vehicles", actors::vehicles_form, "wheels that carry bodies", {read_vehicles, "{}"}, false, {}, {"cars"}},
       {"particles", actors::particles_form, "points that emitters let go", {read_particles, "{}"}},
       {"ignore", ignore_form, "pairs of bodies that pass through each other", {read_ignored, "[]"}}});
  return table;
}

}  // namespace

const Form* step_form(FormStore& store, const ValueForms& values) {
  Form fraction;
  fraction.kind = Form::Kind::text;
  fraction.pattern = "^1/[1-9][0-9]{0,8}$";
  fraction.fits = [](std::string_view text) {
    return text.size() > 2 && text.size() <= 11 && text.substr(0, 2) == "1/" && text[2] != '0' &&
           text.substr(2).find_first_not_of("0123456789") == std::string_view::npos;
  };
  fraction.why = step_meant;
  return store.add(choice_of("a step: seconds above 0, or \"1/N\"", {values.positive, store.add(std::move(fraction))}));
}

double seconds_of_step(const json::Value& value) {
  if (value.is(Kind::number)) return value.number();
  if (!value.is(Kind::text)) return 1.0 / 240;
  double parts = 240;
  std::from_chars(value.text().data() + 2, value.text().data() + value.text().size(), parts);
  return 1 / parts;
}

const std::vector<std::pair<std::string, Integrator>>& integrator_words() {
  static const std::vector<std::pair<std::string, Integrator>> words = {
      {"exact-quadratic", Integrator::exact_quadratic},
      {"semi-implicit-euler", Integrator::semi_implicit_euler},
      {"explicit-euler", Integrator::explicit_euler},
      {"midpoint", Integrator::midpoint},
      {"trapezoid", Integrator::trapezoid},
      {"rk4", Integrator::rk4},
      {"verlet", Integrator::verlet},
      {"backward-euler", Integrator::backward_euler},
      {"implicit-trapezoid", Integrator::implicit_trapezoid}};
  return words;
}

const std::vector<std::pair<std::string, Detection>>& detection_words() {
  static const std::vector<std::pair<std::string, Detection>> words = {
      {"ahead", Detection::ahead}, {"discrete", Detection::discrete}, {"time-of-impact", Detection::time_of_impact}};
  return words;
}

const Form* world_form(FormStore& store, const ValueForms& values) {
  Form world = world_table().form(store, values);
  world.definition = "world";
  return store.add(std::move(world));
}

json::Value place_of_gravity(const json::Value& world) {
  return below(world, {"gravity"});
}

json::Value place_of_step(const json::Value& world) {
  return below(world, {"step"});
}

json::Value place_of_force(const json::Value& world, std::size_t index) {
  const json::Value forces = usable(world, "forces");
  return forces && index < forces.items().size() ? forces.items()[index] : world;
}

json::Value place_of_joint(const json::Value& world, std::string_view name) {
  const json::Value joints = usable(world, "joints");
  return joints ? usable(joints, name) : json::Value();
}

json::Value place_of_soft(const json::Value& world, std::string_view name) {
  return below(world, {"soft", name});
}

json::Value place_of_vehicle(const json::Value& world, std::string_view name) {
  return below(world, {"vehicles", name});
}

json::Value place_of_particles(const json::Value& world, std::string_view name) {
  return below(world, {"particles", name});
}

json::Value place_of_ignored(const json::Value& world) {
  return below(world, {"ignore"});
}

void read_world(const json::Value& world, Building& building) {
  world_table().read(world, building.stage, building);
}

}  // namespace tweenfall::document::fields
