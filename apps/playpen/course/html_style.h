// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Style and script of the HTML report. They are part of each page, so that a page can be moved or
/// sent alone.
namespace playpen::course {

inline constexpr const char* kReportStyle = R"css(
:root { color-scheme: light dark; --ink: #1f2328; --faint: #59636e; --page: #ffffff;
  --panel: #f6f8fa; --line: #d1d9e0; --link: #0550ae; --good: #116329; --bad: #b3261e;
  --mark: #7a4d00; --mark-back: #fff3d6; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e9ed; --faint: #9aa4af; --page: #14171b; --panel: #1d2127; --line: #383f48;
    --link: #79b8ff; --good: #6fce85; --bad: #ff8f87; --mark: #ffd27a; --mark-back: #3a2e12; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1300px; padding: 1rem 1.25rem 3rem; color: var(--ink);
  background: var(--page); font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: .5rem 0; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; }
h3 { font-size: 1rem; margin: 1.25rem 0 .5rem; }
a { color: var(--link); }
a:focus-visible, button:focus-visible, [tabindex]:focus-visible {
  outline: 3px solid var(--link); outline-offset: 2px; }
.faint, figcaption, caption { color: var(--faint); }
.good { color: var(--good); } .bad { color: var(--bad); }
.facts { display: flex; flex-wrap: wrap; gap: .25rem 2rem; margin: .5rem 0; padding: 0;
  align-items: baseline; list-style: none; }
.facts b { font-size: 1.25rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding-bottom: .35rem; }
th, td { padding: .35rem .6rem; border-bottom: 1px solid var(--line); text-align: left;
  vertical-align: top; }
th { background: var(--panel); white-space: nowrap; }
.number { text-align: right; }
.name, .person { overflow-wrap: anywhere; min-width: 7rem; }
.reason { overflow-wrap: anywhere; min-width: 12rem; }
.nowrap { white-space: nowrap; }
th button { all: unset; cursor: pointer; font-weight: 600; }
th button::after { content: " \2195"; color: var(--faint); }
th[aria-sort=ascending] button::after { content: " \2191"; color: var(--ink); }
th[aria-sort=descending] button::after { content: " \2193"; color: var(--ink); }
.like { padding: 0 .4rem; border-radius: .6rem; color: var(--mark); background: var(--mark-back);
  display: inline-block; max-width: 14rem; overflow: hidden; text-overflow: ellipsis;
  white-space: nowrap; }
.pictures { display: grid; gap: 1.25rem;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 20rem), 1fr)); }
figure { margin: 0; max-width: 36rem; }
.charts { max-width: 75rem; margin-bottom: 1.25rem; }
.charts img { min-width: 60rem; }
img { display: block; width: 100%; height: auto; border: 1px solid var(--line);
  background: #ffffff; }
pre { margin: .25rem 0; padding: .75rem; overflow: auto; max-height: 30rem;
  white-space: pre-wrap; overflow-wrap: anywhere;
  background: var(--panel); border: 1px solid var(--line); border-radius: .4rem;
  font: .85rem/1.45 ui-monospace, monospace; }
@media (max-width: 640px) {
  body { padding: .75rem .75rem 2rem; }
  .ranking thead tr { display: flex; flex-wrap: wrap; }
  .ranking th { border: 0; padding: .25rem .5rem; }
  .ranking tbody tr { display: grid; grid-template-columns: 2.5rem 1fr auto auto;
    border-bottom: 1px solid var(--line); padding: .35rem 0; }
  .ranking td { border: 0; padding: .1rem .4rem; }
  .ranking td.name, .ranking td.person { min-width: 0; }
  .ranking td.number::after, .ranking td.passed::after { color: var(--faint); font-size: .8rem; }
  .ranking td.points::after { content: " points"; } .ranking td.passed::after { content: " runs"; }
  .ranking td.person { grid-column: 2 / -1; grid-row: 2; color: var(--faint); }
  .ranking td.state, .ranking td.reason, .ranking td.alike { grid-column: 2 / -1; }
  .ranking td:empty, .ranking td.ok { display: none; } }
@media print { body { max-width: none; } pre { max-height: none; }
  .charts img { min-width: 0; } }
)css";

/// Sorts the ranking by a column whose button was pressed; once more: the other way round.
inline constexpr const char* kSortScript = R"js(
const table = document.querySelector('.ranking');
for (const button of table.querySelectorAll('th button')) {
  button.addEventListener('click', () => {
    const heading = button.parentElement, column = heading.cellIndex;
    const numeric = 'numeric' in heading.dataset;
    const first = numeric && column > 0 ? 'descending' : 'ascending';
    const other = first === 'ascending' ? 'descending' : 'ascending';
    const order = heading.getAttribute('aria-sort') === first ? other : first;
    for (const th of table.querySelectorAll('th')) th.removeAttribute('aria-sort');
    heading.setAttribute('aria-sort', order);
    const sign = order === 'ascending' ? 1 : -1;
    const value = row => row.cells[column].dataset.value ?? row.cells[column].textContent;
    const compare = (a, b) => numeric ? value(a) - value(b)
      : value(a).localeCompare(value(b), undefined, {numeric: true});
    const body = table.tBodies[0];
    body.append(...[...body.rows].sort((a, b) => sign * compare(a, b)));
  });
}
)js";

}  // namespace playpen::course
