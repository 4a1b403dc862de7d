// rows: arrays of cells; a cell is text, a node, or {text, best}.
function table(target, head, rows) {
  const cell = c => {
    const td = element('td');
    if (c && typeof c === 'object' && !(c instanceof Node)) {
      td.append(c.node || c.text);
      if (c.best) td.className = 'best';
    } else td.append(c);
    return td;
  };
  target.replaceChildren(element('table', {}, element('thead', {}, element('tr', {}, ...head.map(h => element('th', {}, h)))),
                                 element('tbody', {}, ...rows.map(r => element('tr', {}, ...r.map(cell))))));
}

function named(method) {
  const span = element('span', {}, element('i', {class: 'dot', style: `background:${method.colour}`}), method.name);
  return span;
}

function costTable(target, methods) {
  const errors = methods[0].seconds_to.map(c => c.error);
  const reached = errors.map((_, i) => methods.filter(m => m.seconds_to[i].seconds !== null).length);
  const key = reached.lastIndexOf(Math.max(...reached));
  const cost = (m, i) => m.seconds_to[i].seconds ?? Infinity;
  const sorted = methods.filter(m => m.seconds_to.some(c => c.seconds !== null)).sort((a, b) => cost(a, key) - cost(b, key) || cost(a, 0) - cost(b, 0));
  const least = errors.map((_, i) => Math.min(...methods.map(m => cost(m, i))));
  table(target, ['method', ...errors.map(e => 'RMSE ' + e)], sorted.map(m => [named(m), ...m.seconds_to.map((c, i) => {
    if (c.seconds === null) return '–';
    const text = short(c.seconds) + ' s' + (c.seconds > least[i] ? ` (${(c.seconds / least[i]).toFixed(1)}×)` : '');
    return {node: c.extrapolated ? element('i', {}, text) : document.createTextNode(text), best: c.seconds === least[i]};
  })]));
}

// The dearest point that has several runs: least overhead, and its variance is known well.
function solid(method) { return [...method.points].reverse().find(p => p.runs > 1 && p.rmse > 0) || method.points[method.points.length - 1]; }

function efficiencyTable(target, methods) {
  const fixed = methods.filter(m => m.family === 'fixed');
  const independent = s => fixed.find(m => m.sampling === s && m.predicted_variance > 0);
  const rows = fixed.map(m => {
    const p = solid(m), samples = p.level;
    const variance = p.rmse * p.rmse * samples;
    // Several directions a camera ray are no independent samples, and what is filtered has a bias.
    const formula = m.directions === 1 && !m.name.startsWith('denoised') ? independent(m.sampling) : null;
    const predicted = formula ? formula.predicted_variance : 0;
    return {m, p, variance, formula, predicted, efficiency: 1 / (variance * p.wall_seconds / samples), expected: predicted ? 1 / (predicted * p.wall_seconds / samples) : 0};
  }).sort((a, b) => b.efficiency - a.efficiency);
  table(target, ['method', 'spp', 'variance × spp', 'of one sample, predicted', 'from', 'efficiency, 1/s', 'predicted', 'ratio'],
    rows.map(r => [named(r.m), r.p.level, short(r.variance, 4), r.predicted ? short(r.predicted, 4) : '–', r.formula ? r.formula.prediction : '–', {text: short(r.efficiency), best: r === rows[0]},
      r.expected ? short(r.expected) : '–', r.expected ? (r.efficiency / r.expected).toFixed(2) : '–']));
}

// A rule takes a least number of samples before it may stop: errors that they reach already cost the same.
function costNote(points, p) {
  const same = points.filter(q => q.level < p.level && q.rays > 0 && Math.abs(q.rays / p.rays - 1) < .02);
  return same.length ? `as many rays as ${Math.min(...same.map(q => q.level))}: the least that the rule takes reaches both` : '';
}

function adaptiveTable(target, methods) {
  const rows = methods.filter(m => m.family === 'adaptive').flatMap(m => m.points.map(p =>
    [named(m), p.level, short(p.error_claimed), short(p.rmse), percent(p.covered), signed(p.mean_error), short(p.wall_seconds) + ' s', p.runs, costNote(m.points, p)]));
  if (!rows.length) return;
  table(target, ['rule', 'error asked', 'claimed', 'reached (RMSE)', 'covered', 'mean error', 'time', 'runs', 'cost'], rows);
  target.prepend(element('h3', {}, 'Adaptive: error asked and error reached'));
}

function coverageTable(target, methods) {
  const levels = [...new Set(methods.flatMap(m => m.points.filter(p => p.covered >= 0).map(p => p.level)))].sort((a, b) => a - b);
  const at = (m, level) => m.points.find(p => p.level === level && p.covered >= 0);
  table(target, ['covered at spp', ...levels.map(l => short(l))], methods.map(m => [named(m), ...levels.map(l => at(m, l) ? percent(at(m, l).covered) : '–')]));
}

// Points [x, y, below the horizon] of the disk: their shares in rings of equal width.
function patternTable(target, patterns) {
  const rings = [0.25, 0.5, 0.75, 1.001];
  target.className = '';
  table(target, ['share of points', 'r < ¼', '¼ to ½', '½ to ¾', '¾ to 1', 'below the horizon'], patterns.map(({name, points}) => {
    const radii = points.map(([x, y]) => Math.hypot(x, y));
    return [name, ...rings.map((end, i) => percent(radii.filter(r => r < end && r >= (i ? rings[i - 1] : 0)).length / radii.length)), percent(points.filter(p => p[2]).length / points.length)];
  }));
}
