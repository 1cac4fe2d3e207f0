#include <Eigen/LU>

#include "math/cross_matrix.h"
#include "rotation/moving_rotation.h"
#include "turns/natural.h"
#include "turns/turn_rule.h"

namespace tweenfall::turns {
namespace {

// One stretch with what stays constant while the rates are solved for; `inverse` is that of the Jacobian J at its end.
struct Part {
  double h;
  Vec3 way, total, spin_rate;
  Mat3 jacobian, inverse, spin_cross;

  explicit Part(const Stretch& s)
      : h(s.duration),
        way(s.way),
        total(s.way + s.spin),
        spin_rate(s.spin / s.duration),
        jacobian(right_jacobian(s.way)),
        inverse(right_jacobian_inverse(s.way)),
        spin_cross(math::cross_matrix(spin_rate)) {}

  // Rate of the rotation vector where the body arrives with the angular velocity v.
  [[nodiscard]] Vec3 vector_rate(const Vec3& v) const noexcept { return inverse * Vec3(v - spin_rate); }

  // The part of the arriving acceleration beyond J r'', and its derivative with respect to v.
  [[nodiscard]] Vec3 bend(const Vec3& v) const noexcept { return rotations::bent_acceleration(way, vector_rate(v)); }
  [[nodiscard]] Mat3 bend_slope(const Vec3& v) const noexcept {
    // A quadratic form: its derivative along d is (B(w + d) - B(w - d)) / 2, exactly.
    const Vec3 w = vector_rate(v);
    Mat3 result;
    for (int c = 0; c < 3; ++c) {
      const Vec3 d = inverse.col(c);
      result.col(c) = 0.5 * (rotations::bent_acceleration(way, w + d) - rotations::bent_acceleration(way, w - d));
    }
    return result;
  }
};

struct Row {
  Mat3 lower, diagonal, upper;
  Vec3 right;
};

// Angular velocities at the keys of a run, in the axes of the keys, that make the angular acceleration continuous.
class Rates {
 public:
  Rates(const std::vector<Stretch>& stretches, std::size_t first, std::size_t last, const NaturalEnds& ends)
      : ends_(ends) {
    for (std::size_t i = first; i < last; ++i) parts_.emplace_back(stretches[i]);
    const std::size_t keys = parts_.size() + (ends_.around ? 0 : 1);
    // Start from the mean rates of the neighbors.
    for (std::size_t k = 0; k < keys; ++k) {
      const Part *a = before(k), *b = after(k);
      Vec3 sum(0, 0, 0);
      double weight = 0;
      for (const Part* part : {a, b})
        if (part) {
          sum += part->total / (part->h * part->h);
          weight += 1 / part->h;
        }
      rates_.push_back(sum / weight);
    }
    if (ends_.start) rates_.front() = *ends_.start;
    if (ends_.end) rates_.back() = *ends_.end;
  }

  // Newton's method; a step that makes things worse is halved.
  std::vector<Vec3> solved() {
    std::vector<Row> rows = rows_at(rates_);
    double miss = size_of(rows);
    for (int round = 0; round < 50 && miss > 0; ++round) {
      const std::vector<Vec3> step = solve(rows);
      double step_size = 0, rate_size = 0;
      for (std::size_t k = 0; k < step.size(); ++k) {
        step_size += step[k].squaredNorm();
        rate_size += rates_[k].squaredNorm();
      }
      if (!(step_size > 1e-31 * rate_size)) break;
      double share = 1;
      bool better = false;
      for (int halving = 0; halving < 8 && !better; ++halving, share /= 2) {
        std::vector<Vec3> next = rates_;
        for (std::size_t k = 0; k < next.size(); ++k) next[k] += share * step[k];
        std::vector<Row> next_rows = rows_at(next);
        const double next_miss = size_of(next_rows);
        if (!(next_miss < miss)) continue;
        better = true;
        rates_ = std::move(next);
        rows = std::move(next_rows);
        miss = next_miss;
      }
      if (!better) break;
    }
    return rates_;
  }

 private:
  [[nodiscard]] const Part* before(std::size_t key) const noexcept {
    if (key > 0) return &parts_[key - 1];
    return ends_.around ? &parts_.back() : nullptr;
  }
  [[nodiscard]] const Part* after(std::size_t key) const noexcept {
    return key < parts_.size() ? &parts_[key] : nullptr;
  }

