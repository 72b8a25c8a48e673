// motion.js - where everything is at any time of any clock: cubic curves through the rows, with the slopes that the
// equations of motion give. At the rows they have the numbers of the rows.

// The cubic with values a, b and slopes c, d (times the length of the interval) at u = 0 and 1.
function cubic(a, b, c, d, u) {
  const v = 1 - u;
  return v * v * ((1 + 2 * u) * a + u * c) + u * u * ((1 + 2 * v) * b - v * d);
}
const cubics = (a, b, c, d, h, u) => a.map((x, i) => cubic(x, b[i], c[i] * h, d[i] * h, u));

// q' = q (0, omega)/2
function spin(q, w) {
  const p = q.slice(1),
    v = plus(times(w, q[0]), cross(p, w));
  return [-dot(p, w) / 2, v[0] / 2, v[1] / 2, v[2] / 2];
}

// omega' of a free ball (9), M' of the point (24) by s.
const isFree = () => !Object.keys(page.effects).some((name) => !["attitude", "reactions", "clock"].includes(name));
let free = isFree(); // in the laboratory (lab.js) it changes
function omegaRate(n, w) {
  const x = cross(
      w.map((v, i) => v * body.J[i]),
      w,
    ),
    u = n.map((v, i) => v / body.J[i]),
    lambda = -dot(x, u) / dot(n, u);
  return x.map((v, i) => v / body.J[i] + lambda * u[i]);
}
function forceAt(gamma) {
  const Jg = gamma.map((v, i) => v * body.J[i]),
    q = dot(gamma, Jg);
  return times(cross(gamma, Jg), ((2 * page.eps) / body.k) * q ** (-1 - 1 / body.k));
}

// The slope of omega or M from the rows beside row i. With effects the page does not know their equations.
function difference(o, name, i) {
  const a = Math.max(0, i - 1),
    b = Math.min(o.count - 1, i + 1);
  return times(plus(o[name][b], times(o[name][a], -1)), 1 / (o.t[b] - o.t[a]));
}

// ds/dt for the slopes of the point. Rows at times t have the point's own: where a chaotic orbit's two runs have
// parted, it is not the ball's. Rows at times s have the ball's dt/ds.
const ownRate = (o, i) =>
  page.clock === "s" ? slope.s(o, i) : physics.sRate(dot(o.gamma[i], o.gamma[i].map((v, j) => v * body.J[j])));

// Slopes by t at row i.
const slope = {
  t: () => 1,
  tau: (o, i) => physics.tauRate(physics.q(o.n[i])),
  s: (o, i) => physics.sRate(physics.q(o.n[i])),
  n: (o, i) => times(cross(o.n[i], o.omega[i]), body.k),
  q: (o, i) => spin(o.q[i], o.omega[i]),
  gamma: (o, i) => times(cross(o.gamma[i], o.M[i]), ownRate(o, i)),
  omega: (o, i) => (free ? omegaRate(o.n[i], o.omega[i]) : difference(o, "omega", i)),
  M: (o, i) => (free ? times(forceAt(o.gamma[i]), ownRate(o, i)) : difference(o, "M", i)),
  contact: (o, i) => times(turned(o.q[i], cross(o.omega[i], o.n[i])), body.b), // on a plane
};

// The interval of a growing column that holds x: from row i to i + 1.
function interval(column, x) {
  let low = 0,
    high = column.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (column[middle] <= x) low = middle;
    else high = middle;
  }
  return low;
}

// The part u of interval i, 0 to 1, at which a clock shows x. The cubic grows: halving and Newton's steps find u.
function partAt(o, clock, i, x) {
  const c = o[clock],
    h = o.t[i + 1] - o.t[i],
    a = slope[clock](o, i) * h,
    b = slope[clock](o, i + 1) * h;
  if (x <= c[i]) return 0;
  if (x >= c[i + 1]) return 1;
  let low = 0,
    high = 1,
    u = (x - c[i]) / (c[i + 1] - c[i]);
  for (let step = 0; step < 60; step++) {
    const off = cubic(c[i], c[i + 1], a, b, u) - x;
    if (off === 0 || high - low < 1e-15) break;
    if (off > 0) high = u;
    else low = u;
    const v = 1 - u,
      rate = 6 * u * v * (c[i + 1] - c[i]) + v * (1 - 3 * u) * a + u * (3 * u - 2) * b;
    const next = u - off / rate;
    u = next > low && next < high ? next : (low + high) / 2;
    if (Math.abs(off) < 1e-15 * Math.abs(x)) break;
  }
  return u;
}

const motion = {
  // Everything at the time at which a clock shows x. Beyond the rows: the first or the last row.
  at(o, clock, x) {
    const column = o[clock],
      i = interval(column, x);
    return motion.inside(o, i, partAt(o, clock, i, x));
  },

  inside(o, i, u) {
    const h = o.t[i + 1] - o.t[i],
      j = i + 1;
    const curve = (name) => cubics(o[name][i], o[name][j], slope[name](o, i), slope[name](o, j), h, u);
    const now = { row: i + u, n: unit(curve("n")), q: unit(curve("q")), omega: curve("omega") };
    for (const name of o.clocks)
      now[name] = cubic(o[name][i], o[name][j], slope[name](o, i) * h, slope[name](o, j) * h, u);
    if (o.gamma) {
      now.gamma = unit(curve("gamma"));
      now.M = curve("M");
    }
    return motion.place(now, body.kind === "plane" ? curve("contact") : null);
  },

  // Contact and centre: on a sphere a R n and (a + b) R n.
  place(now, contact) {
    const normal = turned(now.q, now.n);
    now.contact = contact || times(normal, body.A);
    now.centre = plus(now.contact, times(normal, body.b));
    now.trace = times(now.n, -body.b);
    now.normal = normal;
    return now;
  },

  // dc/dt of a clock where the normal is n.
  rate: (clock, n) =>
    clock === "t" ? 1 : clock === "tau" ? physics.tauRate(physics.q(n)) : physics.sRate(physics.q(n)),

  // Moments so close together that straight pieces between them look smooth.
  moments(o, longest) {
    const list = [];
    for (let i = 0; i + 1 < o.count; i++) {
      const w = Math.hypot(...o.omega[i]) * (o.t[i + 1] - o.t[i]) * Math.max(1, Math.abs(body.k));
      const pieces = Math.min(8, Math.max(1, Math.ceil(w / longest)));
      for (let j = 0; j < pieces; j++) list.push(motion.inside(o, i, j / pieces));
    }
    list.push(motion.inside(o, o.count - 2, 1));
    return list;
  },
};
