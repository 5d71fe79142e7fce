// The numbers of a plot as a table in the page and as a CSV file. Both list all numbers of the plot, visible or not.
"use strict";

/// Returns one row per point, series after series; a cell is text, a number, or null where a number is not finite.
function numberRows(plot) {
  const has = (key) => plot.series.some((series) => series[key]);
  const keys = ["x", "y", ...["y_low", "y_high", "labels"].filter(has)];
  const titles = { x: plot.x.title || "x", y: plot.y.title || "y", y_low: "low", y_high: "high", labels: "note" };
  const rows = [];
  for (const series of plot.series) {
    for (let i = 0; i < series.x.length; ++i) {
      rows.push([series.name, ...keys.map((key) => (series[key] ? series[key][i] : ""))]);
    }
  }
  return { columns: ["series", ...keys.map((key) => titles[key])], rows };
}

function numbersCsv(plot) {
  const { columns, rows } = numberRows(plot);
  const cell = (value) => {
    const text = value === null ? "nan" : String(value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return [columns, ...rows].map((row) => row.map(cell).join(",") + "\n").join("");
}

function numbersTable(plot) {
  const { columns, rows } = numberRows(plot);
  const table = document.createElement("table");
  const line = (cells, parent, tag) => {
    const row = parent.insertRow();
    cells.forEach((value, column) => {
      const cell = document.createElement(column === 0 && tag === "td" ? "th" : tag);
      if (cell.tagName === "TH") cell.scope = tag === "th" ? "col" : "row";
      if (column > 0 && columns[column] !== "note") cell.className = "number";
      cell.textContent = value === null ? "\u2013" : String(value);
      row.append(cell);
    });
  };
  line(columns, table.createTHead(), "th");
  const body = table.createTBody();
  for (const row of rows) line(row, body, "td");
  return table;
}

function saveText(text, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "text/csv;charset=utf-8" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/// Fills `details` when it is opened for the first time, so that large tables cost nothing until then. Hides it where there are
/// no numbers.
function offerNumbers(details, plot) {
  details.hidden = !plot.series.some((series) => series.x.length > 0);
  details.addEventListener("toggle", () => {
    const place = details.querySelector("div");
    if (!details.open || place.childElementCount > 0) return;
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "Save as CSV";
    button.addEventListener("click", () => saveText(numbersCsv(plot), `${plot.id}.csv`));
    const scroll = document.createElement("div");
    scroll.className = "scroll";
    scroll.tabIndex = 0;
    scroll.append(numbersTable(plot));
    place.append(button, scroll);
  });
}
