#include "figures/shape_mesh.h"
#include "recording/meshes/dressed.h"

#include <tweenfall/importers/recording_file.h>

#include <algorithm>
#include <map>

namespace tweenfall::recordings {

namespace {

/// A node that shows one particle after another.
struct Slot {
  std::vector<Vec3> places;
  std::vector<char> shown;
  std::size_t last = 0;  ///< last frame in which it showed one
};

/// Between two particles a slot is hidden for two frames: it shrinks at the place of the first, and grows at that of
/// the second.
constexpr std::size_t pause = 3;

std::vector<Slot> slots_of(const ParticlesRecord& particles, std::size_t frames) {
  std::size_t most = 0;
  for (const StageParticles& there : particles.frame) most = std::max(most, there.numbers.size());
  const std::uint64_t every = std::max<std::size_t>(1, (most + most_particles_in_glb - 1) / most_particles_in_glb);
  constexpr std::uint64_t of_emitter = (std::uint64_t{1} << 40) - 1;
  std::vector<Slot> slots;
  std::map<std::uint64_t, std::size_t> slot_of;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const StageParticles& there = particles.frame[frame];
    std::map<std::uint64_t, std::size_t> now;
    std::vector<std::size_t> born;
    for (std::size_t i = 0; i < there.numbers.size(); ++i) {
      if ((there.numbers[i] & of_emitter) % every != 0) continue;
      const auto known = slot_of.find(there.numbers[i]);
      if (known == slot_of.end()) {
        born.push_back(i);
        continue;
      }
      now.emplace(*known);
      slots[known->second].last = frame;
      slots[known->second].places[frame] = there.positions[i];
      slots[known->second].shown[frame] = 1;
    }
    std::size_t next = 0;
    for (const std::size_t i : born) {
      while (next < slots.size() && slots[next].last + pause > frame) ++next;
      const bool fresh = next == slots.size();
      if (fresh) slots.push_back({std::vector<Vec3>(frames, there.positions[i]), std::vector<char>(frames, 0)});
      Slot& slot = slots[next];
      for (std::size_t k = frame > 0 && !fresh ? frame - 1 : frame; k < frames; ++k)
        slot.places[k] = there.positions[i];
      slot.shown[frame] = 1;
      slot.last = frame;
      now.emplace(there.numbers[i], next);
    }
    // A particle that has died stays where it was.
    for (const auto& [number, slot] : slot_of)
      if (now.count(number) == 0)
        for (std::size_t k = frame; k < frames; ++k) slots[slot].places[k] = slots[slot].places[frame - 1];
    slot_of = std::move(now);
  }
  return slots;
}

ConvexHull octahedron(double radius) {
  std::vector<Vec3> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {radius, -radius}) corners.emplace_back(side * Vec3::Unit(axis));
  return ConvexHull(corners);
}

/// Particles without a radius are drawn with a fraction of the size of the space that all take up.
double radius_of(const ParticlesRecord& particles) {
  constexpr double part = 0.003;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const StageParticles& there : particles.frame)
    for (const Vec3& place : there.positions) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  return std::max({particles.radius, part * (high - low).norm(), 1e-4});
}

}  // namespace

void add_particle_meshes(Dressed& out) {
  const std::vector<ParticlesRecord> all = out.recording.particles;
  const std::size_t frames = out.recording.times.size();
  for (const ParticlesRecord& particles : all) {
    if (particles.frame.size() != frames) continue;
    const std::vector<Slot> slots = slots_of(particles, frames);
    if (slots.empty()) continue;
    const auto described = std::ranges::find(out.stage.particles, particles.name, &ParticlesDescription::name);
    const double r = radius_of(particles);
    Mesh mesh = figures::shape_mesh(Shape{Hull{octahedron(r)}, {}});
    mesh.name = particles.name;
    mesh.base_color = described != out.stage.particles.end() && described->color ? *described->color
                                                                                 : Color{Vec4(0.25, 0.55, 0.85, 1)};
    const std::size_t index = out.stage.meshes.size();
    out.stage.meshes.push_back(std::move(mesh));
    for (std::size_t i = 0; i < slots.size(); ++i) {
      NodeRecord node;
      for (std::size_t frame = 0; frame < frames; ++frame) {
        Motion motion;
        motion.pose.position = slots[i].places[frame];
        motion.pose.scale = slots[i].shown[frame] != 0 ? Vec3(1, 1, 1) : Vec3(0, 0, 0);
        node.world.push_back(child_of({}, motion));
      }
      out.add_shown(std::move(node), particles.name + "/" + std::to_string(i), index);
    }
  }
}

}  // namespace tweenfall::recordings
