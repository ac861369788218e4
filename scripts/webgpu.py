#!/usr/bin/env python3
"""webgpu.py MODULES FRAMES [--check | --picture FILE] [--port PORT]: serves examples/webgpu on the loopback, with the modules in WGSL and
stored frames (docs/webgpu.md). --check runs all frames in headless Chromium, on its software device, prints how far they
are from the library's results, and fails where that is too far. --picture saves what the page shows there."""
import argparse
import functools
import http.server
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading

# Where there is a material: least dB and largest error, which above 1 is relative. Single pixels of light that comes through
# and of thicknesses are further off (docs/webgpu.md).
LEAST_PSNR = {"scattered": 66.0, "transmitted": 68.0, "thicknessOut": 60.0}
LARGEST_ERROR = {"scattered": 4e-3, "transmitted": 0.1, "thicknessOut": 0.1}
LARGEST_ELSEWHERE = 1e-3  # rounding to half floats
PAGE = pathlib.Path(__file__).resolve().parent.parent / "examples" / "webgpu"


class Handler(http.server.SimpleHTTPRequestHandler):
    """The page's files, /wgsl/ and /frames/; /frames lists these; POST /results hands over what the page found, and
    /shown is answered then."""

    def __init__(self, *arguments, site, **keywords):
        self.site = site
        super().__init__(*arguments, directory=str(PAGE), **keywords)

    def translate_path(self, path):
        path = path.split("?")[0]
        for prefix, folder in self.site.folders.items():
            if path.startswith(prefix):
                inside = (folder / path[len(prefix):]).resolve()
                return str(inside) if inside.is_relative_to(folder) else str(folder / "none")
        return super().translate_path(path)

    def do_GET(self):
        if self.path == "/frames":
            names = sorted(file.parent.name for file in self.site.folders["/frames/"].glob("*/frame.json"))
            self.answer(json.dumps(sorted(names, key=lambda name: name != "gallery")).encode())
        elif self.path == "/shown":
            self.site.arrived.wait(timeout=240)
            self.answer(b"")
        else:
            super().do_GET()

    def do_POST(self):
        self.site.results = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.answer(b"{}")
        self.site.arrived.set()

    def answer(self, body):
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class Site:
    def __init__(self, modules, frames, port):
        self.folders = {"/wgsl/": modules.resolve(), "/frames/": frames.resolve()}
        self.results = None
        self.arrived = threading.Event()
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", port), functools.partial(Handler, site=self))
        self.address = f"http://127.0.0.1:{self.server.server_address[1]}/"


def chromium(profile, *arguments):
    program = shutil.which("chromium")
    if program is None:
        sys.exit("webgpu.py: chromium is not installed")
    return [program, "--headless=new", "--no-sandbox", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
            "--no-first-run", f"--user-data-dir={profile}", *arguments]


def check(site):
    """Returns what is wrong, a sentence each."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = subprocess.Popen(chromium(profile, site.address + "?check"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        arrived = site.arrived.wait(timeout=240)
        browser.terminate()
        browser.wait()
    if not arrived:
        return ["the page has sent no results within 240 s"]
    if isinstance(site.results, dict):
        return [site.results["error"]]
    faults = []
    for figures in (figures for result in site.results for figures in result["figures"]):
        print("{frame:12} {output:12} {psnr:6.1f} dB, largest error {largest:.1e}, {visible} of {values} above 0.01; elsewhere "
              "{largestElsewhere:.1e}".format(**figures))
        if figures["values"] == 0:
            faults.append(f"{figures['frame']} has no pixel with a material")
        if figures["psnr"] < LEAST_PSNR[figures["output"]]:
            faults.append("{frame}: {output} is {psnr:.1f} dB from the library's".format(**figures))
        if figures["largest"] > LARGEST_ERROR[figures["output"]]:
            faults.append("{frame}: {output} is up to {largest:.4f} from the library's".format(**figures))
        if figures["largestElsewhere"] > LARGEST_ELSEWHERE:
            faults.append("{frame}: {output} changes pixels without a material".format(**figures))
    for limits in {entry["file"]: entry for result in site.results for entry in result["limits"]}.values():
        print("{file:20} {storageBuffers} storage buffers, {sampledTextures} sampled textures, {storageTextures} storage "
              "textures".format(**limits))
    return faults or ([] if site.results else ["there are no stored frames"])


def picture(site, file):
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        subprocess.run(chromium(profile, f"--screenshot={file.resolve()}", "--window-size=1060,560", "--hide-scrollbars",
                                site.address + "?picture"), check=True, timeout=240, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("modules", type=pathlib.Path)
    parser.add_argument("frames", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--picture", type=pathlib.Path)
    parser.add_argument("--port", type=int, default=0)
    arguments = parser.parse_args()
    site = Site(arguments.modules, arguments.frames, arguments.port)
    threading.Thread(target=site.server.serve_forever, daemon=True).start()
    if arguments.check:
        faults = check(site)
        for fault in faults:
            print(f"webgpu.py: {fault}", file=sys.stderr)
        sys.exit(1 if faults else 0)
    if arguments.picture:
        picture(site, arguments.picture)
        return
    print(site.address, flush=True)
    threading.Event().wait()


main()
