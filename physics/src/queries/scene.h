#pragma once

#include <tweenfall/physics/query.h>

#include <cstdint>
#include <vector>

#include "pairs/bounds_tree.h"
#include "queries/rays.h"

namespace tweenfall::queries {

/// Something that can be queried: a body of a world, or of a stage at some instant.
struct Item {
  const Shape* shape = nullptr;  ///< null: no item has this number
  Pose pose;
  std::uint64_t mark = 0;  ///< a different mark means a different item: its shape may have changed
  std::uint64_t groups = 0;
  bool sensor = false;
};

/// Items at their positions, with their boxes in a tree.
class Scene {
 public:
  /// Whether an item counts. Not called for items that do not exist.
  using Accept = std::function<bool(std::uint32_t item)>;

  /// Items by number, from now on. An item that is not at a finite position does not exist.
  void arrange(std::size_t count, const std::function<Item(std::uint32_t)>& item_of);

  struct ItemRayHit : RayHit {
    std::uint32_t item = 0;
  };
  struct ItemShapeHit : ShapeHit {
    std::uint32_t item = 0;
  };
  struct NearestItem {
    std::uint32_t item = 0;
    double distance = 0;
    Vec3 point{0, 0, 0};
  };
  [[nodiscard]] std::optional<ItemRayHit> first_on_ray(const Ray& ray, const Accept& accept) const;
  [[nodiscard]] std::vector<ItemRayHit> all_on_ray(const Ray& ray, const Accept& accept) const;
  [[nodiscard]] std::optional<ItemShapeHit> first_on_way(const Shape& moving, const Pose& start,
                                                         const Vec3& displacement, const Accept& accept) const;
  [[nodiscard]] std::vector<std::uint32_t> overlapping(const Shape& shape, const Pose& pose,
                                                       const Accept& accept) const;
  /// The same, in place of what `found` held.
  void find_overlapping(const Shape& shape, const Pose& pose, const Accept& accept,
                        std::vector<std::uint32_t>& found) const;
  [[nodiscard]] std::optional<NearestItem> nearest(const Vec3& point, double within, const Accept& accept) const;

  [[nodiscard]] const Item& operator[](std::uint32_t item) const { return items_[item]; }

 private:
  std::vector<Item> items_;
  pairs::BoundsTree tree_;
  std::vector<std::uint32_t> planes_;
};

}  // namespace tweenfall::queries
