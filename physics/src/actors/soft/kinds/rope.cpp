#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>

#include <cmath>
#include <numbers>

#include "actors/soft/soft_state.h"
#include "state/checks.h"
#include "state/countable.h"

namespace tweenfall {

namespace soft {
namespace {

/// The angle by which each link of a chain of equal links turns against the one before, so that the chain, on a
/// circle, spans its ends: distance / link = sin(links angle / 2) / sin(angle / 2).
double turn_of_links(int links, double ends_over_link) {
  double low = 0, high = 2 * std::numbers::pi / links;
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.5 * (low + high);
    const double span = angle > 0 ? elementary::sin(0.5 * links * angle) / elementary::sin(0.5 * angle) : links;
    (span > ends_over_link ? low : high) = angle;
  }
  return 0.5 * (low + high);
}

/// The part of `down` that is perpendicular to the rope.
Vec3 sag_of(const Vec3& along, const Vec3& down) {
  const auto across = [&along](const Vec3& way) -> Vec3 { return way - along * along.dot(way); };
  if (across(down).norm() > 1e-6) return across(down).normalized();
  return across(std::abs(along.x()) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
}

}  // namespace
}  // namespace soft

SoftSettings rope(const RopeSettings& settings) {
  using state::require;
  require(settings.links >= 1 && settings.links <= 100'000,
          "a rope has 1 to 100000 links, not " + std::to_string(settings.links));
  state::require_finite(settings.from, "start of a rope");
  state::require_finite(settings.to, "end of a rope");
  const Vec3 between = settings.to - settings.from;
  const double distance = between.norm();
  require(distance >= 1e-9, "the ends of a rope must not be at one place");
  state::require_amount(settings.slack, "slack of a rope");
  state::require_finite(settings.down, "the way down of a rope");
  require(settings.down.norm() >= 1e-9, "the way down of a rope must be longer than 0");
  require(settings.slack == 0 || settings.links > 1, "a rope of one link cannot have slack");
  require(settings.slack <= 1000, "slack of a rope must be at most 1000, not " + number_text(settings.slack));
  require(settings.mass >= state::smallest && settings.mass <= state::largest,
          "the mass of a rope must be above 0 kg, not " + number_text(settings.mass));
  require(settings.stiffness > 0, "the stiffness of a rope must be above 0 N, not " + number_text(settings.stiffness));
  state::require_amount(settings.damping, "damping of a rope");
  state::require_amount(settings.bending, "bending of a rope");
  require(settings.tear > 0, "a rope must tear at a strain above 0, not " + number_text(settings.tear));

  SoftSettings made;
  const auto links = static_cast<std::size_t>(settings.links);
  const double count = settings.links, length = distance * (1 + settings.slack), link = length / count;
  const Vec3 along = between / distance, sag = soft::sag_of(along, settings.down.normalized());
  const double turn = settings.slack > 0 ? soft::turn_of_links(settings.links, distance / link) : 0;
  Vec3 place = settings.from;
  for (std::size_t i = 0; i <= links; ++i) {
    if (turn == 0) {
      made.positions.push_back(i == links ? settings.to
                                          : Vec3(settings.from + between * (static_cast<double>(i) / count)));
      continue;
    }
    made.positions.push_back(i == links ? settings.to : place);
    const double angle = turn * (0.5 * (count - 1) - static_cast<double>(i));
    place += link * (elementary::cos(angle) * along + elementary::sin(angle) * sag);
  }
  made.masses.assign(links + 1, settings.mass / count);
  made.masses.front() = made.masses.back() = 0.5 * settings.mass / count;
  for (std::uint32_t i = 0; i < links; ++i)
    made.edges.push_back({.a = i,
                          .b = i + 1,
                          .length = link,
                          .stiffness = settings.stiffness / link,
                          .damping = settings.damping / link,
                          .tear = settings.tear});
  if (settings.bending > 0)
    for (std::uint32_t i = 1; i < links; ++i)
      made.bends.push_back({.nodes = {i - 1, i, i + 1, i + 1},
                            .weights = {1, -2, 1, 0},
                            .stiffness = settings.bending / (link * link * link)});
  return made;
}

}  // namespace tweenfall
