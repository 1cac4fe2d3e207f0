#include "state/ignored_pairs.h"

#include <algorithm>
#include <tuple>

namespace tweenfall::state {

namespace {

bool comes_before(const IgnoredPairs::Entry& entry, const std::pair<std::uint32_t, std::uint32_t>& pair) {
  return std::tie(entry.a, entry.b) < std::tie(pair.first, pair.second);
}

}  // namespace

std::vector<IgnoredPairs::Entry>::iterator IgnoredPairs::place_of(std::uint32_t& a, std::uint32_t& b) {
  if (b < a) std::swap(a, b);
  return std::lower_bound(entries_.begin(), entries_.end(), std::pair(a, b), comes_before);
}

bool IgnoredPairs::contains(std::uint32_t a, std::uint32_t b) const {
  if (entries_.empty()) return false;
  const std::pair wanted(std::min(a, b), std::max(a, b));
  const auto place = std::lower_bound(entries_.begin(), entries_.end(), wanted, comes_before);
  return place != entries_.end() && place->a == wanted.first && place->b == wanted.second;
}

bool IgnoredPairs::ask(std::uint32_t a, std::uint32_t b, bool ignore) {
  const auto place = place_of(a, b);
  if (!at(place, a, b)) {
    if (ignore) entries_.insert(place, {a, b, 0, true});
    return ignore;
  }
  if (place->asked == ignore) return false;
  place->asked = ignore;
  if (place->holders > 0) return false;
  entries_.erase(place);
  return true;
}

bool IgnoredPairs::hold(std::uint32_t a, std::uint32_t b) {
  const auto place = place_of(a, b);
  if (!at(place, a, b)) {
    entries_.insert(place, {a, b, 1, false});
    return true;
  }
  ++place->holders;
  return false;
}

bool IgnoredPairs::let_go(std::uint32_t a, std::uint32_t b) {
  const auto place = place_of(a, b);
  if (!at(place, a, b) || place->holders == 0) return false;
  --place->holders;
  if (place->holders > 0 || place->asked) return false;
  entries_.erase(place);
  return true;
}

void IgnoredPairs::remove(std::uint32_t body) {
  std::erase_if(entries_, [body](const Entry& entry) { return entry.a == body || entry.b == body; });
}

}  // namespace tweenfall::state
