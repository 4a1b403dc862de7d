// Pictures are 16-bit numbers: value = low + step * number.
function decode(picture) {
  const text = atob(picture.data), n = text.length / 2, values = new Float32Array(n);
  for (let i = 0; i < n; ++i) values[i] = picture.low + picture.step * (text.charCodeAt(2 * i) | text.charCodeAt(2 * i + 1) << 8);
  return values;
}

const encodeSrgb = v => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055);
// White for 0, red above, blue below.
function signedColour(t) {
  t = Math.max(-1, Math.min(1, t));
  const fade = 1 - Math.abs(t);
  return t > 0 ? [255 - 65 * (1 - fade), 255 * fade, 255 * fade] : [255 * fade, 255 * fade, 255 - 65 * (1 - fade)];
}
// Dark blue, teal, yellow for 0 to 1.
function heat(t) {
  t = Math.max(0, Math.min(1, t));
  return [255 * Math.min(1, 0.15 + 1.3 * t * t), 255 * (0.1 + 0.85 * t), 255 * (0.35 + 0.5 * Math.sin(Math.PI * t) - 0.3 * t)];
}

// One picture in a mode as an ImageData. scale: full colour of the errors.
function colourise(picture, mode, reference, exposure, scale) {
  const {width, height, values} = picture, out = new ImageData(width, height);
  let most = 1;
  if (mode === 'samples' && picture.samples) for (const v of picture.samples) most = Math.max(most, v);
  for (let i = 0; i < values.length; ++i) {
    let c;
    if (mode === 'signed') c = signedColour((values[i] - reference[i]) / scale);
    else if (mode === 'relative') c = heat(Math.abs(values[i] - reference[i]) / Math.max(reference[i], 0.01) / (4 * scale));
    else if (mode === 'samples' && picture.samples) c = heat(Math.log(1 + picture.samples[i]) / Math.log(1 + most));
    else { const v = encodeSrgb(Math.max(0, Math.min(1, values[i] * exposure))); c = [v, v, v]; }
    out.data.set([c[0], c[1], c[2], 255], 4 * i);
  }
  return out;
}

function canvasOf(data) {
  const canvas = element('canvas', {width: data.width, height: data.height});
  canvas.getContext('2d').putImageData(data, 0, 0);
  return canvas;
}

