// What is here: charts (Chart.js) with lines, bands and marks in the page's colours, and the strain that linked charts
// share. What is not: what is drawn (run.js, study.js, sweep.js).
"use strict";

Report.colour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
Report.series = (k) => Report.colour("series-" + (((k % 8) + 8) % 8));

/** The strain (%) under the pointer and that of the frame shown; both null where there is none. */
Report.link = {pointer: null, frame: null, charts: [], pick: null};
/** Calls `act` soon, once however often it is asked for: the block moves at once, charts follow at their own pace. */
Report.soon = (act, wait) => {
  let due = null;
  return () => {
    if (due === null) due = setTimeout(() => {
      due = null;
      act();
    }, wait);
  };
};
Report.link.follow = Report.soon(() => Report.link.charts.forEach((chart) => chart.draw()), 150);
Report.link.point = Report.soon(() => Report.link.charts.forEach((chart) => chart.draw()), 16);
Report.link.show = (changes) => {
  Object.assign(Report.link, changes);
  "pointer" in changes ? Report.link.point() : Report.link.follow();
};

Report.allCharts = [];

/** Marks behind and over the data: {kind: "x", at}, {kind: "y", at, from, to}, {kind: "x-band", low, high},
 *  {kind: "y-band", low, high, from, to}, {kind: "point", x, y}; each with `label`, `colour`, `dash`. */
Report.markPlugin = (marks, linked) => {
  const draw = (chart, behind) => {
    const {ctx, chartArea: area, scales: {x, y}} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(area.left, area.top, area.right - area.left, area.bottom - area.top);
    ctx.clip();
    ctx.font = "12px " + Chart.defaults.font.family;
    const used = [];
    const place = (text, left, top) => {
      const width = ctx.measureText(text).width;
      left = Math.max(area.left + 3, Math.min(left, area.right - width - 3));
      while (used.some((box) => left < box.right + 6 && left + width > box.left - 6 && Math.abs(top - box.top) < 14))
        top += 14;
      used.push({left, right: left + width, top});
      ctx.fillStyle = Report.colour("paper");
      ctx.globalAlpha = 0.75;
      ctx.fillRect(left - 2, top - 1, width + 4, 14);
      ctx.globalAlpha = 1;
      ctx.fillStyle = Report.colour("ink");
      ctx.textBaseline = "top";
      ctx.fillText(text, left, top);
    };
    const clampY = (value) => (Number.isFinite(value) ? y.getPixelForValue(value) : value > 0 ? area.top : area.bottom);
    for (const mark of marks) {
      const band = mark.kind.endsWith("band");
      mark.textAt = null;
      if (band !== behind) {
        if (band) mark.textAt = mark.bandTextAt;
        continue;
      }
      ctx.setLineDash(mark.dash || []);
      ctx.strokeStyle = ctx.fillStyle = mark.colour || Report.colour("soft");
      ctx.lineWidth = 1.5;
      const from = mark.from === undefined || mark.from === null ? area.left : x.getPixelForValue(mark.from);
      const to = mark.to === undefined || mark.to === null ? area.right : x.getPixelForValue(mark.to);
      if (mark.kind === "x-band") {
        const left = x.getPixelForValue(mark.low), right = x.getPixelForValue(mark.high);
        ctx.fillRect(left, area.top, right - left, area.bottom - area.top);
        if (mark.label && right >= area.left && left <= area.right) mark.bandTextAt = [left + 4, area.bottom - 17];
      } else if (mark.kind === "y-band") {
        const top = clampY(mark.high), bottom = clampY(mark.low);
        ctx.fillRect(from, top, to - from, bottom - top);
        if (mark.label && bottom >= area.top && top <= area.bottom) mark.bandTextAt = [to - 4 - ctx.measureText(mark.label).width, top - 16];
      } else {
        ctx.beginPath();
        if (mark.kind === "x") {
          const at = x.getPixelForValue(mark.at);
          ctx.moveTo(at, area.top);
          ctx.lineTo(at, area.bottom);
          if (mark.label) mark.textAt = [at + 4, area.top + 3];
        } else if (mark.kind === "y") {
          const at = y.getPixelForValue(mark.at);
          ctx.moveTo(from, at);
          ctx.lineTo(to, at);
          if (mark.label) mark.textAt = [to - ctx.measureText(mark.label).width - 4, at - 16];
        } else {
          const px = x.getPixelForValue(mark.x), py = y.getPixelForValue(mark.y);
          ctx.arc(px, py, 5, 0, 2 * Math.PI);
          if (mark.label) mark.textAt = [px + 9, py - 4];
        }
        ctx.stroke();
      }
    }
    if (!behind) {
      ctx.setLineDash([]);
      for (const mark of marks) if (mark.textAt) place(mark.label, mark.textAt[0], Math.max(area.top + 2, mark.textAt[1]));
      if (linked)
        for (const [value, colour, width] of [[Report.link.frame, Report.colour("ink"), 2], [Report.link.pointer, Report.colour("soft"), 1]]) {
          if (value === null) continue;
          ctx.strokeStyle = colour;
          ctx.lineWidth = width;
          ctx.beginPath();
          ctx.moveTo(x.getPixelForValue(value), area.top);
          ctx.lineTo(x.getPixelForValue(value), area.bottom);
          ctx.stroke();
        }
    }
    ctx.restore();
  };
  return {
    id: "marks",
    beforeDatasetsDraw: (chart) => draw(chart, true),
    afterDatasetsDraw: (chart) => draw(chart, false),
    afterEvent: (chart, event) => {
      if (!linked) return;
      const {type, x: px} = event.event;
      if (type === "mouseout") Report.link.show({pointer: null});
      if (type === "mousemove") Report.link.show({pointer: chart.scales.x.getValueForPixel(px)});
      if (type === "click" && Report.link.pick) Report.link.pick(chart.scales.x.getValueForPixel(px));
    }
  };
};

