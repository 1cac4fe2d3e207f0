#pragma once

// A model's nodes and clips as a document's tree.

#include <tweenfall/importers/model.h>

#include "json/json_text.h"

namespace tweenfall::document {

[[nodiscard]] JsonValue tree_of(const Model& model);

}  // namespace tweenfall::document
