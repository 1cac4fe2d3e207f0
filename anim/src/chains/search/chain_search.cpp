#include "chains/search/chain_search.h"

#include "chains/search/limited_descent.h"

#include <algorithm>
#include <limits>

namespace tweenfall::chains {
namespace {

using Plain = LimitedDescent<double>;
using Exact = LimitedDescent<Dual>;

constexpr int steps_down = 60, many_ways = 64;
constexpr double arrived = 1e-9, same = 1e-8;  // of the chain's length

// A way down: from the drawn pose of that number, or from where the chain is.
struct Way {
  int number = -1;
  double share = 1;
};

void go(const Way& way, double no_worse, Plain& plain) noexcept {
  if (way.number < 0)
    plain.begin();
  else
    plain.begin(way.number, way.share);
  plain.run(steps_down, no_worse);
}

// Where a way led, with rates. Of the poses there that are as near, which may be many, that of the way means nothing:
// what is taken is where the joints are turned least from where they are in the shape. For that they are held there,
// weakly, and then let go: Newton steps lead from there straight to the nearest. That is a smooth function of the shape
// and the target, whose rates the last steps carry. Where few poses are as near, what is held weakly is not near
// enough: then ever more weakly.
void take(const Plain& plain, const Arrow& target, ChainShape& shape) noexcept {
  constexpr double strengths[] = {1e-5, 1e-7, 1e-9}, damping = 1e-9;
  constexpr double worse = 2e-7;  // of the chain's length
  const double nearest = plain.distance(), reach = shape.reach().v;
  Plain held(shape, target);
  held.begin(plain);
  Exact exact(shape, target);
  for (const double strength : strengths) {
    held.hold(strength);
    held.run(steps_down, std::numeric_limits<double>::infinity());
    exact.begin(held);
    exact.hold(strength);
    exact.settle(4, 0, false);
    exact.hold(0);
    exact.settle(10, 2 * strength, true);
    if (exact.distance() <= nearest + worse * reach) break;
  }
  if (!(exact.distance() <= nearest + worse * reach)) {
    exact.begin(plain);
    exact.settle(4, damping, false);
  }
  for (std::size_t i = 0; i < shape.count(); ++i) shape.turn(i, exact.turn(i));
  shape.place();
}

// Whether no pose at all could bring the end nearer, for the lengths of the bones alone.
bool is_stretched(const Arrow& target, const ChainShape& shape, double distance) noexcept {
  const double far = (target.v - shape.at(0).v).norm(), reach = shape.reach().v;
  double longest = 0;
  for (std::size_t i = 0; i < shape.count(); ++i) longest = std::max(longest, shape.length(i).v);
  return distance <= std::max(far - reach, 2 * longest - reach - far) + 1e-9 * reach;
}

}  // namespace

bool is_searchable(const ChainShape& shape) noexcept {
  return Plain::coordinates_of(shape) <= Plain::room;
}

void descend(const Arrow& target, ChainShape& shape) noexcept {
  Plain plain(shape, target);
  go({}, std::numeric_limits<double>::infinity(), plain);
  take(plain, target, shape);
}

void search_everywhere(const Arrow& target, ChainShape& shape) noexcept {
  // What is missed by little may yet be reached from few places, where the joints can turn in few ways.
  constexpr double little = 0.02;  // of the chain's length
  const int more = Plain::coordinates_of(shape) <= 6 ? 400 : many_ways;
  const double reach = shape.reach().v;
  Plain plain(shape, target);
  Way best;
  double least = std::numeric_limits<double>::infinity();
  for (int number = -1; number < (least < little * reach ? more : many_ways); ++number) {
    const Way way{.number = number};
    go(way, least, plain);
    if (!(plain.distance() < least - same * reach)) continue;
    best = way;
    least = plain.distance();
    if (least <= arrived * reach || is_stretched(target, shape, least)) break;
  }
  go(best, std::numeric_limits<double>::infinity(), plain);
  take(plain, target, shape);
}

void search_from_here(const Arrow& target, ChainShape& shape) noexcept {
  constexpr double matters = 1e-6;  // of the chain's length
  // How far it goes from where it is toward what is drawn: of the poses at the target that are found from near by, the
  // one that turns the joints least is taken.
  constexpr double shares[] = {0.1, 0.2, 0.4, 1};
  constexpr int each = 16;
  const double reach = shape.reach().v;
  Plain plain(shape, target);
  Way best;
  double least = length(target - shape.end()).v, nearest = least - matters * reach;
  double turned = std::numeric_limits<double>::infinity();
  bool any = false, reached = false;
  int number = 0;
  for (const double share : shares) {
    for (const int end = number + (share < 1 ? each : many_ways); number < end && !(reached && share == 1); ++number) {
      const Way way{.number = number, .share = share};
      go(way, reached ? arrived * reach : least, plain);
      const double distance = plain.distance();
      if (distance <= arrived * reach) {
        const double by = plain.turned();
        if (reached && !(by < turned)) continue;
        reached = any = true;
        turned = by;
        best = way;
        least = distance;
      } else if (!reached && distance < nearest) {
        any = true;
        best = way;
        least = distance;
        nearest = distance - same * reach;
      }
    }
    if (reached) break;
  }
  if (!any) return;
  go(best, std::numeric_limits<double>::infinity(), plain);
  take(plain, target, shape);
}

}  // namespace tweenfall::chains
