#!/usr/bin/env python3
"""Turns the JSON of dpe_benchmarks --benchmark_out into the tables of docs/performance.md.

    table.py FILE.json...

Of the repetitions of a benchmark the least of every time is taken, of other counters the
last. The exponents of a row are those of the growth from the next smaller grid, and from
the smallest, log(time ratio) / log(ratio of the numbers of vertices). Times are processor
time unless they are called wall time.
"""
import json
import math
import re
import sys

TIMES = ("ms", "ms_per_frame", "floor_ms", "rollout_ms", "backward_ms",
         "us_per_frame_and_column", "wall_ms", "rejected_ms", "jacobian_wall_ms",
         "least_squares_wall_ms")
PRESET_ORDER = ("side", "flag")
SOLVER_ORDER = ("cholesky", "cg", "auto")


def read(paths):
    """Benchmark name without run options -> counters, least times."""
    results = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            runs = json.load(file)["benchmarks"]
        for run in runs:
            if run.get("run_type") == "iteration":
                merge(results.setdefault(short_name(run["run_name"]), {}), run)
    return results


def short_name(run_name):
    return re.sub(r"/(iterations|repeats):\d+|/process_time", "", run_name)


def merge(result, run):
    for key, value in run.items():
        if key in TIMES and key in result:
            value = min(value, result[key])
        if key == "gflops" and key in result:
            value = max(value, result[key])
        result[key] = value


def parts(name):
    """"forward/side/cg/method:2/grid:12" -> ("forward", "side", {"solver": "cg", ...})."""
    what, preset, solver, *rest = name.split("/")
    fields = {k: int(v) for k, v in (r.split(":") for r in rest)}
    return what, preset, dict(fields, solver=solver)


def select(results, kind):
    """Rows of one kind, as (preset, fields, counters), in the order of the tables."""
    rows = []
    for name, counters in results.items():
        if name.startswith("machine_"):
            continue
        what, preset, fields = parts(name)
        if what == kind or kind.endswith("*") and what.startswith(kind[:-1]):
            rows.append((preset, dict(fields, what=what), counters))
    rows.sort(key=lambda r: (PRESET_ORDER.index(r[0]), r[1]["method"], r[1]["what"],
                             SOLVER_ORDER.index(r[1]["solver"]), r[1]["grid"]))
    return rows


