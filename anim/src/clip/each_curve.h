#pragma once

// The curves of a clip's tracks, one by one.

#include <tweenfall/anim/clip_jumps.h>
#include <tweenfall/anim/component.h>

namespace tweenfall::clips {

inline Property property_of(const Track& track) {
  const auto component = component_named(track.property);
  return component ? component->property : property_named(track.property);
}

/// Calls `visit(curve, accumulates)` with each curve of a track: whether a loop with offset adds to it.
template <class Visit>
struct EachCurve {
  const Visit& visit;
  bool accumulates;
  template <class T>
  void operator()(const Curve<T>& curve) const {
    visit(curve, accumulates);
  }
  void operator()(const WeightCurves& curves) const {
    for (const Curve<double>& curve : curves) visit(curve, accumulates);
  }
  template <class T>
  void operator()(const StepCurve<T>&) const {}
};

template <class Visit>
void for_each_curve(const Clip& clip, const TrackFilter& counts, const Visit& visit) {
  for (const Track& track : clip.tracks) {
    if (counts && !counts(track)) continue;
    const Property property = property_of(track);
    const bool accumulates = property == Property::position || property == Property::rotation;
    std::visit(EachCurve<Visit>{visit, accumulates}, track.curve);
  }
}

}  // namespace tweenfall::clips
