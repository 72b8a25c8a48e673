// judge.js - what the library finds out about the orbit of the laboratory while one watches: its verdict, its exponent or
// its frequency ratio, and which part of the section is chaotic at this energy.

const judge = {
  helper: new Helper(),
  SHARES: [24, 72, 216], // of orbits, one estimate after the other
  told: {},

  stop() {
    this.helper.stop();
    this.told = {};
  },
  async ask(number, job, scene, options) {
    const found = await this.helper.ask(job, scene, options);
    return number === lab.pending ? found.lines : new Promise(() => {}); // a newer orbit is there
  },
  tell(what) {
    Object.assign(this.told, what);
    lab.say();
  },

  async begin(number, scene) {
    this.told = {};
    try {
      const lines = await this.ask(number, "chaos", scene, {});
      this.tell({ verdict: lines.verdict, turns: lines.turns, why: lines.integral });
      this.follow(Number(lines["ball.exponent.t"]));
    } catch (error) {
      if (number === lab.pending) this.tell({ refusal: error.message });
    }
  },
  // The words beside the twin's distance.
  follow(exponent) {
    Object.assign(controls.orbit, { verdict: this.told.verdict, exponent, turns: this.told.turns });
    growth.build(controls.orbit);
    controls.changed();
  },

  // What takes longer, last of all the share.
  async share(number, scene) {
    const { verdict } = this.told;
    try {
      if (verdict === "chaotic") {
        const lines = await this.ask(number, "chaos", scene, { "exponent-turns": 2000, model: "ball" });
        this.tell({ exponent: Number(lines["ball.exponent.t"]), error: Number(lines["ball.error.t"]) });
        this.follow(this.told.exponent);
      } else if (verdict === "regular" && !page.alone) {
        const lines = await this.ask(number, "frequencies", scene, {});
        this.tell({ rotation: Number(lines.frequency_ratio) });
      }
    } catch (error) {
      if (number === lab.pending) this.tell({ rotation: NaN });
    }
    try {
      for (const starts of page.alone ? [] : this.SHARES)
        this.tell({ share: await this.ask(number, "chaos", scene, { starts, turns: 1000, model: "point" }) });
    } catch (error) {
      if (number === lab.pending) this.tell({ share: null, unshared: error.message });
    }
    if (number === lab.pending) lab.shared = number;
  },

  words() {
    return [this.wordsOfOrbit(), this.wordsOfShare()].filter(Boolean).join(" ");
  },
  wordsOfOrbit() {
    const { verdict, turns, refusal, exponent, error, rotation } = this.told;
    if (refusal) return `No verdict: ${refusal}.`;
    if (!verdict) return "Verdict: being computed.";
    const begin = `Verdict: ${verdict} (after ${turns} turns).`;
    if (exponent > 0)
      return `${begin} Exponent: ${digits(exponent, 3)}${error > 0 ? ` ± ${digits(error, 1)}` : ""} per unit of t.`;
    if (verdict !== "regular") return begin;
    return `${begin} Exponent: 0.${rotation > 0 ? ` Frequency ratio: ${digits(rotation, 8)}.` : ""}`;
  },
  wordsOfShare() {
    const { share, unshared } = this.told;
    if (unshared) return `Chaotic share: ${unshared}.`;
    if (!share) return "";
    const percent = (name) => `${digits(100 * Number(share[`share.${name}`]), 3)} %`;
    return (
      `Chaotic share of the section: ${percent("chaotic")}, between ${percent("low")} and ${percent("high")} with ` +
      `95 % confidence (${share["share.followed"]} orbits).`
    );
  },
};
