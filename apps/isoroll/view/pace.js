// pace.js - the curves above the slider: how fast the other clocks run while one runs evenly. If t is the only clock:
// how high the ball is, or how fast it turns.

const pace = {
  canvas: document.getElementById("pace"),

  build(orbit) {
    const others = orbit.clocks.filter((name) => name !== clocks.even),
      column = orbit[clocks.even];
    this.from = column[0];
    this.to = column[orbit.count - 1];
    this.relative = others.length > 0;
    this.lines = others.map((name) => ({ name, value: (now) => clocks.pace(name, now.n) }));
    if (!this.relative) this.lines = [this.height(orbit)];
    for (const line of this.lines)
      line.curve = Array.from(column, (at, i) => [
        at,
        line.value({ n: orbit.n[i], omega: orbit.omega[i], q: orbit.q[i] }),
      ]);
    const values = this.lines.flatMap((line) => line.curve.map((point) => point[1])).concat(this.relative ? 1 : []);
    this.low = values.reduce((a, b) => Math.min(a, b));
    this.most = values.reduce((a, b) => Math.max(a, b));
    this.key = null;
    const words = document.getElementById("pace-words"),
      items = this.lines.map(({ name, words: what }) => [`var(--${name})`, what || `how fast ${clockWords[name][0]} runs`]);
    if (controls.compared) words.textContent = ladder.words();
    else legend(words, items, this.relative ? `${clockWords[clocks.even][0]} runs evenly; ×1 is the mean pace.` : "");
  },

  height(orbit) {
    const up = upOf(orbit);
    if (page.effects.gravity && body.kind !== "plane")
      return {
        name: "t",
        words: "height of the ball’s centre above the sphere’s centre, in units of length",
        value: (now) => dot(turned(now.q, now.n), up) * (body.A + body.b),
      };
    const words = "how fast the ball turns, |ω| in radians/time";
    return { name: "t", words, value: (now) => Math.hypot(...now.omega) };
  },

  // From times and values to pixels.
  scales(width, height) {
    const left = 8,
      right = width - 70,
      top = 8,
      bottom = height - 18,
      room = Math.max(this.most - this.low, 1e-6) * 0.06;
    return {
      left,
      right,
      top,
      bottom,
      x: (value) => left + ((value - this.from) / (this.to - this.from)) * (right - left),
      y: (value) => bottom - 4 - ((value - this.low + room) / (this.most - this.low + 2 * room)) * (bottom - 4 - top),
    };
  },

  // The picture without what moves, drawn once for each size and theme.
  background(width, height) {
    const key = [width, height, isDark(), devicePixelRatio].join();
    if (this.key === key) return this.image;
    const scale = Math.min(devicePixelRatio, 2),
      image = document.createElement("canvas"),
      g = image.getContext("2d");
    const { left, right, bottom, x, y } = this.scales(width, height),
      style = getComputedStyle(document.body);
    image.width = width * scale;
    image.height = height * scale;
    g.scale(scale, scale);
    g.font = "12px system-ui, sans-serif";
    g.strokeStyle = style.getPropertyValue("--rule");
    g.fillStyle = style.getPropertyValue("--quiet");
    this.ticks(g, x, bottom, width);
    g.textAlign = "left";
    if (this.relative) this.mean(g, left, right, y);
    else for (const value of [this.low, this.most]) g.fillText(digits(value, 3), right + 6, y(value) + 4);
    for (const { name, curve } of this.lines) {
      g.strokeStyle = style.getPropertyValue(`--${name}`);
      g.lineWidth = 1.6;
      g.beginPath();
      for (const [at, value] of curve) g.lineTo(x(at), y(value));
      g.stroke();
    }
    Object.assign(this, { key, image });
    return image;
  },

  // A broken line at the mean pace ×1, and the numbers of the largest and the least pace.
  mean(g, left, right, y) {
    const precise = this.most - this.low > 0.1 ? 3 : 5,
      isFar = (value) => Math.abs(y(value) - y(1)) > 15;
    g.setLineDash([3, 4]);
    g.beginPath();
    g.moveTo(left, y(1));
    g.lineTo(right, y(1));
    g.stroke();
    g.setLineDash([]);
    g.fillText("×1", right + 6, y(1) + 4);
    if (isFar(this.most)) g.fillText(`×${digits(this.most, precise)}`, right + 6, y(this.most) + 6);
    if (isFar(this.low)) g.fillText(`×${digits(this.low, precise)}`, right + 6, y(this.low));
  },

  ticks(g, x, bottom, width) {
    const { from, to } = this,
      about = (to - from) / Math.max(2, width / 110),
      power = 10 ** Math.floor(Math.log10(about));
    const step = [1, 2, 5, 10].map((m) => m * power).find((size) => size >= about);
    g.beginPath();
    g.moveTo(x(from), bottom + 0.5);
    g.lineTo(x(to), bottom + 0.5);
    g.stroke();
    for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; i++) {
      const at = x(i * step);
      g.beginPath();
      g.moveTo(at, bottom);
      g.lineTo(at, bottom + 4);
      g.stroke();
      g.textAlign = at < 20 ? "left" : at > width - 30 ? "right" : "center";
      g.fillText(digits(Number((i * step).toPrecision(10))), at, bottom + 15);
    }
  },

  // The curves, a line at the present, and a spot on each curve there.
  draw(now) {
    if (controls.compared) return ladder.draw(this.canvas, now);
    const { g, width, height } = sheet(this.canvas),
      { left, right, top, bottom, x, y } = this.scales(width, height);
    const style = getComputedStyle(document.body),
      at = x(now[clocks.even]);
    g.drawImage(this.background(width, height), 0, 0, width, height);
    g.strokeStyle = style.getPropertyValue("--text");
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(at, top - 4);
    g.lineTo(at, bottom);
    g.stroke();
    for (const { name, value } of this.lines) {
      g.fillStyle = style.getPropertyValue(`--${name}`);
      g.beginPath();
      g.arc(at, y(value(now)), 4, 0, 7);
      g.fill();
    }
    this.toValue = (pixel) =>
      this.from + Math.min(1, Math.max(0, (pixel - left) / (right - left))) * (this.to - this.from);
  },
};
