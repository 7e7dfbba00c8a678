// What is here: discs drawn on a plain canvas, for browsers without WebGL. What is not: what lies over the discs
// (viewer.js).
"use strict";

/** A painter {name, paint(view)}. */
Report.canvasPainter = (canvas, block) => {
  const context = canvas.getContext("2d");
  const order = new Uint32Array(block.discs), start = new Uint32Array(257);

  /** The discs in the order of their values, so that each colour is set once. */
  const sorted = (values) => {
    start.fill(0);
    for (let d = 0; d < block.discs; ++d) ++start[values[d] + 1];
    for (let k = 0; k < 256; ++k) start[k + 1] += start[k];
    const next = start.slice(0, 256);
    for (let d = 0; d < block.discs; ++d) order[next[values[d]]++] = d;
  };

  const paint = (view) => {
    const pixels = canvas.width / view.world.width, small = 1.5;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.save();
    if (view.clip) {
      context.beginPath();
      context.rect((view.clip.x - view.world.x) * pixels, canvas.height - (view.clip.y + view.clip.height - view.world.y) * pixels,
                   view.clip.width * pixels, view.clip.height * pixels);
      context.clip();
    }
    sorted(view.values);
    const [x0, dx] = block.facts.x, [y0, dy] = block.facts.y, step = block.facts.radius[1] * view.growth;
    for (let k = 0; k < 256; ++k) {
      if (start[k] === start[k + 1]) continue;
      context.fillStyle = `rgb(${view.palette[4 * k]},${view.palette[4 * k + 1]},${view.palette[4 * k + 2]})`;
      context.beginPath();
      for (let at = start[k]; at < start[k + 1]; ++at) {
        const d = order[at], radius = block.radius[d] * step * pixels;
        for (const [sx, sy] of view.images) {
          const x = (x0 + view.x[d] * dx + sx - view.world.x) * pixels,
                y = canvas.height - (y0 + view.y[d] * dy + sy - view.world.y) * pixels;
          if (x < -radius || x > canvas.width + radius || y < -radius || y > canvas.height + radius) continue;
          if (radius < small) context.rect(x - radius, y - radius, 2 * radius, 2 * radius);
          else {
            context.moveTo(x + radius, y);
            context.arc(x, y, radius, 0, 2 * Math.PI);
          }
        }
      }
      context.fill();
    }
    context.restore();
    return true;
  };
  return {name: "canvas", paint};
};
