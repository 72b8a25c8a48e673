// clocks.js - the three clocks: which one runs evenly, what each shows, and how fast the others run.

const clockWords = {
  t: ["t", "the ball’s time"],
  tau: ["τ", "the ball’s Hamiltonian time"],
  s: ["s", "the point’s time"],
};

const raised = (n) => [...String(n)].map((d) => (d === "-" ? "⁻" : d === "." ? "·" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[d])).join("");

// A number with `count` significant digits, without zeros at its end.
const digits = (x, count = 6) => {
  if (!Number.isFinite(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const [digit, power] = x
    .toExponential(count - 1)
    .split("e")
    .map(Number);
  const text = size >= 1e6 || size < 1e-3 ? `${digit}·10${raised(power)}` : String(Number(x.toPrecision(count)));
  return text.replace(/^-/, "−");
};

// A component of a vector that moves: four decimals, or four digits where the vector is large or small. What is
// smaller than `rounding` times the vector is 0 within rounding.
const rounding = 16 * 2 ** -52;
const steady = (x, size) =>
  Math.abs(x) < rounding * size ? "0" : size >= 0.1 && size < 1e4 ? x.toFixed(4).replace("-", "−") : digits(x, 4);

// For a clock that runs: a fixed number of decimals, so that digits do not jump.
const reading = (x, span) => {
  const decimals = Math.min(8, Math.max(0, 4 - Math.floor(Math.log10(span || 1))));
  return span >= 1e6 || span < 1e-4 ? digits(x) : x.toFixed(decimals);
};

// Which colour is what, [colour, words] for each curve or dot, and then a sentence.
function legend(parent, items, sentence = "", kind = "line") {
  parent.replaceChildren();
  for (const [colour, words] of items) {
    const part = document.createElement("span"),
      mark = document.createElement("i");
    part.className = "key";
    mark.className = kind;
    mark.style.background = colour;
    part.append(mark, words);
    parent.append(part);
  }
  parent.append(sentence);
}

// A canvas for drawings in pixels of the page; draws anew when its size changes.
function sheet(canvas) {
  const g = canvas.getContext("2d"),
    box = canvas.getBoundingClientRect(),
    scale = Math.min(devicePixelRatio, 2);
  const width = Math.max(1, Math.round(box.width)),
    height = Math.max(1, Math.round(box.height));
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
      const tile = document.createElement("button"),
        [symbol, words] = clockWords[name];
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

  // How much each clock gains over the orbit; which button is chosen.
  measure(orbit) {
    const last = orbit.count - 1;
    this.spans = Object.fromEntries(orbit.clocks.map((name) => [name, orbit[name][last] - orbit[name][0]]));
    for (const name in this.tiles) {
      const on = name === this.even;
      this.tiles[name].setAttribute("aria-checked", String(on));
      this.tiles[name].tabIndex = on ? 0 : -1;
    }
    pace.build(orbit);
  },

  show(now) {
    for (const name in this.tiles) {
      const tile = this.tiles[name];
      tile.own.value.textContent = reading(now[name], this.spans[name]);
      const pace = this.pace(name, now.n);
      tile.own.rate.textContent =
        name === this.even
          ? "runs evenly"
          : `${pace > 1.02 ? "faster" : pace < 0.98 ? "slower" : "mean speed"} ×${pace >= 0.1 && pace < 1e4 ? pace.toFixed(2) : digits(pace, 2)}`;
      tile.own.rate.classList.toggle("even", name === this.even);
    }
  },

  // The pace of a clock where the normal is n: its rate by the even clock, divided by the mean of that rate.
  pace(name, n) {
    return ((motion.rate(name, n) / motion.rate(this.even, n)) * this.spans[this.even]) / this.spans[name];
  },
};
