// marks.js - the words and numbers in the pictures. They are drawn on a canvas of their own over the picture, with all
// pixels of the screen: so they stay sharp where a slow computer draws the picture itself with fewer.

class Marks {
  // `picture` has `eye` and `canvas`; `solids` are spheres, {thing, radius}, that hide what is behind them.
  constructor(picture) {
    this.picture = picture;
    this.list = [];
    this.solids = [];
    this.canvas = document.createElement("canvas");
    this.canvas.className = "marks";
    picture.canvas.parentElement.append(this.canvas);
  }

  clear() {
    this.list = [];
    this.solids = [];
  }

  // A text at a place (three numbers) of a thing, at most as high as `most` there; `colour` gives it a disc.
  add(thing, place, text, { colour, most = Infinity } = {}) {
    const mark = { thing, place: three(place), text, colour, most };
    this.list.push(mark);
    return mark;
  }

  // Whether a solid lies between the eye and a place in the world.
  hidden(place) {
    const eye = this.picture.eye.position,
      way = place.clone().sub(eye),
      far = way.length();
    way.divideScalar(far);
    return this.solids.some(({ thing, radius }) => {
      const to = thing.getWorldPosition(new THREE.Vector3()).sub(eye),
        along = to.dot(way),
        aside = to.lengthSq() - along * along;
      return aside < radius * radius && along - Math.sqrt(radius * radius - aside) < far - 1e-3 * radius;
    });
  }

  draw() {
    const sheetNow = sheet(this.canvas),
      { width, height } = sheetNow;
    this.paint(sheetNow.g, 0, 0, width, height);
  }

  // On any canvas, in the rectangle that the picture fills there.
  paint(g, left, top, width, height) {
    const best = Math.max(12, Math.min(width, height) / 23),
      pixels = height / (2 * Math.tan((this.picture.eye.fov * Math.PI) / 360)); // of a length 1, 1 away from the eye
    g.save();
    g.textAlign = "center";
    g.textBaseline = "middle";
    for (const { thing, place, text, colour, most } of this.list) {
      const world = thing.localToWorld(place.clone()),
        behind = this.hidden(world),
        size = Math.min(best, (most * pixels) / world.distanceTo(this.picture.eye.position)),
        seen = world.project(this.picture.eye);
      if ((behind && !colour) || seen.z > 1 || size < 7) continue;
      const x = left + ((seen.x + 1) / 2) * width,
        y = top + ((1 - seen.y) / 2) * height;
      g.globalAlpha = behind ? 0.4 : 1;
      g.font = `600 ${colour ? 0.8 * size : size}px system-ui, sans-serif`;
      if (colour) {
        g.fillStyle = colour;
        g.strokeStyle = "#ffffff";
        g.lineWidth = 1.5;
        g.beginPath();
        g.arc(x, y, 0.68 * size, 0, 7);
        g.fill();
        g.stroke();
      } else {
        g.lineWidth = 4;
        g.lineJoin = "round";
        g.strokeStyle = theme().paper;
        g.strokeText(text, x, y);
      }
      g.fillStyle = colour ? inkOn(colour) : theme().text;
      g.fillText(text, x, y);
    }
    g.restore();
  }
}
