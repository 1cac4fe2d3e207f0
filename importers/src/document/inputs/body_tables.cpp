#include "document/fields/change.h"
#include "document/fields/things.h"
#include "document/inputs/input_tables.h"

#include <utility>

namespace tweenfall::document::inputs {

using fields::Row;
using fields::Table;

namespace {

template <class Thing>
Row<Thing> body_row() {
  const auto read = [](const json::Value& value, Thing& thing, Building&) {
    thing.input.body = value.text();
    thing.place = value;
  };
  return {"body", &ValueForms::name, "a node's name", {read}, true};
}

}  // namespace

const Table<OfBody<input::Release>>& release_table() {
  using Release = OfBody<input::Release>;
  const auto velocity = [](const json::Value& value, Release& release, Building& building) {
    fields::read_take_over(value, release.input.settings, building);
  };
  static const Table<Release> table(
      "a release",
      {body_row<Release>(),
       {"velocity", fields::take_over_form, "", {velocity, "\"curve\""}},
       fields::overlap_row<Release>([](Release& release) -> TakeOver& { return release.input.settings; })});
  return table;
}

const Table<OfBody<input::Recover>>& recover_table() {
  using Recover = OfBody<input::Recover>;
  const auto path = [](const json::Value& value, Recover& recover, Building& building) {
    fields::read_path(value, recover.input.settings, building);
  };
  const auto settle = [](const json::Value& value, Recover& recover, Building& building) {
    fields::read_settle(value, recover.input.settings.settle, building);
  };
  static const Table<Recover> table("a recovery", {body_row<Recover>(),
                                                   {"path", fields::path_form, "", {path, "{}"}},
                                                   {"settle", fields::settle_form, "", {settle}}});
  return table;
}

const Table<OfBody<HandOverRead>>& hand_over_table() {
  using HandOver = OfBody<HandOverRead>;
  static const Table<HandOver> table("a hand-over", [] {
    std::vector<Row<HandOver>> rows{body_row<HandOver>()};
    const auto change = [](auto& handed) -> auto& {
      return handed.input.change;
    };
    for (Row<HandOver>& row : fields::rows_of_part<HandOver>(fields::change_rows(), change))
      rows.push_back(std::move(row));
    return rows;
  }());
  return table;
}

const Table<OfBody<input::Push>>& push_table() {
  using Push = OfBody<input::Push>;
  static const Table<Push> table("a push",
                                 {body_row<Push>(),
                                  {"impulse", &ValueForms::vector, "N s",
                                   fields::member<Push>([](Push& push) -> Vec3& { return push.input.impulse; }), true},
                                  {"point", &ValueForms::vector, "where, in the world, m",
                                   fields::member<Push>([](Push& push) -> Vec3& { return push.input.point; }), true}});
  return table;
}

}  // namespace tweenfall::document::inputs
