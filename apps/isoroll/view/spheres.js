// spheres.js - the two pictures in space, and the camera that both share.

// Axis 3 of the body points up, as in the pictures of `isoroll plot`.
const bodyUp = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(1, 0, 0), -Math.PI / 2);

const camera = {
  azimuth: 0.7,
  elevation: 0.42,
  zoom: 1,
  home: { azimuth: 0.7, elevation: 0.42, zoom: 1 },
  reset() {
    Object.assign(camera, camera.home);
  },
  look(azimuth, elevation, zoom) {
    Object.assign(camera, { azimuth, elevation, zoom });
  },
  // Turns to a direction in body axes: there the point is seen from the front.
  face(v) {
    camera.home.azimuth = Math.hypot(v[0], v[1]) > 0.1 ? Math.atan2(v[0], -v[1]) + 0.5 : 0.7;
    camera.reset();
  },
};

// Whether the browser has WebGL, and whether a graphics card or the processor draws. The processor draws edges that
// are not smoothed, and draws more pixels when everything stands still.
const graphics = (() => {
  const canvas = document.createElement("canvas"),
    gl = canvas.getContext("webgl") || canvas.getContext("experimental-webgl");
  if (!gl) return { there: false, best: 1 };
  const masked = gl.getParameter(gl.RENDERER) === "WebKit WebGL" && gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(masked ? masked.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  const byProcessor = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name),
    lose = gl.getExtension("WEBGL_lose_context");
  if (lose) lose.loseContext();
  return { there: true, byProcessor, best: byProcessor ? 2 : 1 };
})();

class Picture {
  constructor(canvas, distance) {
    this.canvas = canvas;
    this.renderer = graphics.there
      ? new THREE.WebGLRenderer({ canvas, antialias: !graphics.byProcessor, alpha: true })
      : new FlatRenderer(this);
    this.scene = new THREE.Scene();
    this.eye = new THREE.PerspectiveCamera(30, 1, distance / 100, distance * 20);
    this.distance = distance;
    this.target = new THREE.Vector3();
    this.quality = 1; // of the resolution: less where drawing is slow
    this.marks = new Marks(this);
    this.steer();
  }

  // Takes everything out, before it is built anew.
  clear() {
    this.scene.traverse((thing) => {
      if (thing.geometry) thing.geometry.dispose();
      if (thing.material) thing.material.dispose();
    });
    this.scene.remove(...this.scene.children);
    this.marks.clear();
    this.ribbons = [];
    this.world = this.add(this.scene, new THREE.Group()); // space axes, as they are drawn
  }

  add(parent, ...things) {
    for (const thing of things) parent.add(thing);
    return things[0];
  }

  recolour() {
    this.scene.traverse((thing) => thing.recolour && thing.recolour());
  }

