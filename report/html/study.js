// What is here: the sections of a study: best design, convergence, map, trade-offs, parallel coordinates, importance,
// noise against gain, thumbnails, failed candidates. What is not: sweeps (sweep.js), single runs (run.js).
"use strict";

/** Ranks (ties share theirs), for rank correlations. */
Report.ranks = (values) => {
  const order = values.map((value, k) => [value, k]).sort((a, b) => a[0] - b[0]), ranks = new Array(values.length);
  for (let k = 0; k < order.length;) {
    let end = k;
    while (end < order.length && order[end][0] === order[k][0]) ++end;
    for (let m = k; m < end; ++m) ranks[order[m][1]] = (k + end - 1) / 2;
    k = end;
  }
  return ranks;
};
/** Spearman's rank correlation; NaN where one of the lists is constant. */
Report.rankCorrelation = (a, b) => {
  const x = Report.ranks(a), y = Report.ranks(b), mean = (x.length - 1) / 2;
  let xy = 0, xx = 0, yy = 0;
  x.forEach((value, k) => {
    xy += (value - mean) * (y[k] - mean);
    xx += (value - mean) ** 2;
    yy += (y[k] - mean) ** 2;
  });
  return xx > 0 && yy > 0 ? xy / Math.sqrt(xx * yy) : NaN;
};

/** Blue (small) over grey to orange (large). */
Report.ramp = (part) => {
  const stops = [[0, 90, 181], [120, 150, 190], [180, 180, 176], [225, 150, 80], [200, 80, 0]];
  const at = Math.max(0, Math.min(1, part)) * (stops.length - 1), low = Math.min(stops.length - 2, Math.floor(at)), f = at - low;
  return `rgb(${[0, 1, 2].map((c) => Math.round(stops[low][c] + f * (stops[low + 1][c] - stops[low][c]))).join(",")})`;
};

/** Parallel coordinates of candidates in SVG: an axis a column, a line a candidate, coloured by the last column. */
Report.parallel = (columns, rows, best) => {
  const width = 900, height = 320, top = 34, bottom = 26, left = 60, right = 60;
  const svg = Report.svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "Parallel coordinates of the candidates", style: "width:100%;min-width:860px"});
  const ends = columns.map((column, k) => {
    const values = rows.map((row) => row.values[k]).filter((value) => value !== null);
    const low = Math.min(...values), high = Math.max(...values);
    return [low, high > low ? high : low + 1];
  });
  const x = (k) => left + ((width - left - right) * k) / Math.max(1, columns.length - 1);
  const y = (k, value) => height - bottom - ((height - top - bottom) * (value - ends[k][0])) / (ends[k][1] - ends[k][0]);
  const last = columns.length - 1;
  for (const row of rows.slice().sort((a, b) => (a.number === best ? 1 : 0) - (b.number === best ? 1 : 0) || b.values[last] - a.values[last])) {
    if (row.values.some((value) => value === null)) continue;
    const path = row.values.map((value, k) => `${k ? "L" : "M"}${x(k).toFixed(1)} ${y(k, value).toFixed(1)}`).join("");
    const part = (row.values[last] - ends[last][0]) / (ends[last][1] - ends[last][0]);
    const line = Report.svg("path", {d: path, fill: "none", stroke: row.number === best ? Report.colour("ink") : Report.ramp(part), "stroke-width": row.number === best ? 3.5 : 1.6, opacity: row.number === best ? 1 : 0.8});
    line.append(Report.svg("title", {}, `${row.arm} ${row.number}: ` + columns.map((column, k) => `${column.label} ${Report.digits(row.values[k] * column.scale)} ${column.unit}`).join(", ")));
    svg.append(line);
  }
  columns.forEach((column, k) => {
    svg.append(Report.svg("line", {x1: x(k), x2: x(k), y1: top, y2: height - bottom, stroke: Report.colour("soft")}));
    const text = (content, at) => {
      const label = Report.svg("text", {x: x(k), y: at, "text-anchor": k === 0 ? "start" : k === last ? "end" : "middle", fill: Report.colour("ink"), "font-size": 13, dx: k === 0 ? -left + 4 : k === last ? right - 4 : 0});
      label.textContent = content;
      svg.append(label);
    };
    text(column.label.length > 24 ? column.label.slice(0, 22) + "..." : column.label, 13);
    text(`${Report.digits(ends[k][1] * column.scale)} ${column.unit}`, 29);
    text(`${Report.digits(ends[k][0] * column.scale)} ${column.unit}`, height - 8);
  });
  return svg;
};

