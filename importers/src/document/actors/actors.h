#pragma once

// What acts in a document's world beside its bodies, by name: vehicles, and particles.

#include "document/fields/table.h"

#include <optional>

namespace tweenfall::document::actors {

// Reads things of one kind by name: each begins with what `begin` makes of its name, and comes to `take` with whether
// it has been read without a fault.
template <class Thing, class Begin, class Take>
void read_by_name(const json::Value& value, const fields::Table<Thing>& table, Building& building, const Begin& begin,
                  const Take& take) {
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name) || !member.value.is(json::Value::Kind::object)) continue;
    Thing thing = begin(std::string(member.name));
    const std::size_t before = building.problems.size();
    table.read(member.value, thing, building);
    take(std::move(thing), building.problems.size() == before);
  }
}

// The same of what is only of use without a fault, each in its place of a list.
template <class Thing, class Begin>
void read_by_name(const json::Value& value, const fields::Table<Thing>& table, Building& building,
                  std::vector<Thing>& out, const Begin& begin) {
  read_by_name(value, table, building, begin, [&](Thing thing, bool whole) {
    if (whole) out.push_back(std::move(thing));
  });
}

const Form* vehicles_form(FormStore& store, const ValueForms& values);
void read_vehicles(const json::Value& value, Building& building);

const Form* particles_form(FormStore& store, const ValueForms& values);
void read_particles(const json::Value& value, Building& building);

}  // namespace tweenfall::document::actors