  // Jump of the angular acceleration at each key (at an end: all of it, or the difference between the rate and the
  // given one) with its derivatives; `right` is what a step must remove.
  [[nodiscard]] std::vector<Row> rows_at(const std::vector<Vec3>& rates) const {
    std::vector<Row> rows(rates.size());
    const std::size_t n = rates.size();
    for (std::size_t k = 0; k < n; ++k) {
      Row& row = rows[k];
      row.lower.setZero();
      row.upper.setZero();
      const std::optional<Vec3>& asked = k == 0 ? ends_.start : ends_.end;
      if (!ends_.around && (k == 0 || k + 1 == n) && asked) {
        row.diagonal.setIdentity();
        row.right = *asked - rates[k];
        continue;
      }
      row.diagonal.setZero();
      row.right.setZero();
      if (const Part* p = before(k)) {
        const Vec3& from = rates[k > 0 ? k - 1 : n - 1];
        row.lower = 2 / p->h * p->jacobian;
        row.diagonal += 4 / p->h * Mat3::Identity() + p->bend_slope(rates[k]) + p->spin_cross;
        row.right += 6 / (p->h * p->h) * p->total - row.lower * from - 4 / p->h * rates[k] - p->bend(rates[k]) -
                     p->spin_cross * rates[k];
      }
      if (const Part* p = after(k)) {
        const Vec3& to = rates[k + 1 < n ? k + 1 : 0];
        row.upper = 2 / p->h * p->inverse;
        row.diagonal += 4 / p->h * Mat3::Identity() - p->spin_cross;
        row.right += 6 / (p->h * p->h) * p->total - row.upper * to - 4 / p->h * rates[k] + p->spin_cross * rates[k];
      }
    }
    return rows;
  }

  [[nodiscard]] static double size_of(const std::vector<Row>& rows) noexcept {
    double sum = 0;
    for (const Row& row : rows) sum += row.right.squaredNorm();
    return sum;
  }

  // Block elimination. Around a loop the first unknown becomes three more right-hand sides and is found last.
  [[nodiscard]] std::vector<Vec3> solve(const std::vector<Row>& rows) const {
    using Sides = Eigen::Matrix<double, 3, 4, Eigen::DontAlign>;
    const std::size_t n = rows.size(), first = ends_.around ? 1 : 0;
    std::vector<Vec3> result(n, Vec3(0, 0, 0));
    if (n == 1) {
      result[0] = Mat3(rows[0].lower + rows[0].diagonal + rows[0].upper).inverse() * rows[0].right;
      return result;
    }
    std::vector<Sides> sides(n);
    std::vector<Mat3> uppers(n);
    for (std::size_t k = first; k < n; ++k) {
      Mat3 diagonal = rows[k].diagonal;
      sides[k].setZero();
      sides[k].col(3) = rows[k].right;
      if (ends_.around && k == 1) sides[k].leftCols<3>() -= rows[k].lower;
      if (ends_.around && k + 1 == n) sides[k].leftCols<3>() -= rows[k].upper;
      if (k > first) {
        diagonal -= rows[k].lower * uppers[k - 1];
        sides[k] -= rows[k].lower * sides[k - 1];
      }
      const Mat3 inverse = diagonal.inverse();
      uppers[k] = k + 1 < n ? Mat3(inverse * rows[k].upper) : Mat3(Mat3::Zero());
      sides[k] = Sides(inverse * sides[k]);
    }
    for (std::size_t k = n - 1; k-- > first;) sides[k] -= uppers[k] * sides[k + 1];
    if (ends_.around) {
      const Mat3 all =
          rows[0].diagonal + rows[0].lower * sides[n - 1].leftCols<3>() + rows[0].upper * sides[1].leftCols<3>();
      result[0] =
          all.inverse() * Vec3(rows[0].right - rows[0].lower * sides[n - 1].col(3) - rows[0].upper * sides[1].col(3));
    }
    for (std::size_t k = first; k < n; ++k) {
      result[k] = sides[k].col(3);
      if (ends_.around) result[k] += sides[k].leftCols<3>() * result[0];
    }
    return result;
  }

  NaturalEnds ends_;
  std::vector<Part> parts_;
  std::vector<Vec3> rates_;
};

}  // namespace

// Source: Mayorov, "Smooth attitude interpolation", 2018, with Newton's method in place of its iteration.
void append_natural(const std::vector<Stretch>& stretches, std::size_t first, std::size_t last, const NaturalEnds& ends,
                    std::vector<RotationSpan>& spans) {
  const std::vector<Vec3> rates = Rates(stretches, first, last, ends).solved();
  for (std::size_t i = first; i < last; ++i) {
    const Stretch& s = stretches[i];
    const std::size_t k = i - first;
    const Vec3& arriving = rates[k + 1 < rates.size() ? k + 1 : 0];
    spans.push_back(cubic_turn(s, s.duration * rates[k] - s.spin, s.duration * arriving - s.spin));
  }
}

void natural(const TurnProblem& p) {
  NaturalEnds ends;
  ends.around = p.ends == Ends::wrap && p.first == 0 && p.last == p.stretches.size();
  const Vec3 rest(0, 0, 0);
  if (p.ends == Ends::flat && p.first == 0) ends.start = rest;
  if (p.ends == Ends::flat && p.last == p.stretches.size()) ends.end = rest;
  append_natural(p.stretches, p.first, p.last, ends, p.spans);
}

}  // namespace tweenfall::turns
