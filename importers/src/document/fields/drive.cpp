#include "document/fields/table.h"
#include "document/fields/things.h"

namespace tweenfall::document::fields {

namespace {

constexpr const char* what_owner = "an owner: \"free\", \"keyed\" or a drive, such as {\"hz\": 5}";

const Table<Drive>& drive_table() {
  static const Table<Drive> table(
      "a drive",
      {{"hz", bounded("a frequency above 0 Hz", 0, true), "pull, in cycles per second", member<Drive>(&Drive::hz),
        true},
       {"zeta", &ValueForms::not_negative, "damping ratio", member<Drive>(&Drive::zeta)},
       {"max_force", &ValueForms::not_negative, "N; absent: without limit", member<Drive>(&Drive::max_force)},
       {"max_torque", &ValueForms::not_negative, "N m; absent: without limit", member<Drive>(&Drive::max_torque)},
       {"gravity_compensation", bounded("a share from 0 to 1", 0, false, 1), "of the weight that is borne beside it",
        member<Drive>(&Drive::gravity_compensation)},
       one_of<Drive, Drive::Frame>(
           "frame", "a frame: \"world\", \"parent\" or \"anchor\"",
           {{"world", Drive::Frame::world}, {"parent", Drive::Frame::parent}, {"anchor", Drive::Frame::anchor}},
           "what carries the path: nothing, the nearest or the topmost node above that has a body", &Drive::frame)});
  return table;
}

}  // namespace

const Form* owner_form(FormStore& store, const ValueForms& values) {
  Form drive = drive_table().listing_form(store, values);
  drive.foremost_fault = [](const json::Value& value) {
    for (const std::string word : {"free", "keyed"})
      if (value.find(word) && value.members().size() == 1)
        return "expected " + std::string(what_owner) + "; say " + json::in_quotes(word);
    return std::string();
  };
  Form form = choice_of(what_owner, {store.add(words_of(what_owner, {"free", "keyed"})), store.add(std::move(drive))});
  form.definition = "owner";
  return store.add(std::move(form));
}

Drive read_owner(const json::Value& owner, Building& building) {
  if (owner.is(json::Value::Kind::text)) return owner.text() == "keyed" ? Drive::keyed() : Drive::free();
  // It remains a drive even if its frequency is faulty.
  Drive drive{.hz = 1};
  drive_table().read(owner, drive, building);
  return drive;
}

json::Value place_of_frame(const json::Value& drive) {
  return below(drive, {"frame"});
}

}  // namespace tweenfall::document::fields
