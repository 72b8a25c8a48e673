// compare.js - the same orbit in both models, side by side: a stretch of the path of n and of gamma in the ball's axes,
// coloured by its phase, with the same numbers at the same states; and a ladder that joins equal states on both clocks.

// Viridis, and black or white, whichever is read better on a colour.
const phaseColours = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const phase = (u) => {
  const at = Math.min(1, Math.max(0, u)) * (phaseColours.length - 1),
    i = Math.min(phaseColours.length - 2, Math.floor(at));
  return new THREE.Color(phaseColours[i]).lerp(new THREE.Color(phaseColours[i + 1]), at - i);
};
const inkOn = (colour) => (phaseColours.indexOf(colour) < 5 ? "#ffffff" : "#000000");

const stretch = {
  STATES: 8, // numbered 0 to 8
  FINER: 40, // pieces between two of them

  // The orbit is cut into stretches in which n goes about 6 radians, each as long by the even clock.
  measure(orbit) {
    let way = 0;
    for (let i = 1; i < orbit.count; i++) way += Math.hypot(...plus(orbit.n[i], times(orbit.n[i - 1], -1)));
    stretch.count = Math.max(1, Math.round(way / 6));
    stretch.key = null;
  },
  // The stretch that holds the present: its moments.
  at(orbit, value) {
    const [from, to] = controls.range(),
      size = (to - from) / stretch.count,
      i = Math.min(stretch.count - 1, Math.max(0, Math.floor((value - from) / size)));
    const key = [clocks.even, i].join();
    if (stretch.key === key) return stretch;
    const pieces = stretch.STATES * stretch.FINER;
    stretch.moments = Array.from({ length: pieces + 1 }, (_, j) =>
      motion.at(orbit, clocks.even, from + size * (i + j / pieces)),
    );
    stretch.states = stretch.moments.filter((_, j) => j % stretch.FINER === 0);
    const { apart } = orbit;
    stretch.parted = Boolean(apart) && stretch.states.some((m) => apart.gamma[Math.round(m.row)] > 1e-3);
    return Object.assign(stretch, { key, from: from + size * i, size });
  },
};

// One of the two spheres: name "n" or "gamma".
class PathPicture extends Picture {
  constructor(canvas, name, words) {
    super(canvas, 4.7);
    this.path = name;
    this.name = words;
    this.world = this.add(this.scene, new THREE.Group());
    this.world.quaternion.copy(bodyUp);
    this.add(this.world, sphere(1, 1, { a: "ground", b: "ground", c: "ground", line: "rule" }));
    this.marks.solids.push({ thing: this.world, radius: 1 });
    this.axes("e₁ e₂ e₃".split(" "));
    this.second = this.add(this.world, bead(0.034, "#000000"));
    this.bead = this.add(this.world, bead(0.034, colours.curve));
    this.states = phaseColours.map((colour, i) => this.marks.add(this.world, [0, 0, 0], String(i), { colour }));
    this.recolour();
  }

  setOrbit() {
    this.key = null;
  }

  show(now) {
    const { key, moments, states } = stretch.at(controls.orbit, controls.value);
    this.bead.position.copy(three(now[this.path])).multiplyScalar(1.02);
    this.second.visible = controls.beside && this.path === "gamma";
    if (this.second.visible) this.second.position.copy(three(growth.place(now, "gamma"))).multiplyScalar(1.02);
    if (key === this.key) return;
    this.key = key;
    for (const old of this.ribbons || []) {
      old.parent.remove(old);
      old.geometry.dispose();
    }
    const points = moments.map((m) => m[this.path]);
    states.forEach((m, i) => this.states[i].place.copy(three(m[this.path])).multiplyScalar(1.02));
    this.ribbons = [false, true].map((hidden) => this.add(this.world, coloured(points, 0.02, hidden)));
  }
}

// A ribbon on the unit sphere, coloured by its phase.
function coloured(points, width, hidden) {
  const geometry = strip(points, points, width),
    shades = new Float32Array(6 * points.length);
  points.forEach((_, i) => {
    const { r, g, b } = phase(i / (points.length - 1));
    shades.set([r, g, b, r, g, b], 6 * i);
  });
  geometry.setAttribute("color", new THREE.BufferAttribute(shades, 3));
  const mesh = new THREE.Mesh(
    geometry,
    new THREE.MeshBasicMaterial({
      vertexColors: true,
      transparent: true,
      opacity: hidden ? 0.25 : 1,
      depthWrite: false,
      side: THREE.DoubleSide,
      depthFunc: hidden ? THREE.GreaterDepth : THREE.LessEqualDepth,
    }),
  );
  mesh.frustumCulled = false;
  mesh.renderOrder = hidden ? 3 : 2;
  return mesh;
}

const ladder = {
  words: () =>
    stretch.at(controls.orbit, controls.value).parted
      ? "Here the two computations have parted, as on every chaotic orbit: equal numbers are no longer equal states."
      : `Equal numbers are equal states. Each line joins one state on both clocks; ${clockWords[clocks.even][0]} runs evenly.`,

  draw(canvas, now) {
    const { g, width, height } = sheet(canvas),
      { moments, states } = stretch.at(controls.orbit, controls.value),
      style = getComputedStyle(document.body);
    const rail = (name, y) => {
      const first = moments[0][name],
        span = moments[moments.length - 1][name] - first;
      return { name, y, x: (m) => 14 + ((m[name] - first) / span) * (width - 28) };
    };
    const t = rail("t", 28),
      s = rail("s", height - 28);
    const rung = (m, colour, thick) => {
      g.strokeStyle = colour;
      g.lineWidth = thick;
      g.beginPath();
      g.moveTo(t.x(m), t.y);
      g.lineTo(s.x(m), s.y);
      g.stroke();
    };
    moments.forEach((m, i) => {
      if (i % 4 === 0) rung(m, `#${phase(i / (moments.length - 1)).getHexString()}`, 1);
    });
    states.forEach((m, i) => rung(m, phaseColours[i], 2.5));
    rung(now, style.getPropertyValue("--text"), 1.5);
    for (const one of [t, s]) ladder.rail(g, one, states, style);
    const words = document.getElementById("pace-words");
    if (words.textContent !== ladder.words()) words.textContent = ladder.words();
  },

  // The name of a clock, and the numbered states on it.
  rail(g, { name, y, x }, states, style) {
    g.textBaseline = "middle";
    g.textAlign = "left";
    g.fillStyle = style.getPropertyValue(`--${name}`);
    g.font = "13px system-ui, sans-serif";
    g.fillText(name === "t" ? "the ball’s clock t" : "the point’s clock s", 4, name === "t" ? y - 20 : y + 20);
    g.textAlign = "center";
    g.font = "600 11px system-ui, sans-serif";
    states.forEach((m, i) => {
      g.fillStyle = phaseColours[i];
      g.beginPath();
      g.arc(x(m), y, 9, 0, 7);
      g.fill();
      g.fillStyle = inkOn(phaseColours[i]);
      g.fillText(String(i), x(m), y + 0.5);
    });
  },
};
