// The engine as the page sees it: a Worker that is asked, and answers with promises.
"use strict";

/// Returns the bytes that Base64 text of a compressed file holds.
async function inflated(text) {
  const binary = atob(text.trim());
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

class Engine {
  #worker;
  #waiting = new Map();
  #next = 0;

  /// `code` is the source of the Worker, `wasm` the engine's bytes.
  static async start(code, wasm) {
    const engine = new Engine();
    const address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    engine.#worker = new Worker(address);
    engine.#worker.onmessage = ({ data: { id, value, error } }) => {
      const { resolve, reject } = engine.#waiting.get(id);
      engine.#waiting.delete(id);
      if (error === undefined) resolve(value);
      else reject(new Error(error));
    };
    engine.#worker.onerror = (event) => {
      for (const { reject } of engine.#waiting.values()) reject(new Error(event.message || "the engine's Worker did not start"));
      engine.#waiting.clear();
    };
    await engine.ask("start", { wasm }, [wasm]);
    URL.revokeObjectURL(address);
    return engine;
  }

  /// Asks the Worker for something; rejects with its sentence.
  ask(name, values = {}, transferred = []) {
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ id, name, values }, transferred);
    });
  }

  close() {
    this.#worker.terminate();
  }
}

/// The places of numbers in what a moment has.
const at = {
  time: 0, disks: 1, pairs: 2, walls: 3, events: 4, scale: 5, shift: 6, left: 7, right: 8, bottom: 9, top: 10, kinetic: 11, spin: 12, potential: 13,
  pistons: 14, kT: 15, overlapping: 16, deepest: 17, integral: 18, covered: 19, range: 20, bonds: 21, changes: 22, path: 23, dissipated: 24, pending: 25,
};
