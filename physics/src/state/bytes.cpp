#include "state/bytes.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace tweenfall::state {

namespace {

/// Before a hull that has not been written yet.
constexpr std::uint32_t new_hull = 0xffffffff;

}  // namespace

void ByteWriter::hull(const ConvexHull& hull) {
  const auto [known, added] = hulls_.try_emplace(hull.vertices().data(), static_cast<std::uint32_t>(hulls_.size()));
  number(added ? new_hull : known->second);
  if (!added) return;
  number(static_cast<std::uint64_t>(hull.vertices().size()));
  for (const Vec3& vertex : hull.vertices()) walk(*this, vertex);
  number(static_cast<std::uint64_t>(hull.faces().size()));
  for (const ConvexHull::Face& face : hull.faces()) {
    number(static_cast<std::uint64_t>(face.corners));
    for (const std::uint32_t corner : hull.corners(face)) number(corner);
  }
}

void ByteWriter::field(const Field&) {
  throw std::invalid_argument(
      "a world with a field cannot be saved, for a field is a function: take it away with remove_force, and add it "
      "again after loading");
}

Hull ByteReader::read_hull() {
  std::uint32_t index = 0;
  number(index);
  if (index != new_hull) {
    require(index < hulls_.size(), "there is no such hull");
    return Hull{hulls_[index]};
  }
  std::vector<Vec3> vertices;
  list(vertices);
  std::vector<std::vector<std::uint32_t>> faces;
  list(faces);
  return Hull{hulls_.emplace_back(vertices, faces)};
}

Compound ByteReader::read_compound() {
  require(!in_compound_, "a compound is a part of another one");
  in_compound_ = true;
  std::vector<Shape> parts;
  list(parts);
  in_compound_ = false;
  return Compound(std::move(parts));
}

void ByteReader::field(Field&) {
  require(false, "a field cannot have been saved");
  throw std::logic_error("a field was read");
}

std::uint64_t ByteReader::count() {
  std::uint64_t count = 0;
  number(count);
  require(count <= bytes_.size() - place_, "it tells of more than there is room for");
  return count;
}

void ByteReader::require(bool holds, const char* what) const {
  if (!holds)
    throw std::invalid_argument(std::string("a saved ") + kind_ + " is wrong at byte " + std::to_string(place_) +
                                " of its contents: " + what);
}

}  // namespace tweenfall::state
