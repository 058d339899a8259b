// "In short", the choice of a method by budget, and all rows as a table.
"use strict";

Study.ERROR_BUDGETS = [0.05, 0.02, 0.01, 0.005, 0.002, 0.001];
Study.TIME_BUDGETS = [5, 10, 20, 50, 100, 300, 1000];

Study.TIE_PERCENT = 20;

/** Whether p is as good as the best, as far as a busy machine can tell: nearly the same, or times whose quartiles beside the default overlap. */
const isTied = (p, best, wanted) => {
  if (p[wanted] <= best[wanted] * (1 + Study.TIE_PERCENT / 100)) return true;
  const [a, b] = [p.row.over_default, best.row.over_default];
  return wanted === "x" && !p.scenes && a && b && a.low <= b.high;
};

/** The fastest of the points within an error, or the most accurate within a time; null where there is none. Of those that are as good, within
 * the ties, the first method with its defaults, if there is one. */
Study.bestOf = (points, kind, budget) => {
  const [limit, wanted] = kind === "error" ? ["y", "x"] : ["x", "y"];
  const within = points.filter(p => p[limit] <= budget);
  if (within.length === 0) return null;
  const best = within.reduce((a, b) => a[wanted] <= b[wanted] ? a : b);
  const rank = p => 1000 * (p.label !== p.method) + Study.methods.indexOf(p.method);
  return within.filter(p => isTied(p, best, wanted)).reduce((a, b) => rank(a) <= rank(b) ? a : b, best);
};

Study.chip = method => Study.element("span", { class: "chip", style: `background: ${Study.colorOf(method)}` });

/** One line: which method to use, and what it costs beside a frame without shadows. */
const verdictOf = (points, view) => {
  const budgets = [0.05, 0.01, 0.001], bests = budgets.map(budget => Study.bestOf(points, "error", budget));
  const line = Study.element("p", {});
  const tightest = bests.findLast(best => best);
  if (!tightest) return line;
  const loosest = budgets[bests.findIndex(best => best && best.label === tightest.label)];
  const kept = budgets[bests.lastIndexOf(tightest)];
  line.append("For an error of ", Study.element("b", {}, loosest > kept ? `${loosest} to ${kept}` : String(kept)), " the fastest is ",
    Study.element("b", {}, tightest.label), `: ${Study.ms(tightest.x)} a frame. `);
  const faster = points.filter(p => p.x < tightest.x / (1 + Study.TIE_PERCENT / 100));
  if (faster.length > 0) line.append(`Whatever is faster is off by ${Study.digits(Math.min(...faster.map(p => p.y)), 2)} or more`);
  const plain = points.find(p => p.label === "none");
  if (faster.length > 0) line.append(plain ? `; a frame without any shadow takes ${Study.ms(plain.x)}. ` : ". ");
  const won = Study.scenes.filter(seen => Study.bestOf(Study.pointsOf(seen.rows, view), "error", kept)?.method === tightest.method).length;
  if (Study.scenes.length > 1) line.append(`${tightest.method} is the fastest within ${kept} on ${won} of ${Study.scenes.length} scenes.`);
  return line;
};

/** The fastest of the points within an error, ties or not; Infinity where there is none. */
const timeFor = (points, budget) => points.filter(p => p.y <= budget).reduce((least, p) => Math.min(least, p.x), Infinity);

