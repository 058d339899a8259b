// Plots of time against error: axes and zoom by uPlot; points, front, hover and keyboard here.
"use strict";

/**
 * Draws the mark of a method around (x, y), `r` pixels. Methods differ in shape as well as in color; what people use instead has strokes
 * in place of a filled shape.
 */
Study.drawMark = (ctx, method, x, y, r, { filled = true, pale = false } = {}) => {
  const star = (strokes, start) => {
    for (let k = 0; k < strokes; ++k) {
      const a = start + Math.PI * k / strokes, u = 1.2 * r * Math.cos(a), v = 1.2 * r * Math.sin(a);
      ctx.moveTo(x - u, y - v);
      ctx.lineTo(x + u, y + v);
    }
  };
  const stars = [() => star(2, Math.PI / 4), () => star(2, 0), () => star(3, Math.PI / 2), () => star(4, 0)];
  const shapes = [
    () => ctx.arc(x, y, r, 0, 2 * Math.PI),
    () => ctx.rect(x - r * .85, y - r * .85, 1.7 * r, 1.7 * r),
    () => polygon(4, 0), () => polygon(3, -Math.PI / 2), () => polygon(3, Math.PI / 2),
    () => polygon(6, 0), () => polygon(5, -Math.PI / 2), () => polygon(4, Math.PI / 4),
  ];
  const polygon = (sides, start) => {
    for (let k = 0; k < sides; ++k) {
      const a = start + 2 * Math.PI * k / sides;
      ctx.lineTo(x + 1.25 * r * Math.cos(a), y + 1.25 * r * Math.sin(a));
    }
    ctx.closePath();
  };
  const peer = Object.keys(Study.PEERS).indexOf(method);
  const ours = Study.methods.filter(name => !(name in Study.PEERS));
  ctx.beginPath();
  peer >= 0 ? stars[peer % stars.length]() : shapes[ours.indexOf(method) % shapes.length]();
  ctx.lineWidth = Math.max(1, peer >= 0 ? r / 1.8 : r / 4);
  ctx.strokeStyle = ctx.fillStyle = Study.faded(Study.colorOf(method), pale ? .55 : 1);
  if (filled && peer < 0) ctx.fill();
  ctx.stroke();
};

/** 1, 2 and 5 times powers of 10 between the ends; where there is no room for these, the powers alone. */
const ticksBetween = (low, high, pixels) => {
  const digits = Math.log10(high / low) * 3 > pixels / 36 ? [1] : [1, 2, 5], out = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
    for (const digit of digits) {
      const tick = Number((digit * 10 ** power).toPrecision(3));
      if (tick >= low && tick <= high) out.push(tick);
    }
  return out;
};

/** Ends of logarithmic axes around points. */
Study.rangesOf = points => {
  const around = values => [Math.min(...values) / 1.25, Math.max(...values) * 1.25];
  return { x: around(points.map(p => p.x)), y: around(points.map(p => p.y)) };
};

/**
 * A plot in `place`. `points`: {x, y, label, method, below, row}. `settings`: {height, xLabel, yLabel, chosen, onPick(point),
 * say(point), tip(point), lines, range}. With `lines` the points of a method are joined instead of the front. `range`: of other axes
 * than just around the points, {x: [low, high], y: [low, high]}.
 */
