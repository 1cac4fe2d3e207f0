#include <tweenfall/anim/hierarchy.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "pose/frame_kernels.h"

namespace tweenfall {

WorldMotion child_of(const WorldMotion& parent, const Motion& local) noexcept {
  WorldMotion world;
  pose::fastest_frame_kernels().child(parent, local, world);
  return world;
}

/// Nodes are only ever appended, and never moved: hierarchies that use the first ones stay valid.
struct Hierarchy::Room {
  std::vector<Node> nodes;
  std::vector<std::uint32_t> parents;  ///< of the nodes, stored compactly for the walk from local to world
  std::atomic<std::size_t> used{0};    ///< the first hierarchy to grow takes the next place; another then needs a room
                                       ///< of its own

  [[nodiscard]] static std::uint32_t parent_of(const Node& node) {
    return node.parent == no_node ? pose::no_parent : static_cast<std::uint32_t>(node.parent);
  }
};

namespace pose {
namespace {

void require_parent(const Node& node, std::size_t index) {
  if (node.parent == no_node || node.parent < index) return;
  throw std::invalid_argument("node \"" + node.name + "\" (number " + std::to_string(index) + ") has parent number " +
                              std::to_string(node.parent) + "; a parent must come before its children");
}

[[noreturn]] void refuse_name(const std::string& name) {
  throw std::invalid_argument("two nodes are named \"" + name + "\"");
}

}  // namespace
}  // namespace pose

Hierarchy::Hierarchy(Hierarchy&& other) noexcept
    : room_(std::move(other.room_)), nodes_(std::exchange(other.nodes_, {})), runs_(std::move(other.runs_)) {}

Hierarchy& Hierarchy::operator=(Hierarchy other) noexcept {
  room_.swap(other.room_);
  std::swap(nodes_, other.nodes_);
  runs_.swap(other.runs_);
  return *this;
}

Hierarchy::Hierarchy(std::vector<Node> nodes) {
  std::unordered_set<std::string_view> names;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    pose::require_parent(nodes[i], i);
    if (!names.insert(nodes[i].name).second) pose::refuse_name(nodes[i].name);
  }
  if (nodes.empty()) return;
  room_ = std::make_shared<Room>();
  room_->nodes = std::move(nodes);
  room_->parents.reserve(room_->nodes.capacity());
  for (const Node& node : room_->nodes) room_->parents.push_back(Room::parent_of(node));
  room_->used = room_->nodes.size();
  nodes_ = room_->nodes;
  Names all(nodes_.size());
  std::iota(all.begin(), all.end(), 0U);
  std::ranges::sort(all, {}, [&](std::uint32_t node) -> std::string_view { return nodes_[node].name; });
  runs_.push_back(std::make_shared<const Names>(std::move(all)));
}

std::size_t Hierarchy::add(Node node) {
  if (find(node.name)) pose::refuse_name(node.name);
  return add_again(std::move(node));
}

std::size_t Hierarchy::add_again(Node node) {
  const std::size_t index = nodes_.size();
  pose::require_parent(node, index);
  std::vector<std::shared_ptr<const Names>> runs = runs_;
  Names run{static_cast<std::uint32_t>(index)};
  const auto name_of = [&](std::uint32_t i) -> std::string_view { return i == index ? node.name : nodes_[i].name; };
  while (!runs.empty() && runs.back()->size() <= run.size()) {
    Names merged(runs.back()->size() + run.size());
    std::ranges::merge(*runs.back(), run, merged.begin(), {}, name_of, name_of);
    run = std::move(merged);
    runs.pop_back();
  }
  runs.push_back(std::make_shared<const Names>(std::move(run)));

  std::size_t known = index;
  if (!room_ || index == room_->nodes.capacity() || !room_->used.compare_exchange_strong(known, index + 1)) {
    auto larger = std::make_shared<Room>();
    larger->nodes.reserve(std::max<std::size_t>(16, 2 * index));
    larger->nodes.assign(nodes_.begin(), nodes_.end());
    larger->parents.reserve(larger->nodes.capacity());
    if (room_)
      larger->parents.assign(room_->parents.begin(), room_->parents.begin() + static_cast<std::ptrdiff_t>(index));
    larger->used = index + 1;
    room_ = std::move(larger);
  }
  room_->parents.push_back(Room::parent_of(node));
  room_->nodes.push_back(std::move(node));
  nodes_ = {room_->nodes.data(), index + 1};
  runs_ = std::move(runs);
  return index;
}

std::optional<std::size_t> Hierarchy::find(std::string_view name) const {
  const auto name_of = [&](std::uint32_t node) -> std::string_view { return nodes_[node].name; };
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
    // Among equal names the latest comes last.
    const auto after = std::ranges::upper_bound(**run, name, {}, name_of);
    if (after != (*run)->begin() && nodes_[*std::prev(after)].name == name) return *std::prev(after);
  }
  return std::nullopt;
}

void Hierarchy::world_motions(std::span<const Motion> local, std::span<WorldMotion> world) const noexcept {
  if (!room_) return;
  pose::fastest_frame_kernels().motions(room_->parents.data(), nodes_.size(), local.data(), world.data());
}

void Hierarchy::world_frames(std::span<const Motion> local, std::span<WorldFrame> world) const noexcept {
  if (!room_) return;
  pose::fastest_frame_kernels().frames(room_->parents.data(), nodes_.size(), local.data(), world.data());
}

}  // namespace tweenfall
