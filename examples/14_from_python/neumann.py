"""Neumann's problem V = (1/2) sum c_i x_i^2 on the unit sphere by leapfrog, in plain Python: semicolons, names of its own,
and an error that `isoroll check` tells. leapfrog.csv is what it wrote."""
c, h, steps = (-6.0, -4.0, -2.0), 0.01, 2000
x, v = [0.6, 0.0, 0.8], [0.4, 1.5, -0.3]


def kick(x, v, h):
    """v' = -c x, and the part along x is the sphere's."""
    force = [-ci * xi for ci, xi in zip(c, x)]
    along = sum(f * xi for f, xi in zip(force, x))
    return [vi + h * (f - along * xi) for vi, f, xi in zip(v, force, x)]


def turn(x, v, h):
    """A great circle, exactly."""
    from math import cos, sin, sqrt
    w = sqrt(sum(vi * vi for vi in v))
    a, b = cos(w * h), sin(w * h) / w
    return [a * xi + b * vi for xi, vi in zip(x, v)], [a * vi - w * w * b * xi for xi, vi in zip(x, v)]


with open("leapfrog.csv", "w") as out:
    out.write("step;time;x;y;z;Mx;My;Mz\n")
    for i in range(steps + 1):
        M = [v[1] * x[2] - v[2] * x[1], v[2] * x[0] - v[0] * x[2], v[0] * x[1] - v[1] * x[0]]  # M = x' x x
        if i % 5 == 0:
            out.write(";".join([str(i), f"{i * h:.9g}"] + [f"{y:.9g}" for y in x + M]) + "\n")
        v = kick(x, v, h / 2)
        x, v = turn(x, v, h)
        v = kick(x, v, h / 2)
