// The words of the page, in the reader's language; a language is one file of texts/.
"use strict";

const texts = JSON.parse(document.getElementById("texts").textContent);
const languages = Object.keys(texts);
let language = "en";

/// Returns the text of a key, with {name} replaced by the values given. English stands in where the language lacks it.
function t(key, values = {}) {
  const text = texts[language][key] ?? texts.en[key] ?? key;
  return text.replace(/\{(\w+)\}/g, (_, name) => values[name] ?? "");
}

/// Returns a sentence of the engine in the reader's language where texts/ has it: its key has # for each number,
/// its text {0}, {1} and so on; its place in the text of the scene is left out.
function told(sentence) {
  const values = [];
  const key = sentence.replace(/^\w+:\d+:\d+: /, "").replace(/-?\d+(?:\.\d+)?(?:e[-+]?\d+)?/g, (number) => (values.push(short(Number(number), 4)), "#"));
  return texts[language][key] ?? texts.en[key] ? t(key, values) : sentence;
}

/// Fills in the texts of the page: data-t is the key of what an element says, data-t-title of its title and its label.
function translatePage() {
  document.documentElement.lang = language;
  for (const element of document.querySelectorAll("[data-t]")) element.textContent = t(element.dataset.t);
  for (const element of document.querySelectorAll("[data-t-title]")) {
    element.title = t(element.dataset.tTitle);
    element.setAttribute("aria-label", element.title);
  }
}

function chooseLanguage(wanted) {
  language = languages.find((name) => name === wanted) ?? languages.find((name) => (navigator.language || "en").startsWith(name)) ?? "en";
}
