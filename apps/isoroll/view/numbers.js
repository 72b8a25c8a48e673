// numbers.js - the words and numbers of the page. Texts of files are set only by textContent.

const numbers = {
  // A unit from its dimension: (mass length^2)^(a + b/(2k)) / time^c. Scenes of k and J alone have numbers without
  // units.
  unitOf([a, b, c]) {
    if (body.reduced) return "";
    const power = +(a + b / (2 * body.k)).toPrecision(12),
      up = (x) => (x === 1 ? "" : Number.isInteger(x) ? raised(x) : `^${+x.toPrecision(3)}`),
      part = (name, x) => (x > 0 ? [name + up(x)] : []);
    const above = [...part("mass", power), ...part("length", 2 * power), ...part("time", -c)],
      below = [...part("mass", -power), ...part("length", -2 * power), ...part("time", c)];
    const under = below.length > 1 ? `(${below.join("·")})` : below[0];
    return (above.join("·") || "1") + (below.length ? `/${under}` : "");
  },

  // Text with superscripts: "q^{2}".
  write(parent, text) {
    parent.textContent = "";
    text.split(/\^\{([^}]*)\}/).forEach((part, i) => {
      const piece = document.createElement(i % 2 ? "sup" : "span");
      piece.textContent = i % 2 ? `\u2060${part}` : part; // no line ends before a superscript
      parent.append(piece);
    });
  },

  row(table, cells, tag = "td") {
    const line = table.insertRow();
    return cells.map((text, i) => {
      const cell = document.createElement(i === 0 ? "th" : tag);
      cell.textContent = text;
      if (tag === "th") cell.scope = "col";
      else if (i === 0) cell.scope = "row";
      line.append(cell);
      return cell;
    });
  },

  // A drift or difference, relative to its terms.
  small: (x) => (Math.abs(x) <= rounding ? "0 within rounding" : digits(Math.abs(x), 2)),

  build(orbit) {
    const id = (name) => document.getElementById(name);
    id("integrals").textContent = "";
    this.integrals = [];
    this.row(id("integrals"), ["", "value", body.reduced ? "" : "unit", "drift now", "largest"], "th");
    for (const table of tables("drifts"))
      for (const name of Object.keys(table.columns).filter((one) => `${one}.model` in table.lines)) {
        const line = (key) => table.lines[`${name}.${key}`],
          start = Number(line("start"));
        const cells = this.row(id("integrals"), [
          `${name} (${line("model")})`,
          start === 0 ? "0 within rounding" : digits(start, 5),
          this.unitOf([0, 1, 2].map((i) => Number(line(`dimension.${i}`)))),
          "",
          this.small(Number(line("worst"))),
        ]);
        cells[0].title = `${line("model")}: ${line("doc")}`;
        this.integrals.push([cells[3], column(table, name)]);
      }
    id("conserved").hidden = this.integrals.length === 0;
    this.buildDifference(orbit);
    this.buildState(orbit);
  },

  buildDifference(orbit) {
    const table = document.getElementById("differences"),
      { apart } = orbit;
    document.getElementById("agreement").hidden = !apart;
    table.textContent = "";
    this.differences = [];
    if (!apart) return;
    this.row(table, ["", "now", "largest"], "th");
    for (const [name, words] of [
      ["n", "n (ball)"],
      ["gamma", "γ (point)"],
    ]) {
      const cells = this.row(table, [words, "", this.small(Math.max(...apart[name]))]);
      this.differences.push([cells[1], apart[name]]);
    }
    document.getElementById("difference-words").textContent =
      "Each model was integrated by itself, by its own equations, and carried to the other by the map. " +
      "The numbers are lengths of differences of unit vectors: 0.01 means about half a degree. " +
      page.notes.filter((note) => note.includes("the two computations part")).join(" ");
  },

  buildState(orbit) {
    const table = document.getElementById("state"),
      list = [
        ["ω", "omega", this.unitOf([0, 0, 1])],
        ["n", "n", ""],
        ["M", "M", this.unitOf([2, -1, 1])],
        ["γ", "gamma", ""],
        ["contact", "contact", body.reduced ? "radii" : "length"],
      ];
    table.textContent = "";
    this.row(table, ["", "1", "2", "3", body.reduced ? "" : "unit"], "th");
    this.states = [];
    for (const [symbol, name, of] of list)
      if (name === "contact" || orbit[name]) this.states.push([this.row(table, [symbol, "", "", "", of]), name]);
    this.extras = [];
    this.needed = orbit.column("mu"); // grows without bound where contact is lost
    for (const [name, words, of] of [
      ["pressure", "pressure", body.reduced ? "" : "force"],
      ["mu", "mu needed", ""],
      ["friction", "friction", body.reduced ? "" : "force"],
      ["lambda", "twist torque", body.reduced ? "" : "torque"],
    ])
      if (orbit.column(name)) this.extras.push([this.row(table, [words, "", "", "", of])[1], orbit.column(name)]);
  },

  show(now) {
    const row = Math.min(Math.round(now.row), 1e9),
      at = (column) => column[Math.min(row, column.length - 1)];
    for (const [cell, column] of this.integrals) cell.textContent = this.small(at(column));
    for (const [cell, column] of this.differences) cell.textContent = this.small(at(column));
    for (const [cells, name] of this.states)
      for (let i = 0; i < 3; i++) cells[i + 1].textContent = steady(now[name][i], Math.hypot(...now[name]));
    for (const [cell, column] of this.extras) {
      const none = column === this.needed && at(column) > 1e9; // no friction is enough
      cell.textContent = none ? "∞" : digits(at(column));
    }
  },

  // --- what does not change ---

  describe(orbit) {
    for (const name of ["about", "notes", "left-legend", "right-legend"]) element(name).textContent = "";
    const id = element,
      { kind, A, B, k } = body;
    const where = {
      plane: "on a plane",
      outside: "on a sphere",
      inside: "inside a sphere",
      shell: "around a smaller sphere",
    }[kind];
    const falls = page.effects.gravity ? ", under gravity," : "",
      twists = page.effects.twist ? "" : " or twisting",
      lost = page.notes.some((note) => note.startsWith("contact is lost")) ? "; contact is lost at the end" : "";
    const ball = `${kind === "shell" ? "A hollow ball" : "A ball"} rolls ${where}`;
    id("title").textContent = page.alone
      ? `${ball}${falls.replace(/,$/, "")}`
      : page.kind === "section"
        ? "Orbits of one energy: a rolling ball, and the point that is its twin"
        : "One orbit in two worlds: a rolling ball, and the point that is its twin";
    document.title = `${page.title} – ${id("title").textContent}`;
    this.write(
      id("lead"),
      page.alone
        ? `It rolls without slipping${twists}.`
        : `${ball} without slipping or twisting. It touches at n; the point, by its own equations, is at ` +
            "γ = J^{−1/2} n / |J^{−1/2} n|. Only their clocks differ.",
    );
    this.captions(false);
    id("left-words").textContent += lost;
    if (page.alone) id("left-words").textContent += `. It has no twin among the points: ${page.alone}.`;
    id("right").hidden = id("compare").hidden = Boolean(page.alone);
    document.body.classList.toggle("single", Boolean(page.alone));
    this.legends();
    const about = [
      ["file", page.title],
      ["k", `${digits(k)} (${kind})`],
      ["J", body.J.map((x) => digits(x)).join(", ")],
    ];
    about.push(["ball radius B", body.reduced ? "1 (unit of length)" : digits(B)]);
    if (kind !== "plane") about.push(["sphere radius A", digits(A)]);
    if (page.h !== null) about.push(["energy h", `${digits(page.h)} ${this.unitOf([1, 0, 2])}`]);
    if (page.eps !== null) about.push(["coupling ε", `${digits(page.eps)} ${this.unitOf([4, 0, 2])}`]);
    const own = page.attitude ? ["clock"] : ["clock", "attitude"], // what the page itself needs
      effects = Object.keys(page.effects).filter((name) => !own.includes(name));
    if (effects.length) about.push(["effects", effects.join(", ")]);
    about.push(["made by", `isoroll ${page.version}`]);
    for (const [term, text] of about) {
      const dt = document.createElement("dt"),
        dd = document.createElement("dd");
      dt.textContent = term;
      dd.textContent = text;
      id("about").append(dt, dd);
    }
    for (const note of this.notes(orbit)) {
      const li = document.createElement("li");
      li.textContent = note;
      id("notes").append(li);
    }
  },

  // V with its formula (24).
  potentialWords() {
    const { k } = body,
      named = { "-1": "Neumann’s potential ", 1: "Braden’s potential " }[k] || "the potential ",
      power = k === -1 ? "" : k === 1 ? "^{−1}" : `^{${digits(-1 / k, 4)}}`;
    const magnetic = page.effects.rotor ? ", and in a magnetic field, that of the rotor" : "";
    return page.effects.field
      ? `moves in the potential V = (U(n) − h) (det J / k^{2}) (γ, Jγ)${power}${magnetic}`
      : `moves in ${named}V = −ε (γ, Jγ)${power}${magnetic}`;
  },

  // Of the two pictures: as they move, or compared.
  captions(compared) {
    const put = (side, name, words) => {
      document.getElementById(`${side}-name`).textContent = name;
      this.write(document.getElementById(`${side}-words`), words);
    };
    put(
      "left",
      "The ball",
      compared
        ? "– where it touches, n, in its own axes"
        : {
            plane: "rolls on a plane",
            outside: "rolls on the outside of a sphere",
            inside: "rolls inside a sphere",
            shell: "is hollow and rolls around a sphere",
          }[body.kind],
    );
    put("right", "The point", compared ? "– its place, γ = J^{−1/2} n / |J^{−1/2} n|" : this.potentialWords());
  },

  notes(orbit) {
    const list = [...page.notes],
      { total, every, between } = tables("trajectory")[0].lines; // none of a section's orbit
    if (every > 1) list.push(`The page has 1 row of every ${every}: ${orbit.count} of ${total}.`);
    else if (between > 0) list.push(`The page has the scene’s ${total} rows, and ${between} more after each but the last.`);
    else if (total) list.push(`The page has all ${total} rows.`);
    list.push("Between rows the motion is interpolated by cubic curves with the slopes of the equations of motion.");
    list.push(`${page.alone ? "ω and n" : "ω, n, M and γ"} are in the ball’s axes, the contact is in axes of space.`);
    if (tables("drifts").length)
      list.push("Drift: change of an integral since the first row, divided by the size of its terms.");
    if (body.reduced)
      list.push("The scene gives k and J alone: its numbers have no units, but those of its own mass, length and time.");
    else if (orbit.tau)
      list.push(`Units: t: time; τ: ${this.unitOf([1, -1, -1])}; s: ${this.unitOf([-2, 1, -1])}, as in the file.`);
    return list;
  },

  legends() {
    const put = (list, items) =>
      items.forEach(([colour, text, kind]) => {
        const li = document.createElement("li"),
          mark = document.createElement("i");
        mark.className = kind || "line";
        if (colour) mark.style.background = colour;
        li.append(mark, text);
        document.getElementById(list).append(li);
      });
    put("left-legend", [
      [colours.curve, "contact on the ball"],
      [colours.support, body.kind === "plane" ? "contact on the plane" : "contact on the sphere"],
    ]);
    if (!page.alone) {
      put("right-legend", [[colours.curve, "path of the point"]]);
      if (potential.levels)
        put("right-legend", [
          [
            null,
            `V from ${digits(potential.least, 3)} (dark: the point is fast) to ` +
              `${`${digits(potential.most, 3)} ${this.unitOf([4, -2, 2])}`.trim()}${potential.logarithmic ? ", logarithmic" : ""}`,
            "scale",
          ],
        ]);
    }
  },
};
