// attack KIND [--count N] [--from K] [--seed S] [--jobs J]   run cases of a kind, each job in a process of its own
// attack KIND --show K [--seed S]                            print what case K feeds to the program
//
// KIND: documents, unchanged, graphs, inputs, commands, stage, or the ending of models: .gltf, .glb, .fbx, .bvh, .dae,
// .obj. A case that crashes, takes more than 10 s of a processor, 100 s of the clock or 4 GB is reported by its number,
// and the run continues after it.

#include "attack/attack.h"

#include <CLI/CLI.hpp>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>
#include <thread>

#ifndef __has_feature
#define __has_feature(x) 0
#endif

namespace tweenfall::attack {

namespace {

constexpr double most_seconds = 30;         // of a processor: sanitizers and a slow one take several times as long
constexpr double most_clock_seconds = 100;  // for waiting, and for programs that a case starts
constexpr rlim_t most_bytes = rlim_t{4} << 30;

std::unique_ptr<Attack> attack_of(const std::string& kind, std::uint64_t seed) {
  if (kind == "documents") return attack_documents(seed);
  if (kind == "unchanged") return attack_unchanged();
  if (kind == "graphs") return attack_graphs(seed);
  if (kind == "inputs") return attack_inputs(seed);
  if (kind == "commands") return attack_commands(seed);
  if (kind == "stage") return attack_stage(seed);
  return attack_models(seed, kind);
}

/// What a worker reports to its parent, in memory that both share.
struct Progress {
  std::atomic<std::uint64_t> next{0};  ///< the present case
  std::atomic<std::uint64_t> faults{0};
  std::atomic<std::uint64_t> most_kilobytes{0};
  std::atomic<std::uint64_t> taken{0};
};

void work(const std::string& kind, std::uint64_t seed, std::uint64_t from, std::uint64_t to, std::uint64_t stride,
          Progress& progress) {
#if !defined(__SANITIZE_ADDRESS__) && !__has_feature(address_sanitizer)
  // A sanitizer reserves more than any limit before it begins.
  const rlimit memory{most_bytes, most_bytes};
  setrlimit(RLIMIT_AS, &memory);
#endif
  const std::unique_ptr<Attack> attack = attack_of(kind, seed);
  std::uint64_t taken = 0;
  for (std::uint64_t number = from; number < to; number += stride) {
    progress.next = number;
    std::string fault;
    try {
      fault = attack->run(number);
    } catch (const std::bad_alloc&) {
      fault = "memory ran out";
    } catch (const std::exception& error) {
      fault = error.what();
    }
    if (!fault.empty()) {
      ++progress.faults;
      std::printf("case %llu: %s\n", static_cast<unsigned long long>(number), fault.c_str());
      std::fflush(stdout);
    }
    progress.taken += attack->taken() - taken;
    taken = attack->taken();
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    progress.most_kilobytes = static_cast<std::uint64_t>(used.ru_maxrss);
  }
  progress.next = to;
}

double processor_seconds(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Result {
  std::uint64_t faults = 0, taken = 0, most_kilobytes = 0;
};

/// Memory shared by a process and those it starts.
template <class T>
T* shared(std::size_t count) {
  void* memory = mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  T* first = static_cast<T*>(memory);
  for (std::size_t i = 0; i < count; ++i) new (first + i) T;
  return first;
}

/// Runs one worker until its cases are done, over crashes and hangs.
Result watch(const std::string& kind, std::uint64_t seed, std::uint64_t from, std::uint64_t to, std::uint64_t stride) {
  Progress* const progress = shared<Progress>(1);
  Result result;
  while (from < to) {
    progress->next = from;
    const pid_t worker = fork();
    if (worker == 0) {
      work(kind, seed, from, to, stride, *progress);
      std::fflush(nullptr);
      _exit(0);
    }
    std::uint64_t at = from;
    double waited = 0, began = 0;
    int status = 0;
    bool hung = false;
    while (waitpid(worker, &status, WNOHANG) == 0) {
      usleep(50'000);
      const double worked = processor_seconds(worker);
      waited += 0.05;
      if (progress->next != at) {
        at = progress->next;
        waited = 0;
        began = worked;
      }
      if (worked - began <= most_seconds && waited <= most_clock_seconds) continue;
      hung = true;
      kill(worker, SIGKILL);
      waitpid(worker, &status, 0);
      break;
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder_of_process(worker), ignored);
    at = progress->next;
    result.most_kilobytes = std::max<std::uint64_t>(result.most_kilobytes, progress->most_kilobytes);
    if (!hung && WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    ++result.faults;
    std::printf("case %llu: %s\n", static_cast<unsigned long long>(at), hung ? "took too long" : "crashed");
    std::fflush(stdout);
    from = at + stride;
  }
  result.faults += progress->faults;
  result.taken = progress->taken;
  return result;
}

int run(int argc, char** argv) {
  CLI::App app("Attacks the toolkit with cases made from a seed; each can be run again by its number.");
  std::string kind;
  std::uint64_t count = 1000, from = 0, seed = 1, show = 0;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("kind", kind,
                 "documents, unchanged, graphs, inputs, commands, stage, or an ending of models such as .fbx")
      ->required();
  const CLI::Option* counting =
      app.add_option("--count", count, "how many cases (unchanged: all)")->capture_default_str();
  app.add_option("--from", from, "the first case")->capture_default_str();
  app.add_option("--seed", seed, "other cases")->capture_default_str();
  app.add_option("--jobs", jobs, "processes at once")->capture_default_str();
  const CLI::Option* showing = app.add_option("--show", show, "print what this case feeds to the program, and end");
  CLI11_PARSE(app, argc, argv);
  if (showing->count()) {
    const std::string text = attack_of(kind, seed)->show(show);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
  }

  if (const std::uint64_t size = attack_of(kind, seed)->size(); size > 0)
    count = std::min(counting->count() ? count : size, size - std::min(from, size));

  // Processes rather than threads: forking while another thread allocates memory leaves the child a lock forever.
  Result* const results = shared<Result>(jobs);
  std::vector<pid_t> watchers;
  for (unsigned job = 0; job < jobs; ++job) {
    watchers.push_back(fork());
    if (watchers.back() != 0) continue;
    results[job] = watch(kind, seed, from + job, from + count, jobs);
    std::fflush(nullptr);
    _exit(0);
  }
  Result all;
  for (unsigned job = 0; job < jobs; ++job) {
    int status = 0;
    waitpid(watchers[job], &status, 0);
    all.faults += results[job].faults + (WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : 1);
    all.taken += results[job].taken;
    all.most_kilobytes = std::max(all.most_kilobytes, results[job].most_kilobytes);
  }
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf("%s: %llu cases, %llu of them taken, %llu went wrong, at most %llu MB\n", kind.c_str(), number(count),
              number(all.taken), number(all.faults), number(all.most_kilobytes / 1024));
  return all.faults ? 1 : 0;
}

}  // namespace

}  // namespace tweenfall::attack

int main(int argc, char** argv) {
  try {
    return tweenfall::attack::run(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "attack: %s\n", problem.what());
    return 2;
  }
}
