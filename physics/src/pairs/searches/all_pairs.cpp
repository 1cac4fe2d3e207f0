#include "pairs/searches/searches.h"

namespace tweenfall::pairs {

/// Every box with every other: n (n - 1) / 2 of them.
void all_pairs(Search& search) {
  for (std::size_t a = 0; a < search.items.size(); ++a)
    for (std::size_t b = a + 1; b < search.items.size(); ++b) search.test(a, b);
}

}  // namespace tweenfall::pairs
