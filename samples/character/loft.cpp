#include "loft.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tweenfall::character {

namespace {

Section mixed(const Section& a, const Section& b, const Section& c, const Section& d, double u) {
  // Uniform Catmull-Rom through b and c.
  const double wa = ((2 - u) * u - 1) * u / 2, wb = ((3 * u - 5) * u * u + 2) / 2;
  const double wc = ((4 - 3 * u) * u + 1) * u / 2, wd = (u - 1) * u * u / 2;
  return {.center = wa * a.center + wb * b.center + wc * c.center + wd * d.center,
          .half_width = wa * a.half_width + wb * b.half_width + wc * c.half_width + wd * d.half_width,
          .front = wa * a.front + wb * b.front + wc * c.front + wd * d.front,
          .back = wa * a.back + wb * b.back + wc * c.back + wd * d.back,
          .roundness = wa * a.roundness + wb * b.roundness + wc * c.roundness + wd * d.roundness};
}

// Section at `u` of the row, 0 to 1, measured along the line of centers so that rings are evenly spaced.
Section section_at(const std::vector<Section>& row, const std::vector<double>& lengths, double u) {
  const double length = u * lengths.back();
  const std::size_t last = row.size() - 1;
  std::size_t i = 0;
  while (i + 1 < last && lengths[i + 1] <= length) ++i;
  const double local = (length - lengths[i]) / (lengths[i + 1] - lengths[i]);
  return mixed(row[i > 0 ? i - 1 : 0], row[i], row[i + 1], row[std::min(i + 2, last)], local);
}

std::vector<Section> resampled(const Loft& loft) {
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < loft.sections.size(); ++i)
    lengths.push_back(lengths.back() + (loft.sections[i].center - loft.sections[i - 1].center).norm());
  std::vector<Section> rings;
  rings.reserve(static_cast<std::size_t>(loft.rings));
  for (int i = 0; i < loft.rings; ++i)
    rings.push_back(section_at(loft.sections, lengths, static_cast<double>(i) / (loft.rings - 1)));
  return rings;
}

// Quarter of an ellipse from a section outwards: rings that shrink to a pole.
Section cap_ring(const Section& section, const Vec3& outwards, double share) {
  const auto [sine, cosine] = elementary::sin_cos(std::numbers::pi / 2 * share);
  Section ring = section;
  ring.center += outwards * sine;
  ring.half_width *= cosine;
  ring.front *= cosine;
  ring.back *= cosine;
  return ring;
}

Vec3 outline(const Loft& loft, const Section& section, int step) {
  const auto [sine, cosine] = elementary::sin_cos(2 * std::numbers::pi * step / loft.around);
  // Scaling the circle's point onto the outline keeps the vertices evenly spread at the corners.
  const double power = section.roundness;
  const double sum = elementary::pow(std::abs(cosine), power) + elementary::pow(std::abs(sine), power);
  const double scale = elementary::pow(sum, -1 / power);
  const double depth = sine >= 0 ? section.front : section.back;
  return section.center + loft.side * (section.half_width * cosine * scale) + loft.up * (depth * sine * scale);
}

double signed_volume(const Mesh& mesh, std::size_t first_index) {
  double volume = 0;
  for (std::size_t i = first_index; i < mesh.triangles.size(); i += 3) {
    const Vec3 &a = mesh.positions[mesh.triangles[i]], &b = mesh.positions[mesh.triangles[i + 1]],
               &c = mesh.positions[mesh.triangles[i + 2]];
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

void add_triangles(Mesh& mesh, std::uint32_t first, std::uint32_t around, std::uint32_t rings) {
  const std::size_t first_index = mesh.triangles.size();
  const std::uint32_t start_pole = first + rings * around, end_pole = start_pole + 1;
  const auto at = [&](std::uint32_t ring, std::uint32_t step) { return first + ring * around + step % around; };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
  };
  for (std::uint32_t s = 0; s < around; ++s) {
    add(start_pole, at(0, s), at(0, s + 1));
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      add(at(r, s), at(r + 1, s), at(r + 1, s + 1));
      add(at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
    add(end_pole, at(rings - 1, s + 1), at(rings - 1, s));
  }
  if (signed_volume(mesh, first_index) < 0)
    for (std::size_t i = first_index; i < mesh.triangles.size(); i += 3)
      std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);

  // Cross products weigh each face by its area.
  for (std::size_t i = first_index; i < mesh.triangles.size(); i += 3) {
    const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
    const Vec3 normal = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    for (const std::uint32_t corner : {a, b, c}) mesh.normals[corner] += normal;
  }
}

}  // namespace

void add_loft(Mesh& mesh, const Loft& loft, const Weighting& weighting, const Sculpt& sculpt) {
  std::vector<Section> rings = resampled(loft);
  const Section first = rings.front(), last = rings.back();
  const Vec3 start = (first.center - rings[1].center).normalized() * loft.start_cap;
  const Vec3 end = (last.center - rings[rings.size() - 2].center).normalized() * loft.end_cap;
  for (int i = 1; i <= loft.cap_rings; ++i) {
    const double share = static_cast<double>(i) / (loft.cap_rings + 1);
    rings.insert(rings.begin(), cap_ring(first, start, share));
    rings.push_back(cap_ring(last, end, share));
  }

  const std::size_t before = mesh.positions.size();
  for (const Section& ring : rings)
    for (int step = 0; step < loft.around; ++step) mesh.positions.push_back(outline(loft, ring, step));
  mesh.positions.push_back(first.center + start);
  mesh.positions.push_back(last.center + end);
  for (std::size_t i = before; i < mesh.positions.size(); ++i) {
    if (sculpt) mesh.positions[i] = sculpt(mesh.positions[i]);
    mesh.influences.add(weighting(mesh.positions[i]));
    mesh.normals.push_back(Vec3::Zero());
  }
  add_triangles(mesh, static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(loft.around),
                static_cast<std::uint32_t>(rings.size()));
  for (std::size_t i = before; i < mesh.normals.size(); ++i) mesh.normals[i].normalize();
}

}  // namespace tweenfall::character
