#pragma once

// A change of a body's owner, alone or with the change after it.

#include "document/fields/table.h"

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::document::fields {

struct ChangeBeingRead {
  OwnerChange change;
  json::Value to;                     // the value that names an owner; none where that is faulty
  bool follows = false;               // whether it names the clip to follow
  std::optional<double> lasts;        // time until the change in `then`, s
  std::vector<ChangeBeingRead> then;  // none or one
};

[[nodiscard]] std::vector<Row<ChangeBeingRead>> change_rows();
// The same with the change after it. @param next the form of that
[[nodiscard]] std::vector<Row<ChangeBeingRead>> change_rows(const FormOf& next);
[[nodiscard]] std::vector<Together> lasting();  // rules about the fields for that
const Form* next_change_form(FormStore& store, const ValueForms& values);
void read_next_change(const json::Value& value, ChangeBeingRead& before, Building& building);

[[nodiscard]] json::Value place_of_owner(const json::Value& change);
[[nodiscard]] json::Value place_of_next(const json::Value& change);

// The path of a body that is taken back, and how the difference decays
const Form* path_form(FormStore& store, const ValueForms& values);
void read_path(const json::Value& value, HandBack& out, Building& building);
const Form* settle_form(FormStore& store, const ValueForms& values);
void read_settle(const json::Value& value, Settle& settle, Building& building);

// How overlap is handled. @param access gives the thing's take-over
const Form* overlap_form(FormStore& store, const ValueForms& values);
void read_overlap(const json::Value& value, TakeOver& take_over, Building& building);
template <class Thing, class Access>
[[nodiscard]] Row<Thing> overlap_row(Access access) {
  const auto read = [access](const json::Value& value, Thing& thing, Building& building) {
    read_overlap(value, access(thing), building);
  };
  return {"overlap",
          overlap_form,
          "of a body that leaves its path in others: they are pushed apart, pass through each other, it leaves from "
          "where it was clear, or stays",
          {read, "\"push\""}};
}

// The velocity that a released body starts with
const Form* take_over_form(FormStore& store, const ValueForms& values);
void read_take_over(const json::Value& value, TakeOver& take_over, Building& building);

}  // namespace tweenfall::document::fields
