// What is here: the ways to colour the discs of a block: for each a palette of 256 colours and its key. What is not:
// drawing (block_gl.js, block_canvas.js).
"use strict";

Report.colourWays = (frames) => {
  const ramp = (stops) => {
    const palette = new Uint8Array(256 * 4);
    for (let k = 0; k < 256; ++k) {
      const at = (k / 255) * (stops.length - 1), low = Math.min(stops.length - 2, Math.floor(at)), part = at - low;
      for (let c = 0; c < 3; ++c) palette[4 * k + c] = Math.round(stops[low][c] + part * (stops[low + 1][c] - stops[low][c]));
      palette[4 * k + 3] = 255;
    }
    return palette;
  };
  const classes = new Uint8Array(256 * 4);
  const concrete = [205, 197, 182], crumbs = [150, 140, 132];
  for (let k = 0; k < 256; ++k) {
    const colours = frames.fragment_colours;
    classes.set([...(k === 0 ? concrete : k === 255 ? crumbs : colours[(k - 1) % colours.length]), 255], 4 * k);
  }
  const css = (colour) => `rgb(${colour.join(",")})`;
  const gradient = (palette) => {
    const stops = [0, 32, 64, 96, 128, 160, 192, 224, 255].map((k) => css([palette[4 * k], palette[4 * k + 1], palette[4 * k + 2]]));
    return `linear-gradient(to right, ${stops.join(",")})`;
  };
  // Cividis for strength (Nunez, Anderton and Renslow 2018), blue to orange for stress: both told apart without red and
  // green; damage from pale to dark.
  const damage = ramp([[222, 214, 200], [224, 170, 110], [190, 80, 40], [90, 12, 20]]);
  const strength = ramp([[0, 34, 78], [60, 77, 110], [124, 123, 120], [187, 175, 113], [254, 232, 56]]);
  const force = ramp([[5, 70, 140], [70, 150, 210], [226, 224, 220], [235, 140, 50], [140, 50, 0]]);
  const swatch = (colour, text) => Report.el("span", {}, Report.el("i", {style: `background:${css(colour)}`}), text);
  const scale = (palette, low, high) => [Report.el("span", {}, low), Report.el("span", {class: "ramp", style: `background:${gradient(palette)}`}),
                                         Report.el("span", {}, high)];
  const ways = [
    {name: "fragment", label: "fragments", palette: classes, field: "fragment",
     key: [swatch(concrete, "largest fragment"), ...frames.fragment_colours.slice(0, 4).map((colour, k) => swatch(colour, k === 3 ? "other fragments" : "")),
           swatch(crumbs, "crumbs (fewer than 6 discs)")]},
    {name: "damage", label: "damage", palette: damage, field: "damage", key: scale(damage, "all bonds left", "all bonds lost")}];
  if (frames.strength[0] !== frames.strength[1])
    ways.push({name: "strength", label: "strength", palette: strength, field: "strength",
               key: scale(strength, `weak (factor ${frames.strength[0]})`, `strong (${frames.strength[1]})`)});
  if (frames.force_known)
    ways.push({name: "force", label: "force", palette: force, field: "pressure",
               key: [...scale(force, `tension ${frames.pressure_most_text}`, `compression ${frames.pressure_most_text}`),
                     Report.el("span", {}, "mean stress of each disc from the normal forces of its bonds and contacts; colours by its root")]});
  return ways;
};
