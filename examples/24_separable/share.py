"""Which part of random starts of one energy is chaotic, with another text in the potential of a scene:

    python3 share.py scene.yaml "c: 1" "c: 1.05" [TURNS]

n is even on the part of the sphere where U < h, omega has a random direction across n. Needs the package isoroll."""
import re
import sys
from collections import Counter

import isoroll
import numpy as np

path, old, new = sys.argv[1:4]
starts, turns = 32, int(sys.argv[4]) if len(sys.argv) > 4 else 1500
text = open(path).read().replace(old, new)


def numbers(key):
    return np.array([float(x) for x in re.search(key + r": \[(.*?)\]", text).group(1).split(",")])


J = numbers("J")
U_text, parameters = re.search(r'U: "(.*?)"\s*parameters: {(.*?)}', text, re.S).groups()
U_code = compile(re.sub(r"\s+", " ", U_text).replace("^", "**"), "U", "eval")
names = {"J1": J[0], "J2": J[1], "J3": J[2]}
names.update((p.split(":")[0].strip(), float(p.split(":")[1])) for p in parameters.split(","))


def U(n):
    return eval(U_code, dict(names, __builtins__={}, n1=n[0], n2=n[1], n3=n[2]))


w = numbers("angular_velocity")
h = J @ w**2 / 2 + U(numbers("normal"))
random, verdicts = np.random.default_rng(1), Counter()
while sum(verdicts.values()) < starts:
    n = random.normal(size=3)
    n /= np.linalg.norm(n)
    if U(n) >= h:
        continue
    w = np.cross(n, random.normal(size=3))
    w *= np.sqrt(2 * (h - U(n)) / (J @ w**2))
    scene = isoroll.Scene(text, normal=n, angular_velocity=w)
    verdicts[isoroll.chaos(scene, model="ball", turns=turns, threads=1).verdict[0]] += 1
print(f"h = {h:.6g}:", dict(verdicts))
