#pragma once

// The marks on the curves of a plot: keys with their handles, moments, texts, colors, and a legend.

#include "plot/plot_panel.h"
#include "plot/plotted_track.h"

namespace tweenfall::plotting {

/// Diamonds at the keys, with their handles or, where they have none, short lines along the slopes.
void draw_keys(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted);

/// Lines across the panel at events and hand-offs; their names, to be drawn over the curves.
void draw_moments(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted);
void draw_moment_names(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted);

void draw_texts(SvgWriter& svg, const Panel& panel, const StepCurve<std::string>& curve);

/// The colors themselves, along the top of the frame.
void draw_colors(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted);

/// One line that shows each mark used in the plot beside its name.
void draw_legend(SvgWriter& svg, const PlottedStage& plotted, double x, double y);

}  // namespace tweenfall::plotting
