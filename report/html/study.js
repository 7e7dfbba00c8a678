// What is here: the sections of a study: best design, convergence, importance, noise against gain, thumbnails, failed
// candidates. What is not: points and lines of many designs (scatter.js), maps (map.js), sweeps (sweep.js), runs (run.js).
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
      marks.push(...Report.capMarks(work.verdict, unit.scale));
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
  const variables = usable.filter((column) => column.kind === "variable"), results = usable.filter((column) => column.kind === "result" && column.name !== "wishes_not_kept");
  const axisText = Report.axisText;
  const wishes = work.verdict ? work.verdict.wishes : [];
  const members = (work.pareto && work.pareto.designs) || [];
  const scatter = (caption, x, y, colour, front) => Report.scatter(caption, {x, y, colour}, {columns: usable, rows: done, wishes, best, front, pareto: new Set(members.map((one) => one.number))});
  if (done.length > 1 && variables.length && scoreAt >= 0) {
    const scoreColumn = usable.find((column) => column.kind === "score") || variables[0];
    const plateau = results.find((column) => column.name === "plateau_mean") || results[0] || scoreColumn;
    const weighed = (work.pareto && work.pareto.objectives) || [];
    const others = results.filter((column) => column !== plateau && column.name !== "plateau_std");
    const other = others.find((column) => weighed.includes(column.name) && column.name !== "target_distance") || others[0] || scoreColumn;
    sections.push(section("Where the candidates lie", el("div", {class: "pair"},
      scatter("Map", variables[0], variables[1] || plateau, scoreColumn, false), scatter("Trade-off", plateau, other, scoreColumn, true))));
    const shown = variables.concat(results.filter((column) => !["plateau_std"].includes(column.name)).slice(0, 4), [scoreColumn]);
    sections.push(section("All at once", el("p", {class: "soft"}, "A line a candidate, coloured by its score from blue (small) to orange (large); thick: the best."),
      el("div", {class: "scroll"}, Report.parallel(shown, scored.map((row) => ({...row, values: shown.map((column) => row.values[column.at])})), best ? best.number : -1))));
  }

  if (members.length) {
    const objectives = work.pareto.objectives.map((name) => usable.find((column) => column.name === name || (name === "plateau_stress" && column.name === "plateau_mean"))).filter(Boolean);
    const value = (row, column) => ({value: row ? row.values[column.at] : null, text: Report.digits(row && row.values[column.at] !== null ? row.values[column.at] * column.scale : null)});
    sections.push(section("Pareto set", el("p", {class: "soft"}, `Designs that keep as many wishes as any, and that no other beats in all that the score weighs: ${objectives.map((column) => column.label).join(", ")}. One that was not verified is known on the seeds of the search alone, which flatter the best.`),
      el("div", {class: "scroll"}, Report.sortable(["no.", "design", ...objectives.map(axisText), "score", "verified"], members.map((one) => {
        const row = done.find((candidate) => one.number !== null && candidate.number === one.number);
        return [{value: one.number, text: one.number === null ? "map" : String(one.number)}, one.label, ...objectives.map((column) => value(row, column)), {value: one.score.score, text: Report.digits(one.score.score)}, one.verified ? "on fresh seeds" : "no"];
      })))));
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
  if (work.rows.length) sections.push(Report.allDesigns("All candidates", "candidates.csv", columns, work.rows));
  return sections;
};
