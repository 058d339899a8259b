// Controls, and what follows them.
"use strict";

(() => {
  const get = id => document.getElementById(id);
  const OVER_ALL = "";
  const view = { scene: Study.scenes.length > 1 ? OVER_ALL : Study.scenes[0]?.id, time: "frame", error: "rmse", area: "penumbra", hidden: new Set() };
  let chosen = null;

  const timeTitle = () => `milliseconds for ${Study.TIMES[view.time].title}`;
  const errorTitle = () => `${Study.ERRORS[view.error].title}${view.error === "flip" ? "" : `, ${Study.AREAS[view.area]}`}`;
  const tip = point => {
    const { row } = point;
    const where = point.scenes ? `mean of ${point.scenes} scenes` : row.scene;
    const lines = [Study.element("b", {}, Study.chip(point.method), point.label), `${where}: ${Study.ms(point.x)}, `,
      `${Study.ERRORS[view.error].title} ${Study.errorText(point)}`];
    if (point.scenes) lines.push(Study.element("span", { class: "small" }, `worst on ${row.scene}`));
    else lines.push(Study.element("span", { class: "small" },
      `a quarter of the frames below ${Study.digits(row.frame_ms.low)} ms, a quarter above ${Study.digits(row.frame_ms.high)} ms`));
    if (point.method in Study.PEERS) lines.push(Study.element("span", { class: "small" }, Study.PEERS[point.method].short));
    return lines;
  };
  const say = point => { get("said").textContent = `${point.label}: ${Study.ms(point.x)}, error ${Study.errorText(point)}`; };

  const pick = async row => {
    chosen = row;
    await Study.showPicture(row);
    drawMain();
  };
  const pickPoint = point => { pick(point.row); get("picture-section").scrollIntoView({ behavior: "smooth", block: "nearest" }); };

  const rowsInView = () => view.scene === OVER_ALL ? Study.scenes.flatMap(seen => seen.rows) : Study.cases.find(seen => seen.id === view.scene).rows;
  const drawMain = () => {
    const points = view.scene === OVER_ALL ? Study.pointsOverAll(view) : Study.pointsOf(rowsInView(), view);
    get("mean").textContent = view.scene === OVER_ALL ? `Times are means over the ${Study.scenes.length} scenes, errors root mean squares.` : "";
    Study.mainPlot = Study.makePlot(get("plot"), points, {
      height: Math.max(300, Math.min(520, innerHeight * .6)), xLabel: timeTitle(), yLabel: errorTitle(), chosen, onPick: pickPoint, say, tip });
  };
  const drawScenes = () => {
    get("scenes").replaceChildren();
    const range = Study.rangesOf(Study.scenes.flatMap(seen => Study.pointsOf(seen.rows, view)));
    const plots = Study.scenes.map(seen => {
      const box = Study.element("div", { class: "plot" });
      const title = Study.element("button", { type: "button", onclick: () => choose(seen.id) }, seen.scene);
      get("scenes").append(Study.element("div", {}, Study.element("h3", {}, title), box));
      return () => Study.makePlot(box, Study.pointsOf(seen.rows, view), {
        height: 240, xLabel: "ms", yLabel: Study.ERRORS[view.error].title, small: true, range, onPick: pickPoint, tip });
    });
    plots.forEach(make => make());
  };
  const drawTables = () => {
    Study.fillShort(get("short"), view);
    Study.fillChoice(get("choice"), view, document.querySelector("input[name=budget]:checked").value, pickPoint);
    Study.fillHolders(get("holders"), view, pickPoint);
    Study.fillRows(get("rows"), rowsInView(), pick);
  };
  const drawAll = () => {
    drawLegend();
    drawMain();
    drawTables();
    drawScenes();
    Study.fillGrowth(get("growth"), view);
  };
  const choose = id => {
    view.scene = id;
    get("scene").value = id;
    drawMain();
    Study.fillRows(get("rows"), rowsInView(), pick);
    get("plot-title").scrollIntoView({ behavior: "smooth" });
  };

  const drawLegend = () => {
    get("legend").replaceChildren(...Study.methods.map(method => {
      const box = Study.element("input", { type: "checkbox", onchange: event => {
        event.target.checked ? view.hidden.delete(method) : view.hidden.add(method);
        drawAll();
        get("legend").querySelectorAll("input")[Study.methods.indexOf(method)].focus();
      } });
      box.checked = !view.hidden.has(method);
      const mark = Study.element("canvas", { width: 36, height: 36, "aria-hidden": "true" });
      Study.drawMark(mark.getContext("2d"), method, 18, 18, 9);
      return Study.element("label", { title: Study.summaryOf(method) }, box, mark, method);
    }));
  };

  const fillSelect = (id, entries, key) => {
    entries.forEach(([value, title]) => get(id).append(Study.element("option", { value }, title)));
    get(id).value = view[key];
    get(id).addEventListener("change", () => { view[key] = get(id).value; drawAll(); });
  };
  const setTheme = theme => { document.documentElement.dataset.theme = theme; };

  const fillAbout = () => {
    const { machine, threads, version, commit, frames, samples, double_pixels: pixels, resampled } = Study.about;
    const sizes = [...new Set(Study.scenes.map(seen => `${seen.width}×${seen.height}`))];
    const text = `${machine.processor}, ${threads} threads, ${machine.instruction_set}, no graphics card used; penumbra ${version}${commit ? ` (${commit})` : ""}; ` +
      `${Study.rows.length} measurements on ${Study.scenes.length} scenes${sizes.length === 1 ? ` of ${sizes[0]} pixels` : ""}.`;
    get("about").textContent = text;
    const renderers = [...new Set(Study.rows.map(row => row.renderer).filter(Boolean))];
    get("how").replaceChildren(Study.element("ul", {}, ...[
      `Times are medians of ${frames} warm frames, of more where they scatter; settings are run in turn. A whole frame is what the camera sees, visibility and shading.`,
      `Errors are of the fraction of the light that a pixel sees, against two independent references of ${samples} rays a pixel each; their noise is taken out of the RMSE.` +
        (resampled ? " The worst pixels were traced again with 65,536 rays before the 99 of 100 and the largest are stated." : " The 99 of 100 and the largest contain it."),
      `An RMSE after ≤, a hollow mark in the plots, is the upper end of its 95% interval, or what the references can tell from 0 at best: they cannot tell it from 0.`,
      `Where the shadow is soft: pixels at which the references see part of the light.`,
      pixels > 0 ? `At ${pixels} pixels a scene, chosen by chance, rays in double that share nothing with the methods judge as well.` : "",
      `A certificate is a pixel of which a method says that it is wholly lit or wholly dark; 256 rays a pixel contradict the wrong ones.`,
      `Times within ${Study.TIE_PERCENT}% of each other, or whose quartiles beside the default method overlap, count as equal: of these the defaults are named.`,
      `All scenes: the geometric mean of times, and the root mean square of errors.`,
      renderers.length ? `Drawn by: ${renderers.join("; ")}.` : "",
      ...Study.methods.filter(name => !(name in Study.PEERS) && Study.summaryOf(name)).map(name => `${name}: ${Study.summaryOf(name)}.`),
      ...Object.entries(Study.PEERS).filter(([name]) => Study.methods.includes(name)).map(([name, { long }]) => `${name}: ${long}`),
    ].filter(Boolean).map(line => Study.element("li", {}, line))));
  };

  const start = async () => {
    setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    get("theme").addEventListener("click", () => { setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"); drawAll(); });
    fillAbout();
    get("csv").addEventListener("click", () => {
      const link = Study.element("a", { download: "study.csv", href: URL.createObjectURL(new Blob([Study.csv()], { type: "text/csv" })) });
      link.click();
      URL.revokeObjectURL(link.href);
    });
    if (Study.scenes.length === 0) return;
    const scenes = Study.scenes.map(seen => [seen.id, seen.scene]);
    fillSelect("scene", Study.scenes.length > 1 ? [[OVER_ALL, "all scenes"], ...scenes] : scenes, "scene");
    fillSelect("time", Object.entries(Study.TIMES).map(([key, { title }]) => [key, title]), "time");
    const measured = Object.entries(Study.ERRORS).filter(([key]) => key !== "flip" || Study.rows.some(row => row.error.flip !== undefined));
    fillSelect("error", measured.map(([key, { title }]) => [key, title]), "error");
    fillSelect("area", Object.entries(Study.AREAS), "area");
    document.querySelectorAll("input[name=budget]").forEach(input => input.addEventListener("change", drawTables));
    let width = innerWidth;
    addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; drawAll(); } });
    drawAll();
    const points = Study.frontOf(Study.pointsOf(Study.scenes[0].rows, view));
    if (points.length > 0) await pick(points[points.length - 1].row);
    document.documentElement.dataset.ready = "yes";
  };
  start();
})();
