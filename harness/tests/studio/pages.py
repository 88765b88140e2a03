"""The studio's pages in Chromium: what they show of good files and of hostile ones, by keys alone, at two widths.

run (beside this file) installs what this needs. Arguments: the script of axe-core, which need not be there.
"""

import contextlib
import functools
import http.server
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import traceback

from playwright.sync_api import expect, sync_playwright

PROGRAM = os.environ["CROSSGUARD"]
AXE = pathlib.Path(sys.argv[1])
HOSTILE = "<img src=x onerror='window.harmed=1'><script>window.harmed=1</script>"
expect.set_options(timeout=60_000)

# What cuts a text off at a width: a box that is narrower than its text, and a text outside of its picture.
CUT = """() => [...document.querySelectorAll('h1, h2, h3, p, dd, dt, button, label, output, .said, .timers li, summary')]
    .filter((it) => it.offsetParent && it.scrollWidth > it.clientWidth + 1 && getComputedStyle(it).display !== 'inline')
    .map((it) => `${it.tagName} ${it.textContent}`)"""
OUTSIDE = """() => [...document.querySelectorAll('svg[role=img]')].flatMap((of) => {
    const box = of.getBoundingClientRect();
    const is_outside = (b) => b.left < box.left - 1 || b.right > box.right + 1 || b.top < box.top - 1 || b.bottom > box.bottom + 1;
    return [...of.querySelectorAll('text')].filter((it) => is_outside(it.getBoundingClientRect())).map((it) => it.textContent); })"""
# Pictures are drawn anew in the frame after the one that has the new width.
DRAWN = "() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))"
SERIOUS = """() => axe.run().then((all) => all.violations.filter((it) => ['serious', 'critical'].includes(it.impact))
    .map((it) => `${it.id}: ${it.nodes.slice(0, 5).map((node) => node.html + node.failureSummary).join(' | ')}`))"""


def run(*arguments):
    """What a command of the kit prints."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


class Studio:
    """A studio that is served, and a page of it in a browser."""

    def __init__(self, browser, *arguments):
        command = [PROGRAM, "studio", "--no-browser", "--port", "0", *map(str, arguments)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.url = re.search(r"http://\S+", self.process.stdout.readline()).group()
        self.server = "/".join(self.url.split("/")[:3]) + "/"
        self.browser = browser
        self.page = browser.new_page(viewport={"width": 1280, "height": 900}, accept_downloads=True)
        self.errors, self.requests = [], []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda it: self.errors.append(it.text) if it.type == "error" else None)
        self.page.on("request", lambda it: self.requests.append(it.url))

    def open(self, view=None):
        self.page.goto(self.server + view if view else self.url)
        self.page.wait_for_selector("html[data-ready=true]", state="attached")
        return self.page

    def assert_clean(self):
        """No error, and no request of anybody else."""
        assert self.errors == [], self.errors
        assert len(self.requests) > 8
        others = [it for it in self.requests if not it.startswith((self.server, "blob:", "data:"))]
        assert others == [], others
        assert self.page.evaluate("window.harmed === undefined && document.images.length === 0")

    def assert_fits(self):
        """Each width and colour scheme shows the page without cutting a text off, and axe finds nothing serious."""
        if AXE.is_file():
            self.page.evaluate(AXE.read_text() + "; true")
        for scheme in ("light", "dark"):
            self.page.emulate_media(color_scheme=scheme)
            for width in (820, 1280):
                self.page.set_viewport_size({"width": width, "height": 900})
                self.page.evaluate(DRAWN)
                assert self.page.evaluate("document.documentElement.scrollWidth") <= width, (width, scheme)
                for cut in (CUT, OUTSIDE):
                    assert self.page.evaluate(cut) == [], (width, scheme, self.page.evaluate(cut))
            if AXE.is_file():
                assert self.page.evaluate(SERIOUS) == [], (scheme, self.page.evaluate(SERIOUS))

    def assert_reached_by_tab(self, times, *names):
        """What can be used is reached by Tab, and shows that it has the focus."""
        reached = []
        for _ in range(times):
            self.page.keyboard.press("Tab")
            name, is_shown = self.page.evaluate(
                """() => { const it = document.activeElement;
                return [it.id || it.className || it.textContent, getComputedStyle(it).outlineStyle !== 'none']; }"""
            )
            if self.page.evaluate("document.activeElement === document.body"):
                break
            assert is_shown, name
            reached.append(name)
        assert set(names) <= set(reached), reached

    def open_file(self, content):
        file = {"name": "run.json", "mimeType": "application/json", "buffer": content.encode()}
        self.page.set_input_files("#file", [file])

    def saved(self, folder):
        """The run that the page saves."""
        with self.page.expect_download() as download:
            self.page.click("#save")
        path = folder / "saved.json"
        download.value.save_as(path)
        return path

    def close(self):
        self.page.close()
        self.process.kill()
        self.process.wait()


def free_port():
    """The first of some ports that are free now: nobody else picks from below the system's range."""
    for port in range(20_000 + os.getpid() % 1_000 * 10, 32_000, 10):
        with contextlib.suppress(OSError), contextlib.ExitStack() as sockets:
            for offset in range(4):
                sockets.enter_context(socket.socket(type=socket.SOCK_DGRAM)).bind(("127.0.0.1", port + offset))
            return str(port)
    raise OSError("no free ports")


