#pragma once

// The inputs of a stage, and how each is read; one table of fields for each.

#include <tweenfall/physics/stage/input.h>

#include "document/fields/change.h"
#include "document/fields/table.h"

#include <string>

namespace tweenfall::document::inputs {

/// An input for a play.
template <class Action>
struct Asked {
  std::string play;
  Action action{};
  json::Value place{};  // of the play's name
};

/// An input for a body.
template <class Settings>
struct OfBody {
  Settings input{};
  json::Value place{};  // of the body's name
};

/// A hand-over of a body.
struct HandOverRead {
  std::string body;
  fields::ChangeBeingRead change;
};

/// An input for a graph.
template <class Settings>
struct OfGraph {
  Settings input{};
  json::Value graph{}, name{};  // the places of both names
};

/// Controls of a vehicle.
struct Controlled {
  input::Control input{};
  json::Value place{};  // of the vehicle's name
};

using Started = Asked<playing::Start>;

[[nodiscard]] const fields::Table<Started>& start_table();
[[nodiscard]] const fields::Table<Asked<playing::Stop>>& stop_table();
[[nodiscard]] const fields::Table<Asked<playing::FadeTo>>& fade_table();
[[nodiscard]] const fields::Table<Asked<playing::Weigh>>& weigh_table();
[[nodiscard]] const fields::Table<Asked<playing::SetSpeed>>& speed_table();
[[nodiscard]] const fields::Table<Asked<playing::Seek>>& seek_table();
[[nodiscard]] const fields::Table<OfBody<input::Release>>& release_table();
[[nodiscard]] const fields::Table<OfBody<input::Recover>>& recover_table();
[[nodiscard]] const fields::Table<OfBody<HandOverRead>>& hand_over_table();
[[nodiscard]] const fields::Table<OfBody<input::Push>>& push_table();
[[nodiscard]] const fields::Table<OfGraph<input::Set>>& set_table();
[[nodiscard]] const fields::Table<OfGraph<input::Send>>& send_table();
[[nodiscard]] const fields::Table<Controlled>& control_table();

}  // namespace tweenfall::document::inputs
