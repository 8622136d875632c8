#!/usr/bin/env python3
"""Kills a run at every system call that touches its folder, and fails each call that writes, and looks at what is left.

    tests/killed_at_every_call.py PROGRAM [--scene FILE] [--backend cpu|gpu] [--every N] [--resumed] [--folder DIR]

Needs strace. What it asks for:

* after a kill at any call, what was finished is there and whole: no frame, picture or row that an observer saw is lost;
  `run --resume` comes to the same bytes as a run that was never broken off, `summary.json` but for times included;
* after an error of any call that writes, the run ends with exit code 1 and one sentence, and goes on as above.

With --resumed the run that is killed is one that goes on from half way. The last line counts what was tried. Exits 1 if
anything was lost.
"""

import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SCENES = {
    # Each writes rows between frames, a profile, and pictures; none takes longer than a second.
    "line": """dimension = 1
duration = 3
[[body]]
name = "rod"
shape = { block = { min = [0], max = [12] } }
material = "rubber"
velocity = [0.01]
""",
    "plane": """dimension = 2
duration = 3
[[body]]
name = "disc"
shape = { disc = { center = [0, 0], radius = 3 } }
material = "rubber"
spin = 0.02
velocity = [0.01, 0]
""",
    "solid": """dimension = 3
duration = 3
[[body]]
name = "ball"
shape = { sphere = { center = [0, 0, 0], radius = 2 } }
material = "rubber"
velocity = [0.01, 0, 0]
""",
}

COMMON = """title = "A small body"
units = "dimensionless"
spacing = 1.0
%s
[material.rubber]
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[formulation]
smoothing_length = 1.5
viscosity = { alpha = 0.1 }
artificial_stress = { epsilon = 0.3 }
[output]
series = 0.5
frames = 1.0
picture = { field = "velocity.x", width = 160, height = 120 }
[observe]
kinetic = { kind = "kinetic_energy" }
cut = { kind = "profile", field = "velocity.x", axis = "x" }
"""

# Calls that change a folder, and those that bring it onto the disk. Calls that read are killed at too.
WRITING = ["write", "pwrite64", "writev", "fsync", "fdatasync", "rename", "renameat", "renameat2", "ftruncate", "mkdir", "mkdirat", "link"]
OTHERS = ["open", "openat", "unlink", "unlinkat", "rmdir", "flock", "close", "read", "pread64", "statx", "newfstatat", "fstat", "lseek", "getdents64"]
# Seconds after which a run counts as one that hangs.
PATIENCE = 60
TIMES = ["seconds", "processor_seconds", "particle_updates_per_second"]


class Bench:
    def __init__(self, arguments):
        self.program = str(pathlib.Path(arguments.program).resolve())
        self.place = ["--backend", arguments.backend] + (["--threads", "1"] if arguments.backend == "cpu" else [])
        self.folder = pathlib.Path(arguments.folder or tempfile.mkdtemp(prefix="lithosph-kills-"))
        self.folder.mkdir(parents=True, exist_ok=True)
        self.out, self.whole = self.folder / "out", self.folder / "whole"
        for left in ["out", "whole", "half"]:
            shutil.rmtree(self.folder / left, ignore_errors=True)
        self.scene = self.folder / "small.toml"
        self.scene.write_text(SCENE_OF(arguments.scene))
        self.resumed = arguments.resumed
        self.losses = 0

    def lost(self, line):
        self.losses += 1
        print(line, flush=True)

    def run(self, command, prefix=()):
        said = subprocess.run([*prefix, self.program, "run", *command, *self.place, "--quiet"], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE)
        return said

    def start(self, out="out", prefix=()):
        return self.run([str(self.scene), "--out", out], prefix)

    def resume(self, prefix=()):
        return self.run(["--resume", "out"], prefix)

    def prepare(self):
        """Makes the folder as it is before the run that is broken off."""
        shutil.rmtree(self.out, ignore_errors=True)
        if self.resumed:
            shutil.copytree(self.folder / "half", self.out)

    def broken(self, prefix):
        return self.resume(prefix) if self.resumed else self.start(prefix=prefix)


def SCENE_OF(name):
    return COMMON % SCENES[name] if name in SCENES else pathlib.Path(name).read_text()


def contents(folder):
    """What must be the same after an unbroken and a resumed run."""
    seen = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        # The first two hold wall times. A kill between two states leaves one more, or one less, state behind.
        if path.is_dir() or name in ("manifest.txt", "checkpoint.h5", "checkpoint.previous.h5"):
            continue
        data = path.read_bytes()
        if name == "summary.json":
            summary = json.loads(data)
            data = json.dumps({key: value for key, value in summary.items() if key not in TIMES}).encode()
        seen[name] = data
    return seen


def finished(folder):
    """Files that a reader may have opened: they must not change, but for the master, which may list more, and rows added."""
    if not folder.exists():
        return {}
    seen = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    return {name: data for name, data in seen.items()
            if re.fullmatch(r"frames/\d+\.png|particles/\d+\.vtkhdf|series\.csv|profile-.*\.csv|summary\.json", name)}