def demo(folder, *arguments):
    log = folder / "log.jsonl"
    run("demo", "--quiet", "--speed", "40", "--port", free_port(), "--log", log, *arguments)
    return log


def after(studio, folder):
    people = [{"at_s": at / 10, "id": id, "position_m": [id, 2]} for at in range(200) for id in (1, 2, 3)]
    (folder / "people.jsonl").write_text("".join(json.dumps(it) + "\n" for it in people))
    log = demo(folder, "--scenario", "team", "--perceived", folder / "people.jsonl")
    at = studio(log, "--site", "street")
    page = at.open()
    expect(page.locator("#robots article")).to_have_count(4)
    at.assert_reached_by_tab(18, "skip", "first", "previous", "play", "next", "last", "speed", "slider", "rows")
    page.evaluate("document.activeElement.blur()")
    # Forth and back by keys, and the row that is current says the time.
    time = lambda: int(page.eval_on_selector("#slider", "it => it.value"))
    # Half a millisecond is rounded up by one, and down by the other.
    shown = lambda at: re.compile(f"^({at / 1e6:.3f}|{(at + 1) / 1e6:.3f})$")
    seen = []
    for _ in range(5):
        before = time()
        page.keyboard.press("ArrowRight")
        page.wait_for_function("at => Number(document.getElementById('slider').value) > at", arg=before)
        seen.append(time())
        expect(page.locator(".row.current .at")).to_have_text(shown(seen[-1]))
    for past in reversed(seen[:-1]):
        page.keyboard.press("ArrowLeft")
        expect(page.locator(".row.current .at")).to_have_text(shown(past))
    page.eval_on_selector("#slider", "it => { it.value = it.max / 2; it.dispatchEvent(new Event('input')); }")
    expect(page.locator("#map .body")).to_have_count(4)
    expect(page.locator("#map .person").first).to_be_visible()
    # What is otherwise than at the moment before is marked.
    expect(page.locator("#robots mark").first).to_be_visible()
    page.keyboard.press("Home")
    page.keyboard.press(" ")
    page.wait_for_function("() => Number(document.getElementById('slider').value) > 200000")
    page.keyboard.press(" ")
    expect(page.locator("#play")).to_have_text("Play")
    page.keyboard.press("End")
    at.assert_fits()
    at.assert_clean()


# Drops files, each a name and its text, on the page.
DROP = """files => {
    const dataTransfer = new DataTransfer();
    for (const [name, text] of files) dataTransfer.items.add(new File([text], name));
    for (const kind of ["dragover", "drop"]) {
        const event = new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true });
        if (document.getElementById("main").dispatchEvent(event)) throw new Error(`the browser takes ${kind}`);
    } }"""


