// The numbers of the page, and what is derived from them.
"use strict";
const Study = { ...JSON.parse(document.getElementById("data").textContent) };

Study.TIMES = {
  frame: { title: "a whole frame", of: row => row.frame_ms.median },
  visibility: { title: "visibility alone", of: row => row.visibility_ms },
};
Study.ERRORS = {
  rmse: { title: "RMSE" },
  median: { title: "median" },
  p99: { title: "99 of 100 pixels are within" },
  max: { title: "largest" },
  flip: { title: "seen by the eye (FLIP)", whole: true },
};
Study.AREAS = { penumbra: "where the shadow is soft", all: "all" };

// What people use instead, measured beside: what of it compares, and what does not. `short` stands beside its numbers.
Study.PEERS = {
  "embree-loop": { summary: "one ray at a time, by Embree", short: "independent rays, one at a time, that start .001 away", long: "a plain loop over Embree's rays as its tutorial has it: one independent ray at a time, started .001 away from the surface." },
  povray: { summary: "POV-Ray's circular area light", short: "time of one process; the horizon counts for the light's center alone", long: "the circular area light of POV-Ray: the same n × n points of the light at every pixel, the horizon for its center alone; V is the ratio of a picture with and one without shadows." },
  cycles: { summary: "Blender's Cycles, no denoiser", short: "time of Blender's render call, shading in it", long: "Blender's Cycles, direct light only, no denoiser; V is the ratio of a picture with and one without shadows. Evenly weighed, each point of the light counts alike, as in V; by irradiance, as Blender has it, cosines and distance count, which is another number. Its time has shading in it." },
  "threejs-pcss": { summary: "percentage-closer soft shadows of three.js, on software OpenGL", short: "time of software OpenGL, no measure of a GPU", long: "three.js with percentage-closer soft shadows as in its example, in headless Chromium; V is the ratio of a frame with and one without shadows, the horizon counts for the light's center alone. Its time is that of software OpenGL (SwiftShader): it says nothing of a GPU." },
};

// Errors below this are drawn at it: the axis is logarithmic.
Study.FLOOR = 1e-5;

Study.rows = Study.rows.filter(row => !row.refused);
Study.cases.forEach(seen => { seen.rows = Study.rows.filter(row => row.case === seen.id); });
Study.rows.forEach(row => { row.seen = Study.cases.find(seen => seen.id === row.case); });
Study.scenes = Study.cases.filter(seen => !seen.sweep && seen.rows.length > 0);
Study.methods = [...new Set(Study.rows.map(row => row.method))];

/** The least RMSE that two references tell from 0: n stratified rays are off by .4 n^-3/4, and the mean is over many pixels. */
Study.leastRmse = (samples, pixels) => .4 * samples ** -.75 / pixels ** .25;

/**
 * The chosen error of a row: {value, below}; undefined where the row has none. An RMSE whose interval reaches 0 is less than
 * the references can tell: its value is then the interval's upper end, or what they can tell at best, and it is `below` that.
 */
Study.errorOf = (row, view) => {
  if (view.error === "flip") return row.error.flip === undefined ? undefined : { value: Math.max(Study.FLOOR, row.error.flip), below: row.error.flip < Study.FLOOR };
  const figures = row.error[view.area], value = figures[view.error];
  const untold = view.error === "rmse" && figures.rmse_low === 0;
  return { value: Math.max(Study.FLOOR, untold ? Math.max(figures.rmse_high, figures.pixels > 0 ? Study.leastRmse(row.error.samples, figures.pixels) : 0) : value), below: untold || value < Study.FLOOR };
};
/** One line: how the method computes visibility. */
Study.summaryOf = method => Study.PEERS[method]?.summary || Study.summaries?.[method] || "";
Study.rmseText = row => Study.errorText(Study.errorOf(row, { error: "rmse", area: "penumbra" }));
Study.timeOf = (row, view) => Study.TIMES[view.time].of(row);

/** Points of a plot: {x, y, row, label, method, below}. */
Study.pointsOf = (rows, view) => rows.flatMap(row => {
  const x = Study.timeOf(row, view), error = Study.errorOf(row, view);
  if (!(x > 0) || error === undefined || view.hidden.has(row.method)) return [];
  return [{ x, y: error.value, below: error.below, row, label: row.label, method: row.method }];
});

/** One point a setting that every scene has: geometric mean of times, root mean square of errors. */
Study.pointsOverAll = view => {
  const byLabel = Map.groupBy
    ? Map.groupBy(Study.scenes.flatMap(seen => seen.rows), row => row.label)
    : Study.scenes.flatMap(seen => seen.rows).reduce((map, row) => map.set(row.label, [...(map.get(row.label) || []), row]), new Map());
  return [...byLabel.values()].flatMap(rows => {
    const points = Study.pointsOf(rows, view);
    if (points.length < Study.scenes.length) return [];
    const mean = f => points.reduce((sum, p) => sum + f(p), 0) / points.length;
    const worst = points.reduce((a, b) => a.y >= b.y ? a : b);
    return [{ x: Math.exp(mean(p => Math.log(p.x))), y: Math.sqrt(mean(p => p.y ** 2)), below: points.every(p => p.below),
              row: worst.row, label: worst.label, method: worst.method, scenes: points.length }];
  });
};

/** Those of the points than which none is both faster and more accurate, from the fastest on. */
Study.frontOf = points => {
  const front = [];
  for (const p of [...points].sort((a, b) => a.x - b.x || a.y - b.y))
    if (front.length === 0 || p.y < front[front.length - 1].y) front.push(p);
  return front;
};

/** "silhouette-rows 16" of "silhouette, silhouette-rows 16"; "defaults" where nothing differs. */
Study.settingOf = label => (label.includes(", ") ? label.slice(label.indexOf(", ") + 2) : "defaults")
  .replace(/\d\.?\d*e-\d+/g, text => Study.digits(Number(text), 2));

Study.digits = (value, count = 3) => {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const text = Number(value.toPrecision(count));
  return Math.abs(text) < 1e-4 ? text.toExponential() : String(text);
};
/** Of an axis: "50", "20k", "1M". */
Study.short = value => value >= 1e6 ? `${value / 1e6}M` : value >= 1e4 ? `${value / 1e3}k` : Study.digits(value, 2);
Study.ms = value => value >= 1000 ? `${Study.digits(value / 1000)} s` : `${Study.digits(value)} ms`;
/** Of a point or of what errorOf gives. */
Study.errorText = ({ y, value = y, below }) => (below ? "≤ " : "") + Study.digits(value, below ? 2 : 3);

Study.element = (name, attributes = {}, ...children) => {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    key.startsWith("on") ? node.addEventListener(key.slice(2), value) : node.setAttribute(key, value);
  node.append(...children);
  return node;
};
/** A mix of a color of the page and what is behind: a share of the color. Both as #rrggbb. */
Study.faded = (color, share) => {
  const behind = getComputedStyle(document.documentElement).getPropertyValue("--panel").trim();
  const part = (text, k) => parseInt(text.slice(2 * k + 1, 2 * k + 3), 16);
  const mixed = [0, 1, 2].map(k => Math.round(share * part(color, k) + (1 - share) * part(behind, k)));
  return `rgb(${mixed.join(", ")})`;
};
Study.colorOf = method => getComputedStyle(document.documentElement)
  .getPropertyValue(`--m${Study.methods.indexOf(method) % 12}`).trim();
