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

Form layer_weight() {
  return bounded("a weight from 0 to 1", 0, false, 1);
}

const fields::Table<LayersPose::Layer>& layer_table() {
  using Layer = LayersPose::Layer;
  const auto over = [](const json::Value& value, Layer& layer, Building&) { layer.pose = value.text(); };
  const auto add = [](const json::Value& value, Layer& layer, Building&) {
    layer.pose = value.text();
    layer.adds = true;
  };
  const auto weight = [](const json::Value& value, Layer& layer, Building& building) {
    layer.weight = read_number(value, building);
  };
  const auto mask = [](const json::Value& value, Layer& layer, Building& building) {
    layer.mask = read_mask(value, building);
  };
  static const fields::Table<Layer> table(
      "a layer", {{"over", &ValueForms::name, "a pose that replaces what is below", {over}},
                  {"add", &ValueForms::name, "a pose whose difference to its reference is added", {add}},
                  {"reference", &ValueForms::name, "of what is added; absent: what lies below the graph",
                   fields::member<Layer>(&Layer::reference)},
                  {"weight", number_form(layer_weight()), "how much of it", {weight, "1"}},
                  {"mask", mask_form, "the joints that it reaches; absent: all", {mask}}});
  return table;
}

const Form* layers_form(FormStore& store, const ValueForms& values) {
  Form layer = layer_table().listing_form(store, values);
  layer.together = {exactly_one({"over", "add"}), {Together::Rule::first_needs_second, {"reference", "add"}}};
  Form list = list_of(store.add(std::move(layer)), "a list of layers, the lowest first");
  list.one_a_line = true;
  return store.add(std::move(list));
}

const Form* blend_form(FormStore& store, const ValueForms& values) {
  Form part;
  part.kind = Form::Kind::tuple;
  part.what = "a pose and its weight: [pose, weight]";
  part.parts = {values.name, number_form(bounded("a weight of 0 or more", 0, false)).in(store, values)};
  part.fewest = 2;
  part.on_one_line = true;
  return store.add(list_of(store.add(std::move(part)), "a list of [pose, weight]", 1, most_blended));
}

void read_blend(const json::Value& value, GraphPose& pose, Building& building) {
  BlendPose& blend = pose.operation.emplace<BlendPose>();
  for (const json::Value& part : value.items()) {
    if (part.items().size() != 2) continue;
    blend.parts.push_back({std::string(part.items()[0].text()), read_number(part.items()[1], building)});
  }
}

void read_layers(const json::Value& value, GraphPose& pose, Building& building) {
  for (const json::Value& layer : value.items())
    layer_table().read(layer, as<LayersPose>(pose).layers.emplace_back(), building);
}

std::vector<OperationWord> words() {
  return {clip_word(), rest_word(), blend_word(), layers_word(), space_word(), machine_word()};
}

const fields::Table<GraphPose>& pose_table() {
  static const fields::Table<GraphPose> table("a pose", [] {
    std::vector<Row<GraphPose>> rows;
    for (OperationWord& word : words())
      for (Row<GraphPose>& row : word.rows) rows.push_back(std::move(row));
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
    const std::string_view word = value.text();
    as<ClipPose>(pose).loop = Loop{.mode = word == "pingpong"        ? LoopMode::pingpong
                                           : word == "repeat-offset" ? LoopMode::repeat_offset
                                                                     : LoopMode::repeat};
  };
  const auto count = [](const json::Value& value, GraphPose& pose, Building& building) {
    if (std::optional<Loop>& own = as<ClipPose>(pose).loop) fields::take(value, own->count, building);
  };
  return {{{"clip", &ValueForms::name, "a clip, from when its state was entered or the graph began", {clip}},
           {"speed", &ValueForms::number, "of a clip: clip seconds per second", {speed, "1"}},
           {"at", &ValueForms::number, "of a clip: seconds until it starts", {at, "0"}},
           {"loop",
            words_of("a way to loop", {"repeat", "repeat-offset", "pingpong"}),
            "of a clip; absent: its own",
            {loop}},
           {"count", &ValueForms::positive, "number of plays; absent: without end", {count}}}};
}

OperationWord rest_word() {
  const auto rest = [](const json::Value&, GraphPose& pose, Building&) { pose.operation.emplace<RestPose>(); };
  return {{{"rest", only_true(), "what lies below the graph", {rest}}}};
}

OperationWord blend_word() {
  return {{{"blend", blend_form, "several poses, by weights of which the ratios matter", {read_blend}}}};
}

OperationWord layers_word() {
  const auto base = [](const json::Value& value, GraphPose& pose, Building&) {
    as<LayersPose>(pose).base = value.text();
  };
  return {{{"base", &ValueForms::name, "of layers: what lies under them; absent: what lies below the graph", {base}},
           {"layers", layers_form, "poses over each other", {read_layers}}}};
}

const Form* pose_form(FormStore& store, const ValueForms& values) {
  Form pose = pose_table().form(store, values);
  pose.what += ": {\"clip\"}, {\"rest\"}, {\"blend\"}, {\"layers\"}, {\"space\"} or {\"machine\"}";
  pose.together = {exactly_one({"clip", "rest", "blend", "layers", "space", "machine"}),
                   {Together::Rule::first_needs_second, {"speed", "clip"}},
                   {Together::Rule::first_needs_second, {"at", "clip"}},
                   {Together::Rule::first_needs_second, {"loop", "clip"}},
                   {Together::Rule::first_needs_second, {"count", "loop"}},
                   {Together::Rule::first_needs_second, {"base", "layers"}}};
  pose.definition = "graph pose";
  return store.add(std::move(pose));
}

void read_pose(const json::Value& value, GraphPose& pose, Building& building) {
  pose_table().read(value, pose, building);
}

}  // namespace tweenfall::document::graphs
