#pragma once

/// Who does the parts of a step: the calling thread, a pool of threads, or a job system of the caller's own.
/// The result of a step never depends on it, not in one bit.

#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace tweenfall {

/// Work in numbered parts, which can be done in any order and at the same time. Refers to a callable that must outlive
/// it.
class Work {
 public:
  template <class Callable>
  requires(!std::same_as<std::remove_cvref_t<Callable>, Work> &&
           std::invocable<const Callable&, std::size_t>) explicit Work(const Callable& callable)
      : callable_(&callable),
        call_([](const void* of, std::size_t part) { (*static_cast<const Callable*>(of))(part); }) {}

  void operator()(std::size_t part) const { call_(callable_, part); }

 private:
  const void* callable_;
  void (*call_)(const void*, std::size_t);
};

class Executor {
 public:
  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor() = default;

  /// Calls `work(i)` once for each i from 0 to count - 1, in any order and on any threads, and returns when all calls
  /// have returned. `work` throws nothing. Worlds that share an executor may call this at the same time.
  virtual void for_each(std::size_t count, const Work& work) = 0;
  /// About how many parts it does at the same time; >= 1.
  [[nodiscard]] virtual std::size_t threads() const noexcept = 0;
};

/// The calling thread, one part after the other.
class SerialExecutor final : public Executor {
 public:
  void for_each(std::size_t count, const Work& work) override;
  [[nodiscard]] std::size_t threads() const noexcept override { return 1; }
};

/// The calling thread and others, which wait for work until the pool is destroyed.
class ThreadPool final : public Executor {
 public:
  /// @param threads  including the calling thread. @throws std::invalid_argument for none, or more than 256
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool() override;

  void for_each(std::size_t count, const Work& work) override;
  [[nodiscard]] std::size_t threads() const noexcept override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tweenfall
