const study = JSON.parse(document.getElementById('data').textContent);
const methods = study.methods.filter(m => m.points.length);
methods.forEach((m, i) => { m.colour = PALETTE[i % PALETTE.length]; });
const fact = name => (study.facts.find(f => f.name === name) || {text: ''}).text;
const byId = id => document.getElementById(id);

document.title = 'What accuracy costs: ' + fact('scene');
byId('subtitle').textContent = `${fact('scene')} · ${fact('effect')} · ${fact('size')} pixels · ${fact('device')}`;

// Tables stand in for the plots where there is no library to draw them.
pointTable(byId('point-table'), methods);
if (canPlot) {
  byId('no-plots').remove();
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  showCurves(methods, fact('size'));
} else {
  byId('no-plots').hidden = false;
  document.querySelectorAll('.plots-only').forEach(e => e.remove());
  byId('curve-figure').replaceChildren(element('div', {id: 'slope-table'}));
  slopeTable(byId('slope-table'), methods);
  byId('point-details').open = true;
}
costTable(byId('cost-table'), methods);
efficiencyTable(byId('efficiency-table'), methods);
const fixed = methods.filter(m => m.family === 'fixed' && m.directions === 1 && m.points.some(p => p.covered >= 0));
if (canPlot)
  plotCurves(byId('coverage-plot'), fixed.map(m => ({name: m.name, colour: m.colour, points: m.points.filter(p => p.covered >= 0).map(p =>
    ({x: p.level, y: p.covered, tip: [`${short(p.level)} spp`, `covered ${percent(p.covered)}`]}))})), {x: 'samples a pixel', y: 'pixels inside their 95 % interval', share: true, height: 330, lines: [0.95], powersOfTwo: true});
else coverageTable(byId('coverage-plot'), fixed);
adaptiveTable(byId('adaptive-table'), methods);
byId('screen-radius').textContent = fact('screen-space radius');
showScreen(methods);
if (study.gallery && study.gallery.length) makeViewer(study.gallery);
else byId('pictures').remove();
for (const p of study.patterns || []) {
  const figure = element('figure', {}, element('figcaption', {}, p.name));
  byId('pattern-plots').append(figure);
  if (canPlot) { plotDirections(figure, p.name, p.points); figure.append(figure.firstChild); }
}
if (!(study.patterns || []).length) byId('patterns').remove();
else if (!canPlot) patternTable(byId('pattern-plots'), study.patterns);
table(byId('fact-table'), ['', ''], [...study.facts.map(f => [f.name, f.text]),
  ['reference', `${study.reference.description}; ${study.reference.spp} samples a pixel, ${short(study.reference.seconds)} s, standard error ${short(study.reference.standard_error)} (subtracted)`],
  ['runs made', percent(study.progress) + ' of those planned'],
  ['plots', canPlot ? `Chart.js ${Chart.version}` : 'none: made without Chart.js']]);
if (study.plot_library) byId('licence').textContent = study.plot_library;
else byId('licence-details').remove();

// The one sentence: what the best method saves at the smallest error that plain independent samples reach.
const plain = methods.find(m => m.family === 'fixed' && m.sampler === 'independent') || methods[0];
for (let i = plain.seconds_to.length - 1; i >= 0; --i) {
  const {error, seconds} = plain.seconds_to[i];
  if (seconds === null) continue;
  const cost = m => m.seconds_to[i].seconds ?? Infinity, best = methods.filter(m => m.family === 'fixed').reduce((a, b) => cost(b) < cost(a) ? b : a);
  byId('summary').textContent = `A root mean square error of ${error} costs ${short(cost(best))} s with ${best.name}` + (best === plain ? '.' : `, and ${(seconds / cost(best)).toFixed(1)} times as much with ${plain.name}.`);
  break;
}
