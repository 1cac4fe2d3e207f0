#pragma once

#include <span>
#include <vector>

#include "blocks/coloring.h"
#include "blocks/contact_block.h"
#include "blocks/island_body.h"
#include "step/contact_constraint.h"
#include "step/meeting.h"

namespace tweenfall::blocks {

/// The contacts of an island, four at a time, by color.
class ContactBlocks {
 public:
  /// Sorts the contacts and begins with the impulses that they kept.
  /// @param places  from a body's index to its place in `bodies`
  void build(std::span<step::ContactConstraint* const> contacts, const std::vector<std::uint32_t>& places,
             const std::vector<IslandBody>& bodies, const std::vector<forces::Load>& loads, double h, double dt);
  /// Tells the rows of one contact how its bodies lie now.
  void prepare(ContactBlock& block, int lane, const std::vector<IslandBody>& bodies, const BodyLanes* displacements);
  /// Gives the impulses back to the contacts.
  void store(double h);

  std::vector<ContactBlock> blocks;
  std::vector<PointRow> points;
  std::vector<FrictionRow> frictions;

 private:
  void fill(ContactBlock& block, int lane, step::ContactConstraint& contact, const std::vector<std::uint32_t>& places,
            const std::vector<IslandBody>& bodies, const step::Closing& closing, double h);

  Coloring coloring_;
  std::vector<std::uint32_t> keys_, counts_;
  std::vector<step::ContactConstraint*> sorted_;
};

}  // namespace tweenfall::blocks
