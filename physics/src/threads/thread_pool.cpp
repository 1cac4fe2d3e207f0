#include <tweenfall/physics/executor.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace tweenfall {

namespace threads {
namespace {

constexpr std::size_t most_threads = 256;
/// How long a thread spins for work before it sleeps, and how long before it yields the processor: parts
/// of a step follow each other within microseconds.
constexpr int looks_before_sleep = 4000, looks_before_yield = 400;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

/// Waits while a condition holds that will soon end.
template <class Condition>
void wait_while(const Condition& holds) {
  for (int looks = 0; holds(); ++looks)
    if (looks < looks_before_yield)
      pause();
    else
      std::this_thread::yield();
}

}  // namespace
}  // namespace threads

void SerialExecutor::for_each(std::size_t count, const Work& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

/// One job at a time. A thread that wants to help counts itself in `helpers` before it checks whether the job is open;
/// whoever closed the job waits for all helpers, so that none reads a job that is being replaced.
struct ThreadPool::Implementation {
  std::atomic<std::size_t> size{1};
  std::vector<std::thread> threads;
  std::atomic<bool> busy{false};       ///< a job is being done: another caller does its own alone
  const Work* work = nullptr;          ///< of the job
  std::size_t count = 0;               ///< its parts
  std::atomic<std::size_t> next{0};    ///< part that nobody has taken
  std::atomic<std::uint32_t> open{0};  ///< number of the job; 0 if there is none to help with
  std::atomic<std::uint32_t> bell{0};  ///< changes with every job
  std::atomic<int> helpers{0};
  std::atomic<bool> over{false};

  void take_parts() {
    for (std::size_t part = next.fetch_add(1); part < count; part = next.fetch_add(1)) (*work)(part);
  }

  void help() {
    // More threads than processors would only get in each other's way by spinning.
    const bool crowded = size.load() > std::thread::hardware_concurrency();
    const int last_look = crowded ? 0 : threads::looks_before_sleep;
    std::uint32_t heard = 0;
    for (;;) {
      for (int looks = 0; bell.load() == heard; ++looks) {
        if (looks >= last_look)
          bell.wait(heard);
        else if (looks < threads::looks_before_yield)
          threads::pause();
        else
          std::this_thread::yield();
      }
      if (over.load()) return;
      heard = bell.load();
      helpers.fetch_add(1);
      if (open.load() != 0) take_parts();
      helpers.fetch_sub(1);
    }
  }

  /// Starts as many as possible: with fewer, all work gets done, too.
  void start() {
    threads.reserve(size - 1);
    try {
      while (threads.size() + 1 < size) threads.emplace_back([this] { help(); });
    } catch (const std::system_error&) {
      size = threads.size() + 1;
    }
  }
};

ThreadPool::ThreadPool(std::size_t threads) : implementation_(std::make_unique<Implementation>()) {
  if (threads < 1 || threads > threads::most_threads)
    throw std::invalid_argument("a pool has 1 to " + std::to_string(threads::most_threads) + " threads, not " +
                                std::to_string(threads));
  implementation_->size = threads;
}

ThreadPool::~ThreadPool() {
  Implementation& pool = *implementation_;
  pool.over = true;
  pool.bell.fetch_add(1);
  pool.bell.notify_all();
  for (std::thread& thread : pool.threads) thread.join();
}

std::size_t ThreadPool::threads() const noexcept {
  return implementation_->size;
}

void ThreadPool::for_each(std::size_t count, const Work& work) {
  Implementation& pool = *implementation_;
  if (count <= 1 || pool.busy.exchange(true)) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  if (pool.threads.empty() && pool.size > 1) pool.start();
  pool.work = &work;
  pool.count = count;
  pool.next = 0;
  pool.open = 1;
  pool.bell.fetch_add(1);
  pool.bell.notify_all();
  pool.take_parts();
  pool.open = 0;
  threads::wait_while([&] { return pool.helpers.load() != 0; });
  pool.work = nullptr;
  pool.busy = false;
}

}  // namespace tweenfall
