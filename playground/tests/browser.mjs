// A headless Chromium that a script drives through pipes, by the DevTools protocol; nothing but node is needed.

import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/// The name of a Chromium that is here, or null.
export function chromium() {
  for (const name of ["chromium", "chromium-browser", "google-chrome"]) if (spawnSync(name, ["--version"]).status === 0) return name;
  return null;
}

export class Browser {
  #child;
  #profile = mkdtempSync(join(tmpdir(), "carom-playground-"));
  #next = 1;
  #waiting = new Map();
  #rest = "";
  #page = null;
  errors = [];  // of the console and of scripts, of the page of now

  static async start({ width = 1280, height = 800, options = [] } = {}) {
    const browser = new Browser();
    browser.#child = spawn(chromium(), ["--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--remote-debugging-pipe",
      `--user-data-dir=${browser.#profile}`, `--window-size=${width},${height}`, "--no-first-run", "--disable-background-timer-throttling", ...options, "about:blank"],
    { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.#child.stdio[4].on("data", (bytes) => browser.#hear(bytes.toString("utf8")));
    const { targetInfos } = await browser.#send("Target.getTargets");
    const target = targetInfos.find((one) => one.type === "page");
    const { sessionId } = await browser.#send("Target.attachToTarget", { targetId: target.targetId, flatten: true });
    browser.#page = sessionId;
    for (const domain of ["Page", "Runtime", "Log"]) await browser.send(`${domain}.enable`);
    await browser.size(width, height);
    return browser;
  }

  #hear(text) {
    const parts = (this.#rest + text).split("\0");
    this.#rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id !== undefined) {
        const { resolve, reject } = this.#waiting.get(message.id);
        this.#waiting.delete(message.id);
        if (message.error) reject(new Error(message.error.message));
        else resolve(message.result);
      } else if (message.method === "Runtime.exceptionThrown") {
        const { exceptionDetails: details } = message.params;
        this.errors.push(details.exception?.description ?? details.text);
      } else if (message.method === "Runtime.consoleAPICalled" && ["error", "warning"].includes(message.params.type)) {
        this.errors.push(message.params.args.map((one) => one.value ?? one.description).join(" "));
      } else if (message.method === "Log.entryAdded" && ["error", "warning"].includes(message.params.entry.level) && !/GPU stall|swiftshader|SwiftShader/i.test(message.params.entry.text)) {
        this.errors.push(message.params.entry.text);
      }
    }
  }
  #send(method, params = {}, sessionId = undefined) {
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      this.#waiting.set(id, { resolve, reject });
      this.#child.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
  }
  send(method, params = {}) {
    return this.#send(method, params, this.#page);
  }

  size(width, height, { touch = false, scale = 1 } = {}) {
    return this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: scale, mobile: touch });
  }
  /// "dark" or "light", and whether less motion is asked for.
  media({ scheme = "light", still = false } = {}) {
    return this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }, { name: "prefers-reduced-motion", value: still ? "reduce" : "no-preference" }] });
  }

  /// Opens an address, and waits until the playground there is ready.
  async open(address) {
    this.errors = [];
    await this.send("Page.navigate", { url: "about:blank" });
    await this.send("Page.navigate", { url: address });
    for (let k = 0; k < 600; ++k) {
      await pause(50);
      if (await this.evaluate("document.documentElement.dataset.ready !== undefined || (document.documentElement.dataset.errors ?? '') !== ''").catch(() => false)) return;
    }
    throw new Error(`${address} did not become ready`);
  }
  /// The value of an expression in the page; promises are waited for.
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  /// Seconds of processor time that the browser's processes have taken, by their kind.
  async processorTime() {
    const { processInfo } = await this.#send("SystemInfo.getProcessInfo");
    const sums = {};
    for (const { type, cpuTime } of processInfo) sums[type] = (sums[type] ?? 0) + cpuTime;
    return sums;
  }
  async picture() {
    const { data } = await this.send("Page.captureScreenshot", { format: "png" });
    return Buffer.from(data, "base64");
  }
  async key(key) {
    const code = key === " " ? "Space" : key;
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, code, text: key.length === 1 ? key : undefined });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key, code });
  }
  /// Presses at a place, drags to another, lets go.
  async drag([x0, y0], [x1, y1] = [x0, y0]) {
    const mouse = (type, x, y) => this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1 });
    await mouse("mousePressed", x0, y0);
    for (let k = 1; k <= 4; ++k) await mouse("mouseMoved", x0 + ((x1 - x0) * k) / 4, y0 + ((y1 - y0) * k) / 4);
    await mouse("mouseReleased", x1, y1);
  }
  async close() {
    await this.#send("Browser.close").catch(() => {});
    await new Promise((resolve) => (this.#child.exitCode === null ? this.#child.on("exit", resolve) : resolve()));
    rmSync(this.#profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

export const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
