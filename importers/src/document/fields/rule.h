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

// Where a body that is taken back goes on, and how the difference dies away
const Form* path_form(FormStore& store, const ValueForms& values);
void read_path(const json::Value& value, HandBack& out, Building& building);
const Form* settle_form(FormStore& store, const ValueForms& values);
void read_settle(const json::Value& value, Settle& settle, Building& building);

// What becomes of overlap. @param access  gives the thing's take-over
template <class Thing, class Access>
[[nodiscard]] Row<Thing> overlap_row(Access access) {
  using Overlap = TakeOver::Overlap;
  return one_of<Thing, Overlap>(
      "overlap", "what becomes of overlap: \"push\", \"ignore\", \"rewind\" or \"veto\"",
      {{"push", Overlap::push}, {"ignore", Overlap::ignore}, {"rewind", Overlap::rewind}, {"veto", Overlap::veto}},
      "of a body that leaves its path in others: they are pushed apart, pass "
      "through each other, it leaves from where it was clear, or stays",
      [access](Thing& thing) -> Overlap& { return access(thing).overlap; });
}

// The velocity that a released body starts with
const Form* take_over_form(FormStore& store, const ValueForms& values);
void read_take_over(const json::Value& value, TakeOver& take_over, Building& building);

}  // namespace tweenfall::document::fields
