// chart.js - the section of the laboratory: its dots, and the start that is chosen in it.

const chart = {
  canvas: element("lab-section"),
  dots: [], // {orbit, l, x, shade}, by orbit; the scene's own is 0
  cursor: null, // of the keyboard
  axis: 3, // that the crossings pass

  clear() {
    this.dots = [];
    this.draw();
  },
  add({ columns, shades }, first) {
    columns.orbit.forEach((orbit, i) => {
      const dot = { orbit: orbit && orbit + first.number, l: columns.l[i], x: columns.x[i], shade: shades[orbit] };
      if (orbit >= first.from) this.dots.push(dot);
    });
    this.draw();
  },
  frame() {
    const box = this.canvas.getBoundingClientRect(),
      wide = box.width - 46,
      high = box.height - 44;
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
      g.fillText(words, x(l), height - 20);
    g.fillText(`l, where ${turning("γ", this.axis - 1, "l")}`, x(0), height - 4);
    g.textAlign = "right";
    for (const v of [-1, 0, 1]) g.fillText(String(v).replace("-", "−"), x(-Math.PI) - 6, y(v) + 4);
    g.save();
    g.translate(x(-Math.PI) - 8, y(0.5));
    g.rotate(-Math.PI / 2);
    g.textAlign = "center";
    g.fillText(`x = M${"₁₂₃"[this.axis - 1]}/|M|`, 0, 0);
    g.restore();
    const size = this.dots.length > 4000 ? 1.4 : 2;
    const layer = ({ orbit, shade }) => (orbit === 0 ? 2 : (shade || "colour") === "colour" ? 1 : 0); // the sea first
    for (const now of [0, 1, 2]) {
      for (const dot of this.dots) {
        if (layer(dot) !== now) continue;
        g.fillStyle = now === 2 ? colours.curve : shadeColour(dot.shade, dot.orbit);
        const radius = now === 2 ? 1.6 * size : size;
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
