// Files of inputs changed by structure and by byte: each is refused with its places, or given to its stage while that
// runs; written again it is the same.

#include "attack/mutation.h"
#include "attack/shown.h"
#include "attack/written.h"

#include <tweenfall/importers/inputs.h>

#include <stdexcept>
#include <vector>

namespace tweenfall::attack {

namespace {

class Inputs final : public Attack {
 public:
  explicit Inputs(std::uint64_t seed) : seed_(seed) {
    const std::filesystem::path source = TWEENFALL_SOURCE_DIR;
    const auto stage_of = [&](const char* name) { return Document::read(source / "samples/documents" / name).stage(); };
    told_.push_back({stage_of("stroller.json"), bytes_of(source / "samples/inputs/stroller.json")});
    told_.push_back({stage_of("crane.json"), bytes_of(source / "samples/inputs/crane.json")});
    // Everything that may be asked of plays.
    told_.push_back({stage_of("crane.json"), R"({"tweenfall": 1, "inputs": [
      {"at": 0.5, "seek": {"play": "slew", "to": 0.5, "fade": 0.2, "events": true}},
      {"at": 0.9, "fade": {"play": "sway", "weight": 0.4, "seconds": 0.2, "ease": "quad-in-out"}},
      {"at": 1.2, "weigh": {"play": "sway", "weight": [[0, 1], [0.5, 0.2]]}},
      {"at": 2, "start": {"play": "sway", "fade_in": 0.2}},
      {"at": 2.5, "start": {"play": "again", "clip": "slew", "from": 0.1, "loop": "repeat", "count": 2, "mask": "*"}},
      {"at": 3, "stop": {"play": "again"}},
      {"at": 4, "speed": {"play": "hoist", "speed": [[0, 1], [1, -0.5]]}}]})"});
  }

  std::string show(std::uint64_t number) override { return make(number).second; }

  std::string run(std::uint64_t number) override {
    const auto [stage, text] = make(number);
    try {
      const std::vector<TimedInput> inputs = parse_inputs(text, "attack.json", *stage);
      ++taken_;
      const std::string again = inputs_json(inputs);
      if (const std::string fault = fault_of_json(again); !fault.empty()) return "the inputs written again: " + fault;
      if (inputs_json(parse_inputs(again, "again.json", *stage)) != again) return "written twice they differ";
      return fault_of_run(*stage, 2.5, inputs);
    } catch (const DocumentError& error) {
      for (const Problem& problem : error.problems())
        if (problem.message.empty() || !is_utf8(problem.text())) return "a problem without a message, or not in UTF-8";
      return error.problems().empty() ? "refused without a problem" : "";
    } catch (const std::exception& error) {
      return std::string("valid inputs end with: ") + error.what();
    }
  }

 private:
  struct Told {
    StageDescription stage;
    std::string inputs;
  };

  std::pair<const StageDescription*, std::string> make(std::uint64_t number) const {
    Random random = random_of(seed_, number);
    const Told& told = told_[below(random, told_.size())];
    std::string text = told.inputs;
    if (below(random, 5) != 0) {
      nlohmann::ordered_json inputs = nlohmann::ordered_json::parse(text, nullptr, false, true);
      // Late inputs are moved earlier, so that a short run reaches them.
      for (auto& input : inputs["inputs"]) input["at"] = 0.3 * input["at"].get<double>();
      mutate_structure(random, inputs);
      return {&told.stage, inputs.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
    }
    mutate_bytes(random, text);
    return {&told.stage, text};
  }

  std::uint64_t seed_;
  std::vector<Told> told_;
};

}  // namespace

std::unique_ptr<Attack> attack_inputs(std::uint64_t seed) {
  return std::make_unique<Inputs>(seed);
}

}  // namespace tweenfall::attack
