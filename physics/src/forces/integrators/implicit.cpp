#include "forces/integrators/implicit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "forces/integrators/elimination.h"
#include "islands/small/extrapolation.h"

namespace tweenfall::forces {

namespace {

/// Greatest number of tied blocks that are solved together; if there are more, they are solved one by one, repeatedly.
constexpr std::size_t most_together = 32;
/// Most steps toward the end: if blocks are solved together, and if one by one.
constexpr int most_newton = 40, most_over_and_over = 300;
/// How often slopes are computed again.
constexpr int most_slopes = 12;
/// Rounding of a state, relative.
constexpr double rounding = 1e-15;
/// Number of steps without improvement after which none is expected.
constexpr int most_idle_together = 3, most_idle_apart = 24;
/// How often a step that makes things worse is halved.
constexpr int most_halvings = 12;

/// Blocks that are solved together.
struct Unit {
  std::vector<std::size_t> blocks;
  Elimination slopes;
};

/// Blocks that are tied: together one unit, or each a unit of its own.
struct Tied {
  std::vector<Unit> units;
  std::vector<std::size_t> blocks;
  small::Extrapolation extrapolation;
  std::vector<double> from, to;
  double before = std::numeric_limits<double>::infinity();  ///< the error before the last step
  double least = before;
  int idle = 0, halvings = 0;
  bool done = false;

  [[nodiscard]] bool together() const { return units.size() == 1; }
};

class Meeting {
 public:
  Meeting(const Flow& flow, double dt, double share, std::span<const double> known)
      : flow_(flow), dt_(dt), share_(share), known_(known), now_(known.size()), best_(now_), off_(now_), since_(now_) {
    std::map<std::uint32_t, std::size_t> places;
    for (std::size_t block = 0; block < flow.ties.size(); ++block) {
      const auto [found, added] = places.try_emplace(flow.ties[block], tied_.size());
      if (added) tied_.emplace_back();
      tied_[found->second].blocks.push_back(block);
    }
    for (Tied& tied : tied_) {
      const bool together = tied.blocks.size() <= most_together;
      tied.units.resize(together ? 1 : tied.blocks.size());
      for (std::size_t k = 0; k < tied.blocks.size(); ++k)
        tied.units[together ? 0 : k].blocks.push_back(tied.blocks[k]);
      tied.extrapolation.begin(tied.blocks.size() * flow.block);
    }
  }

  const std::vector<double>& meet() {
    bool left = !tied_.empty();
    for (int step = 0; left && step < most_over_and_over; ++step) {
      find_off(now_, off_);
      if (step < most_slopes) find_slopes();
      left = false;
      for (Tied& tied : tied_) {
        if (tied.done) continue;
        go_on(tied, step);
        left = left || !tied.done;
      }
    }
    return best_;
  }

 private:
  /// The difference between the mean rates that follow from the end and those that lead there.
  void find_off(std::span<const double> rates, std::vector<double>& off) {
    for (std::size_t i = 0; i < rates.size(); ++i) since_[i] = dt_ * rates[i];
    flow_.rates(dt_, since_, off);
    for (std::size_t i = 0; i < rates.size(); ++i) off[i] = known_[i] + share_ * off[i] - rates[i];
  }

  /// Derivatives by the numbers of each unit, by differences: exact if forces are linear. The blocks of a unit take
  /// turns, and so do units that act on each other.
  void find_slopes() {
    const std::size_t n = flow_.block;
    std::vector<double> there(now_.size()), aside(now_.size());
    bool left = true;
    for (std::uint32_t turn = 0; left; ++turn) {
      left = false;
      for (std::size_t column = 0; column < n; ++column) {
        there = now_;
        each_in_turn(turn, [&](Unit& unit, std::size_t place) {
          const std::size_t i = unit.blocks[place] * n + column;
          // Large enough to exceed rounding, and small enough that curves look straight.
          there[i] += 1e-7 * flow_.sizes[i] / std::abs(dt_) + 1e-4 * std::abs(now_[i]) + 1e-9;
          left = true;
        });
        if (!left) break;
        find_off(there, aside);
        each_in_turn(turn, [&](Unit& unit, std::size_t place) {
          const std::size_t width = unit.blocks.size() * n, i = unit.blocks[place] * n + column;
          unit.slopes.entries.resize(width * width);
          for (std::size_t row = 0; row < width; ++row) {
            const std::size_t k = unit.blocks[row / n] * n + row % n;
            unit.slopes.entries[row * width + place * n + column] = (off_[k] - aside[k]) / (there[i] - now_[i]);
          }
        });
      }
    }
    for (Tied& tied : tied_)
      if (!tied.done)
        for (Unit& unit : tied.units) unit.slopes.factor(unit.blocks.size() * n);
  }

