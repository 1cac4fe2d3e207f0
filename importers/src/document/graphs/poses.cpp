#include "document/fields/things.h"
#include "document/graphs/parts.h"

#include <cmath>

namespace tweenfall::document::graphs {

namespace {

using fields::Row;

Form only_true() {
  Form yes;
  yes.kind = Form::Kind::boolean;
  yes.what = "true";
  yes.only_true = true;
  return yes;
}

const fields::Table<LayersPose::Layer>& layer_table() {
  using Layer = LayersPose::Layer;
  const auto over = [](const json::Value& value, Layer& layer, Building&) { layer.pose = value.text(); };
  const auto add = [](const json::Value& value, Layer& layer, Building&) {
    layer.pose = value.text();
    layer.adds = true;
  };
  const auto mask = [](const json::Value& value, Layer& layer, Building& building) {
    layer.mask = read_mask(value, building);
  };
  static const fields::Table<Layer> table(
      "a layer", {{"over", &ValueForms::name, "a pose that replaces what is below", {over}},
                  {"add", &ValueForms::name, "a pose whose difference to its reference is added", {add}},
                  {"reference", &ValueForms::name, "of what is added; absent: what lies below the graph",
                   fields::member<Layer>(&Layer::reference)},
                  number_row<Layer>("weight", share_form(), "how much of it", "1", &Layer::weight),
                  {"mask", mask_form, "the joints that it reaches; absent: all", {mask}}});
  return table;
}

const Form* layers_form(FormStore& store, const ValueForms& values) {
  Form layer = layer_table().listing_form(store, values);
  layer.together = {exactly_one({"over", "add"}), {Together::Rule::first_needs_second, {"reference", "add"}}};
  Form list = list_of(store.add(std::move(layer)), "a list of layers, the lowest first");
  list.one_per_line = true;
  return store.add(std::move(list));
}

Form share_of_a_blend() {
  return bounded("a weight of 0 or more", 0, false);
}

const Form* blend_form(FormStore& store, const ValueForms& values) {
  Form part;
  part.kind = Form::Kind::tuple;
  part.what = "a pose and its weight: [pose, weight]";
  part.parts = {values.name, number_form(share_of_a_blend()).in(store, values)};
  part.fewest = 2;
  part.on_one_line = true;
  part.foremost_fault = [](const json::Value& value) { return swapped_pair(value, true); };
  return store.add(list_of(store.add(std::move(part)), "a list of [pose, weight]", 1, most_blended));
}

void read_blend(const json::Value& value, GraphPose& pose, Building& building) {
  BlendPose& blend = pose.operation.emplace<BlendPose>();
  for (const json::Value& part : value.items()) {
    if (part.items().size() != 2) continue;
    blend.parts.push_back(
        {std::string(part.items()[0].text()), read_number(part.items()[1], share_of_a_blend(), building)});
  }
}

void read_layers(const json::Value& value, GraphPose& pose, Building& building) {
  for (const json::Value& layer : value.items())
    layer_table().read(layer, as<LayersPose>(pose).layers.emplace_back(), building);
}

const std::vector<OperationWord>& words() {
  static const std::vector<OperationWord> all = {clip_word(),        rest_word(),    blend_word(),    layers_word(),
                                                 space_word(),       machine_word(), two_bone_word(), look_at_word(),
                                                 reach_word(),       feet_word(),    mirror_word(),   retarget_word(),
                                                 root_motion_word(), spring_word(),  jiggle_word()};
  return all;
}

const fields::Table<GraphPose>& pose_table() {
  static const fields::Table<GraphPose> table("a pose", [] {
    const auto nothing = [](const json::Value&, GraphPose&, Building&) {};  // it is read when the operation is known
    std::vector<Row<GraphPose>> rows = {
        {"base", &ValueForms::name, "the pose that is changed; absent: what lies below the graph", {nothing}}};
    for (const OperationWord& word : words())
      for (const Row<GraphPose>& row : word.rows) rows.push_back(row);
    return rows;
  }());
  return table;
}

}  // namespace

OperationWord clip_word() {
  const auto clip = [](const json::Value& value, GraphPose& pose, Building&) {
    pose.operation.emplace<ClipPose>().clip = value.text();
  };
  const auto speed = [](const json::Value& value, GraphPose& pose, Building& building) {
    fields::take(value, as<ClipPose>(pose).speed, building);
  };
  const auto at = [](const json::Value& value, GraphPose& pose, Building& building) {
    fields::take(value, as<ClipPose>(pose).at, building);
  };
  const auto loop = [](const json::Value& value, GraphPose& pose, Building&) {
    as<ClipPose>(pose).loop = fields::read_loop(value).value_or(Loop{LoopMode::repeat, 0});
  };
  const auto count = [](const json::Value& value, GraphPose& pose, Building& building) {
    fields::read_count_beside(value, as<ClipPose>(pose).loop, building.problems);
  };
  return {{{"clip", &ValueForms::name, "a clip, from when its state was entered or the graph began", {clip}},
           {"speed", &ValueForms::number, "of a clip: clip seconds per second", {speed, "1"}},
           {"at", &ValueForms::number, "of a clip: seconds until it starts", {at, "0"}},
           {"loop", fields::loop_form, "of a clip; absent: its own", {loop}},
           {"count", &ValueForms::positive, "number of plays; absent: without end", {count}}}};
}

OperationWord rest_word() {
  const auto rest = [](const json::Value&, GraphPose& pose, Building&) { pose.operation.emplace<RestPose>(); };
  return {{{"rest", only_true(), "what lies below the graph", {rest}}}};
}

OperationWord blend_word() {
  return {{{"blend",
            blend_form,
            "several poses, by weights of which the ratios matter; the pose below makes up for what a sum lacks to 0.1",
            {read_blend}}}};
}

OperationWord layers_word() {
  return {{{"layers", layers_form, "poses over each other, the base at the bottom", {read_layers}}}, true};
}

const Form* pose_form(FormStore& store, const ValueForms& values) {
  Form pose = pose_table().form(store, values);
  pose.what += ": ";
  std::vector<std::string> names;
  std::vector<Together> rules;
  for (const OperationWord& word : words()) {
    const std::string& name = word.rows.front().name;
    const bool first = names.empty(), last = names.size() + 1 == words().size();
    pose.what += (first ? "{" : last ? " or {" : ", {") + json::in_quotes(name) + "}";
    names.push_back(name);
    for (std::size_t i = 1; i < word.rows.size(); ++i)
      rules.push_back({Together::Rule::first_needs_second, {word.rows[i].name, name}});
    if (!word.has_base) rules.push_back(at_most_one({"base", name}));
  }
  rules.push_back({Together::Rule::first_needs_second, {"count", "loop"}});
  pose.together = {exactly_one(std::move(names))};
  for (Together& rule : rules) pose.together.push_back(std::move(rule));
  pose.definition = "graph pose";
  return store.add(std::move(pose));
}

void read_pose(const json::Value& value, GraphPose& pose, Building& building) {
  pose_table().read(value, pose, building);
  const std::string base = text_in(value, "base");
  std::visit(
      [&](auto& operation) {
        if constexpr (requires { operation.base; }) operation.base = base;
      },
      pose.operation);
}

}  // namespace tweenfall::document::graphs
