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

// Lines "x y text"; empty if no point can be drawn.
std::string Points(const Plot& plot, const Series& series) {
  std::ostringstream data;
  data.precision(10);
  for (size_t i = 0; i < series.x.size() && i < series.y.size(); ++i) {
    if (!IsDrawn(series.x[i], plot.log_x) || !IsDrawn(series.y[i], plot.log_y)) {
      continue;
    }
    const bool has_text = i < series.annotations.size();
    data << series.x[i] << ' ' << series.y[i] << ' '
         << Quoted(has_text ? series.annotations[i] : "") << '\n';
  }
  return data.str();
}

std::string Axis(const std::string& axis, const std::string& label, bool log) {
  std::string text = "set " + axis + "label " + Quoted(label) + " noenhanced\n";
  if (log) {
    text += "set logscale " + axis + " 10\nset format " + axis + " \"10^{%L}\"\n";
  }
  return text;
}

// Empty for numbers.
std::string YNames(const Plot& plot) {
  if (plot.y_names.empty()) return "";
  std::ostringstream command;
  for (const auto& [value, name] : plot.y_names) {
    command << (command.tellp() > 0 ? ", " : "") << Quoted(name) << ' ' << value;
  }
  return "set ytics noenhanced (" + command.str() + ")\n";
}

std::string SeriesCommand(const Series& series, const std::string& data, size_t index) {
  if (series.style >= 0) index = static_cast<size_t>(series.style);
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
         << YNames(plot) << "set grid lc rgb \"#dddddd\" lt 1\n"
         << "set key outside right top Left reverse samplen 2 spacing 1.2\n"
         << "set offsets graph 0.02, graph 0.02, graph 0.02, graph 0.02\n";
  // What has no point is not in the legend either, but keeps its colour from the
  // others.
  std::string commands;
  for (size_t s = 0; s < plot.series.size(); ++s) {
    const std::string points = Points(plot, plot.series[s]);
    if (points.empty()) continue;
    const std::string name = "$data" + std::to_string(s);
    script << name << " << EOD\n" << points << "EOD\n";
    commands += commands.empty() ? "plot " : ", \\\n     ";
    commands += SeriesCommand(plot.series[s], name, s);
  }
  if (commands.empty()) return "";
  script << commands << "\n";
  return script.str();
}

std::string DrawPlot(const Plot& plot, const std::string& dir) {
  namespace fs = std::filesystem;
  const std::string svg = dir + "/" + plot.name + ".svg";
  const std::string text = GnuplotScript(plot, svg);
  std::error_code error;
  fs::remove(svg, error);
  if (text.empty()) return plot.name + ".svg: there is nothing to draw yet";
  fs::create_directories(dir + "/plots", error);
  const std::string script = dir + "/plots/" + plot.name + ".gp";
  WriteFileAtomically(script, text);
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
