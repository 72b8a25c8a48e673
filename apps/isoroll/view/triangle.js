// triangle.js - the moments J of the laboratory.

// All J of one sum, as a triangle. In its middle one, each is smaller than the sum of the other two.
const triangle = {
  canvas: element("lab-J"),
  corners() {
    const { width, height } = this.canvas.getBoundingClientRect(),
      side = Math.min(width - 40, (height - 30) / 0.866),
      left = (width - side) / 2;
    return [
      [left, height - 16],
      [left + side, height - 16],
      [left + side / 2, height - 16 - 0.866 * side],
    ];
  },
  place(parts) {
    const corners = this.corners();
    return [0, 1].map((c) => corners.reduce((sum, corner, i) => sum + corner[c] * parts[i], 0));
  },
  // The place of J.
  here() {
    const { J } = lab.state,
      sum = J[0] + J[1] + J[2];
    return this.place(J.map((x) => x / sum));
  },
  // The parts of the sum at a place; none is below 1/50.
  parts([px, py]) {
    const [a, b, c] = this.corners(),
      third = (py - a[1]) / (c[1] - a[1]),
      second = (px - a[0] - third * (c[0] - a[0])) / (b[0] - a[0]),
      parts = [1 - second - third, second, third].map((x) => Math.max(0.02, x)),
      sum = parts[0] + parts[1] + parts[2];
    return parts.map((x) => x / sum);
  },
  draw() {
    const { g } = sheet(this.canvas),
      line = (points) => {
        g.beginPath();
        for (const p of points) g.lineTo(...p);
        g.closePath();
      };
    g.strokeStyle = theme().rule;
    g.fillStyle = theme().ground;
    line([this.place([0, 0.5, 0.5]), this.place([0.5, 0, 0.5]), this.place([0.5, 0.5, 0])]);
    g.fill();
    line(this.corners());
    g.stroke();
    g.fillStyle = theme().text;
    g.textAlign = "center";
    this.corners().forEach(([x, y], i) => g.fillText(`J${"₁₂₃"[i]}`, x, i < 2 ? y + 14 : y - 5));
    g.fillStyle = colours.curve;
    g.beginPath();
    g.arc(...this.here(), 6, 0, 7);
    g.fill();
  },
  move(parts) {
    const { J } = lab.state,
      sum = J[0] + J[1] + J[2];
    lab.change({ J: parts.map((x) => +(x * sum).toPrecision(4)) });
  },
  steer() {
    const drag = (e) => {
      const box = this.canvas.getBoundingClientRect();
      if (e.buttons) this.move(this.parts([e.clientX - box.left, e.clientY - box.top]));
    };
    this.canvas.addEventListener("pointerdown", (e) => {
      this.canvas.setPointerCapture(e.pointerId);
      drag(e);
    });
    this.canvas.addEventListener("pointermove", drag);
    this.canvas.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: [-4, 0], ArrowRight: [4, 0], ArrowUp: [0, -4], ArrowDown: [0, 4] }[e.key];
      if (!by) return;
      this.move(this.parts(plus(this.here(), by)));
      e.preventDefault();
      e.stopPropagation();
    });
  },
};
