"""A headless Chromium with the page; says "skipped: chromium" and ends with 77 where Chromium or its driver are missing."""

import json
import os
import pathlib
import shutil
import sys
import tempfile

folder = pathlib.Path(__file__).resolve().parent
page_file = folder.parent.parent / 'share' / 'kte' / 'page.html'
hole = '<script type="application/json" id="kte-scene">null</script>'


def skip(reason):
    print(f'skipped: chromium ({reason})')
    sys.exit(77)


try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    skip('no Python package selenium: Debian has it as python3-selenium')
chromium = shutil.which('chromium') or shutil.which('google-chrome')
driver_program = shutil.which('chromedriver')
if not chromium or not driver_program:
    skip('no program chromium and chromedriver: Debian has them as chromium and chromium-driver')


def filled_page(scene):
    """The page with a scene, as kte::write_page fills it."""
    text = page_file.read_text(encoding='utf-8')
    assert text.count(hole) == 1
    data = json.dumps(scene, separators=(',', ':')).replace('<', '\\u003c')
    return text.replace(hole, hole.replace('null', data))


class Browser:
    """One window; pages come from files, and no host has an address."""

    def __init__(self, width=1280, height=800, *flags):
        options = webdriver.ChromeOptions()
        options.binary_location = chromium
        for flag in ['--headless=new', '--no-sandbox', '--no-first-run', '--disable-quic', '--disable-background-networking',
                     '--disable-component-update', '--disable-sync', '--disable-dev-shm-usage', '--use-angle=swiftshader',
                     '--enable-unsafe-swiftshader', '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1', '--hide-scrollbars',
                     f'--window-size={width},{height}', *flags]:
            options.add_argument(flag)
        options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
        self.driver = webdriver.Chrome(service=Service(driver_program), options=options)
        self.driver.set_script_timeout(30)
        self.size(width, height)
        self.files = tempfile.TemporaryDirectory(prefix='kte_page_')
        self.count = 0

    def size(self, width, height):
        self.driver.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {'width': width, 'height': height, 'deviceScaleFactor': 1, 'mobile': width < 600})

    def media(self, **features):
        self.driver.execute_cdp_cmd('Emulation.setEmulatedMedia', {
            'features': [{'name': name.replace('_', '-'), 'value': value} for name, value in features.items()]})

    def open(self, scene, fragment='#t=0'):
        """Opens the page with a scene, and waits until it is drawn."""
        self.count += 1
        path = os.path.join(self.files.name, f'{self.count}.html')
        with open(path, 'w', encoding='utf-8', errors='surrogatepass') as file:
            file.write(filled_page(scene))
        self.driver.get(f'file://{path}{fragment}')
        self.wait("window.kte_page?.drawn > 1 || !document.getElementById('message').hidden")
        return path

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, condition, seconds=20):
        """Waits until an expression of JavaScript holds."""
        done = self.driver.execute_async_script('''
            const [condition, seconds, done] = arguments, end = performance.now() + 1000 * seconds;
            const holds = new Function(`return (${condition});`);
            (function look() {
              if (holds()) done(true);
              else if (performance.now() > end) done(false);
              else setTimeout(look, 10);
            })();''', condition, seconds)
        assert done, f'{condition} did not come true in {seconds} s'

    def key(self, key, *, shift=False, code=None):
        """A key press of the keyboard, at what has the focus."""
        text = key if len(key) == 1 else ''
        codes = {'ArrowLeft': 37, 'ArrowRight': 39, 'ArrowUp': 38, 'ArrowDown': 40, 'Home': 36, 'End': 35, ' ': 32, 'Enter': 13, 'Tab': 9, 'Escape': 27}
        event = {'key': key, 'code': code or key, 'windowsVirtualKeyCode': codes.get(key, ord(key[0].upper())), 'modifiers': 8 if shift else 0}
        self.driver.execute_cdp_cmd('Input.dispatchKeyEvent', dict(event, type='keyDown', text=text) if text else dict(event, type='rawKeyDown'))
        self.driver.execute_cdp_cmd('Input.dispatchKeyEvent', dict(event, type='keyUp'))

    def mouse(self, kind, x, y, button='left', count=1):
        self.driver.execute_cdp_cmd('Input.dispatchMouseEvent', {
            'type': kind, 'x': x, 'y': y, 'button': button if kind != 'mouseMoved' or button != 'left' else 'left',
            'buttons': 0 if kind == 'mouseReleased' or button == 'none' else 1, 'clickCount': count})

    def click(self, x, y, count=1):
        self.mouse('mousePressed', x, y, count=count)
        self.mouse('mouseReleased', x, y, count=count)

    def console(self):
        """Messages of the console since the last call, without those of the graphics driver about its own speed."""
        return [entry['message'] for entry in self.driver.get_log('browser')
                if entry['level'] in ('SEVERE', 'WARNING') and 'GPU stall due to ReadPixels' not in entry['message']]

    def colour(self, point):
        """What is drawn where a point of the world is, as r g b, or None outside of the canvas."""
        return self.run('''
            kte_page.sources.update(kte_page.player.time, kte_page.simulating.simulation);
            kte_page.picture.draw(kte_page.player.time, null);
            const stage = kte_page.picture.stage, at = stage.project(...arguments[0], {});
            if (at.x < 0 || at.y < 0 || at.x >= stage.width || at.y >= stage.height) return null;
            const gl = stage.renderer.getContext(), pixel = new Uint8Array(4), ratio = stage.renderer.getPixelRatio();
            gl.readPixels(Math.floor(at.x * ratio), Math.floor((stage.height - at.y) * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
            return [...pixel].slice(0, 3);''', point)

    def picture(self, path):
        self.driver.save_screenshot(str(path))

    def close(self):
        self.driver.quit()
        self.files.cleanup()
