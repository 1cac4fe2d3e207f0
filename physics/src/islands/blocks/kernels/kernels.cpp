#include <array>
#include <cstddef>

#include "islands/blocks/kernels/arrival_work.h"
#include "islands/blocks/kernels/ball_work.h"
#include "islands/blocks/kernels/contact_work.h"
#include "islands/blocks/kernels/preparing_work.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::blocks {

namespace {

/// Operations on blocks, in registers of one kind.
template <class Register>
struct RowWork {
  using Contacts = ContactWork<Register>;
  using BallPairs = BallWork<Register>;
  using Arrivals = ArrivalWork<Register>;

  struct WarmStart {
    const Rows& rows;
    TWEENFALL_LANES void operator()(ContactBlock& block) const {
      if (block.even)
        Contacts::template warm_start_block<true>(rows, block);
      else
        Contacts::template warm_start_block<false>(rows, block);
    }
    TWEENFALL_LANES void operator()(BallBlock& block) const { BallPairs::warm_start_balls(rows, block); }
  };
  struct Solve {
    const Rows& rows;
    const PassRule& rule;
    TWEENFALL_LANES void operator()(ContactBlock& block) const {
      if (block.even)
        Contacts::template solve_block<true>(rows, block, rule);
      else
        Contacts::template solve_block<false>(rows, block, rule);
    }
    TWEENFALL_LANES void operator()(BallBlock& block) const { BallPairs::solve_balls(rows, block, rule); }
  };
  struct Hold {
    const Rows& rows;
    TWEENFALL_LANES void operator()(const ContactBlock& block) const { Arrivals::hold_block(rows, block); }
    TWEENFALL_LANES void operator()(const BallBlock& block) const { Arrivals::hold_balls(rows, block); }
  };
};

/// Balls and blocks of two movable bodies first, then those of one.
template <class Work>
TWEENFALL_LANES void do_all(const Rows& rows, const Work& work) {
  for (std::size_t i = 0; i < rows.ball_pairs; ++i) work(rows.balls[i]);
  for (std::size_t i = 0; i < rows.pairs; ++i) work(rows.blocks[i]);
  for (std::size_t i = rows.ball_pairs; i < rows.ball_count; ++i) work(rows.balls[i]);
  for (std::size_t i = rows.pairs; i < rows.count; ++i) work(rows.blocks[i]);
}

// The same source for each instruction set. None of them fuses a multiplication and an addition here, so the bits are
// the same.
#define TWEENFALL_KERNELS(name, Numbers, target)                     \
  target void warm_start_##name(const Rows& rows) {                  \
    do_all(rows, RowWork<Numbers>::WarmStart{rows});                 \
  }                                                                  \
  target void solve_##name(const Rows& rows, const PassRule& rule) { \
    do_all(rows, RowWork<Numbers>::Solve{rows, rule});               \
  }                                                                  \
  target void hold_##name(const Rows& rows) {                        \
    do_all(rows, RowWork<Numbers>::Hold{rows});                      \
  }
// Few lanes of a block turn far in the same sub-step: four at a time are worth looking at.
#define TWEENFALL_PREPARING(name, Four_, target)                                                              \
  target void prepare_##name(const Rows& rows) {                                                              \
    for (std::size_t i = 0; i < rows.count; ++i)                                                              \
      PreparingWork<Halves<Four_>>::prepare_block(rows, rows.blocks[i], rows.origins[i]);                     \
  }                                                                                                           \
  target void prepare_again_##name(const Rows& rows, bool given) {                                            \
    for (std::size_t i = 0; i < rows.count; ++i) {                                                            \
      const Mask stale = stale_lanes(rows, rows.blocks[i], rows.origins[i]);                                  \
      PreparingWork<LanesFrom<Four_, 0>>::prepare_again(rows, rows.blocks[i], rows.origins[i], stale, given); \
      PreparingWork<LanesFrom<Four_, 4>>::prepare_again(rows, rows.blocks[i], rows.origins[i], stale, given); \
    }                                                                                                         \
  }
#define TWEENFALL_MEETINGS(name, Numbers, target)                                                                      \
  target std::size_t find_meetings_##name(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found) { \
    return ArrivalWork<Numbers>::find_meetings(rows, starts, h, found);                                                \
  }

TWEENFALL_KERNELS(plain, Halves<Halves<Two>>, )
TWEENFALL_MEETINGS(plain, Halves<Halves<Two>>, )
TWEENFALL_PREPARING(plain, Halves<Two>, )
constexpr Kernels plain = {prepare_plain, prepare_again_plain, warm_start_plain,
                           solve_plain,   hold_plain,          find_meetings_plain};
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_KERNELS(avx2, Halves<Four>, [[gnu::target("avx2")]])
TWEENFALL_MEETINGS(avx2, Halves<Four>, [[gnu::target("avx2")]])
TWEENFALL_PREPARING(avx2, Four, [[gnu::target("avx2")]])
constexpr Kernels avx2 = {prepare_avx2, prepare_again_avx2, warm_start_avx2, solve_avx2, hold_avx2, find_meetings_avx2};
TWEENFALL_KERNELS(avx512, Eight, [[gnu::target("avx512f,avx512vl,avx512dq")]])
TWEENFALL_MEETINGS(avx512, Eight, [[gnu::target("avx512f,avx512vl,avx512dq")]])
constexpr Kernels avx512 = {prepare_avx2, prepare_again_avx2, warm_start_avx512,
                            solve_avx512, hold_avx512,        find_meetings_avx512};
#endif

}  // namespace

std::span<const Kernels* const> possible_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain, &avx2, &avx512};
#else
  static constexpr std::array all = {&plain};
#endif
  return std::span(all).first(possible_versions());
}

const Kernels& fastest_kernels() {
  static const Kernels& fastest = *possible_kernels().back();
  return fastest;
}

}  // namespace tweenfall::blocks
