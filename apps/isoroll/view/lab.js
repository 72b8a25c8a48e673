// lab.js - the laboratory: k, J and the start are changed in the page, and the library (worker.js) computes anew. There is
// no physics here. One Worker computes the orbit, another one the section and the verdict; a Worker that is busy with
// something old is ended.

// A Worker with the library. ask() gives a promise; after stop() what was asked is never answered.
class Helper {
  constructor() {
    this.asked = new Map();
    this.count = 0;
  }

  static async prepare() {
    const packed = Uint8Array.from(atob(element("library").textContent.trim()), (c) => c.charCodeAt(0)),
      stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    Helper.module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
    Helper.code = URL.createObjectURL(new Blob([element("loader").textContent], { type: "text/javascript" }));
  }

  ask(job, scene, options) {
    if (!this.worker) {
      this.worker = new Worker(Helper.code);
      this.worker.postMessage({ module: Helper.module });
      this.worker.onmessage = ({ data }) => {
        const { resolve, reject } = this.asked.get(data.id);
        this.asked.delete(data.id);
        if (data.error === undefined) resolve(data.result);
        else reject(new Error(data.error));
      };
    }
    const id = this.count++;
    this.worker.postMessage({ id, job, scene, options });
    return new Promise((resolve, reject) => this.asked.set(id, { resolve, reject }));
  }

  // Ends the Worker if it still computes.
  stop() {
    if (!this.asked.size) return;
    this.worker.terminate();
    this.worker = null;
    this.asked.clear();
  }
}

const chart = {
  canvas: element("lab-section"),
  dots: [], // {orbit, l, x}, by orbit; the scene's own is 0
  cursor: null, // of the keyboard

  clear() {
    this.dots = [];
    this.draw();
  },
  add(columns, first) {
    columns.orbit.forEach((orbit, i) => {
      if (orbit >= first.from) this.dots.push({ orbit: orbit && orbit + first.number, l: columns.l[i], x: columns.x[i] });
    });
    this.draw();
  },
  frame() {
    const box = this.canvas.getBoundingClientRect(),
      wide = box.width - 46,
      high = box.height - 34;
    return {
      x: (l) => 38 + ((l + Math.PI) / (2 * Math.PI)) * wide,
      y: (x) => 8 + ((1 - x) / 2) * high,
      place: (e) => [
        ((e.clientX - box.left - 38) / wide) * 2 * Math.PI - Math.PI,
        1 - ((e.clientY - box.top - 8) / high) * 2,
      ],
    };
  },
  draw() {
    const { g, height } = sheet(this.canvas),
      { x, y } = this.frame(),
      style = getComputedStyle(document.body);
    g.strokeStyle = style.getPropertyValue("--rule");
    g.fillStyle = style.getPropertyValue("--quiet");
    g.strokeRect(x(-Math.PI), y(1), x(Math.PI) - x(-Math.PI), y(-1) - y(1));
    g.textAlign = "center";
    for (const [l, words] of [
      [-Math.PI, "−π"],
      [0, "0"],
      [Math.PI, "π"],
    ])
      g.fillText(words, x(l), height - 10);
    g.fillText("l", x(Math.PI / 2), height - 10);
    g.textAlign = "right";
    for (const v of [-1, 0, 1]) g.fillText(String(v).replace("-", "−"), x(-Math.PI) - 6, y(v) + 4);
    g.fillText("x", x(-Math.PI) - 6, y(0.5) + 4);
    const size = this.dots.length > 4000 ? 1.4 : 2;
    for (const own of [false, true]) {
      for (const dot of this.dots) {
        if ((dot.orbit === 0) !== own) continue;
        g.fillStyle = own ? colours.curve : palette[dot.orbit % palette.length];
        const radius = own ? 1.6 * size : size;
        g.fillRect(x(dot.l) - radius / 2, y(dot.x) - radius / 2, radius, radius);
      }
    }
    if (!this.cursor) return;
    g.strokeStyle = theme().text;
    g.beginPath();
    g.arc(x(this.cursor[0]), y(this.cursor[1]), 6, 0, 7);
    g.stroke();
  },
  steer() {
    const inside = (l, x) => [Math.min(3.1, Math.max(-3.1, l)), Math.min(0.98, Math.max(-0.98, x))];
    this.canvas.addEventListener("click", (e) => lab.startAt(...inside(...this.frame().place(e))));
    this.canvas.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key],
        at = this.cursor || [0, 0];
      if (by) this.cursor = inside(at[0] + by[0] * 0.1, at[1] + by[1] * 0.05);
      else if (e.key === "Enter" && this.cursor) lab.startAt(...this.cursor);
      else return;
      this.draw();
      e.preventDefault();
      e.stopPropagation();
    });
  },
};

