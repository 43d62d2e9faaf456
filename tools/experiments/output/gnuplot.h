// Plots, drawn by gnuplot.
#ifndef DPE_TOOLS_EXPERIMENTS_OUTPUT_GNUPLOT_H_
#define DPE_TOOLS_EXPERIMENTS_OUTPUT_GNUPLOT_H_

#include <string>

#include "experiments/experiment.h"

namespace dpe::experiments {

// The script that draws a plot into an SVG file, its data included. What is not finite,
// and on a logarithmic axis not positive, is left out; series without any point are,
// too. Empty if nothing is left.
std::string GnuplotScript(const Plot& plot, const std::string& svg_path);

// Draws DIR/NAME.svg; the script stays beside it in DIR/plots/NAME.gp.
// @return "" if it is there, else why not: gnuplot is missing, or what it says
std::string DrawPlot(const Plot& plot, const std::string& dir);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_OUTPUT_GNUPLOT_H_
