#include "eases/ease_row.h"

// All kinds of eases, in the order of the documentation: one row each, defined in the file of its kind.
// clang-format off
#define TWEENFALL_EASES(ROW)                                                                      \
  ROW(hold) ROW(step_next) ROW(linear) ROW(smooth) ROW(smooth_clamped) ROW(monotone) ROW(akima)   \
  ROW(makima) ROW(natural) ROW(clamped) ROW(periodic) ROW(not_a_knot) ROW(catmull_rom)            \
  ROW(catmull_rom_monotone) ROW(uniform) ROW(centripetal) ROW(chordal) ROW(tcb) ROW(nlerp)        \
  ROW(squad) ROW(barry_goldman) ROW(css_ease) ROW(css_ease_in) ROW(css_ease_out)                  \
  ROW(css_ease_in_out) ROW(step_start) ROW(step_end) ROW(bezier) ROW(cubic_bezier) ROW(steps)     \
  ROW(spring)
#define TWEENFALL_EASE_FAMILIES(ROW)                                                              \
  ROW(sine) ROW(quad) ROW(cubic) ROW(quart) ROW(quint) ROW(poly) ROW(exponential) ROW(circular)   \
  ROW(back) ROW(elastic) ROW(penner_elastic) ROW(bounce)
// clang-format on

namespace tweenfall::eases {

#define TWEENFALL_DECLARE(name) extern const Row name##_row;
TWEENFALL_EASES(TWEENFALL_DECLARE)
#undef TWEENFALL_DECLARE
#define TWEENFALL_DECLARE(name) extern const FamilyRow name##_family;
TWEENFALL_EASE_FAMILIES(TWEENFALL_DECLARE)
#undef TWEENFALL_DECLARE

std::span<const Row* const> rows() noexcept {
#define TWEENFALL_ADDRESS(name) &name##_row,
  static constexpr const Row* all[] = {TWEENFALL_EASES(TWEENFALL_ADDRESS)};
#undef TWEENFALL_ADDRESS
  return all;
}

std::span<const FamilyRow* const> families() noexcept {
#define TWEENFALL_ADDRESS(name) &name##_family,
  static constexpr const FamilyRow* all[] = {TWEENFALL_EASE_FAMILIES(TWEENFALL_ADDRESS)};
#undef TWEENFALL_ADDRESS
  return all;
}

#undef TWEENFALL_EASES
#undef TWEENFALL_EASE_FAMILIES

}  // namespace tweenfall::eases