def opened(studio, folder):
    """After shows logs that somebody drops on it or picks by keys, like logs on the command line."""
    lines = demo(folder).read_text().splitlines(keepends=True)
    of = lambda robot: "".join(it for it in lines if json.loads(it)["robot"] == robot)
    ari, go2, large = (folder / name for name in ("ari.jsonl", "go2.jsonl", "large.jsonl"))
    ari.write_text(of("ARI"))
    go2.write_text(of("Go2"))
    with large.open("wb") as file:
        file.truncate((1 << 26) + 1)
    at = studio("--site", "street")
    page = at.page
    page.goto(at.server + "after/")
    expect(page.locator("#troubles")).to_contain_text("open logs here")
    at.errors.clear()  # There is no run yet: the browser reports the answer as an error.
    at.assert_reached_by_tab(18, "logs")
    # Pressed again where Chromium has not opened it at once, as one time of five.
    choosers = []
    page.on("filechooser", lambda it: choosers.append(it))
    for _ in range(5):
        page.focus("#logs")
        page.keyboard.press("Enter")
        page.wait_for_timeout(1_000)
        if choosers:
            break
    choosers[0].set_files([ari, go2])
    expect(page.locator("#what")).to_have_text(re.compile(r"^ari\.jsonl, go2\.jsonl · .* · ARI, Go2$"))
    expect(page.locator("#chip")).to_have_text("✓ Valid")
    page.wait_for_selector("html[data-ready=true]", state="attached")
    page.keyboard.press("End")
    expect(page.locator("#map .body")).to_have_count(2)
    at.assert_fits()
    at.assert_clean()
    # What is no log leaves the page as it is.
    page.evaluate(DROP, [["<b>notes.txt", HOSTILE]])
    expect(page.locator("#troubles")).to_contain_text("<b>notes.txt, line 1: is not a record")
    page.set_input_files("#logs", large)
    expect(page.locator("#troubles")).to_contain_text("67108864 octets are possible")
    expect(page.locator("#troubles p")).to_have_count(1)
    expect(page.locator("#what")).to_have_text(re.compile("^ari"))
    # A log that is cut is shown as far as it goes; another page of the logs before is told.
    other = at.browser.new_page()
    other.goto(at.server + "after/")
    other.wait_for_selector("html[data-ready=true]", state="attached")
    page.evaluate(DROP, [["cut.jsonl", go2.read_text() + '{"atUs": 1, "robot": "cut\n{}\n']])
    expect(page.locator("#what")).to_have_text(re.compile("^cut.* · Go2$"))
    expect(page.locator("#troubles")).to_contain_text("is not a record")
    expect(page.locator("#chip")).to_have_text("✗ Not valid")
    other.keyboard.press("End")
    expect(other.locator("#troubles")).to_have_text("other logs were opened since: load this page anew")
    other.close()
    assert page.evaluate("window.harmed === undefined && document.images.length === 0")


def report(studio, folder):
    """The page After as a file: it shows the same and asks nobody."""
    log = demo(folder, "--report", folder / "page.html")
    at = studio(log)
    at.requests.clear()
    page = at.page
    page.goto((folder / "page.html").as_uri())
    page.wait_for_selector("html[data-ready=true]", state="attached")
    expect(page.locator("#chip")).to_have_text("✓ Valid")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("End")
    expect(page.locator("#map .body")).to_have_count(2)
    expect(page.locator(".row.current")).to_have_count(1)
    at.assert_fits()
    assert at.errors == [], at.errors
    assert all(it.startswith(("file:", "data:")) for it in at.requests), at.requests


def hostile_log(studio, folder):
    """Names with markup, very many events, and a cut in the middle of a record with more behind it."""
    records = [json.loads(line) for line in demo(folder).read_text().splitlines()]
    last = records[-1]["atUs"]
    for number in range(50_000):
        detail = HOSTILE + "x" * 300 if number % 25 == 0 else HOSTILE
        records.append({"atUs": last + number * 100, "robot": "ARI", "entry": "dropped", "layer": "syntax",
                        "cause": "malformed", "detail": detail, "octets": ""})
    for record in records:
        if record["robot"] == "ARI":
            record["robot"] = HOSTILE
    log = folder / "<b>hostile.jsonl"
    cut = '{"atUs": 1, "robot": "cut\n{}\n'
    log.write_text("".join(json.dumps(it) + "\n" for it in records) + cut)
    at = studio(log)
    page = at.open()
    expect(page.locator("#troubles")).to_contain_text(f"line {len(records) + 1}: is not a record")
    expect(page.locator("#chip")).to_have_text("✗ Not valid")
    for key in ("Home", "ArrowRight", "End", "ArrowLeft"):
        page.keyboard.press(key)
    page.wait_for_function("() => document.querySelectorAll('#messages .row').length > 50")
    assert page.evaluate("document.querySelectorAll('*').length") < 9_000
    expect(page.locator("body")).to_contain_text(HOSTILE)
    at.assert_clean()


