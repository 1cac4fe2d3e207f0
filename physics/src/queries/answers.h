#pragma once

#include "queries/checked.h"
#include "queries/scene.h"

namespace tweenfall::queries {

// The answers that are the same for every scene. `Asked` has `scene()` and `id(item)`.

template <class Asked, class Filter>
[[nodiscard]] Scene::Accept accept(const Asked& asked, const Filter& filter) {
  return [&asked, &filter](std::uint32_t item) {
    const Item& what = asked.scene()[item];
    return (what.groups & filter.groups) != 0 && (filter.sensors || !what.sensor) &&
           (!filter.accept || filter.accept(asked.id(item)));
  };
}

template <class Hit, class Asked, class Filter>
[[nodiscard]] std::optional<Hit> first_on_ray(const Asked& asked, const Ray& ray, const Filter& filter) {
  const auto hit = asked.scene().first_on_ray(ray, accept(asked, filter));
  if (!hit) return std::nullopt;
  return Hit{*hit, asked.id(hit->item)};
}

template <class Hit, class Asked, class Filter>
[[nodiscard]] std::vector<Hit> all_on_ray(const Asked& asked, const Ray& ray, const Filter& filter) {
  const std::vector<Scene::ItemRayHit> found = asked.scene().all_on_ray(ray, accept(asked, filter));
  std::vector<Hit> hits;
  hits.reserve(found.size());
  for (const Scene::ItemRayHit& hit : found) hits.push_back({hit, asked.id(hit.item)});
  return hits;
}

template <class Hit, class Asked, class Filter>
[[nodiscard]] std::optional<Hit> first_on_way(const Asked& asked, const Shape& shape, const Pose& start,
                                              const Vec3& displacement, const Filter& filter) {
  require_no_plane(shape);
  require_place(start);
  require_finite(displacement, "a displacement");
  const auto hit = asked.scene().first_on_way(shape, start, displacement, accept(asked, filter));
  if (!hit) return std::nullopt;
  return Hit{*hit, asked.id(hit->item)};
}

template <class Who, class Asked, class Filter>
[[nodiscard]] std::vector<Who> all_overlapping(const Asked& asked, const Shape& shape, const Pose& pose,
                                               const Filter& filter) {
  require_no_plane(shape);
  require_place(pose);
  const std::vector<std::uint32_t> found = asked.scene().overlapping(shape, pose, accept(asked, filter));
  std::vector<Who> who;
  who.reserve(found.size());
  for (const std::uint32_t item : found) who.push_back(asked.id(item));
  return who;
}

template <class Nearest, class Asked, class Filter>
[[nodiscard]] std::optional<Nearest> nearest(const Asked& asked, const Vec3& point, double within,
                                             const Filter& filter) {
  require_finite(point, "a point");
  require_amount(within, "a greatest distance");
  const auto found = asked.scene().nearest(point, within, accept(asked, filter));
  if (!found) return std::nullopt;
  return Nearest{asked.id(found->item), found->distance, found->point};
}

}  // namespace tweenfall::queries
