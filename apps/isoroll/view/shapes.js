// shapes.js - what the pictures are made of: spheres with patterns, ribbons along paths, markers.

const three = (v) => new THREE.Vector3(v[0], v[1], v[2]);
const turn = (q) => new THREE.Quaternion(q[1], q[2], q[3], q[0]);
const derivatives = { derivatives: true };

const colours = {
  curve: "#d55e00",
  support: "#0072b2",
  t: "#0072b2",
  tau: "#b5578f",
  s: "#00825c",
  light: {
    paper: "#ffffff",
    ball: "#f3efe6",
    dark: "#c3ccd6",
    line: "#56657a",
    ground: "#e9edf0",
    rule: "#93a1ae",
    deep: "#1d4f86",
    middle: "#86b0d0",
    shallow: "#fbf3dd",
    text: "#1c2733",
    future: "#6f7c88",
  },
  dark: {
    paper: "#171c22",
    ball: "#d9d6cf",
    dark: "#8796a6",
    line: "#39485a",
    ground: "#323b45",
    rule: "#6b7a89",
    deep: "#0d2f57",
    middle: "#4d84b0",
    shallow: "#f2e6c4",
    text: "#e8edf2",
    future: "#9aa7b3",
  },
};
// of orbits, by their numbers; it has no grey
const palette = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#999933", "#7d6b9e"];
// Of the shades of orbits (view_orbit.c): grey is chaotic, dark undecided.
const shadeColour = (shade, number) =>
  shade === "grey" ? "#8a929a" : shade === "dark" ? theme().text : palette[number % palette.length];
const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;
const theme = () => (isDark() ? colours.dark : colours.light);

const vertex = `
varying vec3 place; varying vec3 normalOut; varying vec3 toEye;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = position; toEye = -seen.xyz; normalOut = normalMatrix * normal;
  gl_Position = projectionMatrix * seen;
}`;

// Patterns: 0 octants of a ball with the great circles of its axes, 1 a graticule, 2 the potential with contours.
// The potential's height, 0 to 1 between the two numbers of `range`: with u = ln q^(-1/k),
//     mode 0   by u, where V = -eps e^u        mode 1   by V        mode 2   by the logarithm of V
const fragment = `
uniform vec3 a, b, c, line, up; uniform float opacity, rim; uniform int pattern;
uniform vec3 J, linear; uniform vec2 range; uniform float power, free, bound; uniform mat3 quadratic; uniform int mode;
varying vec3 place; varying vec3 normalOut; varying vec3 toEye;
float heightOf(vec3 p) {
  float u = power * log(dot(p * p, J));
  if (mode == 0) return (u - range.x) / (range.y - range.x);
  vec3 n = normalize(sqrt(J) * p);
  float V = (free + bound * (0.5 * dot(n, quadratic * n) + dot(linear, n))) * exp(u);
  return mode == 1 ? (V - range.x) / (range.y - range.x) : log(range.x / V) / log(range.x / range.y);
}
float near(float x, float width) {
  float w = fwidth(x);
  return 1.0 - smoothstep(width * w, (width + 1.0) * w, abs(x));
}
float rule(float x) {
  float w = fwidth(x), away = abs(fract(x + 0.5) - 0.5);
  return (1.0 - smoothstep(0.5 * w, 1.5 * w, away)) * step(w, 0.4);
}
void main() {
  if (dot(place, up) > rim) discard; // a bowl is open above its rim
  vec3 p = normalize(place), colour;
  if (pattern == 0) {
    vec3 w = fwidth(p) + 1e-5, side = smoothstep(-w, w, p) * 2.0 - 1.0;
    colour = mix(a, b, 0.5 + 0.5 * side.x * side.y * side.z);
    colour = mix(colour, line, 0.55 * max(max(near(p.x, 0.8), near(p.y, 0.8)), near(p.z, 0.8)));
  } else if (pattern == 1) {
    float lat = asin(clamp(p.z, -1.0, 1.0)) * 5.7296, lon = atan(p.y, p.x) * 5.7296 / 1.5;
    float g = max(rule(lat / 2.0), rule(lon / 2.0) * smoothstep(0.985, 0.93, abs(p.z)));
    colour = mix(a, line, 0.45 * g);
  } else {
    float height = heightOf(p);
    colour = height < 0.5 ? mix(a, c, height * 2.0) : mix(c, b, height * 2.0 - 1.0);
    colour = mix(colour, line, 0.3 * rule(height * 10.0));
  }
  vec3 n = normalize(normalOut);
  if (dot(n, toEye) < 0.0) n = -n;
  float light = 0.8 + 0.24 * max(0.0, dot(n, normalize(vec3(-0.45, 0.75, 0.6))));
  light *= 0.84 + 0.16 * abs(dot(n, normalize(toEye)));
  gl_FragColor = vec4(min(colour * light, 1.0), opacity);
}`;

