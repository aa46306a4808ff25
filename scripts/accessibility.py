"""What stands in the way of readers who use a keyboard or a screen reader, or see little: for check_report and check_live_page.

The rules are those of axe-core, in the version that scripts/axe/package-lock.json pins with its checksum. npm fetches it
once, into build/axe; the pages that are checked load it from there, as the reports themselves fetch nothing.
"""
import os
import shutil
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PINNED = os.path.join(ROOT, "scripts/axe")
INSTALLED = os.path.join(ROOT, "build/axe")
GRAVE = ("serious", "critical")
MOST_PLACES = 3  # that are named of each rule

RUN = """
const done = arguments[0];
const drawn = () => new Promise(resolve => { requestAnimationFrame(() => requestAnimationFrame(resolve)); });  // in the size it has now
drawn().then(() => axe.run(document, {resultTypes: ['violations']})).then(
  ({violations}) => done(violations.map(({id, impact, help, nodes}) => ({id, impact, help, places: nodes.map(node => node.target.flat().join(' '))}))),
  error => done([{id: 'axe', impact: 'critical', help: 'the rules could not be run: ' + error, places: []}]));
"""


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def is_installed():
    lock = os.path.join(INSTALLED, "package-lock.json")
    return os.path.exists(lock) and read(lock) == read(os.path.join(PINNED, "package-lock.json"))


def install():
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            raise SystemExit("%s is missing, which fetches the rules of accessibility: install it by scripts/setup --dev" % program)
    shutil.rmtree(INSTALLED, ignore_errors=True)
    fetched = INSTALLED + ".new"
    shutil.rmtree(fetched, ignore_errors=True)
    shutil.copytree(PINNED, fetched)
    done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=fetched, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit("npm cannot fetch axe-core as scripts/axe/package-lock.json asks for; it needs the network once:\n" + done.stdout)
    os.rename(fetched, INSTALLED)


def rules():
    """axe-core as JavaScript."""
    if not is_installed():
        install()
    return read(os.path.join(INSTALLED, "node_modules/axe-core/axe.min.js"))


def violations(browser, script):
    """What is wrong with the page as it is shown now, in words; `script` are the rules."""
    browser.set_script_timeout(120)
    browser.execute_script(script)
    wrong = []
    for rule in browser.execute_async_script(RUN):
        if rule["impact"] in GRAVE:
            places, more = rule["places"][:MOST_PLACES], len(rule["places"]) - MOST_PLACES
            wrong.append("accessibility, %s: %s (%s) at %s%s" % (rule["impact"], rule["help"], rule["id"], ", ".join(places),
                                                                 " and %d more" % more if more > 0 else ""))
    return wrong