// All J of one sum, as a triangle. In its middle one, each is smaller than the sum of the other two.
const triangle = {
  canvas: element("lab-J"),
  corners() {
    const { width, height } = this.canvas.getBoundingClientRect(),
      side = Math.min(width - 40, (height - 30) / 0.866),
      left = (width - side) / 2;
    return [
      [left, height - 16],
      [left + side, height - 16],
      [left + side / 2, height - 16 - 0.866 * side],
    ];
  },
  place(parts) {
    const corners = this.corners();
    return [0, 1].map((c) => corners.reduce((sum, corner, i) => sum + corner[c] * parts[i], 0));
  },
  // The place of J.
  here() {
    const { J } = lab.state,
      sum = J[0] + J[1] + J[2];
    return this.place(J.map((x) => x / sum));
  },
  // The parts of the sum at a place; none is below 1/50.
  parts([px, py]) {
    const [a, b, c] = this.corners(),
      third = (py - a[1]) / (c[1] - a[1]),
      second = (px - a[0] - third * (c[0] - a[0])) / (b[0] - a[0]),
      parts = [1 - second - third, second, third].map((x) => Math.max(0.02, x)),
      sum = parts[0] + parts[1] + parts[2];
    return parts.map((x) => x / sum);
  },
  draw() {
    const { g } = sheet(this.canvas),
      line = (points) => {
        g.beginPath();
        for (const p of points) g.lineTo(...p);
        g.closePath();
      };
    g.strokeStyle = theme().rule;
    g.fillStyle = theme().ground;
    line([this.place([0, 0.5, 0.5]), this.place([0.5, 0, 0.5]), this.place([0.5, 0.5, 0])]);
    g.fill();
    line(this.corners());
    g.stroke();
    g.fillStyle = theme().text;
    g.textAlign = "center";
    this.corners().forEach(([x, y], i) => g.fillText(`J${"₁₂₃"[i]}`, x, i < 2 ? y + 14 : y - 5));
    g.fillStyle = colours.curve;
    g.beginPath();
    g.arc(...this.here(), 6, 0, 7);
    g.fill();
  },
  move(parts) {
    const { J } = lab.state,
      sum = J[0] + J[1] + J[2];
    lab.change({ J: parts.map((x) => +(x * sum).toPrecision(4)) });
  },
  steer() {
    const drag = (e) => {
      const box = this.canvas.getBoundingClientRect();
      if (e.buttons) this.move(this.parts([e.clientX - box.left, e.clientY - box.top]));
    };
    this.canvas.addEventListener("pointerdown", (e) => {
      this.canvas.setPointerCapture(e.pointerId);
      drag(e);
    });
    this.canvas.addEventListener("pointermove", drag);
    this.canvas.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: [-4, 0], ArrowRight: [4, 0], ArrowUp: [0, -4], ArrowDown: [0, 4] }[e.key];
      if (!by) return;
      this.move(this.parts(plus(this.here(), by)));
      e.preventDefault();
      e.stopPropagation();
    });
  },
};

