#include "importers/document/document_files.h"

#include <tweenfall/importers/document.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

MassProperties mass_of(const StageDescription& stage, const std::string& name) {
  for (const NodeDescription& node : stage.nodes)
    if (node.name == name && node.body && node.body->mass_properties) return *node.body->mass_properties;
  FAIL("no mass properties for " << name);
  return {};
}

}  // namespace

TEST_CASE("the mass of a body is that of a closed mesh, of points or of an ellipsoid, as closed forms have it") {
  const Document document = Document::read(data_folder() / "documents/good/weighed.json");
  const StageDescription& stage = document.stage();

  // A corner of a box with the edges 3, 2 and 1 m: m (b^2 + c^2) 3/80 and m a b / 80 about the center of mass.
  const MassProperties wedge = mass_of(stage, "wedge");
  CHECK(near(wedge.mass, 6.0, 1e-14));
  CHECK(near(wedge.center, Vec3(0.75, 0.5, 0.25), 1e-13));
  Mat3 expected;
  expected << 5, 0, 0, 0, 10, 0, 0, 0, 13;
  expected *= 6 * 3.0 / 80;
  expected(0, 1) = expected(1, 0) = 6 * 6 / 80.0;
  expected(1, 2) = expected(2, 1) = 6 * 2 / 80.0;
  expected(2, 0) = expected(0, 2) = 6 * 3 / 80.0;
  CHECK((wedge.inertia - expected).cwiseAbs().maxCoeff() < 1e-12);

  // 3 kg at the origin, 2 kg 1 m along x, 1 kg 1 m along y.
  const MassProperties weights = mass_of(stage, "weights");
  CHECK(near(weights.mass, 6.0, 1e-14));
  CHECK(near(weights.center, Vec3(1.0 / 3, 1.0 / 6, 0), 1e-14));
  CHECK(near(weights.inertia(0, 0), 1 - 6.0 / 36, 1e-13));
  CHECK(near(weights.inertia(1, 1), 2 - 6.0 / 9, 1e-13));
  CHECK(near(weights.inertia(2, 2), 3 - 6.0 / 9 - 6.0 / 36, 1e-13));
  CHECK(near(weights.inertia(0, 1), 6.0 / 18, 1e-13));

  const MassProperties egg = mass_of(stage, "egg");
  CHECK(egg.center == Vec3(0, 0.05, 0));
  CHECK(near(Vec3(egg.inertia.diagonal()), Vec3(0.04 + 0.01, 0.09 + 0.01, 0.09 + 0.04), 1e-14));
}
