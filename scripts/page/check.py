"""Checks the pages of `hssh map --html` and `hssh stars --html` in headless Chromium: what is on them, what clicks and keys do, what they ask for.

    pip install selenium
    python3 scripts/page/check.py target/release/hssh [FOLDER for screenshots]

Needs Chromium and ChromeDriver (Debian's packages chromium and chromium-driver); says so and does nothing without.
With HSSH_DATA, pages of real logs are looked at, too.
"""

import http.server
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import worlds

try:
    from browser import CHROMIUM, DRIVER, Browser, Keys
except ImportError:
    CHROMIUM = DRIVER = None

ROOT = Path(__file__).resolve().parent.parent.parent
OPENS_IN = 2.0  # seconds, with 500 places

failures = []


def check(holds, what):
    if not holds:
        failures.append(what)
        print(f"  FAILED: {what}")


def same(one, other, what):
    check(one == other, f"{what}: {one!r} is not {other!r}")


def make(hssh, folder, source, name, *flags):
    """The page of an exploration or log, and the answer that it is to show. A text is written to a file first."""
    if isinstance(source, str):
        file = folder / name
        file.write_text(source)
        source = file
    page = folder / f"{len(list(folder.iterdir()))}.html"
    done = subprocess.run([hssh, "map", source, "--json", "--html", page, *flags], capture_output=True, text=True, timeout=300)
    assert page.exists(), f"{source}: no page\n{done.stderr}"
    return page, json.loads(done.stdout)


def make_plan(hssh, folder, source, *flags):
    """The page of a grid map, and what it is to show."""
    page = folder / f"{len(list(folder.iterdir()))}.html"
    done = subprocess.run([hssh, "stars", source, "--json", "--html", page, *flags], capture_output=True, text=True, timeout=300)
    assert page.exists(), f"{source}: no page\n{done.stderr}"
    return page, json.loads(done.stdout)


def fresh(browser, page):
    return browser.open(page.as_uri())


def soon(holds):
    """Whether something comes to hold within a few seconds: what a page does by itself takes a moment."""
    until = time.monotonic() + 5
    while not holds() and time.monotonic() < until:
        time.sleep(0.02)
    return holds()


def quiet(browser, what):
    same(browser.complaints(), [], f"{what}: console and network")


def agrees(browser, answer, what):
    """What the page makes of the branches is what the library says of the maps."""
    made = browser.js(
        "const { state, replay, wordsOf } = window.hssh;"
        "return state.data.maps.map(map => { const model = replay(state.data, wordsOf(map.branch));"
        "  const name = ({ place, end }) => ({ place, end: state.data.stars[model.places[place].star].ends[end].name });"
        "  return { visits: model.visits.map(({ place, rotation, finding }) => ({ place, rotation, finding })),"
        "    links: model.links.map(({ ends: [from, to] }) => ({ from: name(from), to: name(to) })),"
        "    stars: model.places.map(place => state.data.stars[place.star].name) }; })"
    )
    for map_made, told in zip(made, answer["maps"], strict=True):
        visits = [{key: visit[key] for key in ("place", "rotation", "finding")} for visit in told["visits"]]
        same(map_made["visits"], visits, f"{what}: visits of map {told['rank']}")
        joined = [{"from": link["from"], "to": link["to"]} for link in told["links"]]
        same(map_made["links"], joined, f"{what}: links of map {told['rank']}")
        same(map_made["stars"], [place["star"] for place in told["places"]], f"{what}: places of map {told['rank']}")


def paths_agree(browser, answer, what):
    """Ways of one path have one color: as many colors as paths with more than one place."""
    long_paths = [path for path in answer["maps"][0]["paths"] if len(path["places"]) > 1 or path["circular"]]
    classes = browser.js("return [...new Set([...document.querySelectorAll('#map-picture .link')].map(link => [...link.classList].filter(name => /^path|^dash/.test(name)).join(' ')))].length")
    same(classes, min(len(long_paths), 32), f"{what}: colors of paths")