def number(value, digits=3):
    """Three significant digits, without an exponent unless it is small."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if value == 0:
        return "0"
    if abs(value) < 1e-3:
        return f"{value:.1e}"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{decimals}f}"


def count(value):
    return f"{round(value):,}"


def ratio(a, b):
    return a / b if a is not None and b else None


def exponent(key, counters, previous):
    if previous is None or key not in counters or key not in previous:
        return None
    growth = math.log(counters["vertices"] / previous["vertices"])
    return math.log(counters[key] / previous[key]) / growth


def table(title, heads, rows):
    if not rows:
        return
    print(f"### {title}\n")
    print("| " + " | ".join(heads) + " |")
    print("|" + "---|" * len(heads))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def failure(counters, num_cells):
    cause = counters["error_message"].split(": ")[-1].split(" (")[0]
    return ["failed: " + cause] + ["–"] * (num_cells - 1)


class Series:
    """Remembers rows of each series of grids, for the exponents."""

    def __init__(self):
        self.first = {}
        self.last = {}

    def exponents(self, series, key, counters):
        """Cells: growth from the next smaller grid, and from the smallest of all."""
        previous = self.last.get(series)
        first = self.first.setdefault(series, counters)
        self.last[series] = counters
        overall = exponent(key, counters, first) if first is not counters else None
        return [number(exponent(key, counters, previous)), number(overall)]


EXPONENTS = ["exponent", "from smallest"]


def machine(results):
    for name, c in results.items():
        if name.startswith("machine_dgemm"):
            print(f"Machine: {number(c['gflops'])} GFlop/s in products of 512 × 512 "
                  f"matrices (dgemm), one core.\n")


def grid_name(fields):
    return "{0} × {0}".format(fields["grid"])


def forward(results):
    rows, series = [], Series()
    for preset, fields, c in select(results, "forward"):
        cells = [preset, str(fields["method"]), fields["solver"], grid_name(fields)]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 7))
            continue
        systems = c["factorizations_per_frame"]
        floor = c.get("floor_ms")
        rows.append(cells + [
            number(c["ms_per_frame"]), number(floor),
            number(ratio(c["ms_per_frame"], floor)), number(systems),
            number(ratio(c["ms_per_frame"], floor * systems if floor else None))] +
            series.exponents((preset, fields["method"], fields["solver"]),
                             "ms_per_frame", c))
    table("Forward frame",
          ["scene", "method", "solver", "grid", "ms per frame", "floor, ms",
           "ratio to floor", "factorisations per frame", "ratio to that many floors"] +
          EXPONENTS, rows)


def growth(results):
    rows, series = [], Series()
    for preset, fields, c in select(results, "growth"):
        cells = [preset, str(fields["method"]), fields["solver"], grid_name(fields)]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 3))
            continue
        rows.append(cells + [number(c["ms_per_frame"])] +
                    series.exponents((preset, fields["method"], fields["solver"]),
                                     "ms_per_frame", c))
    table("Growth, over the same fifty frames of every grid",
          ["scene", "method", "solver", "grid", "ms per frame"] + EXPONENTS, rows)


def gradient(results, what="gradient", of=""):
    rows, series = [], Series()
    for preset, fields, c in select(results, what):
        cells = [preset, str(fields["method"]), fields["solver"], grid_name(fields)]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 9))
            continue
        rows.append(cells + [
            number(c["alone_ms"]), number(c["rollout_ms"]), number(c["backward_ms"]),
            number(c["ms_per_frame"]), number(ratio(c["ms_per_frame"], c["alone_ms"])),
            number(c["first_ms"]),
            number(c["peak_mib"])] +
            series.exponents((preset, fields["method"], fields["solver"]),
                             "ms_per_frame", c))
    table(f"Gradient{of} (adjoint, all stiffnesses), per frame",
          ["scene", "method", "solver", "grid", "rollout alone, ms",
           "recorded rollout, ms", "backward step, ms", "gradient, ms",
           "× rollout alone", "first gradient, ms", "memory, MiB"] + EXPONENTS, rows)


def gradient_of_100_frames(results):
    gradient(results, "gradient_of_100_frames", " of 100 frames")


def memory(results):
    rows = []
    for _, fields, c in select(results, "memory"):
        limit = f"{fields['limit']} MiB" if fields["limit"] else "default"
        cells = [grid_name(fields), count(fields["frames"]), count(fields["steps"]),
                 limit]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 4))
            continue
        rows.append(cells + [number(c["peak_mib"]), number(c["resident_mib"]),
                             count(c["ms"]), repr(c["gradient_norm"])])
    table("Memory of a gradient, scene side, method 2",
          ["grid", "frames", "steps per frame", "memory limit", "beyond start, MiB", "resident, MiB", "ms",
           "norm of the gradient"], rows)


def lm_iteration(results):
    rows = []
    for _, fields, c in select(results, "lm_iteration"):
        cells = [str(fields["method"]), grid_name(fields), count(fields["threads"])]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 8))
            continue
        rows.append(cells + [
            count(c["parameters"]), count(c["frames"]), count(c["ms"]),
            count(c["wall_ms"]), count(c["jacobian_wall_ms"]),
            count(c["least_squares_wall_ms"]), number(c.get("rejected_ms")),
            number(c["peak_mib"])])
    table("An iteration of Levenberg-Marquardt, side nL",
          ["method", "grid", "threads", "parameters", "frames", "ms", "wall time, ms",
           "of it Jacobian", "of it least squares", "rejected step, ms",
           "memory, MiB"], rows)


def jacobian(results):
    rows = []
    for _, fields, c in select(results, "jacobian"):
        cells = [str(fields["method"]), grid_name(fields)]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 6))
            continue
        rows.append(cells + [
            count(c["columns"]), count(c["frames"]), count(c["threads"]),
            number(c["ms"]), number(c["us_per_frame_and_column"]),
            number(c["peak_mib"])])
    table("Tangent Jacobian of all positions, scene side",
          ["method", "grid", "columns", "frames", "threads", "ms (processor)",
           "µs per frame and column", "memory, MiB"], rows)


def inverse_dynamics(results):
    rows = []
    for _, fields, c in select(results, "inverse_dynamics"):
        cells = [str(fields["method"]), grid_name(fields)]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 5))
            continue
        rows.append(cells + [
            count(c["parameters"]), count(c["frames"]), number(c["ms"]),
            number(c["deviation_percent"]), number(c["peak_mib"])])
    table("Inverse dynamics, side nL, exact observations",
          ["method", "grid", "parameters", "frames", "ms", "deviation, %",
           "memory, MiB"], rows)


def estimation(results):
    rows, series = [], Series()
    for _, fields, c in select(results, "estimation_*"):
        what = fields["what"][len("estimation_"):].replace("_", " ")
        cells = [what, str(fields["method"]), grid_name(fields)]
        if c.get("error_occurred"):
            rows.append(cells + failure(c, 11))
            continue
        per_frame = dict(c, ms_per_frame=c["ms"] / (c["frames"] - 1))
        rows.append(cells + [
            count(c["frames"]), count(c["parameters"]),
            count(c["iterations"]), count(c["rollouts"]),
            count(c["jacobians"]), number(c["ms"])] +
            series.exponents((what, fields["method"]), "ms_per_frame", per_frame) +
            [number(c["final_rms"]), number(c["peak_mib"]), c.get("label", "")])
    table("Whole estimations, scene side",
          ["what", "method", "grid", "frames", "parameters", "iterations", "rollouts",
           "Jacobians", "ms", "exponent per frame", "from smallest", "RMS, m",
           "memory, MiB", "ended"], rows)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    results = read(sys.argv[1:])
    for write in (machine, forward, growth, gradient, gradient_of_100_frames,
                  memory, jacobian, lm_iteration,
                  inverse_dynamics, estimation):
        write(results)


if __name__ == "__main__":
    main()
