"""Tests the package in a fresh virtual environment: `python3 crates/python/check.py dist`.

It takes a wheel, or the folder that has one. `--long` makes 200,000 mistaken calls instead of 10,000,
`--cluster` tests Dask and Ray, too. `--keep` takes the environment of the last run. It ends at the first
failure.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import venv

HERE = pathlib.Path(__file__).resolve().parent
ENVIRONMENT = HERE.parent.parent / "target" / "python-check"
GUIDE = HERE.parent.parent / "docs" / "guide" / "src"
ALLOWED = HERE / "tests" / "typed" / "unchecked_by_runtime.txt"


def run(title: str, command: list[str], **variables: str) -> None:
    """Run a command in the folder of the package; end the program if it fails."""
    print(f"== {title}: {' '.join(command[1:])}", flush=True)
    begin = time.monotonic()
    # The wheel is tested, not the sources: their folder is on no path.
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "MYPY"))
    }
    status = subprocess.run(command, cwd=HERE, env={**environment, **variables}, check=False).returncode
    print(f"== {time.monotonic() - begin:.1f} s", flush=True)
    if status != 0:
        sys.exit(f"{title}: failed")


def wheel_of(place: pathlib.Path) -> pathlib.Path:
    """Find the wheel, or the newest one in the folder."""
    wheels = sorted(place.glob("mediant-*.whl"), key=os.path.getmtime) if place.is_dir() else [place]
    if not wheels or not wheels[-1].is_file():
        sys.exit(f"{place}: no wheel; see README.md how to make one")
    return wheels[-1].resolve()


def prepare(wheel: pathlib.Path, extras: str, keep: bool) -> str:
    """Install the wheel and what its tests need; return the interpreter."""
    if ENVIRONMENT.exists() and not keep:
        shutil.rmtree(ENVIRONMENT)
    if not ENVIRONMENT.exists():
        print(f"== A fresh environment of Python {sys.version.split()[0]}", flush=True)
        venv.create(ENVIRONMENT, with_pip=True)
    python = str(ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python"))
    # Compiling all modules takes longer than those that the tests import.
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile"]
    run("The wheel and what its tests need", [*pip, f"{wheel}[{extras}]"])
    run("The wheel itself", [*pip, "--force-reinstall", "--no-deps", str(wheel)])
    return python


def run_examples(python: str) -> None:
    """Run the Python examples of the README and of the guide, each as a program of its own."""
    folder = ENVIRONMENT / "examples"
    folder.mkdir(exist_ok=True)
    for page in [HERE / "README.md", *sorted(GUIDE.rglob("*.md"))]:
        blocks = re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.S | re.M)
        if not blocks and page.parent == HERE:
            sys.exit("README.md: no examples found")
        for number, block in enumerate(blocks, 1):
            name = folder / f"{page.stem}_{number}.py"
            name.write_text(f"import os\nos.chdir({str(folder)!r})\n{block}", encoding="utf-8")
            title = f"{page.name}, example {number} of {len(blocks)}"
            run(title, [python, str(name)], MPLBACKEND="agg")


def main() -> None:
    """Do it all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("wheel", type=pathlib.Path, help="a wheel, or the folder that has it")
    parser.add_argument("--long", action="store_true", help="200,000 mistaken calls")
    parser.add_argument("--cluster", action="store_true", help="test Dask and Ray, too")
    parser.add_argument("--keep", action="store_true", help="take the environment of the last run")
    wishes = parser.parse_args()
    # Programs in the background of a shell ignore Ctrl-C, and so would those that test it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    extras = "test,plot,batch,dask" + (",ray" if wishes.cluster else "")
    python = prepare(wheel_of(wishes.wheel), extras, wishes.keep)
    module = [python, "-m"]
    if sys.version_info >= (3, 10):  # mypy runs on these.
        run("Style", [*module, "ruff", "check", "."])
        run("Format", [*module, "ruff", "format", "--check", "."])
        run("Types", [*module, "mypy", "--config-file", "pyproject.toml", "-p", "mediant"])
        run(
            "Types of a program",
            [*module, "mypy", "--config-file", "pyproject.toml", "tests/typed/example.py"],
        )
        stubtest = ["mypy.stubtest", "mediant", "--mypy-config-file", "pyproject.toml"]
        run("The stub", [*module, *stubtest, "--allowlist", str(ALLOWED)])
    # Tests that take times have the cores to themselves.
    timed = "tests/test_interrupts.py"
    tests = [*module, "pytest", "-rs"]
    run("Tests and examples of docstrings", [*tests, "-n", "auto", "tests", "--ignore", timed])
    run("Tests of interrupts", [*tests, timed])
    if wishes.long:
        calls = [*module, "pytest", "-n", "auto", "tests/test_mistakes.py"]
        run("200,000 mistaken calls", calls, MEDIANT_CALLS="200000")
    run_examples(python)
    if wishes.cluster:
        run("Clusters", [*module, "pytest", "tests/cluster"])
    print("== All is well")


if __name__ == "__main__":
    main()
