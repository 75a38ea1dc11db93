"""The page that kte::write_page fills, in a headless Chromium: python3 page_test.py [-k NAME]."""

import hashlib
import time
import unittest

import browser
import scenes
from page_case import PageTest, beside, far


class Drawing(PageTest):
    def in_view(self, points):
        return self.window.run('''
            const stage = kte_page.picture.stage;
            return arguments[0].every((point) => {
              const at = stage.project(...point, {});
              return at.z < 1 && at.x > 0 && at.x < stage.width && at.y > 0 && at.y < stage.height;
            });''', points)

    def test_without_a_scene(self):
        self.window.open(None)
        self.assertIn('no mechanism', self.text('#message'))

    def test_empty_scene(self):
        self.window.open(scenes.empty())
        self.assertEqual(self.text('#title'), 'Empty')

    def test_mechanism_covers_the_pixels_of_its_poses(self):
        self.window.open(scenes.pendulum())
        ground = self.window.colour(beside)
        for t in (0, 0.44, 1.02, 2.9):
            self.seek(t)
            tip = scenes.pendulum_tip(t)
            angle = scenes.pendulum_angle(t)
            self.assertTrue(far(self.window.colour(tip), ground), f'the tip at {t} s')
            self.assertTrue(far(self.window.colour([0.5 * x for x in tip]), ground), f'the link at {t} s')
            for other in (angle + 0.35, angle - 0.35):
                x, y = scenes.math.cos(other), scenes.math.sin(other)
                self.assertFalse(far(self.window.colour([0.85 * x, 0.85 * y, 0]), ground), f'beside the link at {t} s')

    def test_plane_is_seen_from_above_and_gravity_points_down(self):
        self.window.open(scenes.pendulum())
        base, right, up = (self.middle(p) for p in ([0, 0, 0], [0.5, 0, 0], [0, 0.5, 0]))
        self.assertGreater(right[0] - base[0], 50)
        self.assertAlmostEqual(right[0] - base[0], base[1] - up[1], delta=0.01)
        self.assertAlmostEqual(right[1], base[1], delta=0.01)
        self.window.open(scenes.pendulum(gravity=[9.81, 0, 0]))
        base, x = (self.middle(p) for p in ([0, 0, 0], [0.5, 0, 0]))
        self.assertGreater(x[1] - base[1], 50, 'x is down')
        self.assertAlmostEqual(x[0], base[0], delta=0.01)

    def test_all_of_a_motion_is_in_view(self):
        for scene in (scenes.robot(seconds=2), scenes.pendulum(seconds=2), scenes.pendulum(seconds=2, dimension=3)):
            self.window.open(scene)
            for t in (0, 1, 1.57, 2):
                self.seek(t)
                inside = self.window.run('''
                    kte_page.sources.update(kte_page.player.time);
                    kte_page.picture.draw(kte_page.player.time, null);
                    const { stage, poses } = kte_page.picture, w = poses.world;
                    return [...Array(poses.count).keys()].every((i) => {
                      const at = stage.project(w[7 * i], w[7 * i + 1], w[7 * i + 2], {});
                      return at.x > 0 && at.x < stage.width && at.y > 0 && at.y < stage.height;
                    });''')
                self.assertTrue(inside, f'{scene["title"]} at {t} s')

    def test_shapes_are_in_view_in_all_their_motion(self):
        # a bar far outside of its frame, which turns by half a turn in one of 2000 rows, while it goes away and comes back
        times = [0.01 * i for i in range(2001)]
        poses = [[([8 * scenes.math.sin(scenes.math.pi * t / 20), 0, 0], [0, 0, 0, 1] if i == 1007 else scenes.still)] for i, t in enumerate(times)]
        half = [0.1, 1.5, 0.4]
        self.window.open(scenes.empty(
            tracks=1, frames=[{'name': 'bar', 'track': 0}], recordings=[scenes.recording('turn', times, poses)],
            shapes=[{'frame': 0, 'pose': [0, 5, 0, *scenes.still], 'type': 'box', 'size': [2 * x for x in half], 'colour': None, 'role': 'visual', 'mesh': None}]))
        corners = [(x, y, z) for x, y in ((-half[0], 3.5), (-half[0], 6.5), (8 + half[0], 6.5), (8 + half[0], -6.5)) for z in (-half[2], half[2])]
        self.assertTrue(self.in_view(corners), 'the first view')
        self.window.run("kte_page.picture.stage.camera.zoom(6)")
        self.assertFalse(self.in_view(corners))
        self.window.click(*self.window.run("const b = document.getElementById('fit').getBoundingClientRect(); return [b.left + 5, b.top + 5]"))
        self.assertTrue(self.in_view(corners), 'Fit')

    def test_the_row_that_reaches_farthest_is_in_view(self):
        times = [0.01 * i for i in range(2001)]
        poses = [[([0, 0, 5 if i == 1007 else 0], scenes.still)] for i in range(2001)]
        self.window.open(scenes.empty(tracks=1, frames=[{'name': 'ball', 'track': 0}], recordings=[scenes.recording('hop', times, poses)],
                                      shapes=[{'frame': 0, 'pose': [0, 0, 0, *scenes.still], 'type': 'sphere', 'size': [0.2], 'colour': None, 'role': 'visual', 'mesh': None}]))
        self.assertTrue(self.in_view([(0, 0, 5.2)]))

    def test_inertias_do_not_hide_shapes(self):
        box = {'pose': [0, 0, 0, *scenes.still], 'type': 'box', 'size': [0.4, 0.4, 0.4], 'colour': None, 'role': 'visual', 'mesh': None}
        joint = {'type': 'revolute_joint_3D', 'kind': 'revolute', 'axis': [0, 0, 1], 'coordinates': [], 'lower': None, 'upper': None}
        names = ['base', 'sensor of the base', 'small hand', 'large hand']
        radii = [0.1, 0.1, 0.19, 0.21]
        self.window.open(scenes.empty(
            tracks=3, frames=[{'name': names[0], 'track': 0}, {'name': names[1], 'parent': 0, 'pose': [1, 0, 0, *scenes.still]},
                              {'name': names[2], 'track': 1}, {'name': names[3], 'track': 2}],
            joints=[dict(joint, name='a', before=0, after=2), dict(joint, name='b', before=2, after=3)],
            bodies=[{'name': n, 'frame': i, 'mass': 1, 'centre': [0, 0, 0], 'orientation': scenes.still, 'ellipsoid': [r] * 3}
                    for i, (n, r) in enumerate(zip(names, radii))],
            shapes=[dict(box, frame=0)],
            recordings=[scenes.recording('still', [0], [[([0, 0, 0], scenes.still), ([0, 1, 0], scenes.still), ([0, 2, 0], scenes.still)]])]))
        seen = '''
            const seen = new Set();
            kte_page.picture.mechanism.root.traverseVisible((o) => { if (o.userData.kind === 'body') seen.add(o.userData.index); });
            return [...seen].sort();'''
        self.assertEqual(self.window.run(seen), [2], 'shapes stand for the base and what is fixed to it, and a large globe is left out')
        self.window.run("document.getElementById('layer-shaped-bodies').click()")
        self.assertEqual(self.window.run(seen), [0, 1, 2, 3])

    def test_a_page_that_takes_long_says_how_far_it_is(self):
        n = 120
        points = [x for i in range(n) for j in range(n) for x in (i / n, j / n, 0.1 * scenes.math.sin(i) * scenes.math.sin(j))]
        corners = [c for i in range(n - 1) for j in range(n - 1) for a in (i * n + j,) for c in (a, a + 1, a + n, a + 1, a + n + 1, a + n)]
        mesh = {'positions': scenes.packed('f', points), 'indices': scenes.packed('I', corners)}
        watch = self.window.driver.execute_cdp_cmd('Page.addScriptToEvaluateOnNewDocument', {'source': '''
            window.said = [];
            new MutationObserver(() => {
              const line = document.getElementById('loading'), last = said.at(-1);
              if (line && last?.text !== line.textContent) said.push({ text: line.textContent, seen: getComputedStyle(line).visibility });
            }).observe(document, { childList: true, subtree: true, characterData: true });'''})
        self.window.driver.execute_cdp_cmd('Emulation.setCPUThrottlingRate', {'rate': 10})
        try:
            self.window.open(scenes.empty(
                tracks=1, frames=[{'name': 'base', 'track': 0}], meshes=[dict(mesh, name=f'm{i}') for i in range(20)],
                shapes=[{'frame': 0, 'pose': [0, 0, 0.1 * i, *scenes.still], 'type': 'mesh', 'size': [], 'colour': None, 'role': 'visual', 'mesh': i} for i in range(20)],
                recordings=[scenes.recording('still', [0], [[([0, 0, 0], scenes.still)]])]))
            self.window.wait("document.getElementById('loading') === null")
        finally:
            self.window.driver.execute_cdp_cmd('Emulation.setCPUThrottlingRate', {'rate': 1})
            self.window.driver.execute_cdp_cmd('Page.removeScriptToEvaluateOnNewDocument', watch)
        said = self.window.run('return said')
        self.assertEqual([s['text'] for s in said][-1], 'Drawing')
        self.assertEqual(said[-1]['seen'], 'visible', 'after a second')
        counts = [int(s['text'].split()[0]) for s in said if s['text'].endswith(' of 20 meshes read')]
        self.assertGreater(len(counts), 5)
        self.assertEqual(counts, sorted(counts))
        self.window.open(scenes.pendulum())
        self.window.wait("document.getElementById('loading') === null")

    def test_shapes_meshes_and_forces(self):
        triangle = {'name': 'tetrahedron', 'positions': scenes.packed('f', [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
                    'indices': scenes.packed('I', [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])}
        place = [0, 0, 0, 1, 0, 0, 0]
        kinds = ['spring', 'torsion_spring', 'damper', 'beam', 'bushing', 'motor', 'limit', 'friction', 'loop', 'contact', 'other']
        scene = scenes.pendulum(
            dimension=3, meshes=[triangle],
            shapes=[{'frame': 2, 'pose': place, 'type': t, 'size': s, 'colour': [1, 0, 0, 1], 'role': 'visual', 'mesh': 0 if t == 'mesh' else None}
                    for t, s in [('box', [.1, .2, .3]), ('sphere', [.1]), ('cylinder', [.1, .2]), ('capsule', [.1, .2]), ('ellipsoid', [.1, .2, .3]),
                                 ('plane', [0, 0]), ('plane', [1, 1]), ('mesh', [])]]
            + [{'frame': 0, 'pose': place, 'type': 'box', 'size': [1], 'colour': None, 'role': 'visual', 'mesh': None},
               {'frame': 0, 'pose': place, 'type': 'box', 'size': [3, 3, 3], 'colour': None, 'role': 'collision', 'mesh': None}],
            forces=[{'type': k, 'kind': k, 'name': k, 'frames': f, 'coordinates': [0]} for k in kinds for f in ([0, 2], [0, 1], [2], [])])
        self.window.open(scene)
        self.assertIn('Shape 8 is not drawn', self.text('#notes'))
        drawn = self.window.run('''
            const kinds = {};
            kte_page.picture.mechanism.root.traverse((o) => { if (o.isMesh) (kinds[o.userData.kind] ??= new Set()).add(o.userData.index); });
            return Object.fromEntries(Object.entries(kinds).map(([kind, all]) => [kind, all.size]));''')
        self.assertEqual(drawn['shape'], 9)
        self.assertEqual(drawn['force'], 4 * len(kinds))
        red = self.window.colour(scenes.pendulum_tip(0))
        self.assertGreater(red[0], red[2] + 60)
        self.assertFalse(self.window.run("return document.getElementById('layer-collision').checked"))

    def test_contacts_are_drawn_as_what_touches(self):
        touching = {'colour': None, 'role': 'contact', 'mesh': None}
        for dimension in (2, 3):
            self.window.open(scenes.pendulum(
                dimension=dimension, shapes=[
                    dict(touching, frame=0, pose=[0, 0, 0, scenes.math.sqrt(0.5), -scenes.math.sqrt(0.5), 0, 0], type='plane', size=[0, 0]),
                    dict(touching, frame=2, pose=[0, 0, 0, *scenes.still], type='sphere', size=[0.2]),
                    dict(touching, frame=2, pose=[0, 0.3, 0, *scenes.still], type='sphere', size=[0]),
                    dict(touching, frame=0, pose=[0, 0, 0, *scenes.still], type='cylinder', size=[0.1, 0])],
                forces=[{'type': 'sphere_contact', 'kind': 'contact', 'name': 'c', 'frames': [0, 2], 'coordinates': []}]))
            drawn = self.window.run('''
                const found = [];
                kte_page.picture.mechanism.root.traverseVisible((o) => { if (o.isMesh && ['shape', 'force'].includes(o.userData.kind)) found.push(`${o.userData.kind} ${o.userData.index}`); });
                return found;''')
            self.assertEqual(sorted(drawn), ['shape 0', 'shape 1', 'shape 2', 'shape 3'], 'and no rod between the frames')
            red = self.window.colour(scenes.pendulum_tip(0))
            self.assertGreater(red[0], red[1] + 40)
            self.window.run("document.getElementById('layer-forces').click()")
            self.assertFalse(far(self.window.colour([-0.25, -0.5, 0]), [246, 248, 250]), 'their layer is that of forces')

    def test_joint_shows_its_angle(self):
        self.window.open(scenes.pendulum())
        self.seek(1)
        self.window.wait('!kte_page.requested')
        angle = self.window.run('''
            let needle;
            kte_page.picture.mechanism.root.traverse((o) => { if (o.material === kte_page.picture.materials.of('needle')) needle = o.parent; });
            return needle.rotation.z;''')
        self.assertAlmostEqual(angle, scenes.pendulum_angle(1), delta=1e-3)

    def test_other_scenes_are_refused_in_words(self):
        for change, word in (({'format': 'kte-scene-9'}, 'kte-scene-9'), ({'tracks': 1}, 'frames[1].track'), ({'links': [{'from': 0, 'to': 7}]}, 'links[0].to')):
            self.window.open(scenes.pendulum(**change))
            self.assertIn(word, self.text('#message'))
        scene = scenes.pendulum()
        scene['recordings'][0]['positions'] = 'AAAA'
        self.window.open(scene)
        self.assertIn('recordings[0].positions', self.text('#message'))


class Playing(PageTest):
    def test_plays_by_itself_and_moves(self):
        self.window.open(scenes.pendulum(), '')
        first = self.time()
        self.window.wait(f'kte_page.player.time > {first} + 0.2')
        self.window.run('kte_page.play()')
        stopped = self.time()
        time.sleep(0.2)
        self.assertEqual(self.time(), stopped)
        self.assertTrue(far(self.window.colour(scenes.pendulum_tip(stopped)), self.window.colour(beside)))

    def test_stands_still_for_those_who_want_less_motion(self):
        self.window.media(prefers_reduced_motion='reduce')
        self.window.open(scenes.pendulum(), '')
        self.assertFalse(self.window.run('return kte_page.player.playing'))

    def test_keys(self):
        self.window.open(scenes.pendulum())
        self.window.key('ArrowRight')
        self.assertAlmostEqual(self.time(), 0.02)
        self.window.key('ArrowRight')
        self.window.key('ArrowLeft')
        self.assertAlmostEqual(self.time(), 0.02)
        self.window.key('ArrowRight', shift=True)
        self.assertAlmostEqual(self.time(), 0.22)
        self.window.key('End')
        self.assertAlmostEqual(self.time(), 4)
        self.window.key('Home')
        self.assertEqual(self.time(), 0)
        self.window.key(' ')
        self.window.wait('kte_page.player.playing && kte_page.player.time > 0.1')
        self.assertEqual(self.text('#play-name'), 'Pause')
        self.window.key(' ')
        self.assertFalse(self.window.run('return kte_page.player.playing'))
        self.window.wait("document.getElementById('live').textContent.includes('seconds of')")
        self.window.key('.')
        self.assertEqual(self.window.run('return kte_page.player.speed'), 2)
        self.window.key('/')
        self.assertEqual(self.window.run('return document.activeElement.id'), 'search')
        self.window.key(' ')
        self.window.key('l')
        self.assertFalse(self.window.run('return kte_page.player.playing'), 'a space in a field is a space')
        self.assertTrue(self.window.run('return kte_page.player.loop'), 'a letter in a field is a letter')
        self.assertEqual(self.window.run("return document.getElementById('search').value"), ' l')

    def test_end_and_repeat(self):
        self.window.open(scenes.pendulum(seconds=0.4), '#t=0.3')
        self.window.run('kte_page.transport.toggle_loop(); kte_page.play()')
        self.window.wait('!kte_page.player.playing')
        self.assertAlmostEqual(self.time(), 0.4)
        self.window.run('kte_page.transport.toggle_loop(); kte_page.play()')
        self.window.wait('kte_page.player.time > 0.3')
        self.window.wait('kte_page.player.time < 0.2')
        self.assertTrue(self.window.run('return kte_page.player.playing'))
        self.window.run('kte_page.play()')

    def test_scrub_and_plot_by_mouse(self):
        self.window.open(scenes.pendulum())
        box = self.window.run("const b = document.getElementById('scrub').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        self.window.click(box[0] + box[2] / 2, box[1] + box[3] / 2)
        self.assertAlmostEqual(self.time(), 2, delta=0.1)
        box = self.window.run("const b = document.querySelector('.u-over').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        self.window.click(box[0] + box[2] / 4, box[1] + box[3] / 2)
        self.assertAlmostEqual(self.time(), 1, delta=0.1)
        self.window.wait('!kte_page.requested')
        now = self.window.run("return document.querySelector('.now').getBoundingClientRect().left")
        self.assertAlmostEqual(now, box[0] + box[2] / 4, delta=3)

    def test_wheel_zooms_in_on_a_plot(self):
        self.window.open(scenes.pendulum())
        box = self.window.run("const b = document.querySelector('.u-over').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        scale = 'const { min, max } = kte_page.plots.plots[0].uplot.scales.x; return [min, max]'
        self.assertEqual(self.window.run(scale), [0, 4])
        for _ in range(5):
            self.window.driver.execute_cdp_cmd('Input.dispatchMouseEvent', {
                'type': 'mouseWheel', 'x': box[0] + box[2] / 2, 'y': box[1] + box[3] / 2, 'deltaX': 0, 'deltaY': -100})
        self.window.wait('!kte_page.requested && kte_page.plots.span > 0')
        low, high = self.window.run(scale)
        self.assertAlmostEqual(high - low, 4 * 0.8**5, delta=1e-6)
        self.assertAlmostEqual((low + high) / 2, 2, delta=0.1)
        self.seek(3.9)
        self.window.wait('!kte_page.requested')
        low, high = self.window.run(scale)
        self.assertLess(low, 3.9, 'the present time comes into sight')
        self.assertGreaterEqual(high, 3.9)
        self.assertLessEqual(high, 4)
        self.window.run('kte_page.plots.zoom(Infinity, 0)')
        self.window.wait('!kte_page.requested')
        self.assertEqual(self.window.run(scale), [0, 4])

    def test_one_sample_and_equal_times(self):
        self.window.open(scenes.pendulum(seconds=0))
        self.assertTrue(self.window.run("return document.body.classList.contains('still')"))
        scene = scenes.pendulum(seconds=0.08)
        scene['recordings'][0]['t'] = scenes.packed('d', [0, 0.1, 0.1, 0.1, 0.2])
        self.window.open(scene)
        for t in (0, 0.05, 0.1, 0.15, 0.2):
            self.seek(t)
            self.assertTrue(self.window.run('kte_page.sources.update(kte_page.player.time); return [...kte_page.sources.tracks].every(Number.isFinite)'))
        scene['recordings'][0]['count'] = 0
        self.window.open(scene)
        self.assertEqual(self.window.run('return kte_page.player.length'), 0)

    def test_two_recordings(self):
        scene = scenes.pendulum()
        second = scenes.pendulum(seconds=2, rate=30)['recordings'][0]
        scene['recordings'].append(dict(second, name='measured'))
        self.window.open(scene)
        self.window.run('''
            const list = document.querySelectorAll('#recordings select')[1];
            list.value = '1';
            list.dispatchEvent(new Event('change'));''')
        self.window.wait("document.querySelectorAll('.plot').length === 2")
        self.assertTrue(self.window.run('return kte_page.picture.ghost.root.visible'))
        worst = self.window.run('return Math.max(...kte_page.plots.plots[1].series[0].values.filter((x) => x !== null).map(Math.abs))')
        self.assertLess(worst, 0.005)
        self.assertGreater(worst, 0)
        self.assertIn('measured', self.text('#plots'))

    def test_a_bad_column_is_said(self):
        scene = scenes.pendulum()
        scene['recordings'][0]['columns'] = [{'name': 'short', 'unit': 'N', 'data': 'AAAA'}]
        self.window.open(scene)
        self.window.run('''
            document.getElementById('columns').open = true;
            document.querySelectorAll('#column-list input')[1].click();''')
        self.window.wait("document.getElementById('plots').textContent.includes('short is not plotted')")

    def test_columns_that_were_asked_for_are_plotted_at_first(self):
        scene = scenes.pendulum(seconds=0.08)
        scene['recordings'][0]['columns'] = [{'name': n, 'unit': 'N', 'data': scenes.packed('f', [1, 2, 3, 4, 5])} for n in ('other', 'tau/q1')]
        self.window.open(scene)
        self.assertEqual(self.window.run('return kte_page.plots.chosen'), ['angle'])
        scene['recordings'][0]['plotted'] = ['tau/q1', 'angle']
        self.window.open(scene)
        self.assertEqual(self.window.run('return kte_page.plots.chosen'), ['tau/q1', 'angle'])
        self.window.wait("document.querySelectorAll('.plot').length === 2")

    def test_gaps_in_columns(self):
        scene = scenes.pendulum(seconds=0.08)
        scene['recordings'][0]['columns'] = [{'name': 'gap', 'unit': 'N', 'data': scenes.packed('f', [1, float('nan'), 2, 3, float('inf')])}]
        self.window.open(scene)
        self.window.run('''
            document.getElementById('columns').open = true;
            document.querySelectorAll('#column-list input')[1].click();''')
        self.window.wait("document.querySelectorAll('.plot').length === 2")
        self.assertEqual(self.window.run('return kte_page.plots.plots[1].series[0].values'), [1, None, 2, 3, None])


class Panels(PageTest):
    def test_tree_search_hover_and_choice(self):
        self.window.open(scenes.pendulum())
        names = self.window.run("return [...document.querySelectorAll('#tree .name')].map((e) => e.textContent)")
        self.assertEqual(names, ['base', 'hinge', 'arm', 'tip', 'bob'])
        row = self.window.run("const b = document.querySelectorAll('#tree li')[1].getBoundingClientRect(); return [b.left + 60, b.top + 10]")
        highlighted = '''
            const found = new Set(), { mechanism, materials } = kte_page.picture;
            mechanism.root.traverse((o) => { if (o.material === materials.of('highlight')) found.add(`${o.userData.kind} ${o.userData.index}`); });
            return [...found];'''
        self.window.mouse('mouseMoved', *row, 'none')
        self.assertEqual(self.window.run(highlighted), ['joint 0'])
        x, y = self.middle(scenes.pendulum_tip(0))
        self.window.mouse('mouseMoved', x, y, 'none')
        self.window.wait("document.querySelector('#tree .pointed .name')?.textContent === 'bob'")
        self.assertEqual(self.text('#pointed'), 'body bob')
        self.assertEqual(self.window.run(highlighted), ['body 0'])
        self.window.click(x, y)
        self.window.wait("document.querySelector('#details h2')?.textContent === 'bob'")
        self.assertIn('1 kg', self.text('#details'))
        self.window.run('''
            const field = document.getElementById('search');
            field.value = 'IN';
            field.dispatchEvent(new Event('input'));''')
        self.assertEqual(self.window.run("return [...document.querySelectorAll('#tree .name')].map((e) => e.textContent)"), ['hinge'])
        self.assertIn('1 name', self.text('#found'))
        self.window.key('/')
        self.window.key('ArrowDown')
        self.assertEqual(self.window.run("return document.activeElement.querySelector('.name').textContent"), 'hinge')
        self.window.key('/')
        self.window.key('Enter')
        self.assertEqual(self.text('#details h2'), 'hinge')

    def test_tree_by_keyboard(self):
        self.window.open(scenes.pendulum())
        self.window.run("document.querySelector('#tree li').focus()")
        for key in ('ArrowDown', 'ArrowDown'):
            self.window.key(key)
        self.assertEqual(self.window.run("return document.activeElement.querySelector('.name').textContent"), 'arm')
        self.assertEqual(self.time(), 0)
        self.window.key('ArrowLeft')
        self.assertEqual(self.window.run("return document.activeElement.getAttribute('aria-expanded')"), 'false')
        self.window.key('Enter')
        self.assertEqual(self.text('#details h2'), 'arm')

    def test_follow_trail_and_axes(self):
        self.window.open(scenes.pendulum())
        self.window.run("kte_page.tree.choose_item({ kind: 'frame', index: 2 })")
        for name in ('Follow', 'Trail', 'Axes'):
            self.window.run("[...document.querySelectorAll('#details button')].find((b) => b.textContent === arguments[0]).click()", name)
        before = self.middle(scenes.pendulum_tip(0))
        self.seek(1)
        self.window.wait('!kte_page.requested')
        after = self.middle(scenes.pendulum_tip(1))
        self.assertAlmostEqual(before[0], after[0], delta=1)
        self.assertAlmostEqual(before[1], after[1], delta=1)
        self.assertEqual(self.window.run('return kte_page.picture.trail.times.length'), 201)
        self.assertEqual(self.window.run('return kte_page.picture.triads.size'), 1)

    def test_layers_and_labels(self):
        self.window.open(scenes.pendulum())
        tip = [0.7 * x for x in scenes.pendulum_tip(0)]
        ground = self.window.colour(beside)
        self.assertTrue(far(self.window.colour(tip), ground))
        self.window.run("document.getElementById('tab-show').click(); document.getElementById('layer-links').click(); document.getElementById('layer-labels').click()")
        self.assertFalse(far(self.window.colour(tip), ground))
        axis = [x + 0.05 * y for x, y in zip(scenes.pendulum_tip(0), [-scenes.pendulum_tip(0)[1], scenes.pendulum_tip(0)[0], 0])]
        self.assertFalse(far(self.window.colour(axis), ground))
        self.window.run("document.getElementById('layer-frames').click()")
        self.assertTrue(far(self.window.colour(axis), ground))
        self.window.run("document.getElementById('layer-frames').click()")
        self.assertFalse(far(self.window.colour(axis), ground))
        self.assertEqual(self.window.run("return [...document.querySelectorAll('.label')].map((e) => e.textContent)"), ['base', 'arm', 'tip'])

    def test_views_and_saved_picture(self):
        self.window.open(scenes.robot(seconds=1))
        press = "[...document.querySelectorAll('#views button')].find((b) => b.textContent === arguments[0]).click()"
        axis = {'Front': 1, 'Side': 0, 'Top': 2}
        for name, along in axis.items():
            self.window.run(press, name)
            at = self.window.run('return kte_page.picture.stage.camera.camera.getWorldDirection(new kte_page.picture.stage.up.constructor()).toArray()')
            self.assertAlmostEqual(abs(at[along]), 1, delta=1e-3, msg=name)
        self.window.driver.execute_cdp_cmd('Browser.setDownloadBehavior', {'behavior': 'allow', 'downloadPath': self.window.files.name})
        self.window.run(press, 'Save picture')
        path = browser.pathlib.Path(self.window.files.name) / 'Robot of 30 joints.png'
        for _ in range(100):
            if path.exists():
                break
            time.sleep(0.05)
        data = path.read_bytes()
        self.assertEqual(data[:8], b'\x89PNG\r\n\x1a\n')
        self.assertGreater(len(data), 5000)

    def test_light_and_dark(self):
        for scheme, bright in (('light', True), ('dark', False)):
            self.window.media(prefers_color_scheme=scheme)
            self.window.open(scenes.pendulum())
            self.window.run("localStorage.removeItem('kte-theme')")
            self.window.open(scenes.pendulum())
            self.assertEqual(sum(self.window.colour(beside)) > 384, bright)
            self.window.run("document.getElementById('theme').click()")
            self.assertEqual(sum(self.window.colour(beside)) > 384, not bright)
            self.window.run("localStorage.removeItem('kte-theme')")

    def test_phone(self):
        self.window.size(400, 800)
        self.window.open(scenes.pendulum())
        wide = self.window.run('return document.documentElement.scrollWidth')
        self.assertLessEqual(wide, 400)
        for name in ('tree', 'plots', 'move', 'show', 'notes'):
            self.window.run(f"document.getElementById('tab-{name}').click()")
            box = self.window.run(f"const b = document.getElementById('panel-{name}').getBoundingClientRect(); return [b.width, b.height]")
            self.assertGreater(min(box), 200, name)
        self.assertTrue(far(self.window.colour(scenes.pendulum_tip(0)), self.window.colour(beside)))

    def test_touch(self):
        self.window.size(400, 800)
        self.window.open(scenes.pendulum(dimension=3))

        def drag(start, end):
            for kind, points in (('touchStart', [start]), ('touchMove', [end]), ('touchEnd', [])):
                self.window.driver.execute_cdp_cmd('Input.dispatchTouchEvent', {'type': kind, 'touchPoints': [{'x': x, 'y': y} for x, y in points]})

        where = 'return kte_page.picture.stage.camera.camera.position.toArray()'
        before = self.window.run(where)
        drag((200, 200), (260, 200))
        self.assertGreater(sum(abs(a - b) for a, b in zip(before, self.window.run(where))), 0.1)
        self.window.run("document.querySelector('.u-over').scrollIntoView()")
        left, top, width, height = self.window.run("const b = document.querySelector('.u-over').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        drag((left + width / 4, top + height / 2), (left + width / 2, top + height / 2))
        self.assertAlmostEqual(self.time(), 2, delta=0.2)

    def test_all_is_reached_by_the_keyboard(self):
        self.window.open(scenes.pendulum())
        self.window.run("document.getElementById('fit').focus()")
        reached = set()
        for _ in range(40):
            self.window.key('Tab')
            reached.add(self.window.run("const e = document.activeElement; return e.id || e.getAttribute('role') || e.tagName"))
        for name in ('canvas', 'theme', 'help', 'tab-plots', 'search', 'treeitem', 'SUMMARY', 'play', 'scrub', 'speed', 'loop'):
            self.assertIn(name, reached)
        self.window.run("document.getElementById('tab-plots').focus()")
        for name in ('move', 'show', 'notes', 'plots'):
            self.window.key('ArrowRight')
            self.assertEqual(self.window.run('return [document.body.dataset.panel, document.activeElement.id]'), [name, f'tab-{name}'])
        self.assertEqual(self.time(), 0)
        outline = self.window.run("return getComputedStyle(document.getElementById('tab-plots')).outlineStyle")
        self.assertEqual(outline, 'solid')

    def test_names_for_screen_readers(self):
        self.window.open(scenes.pendulum())
        nameless = self.window.run('''
            return [...document.querySelectorAll('button, input, select, canvas, [role="tree"], [role="tablist"]')]
              .filter((e) => !e.closest('[aria-hidden="true"]') && !(e.getAttribute('aria-label') || e.closest('label')?.textContent.trim() || e.textContent.trim() || e.title))
              .map((e) => e.outerHTML);''')
        self.assertEqual(nameless, [])
        self.assertEqual(self.window.run("return document.getElementById('scrub').getAttribute('aria-valuetext')"), '0.00 seconds of 4.00')

    def test_licences_are_there(self):
        self.window.open(scenes.pendulum())
        self.window.key('?')
        self.assertTrue(self.window.run("return document.getElementById('help-dialog').open"))
        self.assertIn('three', self.text('#licences'))
        self.assertIn('Permission is hereby granted', self.text('#licences'))


class Engine(PageTest):
    def open(self, **changes):
        self.window.open(scenes.pendulum(model=scenes.pendulum_model(), **changes))
        self.window.run("document.getElementById('tab-move').click()")
        self.window.wait("kte_page.simulating.sliders || document.getElementById('engine-state').textContent.startsWith('No')")

    def tip(self):
        self.window.wait('!kte_page.requested || kte_page.simulating.simulation.running')
        return self.window.run('return [...kte_page.poses.world.subarray(14, 17)]')

    def test_sliders_pose_the_mechanism(self):
        self.open()
        self.assertEqual(self.window.run("return document.querySelectorAll('#sliders input').length"), 1)
        self.slide('#sliders input', -1)
        tip = self.tip()
        x = self.window.run('return kte_page.sources.q[0]')
        self.assertAlmostEqual(x, -1, delta=2e-3)
        self.assertAlmostEqual(tip[0], scenes.math.cos(x), delta=1e-9)
        self.assertAlmostEqual(tip[1], scenes.math.sin(x), delta=1e-9)
        self.assertIn('rad', self.text('#sliders output'))
        self.assertTrue(far(self.window.colour(tip), self.window.colour(beside)))
        self.window.run("document.getElementById('reset').click()")
        self.assertAlmostEqual(self.tip()[0], scenes.pendulum_tip(0)[0], delta=1e-6)

    def test_simulation_is_that_of_a_pendulum(self):
        self.open()
        self.window.run("document.getElementById('simulate').click()")
        self.window.wait('kte_page.simulating.simulation.time > 0.6')
        self.window.run("document.getElementById('simulate').click()")
        t, q = self.window.run('''
            const { simulation } = kte_page.simulating, r = simulation.recording, i = r.index_at(0.6);
            return [[...r.t.subarray(0, r.count)], [...r.q.subarray(0, r.count)]];''')
        # by Runge and Kutta
        x, v, at, h = scenes.pendulum_angle(0), 0.0, 0.0, 1e-4
        rate = lambda a: -9.81 * scenes.math.cos(a)
        for time_wanted, got in zip(t, q):
            while at < time_wanted - h / 2:
                k1, l1 = v, rate(x)
                k2, l2 = v + h / 2 * l1, rate(x + h / 2 * k1)
                k3, l3 = v + h / 2 * l2, rate(x + h / 2 * k2)
                k4, l4 = v + h * l3, rate(x + h * k3)
                x, v, at = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4), at + h
            self.assertAlmostEqual(got, x, delta=1e-3)
        self.assertGreater(max(q) - min(q), 0.5)
        self.assertIn('energy', self.text('#simulation-state'))
        # it can be played as a recording, and gone on with
        self.window.key('Home')
        self.assertEqual(self.time(), 0)
        self.assertEqual(self.window.run('return kte_page.sources.main === kte_page.simulating.recording'), True)
        self.window.run("document.getElementById('simulate').click()")
        self.window.wait(f'kte_page.simulating.simulation.time > {t[-1]} + 0.1')
        self.window.run("document.getElementById('simulate').click()")

    def test_a_drag_pulls_and_damping_damps(self):
        self.open(state={'q': [-scenes.math.pi / 2], 'v': [0]})
        self.window.run("document.getElementById('simulate').click()")
        self.window.wait('kte_page.simulating.simulation.time > 0.1')
        x, y = self.middle([0, -1, 0])
        side, _ = self.middle([0.6, -0.8, 0])
        self.drag((x, y), (side, y))
        self.window.wait('kte_page.sources.q[0] > -1.2')
        self.assertTrue(self.window.run('return kte_page.picture.pull_line.object.visible'))
        camera = self.window.run('return kte_page.picture.stage.camera.controls.target.toArray()')
        self.window.mouse('mouseReleased', side, y)
        self.assertEqual(self.window.run('return kte_page.picture.stage.camera.controls.target.toArray()'), camera)
        self.slide('#damping', 0.9)
        self.window.wait('Math.abs(kte_page.sources.q[0] + Math.PI / 2) < 0.02 && Math.abs(kte_page.simulating.simulation.v[0]) < 0.02')
        self.window.run("document.getElementById('simulate').click()")

    def test_why_there_are_no_sliders(self):
        for model, word in ((None, 'without its model'), ('{"kte_model": 7}', 'kte: ')):
            self.window.open(scenes.pendulum(model=model))
            self.window.run("document.getElementById('tab-move').click()")
            self.window.wait("document.getElementById('engine-state').textContent.startsWith('No sliders')")
            self.assertIn(word, self.text('#engine-state'))
            self.assertEqual(self.window.run("return document.querySelectorAll('#sliders input').length"), 0)
            self.window.run('kte_page.play()')
            self.window.wait('kte_page.player.time > 0.1')
            self.window.run('kte_page.play()')


class Robust(PageTest):
    def test_hostile_names(self):
        self.window.open(scenes.hostile(), '')
        self.assertTrue(self.window.run("return document.getElementById('message').hidden"), self.text('#message'))
        self.window.run('''
            for (const tab of ['plots', 'move', 'show', 'notes']) document.getElementById(`tab-${tab}`).click();
            document.getElementById('loads-on').click();
            document.getElementById('loads-list').open = true;
            for (const box of document.querySelectorAll('#layers input')) if (!box.checked) box.click();
            document.getElementById('tab-plots').click();
            document.getElementById('columns').open = true;
            for (const box of document.querySelectorAll('#column-list input')) if (!box.checked) box.click();
            for (const row of kte_page.tree.rows) { kte_page.point_at(row.row); kte_page.tree.choose(row); kte_page.follow(row.row.frame); kte_page.trail(row.row.frame); }''')
        drawn = self.window.run('return kte_page.drawn')
        self.window.wait(f'kte_page.drawn > {drawn} + 1')
        self.assertIsNone(self.window.run('return window.harmed'))
        self.window.wait("document.querySelectorAll('button.load').length > 10")
        self.window.run("document.getElementById('tab-show').click(); document.querySelector('button.load').focus()")
        self.window.wait("document.getElementById('load-label').textContent.includes('</script>')")
        self.assertEqual(self.window.run("return document.querySelectorAll('.loads script, .loads img, #load-label *').length"), 0)
        self.assertEqual(self.window.run("return document.querySelectorAll('#tree script, #tree img, h1 *, #details img').length"), 0)
        self.assertEqual(self.text('#title'), scenes.hostile_names[0])
        rows = self.window.run("return [...document.querySelectorAll('#tree .name')].map((e) => e.textContent)")
        self.assertEqual(len(rows), 3 * len(scenes.hostile_names))
        self.assertTrue(all(len(row) <= 500 and '\u202e' not in row and '\x00' not in row for row in rows))
        self.assertIn('\u2400\u2401', ' '.join(rows))
        wide = self.window.run('return document.documentElement.scrollWidth')
        self.assertLessEqual(wide, 1280)

    def test_a_long_recording_of_a_robot_opens_at_once(self):
        scene = scenes.robot()
        size = browser.os.path.getsize(self.window.open(scene, ''))
        self.window.wait("performance.getEntriesByName('kte-first-picture').length > 0")
        spent = self.window.run("return performance.getEntriesByName('kte-first-picture')[0].startTime")
        self.assertLess(size, 10e6)
        print(f'60 s of a robot of 30 joints: {size / 1e6:.1f} MB, first picture after {spent / 1000:.2f} s')
        self.window.wait('kte_page.player.time > 0.5')

    def test_nothing_is_asked_of_the_network(self):
        self.window.open(scenes.pendulum())
        self.assertEqual(self.window.run("return performance.getEntriesByType('resource').map((e) => e.name).filter((name) => !/^(data|blob):/.test(name))"), [])
        text = browser.page_file.read_text(encoding='utf-8')
        self.assertNotIn('src="http', text)

    def test_the_page_is_made_of_its_sources(self):
        self.window.open(None)
        folder = browser.folder.parent.parent / 'tools' / 'page'
        files = [f for part in ('src', 'licences') for f in (folder / part).rglob('*') if f.is_file()]
        files += [folder / name for name in ('page.html', 'style.css', 'bundle.mjs', 'package-lock.json', 'engine/engine.js', 'engine/kte.wasm')]
        total = hashlib.sha256()
        for path in sorted(files, key=lambda f: f.relative_to(folder).as_posix()):
            total.update(f'{path.relative_to(folder).as_posix()}\n'.encode())
            total.update(path.read_bytes())
        self.assertEqual(self.window.run("return document.querySelector('meta[name=kte-sources]').content"), total.hexdigest(),
                         'remake share/kte/page.html by tools/page/build.sh')

    def test_size_of_the_page(self):
        text = browser.page_file.read_text(encoding='utf-8')
        engine = len(text.split('id="kte-engine">')[1].split('<')[0])
        self.assertLess(len(text) - engine, 1e6)
        self.assertLess(engine, 1.5e6)
        self.assertNotIn('</script>', text.split('id="kte-scene">')[1].split('null')[0])


class WithoutWebGL(unittest.TestCase):
    def test_names_and_plots_stay(self):
        window = browser.Browser(1280, 800, '--disable-3d-apis')
        try:
            window.open(scenes.pendulum())
            text = window.run("return document.getElementById('message').textContent")
            self.assertIn('There is no 3D view', text)
            self.assertEqual(window.run("return document.querySelectorAll('#tree .name').length"), 5)
            window.key('End')
            window.wait("Math.abs(kte_page.player.time - 4) < 1e-9 && document.querySelectorAll('.plot').length === 1")
            self.assertEqual(window.console(), [])
        finally:
            window.close()


if __name__ == '__main__':
    unittest.main(verbosity=1)
