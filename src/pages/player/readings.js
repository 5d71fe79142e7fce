// The elements of the page that show numbers and facts.
"use strict";

const readings = {};
for (const element of document.querySelectorAll("[data-reading]")) readings[element.dataset.reading] = element;

function say(name, text) {
  if (readings[name].textContent !== text) readings[name].textContent = text;  // an assignment would force a new layout
}

/// "1 sample", "2,000 samples"
const counted = (count, thing) => `${count.toLocaleString("en")} ${thing}${count === 1 ? "" : "s"}`;

/// Lists the facts about the run at the foot of the page.
function listFacts() {
  const facts = document.getElementById("facts");
  for (const [name, value] of description.facts) {
    const term = document.createElement("dt");
    const text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value;
    facts.append(term, text);
  }
}
