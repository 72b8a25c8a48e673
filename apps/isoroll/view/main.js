// main.js - the player: time, buttons, keys, pictures as files.

const element = (name) => document.getElementById(name);

const controls = {
  playing: false,
  value: 0, // of the even clock
  speed: 1,
  drawn: 0, // frames so far
  dirty: true,
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
    clocks.build(orbit);
    if (this.pictures) for (const picture of this.pictures) picture.setOrbit(orbit, moments);
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
      if (this.value >= to) this.play(false);
    }
    this.adapt(milliseconds);
    if (!this.dirty) return;
    this.dirty = false;
    this.draw();
  },
  // Slow computers draw with fewer pixels while things move, and with all pixels when they stand still.
  adapt(milliseconds) {
    const since = milliseconds - this.before;
    this.before = milliseconds;
    if (!this.pictures) return;
    if (this.dirty) {
      this.resting = milliseconds;
      this.slow = since < 1000 ? 0.8 * this.slow + 0.2 * since : this.slow;
      if (this.slow > 34 && this.quality > 0.45) this.setQuality(this.quality * 0.8);
    } else if (this.quality < graphics.best && milliseconds - this.resting > 400) this.setQuality(graphics.best);
  },
  setQuality(quality) {
    this.quality = quality;
    this.slow = 20;
    for (const picture of this.pictures) picture.quality = quality;
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
    if (this.pictures)
      for (const picture of this.pictures) {
        picture.show(now, this.trail());
        picture.draw();
      }
    clocks.show(now);
    pace.draw(now);
    if (sections) sections.draw(now);
    if (!this.playing || this.drawn % 4 === 0) numbers.show(now); // faster than this nobody can read
    this.drawn++;
  },
  resize() {
    if (this.pictures) for (const picture of this.pictures) picture.resize();
    this.changed();
  },

  // --- pictures as files ---

  // Both models side by side on one canvas of this size.
  compose(width, height) {
    const canvas = document.createElement("canvas"),
      g = canvas.getContext("2d"),
      style = getComputedStyle(document.body);
    canvas.width = width;
    canvas.height = height;
    g.fillStyle = style.getPropertyValue("--page");
    g.fillRect(0, 0, width, height);
    const head = Math.round(height * 0.09),
      foot = Math.round(height * 0.09),
      half = width / 2;
    this.pictures.forEach((picture, i) => {
      picture.renderer.setPixelRatio(2); // smooth edges
      picture.renderer.setSize(half, height - head - foot, false);
      picture.shape(half / (height - head - foot));
      picture.show(this.now, this.trail());
      picture.draw();
      g.drawImage(picture.canvas, i * half, head, half, height - head - foot);
    });
    g.fillStyle = style.getPropertyValue("--text");
    g.textAlign = "center";
    g.font = `600 ${Math.round(head * 0.42)}px system-ui, sans-serif`;
    g.fillText("the ball", half / 2, head * 0.65);
    g.fillText(page.alone ? "the contact, in the ball’s axes" : "the point", half * 1.5, head * 0.65);
    g.font = `${Math.round(foot * 0.36)}px ui-monospace, monospace`;
    const several = this.orbit.clocks.length > 1;
    const words = this.orbit.clocks.map((name) => {
      const text = `${clockWords[name][0]} = ${reading(this.now[name], clocks.spans[name])}`;
      return several && name === clocks.even ? `${text} (even)` : text;
    });
    words.forEach((text, i) => {
      g.fillStyle = style.getPropertyValue(`--${this.orbit.clocks[i]}`);
      g.fillText(text, (width * (i + 1)) / (words.length + 1), height - foot * 0.4);
    });
    return canvas;
  },
  savePicture() {
    const canvas = this.compose(1920, 1080);
    this.resize();
    canvas.toBlob((blob) => {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(blob);
      link.download = `${page.title.replace(/[^\w.-]+/g, "_")}.png`;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  },
  // For `isoroll view --frames`: #frames=FIRST,COUNT,ALL writes these pictures as text.
  writeFrames(first, count, all) {
    const [from, to] = this.range(),
      out = document.createElement("pre");
    out.id = "frames";
    out.append("\n");
    for (let i = first; i < first + count; i++) {
      this.seek(from + (to - from) * (all > 1 ? i / (all - 1) : 0));
      out.append(`\nframe ${i} ${this.compose(1280, 720).toDataURL("image/png")}\n`);
    }
    document.body.append(out);
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
    element("picture").addEventListener("click", () => this.savePicture());
    const frames = [
      ["follow", "beside the ball"],
      ["ball", "the ball itself"],
    ];
    if (body.large && !body.flat) frames.push(["room", "the room"]);
    else if (!body.flat) frames.unshift(["room", "the room"]);
    for (const [value, words] of frames) element("frame").append(new Option(words, value));
    element("frame").addEventListener("change", (e) => {
      if (this.pictures) this.pictures[0].from = e.target.value;
      this.changed();
    });
    const strip = element("pace"),
      drag = (e) => {
        if (e.buttons) {
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
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      if (this.pictures) for (const picture of this.pictures) picture.recolour();
      this.changed();
    });
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
    this.orbit = orbitOf(page.rows || page.section.list[0]);
    if (graphics.there)
      this.pictures = [new BallPicture(element("ball")), new PointPicture(element("point"), !page.alone)];
    else {
      element("trouble").hidden = false;
      element("trouble").textContent =
        "This browser has no WebGL, so the pictures in space are missing. Clocks and numbers work without it.";
      element("models").hidden = true;
      element("picture").hidden = true;
    }
    clocks.even = page.clock;
    this.steer();
    numbers.describe(this.orbit);
    camera.face((this.orbit.gamma || this.orbit.n)[0]);
    this.setOrbit(this.orbit);
    this.last = null;
    const frames = /^#frames=(\d+),(\d+),(\d+)$/.exec(location.hash);
    if (frames && this.pictures) return this.writeFrames(...frames.slice(1).map(Number));
    this.resize();
    this.draw();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.play(true);
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
