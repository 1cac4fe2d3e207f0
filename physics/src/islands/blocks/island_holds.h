#pragma once

#include <vector>

#include "islands/blocks/contact_blocks.h"
#include "islands/blocks/island_body.h"
#include "islands/island_contents.h"
#include "step/solver_body.h"

namespace tweenfall::blocks {

/// What holds bodies of an island besides contacts and joints: drives, stiff springs, resistance to rolling.
class IslandHolds {
 public:
  /// Softens the pull of drives without a limit, so that contacts and joints have to move what they hold, too.
  /// @param driven  a drive holds some body
  void gather(const islands::IslandContents& island, const std::vector<state::Body>& bodies,
              const std::vector<std::uint32_t>& places, std::vector<IslandBody>& entries, bool driven, double h);
  /// Finds resistances to rolling, with the impulses that they kept.
  /// @param rolls  some contact resists
  void gather(const ContactBlocks& contacts, bool rolls, double h);
  [[nodiscard]] bool empty() const { return drives_.empty() && springs_.empty() && rolls_.empty(); }

  /// @param ahead  time from the end of the sub-step to that of the step, s
  void begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& entries,
                      std::vector<BodyLanes>& velocities, double ahead);
  void solve(const std::vector<state::Body>& bodies, std::vector<IslandBody>& entries, const ContactBlocks& contacts,
             std::vector<BodyLanes>& velocities);
  /// Adds up the impulses of the sub-step.
  void add_up() const;
  /// Returns the rolling impulses to the contacts.
  void store() const;

 private:
  struct HeldByDrive {
    std::uint32_t place = 0;
    bool without_limit = false;
    Vec3 impulse{0, 0, 0}, angular_impulse{0, 0, 0};  ///< of the sub-step, N s and N m s
  };
  struct HeldBySpring {
    step::SpringRow* row = nullptr;
    std::uint32_t a = 0, b = 0;  ///< places
  };
  struct Rolling {
    contacts::ContactConstraint* contact = nullptr;
    std::uint32_t lane = 0;      ///< 8 * block + lane; balls come after all blocks
    std::uint32_t a = 0, b = 0;  ///< places
  };
  void solve_drive(HeldByDrive& held, const std::vector<state::Body>& bodies, std::vector<IslandBody>& entries,
                   std::vector<BodyLanes>& velocities) const;

  std::vector<HeldByDrive> drives_;
  std::vector<HeldBySpring> springs_;
  std::vector<Rolling> rolls_;
  double h_ = 0, ahead_ = 0;
};

}  // namespace tweenfall::blocks
