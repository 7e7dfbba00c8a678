// What is here: the page's facts and its packed numbers (packed.h) read. What is not: what they mean.
"use strict";
const Report = {};

Report.facts = JSON.parse(document.getElementById("facts").textContent);

Report.data = (() => {
  const bytesOf = (text) => {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
    return bytes;
  };

  // Browsers before 2023 have no DecompressionStream; pako does the same in plain JavaScript.
  async function inflated(bytes) {
    if (typeof DecompressionStream === "undefined") return pako.inflate(bytes);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** The bytes called `name`; null where the page has none. */
  async function bytes(name) {
    const place = document.getElementById("numbers-" + name);
    return place ? inflated(bytesOf(place.textContent)) : null;
  }

  /** Columns of 32-bit floats, `rows` long. */
  async function floats(name, rows) {
    const all = await bytes(name);
    if (!all || rows === 0) return [];
    const numbers = new Float32Array(all.buffer, all.byteOffset, all.byteLength >> 2);
    const columns = [];
    for (let at = 0; at + rows <= numbers.length; at += rows) columns.push(numbers.subarray(at, at + rows));
    return columns;
  }

  /** 16-bit codes from their differences to those `width` places before: low bytes first, then high bytes. */
  async function codes(name, width) {
    const all = await bytes(name);
    if (!all) return null;
    const count = all.length >> 1, result = new Uint16Array(count);
    for (let k = 0; k < count; ++k)
      result[k] = (all[k] | (all[count + k] << 8)) + (k >= width ? result[k - width] : 0);
    return result;
  }

  return {bytes, floats, codes};
})();
