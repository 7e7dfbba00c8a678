// What is here: the sections of one run: curve with its marks beside the block, linked charts, fragments, cracks,
// validity, numbers, configuration. What is not: the block (viewer.js), folders of work (study.js, sweep.js).
"use strict";

Report.percent = (list) => Array.from(list, (value) => 100 * value);
Report.scaled = (list, scale) => Array.from(list, (value) => scale * value);

/** Mean over `width` (in x) around each sample, narrower towards both ends and the first peak `sharp`: that is no noise. */
Report.smoothed = (x, y, width, sharp) => {
  const sums = new Float64Array(x.length + 1), last = x.length - 1;
  for (let k = 0; k <= last; ++k) sums[k + 1] = sums[k] + y[k];
  let from = 0, to = 0;
  return Array.from(x, (at) => {
    const half = Math.min(width / 2, at - x[0], x[last] - at, sharp === null ? Infinity : Math.abs(at - sharp)) + 1e-9;
    while (from > 0 && x[from - 1] >= at - half) --from;
    while (x[from] < at - half) ++from;
    while (to > 0 && x[to - 1] > at + half) --to;
    while (to <= last && x[to] <= at + half) ++to;
    return (sums[to] - sums[from]) / (to - from);
  });
};

/** Marks of a wished plateau: {low, high} in Pa over a window in %. */
Report.wishBand = (low, high, window, scale) => ({
  kind: "y-band", low: low === null ? -Infinity : low * scale, high: high === null ? Infinity : high * scale, from: window && Number.isFinite(window[0]) ? 100 * window[0] : null,
  to: window && Number.isFinite(window[1]) ? 100 * window[1] : null, colour: Report.colour("wish"), label: "wished"});

/** Lines of largest wished stresses. */
Report.capMarks = (verdict, scale) => (verdict && verdict.caps ? verdict.caps : []).map((cap) => ({
  kind: "y", at: cap.stress * scale, from: 0, to: cap.until === null ? null : 100 * cap.until, dash: [5, 4], colour: Report.series(2), label: cap.text}));

Report.measuredSeries = (curves, scale) => curves.map((curve, k) => ({
  label: curve.name || "measured", x: Report.percent(curve.strain), y: Report.scaled(curve.stress, scale), colour: Report.series(6 - k), dash: [6, 3], width: 1.6}));