lab = {
  ROWS: 1200,
  state: { k: page.k, J: page.J, n: null, omega: null }, // what is computed
  first: null,
  throwing: false,
  verdict: "",
  tolerance: "",
  orbits: new Helper(),
  sections: new Helper(),
  pending: 0, // of changes: only the last one is shown
  clicked: 0, // likewise of clicks in the section

  scene() {
    const { k, J, n, omega } = this.state,
      speed = Math.hypot(...omega) * Math.sqrt(Math.max(...J) / Math.min(...J)) * Math.max(1, Math.abs(k)),
      step = Number((0.1 / speed).toPrecision(3)); // between rows the motion is drawn by cubic curves
    return {
      reduced: { k, J },
      initial: { normal: n, angular_velocity: omega, project: true },
      time: { end: Number((step * this.ROWS).toPrecision(12)), step },
      effects: { attitude: {} },
      output: { as: "both" },
    };
  },

  // Computes with other numbers. `seek`: {clock, value} to go to.
  async change(numbers, seek) {
    Object.assign(this.state, numbers);
    this.show();
    const number = ++this.pending;
    this.orbits.stop();
    this.sections.stop();
    chart.clear();
    this.say("Computing …");
    try {
      await this.prepared;
      if (number !== this.pending) return;
      const found = await this.orbits.ask("run", this.scene());
      if (number !== this.pending) return;
      this.take(found, seek);
    } catch (error) {
      if (number !== this.pending) return;
      this.say(`The library refuses: ${error.message}`);
      this.filled = number;
      return;
    }
    await this.fill(number);
  },

  // A new orbit: everything is drawn anew.
  take(found, seek) {
    const { k, J } = this.state,
      playing = controls.playing;
    Object.assign(page, { k, J, radius: null, eps: Number(found.lines.eps), h: Number(found.lines.h), integrals: [] });
    page.notes = found.notes ? found.notes.split("\n") : [];
    page.rows = { count: found.rows, total: found.rows, every: 1, between: 0 };
    body = bodyOf();
    potential = potentialOf();
    for (const picture of controls.pictures || []) picture.build();
    const orbit = orbitOf({ count: found.rows, columns: found.columns });
    this.tolerance = `Computed in this page: ${found.lines.method}, tolerance ${found.lines.tolerance} for each step.`;
    controls.offerFrames();
    numbers.describe(orbit);
    controls.setOrbit(orbit);
    controls.resize();
    if (seek) {
      controls.setClock(seek.clock);
      controls.seek(seek.value);
    }
    controls.play(seek ? false : playing);
    this.say();
  },

  // The section: the orbit's own crossings, the verdict, then more and more orbits of the same energy.
  async fill(number) {
    const scene = this.scene(),
      sign = "₁₂₃";
    const ask = async (job, options) => {
      const found = await this.sections.ask(job, scene, options);
      return number === this.pending ? found : new Promise(() => {});
    };
    try {
      this.verdict = "";
      const own = await ask("section", { crossings: 200, model: "point" }),
        axis = Number(own.lines.axis);
      element("lab-section-words").textContent =
        `Dots: crossings of n${sign[axis - 1]} = 0, the same for ball and point; large ones: this orbit’s. ` +
        "Click to start there.";
      chart.canvas.setAttribute("aria-label", `The section n${axis} = 0. Arrow keys choose a start, Enter starts there.`);
      chart.add(own.columns, { from: 0, number: 0 });
      const { lines } = await ask("chaos", {});
      this.verdict = this.words(lines);
      this.say();
      for (let seed = 0; seed < 10; seed++) {
        const more = await ask("section", { starts: 6, crossings: 150, model: "point", seed });
        chart.add(more.columns, { from: 1, number: 6 * seed });
      }
      this.filled = number;
    } catch (error) {
      if (number !== this.pending) return;
      element("lab-section-words").textContent = `No section: ${error.message}`;
      this.filled = number;
    }
  },

  words({ verdict, turns, "ball.exponent.t": exponent }) {
    if (verdict === "chaotic")
      return `Verdict: chaotic (after ${turns} turns; exponent about ${digits(Number(exponent), 2)} per unit of t).`;
    return `Verdict: ${verdict} (after ${turns} turns).`;
  },

  say(words) {
    const { state } = this;
    element("lab-words").textContent = words || `${this.verdict || "Verdict: being computed."} ${this.tolerance}`;
    for (const [name, text] of [
      ["lab-k-words", digits(state.k, 4)],
      ["lab-J-words", state.J.map((x) => digits(x, 4)).join(", ")],
    ])
      element(name).textContent = text;
    triangle.canvas.setAttribute("aria-valuetext", element("lab-J-words").textContent);
  },
  show() {
    element("lab-k").value = this.state.k;
    triangle.draw();
  },

  // The orbit through a point of the section: it starts at its first crossing.
  async startAt(l, x) {
    const number = ++this.clicked;
    try {
      await this.prepared;
      const { columns } = await this.orbits.ask("section", this.scene(), {
        at: `${l},${x}`,
        crossings: 1,
        model: "point",
        as: "ball",
      });
      const i = columns.orbit.indexOf(1),
        vector = (name) => [1, 2, 3].map((j) => columns[name + j][i]);
      if (number !== this.clicked) return;
      if (i < 0) throw new Error("this orbit does not come back to the section");
      await this.change({ n: vector("n"), omega: vector("omega") });
    } catch (error) {
      this.say(`No start there: ${error.message}`);
    }
  },

  // Rolls so that the ball's centre begins to move by (right, up) on the screen; 150 pixels are one radius in a unit of
  // time.
  throwBall(right, up) {
    const picture = controls.pictures[0],
      { now } = controls,
      way = new THREE.Vector3(right, up, 0).applyQuaternion(picture.eye.quaternion),
      space = way.applyQuaternion(picture.world.quaternion.clone().inverse());
    const omega = times(cross(now.normal, [space.x, space.y, space.z]), 1 / (150 * body.b)); // no slip: v = omega x b n
    if (Math.hypot(...omega) < 0.02) return;
    this.change({ n: now.n, omega: turned(inverse(now.q), omega) });
  },
  setThrowing(on) {
    this.throwing = on && Boolean(controls.pictures);
    element("lab-throw").setAttribute("aria-pressed", String(this.throwing));
    element("ball").parentElement.classList.toggle("throwing", this.throwing);
  },

  // --- the address ---

  address() {
    const { k, J, n, omega } = this.state,
      list = (v) => v.map((x) => +x.toPrecision(12)).join();
    return this.changed() ? [`k=${k}`, `J=${list(J)}`, `n=${list(n)}`, `w=${list(omega)}`] : [];
  },
  changed() {
    return JSON.stringify(this.state) !== this.first;
  },
  // Whether the address has another state; if so, it is computed.
  read() {
    const given = new URLSearchParams(location.hash.slice(1)),
      list = (name) => (given.get(name) || "").split(",").map(Number),
      [k, J, n, omega] = [Number(given.get("k")), list("J"), list("n"), list("w")];
    if (!k || ![J, n, omega].every((v) => v.length === 3 && v.every(Number.isFinite))) return false;
    if (this.state.n && this.address().join() === [`k=${k}`, ...["J", "n", "w"].map((x) => `${x}=${given.get(x)}`)].join())
      return false;
    const clock = ["t", "tau", "s"].find((name) => Number.isFinite(Number(given.get(name) || NaN)));
    this.change({ k, J, n, omega }, clock && { clock, value: Number(given.get(clock)) });
    return true;
  },

  // --- the beginning ---

  steer() {
    const slider = element("lab-k"),
      stage = element("ball").parentElement;
    slider.addEventListener("input", () => {
      let k = Number(slider.value);
      for (const special of [-1, 0.5, 1]) if (Math.abs(k - special) < 0.035) k = special;
      if (Math.abs(k) < 0.1) k = k < 0 || (k === 0 && this.state.k > 0) ? -0.1 : 0.1; // there is no k = 0
      this.change({ k });
    });
    element("lab-throw").addEventListener("click", () => this.setThrowing(!this.throwing));
    element("lab-begin").addEventListener("click", () => this.change(JSON.parse(this.first)));
    chart.steer();
    triangle.steer();
    let from = null;
    const take = (name, act) =>
      stage.addEventListener(
        name,
        (e) => {
          if (!this.throwing || e.target.id !== "ball") return;
          e.stopPropagation();
          act(e);
        },
        true,
      );
    take("pointerdown", (e) => {
      from = [e.clientX, e.clientY];
      e.target.setPointerCapture(e.pointerId);
    });
    take("pointermove", () => {});
    take("pointercancel", () => (from = null));
    take("pointerup", (e) => {
      if (from) this.throwBall(e.clientX - from[0], from[1] - e.clientY);
      from = null;
    });
    take("keydown", (e) => {
      const by = { ArrowLeft: [-150, 0], ArrowRight: [150, 0], ArrowUp: [0, 150], ArrowDown: [0, -150] }[e.key];
      if (by) this.throwBall(...by);
      if (by) e.preventDefault();
    });
    addEventListener("resize", () => this.redraw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
  },
  redraw() {
    chart.draw();
    triangle.draw();
  },

  async begin() {
    const { orbit } = controls;
    Object.assign(this.state, { n: [...orbit.n[0]], omega: [...orbit.omega[0]] });
    this.first = JSON.stringify(this.state);
    document.body.classList.add("with-lab");
    controls.resize();
    this.steer();
    this.show();
    chart.draw();
    this.say("The library is being unpacked …");
    this.prepared = Helper.prepare();
    this.read(); // before the player writes its own address
    try {
      await this.prepared;
    } catch (error) {
      element("lab").querySelectorAll("input, button").forEach((part) => (part.disabled = true));
      return this.say(`This browser cannot run the library: ${error.message}`);
    }
    element("lab-throw").hidden = !controls.pictures;
    if (this.pending > 0) return; // the address has a state, or the user was fast
    this.tolerance = "This orbit comes from the page’s file.";
    this.say();
    await this.fill(0);
  },
};
window.isoroll.lab = lab;
lab.begin();