def play(studio, folder):
    at = studio()
    page = at.open("play/")
    at.assert_reached_by_tab(24, "skip", "scenario", "loss", "delay", "seed", "breakdowns", "auto", "file")
    taken = lambda steps: expect(page.locator("#steps .row")).to_have_count(steps)
    click = lambda part, label: page.locator(f"#{part} button:enabled", has_text=re.compile(f"^{label}")).first.click()
    state = page.locator("#robots .state").nth(1)
    click("robots", "Pedestrian detected")
    taken(1)
    expect(page.locator("#air .what")).to_have_text(re.compile("^robot 1 → robot 2: RAM"))
    click("air", "Lose")
    taken(2)
    expect(page.locator("#air .what")).to_have_count(0)
    click("robots", "Let timer ram run out")
    taken(3)
    click("air", "Deliver")
    taken(4)
    expect(state).to_have_text("HelpRequested (helper)")
    # Back to before it was lost, and on again.
    for steps in (3, 2, 1):
        page.click("#undo")
        taken(steps)
    expect(state).to_have_text("Idle")
    for steps in (2, 3, 4):
        page.click("#redo")
        taken(steps)
    saved = json.loads(at.saved(folder).read_text())
    assert (saved["scenario"], len(saved["steps"])) == ("pair-with-room", 4), saved
    # Files that are no run leave the play as it was.
    for content, cause in (("{cut", "this is no JSON"), ("[]", "this is no run")):
        at.open_file(content)
        expect(page.locator("#troubles")).to_contain_text(cause)
        taken(4)
    # A street of five robots, by keys alone.
    page.evaluate("document.getElementById('own').open = true")
    page.fill("#robots-wanted", "5")
    page.press("#robots-wanted", "Enter")
    expect(page.locator("#robots article")).to_have_count(5)
    page.locator("#robots button", has_text="Pedestrian").first.press("Enter")
    taken(1)
    page.evaluate("document.activeElement.blur()")
    for key, steps in (("l", 2), ("u", 1), ("r", 2), ("w", 3)):
        page.keyboard.press(key)
        taken(steps)
    page.keyboard.press(" ")
    page.wait_for_function("() => document.querySelectorAll('#steps .row').length > 12")
    page.keyboard.press(" ")
    expect(page.locator("#auto")).to_have_attribute("aria-pressed", "false")
    at.assert_fits()
    at.assert_clean()


# Each row of the guide's script, by the first way to it: what it offers is possible there.
ROWS = """async () => {
    const [{ ROWS, choices }, { withRoom }] = await Promise.all(["./guide.js", "./setup.js"].map((it) => import(new URL(it, location))));
    const text = withRoom("pair", (await (await fetch("api/scenarios")).json()).find((it) => it.name === "pair").text);
    const found = new Map(), queue = [["start", []]], wrong = [];
    while (queue.length) {
        const [row, steps] = queue.shift();
        if (found.has(row)) continue;
        found.set(row, steps);
        const body = JSON.stringify({ scenario: "pair-with-room", text, property: "", steps });
        const walk = await (await fetch("api/walk", { method: "POST", body })).json();
        const offered = choices(row, walk.possible), last = walk.frames[steps.length];
        for (const [kind, [, to]] of Object.entries(ROWS[row][1])) {
            if (offered[kind]) queue.push([to, [...steps, offered[kind]]]);
            else wrong.push(`${row}: ${kind} is not possible`);
        }
        if (last.broken.length) wrong.push(`${row}: ${last.broken}`);
        if (last.robots.some((it) => it.showsGo) !== ["go", "road", "across"].includes(row)) wrong.push(`${row}: the sign`);
        if (!Object.keys(ROWS[row][1]).length && last.robots.some((it) => it.state !== "Idle" || it.isDown || it.onDuty)) wrong.push(`${row}: not idle`);
    }
    return [...wrong, ...Object.keys(ROWS).filter((it) => !found.has(it))];
}"""


