#include "page/content/page_graphs.h"

#include <tweenfall/curves/number_text.h>

#include "json/json_string.h"
#include "page/content/page_frames.h"
#include "recording/base64.h"
#include "recording/user_numbers.h"

#include <algorithm>
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

constexpr std::size_t most_texts = 64;  // more are no states that anyone could tell apart

/// A track of texts as the states of a machine, one after the other; without any if they are too many.
GraphRecord::Machine words_of(const UserTrackRecord& track, const std::vector<double>& times) {
  GraphRecord::Machine machine;
  machine.name = track.name;
  std::vector<std::size_t> said;
  for (std::size_t frame = 0; frame < track.value.size(); ++frame) {
    const std::string& text = std::get<std::string>(track.value[frame]);
    const auto found = std::ranges::find(machine.states, text);
    said.push_back(static_cast<std::size_t>(found - machine.states.begin()));
    if (found == machine.states.end() && machine.states.size() == most_texts) return {};
    if (found == machine.states.end()) machine.states.push_back(text);
    if (frame > 0 && said[frame] == said[frame - 1]) continue;
    GraphRecord::Passage& passage = machine.passages.emplace_back();
    passage.time = times[frame];
    passage.state = said[frame];
  }
  machine.weight.assign(said.size() * machine.states.size(), 0);
  for (std::size_t frame = 0; frame < said.size(); ++frame)
    machine.weight[frame * machine.states.size() + said[frame]] = 1;
  machine.is_settling.assign(said.size(), 0);
  return machine;
}

/// User tracks in the form of a graph: numbers as parameters, texts as machines.
GraphRecord as_graph(const Recording& recording) {
  GraphRecord graph;
  graph.name = "user tracks";
  for (const UserTrackRecord& track : recording.user_tracks) {
    if (track.value.empty()) continue;
    if (std::holds_alternative<std::string>(track.value.front())) {
      GraphRecord::Machine words = words_of(track, recording.times);
      if (!words.states.empty()) graph.machines.push_back(std::move(words));
      continue;
    }
    const std::vector<std::string> names = recordings::number_names(track);
    const std::size_t first = graph.parameters.size();
    for (const std::string& name : names)
      graph.parameters.emplace_back().name = track.name + (name.empty() ? "" : "." + name);
    for (std::size_t frame = 0; frame < track.value.size(); ++frame) {
      const std::vector<double> numbers = recordings::numbers_at(track, frame, names.size());
      for (std::size_t i = 0; i < names.size(); ++i) graph.parameters[first + i].value.push_back(numbers[i]);
    }
  }
  return graph;
}

}  // namespace

void append_page_graphs(std::string& out, const Recording& recording, const std::vector<std::size_t>& frames) {
  if (recording.graphs.empty() && recording.user_tracks.empty()) return;
  out += ",\n\"graphs\":[";
  for (const GraphRecord& graph : recording.graphs) {
    if (&graph != &recording.graphs.front()) out += ",\n";
    out += graph_json(graph, frames);
  }
  if (!recording.user_tracks.empty()) {
    if (!recording.graphs.empty()) out += ",\n";
    out += graph_json(as_graph(recording), frames);
  }
  out += "]";
}

}  // namespace tweenfall::page
