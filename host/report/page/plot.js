// Plots by Chart.js (version 3), which the page carries if it was there when the page was made.
const canPlot = typeof Chart === 'function';

// Labelled values of a logarithmic axis in [low, high]: powers of ten, with 2 and 5 between them if there are few.
function logTicks(low, high) {
  const ticks = [];
  const few = Math.log10(high / low) < 2.5;
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const m of few ? [1, 2, 5] : [1]) {
      const v = +`${m}e${e}`;
      if (v >= low * 0.999 && v <= high * 1.001) ticks.push(v);
    }
  return ticks;
}

const GRID = '#e8ebf0', INK = '#3a4252';

function logAxis(title, values, powersOfTwo = false) {
  const low = Math.min(...values) / 1.25, high = Math.max(...values) * 1.25, ticks = powersOfTwo ? [...new Set(values)] : logTicks(low, high);
  return {type: 'logarithmic', min: low, max: high, title: {display: true, text: title, color: INK, font: {size: 13}}, grid: {color: GRID},
    afterBuildTicks: axis => { axis.ticks = ticks.map(value => ({value})); }, ticks: {callback: v => short(v, 4), color: INK, autoSkip: false, maxRotation: 0}};
}

function shareAxis(title) {
  return {type: 'linear', min: 0, max: 1, title: {display: true, text: title, color: INK, font: {size: 13}}, grid: {color: GRID}, ticks: {callback: v => (100 * v).toFixed(0) + ' %', stepSize: 0.2, color: INK}};
}

const faded = (colour, alpha) => colour + Math.round(255 * alpha).toString(16).padStart(2, '0');

// What a curve {name, colour, dash, points: [{x, y, low, high, tip: [lines]}], fit: {slope, intercept, from}, mark} is for Chart.js: its band, its
// fitted line (of the logarithms), and itself. mark: a point style, for points without a line; bare: a line without points; weak: steps back.
const silent = {pointRadius: 0, pointHitRadius: 0, pointHoverRadius: 0};
function datasetsOf(curve, log, weak) {
  const points = curve.points.filter(p => p.x > 0 && (!log || p.y > 0)), colour = weak ? faded(curve.colour, 0.15) : curve.colour, sets = [];
  if (!points.length) return sets;
    const banded = weak ? [] : points.filter(p => p.low > 0 && p.high > 0);
  sets.push({label: curve.name, curve: curve.name, data: points, borderColor: colour, backgroundColor: colour, borderWidth: 1.8, borderDash: curve.dash || [], showLine: !curve.mark,
    pointStyle: curve.mark || 'circle', pointRadius: curve.mark ? 7 : 3, pointBorderColor: curve.mark ? colour : weak ? 'transparent' : '#ffffff', pointBorderWidth: curve.mark ? 2 : 0.8, pointHitRadius: 7, pointHoverRadius: curve.mark ? 9 : 5.5, order: 1, ...(curve.bare ? silent : {})});
  if (curve.fit && !weak) {
    const last = points[points.length - 1].x, at = x => ({x, y: 10 ** (curve.fit.intercept + curve.fit.slope * Math.log10(x))});
    sets.push({label: curve.name + ', fitted', fit: true, data: [at(curve.fit.from), at(last)], borderColor: '#1d2330', borderWidth: 1.2, borderDash: [2, 2], ...silent, order: 0});
  }
  if (banded.length > 1)
    sets.push({label: curve.name + ', 95 %', band: true, data: [...banded.map(p => ({x: p.x, y: p.high})), ...banded.reverse().map(p => ({x: p.x, y: p.low}))], backgroundColor: faded(curve.colour, 0.18),
      borderWidth: 0, fill: 'shape', ...silent, order: 3});
  return sets;
}

const tooltip = {displayColors: false, backgroundColor: '#16233a', padding: 9, bodyFont: {size: 12.5}, titleFont: {size: 13}, filter: item => Boolean(item.raw.tip),
  callbacks: {title: items => items.length ? items[0].dataset.label : '', label: item => item.raw.tip}};

// A canvas in `target` with a chart on it; what was there before goes.
function chartIn(target, height, label, config) {
  const before = target.querySelector('canvas');
  if (before) Chart.getChart(before).destroy();
  const canvas = element('canvas', {role: 'img', 'aria-label': label});
  target.replaceChildren(element('div', {class: 'plot', style: `height:${height}px`}, canvas));
  return new Chart(canvas, config);
}

// Curves on logarithmic axes, or, if `share`, with a linear vertical one from 0 to 1. lines: values marked across. only: the name of the curve that stands
// out, if any does. powersOfTwo: a label at every x.
function plotCurves(target, curves, {x, y, share = false, height = 480, lines = [], only = null, powersOfTwo = false}) {
  const seen = curves.flatMap(c => c.points.filter(p => p.x > 0 && (share || p.y > 0)));
  if (!seen.length) { target.replaceChildren('Nothing to show.'); return; }
  const scales = {x: logAxis(x, seen.map(p => p.x), powersOfTwo), y: share ? shareAxis(y) : logAxis(y, seen.map(p => p.y))};
  const marks = lines.filter(v => v > scales.y.min && v < scales.y.max).map(v => ({label: String(v), mark: true, data: [{x: scales.x.min, y: v}, {x: scales.x.max, y: v}],
    borderColor: '#8a93a5', borderWidth: 1, borderDash: [2, 4], pointRadius: 0, pointHitRadius: 0, order: 4}));
  chartIn(target, height, `${y} against ${x}`, {type: 'line', data: {datasets: [...curves.flatMap(c => datasetsOf(c, !share, only && only !== c.name)), ...marks]},
    options: {animation: false, maintainAspectRatio: false, scales, interaction: {mode: 'nearest', intersect: true}, plugins: {legend: {display: false}, tooltip}}});
}

// Directions [x, y, below the horizon] in the disk of radius 1, seen from above.
function plotDirections(target, name, points) {
  const circle = [...Array(97).keys()].map(i => ({x: Math.cos(i * Math.PI / 48), y: Math.sin(i * Math.PI / 48)}));
  const dots = (below, colour) => ({label: below ? 'below the horizon' : 'directions', data: points.filter(p => Boolean(p[2]) === below).map(([x, y]) => ({x, y})), backgroundColor: colour, pointRadius: 2, pointHoverRadius: 2, order: 1});
  const axis = {type: 'linear', min: -1.06, max: 1.06, display: false};
  chartIn(target.appendChild(element('div')), 196, name, {type: 'scatter',
    data: {datasets: [dots(false, '#0b5fa5'), dots(true, '#e08a00'), {label: 'horizon', data: circle, showLine: true, fill: 'shape', backgroundColor: '#f4f6fa', borderColor: '#c9d0db', borderWidth: 1, pointRadius: 0, pointHitRadius: 0, order: 2}]},
    options: {animation: false, maintainAspectRatio: false, events: [], scales: {x: axis, y: axis}, plugins: {legend: {display: false}}}});
}
