// Documents of very many keys as trees, beside the parser's bare pass over the same text. `bytes_per_byte` is the peak
// of the memory that reading takes, including the text, divided by the size of the text.

#include "json/json_tree.h"

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>

namespace {

std::size_t taken = 0, peak = 0;

void* counted(std::size_t size) {
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (!memory) throw std::bad_alloc();
  taken += malloc_usable_size(memory);
  peak = std::max(peak, taken);
  return memory;
}

void uncounted(void* memory) noexcept {
  if (memory) taken -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  uncounted(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  uncounted(memory);
}

namespace {

using namespace tweenfall;

// Keys as rows, keys with names, and members of one object with one name each.
enum class Form { rows, named, members };

std::string keys(Form form, std::int64_t count) {
  std::string text =
      form == Form::members ? "{\"all\": {" : "{\"tweenfall\": 1, \"clips\": {\"a\": {\"tracks\": {\"b.x\": [";
  for (std::int64_t i = 0; i < count; ++i) {
    if (i > 0) text += ",\n";
    const std::string time = std::to_string(i / 30) + "." + std::to_string(i % 30 + 10);
    const std::string value = "1." + std::to_string(i * 7919 % 1000);
    text += form == Form::rows    ? "[" + time + ", " + value + "]"
            : form == Form::named ? R"({"t": )" + time + R"(, "v": )" + value + R"(, "ease": "linear"})"
                                  : "\"k" + std::to_string(i) + "\": " + value;
  }
  return text + (form == Form::members ? "}}" : "]}}}}");
}

void tree(benchmark::State& state, Form form) {
  const std::string text = keys(form, state.range(0));
  double most = 0;
  for (auto _ : state) {
    const std::size_t before = taken;
    peak = taken;
    std::vector<json::Fault> faults;
    const json::Tree tree = json::Tree::parse(text, faults);
    benchmark::DoNotOptimize(tree.root());
    if (!faults.empty()) state.SkipWithError(faults.front().message.c_str());
    most = std::max(most, static_cast<double>(peak - before));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
  state.counters["bytes_per_byte"] = most / static_cast<double>(text.size());
}

void bare_pass(benchmark::State& state, Form form) {
  struct Nothing : nlohmann::json_sax<nlohmann::json> {
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }
  };
  const std::string text = keys(form, state.range(0));
  for (auto _ : state) {
    Nothing nothing;
    benchmark::DoNotOptimize(nlohmann::json::sax_parse(text, &nothing));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

BENCHMARK_CAPTURE(bare_pass, rows, Form::rows)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tree, rows, Form::rows)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bare_pass, named, Form::named)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tree, named, Form::named)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bare_pass, members, Form::members)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tree, members, Form::members)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
