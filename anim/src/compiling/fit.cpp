#include "compiling/fit.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace tweenfall::crowd {

namespace {

/// Knots nearer than this to the one before are left out, unless the curves turn out to need them: files round times.
constexpr double nearest_knots = 1e-6;  // s
/// A change that is over within this is a jump, even where no knot tells of it. Where a curve leaves a key straight up,
/// as those that are a part of a circle do, it has come a part of 1e-7 of its way by then, or of 2e-5 where it is a
/// cube root.
constexpr double shortest = 1e-14;  // s
/// Pieces so short may be straight where the slopes of the curve lead nowhere, for they grow without end.
constexpr double shortest_bent = 1e-6;  // s
/// What a fit may take: so many knots for each of the curves', and some more. It bounds the time of compiling.
constexpr std::size_t most_for_each = 16, most_more = 20000;
/// After so many jumps within each other's pieces, pieces are halved: that leads to an end soon.
constexpr int deepest = 100;
/// Where in a piece it is compared with the curves: at irregular places that no oscillation is likely to match.
constexpr double look_places[] = {0.5,          0.2113248654, 0.7886751346, 0.0694318442,
                                  0.9305681558, 0.3617261933, 0.6382738067};

/// The values of a channel at one time, and how fast they change: up to four of each lane.
struct Look {
  double value[4][lane_count] = {}, rate[4][lane_count] = {};
};

class Fitter {
 public:
  /// @param knots     all of the curves, in order
  /// @param formulas  whether there are formulas among the curves: they do not tell where they change
  Fitter(const ExactPose& exact, std::size_t group, Kind kind, const std::array<double, lane_count>& tolerance,
         std::span<const double> knots, bool formulas)
      : exact_(exact),
        first_(group * lane_count),
        kind_(kind),
        tolerance_(tolerance),
        knots_(knots),
        looks_first_(formulas ? std::size(look_places) : 3) {}

  [[nodiscard]] Look look(double time, Side side) const {
    Look look;
    for (std::size_t lane = 0; lane < lane_count; ++lane) look_at(lane, time, side, look);
    return look;
  }

  /// Of the two signs of a rotation, takes the one nearer to another.
  void align(Look& look, const Look& to) const {
    if (kind_ != Kind::rotation) return;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      double dot = 0;
      for (std::size_t c = 0; c < 4; ++c) dot += look.value[c][lane] * to.value[c][lane];
      if (dot >= 0) continue;
      for (std::size_t c = 0; c < 4; ++c) {
        look.value[c][lane] = -look.value[c][lane];
        look.rate[c][lane] = -look.rate[c][lane];
      }
    }
  }

  /// @param most   greatest number of knots; a fit that would need more is given up and returns none
  /// @param brief  whether it is given up, too, where it would need far more if it went on as it began
  [[nodiscard]] Fitted fit(std::span<const double> knots, bool cubic, std::size_t most, bool brief = false) {
    fit_ = {.kind = kind_, .cubic = cubic};
    most_ = most;
    given_up_ = false;
    Look from = look(knots.front(), Side::out);
    before_ = from;
    for (std::size_t i = 0; i + 1 < knots.size() && !given_up_; ++i) {
      if (i > 0) from = look(knots[i], Side::out);
      align(from, before_);
      Look to = look(knots[i + 1], Side::in);
      align(to, from);
      piece(knots[i], from, knots[i + 1], to);
      if (brief) given_up_ = given_up_ || is_hopeless(static_cast<double>(i + 1) / static_cast<double>(knots.size()));
    }
    // Held keys jump to their last value at the very end.
    Look last = look(knots.back(), Side::out);
    align(last, before_);
    if (!given_up_ && !joined(last, 0)) add(knots.back(), last);
    if (given_up_) {
      reached_ = fit_.knots.empty() ? 0 : fit_.knots.back();
      if (fit_.knots.size() > 1) find_thickest();
      fit_.knots.clear();
    }
    return std::move(fit_);
  }

  /// How far the last fit came that was given up, s.
  [[nodiscard]] double reached() const { return reached_; }
  /// Where half of the knots of the last fit that was given up were, and the lane that changed the most there.
  struct Thickest {
    double from = 0, to = 0;
    std::size_t lane = 0;
  };
  [[nodiscard]] const Thickest& thickest() const { return thickest_; }

