#pragma once
// The look of report.html, of runs and of parameter studies.

namespace cnem::report {

inline constexpr const char* report_style = R"css(
:root {
  color-scheme: light dark;
  --page: #f4f5f7; --card: #ffffff; --ink: #171b22; --soft: #5c6675; --line: #dde1e7; --grid: #e8ebef;
  --good: #13795b; --good-tint: #e2f3ec; --bad: #b3261e; --bad-tint: #fbe9e7; --warn: #8a5a00; --warn-tint: #fff4dc;
  --c0: #1f5fbf; --c1: #d2601a; --c2: #2a8c57; --c3: #a3338b; --c4: #7a5a2e; --c5: #1893a8; --c6: #c23a4b; --c7: #667085;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12151a; --card: #1b2027; --ink: #e8ebf0; --soft: #9aa4b2; --line: #303743; --grid: #2a303a;
    --good: #6fd3ab; --good-tint: #17332a; --bad: #ff9c92; --bad-tint: #3d1d1b; --warn: #f0c36b; --warn-tint: #362b14;
    --c0: #6ea8ff; --c1: #ff9d5c; --c2: #6ccf95; --c3: #e58ad2; --c4: #d0b07f; --c5: #5cd0e3; --c6: #ff8591; --c7: #a7b1c0;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink);
  font: 15px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; }
main { max-width: 1480px; margin: 0 auto; padding: 40px 32px 72px; }
h1 { font-size: 30px; line-height: 1.2; margin: 2px 0 12px; font-weight: 650; letter-spacing: -0.012em; }
h2 { font-size: 20px; margin: 48px 0 14px; font-weight: 650; letter-spacing: -0.006em; }
h3 { font-size: 15px; margin: 0 0 10px; font-weight: 600; }
.pictures + h3 { margin-top: 26px; }
.code { margin: 0; color: var(--soft); font-size: 13px; }
.verdict { display: inline-block; margin: 0; padding: 5px 13px; border-radius: 8px; font-weight: 600; font-size: 14px; }
.verdict.good { color: var(--good); background: var(--good-tint); }
.verdict.bad { color: var(--bad); background: var(--bad-tint); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(168px, 1fr)); gap: 12px; margin: 26px 0 0; }
.figures div, .charts figure, .pictures figure, .tables > div, pre, .post-mortem {
  background: var(--card); border: 1px solid var(--line); border-radius: 12px; }
.figures div { padding: 13px 14px; }
dt { color: var(--soft); font-size: 12.5px; }
dd { margin: 1px 0 0; font-size: 17px; font-weight: 620; font-variant-numeric: tabular-nums; letter-spacing: -0.01em;
  overflow-wrap: anywhere; }
dd.of { font-size: 12.5px; font-weight: 400; letter-spacing: 0; color: var(--soft); line-height: 1.35; }
.verdict + .code { margin-top: 9px; }
figure { margin: 0; }
.pictures, .charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(560px, 100%), 1fr)); gap: 16px; }
.charts { grid-template-columns: repeat(auto-fill, minmax(min(400px, 100%), 1fr)); }
.charts + *, .tables + *, .pictures + * { margin-top: 16px; }
.pictures figure { overflow: hidden; align-self: start; }
.pictures { align-items: start; }
.series > * + * { margin-top: 10px; }
.series details > figure { margin-top: 10px; }
.series figcaption { padding: 0 16px 12px; color: var(--soft); font-size: 12.5px; line-height: 1.45; }
.series figcaption:empty { display: none; }
.controls { display: flex; align-items: center; gap: 12px; padding: 8px 14px 12px; }
.controls button { flex: none; width: 40px; height: 34px; padding: 0; border: 1px solid var(--line); border-radius: 8px;
  background: var(--page); color: var(--ink); font-size: 14px; cursor: pointer; }
