#include "fbx/surface/deformers.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::fbx {

namespace {

std::vector<Vec3> vectors(const Reals& numbers) {
  std::vector<Vec3> all;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) all.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return all;
}

bool all_finite(const std::vector<Vec3>& all) {
  return std::ranges::all_of(all, [](const Vec3& v) { return v.allFinite(); });
}

/// The share of the channel, 1 at 100 %, at which only this shape shows, for each of its shapes.
std::vector<double> full_shares(std::size_t channel, std::size_t shapes, const Objects& objects) {
  Reals percents = objects[channel].record->reals("FullWeights");
  std::vector<double> shares(shapes, 1.0);
  // Blender writes one number per point here, with another meaning.
  if (percents.size() != shapes) return shares;
  for (std::size_t i = 0; i < shapes; ++i)
    if (std::isfinite(percents[i])) shares[i] = percents[i] / 100;
  return shares;
}

/// The weight of one shape where the channel is at a share: linear from shape to shape in order of their shares, and
/// extrapolated beyond the last. Value and slope.
std::pair<double, double> shown(const std::vector<double>& shares, std::size_t shape, double at) {
  // The shapes on this side of zero, in order of distance.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (at > 0 ? shares[i] >= 0 : shares[i] < 0) order.push_back(i);
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return std::abs(shares[a]) < std::abs(shares[b]); });
  if (order.empty()) {
    // Below zero without a shape there, the nearest one above is extrapolated backwards.
    for (std::size_t i = 0; i < shares.size(); ++i)
      if (order.empty() || std::abs(shares[i]) < std::abs(shares[order[0]])) order = {i};
  }
  double from = 0, to = 0;
  std::size_t before = shares.size(), after = shares.size();
  for (const std::size_t i : order) {
    before = after;
    from = to;
    after = i;
    to = shares[i];
    if (std::abs(to) > std::abs(at)) break;
  }
  const double width = to - from;
  if (width == 0) return {0, 0};
  const double part = (at - from) / width;
  if (shape == after) return {part, 1 / width};
  if (shape == before) return {1 - part, -1 / width};
  return {0, 0};
}

}  // namespace

std::vector<Shape> read_shapes(std::size_t geometry, const Objects& objects, models::ModelProblems& problems) {
  std::vector<Shape> all;
  for (const std::size_t blend : objects.below(geometry, "Deformer", "BlendShape"))
    for (const std::size_t channel : objects.below(blend, "Deformer", "BlendShapeChannel")) {
      const std::vector<std::size_t> shapes = objects.below(channel, "Geometry", "Shape");
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Record& record = *objects[shapes[i]].record;
        Shape shape{
            shapes.size() == 1 && !objects[channel].name.empty() ? objects[channel].name : objects[shapes[i]].name,
            channel,
            i,
            {},
            vectors(record.reals("Vertices")),
            vectors(record.reals("Normals"))};
        for (const std::int64_t point : record.integers("Indexes"))
          shape.points.push_back(static_cast<std::uint32_t>(std::clamp<std::int64_t>(point, 0, 0xFFFFFFFF)));
        if (shape.points.size() != shape.position_offsets.size() || !all_finite(shape.position_offsets))
          objects.source().fail(record.at, "the shape \"" + shape.name + "\" has " +
                                               std::to_string(shape.points.size()) + " points for " +
                                               std::to_string(shape.position_offsets.size()) + " finite offsets");
        if (shape.normal_offsets.size() != shape.points.size() || !all_finite(shape.normal_offsets))
          shape.normal_offsets.clear();
        if (shape.name.empty()) shape.name = "morph_" + std::to_string(all.size());
        all.push_back(std::move(shape));
      }
      if (shapes.empty())
        problems.repair("blend shape channel \"" + objects[channel].name + "\"", "has no shape and was not read");
    }
  return all;
}

std::vector<Channel<double>> shape_weights(const std::vector<Shape>& shapes, const Objects& objects,
                                           const Stack* stack) {
  std::vector<Channel<double>> all;
  for (const Shape& shape : shapes) {
    // Some programs write the percentage beside the properties.
    const Record* field = objects[shape.channel].record->find("DeformPercent");
    Channel<double> percent =
        number_channel(objects, shape.channel, "DeformPercent", field ? field->number(0, 0) : 0, stack);
    const auto count = static_cast<std::size_t>(std::ranges::count(shapes, shape.channel, &Shape::channel));
    const std::vector<double> shares = full_shares(shape.channel, count, objects);
    if (count == 1 && shares[0] == 1) {
      all.push_back({times(percent.curve, 0.01), percent.driven});
      continue;
    }
    all.push_back({composed<double>(
                       [curve = percent.curve, shares, place = shape.place](double at, Side side) {
                         const Sample<double> s = curve.sample(at, side);
                         const auto [value, slope] = shown(shares, place, s.value / 100);
                         return Sample<double>{value, slope * s.rate / 100, slope * s.acceleration / 100};
                       },
                       Knots().of(percent.curve)),
                   percent.driven});
  }
  return all;
}

}  // namespace tweenfall::fbx
