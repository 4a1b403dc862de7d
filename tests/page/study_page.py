"""The page of a study, as a browser shows it: no error, every figure drawn, slider and zoom work, nothing fetched; and tables instead of plots.

study_page.py NOOK [PAGE]: makes a small study with NOOK, or takes PAGE, and opens it in a headless Chromium from file://.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Common to both checks: what went wrong, what was fetched, and what the page says once `look` has looked.
FRAME = r"""
window.problems = [];
window.addEventListener('error', e => window.problems.push(String(e.message)));
for (const name of ['error', 'warn']) console[name] = (...what) => window.problems.push(what.join(' '));
window.addEventListener('load', () => setTimeout(async () => {
  const out = {};
  try { await look(out); } catch (e) { window.problems.push(e.stack); }
  out.problems = window.problems;
  out.fetched = performance.getEntriesByType('resource').map(r => r.name).filter(n => !n.startsWith('data:'));
  out.wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  document.body.append(Object.assign(document.createElement('pre'), {id: 'check', textContent: JSON.stringify(out)}));
}, 300));
const rowsOf = id => document.querySelectorAll('#' + id + ' tbody tr').length;
const wait = () => new Promise(done => setTimeout(done, 100));
"""

PLOTTED = r"""
async function look(out) {
  const stage = document.getElementById('stage'), box = stage.getBoundingClientRect();
  const at = (x, y) => ({clientX: box.left + x * box.width, clientY: box.top + y * box.height, bubbles: true, cancelable: true, pointerId: 1});
  const lit = () => new Set(stage.getContext('2d').getImageData(0, 0, stage.width, stage.height).data).size;
  stage.setPointerCapture = () => {};  // synthetic events have no pointer to capture
  Object.assign(out, {start: stage.dataset.view, shades: lit()});
  stage.dispatchEvent(new WheelEvent('wheel', {...at(.3, .4), deltaY: -600}));
  out.zoomed = stage.dataset.view;
  stage.dispatchEvent(new PointerEvent('pointerdown', at(.5, .5)));
  stage.dispatchEvent(new PointerEvent('pointermove', at(.25, .5)));
  stage.dispatchEvent(new PointerEvent('pointerup', at(.25, .5)));
  out.split = stage.dataset.view;
  out.probe = document.getElementById('probe').textContent;
  out.modes = {};
  for (const mode of ['signed', 'relative', 'samples', 'picture']) {
    const pick = document.getElementById('pick-mode');
    pick.value = mode;
    pick.dispatchEvent(new Event('change'));
    out.modes[mode] = lit();
  }
  const pixels = () => stage.toDataURL();
  const set = (id, value, type) => { const e = document.getElementById(id); e.value = value; e.dispatchEvent(new Event(type)); };
  const plain = pixels();
  set('pick-exposure', '2', 'input');
  out.exposed = pixels() !== plain;
  set('pick-exposure', '0', 'input');
  set('pick-layout', 'side', 'change');
  out.side = pixels() !== plain;
  // Side by side, both panes show the same part of their pictures: the wheel over one zooms both.
  const half = left => { const c = stage.getContext('2d').getImageData(left ? 0 : stage.width / 2, 0, stage.width / 2, stage.height).data; let sum = 0; for (let i = 0; i < c.length; i += 4) sum = (sum * 31 + c[i]) >>> 0; return sum; };
  const before = [half(true), half(false)];
  stage.dispatchEvent(new WheelEvent('wheel', {...at(.2, .4), deltaY: -400}));
  out.synchronised = half(true) !== before[0] && half(false) !== before[1];
  set('pick-layout', 'slider', 'change');
  out.groups = [...document.querySelectorAll('#strips h3')].map(h => h.textContent);
  out.captions = [...document.querySelectorAll('#strips figcaption')].map(c => c.textContent);
  out.strips = document.querySelectorAll('#strips canvas').length;

  // Plots: what they hold, and that it was drawn: in each curve's colour, at each of its points.
  const chart = id => Chart.getChart(document.querySelector('#' + id + ' canvas'));
  const curves = id => chart(id).data.datasets.filter(d => d.curve);
  const rgb = c => [1, 3, 5].map(i => parseInt(c.slice(i, i + 2), 16));
  const near = (colour, x, y, of) => {
    const scale = of.currentDevicePixelRatio, r = Math.round(4 * scale), data = of.ctx.getImageData(Math.round(x * scale) - r, Math.round(y * scale) - r, 2 * r + 1, 2 * r + 1).data, wanted = rgb(colour);
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] && wanted.every((w, k) => Math.abs(data[i + k] - w) < 90)) return true;
    return false;
  };
  const drawn = id => { const c = chart(id); return c.data.datasets.flatMap((d, i) => d.curve && /^#.{6}$/.test(d.borderColor) ? c.getDatasetMeta(i).data.map(p => near(d.borderColor, p.x, p.y, c)) : []); };
  out.drawn = Object.fromEntries(['curve-plot', 'coverage-plot', 'screen-plot'].map(id => [id, [drawn(id).filter(Boolean).length, drawn(id).length]]));
  out.scales = Object.fromEntries(['curve-plot', 'coverage-plot', 'screen-plot'].map(id => [id, [chart(id).scales.x.type, chart(id).scales.y.type]]));
  out.curves = curves('curve-plot').length;
  out.bands = chart('curve-plot').data.datasets.filter(d => d.band).length;
  out.fits = [chart('curve-plot').data.datasets.filter(d => d.fit).length];
  document.getElementById('fits').click();
  out.fits.push(chart('curve-plot').data.datasets.filter(d => d.fit).length);
  out.slopes = [...document.querySelectorAll('#curve-legend .slope')].map(s => s.textContent).filter(Boolean);
  const canvas = document.querySelector('#curve-plot canvas'), r = canvas.getBoundingClientRect(), first = chart('curve-plot').getDatasetMeta(0).data[0];
  const move = (x, y) => canvas.dispatchEvent(new MouseEvent('mousemove', {clientX: r.left + x, clientY: r.top + y, bubbles: true}));
  move(first.x, first.y);
  await wait();
  const tip = chart('curve-plot').tooltip;
  out.tip = tip.opacity > 0 ? [...tip.title, ...tip.body.flatMap(b => b.lines)].join(' ') : '';
  document.querySelector('#curve-legend button').click();
  out.curves_without_one = curves('curve-plot').length;
  [...document.querySelectorAll('#curve-controls button')].find(b => b.textContent === 'rays').click();
  out.axis = chart('curve-plot').options.scales.x.title.text;
  [...document.querySelectorAll('#curve-controls button')].find(b => b.textContent === 'independent').click();
  out.independent = curves('curve-plot').map(d => d.curve);
  out.crossings = chart('screen-plot').data.datasets.filter(d => d.pointStyle === 'crossRot').length;
  out.patterns = [...document.querySelectorAll('#pattern-plots canvas')].map(c => { const p = Chart.getChart(c); return [p.data.datasets[0].data.length + p.data.datasets[1].data.length, near('#0b5fa5', p.getDatasetMeta(0).data[0].x, p.getDatasetMeta(0).data[0].y, p)]; });

  out.costs = [...document.querySelectorAll('#cost-table tbody tr')].map(r => parseFloat(r.cells[1].textContent)).filter(v => !isNaN(v));
  out.efficiency = [...document.querySelectorAll('#efficiency-table tbody tr')].map(r => r.cells[7].textContent).filter(t => t !== '–');
  // Two errors that the least number of samples reaches, and one that takes more.
  const asked = [{level: .02, rays: 9000}, {level: .05, rays: 4000}, {level: .1, rays: 4010}];
  out.notes = asked.map(p => costNote(asked, p));
  out.radius = document.getElementById('screen-radius').textContent;
  out.facts = document.getElementById('fact-table').textContent;
  out.rows = Object.fromEntries(['point-table', 'cost-table', 'efficiency-table', 'adaptive-table', 'screen-table', 'fact-table'].map(id => [id, rowsOf(id)]));
}
"""

TABLES = r"""
async function look(out) {
  out.note = document.getElementById('no-plots').textContent;
  out.shown = !document.getElementById('no-plots').hidden && document.getElementById('point-details').open;
  out.plots = document.querySelectorAll('.plot').length;
  out.strips = document.querySelectorAll('#strips canvas').length;
  out.rows = Object.fromEntries(['slope-table', 'point-table', 'cost-table', 'efficiency-table', 'coverage-plot', 'adaptive-table', 'screen-table', 'pattern-plots', 'fact-table'].map(id => [id, rowsOf(id)]));
}
"""

SCENE = """[input]
objfile = "corner.obj"
[camera]
eye = [2.0, 1.5, 2.5]
at = [0.0, 0.4, 0.0]
[film]
width = 120
height = 90
[renderer]
type = "ao"
max_distance = 1.5
"""
MESH = """v -2 0 -2
v 2 0 -2
v 2 0 2
v -2 0 2
v -2 2 -2
v 2 2 -2
v -.5 0 0
v .5 0 0
v 0 1 .3
v 0 0 .8
f 4 3 2 1
f 1 2 6 5
f 7 8 9
f 8 10 9
f 10 7 9
"""


def browser():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return name
    print("skipped: no chromium")
    sys.exit(77)


def looked_at(page, folder, look):
    """What a headless browser makes of the page, from file:// and without a network."""
    text = page.read_text(encoding="utf-8")
    # The plotting library and its licence name their authors' sites; nothing else does.
    own = re.sub(r'<script id="plot-library">.*?</script>', "", text, flags=re.S)
    own = re.sub(r'"plot_library":"(?:[^"\\]|\\.)*"', "", own)
    addresses = set(re.findall(r"https?://[^\s'\"<>)]+", own)) - {"http://www.w3.org/2000/svg"}
    assert not addresses, f"the page names {addresses}"
    probed = folder / "probed.html"
    probed.write_text(text.replace("<body>", "<body><script>" + FRAME + look + "</script>", 1), encoding="utf-8")
    command = [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1280,1600", f"--user-data-dir={folder}/profile",
               "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=8000", "--dump-dom", probed.as_uri()]
    dom = subprocess.run(command, capture_output=True, text=True, timeout=200).stdout
    found = re.search(r'<pre id="check">(.*?)</pre>', dom, re.S)
    assert found, "the page did not get as far as its check"
    out = json.loads(found[1].replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))
    print(json.dumps(out, indent=1))
    assert out["problems"] == [], out["problems"]
    assert out["fetched"] == []
    assert out["wide"] <= 0, "the page is wider than its window"
    assert all(n > 0 for n in out["rows"].values()), out["rows"]
    assert out["strips"] >= 4
    return out


