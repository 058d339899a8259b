// Runs inside the page: uses it as a person would, and writes what is wrong into an element "result".
"use strict";

(async () => {
  const faults = [];
  let checks = 0;
  const check = (fine, what) => { ++checks; if (!fine) faults.push(what); };
  const until = async (condition, what) => {
    for (let k = 0; k < 400 && !condition(); ++k) await new Promise(done => setTimeout(done, 25));
    check(condition(), `waited in vain until ${what}`);
  };
  const get = id => document.getElementById(id);
  const colors = canvas => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(`${data[i]},${data[i + 1]},${data[i + 2]}`);
    return seen;
  };
  const rgb = text => {
    const context = document.createElement("canvas").getContext("2d");
    context.fillStyle = text;
    return [1, 3, 5].map(k => parseInt(context.fillStyle.slice(k, k + 2), 16));
  };
  // Marks beside the front are paler: mixed with the white or dark paper.
  const pale = color => color.map((value, k) => .55 * value + .45 * rgb(getComputedStyle(document.documentElement).getPropertyValue("--panel").trim())[k]);
  const has = (seen, color) => [...seen].some(text => text.split(",").every((value, k) => Math.abs(value - color[k]) <= 8));
  const click = (plot, point) => {
    const box = plot.over.getBoundingClientRect();
    const at = { clientX: box.left + plot.valToPos(point.x, "x"), clientY: box.top + plot.valToPos(point.y, "y"), bubbles: true };
    for (const type of ["mousemove", "mousedown", "mouseup", "click"]) plot.over.dispatchEvent(new MouseEvent(type, at));
  };
  const shownRow = () => get("pictures").dataset.row;
  /** Resolves when what follows is drawn: uPlot draws in the next microtask. */
  const choose = async (id, value) => {
    get(id).value = value;
    get(id).dispatchEvent(new Event("change"));
    await new Promise(done => setTimeout(done, 0));
  };

  try {
    await until(() => document.documentElement.dataset.ready === "yes", "the page is ready");
    check(document.querySelectorAll("#scenes .uplot").length === Study.scenes.length, "one plot a scene");
    const methods = new Set(Study.rows.map(row => row.method));
    const inPlot = colors(get("plot").querySelector("canvas"));
    for (const method of methods) {
      const color = rgb(Study.colorOf(method));
      check(has(inPlot, color) || has(inPlot, pale(color)), `no mark of ${method} in the plot`);
    }
    check(get("short").textContent.includes("fastest"), "nothing in short");
    check(get("short").querySelectorAll("tbody tr").length === [...methods].filter(method => method !== "none").length, "a line a method in short");
    check(get("short").querySelectorAll("td.best").length >= 3, "no time in short is the best");
    check([...get("short").querySelectorAll(".what")].every(cell => cell.textContent.length > 10), "a method is not explained");
    check(get("choice").querySelectorAll("tbody tr").length === Study.scenes.length + 1, "a line a scene in the table");
    check(get("holders").querySelectorAll(".bar-line button").length >= Study.scenes.length, "no method in the bars");
    check(Study.csv().trim().split("\n").length === Study.rows.length + 1, "a line a row in the CSV");
    check(document.documentElement.scrollWidth <= innerWidth, `the page is ${document.documentElement.scrollWidth} wide, the window ${innerWidth}`);

    // A click on each point of a scene shows that row, and its difference has what the numbers say.
    for (const seen of Study.scenes) {
      await choose("scene", seen.id);
      for (const { row } of [...Study.mainPlot.points]) {
        const point = Study.mainPlot.points.find(p => p.row === row);
        const before = shownRow();
        const near = Study.mainPlot.points.filter(p => p !== point && Math.hypot(
          Study.mainPlot.valToPos(p.x, "x") - Study.mainPlot.valToPos(point.x, "x"),
          Study.mainPlot.valToPos(p.y, "y") - Study.mainPlot.valToPos(point.y, "y")) < 3);  // events have whole pixels
        if (near.length > 0 || before === point.row.key) continue;
        click(Study.mainPlot, point);
        await until(() => shownRow() !== before, `a click on ${point.label} shows something`);
        check(shownRow() === point.row.key, `a click on ${point.row.key} shows ${shownRow()}`);
        await new Promise(done => setTimeout(done, 0));
      }
    }
    const canvases = [...get("pictures").querySelectorAll("canvas")];
    check(canvases.length === 3, "three pictures");
    canvases.forEach((canvas, k) => check(colors(canvas).size > 8, `picture ${k} is empty`));

    // The hard shadow is off by more than the silhouette method: its difference has more pixels that are blue or red.
    const colored = async method => {
      await Study.showPicture(Study.rows.find(row => row.method === method && row.varied === ""));
      await choose("scale", "0.02");
      const { data } = canvases[2].getContext("2d").getImageData(0, 0, canvases[2].width, canvases[2].height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += Math.abs(data[i] - data[i + 2]) > 60;
      return count;
    };
    const [hard, silhouette] = [await colored("hard"), await colored("silhouette")];
    check(hard > 50 && hard > 4 * silhouette, `differences of hard and silhouette have ${hard} and ${silhouette} colored pixels`);

    // Of settings beside the front there are small pictures: as large on the page, of fewer pixels.
    const small = Study.rows.find(row => !(row.picture in Study.pictures));
    const wide = canvases[2].width;
    check(small !== undefined, "all pictures are large");
    if (small) {
      await Study.showPicture(small);
      await choose("scale", "0.02");
      canvases.forEach((canvas, k) => check(canvas.width === wide && colors(canvas).size > 8, `small picture ${k} is empty, or ${canvas.width} wide`));
      check(get("picture-text").textContent.includes("every second pixel"), "it is not said that pixels are left out");
    }
    await Study.showPicture(Study.rows.find(row => row.method === "silhouette" && row.varied === ""));

    // Linked zoom, and the probe by keyboard.
    const before = canvases.map(canvas => canvas.toDataURL());
    get("zoom-in").click();
    canvases.forEach((canvas, k) => check(canvas.toDataURL() !== before[k], `picture ${k} does not zoom`));
    canvases[0].dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    check(/sees 0\.\d{4} of the light|sees 1\.0000 of the light|no surface/.test(get("probe").textContent), `the probe says ${get("probe").textContent}`);

    // The light as a pixel sees it: partly hidden where the reference says so.
    const partly = async () => {
      for (let k = 0; k < 60; ++k) {
        canvases[0].dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown", bubbles: true }));
        if (/reference 0\.[2-8]/.test(get("probe").textContent) && colors(get("disk")).size > 1) return true;
      }
      return false;
    };
    check(await partly(), "no pixel below the middle sees a part of the light");
    check(!get("disk-figure").hidden && get("disk-text").textContent.includes("The light as pixel"), "the light is not shown");

    // Keyboard in the plot.
    get("plot").focus();
    get("plot").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown", bubbles: true }));
    check(get("said").textContent.includes("error"), "arrows choose no point");
    get("plot").dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));

    // Controls: other errors, a hidden method, the other budget, the other theme, all scenes.
    for (const value of ["p99", "max", "median", "rmse"]) {
      await choose("error", value);
      check(get("plot").querySelectorAll("canvas").length === 1, `no plot of ${value}`);
    }
    document.querySelector("#legend input").click();
    check(!Study.mainPlot.points.some(p => p.method === Study.methods[0]), "a hidden method is shown");
    document.querySelector("#legend input").click();
    const byError = get("choice").textContent;
    document.querySelector("input[value=time][name=budget]").click();
    check(get("choice").textContent !== byError, "both budgets give one table");
    const theme = document.documentElement.dataset.theme;
    get("theme").click();
    check(document.documentElement.dataset.theme !== theme, "the theme does not change");
    await choose("scene", "");
    check(Study.mainPlot.points.length > 5, "few points over all scenes");
  } catch (error) {
    faults.push(String(error.stack || error));
  }
  const result = document.createElement("pre");
  result.id = "result";
  result.textContent = JSON.stringify({ faults, checks, rows: Study.rows.length });
  document.body.append(result);
})();
