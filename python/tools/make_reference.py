"""Writes docs/python_reference.md, the public names of the Python package, from their docstrings.

Usage: PYTHONPATH=folder-of-kte make_reference.py docs/python_reference.md
"""
import inspect
import re
import sys
import textwrap

import kte

SECTIONS = {
    "Chains, states, models": "Element Chain State element_types save_model load_model reduced",
    "Poses": "Pose",
    "Forces and accelerations": """inverse_dynamics forward_dynamics hybrid_dynamics mass_matrix mass_matrix_inverse
        gravity_forces static_forces nonlinear_effects coriolis_forces coriolis_matrix mass_matrix_rate external_forces
        joint_reaction rollout""",
    "Derivatives": "inverse_dynamics_derivatives forward_dynamics_derivatives",
    "Identification": "inertial_parameters torque_regressor base_parameters BaseParameters",
    "Energies and momenta": """potential_energy kinetic_energy energy centre_of_mass centre_of_mass_velocity
        centre_of_mass_acceleration centre_of_mass_jacobian centroidal_momentum centroidal_momentum_rate
        centroidal_momentum_matrix subtree_inertia""",
    "Frames": """forward_kinematics relative_pose frame_velocity frame_acceleration jacobian jacobian_rate
        relative_jacobian bias_acceleration""",
    "Configurations": "neutral_configuration integrate difference interpolate random_configuration",
    "Closed loops": """assemblies assemble consistent_velocities constrained_dynamics constrained_dynamics_derivatives
        loops loop_jacobian loop_motion actuated_forces actuated_dynamics_derivatives""",
    "Contact": """contact_dynamics contact_dynamics_derivatives impact contact_jacobian contact_jacobian_rate
        delassus_matrix operational_inertia support_polygon centre_of_pressure point_contact_2D point_contact_3D
        capsule_contact_2D capsule_contact_3D box_contact_2D box_contact_3D compliant_capsule_contact_2D
        compliant_capsule_contact_3D compliant_box_contact_2D compliant_box_contact_3D""",
    "Robots": """Robot load_robot parse_robot to_urdf to_mjcf inverse_kinematics inverse_kinematics_all Motion
        trapezoidal_motion quintic_motion""",
    "Equilibria and modes": "static_equilibrium equilibrium_path natural_modes",
    "Linear systems": "linearize discretize displacement lqr",
    "Simulation": "simulate Simulation Event Recording",
    "Sweeps": """sweep Distribution Cases uniform log_uniform normal one_of evenly list_of_cases random_cases sobol_cases
        Case OperationRun SimulationRun SweepTable""",
    "Pages": "view Page",
}


def is_result(x):
    return isinstance(x, type) and x.__module__ == "kte._results"


def is_error(x):
    return isinstance(x, type) and issubclass(x, (Exception, Warning))


def doc_of(x, name):
    """The docstring without the signature that may be its first line."""
    text = inspect.getdoc(x) or ""
    first, _, rest = text.partition("\n\n")
    return rest if re.match(rf"{name}\(", first) else text


def first_paragraph(x, name):
    return " ".join(doc_of(x, name).partition("\n\n")[0].split())


def signature_of(x, name):
    first = (inspect.getdoc(x) or "").partition("\n\n")[0]
    if re.match(rf"{name}\(", first):
        return " ".join(first.split())
    try:
        parameters = inspect.signature(x).parameters.values()
    except (TypeError, ValueError):
        return ""
    shown = [p.replace(annotation=inspect.Parameter.empty) for p in parameters if p.name != "self"]
    return name + str(inspect.Signature(shown))


def item(text):
    return textwrap.wrap("* " + text, 120, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)


def members_of(x):
    for name, member in sorted(vars(x).items()):
        if not name.startswith("_") and (inspect.isroutine(member) or isinstance(member, property)):
            yield name, member


def entry(name):
    x = getattr(kte, name)
    lines = [f"### {name}", ""]
    signature = signature_of(x, name)
    if signature:
        lines += ["```python", *textwrap.wrap("kte." + signature, 110, subsequent_indent="    "), "```", ""]
    for line in doc_of(x, name).split("\n"):
        lines += [line] if line.startswith(" ") or len(line) <= 120 else textwrap.wrap(line, 120)
    lines.append("")
    if isinstance(x, type):
        rows = []
        for member, what in members_of(x):
            text = first_paragraph(what, member)
            call = "" if isinstance(what, property) else (signature_of(what, member) or member + "()")[len(member):]
            rows += item(f"`{member}{call}`: {text}" if text else f"`{member}{call}`")
        if rows:
            lines += [*rows, ""]
    return lines


def page():
    elements = set(kte.element_types())
    others = [n for n in kte.__all__ if n not in elements and n != "Array"]
    results = [n for n in others if is_result(getattr(kte, n)) and n != "Pose"]
    errors = [n for n in others if is_error(getattr(kte, n))]
    joints = [n for n in others if getattr(kte, n).__module__ == "kte.joint_series"]
    if joints:
        others = [n for n in others if n not in joints or n == "base_parameters"]
    named = set(" ".join(SECTIONS.values()).split())
    missing = [n for n in others if n not in named | set(results) | set(errors)]
    if missing:
        raise SystemExit(f"make_reference: no section for {', '.join(missing)}")
    lines = [
        "# Python reference",
        "",
        "`python/tools/make_reference.py` generates this page from the docstrings of the package; do not edit it by hand.",
        "[Python](python.md) has examples; [elements](elements.md) the formulas of all elements, whose functions in Python have",
        "the same names and parameters.",
        "",
    ]
    for title, names in SECTIONS.items():
        lines += [f"## {title}", ""]
        for name in names.split():
            lines += entry(name)
    lines += ["## Elements", "", "Elements and combinations of them:", ""]
    lines += textwrap.wrap(", ".join(f"`{n}`" for n in kte.__all__ if n in elements or n in joints) + ".", 110)
    lines += ["", "## Results", "", "Named tuples and classes with these fields:", ""]
    for name in results:
        x = getattr(kte, name)
        fields = getattr(x, "_fields", None) or list(getattr(x, "__dataclass_fields__", {}))
        lines += item(f"`{name}`({', '.join(f'`{f}`' for f in fields)}): {first_paragraph(x, name)}")
    lines += ["", "## Errors", "", "All but the warning derive from `Error`:", ""]
    for name in errors:
        x = getattr(kte, name)
        bases = ", ".join(b.__name__ for b in x.__bases__)
        lines += item(f"`{name}` ({bases}): {first_paragraph(x, name)}")
    return "\n".join(line.rstrip() for line in lines) + "\n"


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write(page())
