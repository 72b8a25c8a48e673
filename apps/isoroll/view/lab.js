// lab.js - the laboratory: k, J, what acts and the start are changed in the page, and the library (worker.js) computes
// anew. There is no physics here. One Worker computes the orbit, one the section, one what is known of the orbit
// (judge.js); a Worker that is busy with something old is ended.

lab = {
  ROWS: 1200,
  DRAWS: 10, // of six orbits, for the section
  state: { k: page.k, J: page.J, n: null, omega: null, ...forces.none() }, // what is computed
  first: null,
  throwing: false,
  tolerance: "",
  orbits: new Helper(),
  sections: new Helper(),
  pending: 0, // of changes: only the last one is shown
  clicked: 0, // likewise of clicks in the section

  scene() {
    const { k, J, n, omega } = this.state,
      turns = Math.hypot(...omega) * Math.sqrt(Math.max(...J) / Math.min(...J)) * Math.max(1, Math.abs(k)),
      step = Number((0.1 / (turns * forces.hurry(this.state))).toPrecision(3)); // between rows: cubic curves
    return {
      reduced: { k, J },
      initial: { normal: n, angular_velocity: omega, project: true },
      time: { end: Number((step * this.ROWS).toPrecision(12)), step },
      effects: { ...forces.effects(this.state), attitude: {} },
      output: { as: "both" },
    };
  },

  // Computes with other numbers, and then all that belongs to the orbit. `seek`: {clock, value} to go to.
  async change(numbers, seek) {
    if (await this.compute(numbers, seek)) await this.fill(this.pending);
  },
  // The orbit alone. False: it is not shown; the library refuses it, or there is a newer change.
  async compute(numbers, seek) {
    const upright = forces.sign(this.state.k);
    Object.assign(this.state, numbers);
    if (forces.sign(this.state.k) !== upright && !numbers.up) this.state.up = null; // it lies elsewhere on its support
    this.show();
    const number = ++this.pending;
    for (const helper of [this.orbits, this.sections]) helper.stop();
    judge.stop();
    chart.clear();
    this.say("Computing …");
    try {
      await this.prepared;
      if (number !== this.pending) return false;
      const found = await this.orbits.ask("run", this.scene());
      if (number !== this.pending) return false;
      this.take(found, seek);
      return true;
    } catch (error) {
      if (number !== this.pending) return false;
      this.say(`The library refuses: ${error.message}`);
      this.filled = this.shared = number;
      return false;
    }
  },

  // A new orbit: everything is drawn anew.
  take(found, seek) {
    const { k, J } = this.state,
      playing = controls.playing,
      { lines } = found.tables[0],
      line = (name) => (name in lines ? Number(lines[name]) : null);
    if (found.alone && controls.compared) controls.compare(false);
    Object.assign(page, { k, J, radius: null, eps: line("eps"), h: line("h"), alone: found.alone });
    page.attitude = false;
    page.effects = { ...forces.effects(this.state), attitude: {} };
    page.notes = found.notes ? found.notes.split("\n") : [];
    page.tables = found.tables;
    free = isFree();
    body = bodyOf();
    potential = potentialOf();
    controls.pictures = found.alone ? this.pictures.slice(0, 1) : this.pictures;
    for (const picture of controls.pictures) picture.build();
    const orbit = orbitOf();
    this.tolerance =
      `Computed in this page by the library, ${lines.method}, with 64-bit numbers and a tolerance of ` +
      `${lines.tolerance} for each step.`;
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

  // The section and the judgement, at the same time.
  async fill(number) {
    await Promise.all([this.fillSection(number), judge.begin(number, this.scene())]);
    if (number !== this.pending) return;
    this.filled = number;
    await judge.share(number, this.scene());
  },

  // The orbit's own crossings, then those of more and more orbits of the same energy.
  async fillSection(number) {
    const scene = this.scene(),
      words = element("lab-section-words"),
      model = page.alone ? "ball" : "point";
    const ask = async (options) => {
      const found = await this.sections.ask("section", scene, { model, ...options });
      return number === this.pending ? found : new Promise(() => {});
    };
    try {
      const own = await ask({ crossings: 200 }),
        axis = Number(own.lines.axis);
      chart.axis = axis;
      const crossed = `crossings of n${"₁₂₃"[axis - 1]} = 0`,
        items = [[colours.curve, "this orbit"], [shadeColour("grey"), "chaotic"], [shadeColour("dark"), "undecided"]];
      if (page.alone) words.textContent = `Dots: ${crossed} by this orbit. The section has no other orbits under gravity.`;
      else legend(words, items, `Dots: ${crossed} upwards; other colours are regular. Click to start there.`, "dot");
      chart.canvas.setAttribute("aria-label", `The section n${axis} = 0. Arrow keys choose a start, Enter starts there.`);
      chart.add(own, { from: 0, number: 0 });
      for (let seed = 0; seed < this.DRAWS && !page.alone; seed++) {
        const more = await ask({ starts: 6, crossings: 150, seed });
        chart.add(more, { from: 1, number: 6 * seed });
      }
    } catch (error) {
      if (number === this.pending) words.textContent = `No section: ${error.message}`;
    }
  },

  say(words) {
    element("lab-words").textContent = words || judge.words();
    element("lab-tolerance").textContent = this.tolerance;
  },
  show() {
    const { state } = this;
    element("lab-k").value = state.k;
    element("lab-k-words").textContent = digits(state.k, 4);
    element("lab-k").setAttribute("aria-valuetext", digits(state.k, 4));
    const most = Math.max(...state.J);
    element("lab-J-words").textContent =
      state.J.map((x) => digits(x, 4)).join(", ") + (2 * most < dot(state.J, [1, 1, 1]) ? "" : " (no solid ball has them)");
    element("lab-support").textContent = this.support(state.k);
    triangle.canvas.setAttribute("aria-valuetext", element("lab-J-words").textContent);
    triangle.draw();
    forces.show(state);
  },
  // In words, from the equation A = B |k/(1 - k)| of the two radii.
  support(k) {
    if (k === 1) return "On a plane: k = 1.";
    const size = digits(Math.abs(k / (1 - k)), 3),
      radius = size === "1" ? "of its own radius" : `with ${size} times its radius`;
    const [where, formula] =
      k < 0 ? ["A shell around", "−A/(B − A)"] : k < 1 ? ["On the outside of", "A/(A + B)"] : ["Inside", "A/(A − B)"];
    return `${where} a sphere ${radius}: k = ${formula}, with A of the sphere and B of the ball.`;
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
    const { gravity } = page.effects,
      vertical = gravity ? turned(inverse(now.q), turned(controls.orbit.q[0], gravity.up)) : null;
    this.change({ n: now.n, omega: turned(inverse(now.q), omega), up: vertical });
  },
  setThrowing(on) {
    this.throwing = on;
    element("lab-throw").setAttribute("aria-pressed", String(this.throwing));
    element("lab-throw").textContent = this.throwing ? "Now drag the ball" : "Throw the ball";
    element("ball").parentElement.classList.toggle("throwing", this.throwing);
  },

  // --- the address ---

  NAMES: { k: "k", J: "J", n: "n", omega: "w", level: "level", rotor: "K", weight: "weight", up: "up" },
  rounded: (v) => (Array.isArray(v) ? v.map((x) => +x.toPrecision(12)) : +v.toPrecision(12)),
  address() {
    if (!this.changed()) return [];
    const none = forces.none();
    return Object.entries(this.NAMES)
      .filter(([key]) => String(this.state[key] ?? "") !== String(none[key] ?? ""))
      .map(([key, name]) => `${name}=${this.rounded(this.state[key])}`);
  },
  changed() {
    return JSON.stringify(this.state) !== this.first;
  },
  // Whether the address has another state; if so, it is computed.
  read() {
    const given = new URLSearchParams(location.hash.slice(1)),
      state = { k: 0, J: [], n: [], omega: [], ...forces.none() };
    for (const [key, name] of Object.entries(this.NAMES)) {
      if (!given.has(name)) continue;
      const list = given.get(name).split(",").map(Number),
        size = ["k", "level", "weight"].includes(key) ? 1 : 3;
      if (list.length !== size || !list.every(Number.isFinite)) return false;
      state[key] = size === 1 ? list[0] : list;
    }
    if (!state.k || [state.J, state.n, state.omega].some((v) => v.length !== 3)) return false;
    const same = (key) => String(state[key]) === String(this.state[key] && this.rounded(this.state[key]));
    if (this.state.n && Object.keys(this.NAMES).every(same)) return false;
    const clock = ["t", "tau", "s"].find((name) => Number.isFinite(Number(given.get(name) || NaN)));
    this.change(state, clock && { clock, value: Number(given.get(clock)) });
    return true;
  },

  // --- the beginning ---

  steer() {
    const slider = element("lab-k"),
      stage = element("ball").parentElement;
    slider.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[e.key];
      if (!by) return;
      e.preventDefault(); // steps that leave the special values, and step over 0
      const k = Math.min(3, Math.max(-3, Math.round(20 * this.state.k + by) / 20));
      this.change({ k: Math.abs(k) < 0.1 ? 0.1 * by : k });
    });
    slider.addEventListener("input", () => {
      let k = Number(slider.value);
      for (const special of [-1, 0.5, 1]) if (Math.abs(k - special) < 0.035) k = special;
      if (Math.abs(k) < 0.1) k = k < 0 || (k === 0 && this.state.k > 0) ? -0.1 : 0.1; // there is no k = 0
      this.change({ k });
    });
    element("lab-throw").addEventListener("click", () => this.setThrowing(!this.throwing));
    element("lab-begin").addEventListener("click", () => {
      this.setThrowing(false);
      this.change(JSON.parse(this.first));
    });
    for (const part of [chart, triangle, forces, taken, story]) part.steer();
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
    forces.read(page.effects, this.state);
    this.pictures = controls.pictures;
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
    if (this.pending > 0) return; // the address has a state, or the user was fast
    this.tolerance = "This orbit comes from the page’s file.";
    this.say();
    await this.fill(0);
  },
};
window.isoroll.lab = lab;
lab.begin();
