#include "operations/account.h"
#include "operations/operation.h"

#include <algorithm>

namespace tweenfall::graphs {

namespace {

class Below : public Operation {
 public:
  void pose(const Log&, const Moment&, const Scratch& scratch, std::span<Motion> out) const noexcept override {
    std::ranges::copy(scratch.below, out.begin());
  }
};

}  // namespace

void tell(const RestPose&, Account& account) {
  account.words = "the pose below";
}

std::unique_ptr<Operation> bound(const RestPose&, Binder&) {
  return std::make_unique<Below>();
}

}  // namespace tweenfall::graphs
