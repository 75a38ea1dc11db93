"""Forces and torques as arrows: python3 forces_test.py [-k NAME]."""

import math
import unittest

import scenes
from page_case import PageTest, beside, far


class Forces(PageTest):
    def open(self, **changes):
        self.window.open(scenes.sprung(**changes))
        self.click('#tab-show')
        self.click('#loads-on')
        self.window.wait("kte_page.acting.loads.engine || kte_page.acting.why.startsWith('Only')")
        self.drawn()

    def drawn(self):
        self.window.wait('!kte_page.requested')

    def only(self, *groups):
        for group in ('weights', 'elements', 'reactions'):
            if self.window.run('return document.getElementById(arguments[0]).checked', f'loads-{group}') != (group in groups):
                self.click(f'#loads-{group}')
        self.drawn()

    def says(self, words):
        self.window.wait(f"document.getElementById('loads-state').textContent.includes('{words}')")

    def arrows(self):
        """Of each item its name, point, force and torque."""
        return {name: rest for name, *rest in self.window.run(
            'return kte_page.acting.loads.arrows.map(({ item, point, force, torque }) => [item.name, point, force, torque])')}

    def near(self, got, wanted, margin=1e-4):
        for x, y in zip(got, wanted):
            self.assertAlmostEqual(x, y, delta=margin * max(1, abs(y)))

    def test_they_are_off_at_first_and_a_key_shows_them(self):
        self.window.open(scenes.sprung())
        self.assertFalse(self.window.run("return document.getElementById('loads-on').checked"))
        self.assertEqual(self.arrows(), {})
        self.window.key('v')
        self.window.wait('kte_page.acting.loads.engine && kte_page.acting.loads.arrows.length === 6')
        self.assertTrue(self.window.run("return document.getElementById('loads-on').checked"))
        self.window.wait("document.getElementById('live').textContent === 'Forces are shown'")
        self.window.key('v')
        self.drawn()
        self.assertEqual(self.arrows(), {})
        self.assertFalse(self.window.run('return kte_page.acting.arrows.root.visible'))

    def test_recorded_forces_are_those_of_the_formulas(self):
        self.open()
        for t in (0, 0.5, 1.24, 3.02):
            self.seek(t)
            self.drawn()
            arrows, (spring, damper) = self.arrows(), scenes.sprung_forces(t)
            point, force, torque = arrows['spring (hook, tip) on tip']
            self.near(point, scenes.pendulum_tip(t))
            self.near(force, spring)
            self.assertEqual(torque, [0, 0, 0])
            self.near(arrows['spring (hook, tip) on hook'][0], scenes.hook)
            self.near(arrows['spring (hook, tip) on hook'][1], [-x for x in spring])
            self.near(arrows['damper (hook, tip) on tip'][1], damper)
            self.near(arrows['driving actuator (angle, motor) on angle'][2], [0, 0, scenes.motor])
            self.near(arrows['weight of bob'][1], [0, -9.81, 0])
            self.assertEqual(self.text('#loads-state'), '')

    def test_reactions_are_those_of_newton(self):
        scene, states, acceleration = scenes.released()
        self.open(**scene)
        self.only('reactions')
        for i in (0, 20, 57, 100):
            self.seek(0.02 * i)
            self.drawn()
            angle, rate = states[i]
            x, y, a = math.cos(angle), math.sin(angle), acceleration(angle, rate)
            sx, sy = (f + g for f, g in zip(*(f[:2] for f in scenes.forces_on_tip(angle, rate))))
            wanted = [-a * y - rate**2 * x - sx, a * x - rate**2 * y - sy + 9.81, 0]
            self.assertEqual(list(self.arrows()), ['joint hinge on arm'], i)
            self.near(self.arrows()['joint hinge on arm'][1], wanted, 1e-3)
            self.assertAlmostEqual(self.arrows()['joint hinge on arm'][2][2], scenes.motor, delta=1e-3)

    def test_what_was_moved_by_something_else_is_not_taken_for_free(self):
        self.open()
        self.only('reactions')
        self.seek(0.5)
        self.says('something acts here that is not in the model')
        self.assertEqual(self.arrows(), {})
        self.only('elements')
        self.assertEqual(len(self.arrows()), 5, 'forces of elements do not depend on that')
        recording = scenes.sprung()['recordings'][0]
        recording['v'] = scenes.packed('f', [0] * 201)
        self.open(recordings=[recording])
        self.seek(0.5)
        self.says('are not the rates of the coordinates')
        self.assertNotIn('damper (hook, tip) on tip', self.arrows())
        self.near(self.arrows()['spring (hook, tip) on tip'][1], scenes.sprung_forces(0.5)[0])

    def test_between_samples_they_go_from_one_to_the_next(self):
        self.open()
        forces = []
        for t in (0.5, 0.51, 0.52):
            self.seek(t)
            self.drawn()
            forces.append(self.arrows()['damper (hook, tip) on tip'][1])
        self.near(forces[1], [(a + b) / 2 for a, b in zip(forces[0], forces[2])])

    def test_arrows_are_drawn_where_they_act_and_as_long_as_they_should(self):
        self.open()
        self.only('weights')
        self.seek(0.8)
        tip = scenes.pendulum_tip(0.8)
        at = lambda x, y: self.window.colour([tip[0] + x, tip[1] + y, 0])
        ground = self.window.colour(beside)
        for y in (-0.1, -0.2, -0.32):  # the longest is 0.35 m
            red, green, blue = at(0, y)
            self.assertGreater(blue, green + 60, y)
            self.assertFalse(far(at(0.06, y), ground))
            self.assertFalse(far(at(-0.06, y), ground))
        self.assertFalse(far(at(0, -0.38), ground))
        self.slide('#loads-scale', -0.3)
        self.assertGreater(at(0, -0.1)[2], at(0, -0.1)[1] + 60)
        self.assertFalse(far(at(0, -0.22), ground))
        self.drawn()
        scale = f'0.1 m = {0.1 * 9.81 / 0.35 * 10**0.3:.2f} N'
        self.window.wait(f"document.querySelector('#loads .slider output').textContent === '{scale}'")

    def test_torques_are_arcs(self):
        self.open()
        self.only('elements')
        for layer in ('joints', 'ranges', 'links', 'forces'):
            self.click(f'#layer-{layer}')
        self.seek(0)
        ground = self.window.colour(beside)
        for degrees in (20, 100, 170, 260):
            x, y = 0.14 * math.cos(math.radians(degrees)), 0.14 * math.sin(math.radians(degrees))
            red, green, blue = self.window.colour([x, y, 0])
            self.assertGreater(red, green + 60, degrees)
            self.assertFalse(far(self.window.colour([0.8 * x, 0.8 * y, 0]), ground), degrees)
        self.assertFalse(far(self.window.colour([0.14 * math.cos(-0.6), 0.14 * math.sin(-0.6), 0]), ground), 'it is open')

    def test_magnitude_by_pointer_and_keyboard(self):
        self.open()
        self.only('weights')
        x, y = self.middle([a + b for a, b in zip(scenes.pendulum_tip(0), [0, -0.2, 0])])
        self.window.mouse('mouseMoved', x, y, 'none')
        self.window.wait("!document.getElementById('load-label').hidden")
        self.assertEqual(self.text('#load-label'), 'weight of bob: 9.81 N')
        self.window.mouse('mouseMoved', x + 90, y, 'none')
        self.window.wait("document.getElementById('load-label').hidden")
        self.window.run("document.getElementById('loads-list').open = true")
        self.window.wait("document.querySelector('button.load em').textContent === '9.81 N'")
        self.window.run("document.querySelector('#loads-list summary').focus()")
        self.window.key('Tab')
        self.window.wait("!document.getElementById('load-label').hidden && document.getElementById('load-label').textContent === 'weight of bob: 9.81 N'")
        self.window.key('Tab')
        self.window.wait("document.getElementById('load-label').hidden")

    def test_what_is_not_known_is_said(self):
        self.open(v=False)
        self.assertNotIn('damper (hook, tip) on tip', self.arrows())
        self.near(self.arrows()['spring (hook, tip) on tip'][1], scenes.sprung_forces(0)[0])
        self.says('damper (hook, tip) on tip')
        self.says('no velocities')
        recording = scenes.sprung()['recordings'][0]
        recording['signals'] = scenes.packed('f', [float('nan')] * 201)
        self.open(recordings=[recording])
        self.assertNotIn('driving actuator (angle, motor) on angle', self.arrows())
        self.says('driving actuator (angle, motor) on angle. They depend on inputs')
        self.open(model=False)
        self.assertEqual(list(self.arrows()), ['weight of bob'])
        self.says('without its model')

    def test_of_sliders_and_simulations(self):
        self.open()
        self.click('#tab-move')
        self.window.wait('kte_page.simulating.sliders')
        self.slide('#sliders input', -1)
        self.drawn()
        arrows = self.arrows()
        self.assertEqual(arrows['damper (hook, tip) on tip'][1], [0, 0, 0])
        x = self.window.run('return kte_page.sources.q[0]')
        d = [h - c for h, c in zip(scenes.hook, (math.cos(x), math.sin(x), 0))]
        self.near(arrows['spring (hook, tip) on tip'][1], [scenes.spring * (1 - scenes.rest / math.hypot(*d)) * c for c in d])
        self.click('#simulate')
        self.window.wait('kte_page.simulating.simulation.time > 0.3')
        self.click('#simulate')
        self.seek(0.2)
        self.drawn()
        q, v, arrow = self.window.run('''
            const r = kte_page.sources.main, t = r.t[r.index_at(0.2)];
            kte_page.scrub(t);
            const { q, v } = r.state_of(r.index_at(t));
            kte_page.acting.update(performance.now(), t, null, kte_page.poses.world);
            return [q[0], v[0], kte_page.acting.loads.arrows.find(({ item }) => item.name === 'damper (hook, tip) on tip').force];''')
        self.assertNotEqual(v, 0)
        tip = [math.cos(q), math.sin(q)]
        d = [h - c for h, c in zip(scenes.hook, tip)]
        length = math.hypot(*d)
        speed = -(-v * tip[1] * d[0] + v * tip[0] * d[1]) / length
        self.near(arrow, [scenes.damping * speed * c / length for c in d])

    def test_a_pull_is_an_arrow(self):
        self.open(state={'q': [-math.pi / 2], 'v': [0]})
        self.click('#tab-move')
        self.window.wait('kte_page.simulating.sliders')
        self.click('#simulate')
        self.window.wait('kte_page.simulating.simulation.time > 0.05')
        tip = self.window.run('return [...kte_page.poses.world.subarray(14, 17)]')
        self.drag(self.middle(tip), self.middle([tip[0] + 0.5, tip[1] + 0.2, 0]))
        pull = "kte_page.acting.loads.arrows.find(({ item }) => item.name === 'pull on arm')"
        self.window.wait(pull)
        point, force, hand, target, stiffness, damping, v = self.window.run(f"""
            kte_page.acting.update(performance.now(), 0, kte_page.simulation, kte_page.poses.world);
            const {{ point, force }} = {pull}, {{ target, stiffness, damping }} = kte_page.pull;
            return [point, force, [...kte_page.pull.from([])], target.toArray(), stiffness, damping, kte_page.simulation.v[0]];""")
        self.near(point, hand)
        self.near(force, [stiffness * (t - x) - damping * rate for t, x, rate in zip(target, point, (-v * point[1], v * point[0], 0))])
        lengths = self.window.run("""
            const { loads } = kte_page.acting;
            return loads.arrows.map(({ force }) => loads.metres.force * Math.hypot(...force));""")
        self.assertLessEqual(max(lengths), 0.35 + 1e-9)
        self.window.mouse('mouseReleased', *self.middle(target))
        self.window.wait(f'!{pull}')
        self.click('#simulate')

    def test_reactions_are_not_known_where_damping_acted(self):
        self.open()
        self.only('reactions')
        self.click('#tab-move')
        self.window.wait('kte_page.simulating.sliders')
        self.slide('#damping', 0.9)
        self.click('#simulate')
        self.window.wait("kte_page.simulating.simulation.time > 0.1 && kte_page.acting.loads.arrows.length === 1")
        self.click('#simulate')
        self.seek(0.05)
        self.drawn()
        self.assertEqual(self.arrows(), {})
        self.click('#tab-show')
        self.says('accelerations')


if __name__ == '__main__':
    unittest.main(verbosity=1)
