#include "actors/soft/blowing.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::soft {

void find_winds(const std::vector<forces::NumberedForce>& forces, double time, std::vector<Blowing>& winds) {
  winds.clear();
  for (const forces::NumberedForce& force : forces) {
    const auto* const wind = std::get_if<Wind>(&force.force);
    if (!wind || !force.settings.bodies.empty()) continue;
    winds.push_back({wind->velocity, forces::not_negative(force.settings.strength.at(time)) * wind->density});
  }
}

void blow(SoftBody& body, const std::vector<Blowing>& winds, double h) {
  const SoftSettings& made = *body.made;
  if (!(made.air_drag > 0) || winds.empty()) return;
  // Each face has its share of the mass of its corners.
  thread_local std::vector<int> faces;
  faces.assign(body.positions.size(), 0);
  for (std::size_t i = 0; i < made.triangles.size(); ++i)
    for (const std::uint32_t corner : made.triangles[i]) faces[corner] += body.gone.triangles[i] != 0 ? 0 : 1;
  thread_local std::vector<Vec3> given;  // N s
  given.assign(body.positions.size(), Vec3(0, 0, 0));
  for (std::size_t i = 0; i < made.triangles.size(); ++i) {
    if (body.gone.triangles[i] != 0) continue;
    const auto& [a, b, c] = made.triangles[i];
    const Vec3 across = (body.positions[b] - body.positions[a]).cross(body.positions[c] - body.positions[a]);
    const double doubled = across.norm();
    if (!(doubled > 0)) continue;
    const Vec3 normal = across / doubled;
    const Vec3 velocity = (body.velocities[a] + body.velocities[b] + body.velocities[c]) / 3;
    double mass = 0;
    for (const std::uint32_t corner : made.triangles[i]) mass += made.masses[corner] / faces[corner];
    double goes = normal.dot(velocity);  // velocity of the face along its normal, updated wind after wind
    for (const Blowing& wind : winds) {
      const double against = normal.dot(wind.velocity) - goes, speed = std::abs(against);
      // As at the end of the step, so that none overshoots: left + drag h left^2 / mass = speed.
      const double drag = 0.25 * wind.density * made.air_drag * doubled;
      const double left = 2 * speed / (1 + std::sqrt(1 + 4 * drag * h / mass * speed));
      goes += std::copysign(speed - left, against);
    }
    const double through = mass * (goes - normal.dot(velocity));  // N s
    for (const std::uint32_t corner : made.triangles[i]) given[corner] += through / 3 * normal;
  }
  for (std::size_t i = 0; i < given.size(); ++i) body.velocities[i] += given[i] / made.masses[i];
}

}  // namespace tweenfall::soft
