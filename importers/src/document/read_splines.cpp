#include "document/read_splines.h"

#include <tweenfall/curves/splines.h>
#include <tweenfall/importers/number_text.h>

#include "document/values.h"

#include <algorithm>
#include <stdexcept>

namespace tweenfall::document {

namespace {

using Kind = JsonValue::Kind;

template <class T>
class SplineReader {
 public:
  SplineReader(double unit, Problems& problems) : unit_(unit), problems_(problems) {}

  std::optional<Curve<T>> through_points(const JsonValue& settings) {
    const std::vector<T> points = values_in(settings, "points");
    const bool closed = flag_in(settings, "closed", false);
    const std::vector<double> times = times_in(settings, [&] {
      const std::string spacing = text_in(settings, "spacing", "uniform");
      return spline_times<T>(points,
                             spacing == "centripetal" ? Parametrization::centripetal
                             : spacing == "chordal"   ? Parametrization::chordal
                                                      : Parametrization::uniform,
                             closed);
    });
    const std::string each = "one for each of the " + std::to_string(points.size()) + " points";
    if (!has_count(settings, "times", points.size() + (closed ? 1 : 0),
                   each + (closed ? " and one for the return" : "")) ||
        !has_count(settings, "rates", points.size(), each) ||
        !has_count(settings, "accelerations", points.size(), each) || !has_rising_times(settings))
      return {};
    if (usable(settings, "rates") && !usable(settings, "accelerations"))
      return hermite_spline<T>(times, points, values_in(settings, "rates"));
    if (usable(settings, "rates"))
      return quintic_spline<T>(times, points, values_in(settings, "rates"), values_in(settings, "accelerations"));
    const SplineEnds<T> ends{end_in(settings, "start"), end_in(settings, "end"), closed};
    const JsonValue* word = usable(settings, "ease");
    if (!word || word->text == "natural") return c2_spline<T>(times, points, ends);
    const std::optional<Ease> rule = Ease::named(word->text);
    if (!rule) return {};
    if (!rule->slope_rule()) {
      problems_.add(*word, "a spline takes an ease that is a rule of slopes, as \"catmull-rom\" is; found " +
                               in_quotes(word->text));
      return {};
    }
    for (const char* name : {"start", "end"}) {
      const JsonValue* end = usable(settings, name);
      if (!end || !end->is(Kind::text)) continue;
      problems_.add(*end, "only a spline of the ease \"natural\" can be without a knot next to its end");
      return {};
    }
    return cubic_spline<T>(times, points, rule->scaled(unit_), ends);
  }

  std::optional<Curve<T>> of_bezier_curves(const JsonValue& settings) {
    const std::vector<T> points = values_in(settings, "points");
    const std::size_t degree = degree_in(settings);
    if (points.size() % degree != 1 % degree || points.size() <= degree) {
      problems_.add(*usable(settings, "points"),
                    "curves of degree " + std::to_string(degree) + " that share their ends have " +
                        std::to_string(degree + 1) + " points, or " + std::to_string(2 * degree + 1) + ", " +
                        std::to_string(3 * degree + 1) + ", ...; found " + std::to_string(points.size()));
      return {};
    }
    const std::size_t curves = (points.size() - 1) / degree;
    const std::vector<double> times = times_in(settings, [&] {
      std::vector<double> even;
      for (std::size_t i = 0; i <= curves; ++i) even.push_back(static_cast<double>(i));
      return even;
    });
    if (!has_count(settings, "times", curves + 1, "one for each of the " + std::to_string(curves + 1) + " ends") ||
        !has_rising_times(settings))
      return {};
    std::vector<T> control;
    for (std::size_t i = 0; i < curves; ++i)
      for (std::size_t k = 0; k <= degree; ++k) control.push_back(points[i * degree + k]);
    return bezier_spline<T>(times, control);
  }

  std::optional<Curve<T>> of_control_points(const JsonValue& settings) {
    const std::vector<T> points = values_in(settings, "points");
    const int degree = static_cast<int>(degree_in(settings));
    const std::size_t knots_wanted = points.size() + static_cast<std::size_t>(degree) + 1;
    if (!has_count(settings, "knots", knots_wanted, "degree + 1 more than points")) return {};
    if (const JsonValue* knots = usable(settings, "knots")) return b_spline<T>(degree, numbers_in(*knots), points);
    return b_spline<T>(degree, clamped_knots(degree, points.size(), 0, number_in(settings, "duration", 1)), points);
  }

