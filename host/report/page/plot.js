'use strict';
// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), then shades of them.
const PALETTE = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5ea8', '#8c6d1f', '#1b7f8c', '#b2182b', '#444b59', '#6aa84f', '#a04f8f', '#4a6fb5', '#c98b5a', '#5f9ea0', '#999999'];

function element(tag, attributes = {}, ...children) {
  const svg = ['svg', 'path', 'circle', 'line', 'text', 'g', 'rect', 'polygon'].includes(tag);
  const made = svg ? document.createElementNS('http://www.w3.org/2000/svg', tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

// 0.00123 -> "0.00123", 1234567 -> "1.23M"
function short(v, digits = 3) {
  if (v === null || v === undefined || !isFinite(v)) return '–';
  if (v === 0) return '0';
  for (const [scale, unit] of [[1e9, 'G'], [1e6, 'M'], [1e4, 'k']])
    if (Math.abs(v) >= scale) return +(v / (unit === 'k' ? 1e3 : scale)).toPrecision(digits) + unit;
  return String(+v.toPrecision(digits));
}

function percent(v) { return v < 0 ? '–' : (100 * v).toFixed(1) + ' %'; }

// A logarithmic axis' labelled values in [low, high]: powers of ten, with 2 and 5 between them if there are few.
function logTicks(low, high) {
  const ticks = [];
  const few = Math.log10(high / low) < 2.5;
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const m of few ? [1, 2, 5] : [1]) {
      const v = m * 10 ** e;
      if (v >= low * 0.999 && v <= high * 1.001) ticks.push(v);
    }
  return ticks;
}

// A chart of curves {name, colour, dash, points: [{x, y, low, high, tip}], line: {slope, intercept}} on axes that are logarithmic or,
// for y, a fixed linear range. Points without positive coordinates are left out.
function chart(target, curves, {x, y, yRange = null, height = 460, lines = []}) {
  const width = 820, left = 66, right = 16, top = 14, bottom = 48;
  const shown = curves.map(c => ({...c, points: c.points.filter(p => p.x > 0 && (yRange || p.y > 0))})).filter(c => c.points.length);
  target.replaceChildren();
  if (!shown.length) { target.append('Nothing to show.'); return; }
  const xs = shown.flatMap(c => c.points.map(p => p.x)), ys = shown.flatMap(c => c.points.map(p => p.y));
  const xLow = Math.min(...xs) / 1.25, xHigh = Math.max(...xs) * 1.25;
  const yLow = yRange ? yRange[0] : Math.min(...ys) / 1.25, yHigh = yRange ? yRange[1] : Math.max(...ys) * 1.25;
  const px = v => left + (width - left - right) * Math.log(v / xLow) / Math.log(xHigh / xLow);
  const part = v => yRange ? (v - yLow) / (yHigh - yLow) : Math.log(v / yLow) / Math.log(yHigh / yLow);
  const py = v => Math.min(height - bottom, Math.max(top, height - bottom - (height - top - bottom) * part(v)));
  const svg = element('svg', {viewBox: `0 0 ${width} ${height}`, width: '100%', role: 'img'});
  for (const v of logTicks(xLow, xHigh)) {
    svg.append(element('line', {x1: px(v), x2: px(v), y1: top, y2: height - bottom, stroke: '#e8ebf0'}));
    svg.append(element('text', {x: px(v), y: height - bottom + 18, 'text-anchor': 'middle', 'font-size': 12}, short(v)));
  }
  const yTicks = yRange ? [0, 1, 2, 3, 4, 5].map(i => yLow + (yHigh - yLow) * i / 5) : logTicks(yLow, yHigh);
  for (const v of yTicks) {
    svg.append(element('line', {x1: left, x2: width - right, y1: py(v), y2: py(v), stroke: '#e8ebf0'}));
    svg.append(element('text', {x: left - 8, y: py(v) + 4, 'text-anchor': 'end', 'font-size': 12}, yRange ? (100 * v).toFixed(0) + ' %' : short(v)));
  }
  for (const v of lines) {
    if (v < yLow || v > yHigh) continue;
    svg.append(element('line', {x1: left, x2: width - right, y1: py(v), y2: py(v), stroke: '#8a93a5', 'stroke-dasharray': '2 4'}));
  }
  svg.append(element('text', {x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle', 'font-size': 13}, x));
  svg.append(element('text', {transform: `translate(16 ${(top + height - bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle', 'font-size': 13}, y));
  const tip = element('div', {class: 'tip', hidden: ''});
  for (const c of shown) {
    const g = element('g', {'data-curve': c.name});
    const banded = c.points.filter(p => p.low > 0 && p.high > 0);
    if (banded.length > 1)
      g.append(element('polygon', {fill: c.colour, opacity: 0.16, points: [...banded.map(p => `${px(p.x)},${py(p.high)}`), ...banded.reverse().map(p => `${px(p.x)},${py(p.low)}`)].join(' ')}));
    g.append(element('path', {d: 'M' + c.points.map(p => `${px(p.x).toFixed(1)} ${py(p.y).toFixed(1)}`).join('L'), fill: 'none', stroke: c.colour, 'stroke-width': 1.8, 'stroke-dasharray': c.dash || 'none', 'stroke-linejoin': 'round'}));
    for (const p of c.points) {
      const dot = element('circle', {cx: px(p.x), cy: py(p.y), r: 3.2, fill: c.colour, stroke: '#fff', 'stroke-width': 0.8});
      const hit = element('circle', {cx: px(p.x), cy: py(p.y), r: 9, fill: 'transparent', class: 'hit',
        onpointerenter: () => {
          dot.setAttribute('r', 5);
          tip.textContent = c.name + '\n' + p.tip;
          tip.hidden = false;
          const scale = svg.getBoundingClientRect().width / width;
          tip.style.left = Math.min(px(p.x) * scale + 14, svg.getBoundingClientRect().width - 190) + 'px';
          tip.style.top = py(p.y) * scale + 12 + 'px';
        },
        onpointerleave: () => { dot.setAttribute('r', 3.2); tip.hidden = true; }});
      g.append(dot, hit);
    }
    svg.append(g);
  }
  target.style.position = 'relative';
  target.append(svg, tip);
}

// Points in the disk of radius 1.
function scatter(points) {
  const svg = element('svg', {viewBox: '-1.08 -1.08 2.16 2.16', width: '100%'});
  svg.append(element('circle', {cx: 0, cy: 0, r: 1, fill: '#f4f6fa', stroke: '#c9d0db', 'stroke-width': 0.012}));
  for (const [x, y] of points) svg.append(element('circle', {cx: x, cy: -y, r: 0.018, fill: '#0b5fa5', opacity: 0.8}));
  return svg;
}
