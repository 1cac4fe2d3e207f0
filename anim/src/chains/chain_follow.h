#pragma once

#include <tweenfall/anim/joint_chain.h>

namespace tweenfall::chains {

/// As `follow`.
/// @param before  the turns that are remembered; none: the chain begins
/// @param after   the turns to remember, of the same size or none; may be `before`
/// @param since_search  as in `ChainMemory`, before
/// @return              the same, after
double follow_from(const JointChain& chain, const Sample<Vec3>& target, double seconds, const Sample<double>& weight,
                   std::span<const Quat> before, std::span<Quat> after, double since_search,
                   std::span<Motion> pose) noexcept;

}  // namespace tweenfall::chains
