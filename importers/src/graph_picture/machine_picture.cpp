#include "graph_picture/machine_picture.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace tweenfall::plotting {

namespace {

constexpr double state_width = 132, state_height = 42;

struct Way {
  Arrow arrow;
  std::string when, how;
};

// From one box to another, bent to the right, further for each arrow that is there already.
Way way_between(const Rectangle& a, const Rectangle& b, std::size_t already) {
  const Vec2 way = b.center() - a.center();
  const double length = std::max(way.norm(), 1.0);
  const Vec2 right(-way.y() / length, way.x() / length);
  const Vec2 control = (a.center() + b.center()) / 2 + (46 + 44 * static_cast<double>(already)) * right;
  return {{a.border_toward(control), control, b.border_toward(control)}, {}, {}};
}

// From a box to itself, outside the ellipse.
Way around_itself(const Rectangle& box, const Vec2& outward, std::size_t already) {
  const double far = 92 + 40 * static_cast<double>(already);
  const Vec2 middle = box.center(), control = middle + far * outward;
  const Vec2 across(-outward.y(), outward.x());
  return {{box.border_toward(control + 60 * across), control, box.border_toward(control - 60 * across)}, {}, {}};
}

// For a transition from any state.
Way from_any(const Rectangle& box, const Vec2& outward, std::size_t already) {
  const Vec2 across(-outward.y(), outward.x());
  const Vec2 from = box.center() + 100 * outward + (70.0 * static_cast<double>(already) + 24) * across;
  const Vec2 to = box.border_toward(from);
  return {{from, (from + to) / 2, to}, {}, {}};
}

}  // namespace

MachinePicture::MachinePicture(const MachinePose& machine) : machine_(machine) {
  const double states = static_cast<double>(machine.states.size());
  for (const GraphTransition& each : machine.transitions)
    self_or_any_ = self_or_any_ || each.from.empty() || std::ranges::find(each.from, each.to) != each.from.end();
  reach_ = machine.states.size() < 2
               ? Vec2(120, 20)
               : Vec2(std::max(260.0, 62 * states), machine.states.size() == 2 ? 60 : 66 + 24 * states);
}

std::size_t MachinePicture::state(const std::string& name) const {
  return static_cast<std::size_t>(std::ranges::find(machine_.states, name, &MachinePose::State::name) -
                                  machine_.states.begin());
}

Vec2 MachinePicture::direction(std::size_t state) const {
  const double turn = static_cast<double>(state) / static_cast<double>(machine_.states.size()) - 0.5;
  const elementary::SinCos angle = elementary::sin_cos(2 * std::numbers::pi * turn);
  return {angle.cos, angle.sin};
}

Rectangle MachinePicture::box(std::size_t state, const Vec2& middle) const {
  const Vec2 place = machine_.states.size() < 2 ? middle : Vec2(middle + direction(state).cwiseProduct(reach_));
  return around(place, state_width, state_height);
}

void MachinePicture::draw(SvgWriter& svg, double left, double top) const {
  const Vec2 middle(left + width() / 2, top + height() / 2);
  std::vector<Rectangle> boxes;
  for (std::size_t i = 0; i < machine_.states.size(); ++i) boxes.push_back(box(i, middle));
  std::vector<Way> ways;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> drawn;
  for (const GraphTransition& transition : machine_.transitions) {
    const std::size_t to = state(transition.to);
    if (to == boxes.size()) continue;
    const auto add = [&](Way way) {
      way.when = words_of(transition.when);
      way.how = words_of(transition.change);
      ways.push_back(std::move(way));
    };
    if (transition.from.empty()) add(from_any(boxes[to], direction(to), drawn[{boxes.size(), to}]++));
    for (const std::string& name : transition.from) {
      const std::size_t from = state(name);
      if (from == boxes.size()) continue;
      const std::size_t already = drawn[{from, to}]++;
      add(from == to ? around_itself(boxes[to], direction(to), already) : way_between(boxes[from], boxes[to], already));
    }
  }
  for (const Way& way : ways) draw_arrow(svg, way.arrow);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const MachinePose::State& each = machine_.states[i];
    const bool first = each.name == machine_.start;
    draw_box(svg, boxes[i], each.name, (first ? "start; " : "") + each.pose,
             {first ? "#dafbe1" : "#ffffff", first ? "#1a7f37" : "#57606a", 20, first});
  }
  std::vector<Arrow> arrows;
  arrows.reserve(ways.size());
  for (const Way& way : ways) arrows.push_back(way.arrow);
  Labels labels(boxes, arrows, left, left + width());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const bool from_a_state =
        std::ranges::any_of(boxes, [&](const Rectangle& each) { return around(arrows[i].from, 1, 1).overlaps(each); });
    if (!from_a_state)
      svg.leaf("circle",
               {{"cx", px(arrows[i].from.x())}, {"cy", px(arrows[i].from.y())}, {"r", "4"}, {"fill", "#8c959f"}});
    labels.draw(svg, i, (from_a_state ? "" : "any: ") + ways[i].when, ways[i].how);
  }
}

}  // namespace tweenfall::plotting