def guide(studio, folder):
    """The guided crossing by keys alone: a message is lost, a reload keeps the place, and the leader loses power."""
    at = studio()
    page = at.open("play/")
    assert page.evaluate(ROWS) == [], page.evaluate(ROWS)
    said = page.locator("#guide-said")
    said_at = lambda begins: expect(said).to_have_text(re.compile(f"^{begins}"))
    while not page.evaluate("document.activeElement.id.startsWith('guide-')"):
        page.keyboard.press("Tab")
    expect(page.locator("#guide-next")).to_be_focused()
    said_at("A person waits")
    page.keyboard.press("Enter")
    said_at("Robot 1 has detected")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    said_at("The message is lost")
    expect(page.locator("#guide-next")).to_be_focused()

    def assert_escorted():
        expect(page.locator("#person")).to_have_text(re.compile("^Somebody is on the road"))
        person, escort = (page.locator(f"#street {it}").bounding_box() for it in (".walker", ".marker.robot-2"))
        assert abs(person["x"] - escort["x"]) < 60 and abs(person["y"] - escort["y"]) < 20, (person, escort)

    def go_on(until, key="n"):
        while not re.match(until, before := said.text_content()):
            page.keyboard.press(key)
            expect(said).not_to_have_text(before)

    go_on("The person is on the road")
    assert_escorted()
    at.assert_fits()
    page.reload()
    page.wait_for_selector("html[data-ready=true]", state="attached")
    said_at("The person is on the road")
    go_on("The person is across, and both robots are idle.")
    expect(page.locator("#steps .row", has_text="who stepped on the road there is across")).to_have_count(1)
    expect(page.locator("#guide button:visible")).to_have_text(["Play freely"])
    # Back to the person on the road, where the leader fails.
    go_on("The person is on the road", "u")
    page.locator("#guide-power").press("Enter")
    said_at("Robot 1 has lost power")
    go_on("Robot 2 is on duty without a leader")
    assert_escorted()
    go_on("The person is across, and both robots are idle, although")
    # Another step ends the guide; undo leads back to it, and the reader may close it.
    page.locator("#robots button", has_text="Hangs").first.press("Enter")
    said_at("You left the guide: it does not go on from “robot 1: hangs”")
    page.locator("#robots button", has_text="Crashes").first.press("Enter")
    expect(said).to_be_hidden()
    for _ in range(2):
        page.keyboard.press("u")
    said_at("The person is across, and both")
    page.locator("#guide-free").press("Enter")
    expect(said).to_be_hidden()
    page.keyboard.press("Enter")
    said_at("The person is across, and both")
    at.assert_clean()


