#include "strategies/separations/separations.h"

#include <algorithm>

namespace tweenfall::strategies {

double Overlap::depth() const {
  double most = 0;
  for (int i = 0; i < count; ++i) most = std::max(most, points[static_cast<std::size_t>(i)].depth);
  return most;
}

void Overlap::part(double by_a, double by_b) {
  a.center -= by_a * normal;
  b.center += by_b * normal;
}

Separates* separation_of(Parting separation) {
  switch (separation) {
    case Parting::soft:
    case Parting::positional_impulse:
      return positional_impulse;
    case Parting::half:
      return half;
    case Parting::by_mass:
      return by_mass;
    case Parting::closest_point:
      return closest_point;
  }
  return nullptr;
}

}  // namespace tweenfall::strategies