def check_plots(page, folder):
    out = looked_at(page, folder, PLOTTED)
    zoom = [float(out[k].split()[0]) for k in ("start", "zoomed")]
    assert zoom[0] == 1 and zoom[1] > 2, zoom
    assert abs(float(out["split"].split()[1]) - 0.25) < 0.02, out["split"]
    assert out["probe"].startswith("pixel ") and "reference" in out["probe"]
    assert out["shades"] > 20 and all(v > 10 for v in out["modes"].values()), out["modes"]
    assert out["exposed"] and out["side"] and out["synchronised"], [out[k] for k in ("exposed", "side", "synchronised")]
    assert out["groups"] == ["In the same time", "To the same error"], out["groups"]
    assert all("RMSE" in caption for caption in out["captions"]), out["captions"]
    assert out["scales"] == {"curve-plot": ["logarithmic"] * 2, "coverage-plot": ["logarithmic", "linear"], "screen-plot": ["logarithmic"] * 2}, out["scales"]
    # A point may lie under others.
    assert all(total > 10 and seen > 0.9 * total for seen, total in out["drawn"].values()), out["drawn"]
    assert out["curves"] > out["curves_without_one"] > 0
    assert out["bands"] > 5 and len(out["slopes"]) > 5
    assert out["fits"][0] == 0 and out["fits"][1] >= len(out["slopes"]), out["fits"]
    assert "RMSE" in out["tip"] and "95 %" in out["tip"] and "rays" in out["axis"], [out["tip"], out["axis"]]
    assert len(out["independent"]) >= 3 and all("independent" in name for name in out["independent"]), out["independent"]
    assert out["crossings"] > 0
    assert len(out["patterns"]) == 5 and all(n == 256 and seen for n, seen in out["patterns"]), out["patterns"]
    assert len(out["costs"]) > 3 and len(out["efficiency"]) >= 3
    assert out["notes"] == ["", "", "as many rays as 0.05: the least that the rule takes reaches both"], out["notes"]
    assert out["radius"] == "1.5 world units", out["radius"]
    for what in ("device", "command", "seeds", "reference", "scene hash", "Chart.js 3"):
        assert what in out["facts"], what
    text = page.read_text(encoding="utf-8")
    assert "Chart.js v3" in text and "MIT License" in text, "the library's notice is gone"