Report.axis = (options, colourGrid) => {
  const axis = {
    type: options.log ? "logarithmic" : options.choices ? "category" : "linear",
    title: {display: Boolean(options.label), text: options.label, color: Report.colour("soft")},
    grid: {color: colourGrid, borderColor: Report.colour("line")},
    ticks: {color: Report.colour("soft"), maxTicksLimit: options.log ? 6 : 9, maxRotation: options.choices ? 40 : 0,
            autoSkip: !options.choices},
    stacked: Boolean(options.stacked)
  };
  if (!options.choices) {
    axis.ticks.callback = (value) => (options.places ? options.places[value] ?? "" : Report.digits(value));
    if (options.places) {
      axis.afterBuildTicks = (scale) => { scale.ticks = options.places.map((unused, value) => ({value})).filter((tick) => options.places[tick.value] !== ""); };
      Object.assign(axis.ticks, {autoSkip: false, maxRotation: 40});
    }
    if (options.grace) axis.grace = options.grace;
    if (options.min !== undefined) axis.min = options.min;
    if (options.max !== undefined) axis.max = options.max;
  } else axis.labels = options.choices;
  return axis;
};

/** The series with its points from left to right, and what belongs to each point beside it: Chart.js takes the ends of an axis
 *  from the first and the last point. */
Report.fromLeft = (series) => {
  if (!series.points || series.points.every((point, k) => k === 0 || series.points[k - 1].x <= point.x)) return series;
  const order = series.points.map((point, k) => k).sort((a, b) => series.points[a].x - series.points[b].x);
  const moved = {...series};
  for (const name of ["points", "colours", "rims", "info"])
    if (Array.isArray(series[name])) moved[name] = order.map((k) => series[name][k]);
  return moved;
};

/**
 * A figure with a chart. spec(): {x, y axes ({label, min, max, log, choices, stacked}), series, marks, linked, bars}, asked
 * again whenever the colours change. A series: {label, x, y (lists) or points ([{x, y}]), colour, width, dash, dots
 * (radius), line (false: dots only), fill (index offset to fill to), info (texts of its points)}.
 */