/** What each method costs for some errors, over all scenes, and the least error that it reached. */
Study.fillShort = (place, view) => {
  const points = Study.scenes.length > 1 ? Study.pointsOverAll(view) : Study.pointsOf(Study.scenes[0]?.rows || [], view);
  const budgets = [0.05, 0.01, 0.001];
  const bests = budgets.map(budget => timeFor(points, budget));
  const lines = Study.methods.filter(method => method !== "none" && !view.hidden.has(method)).map(method => {
    const own = points.filter(p => p.method === method);
    return { method, least: own.length ? own.reduce((a, b) => a.y <= b.y ? a : b) : null, times: budgets.map(budget => timeFor(own, budget)) };
  });
  const order = (a, b) => b.times.filter(isFinite).length - a.times.filter(isFinite).length || a.times.reduce((d, t, k) => d || (isFinite(t) ? t - b.times[k] : 0), 0);
  const cell = (time, k) => Study.element("td", { class: `number${time <= bests[k] * (1 + Study.TIE_PERCENT / 100) ? " best" : ""}` },
    isFinite(time) ? Study.ms(time) : "–");
  const leastOf = least => least ? `${Study.errorText(least)} in ${Study.ms(least.x)}` : "not on every scene";
  const rows = lines.sort(order).map(({ method, times, least }) => Study.element("tr", {},
    Study.element("th", { scope: "row" }, Study.chip(method), method), ...times.map(cell), Study.element("td", {}, leastOf(least)),
    Study.element("td", { class: "what" }, Study.summaryOf(method))));
  const head = ["time for an error of", ...budgets.map(String), "the least error", "how"];
  place.replaceChildren(verdictOf(points, view), Study.element("div", { class: "scroll" }, Study.element("table", {},
    Study.element("thead", {}, Study.element("tr", {}, ...head.map((text, k) => Study.element("th", { scope: "col", class: k > 0 && k < 4 ? "number" : "" }, text)))),
    Study.element("tbody", {}, ...rows))));
};

/** A cell for each run of budgets that have the same choice. */
const runsOf = choices => choices.reduce((runs, choice) => {
  const last = runs.at(-1);
  last && last.choice?.label === choice?.label ? ++last.length : runs.push({ choice, length: 1 });
  return runs;
}, []);

Study.fillChoice = (place, view, kind, onPick) => {
  const budgets = kind === "error" ? Study.ERROR_BUDGETS : Study.TIME_BUDGETS;
  const head = Study.element("tr", {}, Study.element("th", {}, kind === "error" ? "error at most" : "time at most"),
    ...budgets.map(b => Study.element("th", { scope: "col" }, kind === "error" ? String(b) : Study.ms(b))));
  const cell = ({ choice: point, length }) => {
    if (!point) return Study.element("td", { colspan: length }, "–");
    const result = kind === "error" ? Study.ms(point.x) : Study.errorText(point);
    return Study.element("td", { colspan: length }, Study.element("button", { type: "button", onclick: () => onPick(point) },
      Study.chip(point.method), point.method, Study.element("span", { class: "small" }, `${result}, ${Study.settingOf(point.label)}`)));
  };
  const row = (name, points) => Study.element("tr", {}, Study.element("th", { scope: "row" }, name),
    ...runsOf(budgets.map(b => Study.bestOf(points, kind, b))).map(cell));
  const body = Study.scenes.map(seen => row(seen.scene, Study.pointsOf(seen.rows, view)));
  if (Study.scenes.length > 1) body.unshift(row("all scenes", Study.pointsOverAll(view)));
  place.replaceChildren(Study.element("table", {}, Study.element("thead", {}, head), Study.element("tbody", {}, ...body)));
};

/** For each scene a line from 5 ms to 1 s: which method is the most accurate within the time. */
Study.fillHolders = (place, view, onPick) => {
  const [from, to] = [5, 1000], at = ms => 100 * Math.log(ms / from) / Math.log(to / from);
  const line = points => {
    const front = Study.frontOf(points), bar = Study.element("div", { class: "bar-line" });
    const starts = front.filter((point, k) => k === 0 || point.method !== front[k - 1].method);
    starts.forEach((point, k) => {
      const left = Math.max(0, at(point.x)), right = Math.min(100, k + 1 < starts.length ? at(starts[k + 1].x) : 100);
      if (right <= left) return;
      const last = front.filter(p => p.method === point.method && (k + 1 === starts.length || p.x < starts[k + 1].x)).at(-1);
      const error = point === last ? Study.errorText(point) : `${Study.errorText(point)} to ${Study.errorText(last)}`;
      bar.append(Study.element("button", { type: "button", style: `left: ${left}%; width: ${right - left}%; background: ${Study.colorOf(point.method)}`,
        title: `${point.method}: from ${Study.ms(point.x)}, error ${error}`, onclick: () => onPick(last) }, right - left > 9 ? `${point.method} ${error}` : ""));
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
