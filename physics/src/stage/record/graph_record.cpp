#include "stage/record/graph_record.h"

#include <tweenfall/anim/graph_player.h>

#include <algorithm>

namespace tweenfall::staging {

namespace {

constexpr std::size_t most_numbers = 20'000'000, most_passages_kept = 20'000;

GraphRecord::Machine machine_record(const GraphPlayer& player, std::size_t machine) {
  GraphRecord::Machine record;
  record.name = player.machine_name(machine);
  const std::vector<GraphPose>& poses = player.graph().description().poses;
  const auto pose = std::ranges::find(poses, record.name, &GraphPose::name);
  const auto& described = std::get<MachinePose>(pose->operation);
  for (const MachinePose::State& state : described.states) record.states.push_back(state.name);
  for (const GraphPassage& passage : player.passages(machine)) {
    if (record.passages.size() == most_passages_kept) break;
    GraphRecord::Passage& told = record.passages.emplace_back();
    told.time = passage.time;
    told.state = passage.state;
    if (passage.transition == GraphPassage::no_transition) continue;
    const GraphTransition& transition = described.transitions[passage.transition];
    told.how = words_of(transition.change);
    told.when = words_of(transition.when);
  }
  return record;
}

}  // namespace

std::vector<GraphRecord> graph_records(const Stage& stage, std::span<const double> times) {
  std::vector<GraphRecord> records;
  std::size_t numbers = 0;
  for (const GraphDescription& description : stage.description().graphs) {
    GraphPlayer player = stage.graph(description.name);
    GraphRecord record;
    record.name = description.name;
    for (const GraphParameter& parameter : description.parameters) record.parameters.push_back({parameter.name, {}});
    std::size_t states = 0;
    for (std::size_t m = 0; m < player.machines(); ++m) {
      record.machines.push_back(machine_record(player, m));
      states += record.machines.back().states.size() + 1;
    }
    numbers += (record.parameters.size() + states) * times.size();
    if (numbers > most_numbers) return {};
    for (const double time : times) {
      player.seek(std::max(time, 0.0));
      for (GraphRecord::Parameter& parameter : record.parameters)
        parameter.value.push_back(player.parameter(parameter.name).value);
      for (std::size_t m = 0; m < player.machines(); ++m) {
        GraphRecord::Machine& machine = record.machines[m];
        const std::size_t first = machine.weight.size();
        machine.weight.resize(first + machine.states.size(), 0);
        bool settling = false;
        for (const GraphActivity& each : player.activity(m)) {
          machine.weight[first + each.state] += each.weight.value;
          settling = settling || each.settling > 0;
        }
        machine.is_settling.push_back(settling);
      }
    }
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace tweenfall::staging
