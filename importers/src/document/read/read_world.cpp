#include "document/content.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"

#include <charconv>
#include <limits>

namespace tweenfall::document {

namespace {

using Kind = JsonValue::Kind;

std::size_t body_in(const JsonValue& spring, const char* end, Building& building) {
  const JsonValue name = usable(spring, end);
  if (!name) return no_node;
  const auto found = building.nodes.find(name.text());
  if (found != building.nodes.end() && building.stage.nodes[found->second].body) return found->second;
  if (building.excused(name.text())) return no_node;
  building.problems.add(name, (found == building.nodes.end() ? "there is no node " + in_quotes(name.text())
                                                             : "the node " + in_quotes(name.text()) + " has no body") +
                                  suggestion(name.text(), building.body_names()));
  return no_node;
}

SpringDescription read_spring(const JsonValue& value, Building& building) {
  SpringDescription out;
  out.a = body_in(value, "a", building);
  out.b = body_in(value, "b", building);
  if (out.a != no_node && out.a == out.b)
    building.problems.add(usable(value, "b"), "a spring cannot pull a body to itself; leave \"b\" out for the world");
  out.spring.anchor_a = vector_in(value, "anchor_a", Vec3(0, 0, 0));
  out.spring.anchor_b = vector_in(value, "anchor_b", Vec3(0, 0, 0));
  out.spring.rest_length = number_in(value, "rest_length", 0);
  out.spring.stiffness = number_in(value, "stiffness", 0);
  out.spring.damping = number_in(value, "damping", 0);
  return out;
}

}  // namespace

void read_world(Building& building) {
  const JsonValue world = usable(building.root, "world");
  if (!world) return;
  WorldSettings& settings = building.stage.world;
  settings.gravity = vector_in(world, "gravity", settings.gravity);
  if (const JsonValue step = usable(world, "step")) {
    if (step.is(Kind::number)) building.stage.step = step.number();
    if (step.is(Kind::text)) {
      double parts = 240;
      std::from_chars(step.text().data() + 2, step.text().data() + step.text().size(), parts);
      building.stage.step = 1 / parts;
    }
  }
  if (text_in(world, "integrator") == "semi-implicit-euler") settings.integrator = Integrator::semi_implicit_euler;
  settings.iterations = static_cast<int>(number_in(world, "iterations", settings.iterations));
  settings.sleep_speed = number_in(world, "sleep_speed", settings.sleep_speed);
  settings.sleep_after = text_in(world, "sleep_after") == "never"
                             ? std::numeric_limits<double>::infinity()
                             : number_in(world, "sleep_after", settings.sleep_after);
  settings.push_out_speed = number_in(world, "push_out_speed", settings.push_out_speed);
  if (const JsonValue forces = usable(world, "forces")) {
    for (const JsonValue& force : forces.items()) {
      if (const JsonValue drag = usable(force, "drag"))
        building.stage.forces.push_back(DragDescription{Drag{.linear = number_in(drag, "linear", 0),
                                                             .quadratic = number_in(drag, "quadratic", 0),
                                                             .angular = number_in(drag, "angular", 0)}});
      if (const JsonValue spring = usable(force, "spring"))
        building.stage.forces.push_back(read_spring(spring, building));
    }
  }
}

}  // namespace tweenfall::document