 private:
  void look_at(std::size_t lane, double time, Side side, Look& look) const {
    const bool is_there = first_ + lane < exact_.nodes().size();
    const Motion motion = is_there ? exact_.joint(first_ + lane, kind_, time, side) : Motion{};
    if (kind_ == Kind::rotation) {
      const Quat& q = motion.pose.rotation;
      const Vec3& w = motion.twist.angular;
      const Vec3 vector = 0.5 * (q.w() * w + w.cross(q.vec()));
      const double scalar = -0.5 * w.dot(q.vec());
      for (int c = 0; c < 4; ++c) {
        look.value[c][lane] = q.coeffs()[c];
        look.rate[c][lane] = c < 3 ? vector[c] : scalar;
      }
      return;
    }
    for (int c = 0; c < 3; ++c) {
      look.value[c][lane] = kind_ == Kind::scale ? motion.pose.scale[c] : motion.pose.position[c];
      look.rate[c][lane] = kind_ == Kind::scale ? motion.scale_rate[c] : motion.twist.linear[c];
    }
  }

  void piece(double from, const Look& left, double to, const Look& right) {
    if (given_up_) return;
    if (near(from, left, to, right)) return keep(from, left, to, right);
    if (const std::optional<double> jump = depth_ < deepest ? jump_in(from, left, to, right) : std::nullopt)
      return part_at(*jump, from, left, to, right);
    const bool over = to - from <= shortest + 1e-15 * std::abs(to);
    if (over || (fit_.cubic && to - from <= shortest_bent)) {
      Look first = left, last = right;
      straighten(first, last, to - from);
      if (over || near(from, first, to, last)) return keep(from, first, to, last);
    }
    const double middle = split(from, to);
    Look arriving = look(middle, Side::in), leaving = look(middle, Side::out);
    align(arriving, left);
    piece(from, left, middle, arriving);
    align(leaving, arriving);
    Look end = right;
    align(end, leaving);
    piece(middle, leaving, to, end);
  }

  /// Where a change that no rate explains takes place at once, or a good part of it: the first instant after it. Of
  /// many jumps in one piece none is told: halves of it come first.
  [[nodiscard]] std::optional<double> jump_in(double from, const Look& left, double to, const Look& right) const {
    if (!is_sudden(left, right, to - from)) return std::nullopt;
    Look before = left, after = right;
    const double enough = std::max(1.0, 0.25 * change(left, right));
    double last = from, first = to;
    for (;;) {
      const double middle = last + 0.5 * (first - last);
      if (!(middle > last && middle < first)) break;
      Look there = look(middle, Side::out);
      align(there, before);
      if (change(before, there) >= change(there, after)) {
        first = middle;
        after = there;
      } else {
        last = middle;
        before = there;
      }
    }
    return change(before, after) > enough ? std::optional(first) : std::nullopt;
  }

  /// What arrives at a jump is what was there just before it.
  void part_at(double jump, double from, const Look& left, double to, const Look& right) {
    Look arriving = look(std::nextafter(jump, from), Side::out), leaving = look(jump, Side::out);
    align(arriving, left);
    align(leaving, left);
    if (jump == to) return piece(from, left, to, arriving);
    ++depth_;
    piece(from, left, jump, arriving);
    Look end = right;
    align(end, leaving);
    piece(jump, leaving, to, end);
    --depth_;
  }

  /// Whether more has changed than four times what the rates at both ends would have done, and than is tolerated.
  [[nodiscard]] bool is_sudden(const Look& left, const Look& right, double length) const {
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      for (std::size_t c = 0; c < components(kind_); ++c) {
        const double rate = std::max(std::abs(left.rate[c][lane]), std::abs(right.rate[c][lane]));
        if (change(left, right, lane, c) > 4 * rate * length + tolerance_[lane]) return true;
      }
    return false;
  }

  /// The largest change, in tolerances.
  [[nodiscard]] double change(const Look& left, const Look& right) const {
    double most = 0;
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      for (std::size_t c = 0; c < components(kind_); ++c)
        most = std::max(most, change(left, right, lane, c) / tolerance_[lane]);
    return most;
  }

  /// Of one number. After many turns within a piece, signs of rotations tell nothing: the nearer one counts.
  [[nodiscard]] double change(const Look& left, const Look& right, std::size_t lane, std::size_t c) const {
    const double before = left.value[c][lane], after = right.value[c][lane];
    if (kind_ != Kind::rotation) return std::abs(after - before);
    double dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += left.value[k][lane] * right.value[k][lane];
    return std::abs(dot < 0 ? after + before : after - before);
  }

  void keep(double from, const Look& left, double to, const Look& right) {
    if (fit_.knots.empty() || !joined(left, std::max(to - from, from - last_begin_))) add(from, left);
    add(to, right);
    last_begin_ = from;
    before_ = right;
  }

