#include <tweenfall/curves/arc_length.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/spans_between.h"
#include "math/polynomial.h"
#include "math/polynomial_roots.h"
#include "questions/curve_pieces.h"

namespace tweenfall::questions {
namespace {

template <class V>
double product(const V& a, const V& b) noexcept {
  if constexpr (std::is_same_v<V, double>)
    return a * b;
  else
    return a.dot(b);
}

// Where a quintic replaces the curve, the curve's own rate gives its speed more exactly, except close to an infinite
// rate, which is limited there.
template <class V>
struct PathPiece : CurvePiece<V> {
  bool has_own_rate = false;
};

// Speed with respect to the piece's own variable.
template <class V>
double speed(const Curve<V>& path, const PathPiece<V>& piece, double s) noexcept {
  if (piece.has_own_rate) return (piece.to - piece.from) * splines::length_of(path.rate(piece.time_at(s)));
  return splines::length_of(math::evaluate_polynomial(piece.c.data(), piece.degree, s).first);
}

// Source: Abramowitz and Stegun, "Handbook of Mathematical Functions", table 25.4, n = 16.
template <class V>
double gauss(const Curve<V>& path, const PathPiece<V>& piece, double from, double to) noexcept {
  constexpr double nodes[8] = {0.0950125098376374402, 0.2816035507792589132, 0.4580167776572273863,
                               0.6178762444026437484, 0.7554044083550030339, 0.8656312023878317439,
                               0.9445750230732325761, 0.9894009349916499326};
  constexpr double weights[8] = {0.1894506104550684963, 0.1826034150449235889, 0.1691565193950025382,
                                 0.1495959888165767321, 0.1246289712555338721, 0.0951585116824927848,
                                 0.0622535239386478929, 0.0271524594117540949};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (int i = 0; i < 8; ++i)
    sum += weights[i] * (speed(path, piece, middle - half * nodes[i]) + speed(path, piece, middle + half * nodes[i]));
  return half * sum;
}

template <class V>
std::vector<PathPiece<V>> path_pieces(const Curve<V>& path, double from, double to) {
  std::vector<PathPiece<V>> result;
  for (const CurvePiece<V>& piece : curve_pieces(path, from, to)) {
    PathPiece<V> own{piece, !piece.exact()};
    const PathPiece<V> plain{piece, false};
    if (own.has_own_rate) {
      const double length = gauss(path, plain, 0, 1);
      own.has_own_rate = std::abs(gauss(path, own, 0, 1) - length) <= 1e-10 * length + 10 * piece.error;
    }
    result.push_back(own);
  }
  return result;
}

// Part of a piece on which Gauss's rule is accurate from its start to any point.
struct MeasuredPiece {
  std::size_t piece;
  double from, to;        // positions in the piece
  double before, length;  // U
};

template <class V>
class Measure {
 public:
  Measure(const Curve<V>& path, const std::vector<PathPiece<V>>& pieces, std::vector<MeasuredPiece>& result)
      : path_(path), pieces_(pieces), result_(result) {
    for (const PathPiece<V>& piece : pieces) tolerance_ += 1e-13 * gauss(path, piece, 0, 1);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      double from = 0;
      for (const double s : least_speeds(pieces[i])) {
        add(i, from, s, gauss(path, pieces[i], from, s), 0);
        from = s;
      }
      add(i, from, 1, gauss(path, pieces[i], from, 1), 0);
    }
  }

 private:
  static std::vector<double> least_speeds(const CurvePiece<V>& piece) {
    if (piece.degree < 2) return {};
    std::vector<double> square(static_cast<std::size_t>(2 * piece.degree - 1), 0.0);
    for (int i = 1; i <= piece.degree; ++i)
      for (int k = 1; k <= piece.degree; ++k)
        square[static_cast<std::size_t>(i + k - 2)] +=
            i * k * product(piece.c[static_cast<std::size_t>(i)], piece.c[static_cast<std::size_t>(k)]);
    std::vector<double> result = math::polynomial_roots(math::polynomial_derivative(square), 0, 1);
    std::erase_if(result, [](double s) { return s <= 0 || s >= 1; });
    return result;
  }

