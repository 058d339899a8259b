// "In short", the choice of a method by budget, and all rows as a table.
"use strict";

Study.ERROR_BUDGETS = [0.05, 0.02, 0.01, 0.005, 0.002, 0.001];
Study.TIME_BUDGETS = [5, 10, 20, 50, 100, 300, 1000];

/** The fastest of the points within an error, or the most accurate within a time; null where there is none. */
Study.bestOf = (points, kind, budget) => {
  const [limit, wanted] = kind === "error" ? ["y", "x"] : ["x", "y"];
  return points.filter(p => p[limit] <= budget).reduce((best, p) => best && best[wanted] <= p[wanted] ? best : p, null);
};

Study.chip = method => Study.element("span", { class: "chip", style: `background: ${Study.colorOf(method)}` });

/** Which method is the fastest for some errors, counted over scenes. */
Study.fillShort = (place, view) => {
  const list = Study.element("ul");
  for (const budget of [0.05, 0.01, 0.002]) {
    const counts = new Map();
    for (const seen of Study.scenes) {
      const best = Study.bestOf(Study.pointsOf(seen.rows, view), "error", budget);
      if (best) counts.set(best.method, [...(counts.get(best.method) || []), best.x]);
    }
    const all = Study.scenes.length, reached = [...counts.values()].flat().length;
    const range = times => [...new Set([Study.ms(Math.min(...times)), Study.ms(Math.max(...times))])].join(" to ");
    const item = Study.element("li", {}, `Within an error of ${budget} `);
    if (counts.size > 0) item.append("the fastest is ");
    [...counts.entries()].sort((a, b) => b[1].length - a[1].length).forEach(([method, times], k) => {
      item.append(k > 0 ? ", " : "", Study.element("b", {}, method), ` on ${times.length} of ${all} ${all > 1 ? "scenes" : "scene"} (${range(times)})`);
    });
    if (reached < all) item.append(`${counts.size > 0 ? "; " : ""}none is known to be on ${all - reached} of ${all}`);
    item.append(".");
    list.append(item);
  }
  place.replaceChildren(list);
};

Study.fillChoice = (place, view, kind, onPick) => {
  const budgets = kind === "error" ? Study.ERROR_BUDGETS : Study.TIME_BUDGETS;
  const head = Study.element("tr", {}, Study.element("th", {}, kind === "error" ? "error at most" : "time at most"),
    ...budgets.map(b => Study.element("th", { scope: "col" }, kind === "error" ? String(b) : Study.ms(b))));
  const cell = (point) => {
    if (!point) return Study.element("td", {}, "–");
    const result = kind === "error" ? Study.ms(point.x) : Study.errorText(point);
    return Study.element("td", {}, Study.element("button", { type: "button", onclick: () => onPick(point) },
      Study.chip(point.method), point.method, Study.element("span", { class: "small" }, `${result}, ${Study.settingOf(point.label)}`)));
  };
  const row = (name, points) => Study.element("tr", {}, Study.element("th", { scope: "row" }, name),
    ...budgets.map(b => cell(Study.bestOf(points, kind, b))));
  const body = Study.scenes.map(seen => row(seen.scene, Study.pointsOf(seen.rows, view)));
  if (Study.scenes.length > 1) body.unshift(row("all scenes", Study.pointsOverAll(view)));
  place.replaceChildren(Study.element("table", {}, Study.element("thead", {}, head), Study.element("tbody", {}, ...body)));
};

/** For each scene a line from 5 ms to 1 s: which method is the most accurate within the time. */
Study.fillHolders = (place, view, onPick) => {
  const [from, to] = [5, 1000], at = ms => 100 * Math.log(ms / from) / Math.log(to / from);
  const line = points => {
    const front = Study.frontOf(points), bar = Study.element("div", { class: "bar-line" });
    front.forEach((point, k) => {
      const left = Math.max(0, at(point.x)), right = Math.min(100, k + 1 < front.length ? at(front[k + 1].x) : 100);
      if (right <= left) return;
      const error = Study.errorText(point);
      bar.append(Study.element("button", { type: "button", style: `left: ${left}%; width: ${right - left}%; background: ${Study.colorOf(point.method)}`,
        title: `${point.label}: ${Study.ms(point.x)}, error ${error}`, onclick: () => onPick(point) }, `${point.method} ${error}`));
    });
    return bar;
  };
  const lines = Study.scenes.flatMap(seen => [Study.element("span", {}, seen.scene), line(Study.pointsOf(seen.rows, view))]);
  const ticks = [5, 10, 20, 50, 100, 200, 500, 1000].map(ms => Study.element("span", { style: `left: ${at(ms)}%` }, Study.ms(ms)));
  place.className = "holders";
  place.replaceChildren(...lines, Study.element("span", {}, ""), Study.element("div", { class: "bar-ticks" }, ...ticks));
};

const COLUMNS = [
  ["setting", r => r.label],
  ["frame", r => Study.ms(r.frame_ms.median)],
  ["quartiles", r => `${Study.digits(r.frame_ms.low)}–${Study.digits(r.frame_ms.high)}`],
  ["times the default", r => r.over_default ? Study.digits(r.over_default.median) : "–"],
  ["visibility", r => Study.ms(r.visibility_ms)],
  ["RMSE", r => Study.rmseText(r)],
  ["95% interval", r => `${Study.digits(r.error.penumbra.rmse_low, 2)}–${Study.digits(r.error.penumbra.rmse_high, 2)}`],
  ["mean", r => Study.digits(r.error.penumbra.mean, 2)],
  ["median", r => Study.digits(r.error.penumbra.median, 2)],
  ["p99", r => Study.digits(r.error.penumbra.p99, 2)],
  ["largest", r => Study.digits(r.error.penumbra.max, 2)],
  ["RMSE, all pixels", r => Study.errorText(Study.errorOf(r, { error: "rmse", area: "all" }))],
  ["FLIP", r => r.error.flip === undefined ? "–" : Study.digits(r.error.flip, 2)],
  ["RMSE by double", r => r.error.double ? Study.digits(r.error.double.penumbra.rmse) : "–"],
  ["wrong certificates", r => r.error.certificates ? `${r.error.certificates.contradicted} of ${r.error.certificates.pixels}` : "–"],
  ["memory, MiB", r => r.peak_mib ? Study.digits(r.peak_mib) : "–"],
];

/** All rows as the table has them. */
Study.csv = () => {
  const quoted = text => `"${String(text).replaceAll('"', '""')}"`;
  const lines = Study.rows.map(row => [row.case, ...COLUMNS.map(([name, of]) => of(row))].map(quoted).join(","));
  return [["case", ...COLUMNS.map(([name]) => name)].map(quoted).join(","), ...lines].join("\n") + "\n";
};

Study.fillRows = (place, rows, onPick) => {
  const sorted = [...rows].sort((a, b) => a.frame_ms.median - b.frame_ms.median);
  const line = row => Study.element("tr", {}, ...COLUMNS.map(([name, of], k) => k > 0 ? Study.element("td", { class: "number" }, of(row))
    : Study.element("th", { scope: "row" }, Study.element("button", { type: "button", onclick: () => onPick(row) }, Study.chip(row.method), of(row)))));
  place.replaceChildren(Study.element("table", {},
    Study.element("thead", {}, Study.element("tr", {}, ...COLUMNS.map(([name], k) => Study.element("th", { scope: "col", class: k > 0 ? "number" : "" }, name)))),
    Study.element("tbody", {}, ...sorted.map(line))));
};
