#pragma once

// The things that a document describes by fields: the form of each, and how it is read.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::document::fields {

// A node. Its place in its parent can be given for nodes of this document, its look and its body for imported ones too;
// parents are looked up when all nodes are known.
const Form* node_form(FormStore& store, const ValueForms& values);
void read_place(const json::Value& value, NodeDescription& node, Building& building);
[[nodiscard]] std::vector<std::string> place_names();
void read_look(const json::Value& value, NodeDescription& node, Building& building);

const Form* body_form(FormStore& store, const ValueForms& values);
[[nodiscard]] BodyDescription read_body(const json::Value& body, Building& building);

// The mass of a body: its density, a number or an expression, or mass properties instead.
const Form* density_form(FormStore& store, const ValueForms& values);
void read_density(const json::Value& density, BodyDescription& body, Building& building);
const Form* mass_properties_form(FormStore& store, const ValueForms& values);
void read_mass_properties(const json::Value& value, BodyDescription& body, Building& building);

// Groups that bodies and soft bodies belong to, and groups that they collide with.
const Form* groups_form(FormStore& store, const ValueForms& values);
[[nodiscard]] std::uint64_t read_groups(const json::Value& groups, Building& building);
[[nodiscard]] std::uint64_t read_collides_with(const json::Value& groups, Building& building);
void check_groups(Building& building);  // groups that bodies collide with; call when all bodies are known
[[nodiscard]] json::Value place_of_drive(const json::Value& body);  // or the body, where it says none
[[nodiscard]] json::Value place_of_spin(const json::Value& body);   // or the body, where it says none

// The owner of a body: "free", "keyed", or a drive.
const Form* owner_form(FormStore& store, const ValueForms& values);
[[nodiscard]] Drive read_owner(const json::Value& owner, Building& building);
[[nodiscard]] json::Value place_of_frame(const json::Value& drive);  // or the drive, where it says none

const Form* play_form(FormStore& store, const ValueForms& values);
// Empty for an unknown clip, which was reported.
[[nodiscard]] std::optional<Play> read_play(const json::Value& play, Building& building);
[[nodiscard]] json::Value place_of_fade_in(const json::Value& play);
[[nodiscard]] json::Value place_of_fade_out(const json::Value& play);

// A way to loop, or {"mode", "count"}; a play may also say "once".
const Form* loop_form(FormStore& store, const ValueForms& values);
const Form* loop_or_once_form(FormStore& store, const ValueForms& values);
[[nodiscard]] std::optional<Loop> read_loop(const json::Value& loop);
// The "count" beside a loop, which is a part of the loop.
void read_count_beside(const json::Value& count, std::optional<Loop>& loop, Problems& problems);

// Seconds over which a weight comes or goes, and how.
const Form* fade_form(FormStore& store, const ValueForms& values);
[[nodiscard]] Fade read_fade(const json::Value& fade);

const Form* world_form(FormStore& store, const ValueForms& values);
void read_world(const json::Value& world, Building& building);
// A step in seconds or as "1/N", and the names of integrators.
const Form* step_form(FormStore& store, const ValueForms& values);
[[nodiscard]] double seconds_of_step(const json::Value& step);
[[nodiscard]] const std::vector<std::pair<std::string, Integrator>>& integrator_words();
[[nodiscard]] const std::vector<std::pair<std::string, Detection>>& detection_words();
[[nodiscard]] json::Value place_of_gravity(const json::Value& world);  // or the world, where it says none; and so below
[[nodiscard]] json::Value place_of_step(const json::Value& world);
[[nodiscard]] json::Value place_of_force(const json::Value& world, std::size_t index);

// Null for a joint that is not in the document's own world.
[[nodiscard]] json::Value place_of_joint(const json::Value& world, std::string_view name);
[[nodiscard]] json::Value place_of_soft(const json::Value& world, std::string_view name);
[[nodiscard]] json::Value place_of_vehicle(const json::Value& world, std::string_view name);
[[nodiscard]] json::Value place_of_particles(const json::Value& world, std::string_view name);
[[nodiscard]] json::Value place_of_ignored(const json::Value& world);

// The node with a body of that name; `no_node` where there is none, which is reported.
[[nodiscard]] std::size_t body_called(const json::Value& name, Building& building);
// The bodies of a name or pattern; it is reported if there are none.
[[nodiscard]] std::vector<std::size_t> bodies_named(const json::Value& name, Building& building);

}  // namespace tweenfall::document::fields
