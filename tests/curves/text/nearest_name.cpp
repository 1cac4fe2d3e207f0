// The name that was meant by a wrong one.

#include "support.h"

#include <tweenfall/curves/nearest_name.h>

using namespace tweenfall;

TEST_CASE("edits are counted as Damerau's restricted distance counts them") {
  struct Case {
    const char *a, *b;
    std::size_t edits;
  };
  // The first two are the textbook's; "ca" to "abc" is 3 in the restricted form, 2 in the full one.
  for (const Case& each : std::initializer_list<Case>{{"kitten", "sitting", 3},
                                                      {"saturday", "sunday", 3},
                                                      {"ca", "abc", 3},
                                                      {"teh", "the", 1},
                                                      {"", "four", 4},
                                                      {"four", "", 4},
                                                      {"same", "same", 0},
                                                      {"Ping-Pong", "ping_pong", 0}}) {
    CAPTURE(each.a);
    CAPTURE(each.b);
    CHECK(edit_distance(each.a, each.b) == each.edits);
    CHECK(edit_distance(each.b, each.a) == each.edits);
  }
}

TEST_CASE("the nearest name is named, the first of equals, and none that is far") {
  const std::vector<std::string> names{"ball", "wall", "floor", "left_arm", "left_arm_tip"};
  CHECK(nearest_name("bal", names) == "ball");
  CHECK(nearest_name("call", names) == "ball");
  CHECK(nearest_name("flor", names) == "floor");
  CHECK(nearest_name("Left-Arn", names) == "left_arm");
  CHECK(nearest_name("box", names).empty());
  CHECK(nearest_name("", names).empty());
  CHECK(nearest_name("bal", {}).empty());
}

TEST_CASE("a name cut short is known by its start when none is spelled like it") {
  const std::vector<std::string> names{"oscillation", "position", "positions_of_all"};
  CHECK(nearest_name("pos", names) == "position");
  CHECK(nearest_name("p", names).empty());
}

TEST_CASE("endless names and lists cost no more than long ones") {
  const std::string endless(100000, 'a');
  CHECK(nearest_name(endless, std::vector<std::string>{endless + "b"}).empty());
  CHECK(nearest_name("aa", std::vector<std::string>{endless}).empty());
  std::vector<std::string> many(5000, "something else");
  many.push_back("meant");
  CHECK(nearest_name("maent", many).empty());
  many[4999] = "meant";
  CHECK(nearest_name("maent", many) == "meant");
}
