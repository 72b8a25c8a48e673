// main.js - the player: time, what is shown, buttons, keys.

const element = (name) => document.getElementById(name);

const controls = {
  playing: false,
  value: 0, // of the even clock
  speed: 1,
  drawn: 0, // frames so far
  dirty: true,
  compared: false, // the paths lie side by side in the ball's axes
  beside: false, // the neighbour is shown
  quality: 1, // of the resolution
  slow: 20,
  before: 0,
  resting: 0,

  // --- time ---

  range() {
    const column = this.orbit[clocks.even];
    return [column[0], column[this.orbit.count - 1]];
  },
  seek(value) {
    const [from, to] = this.range();
    this.value = Math.min(to, Math.max(from, value));
    this.now = motion.at(this.orbit, clocks.even, this.value);
    this.changed();
  },
  setClock(name) {
    if (!this.orbit.clocks.includes(name)) return;
    const value = this.now[name];
    clocks.even = name;
    clocks.measure(this.orbit);
    stretch.key = null;
    this.setRange();
    this.seek(value);
  },
  play(on = !this.playing) {
    const [from, to] = this.range();
    if (on && this.value >= to) this.seek(from);
    this.playing = on;
    this.last = null;
    this.changed();
  },
  changed() {
    this.dirty = true;
  },

  setOrbit(orbit) {
    this.orbit = orbit;
    const moments = motion.moments(orbit, 0.08);
    stretch.measure(orbit);
    growth.build(orbit);
    clocks.build(orbit);
    if (!orbit.near && this.beside) this.showBeside(false);
    for (const picture of [...this.pictures, ...(this.paths || [])]) picture.setOrbit(orbit, moments);
    if (sections) sections.setOrbit(orbit);
    numbers.build(orbit);
    // speed 1×: the ball turns by about 1.5 radians in a second; the whole takes 8 to 240 seconds
    const last = orbit.count - 1,
      turns = orbit.omega.reduce((sum, w, i) => (i ? sum + Math.hypot(...w) * (orbit.t[i] - orbit.t[i - 1]) : 0), 0);
    this.seconds = Math.min(240, Math.max(8, (turns * Math.max(1, Math.abs(body.k))) / 1.5));
    this.long = turns > 60;
    this.setRange();
    this.seek(orbit[clocks.even][0]);
    this.last = last;
  },
  setRange() {
    const [from, to] = this.range(),
      scrub = element("scrub");
    scrub.min = from;
    scrub.max = to;
    scrub.step = "any";
  },

  // How much of the trail is bright, in radii of the sphere that it lies on.
  trail() {
    const choice = element("trail").value;
    return choice === "short" ? { length: 3, whole: false } : { length: choice === "long" ? 14 : 1e9, whole: true };
  },

  // --- frames ---

  tick(milliseconds) {
    requestAnimationFrame((next) => this.tick(next));
    if (this.playing) {
      const [from, to] = this.range(),
        since = this.last === null ? 0 : Math.min(200, milliseconds - this.last) / 1000;
      this.last = milliseconds;
      this.seek(this.value + (since * this.speed * (to - from)) / this.seconds);
      if (this.value >= to) {
        this.play(false);
        film.ended();
      }
    }
    this.adapt(milliseconds);
    if (!this.dirty) {
      if (milliseconds - this.resting > 300) address.write();
      return;
    }
    this.dirty = false;
    this.draw();
    film.step();
  },
  // Slow computers draw with fewer pixels while things move, and with all pixels when they stand still.
  adapt(milliseconds) {
    const since = milliseconds - this.before;
    this.before = milliseconds;
    if (this.dirty) {
      this.resting = milliseconds;
      this.slow = since < 1000 ? 0.8 * this.slow + 0.2 * since : this.slow;
      if (this.slow > 34 && this.quality > 0.45) this.setQuality(this.quality * 0.8);
    } else if (this.quality < graphics.best && milliseconds - this.resting > 400) this.setQuality(graphics.best);
  },
  setQuality(quality) {
    this.quality = quality;
    this.slow = 20;
    for (const picture of [...this.pictures, ...(this.paths || [])]) picture.quality = quality;
    this.resize();
  },
  draw() {
    const { now } = this,
      scrub = element("scrub"),
      button = element("play");
    const label = this.playing ? "Pause" : this.value >= this.range()[1] ? "Play again" : "Play";
    if (button.textContent !== label) button.textContent = label;
    scrub.value = this.value;
    scrub.setAttribute("aria-valuetext", `${clockWords[clocks.even][0]} = ${digits(this.value)}`);
    element("reading").textContent = `${clockWords[clocks.even][0]} = ${reading(this.value, clocks.spans[clocks.even])}`;
    for (const picture of this.shown()) {
      picture.show(now, this.trail());
      picture.draw();
    }
    clocks.show(now);
    growth.draw(now);
    pace.draw(now);
    if (sections) sections.draw(now);
    if (!this.playing || this.drawn % 4 === 0) numbers.show(now); // faster than this nobody can read
    this.drawn++;
  },
  resize() {
    for (const picture of this.shown()) picture.resize();
    this.changed();
  },

  // --- what is shown ---

  // The pictures that are seen: as the models move, or compared.
  shown() {
    return this.compared ? this.paths : this.pictures;
  },
  compare(on) {
    if (page.alone) return;
    this.compared = on;
    if (on && !this.paths)
      this.paths = [
        new PathPicture(this.canvasIn("ball"), "n", "the ball: n"),
        new PathPicture(this.canvasIn("point"), "gamma", "the point: γ"),
      ];
    for (const [list, seen] of [
      [this.pictures, !on],
      [this.paths || [], on],
    ])
      for (const { canvas, marks } of list) canvas.hidden = marks.canvas.hidden = !seen;
    document.body.classList.toggle("compared", on);
    element("compare").setAttribute("aria-pressed", String(on));
    for (const id of ["left-legend", "right-legend", "trail-label", "frame-label"]) element(id).hidden = on;
    numbers.captions(on);
    pace.build(this.orbit);
    this.resize();
  },
  // A canvas for a compared path, in the same place as another.
  canvasIn(name) {
    const canvas = document.createElement("canvas");
    canvas.id = `${name}-path`;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `The path of the ${name} in the ball’s axes. Arrow keys turn the view.`);
    element(name).after(canvas);
    return canvas;
  },
  showBeside(on) {
    on = on && Boolean(this.orbit.near);
    this.beside = on;
    element("beside").setAttribute("aria-pressed", String(on));
    element("growth").hidden = element("beside-words").hidden = !on;
    document.body.classList.toggle("with-neighbour", on);
    this.resize();
  },

  // --- buttons and keys ---

  steer() {
    const speeds = [0.125, 0.25, 0.5, 1, 2, 4, 8],
      select = element("speed");
    for (const speed of speeds)
      select.append(new Option(`${speed < 1 ? "1/" + 1 / speed : speed}×`, String(speed), false, speed === 1));
    select.addEventListener("change", () => {
      this.speed = Number(select.value);
    });
    element("play").addEventListener("click", () => this.play());
    element("scrub").addEventListener("input", (e) => {
      this.play(false);
      this.seek(Number(e.target.value));
    });
    element("trail").addEventListener("change", () => this.changed());
    element("reset").addEventListener("click", () => {
      camera.reset();
      this.changed();
    });
    element("picture").addEventListener("click", () => film.savePicture());
    element("film").addEventListener("click", () => film.record());
    element("film").hidden = !window.MediaRecorder;
    element("compare").addEventListener("click", () => this.compare(!this.compared));
    element("beside").addEventListener("click", () => this.showBeside(!this.beside));
    element("screen").hidden = !document.fullscreenEnabled;
    element("screen").addEventListener("click", () =>
      document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen(),
    );
    this.offerFrames();
    element("frame").addEventListener("change", (e) => {
      this.pictures[0].from = e.target.value;
      this.changed();
    });
    const strip = element("pace"),
      drag = (e) => {
        if (e.buttons && !this.compared) {
          this.play(false);
          this.seek(pace.toValue(e.clientX - strip.getBoundingClientRect().left));
        }
      };
    strip.addEventListener("pointerdown", (e) => {
      strip.setPointerCapture(e.pointerId);
      drag(e);
    });
    strip.addEventListener("pointermove", drag);
    element("clocks").addEventListener("keydown", (e) => this.turnRadio(e));
    document.addEventListener("keydown", (e) => this.key(e));
    addEventListener("resize", () => this.resize());
    addEventListener("hashchange", () => address.read());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      for (const picture of [...this.pictures, ...(this.paths || [])]) picture.recolour();
      this.changed();
    });
  },
  // From where the ball can be watched.
  offerFrames() {
    const frames = [
      ["follow", "beside the ball"],
      ["ball", "the ball itself"],
    ];
    if (body.large && !body.flat) frames.push(["room", "the room"]);
    else if (!body.flat) frames.unshift(["room", "the room"]);
    element("frame").replaceChildren(...frames.map(([value, words]) => new Option(words, value)));
  },
  turnRadio(e) {
    const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[e.key],
      list = this.orbit.clocks;
    if (!by) return;
    const next = list[(list.indexOf(clocks.even) + by + list.length) % list.length];
    this.setClock(next);
    clocks.tiles[next].focus();
    e.preventDefault();
    e.stopPropagation();
  },
  key(e) {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const tag = e.target.tagName,
      [from, to] = this.range(),
      step = (to - from) / (e.shiftKey ? 1000 : 100);
    if (tag === "SELECT" || (tag === "BUTTON" && (e.key === " " || e.key === "Enter"))) return;
    if (tag === "INPUT" && e.target.id !== "scrub" && /^(Arrow|Home|End|Page)/.test(e.key)) return; // a slider of its own
    const jump = (value) => {
      this.play(false);
      this.seek(value);
    };
    const act = {
      " ": () => this.play(),
      ArrowLeft: () => jump(this.value - step),
      ArrowRight: () => jump(this.value + step),
      Home: () => jump(from),
      End: () => jump(to),
      "+": () => this.hurry(1),
      "-": () => this.hurry(-1),
    }[e.key];
    if (act) act();
    else if (/^[123]$/.test(e.key) && this.orbit.clocks[e.key - 1]) this.setClock(this.orbit.clocks[e.key - 1]);
    else return;
    e.preventDefault();
  },
  hurry(by) {
    const select = element("speed");
    select.selectedIndex = Math.min(select.options.length - 1, Math.max(0, select.selectedIndex + by));
    this.speed = Number(select.value);
  },

  // --- the beginning ---

  begin() {
    this.orbit = orbitOf(sections ? sections.chosen : undefined);
    this.pictures = [new BallPicture(element("ball")), ...(page.alone ? [] : [new PointPicture(element("point"))])];
    element("trouble").hidden = graphics.there;
    if (!graphics.there) element("trouble").textContent = "This browser has no WebGL: the pictures are line drawings.";
    clocks.even = page.clock;
    this.steer();
    numbers.describe(this.orbit);
    camera.face((this.orbit.gamma || this.orbit.n)[0]);
    this.setOrbit(this.orbit);
    this.last = null;
    this.resize();
    const told = address.read();
    this.draw();
    if (!told && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.play(true);
    requestAnimationFrame((now) => this.tick(now));
  },
};

// For tests and for the browser's console.
window.isoroll = {
  time: () => controls.value,
  clock: () => clocks.even,
  seek: (value) => {
    controls.play(false);
    controls.seek(value);
    return window.isoroll.state();
  },
  setClock: (name) => controls.setClock(name),
  play: (on) => controls.play(on),
  range: () => controls.range(),
  drawn: () => controls.drawn,
  state: () => ({ ...controls.now, clock: clocks.even, playing: controls.playing, speed: controls.speed }),
  sections: () => sections,
};

controls.begin();