def published(studio, folder):
    """Play on a server of files: a crossing by itself, and its link in another profile shows the same."""
    pages = pathlib.Path(os.environ["PAGES"])
    if not (pages / "shell/model.wasm").is_file():
        print("published: SKIPPED, there is no model")
        return
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=pages))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    at = studio()
    at.process.kill()
    at.server = f"http://127.0.0.1:{server.server_port}/"
    page = at.open("play/")
    page.keyboard.press("n")
    expect(page.locator("#guide-said")).to_have_text(re.compile("^Robot 1 has detected"))
    expect(page.locator("#steps .row")).to_have_count(1)
    page.fill("#seed", "3")
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press(" ")
    on_road = "() => document.getElementById('person').textContent.startsWith('Somebody is on the road')"
    page.wait_for_function(on_road, timeout=60_000)
    page.keyboard.press(" ")
    expect(page.locator("#auto")).to_have_attribute("aria-pressed", "false")
    shown = lambda of: [of.locator(part).all_text_contents() for part in ("#steps .row", "#robots .words", "#person", "#air .what")]
    # The step that was under way is in the address, too.
    page.wait_for_timeout(1_000)
    link, here = page.url, shown(page)
    with at.browser.new_context() as other:
        there = other.new_page()
        there.goto(link)
        there.wait_for_selector("html[data-ready=true]", state="attached")
        assert shown(there) == here
        # A link that was cut says so, and leaves a page that can be played.
        cut = other.new_page()
        cut.goto(link[: len(link) * 2 // 3])
        cut.wait_for_selector("html[data-ready=true]", state="attached")
        expect(cut.locator("#troubles")).to_contain_text("it was cut or changed")
        expect(cut.locator("#steps .row")).to_have_count(0)
    page.reload()
    page.wait_for_selector("html[data-ready=true]", state="attached")
    assert shown(page) == here
    at.assert_fits()
    page = at.open("explore/")
    expect(page.locator("#about b")).to_have_text(re.compile("^W1: "))
    expect(page.locator("#person-beside")).to_have_text("Somebody waits at the kerb: no sign shows go.")
    page.select_option("#goal", "3")
    page.eval_on_selector("#search", "it => it.requestSubmit()")
    expect(page.locator("#found")).to_have_text(re.compile("^After "))
    at.assert_clean()
    server.shutdown()


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def explore(studio, folder):
    at = studio()
    page = at.open("explore/")
    at.assert_reached_by_tab(20, "skip", "run", "file", "scenario", "who", "goal", "next", "slider")
    # Under the same story somebody is alone on the road by the paper's wording, and not with the kit.
    waits = "Somebody waits at the kerb: no sign shows go."
    for story, paper, kit, on_road in (
        ("led onto the road although the leader is gone", "word of ARI. Nobody guards.", waits, 0),
        ("let across while the guard is still on its way", "word of ARI. Nobody guards.", waits, 0),
        ("left alone in the middle of the road", "word of ARI. Nobody guards.", "sign of ARI. Go2 guards.", 1),
    ):
        page.select_option("#run", label=f"{'W2' if on_road else 'W1'}: {story}")
        expect(page.locator("#about b")).to_have_text(re.compile(story))
        expect(page.locator("#person")).to_have_text("Somebody waits at the kerb.")
        expect(page.locator("#person-beside")).to_have_text(waits)
        page.click("#last")
        expect(page.locator("#person")).to_have_text(f"Somebody is on the road, at the {paper}")
        expect(page.locator("#person-beside")).to_have_text(re.compile(re.escape(kit) + "$"))
        expect(page.locator("#street .walker.onRoad")).to_have_count(1)
        expect(page.locator("#street-beside .walker.onRoad")).to_have_count(on_road)
        expect(page.locator("#street-beside .sign.go")).to_have_count(on_road)
        at.assert_fits()
    # The kit's run goes on by hand.
    page.click("#open-beside")
    expect(page.locator("#person")).to_have_text("Somebody is on the road, at the sign of robot 1. robot 2 guards.")
    expect(page.locator("#possible button").first).to_be_visible()
    page.select_option("#run", label="P1: late acknowledgement after fallback")
    expect(page.locator("#about b")).to_have_text(re.compile("^P1: "))
    expect(page.locator("#street")).to_contain_text("about messages alone")
    expect(page.locator("#beside")).to_be_hidden()
    page.evaluate("document.activeElement.blur()")
    states = lambda: page.locator("#robots .state").all_text_contents()
    seen = [states()]
    assert seen[0] == ["Idle", "Idle"]
    for step in range(1, 10):
        page.keyboard.press("ArrowRight")
        expect(page.locator(".row.current .at")).to_have_text(str(step))
        seen.append(states())
    # The leader counts on a guard that has fallen back.
    assert seen[9] == ["ManeuverExecuting (leader)", "RoleEstablished (follower)"], seen[9]
    for step in range(8, -1, -1):
        page.keyboard.press("ArrowLeft")
        page.wait_for_function("at => Number(document.getElementById('slider').value) === at", arg=step)
        assert states() == seen[step]
    page.keyboard.press("End")
    # The first state where something is so, and one that never is.
    page.select_option("#scenario", "crossing")
    page.select_option("#who", "event")
    page.select_option("#goal", "0")
    page.eval_on_selector("#search", "it => it.requestSubmit()")
    expect(page.locator("#found")).to_have_text(re.compile("^After "))
    expect(page.locator("#person")).to_have_text("Somebody is on the road, at the sign of robot 1. robot 2 guards.")
    expect(page.locator("#touched")).to_contain_text(re.compile("W1.*when.*a pedestrian steps on the road"))
    run_of_page = json.loads(at.saved(folder).read_text())
    page.select_option("#who", "1")
    page.select_option("#goal", "1")
    page.eval_on_selector("#search", "it => it.requestSubmit()")
    expect(page.locator("#found")).to_have_text(re.compile("^Never: all "))
    at.assert_fits()
    at.assert_clean()
    # A run with markup in it, opened from a file; the page reads no file of this machine.
    run_of_page["steps"][1]["action"] = HOSTILE
    run_of_page["property"] = HOSTILE
    path = folder / "<b>hostile.json"
    path.write_text(json.dumps(run_of_page))
    at = studio("--replay", path)
    page = at.open()
    expect(page.locator("#troubles")).to_contain_text("cannot happen")
    expect(page.locator("body")).to_contain_text(HOSTILE)
    assert page.evaluate("window.harmed === undefined && document.images.length === 0")
    at.open_file('{"scenario": "/etc/hostname", "property": "", "steps": []}')
    expect(page.locator("#troubles")).to_contain_text("does not come with the kit")


def live(studio, folder):
    log = folder / "growing.jsonl"
    at = studio("--follow", log)
    page = at.open()
    chip = page.locator("#chip")
    expect(chip).to_have_text("Waiting for a record")
    command = [PROGRAM, "demo", "--port", free_port(), "--log", str(log)]
    crossing = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        expect(chip).to_have_text("● Live")
        expect(page.locator("#map .body")).to_have_count(2)
        page.wait_for_function("() => document.querySelectorAll('#messages .row').length > 4")
        # Both hang: what is shown is said to be old.
        crossing.send_signal(signal.SIGSTOP)
        expect(chip).to_have_text("✗ 2 of 2 silent")
        expect(page.locator(".robot.stale")).to_have_count(2)
        at.assert_fits()
        crossing.send_signal(signal.SIGCONT)
        expect(chip).to_have_text("● Live")
        page.keyboard.press(" ")
        expect(chip).to_have_text("‖ Held")
        page.keyboard.press(" ")
        at.assert_clean()
        # A page whose studio is gone says so.
        at.process.kill()
        expect(chip).to_have_text("✗ Not live")
    finally:
        crossing.kill()


def commanded(studio, folder):
    """Live commands a robot by its operator port, by keys alone: asked first by the robot's name, answered by the robot."""
    sockets = [f"unix:{folder}/{name}.sock" for name in ("ari", "absent")]
    (folder / "ari.toml").write_text(
        f'name = "<b>ARI"\nstation = 1\nbuild = "humanoid"\nboot_file = "ari.boot"\n\n[operator]\nlisten = "{sockets[0]}"\n\n'
        f'[link]\naddress = "127.0.0.1:{free_port()}"\npeers = []\n')
    log = folder / "ari.jsonl"
    command = [PROGRAM, "run", "--config", str(folder / "ari.toml"), "--json"]
    robot = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=log.open("w"), stderr=subprocess.DEVNULL)
    try:
        at = studio("--follow", log, "--operator", sockets[0], "--operator", sockets[1])
        page = at.open()
        asked, newest = page.locator("#asked"), page.locator("#answers > li").first
        expect(page.locator("#chip")).to_have_text("● Live")
        expect(page.locator("#keys button").first).to_have_text("Stop <b>ARI… (s)")
        at.errors.clear()  # The other robot is not there: the browser reports the answer as an error.
        at.assert_reached_by_tab(18, "skip", "hold", "port", "word", "order")
        page.evaluate("document.activeElement.blur()")
        told = lambda: [it["input"]["local"] for it in map(json.loads, log.read_text().splitlines()[:-1]) if "local" in it.get("input", {})]
        # Asked first; what is not confirmed is not told.
        for times, leaves in enumerate(("Escape", "Enter"), 1):
            page.keyboard.press("c")
            expect(page.locator("#asked-title")).to_have_text("Tell <b>ARI: clear?")
            expect(page.locator("#asked-road")).to_contain_text("say it only when you see nobody on the road")
            expect(page.locator("#asked-now")).to_contain_text("Idle. It knows of nobody on the road.")
            expect(page.locator("#cancel")).to_be_focused()
            if leaves == "Escape":
                at.assert_fits()
            page.keyboard.press(leaves)
            expect(asked).to_be_hidden()
            expect(page.locator("#answers > li", has_text="<b>ARI was told nothing")).to_have_count(times)
        assert told() == []
        page.keyboard.press("s")
        expect(page.locator("#tell")).to_be_focused()
        expect(page.locator("#asked-title")).to_have_text("Tell <b>ARI: unavailable emergency-stop?")
        page.keyboard.press("Enter")
        expect(newest).to_contain_text("it has not answered yet")
        expect(newest).to_contain_text("<b>ARI then: Idle, unavailable: emergencyStop.")
        assert told() == [{"availabilityChanged": {"unavailable": "emergencyStop"}}], told()
        # Any command; what the robot refuses is said as it says it.
        page.select_option("#word", "battery")
        page.fill("#words", "full")
        page.press("#words", "Enter")
        expect(page.locator("#asked-title")).to_have_text("Tell <b>ARI: battery full?")
        page.click("#tell")
        expect(newest).to_contain_text("<b>ARI refuses it: 'full' is not a charge from 0 to 100 percent")
        at.assert_fits()
        at.assert_clean()
        # While it is asked the robot hangs: it can not be confirmed. A robot that is not there is not asked about.
        page.select_option("#word", "quit")
        page.click("#order")
        expect(page.locator("#asked-title")).to_have_text("Tell <b>ARI: quit?")
        expect(asked).to_be_visible()
        robot.send_signal(signal.SIGSTOP)
        expect(page.locator("#tell")).to_be_disabled()
        expect(page.locator("#asked-now")).to_contain_text("it hangs, or has just ended")
        robot.send_signal(signal.SIGCONT)
        expect(page.locator("#tell")).to_be_enabled()
        page.keyboard.press("Escape")
        page.select_option("#port", "1")
        page.click("#keys button")
        expect(newest).to_contain_text("absent.sock: no robot is reached")
        expect(asked).to_be_hidden()
        assert len(told()) == 1, told()
    finally:
        robot.kill()
        robot.wait()


def site(studio, folder):
    run("new", folder / "corner")
    file = folder / "corner/site.toml"
    before = file.read_text()
    at = studio("--site", file, "--plan", folder / "corner/plan.toml")
    page = at.open()
    chip, said, where = (page.locator(it) for it in ("#chip", "#said", "#at"))
    expect(said).to_contain_text("plan plan: 2 roles, 2 stages; it fits")
    at.assert_reached_by_tab(29, "skip", "save", "again", "dot kerb chosen", "dot lane chosen", "dot place chosen", "dot line kerb chosen")
    # By the mouse, off its lane and back: the check's words at once, and nothing is written that does not fit.
    dot = page.get_by_role("button", name="place far-lane")
    centre = lambda: [dot.bounding_box()[it] + 12 for it in ("x", "y")]
    x, y = centre()
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y - 120, steps=4)
    expect(where).to_have_text(re.compile(r"^place far-lane: 7\.0\d m east, 9\.0\d m north$"))
    expect(said).to_contain_text("site.toml:39: place 'far-lane' is for guarding, and on no lane")
    page.mouse.up()
    expect(chip).to_have_text("✗ Does not fit")
    page.click("#save")
    expect(said).to_contain_text("Not saved.")
    assert file.read_text() == before
    at.assert_fits()
    # By keys alone: a place by the metre, both ends of a kerb by 0.1 m.
    dot.focus()
    for _ in range(4):
        page.keyboard.press("Shift+ArrowDown")
    expect(said).to_contain_text("it fits")
    page.get_by_role("button", name="kerb 2", exact=True).focus()
    page.keyboard.press("ArrowUp")
    expect(where).to_have_text("kerb 2: -3.00 m east, 7.10 m north; 5.00 m east, 7.10 m north")
    expect(chip).to_have_text("3 moved, not saved")
    dot.focus()
    east, north = re.fullmatch(r"place far-lane: (\S+) m east, (\S+) m north", where.inner_text()).groups()
    page.focus("#save")
    page.keyboard.press("Enter")
    expect(chip).to_have_text("✓ As the file")
    moved = before.replace("[6.0, 5.0]", f"[{float(east)}, {float(north)}]").replace("[-3.0, 7.0], [5.0, 7.0]", "[-3.0, 7.1], [5.0, 7.1]")
    assert file.read_text() == moved != before
    at.assert_clean()
    # What somebody else writes meanwhile is not lost.
    file.write_text(before)
    page.focus("#save")
    page.keyboard.press("Enter")
    expect(page.locator("#troubles")).to_contain_text("has changed since this page read it. Nothing was written")
    assert file.read_text() == before
    page.click("#again")
    expect(chip).to_have_text("✓ As the file")
    dot.focus()
    expect(where).to_have_text("place far-lane: 6.00 m east, 5.00 m north")
    expect(page.locator("#troubles")).to_be_empty()


def main():
    passed = failed = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        for test in (after, opened, report, hostile_log, play, guide, published, explore, live, commanded, site):
            with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as closing:
                def studio(*arguments):
                    at = Studio(browser, *arguments)
                    closing.callback(at.close)
                    return at
                try:
                    test(studio, pathlib.Path(folder))
                    passed += 1
                    print(f"{test.__name__}: ok", flush=True)
                except Exception:
                    failed += 1
                    traceback.print_exc()
                    print(f"{test.__name__}: FAILED", flush=True)
        browser.close()
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
