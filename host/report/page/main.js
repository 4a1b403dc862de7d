const study = JSON.parse(document.getElementById('data').textContent);
const methods = study.methods.filter(m => m.points.length);
methods.forEach((m, i) => { m.colour = PALETTE[i % PALETTE.length]; });
const fact = name => (study.facts.find(f => f.name === name) || {text: ''}).text;

document.title = 'What accuracy costs: ' + fact('scene');
document.getElementById('subtitle').textContent = `${fact('scene')} · ${fact('effect')} · ${fact('size')} pixels · ${fact('device')}`;

const axes = {
  seconds: {label: `seconds for ${fact('size')} pixels`, get: p => p.wall_seconds, fit: 'fit_seconds'},
  'device seconds': {label: 'seconds in kernels', get: p => p.device_seconds, fit: 'fit_seconds'},
  rays: {label: 'rays traced', get: p => p.rays, fit: 'fit_rays'},
};
let axis = 'seconds';
const hidden = new Set();

function drawCurves() {
  const {label, get, fit} = axes[axis];
  const curves = methods.filter(m => !hidden.has(m.name)).map(m => ({
    name: m.name, colour: m.colour, dash: m.family === 'adaptive' ? '7 5' : m.family === 'ssao' ? '2 4' : null,
    points: m.points.map(p => ({x: get(p), y: p.rmse, low: p.runs > 2 ? p.rmse_low : 0, high: p.rmse_high,
      tip: `${m.family === 'adaptive' ? 'error asked' : m.family === 'ssao' ? 'samples' : 'spp'} ${short(p.level)}\nRMSE ${short(p.rmse, 4)}  [${short(p.rmse_low)}, ${short(p.rmse_high)}]\n` +
           `${short(p.wall_seconds)} s, in kernels ${short(p.device_seconds)} s\n${short(p.rays)} rays, ${p.runs} runs\nbias ${short(p.bias, 2)}`})),
  }));
  chart(document.getElementById('curve-plot'), curves, {x: label, y: 'RMSE', lines: [0.05, 0.02, 0.01, 0.005]});
  document.getElementById('curve-legend').replaceChildren(...methods.map(m => {
    const f = m[fit];
    const line = element('svg', {width: 26, height: 10}, element('line', {x1: 0, x2: 26, y1: 5, y2: 5, stroke: m.colour, 'stroke-width': 2.5, 'stroke-dasharray': m.family === 'adaptive' ? '7 4' : m.family === 'ssao' ? '2 3' : 'none'}));
    const button = element('button', {onclick: () => { hidden.has(m.name) ? hidden.delete(m.name) : hidden.add(m.name); drawCurves(); }}, line, m.name,
      element('span', {class: 'slope', title: 'fitted slope and its standard error'}, f && m.family !== 'ssao' ? `${f.slope.toFixed(2)} ± ${f.slope_error.toFixed(2)}` : ''));
    if (hidden.has(m.name)) button.className = 'off';
    return button;
  }));
}

document.getElementById('curve-controls').append(element('span', {}, 'against'), element('span', {class: 'tabs'}, ...Object.keys(axes).map(name =>
  element('button', {class: name === axis ? 'on' : '', onclick: e => {
    axis = name;
    for (const b of e.target.parentNode.children) b.className = b === e.target ? 'on' : '';
    drawCurves();
  }}, name))));
drawCurves();
costTable(document.getElementById('cost-table'), methods);
efficiencyTable(document.getElementById('efficiency-table'), methods);
chart(document.getElementById('coverage-plot'), methods.filter(m => m.family === 'fixed' && m.directions === 1).map(m => ({
  name: m.name, colour: m.colour, points: m.points.filter(p => p.covered >= 0).map(p => ({x: p.level, y: p.covered, tip: `spp ${p.level}\ncovered ${percent(p.covered)}`}))})),
  {x: 'spp', y: 'pixels inside their 95 % interval', yRange: [0, 1], height: 340, lines: [0.95]});
adaptiveTable(document.getElementById('adaptive-table'), methods);
document.getElementById('screen-radius').textContent = fact('screen-space radius');
screenTable(document.getElementById('screen-table'), document.getElementById('screen'), methods);
if (study.gallery && study.gallery.length) makeViewer(study.gallery);
else document.getElementById('pictures').remove();
for (const p of study.patterns || [])
  document.getElementById('pattern-plots').append(element('figure', {}, scatter(p.points), element('figcaption', {}, p.name)));
if (!(study.patterns || []).length) document.getElementById('patterns').remove();
table(document.getElementById('fact-table'), ['', ''], [...study.facts.map(f => [f.name, f.text]),
  ['reference', `${study.reference.description}; ${study.reference.spp} samples a pixel, ${short(study.reference.seconds)} s, standard error ${short(study.reference.standard_error)} (subtracted)`],
  ['runs made', percent(study.progress) + ' of those planned']]);

// The one sentence: what the best method saves at the smallest error that it and the plainest methods reach.
for (let i = methods[0].seconds_to.length - 1; i >= 0; --i) {
  const fixed = methods.filter(m => m.family === 'fixed' && m.seconds_to[i].seconds !== null);
  if (fixed.length < 2) continue;
  fixed.sort((a, b) => a.seconds_to[i].seconds - b.seconds_to[i].seconds);
  const best = fixed[0], worst = fixed[fixed.length - 1], ratio = worst.seconds_to[i].seconds / best.seconds_to[i].seconds;
  document.getElementById('summary').textContent = `An error of ${best.seconds_to[i].error} costs ${short(best.seconds_to[i].seconds)} s with ${best.name} and ${short(worst.seconds_to[i].seconds)} s with ${worst.name}: ${ratio.toFixed(1)} times as much.`;
  break;
}
