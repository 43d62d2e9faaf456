#include "experiments/output/gnuplot.h"

#include <cmath>
#include <filesystem>
#include <sstream>

#include "dpe/engine/scene_io.h"
#include "experiments/executors/shell.h"

namespace dpe::experiments {
namespace {

// Told apart also without colours, by the marks; the palette of Okabe and Ito is made
// for people who see fewer of them.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000", "#8c6d31"};
constexpr int kMarks[] = {7, 5, 9, 13, 11, 6, 4, 8};
constexpr size_t kNumStyles = 8;

// Text in double quotes, without the commands that gnuplot reads in "enhanced" texts.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n') {
      quoted += "\\n";
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

bool IsDrawn(double value, bool log) {
  return std::isfinite(value) && (!log || value > 0.0);
}

std::string Data(const Plot& plot, const Series& series, const std::string& name) {
  std::ostringstream data;
  data.precision(10);
  data << name << " << EOD\n";
  bool has_any = false;
  for (size_t i = 0; i < series.x.size() && i < series.y.size(); ++i) {
    if (!IsDrawn(series.x[i], plot.log_x) || !IsDrawn(series.y[i], plot.log_y)) {
      continue;
    }
    const bool has_text = i < series.annotations.size();
    data << series.x[i] << ' ' << series.y[i] << ' '
         << Quoted(has_text ? series.annotations[i] : "") << '\n';
    has_any = true;
  }
  // gnuplot refuses an empty block; a point that is not a number is not drawn.
  if (!has_any) data << "NaN NaN \"\"\n";
  data << "EOD\n";
  return data.str();
}

std::string Axis(const std::string& axis, const std::string& label, bool log) {
  std::string text = "set " + axis + "label " + Quoted(label) + " noenhanced\n";
  if (log) {
    text += "set logscale " + axis + " 10\nset format " + axis + " \"10^{%L}\"\n";
  }
  return text;
}

std::string SeriesCommand(const Series& series, const std::string& data, size_t index) {
  const size_t style = index % kNumStyles;
  std::ostringstream command;
  command << data << " using 1:2 with "
          << (series.line ? (series.marks ? "linespoints" : "lines") : "points")
          << " lc rgb \"" << kColours[style] << '"';
  if (series.line) {
    command << " lw 2 dt " << (index / kNumStyles) % 5 + 1;
  }
  if (series.marks || !series.line) command << " pt " << kMarks[style] << " ps 0.8";
  command << " title " << Quoted(series.label) << " noenhanced";
  if (!series.annotations.empty()) {
    command << ", " << data
            << " using 1:2:3 with labels noenhanced left offset 0.7,0.5 font \",10\" "
               "notitle";
  }
  return command.str();
}

}  // namespace

std::string GnuplotScript(const Plot& plot, const std::string& svg_path) {
  std::ostringstream script;
  script << "set encoding utf8\n"
         << "set terminal svg size 960,540 dynamic enhanced font \"Helvetica,14\" "
            "background \"#ffffff\"\n"
         << "set output " << Quoted(svg_path) << "\n"
         << "set title " << Quoted(plot.title) << " noenhanced font \",16\"\n"
         << Axis("x", plot.x_label, plot.log_x) << Axis("y", plot.y_label, plot.log_y)
         << "set grid lc rgb \"#dddddd\" lt 1\n"
         << "set key outside right top Left reverse samplen 2 spacing 1.2\n"
         << "set offsets graph 0.02, graph 0.02, graph 0.02, graph 0.02\n";
  for (size_t s = 0; s < plot.series.size(); ++s) {
    script << Data(plot, plot.series[s], "$data" + std::to_string(s));
  }
  script << "plot ";
  for (size_t s = 0; s < plot.series.size(); ++s) {
    script << (s > 0 ? ", \\\n     " : "")
           << SeriesCommand(plot.series[s], "$data" + std::to_string(s), s);
  }
  script << "\n";
  return script.str();
}

std::string DrawPlot(const Plot& plot, const std::string& dir) {
  namespace fs = std::filesystem;
  if (plot.series.empty()) return plot.name + ": there is nothing to draw";
  std::error_code error;
  fs::create_directories(dir + "/plots", error);
  const std::string svg = dir + "/" + plot.name + ".svg";
  const std::string script = dir + "/plots/" + plot.name + ".gp";
  WriteFileAtomically(script, GnuplotScript(plot, svg));
  fs::remove(svg, error);
  const CommandResult result = RunCommand({"gnuplot", script});
  if (result.exit_code == 127) {
    return "gnuplot was not found, so plots are not drawn; once it is installed, run "
           "the same command again";
  }
  if (result.exit_code != 0 || !fs::exists(svg)) {
    return plot.name + ": gnuplot failed: " + result.err;
  }
  return "";
}

}  // namespace dpe::experiments
