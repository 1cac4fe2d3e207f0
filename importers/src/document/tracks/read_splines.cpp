#include "document/tracks/read_splines.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/splines.h>

#include "document/read/values.h"

#include <algorithm>
#include <stdexcept>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

template <class T>
class SplineReader {
 public:
  SplineReader(double unit, Problems& problems) : unit_(unit), problems_(problems) {}

  std::optional<Curve<T>> through_points(const json::Value& settings) {
    const std::vector<T> points = values_in(settings, "points");
    const bool closed = flag_in(settings, "closed", false);
    const std::string each = "one for each of the " + std::to_string(points.size()) + " points";
    if (!has_count(settings, "times", points.size() + (closed ? 1 : 0),
                   each + (closed ? " and one for the return" : ""), problems_) ||
        !has_count(settings, "rates", points.size(), each, problems_) ||
        !has_count(settings, "accelerations", points.size(), each, problems_) || !has_rising_times(settings, problems_))
      return {};
    const std::string spacing = text_in(settings, "spacing", "uniform");
    const Parametrization parametrization = spacing == "centripetal" ? Parametrization::centripetal
                                            : spacing == "chordal"   ? Parametrization::chordal
                                                                     : Parametrization::uniform;
    const std::vector<double> times = times_in(
        settings, usable(settings, "times") ? std::vector<double>() : spline_times<T>(points, parametrization, closed));
    if (usable(settings, "rates") && !usable(settings, "accelerations"))
      return hermite_spline<T>(times, points, values_in(settings, "rates"));
    if (usable(settings, "rates"))
      return quintic_spline<T>(times, points, values_in(settings, "rates"), values_in(settings, "accelerations"));
    const SplineEnds<T> ends{end_in(settings, "start"), end_in(settings, "end"), closed};
    const json::Value word = usable(settings, "ease");
    if (!word || word.text() == "natural") return c2_spline<T>(times, points, ends);
    const std::optional<Ease> rule = Ease::named(word.text());
    if (!rule) return {};
    if (!rule->slope_rule()) {
      problems_.add(word, "a spline takes an ease that is a rule of slopes, as \"catmull-rom\" is; found " +
                              json::in_quotes(word.text()));
      return {};
    }
    for (const char* name : {"start", "end"}) {
      const json::Value end = usable(settings, name);
      if (!end || !end.is(Kind::text)) continue;
      problems_.add(end, "only a spline with the ease \"natural\" can be \"not-a-knot\" at an end");
      return {};
    }
    return cubic_spline<T>(times, points, rule->scaled(unit_), ends);
  }

  std::optional<Curve<T>> of_bezier_curves(const json::Value& settings) {
    const std::vector<T> points = values_in(settings, "points");
    const std::size_t degree = degree_in(settings), curves = bezier_curves_in(settings, degree, problems_);
    if (curves == 0) return {};
    const std::vector<double> times = times_in(settings, even_times(curves));
    std::vector<T> control;
    for (std::size_t i = 0; i < curves; ++i)
      for (std::size_t k = 0; k <= degree; ++k) control.push_back(points[i * degree + k]);
    return bezier_spline<T>(times, control);
  }

  std::optional<Curve<T>> of_control_points(const json::Value& settings) {
    const std::vector<T> points = values_in(settings, "points");
    const int degree = static_cast<int>(degree_in(settings));
    const std::size_t knots_wanted = points.size() + static_cast<std::size_t>(degree) + 1;
    if (!has_count(settings, "knots", knots_wanted, "degree + 1 more than points", problems_)) return {};
    if (const json::Value knots = usable(settings, "knots")) return b_spline<T>(degree, numbers_in(knots), points);
    return b_spline<T>(degree, clamped_knots(degree, points.size(), 0, number_in(settings, "duration", 1)), points);
  }

 private:
  [[nodiscard]] T value_of(const json::Value& value) const {
    if constexpr (std::is_same_v<T, double>) {
      return unit_ * value.number();
    } else {
      T result = zero<T>();
      for (std::size_t i = 0; i < value.items().size() && i < static_cast<std::size_t>(T::RowsAtCompileTime); ++i)
        result[static_cast<Eigen::Index>(i)] = unit_ * value.items()[i].number();
      return result;
    }
  }

  [[nodiscard]] std::vector<T> values_in(const json::Value& settings, std::string_view name) const {
    std::vector<T> result;
    if (const json::Value list = usable(settings, name))
      for (const json::Value& item : list.items()) result.push_back(value_of(item));
    return result;
  }

  [[nodiscard]] static std::vector<double> numbers_in(const json::Value& list) {
    std::vector<double> result;
    for (const json::Value& item : list.items()) result.push_back(item.number());
    return result;
  }

  [[nodiscard]] static std::size_t degree_in(const json::Value& settings) {
    return static_cast<std::size_t>(number_in(settings, "degree", 3));
  }

  [[nodiscard]] SplineEnd<T> end_in(const json::Value& settings, std::string_view name) const {
    const json::Value said = usable(settings, name);
    if (!said) return {};
    if (said.is(Kind::text)) return SplineEnd<T>::not_a_knot();
    if (const json::Value rate = usable(said, "rate")) return SplineEnd<T>::rate(value_of(rate));
    if (const json::Value given = usable(said, "acceleration")) return SplineEnd<T>::acceleration(value_of(given));
    return {};
  }

  double unit_;
  Problems& problems_;
};

}  // namespace

template <class T>
std::optional<Curve<T>> read_spline(const json::Value& track, double unit, Problems& problems) {
  SplineReader<T> reader(unit, problems);
  const auto read = [&](const json::Value& settings, auto make) -> std::optional<Curve<T>> {
    if (has_faults(settings) || !usable(settings, "points")) return {};
    try {
      return (reader.*make)(settings);
    } catch (const std::invalid_argument& fault) {
      problems.add(settings, fault.what());
      return {};
    }
  };
  if (const json::Value s = usable(track, "spline")) return read(s, &SplineReader<T>::through_points);
  if (const json::Value s = usable(track, "bezier")) return read(s, &SplineReader<T>::of_bezier_curves);
  if (const json::Value s = usable(track, "b_spline")) return read(s, &SplineReader<T>::of_control_points);
  return {};
}

template std::optional<Curve<double>> read_spline<double>(const json::Value&, double, Problems&);
template std::optional<Curve<Vec2>> read_spline<Vec2>(const json::Value&, double, Problems&);
template std::optional<Curve<Vec3>> read_spline<Vec3>(const json::Value&, double, Problems&);
template std::optional<Curve<Vec4>> read_spline<Vec4>(const json::Value&, double, Problems&);

}  // namespace tweenfall::document
