#pragma once

// What acts in a document's world beside its bodies, by name: vehicles, and particles.

#include "document/fields/table.h"

#include <optional>

namespace tweenfall::document::actors {

const Form* vehicles_form(FormStore& store, const ValueForms& values);
void read_vehicles(const json::Value& value, Building& building);

const Form* particles_form(FormStore& store, const ValueForms& values);
void read_particles(const json::Value& value, Building& building);

}  // namespace tweenfall::document::actors
