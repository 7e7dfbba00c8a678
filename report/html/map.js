// What is here: the sections of a map: what can be reached, where the wish lies, all designs. What is not: studies
// (study.js).
"use strict";

Report.mapSections = (work) => {
  const {el, section} = Report;
  const columns = work.columns.map((column, k) => ({...column, at: k})), done = work.rows.filter((row) => row.status === "completed");
  const variables = columns.filter((column) => column.kind === "variable"), results = columns.filter((column) => column.kind === "result");
  const named = (name) => results.find((column) => column.name === name);
  const sections = [];
  sections.push(section("What can be reached", Report.table(["", "smallest to largest mean of a design", "designs"], work.ranges, [2])));
  const plateau = named("plateau_stress") || results[0];
  if (done.length > 1 && plateau && results.length > 1) {
    const against = (name, colour) => {
      const column = named(name);
      return column && column !== plateau ? Report.scatter(column.label, {x: plateau, y: column, colour}, {columns, rows: done, wishes: work.wishes, best: null}) : null;
    };
    const colour = variables[0] || named("porosity") || plateau;
    sections.push(section("Where the designs lie", el("p", {class: "soft"}, "A point a design: the mean of its replicates. Bands: what is wished."),
      el("div", {class: "pair"}, against("cap_ratio", colour), against("undulation", colour), against("found_plateau_length", colour), against("porosity", colour))));
    const shown = variables.concat(["plateau_stress", "cap_ratio", "undulation"].map(named).filter(Boolean).reverse());
    sections.push(section("All at once", el("p", {class: "soft"}, `A line a design, coloured by its ${shown[shown.length - 1].label} from blue (small) to orange (large).`),
      el("div", {class: "scroll"}, Report.parallel(shown, done.map((row) => ({...row, values: shown.map((column) => row.values[column.at])})), -1))));
  }
  if (work.failed.length)
    sections.push(section("Designs that failed", Report.table(["design", "reason"], work.failed.map((one) => [one.what, one.reason]))));
  sections.push(Report.allDesigns("All designs", "designs.csv", columns, work.rows));
  return sections;
};
