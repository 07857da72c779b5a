/// Style and behaviour of the report's page.
#pragma once

#include <string_view>

namespace vicus::report {

inline constexpr std::string_view kPageStyle = R"css(
:root { --ink: #24272b; --soft: #666c72; --line: #dcd7cc; --paper: #fbfaf6; --panel: #ffffff; --accent: #8f2f22;
  --good: #2f7a55; --better: #e7f0e6;
  --text: Charter, "Bitstream Charter", "Source Serif 4", "Iowan Old Style", Georgia, "DejaVu Serif", serif;
  --figures: "Inter", "Source Sans 3", "Helvetica Neue", "Noto Sans", "DejaVu Sans", Arial, sans-serif;
  --code: "JetBrains Mono", "SF Mono", Consolas, "DejaVu Sans Mono", monospace; }
* { box-sizing: border-box; }
html { background: var(--paper); color: var(--ink); font: 17px/1.55 var(--text); }
body { max-width: 1360px; margin: 0 auto; padding: 48px 32px 96px; }
header { border-bottom: 3px double var(--ink); padding-bottom: 18px; margin-bottom: 30px; }
.eyebrow { font: 600 13px/1.4 var(--figures); letter-spacing: .12em; text-transform: uppercase; color: var(--accent);
  margin: 0; }
h1 { font-size: 44px; line-height: 1.1; font-weight: 600; margin: 6px 0 10px; }
.facts { font: 14px/1.6 var(--figures); color: var(--soft); margin: 0; }
.facts span + span::before { content: "·"; margin: 0 .55em; }
h2 { font-size: 27px; font-weight: 600; margin: 56px 0 4px; }
h3 { font-size: 19px; font-weight: 600; margin: 30px 0 6px; }
p, li { max-width: 74ch; }
.lead { color: var(--soft); margin: 0 0 16px; }
.summary { font-size: 20px; line-height: 1.5; }
.summary p { margin: 0 0 10px; }
.findings { border: 1px solid var(--accent); border-left-width: 6px; background: #fdf1ee; padding: 14px 20px;
  margin: 22px 0; }
.findings h2 { margin: 0 0 4px; font-size: 20px; color: var(--accent); }
.findings ul { margin: 0; padding-left: 1.2em; }
.fine { border-left: 6px solid var(--good); background: #eef5ee; padding: 10px 20px; margin: 22px 0; }
.fine p { margin: 0; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font: 13.5px/1.35 var(--figures); font-variant-numeric: tabular-nums; width: 100%;
  background: var(--panel); }
th, td { padding: 6px 8px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 600; color: var(--soft); vertical-align: bottom; border-bottom: 2px solid var(--ink); font-size: 12.5px;
  white-space: normal; }
th small { display: block; font-weight: 400; font-size: 11px; }
th.group { text-align: center; border-bottom: 1px solid var(--line); color: var(--ink); }
td:first-child, th:first-child { text-align: left; }
td.text, th.text { text-align: left; white-space: normal; }
td code { font: 12px var(--code); color: var(--soft); display: block; }
td small { color: var(--soft); font-size: 11.5px; }
tr.base td { background: #f4f1e9; }
tbody tr:hover td { background: #f1ede2; }
.bad { color: var(--accent); font-weight: 700; }
.ok { color: var(--good); }
.bar { display: block; }
figure { margin: 18px 0 0; }
figcaption { font: 13px/1.45 var(--figures); color: var(--soft); margin-top: 5px; max-width: 90ch; }
.card { background: var(--panel); border: 1px solid var(--line); padding: 14px 16px 8px; }
svg.plot { display: block; width: 100%; height: auto; font-family: var(--figures); }
.plot .ground { fill: #fff; stroke: var(--line); }
.plot path.better { fill: var(--better); }
.plot text.better { fill: var(--good); font-size: 12px; font-style: italic; }
.plot .grid { stroke: #ece8de; }
.plot .break { stroke: var(--soft); stroke-dasharray: 2 4; }
.plot text { font-size: 12.5px; fill: var(--ink); }
.plot .tick { fill: var(--soft); font-size: 12px; font-variant-numeric: tabular-nums; }
.plot .axis { fill: var(--soft); font-size: 13px; }
.plot .line { fill: none; stroke-width: 2; }
.plot .interval { stroke-width: 2; opacity: .45; }
.plot .ring { fill: #fff; stroke-width: 2; }
.plot .point { stroke: #fff; stroke-width: 1.5; cursor: default; }
.plot .point:hover, .plot .part:hover { filter: brightness(1.15); }
.plot :focus { outline: 2px solid var(--ink); }
.legend { font: 13px/1.7 var(--figures); color: var(--soft); margin: 6px 0 4px; max-width: none; }
.legend span { margin-right: 18px; white-space: nowrap; }
.legend i { display: inline-block; width: 11px; height: 11px; margin-right: 6px; border-radius: 2px; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(460px, 100%), 1fr)); gap: 22px; }
.triple { display: grid; grid-template-columns: repeat(3, 1fr); gap: 8px; }
.triple img { width: 100%; display: block; image-rendering: auto; }
.triple span { font: 12px var(--figures); color: var(--soft); }
.ramp { display: inline-block; width: 180px; height: 10px; vertical-align: middle; margin: 0 8px; }
details { border-bottom: 1px solid var(--line); padding: 6px 0; }
summary { cursor: pointer; font: 15px/1.5 var(--figures); }
summary b { font-weight: 600; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 4px 22px; font-size: 15.5px; }
dt { font: 600 13.5px/1.75 var(--figures); }
dd { margin: 0; max-width: 80ch; }
#tip { position: fixed; pointer-events: none; background: var(--ink); color: #fff; font: 12.5px/1.45 var(--figures);
  padding: 6px 10px; border-radius: 3px; white-space: pre-line; max-width: 340px; display: none; z-index: 9; }
@media (max-width: 760px) { body { padding: 24px 14px; } h1 { font-size: 32px; } dl { grid-template-columns: 1fr; }
  dd { margin-bottom: 10px; } .triple { grid-template-columns: 1fr; max-width: 480px; } }
@media print { body { max-width: none; padding: 0; } .wide { overflow: visible; } details > * { display: block; }
  figure, tr { break-inside: avoid; } }
)css";

/// Shows `data-tip` texts beside the pointer or the focused mark.
inline constexpr std::string_view kPageScript = R"js(
const tip = document.createElement('div');
tip.id = 'tip';
document.body.append(tip);
function show(mark, x, y) {
  tip.textContent = mark.dataset.tip;
  tip.style.display = 'block';
  tip.style.left = Math.min(x + 14, innerWidth - tip.offsetWidth - 8) + 'px';
  tip.style.top = Math.min(y + 14, innerHeight - tip.offsetHeight - 8) + 'px';
}
const hide = () => { tip.style.display = 'none'; };
document.addEventListener('pointermove', e => {
  const mark = e.target.closest('[data-tip]');
  if (mark) show(mark, e.clientX, e.clientY); else hide();
});
document.addEventListener('focusin', e => {
  const mark = e.target.closest('[data-tip]');
  if (!mark) return;
  const box = mark.getBoundingClientRect();
  show(mark, box.right, box.bottom);
});
document.addEventListener('focusout', hide);
)js";

}  // namespace vicus::report