// A sphere; colours a and b (and c between them) and line by name in the theme. levels: the uniforms of heightOf.
function sphere(radius, pattern, names, { side = THREE.FrontSide, opacity = 1, levels = {}, finer = 1 } = {}) {
  const geometry = new THREE.SphereBufferGeometry(radius, 56 * finer, 36 * finer);
  const uniforms = {
    a: { value: 0 },
    b: { value: 0 },
    c: { value: 0 },
    line: { value: 0 },
    opacity: { value: opacity },
    pattern: { value: pattern },
    up: { value: new THREE.Vector3() },
    rim: { value: 1e30 },
    J: { value: new THREE.Vector3(1, 1, 1) },
    linear: { value: new THREE.Vector3() },
    range: { value: new THREE.Vector2(0, 1) },
    power: { value: 1 },
    free: { value: 0 },
    bound: { value: 0 },
    quadratic: { value: new THREE.Matrix3() },
    mode: { value: 0 },
  };
  for (const name in levels) uniforms[name].value = levels[name];
  const material = new THREE.ShaderMaterial({
    vertexShader: vertex,
    fragmentShader: fragment,
    uniforms,
    side,
    transparent: opacity < 1,
    depthWrite: opacity === 1,
    extensions: derivatives,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  const mesh = new THREE.Mesh(geometry, material);
  flat.sphere(mesh, radius, names, { clear: opacity < 1 || side === THREE.BackSide, levels: pattern === 2 });
  mesh.recolour = () => {
    for (const key in names) uniforms[key].value = new THREE.Color(theme()[names[key]]);
  };
  return mesh;
}

// A level plane with rules one radius apart, which fades far from `middle`.
function plane(size, spacing) {
  const uniforms = {
    a: { value: 0 },
    line: { value: 0 },
    middle: { value: new THREE.Vector3() },
    right: { value: new THREE.Vector3(1, 0, 0) },
    ahead: { value: new THREE.Vector3(0, 0, 1) },
    size: { value: size },
    spacing: { value: spacing },
  };
  const material = new THREE.ShaderMaterial({
    uniforms,
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
    extensions: derivatives,
    vertexShader: `varying vec2 local; varying vec2 ruled;
      uniform float size, spacing; uniform vec3 middle, right, ahead;
      void main() { local = position.xy / size;
      ruled = (position.xy + vec2(dot(middle, right), dot(middle, ahead))) / spacing;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `varying vec2 local; varying vec2 ruled; uniform vec3 a, line;
      float rule(vec2 x) { vec2 w = fwidth(x), d = abs(fract(x + 0.5) - 0.5);
        vec2 g = (1.0 - smoothstep(0.5 * w, 1.5 * w, d)) * (1.0 - smoothstep(0.1, 0.45, w)); return max(g.x, g.y); }
      void main() { float fade = 1.0 - smoothstep(0.3, 1.0, length(local));
      gl_FragColor = vec4(mix(a, line, 0.35 * rule(ruled) + 0.3 * rule(ruled / 5.0)), fade * 0.9); }`,
  });
  const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * size, 2 * size), material);
  flat.plane(mesh, uniforms);
  mesh.recolour = () => {
    uniforms.a.value = new THREE.Color(theme().ground);
    uniforms.line.value = new THREE.Color(theme().rule);
  };
  return mesh;
}

// A band along points of a surface with these normals: two corners at each point.
function strip(points, normals, width) {
  const count = points.length,
    places = new Float32Array(6 * count),
    index = new Uint32Array(6 * count - 6);
  for (let i = 0; i < count; i++) {
    const ahead = plus(points[Math.min(i + 1, count - 1)], times(points[Math.max(i - 1, 0)], -1));
    const n = normals[i],
      aside = cross(n, ahead),
      size = Math.hypot(...aside) || 1;
    const lifted = plus(points[i], times(n, width * 0.12));
    places.set(plus(lifted, times(aside, width / size)), 6 * i);
    places.set(plus(lifted, times(aside, -width / size)), 6 * i + 3);
    if (i > 0) index.set([2 * i - 2, 2 * i - 1, 2 * i, 2 * i, 2 * i - 1, 2 * i + 1], 6 * i - 6);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}

// The trail: the path up to the present, a ribbon on a surface that fades with its length, in units of `scale`.
// `at(moment)` gives its points, `normal(moment)` the surface's normal there. Only its bright part is drawn.
function ribbon(moments, at, normal, width, colour, scale, { hidden = false } = {}) {
  const count = moments.length,
    points = moments.map(at),
    length = new Float64Array(count),
    along = new Float32Array(2 * count);
  for (let i = 1; i < count; i++) {
    length[i] = length[i - 1] + Math.hypot(...plus(points[i], times(points[i - 1], -1))) / scale;
    along[2 * i] = along[2 * i + 1] = length[i];
  }
  const geometry = strip(points, moments.map(normal), width);
  geometry.setAttribute("along", new THREE.BufferAttribute(along, 1));
  const uniforms = {
    now: { value: 0 },
    tail: { value: 6 },
    colour: { value: new THREE.Color(colour) },
    strength: { value: hidden ? 0.22 : 1 },
  };
  const material = new THREE.ShaderMaterial({
    uniforms,
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
    depthFunc: hidden ? THREE.GreaterDepth : THREE.LessEqualDepth,
    vertexShader: `attribute float along; varying float where;
      void main() { where = along; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `uniform float now, tail, strength; uniform vec3 colour; varying float where;
      void main() { float age = (now - where) / tail; if (age < 0.0) discard;
      gl_FragColor = vec4(colour, exp(-2.5 * age * age) * strength); }`,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = hidden ? 3 : 2;
  if (!hidden) flat.ribbon(mesh, points, colour);
  const rows = moments.map((m) => m.row);
  mesh.show = (row, trail) => {
    const i = interval(rows, row),
      part = (row - rows[i]) / (rows[i + 1] - rows[i]);
    const now = length[i] + (length[i + 1] - length[i]) * Math.min(Math.max(part, 0), 1);
    const first = interval(length, now - 1.6 * trail.length);
    geometry.setDrawRange(6 * first, 6 * (i + 1 - first));
    Object.assign(mesh, { flatFrom: first, flatTo: i });
    uniforms.now.value = now;
    uniforms.tail.value = trail.length;
  };
  return mesh;
}

// The whole path, as a pale line.
function whole(moments, at, lift) {
  const each = Math.ceil(moments.length / 4000),
    points = moments.filter((_, i) => i % each === 0).map((m) => three(times(at(m), lift)));
  const line = new THREE.Line(
    new THREE.BufferGeometry().setFromPoints(points),
    new THREE.LineBasicMaterial({ transparent: true, opacity: 0.42, depthWrite: false }),
  );
  line.frustumCulled = false;
  line.show = (row, trail) => {
    line.visible = trail.whole;
  };
  line.recolour = () => line.material.color.set(theme().future);
  return line;
}

// A bright bead, with a halo, seen faintly through what hides it.
function bead(radius, colour) {
  const group = new THREE.Group(),
    ball = new THREE.SphereBufferGeometry(radius, 16, 10);
  const add = (scale, settings) => {
    const mesh = new THREE.Mesh(
      ball,
      new THREE.MeshBasicMaterial({ transparent: true, depthWrite: false, ...settings }),
    );
    mesh.scale.setScalar(scale);
    mesh.renderOrder = 5;
    group.add(mesh);
    return mesh;
  };
  const rim = add(1.35, { color: "#ffffff", opacity: 0.9 });
  add(1, { color: colour });
  add(1, { color: colour, opacity: 0.35, depthFunc: THREE.GreaterDepth });
  rim.renderOrder = 4;
  flat.bead(group, radius, colour);
  return group;
}

// A straight line between two points.
function segment(from, to) {
  const geometry = new THREE.BufferGeometry().setFromPoints([three(from), three(to)]);
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.6 }));
  line.recolour = () => line.material.color.set(theme().rule);
  flat.segment(line, [three(from), three(to)]);
  return line;
}
