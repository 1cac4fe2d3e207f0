#include "recording/recording_model.h"

namespace tweenfall {

Model recording_model(const Recording&, const StageDescription&) { return {}; }

}  // namespace tweenfall
