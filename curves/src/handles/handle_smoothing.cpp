#include <algorithm>
#include <cmath>
#include <limits>

#include "handles/handle_places.h"
#include "math/tridiagonal.h"

namespace tweenfall::handling {
namespace {

void lock(math::Tridiagonal& rows, std::size_t i, double value) {
  rows.lower[i] = rows.upper[i] = 0;
  rows.diagonal[i] = 1;
  rows.right[i] = value;
}

void copy_row(math::Tridiagonal& rows, std::size_t i, const math::Tridiagonal& from) {
  rows.lower[i] = from.lower[i];
  rows.diagonal[i] = from.diagonal[i];
  rows.upper[i] = from.upper[i];
  rows.right[i] = from.right[i];
}

struct HandleLimits {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  // The slope may neither point away from the neighbor nor reach beyond its value.
  void keep_within(double secant) {
    const double most = 3 * secant;
    low = std::max(low, std::min(most, 0.0));
    high = std::min(high, std::max(most, 0.0));
  }
};

// Slopes that solve the rows where the limits allow it. A slope beyond a limit is locked to it; one that would then
// move back inside is released again, at most twice. Source: Blender, tridiagonal_solve_with_limits.
std::vector<double> solved_within(const math::Tridiagonal& free_rows, const std::vector<HandleLimits>& limits) {
  const std::size_t n = free_rows.rows();
  math::Tridiagonal rows = free_rows;
  std::vector<bool> locked(n);
  std::vector<int> releases(n);
  for (;;) {
    math::Tridiagonal solution = rows;
    solution.solve_cyclic();
    std::vector<double>& x = solution.right;
    std::vector<std::size_t> beyond;
    for (std::size_t i = 0; i < n; ++i)
      if (x[i] < limits[i].low || x[i] > limits[i].high) beyond.push_back(i);
    const auto target = [&](std::size_t i) { return x[i] > limits[i].high ? limits[i].high : limits[i].low; };
    // First those of the right sign that are too large: this may correct the others.
    const bool some_too_far = std::any_of(beyond.begin(), beyond.end(), [&](std::size_t i) { return target(i) != 0; });
    for (const std::size_t i : beyond)
      if (!some_too_far || target(i) != 0) {
        locked[i] = true;
        lock(rows, i, target(i));
      }
    if (!beyond.empty()) continue;
    bool released = false;
    for (std::size_t i = 0; i < n; ++i) {
      if (!locked[i] || releases[i] >= 2) continue;
      const double before = x[(i + n - 1) % n], after = x[(i + 1) % n];
      const double pull =
          free_rows.right[i] - free_rows.lower[i] * before - free_rows.diagonal[i] * x[i] - free_rows.upper[i] * after;
      if ((pull > 0 && x[i] < limits[i].high) || (pull < 0 && x[i] > limits[i].low)) {
        copy_row(rows, i, free_rows);
        locked[i] = false;
        ++releases[i];
        released = true;
      }
    }
    if (!released) return x;
  }
}

bool is_free(const PlacedKey& key) {
  return is_smooth(key.in_kind) && is_smooth(key.out_kind) && !key.locked;
}

bool is_clamped(const PlacedKey& key) {
  return key.in_kind == TangentKind::auto_clamped || key.out_kind == TangentKind::auto_clamped;
}

// A run of keys, given by their indices; around a loop it may lead over the seam.
class Run {
 public:
  Run(std::vector<PlacedKey>& keys, std::size_t first, std::size_t count, bool cycle)
      : keys_(keys), first_(first), count_(count), whole_cycle_(cycle && count == keys.size() && first == 0) {}

  void smooth() {
    if (count_ < 2) return;
    const PlacedKey &first = key(0), &last = key(count_ - 1);
    const bool starts_open = whole_cycle_ || opens(first, first.out_kind, index(0) == 0);
    const bool ends_open = whole_cycle_ || opens(last, last.in_kind, index(count_ - 1) + 1 == keys_.size());
    if (count_ == 2 && !whole_cycle_ && starts_open == ends_open) return;
    const std::size_t unknowns = whole_cycle_ ? count_ - 1 : count_;
    math::Tridiagonal rows(unknowns);
    for (std::size_t k = 0; k < unknowns; ++k) {
      const bool at_start = k == 0 && !whole_cycle_, at_end = k + 1 == count_;
      if (at_start || at_end) {
        rows.lower[k] = rows.upper[k] = 1;
        rows.diagonal[k] = 2;
        rows.right[k] = 3 * secant(at_start ? 0 : count_ - 2);
        continue;
      }
      const std::size_t a = k > 0 ? k - 1 : count_ - 2;
      const double total = duration(a) + duration(k);
      const double h0 = duration(a) / total, h1 = duration(k) / total;
      rows.lower[k] = h1;
      rows.diagonal[k] = 2;
      rows.upper[k] = h0;
      rows.right[k] = 3 * (h1 * secant(a) + h0 * secant(k));
    }
    if (!whole_cycle_) {
      rows.lower[0] = rows.upper[unknowns - 1] = 0;
      if (!starts_open) lock_end(rows, 0, 1, key(0).out, duration(0), ends_open);
      if (!ends_open) lock_end(rows, unknowns - 1, unknowns - 2, key(count_ - 1).in, duration(count_ - 2), starts_open);
    }
    const std::vector<double> slopes = solved_within(rows, limits(unknowns));
    for (std::size_t k = 0; k < count_; ++k) {
      const double slope = slopes[k % unknowns];
      const bool open = k == 0 ? starts_open : k + 1 == count_ ? ends_open : true;
      if (!open) continue;
      const bool end = index(k) == 0 || index(k) + 1 == keys_.size();
      if (k > 0) set(key(k), key(k).in, key(k).in_kind, slope, end);
      PlacedKey& left = index(k) + 1 < keys_.size() ? key(k) : keys_.front();
      if (k + 1 < count_) set(left, left.out, left.out_kind, slope, end);
    }
  }

