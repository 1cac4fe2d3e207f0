#pragma once

// A rule of the hand-off: when a body changes owner, to whom, and how.

#include "document/fields/table.h"

#include <string>
#include <vector>

namespace tweenfall::document::fields {

// A time at which a rule acts, and where it says so.
struct RuleInstant {
  json::Value place;
  double seconds = 0;
};

struct RuleBeingRead {
  Rule rule;
  std::vector<std::size_t> bodies;  // the nodes that it names, each once
  std::vector<RuleInstant> instants;
  json::Value to;                                    // where it names an owner; none where that is faulty
  bool follows = false;                              // whether it names the clip to follow
  const std::vector<std::string>* events = nullptr;  // of all clips
};

const Form* rule_form(FormStore& store, const ValueForms& values);
[[nodiscard]] RuleBeingRead read_rule(const json::Value& value, const std::vector<std::string>& events,
                                      Building& building);

// Its "when"
const Form* when_form(FormStore& store, const ValueForms& values);
void read_when(const json::Value& value, RuleBeingRead& rule, Building& building);

// The velocity that a released body starts with
const Form* take_over_form(FormStore& store, const ValueForms& values);
void read_take_over(const json::Value& value, TakeOver& take_over, Building& building);

}  // namespace tweenfall::document::fields
