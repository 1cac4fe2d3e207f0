#include "stage/saving/fingerprint.h"

#include <algorithm>
#include <cmath>

#include "saving/envelope.h"
#include "stage/saving/stage_fields.h"

namespace tweenfall::staging {

namespace {

/// Writes functions as their values at many times.
class Sampling {
 public:
  explicit Sampling(saving::ByteWriter& out) : visit_(out) {}

  template <class T>
  void operator()(const Curve<T>& curve) const {
    const double from = std::isfinite(curve.start()) ? curve.start() : 0;
    const double to = std::isfinite(curve.end()) ? curve.end() : from + 10;
    constexpr int between = 16;
    for (int i = -1; i <= between + 1; ++i) tell(curve, from + (to - from) * i / between, Side::out);
    for (const double knot : curve.knots())
      for (const Side side : {Side::in, Side::out}) tell(curve, knot, side);
  }
  void operator()(const WeightCurves& curves) const {
    for (const Curve<double>& curve : curves) (*this)(curve);
  }
  template <class T>
  void operator()(const StepCurve<T>& curve) const {
    for (const auto& [time, value] : curve.steps()) visit_(time, value);
  }

 private:
  template <class T>
  void tell(const Curve<T>& curve, double time, Side side) const {
    const auto sample = curve.sample(time, side);
    visit_(time);
    each_number(sample.value);
    each_number(sample.rate);
  }
  void each_number(const double& value) const { visit_(value); }
  void each_number(const Color& value) const { visit_(value); }
  void each_number(const Quat& value) const { visit_(value); }
  template <class Vector>
  void each_number(const Vector& value) const {
    for (int i = 0; i < static_cast<int>(value.size()); ++i) visit_(value.data()[i]);
  }

  saving::Walk<saving::ByteWriter> visit_;
};

void tell_forces(const std::vector<ForceDescription>& forces, const saving::Walk<saving::ByteWriter>& visit) {
  for (const ForceDescription& force : forces) {
    const bool user_field = std::holds_alternative<Field>(force.force);
    if (!user_field) visit(force.force);
    visit.places(force.a, force.b);
    for (const std::size_t node : force.bodies) visit.places(node);
    visit(user_field, force.strength);
  }
}

}  // namespace

std::uint64_t fingerprint(const StageDescription& description) {
  saving::ByteWriter out;
  const saving::Walk<saving::ByteWriter> visit(out);
  const Sampling sampling(out);
  visit(description.step, description.world, description.nodes, description.joints, description.rules);
  for (const SoftDescription& soft : description.softs) visit(soft);
  for (const VehicleDescription& vehicle : description.vehicles) visit(vehicle);
  for (const ParticlesDescription& particles : description.particles) {
    visit(particles.name, particles.settings, particles.collide);
    for (const EmitterDescription& emitter : particles.emitters) {
      visit.places(emitter.node);
      visit(emitter.position, emitter.direction, emitter.inherit, emitter.spread, emitter.speed_spread, emitter.size,
            emitter.start, emitter.end);
      sampling(emitter.rate);
      sampling(emitter.speed);
    }
    tell_forces(particles.forces, visit);
  }
  for (const Clip& clip : description.clips) {
    visit(clip.name, clip.duration, clip.loop.mode, clip.loop.count);
    for (const Track& track : clip.tracks) {
      visit(track.node, track.property, track.relative);
      std::visit(sampling, track.curve);
    }
    for (const ClipEvent& event : clip.events) visit(event.from, event.to, event.name, event.data);
  }
  for (const Play& play : description.plays) {
    visit.places(play.clip);
    visit(play.at, play.mask, play.name, play.from, play.to, play.offset, play.reverse, play.loop, play.fade_in,
          play.fade_out, play.fill);
    sampling(play.speed.curve().value_or(Curve<double>(play.speed.at(0))));
    sampling(play.weight);
  }
  for (const GraphDescription& graph : description.graphs) {
    const std::uint64_t of_graph = fingerprint(graph);
    visit(of_graph);
  }
  tell_forces(description.forces, visit);
  for (const auto& [a, b] : description.ignored) visit.places(a, b);
  return saving::checksum(out.bytes);
}

}  // namespace tweenfall::staging
