#pragma once

#include "gltf/read/fields.h"

#include <tweenfall/importers/model.h>

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace tweenfall::gltf::physics {

/// The collision filters of a file as groups: all bodies that are in the same systems are one group.
class CollisionSystems {
 public:
  /// Notes the filter of a body.
  void add(std::size_t body, const Fields& filter);
  /// Gives the bodies that have filters their groups, and tells them with which they collide.
  void finish(std::span<ModelBody> bodies) const;

 private:
  using Names = std::set<std::string>;
  struct Entry {
    std::size_t body = 0, group = 0;
    std::optional<Names> with;  ///< collides with these alone
    Names apart;                ///< does not collide with these
  };
  [[nodiscard]] static bool meets(const Entry& entry, const Names& other);

  std::vector<Entry> entries_;
  /// The first group is that of bodies that are in no system.
  std::map<Names, std::size_t> groups_{{{}, 0}};
};

}  // namespace tweenfall::gltf::physics
