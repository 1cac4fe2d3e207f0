#include <tweenfall/physics/executor.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
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

/// Bytes that one processor takes from another at once.
constexpr std::size_t line = 64;

/// Number of a job, and a number of parts, in one word: jobs are counted for decades before the number comes again.
constexpr std::uint64_t part_bits = 20, most_parts = (std::uint64_t{1} << part_bits) - 1;

constexpr std::uint64_t pack(std::uint64_t job, std::uint64_t parts) {
  return job << part_bits | parts;
}
/// Whether the first of two jobs came after the second one.
constexpr bool is_later(std::uint64_t packed, std::uint64_t job) {
  return static_cast<std::int64_t>(packed - pack(job, most_parts)) > 0;
}

/// The parts of a job that a thread does before it helps others: the same in job after job, so that what they work on
/// is still near it.
struct alignas(line) Share {
  /// The last job of which a part was taken from it, and the next part. Nobody sets it back: what belongs to an earlier
  /// job has all parts of the present one left.
  std::atomic<std::uint64_t> next{0};

  /// Takes a part that nobody has taken; nothing if there is none, or the job is over.
  std::optional<std::size_t> take(std::uint64_t job, std::size_t begin, std::size_t end) {
    std::uint64_t seen = next.load();
    for (;;) {
      if (is_later(seen, job)) return std::nullopt;
      const std::size_t part = seen >> part_bits == job ? seen & most_parts : begin;
      if (part >= end) return std::nullopt;
      if (next.compare_exchange_weak(seen, pack(job, part + 1))) return part;
    }
  }
};

}  // namespace
}  // namespace threads

void SerialExecutor::for_each(std::size_t count, const Work& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

/// One job at a time. Nobody waits for a thread that has not taken a part: one that comes late finds all of them taken.
/// A part can be taken only while its job goes on, and then the job's work is there; before, it may be another's.
struct ThreadPool::Implementation {
  std::atomic<std::size_t> size{1};
  std::vector<std::thread> threads;
  std::vector<threads::Share> shares;  ///< one for each thread, the caller's first
  std::atomic<bool> busy{false};       ///< a job is being done: another caller does its own alone
  alignas(threads::line) std::atomic<std::uint32_t> bell{0};  ///< changes with every job
  std::atomic<bool> over{false};
  std::atomic<std::uint64_t> job{0};  ///< its number, and of how many parts it is
  std::atomic<const Work*> work{nullptr};
  alignas(threads::line) std::atomic<std::size_t> left{0};  ///< parts that are not known to be done

  /// First those of a thread's own share, then what others have left.
  void take_parts(std::size_t thread) {
    const std::uint64_t packed = job.load();
    const Work* const its_work = work.load();
    const std::uint64_t number = packed >> threads::part_bits;
    const std::size_t count = packed & threads::most_parts, all = shares.size();
    std::size_t done = 0;
    for (std::size_t i = 0; i < all; ++i) {
      const std::size_t owner = (thread + i) % all;
      const std::size_t begin = count * owner / all, end = count * (owner + 1) / all;
      if (begin == end) continue;
      while (const std::optional<std::size_t> part = shares[owner].take(number, begin, end)) {
        (*its_work)(*part);
        ++done;
      }
    }
    if (done > 0) left.fetch_sub(done);
  }

  void help(std::size_t thread) {
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
      // In this order: a ring that is heard here may be the last one.
      heard = bell.load();
      if (over.load()) return;
      take_parts(thread);
    }
  }

  void do_together(std::size_t count, const Work& of_it) {
    left = count;
    work = &of_it;
    job = threads::pack((job.load() >> threads::part_bits) + 1, count);
    bell.fetch_add(1);
    bell.notify_all();
    take_parts(0);
    threads::wait_while([&] { return left.load() != 0; });
  }

  /// Starts as many as possible: with fewer, all work gets done, too.
  void start() {
    threads.reserve(size - 1);
    try {
      while (threads.size() + 1 < size) threads.emplace_back([this, thread = threads.size() + 1] { help(thread); });
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
  implementation_->shares = std::vector<threads::Share>(threads);
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
  for (std::size_t begin = 0; begin < count; begin += threads::most_parts) {
    const auto later = [&](std::size_t part) { work(begin + part); };
    const std::size_t parts = std::min<std::size_t>(count - begin, threads::most_parts);
    pool.do_together(parts, begin == 0 ? work : Work(later));
  }
  pool.busy = false;
}

}  // namespace tweenfall