  template <class See>
  void each_in_turn(std::uint32_t turn, const See& see) {
    for (Tied& tied : tied_) {
      if (tied.done) continue;
      if (tied.together() && turn < tied.blocks.size()) see(tied.units[0], turn);
      if (tied.together()) continue;
      for (Unit& unit : tied.units)
        if (flow_.turns[unit.blocks[0]] == turn) see(unit, std::size_t{0});
    }
  }

  void go_on(Tied& tied, int step) {
    const std::size_t n = flow_.block;
    tied.from.clear();
    tied.to.clear();
    double most = 0;
    for (const Unit& unit : tied.units) {
      std::vector<double> change;
      change.reserve(unit.blocks.size() * n);
      for (const std::size_t block : unit.blocks)
        for (std::size_t k = 0; k < n; ++k) change.push_back(off_[block * n + k]);
      unit.slopes.solve(change);
      for (std::size_t k = 0; k < change.size(); ++k) {
        const std::size_t at = unit.blocks[k / n] * n, i = at + k % n, first = k - k % flow_.kind;
        double size = 0;
        for (std::size_t beside = first; beside < first + flow_.kind; ++beside)
          size = std::max(size, std::abs(dt_ * (now_[at + beside % n] + change[beside])));
        size += flow_.sizes[i];
        // Infinite, or not a number: both count alike.
        const double share = change[k] == 0 ? 0 : std::abs(dt_ * change[k]) / size;
        most = share < 1e300 ? std::max(most, share) : 1e300;
        tied.from.push_back(now_[i]);
        tied.to.push_back(now_[i] + change[k]);
      }
    }
    const bool together = tied.together();
    const int bored = together ? most_idle_together : most_idle_apart;
    if (together && most > tied.before && tied.halvings < most_halvings) {
      // The step was too long.
      ++tied.halvings;
      put(tied, [&](std::size_t k) { return 0.5 * (now_at(tied, k) + best_at(tied, k)); });
      return;
    }
    tied.halvings = 0;
    tied.before = most;
    tied.idle = most < 0.5 * tied.least ? 0 : tied.idle + 1;
    if (most <= tied.least || step == 0) {
      tied.least = most;
      for (std::size_t k = 0; k < tied.from.size(); ++k) best_[index(tied, k)] = tied.from[k];
    }
    tied.done = !(most > rounding) || tied.idle > bored || (together && step >= most_newton);
    if (tied.done && tied.least > 0 && most <= tied.least) {
      for (std::size_t k = 0; k < tied.to.size(); ++k) best_[index(tied, k)] = tied.to[k];
      return;
    }
    if (together) {
      put(tied, [&](std::size_t k) { return tied.to[k]; });
      return;
    }
    const std::vector<double>& next = tied.extrapolation.next(tied.from, tied.to);
    put(tied, [&](std::size_t k) { return next[k]; });
  }

  [[nodiscard]] std::size_t index(const Tied& tied, std::size_t k) const {
    return tied.blocks[k / flow_.block] * flow_.block + k % flow_.block;
  }
  [[nodiscard]] double now_at(const Tied& tied, std::size_t k) const { return now_[index(tied, k)]; }
  [[nodiscard]] double best_at(const Tied& tied, std::size_t k) const { return best_[index(tied, k)]; }
  template <class Value>
  void put(const Tied& tied, const Value& value) {
    for (std::size_t k = 0; k < tied.blocks.size() * flow_.block; ++k) now_[index(tied, k)] = value(k);
  }

  const Flow& flow_;
  double dt_, share_;
  std::span<const double> known_;
  std::vector<double> now_, best_, off_, since_;
  std::vector<Tied> tied_;
};

}  // namespace

void meet_the_end(const Flow& flow, double dt, double share, std::span<const double> known, std::span<double> means) {
  Meeting meeting(flow, dt, share, known);
  const std::vector<double>& met = meeting.meet();
  std::copy(met.begin(), met.end(), means.begin());
}

}  // namespace tweenfall::forces
