"""Headless Chromium that keeps account of what a page asks for and complains of."""

import json
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
DRIVER = shutil.which("chromedriver")
FLAGS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--force-color-profile=srgb", "--hide-scrollbars",
]


class Browser:
    """A browser with one page."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        for flag in [*FLAGS, f"--user-data-dir={self.profile.name}", "--window-size=1300,1000"]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(executable_path=DRIVER))

    def close(self):
        self.driver.quit()
        self.profile.cleanup()

    def open(self, address):
        """Opens a page; returns how many seconds it took until everything was drawn."""
        self.said, self.asked = [], []
        self.driver.get("about:blank")
        self._take_logs()
        self.said, self.asked = [], []
        self.driver.get(address)
        # Two frames after the script has run, the first picture is on the screen.
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())))"
        )
        return self.js("return performance.getEntriesByType('navigation')[0].loadEventEnd / 1000")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def click(self, selector):
        """Clicks in the middle of an element, as a mouse would: whatever lies there gets it."""
        node = self.one(selector)
        self.js("arguments[0].scrollIntoView({ block: 'center' })", node)
        node.click()

    def drag(self, selector, right, down):
        """Moves the mouse, its button held, from the middle of an element."""
        node = self.one(selector)
        self.js("arguments[0].scrollIntoView({ block: 'center' })", node)
        ActionChains(self.driver).click_and_hold(node).move_by_offset(right, down).release().perform()

    def key(self, *keys):
        self.driver.switch_to.active_element.send_keys(*keys)

    def media(self, **features):
        """What the page is told of the reader's wishes: prefers_color_scheme='dark', or media='print'."""
        medium = features.pop("media", "")
        told = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": medium, "features": told})

    def size(self, width, height):
        self.driver.set_window_size(width, height)

    def shot(self, file):
        self.driver.save_screenshot(str(file))

    def complaints(self):
        """What the console says, and every request that leaves the file."""
        self._take_logs()
        return self.said + self.asked

    def _take_logs(self):
        self.said += [f"console: {entry['message']}" for entry in self.driver.get_log("browser")]
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                address = message["params"]["request"]["url"]
                if not address.startswith(("data:", "file:", "about:")):
                    self.asked.append(f"request: {address}")


__all__ = ["Browser", "CHROMIUM", "DRIVER", "Keys"]
