"""Scenes for the tests of the page, with motion that has a formula."""

import array
import base64
import json
import math


def packed(kind, numbers):
    return base64.b64encode(array.array(kind, numbers).tobytes()).decode()


def rotations(quaternions):
    return packed('h', [round(32767 * x) for q in quaternions for x in q])


def recording(name, times, poses, q=None, columns=(), v=None, signals=None):
    """poses: of each time a list of (position, quaternion), one a track; q, v, signals: of each time a list; columns: (name, unit, values)."""
    return {
        'name': name, 'count': len(times), 't': packed('d', times),
        'positions': packed('f', [x for row in poses for p, _ in row for x in p]),
        'rotations': rotations([r for row in poses for _, r in row]),
        **{name: packed('f', [x for row in rows for x in row]) if rows else None for name, rows in (('q', q), ('v', v), ('signals', signals))},
        'columns': [{'name': n, 'unit': u, 'data': packed('f', values)} for n, u, values in columns],
    }


def empty(**changes):
    scene = {
        'format': 'kte-scene-1', 'title': 'Empty', 'dimension': 3, 'gravity': [0, 0, -9.81], 'size': 1, 'frames': [], 'tracks': 0,
        'coordinates': [], 'joints': [], 'links': [], 'bodies': [], 'forces': [], 'shapes': [], 'meshes': [], 'notes': [], 'recordings': [],
        'model': None, 'state': {'q': [], 'v': []},
    }
    scene.update(changes)
    return scene


still = [1, 0, 0, 0]


def about_z(angle):
    return [math.cos(angle / 2), 0, 0, math.sin(angle / 2)]


def pendulum_angle(t):
    return -math.pi / 2 + 1.2 * math.cos(2 * t)


def pendulum_tip(t):
    return [math.cos(pendulum_angle(t)), math.sin(pendulum_angle(t)), 0]


def pendulum(seconds=4, rate=50, model=None, **changes):
    """A planar pendulum of 1 m; q is 0 along x."""
    times = [i / rate for i in range(int(seconds * rate) + 1)]
    angles = [pendulum_angle(t) for t in times]
    poses = [[([0, 0, 0], still), ([0, 0, 0], about_z(a))] for a in angles]
    run = recording('swing', times, poses, [[a] for a in angles], [('energy', 'J', [math.cos(t) for t in times])])
    scene = empty(
        title='Pendulum', dimension=2, gravity=[0, -9.81, 0], size=1, tracks=2, model=model,
        frames=[{'name': 'base', 'track': 0}, {'name': 'arm', 'track': 1}, {'name': 'tip', 'parent': 1, 'pose': [1, 0, 0, 1, 0, 0, 0]}],
        coordinates=[{'name': 'angle', 'unit': 'rad', 'q': 0, 'size': 1, 'v': 0, 'v_size': 1, 'kind': 'angle', 'lower': -3, 'upper': 0.5, 'follows': False}],
        joints=[{'name': 'hinge', 'type': 'revolute_joint_2D', 'kind': 'revolute', 'before': 0, 'after': 1, 'axis': [0, 0, 1], 'coordinates': [0],
                 'lower': -3, 'upper': 0.5}],
        links=[{'type': 'rigid_link_2D', 'from': 1, 'to': 2}],
        bodies=[{'name': 'bob', 'frame': 2, 'mass': 1, 'centre': [0, 0, 0], 'orientation': still, 'ellipsoid': [0, 0, 0]}],
        recordings=[run], state={'q': [angles[0]], 'v': [0]})
    scene.update(changes)
    return scene


def pendulum_model():
    """The pendulum as a model file; frames and the coordinate have the names of the scene."""
    elements = [
        {'type': 'revolute_joint_2D', 'version': 1, 'ports': {'coordinate': 'angle', 'base': 'base', 'end': 'arm'}, 'parameters': {'axis': '0 0 1'}},
        {'type': 'rigid_link_2D', 'version': 1, 'ports': {'base': 'arm', 'end': 'tip'},
         'parameters': {'position': '1 0 0', 'rotation': '1 0 0 0 1 0 0 0 1'}},
        {'type': 'inertia_2D', 'version': 1, 'ports': {'frame': 'tip'}, 'parameters': {'mass': '1', 'com': '0 0 0', 'inertia': '0 0 0 0 0 0'}}]
    return json.dumps({'kte_model': {'version': 1, 'gravity': '0 -9.81 0', 'elements': elements}})


hook = [-0.6, -0.9, 0]
spring, rest, damping, motor = 20, 0.3, 2, 3  # N/m, m, N s/m, Nm


