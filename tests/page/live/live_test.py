"""A page of a program that runs (kte::live_page), in a headless Chromium: python3 live_test.py PROGRAM."""

import pathlib
import subprocess
import sys
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import browser


class Program:
    """The program, and the lines that it prints."""

    def __init__(self, path):
        self.process = subprocess.Popen([path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.url = self.process.stdout.readline().strip()
        self.lines = []
        self.reader = threading.Thread(target=lambda: self.lines.extend(iter(self.process.stdout.readline, '')), daemon=True)
        self.reader.start()

    def printed(self, start, seconds=20):
        """Waits for a line that begins so."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for line in self.lines:
                if line.startswith(start):
                    return line.strip()
            time.sleep(0.01)
        raise AssertionError(f'no line {start!r} in {self.lines}')

    def end(self):
        self.process.stdin.close()
        self.process.wait(20)
        self.reader.join(20)
        self.process.stdout.close()


class LiveTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.window = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.window.close()

    def setUp(self):
        self.program = Program(program)
        self.window.driver.get(self.program.url)
        self.window.wait("document.getElementById('live-state')?.textContent.startsWith('t = ')")

    def tearDown(self):
        self.program.end()

    def run_script(self, script, *arguments):
        return self.window.run(script, *arguments)

    def text(self, identifier):
        return self.run_script('return document.getElementById(arguments[0]).textContent', identifier)

    def click(self, identifier):
        self.run_script('document.getElementById(arguments[0]).click()', identifier)

    def slide(self, value):
        self.run_script('''
            const slider = document.querySelector('#sliders input');
            slider.value = arguments[0];
            slider.dispatchEvent(new Event('input'));''', str(value))

    def tip(self):
        """Where the tip is in the page's picture."""
        return self.run_script('''
            const i = kte_page.scene.frames.findIndex((frame) => frame.name === 'tip');
            return [...kte_page.poses.world.slice(7 * i, 7 * i + 3)];''')

    def test_mechanism_moves_in_step_with_the_program(self):
        self.assertEqual(self.text('title'), 'Live </script> arm')
        self.assertEqual(self.text('tab-move'), 'Live')
        first = self.tip()
        self.window.wait(f'Math.abs(kte_page.poses.world[7 * kte_page.scene.frames.findIndex((f) => f.name === "tip") + 1] - {first[1]}) > 0.1')
        x, y, _ = self.tip()
        self.assertAlmostEqual(x * x + y * y, 1, places=4)
        self.window.wait('kte_page.recording.count > 100')
        self.assertEqual(self.window.console(), [])

    def test_slider_sets_a_value_of_the_program(self):
        self.assertEqual(self.run_script("return document.querySelector('#sliders .name').textContent"), 'angle </script>')
        self.assertEqual(self.run_script("return [...document.querySelectorAll('#sliders .end')].map((end) => end.textContent)"), ['−1', '1'])
        self.slide(0.5)
        self.program.printed('angle 0.5')
        self.slide(-0.25)
        self.program.printed('angle -0.25')
        self.assertEqual(self.window.console(), [])

    def test_pause_and_reset(self):
        self.click('live-run')
        self.window.wait("document.getElementById('live-run').textContent === 'Run'")
        self.window.wait("document.getElementById('live-state').textContent.endsWith('paused')")
        self.window.wait('kte_page.simulation.running === false')
        time_there = self.run_script('return kte_page.simulation.time')
        self.assertGreater(time_there, 0)
        self.click('live-reset')
        self.program.printed('reset 1')
        self.window.wait('kte_page.simulation.time === 0')
        self.click('live-run')
        self.window.wait('kte_page.simulation.time > 0.1')
        self.assertEqual(self.window.console(), [])

    def test_looking_back_pauses(self):
        self.window.wait('kte_page.recording.count > 50')
        self.run_script('kte_page.scrub(kte_page.recording.start)')
        self.window.wait("document.getElementById('live-run').textContent === 'Run'")
        self.window.wait('kte_page.sources.mode === "play"')
        self.assertAlmostEqual(self.run_script('return kte_page.player.time'), self.run_script('return kte_page.recording.start'))
        self.click('live-run')
        self.window.wait('kte_page.sources.mode === "simulate" && kte_page.simulation.running')
        self.assertEqual(self.window.console(), [])

    def test_recording_is_saved(self):
        self.click('live-record')
        self.window.wait("document.getElementById('live-recording').textContent.startsWith('Recording: ')")
        self.window.wait('kte_page.panel.row_count > 20')
        self.click('live-record')
        self.window.wait("document.querySelector('#live-recording a')")
        csv = self.window.driver.execute_async_script("const done = arguments[0]; fetch('recording.csv').then((r) => r.text()).then(done)")
        self.assertTrue(csv.startswith('t,q,q/v\n'))
        self.assertGreater(csv.count('\n'), 20)
        self.assertEqual(self.window.console(), [])

    def test_end_of_the_program_is_said(self):
        self.program.end()
        self.window.wait("document.getElementById('engine-state').textContent === 'The program has ended.'")
        self.assertTrue(self.run_script("return document.getElementById('live-run').disabled"))
        self.assertEqual(self.window.console(), [])

    def test_lost_connection_is_said(self):
        self.program.process.kill()
        self.program.process.wait(20)
        self.window.wait("document.getElementById('engine-state').textContent.startsWith('Connection lost')")
        self.window.console()  # that nothing answers


if __name__ == '__main__':
    program = sys.argv.pop(1)
    unittest.main()
