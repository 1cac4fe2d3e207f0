#include "islands/shifted_apart.h"

#include <algorithm>

namespace tweenfall::islands {

using contacts::ContactConstraint;
using state::Body;

namespace {

/// Overlap that is left, m: what merely lies on something is not lifted off.
constexpr double left = 2e-5;
constexpr int most_sweeps = 32, most_passes = 64;
/// Share of the way that contacts may lack.
constexpr double lacking = 0.1, hardly_lacking = 0.01;

constexpr std::uint32_t nowhere = 0xfffffffe;

/// The widest or narrowest gap among a contact's points, m.
template <class Choose>
double gap_of(const ContactConstraint& contact, const Choose& choose) {
  double gap = contact.points[0].start_gap;
  for (int i = 1; i < contact.count; ++i) gap = choose(gap, contact.points[static_cast<std::size_t>(i)].start_gap);
  return gap;
}
double widest_gap(const ContactConstraint& contact) {
  return gap_of(contact, [](double a, double b) { return std::max(a, b); });
}
double narrowest_gap(const ContactConstraint& contact) {
  return gap_of(contact, [](double a, double b) { return std::min(a, b); });
}

bool stays(const Body& body) {
  return body.immovable() || body.asleep;
}

}  // namespace

void ShiftedApart::mark(std::span<ContactConstraint* const> contacts, const threads::Workers& workers) {
  constexpr std::size_t worth_a_part = 256;
  // Where one corner lies deeper than the others, impulses still turn it out.
  workers.ranges(contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (ContactConstraint* contact : contacts.subspan(begin, end - begin))
      if (contact->within) contact->eased = std::max(0.0, -widest_gap(*contact));
  });
}

void ShiftedApart::find_levels(const std::vector<Body>& bodies) {
  for (const std::uint32_t body : members_) levels_[body] = stays(bodies[body]) ? 0 : nowhere;
  bool changed = true;
  for (int pass = 0; pass < most_passes && changed; ++pass) {
    changed = false;
    for (std::size_t n = 0; n < openings_.size(); ++n) {
      const ContactConstraint& contact = *openings_[pass % 2 == 0 ? n : openings_.size() - 1 - n].contact;
      std::uint32_t &a = levels_[contact.a], &b = levels_[contact.b];
      const std::uint32_t over_a = std::min(a + 1, nowhere), over_b = std::min(b + 1, nowhere);
      changed = changed || over_b < a || over_a < b;
      a = std::min(a, over_b);
      b = std::min(b, over_a);
    }
  }
  const auto lower_end = [this](const Opening& one) {
    return std::min(levels_[one.contact->a], levels_[one.contact->b]);
  };
  std::stable_sort(openings_.begin(), openings_.end(),
                   [&](const Opening& one, const Opening& other) { return lower_end(one) < lower_end(other); });
}

/// The lower of two bodies bears the other one's shift; where none is lower, the lighter one moves more.
void ShiftedApart::sweep(const std::vector<Body>& bodies) {
  for (const Opening& one : openings_) {
    const Vec3& normal = one.contact->manifold.normal;
    const std::uint32_t a = one.contact->a, b = one.contact->b;
    const double lacks = one.width - normal.dot(shifts_[b] - shifts_[a]);
    if (!(lacks > 0)) continue;
    const auto lightness = [&](std::uint32_t of, std::uint32_t other) {
      return stays(bodies[of]) || levels_[of] < levels_[other] ? 0 : 1 / bodies[of].mass().mass;
    };
    const double light_a = lightness(a, b), light_b = lightness(b, a);
    if (!(light_a + light_b > 0)) continue;
    const double share = light_b / (light_a + light_b);
    shifts_[b] += share * lacks * normal;
    shifts_[a] -= (1 - share) * lacks * normal;
  }
}

/// The most that a contact lacks, m.
double ShiftedApart::missing() const {
  double result = 0;
  for (const Opening& one : openings_)
    result = std::max(result,
                      one.width - one.contact->manifold.normal.dot(shifts_[one.contact->b] - shifts_[one.contact->a]));
  return result;
}

void ShiftedApart::shift(std::span<ContactConstraint* const> contacts, std::vector<Body>& bodies, double most) {
  const auto is_marked = [](const ContactConstraint* contact) { return contact->eased > 0; };
  if (std::none_of(contacts.begin(), contacts.end(), is_marked)) return;
  levels_.resize(bodies.size());
  shifts_.resize(bodies.size());
  openings_.clear();
  members_.clear();
  double widest = 0;
  for (const ContactConstraint* contact : contacts) {
    const double gap = narrowest_gap(*contact);
    const double width = is_marked(contact) ? std::clamp(-gap - left, 0.0, most) : -std::max(0.0, gap);
    widest = std::max(widest, width);
    openings_.push_back({contact, width});
    members_.insert(members_.end(), {contact->a, contact->b});
  }
  if (!(widest > 0)) return;
  std::sort(members_.begin(), members_.end());
  members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
  for (const std::uint32_t body : members_) shifts_[body] = Vec3::Zero();
  find_levels(bodies);
  for (int i = 0; i < most_sweeps && (i == 0 || missing() > hardly_lacking * widest); ++i) sweep(bodies);
  if (missing() > lacking * widest) {
    for (ContactConstraint* contact : contacts) contact->within = false;
    return;
  }
  double longest = most;
  for (const std::uint32_t body : members_) longest = std::max(longest, shifts_[body].norm());
  for (const std::uint32_t index : members_) {
    if (shifts_[index] == Vec3::Zero()) continue;
    Body& body = bodies[index];
    body.center += most / longest * shifts_[index];
    body.follow_center(body.motion.pose.rotation);
  }
}

}  // namespace tweenfall::islands
