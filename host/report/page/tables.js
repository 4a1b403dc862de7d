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
  const fixed = methods.filter(m => m.family === 'fixed' && m.points.length);
  const independent = s => fixed.find(m => m.sampling === s && m.predicted_variance > 0);
  const rows = fixed.map(m => {
    const p = solid(m), samples = p.level;
    const variance = p.rmse * p.rmse * samples;
    const formula = independent(m.sampling);
    const predicted = formula && m.directions === 1 ? formula.predicted_variance : 0;
    return {m, p, variance, predicted, efficiency: 1 / (variance * p.wall_seconds / samples), expected: predicted ? 1 / (predicted * p.wall_seconds / samples) : 0};
  }).sort((a, b) => b.efficiency - a.efficiency);
  table(target, ['method', 'spp', 'variance × spp', 'of one sample, by formula', 'efficiency, 1/s', 'predicted', 'ratio'],
    rows.map(r => [named(r.m), r.p.level, short(r.variance, 4), r.predicted ? short(r.predicted, 4) : '–', {text: short(r.efficiency), best: r === rows[0]},
      r.expected ? short(r.expected) : '–', r.expected ? (r.efficiency / r.expected).toFixed(2) : '–']));
}

function adaptiveTable(target, methods) {
  const rows = methods.filter(m => m.family === 'adaptive').flatMap(m => m.points.map(p =>
    [named(m), p.level, short(p.error_claimed), short(p.rmse), percent(p.covered), (p.mean_error >= 0 ? '+' : '') + short(p.mean_error, 2), short(p.wall_seconds) + ' s']));
  if (!rows.length) return;
  table(target, ['rule', 'error asked', 'claimed', 'reached (RMSE)', 'covered', 'mean error', 'time'], rows);
  target.prepend(element('h3', {}, 'Adaptive: error asked and error reached'));
}

function screenTable(target, section, methods) {
  const screen = methods.filter(m => m.family === 'ssao' && m.points.length);
  if (!screen.length) { section.remove(); return; }
  const traced = methods.filter(m => m.family === 'fixed' && m.points.length);
  table(target, ['method', 'floor (RMSE)', 'mean error', 'time', 'ray traced is as accurate after'], screen.map(m => {
    const p = m.points.reduce((a, b) => b.rmse < a.rmse ? b : a);
    let best = null;
    for (const t of traced) {
      const q = crossing(t.points, p.rmse);
      if (q && (!best || q.seconds < best.seconds)) best = {...q, name: t.name};
    }
    return [named(m), short(p.rmse), (p.mean_error >= 0 ? '+' : '') + short(p.mean_error, 2), short(p.wall_seconds) + ' s',
            best ? `${short(best.seconds)} s, ${short(best.level)} spp (${best.name})` : '–'];
  }));
}

// Where a curve reaches an error, by log-log interpolation.
function crossing(points, error) {
  for (let i = 0; i < points.length; ++i) {
    const p = points[i];
    if (p.rmse > error) continue;
    if (i === 0) return {seconds: p.wall_seconds, level: p.level};
    const q = points[i - 1], along = Math.log(q.rmse / error) / Math.log(q.rmse / p.rmse);
    const between = (a, b) => a * (b / a) ** along;
    return {seconds: between(q.wall_seconds, p.wall_seconds), level: Math.round(between(q.level, p.level))};
  }
  return null;
}
