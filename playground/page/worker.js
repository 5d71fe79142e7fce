// The Worker: runs the engine, and answers the page. Every message is {id, name, values}; its answer {id, value} or {id, error}.
"use strict";

let engine = null;

function pointerTo(text) {
  const size = engine.lengthBytesUTF8(text) + 1;
  const pointer = engine._malloc(size);
  engine.stringToUTF8(text, pointer, size);
  return pointer;
}

/// Calls a function that takes texts and answers with JSON. Throws what it answers as an error.
function asked(name, ...values) {
  const pointers = values.map((value) => (typeof value === "string" ? pointerTo(value) : value));
  try {
    const result = JSON.parse(engine.UTF8ToString(engine[`_carom_${name}`](...pointers)));
    if (result.error) throw new Error(result.error);
    return result;
  } finally {
    values.forEach((value, k) => typeof value === "string" && engine._free(pointers[k]));
  }
}

const numbersAt = (pointer, count) => engine.HEAPF64.slice(pointer / 8, pointer / 8 + count);
const numberCount = 26;

/// The disks and the numbers of now; `about` has what else the page asked for.
function moment(about = {}) {
  const pointer = engine._carom_state();
  const numbers = numbersAt(engine._carom_numbers(), numberCount);
  const result = { disks: numbersAt(pointer, 4 * numbers[1]), numbers };
  if (about.histogram) result.histogram = numbersAt(engine._carom_histogram(), 60);
  if (about.measured) result.measured = asked("measured");
  const twin = engine._carom_twin_state();
  if (twin) {
    result.twin = numbersAt(twin, 4 * numbers[1]);
    if (about.measured || about.twin) {
      result.twinNumbers = asked("twin_numbers");
      const marks = engine._carom_twin_overlapping();
      result.twinMarks = engine.HEAPU8.slice(marks, marks + numbers[1]);
    }
  }
  return result;
}

/// Radii, masses and species: once after every change of disks.
function properties(description) {
  const count = description.disks;
  const all = numbersAt(engine._carom_disks(), 3 * count);
  return { description, radius: all.slice(0, count), mass: all.slice(count, 2 * count), species: all.slice(2 * count) };
}

let lastMoment = 0;  // on the reader's clock

function advanced(until, budget) {
  const status = engine._carom_advance(until, budget);
  if (status === 3) throw new Error(engine.UTF8ToString(engine._carom_answer()));
  return { status, why: status === 2 ? engine.UTF8ToString(engine._carom_why_stopped()) : "" };
}

const does = {
  async start({ wasm }) {
    engine = await CaromEngine({ wasmBinary: wasm, print: () => {}, printErr: () => {} });
    return {};
  },
  /// The changes come with the scene, so that no frame runs past the first of them before they are there.
  load: ({ toml, source, overrides, changes }) => ({ ...properties(asked("load", toml, source, overrides.join("\n"), changes)), ...moment({ measured: true, histogram: true }) }),
  /// Advances by simulated time, within a budget of milliseconds.
  frame({ time, budget, about }) {
    const began = performance.now();
    const changes = numberOf(22);
    const result = advanced(engine.HEAPF64[engine._carom_numbers() / 8] + time, budget);
    result.spent = performance.now() - began;
    engine._carom_advance_twin(Math.max(4, budget / 2));
    if (began - lastMoment > 400) {
      engine._carom_keep_moment();
      lastMoment = began;
    }
    Object.assign(result, moment(about));
    if (result.numbers[22] !== changes) Object.assign(result, properties(asked("describe")));  // the list has changed something
    const fault = engine.UTF8ToString(engine._carom_fault());
    if (fault) result.fault = fault;
    return result;
  },
  /// Runs to a time, however long it takes, a piece at a time so that other messages get through.
  async until({ time }) {
    for (;;) {
      const { status, why } = advanced(time, 200);
      engine._carom_advance_twin(200);
      if (status === 0) break;
      if (status === 2) throw new Error(`the run cannot go on: ${why}`);
      await new Promise((resolve) => setTimeout(resolve));
    }
    return { ...properties(asked("describe")), ...moment({ measured: true, histogram: true, twin: true }) };
  },
  step() {
    const told = asked("step");
    engine._carom_advance_twin(200);
    return { ...told, ...properties(asked("describe")), ...moment({ measured: true, histogram: true, twin: true }) };
  },
  back({ events }) {
    const done = engine._carom_back(events);
    return { done, ...properties(asked("describe")), ...moment({ measured: true, histogram: true, twin: true }) };
  },
  apply: ({ body }) => ({ ...properties(asked("apply", body)), ...moment({ measured: true, histogram: true, twin: true }) }),
  changes: () => asked("changes"),
  scene: () => asked("scene_text"),
  hash: () => asked("hash"),
  check: () => asked("check"),
  measureAnew: () => (engine._carom_measure_anew(), moment({ measured: true, histogram: true })),
  twin: ({ method, dt }) => ({ ...asked("twin", method, dt), ...moment({ twin: true }) }),
  look: () => moment({ measured: true, histogram: true, twin: true }),
  memory: () => ({ bytes: engine.HEAPU8.length }),
};

const numberOf = (index) => engine.HEAPF64[engine._carom_numbers() / 8 + index];

onmessage = async ({ data: { id, name, values } }) => {
  try {
    const value = await does[name](values ?? {});
    const buffers = Object.values(value).filter((part) => ArrayBuffer.isView(part)).map((part) => part.buffer);
    postMessage({ id, value }, buffers);
  } catch (error) {
    postMessage({ id, error: error instanceof WebAssembly.RuntimeError ? `the engine has stopped (${error.message}); load a scene again` : String(error.message ?? error) });
  }
};
