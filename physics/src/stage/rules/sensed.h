#pragma once

#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Reports what entered sensors in the world's last step, and what left them.
void report_sensed(const StageState& state, std::vector<Happening>& happenings);

/// Whether in the world's last step something that the trigger names entered a sensor that it names, or left it.
[[nodiscard]] bool has_entered(const StageState& state, const when::Enter& enter, const BodyId& own);
[[nodiscard]] bool has_left(const StageState& state, const when::Leave& leave, const BodyId& own);

}  // namespace tweenfall::staging
