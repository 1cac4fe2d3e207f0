#include "stage/whole_pose.h"

namespace tweenfall::staging {

const Motion& WholePose::local(NodeId node) {
  if (local_.empty()) {
    local_.resize(state_.nodes->size());
    state_.animation->sample(time_, local_, side_);
  }
  return local_[node];
}

const WorldMotion& WholePose::authored(NodeId node) {
  if (world_.empty()) {
    static_cast<void>(local(node));
    world_.resize(local_.size());
    state_.nodes->world_motions(local_, world_);
  }
  return world_[node];
}

bool WholePose::follows(const StagedBody& body) const {
  return body.path.clock() == ClockOverride{} && body.path.side_at(time_, side_) == side_;
}

Motion WholePose::at(const StagedBody& body) {
  return follows(body) ? body.path.at(time_, authored(body.node), side_) : body.path.at(time_, side_);
}

WorldMotion WholePose::world(const StagedBody& body) {
  return body.sized(time_,
                    follows(body) ? body.path.world(time_, authored(body.node), side_) : body.path.world(time_, side_));
}

}  // namespace tweenfall::staging
