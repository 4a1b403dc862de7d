// Screen-space methods beside ray tracing: the floor of their error, and where tracing overtakes them.
function showScreen(methods) {
  const screen = methods.filter(m => m.family === 'ssao');
  if (!screen.length) { document.getElementById('screen').remove(); return; }
  const traced = methods.filter(m => m.family === 'fixed'), floors = screen.map(m => floorOf(m, traced));
  table(document.getElementById('screen-table'), ['method', 'floor (RMSE)', 'mean error', 'time', 'ray traced is as accurate after', 'rays cost'], floors.map(f =>
    [named(f.method), short(f.point.rmse), signed(f.point.mean_error), short(f.point.wall_seconds) + ' s', f.crossing ? `${short(f.crossing.seconds)} s, ${f.crossing.level} spp (${f.crossing.name})` : '–',
      f.crossing ? `${(f.crossing.seconds / f.point.wall_seconds).toFixed(2)}×` : '–']));
  if (!canPlot) { document.getElementById('screen-plot').remove(); return; }
  const envelope = cheapest(traced), last = Math.max(...envelope.map(p => p.x), ...screen.flatMap(m => m.points.map(p => p.wall_seconds)));
  const curves = [{name: 'ray traced, the cheapest method at each error', colour: '#1d2330', points: envelope}];
  for (const {method, point, crossing} of floors) {
    curves.push(curveOf(method, p => p.wall_seconds));
    curves.push({name: method.name + ', floor', colour: method.colour, dash: [1, 4], bare: true, points: [{x: point.wall_seconds, y: point.rmse}, {x: last, y: point.rmse}]});
    if (crossing) curves.push({name: 'crossing: ' + method.name, colour: method.colour, mark: 'crossRot', points: [{x: crossing.seconds, y: point.rmse,
      tip: [`${crossing.name}, ${crossing.level} spp`, `is as accurate (RMSE ${short(point.rmse)}) after ${short(crossing.seconds)} s,`, `${method.name} takes ${short(point.wall_seconds)} s`]}]});
  }
  plotCurves(document.getElementById('screen-plot'), curves, {x: 'seconds', y: 'RMSE', height: 400});
}

function floorOf(method, traced) {
  const point = method.points.reduce((a, b) => b.rmse < a.rmse ? b : a);
  let crossing = null;
  for (const t of traced) {
    const at = crossingOf(t.points, point.rmse);
    if (at && (!crossing || at.seconds < crossing.seconds)) crossing = {...at, name: t.name};
  }
  return {method, point, crossing};
}

// Points of all methods that no other beats in both time and error.
function cheapest(methods) {
  const all = methods.flatMap(m => m.points.filter(p => p.rmse > 0).map(p => ({x: p.wall_seconds, y: p.rmse, tip: [m.name, ...tipOf(m, p)]}))).sort((a, b) => a.x - b.x);
  const kept = [];
  for (const p of all) if (!kept.length || p.y < kept[kept.length - 1].y) kept.push(p);
  return kept;
}

// Where a curve reaches an error, by log-log interpolation.
function crossingOf(points, error) {
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
