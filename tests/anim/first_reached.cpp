#include "operations/first_reached.h"

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("what is reached near a guess is found by few questions, and anywhere else too, to the same bit") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double before = i % 3 == 0 ? 0 : random.unit(), time = before + random.unit() + 1e-9;
    const double moment = before + (time - before) * random.unit();
    int asked = 0;
    const auto reached = [&](double at) {
      ++asked;
      return at >= moment && at > before;
    };
    const double found = graphs::first_reached(before, time, reached);
    CHECK(found == std::max(moment, std::nextafter(before, 2.0)));
    asked = 0;
    CHECK(graphs::first_reached(before, time, moment * (1 + 1e-15), reached) == found);
    CHECK(asked <= 8);
    // A guess that is far off, or none, costs time alone.
    for (const double guess : {before, time, 0.5 * (before + time), -1.0, std::nan("")})
      CHECK(graphs::first_reached(before, time, guess, reached) == found);
  }
}
