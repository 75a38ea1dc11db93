import inspect
import re
from pathlib import Path

import numpy as np
import pytest

import kte
import kte.elements
from kte import _element


def is_required(p):
    return p.default in (inspect.Parameter.empty, _element.required)


def example(function):
    """An element with names for ports, and plausible parameters."""
    arguments = {}
    for p in inspect.signature(function).parameters.values():
        if p.name == "surface_radius":
            arguments[p.name] = 0.0  # a half space
        elif not is_required(p):
            continue
        elif p.annotation == "str":
            arguments[p.name] = "the " + p.name
        elif "axis" in p.name or p.name in ("normal", "tangent"):
            arguments[p.name] = [1, 0] if function.__name__.endswith("2D") else [1, 0, 0]
        elif p.annotation == "float":
            arguments[p.name] = 1.0
        elif p.name in ("lengths", "forces"):
            arguments[p.name] = [1.0, 2.0]
        elif p.annotation == "Rotation":
            arguments[p.name] = np.eye(3)
        elif p.name in ("stiffness", "damping", "ang_stiffness", "ang_damping"):
            arguments[p.name] = np.zeros((3, 3))
        else:
            arguments[p.name] = [1, 0] if function.__name__.endswith("2D") else [1, 0, 0]
    return function(**arguments)


def page():
    """The tables of docs/elements.md: of each element the ports and parameters, in order, with what follows each name."""
    found, family = {}, None
    for line in (Path(__file__).parents[2] / "docs" / "elements.md").read_text().splitlines():
        heading = re.match(r"## (`(\w+)`)?", line)
        if heading:
            family = heading[2]
        elif family and line.startswith("| `"):
            name, dimensions, rest = line.strip("| ").split(" | ", 2)
            for dimension in dimensions.split(", "):
                found.setdefault(family if dimension == "-" else f"{family}_{dimension}", []).append((name.strip("`"), rest))
    return found


def test_there_is_a_function_for_each_type():
    assert sorted(kte.elements.__all__) == kte.element_types()


@pytest.mark.parametrize("name", kte.elements.__all__)
def test_arguments_have_the_order_of_the_page_and_its_defaults(name):
    rows = [(n, text) for n, text in page()[name] if "axis z" not in text]
    ports = [n for n, text in rows if text.startswith("port")]
    expected = sorted(ports, key=lambda n: n not in ("loop", "contact"))
    expected += [n + "_length" if n in ports else n for n, text in rows if not text.startswith("port")]
    signature = inspect.signature(getattr(kte, name)).parameters
    assert list(signature) == expected
    assert all(p.kind == p.POSITIONAL_OR_KEYWORD for p in signature.values())
    for n, text in rows:
        if text.startswith("port") or n in ("com", "stiffness_coupling", "damping_coupling", "surface_axis", "surface_radius"):
            continue
        p = signature[n + "_length" if n in ports else n]
        default = re.search(r"optional, default (-?[\w.-]+)", text)
        assert is_required(p) == ("optional" not in text and (name[:7], n) != ("inertia", "inertia")), n
        if default and re.fullmatch(r"[-\d.e]+|-?infinity", default[1]):
            assert np.all(np.asarray(p.default) == float(default[1])), n


def test_positional_arguments_are_those_of_the_page():
    stops = kte.joint_limit_gen("q", -0.5, 1.0, 1e4, 30)
    assert stops == kte.joint_limit_gen("q", lower=-0.5, upper=1.0, stiffness=1e4, damping=30)
    assert {n: x[0] for n, x in kte.joint_friction_gen("q", 0.1).parameters.items()} == dict(
        viscous=0.1, coulomb=0, stiction=0, stribeck_velocity=1, smoothing_velocity=0
    )
    with pytest.raises(kte.BadParameter, match="smoothing_velocity must be finite and positive with dry friction"):
        kte.joint_friction_gen("q", coulomb=1)
    with pytest.raises(TypeError, match=r"joint_limit_gen\(\) missing 1 required argument: 'stiffness'"):
        kte.joint_limit_gen("q", -0.5, 1.0)
    with pytest.raises(TypeError, match=r"bristle_contact_2D\(\) missing 4 required arguments: 'radius', 'stiffness'"):
        kte.bristle_contact_2D("a", "b", "z")


@pytest.mark.parametrize("name", kte.elements.__all__)
def test_its_ports_and_parameters_are_those_of_the_library(name):
    function = getattr(kte, name)
    assert function.__doc__
    try:
        element = example(function)
    except kte.BadParameter as e:  # of these numbers; ports and parameters have been read
        assert "one of lower and upper must be finite" in str(e) or "crank" in str(e) or "dead" in str(e), e
        return
    assert element.type == name
    try:
        element = kte.Chain(element).elements[0]  # with its parameters in the order of C++
    except kte.BadWiring:
        pass  # of a single element
    names = [n for n, text in page()[name] if not text.startswith("port")]
    assert [n for n in names if n in element.parameters] == list(element.parameters)


def test_parameters_are_checked_where_an_element_is_made():
    with pytest.raises(kte.BadParameter, match="inertia_3D .frame 'tool'.: mass must be finite and not negative, got -1"):
        kte.inertia_3D("tool", mass=-1)


