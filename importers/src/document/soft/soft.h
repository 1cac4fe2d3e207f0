#pragma once

// The soft bodies of a document's world, by name.

#include "document/fields/table.h"

namespace tweenfall::document::soft {

// The nodes of a soft body for the words "start" and "end".
struct Sides {
  std::vector<std::uint32_t> start, end;
};

struct SoftBeingRead {
  SoftDescription described;
  json::Value kind;  // the value of its kind
  Sides sides;
};

// One field for each kind of soft body
[[nodiscard]] std::vector<fields::Row<SoftBeingRead>> kinds();

const Form* form(FormStore& store, const ValueForms& values);
void read(const json::Value& value, Building& building);

}  // namespace tweenfall::document::soft