Report.runSections = async (run, name) => {
  const {el, section, chart, percent, scaled} = Report;
  const columns = {}, history = run.history;
  (await Report.data.floats("history", history.rows)).forEach((values, k) => { columns[history.columns[k].name] = values; });
  const strain = percent(columns.strain_yy || []), stress = columns.stress_yy || [];
  const limits = {min: 0, max: strain.length ? Math.max(...strain) : 1};
  const unit = Report.stressUnit(Report.largest(stress));
  const state = {log: false, smooth: true, frame: 0};
  const marks = () => {
    const list = [], m = run.marks;
    if (m.window && 100 * m.window[0] < limits.max) list.push({kind: "x-band", low: 100 * m.window[0], high: 100 * m.window[1], colour: Report.colour("band"), label: "plateau window"});
    for (const wish of run.verdict ? run.verdict.wishes : [])
      if (wish.measure === "plateau_stress") list.push(Report.wishBand(wish.low, wish.high, m.window, unit.scale));
    list.push(...Report.capMarks(run.verdict, unit.scale));
    if (m.plateau_stress !== null && m.window)
      list.push({kind: "y", at: m.plateau_stress * unit.scale, from: 100 * m.window[0], to: 100 * m.window[1], colour: Report.series(1), label: `plateau ${Report.digits(m.plateau_stress * unit.scale)} ${unit.name}`});
    if (m.found_plateau_start !== null && m.found_plateau_stress !== null)
      list.push({kind: "y", at: m.found_plateau_stress * unit.scale, from: 100 * m.found_plateau_start, to: 100 * m.found_plateau_end, colour: Report.series(2), dash: [2, 3], label: "found plateau"});
    if (m.first_peak_strain !== null)
      list.push({kind: "point", x: 100 * m.first_peak_strain, y: m.first_peak_stress * unit.scale, colour: Report.series(1), label: `first peak ${Report.digits(m.first_peak_stress * unit.scale)} ${unit.name}`});
    const dense = m.densification_strain ?? m.densification_onset;
    if (dense !== null && 100 * dense < 0.999 * limits.max)
      list.push({kind: "x", at: 100 * dense, dash: [6, 4], label: "densification"});
    return list;
  };
  const curve = chart("Stress over strain", () => {
    const smooth = state.smooth ? Report.smoothed(strain, stress, 1, run.marks.first_peak_strain === null ? null : 100 * run.marks.first_peak_strain) : stress;
    const series = [{label: "stress as computed", x: strain, y: scaled(stress, unit.scale), colour: Report.series(0), width: state.smooth ? 0.9 : 1.8, fillColour: Report.colour("band")}];
    if (state.smooth) series.push({label: "mean over 1 % strain", x: strain, y: scaled(smooth, unit.scale), colour: Report.series(0), width: 2.4});
    return {
      x: {label: "strain (%)", ...limits}, y: {label: `stress (${unit.name})`, log: state.log, ...(state.log ? {} : {min: 0})},
      series: series.concat(Report.measuredSeries(run.measured, unit.scale)), marks: marks(), linked: true};
  }, {tall: true, tools: el("div", {class: "tools"},
    el("label", {}, el("input", {type: "checkbox", onchange: (event) => { state.log = event.target.checked; curve.redraw(); }}), "logarithmic"),
    el("label", {}, el("input", {type: "checkbox", checked: true, onchange: (event) => { state.smooth = event.target.checked; curve.redraw(); }}), "mean over 1 % strain"),
    el("span", {class: "soft"}, "click: the frame at that strain"))});

  const frames = run.frames;
  const sizes = frames ? chart("Fragment sizes", () => {
    const info = frames.list[state.frame];
    return {bars: true, x: {label: "diameter of a disc of the fragment's area", choices: frames.size_classes}, y: {label: "share of the solid (%)", min: 0, max: 100},
            series: [{label: "", y: percent(info.fragments.fraction), colour: Report.series(0), info: info.fragments.count.map((count, k) => `${Report.digits(100 * info.fragments.fraction[k])} % in ${count} fragment${count === 1 ? "" : "s"}`)}]};
  }, {note: "in the frame shown"}) : null;
  const followSizes = Report.soon(() => sizes.redraw(), 250);
  const block = await Report.readBlock(frames);
  const viewer = block ? Report.viewer(block, {onFrame: (frame) => { state.frame = frame; followSizes(); }}) : null;

  const linked = (caption, parts, options = {}) => {
    const known = parts.filter(([column]) => columns[column] && Report.largest(columns[column]) > 0);
    if (known.length === 0) return null;
    const scale = options.stress ? unit.scale : options.scale || 1;
    return chart(caption, () => ({
      x: {label: "strain (%)", ...limits}, y: {label: options.label || "", min: options.free ? undefined : 0}, linked: true,
      series: known.map(([column, label], k) => ({label: known.length > 1 ? label : "", x: strain, y: scaled(columns[column], scale), colour: Report.series(k)}))}));
  };
  if (columns.broken_bonds && columns.broken_in_tension) columns.broken_in_shear = columns.broken_bonds.map((all, k) => all - columns.broken_in_tension[k]);
  // Energies per area of the block: J per metre of depth over m2 of the block is J/m3.
  const area = frames ? frames.width * frames.height : null;
  const charts = [
    linked("Broken bonds", [["broken_in_tension", "in tension"], ["broken_in_shear", "in shear"], ...(columns.broken_in_tension ? [] : [["broken_bonds", "all"]])], {label: "bonds"}),
    linked("Fragments", [["fragments", "fragments"]], {label: "fragments"}),
    linked("Lateral stress", [["stress_xx", "across"], ["wall_stress_left", "on the left wall"], ["wall_stress_right", "on the right wall"]], {stress: true, label: `stress (${unit.name})`, free: true}),
    linked("Energies", [["external_work", "work done on the block"], ["elastic_bonds", "elastic, bonds"], ["elastic_contacts", "elastic, contacts"], ["damage", "damage"], ["friction", "friction"], ["viscous", "contact dashpots"], ["cundall", "Cundall damping"], ["kinetic", "kinetic"]],
           area ? {scale: 1e-3 / area, label: "energy (kJ/m3)"} : {label: "energy (J per m of depth)"}),
    linked("Strain rate", [["rate", "rate"]], {label: "1/s"}), linked("Contacts", [["contacts", "contacts"]], {label: "pairs of discs that touch"})];
  const angles = Array.from({length: 12}, (unused, k) => String(-90 + 15 * k + 7.5));
  const cracks = Report.largest(run.cracks.tension, run.cracks.shear) > 0 ? chart("Crack orientations", () => ({
    bars: true, x: {label: "angle to the direction of loading (degrees; 0: along it)", choices: angles, stacked: true}, y: {label: "broken bonds", min: 0, stacked: true},
    series: [{label: "tension", y: run.cracks.tension, colour: Report.series(0)}, {label: "shear", y: run.cracks.shear, colour: Report.series(1)}]}), {note: "all breaks of the run, in the intact block"}) : null;

  const validity = run.validity.length ? section("Can the numbers be relied on?",
    Report.table(["what", "value", "guide", ""], run.validity.map((row) => [row.name, row.value, row.guide, el("span", {class: "mark " + (row.good ? "met" : "missed")}, row.good ? "in order" : "look here")])),
    run.warnings.length ? el("ul", {class: "soft"}, ...run.warnings.map((one) => el("li", {}, one))) : null) : null;
  const csv = () => {
    const names = history.columns.map((column) => column.name);
    const lines = [names.join(",")];
    for (let k = 0; k < history.rows; ++k) lines.push(names.map((column) => String(Number(columns[column] ? columns[column][k].toPrecision(7) : ""))).join(","));
    return lines.join("\n") + "\n";
  };
  return [
    section("Curve and block", el("div", {class: "pair"}, curve, viewer || el("p", {class: "notice"}, "This run kept no frames (output.frames = \"none\"), so there is no block to show."))),
    section("Along the way", el("p", {class: "soft no-print"}, "The charts share their strain axis: the thin line follows the pointer, the thick one is the frame shown."),
            el("div", {class: "grid"}, charts.filter(Boolean), sizes, cracks)),
    validity,
    section("All numbers", el("div", {class: "grid"}, run.tables.map((one) => el("div", {}, el("h3", {}, one.title), Report.table([], one.rows.map(([label, value, help]) => [el("span", {title: help}, label), value]), [1]))))),
    section("Do it again", run.command ? el("p", {}, "Command:") : null, run.command ? el("pre", {class: "wrap"}, run.command) : null, el("p", {class: "soft"}, `${run.program}; seeds ${run.seeds}`),
            el("p", {}, Report.download("Curve as CSV", name + ".csv", csv), " ", el("span", {class: "soft"}, `seven digits${history.every > 1 ? `, every ${history.every}th row` : ""}; R.csv beside the run file has all`)),
            el("details", {}, el("summary", {}, "Resolved configuration"), el("pre", {}, run.config)))];
};
