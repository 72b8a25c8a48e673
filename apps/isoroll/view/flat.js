// flat.js - draws the pictures without WebGL, as line drawings on a plain canvas: each thing of shapes.js says in `flat`
// how it is drawn. What lies behind a solid is pale.

class FlatRenderer {
  constructor(picture) {
    this.picture = picture;
    this.canvas = picture.canvas;
    this.g = this.canvas.getContext("2d");
  }
  setPixelRatio(ratio) {
    this.ratio = ratio;
  }
  setSize(width, height) {
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
  }

  render(scene, eye) {
    const { g, canvas } = this,
      things = [];
    this.eye = eye;
    scene.updateMatrixWorld();
    eye.updateMatrixWorld();
    this.inverse = new THREE.Matrix4().getInverse(eye.matrixWorld);
    this.focal = canvas.height / (2 * Math.tan((eye.fov * Math.PI) / 360));
    g.clearRect(0, 0, canvas.width, canvas.height);
    g.lineWidth = 1.4 * this.ratio;
    g.lineJoin = "round";
    scene.traverseVisible((thing) => thing.flat && things.push(thing));
    const far = (thing) => (thing.isBead ? 0 : thing.getWorldPosition(new THREE.Vector3()).distanceTo(eye.position));
    const rank = (thing) => thing.flatRank * 1e6 - far(thing); // first what is behind
    things.sort((a, b) => rank(a) - rank(b)).forEach((thing) => thing.flat(this));
    g.globalAlpha = 1;
  }

  // A place in the world, in pixels.
  at(place) {
    const p = place.clone().applyMatrix4(this.inverse);
    return [this.canvas.width / 2 - (this.focal * p.x) / p.z, this.canvas.height / 2 + (this.focal * p.y) / p.z];
  }
  size(place, radius) {
    return (this.focal * radius) / place.distanceTo(this.eye.position);
  }
  // A line through places of a thing, in parts that are seen or hidden.
  line(thing, places, colour, { pale = 0.25 } = {}) {
    const { g } = this,
      world = places.map((place) => thing.localToWorld(place.clone())),
      hidden = world.map((place) => this.picture.marks.hidden(place)),
      pixels = world.map((place) => this.at(place));
    g.strokeStyle = colour;
    for (let i = 1; i < pixels.length; i++) {
      g.globalAlpha = hidden[i] ? pale : 1;
      g.beginPath();
      g.moveTo(...pixels[i - 1]);
      do g.lineTo(...pixels[i]);
      while (i + 1 < pixels.length && hidden[i + 1] === hidden[i] && ++i);
      g.stroke();
    }
    g.globalAlpha = 1;
  }
  disc(place, radius, colour, alpha = 1) {
    const { g } = this;
    g.globalAlpha = alpha;
    g.fillStyle = colour;
    g.beginPath();
    g.arc(...this.at(place), radius, 0, 7);
    g.fill();
    g.globalAlpha = 1;
  }
}

const flat = {
  // Great circles perpendicular to the axes; a sphere with a potential has its colours, in squares.
  sphere(mesh, radius, names, { clear, levels }) {
    mesh.flatRank = clear ? 0 : 1;
    mesh.flat = (to) => {
      const centre = mesh.getWorldPosition(new THREE.Vector3()),
        colour = (name) => theme()[name];
      to.disc(centre, to.size(centre, radius), colour(levels ? names.c : names.a), clear ? 0.35 : 1);
      if (levels) flat.potential(to, mesh, centre, radius);
      for (let axis = 0; axis < 3; axis++) {
        const circle = Array.from({ length: 49 }, (_, i) => {
          const v = [0, 0, 0];
          v[(axis + 1) % 3] = 1.002 * radius * Math.cos((i * Math.PI) / 24);
          v[(axis + 2) % 3] = 1.002 * radius * Math.sin((i * Math.PI) / 24);
          return three(v);
        });
        to.line(mesh, circle, colour(names.line), { pale: clear ? 0.5 : 0.08 });
      }
    };
  },
  potential(to, mesh, centre, radius) {
    const { g } = to,
      [x, y] = to.at(centre),
      size = to.size(centre, radius),
      step = Math.max(3, size / 28),
      back = mesh.getWorldQuaternion(new THREE.Quaternion()).inverse(),
      { least, most, logarithmic } = potential,
      ramp = ["deep", "middle", "shallow"].map((name) => new THREE.Color(theme()[name]));
    g.save();
    g.beginPath();
    g.arc(x, y, size, 0, 7);
    g.clip();
    for (let dx = -size; dx < size; dx += step)
      for (let dy = -size; dy < size; dy += step) {
        const [u, v] = [(dx + step / 2) / size, (dy + step / 2) / size],
          w = 1 - u * u - v * v;
        if (w < -0.2) continue;
        const p = new THREE.Vector3(u, -v, Math.sqrt(Math.max(0, w))).normalize().applyQuaternion(to.eye.quaternion).applyQuaternion(back),
          V = physics.V([p.x, p.y, p.z]),
          height = 2 * (logarithmic ? Math.log(V / least) / Math.log(most / least) : (V - least) / (most - least));
        g.fillStyle = ramp[height < 1 ? 0 : 1].clone().lerp(ramp[height < 1 ? 1 : 2], height % 1).getStyle();
        g.fillRect(x + dx, y + dy, step + 0.5, step + 0.5);
      }
    g.restore();
  },
  // Lines one radius apart, which stay where they are while the middle moves.
  plane(mesh, { middle, right, ahead, spacing }) {
    mesh.flatRank = 0;
    mesh.flat = (to) => {
      const along = (axis) => Math.round(axis.dot(middle.value) / spacing.value) * spacing.value - axis.dot(middle.value);
      for (const [a, b] of [
        [right.value, ahead.value],
        [ahead.value, right.value],
      ])
        for (let i = -5; i <= 5; i++) {
          const ends = [-5, 5].map((j) =>
            a.clone().multiplyScalar(along(a) + i * spacing.value).addScaledVector(b, j * spacing.value).add(middle.value),
          );
          to.line(mesh.parent, ends, theme().rule);
        }
    };
  },
  // The newest part of a path: `points`, of which mesh.flatFrom to mesh.flatTo are shown.
  ribbon(mesh, points, colour) {
    const list = points.map(three);
    mesh.flatRank = 2;
    mesh.flat = (to) => to.line(mesh, list.slice(Math.max(mesh.flatFrom, mesh.flatTo - 500), mesh.flatTo + 1), colour);
  },
  segment(mesh, ends) {
    mesh.flatRank = 2;
    mesh.flat = (to) => to.line(mesh, ends, theme().rule, { pale: 0 });
  },
  bead(group, radius, colour) {
    Object.assign(group, { flatRank: 3, isBead: true });
    group.flat = (to) => {
      const place = group.getWorldPosition(new THREE.Vector3()),
        size = to.size(place, radius),
        alpha = to.picture.marks.hidden(place) ? 0.4 : 1;
      to.disc(place, 1.35 * size, "#ffffff", alpha);
      to.disc(place, size, colour, alpha);
    };
  },
};
