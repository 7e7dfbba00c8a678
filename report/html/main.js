// What is here: the page put together from the facts. What is not: its sections (run.js, study.js, sweep.js).
"use strict";

Report.markClass = (outcome) => (outcome === "met" ? "met" : outcome === "missed" || outcome === "out of reach" ? "missed" : "open");

Report.verdict = (verdict, status, reason) => {
  const {el} = Report;
  if (!verdict || !verdict.text)
    return el("div", {class: "verdict"}, el("strong", {class: "outcome"}, "No wish was stated"),
      el("p", {}, `Write a [target] into the design or study, and this place says whether it is met. ${status ? `The work: ${status}${reason ? ", " + reason : ""}.` : ""}`));
  const head = verdict.outcome === "met" ? verdict.text.split(":")[0] : verdict.outcome;  // "met at this rate (...)"
  const text = verdict.text.startsWith(verdict.outcome) ? verdict.text.slice(verdict.outcome.length).replace(/^[\s:,]+/, "") : verdict.text;
  return el("div", {class: "verdict " + Report.markClass(verdict.outcome)},
    el("strong", {class: "outcome"}, head ? head[0].toUpperCase() + head.slice(1) : "Verdict"),
    verdict.wishes.length ? null : el("p", {}, text),
    verdict.wishes.length ? el("ul", {}, verdict.wishes.map((wish) => el("li", {}, el("span", {class: "mark " + Report.markClass(wish.outcome)}, wish.outcome), el("span", {}, wish.text)))) : null,
    verdict.blocks ? el("p", {}, verdict.blocks[0].toUpperCase() + verdict.blocks.slice(1)) : null,
    verdict.note ? el("p", {class: "note"}, verdict.note) : null);
};

/** In the place of a verdict: a map has none, but says what it does not come near. */
Report.reach = (work) => {
  const {el} = Report, far = work.out_of_reach.length > 0;
  return el("div", {class: "verdict " + (far ? Report.markClass("out of reach") : "")}, el("strong", {class: "outcome"}, far ? "Out of reach of these designs" : work.wishes.length ? "Every wish lies within what was reached" : "No wish was stated"),
    ...work.out_of_reach.map((sentence) => el("p", {}, sentence.replace(/^out of the reachable range: /, ""))),
    el("p", {class: "soft"}, "A map shows what designs reach, each wish by itself. Whether one block keeps all of them is for a study to find and to show."));
};

Report.cards = (run) => {
  const wanted = ["plateau stress", "first peak stress", "cap ratio (largest stress / plateau)", "undulation", "densification strain", "energy absorbed to window end"];
  const rows = run.tables.flatMap((one) => one.rows);
  const found = wanted.map((label) => rows.find((row) => row[0] === label)).filter(Boolean);
  return Report.el("div", {class: "cards"}, found.map(([label, value, help]) => Report.el("div", {class: "card", title: help}, Report.el("b", {}, value), Report.el("span", {}, label))));
};

Report.build = async () => {
  const {el, facts} = Report, page = document.getElementById("page");
  const kinds = {run: "Evaluation of a block", ensemble: "Ensemble of replicates", study: "Study", map: "Map: what can be reached", sweep: "Sweep", calibration: "Calibration of a material"};
  page.append(el("header", {}, el("p", {class: "soft"}, kinds[facts.kind] || ""), el("h1", {}, facts.title), facts.block ? el("p", {class: "soft"}, facts.block) : null,
    facts.under_way ? el("p", {class: "notice"}, "The work goes on: this page is written anew once a minute and loads itself.") : null,
    !facts.under_way && facts.status && facts.status !== "completed" ? el("p", {class: "notice"}, `${facts.status}: ${facts.reason || ""}`) : null,
    el("div", {class: "head"}, facts.kind === "map" ? Report.reach(facts.work) : Report.verdict(facts.verdict, facts.status, facts.reason), el("aside", {class: "leaves-out"}, el("h3", {}, "What this model leaves out"), el("ul", {}, facts.left_out.map((text) => el("li", {}, text)))))));
  if (facts.run && facts.kind === "run") page.append(Report.cards(facts.run));
  if (facts.kind === "study") page.append(...Report.studySections(facts.work).filter(Boolean));
  if (facts.kind === "map") page.append(...Report.mapSections(facts.work).filter(Boolean));
  if (facts.kind === "sweep" || facts.kind === "ensemble") page.append(...Report.sweepSections(facts.work, facts.kind === "ensemble").filter(Boolean));
  if (facts.kind === "calibration") page.append(...Report.calibrationSections(facts.work));
  // The verdict is painted before the numbers of the frames, which stand at the end of the page, are read and unpacked.
  await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  if (document.readyState === "loading") await new Promise((done) => addEventListener("DOMContentLoaded", done));
  if (facts.run) {
    if (facts.run_caption) page.append(el("h2", {}, facts.run_caption), el("p", {class: "soft"}, facts.run.block), Report.cards(facts.run));
    page.append(...(await Report.runSections(facts.run, facts.name)).filter(Boolean));
  }
  if (facts.summary) page.append(Report.section("As the program prints it", el("details", {}, el("summary", {}, "Summary"), el("pre", {}, facts.summary))));
  requestAnimationFrame(() => { document.documentElement.dataset.ready = "yes"; });
};

Report.build().catch((error) => {
  document.getElementById("page").append(Report.el("p", {class: "notice"}, "This report could not be drawn whole: " + error.message));
  document.documentElement.dataset.ready = "failed";
  throw error;
});
