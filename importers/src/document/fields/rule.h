#pragma once

// A hand-off rule: when a body changes owner, to whom, and how.

#include "document/fields/change.h"

#include <string>
#include <vector>

namespace tweenfall::document::fields {

// A time at which a rule acts, and its place in the document.
struct RuleInstant {
  json::Value place;
  double seconds = 0;
};

struct RuleBeingRead {
  Rule rule;
  std::vector<std::size_t> bodies;  // the nodes that it names, each once
  std::vector<RuleInstant> instants;
  ChangeBeingRead change;
  const std::vector<std::string>* events = nullptr;  // of all clips
};

const Form* rule_form(FormStore& store, const ValueForms& values);
[[nodiscard]] RuleBeingRead read_rule(const json::Value& value, const std::vector<std::string>& events,
                                      Building& building);

// Its "when"
const Form* when_form(FormStore& store, const ValueForms& values);
void read_when(const json::Value& value, RuleBeingRead& rule, Building& building);

}  // namespace tweenfall::document::fields
