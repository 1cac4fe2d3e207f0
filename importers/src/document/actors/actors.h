#pragma once

// The actors of a document's world other than bodies, by name: vehicles and particles.

#include "document/fields/table.h"

#include <optional>

namespace tweenfall::document::actors {

// Reads things of one kind by name: `begin` makes each from its name, and `take` gets it, with a flag that tells
// whether it was read without a fault.
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

// The same for things that are only usable without a fault; appends them to a list.
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