def sprung(v=True, signals=True, model=True, **changes):
    """The pendulum with a spring and a damper from its tip to a hook, and a motor; what it recorded is not what would happen."""
    scene = pendulum(model=pendulum_model() if model else None)
    if model:
        elements = json.loads(scene['model'])
        for type_, ports, parameters in (
                ('rigid_link_2D', {'base': 'base', 'end': 'hook'}, {'position': ' '.join(map(str, hook)), 'rotation': '1 0 0 0 1 0 0 0 1'}),
                ('spring_2D', {'anchor1': 'hook', 'anchor2': 'tip'}, {'rest_length': str(rest), 'stiffness': str(spring), 'saturation': '0'}),
                ('damper_2D', {'anchor1': 'hook', 'anchor2': 'tip'}, {'damping': str(damping)}),
                ('driving_actuator_gen', {'coordinate': 'angle', 'input': 'motor'}, {})):
            elements['kte_model']['elements'].append({'type': type_, 'version': 1, 'ports': ports, 'parameters': parameters})
        scene['model'] = json.dumps(elements)
    scene['frames'].append({'name': 'hook', 'parent': 0, 'pose': hook + still})
    scene['forces'] = [
        {'type': 'spring_2D', 'kind': 'spring', 'name': 'hook, tip', 'frames': [3, 2], 'coordinates': [], 'element': 4},
        {'type': 'damper_2D', 'kind': 'damper', 'name': 'hook, tip', 'frames': [3, 2], 'coordinates': [], 'element': 5},
        {'type': 'driving_actuator_gen', 'kind': 'motor', 'name': 'angle, motor', 'frames': [], 'coordinates': [0], 'element': 6}]
    times = [i / 50 for i in range(201)]
    run = scene['recordings'][0]
    run['v'] = packed('f', [-2.4 * math.sin(2 * t) for t in times]) if v else None
    run['signals'] = packed('f', [motor for _ in times]) if signals else None
    scene.update(changes)
    return scene


def released():
    """The same as it moves by itself, integrated by Runge and Kutta: the scene, and of each sample its angle and rate."""
    def acceleration(angle, rate):
        (sx, sy, _), (dx, dy, _) = forces_on_tip(angle, rate)
        return motor + math.cos(angle) * (sy + dy - 9.81) - math.sin(angle) * (sx + dx)  # of 1 kg at 1 m

    steps, h = 40, 0.02 / 40
    states = [(-0.3, 0.0)]
    while len(states) < 101:
        x, v = states[-1]
        for _ in range(steps):
            k1, l1 = v, acceleration(x, v)
            k2, l2 = v + h / 2 * l1, acceleration(x + h / 2 * k1, v + h / 2 * l1)
            k3, l3 = v + h / 2 * l2, acceleration(x + h / 2 * k2, v + h / 2 * l2)
            k4, l4 = v + h * l3, acceleration(x + h * k3, v + h * l3)
            x, v = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
        states.append((x, v))
    run = recording('released', [0.02 * i for i in range(101)], [[([0, 0, 0], still), ([0, 0, 0], about_z(x))] for x, _ in states],
                    [[x] for x, _ in states], v=[[v] for _, v in states], signals=[[motor]] * 101)
    return sprung(recordings=[run]), states, acceleration


def sprung_forces(t):
    """Of the spring and the damper on the tip at a time."""
    return forces_on_tip(pendulum_angle(t), -2.4 * math.sin(2 * t))


def forces_on_tip(angle, rate):
    tip = [math.cos(angle), math.sin(angle), 0]
    d = [h - x for h, x in zip(hook, tip)]
    length = math.hypot(*d)
    e = [x / length for x in d]
    speed = -(-rate * tip[1] * e[0] + rate * tip[0] * e[1])
    return [spring * (length - rest) * x for x in e], [damping * speed * x for x in e]


