#include <tweenfall/anim/hierarchy.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "pose/moving_frame.h"

namespace tweenfall {

namespace pose {
namespace {

MovingFrame read(const Mat3& linear, const Mat3& rate, const Vec3& origin, const Vec3& velocity) noexcept {
  MovingFrame frame;
  for (int i = 0; i < 3; ++i) frame.axes[i] = MovingColumn::read(linear.data() + 3 * i, rate.data() + 3 * i);
  frame.origin = MovingColumn::read(origin.data(), velocity.data());
  return frame;
}

void write(const MovingFrame& frame, Mat3& linear, Mat3& rate, Vec3& origin, Vec3& velocity) noexcept {
  for (int i = 0; i < 3; ++i) frame.axes[i].write(linear.data() + 3 * i, rate.data() + 3 * i);
  frame.origin.write(origin.data(), velocity.data());
}

// Near a length of 1, as products of rotations are, by a step of Newton's that leaves less than a rounding.
[[gnu::always_inline]] inline Quat near_unit(const Quat& q) noexcept {
  const double excess = q.squaredNorm() - 1;
  if (!(std::abs(excess) < 1e-9)) return q.normalized();
  return Quat(q.coeffs() * (1 - 0.5 * excess));
}

// Inlined, so that what is read of the parent need not be where the child's is written.
[[gnu::always_inline]] inline void place(const WorldMotion& parent, const Motion& local, WorldMotion& world) noexcept {
  const Motion& above = parent.motion;
  Motion& motion = world.motion;
  write(child_frame(read(parent.linear, parent.linear_rate, above.pose.position, above.twist.linear), local),
        world.linear, world.linear_rate, motion.pose.position, motion.twist.linear);
  motion.pose.rotation = near_unit(above.pose.rotation * local.pose.rotation);
  motion.pose.scale = above.pose.scale.cwiseProduct(local.pose.scale);
  motion.twist.angular = above.twist.angular + above.pose.rotation * local.twist.angular;
  motion.scale_rate = above.scale_rate.cwiseProduct(local.pose.scale) + above.pose.scale.cwiseProduct(local.scale_rate);
}

}  // namespace
}  // namespace pose

WorldMotion child_of(const WorldMotion& parent, const Motion& local) noexcept {
  WorldMotion world;
  pose::place(parent, local, world);
  return world;
}

/// Nodes are only ever put behind those that are there, and never moved: who sees the first ones sees them for good.
struct Hierarchy::Room {
  static constexpr std::uint32_t outside = 0xffffffff;

  std::vector<Node> nodes;
  std::vector<std::uint32_t> parents;  ///< of them, close together for the walk from local to world
  std::atomic<std::size_t> used{0};    ///< who grows first takes the place behind; another then needs a room of its own

  [[nodiscard]] static std::uint32_t parent_of(const Node& node) {
    return node.parent == no_node ? outside : static_cast<std::uint32_t>(node.parent);
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
    // Of equal names the latest comes last.
    const auto after = std::ranges::upper_bound(**run, name, {}, name_of);
    if (after != (*run)->begin() && nodes_[*std::prev(after)].name == name) return *std::prev(after);
  }
  return std::nullopt;
}

void Hierarchy::world_motions(std::span<const Motion> local, std::span<WorldMotion> world) const noexcept {
  static const WorldMotion outside;
  const std::uint32_t* const parents = room_ ? room_->parents.data() : nullptr;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    pose::place(parents[i] == Room::outside ? outside : world[parents[i]], local[i], world[i]);
}

void Hierarchy::world_frames(std::span<const Motion> local, std::span<WorldFrame> world) const noexcept {
  static const WorldFrame outside;
  const std::uint32_t* const parents = room_ ? room_->parents.data() : nullptr;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const WorldFrame& above = parents[i] == Room::outside ? outside : world[parents[i]];
    WorldFrame& frame = world[i];
    pose::write(pose::child_frame(pose::read(above.linear, above.linear_rate, above.origin, above.velocity), local[i]),
                frame.linear, frame.linear_rate, frame.origin, frame.velocity);
  }
}

}  // namespace tweenfall
