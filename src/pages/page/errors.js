// Collects the errors of the page in data-errors of the document, for tests, and shows them to the reader.
"use strict";

document.documentElement.dataset.errors = "";

/// Records an error, and shows it in `place` or, without one, at the top of the page.
function pageError(message, place) {
  const root = document.documentElement;
  root.dataset.errors += (root.dataset.errors ? "\n" : "") + message;
  const note = document.createElement("p");
  note.className = "error";
  note.textContent = "Error: " + message;
  if (place) {
    place.replaceChildren(note);
  } else if (document.body) {
    document.body.prepend(note);
  }
}

window.addEventListener("error", (event) => pageError(`${event.message} (line ${event.lineno})`));
window.addEventListener("unhandledrejection", (event) => pageError(String(event.reason)));
document.addEventListener("securitypolicyviolation", (event) => pageError(`refused to load ${event.blockedURI}`));
