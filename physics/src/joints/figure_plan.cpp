#include "joints/figure_plan.h"

#include <algorithm>

namespace tweenfall::joints {

namespace {

/// More blocks per joint than this are more work than solving joint by joint.
constexpr std::size_t most_blocks = 16;
constexpr std::uint32_t unseen = 0xffffffffu;

}  // namespace

void FigurePlan::Room::fit(std::size_t places) {
  if (at_body.size() >= places) return;
  at_body.resize(places);
  depth.resize(places, unseen);
}

bool FigurePlan::make(std::span<const Member> members, Room& room) {
  members_.assign(members.begin(), members.end());
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    if (members_[i].a_moves) room.at_body[members_[i].a].push_back(i);
    if (members_[i].b_moves) room.at_body[members_[i].b].push_back(i);
  }
  order(room);
  const bool found = find_structure(room);
  for (const Member& member : members)
    for (const std::uint32_t end : {member.a, member.b}) {
      room.at_body[end].clear();
      room.depth[end] = unseen;
    }
  if (!found) return false;
  return true;
}

void FigurePlan::change_members(std::span<const Member> members) {
  for (std::size_t i = 0; i < members.size(); ++i) members_[place_of_[i]] = members[i];
}

/// By distance from where each tree hangs, the farthest first.
void FigurePlan::order(Room& room) {
  std::vector<std::uint32_t>& depth = room.depth;
  std::vector<std::uint32_t>& queue = room.queue;
  queue.clear();
  const auto start = [&](std::uint32_t body) {
    if (depth[body] != unseen) return;
    depth[body] = 0;
    queue.push_back(body);
  };
  std::size_t from = 0;
  const auto spread = [&] {
    for (; from < queue.size(); ++from) {
      const std::uint32_t body = queue[from];
      for (const std::uint32_t i : room.at_body[body]) {
        const Member& member = members_[i];
        for (const std::uint32_t end : {member.a, member.b}) {
          if (!(end == member.a ? member.a_moves : member.b_moves) || depth[end] != unseen) continue;
          depth[end] = depth[body] + 1;
          queue.push_back(end);
        }
      }
    }
  };
  // A tree that hangs on something immovable starts there.
  for (const Member& member : members_) {
    if (!member.a_moves && member.b_moves) start(member.b);
    if (!member.b_moves && member.a_moves) start(member.a);
  }
  spread();
  for (const Member& member : members_) {
    if (member.a_moves) start(member.a);
    if (member.b_moves) start(member.b);
    spread();
  }
  const auto depth_of = [&](std::uint32_t i) {
    const Member& member = members_[i];
    // A joint to something fixed is one step nearer than any other joint of its body.
    const std::uint32_t a = member.a_moves ? depth[member.a] + 1 : 0;
    const std::uint32_t b = member.b_moves ? depth[member.b] + 1 : 0;
    return a + b;
  };
  std::vector<std::uint32_t>& chosen = room.queue;
  chosen.resize(members_.size());
  for (std::uint32_t i = 0; i < chosen.size(); ++i) chosen[i] = i;
  std::sort(chosen.begin(), chosen.end(), [&](std::uint32_t left, std::uint32_t right) {
    const std::uint32_t depth_left = depth_of(left), depth_right = depth_of(right);
    return depth_left != depth_right ? depth_left > depth_right : left < right;
  });
  room.place_of.resize(members_.size());
  for (std::uint32_t place = 0; place < chosen.size(); ++place) room.place_of[chosen[place]] = place;
}

bool FigurePlan::find_structure(Room& room) {
  const std::size_t count = members_.size();
  if (room.later.size() < count) room.later.resize(count);
  for (std::size_t place = 0; place < count; ++place) room.later[place].clear();
  std::size_t pairs = 0;
  // Of the members at a body, each affects all that come later; a body with very many is not part of a tree.
  for (std::uint32_t i = 0; i < count; ++i)
    for (const bool by_b : {false, true}) {
      if (!(by_b ? members_[i].b_moves : members_[i].a_moves)) continue;
      const std::vector<std::uint32_t>& others = room.at_body[by_b ? members_[i].b : members_[i].a];
      pairs += others.size();
      if (pairs > 2 * most_blocks * count + 2) return false;
      for (const std::uint32_t k : others)
        if (room.place_of[k] > room.place_of[i]) room.later[room.place_of[i]].push_back(room.place_of[k]);
    }
  first_.resize(count + 1);
  later_.clear();
  for (std::size_t place = 0; place < count; ++place) {
    std::vector<std::uint32_t>& own = room.later[place];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    first_[place] = static_cast<std::uint32_t>(later_.size());
    later_.insert(later_.end(), own.begin(), own.end());
    if (later_.size() > most_blocks * count) return false;
    // The members that it affects affect each other once it is eliminated.
    if (!own.empty()) room.later[own.front()].insert(room.later[own.front()].end(), own.begin() + 1, own.end());
  }
  first_[count] = static_cast<std::uint32_t>(later_.size());
  room.given = members_;
  place_of_ = room.place_of;
  change_members(room.given);
  return true;
}

}  // namespace tweenfall::joints
