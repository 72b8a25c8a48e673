#!/usr/bin/env python3
"""What efficiency a sweep would reach on many ranks of MPI: a simulation. python3 ranks.py [FETCH] [MESSAGE]

FETCH: the counter is busy so long for a chunk, in microseconds (5). MESSAGE: rank 0 is busy so long for a message,
besides its rows (15). `ISOROLL_TIMES=1 mpirun ... isoroll-mpi sweep ...` prints both for a machine. PART and RESULT are
what a row costs rank 0 in FILE.part and in the result, in microseconds, and SPREAD is how the times of chunks are
spread about their mean (ln of the standard deviation), all measured with a sweep of chaotic shares.

Every rank fetches a chunk, computes it, and waits until rank 0 has written it. The counter serves one rank at a time,
and so does rank 0, which looks for messages every millisecond when it has none. Each rank computes 100 chunks; the
time until the first rank finds no chunk gives the rate, what follows is the tail. A day's work is a day at this rate,
the tail, and the writing of the result."""
import heapq
import random
import sys

DAY, PER_RANK, LOOKS = 86400, 100, 1e-3
PART, RESULT, SPREAD = 0.59, 0.83, 0.5


def efficiency(ranks, chunk, fetch, message, rows):
    dice = random.Random(18)
    length = lambda: chunk * dice.lognormvariate(-SPREAD**2 / 2, SPREAD)
    counter = writer = used_up = end = work = 0
    ends, left = [], (PER_RANK - 1) * ranks
    for _ in range(ranks):  # the first fetches come at the same time
        counter += fetch
        work += (took := length())
        ends.append(counter + took)
    heapq.heapify(ends)
    while ends:
        end = writer = max(writer, ends[0] + LOOKS / 2 if ends[0] > writer else 0) + message
        if left == 0:
            heapq.heappop(ends)
            continue
        counter = max(counter, writer) + fetch
        work += (took := length())
        heapq.heapreplace(ends, counter + took)
        left -= 1
        used_up = counter if left == 0 else used_up
    tail = end - used_up  # where half of the ranks are idle, at worst
    rate = min(1, (work - ranks * tail / 2) / (ranks * used_up))
    return DAY / (DAY / rate + tail + ranks * DAY / chunk * rows * 1e-6 * RESULT)


fetch, message = (float(sys.argv[i]) if len(sys.argv) > i else (5, 15)[i - 1] for i in (1, 2))
print(f"{'point':>8} {'chunk':>8} {'100 ranks':>12} {'1000':>12} {'10000':>12}   rank 0 is full at")
for chunk in 1, 10:
    for point in 1e-3, 1e-2, 0.1, 1, 10:
        rows = max(1, chunk / point)
        busy = 1e-6 * (message + rows * PART)
        shares = [efficiency(n, rows * point, 1e-6 * fetch, busy, rows) for n in (100, 1000, 10000)]
        print(f"{point:8g} {rows * point:8g}", *(f"{100 * s:10.1f} %" for s in shares), f"{rows * point / busy:10.0f}")
