"""A page of a program that runs (kte::live_page), in a headless Chromium: python3 live_test.py PROGRAM."""

import math
import pathlib
import subprocess
import sys
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from page_case import WindowTest


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


class LiveTest(WindowTest):
    def setUp(self):
        self.program = Program(program)
        self.window.driver.get(self.program.url)
        self.window.wait("document.getElementById('live-state')?.textContent.startsWith('t = ')")

    def tearDown(self):
        self.program.end()

    def tip(self):
        """Where the tip is in the page's picture."""
        return self.run_script('''
            const i = kte_page.scene.frames.findIndex((frame) => frame.name === 'tip');
            return [...kte_page.poses.world.slice(7 * i, 7 * i + 3)];''')

    def test_mechanism_moves_in_step_with_the_program(self):
        self.assertEqual(self.text('#title'), 'Live </script> arm')
        self.assertEqual(self.text('#tab-move'), 'Live')
        first = self.tip()
        self.window.wait(f'Math.abs(kte_page.poses.world[7 * kte_page.scene.frames.findIndex((f) => f.name === "tip") + 1] - {first[1]}) > 0.1')
        x, y, _ = self.tip()
        self.assertAlmostEqual(x * x + y * y, 1, places=4)
        self.window.wait('kte_page.recording.count > 100')
        self.assertEqual(self.window.console(), [])

    def test_slider_sets_a_value_of_the_program(self):
        self.assertEqual(self.run_script("return document.querySelector('#sliders .name').textContent"), 'angle </script>')
        self.assertEqual(self.run_script("return [...document.querySelectorAll('#sliders .end')].map((end) => end.textContent)"), ['−1', '1'])
        self.slide('#sliders input', 0.5)
        self.program.printed('angle 0.5')
        self.slide('#sliders input', -0.25)
        self.program.printed('angle -0.25')
        self.assertEqual(self.window.console(), [])

    def test_a_drag_pulls_a_body_of_the_program(self):
        self.run_script('kte_page.player.speed = 0.05')  # or the tip is not where it was
        self.window.wait('kte_page.controls.speed === 0.05')
        tip = self.tip()
        x, y = self.middle(tip)
        self.drag((x, y), self.middle([tip[0], tip[1] + 0.3, 0]))
        frame, point, target = self.run_script("const { frame, point, target } = kte_page.pull; return [frame, [...point], target.toArray()]")
        self.assertEqual(self.run_script('return kte_page.scene.frames[arguments[0]].name', frame), 'joint')
        self.assertTrue(self.run_script('return kte_page.picture.pull_line.object.visible'))
        self.program.printed(f'pull joint at {point[0]:.3f} {point[1]:.3f} to {target[0]:.3f} {target[1]:.3f}')
        self.window.wait('kte_page.simulation.pull?.frame === "joint"')
        time.sleep(2.5)
        self.assertNotIn('released\n', self.program.lines, 'it holds on')
        self.window.mouse('mouseReleased', x, y)
        self.program.printed('released')
        self.window.wait('kte_page.simulation.pull === null && !kte_page.picture.pull_line.object.visible')
        self.assertEqual(self.window.console(), [])

    def test_forces_are_shown(self):
        self.window.key('v')
        self.window.wait('kte_page.acting.loads.engine && kte_page.acting.loads.arrows.length === 1')
        self.click('#loads-reactions')  # of what the program moves without saying how fast
        self.click('#tab-show')
        self.window.wait("document.getElementById('loads-state').textContent.includes('are not the rates of the coordinates')")
        # of 1 kg at 1 m
        force, q, v, a = self.run_script("""
            const { engine, arrows } = kte_page.acting.loads, { q, v, signals } = kte_page.simulation;
            const at = engine.loads(q, v, signals), track = kte_page.scene.frames.find((f) => f.name === 'joint').track;
            return [at.reactions[track].force, q[0], v[0], engine.accelerations(q, v)[0]];""")
        x, y = math.cos(q), math.sin(q)
        for got, wanted in zip(force, (-a * y - v * v * x, a * x - v * v * y + 9.81, 0)):
            self.assertAlmostEqual(got, wanted, places=4)
        self.assertEqual(self.window.console(), [])

    def test_pause_and_reset(self):
        self.click('#live-run')
        self.window.wait("document.getElementById('live-run').textContent === 'Run'")
        self.window.wait("document.getElementById('live-state').textContent.endsWith('paused')")
        self.window.wait('kte_page.simulation.running === false')
        time_there = self.run_script('return kte_page.simulation.time')
        self.assertGreater(time_there, 0)
        self.click('#live-reset')
        self.program.printed('reset 1')
        self.window.wait('kte_page.simulation.time === 0')
        self.click('#live-run')
        self.window.wait('kte_page.simulation.time > 0.1')
        self.assertEqual(self.window.console(), [])

    def test_looking_back_pauses(self):
        self.window.wait('kte_page.recording.count > 50')
        self.run_script('kte_page.scrub(kte_page.recording.start)')
        self.window.wait("document.getElementById('live-run').textContent === 'Run'")
        self.window.wait('kte_page.sources.mode === "play"')
        self.assertAlmostEqual(self.run_script('return kte_page.player.time'), self.run_script('return kte_page.recording.start'))
        self.click('#live-run')
        self.window.wait('kte_page.sources.mode === "simulate" && kte_page.simulation.running')
        self.assertEqual(self.window.console(), [])

    def test_recording_is_saved(self):
        self.click('#live-record')
        self.window.wait("document.getElementById('live-recording').textContent.startsWith('Recording: ')")
        self.window.wait('kte_page.panel.row_count > 20')
        self.click('#live-record')
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