  void find_thickest() {
    const std::size_t half = fit_.knots.size() / 2;
    std::size_t first = 0;
    for (std::size_t i = 0; i + half < fit_.knots.size(); ++i)
      if (fit_.knots[i + half] - fit_.knots[i] < fit_.knots[first + half] - fit_.knots[first]) first = i;
    thickest_ = {.from = fit_.knots[first], .to = fit_.knots[first + half]};
    double most = 0;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      double sum = 0;
      for (std::size_t i = first; i < first + half; ++i)
        for (std::size_t c = 0; c < components(kind_); ++c) {
          const std::size_t place = (i * fit_.slots() + c) * lane_count + lane;
          sum += std::abs(fit_.values[place + fit_.slots() * lane_count] - fit_.values[place]) / tolerance_[lane];
        }
      if (sum > most) {
        most = sum;
        thickest_.lane = lane;
      }
    }
  }

  /// Makes a line of the piece between two looks.
  void straighten(Look& left, Look& right, double length) const {
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      for (std::size_t c = 0; c < components(kind_); ++c) {
        const double way = right.value[c][lane] - left.value[c][lane];
        left.rate[c][lane] = right.rate[c][lane] = way == 0 ? 0 : way / length;
      }
  }

  /// A knot of a curve that was taken for one with its neighbor, or else the middle.
  [[nodiscard]] double split(double from, double to) const {
    const auto first = std::ranges::upper_bound(knots_, from);
    const auto last = std::ranges::lower_bound(knots_, to);
    return first < last ? first[(last - first) / 2] : from + 0.5 * (to - from);
  }

  /// Whether the values arriving at and leaving the last knot agree.
  [[nodiscard]] bool joined(const Look& left, double length) const {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const double room = 0.1 * tolerance_[lane];
      for (std::size_t c = 0; c < components(kind_); ++c) {
        if (!(std::abs(left.value[c][lane] - before_.value[c][lane]) <= room)) return false;
        if (fit_.cubic && !(std::abs(left.rate[c][lane] - before_.rate[c][lane]) * length * 0.15 <= room)) return false;
      }
    }
    return true;
  }

  /// Whether the knots so far are a good part of all that a fit may take, for a small part of the curves' knots.
  [[nodiscard]] bool is_hopeless(double part) const {
    const double used = static_cast<double>(fit_.knots.size()) / static_cast<double>(most_);
    return used > 0.1 && part < 0.25 * used;
  }

  void add(double time, const Look& look) {
    if (fit_.knots.size() >= most_) {
      given_up_ = true;
      return;
    }
    fit_.knots.push_back(time);
    for (std::size_t c = 0; c < components(kind_); ++c)
      fit_.values.insert(fit_.values.end(), std::begin(look.value[c]), std::end(look.value[c]));
    for (std::size_t c = 0; fit_.cubic && c < components(kind_); ++c)
      fit_.values.insert(fit_.values.end(), std::begin(look.rate[c]), std::end(look.rate[c]));
  }

  /// Whether the piece between two looks is near enough to the curves: between keys at few places, if it is much nearer
  /// there than it must be.
  [[nodiscard]] bool near(double from, const Look& left, double to, const Look& right) const {
    constexpr double much_nearer = 0.5;  // tolerances
    const double length = to - from;
    Look there;
    double farthest = 0;  // tolerances
    for (std::size_t i = 0; i < std::size(look_places); ++i) {
      if (i == looks_first_ && farthest <= much_nearer) break;
      const double u = look_places[i];
      const double time = from + u * length;
      const double h01 = fit_.cubic ? u * u * (3 - 2 * u) : u, h00 = 1 - h01;
      const double h10 = fit_.cubic ? u * (1 - u) * (1 - u) * length : 0,
                   h11 = fit_.cubic ? -u * u * (1 - u) * length : 0;
      // The lane that was off before is the likeliest to be so again.
      const std::size_t first = suspect_;
      for (std::size_t k = 0; k < lane_count; ++k) {
        const std::size_t lane = (first + k) % lane_count;
        look_at(lane, time, Side::out, there);
        double mixed[4] = {}, squared = 0, dot = 0;
        for (std::size_t c = 0; c < components(kind_); ++c) {
          mixed[c] = h00 * left.value[c][lane] + h01 * right.value[c][lane] + h10 * left.rate[c][lane] +
                     h11 * right.rate[c][lane];
          squared += mixed[c] * mixed[c];
          dot += mixed[c] * there.value[c][lane];
        }
        double factor = 1;
        if (kind_ == Kind::rotation) factor = (dot < 0 ? -1 : 1) / std::sqrt(squared);
        for (std::size_t c = 0; c < components(kind_); ++c) {
          const double off = std::abs(factor * mixed[c] - there.value[c][lane]) / tolerance_[lane];
          if (!(off <= 1)) {
            suspect_ = lane;
            return false;
          }
          farthest = std::max(farthest, off);
        }
      }
    }
    return true;
  }

  const ExactPose& exact_;
  std::size_t first_;
  Kind kind_;
  const std::array<double, lane_count>& tolerance_;
  std::span<const double> knots_;
  std::size_t looks_first_;  // at so many places
  Fitted fit_;
  std::size_t most_ = 0;
  bool given_up_ = false;
  int depth_ = 0;
  mutable std::size_t suspect_ = 0;  // the lane that was last found too far off
  Look before_;
  double last_begin_ = 0, reached_ = 0;
  Thickest thickest_;
};

