// worker.js - runs in a Worker behind the loader of emscripten (isoroll.js): calls the library by its interface for other
// languages (lib/api/interface.h). All physics of the laboratory is computed here.
//
// In: {module}, the compiled library, first; then {id, job, scene, options}. Out: {id, result} or {id, error}.

let library = null; // a promise of it
const jobs = {};

onmessage = async ({ data }) => {
  if (data.module) {
    library = isoroll({
      instantiateWasm: (imports, done) => {
        WebAssembly.instantiate(data.module, imports).then((instance) => done(instance));
        return {};
      },
    });
    return;
  }
  const calls = callsOf(await library);
  try {
    const result = jobs[data.job](calls, data.scene, data.options),
      columns = (result.tables || [result]).flatMap((table) => Object.values(table.columns || {}));
    postMessage({ id: data.id, result }, [...new Set(columns.map((column) => column.buffer).filter(Boolean))]);
  } catch (error) {
    postMessage({ id: data.id, error: error.message });
  }
  calls.end();
};

// What the jobs need of the library; end() frees what they have used.
function callsOf(M) {
  const ctx = M._iso_context_create(),
    ends = [() => M._iso_context_free(ctx)],
    pointer = (at) => M.HEAPU32[at >> 2];
  const room = (bytes) => {
    const at = M._malloc(bytes);
    ends.push(() => M._free(at));
    return at;
  };
  const text = (words) => {
    const bytes = M.lengthBytesUTF8(words) + 1,
      at = room(bytes);
    M.stringToUTF8(words, at, bytes);
    return at;
  };
  const ok = (status) => {
    if (status !== 0) throw new Error(M.UTF8ToString(M._iso_context_message(ctx)).replace(/^page:\d+:\d+: /, ""));
  };
  const sceneOf = (scene) => {
    const words = JSON.stringify(scene), // YAML as well
      at = room(4);
    ok(M._iso_scene_parse(ctx, text("page"), text(words), M.lengthBytesUTF8(words), at));
    const made = pointer(at);
    ends.push(() => M._iso_scene_free(made));
    return made;
  };
  // The lines of a record, and its columns by their names; words where a column has words.
  const taken = (record) => {
    ends.push(() => M._iso_record_free(record));
    const rows = M._iso_record_rows(record),
      count = M._iso_record_columns(record),
      first = rows ? M._iso_record_row(record, 0) >> 3 : 0,
      lines = {},
      columns = {},
      key = room(8);
    for (let i = 0; M._iso_record_line(record, i, key, key + 4); i++)
      lines[M.UTF8ToString(pointer(key))] = M.UTF8ToString(pointer(key + 4));
    for (let j = 0; j < count; j++) {
      const numbers = Float64Array.from({ length: rows }, (_, i) => M.HEAPF64[first + i * count + j]);
      columns[M.UTF8ToString(M._iso_record_name(record, j))] = M._iso_record_has_words(record, j)
        ? Array.from(numbers, (number) => M.UTF8ToString(M._iso_record_word(record, number)))
        : numbers;
    }
    return { rows, lines, columns };
  };
  // The first table of a study, and what it notes.
  const ask = (name, scene, options) => {
    const at = room(24),
      sink = room(20),
      notes = [],
      note = M.addFunction((_, words) => notes.push(M.UTF8ToString(words)), "vii"),
      lines = Object.entries(options).map(([key, value]) => `${key}=${value}`);
    ends.push(() => M.removeFunction(note));
    M.HEAPU32.set([0, 0, note, 0, 0], sink >> 2); // iso_sink: header, row, note, progress, data
    ok(M._iso_study_ask(ctx, text(name), sceneOf(scene), 0, text(lines.join("\n")), sink, at));
    for (let i = 1; i < 6; i++) if (pointer(at + 4 * i)) M._iso_record_free(pointer(at + 4 * i));
    return { ...taken(pointer(at)), notes: notes.join("\n") };
  };
  return {
    run: (scene) => ask("run", scene, {}),
    study: ask,
    end: () => ends.reverse().forEach((end) => end()),
  };
}

