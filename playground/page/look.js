// How the page looks: the reader's settings of it, its theme, and what it says when something is amiss.
"use strict";

const parameters = new URLSearchParams(location.search);
const settings = { colour: "speed", palette: "viridis", theme: "auto", arrows: false, followed: -1, tool: "hand", history: "temperature" };

const theme = {};
const darkScreen = matchMedia("(prefers-color-scheme: dark)");
const stillScreen = matchMedia("(prefers-reduced-motion: reduce)");

function applyTheme() {
  const isDark = settings.theme === "auto" ? darkScreen.matches : settings.theme === "dark";
  document.documentElement.dataset.theme = isDark ? "dark" : "light";
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue(name).trim();
  Object.assign(theme, { isDark, font: value("--text-font") });
  for (const name of ["ink", "muted", "rule", "frame", "paper", "raised", "accent", "second", "solid", "fault"]) theme[name] = value(`--${name}`);
  run.isStale = true;
}

const byId = (name) => document.getElementById(name);

let noticeTimer = 0;
/// Says a sentence above the disks, for some seconds; in an open dialog, which would cover it there, below what it has.
function notify(sentence, isGood = false) {
  const note = byId("notice");
  (document.querySelector("dialog[open]") ?? byId("overlay").parentElement).append(note);
  note.textContent = told(sentence);
  note.classList.toggle("good", isGood);
  note.hidden = false;
  clearTimeout(noticeTimer);
  noticeTimer = setTimeout(() => (note.hidden = true), 4000 + 60 * sentence.length);
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    notify(t("copied"), true);
  } catch {
    // Without permission, or from a file in some browsers: the text is shown to be copied by hand.
    byId("copyText").value = text;
    byId("copyDialog").showModal();
    byId("copyText").select();
  }
}
