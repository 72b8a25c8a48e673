// lab.js - the laboratory: k, J and the start are changed in the page, and the library (worker.js) computes anew. There is
// no physics here. One Worker computes the orbit, another one the section and the verdict; a Worker that is busy with
// something old is ended.

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