  resize() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    const width = Math.max(1, Math.round(box.width)),
      height = Math.max(1, Math.round(box.height));
    this.renderer.setPixelRatio(Math.min(Math.min(devicePixelRatio, 2) * this.quality, 2));
    this.renderer.setSize(width, height, false);
    this.shape(width / height);
  }

  // A narrow picture is seen from farther away.
  shape(aspect) {
    this.eye.aspect = aspect;
    this.far = Math.max(1, 1 / aspect);
  }

  draw() {
    const { azimuth: a, elevation: e, zoom } = camera,
      d = ((this.near || this.distance) * this.far) / zoom;
    const place = new THREE.Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
    this.eye.position.copy(place.multiplyScalar(d)).add(this.target);
    this.eye.lookAt(this.target);
    this.eye.updateProjectionMatrix();
    this.renderer.render(this.scene, this.eye);
    this.marks.draw();
  }

  // The axes 1, 2, 3 of a unit sphere in this.world.
  axes(names) {
    names.forEach((text, i) => {
      const end = [0, 0, 0],
        start = [0, 0, 0],
        place = [0, 0, 0];
      start[i] = 1;
      end[i] = 1.1;
      place[i] = 1.16;
      this.add(this.world, segment(start, end));
      this.marks.add(this.world, place, text);
    });
  }

  // Drag, wheel, two fingers, and arrow keys. One finger up or down scrolls the page.
  steer() {
    const fingers = new Map(),
      { canvas } = this;
    let apart = 0;
    const spread = () => {
      const [p, q] = [...fingers.values()];
      return Math.hypot(p[0] - q[0], p[1] - q[1]);
    };
    const rotate = (dx, dy) => {
      camera.azimuth -= dx;
      camera.elevation = Math.min(1.5, Math.max(-1.5, camera.elevation + dy));
      controls.changed();
    };
    const zoom = (by) => {
      camera.zoom = Math.min(12, Math.max(0.3, camera.zoom * by));
      controls.changed();
    };
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      fingers.set(e.pointerId, [e.clientX, e.clientY]);
      if (fingers.size === 2) apart = spread();
    });
    canvas.addEventListener("pointermove", (e) => {
      const last = fingers.get(e.pointerId);
      if (!last) return;
      fingers.set(e.pointerId, [e.clientX, e.clientY]);
      if (fingers.size === 1) rotate((e.clientX - last[0]) / 150, (e.clientY - last[1]) / 150);
      if (fingers.size === 2) {
        const now = spread();
        zoom(now / apart);
        apart = now;
        rotate(0, (e.clientY - last[1]) / 300);
      }
    });
    for (const name of ["pointerup", "pointercancel"])
      canvas.addEventListener(name, (e) => fingers.delete(e.pointerId));
    canvas.addEventListener(
      "wheel",
      (e) => {
        e.preventDefault();
        zoom(Math.exp(-e.deltaY / 600));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: [0.08, 0], ArrowRight: [-0.08, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08] }[e.key];
      if (!by) return;
      rotate(-by[0], by[1]);
      e.preventDefault();
      e.stopPropagation();
    });
  }
}

// --- the ball in space ---

class BallPicture extends Picture {
  constructor(canvas) {
    super(canvas, 1);
    this.name = "the ball";
    this.build();
  }

  build() {
    const { A, B, kind } = body;
    this.clear();
    this.size = body.flat ? 2.3 * B : kind === "outside" ? A + B : kind === "inside" ? A : Math.max(A, B);
    this.distance = 4.05 * this.size;
    this.eye.near = this.distance / 200;
    this.eye.far = this.distance * 30;
    this.ball = this.add(this.world, new THREE.Group());
    this.buildSupport();
    this.buildBall();
    this.bead = this.add(this.world, bead(0.045 * Math.min(B, this.size / 2), colours.curve));
    this.middle = new THREE.Vector3();
    this.origin = [0, 0, 0]; // of what is drawn: near the contact where the sphere is very large
    this.from = body.flat || body.large ? "follow" : "room";
  }

  buildSupport() {
    const { A, B, kind } = body,
      names = { a: "ground", b: "ground", c: "ground", line: "rule" };
    if (body.flat) this.support = this.add(this.world, plane(16 * B, B));
    else
      this.support = this.add(
        this.world,
        sphere(A, 1, names, { side: kind === "inside" ? THREE.BackSide : THREE.FrontSide, finer: body.large ? 8 : 1 }),
      );
  }

  buildBall() {
    const { B, kind } = body,
      names = { a: "ball", b: "dark", c: "ball", line: "line" };
    if (kind === "shell") {
      this.add(this.ball, sphere(B, 0, names, { side: THREE.BackSide }), sphere(B, 0, names, { opacity: 0.1 }));
    } else this.add(this.ball, sphere(B, 0, names));
    for (let i = 0; i < 3; i++)
      this.marks.add(
        this.ball,
        [0, 1, 2].map((j) => (i === j ? 1.08 * B : 0)),
        String(i + 1),
        { most: 0.24 * B },
      );
    if (kind !== "shell") this.marks.solids.push({ thing: this.ball, radius: B });
    if (kind !== "inside" && !body.flat) this.marks.solids.push({ thing: this.world, radius: body.A });
  }

