#pragma once

/// Stands in `curves` now; this header leads there.

#include <tweenfall/curves/nearest_name.h>
