// What is here: the block frame by frame: slider, keys, colours, bonds, scale. What is not: the discs themselves
// (block_gl.js, block_canvas.js).
"use strict";

/** The frames' numbers read; null where the page has none. */
Report.readBlock = async (facts) => {
  if (!facts) return null;
  const discs = facts.discs, count = facts.list.length, data = Report.data;
  const [x, y, radius, fragment, damage, pressure, strength, bonds] = await Promise.all([
    data.codes("x", discs), data.codes("y", discs), data.codes("radius", discs), data.bytes("fragment"), data.bytes("damage"),
    data.bytes("pressure"), data.bytes("strength"), data.floats("bonds", facts.bonds.count)]);
  const frame = (all, k) => all.subarray(k * discs, (k + 1) * discs);
  return {
    facts, discs, count, radius, bonds, x: (k) => frame(x, k), y: (k) => frame(y, k),
    fields: {fragment: (k) => frame(fragment, k), damage: (k) => frame(damage, k), pressure: (k) => frame(pressure, k), strength: () => strength}
  };
};

Report.viewer = (block, {onFrame = () => {}} = {}) => {
  const {el} = Report, facts = block.facts, ways = Report.colourWays(facts);
  const state = {frame: 0, way: ways[0], deformed: true, bonds: false, timer: null};
  const overCanvas = el("canvas", {"aria-hidden": "true"}), stage = el("div", {class: "stage"}, overCanvas);
  let painter = null;
  // A canvas keeps its first kind of context, so each painter has an element of its own.
  const paintWith = (make) => {
    const canvas = el("canvas", {role: "img", "aria-label": "The block, disc by disc"});
    canvas.width = overCanvas.width;
    canvas.height = overCanvas.height;
    painter = make(canvas, block);
    if (!painter) return false;
    if (stage.children.length > 1) stage.firstChild.remove();
    stage.prepend(canvas);
    canvas.addEventListener("webglcontextlost", () => {
      paintWith(Report.canvasPainter);
      paint();
    });
    return true;
  };

  // What is shown: the block at its first frame, and what bulges beyond free sides.
  const first = facts.list[0].h, full = 65535;
  const left = Math.min(0, facts.edges.free ? facts.x[0] : 0);
  const right = Math.max(first[0], facts.edges.free ? facts.x[0] + facts.x[1] * full : first[0]);
  const margin = 0.015 * (right - left);
  const world = {x: left - margin, y: -margin, width: right - left + 2 * margin, height: first[2] + 2 * margin};

  const slider = el("input", {type: "range", min: 0, max: block.count - 1, step: 1, value: 0, "aria-label": "Frame by strain",
                              oninput: () => show(Number(slider.value))});
  const caption = el("b"), key = el("div", {class: "legend", "aria-live": "off"});
  const wayButtons = ways.map((way, k) => el("button", {type: "button", "aria-pressed": String(k === 0), title: "Key " + (k + 1), onclick: () => colourBy(way)}, way.label));
  const check = (text, on, change) => el("label", {}, el("input", {type: "checkbox", checked: on, onchange: (event) => change(event.target.checked)}), text);
  const playButton = el("button", {type: "button", title: "Space", onclick: () => play()}, "Play");
  const tools = el("div", {class: "tools"}, el("span", {}, "Colour by"), wayButtons, playButton,
    check("deformed", true, (on) => { state.deformed = on; paint(); }),
    check("bonds", false, (on) => { state.bonds = on; paint(); }));

  const images = (frame) => {
    const list = [], [hx, hxy, hy] = facts.list[frame].h, across = facts.edges.walls || facts.edges.free ? 0 : 1, along = facts.edges.platens ? 0 : 1;
    for (let a = -across; a <= across; ++a) for (let b = -along; b <= along; ++b) list.push([a * hx + b * hxy, b * hy]);
    return list.sort((p, q) => Math.abs(q[0]) + Math.abs(q[1]) - Math.abs(p[0]) - Math.abs(p[1]));
  };

  const paintOver = (placed) => {
    const context = overCanvas.getContext("2d"), pixels = overCanvas.width / world.width, ratio = devicePixelRatio || 1;
    const px = (x) => (x - world.x) * pixels, py = (y) => overCanvas.height - (y - world.y) * pixels;
    context.clearRect(0, 0, overCanvas.width, overCanvas.height);
    const outline = (h, dash) => {
      context.setLineDash(dash);
      context.beginPath();
      context.moveTo(px(0), py(0));
      context.lineTo(px(h[0]), py(0));
      context.lineTo(px(h[0] + h[1]), py(h[2]));
      context.lineTo(px(h[1]), py(h[2]));
      context.closePath();
      context.stroke();
    };
    context.strokeStyle = Report.colour("soft");
    context.lineWidth = ratio;
    if (placed !== 0) outline(first, [4 * ratio, 4 * ratio]);
    const h = facts.list[placed].h;
    if (!facts.edges.free) outline(h, []);
    if (facts.edges.platens) {
      context.fillStyle = Report.colour("ink");
      context.fillRect(px(world.x), py(0), world.width * pixels, 4 * ratio);
      context.fillRect(px(world.x), py(h[2]) - 4 * ratio, world.width * pixels, 4 * ratio);
    }
    if (state.bonds && block.bonds.length === 3) {
      const [i, j, broken] = block.bonds, strain = facts.list[state.frame].strain, xs = block.x(placed), ys = block.y(placed);
      const [x0, dx] = facts.x, [y0, dy] = facts.y, far = 0.25 * Math.min(h[0], h[2]);
      context.setLineDash([]);
      context.strokeStyle = "rgba(0, 60, 120, 0.75)";
      context.lineWidth = 1.2 * ratio;
      context.beginPath();
      for (let b = 0; b < i.length; ++b) {
        if (broken[b] >= 0 && broken[b] <= strain) continue;
        const ax = x0 + dx * xs[i[b]], ay = y0 + dy * ys[i[b]], bx = x0 + dx * xs[j[b]], by = y0 + dy * ys[j[b]];
        if (Math.abs(ax - bx) > far || Math.abs(ay - by) > far) continue;
        context.moveTo(px(ax), py(ay));
        context.lineTo(px(bx), py(by));
      }
      context.stroke();
    }
  };

  const paint = () => {
    const placed = state.deformed ? state.frame : 0, h = facts.list[placed].h;
    const list = images(placed);
    const view = {x: block.x(placed), y: block.y(placed), values: block.fields[state.way.field](state.frame), palette: state.way.palette,
                  images: list, h, world, growth: 1.28,
                  clip: list.length > 1 && Math.abs(h[1]) < 1e-9 * h[0]
                      ? {x: facts.edges.free ? world.x : 0, y: 0, width: facts.edges.free ? world.width : h[0], height: h[2]} : null};
    if (!painter.paint(view)) {
      paintWith(Report.canvasPainter);  // the graphics card draws no points of this size
      painter.paint(view);
    }
    paintOver(placed);
    stage.dataset.painter = document.documentElement.dataset.painter = painter.name;
    stage.dataset.frame = state.frame;
  };

  const show = (frame) => {
    state.frame = Math.max(0, Math.min(block.count - 1, frame));
    slider.value = state.frame;
    const info = facts.list[state.frame];
    caption.textContent = `at ${info.strain_text} strain`;
    slider.setAttribute("aria-valuetext", caption.textContent);
    paint();
    Report.link.show({frame: 100 * info.strain});
    onFrame(state.frame);
  };
  const colourBy = (way) => {
    state.way = way;
    wayButtons.forEach((button, k) => button.setAttribute("aria-pressed", String(ways[k] === way)));
    key.replaceChildren(...way.key);
    paint();
  };
  const play = () => {
    const playing = state.timer !== null;
    if (playing) clearInterval(state.timer);
    state.timer = playing ? null : setInterval(() => show((state.frame + 1) % block.count), 400);
    playButton.textContent = playing ? "Play" : "Stop";
  };
  const resize = () => {
    const room = stage.parentElement.clientWidth, tallest = Math.max(320, 0.72 * innerHeight), ratio = devicePixelRatio || 1;
    const width = Math.min(room, (tallest * world.width) / world.height), height = (width * world.height) / world.width;
    stage.style.width = width + "px";
    stage.style.height = height + "px";
    for (const canvas of stage.children) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    paint();
  };

  addEventListener("keydown", (event) => {
    if (event.target.matches("input:not([type=range]), select, textarea") || event.ctrlKey || event.altKey || event.metaKey) return;
    const steps = {ArrowLeft: state.frame - 1, ArrowRight: state.frame + 1, Home: 0, End: block.count - 1};
    if (event.key in steps) {
      show(steps[event.key]);
      event.preventDefault();
    } else if (event.key === " " && !event.target.matches("button, summary")) {
      play();
      event.preventDefault();
    } else if (event.key >= "1" && event.key <= String(ways.length)) colourBy(ways[Number(event.key) - 1]);
  });
  Report.link.pick = (strain) => {
    let nearest = 0;
    facts.list.forEach((info, k) => {
      if (Math.abs(100 * info.strain - strain) < Math.abs(100 * facts.list[nearest].strain - strain)) nearest = k;
    });
    show(nearest);
  };
  const shown = facts.list.length < facts.of ? `${facts.list.length} of ${facts.of} frames, so that the page stays small. ` : "";
  const element = el("figure", {class: "viewer"}, el("figcaption", {}, "The block ", caption), tools, stage, slider, key,
    el("p", {class: "soft no-print"}, `Keys: left and right arrow, Home, End; space plays; 1 to ${ways.length} colour. ${shown}Bonds: ${facts.bonds.count_text} of ${facts.bonds.of_text}, evenly sampled.`));
  requestAnimationFrame(() => {
    if (!paintWith(Report.glPainter)) paintWith(Report.canvasPainter);
    resize();
    colourBy(ways[0]);
    show(Math.min(block.count - 1, 1));
    addEventListener("resize", resize);
    document.documentElement.dataset.block = "shown";
    Report.shownAt = performance.now();  // for tests
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);
  // For tests: how long it takes to show each frame once, in ms.
  element.timed = () => {
    const begun = performance.now();
    for (let k = 0; k < block.count; ++k) {
      show(k);
      overCanvas.getContext("2d").getImageData(0, 0, 1, 1);
      const gl = stage.firstChild.getContext("webgl");
      if (gl) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      else stage.firstChild.getContext("2d").getImageData(0, 0, 1, 1);
    }
    return (performance.now() - begun) / block.count;
  };
  Report.shownBlock = element;
  return element;
};