def calls(bench, names):
    """Numbers of the calls, each counted within its name and thread, that touch the folder."""
    bench.prepare()
    log = bench.folder / "strace.log"
    said = bench.broken(["strace", "-f", "-y", "-qq", "-e", "signal=none", "-e", f"trace={','.join('?' + name for name in names)}", "-o", str(log)])
    if said.returncode != 0:
        sys.exit(f"the run that is watched failed:\n{said.stderr}")
    counts, found = {}, []
    for line in log.read_text(errors="replace").splitlines():
        match = re.match(r"(\d+) +(\w+)\((.*)", line)
        if not match or "resumed>" in line:
            continue
        thread, name, rest = match.groups()
        counts[thread, name] = counts.get((thread, name), 0) + 1
        if str(bench.out) in rest or re.search(r'"out[/"]', rest):
            found.append((name, counts[thread, name]))
    return sorted(set(found))


def inject(bench, name, when, what):
    bench.prepare()
    trace = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={name}", "-e", f"inject={name}:{what}:when={when}"]
    return bench.broken(trace)


def goes_on(bench, place, reference, before):
    """Resumes, or begins again where nothing was begun, and compares."""
    for name, data in before.items():
        # A row that a kill cut short is no row.
        whole = reference.get(name, b"")
        if name == "series.csv":
            data = data[: data.rfind(b"\n") + 1]
            good = whole.startswith(data)
        elif name == "summary.json":
            good = True
        else:
            good = whole == data
        if not good:
            bench.lost(f"{place}: {name} is not as it must be")
    began = (bench.out / "run.toml").exists()
    said = bench.resume() if began else None
    if said is None or said.returncode == 2:
        if before:
            bench.lost(f"{place}: cannot be resumed: {said and said.stderr}")
        shutil.rmtree(bench.out, ignore_errors=True)
        said = bench.start()
        kind = "begun again"
    else:
        kind = "resumed"
    if said.returncode != 0 or "panicked" in said.stderr:
        bench.lost(f"{place}: {kind}, exit {said.returncode}: {said.stderr}")
        return kind
    seen = contents(bench.out)
    for name in sorted(seen.keys() | reference.keys()):
        if seen.get(name) != reference.get(name):
            bench.lost(f"{place}: {kind}, {name} differs")
    return kind


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scene", default="plane", help="line, plane, solid, or a file")
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--every", type=int, default=1, help="try only each N-th call")
    parser.add_argument("--resumed", action="store_true", help="break off a run that goes on from half way")
    parser.add_argument("--folder", help="work here; a temporary folder unless given")
    arguments = parser.parse_args()
    bench = Bench(arguments)
    if bench.resumed:
        # Half way: killed when the third frame's picture takes its name.
        said = subprocess.run(["strace", "-f", "-qq", "-o", "/dev/null", "-e", "trace=rename", "-e", "inject=rename:signal=KILL:when=10",
                               bench.program, "run", str(bench.scene), "--out", "half", *bench.place, "--quiet"], cwd=bench.folder,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=PATIENCE)
        if said.returncode == 0 or not (bench.folder / "half/checkpoint.h5").exists():
            sys.exit("the run was not broken off half way")
    if bench.start("whole").returncode != 0:
        sys.exit("the unbroken run failed")
    reference = contents(bench.whole)

    kinds, kills = {}, calls(bench, WRITING + OTHERS)[:: arguments.every]
    for name, when in kills:
        place = f"killed at {name} {when}"
        try:
            inject(bench, name, when, "signal=KILL")
            kind = goes_on(bench, place, reference, finished(bench.out))
            kinds[kind] = kinds.get(kind, 0) + 1
        except subprocess.TimeoutExpired:
            bench.lost(f"{place}: hangs")
    errors, ends = 0, {}
    for name, when in [call for call in calls(bench, WRITING)][:: arguments.every]:
        for error in ["ENOSPC", "EIO"]:
            place, errors = f"{error} at {name} {when}", errors + 1
            try:
                said = inject(bench, name, when, f"error={error}")
                ends[said.returncode] = ends.get(said.returncode, 0) + 1
                lines = [line for line in said.stderr.splitlines() if "warning" not in line]
                if said.returncode != 1 or len(lines) != 1 or not lines[0].startswith("lithosph: "):
                    bench.lost(f"{place}: exit {said.returncode}: {said.stderr!r}")
                goes_on(bench, place, reference, finished(bench.out))
            except subprocess.TimeoutExpired:
                bench.lost(f"{place}: hangs")
    told = ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))
    codes = ", ".join(f"{count} with exit {code}" for code, count in sorted(ends.items()))
    start = "a resumed run" if bench.resumed else "a run"
    print(f"{start} of {arguments.scene} on {arguments.backend}: {len(kills)} kills ({told}), {errors} errors ({codes}), {bench.losses} losses")
    if not arguments.folder:
        shutil.rmtree(bench.folder, ignore_errors=True)
    sys.exit(1 if bench.losses else 0)


if __name__ == "__main__":
    main()
