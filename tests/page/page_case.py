"""What the tests of pages share: a window with a page, and what is seen in it."""

import unittest

import browser

beside = [0.31, 0.05, 0]  # where no part of the pendulum ever is


def far(a, b):
    """Whether two colours are clearly different."""
    return sum(abs(x - y) for x, y in zip(a, b)) > 60


class WindowTest(unittest.TestCase):
    """A window for all tests of a class."""

    @classmethod
    def setUpClass(cls):
        cls.window = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.window.close()

    def run_script(self, script, *arguments):
        return self.window.run(script, *arguments)

    def text(self, selector):
        return self.window.run('return document.querySelector(arguments[0]).textContent', selector)

    def click(self, selector):
        self.window.run('document.querySelector(arguments[0]).click()', selector)

    def slide(self, selector, value):
        """Moves a slider."""
        self.window.run('''
            const slider = document.querySelector(arguments[0]);
            slider.value = arguments[1];
            slider.dispatchEvent(new Event('input'));''', selector, str(value))

    def middle(self, point):
        """Where a point of the world is in the window."""
        return self.window.run('''
            const box = document.getElementById('canvas').getBoundingClientRect();
            const at = kte_page.picture.stage.project(...arguments[0], {});
            return [box.left + at.x, box.top + at.y];''', point)

    def drag(self, start, end, steps=10):
        """Presses the mouse and moves it; it stays pressed."""
        self.window.mouse('mousePressed', *start)
        for i in range(1, steps + 1):
            self.window.mouse('mouseMoved', *(a + (b - a) * i / steps for a, b in zip(start, end)))


class PageTest(WindowTest):
    """Pages from files; the console is silent."""

    def setUp(self):
        self.window.size(1280, 800)
        self.window.media(prefers_color_scheme='light', prefers_reduced_motion='no-preference')

    def tearDown(self):
        self.assertEqual(self.window.console(), [], 'the console is silent')

    def time(self):
        return self.window.run('return kte_page.player.time')

    def seek(self, t):
        self.window.run('kte_page.scrub(arguments[0])', t)
