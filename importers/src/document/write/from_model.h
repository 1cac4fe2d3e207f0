#pragma once

// A model's nodes and clips as a document.

#include <tweenfall/importers/model.h>

#include <string>

namespace tweenfall::document {

// The JSON text of a document, without spaces.
[[nodiscard]] std::string text_of(const Model& model);

}  // namespace tweenfall::document
