// What is here: the sections of sweeps, ensembles and calibrations. What is not: studies (study.js), single runs (run.js).
"use strict";

/** Values of a curve (strain in %) at given strains, by linear interpolation; NaN beyond its ends. */
Report.valuesAt = (strains, curve) => {
  const x = curve.strain, y = curve.stress;
  let k = 0;
  return strains.map((at) => {
    const strain = at / 100;
    while (k + 1 < x.length && x[k + 1] < strain) ++k;
    if (x.length === 0 || strain < x[0] || strain > x[x.length - 1] + 1e-9) return NaN;
    if (k + 1 >= x.length) return y[x.length - 1];
    const part = x[k + 1] > x[k] ? (strain - x[k]) / (x[k + 1] - x[k]) : 0;
    return y[k] + part * (y[k + 1] - y[k]);
  });
};

/** Mean, smallest and largest of curves at 240 strains: {strain, mean, low, high}. */
Report.bandOf = (curves) => {
  const known = curves.filter((curve) => curve.strain.length > 1);
  if (known.length === 0) return null;
  const end = Math.min(...known.map((curve) => 100 * curve.strain[curve.strain.length - 1]));
  const strain = Array.from({length: 241}, (unused, k) => (end * k) / 240);
  const values = known.map((curve) => Report.valuesAt(strain, curve));
  const over = (pick) => strain.map((unused, k) => pick(values.map((list) => list[k]).filter(Number.isFinite)));
  return {strain, mean: over((list) => list.reduce((sum, value) => sum + value, 0) / list.length), low: over((list) => Math.min(...list)), high: over((list) => Math.max(...list))};
};

/** Series of curves of one case: a band of its replicates, and their mean. */
Report.bandSeries = (curves, label, colour, scale, bands = true) => {
  const band = Report.bandOf(curves);
  if (!band) return [];
  const series = [{label, x: band.strain, y: Report.scaled(band.mean, scale), colour, width: 2.2}];
  if (bands && curves.length > 1) {
    const faint = Report.faint(colour);
    series.push({label: "", x: band.strain, y: Report.scaled(band.low, scale), colour: faint, width: 0.6, order: 1},
                {label: "", x: band.strain, y: Report.scaled(band.high, scale), colour: faint, width: 0.6, fill: "-1", fillColour: faint, order: 1});
  }
  return series;
};