// The tables of a page (view.h): each model by its own equations, at the same times; and how far they are apart. A ball
// without a point runs alone, and the result says why.
jobs.run = (calls, scene) => {
  let ball,
    alone = "";
  try {
    ball = calls.run({ ...scene, solver: { backend: "ball" } });
  } catch (error) {
    ball = calls.run({ ...scene, solver: { backend: "ball" }, output: { as: "ball" } }); // or it is refused as well
    alone = error.message;
  }
  const { rows, notes, columns } = ball,
    lines = { ...ball.lines, total: rows, every: 1, between: 0 },
    found = [{ kind: "trajectory", rows, lines, columns }, ...neighbourOf(calls, scene, ball, alone)];
  if (alone) return { tables: found, notes, alone };
  const { attitude, ...effects } = scene.effects, // the point has none
    point = calls.run({ ...scene, effects, solver: { backend: "point" } });
  const distance = (name) =>
    columns[name + 1].map((_, i) =>
      Math.hypot(...[1, 2, 3].map((j) => columns[name + j][i] - point.columns[name + j][i])),
    );
  found.push({ kind: "compare", rows, lines: {}, columns: { n: distance("n"), gamma: distance("gamma") } });
  for (const name of ["M", "gamma"]) for (const j of [1, 2, 3]) columns[name + j] = point.columns[name + j];
  return { tables: found, notes, alone };
};

// The neighbour, as in view_orbit.c: omega is turned about n by 1e-6 radians. Its place in the picture of the point (n, if
// there is none), and its distance.
function neighbourOf(calls, scene, ball, alone) {
  const vector = (columns, name, i) => [1, 2, 3].map((j) => columns[name + j][i]),
    [a, b, c] = vector(ball.columns, "n", 0),
    [x, y, z] = vector(ball.columns, "omega", 0),
    speed = Math.hypot(x, y, z);
  if (!(speed > 0)) return [];
  const omega = [x + 1e-6 * (b * z - c * y), y + 1e-6 * (c * x - a * z), z + 1e-6 * (a * y - b * x)],
    twin = calls.run({
      ...scene,
      initial: { normal: [a, b, c], angular_velocity: omega, project: true },
      solver: { backend: "ball" },
      output: { as: alone ? "ball" : "both" },
    }).columns;
  const apart = (name, i) => Math.hypot(...vector(ball.columns, name, i).map((v, j) => v - twin[name + (j + 1)][i])),
    columns = { distance: twin.t.map((_, i) => Math.hypot(apart("omega", i) / speed, apart("n", i))) };
  for (const j of [1, 2, 3]) columns[(alone ? "n" : "gamma") + j] = twin[(alone ? "n" : "gamma") + j];
  return [{ kind: "neighbour", rows: twin.t.length, lines: {}, columns }];
}

// Crossings; of spread orbits also the shades, as in view_orbit.c: by the verdicts on orbits that begin at their first
// crossings. Orbits without a verdict have no shade.
jobs.section = (calls, scene, options) => {
  const found = calls.study("section", scene, options),
    { orbit, l, x } = found.columns,
    starts = options.starts ? [...orbit.keys()].filter((i) => orbit[i] > 0 && orbit[i] !== orbit[i - 1]) : [];
  found.shades = {};
  if (!starts.length) return found;
  const at = starts.map((i) => `${l[i]},${x[i]}`).join(";"),
    axis = found.lines.axis;
  try {
    const { columns } = calls.study("chaos", scene, { at, axis, turns: 1000, model: options.model });
    for (let i = 1; i < columns.orbit.length; i++)
      found.shades[orbit[starts[columns.orbit[i] - 1]]] =
        { chaotic: "grey", undecided: "dark" }[columns.verdict[i]] || "colour";
  } catch (error) {
    // the section is not global, ...
  }
  return found;
};

for (const name of ["chaos", "frequencies"])
  jobs[name] = (calls, scene, options) => ({ lines: calls.study(name, scene, options).lines });
