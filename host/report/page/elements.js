'use strict';
// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), then shades of them.
const PALETTE = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5ea8', '#8c6d1f', '#1b7f8c', '#b2182b', '#444b59', '#6aa84f', '#a04f8f', '#4a6fb5', '#c98b5a', '#5f9ea0', '#999999', '#2f4b7c', '#a05195', '#665191'];

function element(tag, attributes = {}, ...children) {
  const made = ['svg', 'line'].includes(tag) ? document.createElementNS('http://www.w3.org/2000/svg', tag) : document.createElement(tag);
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

function signed(v, digits = 2) { return (v >= 0 ? '+' : '') + short(v, digits); }
function percent(v) { return v < 0 ? '–' : (100 * v).toFixed(1) + ' %'; }
const levelName = {fixed: 'spp', adaptive: 'error asked', ssao: 'samples'};
