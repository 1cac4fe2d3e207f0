#include "gltf/physics/collision_systems.h"

#include <algorithm>
#include <cstdint>

namespace tweenfall::gltf::physics {

namespace {

std::set<std::string> names_of(const Fields& filter, const char* list) {
  std::set<std::string> names;
  for (const json::Value& name : filter.list(list)) {
    if (!name.is(json::Value::Kind::text)) {
      filter.problems().add(filter.place_of(list), "must be a list of names");
      break;
    }
    names.insert(std::string(name.text()));
  }
  return names;
}

}  // namespace

void CollisionSystems::add(std::size_t body, const Fields& filter) {
  constexpr std::size_t most = 64;
  Entry entry{.body = body, .group = 0, .with = {}, .apart = names_of(filter, "notCollideWithSystems")};
  if (filter.has("collideWithSystems")) entry.with = names_of(filter, "collideWithSystems");
  const Names in = names_of(filter, "collisionSystems");
  if (const auto known = groups_.find(in); known != groups_.end())
    entry.group = known->second;
  else if (groups_.size() < most)
    entry.group = groups_.emplace(in, groups_.size()).first->second;
  else
    filter.problems().repair(filter.place(),
                             "puts bodies into more than 63 different sets of systems in all; here it "
                             "is as if it put them into none");
  entries_.push_back(std::move(entry));
}

bool CollisionSystems::meets(const Entry& entry, const Names& other) {
  const auto are_among = [&](const Names& names) {
    return std::ranges::any_of(other, [&](const std::string& name) { return names.contains(name); });
  };
  return (!entry.with || are_among(*entry.with)) && !are_among(entry.apart);
}

void CollisionSystems::finish(std::span<ModelBody> bodies) const {
  for (const Entry& entry : entries_) {
    BodyDescription& body = bodies[entry.body].body;
    body.groups = std::uint64_t{1} << entry.group;
    body.collides_with = entry.with ? 0 : ~std::uint64_t{0};
    for (const auto& [names, group] : groups_) {
      const std::uint64_t bit = std::uint64_t{1} << group;
      body.collides_with = meets(entry, names) ? body.collides_with | bit : body.collides_with & ~bit;
    }
  }
}

}  // namespace tweenfall::gltf::physics
