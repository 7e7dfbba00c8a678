// What is here: discs drawn by WebGL, a point each. What is not: where there is no WebGL (block_canvas.js), what lies
// over the discs (viewer.js).
"use strict";

/** A painter {name, paint(view)}; null where the browser has no WebGL, has it without a graphics card, or draws no points
 *  of the size needed. */
Report.glPainter = (canvas, block) => {
  // Not antialiased: that smooths triangles, no points, and trebles the time where there is no graphics card.
  const gl = canvas.getContext("webgl", {antialias: false, preserveDrawingBuffer: true, alpha: true});
  if (!gl) return null;
  // Without a graphics card the plain canvas is faster; "#webgl" behind the address takes WebGL all the same.
  const names = gl.getExtension("WEBGL_debug_renderer_info"), drawnBy = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  if (/swiftshader|llvmpipe|softpipe|software|basic render/i.test(drawnBy) && location.hash !== "#webgl") return null;
  const shader = (kind, text) => {
    const made = gl.createShader(kind);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    return made;
  };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `
    attribute vec2 place; attribute float radius; attribute float value;
    uniform vec2 offset, range, shift, corner, size;
    uniform float pixels, largest;
    varying float shade;
    void main() {
      vec2 at = offset + place * range + shift;
      gl_Position = vec4((at - corner) / size * 2.0 - 1.0, 0.0, 1.0);
      gl_PointSize = max(1.0, 2.0 * radius * largest * pixels);
      shade = value;
    }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `
    precision mediump float;
    varying float shade;
    uniform sampler2D palette;
    void main() {
      vec2 from = gl_PointCoord * 2.0 - 1.0;
      float r = dot(from, from);
      if (r > 1.0) discard;
      vec3 colour = texture2D(palette, vec2((shade * 255.0 + 0.5) / 256.0, 0.5)).rgb;
      gl_FragColor = vec4(colour * (1.0 - 0.3 * smoothstep(0.6, 1.0, r)), 1.0);
    }`));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const at = (name) => gl.getUniformLocation(program, name);
  const attribute = (name, size, type) => {
    const buffer = gl.createBuffer(), place = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, true, 0, 0);
    return (data) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    };
  };
  const setPlaces = attribute("place", 2, gl.UNSIGNED_SHORT), setRadius = attribute("radius", 1, gl.UNSIGNED_SHORT),
        setValues = attribute("value", 1, gl.UNSIGNED_BYTE);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  for (const [what, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
    gl.texParameteri(gl.TEXTURE_2D, what, value);
  const full = 65535, places = new Uint16Array(2 * block.discs);
  /** The discs that reach over an edge of the block: only their images show. */
  const edgeDiscs = (view) => {
    const [hx, , hy] = view.h, far = block.facts.radius[1] * full * view.growth, list = [];
    const [x0, dx] = block.facts.x, [y0, dy] = block.facts.y;
    for (let d = 0; d < block.discs; ++d) {
      const x = x0 + dx * view.x[d], y = y0 + dy * view.y[d];
      if (x < far || x > hx - far || y < far || y > hy - far) list.push(d);
    }
    return list;
  };
  const largestPoint = gl.getParameter(gl.ALIASED_POINT_SIZE_RANGE)[1];

  const paint = (view) => {
    const pixels = canvas.width / view.world.width, largest = block.facts.radius[1] * full * view.growth;
    if (2 * largest * pixels > largestPoint) return false;
    for (let d = 0; d < block.discs; ++d) {
      places[2 * d] = view.x[d];
      places[2 * d + 1] = view.y[d];
    }
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, view.palette);
    gl.uniform2f(at("offset"), block.facts.x[0], block.facts.y[0]);
    gl.uniform2f(at("range"), block.facts.x[1] * full, block.facts.y[1] * full);
    gl.uniform2f(at("corner"), view.world.x, view.world.y);
    gl.uniform2f(at("size"), view.world.width, view.world.height);
    gl.uniform1f(at("pixels"), pixels);
    gl.uniform1f(at("largest"), largest);
    if (view.clip) {
      gl.enable(gl.SCISSOR_TEST);
      gl.scissor(Math.round((view.clip.x - view.world.x) * pixels), Math.round((view.clip.y - view.world.y) * pixels),
                 Math.round(view.clip.width * pixels), Math.round(view.clip.height * pixels));
    }
    const draw = (xy, radius, values, images) => {
      setPlaces(xy);
      setRadius(radius);
      setValues(values);
      for (const [dx, dy] of images) {
        gl.uniform2f(at("shift"), dx, dy);
        gl.drawArrays(gl.POINTS, 0, values.length);
      }
    };
    const images = view.images.filter(([dx, dy]) => dx !== 0 || dy !== 0);
    if (images.length) {
      const edge = Math.abs(view.h[1]) < 1e-9 * view.h[0] ? edgeDiscs(view) : Array.from(view.values.keys());
      draw(Uint16Array.from({length: 2 * edge.length}, (unused, k) => places[2 * edge[k >> 1] + (k & 1)]),
           Uint16Array.from(edge, (d) => block.radius[d]), Uint8Array.from(edge, (d) => view.values[d]), images);
    }
    draw(places, block.radius, view.values, [[0, 0]]);
    return true;
  };
  return {name: "webgl", paint};
};
