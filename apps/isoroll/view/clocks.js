// clocks.js - the three clocks: which one runs evenly, what each shows, and how fast the others go.

const clockWords = {
  t: ["t", "the ball’s time"],
  tau: ["τ", "the ball’s Hamiltonian time"],
  s: ["s", "the point’s time"],
};

const raised = (n) => [...String(n)].map((d) => d === "-" ? "⁻" : d === "." ? "·" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("");

// A number with so many significant digits, without zeros at its end.
const digits = (x, count = 6) => {
  if (!Number.isFinite(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const [digit, power] = x.toExponential(count - 1).split("e").map(Number);
  const text = size >= 1e6 || size < 1e-3 ? `${digit}·10${raised(power)}` : String(Number(x.toPrecision(count)));
  return text.replace(/^-/, "−");
};

// For a clock that runs: a fixed number of decimals, so that digits do not jump.
const reading = (x, span) => {
  const decimals = Math.min(8, Math.max(0, 4 - Math.floor(Math.log10(span || 1))));
  return span >= 1e6 || span < 1e-4 ? x.toExponential(5) : x.toFixed(decimals);
};

// A canvas for drawings in pixels of the page; draws anew when its size changes.
function sheet(canvas) {
  const g = canvas.getContext("2d"), box = canvas.getBoundingClientRect(), scale = Math.min(devicePixelRatio, 2);
  const width = Math.max(1, Math.round(box.width)), height = Math.max(1, Math.round(box.height));
  if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
  }
  g.setTransform(scale, 0, 0, scale, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = "12px system-ui, sans-serif";
  return { g, width, height };
}

const clocks = {
  even: page.clock,

  // One button for each clock of the orbit.
  build(orbit) {
    const box = document.getElementById("clocks");
    box.textContent = "";
    this.tiles = {};
    orbit.clocks.forEach((name, i) => {
      const tile = document.createElement("button"), [symbol, words] = clockWords[name];
      tile.setAttribute("role", "radio");
      tile.setAttribute("aria-keyshortcuts", String(i + 1));
      tile.className = "clock";
      tile.own = {};
      tile.style.setProperty("--own", `var(--${name})`);
      for (const part of ["symbol", "words", "value", "rate"]) {
        const span = document.createElement("span");
        span.className = part;
        tile.append(span);
        tile.own[part] = span;
      }
      tile.own.symbol.textContent = symbol;
      tile.own.words.textContent = words;
      tile.addEventListener("click", () => controls.setClock(name));
      box.append(tile);
      this.tiles[name] = tile;
    });
    if (!orbit.clocks.includes(this.even)) this.even = orbit.clocks[0];
    this.measure(orbit);
  },

  // The pace of each clock against the even one, divided by its mean.
  measure(orbit) {
    const last = orbit.count - 1, span = (name) => orbit[name][last] - orbit[name][0];
    this.curves = {};
    for (const name of orbit.clocks) {
      const mean = span(name) / span(this.even), rows = Math.min(orbit.count, 1500);
      this.curves[name] = Array.from({ length: rows }, (_, i) => {
        const row = Math.round(i * last / (rows - 1));
        return [orbit[this.even][row], motion.rate(name, orbit.n[row]) / motion.rate(this.even, orbit.n[row]) / mean];
      });
    }
    this.mean = (name) => span(name) / span(this.even);
    this.spans = Object.fromEntries(orbit.clocks.map((name) => [name, span(name)]));
    for (const name in this.tiles) {
      const on = name === this.even;
      this.tiles[name].setAttribute("aria-checked", String(on));
      this.tiles[name].tabIndex = on ? 0 : -1;
    }
    const others = orbit.clocks.filter((name) => name !== this.even).map((name) => clockWords[name][0]);
    document.getElementById("pace-words").textContent = others.length === 0
      ? "The time runs evenly." : `${clockWords[this.even][0]} runs evenly. The curves: how fast ${others.join(" and ")} ` +
        `${others.length > 1 ? "run" : "runs"} meanwhile, against the mean.`;
  },

  show(now) {
    for (const name in this.tiles) {
      const tile = this.tiles[name];
      tile.own.value.textContent = reading(now[name], this.spans[name]);
      const pace = this.pace(name, now);
      tile.own.rate.textContent = name === this.even ? "runs evenly" : `${pace > 1.02 ? "hurries" : pace < 0.98 ? "waits" : "keeps pace"} ×${pace.toFixed(2)}`;
      tile.own.rate.classList.toggle("even", name === this.even);
    }
  },

  // The pace of a clock now, against its mean.
  pace(name, now) {
    return motion.rate(name, now.n) / motion.rate(this.even, now.n) / this.mean(name);
  },

  // Where there is only t: how high the centre of the ball is, or how fast the ball turns.
  heights(orbit) {
    const up = upOf(orbit), high = page.effects.gravity && body.kind !== "plane";
    const value = high ? (now) => dot(now.centre, up) : (now) => Math.hypot(...now.omega);
    if (this.heightsOf !== orbit) {
      this.heightsOf = orbit;
      this.heightCurve = orbit.t.length > 1 ? Array.from(orbit.t, (t, i) => [t, value(motion.inside(orbit, Math.min(i, orbit.count - 2), i === orbit.count - 1 ? 1 : 0))]) : [];
      document.getElementById("pace-words").textContent = high ? "The curve: how high the centre of the ball is." : "The curve: how fast the ball turns, |ω|.";
    }
    return ["t", this.heightCurve, value];
  },

  // The curves of pace, and a line at the present.
  draw(orbit, now) {
    const { g, width, height } = sheet(document.getElementById("pace")), left = 8, right = width - 54, top = 8, bottom = height - 18;
    const others = orbit.clocks.filter((name) => name !== this.even);
    const column = orbit[this.even], from = column[0], to = column[orbit.count - 1];
    const x = (value) => left + (value - from) / (to - from) * (right - left), style = getComputedStyle(document.body);
    const lines = others.length ? others.map((name) => [name, this.curves[name], (now) => this.pace(name, now)]) : [this.heights(orbit)];
    let low = others.length ? 1 : Infinity, most = others.length ? 1 : -Infinity;
    for (const [, curve] of lines) for (const [, value] of curve) { low = Math.min(low, value); most = Math.max(most, value); }
    const room = Math.max(most - low, 1e-6) * 0.06;
    const y = (value) => bottom - 4 - (value - low + room) / (most - low + 2 * room) * (bottom - 4 - top);
    g.strokeStyle = style.getPropertyValue("--rule");
    g.fillStyle = style.getPropertyValue("--quiet");
    g.lineWidth = 1;
    this.ticks(g, from, to, x, bottom, width);
    g.textAlign = "left";
    if (others.length) {
      const precise = most - low > 0.1 ? 3 : 5, far = (value) => Math.abs(y(value) - y(1)) > 15;
      g.setLineDash([3, 4]);
      g.beginPath(); g.moveTo(left, y(1)); g.lineTo(right, y(1)); g.stroke();
      g.setLineDash([]);
      g.fillText("×1", right + 6, y(1) + 4);
      if (far(most)) g.fillText(`×${digits(most, precise)}`, right + 6, y(most) + 6);
      if (far(low)) g.fillText(`×${digits(low, precise)}`, right + 6, y(low));
    } else for (const value of [low, most]) g.fillText(digits(value, 3), right + 6, y(value) + 4);
    for (const [name, curve] of lines) {
      g.strokeStyle = style.getPropertyValue(`--${name}`);
      g.lineWidth = 1.6;
      g.beginPath();
      for (const [at, value] of curve) g.lineTo(x(at), y(value));
      g.stroke();
    }
    g.strokeStyle = style.getPropertyValue("--text");
    g.lineWidth = 1.5;
    g.beginPath(); g.moveTo(x(now[this.even]), top - 4); g.lineTo(x(now[this.even]), bottom); g.stroke();
    for (const [name, , value] of lines) {
      g.fillStyle = style.getPropertyValue(`--${name}`);
      g.beginPath(); g.arc(x(now[this.even]), y(value(now)), 4, 0, 7); g.fill();
    }
    this.toValue = (pixel) => from + Math.min(1, Math.max(0, (pixel - left) / (right - left))) * (to - from);
  },

  ticks(g, from, to, x, bottom, width) {
    const about = (to - from) / Math.max(2, width / 110), power = 10 ** Math.floor(Math.log10(about));
    const step = [1, 2, 5, 10].map((m) => m * power).find((size) => size >= about);
    g.beginPath(); g.moveTo(x(from), bottom + 0.5); g.lineTo(x(to), bottom + 0.5); g.stroke();
    for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; i++) {
      const at = x(i * step), text = String(+(i * step).toPrecision(10));
      g.beginPath(); g.moveTo(at, bottom); g.lineTo(at, bottom + 4); g.stroke();
      g.textAlign = at < 20 ? "left" : at > width - 30 ? "right" : "center";
      g.fillText(text, at, bottom + 15);
    }
  },
};
