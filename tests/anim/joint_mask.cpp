#include <tweenfall/anim/joint_mask.h>

#include "support.h"

using namespace tweenfall;

namespace {

/// hips -> (spine -> (arm.L -> hand.L, arm.R -> hand.R), leg.L, leg.R)
Hierarchy figure() {
  return Hierarchy(
      {{"hips"}, {"spine", 0}, {"arm.L", 1}, {"hand.L", 2}, {"arm.R", 1}, {"hand.R", 4}, {"leg.L", 0}, {"leg.R", 0}});
}

std::vector<double> weights(const JointMask& mask) {
  return {mask.weights().begin(), mask.weights().end()};
}

}  // namespace

TEST_CASE("a mask gives its weights to the joints that a name or a pattern says, and elsewhere to the others") {
  const std::vector<MaskPart> parts{{.joints = "*.L", .weight = 0.75}, {.joints = "spine", .weight = 0.5}};
  CHECK(weights(JointMask(figure(), parts)) == std::vector<double>{0, 0.5, 0.75, 0.75, 0, 0, 0.75, 0});
  CHECK(weights(JointMask(figure(), parts, 0.25)) ==
        std::vector<double>{0.25, 0.5, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25});
}

TEST_CASE("a part of a mask reaches everything below its joints, and a later part prevails") {
  const std::vector<MaskPart> parts{{.joints = "spine", .below = true},
                                    {.joints = "arm.R", .weight = 0.5, .below = true}};
  CHECK(weights(JointMask(figure(), parts)) == std::vector<double>{0, 1, 1, 1, 0.5, 0.5, 0, 0});
  const std::vector<MaskPart> whole{{.joints = "arm.R", .weight = 0.5}, {.joints = "hips", .below = true}};
  CHECK(weights(JointMask(figure(), whole)) == std::vector<double>(8, 1));
}

TEST_CASE("masks are combined by product, by the larger weight, and by the opposite") {
  const JointMask a(std::vector<double>{0, 0.5, 1}), b(std::vector<double>{1, 0.5, 0.25});
  CHECK(weights(both(a, b)) == std::vector<double>{0, 0.25, 0.25});
  CHECK(weights(either(a, b)) == std::vector<double>{1, 0.5, 1});
  CHECK(weights(opposite(b)) == std::vector<double>{0, 0.5, 0.75});
  CHECK(both(a, JointMask()) == a);
  CHECK(either(JointMask(), b) == JointMask(std::vector<double>{1, 1, 1}));
  CHECK_THROWS_WITH_AS((void)both(a, JointMask(std::vector<double>{1})),
                       "masks of 3 and of 1 nodes do not fit each other", std::invalid_argument);
  CHECK_THROWS_AS((void)opposite(JointMask()), std::invalid_argument);
}

TEST_CASE("a default mask reaches every node fully") {
  CHECK(JointMask()[0] == 1);
  CHECK(JointMask()[1000] == 1);
}

TEST_CASE("a mask lists every pattern that names no joint and every weight that is none") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<MaskPart> parts{
      {.joints = "hnd.L"}, {.joints = "tail/*"}, {.joints = "spine", .weight = 1.5}, {.joints = "", .weight = none}};
  CHECK_THROWS_WITH_AS(JointMask(figure(), parts, -0.5),
                       "a mask does not fit its nodes:\n"
                       "  the weight elsewhere must be 0 to 1; it is -0.5\n"
                       "  no joint is named \"hnd.L\"; did you mean \"hand.L\"?\n"
                       "  no joint matches \"tail/*\"\n"
                       "  the weight of \"spine\" must be 0 to 1; it is 1.5\n"
                       "  the weight of \"\" must be 0 to 1; it is nan\n"
                       "  no joint is named \"\"",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(JointMask(std::vector<double>{0, 2}),
                       "a mask has invalid weights:\n  the weight of node 1 must be 0 to 1; it is 2",
                       std::invalid_argument);
}