Report.chart = (caption, spec, {tall = false, tools = null, note = ""} = {}) => {
  const canvas = Report.el("canvas", {role: "img", "aria-label": caption});
  const figure = Report.el("figure", {}, Report.el("figcaption", {}, caption, note ? Report.el("span", {class: "soft"}, " " + note) : null),
    tools, Report.el("div", {class: tall ? "plot tall" : "plot"}, canvas));
  let chart = null;
  const pointsOf = (series, log) => {
    if (series.points) return series.points;
    const points = [];
    for (let k = 0; k < series.x.length; ++k)
      if (Number.isFinite(series.y[k]) && (!log || series.y[k] > 0)) points.push({x: series.x[k], y: series.y[k]});
    return points;
  };
  const build = () => {
    const what = spec();
    const grid = Report.colour("grid");
    const datasets = what.series.map(Report.fromLeft).map((series, k) => {
      const colour = series.colour || Report.series(k);
      const line = series.line !== false;
      return {
        label: series.label || "", data: what.bars ? series.y : pointsOf(series, what.y.log), info: series.info,
        borderColor: colour, backgroundColor: series.fillColour || colour, borderWidth: what.bars ? 0 : series.width || 1.8,
        borderDash: series.dash || [], pointRadius: series.dots || (line ? 0 : 3), pointHoverRadius: (series.dots || 3) + 2,
        pointStyle: series.style || "circle", showLine: line, fill: series.fill || false, tension: 0, order: series.order || 0,
        hidden: false, pointBackgroundColor: series.colours || colour, pointBorderColor: series.rims || series.colours || colour,
        stepped: series.stepped || false
      };
    });
    const config = {
      type: what.bars ? "bar" : "scatter",
      data: {labels: what.x.choices, datasets},
      options: {
        animation: false, responsive: true, maintainAspectRatio: false, parsing: what.bars ? undefined : false, normalized: true,
        interaction: {mode: what.bars ? "index" : "nearest", axis: what.linked ? "x" : "xy", intersect: false},
        onClick: what.onPick ? (event, items) => items.length && what.onPick(items[0]) : undefined,
        scales: {x: Report.axis(what.x, grid), y: Report.axis(what.y, grid)},
        plugins: {
          legend: {
            display: datasets.some((one) => one.label), position: "top", align: "start",
            labels: {color: Report.colour("ink"), boxWidth: 22, boxHeight: 2, padding: 8, filter: (item) => item.text !== ""}
          },
          tooltip: {
            callbacks: {
              title: (items) => (what.bars && items.length ? items[0].label : ""),
              label: (item) => {
                if (item.dataset.info) return item.dataset.info[item.dataIndex];
                const value = Report.digits(what.bars ? item.raw : item.parsed.y);
                return `${item.dataset.label || caption}: ${value}` + (what.bars ? "" : ` at ${Report.digits(item.parsed.x)}`);
              }
            }
          }
        }
      },
      plugins: [Report.markPlugin(what.marks || [], Boolean(what.linked))]
    };
    if (what.bars) {
      config.options.scales.x.grid.display = false;
      if (datasets.every((one) => one.label)) config.options.plugins.legend.labels.boxHeight = 10;
    }
    if (chart) {
      Report.link.charts = Report.link.charts.filter((one) => one !== chart);
      chart.destroy();
    }
    chart = new Chart(canvas, config);
    if (what.linked) Report.link.charts.push(chart);
  };
  Report.allCharts.push(build);
  figure.redraw = build;
  // Drawn once it is in the page: Chart.js takes its size from there.
  requestAnimationFrame(build);
  return figure;
};

Report.redrawAll = () => Report.allCharts.forEach((build) => build());
Chart.defaults.font.family = 'system-ui, "DejaVu Sans", sans-serif';
Chart.defaults.font.size = 12;
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => Report.redrawAll());
addEventListener("beforeprint", () => {
  document.documentElement.classList.add("light");
  Report.redrawAll();
});
addEventListener("afterprint", () => {
  document.documentElement.classList.remove("light");
  Report.redrawAll();
});