std::string too_fast(const ExactPose& exact, const CurveKnots& knots, std::size_t group, Kind kind,
                     const Fitter::Thickest& there, std::size_t most) {
  const std::size_t node = std::min(group * lane_count + there.lane, exact.nodes().size() - 1);
  const auto brief = [](double time) { return number_text(std::round(time * 1e6) / 1e6); };
  const std::string from = brief(there.from), to = brief(there.to);
  const std::string property = kind == Kind::rotation ? "rotation" : kind == Kind::scale ? "scale" : "position";
  std::vector<double> keys = knots.of[static_cast<std::size_t>(kind)][node];
  std::erase_if(keys, [&, margin = there.to - there.from](double key) {
    return key < there.from - margin || key > there.to + margin;
  });
  std::ranges::sort(keys);
  const bool close =
      std::ranges::adjacent_find(keys, [&](double a, double b) { return b - a < 0.1 * knots.look; }) != keys.end();
  return "clip \"" + exact.clip().name + "\" cannot be compiled for a crowd: " +
         (from == to ? "near " + from + " s" : "from " + from + " s to " + to + " s") + " the " + property + " of \"" +
         exact.nodes()[node].name + "\" changes so fast that " + std::to_string(most) + " knots are too few for it" +
         (close ? "; smooth slopes are as steep as keys are close" : "");
}

}  // namespace

Fitted fitted(const ExactPose& exact, const CurveKnots& knots, std::size_t group, Kind kind,
              const std::array<double, lane_count>& tolerance) {
  std::vector<double> all;
  bool formulas = false;
  for (std::size_t node = group * lane_count; node < std::min(exact.nodes().size(), (group + 1) * lane_count); ++node) {
    const std::vector<double>& of_node = knots.of[static_cast<std::size_t>(kind)][node];
    all.insert(all.end(), of_node.begin(), of_node.end());
    formulas = formulas || knots.formula[static_cast<std::size_t>(kind)][node] != 0;
  }
  std::ranges::sort(all);
  std::vector<double> times{0.0};
  for (const double time : all)
    if (time > times.back() + nearest_knots) times.push_back(time);
  if (exact.duration() > 0) times.push_back(exact.duration());
  Fitter fitter(exact, group, kind, tolerance, all, formulas);
  if (times.size() == 1) {
    Fitted still{.kind = kind, .knots = times};
    const Look look = fitter.look(0, Side::out);
    for (std::size_t c = 0; c < components(kind); ++c)
      still.values.insert(still.values.end(), std::begin(look.value[c]), std::end(look.value[c]));
    return still;
  }
  // A knot of a cubic takes twice the room; but where its neighbors are far apart it is the lines that take more.
  // Whether few lines do is known soon. Else the cubics come first, and lines are tried as far as they would take less.
  const std::size_t most = most_more + most_for_each * times.size();
  const std::size_t soon = 4 * times.size();
  Fitted lines = fitter.fit(times, false, soon, true);
  if (!lines.knots.empty()) {
    Fitted cubics = fitter.fit(times, true, lines.knots.size() / 2);
    return cubics.knots.empty() ? lines : cubics;
  }
  const double part = fitter.reached() / times.back();
  Fitted cubics = fitter.fit(times, true, most);
  const std::size_t most_lines = cubics.knots.empty() ? most : std::min(most, 2 * cubics.knots.size() - 1);
  // Where lines would take far more if they went on as they began, they are not tried again.
  if (static_cast<double>(soon) < 4 * part * static_cast<double>(most_lines))
    lines = fitter.fit(times, false, most_lines);
  if (!lines.knots.empty()) return lines;
  if (!cubics.knots.empty()) return cubics;
  throw std::invalid_argument(too_fast(exact, knots, group, kind, fitter.thickest(), most));
}

}  // namespace tweenfall::crowd
