// live_kept.js WORKER FOLDER FOLDER - the library of a laboratory in two folders (isoroll.js, library.txt): the worker of
// the page computes the same with both, to the bit. Prints what it compared; ends with 1 where they differ.
const fs = require("fs"),
  vm = require("vm"),
  zlib = require("zlib");
const [worker, ...folders] = process.argv.slice(2);
const start = { normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225] };
const scene = (k, effects) => ({
  reduced: { k, J: [1, 2, 5] }, initial: start, time: { end: 20, step: 0.5 }, effects, output: { as: "both" },
});
const questions = [
  ["run", scene(0.5, {})],
  ["run", scene(-1, { level: { c: 0.3 } })],
  ["run", scene(1, { attitude: {}, rotor: { momentum: [0.1, 0.2, 0.3] } })],
  ["section", scene(0.75, {}), { starts: 3, crossings: 20 }],
  ["chaos", scene(0.5, {}), { starts: 3, turns: 100 }],
  ["frequencies", scene(-1, {}), {}],
];

async function answers(folder) {
  const taken = new Map();
  const world = vm.createContext({
    TextDecoder, TextEncoder, console, performance, // WebAssembly is its own, with its own errors
    importScripts: () => {}, // so it is a Worker
    location: { href: "" },
    postMessage: ({ id, result, error }) => taken.set(id, error || result),
  });
  world.self = world;
  vm.runInContext(fs.readFileSync(`${folder}/isoroll.js`, "utf8"), world);
  vm.runInContext(fs.readFileSync(worker, "utf8"), world);
  const packed = Buffer.from(fs.readFileSync(`${folder}/library.txt`, "utf8"), "base64");
  await world.onmessage({ data: { module: await vm.runInContext("(bytes) => WebAssembly.compile(bytes)", world)(zlib.gunzipSync(packed)) } });
  for (const [id, [job, of, options]] of questions.entries())
    await world.onmessage({ data: { id, job, scene: of, options: options || {} } });
  return questions.map((_, id) => JSON.stringify(taken.get(id)));
}

Promise.all(folders.map(answers)).then(([one, two]) => {
  one.forEach((answer, i) => {
    const numbers = (answer.match(/\d+\.\d+/g) || []).length,
      same = numbers > 3 && answer === two[i];
    console.log(`${same ? "same" : "DIFFERENT"}: ${questions[i][0]}, ${numbers} numbers`);
    if (!same) process.exitCode = 1, console.log(answer.slice(0, 300) + "\n" + two[i].slice(0, 300));
  });
});
