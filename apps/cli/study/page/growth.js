// Time against the light's radius, the casters' faces and the picture's size: one plot a scene and a quantity.
"use strict";

Study.SWEEPS = {
  light: { title: "light's radius, times the scene's", of: seen => seen.light_scale },
  faces: { title: "faces of the casters", of: seen => seen.caster_faces },
  size: { title: "pixels", of: seen => seen.width * seen.height },
};

Study.fillGrowth = (place, view) => {
  place.replaceChildren();
  const plots = [];
  for (const [sweep, { title, of }] of Object.entries(Study.SWEEPS)) {
    const cases = Study.cases.filter(seen => seen.sweep === sweep);
    for (const group of new Set(cases.map(seen => seen.group))) {
      const rows = Study.cases.filter(seen => seen.group === group && (seen.sweep === sweep || !seen.sweep))
        .flatMap(seen => seen.rows).filter(row => row.varied === "" && !view.hidden.has(row.method));
      const points = rows.map(row => ({ x: of(row.seen), y: Study.timeOf(row, view), row, label: row.label, method: row.method }));
      const box = Study.element("div", { class: "plot" });
      place.append(Study.element("div", {}, Study.element("h3", {}, `${group}: ${title}`), box));
      plots.push(() => Study.makePlot(box, points, {
        height: 240, xLabel: title, yLabel: "ms", small: true, lines: true,
        tip: p => [Study.element("b", {}, p.label), `${Study.digits(p.x)}: ${Study.ms(p.y)}, RMSE ${Study.rmseText(p.row)}`],
      }));
    }
  }
  document.getElementById("growth-section").hidden = plots.length === 0;
  plots.forEach(make => make());
};
