#include "emulator/play/report/page_parts.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/results/junit.h"

namespace understudy::emulator::play {

const std::string_view kPageStyle = R"(
:root {
  color-scheme: light dark;
  --page: #ffffff; --card: #f6f8fa; --ink: #1f2328; --dim: #59636e; --rule: #d1d9e0; --grid: #e4e8ec;
  --good: #1a7f37; --bad: #cf222e; --bad-card: #fff1f0; --bit: #4f5b66;
  --k0: #0969da; --k1: #bc4c00; --k2: #1a7f37; --k3: #8250df;
  --k4: #bf3989; --k5: #0a7d88; --k6: #9a6700; --k7: #59636e;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #0d1117; --card: #161b22; --ink: #e6edf3; --dim: #9198a1; --rule: #30363d; --grid: #21262d;
    --good: #3fb950; --bad: #ff7b72; --bad-card: #2d1214; --bit: #adb6bf;
    --k0: #58a6ff; --k1: #f0883e; --k2: #56d364; --k3: #bc8cff;
    --k4: #f778ba; --k5: #39c5cf; --k6: #e3b341; --k7: #9198a1;
  }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 24px; max-width: 1240px; background: var(--page); color: var(--ink);
       font: 14px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 22px; margin: 0 0 2px; }
h2, h3 { font-size: 15px; margin: 18px 0 6px; }
.unseen { position: absolute; width: 1px; height: 1px; margin: 0; overflow: hidden; clip-path: inset(50%); }
a { color: inherit; }
code, pre, td.time, .picture text { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
code, pre, td.time { font-size: 12.5px; }
code, pre { overflow-wrap: anywhere; white-space: pre-wrap; }
pre { margin: 0; }
.dim { color: var(--dim); }
.good { color: var(--good); }
.bad { color: var(--bad); }
table { border-collapse: collapse; width: 100%; }
th { text-align: left; font-weight: 600; font-size: 12.5px; color: var(--dim); }
th, td { padding: 4px 10px 4px 0; vertical-align: top; border-bottom: 1px solid var(--rule); }
td.time, th.time { text-align: right; white-space: nowrap; }
.scenarios td:first-child { width: 90px; font-weight: 600; white-space: nowrap; }
.scenario { margin-top: 18px; border: 1px solid var(--rule); border-radius: 8px; padding: 0 18px; }
.scenario[open] { padding-bottom: 16px; }
.scenario > summary { cursor: pointer; padding: 10px 0; font-size: 15px; }
.scenario > summary h2 { display: inline; margin: 0 8px; }
.failure { background: var(--bad-card); border-left: 4px solid var(--bad); padding: 8px 14px; margin: 4px 0; }
.failure table { margin-top: 6px; }
.failure th, .failure td { border: 0; padding: 1px 12px 1px 0; }
.failure th { width: 90px; }
.steps tr.failed > td { background: var(--bad-card); }
.steps .place { white-space: nowrap; text-align: right; padding-right: 0; }
.steps summary, .failure summary { cursor: pointer; color: var(--dim); font-size: 12.5px; }
.frames { margin: 2px 0 6px; width: auto; }
.frames td { border: 0; padding: 0 12px 0 0; font-size: 12.5px; }
.frames code.dim { margin-left: 10px; }
.covered td { border: 0; padding: 0 12px 0 0; }
.covered th { padding-right: 12px; }
.covered .outcomes { white-space: nowrap; font-size: 12.5px; }
.covered td:last-child, .programs td:first-child { width: 100%; }
.touched td:first-child code { white-space: nowrap; }
.covered tr.missed > td { background: var(--bad-card); }
.programs th[colspan] { text-align: right; }
.scene { position: relative; }
.scroll { overflow-x: auto; }
.scroll > table { min-width: 560px; }
.picture { display: block; width: 100%; min-width: 820px; height: auto; margin: 4px 0 0; }
.picture text { font-size: 11px; fill: var(--ink); }
.picture .mark, .picture .number { fill: var(--dim); }
.picture .title { font-weight: 600; }
.picture .end { text-anchor: end; }
.picture .middle { text-anchor: middle; }
.picture .failed { fill: var(--bad); font-weight: 600; }
.picture line, .picture polyline { vector-effect: non-scaling-stroke; }
.picture .grid { stroke: var(--grid); }
.picture .frame { fill: none; stroke: var(--rule); }
.picture .fault { stroke: var(--bad); opacity: 0.55; }
.picture .step { stroke: var(--dim); stroke-dasharray: 2 4; opacity: 0.7; }
.picture .failure { stroke: var(--bad); stroke-width: 1.6; stroke-dasharray: 6 3; }
.picture .pointer { stroke: var(--dim); visibility: hidden; }
.picture .line { fill: none; stroke-width: 1.7; stroke-linejoin: round; }
.picture .dashed { stroke-dasharray: 5 4; }
.picture .wait { fill: var(--k0); fill-opacity: 0.55; }
.picture .sleep { fill: var(--k7); fill-opacity: 0.25; }
.picture .vain { fill: var(--bad); }
.picture .bit { stroke: var(--bit); stroke-width: 1.2; fill: var(--bit); fill-opacity: 0.22; }
.k0 { stroke: var(--k0); } .k1 { stroke: var(--k1); } .k2 { stroke: var(--k2); } .k3 { stroke: var(--k3); }
.k4 { stroke: var(--k4); } .k5 { stroke: var(--k5); } .k6 { stroke: var(--k6); } .k7 { stroke: var(--k7); }
.values { position: absolute; pointer-events: none; visibility: hidden; z-index: 1; background: var(--card);
          border: 1px solid var(--rule); border-radius: 6px; padding: 6px 10px; box-shadow: 0 2px 8px #0003; }
footer { margin-top: 24px; color: var(--dim); font-size: 12.5px; }
@media (max-width: 640px) {
  body { padding: 14px; }
  .scenario { padding: 0 10px; }
}
@media print { .scroll { overflow: visible; } .picture { min-width: 0; } }
@media print { .scenario { break-inside: avoid; } }
)";

const std::string_view kPageScript = R"(
"use strict";
// A link to a scenario opens it.
function openLinked() {
  const linked = document.getElementById(location.hash.slice(1));
  if (linked instanceof HTMLDetailsElement) { linked.open = true; linked.scrollIntoView(); }
}
addEventListener("hashchange", openLinked);
openLinked();

// The values under the pointer. Lines have their data in `points`: milliseconds and amounts.
for (const picture of document.querySelectorAll("svg.picture")) {
  const scene = picture.closest(".scene"), values = scene.querySelector(".values");
  const pointer = picture.querySelector(".pointer");
  const [begin, end, left, right] =
    ["begin", "end", "left", "right"].map(name => Number(picture.dataset[name]));
  let curves = null;
  const read = () => [...picture.querySelectorAll("polyline")].map(line => ({
    name: line.dataset.name,
    base: Number(line.dataset.base),
    isStepped: line.classList.contains("stepped"),
    points: line.getAttribute("points").split(" ").map(point => point.split(",").map(Number))
      .slice(line.classList.contains("bit") ? 1 : 0, line.classList.contains("bit") ? -1 : undefined),
  }));
  const valueAt = ({base, isStepped, points}, ms) => {
    let low = 0, high = points.length - 1;
    while (low < high) {  // the last point that is not later
      const middle = (low + high + 1) >> 1;
      if (points[middle][0] <= ms) low = middle; else high = middle - 1;
    }
    const [x, y] = points[low], next = points[low + 1];
    if (isStepped || !next || next[0] === x || ms <= x) return base + y;
    return base + y + (next[1] - y) * (ms - x) / (next[0] - x);
  };
  picture.addEventListener("pointermove", event => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM().inverse());
    const ms = Math.round((at.x - left) / (right - left) * (end - begin));
    if (ms < 0 || ms > end - begin) return picture.dispatchEvent(new Event("pointerleave"));
    curves ??= read();
    pointer.setAttribute("x1", at.x);
    pointer.setAttribute("x2", at.x);
    pointer.style.visibility = values.style.visibility = "visible";
    const rows = curves.map(curve => [curve.name, String(Math.round(valueAt(curve, ms) * 100) / 100)]);
    rows.unshift(["time", (begin + ms) / 1000 + " s"]);
    const width = Math.max(...rows.map(row => row[0].length));
    values.textContent = rows.map(([name, value]) => name.padEnd(width + 2) + value).join("\n");
    const box = scene.getBoundingClientRect(), x = event.clientX - box.left;
    values.style.left = x > box.width / 2 ? "" : x + 18 + "px";
    values.style.right = x > box.width / 2 ? box.width - x + 18 + "px" : "";
    values.style.top = Math.min(event.clientY - box.top + 12, Math.max(box.height - values.offsetHeight, 0)) + "px";
  });
  picture.addEventListener("pointerleave", () => {
    pointer.style.visibility = values.style.visibility = "hidden";
  });
}
)";

std::string plain_page(std::string_view title, std::string_view subtitle, std::string_view main,
                       std::string_view version) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Understudy: " +
         xml_escaped(title) + "</title>\n<style>" + std::string(kPageStyle) +
         "</style>\n</head>\n<body>\n<header>\n<h1>" + xml_escaped(title) + "</h1>\n<p>" +
         xml_escaped(subtitle) + "</p>\n</header>\n<main>\n" + std::string(main) +
         "</main>\n<footer>understudy " + xml_escaped(version) + "</footer>\n</body>\n</html>\n";
}

std::string table_section(std::string_view heading, std::span<const std::string_view> columns,
                          const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  std::string text = "<section>\n<h2>" + xml_escaped(heading) + "</h2>\n<div class=\"scroll\"><table>\n<tr>";
  for (const std::string_view column : columns) text += "<th scope=\"col\">" + xml_escaped(column) + "</th>";
  text += "</tr>\n";
  for (const std::vector<std::string>& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + xml_escaped(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table></div>\n</section>\n";
}

}  // namespace understudy::emulator::play
