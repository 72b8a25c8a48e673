// sections.js - both Poincare sections as plots, from the chart (l, x) that they share.
//
// For axis a, with b and c after it: gamma = (cos l, -sin l) in the axes b, c. The ball's coordinates are psi, with n =
// (cos psi, -sin psi) in them, and omega_a/|omega|; the point's are l and L = G(l) x, where G^2 = |M|^2 = 2 (H + eps
// q^(-1/k)). The words of the axes are those of the command's pictures.

// "n₁ = cos ψ, n₂ = −sin ψ", in the axes after axis a, from 0 on.
const turning = (vector, a, angle) =>
  `${vector}${"₁₂₃"[(a + 1) % 3]} = cos ${angle}, ${vector}${"₁₂₃"[(a + 2) % 3]} = −sin ${angle}`;

const sections = !tables("section").length
  ? null
  : (() => {
      const { J, k } = body,
        [crossed] = tables("section"),
        [found] = tables("orbits"),
        a = Number(crossed.lines.axis) - 1,
        b = (a + 1) % 3,
        c = (a + 2) % 3;
      const [orbits, l, x] = ["orbit", "l", "x"].map((name) => column(crossed, name));
      const free = Boolean(page.eps) && !Object.keys(page.effects).some((name) => name !== "level" && name !== "clock");
      const H = page.effects.level ? (page.effects.level.c[0] * body.detJ) / k ** 2 : 0;
      const G = (l) => {
        const q = J[b] * Math.cos(l) ** 2 + J[c] * Math.sin(l) ** 2;
        return free ? Math.sqrt(2 * Math.max(0, H + page.eps * q ** (-1 / k))) : 1;
      };
      const ofBall = (l, x) => {
        const across = Math.sqrt((1 - x) * (1 + x)),
          omega = [
            (Math.sign(k) * across * Math.sin(l)) / Math.sqrt(J[b]),
            (Math.sign(k) * across * Math.cos(l)) / Math.sqrt(J[c]),
            (Math.sign(k) * x) / Math.sqrt(J[a]),
          ];
        return [
          Math.atan2(Math.sqrt(J[c]) * Math.sin(l), Math.sqrt(J[b]) * Math.cos(l)),
          omega[2] / Math.hypot(...omega),
        ];
      };
      const ofPoint = (l, x) => [l, G(l) * x];
      const top = Math.max(...Array.from({ length: 361 }, (_, i) => G((i * Math.PI) / 180)));
      const plots = [
        {
          canvas: document.getElementById("section-ball"),
          place: ofBall,
          top: 1,
          across: `ψ, where ${turning("n", a, "ψ")}`,
          up: `ω${"₁₂₃"[a]}/|ω|`,
          edge: () => 1,
        },
        {
          canvas: document.getElementById("section-point"),
          place: ofPoint,
          top,
          across: `l, where ${turning("γ", a, "l")}`,
          up: free ? `L = M${"₁₂₃"[a]}` : `x = M${"₁₂₃"[a]}/|M|`,
          edge: G,
        },
      ];
      const dots = plots.map((plot) => Array.from(l, (angle, i) => plot.place(angle, x[i])));
      const runnable = tables("trajectory").map((one) => Number(one.lines.orbit));
      const shades = new Map(found && Array.from(column(found, "orbit"), (number, i) => [number, column(found, "shade")[i]]));
      const shadeOf = (orbit) => shades.get(orbit) || (found ? "dark" : "colour"); // of thousands some have no verdict
      const colourOf = (orbit) => shadeColour(shadeOf(orbit), orbit);
      const behind = (orbit) => shadeOf(orbit) !== "colour";
      let chosen = runnable[0],
        hovered = -1,
        crossings = [];

      const frameOf = (plot) => {
        const box = plot.canvas.getBoundingClientRect();
        return {
          x: (v) => 46 + ((v + Math.PI) / (2 * Math.PI)) * (box.width - 58),
          y: (v) => 12 + ((1 - v / (plot.top * 1.04)) / 2) * (box.height - 50),
        };
      };

      function axes(g, plot, { x, y }, width, height) {
        const style = getComputedStyle(document.body);
        g.strokeStyle = style.getPropertyValue("--rule");
        g.fillStyle = style.getPropertyValue("--quiet");
        g.textAlign = "center";
        for (const [v, text] of [
          [-Math.PI, "−π"],
          [-Math.PI / 2, "−π/2"],
          [0, "0"],
          [Math.PI / 2, "π/2"],
          [Math.PI, "π"],
        ]) {
          g.beginPath();
          g.moveTo(x(v), y(-plot.top * 1.04));
          g.lineTo(x(v), y(-plot.top * 1.04) + 4);
          g.stroke();
          g.fillText(text, x(v), y(-plot.top * 1.04) + 17);
        }
        g.fillText(plot.across, x(0), height - 4);
        g.textAlign = "right";
        for (const v of [-1, -0.5, 0, 0.5, 1]) {
          g.beginPath();
          g.moveTo(x(-Math.PI) - 4, y(v * plot.top));
          g.lineTo(x(-Math.PI), y(v * plot.top));
          g.stroke();
          g.fillText(String(+(v * plot.top).toPrecision(2)).replace("-", "−"), x(-Math.PI) - 7, y(v * plot.top) + 4);
        }
        g.save();
        g.translate(11, y(0) - 40);
        g.rotate(-Math.PI / 2);
        g.textAlign = "center";
        g.fillText(plot.up, -0, 0);
        g.restore();
        g.beginPath();
        for (const sign of [1, -1])
          for (let i = 0; i <= 240; i++) {
            const l = sign * Math.PI * ((2 * i) / 240 - 1);
            g.lineTo(x(l), y(sign * plot.edge(l)));
          }
        g.closePath();
        g.stroke();
      }

      // All dots, once for each size and theme.
      function background(plot, i, width, height) {
        const key = [width, height, isDark(), devicePixelRatio].join();
        if (plot.key === key) return plot.image;
        const scale = Math.min(devicePixelRatio, 2),
          image = document.createElement("canvas"),
          g = image.getContext("2d");
        image.width = width * scale;
        image.height = height * scale;
        g.scale(scale, scale);
        g.font = "12px system-ui, sans-serif";
        const frame = frameOf(plot),
          size = Math.max(1, Math.min(2.4, 200 / Math.sqrt(dots[i].length)));
        axes(g, plot, frame, width, height);
        g.globalAlpha = 0.75;
        // the sea first, so that it covers no island
        for (const first of [true, false])
          dots[i].forEach(([right, up], j) => {
            if (behind(orbits[j]) !== first) return;
            g.fillStyle = colourOf(orbits[j]);
            g.fillRect(frame.x(right) - size / 2, frame.y(up) - size / 2, size, size);
          });
        Object.assign(plot, { key, image });
        return image;
      }

      function highlight(g, frame, i, orbit, colour, size) {
        g.fillStyle = colour;
        dots[i].forEach(([right, up], j) => {
          if (orbits[j] !== orbit) return;
          g.beginPath();
          g.arc(frame.x(right), frame.y(up), size, 0, 7);
          g.fill();
        });
      }

      // The last twelve crossings before the present, as rings. The newest ring is the largest.
      function live(g, plot, frame, now) {
        const passed = crossings.filter((one) => one.t <= now.t);
        passed.slice(-12).forEach((one, j, list) => {
          const [right, up] = plot.place(one.l, one.x),
            last = j === list.length - 1;
          g.strokeStyle = colours.curve;
          g.globalAlpha = 0.25 + (0.75 * (j + 1)) / list.length;
          g.lineWidth = last ? 2.5 : 1.2;
          g.beginPath();
          g.arc(frame.x(right), frame.y(up), last ? 8 : 5, 0, 7);
          g.stroke();
        });
        g.globalAlpha = 1;
      }

      const nearest = (i, e) => {
        const box = plots[i].canvas.getBoundingClientRect(),
          frame = frameOf(plots[i]);
        let best = -1,
          least = 18 ** 2;
        dots[i].forEach(([right, up], j) => {
          const d = (frame.x(right) - e.clientX + box.left) ** 2 + (frame.y(up) - e.clientY + box.top) ** 2;
          if (d < least && runnable.includes(orbits[j])) {
            least = d;
            best = j;
          }
        });
        return best < 0 ? -1 : orbits[best];
      };

      const api = {
        orbits: runnable,
        get chosen() {
          return chosen;
        },
        colourOf,
        // Where a dot of an orbit is drawn, far from the dots of others; for tests.
        alone(i, number) {
          const frame = frameOf(plots[i]),
            box = plots[i].canvas.getBoundingClientRect();
          const spots = dots[i].map(([right, up]) => [box.left + frame.x(right), box.top + frame.y(up)]);
          let best = null,
            most = -1;
          spots.forEach((spot, j) => {
            if (orbits[j] !== number) return;
            const room = Math.min(
              ...spots.map((other, m) =>
                orbits[m] === number ? Infinity : Math.hypot(other[0] - spot[0], other[1] - spot[1]),
              ),
            );
            if (room > most) {
              most = room;
              best = spot;
            }
          });
          return best;
        },
        choose(number) {
          if (!runnable.includes(number)) return;
          chosen = number;
          document.getElementById("orbit").value = String(number);
          controls.setOrbit(orbitOf(number));
        },
        // The crossings n_a = 0, n_a growing, of the orbit that runs.
        setOrbit(orbit) {
          crossings = [];
          const sign = (i) => orbit.n[i][a];
          for (let i = 0; i + 1 < orbit.count; i++) {
            if (!(sign(i) < 0 && sign(i + 1) >= 0) && !(i === 0 && Math.abs(sign(0)) < 1e-9)) continue;
            let low = 0,
              high = i === 0 && Math.abs(sign(0)) < 1e-9 ? 0 : 1;
            for (let step = 0; step < 50 && high > low; step++) {
              const middle = (low + high) / 2;
              if (motion.inside(orbit, i, middle).n[a] < 0) low = middle;
              else high = middle;
            }
            const now = motion.inside(orbit, i, high),
              root = J.map(Math.sqrt);
            const gamma = now.n.map((v, j) => v / root[j]),
              M = now.omega.map((v, j) => Math.sign(k) * v * root[j]);
            crossings.push({ t: now.t, l: Math.atan2(-gamma[c], gamma[b]), x: M[a] / Math.hypot(...M) });
          }
          document.getElementById("orbit-words").textContent =
            `${{ chaotic: "Chaotic.", regular: "Regular." }[orbit.verdict] || ""} ` +
            `Rings mark its ${crossings.length} crossings while it runs here.`;
        },
        crossings: () => crossings,
        place: (plot, l, x) => plots[plot].place(l, x),
        draw(now) {
          plots.forEach((plot, i) => {
            const { g, width, height } = sheet(plot.canvas),
              frame = frameOf(plot);
            g.drawImage(background(plot, i, width, height), 0, 0, width, height);
            if (hovered >= 0 && hovered !== chosen) highlight(g, frame, i, hovered, theme().text, 2);
            highlight(g, frame, i, chosen, colours.curve, 2.2);
            live(g, plot, frame, now);
          });
        },
      };

      plots.forEach((plot, i) => {
        plot.canvas.hidden = false;
        plot.canvas.addEventListener("pointermove", (e) => {
          hovered = nearest(i, e);
          controls.changed();
        });
        plot.canvas.addEventListener("pointerleave", () => {
          hovered = -1;
          controls.changed();
        });
        plot.canvas.addEventListener("click", (e) => {
          const number = nearest(i, e);
          if (number < 0) return;
          api.choose(number);
          controls.play(true);
        });
        plot.canvas.addEventListener("keydown", (e) => {
          const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[e.key];
          if (!by) return;
          const count = api.orbits.length,
            at = api.orbits.indexOf(chosen);
          api.choose(api.orbits[(at + by + count) % count]);
          e.preventDefault();
          e.stopPropagation();
        });
      });
      const select = document.getElementById("orbit");
      for (const number of api.orbits) select.append(new Option(String(number), String(number)));
      select.addEventListener("change", () => api.choose(Number(select.value)));
      document.getElementById("sections").hidden = false;
      document.body.classList.add("with-sections");
      const dark = Array.from(orbits).some((number) => shadeOf(number) === "dark"),
        items = [[colours.curve, "the orbit that runs", "dot"], ...(found ? shadeItems(dark) : [])];
      legend(document.getElementById("section-legend"), items, `Other colours: ${found ? "a regular" : "an"} orbit each.`);
      document.getElementById("section-name").textContent = `n${"₁₂₃"[a]} = 0`;
      return api;
    })();
