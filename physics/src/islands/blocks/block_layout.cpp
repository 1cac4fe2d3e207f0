#include "islands/blocks/contact_blocks.h"

#include <algorithm>
#include <numeric>

/// Which contacts share a block, and in which order blocks are solved.

namespace tweenfall::blocks {

using contacts::ContactConstraint;

namespace {

// Kinds of contacts: balls, or three grips, even or not, of up to four points. Contacts of one grip share blocks, those
// with the most points first, so that nearly all lanes are full and hardly any does more than it must.
enum class Grip { none, central, points, balls };
constexpr std::uint32_t kinds_of_grip = 8, kinds = 4 * kinds_of_grip;
constexpr std::uint32_t ball_kind = static_cast<std::uint32_t>(Grip::balls) * kinds_of_grip;

int points_of(std::uint32_t kind) {
  return 4 - static_cast<int>(kind % 4);
}

bool is_even(std::uint32_t kind) {
  return kind / 4 % 2 == 1;
}

/// A contact that slides is held point by point, as only this ends the spin of a sliding body together with its slide.
Grip grip_of(const ContactConstraint& contact) {
  if (!(contact.friction > 0)) return Grip::none;
  return contact.count > 1 && !contact.slid && !contact.began ? Grip::central : Grip::points;
}

std::uint32_t kind_of(const ContactConstraint& contact, const IslandBody& a, const IslandBody& b) {
  const auto smooth = [](const IslandBody& body) { return body.movable ? body.round : body.led == step::not_led; };
  if (contact.count == 1 && !a.conveys && !b.conveys && smooth(a) && smooth(b)) return ball_kind;
  return static_cast<std::uint32_t>(grip_of(contact)) * kinds_of_grip + (a.isotropic && b.isotropic ? 4u : 0u) +
         static_cast<std::uint32_t>(4 - contact.count);
}

}  // namespace

void ContactBlocks::find_keys(std::span<ContactConstraint* const> contacts, const std::vector<std::uint32_t>& places,
                              const std::vector<IslandBody>& bodies, const threads::Workers& work) {
  constexpr std::size_t worth_a_part = 64;
  ends.resize(contacts.size());
  work.ranges(contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ContactConstraint& contact = *contacts[i];
      const std::uint32_t place_a = places[contact.a], place_b = places[contact.b];
      const IslandBody &a = bodies[place_a], &b = bodies[place_b];
      ends[i] = {place_a, place_b, kind_of(contact, a, b), a.movable, b.movable};
    }
  });
  coloring_.reset(bodies.size());
  keys_.clear();
  keys_.reserve(contacts.size());
  for (const Ends& one : ends)
    keys_.push_back(coloring_.color(one.a, one.a_moves, one.b, one.b_moves) * kinds + one.kind);
}

/// Creates all blocks and balls, and lists what is to be filled in.
void ContactBlocks::lay_out() {
  blocks.clear();
  balls.clear();
  point_count_ = friction_count_ = 0;
  drifts.clear();
  inertias.clear();
  meetings.clear();
  ball_meetings.clear();
  origins.clear();
  ball_origins.clear();
  color_blocks_.clear();
  color_balls_.clear();
  fillings_.clear();
  std::uint32_t colors = 0;
  const auto open_colors = [&](std::uint32_t end) {
    for (; colors < end; ++colors) {
      color_blocks_.push_back(blocks.size());
      color_balls_.push_back(balls.size());
      if (colors != Coloring::half) continue;
      pairs = blocks.size();
      ball_pairs = balls.size();
    }
  };
  for (std::uint32_t next = 0; next < sorted_.size();) {
    const std::uint32_t first = keys_[sorted_[next]], color = first / kinds;
    open_colors(color + 1);
    Filling filling{first % kinds == ball_kind, 0, next, 0, room};
    Makeup makeup{static_cast<int>(first % kinds / kinds_of_grip)};
    for (; filling.count < lane_count && next < sorted_.size(); ++next, ++filling.count) {
      const std::uint32_t key = keys_[sorted_[next]];
      if (key / kinds_of_grip != first / kinds_of_grip) break;
      makeup.points = std::max(makeup.points, points_of(key));
      makeup.even = makeup.even && is_even(key);
    }
    open(makeup);
    filling.index = static_cast<std::uint32_t>((filling.of_balls ? balls.size() : blocks.size()) - 1);
    fillings_.push_back(filling);
    // If all lanes have two movable bodies, no place is needed.
    if (filling.count < lane_count || color >= Coloring::half) ++room;
  }
  open_colors(coloring_.end());
}

