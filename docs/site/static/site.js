// A press on a picture of the gallery puts the player of that run in its place. Without this script the link opens the player.
addEventListener("DOMContentLoaded", () => {
  for (const link of document.querySelectorAll("a.press-to-play")) {
    link.addEventListener("click", (event) => {
      if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      const frame = document.createElement("iframe");
      frame.className = "live";
      frame.src = `${link.href}#play`;
      frame.title = link.querySelector("img")?.alt ?? "player";
      frame.allowFullscreen = true;
      link.replaceWith(frame);
      frame.focus();
    });
  }
});

// Who asks for less motion sees a still picture on the start page.
addEventListener("DOMContentLoaded", () => {
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  for (const film of document.querySelectorAll(".film img")) film.src = film.src.replace(/(_dark)?\.gif$/, ".png");
});
