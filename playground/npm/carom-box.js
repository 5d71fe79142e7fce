// <carom-box scene="piston" n="200"></carom-box>: a box of the playground in a page of one's own. Scene text in TOML may stand inside the
// element. The page playground.html is looked for beside this file, or where the attribute `page` says.

const passed = ["scene", "lang", "theme", "rate", "play", "colour", "palette", "draw", "n", "eta", "kT", "seed"];

class CaromBox extends HTMLElement {
  #frame = null;
  #ready = null;

  connectedCallback() {
    if (this.#frame) return;
    const page = new URL(this.getAttribute("page") ?? "playground.html", this.hasAttribute("page") ? document.baseURI : import.meta.url);
    page.searchParams.set("embed", "");
    for (const name of passed) if (this.hasAttribute(name)) page.searchParams.set(name, this.getAttribute(name));
    const toml = this.textContent.trim();
    this.#frame = document.createElement("iframe");
    this.#frame.title = this.getAttribute("title") ?? "Carom";
    this.#frame.style.cssText = "width: 100%; height: 100%; border: 0";
    this.#frame.src = page.href;
    if (!this.style.display) this.style.display = "block";
    if (!this.style.height && !this.hasAttribute("height")) this.style.height = "28rem";
    if (this.hasAttribute("height")) this.style.height = this.getAttribute("height");
    this.#ready = new Promise((resolve, reject) => {
      this.#frame.addEventListener("load", async () => {
        try {
          const { carom } = this.#frame.contentWindow;
          await carom.ready;
          if (toml) await carom.load(toml);
          if (toml && this.getAttribute("play") !== "0") carom.play(true);
          resolve(carom);
        } catch (error) {
          reject(error);
        }
      });
    });
    this.#ready.catch(() => {});  // whoever asks for it is told
    this.replaceChildren(this.#frame);
  }

  /// Resolves with the functions of the page inside (window.carom), once it is ready. Both pages must come from one place.
  get ready() {
    return this.#ready;
  }
}

customElements.define("carom-box", CaromBox);

export { CaromBox };
