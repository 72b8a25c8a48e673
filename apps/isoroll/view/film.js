// film.js - pictures and films as files: what both pictures show, with their names and the clocks, on one canvas.

const film = {
  // Names, pictures as they were drawn last, and clocks.
  paint(g, width, height) {
    const style = getComputedStyle(document.body),
      pictures = controls.shown(),
      head = Math.round(height * 0.09),
      foot = head,
      part = width / pictures.length;
    g.fillStyle = style.getPropertyValue("--page");
    g.fillRect(0, 0, width, height);
    pictures.forEach((picture, i) => {
      const { x, y, w, h } = film.fit(picture.canvas, i * part, head, part, height - head - foot);
      g.drawImage(picture.canvas, x, y, w, h);
      picture.marks.paint(g, x, y, w, h);
    });
    g.textAlign = "center";
    pictures.forEach((picture, i) => {
      g.fillStyle = style.getPropertyValue("--text");
      g.font = `600 ${Math.round(head * 0.42)}px system-ui, sans-serif`;
      g.fillText(picture.name, (i + 0.5) * part, head * 0.65);
    });
    film.clocks(g, width, height - foot * 0.4, Math.round(foot * 0.36), style);
  },

  clocks(g, width, y, size, style) {
    const list = controls.orbit.clocks;
    g.font = `${size}px ui-monospace, monospace`;
    list.forEach((name, i) => {
      const text = `${clockWords[name][0]} = ${reading(controls.now[name], clocks.spans[name])}`;
      g.fillStyle = style.getPropertyValue(`--${name}`);
      g.fillText(
        list.length > 1 && name === clocks.even ? `${text} (even)` : text,
        (width * (i + 1)) / (list.length + 1),
        y,
      );
    });
  },

  // The largest rectangle of a canvas's shape inside another.
  fit(canvas, x, y, width, height) {
    const scale = Math.min(width / canvas.width, height / canvas.height),
      w = canvas.width * scale,
      h = canvas.height * scale;
    return { x: x + (width - w) / 2, y: y + (height - h) / 2, w, h };
  },

  // Draws the pictures anew, with all the pixels that a canvas of this size has for them.
  compose(width, height) {
    const canvas = document.createElement("canvas"),
      pictures = controls.shown(),
      part = width / pictures.length,
      tall = height - 2 * Math.round(height * 0.09);
    canvas.width = width;
    canvas.height = height;
    for (const picture of pictures) {
      picture.renderer.setPixelRatio(2); // smooth edges
      picture.renderer.setSize(part, tall, false);
      picture.shape(part / tall);
      picture.show(controls.now, controls.trail());
      picture.draw();
    }
    film.paint(canvas.getContext("2d"), width, height);
    return canvas;
  },

  save(blob, ending, name = page.title) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${name.replace(/[^\w.-]+/g, "_")}.${ending}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  },
  savePicture() {
    const canvas = film.compose(1920, 1080);
    controls.resize();
    canvas.toBlob((blob) => film.save(blob, "png"));
  },

  // A film of what is seen, from now until the button is pressed again or the orbit ends.
  record() {
    if (film.recorder) return film.recorder.stop();
    const canvas = document.createElement("canvas"),
      pieces = [];
    canvas.width = 1280;
    canvas.height = 720;
    film.sheet = canvas.getContext("2d");
    film.paint(film.sheet, 1280, 720);
    film.recorder = new MediaRecorder(canvas.captureStream(30), { videoBitsPerSecond: 8e6 });
    film.recorder.ondataavailable = (e) => pieces.push(e.data);
    film.recorder.onstop = () => {
      film.recorder = null;
      element("film").textContent = "Record video";
      controls.play(false);
      film.save(new Blob(pieces, { type: "video/webm" }), "webm");
    };
    element("film").textContent = "Stop and save video";
    film.recorder.start();
    controls.play(true);
  },
  // After each picture that was drawn.
  step() {
    if (film.recorder) film.paint(film.sheet, 1280, 720);
  },
  ended() {
    if (film.recorder) film.recorder.stop();
  },
};
