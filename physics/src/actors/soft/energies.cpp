#include "actors/soft/energies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "actors/soft/resolved.h"

namespace tweenfall::soft {

double elastic_energy(const SoftBody& body) {
  const SoftSettings& made = *body.made;
  const std::vector<Vec3>& x = body.positions;
  double energy = 0;
  const auto add = [&energy](double stiffness, double off) {
    if (!std::isinf(stiffness)) energy += 0.5 * stiffness * off * off;
  };
  const bool passed_over = passes_over_edges(body);
  for (std::size_t i = 0; i < made.edges.size(); ++i) {
    const SoftEdge& edge = made.edges[i];
    if (body.torn[i] != 0 || std::isinf(edge.stiffness)) continue;
    add(passed_over ? resolved(body, edge).stiffness : edge.stiffness, (x[edge.a] - x[edge.b]).norm() - *edge.length);
  }
  for (std::size_t i = 0; i < made.bends.size(); ++i) {
    const SoftBend& bend = made.bends[i];
    if (body.gone.bends[i] != 0 || std::isinf(bend.stiffness)) continue;
    Vec3 off(0, 0, 0);
    for (std::size_t k = 0; k < 4; ++k) off += bend.weights[k] * x[bend.nodes[k]];
    add(resolved_stiffness(body, bend), off.norm());
  }
  return energy + volume_energy(body);
}

double volume_energy(const SoftBody& body) {
  const SoftSettings& made = *body.made;
  const std::vector<Vec3>& x = body.positions;
  double energy = 0;
  const auto add = [&energy](double stiffness, double off) {
    if (!std::isinf(stiffness)) energy += 0.5 * stiffness * off * off;
  };
  for (std::size_t i = 0; i < made.tetrahedra.size(); ++i) {
    if (body.gone.tetrahedra[i] != 0) continue;
    const SoftTetrahedron& solid = made.tetrahedra[i];
    const auto& n = solid.nodes;
    if (!std::isinf(solid.stiffness))
      add(resolved_stiffness(made, solid, body.pace), volume_of(x[n[0]], x[n[1]], x[n[2]], x[n[3]]) - *solid.volume);
  }
  for (std::size_t i = 0; i < made.enclosures.size(); ++i) {
    const SoftEnclosure& enclosure = made.enclosures[i];
    if (body.gone.enclosures[i] == 0 && !std::isinf(enclosure.stiffness))
      add(resolved_stiffness(made, enclosure, body.pace), enclosed_by(enclosure.triangles, x) - *enclosure.volume);
  }
  return energy;
}

void Energies::take_edges(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  edges_.clear();
  for (std::size_t i = 0; i < made_.edges.size(); ++i) {
    if (body_.torn[i] != 0) continue;
    const SoftEdge& edge = made_.edges[i];
    const Vec3 between = p_[edge.a] - p_[edge.b], before = x[edge.a] - x[edge.b];
    const double length = between.norm(), length_before = before.norm();
    // Two ends at the same place have no direction.
    const Vec3 normal = length > 0 ? Vec3(between / length) : Vec3(0, 0, 0);
    const Vec3 damped_normal = length_before > 0 ? Vec3(before / length_before) : Vec3(0, 0, 0);
    const double pull = edge.stiffness * (length - *edge.length);
    edges_.push_back({edge.a, edge.b, normal, pull, edge.stiffness, length > 0 ? std::max(0.0, pull / length) : 0,
                      damped_normal, edge.damping * damped_normal.dot(v[edge.a] - v[edge.b]), edge.damping});
  }
}

void Energies::take_amounts() {
  amounts_.clear();
  for (std::size_t i = 0; i < made_.tetrahedra.size(); ++i) {
    if (body_.gone.tetrahedra[i] != 0) continue;
    const SoftTetrahedron& solid = made_.tetrahedra[i];
    const auto& n = solid.nodes;
    const Vec3 b = p_[n[1]] - p_[n[0]], c = p_[n[2]] - p_[n[0]], d = p_[n[3]] - p_[n[0]];
    const Vec3 by_b = c.cross(d) / 6, by_c = d.cross(b) / 6, by_d = b.cross(c) / 6;
    amounts_.push_back({solid.stiffness / *solid.volume,
                        b.dot(c.cross(d)) / 6 - *solid.volume,
                        {{n[0], -(by_b + by_c + by_d)}, {n[1], by_b}, {n[2], by_c}, {n[3], by_d}}});
  }
  for (std::size_t i = 0; i < made_.enclosures.size(); ++i) {
    if (body_.gone.enclosures[i] != 0) continue;
    const SoftEnclosure& enclosure = made_.enclosures[i];
    std::vector<Vec3> gradients(p_.size(), Vec3(0, 0, 0));
    const Vec3 origin = p_[enclosure.triangles[0][0]];
    double volume = 0;
    for (const auto& triangle : enclosure.triangles) {
      const Vec3 a = p_[triangle[0]] - origin, b = p_[triangle[1]] - origin, c = p_[triangle[2]] - origin;
      volume += a.dot(b.cross(c)) / 6;
      gradients[triangle[0]] += b.cross(c) / 6;
      gradients[triangle[1]] += c.cross(a) / 6;
      gradients[triangle[2]] += a.cross(b) / 6;
    }
    Amount amount{enclosure.stiffness / *enclosure.volume, volume - *enclosure.volume, {}};
    for (std::uint32_t k = 0; k < p_.size(); ++k)
      if (gradients[k] != Vec3::Zero()) amount.gradients.emplace_back(k, gradients[k]);
    amounts_.push_back(std::move(amount));
  }
}

double Energies::at(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  p_ = x;
  for (std::size_t i = 0; i < p_.size(); ++i) p_[i] += h_ * v[i];
  take_edges(x, v);
  bends_.clear();
  for (std::size_t i = 0; i < made_.bends.size(); ++i) {
    if (body_.gone.bends[i] != 0) continue;
    Vec3 off(0, 0, 0);
    for (std::size_t k = 0; k < 4; ++k) off += made_.bends[i].weights[k] * p_[made_.bends[i].nodes[k]];
    bends_.push_back({&made_.bends[i], off});
  }
  take_amounts();
  double sum = 0;
  for (const Edge& edge : edges_) {
    sum += 0.5 * edge.pull * edge.pull / edge.along;
    if (edge.damping > 0) sum += 0.5 * h_ * edge.damped * edge.damped / edge.damping;
  }
  for (const Bend& bend : bends_) sum += 0.5 * bend.bend->stiffness * bend.off.squaredNorm();
  for (const Amount& amount : amounts_) sum += 0.5 * amount.stiffness * amount.off * amount.off;
  return sum;
}

void Energies::add_gradient(std::vector<Vec3>& gradient) const {
  for (const Edge& edge : edges_) {
    const Vec3 force = h_ * (edge.pull * edge.normal + edge.damped * edge.damped_normal);
    gradient[edge.a] += force;
    gradient[edge.b] -= force;
  }
  for (const Bend& bend : bends_)
    for (std::size_t k = 0; k < 4; ++k)
      gradient[bend.bend->nodes[k]] += h_ * bend.bend->stiffness * bend.bend->weights[k] * bend.off;
  for (const Amount& amount : amounts_)
    for (const auto& [node, direction] : amount.gradients)
      gradient[node] += h_ * amount.stiffness * amount.off * direction;
}

void Energies::add_product(const std::vector<Vec3>& change, std::vector<Vec3>& out) const {
  for (const Edge& edge : edges_) {
    const Vec3 apart = change[edge.a] - change[edge.b];
    const double along = edge.normal.dot(apart);
    Vec3 force = h_ * h_ * (edge.along * along * edge.normal + edge.across * (apart - along * edge.normal));
    if (edge.damping > 0) force += h_ * edge.damping * edge.damped_normal.dot(apart) * edge.damped_normal;
    out[edge.a] += force;
    out[edge.b] -= force;
  }
  for (const Bend& bend : bends_) {
    Vec3 off(0, 0, 0);
    for (std::size_t k = 0; k < 4; ++k) off += bend.bend->weights[k] * change[bend.bend->nodes[k]];
    off *= h_ * h_ * bend.bend->stiffness;
    for (std::size_t k = 0; k < 4; ++k) out[bend.bend->nodes[k]] += bend.bend->weights[k] * off;
  }
  for (const Amount& amount : amounts_) {
    double grown = 0;
    for (const auto& [node, direction] : amount.gradients) grown += direction.dot(change[node]);
    grown *= h_ * h_ * amount.stiffness;
    for (const auto& [node, direction] : amount.gradients) out[node] += grown * direction;
  }
}

Mat3 Energies::block_of(const Edge& edge) const {
  const Mat3 line = edge.normal * edge.normal.transpose();
  Mat3 block = h_ * h_ * (edge.along * line + edge.across * (Mat3::Identity() - line));
  if (edge.damping > 0) block += h_ * edge.damping * edge.damped_normal * edge.damped_normal.transpose();
  return block;
}

void Energies::add_blocks(std::vector<Mat3>& blocks) const {
  for (const Edge& edge : edges_) {
    const Mat3 block = block_of(edge);
    blocks[edge.a] += block;
    blocks[edge.b] += block;
  }
  for (const Bend& bend : bends_)
    for (std::size_t k = 0; k < 4; ++k)
      blocks[bend.bend->nodes[k]] +=
          h_ * h_ * bend.bend->stiffness * bend.bend->weights[k] * bend.bend->weights[k] * Mat3::Identity();
  for (const Amount& amount : amounts_)
    for (const auto& [node, direction] : amount.gradients)
      blocks[node] += h_ * h_ * amount.stiffness * direction * direction.transpose();
}

void Energies::add_all_blocks(ChainFactor& matrix) const {
  for (const Edge& edge : edges_) {
    const Mat3 block = block_of(edge);
    matrix.add(edge.a, edge.a, block);
    matrix.add(edge.b, edge.b, block);
    matrix.add(edge.a, edge.b, -block);
  }
  for (const Bend& bend : bends_)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t other = 0; other <= k; ++other) {
        const double weights = bend.bend->weights[k] * bend.bend->weights[other];
        if (weights == 0) continue;
        const Mat3 block = h_ * h_ * bend.bend->stiffness * weights * Mat3::Identity();
        matrix.add(bend.bend->nodes[k], bend.bend->nodes[other], block);
      }
  for (const Amount& amount : amounts_)
    for (std::size_t k = 0; k < amount.gradients.size(); ++k)
      for (std::size_t other = 0; other <= k; ++other) {
        const auto& [a, of_a] = amount.gradients[k];
        const auto& [b, of_b] = amount.gradients[other];
        matrix.add(a, b, h_ * h_ * amount.stiffness * of_a * of_b.transpose());
      }
}

}  // namespace tweenfall::soft
