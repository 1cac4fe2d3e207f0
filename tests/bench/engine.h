#pragma once

// A scene in some engine, which is stepped and asked where everything is.

#include <tweenfall/physics/world.h>

#include <memory>

namespace tweenfall::test {
struct Scene;
}

namespace tweenfall::bench {

class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;
  virtual void step() = 0;
  /// Of the scene's body with this index; its twist at the center of mass.
  [[nodiscard]] virtual Motion motion(std::size_t body) const = 0;
};

/// The scene in Bullet with its default settings, except that nothing ever sleeps.
[[nodiscard]] std::unique_ptr<Engine> in_bullet(const test::Scene& scene);

}  // namespace tweenfall::bench