def test_headline(browser, page, answer, what):
    fresh(browser, page)
    shown = browser.text("#headline")
    check(answer["verdict"]["sentence"] in shown, f"{what}: the verdict is at the top")
    for trusted in answer["certificate"]["trusted"]:
        check(trusted["sentence"][1:] in shown, f"{what}: what is taken on trust is at the top")
    least, most = answer["maps"][0]["probability"] if answer["maps"] and "probability" in answer["maps"][0] else (None, None)
    same("DOUBTFUL" in shown, most is not None and least < 0.5, f"{what}: DOUBTFUL")
    same(browser.one("h1").text, answer["input"]["name"], f"{what}: the name")


def test_clicks(browser, page, answer, what):
    fresh(browser, page)
    agrees(browser, answer, what)
    paths_agree(browser, answer, what)
    places = len(answer["maps"][0]["places"])
    same(len(browser.all("#map-picture .place")), places, f"{what}: places drawn")
    same(len(browser.all("#map-picture .link")), len(answer["maps"][0]["links"]), f"{what}: ways drawn")
    browser.click(f"[data-place='{places - 1}'] circle:nth-of-type(2)")
    check(browser.text("#detail").startswith(f"Place {places - 1}"), f"{what}: a click on a place shows it")
    same(browser.js("return document.querySelectorAll('#map-picture .place.chosen').length"), 1, f"{what}: it is marked")
    browser.click("#detail li .inline")
    check(browser.text("#detail h3").split()[0] in ("Way", "Visit"), f"{what}: a click in the list goes on")
    browser.js("document.querySelector('[data-way=\"0\"] .reach').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    same(browser.text("#detail h3"), "Way 0", f"{what}: a click on a way shows it")
    browser.click("#clear")
    check("Choose a place" in browser.text("#detail"), f"{what}: nothing is chosen any more")
    for part in ("places", "ways", "visits", "levels"):
        browser.click(f"#{part} summary")
        check(soon(lambda: len(browser.all(f"#{part} tbody tr")) > 0), f"{what}: the list of {part} opens")
    same(len(browser.all("#visits tbody tr")), len(answer["maps"][0]["visits"]), f"{what}: visits listed")
    browser.click("#visits tbody tr:last-child button")
    check(browser.text("#detail").startswith(f"Visit {len(answer['maps'][0]['visits']) - 1}"), f"{what}: a visit is shown")
    quiet(browser, what)


def keys_on_the_picture(browser, invitation, what):
    """Enter chooses, arrows go from place to place, plus and 0 zoom, and Escape leaves the invitation to choose."""
    browser.js("document.querySelector('#map-picture .place[tabindex=\"0\"]').focus()")
    browser.key(Keys.ENTER)
    same(browser.text("#detail h3"), "Place 0", f"{what}: Enter chooses a place")
    moved = set()
    for arrow in (Keys.ARROW_LEFT, Keys.ARROW_RIGHT, Keys.ARROW_UP, Keys.ARROW_DOWN):
        browser.key(arrow)
        moved.add(browser.text("#detail h3"))
        same(browser.js("return document.activeElement.dataset.place"), browser.text("#detail h3").split()[-1], f"{what}: the focus goes along")
    check(len(moved) > 1, f"{what}: arrows go to other places")
    wide = browser.js("return document.getElementById('map-picture').viewBox.baseVal.width")
    browser.key("+")
    check(browser.js("return document.getElementById('map-picture').viewBox.baseVal.width") < wide, f"{what}: + zooms in")
    browser.key("0")
    check(abs(browser.js("return document.getElementById('map-picture').viewBox.baseVal.width") - wide) < 1e-6 * wide, f"{what}: 0 shows everything")
    browser.key(Keys.ESCAPE)
    check(invitation in browser.text("#detail"), f"{what}: Escape chooses nothing")


def test_keys(browser, page, what):
    fresh(browser, page)
    browser.js("document.body.focus()")
    reached = set()
    for _ in range(60):
        browser.key(Keys.TAB)
        reached.add(browser.js("const at = document.activeElement; return at.id || at.getAttribute('data-place') && 'place' || at.getAttribute('data-node') && 'node' || at.className || at.tagName"))
        outline = browser.js(
            "const at = document.activeElement; const style = getComputedStyle(at);"
            "const halo = at.querySelector?.('.halo, .reach'); return style.outlineStyle !== 'none' || (halo && getComputedStyle(halo).stroke !== 'none')"
        )
        check(outline, f"{what}: the focus is seen on {browser.js('return document.activeElement.outerHTML.slice(0, 90)')}")
        if "node" in reached and "levels" in reached:
            break
    for stop in ("theme", "place", "travel", "rank-1", "node"):
        check(stop in reached, f"{what}: Tab comes to {stop} (it came to {sorted(reached)})")
    keys_on_the_picture(browser, "Choose a place", what)
    browser.js("document.querySelector('[data-node=\"0\"]').focus()")
    browser.key(Keys.ARROW_RIGHT)
    browser.key(Keys.ENTER)
    check(browser.text("#map-caption").startswith("Hypothesis 1 of the tree"), f"{what}: the tree goes by keys")
    unnamed = browser.js(
        "return [...document.querySelectorAll('button, select, input, [role=button], [role=treeitem]')]"
        ".filter(at => !(at.textContent.trim() || at.getAttribute('aria-label') || at.labels?.length)).map(at => at.outerHTML)"
    )
    same(unnamed, [], f"{what}: everything to act on has a name")
    quiet(browser, what)


def test_slider(browser, page, answer, what):
    fresh(browser, page)
    last = answer["input"]["explained"]
    history = browser.js("return window.hssh.state.data.history")
    slide = "const at = document.getElementById('travel'); at.value = arguments[0]; at.dispatchEvent(new Event('input', { bubbles: true }))"
    places = browser.js("return document.querySelectorAll('#map-picture .place').length")
    counts = []
    for travel in range(last + 1):
        browser.js(slide, travel)
        caption = browser.text("#map-caption")
        if travel < last:
            check(caption.startswith(f"What the on-line search believed after travel {travel} of"), f"{what}: the slider at {travel} says what it shows: {caption}")
        counts.append(browser.js("return document.querySelectorAll('#map-picture .place').length"))
    same(counts[0], 1, f"{what}: it begins with one place")
    same(counts[-1], places, f"{what}: it ends with the answer")
    same(len(history["beliefs"]), last + 1, f"{what}: a belief after each travel")
    browser.js(slide, 1)
    browser.click("#mode-now")
    check("what is known today" in browser.text("#map-caption"), f"{what}: hindsight is called that")
    same(browser.js("return document.querySelectorAll('#map-picture .place').length"), len({visit["place"] for visit in answer["maps"][0]["visits"][:2]}), f"{what}: the part that was travelled")
    browser.one("#travel").send_keys(Keys.ARROW_RIGHT)
    check("first 2 travels" in browser.text("#map-caption"), f"{what}: the slider goes by keys")
    quiet(browser, what)


def last_belief_is_the_answer(browser, answer, what):
    """The on-line search ends where the search of everything does: branch for branch."""
    words = browser.js("return window.hssh.state.known.branches.at(-1).join(' ')")
    same(words, answer["maps"][0]["branch"], f"{what}: the last belief is the best map")


def test_ranking(browser, page, answer, what):
    fresh(browser, page)
    check(len(answer["maps"]) > 1, f"{what}: there are several maps")
    browser.click("#rank-2")
    check(browser.text("#map-caption").startswith("Map 2 of"), f"{what}: a click on a rank shows that map")
    difference = answer["maps"][1]["difference"]["sentence"]
    check(difference[1:] in browser.text("#difference"), f"{what}: what tells it from the first")
    browser.click("#parting")
    check(browser.text("#detail h3") == f"Visit {answer['maps'][1]['difference']['parting']['visit']}", f"{what}: where they part")
    browser.click("#map-before")
    check(browser.text("#map-caption").startswith("Map 1 of"), f"{what}: back to the first")
    browser.click("#map-next")
    same(browser.js("return window.hssh.state.rank"), 2, f"{what}: on to the second")
    if "costs" in answer["maps"][1]:
        total = f"{answer['maps'][1]['costs']['total']:.3f}"
        check(total in browser.text("#costs"), f"{what}: its costs, {total}")
    quiet(browser, what)


def test_tree(browser, page, answer, what):
    fresh(browser, page)
    nodes = browser.all("#tree-picture .node")
    made = answer["search"]["nodes"]
    check(len(nodes) == made if made <= 1500 else 0 < len(nodes) <= 1500, f"{what}: {len(nodes)} of {made} hypotheses")
    hidden = browser.js("return window.hssh.state.data.tree.nodes.reduce((sum, node) => sum + (node.hidden ?? 0), 0)")
    same(len(nodes) + hidden, made, f"{what}: those shown and those that are not")
    browser.js("document.querySelector('#tree-picture .node.ranked').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    check("it explains everything" in browser.text("#map-caption"), f"{what}: a click shows the hypothesis")
    same(len(browser.all("#tree-picture .chosen")), 1, f"{what}: it is marked")
    quiet(browser, what)


def test_colors(browser, page, what):
    def ground():
        return browser.js("return getComputedStyle(document.body).backgroundColor")

    browser.media(prefers_color_scheme="light")
    fresh(browser, page)
    light = ground()
    browser.media(prefers_color_scheme="dark")
    dark = ground()
    check(light != dark, f"{what}: dark where the system is")
    choose = "const at = document.getElementById('theme'); at.value = arguments[0]; at.dispatchEvent(new Event('change'))"
    browser.js(choose, "light")
    same(ground(), light, f"{what}: light although the system is dark")
    contrasts(browser, f"{what}, light")
    browser.js(choose, "dark")
    browser.media(prefers_color_scheme="light")
    same(ground(), dark, f"{what}: dark although the system is light")
    contrasts(browser, f"{what}, dark")
    browser.js(choose, "")
    browser.media()
    quiet(browser, what)


def contrasts(browser, what):
    """Text against its ground, by the rule of WCAG: at least 4.5 to 1; 3 to 1 for large text and for lines."""
    poor = browser.js("""
        const luminance = color => { const [r, g, b] = color.match(/[\\d.]+/g).map(Number).map(c => c / 255).map(c => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
        const contrast = (one, other) => { const [a, b] = [luminance(one), luminance(other)].sort((x, y) => y - x); return (a + 0.05) / (b + 0.05); };
        const groundOf = at => { for (; at; at = at.parentElement) { const c = getComputedStyle(at).backgroundColor; if (!c.endsWith(', 0)') && c !== 'transparent') return c; } return 'rgb(255, 255, 255)'; };
        const poor = [];
        for (const at of document.querySelectorAll('p, li, td, th, h1, h2, h3, button, label, summary, caption, dt, dd, .banner, output')) {
          if (!at.textContent.trim() || at.disabled || !at.getClientRects().length) continue;
          const found = contrast(getComputedStyle(at).color, groundOf(at));
          if (found < 4.5) poor.push(`${at.tagName} ${at.textContent.slice(0, 30)}: ${found.toFixed(2)}`);
        }
        const ground = getComputedStyle(document.getElementById('map-picture')).backgroundColor;
        for (const at of document.querySelectorAll('#map-picture .link')) {
          const found = contrast(getComputedStyle(at).stroke, ground);
          if (found < 3) poor.push(`${at.getAttribute('class')}: ${found.toFixed(2)}`);
        }
        return [...new Set(poor)];
    """)
    same(poor, [], f"{what}: contrast")


def test_sizes(browser, page, what):
    fresh(browser, page)
    for width in (1300, 800, 500):
        browser.size(width, 900)
        wider = browser.js("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
        check(wider <= 0, f"{what}: nothing sticks out {wider} px at a width of {width}")
    browser.size(1300, 1000)
    browser.media(media="print")
    check(browser.js("return getComputedStyle(document.querySelector('.zoom')).display") == "none", f"{what}: no buttons on paper")
    browser.js("window.dispatchEvent(new Event('beforeprint'))")
    check(len(browser.all("details tbody tr")) > 0, f"{what}: lists are printed")
    browser.media()
    quiet(browser, what)


def test_nasty(browser, page, answer, what):
    seconds = fresh(browser, page)
    same(browser.js("return document.querySelectorAll('img, iframe, script:not([type])').length"), 1, f"{what}: one script, no image")
    names = {place["star"] for place in answer["maps"][0]["places"]}
    browser.click("#places summary")
    for name in names:
        check(soon(lambda: name in browser.text("#places")), f"{what}: {name!r} is shown as it is")
    for number in range(len(names)):
        browser.js("document.querySelector(`[data-place='${arguments[0]}']`).dispatchEvent(new MouseEvent('click', { bubbles: true }))", number)
    same(browser.one("h1").text, answer["input"]["name"], f"{what}: the file's name")
    quiet(browser, what)
    return seconds


def test_no_map(browser, page, answer, what):
    fresh(browser, page)
    same(answer["maps"], [], f"{what}: no map")
    check("NO MAP" in browser.text("#headline"), f"{what}: says so")
    check("no map explains travel" in browser.text("#time"), f"{what}: says where it ends: {browser.text('#time')}")
    check(len(browser.all("#map-picture .place")) > 0, f"{what}: what was before is drawn")
    quiet(browser, what)


def test_one_place(browser, page, what):
    fresh(browser, page)
    same(len(browser.all("#map-picture .place")), 1, f"{what}: one place")
    box = browser.js("const { x, y, width, height } = document.getElementById('map-picture').viewBox.baseVal; return [x, y, width, height]")
    check(all(abs(number) < 1e3 for number in box) and box[2] > 0, f"{what}: a picture of it: {box}")
    browser.click("[data-place='0'] circle:nth-of-type(2)")
    same(browser.text("#detail h3"), "Place 0", f"{what}: a click shows it")
    quiet(browser, what)


def test_log(browser, page, answer, what):
    fresh(browser, page)
    agrees(browser, answer, what)
    same(len(browser.all("#map-picture image")), 1, f"{what}: the building")
    check(browser.js("return document.querySelector('#map-picture image').getBoundingClientRect().width > 100"), f"{what}: the building is seen")
    browser.js("document.querySelector('[data-place=\"1\"]').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    check(len(browser.all("#detail .local image")) > 0, f"{what}: local maps of a place")
    browser.click("#layer-grid")
    same(len(browser.all("#map-picture image")), 0, f"{what}: the building is switched off")
    check(len(browser.all(".robot-way")) == 1, f"{what}: the robot's way")
    quiet(browser, what)


def test_large(browser, page, answer, what):
    seconds = min(fresh(browser, page) for _ in range(3))
    print(f"  {what}: {len(answer['maps'][0]['places'])} places, {page.stat().st_size / 1e6:.1f} MB, opens in {seconds:.2f} s")
    check(seconds < OPENS_IN, f"{what}: opens in {seconds:.2f} s, more than {OPENS_IN}")
    same(len(browser.all("#map-picture .place")), len(answer["maps"][0]["places"]), f"{what}: all places")
    started = time.monotonic()
    browser.js("document.querySelector('[data-place=\"7\"]').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    same(browser.text("#detail h3"), "Place 7", f"{what}: a click")
    click = time.monotonic() - started
    check(click < 0.5, f"{what}: a click takes {click:.2f} s")
    quiet(browser, what)


KINDS = {"region": "regions", "passage": "passages", "place": "places", "connection": "connections"}


def press(browser, selector):
    """A click on what may lie under something else."""
    browser.js("document.querySelector(arguments[0]).dispatchEvent(new MouseEvent('click', { bubbles: true }))", selector)


def test_plan(browser, page, account, what):
    """Everything of a grid map is drawn, listed and told when it is chosen, in the words of the account."""
    fresh(browser, page)
    same(browser.one("h1").text, account["name"], f"{what}: the name")
    same("DOUBTFUL" in browser.text("#headline"), "doubt" in account, f"{what}: DOUBTFUL")
    doors = sum(passage["kind"] == "door" for passage in account["passages"])
    check(f"{doors} of them with a door" in browser.text("#headline"), f"{what}: {doors} doors")
    same(len(browser.all("#map-picture image")), 1, f"{what}: the grid")
    for kind, of in KINDS.items():
        same(len(browser.all(f"#map-picture [data-{kind}]")), len(account[of]), f"{what}: {of} drawn")
        browser.click(f"#{of} summary")
        check(soon(lambda: len(browser.all(f"#{of} tbody tr")) == len(account[of])), f"{what}: {of} listed")
    for number, region in enumerate(account["regions"]):
        press(browser, f"[data-region='{number}']")
        told = browser.text("#detail")
        check(f"{region['area']:.1f} m²" in told, f"{what}: the area of region {number}: {told}")
        same(len(browser.all("#detail li")), len(region["passages"]), f"{what}: where region {number} leads")
        same(browser.js("return document.querySelectorAll('#map-picture .chosen').length"), 1, f"{what}: it is marked")
    for number, passage in enumerate(account["passages"]):
        press(browser, f"[data-passage='{number}']")
        told = browser.text("#detail")
        likely = int(100 * passage["door_probability"] + 0.5)
        check(f"{likely} %" in told, f"{what}: how probable a door is passage {number}: {told}")
        same(browser.text("#detail h3").lower(), f"{passage['kind']} {number}", f"{what}: its name")
    for number, place in enumerate(account["places"]):
        press(browser, f"[data-place='{number}']")
        same(len(browser.all("#detail .star")), 1 if place["ends"] else 0, f"{what}: the star of place {number}")
        same(len(browser.all("#detail li")), len(place["ends"]), f"{what}: its ends")
        leads = browser.js("return [...document.querySelectorAll('#detail li button')].map(at => at.textContent).filter(name => name.startsWith('connection')).length")
        same(leads, sum(end["place"] == number for connection in account["connections"] for end in connection["ends"]), f"{what}: where place {number} leads")
    for number, connection in enumerate(account["connections"]):
        press(browser, f"[data-connection='{number}']")
        check(browser.text("#detail").startswith(f"Connection {number}"), f"{what}: connection {number} is told")
        same(len(browser.all("#detail p button")), 2 + len(connection.get("passages", [])), f"{what}: what it joins and leads through")
    browser.click("#clear")
    check("Choose a room" in browser.text("#detail"), f"{what}: nothing is chosen any more")
    for layer, gone in (("grid", "image"), ("regions", ".area"), ("ways", ".walk")):
        browser.click(f"#layer-{layer}")
        same(len(browser.all(f"#map-picture {gone}")), 0, f"{what}: {layer} switched off")
        browser.click(f"#layer-{layer}")
    quiet(browser, what)


def test_plan_mouse(browser, page, what):
    """A room is chosen by a click of a real mouse, and not by the end of a movement that dragged the picture."""
    fresh(browser, page)
    browser.click(".place circle:nth-of-type(2)")
    same(browser.text("#detail h3"), "Place 0", f"{what}: a click on a place")
    browser.click("#clear")
    browser.drag("#map-picture", 60, 40)
    check("Choose a room" in browser.text("#detail"), f"{what}: dragging chooses nothing")
    quiet(browser, what)


def test_plan_keys(browser, page, what):
    fresh(browser, page)
    keys_on_the_picture(browser, "Choose a room", what)
    browser.js("document.body.focus()")
    reached = set()
    for _ in range(24):
        browser.key(Keys.TAB)
        reached.add(browser.js("const at = document.activeElement; return at.id || at.getAttribute('data-place') && 'place' || at.parentElement?.id || at.className || at.tagName"))
    for stop in ("theme", "place", "regions", "layer-grid"):
        check(stop in reached, f"{what}: Tab comes to {stop} (it came to {sorted(reached)})")
    unnamed = browser.js(
        "return [...document.querySelectorAll('button, select, input, [role=button]')]"
        ".filter(at => !(at.textContent.trim() || at.getAttribute('aria-label') || at.labels?.length)).map(at => at.outerHTML)"
    )
    same(unnamed, [], f"{what}: everything to act on has a name")
    quiet(browser, what)


class Serving(http.server.BaseHTTPRequestHandler):
    """Serves a page, and one message of news once it is told to."""

    page, news, told, ended = b"", b"", threading.Event(), threading.Event()

    def say(self, message):
        self.wfile.write(message + b"\n\n")
        self.wfile.flush()

    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream" if self.path == "/news" else "text/html; charset=utf-8")
        self.end_headers()
        if self.path == "/news":
            self.say(b"event: robot\ndata: " + json.dumps({"pose": [2, 1, 0.5], "hits": [[3, 3], [4, 1]]}).encode())
            self.told.wait(20)
            self.say(b"data: " + self.news)
            self.ended.wait(20)
            self.say(b"event: end\ndata: {}")
        else:
            self.wfile.write(self.page)

    def log_message(self, *_):
        pass


def test_live(browser, page, other, what):
    """A served page takes news, and keeps what is chosen."""
    mark = '<script type="application/json" id="data">'
    html = page.read_text().replace("connect-src 'none'", "connect-src 'self'").replace(mark + "{", mark + '{"live":"/news",')
    news = json.loads(other.read_text().split(mark)[1].split("</script>")[0])
    Serving.page, Serving.news = html.encode(), json.dumps(news).encode()
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Serving)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    browser.open(f"http://127.0.0.1:{server.server_port}/")
    browser.click("[data-place='1'] circle:nth-of-type(2)")
    check(soon(lambda: len(browser.all(".robot-now .hit")) == 2), f"{what}: the robot as it is now")
    places = len(browser.all("#map-picture .place"))
    browser.js("window.kept = true")
    Serving.told.set()
    check(soon(lambda: len(browser.all("#map-picture .place")) != places), f"{what}: the page is drawn anew")
    check(browser.js("return window.kept"), f"{what}: without being loaded again")
    same(browser.text("#detail h3"), "Place 1", f"{what}: what was chosen is chosen")
    Serving.ended.set()
    check(soon(lambda: "nothing more will come" in browser.text("#live")), f"{what}: says when it is over")
    asked = [line for line in browser.complaints() if not line.startswith(f"request: http://127.0.0.1:{server.server_port}/")]
    same(asked, [], f"{what}: console and network")
    server.shutdown()


def screenshots(browser, folder, pages):
    folder.mkdir(parents=True, exist_ok=True)
    for name, page in pages.items():
        fresh(browser, page)
        browser.shot(folder / f"{name}.png")
        height = browser.js("return document.documentElement.scrollHeight")
        browser.size(1300, min(height + 100, 6000))
        browser.shot(folder / f"{name}-whole.png")
        browser.size(1300, 1000)


def run(hssh, folder, shots):
    fixture = lambda name: ROOT / "fixtures" / name
    browser = Browser()
    try:
        aces, aces_says = make(hssh, folder, fixture("aces.ron"), "", "--planar")
        print("aces.ron: one map, measured")
        test_headline(browser, aces, aces_says, "aces.ron")
        test_clicks(browser, aces, aces_says, "aces.ron")
        test_keys(browser, aces, "aces.ron")
        test_slider(browser, aces, aces_says, "aces.ron")
        last_belief_is_the_answer(browser, aces_says, "aces.ron")
        test_tree(browser, aces, aces_says, "aces.ron")
        test_colors(browser, aces, "aces.ron")
        test_sizes(browser, aces, "aces.ron")
        print("figure-2-4.ron: several maps by topology alone")
        several, several_says = make(hssh, folder, fixture("figure-2-4.ron"), "")
        test_headline(browser, several, several_says, "figure-2-4.ron")
        test_clicks(browser, several, several_says, "figure-2-4.ron")
        test_ranking(browser, several, several_says, "figure-2-4.ron")
        test_slider(browser, several, several_says, "figure-2-4.ron")
        test_tree(browser, several, several_says, "figure-2-4.ron")
        last_belief_is_the_answer(browser, several_says, "figure-2-4.ron")
        print("aces.ron by topology alone: many maps")
        many, many_says = make(hssh, folder, fixture("aces.ron"), "", "--search", "breadth-first", "--planar", "--all")
        test_ranking(browser, many, many_says, "aces.ron breadth-first")
        agrees(browser, many_says, "aces.ron breadth-first")
        print("misread.ron: errors of perception")
        misread, misread_says = make(hssh, folder, fixture("misread.ron"), "", "--planar", "--readings")
        test_headline(browser, misread, misread_says, "misread.ron")
        test_clicks(browser, misread, misread_says, "misread.ron")
        for correction in misread_says["readings"]["corrections"]:
            check(correction["sentence"][1:] in browser.text("#headline"), f"misread.ron: {correction['sentence']}")
        print("names that look like markup")
        nasty, nasty_says = make(hssh, folder, worlds.nasty(), "<img src=y onerror=alert(3)>&\"'.ron")
        test_nasty(browser, nasty, nasty_says, "nasty names")
        print("no map, and one place")
        none, none_says = make(hssh, folder, worlds.NO_MAP, "none.ron")
        test_no_map(browser, none, none_says, "no map")
        one, _ = make(hssh, folder, worlds.ONE_PLACE, "one.ron")
        test_one_place(browser, one, "one place")
        print("floor.yaml: a grid map")
        names = folder / "names.csv"
        names.write_text("x,y,name\n6,8,</script><b>&lab\n")
        plan, plan_says = make_plan(hssh, folder, fixture("grids/floor.yaml"), "--names", names)
        test_plan(browser, plan, plan_says, "floor.yaml")
        test_plan_mouse(browser, plan, "floor.yaml")
        test_plan_keys(browser, plan, "floor.yaml")
        test_colors(browser, plan, "floor.yaml")
        test_sizes(browser, plan, "floor.yaml")
        detailed, detailed_says = make_plan(hssh, folder, fixture("grids/floor.yaml"), "--detail")
        test_plan(browser, detailed, detailed_says, "floor.yaml --detail")
        print("500 places")
        large, large_says = make(hssh, folder, worlds.streets(20, 25), "large.ron", "--search", "best-first")
        test_large(browser, large, large_says, "streets")
        agrees(browser, large_says, "streets")
        print("news while it is looked at")
        test_live(browser, aces, several, "live")
        pages = {"aces": aces, "several": several, "many": many, "misread": misread, "nasty": nasty, "none": none, "one": one, "large": large, "plan": plan}
        if data := os.environ.get("HSSH_DATA"):
            for grid, *flags in (("aces.yaml",), ("gdc3/3.yaml",), ("rooms/office_a.png", "--resolution", "0.05")):
                page, says = make_plan(hssh, folder, Path(data) / "gridmap" / grid, *flags)
                test_plan(browser, page, says, grid)
                print(f"{grid}: {len(says['regions'])} regions, {page.stat().st_size / 1e6:.1f} MB, opens in {fresh(browser, page):.2f} s")
                pages[f"plan-{Path(grid).stem}"] = page
            for log in ("aces", "intel"):
                print(f"{log}.log.gz: a real log")
                page, says = make(hssh, folder, Path(data) / "logs" / f"{log}.log.gz", "")
                test_headline(browser, page, says, log)
                test_log(browser, page, says, log)
                last_belief_is_the_answer(browser, says, log)
                print(f"  {page.stat().st_size / 1e6:.1f} MB, opens in {fresh(browser, page):.2f} s")
                pages[f"log-{log}"] = page
        else:
            print("real logs: skipped, for HSSH_DATA names no data folder")
        if shots:
            screenshots(browser, shots, pages)
    finally:
        browser.close()


def main():
    if not (CHROMIUM and DRIVER):
        print("page: SKIPPED, for there is no Chromium with ChromeDriver (Debian: chromium, chromium-driver) or no Python package selenium here")
        return
    with tempfile.TemporaryDirectory() as folder:
        run(Path(sys.argv[1]).resolve(), Path(folder), Path(sys.argv[2]) if len(sys.argv) > 2 else None)
    if failures:
        sys.exit(f"page: {len(failures)} of the checks failed")
    print("page: every check holds")


if __name__ == "__main__":
    main()
