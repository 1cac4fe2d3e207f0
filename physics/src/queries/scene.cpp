#include "queries/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "queries/closest.h"
#include "queries/sweep.h"

namespace tweenfall::queries {

namespace {

/// How much the tree's boxes are enlarged, in parts of their sides, so that small motions need no update.
constexpr double spare = 0.05;
/// Rounding of positions, relative.
constexpr double place_rounding = 1e-12;

bool is_there(const Item& item) {
  return item.shape && item.pose.position.allFinite() && item.pose.rotation.coeffs().allFinite();
}

bool stays(const Item& before, const Item& now) {
  return before.mark == now.mark && before.pose.position == now.pose.position &&
         before.pose.rotation.coeffs() == now.pose.rotation.coeffs();
}

Bounds with_room(const Bounds& box, double part) {
  const Vec3 room =
      part * (box.high - box.low) +
      Vec3::Constant(place_rounding * std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()));
  return {box.low - room, box.high + room};
}

}  // namespace

void Scene::arrange(std::size_t count, const std::function<Item(std::uint32_t)>& item_of) {
  for (auto item = static_cast<std::uint32_t>(count); item < items_.size(); ++item) tree_.remove(item);
  items_.resize(count);
  planes_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Item before = std::exchange(items_[i], item_of(i));
    Item& item = items_[i];
    if (!is_there(item)) {
      item.shape = nullptr;
      tree_.remove(i);
    } else if (std::holds_alternative<Plane>(item.shape->solid)) {
      tree_.remove(i);
      planes_.push_back(i);
    } else if (!tree_.has(i) || !stays(before, item)) {
      const Bounds box = with_room(bounds(*item.shape, item.pose), 0);
      if (!tree_.has(i) || before.mark != item.mark || !pairs::contains(tree_.of(i), box))
        tree_.set(i, with_room(box, spare));
    }
  }
  tree_.settle();
}

std::vector<Scene::ItemRayHit> Scene::all_on_ray(const Ray& ray, const Accept& accept) const {
  std::vector<ItemRayHit> hits;
  const auto see = [&](std::uint32_t item) {
    if (!accept(item)) return;
    if (const std::optional<RayHit> hit = queries::first_on_ray(*items_[item].shape, items_[item].pose, ray))
      hits.push_back({*hit, item});
  };
  for (const std::uint32_t plane : planes_) see(plane);
  tree_.visit_along(
      ray.direction, [&](const Bounds& box) { return meets_box(box, ray.from, ray.direction, ray.length); }, see);
  std::ranges::sort(hits, [](const ItemRayHit& a, const ItemRayHit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.item < b.item;
  });
  return hits;
}

std::optional<Scene::ItemRayHit> Scene::first_on_ray(const Ray& ray, const Accept& accept) const {
  std::optional<ItemRayHit> first;
  double length = ray.length;
  const auto see = [&](std::uint32_t item) {
    if (!accept(item)) return;
    const std::optional<RayHit> hit = queries::first_on_ray(*items_[item].shape, items_[item].pose, ray);
    if (!hit || hit->distance > length || (first && hit->distance == length && item > first->item)) return;
    first = ItemRayHit{*hit, item};
    length = hit->distance;
  };
  for (const std::uint32_t plane : planes_) see(plane);
  tree_.visit_along(
      ray.direction, [&](const Bounds& box) { return meets_box(box, ray.from, ray.direction, length); }, see);
  return first;
}

std::optional<Scene::ItemShapeHit> Scene::first_on_way(const Shape& moving, const Pose& start, const Vec3& displacement,
                                                       const Accept& accept) const {
  const Bounds box = with_room(bounds(moving, start), 0);
  const Vec3 middle = 0.5 * box.low + 0.5 * box.high, half = 0.5 * (box.high - box.low);
  std::optional<ItemShapeHit> first;
  const auto see = [&](std::uint32_t item) {
    if (!accept(item)) return;
    const std::optional<ShapeHit> hit =
        queries::first_on_way(moving, start, displacement, *items_[item].shape, items_[item].pose);
    if (!hit || (first && hit->fraction > first->fraction)) return;
    if (first && hit->fraction == first->fraction && item > first->item) return;
    first = ItemShapeHit{*hit, item};
  };
  for (const std::uint32_t plane : planes_) see(plane);
  // A hair farther than the first hit so far, which is only nearly exact.
  const auto on_way = [&](const Bounds& other) {
    return meets_box({other.low - half, other.high + half}, middle, displacement,
                     first ? first->fraction * (1 + 1e-9) : 1.0);
  };
  tree_.visit_along(displacement, on_way, see);
  return first;
}

std::vector<std::uint32_t> Scene::overlapping(const Shape& shape, const Pose& pose, const Accept& accept) const {
  std::vector<std::uint32_t> found;
  find_overlapping(shape, pose, accept, found);
  return found;
}

void Scene::find_overlapping(const Shape& shape, const Pose& pose, const Accept& accept,
                             std::vector<std::uint32_t>& found) const {
  found.clear();
  const auto see = [&](std::uint32_t item) {
    if (accept(item) && !(closest_between(*items_[item].shape, items_[item].pose, shape, pose).gap > 0))
      found.push_back(item);
  };
  for (const std::uint32_t plane : planes_) see(plane);
  const Vec3 end = Vec3::Constant(std::numeric_limits<double>::infinity());
  const bool endless = std::holds_alternative<Plane>(shape.solid);
  tree_.visit(endless ? Bounds{-end, end} : with_room(bounds(shape, pose), 0), see);
  std::ranges::sort(found);
}

std::optional<Scene::NearestItem> Scene::nearest(const Vec3& point, double within, const Accept& accept) const {
  std::optional<NearestItem> best;
  double most = within;
  const auto see = [&](std::uint32_t item) {
    if (!accept(item)) return;
    const Closest closest = nearest_to(*items_[item].shape, items_[item].pose, point);
    const double distance = std::max(0.0, closest.gap);
    if (distance > most || (best && distance == most && item > best->item)) return;
    best = NearestItem{item, distance, closest.on_b};
    most = distance;
  };
  for (const std::uint32_t plane : planes_) see(plane);
  const auto near_enough = [&](const Bounds& box) {
    const Vec3 away = (box.low - point).cwiseMax(point - box.high).cwiseMax(0.0);
    return away.norm() <= most * (1 + 1e-12);
  };
  tree_.visit_near(point, near_enough, see);
  return best;
}

}  // namespace tweenfall::queries
