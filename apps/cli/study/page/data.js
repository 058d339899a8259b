// The numbers of the page, and what is derived from them.
"use strict";
const Study = { ...JSON.parse(document.getElementById("data").textContent) };

Study.TIMES = {
  frame: { title: "a whole frame", of: row => row.frame_ms.median, range: row => row.frame_ms },
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

// Errors below this are drawn at it: the axis is logarithmic, and references have noise.
Study.FLOOR = 1e-5;

Study.rows = Study.rows.filter(row => !row.refused);
Study.cases.forEach(seen => { seen.rows = Study.rows.filter(row => row.case === seen.id); });
Study.rows.forEach(row => { row.seen = Study.cases.find(seen => seen.id === row.case); });
Study.scenes = Study.cases.filter(seen => !seen.sweep && seen.rows.length > 0);
Study.methods = [...new Set(Study.rows.map(row => row.method))];

/** The chosen error of a row; undefined where the row has none. */
Study.errorOf = (row, view) => view.error === "flip" ? row.error.flip : row.error[view.area][view.error];
Study.timeOf = (row, view) => Study.TIMES[view.time].of(row);

/** Points of a plot: {x, y, row, label, method, below}. */
Study.pointsOf = (rows, view) => rows.flatMap(row => {
  const x = Study.timeOf(row, view), error = Study.errorOf(row, view);
  if (!(x > 0) || error === undefined || view.hidden.has(row.method)) return [];
  return [{ x, y: Math.max(error, Study.FLOOR), below: error < Study.FLOOR, row, label: row.label, method: row.method }];
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
    const error = p => p.below ? 0 : p.y;
    const y = Math.sqrt(mean(p => error(p) ** 2));
    const worst = points.reduce((a, b) => error(a) >= error(b) ? a : b);
    return [{ x: Math.exp(mean(p => Math.log(p.x))), y: Math.max(y, Study.FLOOR), below: y < Study.FLOOR,
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
Study.settingOf = label => label.includes(", ") ? label.slice(label.indexOf(", ") + 2) : "defaults";

Study.digits = (value, count = 3) => {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const text = Number(value.toPrecision(count));
  return Math.abs(text) < 1e-4 ? text.toExponential() : String(text);
};
Study.ms = value => value >= 1000 ? `${Study.digits(value / 1000)} s` : `${Study.digits(value)} ms`;
Study.errorText = value => value < Study.FLOOR ? "< 0.00001" : Study.digits(value);

Study.element = (name, attributes = {}, ...children) => {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    key.startsWith("on") ? node.addEventListener(key.slice(2), value) : node.setAttribute(key, value);
  node.append(...children);
  return node;
};
Study.colorOf = method => getComputedStyle(document.documentElement)
  .getPropertyValue(`--m${Study.methods.indexOf(method) % 8}`).trim();
