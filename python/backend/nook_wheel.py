"""The build backend of `pip install .` (PEP 517): CMake builds the module, and this packs it as a wheel.

scikit-build-core and meson-python would do as much, but Debian 12 has neither, and pip would have to download
them to build. This needs nothing but Python, CMake and a compiler, so that `pip install .` works offline, and
packs one module of the stable ABI (cp311-abi3) with the whole of nook inside it, kernels too. OpenEXR, libpng
and zlib stay the system's: the wheel is for the system that it was built on.

NOOK_WHEEL_BUILD names a build folder that is kept and gone on with.
"""

import base64
import contextlib
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def _version():
    return re.search(r"project\(nook VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _tag():
    import sysconfig

    return "cp311-abi3-" + re.sub("[-.]", "_", sysconfig.get_platform())


def _metadata():
    readme = (ROOT / "docs" / "python.md").read_text()
    return f"""Metadata-Version: 2.1
Name: nook
Version: {_version()}
Summary: Ambient, reflection and screen-space occlusion on OpenCL, as arrays
Requires-Python: >=3.11
Requires-Dist: numpy>=1.24
Provides-Extra: plot
Requires-Dist: matplotlib>=3.6; extra == "plot"
Description-Content-Type: text/markdown

{readme}"""


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("nook is built from a checkout: pip install PATH, or git archive")


def _info_files():
    wheel = f"Wheel-Version: 1.0\nGenerator: nook\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    return {"METADATA": _metadata().encode(), "WHEEL": wheel.encode()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    info = Path(metadata_directory) / f"nook-{_version()}.dist-info"
    info.mkdir()
    for name, data in _info_files().items():
        (info / name).write_bytes(data)
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    kept = os.environ.get("NOOK_WHEEL_BUILD")
    with contextlib.nullcontext(kept) if kept else tempfile.TemporaryDirectory() as folder:
        off = [f"-DNOOK_{what}=OFF" for what in ("PROGRAM", "TESTS", "BENCH", "SCENES", "INSTALL")]
        command = ["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", *off]
        command += ["-DNOOK_PYTHON_ALONE=ON", f"-DPython3_EXECUTABLE={sys.executable}"]
        if subprocess.run(["ninja", "--version"], capture_output=True, check=False).returncode == 0:
            command += ["-G", "Ninja"]
        subprocess.run(command, check=True)
        jobs = os.environ.get("NOOK_JOBS", str(os.cpu_count()))
        subprocess.run(["cmake", "--build", folder, "-j", jobs, "--target", "nook_python"], check=True)
        return pack(Path(folder) / "python" / "nook", wheel_directory)


def pack(package, wheel_directory):
    """The package as a wheel. Equal files give equal bytes."""
    info = f"nook-{_version()}.dist-info"
    files = {f"nook/{file.name}": file.read_bytes() for file in sorted(package.iterdir()) if file.is_file()}
    files |= {f"{info}/{name}": data for name, data in _info_files().items()}
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"nook-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = 0o755 << 16 if name.endswith(".so") else 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return wheel
