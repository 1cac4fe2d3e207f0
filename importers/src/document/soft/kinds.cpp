#include "document/soft/soft.h"

#include <stdexcept>

namespace tweenfall::document::soft {

namespace {

using Read = SoftBeingRead;

const Form* cells_form(FormStore& store, std::size_t axes, double most) {
  const Form* const cell =
      store.add(bounded("a whole number from 1 to " + std::to_string(static_cast<int>(most)), 1, false, most, true));
  return store.add(list_of(cell, "a list of " + std::to_string(axes) + " whole numbers", axes, axes));
}

template <std::size_t axes>
std::array<int, axes> cells_of(const json::Value& value, std::array<int, axes> cells) {
  for (std::size_t i = 0; i < std::min(axes, value.items().size()); ++i)
    if (value.items()[i].is(json::Value::Kind::number)) cells[i] = static_cast<int>(value.items()[i].number());
  return cells;
}

const fields::Table<RopeSettings>& rope_table() {
  using fields::member;
  using Rope = RopeSettings;
  static const fields::Table<Rope> table(
      "a rope",
      {{"from", &ValueForms::vector, "m, world", member<Rope>(&Rope::from), true},
       {"to", &ValueForms::vector, "m, world", member<Rope>(&Rope::to), true},
       {"links",
        bounded("a whole number from 1 to 100000", 1, false, 100'000, true),
        "",
        member<Rope>(&Rope::links),
        false,
        {},
        {"nodes", "segments", "points", "count"}},
       {"slack", bounded("a number from 0 to 1000", 0, false, 1000),
        "by which part of the distance of its ends it is longer", member<Rope>(&Rope::slack)},
       {"down", &ValueForms::vector, "where what is slack hangs to begin with; absent: against y",
        member<Rope>(&Rope::down)},
       {"mass", &ValueForms::positive, "of the whole, kg", member<Rope>(&Rope::mass)},
       {"stiffness", &ValueForms::positive, "force at a strain of 1, N; absent: it cannot be stretched",
        member<Rope>(&Rope::stiffness)},
       {"damping", &ValueForms::not_negative, "the same at a strain rate of 1/s, N s", member<Rope>(&Rope::damping)},
       {"bending", &ValueForms::not_negative, "moment times radius of curvature, N m^2", member<Rope>(&Rope::bending)},
       {"tear", &ValueForms::positive, "strain at which it tears; absent: never", member<Rope>(&Rope::tear)}});
  return table;
}

const fields::Table<ClothSettings>& cloth_table() {
  using fields::member;
  using Cloth = ClothSettings;
  const auto of_material = [](auto ClothMaterial::*part) {
    return member<Cloth>([part](Cloth & cloth) -> auto& { return cloth.material.*part; });
  };
  const fields::FormOf cells =
      fields::FormOf::Make([](FormStore& store, const ValueForms&) { return cells_form(store, 2, 1000); });
  const fields::Meaning<Cloth> read_cells = {[](const json::Value& value, Cloth& cloth, Building&) {
                                               const auto given = cells_of(value, std::array{20, 20});
                                               cloth.columns = given[0];
                                               cloth.rows = given[1];
                                             },
                                             "[20, 20]"};
  static const fields::Table<Cloth> table(
      "a cloth",
      {{"corner", &ValueForms::vector, "m, world", member<Cloth>(&Cloth::corner), true},
       {"along", &ValueForms::vector, "one side from there, m", member<Cloth>(&Cloth::along), true, {}, {"width"}},
       {"across", &ValueForms::vector, "the other, m", member<Cloth>(&Cloth::across), true, {}, {"height", "length"}},
       {"cells", cells, "along and across", read_cells, false, {}, {"nodes", "segments", "resolution"}},
       {"density", &ValueForms::positive, "kg/m^2", of_material(&ClothMaterial::density)},
       {"stretching", &ValueForms::positive, "force over width at a strain of 1, N/m",
        of_material(&ClothMaterial::stretching)},
       {"damping", &ValueForms::not_negative, "the same at a strain rate of 1/s, N s/m",
        of_material(&ClothMaterial::damping)},
       {"bending", &ValueForms::not_negative, "N m", of_material(&ClothMaterial::bending)},
       {"tear", &ValueForms::positive, "strain at which it tears; absent: never", of_material(&ClothMaterial::tear)}});
  return table;
}

const fields::Table<SoftBoxSettings>& volume_table() {
  using fields::member;
  using Volume = SoftBoxSettings;
  const auto of_material = [](auto VolumeMaterial::*part) {
    return member<Volume>([part](Volume & volume) -> auto& { return volume.material.*part; });
  };
  const fields::FormOf cells =
      fields::FormOf::Make([](FormStore& store, const ValueForms&) { return cells_form(store, 3, 100); });
  const fields::Meaning<Volume> read_cells = {
      [](const json::Value& value, Volume& volume, Building&) { volume.cells = cells_of(value, volume.cells); },
      "[4, 4, 4]"};
  const auto position = [](Volume& volume) -> Vec3& { return volume.pose.position; };
  const auto rotation = [](Volume& volume) -> Quat& { return volume.pose.rotation; };
  static const fields::Table<Volume> table(
      "a soft box",
      {{"position", &ValueForms::vector, "of its middle, m, world", member<Volume>(position), true},
       {"rotation", &ValueForms::rotation, "", member<Volume>(rotation)},
       {"half_extents", &ValueForms::vector, "m", member<Volume>(&Volume::half_extents), true},
       {"cells", cells, "along its axes, each of five tetrahedra", read_cells, false, {}, {"nodes", "resolution"}},
       {"density", &ValueForms::positive, "kg/m^3", of_material(&VolumeMaterial::density)},
       {"stiffness", &ValueForms::positive, "of its edges: about Young's modulus, Pa",
        of_material(&VolumeMaterial::stiffness)},
       {"bulk", &ValueForms::positive, "against a change of volume, Pa", of_material(&VolumeMaterial::bulk)},
       {"damping", &ValueForms::not_negative, "of its edges, Pa s", of_material(&VolumeMaterial::damping)},
       {"tear", &ValueForms::positive, "strain at which it tears; absent: never", of_material(&VolumeMaterial::tear)}});
  return table;
}

// A kind, made by `make` from the settings read.
template <class Settings, class Make>
fields::Row<Read> kind(std::string name, const fields::Table<Settings>& table, Make make, std::string help) {
  const auto read = [&table, make](const json::Value& value, Read& out, Building& building) {
    out.kind = value;
    Settings settings{};
    const std::size_t before = building.problems.size();
    table.read(value, settings, building);
    if (building.problems.size() > before) return;
    try {
      make(settings, out);
    } catch (const std::invalid_argument& fault) {
      building.problems.add(value, fault.what());
    }
  };
  return {std::move(name), form_of(table), std::move(help), {read}};
}

}  // namespace

std::vector<fields::Row<SoftBeingRead>> kinds() {
  const auto rope_made = [](const RopeSettings& settings, Read& out) {
    out.described.soft = rope(settings);
    out.sides = {{0}, {static_cast<std::uint32_t>(settings.links)}};
  };
  const auto cloth_made = [](const ClothSettings& settings, Read& out) {
    out.described.soft = cloth(settings);
    const auto columns = static_cast<std::uint32_t>(settings.columns), rows = static_cast<std::uint32_t>(settings.rows);
    for (std::uint32_t i = 0; i <= columns; ++i) {
      out.sides.start.push_back(i);
      out.sides.end.push_back(rows * (columns + 1) + i);
    }
  };
  const auto volume_made = [](const SoftBoxSettings& settings, Read& out) {
    out.described.soft = soft_box(settings);
    const auto x = static_cast<std::uint32_t>(settings.cells[0]), y = static_cast<std::uint32_t>(settings.cells[1]),
               z = static_cast<std::uint32_t>(settings.cells[2]);
    for (std::uint32_t k = 0; k <= z; ++k)
      for (std::uint32_t i = 0; i <= x; ++i) {
        out.sides.start.push_back(k * (y + 1) * (x + 1) + i);
        out.sides.end.push_back((k * (y + 1) + y) * (x + 1) + i);
      }
  };
  std::vector<fields::Row<Read>> rows;
  rows.push_back(kind("rope", rope_table(), rope_made, "a chain of nodes, of which \"links\" counts the edges"));
  rows.push_back(kind("cloth", cloth_table(), cloth_made,
                      "a parallelogram; the node in column i of row j is number j (columns + 1) + i"));
  rows.push_back(kind("volume", volume_table(), volume_made,
                      "a box; node (i, j, k) is number (k (cells y + 1) + j) (cells x + 1) + i"));
  return rows;
}

}  // namespace tweenfall::document::soft
