// numbers.js - the words and numbers of the page. Texts of files are set only by textContent.

const numbers = {
  // A unit from its dimension: J^(a + b/(2k)) / time^c, where J stands for the unit of moments of inertia.
  unitOf([a, b, c]) {
    const power = a + b / (2 * body.k),
      up = (x) => (x === 1 ? "" : Number.isInteger(x) ? raised(x) : `^${+x.toPrecision(3)}`);
    const J = Math.abs(power) < 1e-12 ? "" : `J${up(power)}`;
    if (c === 0) return J || "1";
    return c > 0 ? `${J || "1"}/time${up(c)}` : `${J ? J + "·" : ""}time${up(-c)}`;
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

  small: (x) => digits(Math.abs(x), 2),

  build(orbit) {
    const id = (name) => document.getElementById(name);
    id("conserved").hidden = page.integrals.length === 0;
    id("integrals").textContent = "";
    this.integrals = [];
    const head = () => this.row(id("integrals"), ["", "value", "unit", "drift now", "largest"], "th");
    if (page.integrals.length) head();
    page.integrals.forEach((one, i) => {
      const cells = this.row(id("integrals"), [
        `${one.name} (${one.model})`,
        digits(one.start, 5),
        this.unitOf(one.dimension),
        "",
        this.small(one.worst),
      ]);
      cells[0].title = `${one.model}: ${one.doc}`;
      this.integrals.push([cells[3], orbit.column[`drift${i}`]]);
    });
    this.buildDifference(orbit);
    this.buildState(orbit);
  },

  buildDifference(orbit) {
    const table = document.getElementById("differences"),
      has = orbit.column.apart_n;
    document.getElementById("agreement").hidden = !has;
    table.textContent = "";
    this.differences = [];
    if (!has) return;
    this.row(table, ["", "now", "largest"], "th");
    for (const [name, words] of [
      ["apart_n", "n (ball)"],
      ["apart_gamma", "γ (point)"],
    ]) {
      const cells = this.row(table, [words, "", this.small(Math.max(...orbit.column[name]))]);
      this.differences.push([cells[1], orbit.column[name]]);
    }
    document.getElementById("difference-words").textContent =
      "Each model was integrated by itself, by its own equations, and carried to the other by the map. " +
      "The numbers are lengths of differences of unit vectors: 0.01 means about half a degree. " +
      page.notes.filter((note) => note.includes("the two computations part")).join(" ");
  },

  buildState(orbit) {
    const table = document.getElementById("state"),
      list = [
        ["ω", "omega", "1/time"],
        ["n", "n", "1"],
        ["M", "M", ""],
        ["γ", "gamma", "1"],
        ["contact", "contact", body.reduced ? "radii" : "length"],
      ];
    table.textContent = "";
    this.row(table, ["", "1", "2", "3", "unit"], "th");
    this.states = [];
    const M = this.unitOf([2, -1, 1]);
    for (const [symbol, name, of] of list)
      if (name === "contact" || orbit[name])
        this.states.push([this.row(table, [symbol, "", "", "", name === "M" ? M : of]), name]);
    this.extras = [];
    this.needed = orbit.column.mu; // grows without bound where contact is lost
    for (const [name, words, of] of [
      ["pressure", "pressure", "force"],
      ["mu", "mu needed", "1"],
      ["friction", "friction", "force"],
      ["lambda", "twist torque", "torque"],
    ])
      if (orbit.column[name]) this.extras.push([this.row(table, [words, "", "", "", of])[1], orbit.column[name]]);
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
    const id = (name) => document.getElementById(name),
      { kind, A, B, k } = body;
    const where = {
      plane: "on a plane",
      outside: "on a sphere",
      inside: "inside a sphere",
      shell: "around a smaller sphere",
    }[kind];
    document.title = `${page.title} – isoroll`;
    id("title").textContent = page.title;
    const falls = page.effects.gravity ? ", under gravity," : "",
      twists = page.effects.twist ? "" : " or twisting";
    id("lead").textContent = page.alone
      ? `A ball with three moments of inertia rolls ${where}${falls} without slipping${twists}.`
      : `Left, a ball rolls ${where} without slipping or twisting. Right, a point moves on a sphere. ` +
        "The isomorphism carries one path to the other; only the clocks differ.";
    id("left-words").textContent = {
      plane: "rolls on a plane",
      outside: "rolls on the outside of a sphere",
      inside: "rolls inside a sphere",
      shell: "is hollow and rolls around a sphere",
    }[kind];
    if (page.notes.some((note) => note.startsWith("contact is lost")))
      id("left-words").textContent += "; contact is lost at the end";
    if (page.alone) {
      id("right-name").textContent = "The contact";
      id("right-words").textContent = "on the ball, seen in the ball’s own axes";
    } else
      id("right-words").textContent =
        `moves in the ${page.effects.field ? "" : k === -1 ? "Neumann " : k === 1 ? "Braden " : ""}potential V`;
    this.legends();
    const about = [
      ["k", `${digits(k)} (${kind})`],
      ["J", body.J.map((x) => digits(x)).join(", ")],
    ];
    about.push(["ball radius B", body.reduced ? "1 (unit of length)" : digits(B)]);
    if (kind !== "plane") about.push(["sphere radius A", digits(A)]);
    if (page.h !== null) about.push(["energy h", `${digits(page.h)} J/time²`]);
    if (page.eps !== null) about.push(["coupling ε", `${digits(page.eps)} J⁴/time²`]);
    const effects = Object.keys(page.effects).filter((name) => name !== "clock");
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

  notes(orbit) {
    const list = [...page.notes],
      { rows } = page;
    if (page.alone) list.unshift(`There is no point: ${page.alone}.`);
    if (rows && rows.every > 1)
      list.push(`The page has 1 row of every ${rows.every}: ${orbit.count} of ${rows.total}.`);
    else if (rows && rows.between > 0)
      list.push(`The page has the scene’s ${rows.total} rows, and ${rows.between} more after each but the last.`);
    else if (rows) list.push(`The page has all ${rows.total} rows.`);
    list.push("Between rows the motion is interpolated by cubic curves with the slopes of the equations of motion.");
    list.push(`${page.alone ? "ω and n" : "ω, n, M and γ"} are in the ball’s axes, the contact is in axes of space.`);
    if (page.integrals.length)
      list.push("Drift: change of an integral since the first row, divided by the size of its terms.");
    list.push("Units are those of the file. J stands for the unit of the moments of inertia (mass·length²).");
    if (orbit.tau)
      list.push(`Units: t: time; τ: ${this.unitOf([1, -1, -1])}; s: ${this.unitOf([-2, 1, -1])}.`);
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
    if (page.alone) put("right-legend", [[colours.curve, "path of the contact"]]);
    else {
      put("right-legend", [[colours.curve, "path of the point"]]);
      if (potential.levels)
        put("right-legend", [
          [
            null,
            `V from ${digits(potential.least, 3)} (dark: the point is fast) to ${digits(potential.most, 3)}` +
              ` ${this.unitOf([4, -2, 2])}${potential.logarithmic ? ", logarithmic" : ""}`,
            "scale",
          ],
        ]);
    }
  },
};
