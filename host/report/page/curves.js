// Error against cost: the plot, its legend, and the numbers behind it.
const axes = {
  seconds: {label: 'seconds', get: p => p.wall_seconds, fit: 'fit_seconds'},
  'device seconds': {label: 'seconds in kernels', get: p => p.device_seconds, fit: 'fit_device_seconds'},
  rays: {label: 'rays traced', get: p => p.rays, fit: 'fit_rays'},
};
const dashes = {fixed: null, adaptive: [7, 4], ssao: [2, 3]};

function tipOf(m, p) {
  return [`${levelName[m.family]} ${short(p.level, 4)}`, `RMSE ${short(p.rmse, 4)}, 95 % [${short(p.rmse_low)}, ${short(p.rmse_high)}]`,
    `${short(p.wall_seconds)} s, in kernels ${short(p.device_seconds)} s`, `${short(p.rays)} rays, ${p.runs} run${p.runs === 1 ? '' : 's'}`, `bias ${short(p.bias, 2)}`];
}

// Bands of less than three runs are those of Student's distribution with one degree of freedom: not worth drawing.
function curveOf(m, get, fit = null) {
  const from = m.points.find(p => get(p) > 0 && (m.family === 'adaptive' || p.level >= 4));
  return {name: m.name, colour: m.colour, dash: dashes[m.family], fit: fit && from ? {...fit, from: get(from)} : null,
    points: m.points.map(p => ({x: get(p), y: p.rmse, low: p.runs > 2 ? p.rmse_low : 0, high: p.rmse_high, tip: tipOf(m, p)}))};
}

function pointTable(target, methods) {
  table(target, ['method', 'level', 'runs', 'RMSE', '95 % from', 'to', 'seconds', 'in kernels', 'rays', 'bias', 'covered'], methods.flatMap(m => m.points.map(p =>
    [named(m), `${short(p.level, 4)} ${levelName[m.family]}`, p.runs, short(p.rmse, 4), short(p.rmse_low), short(p.rmse_high), short(p.wall_seconds), short(p.device_seconds), short(p.rays), short(p.bias, 2), percent(p.covered)])));
}

function slopeTable(target, methods) {
  const text = f => f ? `${f.slope.toFixed(2)} ± ${f.slope_error.toFixed(2)}` : '–';
  table(target, ['method', 'slope against seconds', 'against rays'], methods.filter(m => m.family !== 'ssao').map(m => [named(m), text(m.fit_seconds), text(m.fit_rays)]));
}

function showCurves(methods, size) {
  const plot = document.getElementById('curve-plot'), hidden = new Set();
  let axis = 'seconds', fits = false;
  const draw = (only = null) => {
    const {label, get, fit} = axes[axis];
    const shown = methods.filter(m => !hidden.has(m.name));
    plotCurves(plot, shown.map(m => curveOf(m, get, fits || only === m.name ? m.family !== 'ssao' && m[fit] : null)),
      {x: axis === 'rays' ? label : `${label} for ${size} pixels`, y: 'RMSE', lines: [0.05, 0.02, 0.01, 0.005], height: 560, only});
  };
  const legend = () => document.getElementById('curve-legend').replaceChildren(...methods.map(m => {
    const f = m[axes[axis].fit];
    const line = element('svg', {width: 26, height: 10}, element('line', {x1: 0, x2: 26, y1: 5, y2: 5, stroke: m.colour, 'stroke-width': 2.5, 'stroke-dasharray': (dashes[m.family] || ['none']).join(' ')}));
    return element('button', {class: hidden.has(m.name) ? 'off' : '', onclick: () => { hidden.has(m.name) ? hidden.delete(m.name) : hidden.add(m.name); legend(); draw(); },
      onpointerenter: () => hidden.has(m.name) || draw(m.name), onpointerleave: () => draw()}, line, m.name,
      element('span', {class: 'slope', title: 'fitted slope and its standard error'}, f && m.family !== 'ssao' ? `${f.slope.toFixed(2)} ± ${f.slope_error.toFixed(2)}` : ''));
  }));
  const tabs = element('span', {class: 'tabs'}, ...Object.keys(axes).map(name => element('button', {class: name === axis ? 'on' : '', onclick: e => {
    axis = name;
    for (const b of tabs.children) b.className = b === e.target ? 'on' : '';
    legend();
    draw();
  }}, name)));
  const only = (text, keep) => element('button', {class: 'plain', onclick: () => { hidden.clear(); methods.filter(m => !keep(m)).forEach(m => hidden.add(m.name)); legend(); draw(); }}, text);
  document.getElementById('curve-controls').append('against', tabs,
    element('label', {}, element('input', {type: 'checkbox', id: 'fits', onchange: e => { fits = e.target.checked; draw(); }}), ' fitted lines'),
    'show', only('all', () => true), only('traced', m => m.family !== 'ssao'), only('independent', m => m.sampler === 'independent'), only('none', () => false));
  legend();
  draw();
}