 private:
  [[nodiscard]] T value_of(const JsonValue& value) const {
    if constexpr (std::is_same_v<T, double>) {
      return unit_ * value.number;
    } else {
      T result = zero<T>();
      for (std::size_t i = 0; i < value.items.size() && i < static_cast<std::size_t>(T::RowsAtCompileTime); ++i)
        result[static_cast<Eigen::Index>(i)] = unit_ * value.items[i].number;
      return result;
    }
  }

  [[nodiscard]] std::vector<T> values_in(const JsonValue& settings, std::string_view name) const {
    std::vector<T> result;
    if (const JsonValue* list = usable(settings, name))
      for (const JsonValue& item : list->items) result.push_back(value_of(item));
    return result;
  }

  [[nodiscard]] static std::vector<double> numbers_in(const JsonValue& list) {
    std::vector<double> result;
    for (const JsonValue& item : list.items) result.push_back(item.number);
    return result;
  }

  [[nodiscard]] static std::size_t degree_in(const JsonValue& settings) {
    return static_cast<std::size_t>(number_in(settings, "degree", 3));
  }

  // Whether a list, if it is there, is as long as it must be.
  [[nodiscard]] bool has_count(const JsonValue& settings, std::string_view name, std::size_t count,
                               const std::string& why) {
    const JsonValue* list = usable(settings, name);
    if (!list || list->items.size() == count) return true;
    problems_.add(*list,
                  "expected " + std::to_string(count) + ", " + why + "; found " + std::to_string(list->items.size()));
    return false;
  }

  [[nodiscard]] bool has_rising_times(const JsonValue& settings) {
    const JsonValue* times = usable(settings, "times");
    for (std::size_t i = 1; times && i < times->items.size(); ++i) {
      const double before = times->items[i - 1].number, time = times->items[i].number;
      if (time > before) continue;
      problems_.add(times->items[i],
                    "times must increase; " + number_text(time) + " s is not after " + number_text(before) + " s");
      return false;
    }
    return true;
  }

  // Those stated, else the proposed ones stretched to the duration.
  template <class Propose>
  [[nodiscard]] static std::vector<double> times_in(const JsonValue& settings, const Propose& propose) {
    if (const JsonValue* stated = usable(settings, "times")) return numbers_in(*stated);
    std::vector<double> times = propose();
    const double duration = number_in(settings, "duration", 1), whole = times.back();
    for (double& time : times) time = time / whole * duration;
    return times;
  }

  [[nodiscard]] SplineEnd<T> end_in(const JsonValue& settings, std::string_view name) const {
    const JsonValue* said = usable(settings, name);
    if (!said) return {};
    if (said->is(Kind::text)) return SplineEnd<T>::not_a_knot();
    if (const JsonValue* rate = usable(*said, "rate")) return SplineEnd<T>::rate(value_of(*rate));
    if (const JsonValue* given = usable(*said, "acceleration")) return SplineEnd<T>::acceleration(value_of(*given));
    return {};
  }

  double unit_;
  Problems& problems_;
};

bool has_faults(const JsonValue& value) {
  if (value.is(Kind::faulty)) return true;
  return std::any_of(value.items.begin(), value.items.end(), has_faults) ||
         std::any_of(value.members.begin(), value.members.end(),
                     [](const JsonMember& member) { return has_faults(member.value); });
}

}  // namespace

template <class T>
std::optional<Curve<T>> read_spline(const JsonValue& track, double unit, Problems& problems) {
  SplineReader<T> reader(unit, problems);
  const auto read = [&](const JsonValue& settings, auto make) -> std::optional<Curve<T>> {
    if (has_faults(settings) || !usable(settings, "points")) return {};
    try {
      return (reader.*make)(settings);
    } catch (const std::invalid_argument& fault) {
      problems.add(settings, fault.what());
      return {};
    }
  };
  if (const JsonValue* s = usable(track, "spline")) return read(*s, &SplineReader<T>::through_points);
  if (const JsonValue* s = usable(track, "bezier")) return read(*s, &SplineReader<T>::of_bezier_curves);
  if (const JsonValue* s = usable(track, "b_spline")) return read(*s, &SplineReader<T>::of_control_points);
  return {};
}

template std::optional<Curve<double>> read_spline<double>(const JsonValue&, double, Problems&);
template std::optional<Curve<Vec2>> read_spline<Vec2>(const JsonValue&, double, Problems&);
template std::optional<Curve<Vec3>> read_spline<Vec3>(const JsonValue&, double, Problems&);
template std::optional<Curve<Vec4>> read_spline<Vec4>(const JsonValue&, double, Problems&);

}  // namespace tweenfall::document
