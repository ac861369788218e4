#!/usr/bin/env python3
"""Tables what becomes of sample files of glTF: drawn, drawn with notes of what is left out, or refused with a sentence.

Usage: gltf-samples.py NACRE FOLDER... > table. NACRE is the command to run; every .gltf and .glb in a FOLDER or below is drawn
once, small and without the effect. Exits with 1 where a file is silent: neither a picture nor a sentence. Needs Python 3 and
nothing beside its standard library.
"""
import os
import subprocess
import sys
import tempfile


def samples(folder):
    for path, folders, names in sorted(os.walk(folder)):
        folders.sort()
        for name in sorted(names):
            if name.lower().endswith((".gltf", ".glb")):
                yield os.path.join(path, name)


def draw(nacre, file, work):
    """What becomes of the file, and what is said about it."""
    command = [nacre, "render", file, "--size", "32x18", "--shadow-map-size", "64", "--no-scatter", "--no-transmit", "--output", work + "/p.png"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode == 0:
        prefix = "nacre: note: "
        notes = [line.removeprefix(prefix) for line in done.stderr.splitlines() if line.startswith(prefix)]
        return ("drawn, noted" if notes else "drawn"), notes
    says = [line.removeprefix("nacre: ") for line in done.stderr.splitlines() if line.startswith("nacre: ") and "rendering" not in line]
    return ("refused" if done.returncode in (1, 2) and says else "SILENT"), says[-1:]


def main():
    nacre, folders = sys.argv[1], sys.argv[2:]
    counts = {}
    print("| file | what becomes of it | what is said |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as work:
        for folder in folders:
            for file in samples(folder):
                result, says = draw(nacre, file, work)
                counts[result] = counts.get(result, 0) + 1
                prefix = os.path.dirname(file) + "/"
                text = "; ".join(s.replace(prefix, "").replace("|", "\\|") for s in says)
                name = os.path.join(os.path.basename(os.path.normpath(folder)), os.path.relpath(file, folder))
                print("| %s | %s | %s |" % (name, result, text), flush=True)
    print("\n" + ", ".join("%d %s" % (counts[key], key) for key in sorted(counts)), file=sys.stderr)
    return 1 if "SILENT" in counts else 0


if __name__ == "__main__":
    sys.exit(main())