/** A colour of the form #rrggbb, mostly transparent. */
Report.faint = (colour) => (/^#[0-9a-f]{6}$/i.test(colour) ? colour + "33" : colour);

Report.sweepSections = (work, ensemble) => {
  const {el, section, chart} = Report;
  const all = work.groups.flatMap((group) => group.points).concat(work.base).flatMap((point) => point.curves);
  const unit = Report.stressUnit(Report.largest(...all.map((curve) => curve.stress)));
  const state = {log: !ensemble};  // a sweep compares curves of different heights
  const redraws = [];
  const windowMarks = () => (work.window.length === 2 && work.window[0] !== null ? [{kind: "x-band", low: 100 * work.window[0], high: 100 * work.window[1], colour: Report.colour("band"), label: "plateau window"}] : []);
  const wishes = () => (work.verdict ? work.verdict.wishes.filter((wish) => wish.measure === "plateau_stress").map((wish) => Report.wishBand(wish.low, wish.high, work.window, unit.scale)).concat(Report.capMarks(work.verdict, unit.scale)) : []);
  const curveFigure = (caption, series, bands = true) => {
    const figure = chart(caption, () => ({
      x: {label: "strain (%)", min: 0}, y: {label: `stress (${unit.name})`, log: state.log, ...(state.log ? {} : {min: 0})},
      series: series().concat(Report.measuredSeries(work.measured, unit.scale)), marks: windowMarks().concat(wishes())}), {tall: true, note: ensemble ? "" : bands ? "means of the replicates; band: their range" : "means of the replicates"});
    redraws.push(figure.redraw);
    return figure;
  };
  const logarithmic = el("div", {class: "tools"}, el("label", {}, el("input", {type: "checkbox", checked: state.log, onchange: (event) => {
    state.log = event.target.checked;
    redraws.forEach((redraw) => redraw());
  }}), "logarithmic stress"));

  const dots = (group, measure, k) => chart(measure.label, () => {
    const series = [];
    group.series.forEach((name, s) => {
      const points = group.points.filter((point) => point.series === s), colour = Report.series(s), shift = group.series.length > 1 ? 0.16 * (s - (group.series.length - 1) / 2) : 0;
      const own = points.flatMap((point) => point.values[k].replicates.filter((value) => value !== null).map((value) => ({x: point.place + shift, y: value * measure.scale})));
      series.push({label: "", points: own, line: false, dots: 2, colour: Report.faint(colour).replace("33", "99"), order: 2});
      points.forEach((point) => {
        const value = point.values[k];
        if (value.mean === null || value.half === null) return;
        series.push({label: "", points: [{x: point.place + shift, y: (value.mean - value.half) * measure.scale}, {x: point.place + shift, y: (value.mean + value.half) * measure.scale}], colour, width: 2});
      });
      series.push({label: name, points: points.filter((point) => point.values[k].mean !== null).map((point) => ({x: point.place + shift, y: point.values[k].mean * measure.scale})), line: false, dots: 5, colour,
                   info: points.filter((point) => point.values[k].mean !== null).map((point) => `${group.places[point.place]}: ${Report.digits(point.values[k].mean * measure.scale)} ${measure.unit}` + (point.values[k].half === null ? "" : ` +- ${Report.digits(point.values[k].half * measure.scale)} (95 %)`))});
    });
    const base = work.base.length && work.base[0].values[k].mean !== null ? [{kind: "y", at: work.base[0].values[k].mean * measure.scale, dash: [5, 4], label: "the design itself"}] : [];
    return {x: {label: group.label, min: -0.5, max: group.places.length - 0.5, places: group.places}, y: {label: measure.unit}, series, marks: base};
  });

  const sections = [];
  if (ensemble) {
    const group = work.groups[0];
    sections.push(section("Curves of all replicates", logarithmic, curveFigure("Stress over strain", () => {
      const list = Report.bandSeries(group.points[0].curves, "mean; band: range of the replicates", Report.series(0), unit.scale);
      group.points[0].curves.forEach((curve) => list.push({label: "", x: Report.percent(curve.strain), y: Report.scaled(curve.stress, unit.scale), colour: Report.faint(Report.series(0)).replace("33", "70"), width: 0.8, order: 3}));
      return list;
    })));
    sections.push(section("Replicates", Report.table(["result", "mean +- half of its 95 % interval", "replicates"], work.measures.map((measure, k) => {
      const value = group.points[0].values[k], text = (number) => Report.digits(number === null ? null : number * measure.scale);
      return [measure.label, `${text(value.mean)}${value.half === null ? "" : " +- " + text(value.half)} ${measure.unit}`, value.replicates.map(text).join(", ")];
    }))));
  } else {
    sections.push(logarithmic);
    for (const group of work.groups)
      sections.push(section(group.label || "Cases", curveFigure("Curves", () => {
        const series = work.base.length ? Report.bandSeries(work.base[0].curves, "the design itself", Report.colour("soft"), unit.scale) : [];
        return series.concat(group.points.flatMap((point, k) => Report.bandSeries(point.curves, [group.places[point.place], group.series[point.series]].filter(Boolean).join(", "), Report.series(k), unit.scale, group.points.length <= 6)));
      }, group.points.length <= 6), el("div", {class: "grid"}, work.measures.map((measure, k) => dots(group, measure, k)))));
    sections.push(section("All cases", el("p", {class: "soft"}, "Means and half of their 95 % intervals. A click on a head sorts."),
      Report.sortable(["case", "completed", ...work.measures.map((measure) => measure.label)], work.cases.map((one) => [one.label, {text: one.can_run ? String(one.completed) : "cannot be laid out", value: one.completed}, ...one.results]))));
  }
  return sections;
};

Report.calibrationSections = (work) => {
  const delays = [...new Set(work.points.filter((point) => point.chart).map((point) => point.delay))].sort((a, b) => a - b);
  const figure = Report.chart("What the law can reach", () => ({
    x: {label: "delta_t0 / delta_n0"}, y: {label: "compressive over tensile strength"},
    series: delays.map((delay) => ({label: `zeta_max ${Report.digits(delay)}`, points: work.points.filter((point) => point.chart && point.delay === delay && point.ratio !== null).map((point) => ({x: point.shear, y: point.ratio})).sort((a, b) => a.x - b.x), dots: 3}))
      .concat([{label: "tested on the way", line: false, dots: 3, style: "rectRot", colour: Report.colour("soft"), points: work.points.filter((point) => !point.chart && point.ratio !== null).map((point) => ({x: point.shear, y: point.ratio}))}]),
    marks: [...(work.wanted === null ? [] : [{kind: "y", at: work.wanted, dash: [6, 4], label: "wanted"}]), ...(work.found === null ? [] : [{kind: "x", at: work.found, dash: [3, 3], label: "found"}])]}), {tall: true});
  return [Report.section("Reachable ratios of strength", work.points.length ? figure : Report.el("p", {}, "No point is tested yet."))];
};
