#include <tweenfall/curves/number_text.h>

#include "document/read/values.h"
#include "document/tracks/read_splines.h"

#include <algorithm>

namespace tweenfall::document {

bool has_faults(const json::Value& value) {
  if (value.is(json::Value::Kind::faulty)) return true;
  return std::any_of(value.items().begin(), value.items().end(), has_faults) ||
         std::any_of(value.members().begin(), value.members().end(),
                     [](const json::Member& member) { return has_faults(member.value); });
}

bool has_count(const json::Value& settings, std::string_view name, std::size_t count, const std::string& why,
               Problems& problems) {
  const json::Value list = usable(settings, name);
  if (!list || list.items().size() == count) return true;
  problems.add(list,
               "expected " + std::to_string(count) + ", " + why + "; found " + std::to_string(list.items().size()));
  return false;
}

bool has_rising_times(const json::Value& settings, Problems& problems) {
  const json::Value times = usable(settings, "times");
  for (std::size_t i = 1; times && i < times.items().size(); ++i) {
    const double before = times.items()[i - 1].number(), time = times.items()[i].number();
    if (time > before) continue;
    problems.add(times.items()[i],
                 "times must increase; " + number_text(time) + " s is not after " + number_text(before) + " s");
    return false;
  }
  return true;
}

std::size_t bezier_curves_in(const json::Value& settings, std::size_t degree, Problems& problems) {
  const json::Value points = usable(settings, "points");
  if (!points) return 0;
  const std::size_t count = points.items().size(), curves = (count - 1) / degree;
  if (curves == 0 || (count - 1) % degree != 0) {
    problems.add(points, "curves of degree " + std::to_string(degree) + " that share their ends have " +
                             std::to_string(degree + 1) + " points, or " + std::to_string(2 * degree + 1) + ", " +
                             std::to_string(3 * degree + 1) + ", ...; found " + std::to_string(count));
    return 0;
  }
  const std::string why = "one for each of the " + std::to_string(curves + 1) + " ends";
  return has_count(settings, "times", curves + 1, why, problems) && has_rising_times(settings, problems) ? curves : 0;
}

std::vector<double> times_in(const json::Value& settings, std::vector<double> proposed) {
  if (const json::Value stated = usable(settings, "times")) {
    std::vector<double> times;
    for (const json::Value& item : stated.items()) times.push_back(item.number());
    return times;
  }
  const double duration = number_in(settings, "duration", 1), whole = proposed.back();
  for (double& time : proposed) time = time / whole * duration;
  return proposed;
}

std::vector<double> even_times(std::size_t spans) {
  std::vector<double> times;
  for (std::size_t i = 0; i <= spans; ++i) times.push_back(static_cast<double>(i));
  return times;
}

}  // namespace tweenfall::document
