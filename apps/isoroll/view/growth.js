// growth.js - the neighbour of the orbit: how its distance grows, on a logarithmic scale. The library has computed it.

const growth = {
  canvas: document.getElementById("growth"),

  build(orbit) {
    this.near = orbit.near;
    this.orbit = orbit;
    document.getElementById("beside").hidden = !this.near;
    if (!this.near) return;
    this.low = Math.floor(Math.log10(this.near.reduce((a, b) => (b > 0 ? Math.min(a, b) : a), 1e-6)));
    this.high = Math.ceil(Math.log10(this.near.reduce((a, b) => Math.max(a, b), 1e-5)));
    legend(document.getElementById("beside-words"), [[colours.curve, "distance of the neighbour"]], this.words(orbit));
  },

  words({ verdict, exponent, turns }) {
    const begin = `A neighbour begins 10⁻⁶ away${page.alone ? "" : " (the black bead)"}. `;
    if (verdict === "chaotic" && exponent > 0)
      return (
        `${begin}This orbit is chaotic: in the mean over a long time the distance grows by the factor e in ` +
        `t = ${digits(1 / exponent, 2)} (exponent ${digits(exponent, 2)}; the broken line).`
      );
    if (verdict === "regular") return `${begin}This orbit is regular: the distance does not grow exponentially.`;
    if (verdict) return `${begin}Whether this orbit is chaotic is not decided after ${turns || 1000} turns.`;
    return `${begin}The curve: its distance.`;
  },

  draw(now) {
    if (!this.near || !controls.beside) return;
    const { g, width, height } = sheet(this.canvas),
      style = getComputedStyle(document.body),
      { left, right, bottom, x } = pace.scales(width, height),
      y = (log) => 8 + ((this.high - log) / (this.high - this.low)) * (bottom - 14);
    g.strokeStyle = style.getPropertyValue("--rule");
    g.fillStyle = style.getPropertyValue("--quiet");
    g.textAlign = "left";
    for (let power = this.low; power <= this.high; power++) {
      g.beginPath();
      g.moveTo(left, y(power));
      g.lineTo(right, y(power));
      g.stroke();
      if ((power - this.high) % 2 === 0) g.fillText(power === 0 ? "1" : `10${raised(power)}`, right + 6, y(power) + 4);
    }
    pace.ticks(g, x, bottom, width);
    const at = this.orbit[clocks.even],
      line = (value, colour, dash) => {
        g.strokeStyle = colour;
        g.setLineDash(dash);
        g.lineWidth = 1.6;
        g.beginPath();
        for (let i = 0; i < at.length; i++) if (value(i) <= this.high) g.lineTo(x(at[i]), y(Math.max(this.low, value(i))));
        g.stroke();
        g.setLineDash([]);
      };
    line((i) => Math.log10(this.near[i]), colours.curve, []);
    if (this.orbit.verdict === "chaotic")
      line(
        (i) => Math.log10(this.near[0]) + (this.orbit.exponent * (this.orbit.t[i] - this.orbit.t[0])) / Math.LN10,
        style.getPropertyValue("--text"),
        [6, 5],
      );
    g.strokeStyle = style.getPropertyValue("--text");
    g.beginPath();
    g.moveTo(x(now[clocks.even]), 4);
    g.lineTo(x(now[clocks.even]), bottom);
    g.stroke();
  },

  // Where the neighbour is now; its difference from our place is interpolated.
  place(now, name) {
    const i = Math.min(Math.floor(now.row), this.orbit.count - 2),
      u = now.row - i,
      off = (j) => plus(this.orbit.beside[j], times(this.orbit[name][j], -1));
    return unit(plus(now[name], plus(times(off(i), 1 - u), times(off(i + 1), u))));
  },
};
