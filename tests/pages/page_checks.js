// What scripts that work the controls of a page have in common. Run behind the page's own scripts; data-checks of the document counts
// the checks, data-failures lists those that failed, as noteChecks() leaves them.
const failures = [];
let checks = 0;
function check(what, isTrue) {
  ++checks;
  if (!isTrue) failures.push(what);
}
const near = (a, b) => Math.abs(a - b) <= 1e-12 * Math.max(Math.abs(a), Math.abs(b), 1);
const byId = (id) => document.getElementById(id);
const press = (key, options = {}) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, ...options }));
const give = (id, value, event) => {
  byId(id).value = value;
  byId(id).dispatchEvent(new Event(event, { bubbles: true }));
};
const stageCanvas = byId("stage");
const copy = new OffscreenCanvas(stageCanvas.width, stageCanvas.height).getContext("2d", { willReadFrequently: true });
const pixels = () => {
  carom.frame(0);
  copy.drawImage(stageCanvas, 0, 0);
  return copy.getImageData(0, 0, stageCanvas.width, stageCanvas.height).data;
};
const picture = () => {
  let hash = 0;
  for (const byte of pixels()) hash = (Math.imul(hash, 31) + byte) | 0;
  return hash;
};
/// Whether two pictures are one: browsers have more than one way to smooth the rim of a circle, which differ by a few of 255
/// levels. Whatever is drawn or not differs by far more.
const same = (a, b) => a.every((level, k) => Math.abs(level - b[k]) <= 8);
const pointer = (type, x, y, more = {}) => {
  const frame = stageCanvas.getBoundingClientRect();
  const at = { clientX: frame.left + x, clientY: frame.top + y, pointerId: 1, bubbles: true, ...more };
  stageCanvas.dispatchEvent(type === "wheel" ? new WheelEvent(type, { ...at, cancelable: true }) : new PointerEvent(type, at));
};
const noteChecks = () => {
  document.documentElement.dataset.checks = checks;
  document.documentElement.dataset.failures = failures.join("; ");
};
/// Whether all that can be worked can be reached without a mouse, and says what it is.
function checkReach() {
  for (const element of document.querySelectorAll("button, select, input, summary")) {
    check(`${element.id} has the focus`, element.tabIndex >= 0);
    const name = element.getAttribute("aria-label") || element.textContent.trim() || (element.labels && element.labels[0].textContent);
    check(`${element.id} has a name`, Boolean(name));
  }
}