def check_tables(page, folder):
    out = looked_at(page, folder, TABLES)
    assert out["shown"] and "libjs-chart.js" in out["note"], out["note"]
    assert out["plots"] == 0
    assert out["rows"]["point-table"] > 20 and out["rows"]["pattern-plots"] == 5, out["rows"]


def study(nook, folder, *more):
    command = [nook, "study", str(folder / "corner.toml"), "-o", str(folder / "study"), "--budget", "40", "--max-spp", "64", "--quiet", *more]
    return subprocess.run(command, check=True, capture_output=True, text=True).stderr


def main():
    browser()
    with tempfile.TemporaryDirectory(prefix="nook-page-") as name:
        folder = pathlib.Path(name)
        if len(sys.argv) > 2:
            check_plots(pathlib.Path(sys.argv[2]), folder)
            return
        page = folder / "study" / "index.html"
        (folder / "corner.toml").write_text(SCENE)
        (folder / "corner.obj").write_text(MESH)
        said = study(sys.argv[1], folder)
        header = (folder / "study" / "study.csv").read_text().splitlines()[0].split(",")
        assert header[:6] == ["method", "family", "sampling", "sampler", "directions", "level"], header
        if "libjs-chart.js" in said:
            print("without Chart.js: the plots go untested")
        else:
            check_plots(page, folder)
        # The same study goes on, and its page is made again.
        study(sys.argv[1], folder, "--no-plots")
        check_tables(page, folder)


main()
