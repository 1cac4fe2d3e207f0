#include "fbx/records/record.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::fbx {

namespace {

template <class T>
T converted(std::int64_t value) {
  return static_cast<T>(value);
}
template <class T>
T converted(double value) {
  if constexpr (std::is_same_v<T, double>)
    return value;
  else
    return whole_of(value);
}

template <class T>
T scalar(const Record& record, std::size_t index, T otherwise) {
  if (index >= record.values.size()) return otherwise;
  if (const auto* whole = std::get_if<std::int64_t>(&record.values[index])) return converted<T>(*whole);
  if (const auto* real = std::get_if<double>(&record.values[index])) return converted<T>(*real);
  return otherwise;
}

template <class T>
std::vector<T> all_numbers(const Record& record) {
  std::vector<T> all;
  for (const Value& value : record.values) {
    if (const auto* whole = std::get_if<std::int64_t>(&value))
      all.push_back(converted<T>(*whole));
    else if (const auto* real = std::get_if<double>(&value))
      all.push_back(converted<T>(*real));
    else if (const auto* integers = std::get_if<Integers>(&value))
      for (const std::int64_t each : *integers) all.push_back(converted<T>(each));
    else if (const auto* reals = std::get_if<Reals>(&value))
      for (const double each : *reals) all.push_back(converted<T>(each));
  }
  return all;
}

}  // namespace

std::int64_t whole_of(double value) noexcept {
  if (!(std::abs(value) < 9.2e18)) return value > 0 ? std::numeric_limits<std::int64_t>::max() : 0;
  return static_cast<std::int64_t>(value);
}

const Record* Record::find(std::string_view child) const {
  const auto found = std::ranges::find(children, child, &Record::name);
  return found == children.end() ? nullptr : &*found;
}

std::int64_t Record::whole(std::size_t index, std::int64_t otherwise) const {
  return scalar<std::int64_t>(*this, index, otherwise);
}

double Record::number(std::size_t index, double otherwise) const {
  return scalar<double>(*this, index, otherwise);
}

std::string_view Record::text(std::size_t index) const {
  if (index >= values.size()) return {};
  const auto* text = std::get_if<std::string>(&values[index]);
  return text ? std::string_view(*text) : std::string_view();
}

// In a text an array lies in a record "a" of its own.
Reals Record::reals() const {
  const Record* list = find("a");
  return all_numbers<double>(list ? *list : *this);
}

Integers Record::integers() const {
  const Record* list = find("a");
  return all_numbers<std::int64_t>(list ? *list : *this);
}

Reals Record::reals(std::string_view child) const {
  const Record* record = find(child);
  return record ? record->reals() : Reals();
}

Integers Record::integers(std::string_view child) const {
  const Record* record = find(child);
  return record ? record->integers() : Integers();
}

}  // namespace tweenfall::fbx