def test_contacts_are_with_half_spaces_by_default():
    foot = kte.sphere_contact_3D("foot", "ground", "shank", radius=0.1, friction=0.5)
    assert foot == kte.sphere_contact_3D("foot", "ground", "shank", [0, 0, 1], 0, 0.1, [0, 0, 0], 0.5)
    assert kte.compliant_contact_2D("a", "b", radius=0.1, stiffness=1e5) == kte.compliant_contact_2D("a", "b", [0, 1], 0, 0.1, stiffness=1e5)
    ball = kte.point_contact_3D("corner", "a", "b", 0.2, surface_radius=0.5)
    assert ball == kte.sphere_contact_3D("corner", "a", "b", [0, 0, 0], 0.5, 0, friction=0.2)
    with pytest.raises(TypeError, match="box_contact.* missing 1 required positional argument: 'half'"):
        kte.box_contact_3D("crate", "a", "b")


def test_parameters_have_units_in_docstrings():
    assert "stiffness: number, N/m" in kte.spring_3D.__doc__
    assert "coordinate: reads; angle from base to end, rad" in kte.revolute_joint_3D.__doc__


def test_rotations_may_be_given_in_several_ways():
    class Turn:
        def as_matrix(self):
            return np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])

    matrix = kte.rigid_link_3D("a", "b", [0, 0, 0], rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    assert kte.rigid_link_3D("a", "b", [0, 0, 0], rotation=Turn()) == matrix
    planar = kte.rigid_link_2D("a", "b", [0, 0], rotation=np.pi / 2)
    assert planar.parameters["rotation"] == pytest.approx(np.ravel(Turn().as_matrix()).tolist(), abs=1e-16)


def test_inertias_may_be_given_in_several_ways():
    full = kte.inertia_3D("a", 1, inertia=[[2, 0, 0], [0, 3, 0], [0, 0, 4]])
    assert full.parameters["inertia"] == [2, 0, 0, 3, 0, 4]
    assert kte.inertia_3D("a", 1, inertia=[2, 3, 4]) == full == kte.inertia_3D("a", 1, inertia=[2, 0, 0, 3, 0, 4])
    assert kte.inertia_3D("a", 1, inertia=2).parameters["inertia"] == [2, 0, 0, 2, 0, 2]
    assert kte.inertia_2D("a", 1, inertia=2).parameters["inertia"] == [0, 0, 0, 0, 0, 2]
    with pytest.raises(kte.BadParameter, match="symmetric"):
        kte.inertia_3D("a", 1, inertia=[[1, 2, 0], [0, 1, 0], [0, 0, 1]])


@pytest.mark.parametrize(
    "make, sentence",
    [
        (lambda: kte.rigid_link_3D("a", "b", [1, 2]), r"position has shape \(2,\), expected \(3,\): x, y, z"),
        (lambda: kte.rigid_link_3D("a", "b", "far"), "position must be numbers, not 'far'"),
        (lambda: kte.rigid_link_3D("a", 3, [1, 2, 3]), "end must be a str"),
        (lambda: kte.inertia_gen("q", [1, 2]), r"mass has shape \(2,\)"),
    ],
)
def test_wrong_parameters_say_what_is_expected(make, sentence):
    with pytest.raises((kte.BadParameter, TypeError), match=sentence):
        make()


def test_joints_of_two_coordinates_are_two_joints():
    place = dict(position=[0.1, 0, 0])
    leg = kte.Chain(
        kte.universal_joint_3D("pitch", "yaw", "base", "shaft", [1, 0, 0], [0, 1, 0], **place),
        kte.cylindrical_joint_3D("roll", "stroke", "shaft", "rod", [0, 0, 1]),
        kte.hooke_joint_3D("flexion", "inversion", "rod", "foot", [0, 1, 0], [1, 0, 0], [0, 0, -0.02]),
        kte.fixed_joint_3D("foot", "sole", [0, 0, -0.1]),
    )
    assert leg.coordinates == ["pitch", "yaw", "roll", "stroke", "flexion", "inversion"]
    pose = kte.forward_kinematics(leg, [0, 0, 0, 0.3, 0, 0], "sole")
    np.testing.assert_allclose(pose.position, [0.1, 0, 0.3 - 0.02 - 0.1], atol=1e-15)
    with pytest.raises(kte.BadParameter, match="must not be parallel"):
        kte.universal_joint_3D("a", "b", "c", "d", [1, 0, 0], [1, 0, 0])


def test_contacts_of_boxes_and_capsules_are_those_of_their_corners_and_ends():
    chain = kte.Chain(
        kte.base_3D("ground"),
        kte.free_joint_3D("pose", "ground", "body"),
        kte.inertia_3D("body", mass=1, inertia=1),
        kte.box_contact_3D("crate", "ground", "body", [0.3, 0.2, 0.1], friction=0.5),
        kte.compliant_capsule_contact_3D("ground", "body", [0, 0, 0.2], 0.05, 1e5, friction=0.5),
    )
    elements = list(chain.elements)
    corner = next(e for e in elements if e.ports.get("contact") == "crate/corner 3")
    assert list(corner.parameters["offset"]) == [-0.3, 0.2, -0.1]
    assert sum(e.type == "sphere_contact_3D" for e in elements) == 8
    assert sum(e.type == "compliant_contact_3D" for e in elements) == 2
    assert len(kte.capsule_contact_2D("rod", "floor", "card", [0.4, 0], 0.05)) == 2
    with pytest.raises(ValueError, match="half must have 2 numbers"):
        kte.box_contact_2D("card", "floor", "card", [1, 2, 3])
