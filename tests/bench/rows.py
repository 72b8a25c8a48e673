#!/usr/bin/env python3
"""What rows cost: `convert`, `check` and `run` of long trajectories, and the start of the command.

    python3 rows.py BEFORE AFTER [ROWS]

BEFORE and AFTER are two builds of the command `isoroll`; give one of them twice to see the noise. The trajectory has
ROWS rows (300000), k = -1, J = (1.4, 2.1, 3.0), step 0.01, 7 columns of 17 digits.

The first table: processor time in microseconds a row, each the median of 7 passes over all lines in turn, with BEFORE,
with AFTER, and their ratio. The second: milliseconds of processor time for a whole process, the median of 100."""
import os
import resource
import statistics
import subprocess
import sys
import tempfile

ROWS = {
    "convert": "convert --quiet --to point ball.csv -o /dev/null",
    "check": "check ball.csv",
    "check, both models, 3 clocks": "check both.csv",
    "run": "run long.yaml",
    "run, closed solution": "run long.yaml --backend exact",
}
STARTS = {"--version": "--version", "run, 101 rows": "run short.yaml"}
SCENE = """reduced: {k: -1, J: [1.4, 2.1, 3.0]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: %.17g, step: 0.01}
"""


def seconds(command, arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([command, *arguments.split()], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def table(builds, lines, passes, unit, name):
    took = [{line: [seconds(b, lines[line]) for b in builds] for line in lines} for _ in range(passes)]
    print(f"\n{name:28} {'before':>9} {'after':>9} {'ratio':>6}")
    for line in lines:
        before, after = (statistics.median(t[line][i] for t in took) / unit for i in (0, 1))
        print(f"{line:28} {before:9.3f} {after:9.3f} {before / after:6.2f}")


builds = [os.path.realpath(path) for path in sys.argv[1:3]]
count = int(sys.argv[3]) if len(sys.argv) > 3 else 300000
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name, end in ("long", 0.01 * (count - 1)), ("short", 1):
        open(name + ".yaml", "w").write(SCENE % end)
    seconds(builds[1], "run long.yaml -o ball.csv")
    seconds(builds[1], "run long.yaml --as both -o both.csv")
    table(builds, ROWS, 7, 1e-6 * count, "microseconds a row")
    table(builds, STARTS, 100, 1e-3, "milliseconds")
    os.chdir("/")
