// What is here: many designs in one picture: points of two columns coloured by a third, parallel coordinates, a
// table. What is not: which designs and columns (study.js, map.js).
"use strict";

/** Blue (small) over grey to orange (large). */
Report.ramp = (part) => {
  const stops = [[0, 90, 181], [120, 150, 190], [180, 180, 176], [225, 150, 80], [200, 80, 0]];
  const at = Math.max(0, Math.min(1, part)) * (stops.length - 1), low = Math.min(stops.length - 2, Math.floor(at)), f = at - low;
  return `rgb(${[0, 1, 2].map((c) => Math.round(stops[low][c] + f * (stops[low + 1][c] - stops[low][c]))).join(",")})`;
};

/** A label on two lines of at most `most` letters, cut where it is longer. */
Report.twoLines = (label, most) => {
  const cut = (words) => (words.length > most ? words.slice(0, Math.max(1, most - 2)) + ".." : words);
  const at = label.length > most ? label.lastIndexOf(" ", most) : -1;
  return at > 0 ? [cut(label.slice(0, at)), cut(label.slice(at + 1))] : [cut(label)];
};

/** Parallel coordinates of candidates in SVG: an axis a column, a line a candidate, coloured by the last column. */
Report.parallel = (columns, rows, best) => {
  const width = 900, height = 334, top = 48, bottom = 26, left = 60, right = 60;
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
    Report.twoLines(column.label, Math.floor((width - left - right) / Math.max(1, last) / 7.5)).forEach((words, line) => text(words, 13 + 15 * line));
    text(`${Report.digits(ends[k][1] * column.scale)} ${column.unit}`, 43);
    text(`${Report.digits(ends[k][0] * column.scale)} ${column.unit}`, height - 8);
  });
  return svg;
};

Report.axisText = (column) => column.label + (column.unit ? ` (${column.unit})` : "");

/** Two columns against each other, coloured by a third; a reader chooses others. `chosen`: {x, y, colour} to begin with.
    `data`: {columns (with `at`, their place in values), rows, wishes, best (a row or null), front (draw it), pareto (numbers
    of rows that have a rim)}. */
Report.scatter = (caption, chosen, data) => {
  const {el, chart} = Report, columns = data.columns;
  const wishesOf = (column) => data.wishes.filter((wish) => wish.measure === column.name || (wish.measure === "plateau_stress" && column.name === "plateau_mean"));
  const select = (what) => el("label", {}, {x: "across", y: "upwards", colour: "colour"}[what], el("select", {onchange: (event) => {
    chosen[what] = columns.find((column) => column.name === event.target.value);
    figure.redraw();
  }}, columns.map((column) => el("option", {value: column.name, selected: column === chosen[what]}, column.label))));
  const figure = chart(caption, () => {
    const rows = data.rows.filter((row) => row.values[chosen.x.at] !== null && row.values[chosen.y.at] !== null);
    const at = (row) => ({x: row.values[chosen.x.at] * chosen.x.scale, y: row.values[chosen.y.at] * chosen.y.scale});
    const shades = rows.map((row) => row.values[chosen.colour.at]), known = shades.filter((value) => value !== null);
    const low = Math.min(...known), high = Math.max(...known);
    const colours = shades.map((value) => (value === null ? Report.colour("line") : Report.ramp(high > low ? (value - low) / (high - low) : 0.5)));
    const info = rows.map((row) => `${row.arm} ${row.number}: ${chosen.x.label} ${Report.digits(at(row).x)}, ${chosen.y.label} ${Report.digits(at(row).y)}, ${chosen.colour.label} ${Report.digits(row.values[chosen.colour.at] === null ? null : row.values[chosen.colour.at] * chosen.colour.scale)}`);
    const marks = ["x", "y"].flatMap((what) => wishesOf(chosen[what]).map((wish) => ({kind: what + "-band", low: wish.low === null ? -1e30 : wish.low * chosen[what].scale,
      high: wish.high === null ? 1e30 : wish.high * chosen[what].scale, colour: Report.colour("wish"), label: "wished"})));
    const best = data.best;
    if (best && best.values[chosen.x.at] !== null && best.values[chosen.y.at] !== null) marks.push({kind: "point", ...at(best), colour: Report.colour("ink"), label: "best"});
    const rims = data.pareto && data.pareto.size ? rows.map((row, k) => (data.pareto.has(row.number) ? Report.colour("ink") : colours[k])) : undefined;
    const series = [{label: "", line: false, dots: 6, points: rows.map(at), colours, rims, info, colour: Report.series(0)}];
    if (data.front) series.push(...Report.front(rows, chosen, at));
    return {x: {label: Report.axisText(chosen.x), grace: "6%"}, y: {label: Report.axisText(chosen.y), grace: "6%"}, series, marks};
  }, {tools: el("div", {class: "tools"}, select("x"), select("y"), select("colour")), tall: true,
      note: `colour: ${chosen.colour.label}, from blue (small) to orange (large)${data.pareto && data.pareto.size ? "; dark rim: Pareto set" : ""}`});
  return figure;
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

/** Every design in a table that sorts, and as a file. */
Report.allDesigns = (title, file, columns, rows) => {
  const {el} = Report, heads = ["no.", "arm", "status", ...columns.map(Report.axisText)];
  const csv = () => [["number", "arm", "status", ...columns.map((column) => column.name)], ...rows.map((row) => [row.number, row.arm, row.status, ...row.values])].map((line) => line.map(Report.csvField).join(",")).join("\n") + "\n";
  return Report.section(title, el("p", {}, Report.download(`${title} as CSV`, file, csv)), el("details", {open: rows.length <= 60}, el("summary", {}, `${rows.length} designs`),
    Report.sortable(heads, rows.map((row) => [row.number, row.arm, row.status, ...columns.map((column, k) => ({value: row.values[k], text: Report.digits(row.values[k] === null ? null : row.values[k] * column.scale)}))]))));
};