  setOrbit(orbit, moments) {
    const B = body.B,
      thin = Math.min(0.026 * B, 0.014 * this.size),
      wide = 0.011 * (body.large ? 3 * B : this.size),
      plane = body.flat;
    if (body.flat && body.kind !== "plane") this.origin = moments[0].contact;
    for (const old of this.ribbons || []) {
      old.parent.remove(old);
      old.geometry.dispose();
    }
    const out = body.b > 0 ? 1 : -1; // the trace lies on the outside of the ball, of a shell on its inside
    const side = body.kind === "shell" ? -1 : 1;
    const trace = (hidden) =>
      ribbon(
        moments,
        (m) => m.trace,
        (m) => times(m.n, -out * side),
        thin,
        colours.curve,
        B,
        { hidden },
      );
    const space = (hidden) =>
      ribbon(
        moments,
        (m) => this.drawn(m.contact),
        (m) => times(m.normal, body.kind === "inside" ? -1 : 1),
        wide,
        colours.support,
        B,
        { hidden },
      );
    this.ribbons = [
      this.add(this.ball, trace(false)),
      this.add(this.world, space(false)),
      this.add(
        this.ball,
        whole(moments, (m) => m.trace, 1 + 0.003 * side),
      ),
      this.add(
        this.world,
        whole(moments, (m) => this.drawn(m.contact), plane ? 1 : body.kind === "inside" ? 0.998 : 1.002),
      ),
    ];
    if (body.kind !== "shell") this.ribbons.push(this.add(this.ball, trace(true)));
    if (!plane) this.ribbons.push(this.add(this.world, space(true)));
    const up = upOf(orbit);
    this.upright = new THREE.Quaternion().setFromUnitVectors(three(up), new THREE.Vector3(0, 1, 0));
    if (body.kind === "inside" && !plane && page.effects.gravity) this.openBowl(moments, up);
    this.recolour();
  }

  // With gravity only the part of the sphere below the highest contact is drawn: a bowl.
  openBowl(moments, up) {
    const { A, B } = body,
      uniforms = this.support.material.uniforms;
    const highest = moments.reduce((most, m) => Math.max(most, dot(m.contact, up)), -A);
    const rim = Math.min(0.9 * A, highest + 0.12 * A),
      low = Math.min(rim, 0);
    uniforms.up.value.copy(three(up));
    uniforms.rim.value = rim;
    const width = Math.sqrt(A * A - low * low),
      height = rim + A;
    this.distance = 4.05 * Math.max(width, height / 2, 2 * B);
    this.middle = new THREE.Vector3(0, (rim - A) / 2, 0);
    camera.elevation = camera.home.elevation = 0.6;
  }

  drawn(place) {
    return place.map((x, i) => x - this.origin[i]);
  }

  show(now, trail) {
    const centre = three(this.drawn(now.centre));
    this.ball.position.copy(centre);
    this.ball.quaternion.copy(turn(now.q));
    this.bead.position.copy(three(this.drawn(now.contact)));
    if (body.flat) this.showPlane(now);
    for (const strip of this.ribbons) strip.show(now.row, trail);
    this.world.quaternion.copy(this.upright);
    this.world.position.set(0, 0, 0);
    this.target.copy(this.middle);
    // the middle of ball and sphere together, so that they fill the picture; a bowl has its own
    if (body.kind === "outside") this.target.copy(three(times(now.normal, body.B)).applyQuaternion(this.upright));
    if (body.kind === "shell" && body.B > body.A) this.target.copy(centre.clone().applyQuaternion(this.upright));
    this.near = this.from === "room" ? 0 : 4.05 * (body.kind === "shell" ? 1.2 : 2.2) * body.B;
    this.eye.near = (this.near || this.distance) / 200;
    if (this.from === "follow") this.target.copy(centre.clone().applyQuaternion(this.upright));
    if (this.from === "ball") {
      const back = bodyUp.clone().multiply(turn(inverse(now.q)));
      this.target.set(0, 0, 0);
      this.world.quaternion.copy(back);
      this.world.position.copy(centre.clone().applyQuaternion(back).negate());
    }
  }

