// address.js - what is shown, in the address of the page: #t=12.5&view=compare,beside&orbit=3&eye=0.7,0.42,1. The name
// of the even clock stands before its time. Such an address opens the page at the same moment, seen from the same side.

let lab = null; // the laboratory (lab.js), with --live

const address = {
  written: "",
  text() {
    const views = [controls.compared && "compare", controls.beside && "beside"].filter(Boolean),
      eye = [camera.azimuth, camera.elevation, camera.zoom].map((x) => +x.toFixed(3));
    const parts = [`${clocks.even}=${+controls.value.toPrecision(10)}`];
    if (views.length) parts.push(`view=${views}`);
    if (sections) parts.push(`orbit=${sections.chosen}`);
    if (lab) parts.push(...lab.address());
    return `#${parts.join("&")}&eye=${eye}`;
  },
  write() {
    const text = address.text();
    if (text === address.written) return;
    address.written = text;
    history.replaceState(null, "", text);
  },
  // What is not there, or is no number, changes nothing.
  read() {
    if (location.hash === address.written) return;
    if (lab && lab.read()) return; // which reads the rest when its orbit is there
    const given = new URLSearchParams(location.hash.slice(1)),
      views = (given.get("view") || "").split(","),
      eye = (given.get("eye") || "").split(",").map(Number);
    if (sections && given.has("orbit")) sections.choose(Number(given.get("orbit")));
    if (given.has("view")) {
      controls.compare(views.includes("compare"));
      controls.showBeside(views.includes("beside"));
    }
    const even = controls.orbit.clocks.find((name) => given.has(name) && Number.isFinite(Number(given.get(name))));
    if (even) {
      controls.play(false);
      controls.setClock(even);
      controls.seek(Number(given.get(even)));
    }
    if (eye.length === 3 && eye.every(Number.isFinite) && eye[2] > 0) camera.look(...eye);
    controls.changed();
    return even !== undefined;
  },
};
