// What is here: elements of the page made from texts (never from HTML, so nothing a user wrote can become markup),
// numbers as people read them, downloads. What is not: charts.
"use strict";

Report.el = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(3))
    if (child !== null && child !== undefined) element.append(child);
  return element;
};

Report.svg = (tag, attributes = {}, ...children) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};

/** Four significant digits, as the program prints them. */
Report.digits = (value) => {
  if (value === null || value === undefined || !Number.isFinite(value)) return "-";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e7 || size < 1e-4)) return value.toExponential(3).replace(/\.?0+e/, "e");
  if (size >= 1000) return Math.round(value).toLocaleString("en-US");
  return String(Number(value.toPrecision(4)));
};

/** The unit that shows stresses up to `most` (Pa) as 1 to 999. */
Report.stressUnit = (most) => {
  for (const [name, scale] of [["Pa", 1], ["kPa", 1e-3], ["MPa", 1e-6]])
    if (most * scale < 1000) return {name, scale};
  return {name: "GPa", scale: 1e-9};
};

Report.largest = (...lists) => {
  let most = 0;
  for (const list of lists)
    for (const value of list || []) if (Number.isFinite(value) && Math.abs(value) > most) most = Math.abs(value);
  return most;
};

Report.table = (heads, rows, numeric = []) =>
  Report.el("div", {class: "scroll"}, Report.el("table", {},
    heads.length ? Report.el("thead", {}, Report.el("tr", {}, heads.map((text, k) =>
      Report.el("th", {class: numeric.includes(k) ? "number" : null, scope: "col"}, text)))) : null,
    Report.el("tbody", {}, rows.map((cells) => Report.el("tr", {}, cells.map((text, k) =>
      Report.el("td", {class: numeric.includes(k) ? "number" : null}, text)))))));

/** A table whose columns sort by a click: rows of {text, value} or texts. */
Report.sortable = (heads, rows) => {
  const body = Report.el("tbody");
  let sorted = -1, up = true;
  const value = (cell) => (typeof cell === "object" && cell !== null ? cell.value : cell);
  const text = (cell) => (typeof cell === "object" && cell !== null ? cell.text : cell);
  const numeric = (k) => rows.some((row) => typeof value(row[k]) === "number");
  const fill = () => {
    const order = rows.slice();
    if (sorted >= 0)
      order.sort((a, b) => {
        const x = value(a[sorted]), y = value(b[sorted]);
        if (x === y) return 0;
        if (x === null || x === undefined) return 1;
        if (y === null || y === undefined) return -1;
        return (x < y ? -1 : 1) * (up ? 1 : -1);
      });
    body.replaceChildren(...order.map((row) => Report.el("tr", {}, row.map((cell, k) =>
      Report.el("td", {class: numeric(k) ? "number" : null}, text(cell))))));
  };
  const head = Report.el("tr", {}, heads.map((name, k) =>
    Report.el("th", {scope: "col", class: numeric(k) ? "number" : null}, Report.el("button", {
      type: "button", title: "Sort by " + name,
      onclick: () => {
        up = sorted === k ? !up : true;
        sorted = k;
        fill();
      }}, name))));
  fill();
  return Report.el("div", {class: "scroll"}, Report.el("table", {}, Report.el("thead", {}, head), body));
};

/** A button that hands out `text()` as a file. */
Report.download = (label, name, text) => Report.el("button", {
  type: "button", class: "no-print",
  onclick: () => {
    const url = URL.createObjectURL(new Blob([text()], {type: "text/csv"}));
    const link = Report.el("a", {href: url, download: name});
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(url), 1000);
  }}, label);

/** One field of CSV (RFC 4180). */
Report.csvField = (value) => {
  const text = value === null || value === undefined ? "" : String(value);
  return /[",\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
};

/** The block of a layout with its holes (layout_path.h). */
Report.layout = (layout, label) => Report.svg("svg",
  {viewBox: `0 0 ${layout.width} ${layout.height}`, role: "img", "aria-label": label},
  Report.svg("svg", {width: layout.width, height: layout.height},  // cuts off what reaches over an edge
    Report.svg("rect", {class: "concrete", width: layout.width, height: layout.height}),
    Report.svg("path", {class: "hole", d: layout.path})));

Report.section = (title, ...children) => Report.el("section", {}, Report.el("h2", {}, title), children);
