// taken.js - what can be taken from the laboratory: the link, a film, the scene, and the commands that compute the same.

const taken = {
  // The scene as a file for isoroll.
  yaml() {
    const scene = { ...lab.scene(), output: { as: page.alone ? "ball" : "both" } },
      flow = (value) => JSON.stringify(value).replace(/"(\w+)":/g, "$1: ").replace(/,/g, ", ").replaceAll('"', "");
    return Object.entries(scene)
      .map(([key, value]) => `${key}: ${flow(value)}\n`)
      .join("");
  },
  commands() {
    const model = page.alone ? "ball" : "point",
      more = page.alone ? "" : " --starts 60 --crossings 150",
      starts = page.alone ? "" : ` --starts ${judge.SHARES[judge.SHARES.length - 1]} --turns 1000`;
    return [
      "isoroll run scene.yaml -o orbit.csv",
      `isoroll section scene.yaml --model ${model}${more} -o section.csv`,
      `isoroll chaos scene.yaml --model ${model}${starts}`,
    ].join("\n");
  },

  say(words) {
    element("lab-taken").textContent = words;
  },
  async copy(text, words) {
    try {
      await navigator.clipboard.writeText(text);
      this.say(`${words} copied.`);
    } catch (error) {
      this.say(`This browser does not let the page copy. ${words}: ${text}`);
    }
  },
  film() {
    if (film.recorder) return;
    film.record();
    const { recorder } = film;
    this.say("Ten seconds are being recorded …");
    recorder.addEventListener("stop", () => this.say("The film is saved."));
    setTimeout(() => recorder === film.recorder && film.ended(), 10000);
  },
  steer() {
    element("lab-link").addEventListener("click", () => {
      address.write();
      this.copy(location.href, "Link");
    });
    element("lab-film").hidden = !window.MediaRecorder;
    element("lab-film").addEventListener("click", () => this.film());
    element("lab-scene").addEventListener("click", () => film.save(new Blob([this.yaml()]), "yaml", "scene"));
    element("lab-command").addEventListener("click", () => {
      element("lab-commands").textContent = this.commands();
      element("lab-commands").hidden = false;
      this.copy(this.commands(), "Commands");
    });
  },
};
