// What is here: discs drawn on a plain canvas, for browsers without WebGL or without a graphics card. What is
// not: what lies over the discs (viewer.js).
"use strict";

/** A painter {name, paint(view)}: it sets the pixels itself, which is many times as fast as paths of thousands of discs. */
Report.canvasPainter = (canvas, block) => {
  const context = canvas.getContext("2d");
  let image = null;

  const paint = (view) => {
    const width = canvas.width, height = canvas.height, pixels = width / view.world.width;
    if (width < 1 || height < 1) return true;
    if (!image || image.width !== width || image.height !== height) image = context.createImageData(width, height);
    const colours = new Uint32Array(view.palette.buffer, view.palette.byteOffset, 256), ground = new Uint32Array(image.data.buffer);
    ground.fill(0);
    const clip = view.clip || view.world, left = Math.max(0, Math.round((clip.x - view.world.x) * pixels)),
          right = Math.min(width, Math.round((clip.x + clip.width - view.world.x) * pixels)),
          top = Math.max(0, Math.round(height - (clip.y + clip.height - view.world.y) * pixels)),
          bottom = Math.min(height, Math.round(height - (clip.y - view.world.y) * pixels));
    const [x0, dx] = block.facts.x, [y0, dy] = block.facts.y, step = block.facts.radius[1] * view.growth * pixels;
    // Discs that are large enough have a darker rim, so that they are told apart: from this part of the radius on.
    const rims = colours.map((colour) => (colour & 0xff000000) | ((colour >>> 2) & 0x3f3f3f) * 3), inner = 0.85, smallest = 3;
    const disc = (x, y, radius, colour) => {
      const last = Math.min(bottom, Math.ceil(y + radius - 0.5));
      for (let row = Math.max(top, Math.ceil(y - radius - 0.5)); row < last; ++row) {
        const from = row + 0.5 - y, half = Math.sqrt(radius * radius - from * from);
        const begin = Math.max(left, Math.round(x - half)), end = Math.min(right, Math.round(x + half));
        if (end > begin) ground.fill(colour, row * width + begin, row * width + end);
      }
    };
    for (const [sx, sy] of view.images)
      for (let d = 0; d < block.discs; ++d) {
        const x = (x0 + view.x[d] * dx + sx - view.world.x) * pixels, y = height - (y0 + view.y[d] * dy + sy - view.world.y) * pixels;
        const radius = block.radius[d] * step;
        if (x + radius < left || x - radius > right || y + radius < top || y - radius > bottom) continue;
        disc(x, y, radius, (radius < smallest ? colours : rims)[view.values[d]]);
        if (radius >= smallest) disc(x, y, inner * radius, colours[view.values[d]]);
      }
    context.putImageData(image, 0, 0);
    return true;
  };
  return {name: "canvas", paint};
};