  void add(std::size_t i, double from, double to, double whole, int depth) {
    const double middle = 0.5 * (from + to);
    const double first = gauss(path_, pieces_[i], from, middle), second = gauss(path_, pieces_[i], middle, to);
    if (std::abs(first + second - whole) <= tolerance_ || depth == 40) {
      result_.push_back({i, from, to, total_, first + second});
      total_ += first + second;
      return;
    }
    add(i, from, middle, first, depth + 1);
    add(i, middle, to, second, depth + 1);
  }

  const Curve<V>& path_;
  const std::vector<PathPiece<V>>& pieces_;
  std::vector<MeasuredPiece>& result_;
  double tolerance_ = 0, total_ = 0;
};

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

template <class T>
struct MeasuredPath<T>::Data {
  Curve<T> path;
  std::vector<questions::PathPiece<T>> pieces;
  std::vector<questions::MeasuredPiece> stretches;

  [[nodiscard]] double length() const noexcept {
    return stretches.empty() ? 0 : stretches.back().before + stretches.back().length;
  }

  // Position within a stretch at the length `rest` from its start.
  [[nodiscard]] double position(const questions::MeasuredPiece& stretch, double rest) const noexcept {
    const questions::PathPiece<T>& piece = pieces[stretch.piece];
    if (!(rest > 0)) return stretch.from;
    if (!(rest < stretch.length)) return stretch.to;
    double low = stretch.from, high = stretch.to, s = low + (high - low) * (rest / stretch.length);
    for (int i = 0; i < 100; ++i) {
      const double error = questions::gauss(path, piece, stretch.from, s) - rest;
      if (error == 0) break;
      (error < 0 ? low : high) = s;
      double next = s - error / questions::speed(path, piece, s);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (next <= low || next >= high || std::abs(next - s) <= 1e-16 * std::abs(s)) break;
      s = next;
    }
    return s;
  }

