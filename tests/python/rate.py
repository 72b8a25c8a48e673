"""The rate of isoroll.batch, beside that of C (tests/bench/foreign.c). Run it by hand, after bench_foreign:

    PYTHONPATH=apps/python ISOROLL_LIBRARY=BUILD/libisoroll.so.0 python3 tests/python/rate.py [SCENE]
"""

import sys
import time

import numpy as np

import isoroll

USUAL = """reduced: {k: 0.5, J: [1, 2, 5]}
time: {end: 1}
initial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}
"""


def measure(scene, count, end, rows):
    angle = 2 * np.pi * np.arange(count) / count
    zero = 0 * angle
    start = np.stack([np.cos(angle), np.sin(angle), zero, zero, zero, zero + 1], axis=1)
    times = end * np.arange(1, rows + 1) / rows
    best = np.inf
    for _ in range(9):
        before = time.process_time()
        isoroll.batch(scene, times, start=start)
        best = min(best, time.process_time() - before)
    print(f"{'isoroll.batch':18} {count:6} orbits to {end:3}, {rows:3} rows: {best:.4f} s, "
          f"{count / best:8.0f} orbits a second")


if __name__ == "__main__":
    chosen = isoroll.Scene(sys.argv[1] if len(sys.argv) > 1 else USUAL)
    for size in ((4096, 100, 1), (20000, 20, 10), (2000, 50, 500)):
        measure(chosen, *size)
