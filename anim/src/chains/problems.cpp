#include "chains/problems.h"

#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>

namespace tweenfall {

std::optional<std::size_t> NodeRef::in(const Hierarchy& nodes) const {
  if (!by_number_) return nodes.find(name_);
  return index_ < nodes.size() ? std::optional(index_) : std::nullopt;
}

std::string NodeRef::text() const {
  return by_number_ ? "number " + std::to_string(index_) : '"' + name_ + '"';
}

namespace chains {

namespace {

std::string listed(std::span<const Problem> problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + problem.text;
  return text;
}

std::string listed(std::string text, std::span<const Problem> problems) {
  for (const Problem& problem : problems) text += "\n  " + problem.text;
  return text;
}

}  // namespace

Unfit::Unfit(std::vector<Problem> problems)
    : std::invalid_argument(listed(problems)),
      problems_(std::make_shared<const std::vector<Problem>>(std::move(problems))) {}

Unfit::Unfit(const std::string& heading, std::vector<Problem> problems)
    : std::invalid_argument(listed(heading, problems)),
      problems_(std::make_shared<const std::vector<Problem>>(std::move(problems))) {}

void Problems::add(const std::string& problem) {
  problems_.push_back({member_, what_ + ": " + problem});
}

bool Problems::require(bool holds, const std::string& problem) {
  if (!holds) add(problem);
  return holds;
}

std::size_t Problems::node(const Hierarchy& nodes, const NodeRef& told, const std::string& role) {
  if (const auto found = told.in(nodes)) return *found;
  std::vector<std::string> names;
  names.reserve(nodes.size());
  for (const Node& node : nodes.nodes()) names.push_back(node.name);
  std::string wrong = told.text();
  std::string nearest;
  if (wrong.size() > 2 && wrong.front() == '"') nearest = nearest_name(wrong.substr(1, wrong.size() - 2), names);
  add(role + " is " + wrong + ", and there is no such node" +
      (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  return no_node;
}

std::vector<std::size_t> Problems::chain(const Hierarchy& nodes, std::span<const NodeRef> told) {
  std::vector<std::size_t> result;
  result.reserve(told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    const std::string name = "joint " + std::to_string(i + 1);
    at({"joints", std::to_string(i)});
    const std::size_t index = node(nodes, told[i], name);
    if (i > 0 && index != no_node && result.back() != no_node)
      require(is_below(nodes, index, result.back()), name + " (" + called(nodes, told[i]) +
                                                         ") must be below the joint before it (" +
                                                         called(nodes, told[i - 1]) + ")");
    result.push_back(index);
  }
  at({});
  return result;
}

void Problems::add_all(std::span<const Problem> problems, const std::string& whose) {
  const Member here = member_;
  for (const Problem& problem : problems) {
    member_.insert(member_.end(), problem.member.begin(), problem.member.end());
    add(whose + " " + problem.text);
    member_ = here;
  }
}

void Problems::require_finite(const Vec3& v, const std::string& name) {
  if (require(std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()), name + " must be finite"))
    require(v.cwiseAbs().maxCoeff() <= largest, name + " has a number beyond " + number_text(largest));
}

void Problems::require_in(double number, double low, double high, const std::string& name) {
  require(number >= low && number <= high,
          name + " is " + number_text(number) + "; it must be from " + number_text(low) + " to " + number_text(high));
}

void Problems::report() const {
  if (!none()) throw Unfit(problems_);
}

std::string called(const Hierarchy& nodes, const NodeRef& told) {
  const auto found = told.in(nodes);
  return found && !nodes[*found].name.empty() ? '"' + nodes[*found].name + '"' : told.text();
}

bool is_below(const Hierarchy& nodes, std::size_t node, std::size_t above) {
  while (node != no_node) {
    node = nodes[node].parent;
    if (node == above) return true;
  }
  return false;
}

}  // namespace chains
}  // namespace tweenfall
