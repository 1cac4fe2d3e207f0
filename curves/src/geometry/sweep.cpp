#include <tweenfall/curves/frames.h>
#include <tweenfall/curves/sweep.h>

#include <cmath>
#include <stdexcept>

#include "curve/components.h"
#include "geometry/profile.h"

namespace tweenfall::geometry {
namespace {

// The rates of the rail that the surface normal needs at a ring.
struct RailPoint {
  double speed;       // m/s
  Vec3 tangent_rate;  // derivative of the tangent, 1/s
  double twist_rate;  // rad/s
};

RailPoint rail_point(const Curve<Vec3>& rail, double time, const Vec3& tangent, double twist_per_length) {
  const Sample<Vec3> s = rail.sample(time, time >= rail.end() ? Side::in : Side::out);
  const double speed = s.rate.norm();
  if (!(speed > 0)) return {1, Vec3(0, 0, 0), 0};
  return {speed, Vec3((s.acceleration - s.acceleration.dot(tangent) * tangent) / speed), twist_per_length * speed};
}

// The outward normal of the surface: the tangent along the profile times the tangent along the rail.
Vec3 surface_normal(const Profile::Column& p, const Frame& f, const RailPoint& r) {
  const Vec3 arm = p.position[0] * f.normal + p.position[1] * f.binormal;
  const Vec3 along_profile = p.tangent[0] * f.normal + p.tangent[1] * f.binormal;
  const Vec3 along_rail = (r.speed - arm.dot(r.tangent_rate)) * f.tangent + r.twist_rate * f.tangent.cross(arm);
  Vec3 normal = along_profile.cross(along_rail);
  // Where the bend is tighter than the profile is wide, the surface runs backwards.
  if (normal.dot(along_profile.cross(f.tangent)) < 0) normal = -normal;
  const double size = normal.norm();
  return size > 0 ? Vec3(normal / size) : Vec3(along_profile.cross(f.tangent));
}

void add_lid(SurfaceMesh& mesh, const Profile& profile, const Frame& frame, std::uint32_t ring, bool at_end) {
  std::vector<Vec2> outline;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const std::uint32_t corner : profile.corners) {
    outline.push_back(profile.columns[corner].position);
    mesh.positions.push_back(mesh.positions[ring + corner]);
    mesh.normals.push_back(at_end ? frame.tangent : Vec3(-frame.tangent));
    mesh.texture_coordinates.push_back(profile.columns[corner].position);
  }
  const std::vector<std::uint32_t> triangles = polygon_triangles(outline);
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    for (const std::size_t k : {0, 1, 2}) mesh.triangles.push_back(first + triangles[i + (at_end ? k : 2 - k)]);
}

}  // namespace
}  // namespace tweenfall::geometry

namespace tweenfall {

SurfaceMesh sweep(const Curve<Vec2>& curve, const Curve<Vec3>& rail, const SweepOptions& options) {
  if (!std::isfinite(options.twist)) throw std::invalid_argument("a sweep's twist must be finite");
  // A straight side that is twisted becomes a helical surface, not a plane.
  geometry::Profile profile(curve, options.profile_steps, options.twist == 0);
  if (profile.closed && profile.area < 0) profile.reverse();

  const std::vector<double> times = geometry::step_times(rail, options.rail_steps, options.twist == 0, "a rail");
  const Vec3 begin = rail.value(times.front()), end = rail.value(times.back(), Side::in);
  const Vec3 leaving = rail.rate(times.front()), arriving = rail.rate(times.back(), Side::in);
  double size = 0;
  for (const double t : times) size = std::max(size, (rail.value(t) - begin).norm());
  if (!(size > 0) || !std::isfinite(size))
    throw std::invalid_argument("a rail must have a finite length; it stays within " + spans::text_of(size) + " m of " +
                                spans::text_of(begin));
  const bool loop = times.size() > 3 && (end - begin).norm() <= 1e-9 * size &&
                    leaving.cross(arriving).norm() <= 1e-6 * leaving.norm() * arriving.norm() &&
                    leaving.dot(arriving) > 0;
  constexpr double turn = 0x1.921fb54442d18p+2;
  if (loop && !(std::abs(std::remainder(options.twist, turn)) <= 1e-9))
    throw std::invalid_argument("a closed rail is twisted by whole turns, or the profile would not meet itself; " +
                                spans::text_of(options.twist) + " radians given");
  const std::vector<Frame> frames =
      rotation_minimizing_frames(rail, times, {.normal = options.normal, .twist = options.twist, .closed = loop});
  std::vector<double> along = {0};
  for (std::size_t i = 1; i < frames.size(); ++i)
    along.push_back(along.back() + (frames[i].position - frames[i - 1].position).norm());

  SurfaceMesh mesh;
  const auto columns = static_cast<std::uint32_t>(profile.columns.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame& f = frames[i];
    const geometry::RailPoint r = geometry::rail_point(rail, times[i], f.tangent, options.twist / along.back());
    const bool again = loop && i + 1 == frames.size();  // the first ring, to the bit
    for (std::uint32_t c = 0; c < columns; ++c) {
      const geometry::Profile::Column& p = profile.columns[c];
      mesh.positions.push_back(again ? mesh.positions[c]
                                     : Vec3(f.position + p.position[0] * f.normal + p.position[1] * f.binormal));
      mesh.normals.push_back(again ? mesh.normals[c] : geometry::surface_normal(p, f, r));
      mesh.texture_coordinates.push_back({p.share, along[i] / along.back()});
    }
    if (i == 0) continue;
    const auto ring = static_cast<std::uint32_t>(i) * columns;
    for (const std::uint32_t side : profile.sides) {
      const std::uint32_t a = ring - columns + side, b = a + 1, c = ring + side, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  if (options.caps && profile.closed && !loop) {
    geometry::add_lid(mesh, profile, frames.front(), 0, false);
    geometry::add_lid(mesh, profile, frames.back(), static_cast<std::uint32_t>(frames.size() - 1) * columns, true);
  }
  return mesh;
}

}  // namespace tweenfall