function makeViewer(gallery) {
  const pictures = gallery.map(p => ({...p, values: decode(p), samples: p.samples ? decode(p.samples) : null}));
  const reference = pictures.find(p => p.group === 'reference').values;
  const stage = document.getElementById('stage'), probe = document.getElementById('probe'), context = stage.getContext('2d');
  const state = {a: 0, b: Math.min(1, pictures.length - 1), mode: 'picture', layout: 'slider', exposure: 0, scale: 0.1, split: 0.5, zoom: 1, x: 0.5, y: 0.5};
  const {width, height} = pictures[0];
  stage.height = Math.round(stage.width * height / width);
  let drawn = [];

  const select = (key, values) => element('select', {id: 'pick-' + key, onchange: e => { state[key] = values ? e.target.value : +e.target.value; colour(); }},
    ...(values || pictures.map((p, i) => [i, `${p.name} — ${p.detail}`])).map(([v, text]) => element('option', {value: v}, text)));
  const range = (key, low, high, step) => element('input', {id: 'pick-' + key, type: 'range', min: low, max: high, step, value: state[key], oninput: e => { state[key] = +e.target.value; colour(); }});
  const pickA = select('a'), pickB = select('b');
  document.getElementById('viewer-controls').append(
    element('label', {}, 'left ', pickA), element('label', {}, 'right ', pickB),
    element('label', {}, 'show ', select('mode', [['picture', 'picture'], ['signed', 'signed error'], ['relative', 'relative error'], ['samples', 'samples a pixel']])),
    element('label', {}, 'as ', select('layout', [['slider', 'slider'], ['side', 'side by side']])),
    element('label', {}, 'exposure ', range('exposure', -3, 3, 0.1)), element('label', {}, 'error scale ', range('scale', 0.01, 0.5, 0.01)));

  function colour() {
    pickA.value = state.a;
    pickB.value = state.b;
    drawn = [state.a, state.b].map(i => canvasOf(colourise(pictures[i], state.mode, reference, 2 ** state.exposure, state.scale)));
    draw();
  }
  // The part of the picture that a pane of w x h canvas pixels shows.
  const panes = () => state.layout === 'side' ? [[0, stage.width / 2], [stage.width / 2, stage.width / 2]] : [[0, stage.width], [0, stage.width]];
  const scaleOf = w => Math.min(w / width, stage.height / height) * state.zoom;
  const toPicture = (px, py, [left, w]) => { const s = scaleOf(w); return [state.x * width + (px - left - w / 2) / s, state.y * height + (py - stage.height / 2) / s]; };
  function draw() {
    context.fillStyle = '#22262e';
    context.fillRect(0, 0, stage.width, stage.height);
    panes().forEach((pane, i) => {
      const [left, w] = pane, s = scaleOf(w);
      context.save();
      context.beginPath();
      if (state.layout === 'side') context.rect(left, 0, w, stage.height);
      else if (i === 0) context.rect(0, 0, stage.width * state.split, stage.height);
      else context.rect(stage.width * state.split, 0, stage.width, stage.height);
      context.clip();
      context.imageSmoothingEnabled = s < 2;
      context.drawImage(drawn[i], left + w / 2 - state.x * width * s, stage.height / 2 - state.y * height * s, width * s, height * s);
      const text = pictures[[state.a, state.b][i]].name;
      context.font = '600 17px system-ui, sans-serif';
      const length = context.measureText(text).width, at = i === 0 ? left + 12 : left + w - length - 12;
      context.fillStyle = 'rgba(15,20,30,.72)';
      context.fillRect(at - 7, 9, length + 14, 27);
      context.fillStyle = '#fff';
      context.fillText(text, at, 28);
      context.restore();
    });
    context.fillStyle = '#ffb000';
    const x = state.layout === 'side' ? stage.width / 2 : stage.width * state.split;
    context.fillRect(x - 1.5, 0, 3, stage.height);
    stage.dataset.view = `${state.zoom.toFixed(3)} ${state.split.toFixed(3)} ${state.x.toFixed(3)}`;
  }
  const at = e => { const r = stage.getBoundingClientRect(); return [(e.clientX - r.left) * stage.width / r.width, (e.clientY - r.top) * stage.height / r.height]; };
  let held = null;
  stage.addEventListener('pointerdown', e => {
    const [x] = at(e);
    held = state.layout === 'slider' && Math.abs(x - stage.width * state.split) < 18 ? 'split' : 'picture';
    stage.setPointerCapture(e.pointerId);
  });
  stage.addEventListener('pointerup', () => { held = null; });
  stage.addEventListener('pointermove', e => {
    const [x, y] = at(e), pane = panes()[state.layout === 'side' && x > stage.width / 2 ? 1 : 0], s = scaleOf(pane[1]);
    if (held === 'split') state.split = Math.max(0, Math.min(1, x / stage.width));
    else if (held === 'picture') {
      const k = stage.width / stage.getBoundingClientRect().width;
      state.x -= e.movementX * k / s / width;
      state.y -= e.movementY * k / s / height;
    }
    if (held) draw();
    const [u, v] = toPicture(x, y, pane).map(Math.floor);
    if (u < 0 || v < 0 || u >= width || v >= height) return;
    const i = v * width + u, A = pictures[state.a], B = pictures[state.b];
    const say = p => `${p.name}: ${p.values[i].toFixed(4)} (${(p.values[i] - reference[i] >= 0 ? '+' : '') + (p.values[i] - reference[i]).toFixed(4)})` + (p.samples ? `, ${Math.round(p.samples[i])} samples` : '');
    probe.textContent = `pixel ${u}, ${v} — reference ${reference[i].toFixed(4)} — ${say(A)} — ${say(B)}`;
  });
  stage.addEventListener('wheel', e => {
    e.preventDefault();
    const [x, y] = at(e), pane = panes()[state.layout === 'side' && x > stage.width / 2 ? 1 : 0];
    const [u, v] = toPicture(x, y, pane);
    state.zoom = Math.max(1, Math.min(64, state.zoom * Math.exp(-e.deltaY * 0.002)));
    const [u2, v2] = toPicture(x, y, pane);
    state.x += (u - u2) / width;
    state.y += (v - v2) / height;
    if (state.zoom === 1) { state.x = 0.5; state.y = 0.5; }
    draw();
  }, {passive: false});
  stage.addEventListener('dblclick', () => { Object.assign(state, {zoom: 1, x: 0.5, y: 0.5}); draw(); });

  const strips = document.getElementById('strips');
  for (const group of ['equal time', 'equal error']) {
    const of = pictures.map((p, i) => [p, i]).filter(([p]) => p.group === group);
    if (!of.length) continue;
    strips.append(element('h3', {}, group === 'equal time' ? 'In the same time' : 'To the same error'));
    strips.append(element('div', {class: 'strip'}, ...of.map(([p, i]) => element('figure', {onclick: () => { state.b = i; state.a = pictures.findIndex(q => q.group === 'reference'); colour(); stage.scrollIntoView({block: 'center', behavior: 'smooth'}); }},
      canvasOf(colourise(p, 'picture', reference, 1, 1)), element('figcaption', {}, element('b', {}, p.name), element('br'), p.detail)))));
  }
  const best = pictures.map((p, i) => [p, i]).filter(([p]) => p.group === 'equal time');
  if (best.length > 1) { state.a = best[0][1]; state.b = best[best.length - 1][1]; }
  colour();
}