 private:
  [[nodiscard]] std::size_t index(std::size_t k) const {
    // The first and the last key of a loop are the same.
    const std::size_t i = first_ + k;
    return i < keys_.size() ? i : i + 1 - keys_.size();
  }
  [[nodiscard]] PlacedKey& key(std::size_t k) const { return keys_[index(k)]; }
  [[nodiscard]] double duration(std::size_t span) const {
    const std::size_t i = index(span) + 1 < keys_.size() ? index(span) : 0;
    return keys_[i + 1].time - keys_[i].time;
  }
  [[nodiscard]] double secant(std::size_t span) const {
    const std::size_t i = index(span) + 1 < keys_.size() ? index(span) : 0;
    return (keys_[i + 1].value - keys_[i].value) / (keys_[i + 1].time - keys_[i].time);
  }

  static bool opens(const PlacedKey& key, TangentKind kind, bool end_of_curve) {
    return kind == TangentKind::vector || (end_of_curve && is_smooth(kind) && !key.locked);
  }

  // An end that keeps its handle: its slope is known. If its length is not a third, that changes how strongly the
  // acceleration at the next key depends on that key's own slope.
  void lock_end(math::Tridiagonal& rows, std::size_t end, std::size_t next, HandleReach reach, double span,
                bool other_open) const {
    const double fit = span / (reach.time + span / 3);
    if (fit < 1) reach = {fit * reach.time, fit * reach.value};
    lock(rows, end, 3 * reach.value / span);
    if (count_ == 2 && !other_open) return;
    // In the units of the row, in which its two spans have the weights h1 and h0.
    const double share = 1 - 3 * reach.time / span;
    const double weight = end < next ? rows.lower[next] : rows.upper[next];
    rows.diagonal[next] += weight * share;
  }

  [[nodiscard]] std::vector<HandleLimits> limits(std::size_t unknowns) const {
    std::vector<HandleLimits> result(unknowns);
    for (std::size_t k = 0; k < count_; ++k) {
      if (!is_clamped(key(k))) continue;
      if (k > 0) result[k % unknowns].keep_within(secant(k - 1));
      if (k + 1 < count_) result[k % unknowns].keep_within(secant(k));
    }
    return result;
  }

  static void set(PlacedKey& key, HandleReach& reach, TangentKind kind, double slope, bool end_of_curve) {
    if (!is_smooth(kind) && kind != TangentKind::vector) return;
    reach.value = slope * reach.time;
    align_handles(key);
    HandleReach& other = &reach == &key.in ? key.out : key.in;
    const TangentKind other_kind = &reach == &key.in ? key.out_kind : key.in_kind;
    if (end_of_curve && (is_smooth(other_kind) || other_kind == TangentKind::vector)) other = reach;
  }

  std::vector<PlacedKey>& keys_;
  std::size_t first_, count_;
  bool whole_cycle_;
};

}  // namespace

// Runs of keys with free slopes lie between keys without, or the ends.
// Source: Blender, BKE_nurb_handle_smooth_fcurve.
void smooth_handles(std::vector<PlacedKey>& keys, Ends ends) {
  const std::size_t n = keys.size();
  const bool cycle = ends == Ends::wrap && is_free(keys.front()) && is_free(keys.back());
  std::size_t first = 0;
  if (cycle)
    for (std::size_t i = 1; i + 1 < n && first == 0; ++i)
      if (!is_free(keys[i])) first = i;
  if (cycle && first == 0) return Run(keys, 0, n, true).smooth();
  std::size_t start = first, count = 1;
  for (std::size_t k = 1; k < n; ++k) {
    // Around the seam the last key is the first.
    std::size_t i = first + k;
    if (i + 1 >= n && cycle) i = i + 1 - n;
    ++count;
    if (is_free(keys[i]) && k + 1 < n) continue;
    Run(keys, start, count, cycle).smooth();
    start = i;
    count = 1;
  }
}

}  // namespace tweenfall::handling
