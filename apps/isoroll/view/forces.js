// forces.js - what acts on the ball in the laboratory, beside its support: a level H, a rotor, weight. The state of the
// laboratory has
//
//     level     H divided by the kinetic energy of the point at the start; 0: the free ball, whose point has H = 0
//     rotor     its momentum, three numbers
//     weight    |mgb|; 0: none
//     up        the upward vertical in axes of the body at the start; null: along the contact normal

const forces = {
  none: () => ({ level: 0, rotor: [0, 0, 0], weight: 0, up: null }),

  // c with which a potential -c (n, J^-1 n)^(-1/k) has this part of the ball's kinetic energy at the start.
  unitOfLevel({ k, J, n, omega }) {
    return (dot(omega, omega.map((w, i) => w * J[i])) / 2) * dot(n, n.map((v, i) => v / J[i])) ** (1 / k);
  },
  // The ball begins on top of a sphere, or at the bottom of a bowl.
  upright: ({ k, n }) => (k > 1 ? times(n, -1) : n),
  sign: (k) => (k > 1 || k < 0 ? -1 : 1), // of b

  // As a scene has them.
  effects(state) {
    const { k, level, rotor, weight, up } = state,
      list = {};
    if (weight) list.gravity = { mgb: weight * this.sign(k), up: up || this.upright(state) };
    if (level) list.level = { c: level * this.unitOfLevel(state) };
    if (rotor.some((x) => x)) list.rotor = { momentum: rotor };
    return list;
  },
  // From the effects of the page's own scene.
  read({ level, rotor, gravity }, state) {
    if (level) state.level = +(level.c[0] / this.unitOfLevel(state)).toPrecision(12);
    if (rotor) state.rotor = [...rotor.momentum];
    if (gravity) Object.assign(state, { weight: gravity.mgb[0] * this.sign(state.k), up: [...gravity.up] });
  },

  inputs: ["lab-K1", "lab-K2", "lab-K3"].map(element),
  steer() {
    element("lab-level").addEventListener("input", (e) => lab.change({ level: Number(e.target.value) }));
    element("lab-weight").addEventListener("input", (e) => lab.change({ weight: Number(e.target.value) }));
    for (const input of this.inputs)
      input.addEventListener("input", () => lab.change({ rotor: this.inputs.map((x) => Number(x.value)) }));
  },
  show(state) {
    const { k, J, level, rotor, weight } = state;
    element("lab-level").value = level;
    element("lab-weight").value = weight;
    this.inputs.forEach((input, i) => (input.value = rotor[i]));
    element("lab-rotor-words").textContent = rotor.map((x) => digits(x, 3)).join(", ");
    element("lab-weight-words").textContent = digits(weight, 3);
    const H = (level * this.unitOfLevel(state) * J[0] * J[1] * J[2]) / k ** 2;
    element("lab-level").disabled = weight > 0;
    element("lab-level-words").textContent =
      weight > 0 ? "none, there is no point" : digits(H, 4) + (level ? "" : " (nothing acts on the ball)");
  },
  // How many times faster than a free ball the ball can become.
  hurry(state) {
    const { k, J, n, omega, level, weight } = state,
      energy = dot(omega, omega.map((w, i) => w * J[i])) / 2,
      power = (g) => g ** (-1 / k),
      range = Math.abs(power(1 / Math.max(...J)) - power(1 / Math.min(...J))),
      here = power(dot(n, n.map((v, i) => v / J[i])));
    const times = Math.sqrt(1 + (Math.abs(level) * range) / here + (k === 1 ? 0 : (2 * weight) / Math.abs(1 - k) / energy));
    return Number.isFinite(times) ? times : 1; // the library refuses such a k
  },
};