/// Sorts contacts by key, keeping their order. There are thousands of keys, but most islands have only few contacts.
void ContactBlocks::sort_by_key() {
  constexpr std::size_t few_contacts = 256;
  sorted_.resize(keys_.size());
  if (keys_.size() <= few_contacts) {
    std::iota(sorted_.begin(), sorted_.end(), std::uint32_t{0});
    std::sort(sorted_.begin(), sorted_.end(), [this](std::uint32_t left, std::uint32_t right) {
      return keys_[left] != keys_[right] ? keys_[left] < keys_[right] : left < right;
    });
    return;
  }
  counts_.assign(std::size_t{coloring_.end()} * kinds + 1, 0);
  for (const std::uint32_t key : keys_) ++counts_[key + 1];
  for (std::size_t i = 1; i < counts_.size(); ++i) counts_[i] += counts_[i - 1];
  for (std::uint32_t i = 0; i < keys_.size(); ++i) sorted_[counts_[keys_[i]]++] = i;
}

void ContactBlocks::find_phases() {
  phases.clear();
  color_blocks_.push_back(blocks.size());
  color_balls_.push_back(balls.size());
  const auto add = [this](bool of_balls, std::uint32_t from, std::uint32_t to) {
    const std::vector<std::size_t>& starts = of_balls ? color_balls_ : color_blocks_;
    for (std::uint32_t color = from; color < to; ++color)
      if (starts[color] < starts[color + 1]) phases.push_back({of_balls, starts[color], starts[color + 1]});
  };
  add(true, 0, Coloring::half);
  add(false, 0, Coloring::half);
  add(true, Coloring::half, coloring_.end());
  add(false, Coloring::half, coloring_.end());
  stretches.clear();
  for (const bool of_balls : {false, true})
    for (const Phase& phase : phases)
      if (phase.of_balls == of_balls) {
        const std::size_t before = of_balls ? blocks.size() : 0;
        stretches.push_back({static_cast<std::uint32_t>((before + phase.begin) * lane_count),
                             static_cast<std::uint32_t>((before + phase.end) * lane_count)});
      }
}

void ContactBlocks::open(const Makeup& makeup) {
  const auto grip = static_cast<Grip>(makeup.grip);
  if (grip == Grip::balls) {
    balls.emplace_back();
    ball_meetings.emplace_back();
    ball_origins.emplace_back();
    return;
  }
  ContactBlock& block = blocks.emplace_back();
  meetings.emplace_back();
  origins.emplace_back();
  block.even = makeup.even;
  block.points = static_cast<std::int8_t>(makeup.points);
  block.frictions = grip == Grip::none ? std::int8_t{0} : grip == Grip::central ? std::int8_t{1} : block.points;
  block.point = point_count_;
  block.friction = friction_count_;
  point_count_ += static_cast<std::uint32_t>(block.points);
  friction_count_ += static_cast<std::uint32_t>(block.frictions);
  if (points.size() < point_count_) points.resize(2 * std::size_t{point_count_});
  if (frictions.size() < friction_count_) frictions.resize(2 * std::size_t{friction_count_});
  if (drifting_) drifts.resize(friction_count_);
  if (block.even) return;
  block.inertia = static_cast<std::uint32_t>(inertias.size());
  inertias.emplace_back();
}

}  // namespace tweenfall::blocks
