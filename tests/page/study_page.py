"""The page of a study, as a browser shows it: no error, every figure drawn, slider and zoom work, nothing fetched.

study_page.py NOOK [PAGE]: makes a small study with NOOK, or takes PAGE, and opens it in a headless Chromium from file://.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CHECK = r"""
window.problems = [];
window.addEventListener('error', e => window.problems.push(String(e.message)));
for (const name of ['error', 'warn']) console[name] = (...what) => window.problems.push(what.join(' '));
window.addEventListener('load', () => setTimeout(() => {
  const out = {};
  try { look(out); } catch (e) { window.problems.push(e.stack); }
  out.problems = window.problems;
  document.body.append(Object.assign(document.createElement('pre'), {id: 'check', textContent: JSON.stringify(out)}));
}, 300));
function look(out) {
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
  out.slopes = [...document.querySelectorAll('#curve-legend .slope')].map(s => s.textContent).filter(Boolean);
  out.bands = document.querySelectorAll('#curve-plot polygon').length;
  out.costs = [...document.querySelectorAll('#cost-table tbody tr')].map(r => parseFloat(r.cells[1].textContent)).filter(v => !isNaN(v));
  out.efficiency = [...document.querySelectorAll('#efficiency-table tbody tr')].map(r => r.cells[6].textContent).filter(t => t !== '–');
  out.radius = document.getElementById('screen-radius').textContent;
  out.facts = document.getElementById('fact-table').textContent;
  const dots = () => document.querySelectorAll('#curve-plot circle.hit').length;
  out.dots = dots();
  const hit = document.querySelector('#curve-plot circle.hit');
  hit.dispatchEvent(new PointerEvent('pointerenter'));
  out.tip = document.querySelector('#curve-plot .tip').textContent;
  document.querySelector('#curve-legend button').click();
  out.dots_without_one = dots();
  [...document.querySelectorAll('#curve-controls button')].find(b => b.textContent === 'rays').click();
  out.axis = document.querySelector('#curve-plot svg').textContent;
  out.coverage_dots = document.querySelectorAll('#coverage-plot circle.hit').length;
  out.patterns = [...document.querySelectorAll('#pattern-plots svg')].map(s => s.querySelectorAll('circle').length);
  out.rows = Object.fromEntries(['cost-table', 'efficiency-table', 'adaptive-table', 'screen-table', 'fact-table'].map(id => [id, document.querySelectorAll('#' + id + ' tbody tr').length]));
  out.strips = document.querySelectorAll('#strips canvas').length;
  out.fetched = performance.getEntriesByType('resource').map(r => r.name).filter(n => !n.startsWith('data:'));
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


def check(page, folder):
    text = page.read_text(encoding="utf-8")
    addresses = set(re.findall(r"https?://[^\s'\"<>)]+", text)) - {"http://www.w3.org/2000/svg"}
    assert not addresses, f"the page names {addresses}"
    probed = folder / "probed.html"
    probed.write_text(text.replace("<body>", "<body><script>" + CHECK + "</script>", 1), encoding="utf-8")
    command = [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1280,1600", f"--user-data-dir={folder}/profile",
               "--virtual-time-budget=8000", "--dump-dom", probed.as_uri()]
    dom = subprocess.run(command, capture_output=True, text=True, timeout=200).stdout
    found = re.search(r'<pre id="check">(.*?)</pre>', dom, re.S)
    assert found, "the page did not get as far as its check"
    out = json.loads(found[1].replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))
    print(json.dumps(out, indent=1))
    assert out["problems"] == [], out["problems"]
    assert out["fetched"] == []
    zoom = [float(out[k].split()[0]) for k in ("start", "zoomed")]
    assert zoom[0] == 1 and zoom[1] > 2, zoom
    assert abs(float(out["split"].split()[1]) - 0.25) < 0.02, out["split"]
    assert out["probe"].startswith("pixel ") and "reference" in out["probe"]
    assert out["shades"] > 20 and all(v > 10 for v in out["modes"].values()), out["modes"]
    assert out["dots"] > out["dots_without_one"] > 0
    assert "RMSE" in out["tip"] and "rays" in out["axis"]
    assert out["coverage_dots"] > 0
    assert len(out["patterns"]) == 5 and all(n == 257 for n in out["patterns"]), out["patterns"]
    assert all(n > 0 for n in out["rows"].values()), out["rows"]
    assert out["strips"] >= 4
    assert out["exposed"] and out["side"] and out["synchronised"], [out[k] for k in ("exposed", "side", "synchronised")]
    assert out["groups"] == ["In the same time", "To the same error"], out["groups"]
    assert all("RMSE" in caption for caption in out["captions"]), out["captions"]
    assert len(out["slopes"]) > 5 and out["bands"] > 0
    assert len(out["costs"]) > 3 and len(out["efficiency"]) >= 3
    assert out["radius"] == "1.5 world units", out["radius"]
    for what in ("device", "command", "seeds", "reference", "scene hash"):
        assert what in out["facts"], what


def main():
    browser()
    with tempfile.TemporaryDirectory(prefix="nook-page-") as name:
        folder = pathlib.Path(name)
        page = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else folder / "study" / "index.html"
        if len(sys.argv) < 3:
            (folder / "corner.toml").write_text(SCENE)
            (folder / "corner.obj").write_text(MESH)
            study = [sys.argv[1], "study", str(folder / "corner.toml"), "-o", str(folder / "study"), "--budget", "20", "--max-spp", "64", "--quiet"]
            subprocess.run(study, check=True)
            header = (folder / "study" / "study.csv").read_text().splitlines()[0].split(",")
            assert header[:6] == ["method", "family", "sampling", "sampler", "directions", "level"], header
        check(page, folder)


main()
