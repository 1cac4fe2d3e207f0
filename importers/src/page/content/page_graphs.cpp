#include "page/content/page_graphs.h"

#include <tweenfall/curves/number_text.h>

#include "json/json_string.h"
#include "page/content/page_frames.h"
#include "recording/base64.h"

#include <cmath>

namespace tweenfall::page {

namespace {

void append_text(std::string& out, const char* name, const std::string& text) {
  ((out += ",\"") += name) += "\":";
  json::append_string(out, text);
}

/// Numbers `first` to `first + stride` of each frame.
template <class NumberAt>
void append_numbers(std::string& out, const char* name, const std::vector<std::size_t>& frames, std::size_t stride,
                    const NumberAt& number_at) {
  std::vector<float> numbers;
  numbers.reserve(frames.size() * stride);
  for (const std::size_t frame : frames)
    for (std::size_t i = 0; i < stride; ++i) numbers.push_back(single(number_at(frame * stride + i)));
  ((out += ",\"") += name) += "\":\"" + recordings::base64(std::span<const float>(numbers)) + "\"";
}

std::string machine_json(const GraphRecord::Machine& machine, const std::vector<std::size_t>& frames) {
  std::string out = "{\"states\":[";
  for (const std::string& state : machine.states) {
    if (&state != &machine.states.front()) out += ',';
    json::append_string(out, state);
  }
  out += "]";
  append_text(out, "name", machine.name);
  append_numbers(out, "weights", frames, machine.states.size(), [&](std::size_t i) { return machine.weight[i]; });
  append_numbers(out, "settling", frames, 1, [&](std::size_t i) { return machine.is_settling[i] ? 1. : 0.; });
  out += ",\"passages\":[";
  for (const GraphRecord::Passage& passage : machine.passages) {
    if (&passage != &machine.passages.front()) out += ',';
    out += "{\"time\":" + number_text(passage.time) + ",\"state\":" + std::to_string(passage.state);
    append_text(out, "how", passage.how);
    append_text(out, "when", passage.when);
    out += '}';
  }
  return out + "]}";
}

std::string graph_json(const GraphRecord& graph, const std::vector<std::size_t>& frames) {
  std::string out = "{\"name\":";
  json::append_string(out, graph.name);
  out += ",\"parameters\":[";
  for (const GraphRecord::Parameter& parameter : graph.parameters) {
    if (&parameter != &graph.parameters.front()) out += ',';
    out += "{\"name\":";
    json::append_string(out, parameter.name);
    append_numbers(out, "values", frames, 1, [&](std::size_t i) { return parameter.value[i]; });
    out += '}';
  }
  out += "],\"machines\":[";
  for (const GraphRecord::Machine& machine : graph.machines) {
    if (&machine != &graph.machines.front()) out += ",\n";
    out += machine_json(machine, frames);
  }
  return out + "]}";
}

}  // namespace

void append_page_graphs(std::string& out, const Recording& recording, const std::vector<std::size_t>& frames) {
  if (recording.graphs.empty()) return;
  out += ",\n\"graphs\":[";
  for (const GraphRecord& graph : recording.graphs) {
    if (&graph != &recording.graphs.front()) out += ",\n";
    out += graph_json(graph, frames);
  }
  out += "]";
}

}  // namespace tweenfall::page