Report.studySections = (work) => {
  const {el, section, chart} = Report;
  const columns = work.columns, done = work.rows.filter((row) => row.status === "completed");
  const scoreAt = columns.findIndex((column) => column.kind === "score");
  const score = (row) => row.values[scoreAt];
  const scored = done.filter((row) => score(row) !== null);
  const best = scored.find((row) => row.number === work.best_number && row.number > 0) || null;
  const sections = [];

  // Curves of best and start.
  const curves = work.best.concat(work.start);
  if (curves.length) {
    const unit = Report.stressUnit(Report.largest(...curves.map((curve) => curve.stress)));
    const window = work.wish.window, state = {log: false};
    const figure = chart("Best design and start", () => {
      const marks = [];
      if (window[0] !== null && window[1] !== null) marks.push({kind: "x-band", low: 100 * window[0], high: 100 * window[1], colour: Report.colour("band"), label: "plateau window"});
      if (work.wish.target !== null) marks.push(Report.wishBand(work.wish.target - (work.wish.tolerance || 0), work.wish.target + (work.wish.tolerance || 0), window, unit.scale));
      let series = Report.bandSeries(work.best, "best design", Report.series(0), unit.scale).concat(Report.bandSeries(work.start, "start", Report.series(1), unit.scale), Report.measuredSeries(work.measured, unit.scale));
      if (work.wish.curve) series = series.concat({label: "wished", x: Report.percent(work.wish.curve.strain), y: Report.scaled(work.wish.curve.stress, unit.scale), colour: Report.series(2), dash: [7, 4]});
      return {x: {label: "strain (%)", min: 0}, y: {label: `stress (${unit.name})`, log: state.log, ...(state.log ? {} : {min: 0})}, series, marks};
    }, {tall: true, note: "band: range of the replicates", tools: el("div", {class: "tools"}, el("label", {}, el("input", {type: "checkbox", onchange: (event) => { state.log = event.target.checked; figure.redraw(); }}), "logarithmic"))});
    const layouts = [[work.start_layout, "start"], [work.best_layout, "best design"]].filter(([layout]) => layout);
    sections.push(section("What was found", el("div", {class: "pair"}, figure, el("div", {},
      el("div", {class: "thumbnails"}, layouts.map(([layout, name]) => el("figure", {}, Report.layout(layout, name), el("figcaption", {}, name)))),
      Report.table(["", "best", "start"], work.facts, [1, 2])))));
  }

  // Convergence.
  const arms = [...new Set(scored.filter((row) => row.number > 0).map((row) => row.arm))];
  if (scored.length) {
    const steps = [];
    let smallest = Infinity;
    for (const row of scored.filter((one) => one.number > 0).sort((a, b) => a.number - b.number)) {
      smallest = Math.min(smallest, score(row));
      steps.push({x: row.number, y: smallest});
    }
    const start = scored.find((row) => row.number === 0);
    const all = scored.map(score), positive = all.every((value) => value > 0), wide = positive && Math.max(...all) > 30 * Math.min(...all);
    sections.push(section("The search", chart("Score of each candidate (smaller is better)", () => ({
      x: {label: "candidate"}, y: {label: work.score_label, log: wide},
      series: arms.map((arm, k) => ({label: arm, line: false, dots: 4, colour: Report.series(k), points: scored.filter((row) => row.arm === arm && row.number > 0).map((row) => ({x: row.number, y: score(row)}))}))
        .concat([{label: "best so far", points: steps, stepped: true, colour: Report.colour("ink"), width: 1.5, order: 5}]),
      marks: [...(start ? [{kind: "y", at: score(start), dash: [5, 4], label: "start"}] : []), ...(best ? [{kind: "point", x: best.number, y: score(best), label: "best"}] : [])]}))));
  }

  // Two columns against each other, coloured by a third: the map of the variables, and trade-offs between results.
  const usable = columns.map((column, k) => ({...column, at: k})).filter((column) => done.some((row) => row.values[column.at] !== null) && !["replicates", "failed", "violation"].includes(column.name));
  const variables = usable.filter((column) => column.kind === "variable"), results = usable.filter((column) => column.kind === "result");
  const axisText = (column) => column.label + (column.unit ? ` (${column.unit})` : "");
  const wishesOf = (column) => (work.verdict ? work.verdict.wishes : []).filter((wish) => wish.measure === column.name || (wish.measure === "plateau_stress" && column.name === "plateau_mean"));
  const scatter = (caption, x0, y0, c0, front) => {
    const chosen = {x: x0, y: y0, c: c0};
    const select = (what, list) => el("label", {}, {x: "across", y: "upwards", c: "colour"}[what], el("select", {onchange: (event) => {
      chosen[what] = usable.find((column) => column.name === event.target.value);
      figure.redraw();
    }}, list.map((column) => el("option", {value: column.name, selected: column === chosen[what]}, column.label))));
    const figure = chart(caption, () => {
      const rows = done.filter((row) => row.values[chosen.x.at] !== null && row.values[chosen.y.at] !== null);
      const at = (row) => ({x: row.values[chosen.x.at] * chosen.x.scale, y: row.values[chosen.y.at] * chosen.y.scale});
      const shades = rows.map((row) => row.values[chosen.c.at]), low = Math.min(...shades.filter((value) => value !== null)), high = Math.max(...shades.filter((value) => value !== null));
      const colours = shades.map((value) => (value === null ? Report.colour("line") : Report.ramp(high > low ? (value - low) / (high - low) : 0.5)));
      const info = rows.map((row) => `${row.arm} ${row.number}: ${chosen.x.label} ${Report.digits(at(row).x)}, ${chosen.y.label} ${Report.digits(at(row).y)}, ${chosen.c.label} ${Report.digits(row.values[chosen.c.at] === null ? null : row.values[chosen.c.at] * chosen.c.scale)}`);
      const bands = ["x", "y"].flatMap((what) => wishesOf(chosen[what]).map((wish) => {
        const band = {low: wish.low === null ? -1e30 : wish.low * chosen[what].scale, high: wish.high === null ? 1e30 : wish.high * chosen[what].scale, colour: Report.colour("wish"), label: "wished"};
        return {kind: what + "-band", ...band};
      }));
      const marks = bands.concat(best && best.values[chosen.x.at] !== null && best.values[chosen.y.at] !== null ? [{kind: "point", ...at(best), colour: Report.colour("ink"), label: "best"}] : []);
      const series = [{label: "", line: false, dots: 6, points: rows.map(at), colours, info, colour: Report.series(0)}];
      if (front) series.push(...Report.front(rows, chosen, at));
      return {x: {label: axisText(chosen.x), grace: "6%"}, y: {label: axisText(chosen.y), grace: "6%"}, series, marks};
    }, {tools: el("div", {class: "tools"}, select("x", usable), select("y", usable), select("c", usable)), tall: true,
        note: `colour: ${chosen.c.label}, from blue (small) to orange (large)`});
    return figure;
  };
  if (done.length > 1 && variables.length && scoreAt >= 0) {
    const scoreColumn = usable.find((column) => column.kind === "score") || variables[0];
    const plateau = results.find((column) => column.name === "plateau_mean") || results[0] || scoreColumn;
    const other = results.find((column) => column !== plateau && column.name !== "plateau_std") || scoreColumn;
    sections.push(section("Where the candidates lie", el("div", {class: "pair"},
      scatter("Map", variables[0], variables[1] || plateau, scoreColumn, false), scatter("Trade-off", plateau, other, scoreColumn, true))));
    const shown = variables.concat(results.filter((column) => !["plateau_std"].includes(column.name)).slice(0, 4), [scoreColumn]);
    sections.push(section("All at once", el("p", {class: "soft"}, "A line a candidate, coloured by its score from blue (small) to orange (large); thick: the best."),
      el("div", {class: "scroll"}, Report.parallel(shown, scored.map((row) => ({...row, values: shown.map((column) => row.values[column.at])})), best ? best.number : -1))));
  }

  // Importance.
  for (const [arm, shares] of Object.entries((work.model && work.model.importance) || {})) {
    const listed = Object.entries(shares).map(([name, share]) => ({label: (columns.find((column) => column.name === name) || {label: name}).label, ...share})).sort((a, b) => b.total - a.total);
    sections.push(section("What matters", chart(`Share of the variation of the expected score that each variable explains, ${arm}`, () => ({
      bars: true, x: {choices: listed.map((one) => one.label)}, y: {label: "share", min: 0, max: 1},
      series: [{label: "alone (first-order Sobol index)", colour: Report.series(0), y: listed.map((one) => Math.max(0, one.first))},
               {label: "with the others (total index)", colour: Report.series(1), y: listed.map((one) => Math.max(0, one.total))}]}),
      {note: `by the model, over the whole bounds, to about a tenth. ${work.model.trusted === false ? "The model of this study is not to be relied on: a hint at most." : ""}`}), work.model.in_words ? el("p", {class: "soft"}, work.model.in_words) : null));
  }
  if (scored.length >= 6 && variables.length) {
    const rows = scored, list = [usable.find((column) => column.kind === "score"), ...results.filter((column) => !["plateau_std"].includes(column.name)).slice(0, 3)].filter(Boolean);
    sections.push(section("What goes with what", chart("Rank correlation of each variable with the results", () => ({
      bars: true, x: {choices: variables.map((column) => column.label)}, y: {label: "rank correlation", min: -1, max: 1},
      series: list.map((result, k) => ({label: result.label, colour: Report.series(k), y: variables.map((variable) => {
        const both = rows.filter((row) => row.values[variable.at] !== null && row.values[result.at] !== null);
        const value = Report.rankCorrelation(both.map((row) => row.values[variable.at]), both.map((row) => row.values[result.at]));
        return Number.isFinite(value) ? value : 0;
      })}))}), {note: `over ${rows.length} candidates of a search, which are no even sample: a hint, no proof. Values within +-${Report.digits(2 / Math.sqrt(rows.length - 1))} may be chance`})));
  }

  // Noise against gain.
  const finals = work.finals;
  if (finals && finals.best_scores && finals.best_scores.length) {
    const gain = finals.gain, half = finals.gain_confidence_95, pairs = finals.best_scores.length;
    sections.push(section("Noise against gain", el("p", {}, `Best and start on the same ${pairs} fresh seeds: the score ${gain >= 0 ? "falls" : "rises"} by ${Report.digits(Math.abs(gain))}${half === null || half === undefined ? "" : ` +- ${Report.digits(half)} (95 %, paired)`} from start to best. `,
      el("b", {}, finals.significant ? "The gain is beyond chance." : "The difference may be chance.")), finals.start_scores && finals.start_scores.length ? chart("Score on each fresh seed (smaller is better)", () => ({
        x: {label: "fresh seed", min: 0.5, max: pairs + 0.5, places: [...Array(pairs + 1).keys()].map((k) => (k ? String(k) : ""))}, y: {label: "score"},
        series: [{label: "start", line: false, dots: 6, colour: Report.series(1), points: finals.start_scores.map((value, k) => ({x: k + 1, y: value}))},
                 {label: "best", line: false, dots: 6, colour: Report.series(0), points: finals.best_scores.map((value, k) => ({x: k + 1, y: value}))}]})) : null));
  }
  if (work.thumbnails.length)
    sections.push(section("The best candidates", el("div", {class: "thumbnails"}, work.thumbnails.map((one) => el("figure", {}, Report.layout(one.layout, `${one.arm} ${one.number}`), el("figcaption", {}, `${one.number ? "No. " + one.number : "Start"} `, el("span", {class: "soft"}, `${one.arm}, score ${one.score}`)))))));
  if (work.failed.length)
    sections.push(section("Candidates that failed", Report.table(["candidate", "reason"], work.failed.map((one) => [one.what, one.reason]))));
  if (work.rows.length) {
    const heads = ["no.", "arm", "status", ...columns.map(axisText)];
    const csv = () => [["number", "arm", "status", ...columns.map((column) => column.name)], ...work.rows.map((row) => [row.number, row.arm, row.status, ...row.values])].map((line) => line.map(Report.csvField).join(",")).join("\n") + "\n";
    sections.push(section("All candidates", el("p", {}, Report.download("Candidates as CSV", "candidates.csv", csv)), el("details", {open: work.rows.length <= 60},  el("summary", {}, `${work.rows.length} candidates`),
      Report.sortable(heads, work.rows.map((row) => [row.number, row.arm, row.status, ...columns.map((column, k) => ({value: row.values[k], text: Report.digits(row.values[k] === null ? null : row.values[k] * column.scale)}))])))));
  }
  return sections;
};

/** Candidates that no other beats in both columns, where the wishes or the names say which side is better. */
Report.front = (rows, chosen, at) => {
  const better = (column) => (/peak|undulation|cap|distance|std|score/.test(column.name) ? -1 : /length|smallest|energy|densification|efficiency/.test(column.name) ? 1 : 0);
  const sx = better(chosen.x), sy = better(chosen.y);
  if (sx === 0 || sy === 0) return [];
  const points = rows.map(at);
  const front = points.filter((p) => !points.some((q) => sx * (q.x - p.x) >= 0 && sy * (q.y - p.y) >= 0 && (q.x !== p.x || q.y !== p.y))).sort((a, b) => a.x - b.x);
  return front.length > 1 ? [{label: "not beaten in both", points: front, colour: Report.colour("soft"), width: 1.4, dash: [4, 3], order: 4}] : [];
};
