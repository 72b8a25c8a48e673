// orbit.js - the data of the page: a head, and tables {kind, rows, lines, columns}; and what follows from them.
//
// Vectors are arrays of three numbers, quaternions of four, [q0, q1, q2, q3] with q0 real. Columns are Float64Array.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const times = (a, c) => a.map((x) => x * c);
const plus = (a, b) => a.map((x, i) => x + b[i]);
const unit = (a) => times(a, 1 / Math.hypot(...a));

// R v, from body to space axes.
function turned(q, v) {
  const p = q.slice(1),
    twice = times(cross(p, v), 2);
  return plus(plus(v, times(twice, q[0])), cross(p, twice));
}

const inverse = (q) => [q[0], -q[1], -q[2], -q[3]];

// A column of numbers from base64; words, and what the library has just computed (lab.js), are an array already.
function decoded(text) {
  if (typeof text !== "string") return text;
  const bytes = atob(text),
    count = bytes.length / 8,
    column = new Float64Array(count);
  const view = new DataView(new ArrayBuffer(8));
  for (let i = 0; i < count; i++) {
    for (let b = 0; b < 8; b++) view.setUint8(b, bytes.charCodeAt(8 * i + b));
    column[i] = view.getFloat64(0, true);
  }
  return column;
}

const page = JSON.parse(document.getElementById("data").textContent);

// The tables of a kind; with a number only those of this orbit of a section. A column is decoded when it is asked for.
const tables = (kind, orbit) =>
  page.tables.filter((one) => one.kind === kind && (orbit === undefined || Number(one.lines.orbit) === orbit));
function column(table, name) {
  if (!table || !(name in table.columns)) return undefined;
  return (table.columns[name] = decoded(table.columns[name]));
}

// The ball and its support, in the file's units. b < 0 where the ball is inside, or around, the fixed sphere. In the
// laboratory (lab.js) k and J change.
const bodyOf = () => {
  const { k, J } = page,
    B = page.radius > 0 ? page.radius : 1;
  const kind = k === 1 ? "plane" : k < 0 ? "shell" : k < 1 ? "outside" : "inside";
  const b = kind === "inside" || kind === "shell" ? -B : B,
    A = kind === "plane" ? Infinity : B * Math.abs(k / (1 - k));
  return {
    k,
    J,
    B,
    b,
    kind,
    A,
    flat: A > 300 * B, // beside the ball the sphere looks like a plane, and is drawn so
    large: kind !== "plane" && A > 30 * B, // in a picture of the whole sphere the ball would be a dot
    detJ: J[0] * J[1] * J[2],
    reduced: !(page.radius > 0),
  };
};
let body = bodyOf();

// q = (gamma, J gamma) = 1/(n, n/J); rates of the clocks by t; the potential (24) and what a field adds to it.
const physics = {
  q: (n) => 1 / n.reduce((sum, x, i) => sum + (x * x) / body.J[i], 0),
  tauRate: (q) => q ** (1 - 1 / (2 * body.k)),
  sRate: (q) => (body.k ** 2 / body.detJ) * q ** (1 + 1 / (2 * body.k)),
  normal: (gamma) => unit(gamma.map((x, i) => x * Math.sqrt(body.J[i]))),
  field(n) {
    const { quadratic, linear } = page.effects.field || {};
    let U = 0;
    for (let i = 0; quadratic && i < 3; i++)
      for (let j = 0; j < 3; j++) U += (n[i] * quadratic[3 * i + j] * n[j]) / 2;
    return linear ? U + dot(linear, n) : U;
  },
  V(gamma) {
    const q = gamma.reduce((sum, x, i) => sum + x * x * body.J[i], 0);
    return (
      -page.eps * q ** (-1 / body.k) +
      ((physics.field(physics.normal(gamma)) * body.detJ) / body.k ** 2) * q ** (-1 / body.k)
    );
  },
  // omega of the map (18)
  omega(M, gamma) {
    const q = gamma.reduce((sum, x, i) => sum + x * x * body.J[i], 0);
    const NN = (Math.sqrt(body.detJ) / body.k) * q ** (-1 / (2 * body.k));
    return M.map((x, i) => x / Math.sqrt(body.J[i]) / NN);
  },
};

// The orbit of the page, or that of a section with this number: arrays of vectors by name, for each row, and tables.
function orbitOf(number) {
  const [rows] = tables("trajectory", number),
    [neighbour] = tables("neighbour", number),
    [compare] = tables("compare"),
    [found] = tables("orbits"),
    vectors = (table, name, first = 1, size = 3) =>
      column(table, name + first) &&
      Array.from({ length: table.rows }, (_, i) =>
        Array.from({ length: size }, (_, j) => column(table, name + (first + j))[i]),
      );
  const o = {
    count: rows.rows,
    column: (name) => column(rows, name),
    q: vectors(rows, "q", 0, 4),
    near: column(neighbour, "distance"),
    apart: compare && { n: column(compare, "n"), gamma: column(compare, "gamma") },
  };
  for (const name of ["t", "tau", "s"]) o[name] = column(rows, name);
  for (const name of ["e", "n", "omega", "gamma", "M", "contact"]) o[name] = vectors(rows, name);
  if (o.near) o.beside = vectors(neighbour, page.alone ? "n" : "gamma");
  const at = found ? column(found, "orbit").indexOf(number ?? 0) : -1;
  if (at >= 0) for (const name of ["verdict", "exponent"]) o[name] = column(found, name)[at];
  if (!o.n) o.n = o.gamma.map(physics.normal);
  if (!o.omega) o.omega = o.gamma.map((gamma, i) => physics.omega(o.M[i], gamma));
  o.clocks = ["t", "tau", "s"].filter((name) => o[name]);
  return o;
}

// The direction that points up in the pictures, in space axes. With gravity it is the upward vertical, so that a slope
// is seen. Else the ball begins on top of its support, or at the bottom of a bowl.
function upOf(orbit) {
  const n = turned(orbit.q[0], orbit.n[0]);
  if (page.effects.gravity) {
    const e = orbit.e ? orbit.e[0] : page.effects.gravity.up;
    return unit(turned(orbit.q[0], e));
  }
  return body.kind === "inside" ? times(n, -1) : n;
}