.controls input { flex: 1; min-width: 0; accent-color: var(--c0); }
.controls output { flex: none; min-width: 76px; text-align: right; font-variant-numeric: tabular-nums; }
summary { color: var(--soft); font-size: 13px; cursor: pointer; }
.pictures img { display: block; width: 100%; height: auto; cursor: zoom-in; }
.charts figure { padding: 16px 18px 12px; }
.charts figcaption { color: var(--soft); font-size: 12.5px; line-height: 1.45; }
.chart { display: block; width: 100%; height: auto; fill: var(--soft); font-variant-numeric: tabular-nums; }
.chart path { fill: none; }
.chart .grid { stroke: var(--grid); }
.chart .zero, .chart .axis { stroke: var(--soft); }
.chart .zero { stroke-opacity: 0.55; }
.chart .label { fill: var(--ink); }
.chart .key { fill: var(--ink); }
.chart .line { stroke-width: 1.9; stroke-linejoin: round; stroke-linecap: round; }
.chart .faint { stroke-width: 1; stroke-opacity: 0.3; }
.chart .dashed { stroke-dasharray: 6 4; }
.chart .s0 { stroke: var(--c0); } .chart .s1 { stroke: var(--c1); } .chart .s2 { stroke: var(--c2); }
.chart .s3 { stroke: var(--c3); } .chart .s4 { stroke: var(--c4); } .chart .s5 { stroke: var(--c5); }
.chart .s6 { stroke: var(--c6); } .chart .s7 { stroke: var(--c7); }
.faces { grid-template-columns: repeat(auto-fill, minmax(min(600px, 100%), 1fr)); }
.face > div { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(270px, 100%), 1fr)); gap: 12px 20px; align-items: center; }
.face table { max-width: 460px; }
.wide { grid-template-columns: minmax(0, 600px); }
.experiments { grid-template-columns: minmax(0, 1100px); }
.experiments figure > div { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(400px, 100%), 1fr)); gap: 12px 28px; align-items: center; }
.chart path.body { fill: var(--grid); }
.chart .surface, .chart .burr_side { stroke: var(--c7); } .chart .rollover { stroke: var(--c1); stroke-width: 3; }
.chart .burnish { stroke: var(--c0); stroke-width: 3; } .chart .second_burnish { stroke: var(--c5); stroke-width: 3; }
.chart .broken { stroke: var(--c4); stroke-width: 3; } .chart .hole { stroke: var(--c2); stroke-width: 3; }
.chart .fracture { stroke: var(--c6); stroke-width: 3; } .chart .burr { stroke: var(--c3); stroke-width: 3; }
.tables { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(400px, 100%), 1fr)); gap: 16px; align-items: start; }
.tables > div { padding: 16px 18px 10px; }
table { width: 100%; border-collapse: collapse; font-size: 14px; }
th, td { padding: 5px 0; border-top: 1px solid var(--grid); text-align: left; font-weight: 400; vertical-align: top; }
th { color: var(--soft); padding-right: 16px; }
td { text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: break-word; }
.measured td { padding-left: 12px; }
.scroll { overflow-x: auto; min-width: 0; }
tr:first-child > * { border-top: 0; }
.warnings { margin: 0; padding: 12px 16px 12px 34px; border-radius: 12px; background: var(--warn-tint); color: var(--warn); }
.post-mortem { padding: 16px 20px; border-color: var(--bad); max-width: 860px; }
.post-mortem p { margin: 0 0 10px; font-weight: 600; color: var(--bad); }
.post-mortem img { width: 100%; }
pre { margin: 0; padding: 18px 20px; max-height: 560px; overflow: auto; font: 12.5px/1.55 ui-monospace, "SF Mono",
  Menlo, Consolas, "DejaVu Sans Mono", monospace; tab-size: 2; }
dialog { width: 96vw; max-width: 1500px; padding: 0; border: 0; border-radius: 12px; overflow: hidden; background: var(--card); }
dialog::backdrop { background: rgb(10 12 16 / 0.75); }
dialog img { display: block; width: 100%; max-height: 94vh; object-fit: contain; cursor: zoom-out; }
@media (max-width: 600px) {
  main { padding: 20px 12px 48px; }
  h1 { font-size: 25px; }
  .figures { grid-template-columns: repeat(auto-fit, minmax(135px, 1fr)); gap: 8px; margin-top: 18px; }
  .figures div { padding: 10px 12px; }
  .charts figure, .tables > div { padding-left: 12px; padding-right: 12px; }
  .measured { font-size: 13px; }
  .measured th { padding-right: 0; }
  .measured td { padding-left: 8px; }
  pre { padding: 12px; }
}
@media print {
  body { background: #ffffff; }
  main { padding: 0; }
  pre { max-height: none; white-space: pre-wrap; }
  figure, .tables > div { break-inside: avoid; }
}
)css";

/// On a dark page pictures get dark colours (report/palette_png.hpp). Series of pictures are played. A click
/// on a picture shows it as large as the window.
inline constexpr const char* report_script = R"js(
const night = matchMedia("(prefers-color-scheme: dark)");
const shown = [];
function paint() {
  for (const image of document.querySelectorAll("img[data-dark]")) {
    image.light ??= image.src;
    if (night.matches && !image.dark) {
      const [at, chunk] = image.dataset.dark.split(":"), bytes = atob(image.light.split(",")[1]), colours = atob(chunk);
      image.dark = "data:image/png;base64," + btoa(bytes.slice(0, +at) + colours + bytes.slice(+at + colours.length));
    }
    image.src = night.matches ? image.dark : image.light;
  }
  for (const show of shown) show();
}
for (const player of document.querySelectorAll(".player")) {
  const figures = [...player.nextElementSibling.querySelectorAll("figure")];
  const [button, slider, time] = player.querySelectorAll("button, input, output");
  let timer = 0;
  const show = () => {
    const figure = figures[slider.value];
    player.querySelector("img").src = figure.querySelector("img").src;
    player.querySelector("figcaption").textContent = figure.querySelector("figcaption")?.textContent ?? "";
    time.textContent = figure.dataset.time;
  };
  const step = () => { slider.value = (+slider.value + 1) % figures.length; show(); };
  const stop = () => { clearInterval(timer); timer = 0; button.textContent = "\u25b6"; button.ariaLabel = "play"; };
  button.addEventListener("click", () => {
    if (timer) return stop();
    timer = setInterval(step, 400); button.textContent = "\u23f8"; button.ariaLabel = "pause"; step();
  });
  slider.addEventListener("input", () => { stop(); show(); });
  slider.value = figures.length - 1;
  player.hidden = false;
  shown.push(show);
}
night.addEventListener("change", paint);
paint();
addEventListener("beforeprint", () => { for (const all of document.querySelectorAll("details")) all.open = true; });
const dialog = document.querySelector("dialog");
document.addEventListener("click", event => {
  if (!event.target.matches(".pictures img")) return;
  dialog.firstElementChild.src = event.target.src;
  dialog.showModal();
});
dialog.addEventListener("click", () => dialog.close());
)js";

} // namespace cnem::report
