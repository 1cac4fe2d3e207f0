#include "document/fields/change.h"

#include <tweenfall/curves/number_text.h>

#include "document/fields/things.h"
#include "document/report/suggestion.h"

#include <utility>

namespace tweenfall::document::fields {

namespace {

// The path of a body that is taken back

void read_followed_clip(const json::Value& value, HandBack& out, Building& building) {
  take(value, out.clip, building);
  if (building.clips.count(out.clip) == 0 && !building.excused(out.clip))
    building.problems.add(
        value, "there is no clip " + json::in_quotes(out.clip) + suggestion_or_import(out.clip, building.clip_names()));
}

std::string clock_instead(std::string_view word) {
  if (word != "match") return {};
  return "; a clip is not searched for the pose that matches: \"restart\" begins it, \"run\" goes on";
}

const Table<HandBack>& path_table() {
  using Clock = HandBack::Clock;
  using Anchor = HandBack::Anchor;
  Form clock = words_of("a clock: \"run\", \"hold\" or \"restart\"", {"run", "hold", "restart"});
  clock.why = clock_instead;
  Row<HandBack> time = one_of<HandBack, Clock>(
      "time", "a clock", {{"run", Clock::run}, {"hold", Clock::hold}, {"restart", Clock::restart}},
      "where the clip's clock stands", &HandBack::clock);
  time.form = clock;
  static const Table<HandBack> table(
      "a path", {{"clip", &ValueForms::name, "absent: what played before", {read_followed_clip}},
                 time,
                 one_of<HandBack, Anchor>("anchor", "an anchor",
                                          {{"keep", Anchor::keep}, {"here", Anchor::here}, {"ground", Anchor::ground}},
                                          "where the path lies; of a ragdoll, that of its root", &HandBack::anchor)});
  return table;
}

const Table<Settle>& settle_table() {
  const auto kind = [](std::string word, Settle::Kind meant) {
    const auto read = [meant](const json::Value& value, Settle& settle, Building&) {
      settle = {meant, value.number()};
    };
    return Row<Settle>{std::move(word), &ValueForms::positive, "s", {read}};
  };
  static const Table<Settle> table("a settle",
                                   {kind("quintic", Settle::Kind::quintic), kind("half_life", Settle::Kind::half_life),
                                    kind("dead_blend", Settle::Kind::dead_blend)});
  return table;
}

// Why a field has no effect for a change to an owner, if it names one.
auto useless_to(Owner owner, const std::string& why) {
  return [owner, why](const ChangeBeingRead& read) {
    return read.to && read.change.to.owner() == owner ? why : std::string();
  };
}

// How long a change holds, and what follows it
std::vector<Row<ChangeBeingRead>> next_rows(const FormOf& next) {
  const auto lasts = [](const json::Value& value, ChangeBeingRead& read, Building&) { read.lasts = value.number(); };
  return {{"for", &ValueForms::positive, "seconds until \"then\"", {lasts}, false, {}, {"hold"}},
          {"then", next, "the next change", {read_next_change}, false, {}, {"next"}}};
}

}  // namespace

std::vector<Row<ChangeBeingRead>> change_rows() {
  const Meaning<ChangeBeingRead> to = {[](const json::Value& value, ChangeBeingRead& read, Building& building) {
    read.to = value;
    read.change.to = read_owner(value, building);
  }};
  const Meaning<ChangeBeingRead> velocity = {[](const json::Value& value, ChangeBeingRead& read, Building& building) {
                                               read_take_over(value, read.change.take_over, building);
                                             },
                                             "\"curve\""};
  const Meaning<ChangeBeingRead> settle = {[](const json::Value& value, ChangeBeingRead& read, Building& building) {
                                             settle_table().read(value, read.change.hand_back.settle, building);
                                           },
                                           "{\"quintic\": " + number_text(Settle{}.seconds) + "}"};
  const Meaning<ChangeBeingRead> path = {[](const json::Value& value, ChangeBeingRead& read, Building& building) {
                                           path_table().read(value, read.change.hand_back, building);
                                           read.follows = static_cast<bool>(value.find("clip"));
                                         },
                                         "{}"};
  Row<ChangeBeingRead> overlap =
      overlap_row<ChangeBeingRead>([](ChangeBeingRead& read) -> TakeOver& { return read.change.take_over; });
  overlap.useless = useless_to(Owner::keyed, "for a keyed body; it has its path's place");
  return {{"to", owner_form, "the new owner", to, true},
          {"ramp", &ValueForms::not_negative, "seconds in which the drive gets there, even in log frequency",
           member<ChangeBeingRead>([](ChangeBeingRead& read) -> double& { return read.change.ramp; })},
          {"velocity", take_over_form, "of a released body", velocity, false,
           useless_to(Owner::keyed, "for a keyed body; it has its path's")},
          overlap,
          {"path", path_form, "of a body that is taken back", path, false,
           useless_to(Owner::free, "for a body that is let go; it follows none")},
          {"settle", settle_form, "how the difference dies away", settle, false,
           useless_to(Owner::free, "for a body that is let go; nothing settles")}};
}

std::vector<Row<ChangeBeingRead>> change_rows(const FormOf& next) {
  std::vector<Row<ChangeBeingRead>> rows = change_rows();
  for (Row<ChangeBeingRead>& row : next_rows(next)) rows.push_back(std::move(row));
  return rows;
}

std::vector<Together> lasting() {
  return {{Together::Rule::first_needs_second, {"for", "then"}}, {Together::Rule::first_needs_second, {"then", "for"}}};
}

const Form* next_change_form(FormStore& store, const ValueForms& values) {
  Form* change = store.reserve();
  const Form* word = store.add(words_of("an owner: \"free\" or \"keyed\"", {"free", "keyed"}));
  const Form* next = store.add(choice_of("a change: \"free\", \"keyed\" or {\"to\", ...}", {word, change}));
  const FormOf::Make itself = [next](FormStore&, const ValueForms&) { return next; };
  *change = Table<ChangeBeingRead>("a change", change_rows(itself)).listing_form(store, values);
  change->together = lasting();
  change->definition = "change";
  return next;
}

json::Value place_of_owner(const json::Value& change) {
  return change.is(json::Value::Kind::object) ? below(change, {"to"}) : change;
}

json::Value place_of_next(const json::Value& change) {
  return below(change, {"then"});
}

void read_next_change(const json::Value& value, ChangeBeingRead& before, Building& building) {
  ChangeBeingRead& read = before.then.emplace_back();
  if (value.is(json::Value::Kind::text)) {
    read.to = value;
    read.change.to = read_owner(value, building);
    return;
  }
  static const Table<ChangeBeingRead> table("a change", change_rows(next_change_form));
  table.read(value, read, building);
}

const Form* path_form(FormStore& store, const ValueForms& values) {
  return store.add(path_table().listing_form(store, values));
}

void read_path(const json::Value& value, HandBack& out, Building& building) {
  path_table().read(value, out, building);
}

const Form* settle_form(FormStore& store, const ValueForms& values) {
  Form form = settle_table().choosing_form(store, values);
  form.what += ", in seconds";
  return store.add(std::move(form));
}

void read_settle(const json::Value& value, Settle& settle, Building& building) {
  settle_table().read(value, settle, building);
}

}  // namespace tweenfall::document::fields
