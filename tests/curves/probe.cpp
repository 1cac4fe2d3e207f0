#include "support.h"
TEST_CASE("one is one") { MESSAGE("SKIPPED: nothing really"); CHECK(1 == 1); }