  [[nodiscard]] const questions::MeasuredPiece& stretch_at(double length, Side side) const noexcept {
    const auto after = side == Side::out
                           ? std::upper_bound(stretches.begin(), stretches.end(), length,
                                              [](double v, const questions::MeasuredPiece& s) { return v < s.before; })
                           : std::lower_bound(stretches.begin(), stretches.end(), length,
                                              [](const questions::MeasuredPiece& s, double v) { return s.before < v; });
    return after == stretches.begin() ? *after : *(after - 1);
  }
};

template <class T>
MeasuredPath<T>::MeasuredPath(const Curve<T>& path) {
  spans::check_times(path.start(), path.end());
  auto data = std::make_shared<Data>(Data{path, questions::path_pieces(path, path.start(), path.end()), {}});
  questions::Measure<T>(path, data->pieces, data->stretches);
  data_ = std::move(data);
}

template <class T>
double MeasuredPath<T>::length() const noexcept {
  return data_->length();
}

template <class T>
double MeasuredPath<T>::length_at(double time) const noexcept {
  const Data& d = *data_;
  if (d.stretches.empty() || time <= d.path.start()) return 0;
  if (time >= d.path.end()) return d.length();
  const auto after = std::upper_bound(d.pieces.begin(), d.pieces.end(), time,
                                      [](double t, const questions::PathPiece<T>& piece) { return t < piece.from; });
  const std::size_t i = static_cast<std::size_t>(after - d.pieces.begin()) - 1;
  const double s = d.pieces[i].position_at(time);
  const auto next =
      std::partition_point(d.stretches.begin(), d.stretches.end(), [&](const questions::MeasuredPiece& stretch) {
        return stretch.piece < i || (stretch.piece == i && stretch.from <= s);
      });
  const questions::MeasuredPiece& stretch = *(next - 1);
  return stretch.before + questions::gauss(d.path, d.pieces[i], stretch.from, s);
}

template <class T>
double MeasuredPath<T>::time_at(double length_from_start) const noexcept {
  const Data& d = *data_;
  if (d.stretches.empty() || !(length_from_start > 0)) return d.path.start();
  if (length_from_start >= d.length()) return d.path.end();
  const questions::MeasuredPiece& stretch = d.stretch_at(length_from_start, Side::out);
  return d.pieces[stretch.piece].time_at(d.position(stretch, length_from_start - stretch.before));
}

template <class T>
Sample<T> MeasuredPath<T>::sample_at(double length_from_start, Side side) const noexcept {
  const Data& d = *data_;
  if (d.stretches.empty()) return {d.path.value(d.path.start()), zero<T>(), zero<T>()};
  const double length = std::clamp(length_from_start, 0.0, d.length());
  const questions::MeasuredPiece& stretch = d.stretch_at(length, side);
  const questions::PathPiece<T>& piece = d.pieces[stretch.piece];
  const double s = d.position(stretch, length - stretch.before);
  const double time = piece.time_at(s);
  math::Polynomial<T> p;
  if (piece.exact()) {
    p = math::evaluate_polynomial(piece.c.data(), piece.degree, s);
  } else {
    // Derivatives by length do not depend on the parameter used.
    const Sample<T> own = d.path.sample(time, s < 1 ? Side::out : Side::in);
    p = {own.value, own.rate, own.acceleration};
  }
  const T value = s > 0 && s < 1 ? p.value : d.path.value(time, s < 1 ? Side::out : Side::in);
  const double square = questions::product(p.first, p.first), bend = questions::product(p.second, p.second);
  if (square > 1e-24 * bend && square > 0) {
    const double pace = std::sqrt(square);
    return {value, p.first / pace, (p.second - (questions::product(p.first, p.second) / square) * p.first) / square};
  }
  // Where the path stops for an instant, it leaves along its second derivative, and arrives against it.
  if (!(bend > 0)) return {value, zero<T>(), zero<T>()};
  return {value, ((s < 1 ? 1 : -1) / std::sqrt(bend)) * p.second, zero<T>()};
}

template <class T>
double arc_length(const Curve<T>& curve, double from, double to) {
  if (to < from) return -arc_length(curve, to, from);
  const std::vector<questions::PathPiece<T>> pieces = questions::path_pieces(curve, from, to);
  std::vector<questions::MeasuredPiece> stretches;
  questions::Measure<T>(curve, pieces, stretches);
  return stretches.empty() ? 0 : stretches.back().before + stretches.back().length;
}

template <class T>
Curve<T> at_even_speed(const Curve<T>& path, double start, double duration) {
  spans::check_times(start, start + duration);
  if (!(duration > 0)) throw std::invalid_argument("a path needs a duration > 0 s; it is " + spans::text_of(duration));
  const MeasuredPath<T> measured(path);
  const double pace = measured.length() / duration;
  return Curve<T>(
      [measured, start, duration, pace](double time, Side side) {
        // The end itself, whatever rounding happened on the way there.
        const double done = time >= start + duration ? measured.length() : pace * (time - start);
        Sample<T> s = measured.sample_at(done, side);
        s.rate = pace * s.rate;
        s.acceleration = (pace * pace) * s.acceleration;
        return s;
      },
      start, start + duration);
}

#define TWEENFALL_ARC_LENGTH(T)                                   \
  template class MeasuredPath<T>;                                 \
  template double arc_length<T>(const Curve<T>&, double, double); \
  template Curve<T> at_even_speed<T>(const Curve<T>&, double, double);
TWEENFALL_ARC_LENGTH(double)
TWEENFALL_ARC_LENGTH(Vec2)
TWEENFALL_ARC_LENGTH(Vec3)
TWEENFALL_ARC_LENGTH(Vec4)
#undef TWEENFALL_ARC_LENGTH

}  // namespace tweenfall
