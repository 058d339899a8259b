// Picture, reference and signed difference of a row, with linked zoom and a probe.
"use strict";

(() => {
  const panels = {};
  const SCALES = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1];
  let shown = null;  // what is decoded of the row that is shown
  let zoom = { factor: 1, x: 0, y: 0 };  // x, y: the pixel at the left top
  let probed = null;

  const pictureOf = name => new Promise((resolve, reject) => {
    const image = new Image();
    image.onload = () => resolve(image);
    image.onerror = () => reject(new Error(`picture ${name} cannot be read`));
    image.src = `data:image/webp;base64,${Study.pictures[name]}`;
  });

  /** The bytes of an embedded PNG: {width, height, data}, four bytes a pixel. */
  const decode = async name => {
    const image = await pictureOf(name);
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height);
  };

  const toLinear = byte => { const s = byte / 255; return s <= .04045 ? s / 12.92 : ((s + .055) / 1.055) ** 2.4; };
  const toSrgb = v => 255 * (v <= .0031308 ? 12.92 * v : 1.055 * Math.min(1, v) ** (1 / 2.4) - .055);
  const LINEAR = Float32Array.from({ length: 256 }, (_, k) => toLinear(k));

  /** Every `factor`-th pixel, across and down. */
  const thinned = (image, factor) => {
    if (factor === 1) return image;
    const width = Math.ceil(image.width / factor), height = Math.ceil(image.height / factor), data = new Uint8ClampedArray(4 * width * height);
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) {
        const from = 4 * factor * (y * image.width + x);
        data.set(image.data.subarray(from, from + 4), 4 * (y * width + x));
      }
    return { width, height, data };
  };

  /** Errors, visibilities and certificates of every pixel; surfaces that are not there have NaN. */
  const unpack = (reference, error) => {
    const count = reference.width * reference.height;
    const out = { width: reference.width, height: reference.height, reference: new Float32Array(count), error: new Float32Array(count),
                  unshadowed: new Float32Array(count), certificate: new Uint8Array(count) };
    for (let i = 0; i < count; ++i) {
      const byte = error.data[4 * i], root = (byte - 128) / 127;
      out.reference[i] = (reference.data[4 * i] * 256 + reference.data[4 * i + 1]) / 65535;
      out.unshadowed[i] = reference.data[4 * i + 2] / 255;
      out.error[i] = byte === 0 ? NaN : Math.sign(root) * root * root;
      out.certificate[i] = Math.round(error.data[4 * i + 1] / 100);
    }
    return out;
  };

  const toCanvas = (width, height, color) => {
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const context = canvas.getContext("2d"), image = context.createImageData(width, height);
    for (let i = 0; i < width * height; ++i) {
      const rgb = color(i);
      image.data.set([rgb[0], rgb[1], rgb[2], 255], 4 * i);
    }
    context.putImageData(image, 0, 0);
    return canvas;
  };
  /** The scene's colors times the share of the light that is left. */
  const shaded = (lit, numbers, visibility) => toCanvas(numbers.width, numbers.height, i => {
    const bytes = [lit.data[4 * i], lit.data[4 * i + 1], lit.data[4 * i + 2]];
    const unshadowed = numbers.unshadowed[i];
    if (Number.isNaN(numbers.error[i])) return bytes;
    const share = unshadowed > 0 ? Math.min(1, Math.max(0, visibility(i)) / unshadowed) : 0;
    return bytes.map(byte => toSrgb(LINEAR[byte] * share));
  });
  const signedColor = value => {
    const t = Math.min(1, Math.abs(value)), to = value < 0 ? [20, 60, 200] : [200, 30, 20];
    return to.map(c => 255 + (c - 255) * t);
  };
  const drawDifference = () => {
    const scale = Number(document.getElementById("scale").value);
    const { numbers } = shown;
    panels.difference.picture = toCanvas(numbers.width, numbers.height,
      i => Number.isNaN(numbers.error[i]) ? [128, 128, 128] : signedColor(numbers.error[i] / scale));
    panels.difference.caption.replaceChildren("difference: ", `−${scale} `, Study.element("span", { class: "ramp" }), ` +${scale}; blue is too dark`);
  };

  const draw = () => {
    for (const panel of Object.values(panels)) {
      if (!panel.picture) continue;
      const { canvas, picture } = panel, context = canvas.getContext("2d");
      const unit = 2 * shown.factor;
      canvas.width = picture.width * unit;
      canvas.height = picture.height * unit;
      context.imageSmoothingEnabled = false;
      const f = unit * zoom.factor;
      context.setTransform(f, 0, 0, f, -zoom.x * f, -zoom.y * f);
      context.drawImage(picture, 0, 0);
      if (!probed) continue;
      context.strokeStyle = "#ff00c8";
      context.lineWidth = 2 / f;
      context.strokeRect(probed.x - 1 / f, probed.y - 1 / f, 1 + 2 / f, 1 + 2 / f);
    }
  };
  const moveTo = (factor, x, y) => {
    const { width, height } = shown.numbers;
    factor = Math.min(32, Math.max(1, factor));
    zoom = { factor, x: Math.min(width - width / factor, Math.max(0, x)), y: Math.min(height - height / factor, Math.max(0, y)) };
    draw();
  };
  const zoomAt = (ratio, x, y) => {
    const factor = Math.min(32, Math.max(1, zoom.factor * ratio)), kept = zoom.factor / factor;
    moveTo(factor, x - (x - zoom.x) * kept, y - (y - zoom.y) * kept);
  };
  const middle = () => [zoom.x + shown.numbers.width / zoom.factor / 2, zoom.y + shown.numbers.height / zoom.factor / 2];

  const probe = (x, y) => {
    const { numbers, row } = shown;
    probed = { x: Math.min(numbers.width - 1, Math.max(0, Math.floor(x))), y: Math.min(numbers.height - 1, Math.max(0, Math.floor(y))) };
    const i = probed.y * numbers.width + probed.x, step = Math.ceil(row.width / 320) * shown.factor;
    const error = numbers.error[i], reference = numbers.reference[i];
    const certificate = ["not certified", "certified lit", "certified in umbra"][numbers.certificate[i]];
    document.getElementById("probe").textContent = Number.isNaN(error)
      ? `Pixel ${probed.x * step}, ${probed.y * step}: no surface.`
      : `Pixel ${probed.x * step}, ${probed.y * step}: by ${row.method} it sees ${(reference + error).toFixed(4)} of the light, by the reference ` +
        `${reference.toFixed(4)}; error ${error >= 0 ? "+" : "−"}${Study.digits(Math.abs(error), 2)}; ${certificate}.`;
    drawDisk(step, !Number.isNaN(error));
    draw();
  };

  /** The light as the nearest pixel sees it of which that is kept. */
  const drawDisk = (step, lit) => {
    const figure = document.getElementById("disk-figure"), { disks } = shown;
    figure.hidden = !disks || !lit;
    if (figure.hidden) return;
    const points = 12, spacing = 4 / shown.factor, last = n => Math.ceil(n / spacing) - 1;
    const column = Math.min(last(shown.numbers.width), Math.round(probed.x / spacing));
    const row = Math.min(last(shown.numbers.height), Math.round(probed.y / spacing));
    const context = document.getElementById("disk").getContext("2d");
    context.imageSmoothingEnabled = false;
    context.drawImage(disks, column * points, row * points, points, points, 0, 0, 96, 96);
    document.getElementById("disk-text").textContent =
      `The light as pixel ${column * spacing * step}, ${row * spacing * step} sees it: what is black is hidden. (Kept of every ${spacing * step}th pixel.)`;
  };

  const pointers = new Map();
  const listen = canvas => {
    const place = event => {
      const box = canvas.getBoundingClientRect(), { width, height } = shown.numbers;
      return [zoom.x + (event.clientX - box.left) / box.width * width / zoom.factor,
              zoom.y + (event.clientY - box.top) / box.height * height / zoom.factor];
    };
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      zoomAt(event.deltaY < 0 ? 1.25 : .8, ...place(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      probe(...place(event));
    });
    canvas.addEventListener("pointermove", event => {
      const before = pointers.get(event.pointerId);
      if (!before) return event.pointerType === "mouse" && probe(...place(event));
      const box = canvas.getBoundingClientRect(), unit = shown.numbers.width / zoom.factor / box.width;
      const others = [...pointers.entries()].filter(([id]) => id !== event.pointerId);
      if (others.length === 1) {
        const other = others[0][1], span = p => Math.hypot(p.x - other.x, p.y - other.y);
        zoomAt(span({ x: event.clientX, y: event.clientY }) / Math.max(1, span(before)), ...middle());
      } else {
        moveTo(zoom.factor, zoom.x - (event.clientX - before.x) * unit, zoom.y - (event.clientY - before.y) * unit);
      }
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
    canvas.addEventListener("keydown", event => {
      const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      const from = probed || { x: middle()[0], y: middle()[1] };
      if (steps[event.key]) probe(from.x + steps[event.key][0], from.y + steps[event.key][1]);
      else if (event.key === "+" || event.key === "=") zoomAt(1.5, from.x, from.y);
      else if (event.key === "-") zoomAt(1 / 1.5, from.x, from.y);
      else return;
      event.preventDefault();
    });
  };

  const makePanels = () => {
    const place = document.getElementById("pictures");
    for (const name of ["picture", "reference", "difference"]) {
      const canvas = Study.element("canvas", { tabindex: "0", "aria-label": `${name}; arrows move the probe, + and - zoom` });
      const caption = Study.element("figcaption", {}, name);
      panels[name] = { canvas, caption, picture: null };
      place.append(Study.element("figure", {}, canvas, caption));
      listen(canvas);
    }
    const scale = document.getElementById("scale");
    SCALES.forEach(value => scale.append(Study.element("option", { value }, String(value))));
    scale.addEventListener("change", () => { drawDifference(); draw(); });
    const button = (id, action) => document.getElementById(id).addEventListener("click", () => shown && action());
    button("zoom-in", () => zoomAt(1.5, ...middle()));
    button("zoom-out", () => zoomAt(1 / 1.5, ...middle()));
    button("zoom-all", () => moveTo(1, 0, 0));
  };

  /** Shows a row. Resolves when it is drawn. */
  Study.showPicture = async row => {
    if (!panels.picture) makePanels();
    const text = document.getElementById("picture-text");
    const name = [row.picture, row.small_picture].find(one => one in Study.pictures);
    if (!name) {
      text.textContent = `There is no picture of ${row.label}.`;
      return;
    }
    const { lit_picture: litName, reference_picture: referenceName, disks_picture: disksName } = row.seen;
    const [wholeLit, wholeReference, error] = await Promise.all([litName, referenceName, name].map(decode));
    const factor = Math.round(wholeReference.width / error.width);
    const [lit, reference] = [wholeLit, wholeReference].map(image => thinned(image, factor));
    const sameView = shown && shown.row.seen === row.seen;
    const disks = sameView ? shown.disks : disksName in Study.pictures ? await pictureOf(disksName) : null;
    const numbers = unpack(reference, error);
    if (!sameView) { zoom = { factor: 1, x: 0, y: 0 }; probed = null; }
    else if (shown.factor !== factor) {
      const ratio = shown.factor / factor;
      zoom = { factor: zoom.factor, x: zoom.x * ratio, y: zoom.y * ratio };
      if (probed) probed = { x: Math.floor(probed.x * ratio), y: Math.floor(probed.y * ratio) };
    }
    shown = { row, numbers, disks, factor };
    panels.picture.picture = shaded(lit, numbers, i => numbers.reference[i] + numbers.error[i]);
    panels.reference.picture = shaded(lit, numbers, i => numbers.reference[i]);
    panels.picture.caption.textContent = row.label;
    panels.reference.caption.textContent = `reference, twice ${Study.about.samples} rays a pixel`;
    const wanted = Math.max(.001, row.error.penumbra.p99);
    document.getElementById("scale").value = String(SCALES.find(s => s >= wanted) || 1);
    drawDifference();
    draw();
    if (probed) probe(probed.x, probed.y);
    else {
      document.getElementById("disk-figure").hidden = true;
      document.getElementById("probe").textContent = "Point at a pixel for its numbers. Wheel or pinch zooms, dragging moves; all three follow.";
    }
    const peer = row.method in Study.PEERS ? ` (${Study.PEERS[row.method].short})` : "";
    text.textContent = `${row.scene}: ${row.label}. ${Study.ms(row.frame_ms.median)} a frame${peer}, RMSE ${Study.rmseText(row)} where the shadow is soft. ` +
      `Stages, ms: ${Object.entries(row.stages).map(([stage, ms]) => `${stage.replaceAll("_", " ")} ${Study.digits(ms, 2)}`).join(", ")}.` +
      (factor > 1 ? " Of settings beside the front every second pixel is kept." : "");
    document.getElementById("pictures").dataset.row = row.key;
  };
})();