Study.makePlot = (place, points, settings) => {
  place.replaceChildren();
  if (points.length === 0) {
    place.append("Nothing to show: choose another method or scene.");
    return null;
  }
  points = [...points].sort((a, b) => a.x - b.x);
  const front = settings.lines ? [] : Study.frontOf(points);
  const style = getComputedStyle(document.documentElement);
  const ink = style.getPropertyValue("--soft").trim(), grid = style.getPropertyValue("--line").trim();
  const axis = (label, size) => ({
    label, size, stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid }, labelSize: 22, font: "12px system-ui",
    labelFont: "13px system-ui",
    splits: (u, index, low, high) => ticksBetween(low, high, index === 0 ? u.bbox.width / devicePixelRatio : 1.6 * u.bbox.height / devicePixelRatio),
    filter: (u, splits) => splits, values: (u, splits) => splits.map(Study.short),
  });
  let active = -1;

  const drawLine = (u, line, color, width) => {
    const { ctx } = u;
    ctx.beginPath();
    line.forEach((p, k) => {
      const x = u.valToPos(p.x, "x", true), y = u.valToPos(p.y, "y", true);
      if (k > 0 && !settings.lines) ctx.lineTo(x, u.valToPos(line[k - 1].y, "y", true));
      ctx.lineTo(x, y);
    });
    ctx.lineWidth = width;
    ctx.strokeStyle = color;
    ctx.stroke();
  };
  const draw = u => {
    const { ctx } = u, ratio = devicePixelRatio || 1;
    ctx.save();
    ctx.beginPath();
    ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    ctx.clip();
    if (settings.lines)
      for (const method of new Set(points.map(p => p.method)))
        drawLine(u, points.filter(p => p.method === method), Study.colorOf(method), 1.5 * ratio);
    else drawLine(u, front, style.getPropertyValue("--ink").trim(), 2 * ratio);
    // What is beaten first, so that it hides nothing of the front.
    const isOfFront = p => settings.lines || front.includes(p);
    const order = [...points.keys()].sort((a, b) => isOfFront(points[a]) - isOfFront(points[b]));
    order.forEach(k => {
      const p = points[k];
      const chosen = k === active || (settings.chosen && p.row === settings.chosen && p.label === settings.chosen.label);
      const r = (settings.small ? 3 : 4.5) * ratio * (chosen ? 1.7 : 1);
      const pale = !(isOfFront(p) || chosen);
      Study.drawMark(ctx, p.method, u.valToPos(p.x, "x", true), u.valToPos(p.y, "y", true), r, { filled: !p.below, pale });
    });
    ctx.restore();
  };

  const range = settings.range || Study.rangesOf(points);
  const u = new uPlot({
    width: place.clientWidth || 320, height: settings.height, legend: { show: false },
    cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: true, uni: 20 } },
    scales: {
      x: { time: false, distr: 3, range: (self, low, high) => low === null || !self.zoomed ? range.x : [low, high] },
      y: { distr: 3, range: (self, low, high) => low === null || !self.zoomed ? range.y : [low, high] },
    },
    axes: [axis(settings.xLabel, 44), axis(settings.yLabel, 62)],
    series: [{}, { paths: () => null, points: { show: false } }],
    hooks: { draw: [draw], setSelect: [self => { self.zoomed = true; }] },
  }, [points.map(p => p.x), points.map(p => p.y)], place);
  u.over.addEventListener("dblclick", () => { u.zoomed = false; u.redraw(true, true); });

  const tip = document.getElementById("tip");
  const show = k => {
    active = k;
    u.redraw(false, false);
    tip.hidden = k < 0;
    if (k < 0) return;
    tip.replaceChildren(...settings.tip(points[k]));
    const box = u.over.getBoundingClientRect();
    const x = box.left + scrollX + u.valToPos(points[k].x, "x"), y = box.top + scrollY + u.valToPos(points[k].y, "y");
    tip.style.left = `${Math.max(4, Math.min(x + 14, scrollX + document.documentElement.clientWidth - tip.offsetWidth - 8))}px`;
    tip.style.top = `${y + 14}px`;
  };
  const nearest = event => {
    const box = u.over.getBoundingClientRect();
    const distance = p => Math.hypot(u.valToPos(p.x, "x") - event.clientX + box.left, u.valToPos(p.y, "y") - event.clientY + box.top);
    let best = -1;
    points.forEach((p, k) => { if (distance(p) < (best < 0 ? 26 : distance(points[best]))) best = k; });
    return best;
  };
  let pressed = null;
  u.over.addEventListener("mousemove", event => { const k = nearest(event); if (k !== active) show(k); });
  u.over.addEventListener("mouseleave", () => show(-1));
  u.over.addEventListener("mousedown", event => { pressed = [event.clientX, event.clientY]; });
  u.over.addEventListener("click", event => {
    if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const k = nearest(event);
    if (k >= 0 && settings.onPick) settings.onPick(points[k]);
  });
  u.points = points;
  if (!settings.onPick || settings.small) return u;

  place.tabIndex = 0;
  place.setAttribute("role", "application");
  place.setAttribute("aria-label", `${settings.xLabel} against ${settings.yLabel}; arrows choose a point, Enter shows its picture`);
  place.onkeydown = event => {
    const next = (list, by) => list[Math.min(list.length - 1, Math.max(0, list.indexOf(points[active]) + by))];
    const steps = { ArrowRight: [points, 1], ArrowLeft: [points, -1], ArrowDown: [front, 1], ArrowUp: [front, -1] };
    if (event.key === "Enter" && active >= 0) settings.onPick(points[active]);
    else if (event.key === "Escape") show(-1);
    else if (steps[event.key]) {
      show(points.indexOf(next(...steps[event.key])));
      settings.say(points[active]);
    } else return;
    event.preventDefault();
  };
  place.onblur = () => show(-1);
  return u;
};