  // The drawn part of the plane goes with the ball; its lines stay where they are.
  showPlane(now) {
    const { middle, right, ahead } = this.support.material.uniforms,
      contact = three(this.drawn(now.contact));
    const flat = this.support.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), three(now.normal));
    this.support.position.copy(contact);
    middle.value.copy(contact);
    right.value.set(1, 0, 0).applyQuaternion(flat);
    ahead.value.set(0, 1, 0).applyQuaternion(flat);
  }
}

// --- the point ---

class PointPicture extends Picture {
  constructor(canvas) {
    super(canvas, 4.7);
    this.name = "the point";
    this.build();
  }

  build() {
    this.clear();
    this.world.quaternion.copy(bodyUp);
    const { levels } = potential;
    const names = levels
      ? { a: "deep", b: "shallow", c: "middle", line: "line" }
      : { a: "ball", b: "dark", c: "ball", line: "line" };
    this.add(this.world, sphere(1, levels ? 2 : 0, names, { levels }));
    this.axes(["1", "2", "3"]);
    this.marks.solids.push({ thing: this.world, radius: 1 });
    this.second = this.add(this.world, bead(0.042, "#000000"));
    this.bead = this.add(this.world, bead(0.042, colours.curve));
  }

  setOrbit(orbit, moments) {
    for (const old of this.ribbons || []) {
      old.parent.remove(old);
      old.geometry.dispose();
    }
    const at = (m) => m.gamma;
    this.ribbons = [false, true].map((hidden) => ribbon(moments, at, at, 0.016, colours.curve, 1, { hidden }));
    this.ribbons.push(whole(moments, at, 1.003));
    this.add(this.world, ...this.ribbons);
    this.recolour();
  }

  show(now, trail) {
    this.bead.position.copy(three(now.gamma)).multiplyScalar(1.015);
    this.second.visible = controls.beside;
    if (controls.beside) this.second.position.copy(three(growth.place(now, "gamma"))).multiplyScalar(1.015);
    for (const strip of this.ribbons) strip.show(now.row, trail);
  }
}

// The uniforms with which heightOf (shapes.js) gives 0 at V = least and 1 at V = most. V is divided by `size`.
function levelsOf(least, most, logarithmic) {
  const { field } = page.effects,
    size = Math.max(Math.abs(least), Math.abs(most)),
    by = (x) => Math.log(x / -page.eps);
  const levels = { J: three(body.J), power: -1 / body.k, mode: !logarithmic ? 1 : field ? 2 : 0 };
  levels.range =
    levels.mode === 0 ? new THREE.Vector2(by(least), by(most)) : new THREE.Vector2(least / size, most / size);
  levels.free = -page.eps / size;
  if (!field) return levels;
  levels.bound = body.detJ / body.k ** 2 / size;
  if (field.linear) levels.linear = three(field.linear);
  if (field.quadratic) levels.quadratic = new THREE.Matrix3().set(...field.quadratic);
  return levels;
}

// The potential on the sphere, as heights from 0 (deepest) to 1; by its logarithm if V < 0 and its ratio is above 4.
const potentialOf = () => {
  if (page.alone || !(page.eps !== null) || page.eps === 0) return {};
  let least = Infinity,
    most = -Infinity;
  for (let i = 0; i < 4000; i++) {
    // points spread evenly over the sphere
    const z = 1 - (2 * i + 1) / 4000,
      r = Math.sqrt(1 - z * z),
      angle = i * 2.399963229728653;
    const V = physics.V([r * Math.cos(angle), r * Math.sin(angle), z]);
    least = Math.min(least, V);
    most = Math.max(most, V);
  }
  for (let i = 0; i < 3; i++) {
    const V = physics.V([0, 0, 0].map((_, j) => +(i === j)));
    least = Math.min(least, V);
    most = Math.max(most, V);
  }
  if (!(most - least > 1e-9 * Math.abs(least))) return {}; // equal moments: V is constant
  const logarithmic = most < 0 && least / most > 4;
  return { levels: levelsOf(least, most, logarithmic), least, most, logarithmic };
};
let potential = potentialOf();
