// The contents of the file: a description, and columns of numbers as typed arrays.
"use strict";

const description = JSON.parse(document.getElementById("description").textContent);

/// Decodes Base64 to bytes.
function decodedBytes(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const piece = 1 << 16;  // characters, a multiple of 4; decoding all at once would take twice the memory
  const bytes = new Uint8Array(Math.floor((text.length * 3) / 4));
  let at = 0;
  for (let begin = 0; begin < text.length; begin += piece) {
    const part = atob(text.slice(begin, begin + piece));
    for (let k = 0; k < part.length; ++k) bytes[at++] = part.charCodeAt(k);
  }
  return bytes.subarray(0, at);
}

/// Returns {name: typed array}.
function decodedColumns(element) {
  const types = { Float64Array, Float32Array, Uint32Array, Uint16Array, Int16Array, Uint8Array };
  const { buffer } = decodedBytes(element.textContent);
  element.remove();  // frees the text, which is several times as large as the numbers
  const columns = {};
  for (const { name, type, offset, length } of description.columns) columns[name] = new types[type](buffer, offset, length);
  return columns;
}

const columns = decodedColumns(document.getElementById("columns"));
const disks = description.disks;
const box = {
  lower: description.box.lower,
  upper: description.box.upper,
  periodic: description.box.periodic,
  isCircle: description.box.isCircle === true,
  lengths: [0, 1].map((axis) => description.box.upper[axis] - description.box.lower[axis]),
};

/// Returns a moment of the run, which every part of the page draws or measures. `done` is the number of events up to it. Where
/// events are replayed, `flights` and `cursor` hold the flights of the disks up to it.
function emptyMoment() {
  const numbers = () => new Float64Array(disks);
  const walls = new Float64Array([box.lower[0], box.upper[0], box.lower[1], box.upper[1]]);
  return { time: 0, done: 0, x: numbers(), y: numbers(), vx: numbers(), vy: numbers(), scale: 1, displacement: 0, walls, flights: null, cursor: null };
}

/// Returns a coordinate folded into the box, on a periodic axis.
function folded(value, axis) {
  const inside = value - Math.floor((value - box.lower[axis]) / box.lengths[axis]) * box.lengths[axis];
  return inside < box.upper[axis] ? inside : box.lower[axis];
}

/// Returns the number of entries of a sorted list that are at most `value`.
function countUpTo(list, value, begin = 0, end = list.length) {
  while (begin < end) {
    const middle = (begin + end) >>> 1;
    if (list[middle] <= value) begin = middle + 1;
    else end = middle;
  }
  return begin;
}
