#pragma once

// The targets of attacks: each kind makes case number n from a seed alone, so that it can be repeated by its number.

#include "random.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace tweenfall::attack {

using test::Random;

/// One kind of attack, ready to run any of its cases.
class Attack {
 public:
  virtual ~Attack() = default;
  /// Runs case `number`. @returns what went wrong, in a sentence; empty if nothing did. A crash ends the process.
  [[nodiscard]] virtual std::string run(std::uint64_t number) = 0;
  /// What case `number` feeds to the program, for inspection.
  [[nodiscard]] virtual std::string show(std::uint64_t number) = 0;
  /// How many cases so far were valid, and so were run to the end.
  [[nodiscard]] std::uint64_t taken() const { return taken_; }
  /// How many cases there are; 0 if they never end.
  [[nodiscard]] virtual std::uint64_t size() const { return 0; }

 protected:
  std::uint64_t taken_ = 0;
};

std::unique_ptr<Attack> attack_documents(std::uint64_t seed);
/// Each document of the samples, the tests and ../shared once, unchanged.
std::unique_ptr<Attack> attack_unchanged();
/// Documents with graphs, in which only the graphs are changed.
std::unique_ptr<Attack> attack_graphs(std::uint64_t seed);
/// Files of inputs, given to the stages they belong to.
std::unique_ptr<Attack> attack_inputs(std::uint64_t seed);
/// The same documents, given to the command.
std::unique_ptr<Attack> attack_commands(std::uint64_t seed);
/// @param ending  of the models to start from, such as ".fbx"
std::unique_ptr<Attack> attack_models(std::uint64_t seed, const std::string& ending);
std::unique_ptr<Attack> attack_stage(std::uint64_t seed);

/// The bytes of a file; empty if it cannot be read.
[[nodiscard]] std::string bytes_of(const std::filesystem::path& file);

/// A folder for what a process writes; it is removed with the process.
[[nodiscard]] std::filesystem::path folder_of_process(long process);

/// The random numbers of one case.
inline Random random_of(std::uint64_t seed, std::uint64_t number) {
  return Random(seed * 0x9e3779b97f4a7c15u ^ (number + 1) * 0xd1342543de82ef95u);
}

}  // namespace tweenfall::attack