def robot(joints=30, seconds=60, rate=100):
    """A serial arm in space that coils and uncoils."""
    count = int(seconds * rate) + 1
    times = [i / rate for i in range(count)]
    length = 0.2
    positions, turns, q = array.array('f'), array.array('h'), array.array('f')
    for t in times:
        x = y = angle = 0.0
        z = 0.1
        bend = 0.18 * math.sin(0.7 * t)
        positions.extend((0, 0, 0))
        turns.extend((32767, 0, 0, 0))
        for i in range(joints):
            angle += bend
            positions.extend((x, y, z))
            turns.extend((round(32767 * math.cos(angle / 2)), 0, round(-32767 * math.sin(angle / 2)), 0))
            x += length * math.cos(angle)
            z += length * math.sin(angle)
            q.append(-bend)
    frames = [{'name': 'base', 'track': 0}] + [{'name': f'link {i + 1}', 'track': i + 1} for i in range(joints)]
    columns = [{'name': f'joint {i + 1}/v', 'unit': 'rad/s', 'data': packed('f', [0.126 * math.cos(0.7 * t) for t in times])} for i in range(joints)]
    return empty(
        title='Robot of 30 joints', size=6, tracks=joints + 1, frames=frames + [{'name': 'tool', 'parent': joints, 'pose': [length, 0, 0, 1, 0, 0, 0]}],
        coordinates=[{'name': f'joint {i + 1}', 'unit': 'rad', 'q': i, 'size': 1, 'v': i, 'v_size': 1, 'kind': 'angle', 'lower': -2, 'upper': 2,
                      'follows': False} for i in range(joints)],
        joints=[{'name': f'joint {i + 1}', 'type': 'revolute_joint_3D', 'kind': 'revolute', 'before': i, 'after': i + 1, 'axis': [0, 1, 0],
                 'coordinates': [i], 'lower': -2, 'upper': 2} for i in range(joints)],
        links=[{'type': 'rigid_link_3D', 'from': i + 1, 'to': i + 2} for i in range(joints)],
        bodies=[{'name': f'body {i + 1}', 'frame': i + 1, 'mass': 1, 'centre': [length / 2, 0, 0], 'orientation': still,
                 'ellipsoid': [0.1, 0.05, 0.05]} for i in range(joints)],
        recordings=[{'name': 'coil', 'count': count, 't': packed('d', times), 'positions': base64.b64encode(positions.tobytes()).decode(),
                     'rotations': base64.b64encode(turns.tobytes()).decode(), 'q': base64.b64encode(q.tobytes()).decode(), 'columns': columns}],
        state={'q': [0.0] * joints, 'v': [0.0] * joints})


hostile_names = [
    '</script><script>window.harmed = 1</script>', '<img src=x onerror="window.harmed = 1">', '"\' onload=alert(1) x="', 'a' * 10240,
    '\u202egnimaL\u202c right to left', '\u0645\u0641\u0635\u0644 \u0627\u0644\u0643\u062a\u0641', '\x00\x01\x1b[31m\x7f\n\t', '',
    '\U0001f9be \U0001d54f \u0915\u094d\u0937', 'e\u0301\u0302\u0303' * 200, '\ud800', '__proto__', 'constructor', '${1}`', '<!--', '\u2028\u2029', '&lt;&amp;',
]


def hostile():
    """Every name there is, hostile: of frames, joints, bodies, forces, coordinates, recordings, columns, units, notes, the title."""
    n = len(hostile_names)
    run = {'count': 2, 't': packed('d', [0, 1]), 'positions': packed('f', [float(i % 5) * (i % 3 == 0) for i in range(2 * 3 * n)]),
           'rotations': rotations([still] * (2 * n)), 'q': packed('f', [0.5] * (2 * n))}
    return empty(
        title=hostile_names[0], tracks=n, frames=[{'name': name, 'track': i} for i, name in enumerate(hostile_names)],
        coordinates=[{'name': name, 'unit': name, 'q': i, 'size': 1, 'v': i, 'v_size': 1, 'kind': name, 'lower': None, 'upper': None, 'follows': False}
                     for i, name in enumerate(hostile_names)],
        joints=[{'name': name, 'type': name, 'kind': name, 'before': i, 'after': (i + 1) % n, 'axis': [0, 0, 1], 'coordinates': [i], 'lower': None,
                 'upper': None} for i, name in enumerate(hostile_names)],
        links=[{'type': name, 'from': i, 'to': (i + 2) % n} for i, name in enumerate(hostile_names)],
        bodies=[{'name': name, 'frame': i, 'mass': 1, 'centre': [0, 0, 0], 'orientation': still, 'ellipsoid': [0.1, 0.1, 0.1]}
                for i, name in enumerate(hostile_names)],
        forces=[{'type': name, 'kind': name, 'name': name, 'frames': [i], 'coordinates': [i]} for i, name in enumerate(hostile_names)],
        shapes=[{'frame': 0, 'pose': [0, 0, 0, 1, 0, 0, 0], 'type': name, 'size': [1], 'colour': None, 'role': name, 'mesh': None} for name in hostile_names],
        meshes=[{'name': name, 'positions': '', 'indices': ''} for name in hostile_names], notes=hostile_names, state={'q': [0.5] * n, 'v': [0] * n},
        recordings=[dict(run, name=name, columns=[{'name': c, 'unit': c, 'data': packed('f', [1, 2])} for c in hostile_names]) for name in hostile_names[:3]])
