// story.js - a story of five steps, which moves the controls of the laboratory. It can be left at any time; everything then
// stays as it is.

const story = {
  at: -1, // the step; -1: it is not told
  timers: [],

  start: { n: [0.36, 0.48, 0.8], omega: [0.9, -0.3, -0.225], ...forces.none() },
  steps: [
    ["Roll it: the ball neither slips nor twists.", (tell) => tell.lab({ k: 1, J: [1, 1.2, 1.5] })],
    [
      "Watch the contact: each place n on the ball (left) belongs to one place γ of the point (right); equal numbers are equal states.",
      (tell) => tell.lab({ k: 1, J: [1, 1.2, 1.5] }).then(() => controls.compare(true)),
    ],
    [
      "Stretch the sphere: with other moments J, the map from n to γ = J^{−1/2} n / |J^{−1/2} n| is stretched more.",
      (tell) => tell.lab({ k: 1, J: [1, 2, 5] }).then(() => controls.compare(true)),
    ],
    [
      "Change the clock: now s runs evenly, the point moves by Newton’s law, and the ball is faster and slower.",
      (tell) => {
        tell.bring("time");
        tell.lab({ k: 1, J: [1, 2, 5] }).then(() => controls.setClock("s"));
      },
    ],
    [
      "See the section: chaos at k = ½, but only curves at k = 1 and at k = −1.",
      (tell) => {
        tell.bring("lab-figure");
        tell.lab({ k: 0.5, J: [1, 2, 5] });
        tell.add("Now: k = ½.");
        [1, -1].forEach((k, i) =>
          tell.later(8 * (i + 1), () => {
            tell.add(`Now: k = ${digits(k)}.`);
            lab.change({ k });
          }),
        );
      },
    ],
  ],

  // Ends what the last step has begun.
  clear() {
    this.timers.forEach(clearTimeout);
    this.timers = [];
    if (controls.compared) controls.compare(false);
    if (clocks.even !== "t") controls.setClock("t");
  },
  // Shows this orbit. The promise is kept when it is there, if the story is still at this step.
  async lab(numbers) {
    const { at } = this;
    const shown = await lab.compute({ ...this.start, ...numbers });
    if (shown) lab.fill(lab.pending);
    if (!shown || at !== this.at) return new Promise(() => {});
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) controls.play(true);
  },
  // What the step speaks of is seen.
  bring(name) {
    element(name).scrollIntoView({ block: "nearest" });
  },
  add(words) {
    numbers.write(element("story-words"), `${this.at + 1} of ${this.steps.length}. ${this.steps[this.at][0]} ${words}`);
  },
  later(seconds, act) {
    this.timers.push(setTimeout(act, 1000 * seconds));
  },
  tell(step) {
    this.clear();
    this.at = step >= 0 && step < this.steps.length ? step : -1;
    const on = this.at >= 0;
    for (const name of ["back", "next", "leave"]) element(`story-${name}`).hidden = !on;
    element("story-begin").hidden = on;
    element("story-words").textContent = "";
    if (!on) return element("story-begin").focus();
    this.add("");
    element("story-back").disabled = step === 0;
    element("story-next").textContent = step + 1 < this.steps.length ? "Next" : "The end";
    if (step === 0) element("story-next").focus();
    this.steps[step][1](this);
  },
  steer() {
    element("story-begin").addEventListener("click", () => this.tell(0));
    element("story-back").addEventListener("click", () => this.tell(this.at - 1));
    element("story-next").addEventListener("click", () => this.tell(this.at + 1));
    element("story-leave").addEventListener("click", () => this.tell(-1));
    // whoever turns something himself is not disturbed
    for (const name of ["pointerdown", "keydown"])
      element("lab").addEventListener(name, () => {
        this.timers.forEach(clearTimeout);
      });
  },
};
