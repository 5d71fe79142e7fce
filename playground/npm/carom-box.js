// <carom-box scene="piston" n="200"></carom-box>: a box of the playground in a page of one's own. Scene text in TOML may stand inside the
// element. The page playground.html is looked for beside this file, or where the attribute `page` says.

const passed = ["scene", "lang", "theme", "rate", "play", "colour", "palette", "draw", "n", "eta", "kT", "seed"];

class CaromBox extends HTMLElement {
  static observedAttributes = [...passed, "page", "height"];
  #toml = null;
  #ready = null;
  #isLate = false;  // an attribute has changed, and the frame not yet

  connectedCallback() {
    this.#toml ??= this.textContent.trim();
    this.#show();
  }
  attributeChangedCallback() {
    if (!this.#ready || this.#isLate) return;
    this.#isLate = true;
    queueMicrotask(() => this.isConnected && this.#show());
  }

  #show() {
    this.#isLate = false;
    const page = new URL(this.getAttribute("page") ?? "playground.html", this.hasAttribute("page") ? document.baseURI : import.meta.url);
    page.searchParams.set("embed", "");
    for (const name of passed) if (this.hasAttribute(name)) page.searchParams.set(name, this.getAttribute(name));
    const frame = document.createElement("iframe");
    frame.title = this.getAttribute("title") ?? "Carom";
    frame.style.cssText = "width: 100%; height: 100%; border: 0";
    frame.allow = "fullscreen; clipboard-write";
    frame.src = page.href;
    this.style.display ||= "block";
    if (this.hasAttribute("height")) this.style.height = this.getAttribute("height");
    else this.style.height ||= "28rem";
    this.#ready = new Promise((resolve, reject) => {
      frame.addEventListener("load", async () => {
        try {
          const { carom } = frame.contentWindow;
          if (!carom) throw new Error(`${page.href} is not the page of the playground; set the attribute page to where playground.html is`);
          await carom.ready;
          if (this.#toml) await carom.load(this.#toml);
          if (this.#toml && this.getAttribute("play") !== "0") carom.play(true);
          resolve(carom);
        } catch (error) {
          reject(error);
        }
      });
    });
    this.#ready.catch(() => {});  // whoever asks for it is told
    this.replaceChildren(frame);
  }

  /// Resolves with the functions of the page inside (window.carom), once it is ready. Both pages must come from one place.
  get ready() {
    return this.#ready;
  }
}

customElements.define("carom-box", CaromBox);

export { CaromBox };
