"""Everything that a scene holds, as classes: objects of all kinds, and what their properties
are made of. Written by `python/generate.py` from the declarations that scenes are read by, with
examples from the scenarios and the catalogue of objects.

A quantity is a number in SI units or a text with its unit. What is left out has the default
that is said. Instead of an object of a class, a mapping with the same names is taken.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, Union

from dam._tree import Own, Quantity, Tree, Value

__all__ = [
    "AnyKind",
    "Belt",
    "Cam",
    "CamFollower",
    "CamOf",
    "Contact",
    "Couple",
    "CoupleTable",
    "Crank",
    "CrankGeometry",
    "Differential",
    "DifferentialInput",
    "DiscCam",
    "Drive",
    "FirstTimes",
    "Flat",
    "Force",
    "FourBar",
    "Friction",
    "From",
    "Gear",
    "Geometry",
    "Gravity",
    "Harmonic",
    "HuntCrossley",
    "Identify",
    "Indicator",
    "Kloss",
    "Law",
    "LawOf",
    "Lever",
    "Lift",
    "LiftCam",
    "LiftCamLaw",
    "Line",
    "Linear",
    "Linkage",
    "LinkageAssembly",
    "LinkageCoupling",
    "LinkageCouplingCam",
    "LinkageForce",
    "LinkageForceForce",
    "LinkageForceTable",
    "LinkageInput",
    "LinkageLink",
    "LinkageLinkGeometry",
    "LinkageOutput",
    "LinkagePair",
    "Load",
    "Material",
    "Motion",
    "Motor",
    "Optimize",
    "Pair",
    "PairContact",
    "Plan",
    "Planetary",
    "PlannedMotion",
    "Point",
    "Polynomial",
    "Position",
    "PositionCam",
    "PositionCamLaw",
    "PositionPolynomial",
    "PositionTable",
    "Rack",
    "Ratio",
    "Rocker",
    "RockerGeometry",
    "Run",
    "RunLaw",
    "RunUp",
    "Scca",
    "Sections",
    "Shaft",
    "ShaftGeometry",
    "Sine",
    "Slider",
    "SliderCrank",
    "Sliding",
    "SlottedLink",
    "Spring",
    "Start",
    "Stations",
    "Steady",
    "Stop",
    "StopContact",
    "Strut",
    "Table",
    "TableFile",
    "Teeth",
    "Tolerance",
    "Torque",
    "TorqueLinear",
    "Torsion",
    "Trapezoid",
    "Until",
    "Weight",
    "Weld",
    "Window",
]


class Belt(Tree):
    """A belt or chain over two pulleys.

    Parameters
    ----------
    diameters
        Diameters of the first and the second pulley.
    wheels
        The two links, with the wheels or the gear and its rack; `ground` for what stands
        still.
    carrier
        The link that carries both, or `ground`; default the only one that does.
    crossed
        True: the belt is crossed, and the pulleys turn against each other. Default: false.
    offset
        Angle of the second wheel (or displacement of the rack) seen from the carrier where
        that of the first is zero: how they were put together (angle in rad, deg, mrad or
        rev) Default: 0.0.

    Examples
    --------
    >>> belt = kinds.Belt(wheels=["left", "right"], diameters=["50 mm", "50 mm"], offset="60 deg")
    >>> belt.offset
    '60 deg'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        diameters: Sequence[Quantity],
        wheels: Sequence[str],
        carrier: str | None = None,
        crossed: bool | None = None,
        offset: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("diameters", diameters),
            ("wheels", wheels),
            ("carrier", carrier),
            ("crossed", crossed),
            ("offset", offset),
        )


class Cam(Tree):
    """Contact along a line with the object's own `cam`, of its `material`: radii, width and moduli are those, k is the secant N/p at a stated load.

    Parameters
    ----------
    load
        Contact force along the normal at which k is the secant N/p (force in N, kN, MN, lbf
        or kgf)
    at
        Angle of the cam at which they touch; absent: where its profile is most sharply
        convex (angle in rad, deg, mrad or rev)
    cam_depth
        Depth below the cam's surface from which its approach is counted, where that is flat
        or hollow (length in m, mm, cm, µm, in or ft)
    depth
        Depth below a flat face from which its approach is counted (length in m, mm, cm, µm,
        in or ft)

    Examples
    --------
    >>> cam = kinds.Cam(load="800 N")
    >>> cam.load
    '800 N'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        load: Quantity,
        at: Quantity | None = None,
        cam_depth: Quantity | None = None,
        depth: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("load", load),
            ("at", at),
            ("cam_depth", cam_depth),
            ("depth", depth),
        )


class CamFollower(Tree):
    """The follower of a cam, turning or sliding, held to it by a closing force.

    Parameters
    ----------
    input
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    cam
        Geometry of the disc cam that realises the position function: for `dam cam`, and
        with a `material` for the pressure of a run; not for the dynamics.
    damping
        Damping b seen at the last mass (rotational damping in N m s/rad or N m s; or
        damping in N s/m, kN s/m or lbf s/in)
    damping_capacity
        Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default
        0. (a pure number)
    dampings
        Damping of each link
    description
        Remarks for people.
    flexibility
        `static`, in place of `masses`: the uniform object has its static deflection,
        without vibrations, and with it a contact element in series. Its speed follows. Its
        acceleration is that of its driven end. Needs a pair that stays closed and a motion
        that is known beforehand.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    geometry
        Dimensions and material, in place of inertia and stiffness
    inertia
        Total inertia J (moment of inertia in kg m^2, kg cm^2, g mm^2, lb ft^2 or lb in^2;
        or mass in kg, g, t or lb)
    inertias
        Inertia of each mass
    lever_arm
        Arm on which an angle given by the position function becomes a length (length in m,
        mm, cm, µm, in or ft)
    lever_ratio
        Factor on the position function. (a pure number)
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    lumping
        Where the inertia of each cell of the object is put. `ends`: at the far end of the
        cell. `balanced`: at both ends, so that the first moment of compliance is kept. It
        needs a contact that cannot separate, or a contact element. Behind that the first
        cell is of the former kind. Default `ends`.
    mass
        Another name of `inertia`.
    masses
        Number of masses; 0: rigid; "auto": as many masses or modes as the accuracy of the
        run needs. Default: 1, or the length of the lists.
    modes
        Number of vibration modes that the uniform object is reduced to, in place of
        `masses`: the lowest, of the object held at its driven end. The residual flexibility
        of the others is kept. Needs a pair that stays closed, or a contact element, behind
        which they are the modes of the free object.
    moment_of_inertia
        Another name of `inertia`.
    motion
        Whether the follower turns or slides.
    pair
        The driving pair. Default: {}.
    position
        Position function U(φ): the prescribed position of this object.
    split
        How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.
    stiffness
        Stiffness c seen at the last mass (rotational stiffness in N m/rad, N m, kN m/rad, N
        m/deg or lbf ft/rad; or stiffness in N/m, N/mm, kN/mm or lbf/in)
    stiffnesses
        Stiffness of each link
    stops
        One-sided stops of the last mass against the ground, by name. Default: {}.

    Examples
    --------
    >>> cam_follower = kinds.CamFollower(
    ...     "camshaft",
    ...     from_="cam_follower/valve-pushrod-one-mass",
    ...     position={
    ...         "cam": {
    ...             "lift": "10.5 mm",
    ...             "rise": "70 deg",
    ...             "dwell": "4 deg",
    ...             "return": "70 deg",
    ...             "law": "4-5-6-7",
    ...             "phase": "-30 deg",
    ...         },
    ...     },
    ... )
    >>> cam_follower.from_
    'cam_follower/valve-pushrod-one-mass'
    """

    __slots__ = ()

    def __init__(
        self,
        input: str | None = None,
        *,
        cam: DiscCam | Mapping[str, Value] | None = None,
        damping: Quantity | None = None,
        damping_capacity: Quantity | None = None,
        dampings: Sequence[Quantity] | None = None,
        description: str | None = None,
        flexibility: Literal['static'] | None = None,
        from_: str | None = None,
        geometry: Geometry | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        inertias: Sequence[Quantity] | None = None,
        lever_arm: Quantity | None = None,
        lever_ratio: Quantity | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        lumping: Literal['ends', 'balanced'] | None = None,
        mass: Quantity | None = None,
        masses: int | str | Literal['auto'] | None = None,
        modes: int | str | None = None,
        moment_of_inertia: Quantity | None = None,
        motion: Literal['turning', 'sliding'] | None = None,
        pair: Pair | Mapping[str, Value] | None = None,
        position: Position | Mapping[str, Value] | Own | None = None,
        split: Literal['cubes', 'equal'] | Sequence[Quantity] | None = None,
        stiffness: Quantity | None = None,
        stiffnesses: Sequence[Quantity] | None = None,
        stops: Mapping[str, Stop | Mapping[str, Value]] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "cam_follower"),
            ("input", input),
            ("cam", cam),
            ("damping", damping),
            ("damping_capacity", damping_capacity),
            ("dampings", dampings),
            ("description", description),
            ("flexibility", flexibility),
            ("from", from_),
            ("geometry", geometry),
            ("inertia", inertia),
            ("inertias", inertias),
            ("lever_arm", lever_arm),
            ("lever_ratio", lever_ratio),
            ("loads", loads),
            ("lumping", lumping),
            ("mass", mass),
            ("masses", masses),
            ("modes", modes),
            ("moment_of_inertia", moment_of_inertia),
            ("motion", motion),
            ("pair", pair),
            ("position", position),
            ("split", split),
            ("stiffness", stiffness),
            ("stiffnesses", stiffnesses),
            ("stops", stops),
        )


class CamOf(Tree):
    """What `cam` is made of.

    Parameters
    ----------
    base_radius
        Radius of the base circle: the smallest circle about the axis that the profile
        touches (length in m, mm, cm, µm, in or ft)
    contact
        What of the follower touches the cam.
    arm
        From the follower's axis to the centre of the roller, or to the edge (length in m,
        mm, cm, µm, in or ft)
    centre_distance
        Distance between the axes of cam and follower (length in m, mm, cm, µm, in or ft)
    direction
        For drawings: direction of outward motion (default 90 deg), or from the cam's axis
        to that of a turning follower (default 0) (angle in rad, deg, mrad or rev)
    material
        Material of follower and cam, the counter-body: for the Hertzian pressure between
        them.
    positive
        Where positive displacement takes the follower, seen from the cam's axis. Default:
        "outward".
    range
        First and last angle of the cam that an open profile covers; without it a whole turn
    sense
        Sense in which the cam turns as its angle grows. Default: "counterclockwise".
    surface
        Which side of the cam is touched. Default: "disc".
    swing
        Whether the follower moves outwards against the sense in which the cam turns, or
        with it. Default: "against".

    Examples
    --------
    >>> cam_of = kinds.CamOf(
    ...     base_radius="30 mm",
    ...     contact={"roller": "8 mm"},
    ...     centre_distance="90 mm",
    ...     arm="70 mm",
    ...     swing="against",
    ... )
    >>> cam_of.base_radius
    '30 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        base_radius: Quantity,
        contact: Literal['knife_edge'] | Contact | Mapping[str, Value],
        arm: Quantity | None = None,
        centre_distance: Quantity | None = None,
        direction: Quantity | None = None,
        material: Material | Mapping[str, Value] | None = None,
        positive: Literal['outward', 'inward'] | None = None,
        range: Sequence[Quantity] | None = None,
        sense: Literal['counterclockwise', 'clockwise'] | None = None,
        surface: Literal['disc', 'hollow', 'groove'] | None = None,
        swing: Literal['against', 'with'] | None = None,
    ) -> None:
        super().__init__(
            ("base_radius", base_radius),
            ("contact", contact),
            ("arm", arm),
            ("centre_distance", centre_distance),
            ("direction", direction),
            ("material", material),
            ("positive", positive),
            ("range", range),
            ("sense", sense),
            ("surface", surface),
            ("swing", swing),
        )


class Contact(Tree):
    """What `contact` is made of.

    Parameters
    ----------
    flat
        A flat face.
    roller
        Radius of the roller, or of a round face (length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> contact = kinds.Contact(roller="8 mm")
    >>> contact.roller
    '8 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        flat: Flat | Mapping[str, Value] | None = None,
        roller: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("flat", flat),
            ("roller", roller),
        )


class Couple(Tree):
    """A constant couple on a link, counterclockwise.

    Parameters
    ----------
    link
        The link.
    moment
        The couple (moment in N m, kN m, N mm, lbf ft or lbf in)

    Examples
    --------
    >>> couple = kinds.Couple(link="crank", moment=0.1)
    >>> couple.link
    'crank'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        link: str,
        moment: Quantity,
    ) -> None:
        super().__init__(
            ("link", link),
            ("moment", moment),
        )


class CoupleTable(Tree):
    """A couple on a link, counterclockwise, over the input coordinate.

    Parameters
    ----------
    link
        The link.
    points
        List of [input coordinate, couple]: linear between the points, constant outside.
    period
        Repeats after this much of the input coordinate (angle in rad, deg, mrad or rev; or
        length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> couple_table = kinds.CoupleTable(
    ...     link="crank",
    ...     points=[["0 deg", 0], ["180 deg", "-5 N m"]],
    ... )
    >>> couple_table.link
    'crank'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        link: str,
        points: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value],
        period: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("link", link),
            ("points", points),
            ("period", period),
        )


class Crank(Tree):
    """A crank: a lever that turns about a fixed axis.

    Parameters
    ----------
    input
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    damping
        Damping b seen at the last mass (rotational damping in N m s/rad or N m s)
    damping_capacity
        Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default
        0. (a pure number)
    dampings
        Damping of each link
    description
        Remarks for people.
    flexibility
        `static`, in place of `masses`: the uniform object has its static deflection,
        without vibrations, and with it a contact element in series. Its speed follows. Its
        acceleration is that of its driven end. Needs a pair that stays closed and a motion
        that is known beforehand.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    geometry
        Dimensions and material, in place of inertia and stiffness
    inertia
        Total inertia J (moment of inertia in kg m^2, kg cm^2, g mm^2, lb ft^2 or lb in^2)
    inertias
        Inertia of each mass
    lever_ratio
        Factor on the position function. (a pure number)
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    lumping
        Where the inertia of each cell of the object is put. `ends`: at the far end of the
        cell. `balanced`: at both ends, so that the first moment of compliance is kept. It
        needs a contact that cannot separate, or a contact element. Behind that the first
        cell is of the former kind. Default `ends`.
    masses
        Number of masses; 0: rigid; "auto": as many masses or modes as the accuracy of the
        run needs. Default: 1, or the length of the lists.
    modes
        Number of vibration modes that the uniform object is reduced to, in place of
        `masses`: the lowest, of the object held at its driven end. The residual flexibility
        of the others is kept. Needs a pair that stays closed, or a contact element, behind
        which they are the modes of the free object.
    moment_of_inertia
        Another name of `inertia`.
    pair
        The driving pair. Default: {}.
    position
        Position function U(φ): the prescribed position of this object.
    split
        How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.
    stiffness
        Stiffness c seen at the last mass (rotational stiffness in N m/rad, N m, kN m/rad, N
        m/deg or lbf ft/rad)
    stiffnesses
        Stiffness of each link
    stops
        One-sided stops of the last mass against the ground, by name. Default: {}.

    Examples
    --------
    >>> crank = kinds.Crank("motor", from_="crank/cast-iron-disc-400mm")
    >>> crank.from_
    'crank/cast-iron-disc-400mm'
    """

    __slots__ = ()

    def __init__(
        self,
        input: str | None = None,
        *,
        damping: Quantity | None = None,
        damping_capacity: Quantity | None = None,
        dampings: Sequence[Quantity] | None = None,
        description: str | None = None,
        flexibility: Literal['static'] | None = None,
        from_: str | None = None,
        geometry: CrankGeometry | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        inertias: Sequence[Quantity] | None = None,
        lever_ratio: Quantity | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        lumping: Literal['ends', 'balanced'] | None = None,
        masses: int | str | Literal['auto'] | None = None,
        modes: int | str | None = None,
        moment_of_inertia: Quantity | None = None,
        pair: Pair | Mapping[str, Value] | None = None,
        position: Position | Mapping[str, Value] | Own | None = None,
        split: Literal['cubes', 'equal'] | Sequence[Quantity] | None = None,
        stiffness: Quantity | None = None,
        stiffnesses: Sequence[Quantity] | None = None,
        stops: Mapping[str, Stop | Mapping[str, Value]] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "crank"),
            ("input", input),
            ("damping", damping),
            ("damping_capacity", damping_capacity),
            ("dampings", dampings),
            ("description", description),
            ("flexibility", flexibility),
            ("from", from_),
            ("geometry", geometry),
            ("inertia", inertia),
            ("inertias", inertias),
            ("lever_ratio", lever_ratio),
            ("loads", loads),
            ("lumping", lumping),
            ("masses", masses),
            ("modes", modes),
            ("moment_of_inertia", moment_of_inertia),
            ("pair", pair),
            ("position", position),
            ("split", split),
            ("stiffness", stiffness),
            ("stiffnesses", stiffnesses),
            ("stops", stops),
        )


class CrankGeometry(Tree):
    """Dimensions and material, in place of inertia and stiffness

    Parameters
    ----------
    density
        Density of the material (density in kg/m^3, g/cm^3 or lb/in^3)
    height
        Height of the section, in the plane of motion (length in m, mm, cm, µm, in or ft)
    length
        Length from the axis to the tip (length in m, mm, cm, µm, in or ft)
    modulus
        Young's modulus of the material (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    width
        Width of the section, along the axis (length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> crank_geometry = kinds.CrankGeometry(
    ...     length="120 mm",
    ...     width="12 mm",
    ...     height="30 mm",
    ...     density=2700,
    ...     modulus="70 GPa",
    ... )
    >>> crank_geometry.length
    '120 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        density: Quantity,
        height: Quantity,
        length: Quantity,
        modulus: Quantity,
        width: Quantity,
    ) -> None:
        super().__init__(
            ("density", density),
            ("height", height),
            ("length", length),
            ("modulus", modulus),
            ("width", width),
        )


class Differential(Tree):
    """A sum of several inputs: a planetary gear, a differential, a summing lever.

    Parameters
    ----------
    backlash
        Backlash: gap of a form-closed pair (angle in rad, deg, mrad or rev; or length in m,
        mm, cm, µm, in or ft)
    coordinate
        Whether it turns or slides. Default: "turning".
    damping
        Damping b seen at the last mass (rotational damping in N m s/rad or N m s; or
        damping in N s/m, kN s/m or lbf s/in)
    damping_capacity
        Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default
        0. (a pure number)
    dampings
        Damping of each link
    description
        Remarks for people.
    flexibility
        `static`, in place of `masses`: the uniform object has its static deflection,
        without vibrations, and with it a contact element in series. Its speed follows. Its
        acceleration is that of its driven end. Needs a pair that stays closed and a motion
        that is known beforehand.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    geometry
        Dimensions and material, in place of inertia and stiffness
    inertia
        Total inertia J (moment of inertia in kg m^2, kg cm^2, g mm^2, lb ft^2 or lb in^2;
        or mass in kg, g, t or lb)
    inertias
        Inertia of each mass
    inputs
        What it sums, by name: at least two.
    lever
        A lever that sums by its arms: each input acts `at` a place along it.
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    lumping
        Where the inertia of each cell of the object is put. `ends`: at the far end of the
        cell. `balanced`: at both ends, so that the first moment of compliance is kept. It
        needs a contact that cannot separate, or a contact element. Behind that the first
        cell is of the former kind. Default `ends`.
    mass
        Another name of `inertia`.
    masses
        Number of masses; 0: rigid; "auto": as many masses or modes as the accuracy of the
        run needs. Default: 1, or the length of the lists.
    modes
        Number of vibration modes that the uniform object is reduced to, in place of
        `masses`: the lowest, of the object held at its driven end. The residual flexibility
        of the others is kept. Needs a pair that stays closed, or a contact element, behind
        which they are the modes of the free object.
    moment_of_inertia
        Another name of `inertia`.
    offset
        Output where every input is at zero; default 0 (angle in rad, deg, mrad or rev; or
        length in m, mm, cm, µm, in or ft)
    pair
        The driving pair. Default: {}.
    planetary
        A planetary gear: two of its inputs `sun`, `ring` and `carrier` drive the third.
    split
        How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.
    stiffness
        Stiffness c seen at the last mass (rotational stiffness in N m/rad, N m, kN m/rad, N
        m/deg or lbf ft/rad; or stiffness in N/m, N/mm, kN/mm or lbf/in)
    stiffnesses
        Stiffness of each link
    stops
        One-sided stops of the last mass against the ground, by name. Default: {}.

    Examples
    --------
    >>> differential = kinds.Differential(
    ...     inputs={"sun": {"object": "press"}, "ring": {"object": "adjuster"}},
    ...     planetary={"basic_ratio": -3},
    ...     inertia="0.5 kg m^2",
    ...     stiffness="200 kN m/rad",
    ...     damping="40 N m s/rad",
    ...     masses=1,
    ... )
    >>> differential.inertia
    '0.5 kg m^2'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        backlash: Quantity | None = None,
        coordinate: Literal['turning', 'sliding'] | None = None,
        damping: Quantity | None = None,
        damping_capacity: Quantity | None = None,
        dampings: Sequence[Quantity] | None = None,
        description: str | None = None,
        flexibility: Literal['static'] | None = None,
        from_: str | None = None,
        geometry: Geometry | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        inertias: Sequence[Quantity] | None = None,
        inputs: Mapping[str, DifferentialInput | Mapping[str, Value]] | None = None,
        lever: Lever | Mapping[str, Value] | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        lumping: Literal['ends', 'balanced'] | None = None,
        mass: Quantity | None = None,
        masses: int | str | Literal['auto'] | None = None,
        modes: int | str | None = None,
        moment_of_inertia: Quantity | None = None,
        offset: Quantity | None = None,
        pair: Pair | Mapping[str, Value] | None = None,
        planetary: Planetary | Mapping[str, Value] | None = None,
        split: Literal['cubes', 'equal'] | Sequence[Quantity] | None = None,
        stiffness: Quantity | None = None,
        stiffnesses: Sequence[Quantity] | None = None,
        stops: Mapping[str, Stop | Mapping[str, Value]] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "differential"),
            ("backlash", backlash),
            ("coordinate", coordinate),
            ("damping", damping),
            ("damping_capacity", damping_capacity),
            ("dampings", dampings),
            ("description", description),
            ("flexibility", flexibility),
            ("from", from_),
            ("geometry", geometry),
            ("inertia", inertia),
            ("inertias", inertias),
            ("inputs", inputs),
            ("lever", lever),
            ("loads", loads),
            ("lumping", lumping),
            ("mass", mass),
            ("masses", masses),
            ("modes", modes),
            ("moment_of_inertia", moment_of_inertia),
            ("offset", offset),
            ("pair", pair),
            ("planetary", planetary),
            ("split", split),
            ("stiffness", stiffness),
            ("stiffnesses", stiffnesses),
            ("stops", stops),
        )


class DifferentialInput(Tree):
    """What `differential_input` is made of.

    Parameters
    ----------
    object
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    at
        Place of the input along the lever, with `lever` (length in m, mm, cm, µm, in or ft)
    ratio
        Factor with which the input enters the sum. (a pure number; or length per angle in
        m/rad, mm/rad, mm/rev or mm)

    Examples
    --------
    >>> differential_input = kinds.DifferentialInput(object="motor")
    >>> differential_input.object
    'motor'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        object: str,
        at: Quantity | None = None,
        ratio: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("object", object),
            ("at", at),
            ("ratio", ratio),
        )


class DiscCam(Tree):
    """What `disc_cam` is made of.

    Parameters
    ----------
    base_radius
        Radius of the base circle: the smallest circle about the axis that the profile
        touches (length in m, mm, cm, µm, in or ft)
    contact
        What of the follower touches the cam.
    arm
        From the follower's axis to the centre of the roller, or to the edge (length in m,
        mm, cm, µm, in or ft)
    centre_distance
        Distance between the axes of cam and follower (length in m, mm, cm, µm, in or ft)
    direction
        For drawings: direction of outward motion (default 90 deg), or from the cam's axis
        to that of a turning follower (default 0) (angle in rad, deg, mrad or rev)
    material
        Material of follower and cam, the counter-body: for the Hertzian pressure between
        them.
    offset
        Distance of the follower's line from the cam's axis, positive to the side on which
        the cam's surface moves outwards (length in m, mm, cm, µm, in or ft) Default: 0.0.
    positive
        Where positive displacement takes the follower, seen from the cam's axis. Default:
        "outward".
    range
        First and last angle of the cam that an open profile covers; without it a whole turn
    sense
        Sense in which the cam turns as its angle grows. Default: "counterclockwise".
    surface
        Which side of the cam is touched. Default: "disc".
    swing
        Whether the follower moves outwards against the sense in which the cam turns, or
        with it. Default: "against".

    Examples
    --------
    >>> disc_cam = kinds.DiscCam(base_radius="30 mm", contact={"flat": {"width": "50 mm"}})
    >>> disc_cam.base_radius
    '30 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        base_radius: Quantity,
        contact: Literal['knife_edge'] | Contact | Mapping[str, Value],
        arm: Quantity | None = None,
        centre_distance: Quantity | None = None,
        direction: Quantity | None = None,
        material: Material | Mapping[str, Value] | None = None,
        offset: Quantity | None = None,
        positive: Literal['outward', 'inward'] | None = None,
        range: Sequence[Quantity] | None = None,
        sense: Literal['counterclockwise', 'clockwise'] | None = None,
        surface: Literal['disc', 'hollow', 'groove'] | None = None,
        swing: Literal['against', 'with'] | None = None,
    ) -> None:
        super().__init__(
            ("base_radius", base_radius),
            ("contact", contact),
            ("arm", arm),
            ("centre_distance", centre_distance),
            ("direction", direction),
            ("material", material),
            ("offset", offset),
            ("positive", positive),
            ("range", range),
            ("sense", sense),
            ("surface", surface),
            ("swing", swing),
        )


class Drive(Tree):
    """A drive: prescribed motion, or a motor.

    Parameters
    ----------
    coordinate
        Whether the drive turns or slides (a cylinder, a linear motor). Default: "turning".
    description
        Remarks for people.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    motion
        Prescribed motion.
    motor
        A motor.

    Examples
    --------
    >>> drive = kinds.Drive(from_="drive/servo-20nm")
    >>> drive.from_
    'drive/servo-20nm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        coordinate: Literal['turning', 'sliding'] | None = None,
        description: str | None = None,
        from_: str | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        motion: Motion | Mapping[str, Value] | None = None,
        motor: Motor | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "drive"),
            ("coordinate", coordinate),
            ("description", description),
            ("from", from_),
            ("loads", loads),
            ("motion", motion),
            ("motor", motor),
        )


class FirstTimes(Tree):
    """What `first_times` is made of.

    Parameters
    ----------
    condition
        Comparisons over t, phi, phi_dot, acceleration, delta, reaction, contact_force and
        clearance of the object, in SI units: "phi > 0.3 && t > 1".
    of
        Object, output or stop whose motion the condition is about: `rocker`, `press.ram`.

    Examples
    --------
    >>> first_times = kinds.FirstTimes(of="follower", condition="phi > lift/2")
    >>> first_times.of
    'follower'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        condition: str,
        of: str,
    ) -> None:
        super().__init__(
            ("condition", condition),
            ("of", of),
        )


class Flat(Tree):
    """A flat face.

    Parameters
    ----------
    face_offset
        Distance of the face from the follower's axis, positive when the face lies between
        that axis and the cam (length in m, mm, cm, µm, in or ft) Default: 0.0.
    inclination
        Angle between the face's normal and the direction of motion, positive against the
        sense in which the cam turns (angle in rad, deg, mrad or rev) Default: 0.0.
    width
        Width of the face (length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> flat = kinds.Flat(width="28 mm")
    >>> flat.width
    '28 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        face_offset: Quantity | None = None,
        inclination: Quantity | None = None,
        width: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("face_offset", face_offset),
            ("inclination", inclination),
            ("width", width),
        )


class Force(Tree):
    """Driving force over speed.

    Parameters
    ----------
    constant
        Constant force (force in N, kN, MN, lbf or kgf)
    expression
        Expression over t, phi and phi_dot of the drive, in s, rad or m: "30*(1 -
        phi_dot/150)".
    linear
        T₀·(1 − ω/ω₀).
    over
        Another object or output: `press`, `press.ram`. `expression` knows its motion as
        over_phi and over_phi_dot.
    table
        List of [speed, force]: linear between the points, constant outside.
    unit
        Unit of the value of `expression`; default SI (force in N, kN, MN, lbf or kgf)

    Examples
    --------
    >>> force = kinds.Force(constant="250 N")
    >>> force.constant
    '250 N'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        constant: Quantity | None = None,
        expression: str | None = None,
        linear: Linear | Mapping[str, Value] | None = None,
        over: str | None = None,
        table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
        unit: str | None = None,
    ) -> None:
        super().__init__(
            ("constant", constant),
            ("expression", expression),
            ("linear", linear),
            ("over", over),
            ("table", table),
            ("unit", unit),
        )


class FourBar(Tree):
    """Four-bar linkage: angle of the driven lever.

    Parameters
    ----------
    coupler
        Length of the coupler (length in m, mm, cm, µm, in or ft)
    crank
        Length of the driving crank (length in m, mm, cm, µm, in or ft)
    frame
        Distance of the fixed pivots (length in m, mm, cm, µm, in or ft)
    rocker
        Length of the driven lever (length in m, mm, cm, µm, in or ft)
    branch
        `+`: open, `-`: crossed. Default: "+".
    phase
        Added to the driver's angle (angle in rad, deg, mrad or rev) Default: 0.0.

    Examples
    --------
    >>> four_bar = kinds.FourBar(crank="40 mm", coupler="120 mm", rocker="100 mm", frame="130 mm")
    >>> four_bar.crank
    '40 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        coupler: Quantity,
        crank: Quantity,
        frame: Quantity,
        rocker: Quantity,
        branch: Literal['+', '-'] | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("coupler", coupler),
            ("crank", crank),
            ("frame", frame),
            ("rocker", rocker),
            ("branch", branch),
            ("phase", phase),
        )


class Friction(Tree):
    """Dry friction that sticks, with `sliding`; or Coulomb friction, regularised: W = −force·tanh(φ̇/width).

    Parameters
    ----------
    engagement
        With `sliding`: factor by which a clutch or a brake is pressed, 0 where it is below.
        An expression as of a load, "t < 0.2 ? 0 : 1"
    force
        Force of friction that is regularised over a `width`: it creeps (moment in N m, kN
        m, N mm, lbf ft or lbf in; or force in N, kN, MN, lbf or kgf)
    sliding
        Friction while it slides; at rest it sticks, up to `static` (moment in N m, kN m, N
        mm, lbf ft or lbf in; or force in N, kN, MN, lbf or kgf)
    static
        With `sliding`: greatest force that holds it at rest; default `sliding` (moment in N
        m, kN m, N mm, lbf ft or lbf in; or force in N, kN, MN, lbf or kgf)
    stribeck_speed
        With `static`: speed over which friction falls from `static` towards `sliding`, F =
        sliding + (static − sliding)·exp(−|φ̇|/stribeck_speed); without it at once (angular
        speed in rad/s, rev/s, rpm, 1/min or deg/s; or speed in m/s, mm/s, m/min, in/s or
        ft/s)
    width
        With `force`: speed at which 76 % of the force is reached (angular speed in rad/s,
        rev/s, rpm, 1/min or deg/s; or speed in m/s, mm/s, m/min, in/s or ft/s)

    Examples
    --------
    >>> friction = kinds.Friction(sliding="4 N", static="5 N")
    >>> friction.sliding
    '4 N'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        engagement: str | None = None,
        force: Quantity | None = None,
        sliding: Quantity | None = None,
        static: Quantity | None = None,
        stribeck_speed: Quantity | None = None,
        width: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("engagement", engagement),
            ("force", force),
            ("sliding", sliding),
            ("static", static),
            ("stribeck_speed", stribeck_speed),
            ("width", width),
        )


class From(Tree):
    """Geometry from which the stiffness follows, in its place.

    Parameters
    ----------
    cam
        Contact along a line with the object's own `cam`, of its `material`: radii, width
        and moduli are those, k is the secant N/p at a stated load.
    line
        Contact along a line (roller, flat face): k is the secant N/p at a stated load.
    point
        Contact in a point, by Hertz: K; the law is `hertz`.

    Examples
    --------
    >>> from_ = kinds.From(line={"width": "12 mm", "load": "1 kN", "modulus": "206 GPa"})
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        cam: Cam | Mapping[str, Value] | None = None,
        line: Line | Mapping[str, Value] | None = None,
        point: Point | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("cam", cam),
            ("line", line),
            ("point", point),
        )


class Gear(Tree):
    """Two gears: seen from their carrier they turn as their numbers of teeth say.

    Parameters
    ----------
    wheels
        The two links, with the wheels or the gear and its rack; `ground` for what stands
        still.
    carrier
        The link that carries both, or `ground`; default the only one that does.
    diameters
        In place of `teeth`: diameters of the pitch circles; their ratio counts.
    internal
        True: one of them has internal teeth, and both turn in the same sense. Default:
        false.
    offset
        Angle of the second wheel (or displacement of the rack) seen from the carrier where
        that of the first is zero: how they were put together (angle in rad, deg, mrad or
        rev) Default: 0.0.
    teeth
        Numbers of teeth of the first and the second gear.

    Examples
    --------
    >>> gear = kinds.Gear(wheels=["sun", "planet"], teeth=[24, 18])
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        wheels: Sequence[str],
        carrier: str | None = None,
        diameters: Sequence[Quantity] | None = None,
        internal: bool | None = None,
        offset: Quantity | None = None,
        teeth: Sequence[int | str] | None = None,
    ) -> None:
        super().__init__(
            ("wheels", wheels),
            ("carrier", carrier),
            ("diameters", diameters),
            ("internal", internal),
            ("offset", offset),
            ("teeth", teeth),
        )


class Geometry(Tree):
    """Dimensions and material, in place of inertia and stiffness

    Parameters
    ----------
    density
        Density of the material (density in kg/m^3, g/cm^3 or lb/in^3)
    length
        Length (length in m, mm, cm, µm, in or ft)
    modulus
        Young's modulus of the material (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    area
        Area of the section (area in m^2, mm^2, cm^2 or in^2)
    diameter
        Diameter of a round section (length in m, mm, cm, µm, in or ft)
    section
        Width and height of a rectangular section

    Examples
    --------
    >>> geometry = kinds.Geometry(
    ...     section=["16 mm", "25 mm"],
    ...     length="80 mm",
    ...     density=7850,
    ...     modulus="210 GPa",
    ... )
    >>> geometry.length
    '80 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        density: Quantity,
        length: Quantity,
        modulus: Quantity,
        area: Quantity | None = None,
        diameter: Quantity | None = None,
        section: Sequence[Quantity] | None = None,
    ) -> None:
        super().__init__(
            ("density", density),
            ("length", length),
            ("modulus", modulus),
            ("area", area),
            ("diameter", diameter),
            ("section", section),
        )


class Gravity(Tree):
    """What `gravity` is made of.

    Parameters
    ----------
    acceleration
        Acceleration of free fall (acceleration in m/s^2, mm/s^2, in/s^2 or ft/s^2) Default:
        9.80665.
    direction
        Its direction; default downwards, −90 deg (angle in rad, deg, mrad or rev) Default:
        -1.5707963267948966.

    Examples
    --------
    >>> gravity = kinds.Gravity(acceleration=9.81)
    >>> gravity.acceleration
    9.81
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        acceleration: Quantity | None = None,
        direction: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("acceleration", acceleration),
            ("direction", direction),
        )


class Harmonic(Tree):
    """Sine over time, or over the displacement of the driver or of the object `over`.

    Parameters
    ----------
    amplitude
        Amplitude (moment in N m, kN m, N mm, lbf ft or lbf in; or force in N, kN, MN, lbf
        or kgf)
    frequency
        Periods per second (frequency in Hz or kHz)
    mean
        Constant part (moment in N m, kN m, N mm, lbf ft or lbf in; or force in N, kN, MN,
        lbf or kgf) Default: 0.0.
    order
        Periods per turn of the driver, or of the object `over` (a pure number)
    phase
        Angle of the sine at its start (angle in rad, deg, mrad or rev) Default: 0.0.

    Examples
    --------
    >>> harmonic = kinds.Harmonic(amplitude="5 N m", order=2)
    >>> harmonic.amplitude
    '5 N m'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        amplitude: Quantity,
        frequency: Quantity | None = None,
        mean: Quantity | None = None,
        order: Quantity | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("amplitude", amplitude),
            ("frequency", frequency),
            ("mean", mean),
            ("order", order),
            ("phase", phase),
        )


class HuntCrossley(Tree):
    """N = c·p·max(0, 1 + κ·ṗ)

    Parameters
    ----------
    kappa
        κ, seconds per unit of penetration (time per angle in s/rad or s; or time per length
        in s/m or s/mm)

    Examples
    --------
    >>> hunt_crossley = kinds.HuntCrossley(kappa=0.9)
    >>> hunt_crossley.kappa
    0.9
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        kappa: Quantity,
    ) -> None:
        super().__init__(
            ("kappa", kappa),
        )


class Identify(Tree):
    """Numbers that are sought from records of the motion (`dam identify`).

    Parameters
    ----------
    match
        Columns of the records and the signals that they measure: "x=rocker.delta".
    vary
        Numbers that are sought, and their ranges: PATH=LOW:HIGH, with :START and :log if
        wanted.
    record
        Records of the motion, CSV files in the folder of the scene, with settings for one
        of them behind semicolons: "test.csv; shaft.motion.speed=300 rpm". Default: [].
    sigma
        Standard deviations of columns: "x=1 µrad". Default: [].
    starts
        Number of starts (8).
    until
        Up to where records are used; to their end if not given.

    Examples
    --------
    >>> identify = kinds.Identify(
    ...     record=["released_wheel.csv"],
    ...     match=["deflection=wheel.delta"],
    ...     vary=["wheel.stiffness=5:12 kN m/rad"],
    ...     sigma=["deflection=20 µrad"],
    ... )
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        match: Sequence[str],
        vary: Sequence[str],
        record: Sequence[str] | None = None,
        sigma: Sequence[str] | None = None,
        starts: int | str | None = None,
        until: Literal['first_separation'] | None = None,
    ) -> None:
        super().__init__(
            ("match", match),
            ("vary", vary),
            ("record", record),
            ("sigma", sigma),
            ("starts", starts),
            ("until", until),
        )


class Indicator(Tree):
    """Pressure on a piston over the displacement of the driver or of the object `over`: the indicator diagram of an engine or a compressor.

    Parameters
    ----------
    area
        Area of the piston; positive: the pressure pushes towards positive displacement
        (area in m^2, mm^2, cm^2 or in^2)
    points
        List of [displacement of the driver or of `over`, pressure]: linear between the
        points.
    ambient
        Pressure on the other side of the piston (pressure in Pa, kPa, bar, MPa or psi)
        Default: 101325.0.
    period
        Repeats after this much of that displacement: 360 deg of a two-stroke, 720 deg of a
        four-stroke engine; default one turn of what turns (angle in rad, deg, mrad or rev;
        or length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> indicator = kinds.Indicator(
    ...     points=[
    ...         ["0 deg", "20 bar"],
    ...         ["30 deg", "35 bar"],
    ...         ["120 deg", "4 bar"],
    ...         ["180 deg", "1.2 bar"],
    ...         ["540 deg", "1 bar"],
    ...         ["660 deg", "6 bar"],
    ...     ],
    ...     area="-50 cm^2",
    ...     ambient="1 bar",
    ...     period="720 deg",
    ... )
    >>> indicator.area
    '-50 cm^2'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        area: Quantity,
        points: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value],
        ambient: Quantity | None = None,
        period: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("area", area),
            ("points", points),
            ("ambient", ambient),
            ("period", period),
        )


class Kloss(Tree):
    """Asynchronous motor: 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.

    Parameters
    ----------
    breakdown_slip
        Slip s_b of the greatest torque (a pure number)
    breakdown_torque
        Greatest torque T_b (moment in N m, kN m, N mm, lbf ft or lbf in)
    synchronous_speed
        Synchronous speed ω_s (angular speed in rad/s, rev/s, rpm, 1/min or deg/s)

    Examples
    --------
    >>> kloss = kinds.Kloss(
    ...     breakdown_torque="51.7 N m",
    ...     breakdown_slip=0.2,
    ...     synchronous_speed="1500 rpm",
    ... )
    >>> kloss.breakdown_torque
    '51.7 N m'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        breakdown_slip: Quantity,
        breakdown_torque: Quantity,
        synchronous_speed: Quantity,
    ) -> None:
        super().__init__(
            ("breakdown_slip", breakdown_slip),
            ("breakdown_torque", breakdown_torque),
            ("synchronous_speed", synchronous_speed),
        )


class Law(Tree):
    """What `law` is made of.

    Parameters
    ----------
    hunt_crossley
        N = c·p·max(0, 1 + κ·ṗ)

    Examples
    --------
    >>> law = kinds.Law(hunt_crossley={"kappa": 0.9})
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        hunt_crossley: HuntCrossley | Mapping[str, Value],
    ) -> None:
        super().__init__(
            ("hunt_crossley", hunt_crossley),
        )


class LawOf(Tree):
    """What `law` is made of.

    Parameters
    ----------
    polynomial
        Polynomial from conditions at its ends; θ and θ′ are 0, 0 and 1, 0 there.
    scca
        Sine, constant and cosine acceleration, symmetric.
    sections
        Run-up, uniform motion and run-out.
    table
        List of [τ, θ] from [0, 0] to [1, 1]: a smooth spline, at rest at both ends.

    Examples
    --------
    >>> law_of = kinds.LawOf(
    ...     sections={
    ...         "run_up": "equilateral_trapezoid",
    ...         "run_out": "cosine",
    ...         "skewness": 3,
    ...         "uniform": 0,
    ...     },
    ... )
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        polynomial: Polynomial | Mapping[str, Value] | None = None,
        scca: Scca | Mapping[str, Value] | None = None,
        sections: Sections | Mapping[str, Value] | None = None,
        table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("polynomial", polynomial),
            ("scca", scca),
            ("sections", sections),
            ("table", table),
        )


class Lever(Tree):
    """A lever that sums by its arms: each input acts `at` a place along it.

    Parameters
    ----------
    output
        Place of the output along the lever (length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> lever = kinds.Lever(output="0.3 m")
    >>> lever.output
    '0.3 m'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        output: Quantity,
    ) -> None:
        super().__init__(
            ("output", output),
        )


class Lift(Tree):
    """Lift of the roller's centre from its circle, radially, over the angle in the cam: a law that repeats after a turn; default none, a circle.

    Parameters
    ----------
    cam
        Cam with rise, dwell, return and rest.
    plan
        Plan of motion: any number of rises, dwells and returns.
    sine
        U = amplitude·sin(harmonic·φ + phase) + offset.
    table
        Smooth spline through given points.

    Examples
    --------
    >>> lift = kinds.Lift(sine={"amplitude": "4 mm", "harmonic": 3})
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        cam: LiftCam | Mapping[str, Value] | None = None,
        plan: Plan | Mapping[str, Value] | None = None,
        sine: Sine | Mapping[str, Value] | None = None,
        table: Table | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("cam", cam),
            ("plan", plan),
            ("sine", sine),
            ("table", table),
        )


class LiftCam(Tree):
    """Cam with rise, dwell, return and rest.

    Parameters
    ----------
    law
        Law of motion of both, or an object with one for the rise and one for the return.
    lift
        Full stroke (length in m, mm, cm, µm, in or ft)
    return_
        Angle of the return (angle in rad, deg, mrad or rev)
    rise
        Angle of the rise (angle in rad, deg, mrad or rev)
    dwell
        Angle of the upper dwell (angle in rad, deg, mrad or rev) Default: 0.0.
    phase
        Added to the driver's angle (angle in rad, deg, mrad or rev) Default: 0.0.
    rest
        Angle of the rest; if given, the four angles must make a full turn (angle in rad,
        deg, mrad or rev)

    Examples
    --------
    >>> lift_cam = kinds.LiftCam(
    ...     lift="4 mm",
    ...     rise="90 deg",
    ...     dwell="60 deg",
    ...     return_="90 deg",
    ...     law="cycloidal",
    ... )
    >>> lift_cam.lift
    '4 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        law: Literal['parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | LawOf | Mapping[str, Value] | LiftCamLaw,
        lift: Quantity,
        return_: Quantity,
        rise: Quantity,
        dwell: Quantity | None = None,
        phase: Quantity | None = None,
        rest: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("law", law),
            ("lift", lift),
            ("return", return_),
            ("rise", rise),
            ("dwell", dwell),
            ("phase", phase),
            ("rest", rest),
        )


class LiftCamLaw(Tree):
    """What `law` is made of.

    Parameters
    ----------
    return_
        Law of the return, run backwards.
    rise
        Law of the rise.

    Examples
    --------
    >>> lift_cam_law = kinds.LiftCamLaw(rise="harmonic", return_="cycloidal")
    >>> lift_cam_law.rise
    'harmonic'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        return_: Literal['parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | LawOf | Mapping[str, Value],
        rise: Literal['parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | LawOf | Mapping[str, Value],
    ) -> None:
        super().__init__(
            ("return", return_),
            ("rise", rise),
        )


class Line(Tree):
    """Contact along a line (roller, flat face): k is the secant N/p at a stated load.

    Parameters
    ----------
    load
        Contact force at which k is the secant N/p (force in N, kN, MN, lbf or kgf)
    modulus
        Young's modulus of the object (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    width
        Length of the line of contact (length in m, mm, cm, µm, in or ft)
    arm
        Arm on which the contact acts, of an object that turns (length in m, mm, cm, µm, in
        or ft)
    counter_depth
        Depth below the counter-body's surface from which its approach is counted, where
        that is flat or hollow (length in m, mm, cm, µm, in or ft)
    counter_modulus
        Young's modulus of the counter-body; absent: that of the object (modulus in Pa, MPa,
        GPa, N/mm^2 or ksi)
    counter_poisson_ratio
        Poisson's ratio of the counter-body; absent: that of the object (a pure number)
    counter_radius
        Radius of the counter-body: positive convex, negative hollow; absent: flat (length
        in m, mm, cm, µm, in or ft)
    depth
        Depth below the object's surface from which its approach is counted, where that is
        flat or hollow (length in m, mm, cm, µm, in or ft)
    poisson_ratio
        Poisson's ratio of the object. (a pure number) Default: 0.3.
    radius
        Radius of the object: positive convex, negative hollow; absent: flat (length in m,
        mm, cm, µm, in or ft)

    Examples
    --------
    >>> line = kinds.Line(width="12 mm", load="1 kN", modulus="206 GPa", radius="8 mm")
    >>> line.width
    '12 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        load: Quantity,
        modulus: Quantity,
        width: Quantity,
        arm: Quantity | None = None,
        counter_depth: Quantity | None = None,
        counter_modulus: Quantity | None = None,
        counter_poisson_ratio: Quantity | None = None,
        counter_radius: Quantity | None = None,
        depth: Quantity | None = None,
        poisson_ratio: Quantity | None = None,
        radius: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("load", load),
            ("modulus", modulus),
            ("width", width),
            ("arm", arm),
            ("counter_depth", counter_depth),
            ("counter_modulus", counter_modulus),
            ("counter_poisson_ratio", counter_poisson_ratio),
            ("counter_radius", counter_radius),
            ("depth", depth),
            ("poisson_ratio", poisson_ratio),
            ("radius", radius),
        )


class Linear(Tree):
    """T₀·(1 − ω/ω₀).

    Parameters
    ----------
    no_load_speed
        Speed without load, ω₀ (speed in m/s, mm/s, m/min, in/s or ft/s)
    stall_force
        Force at rest, F₀ (force in N, kN, MN, lbf or kgf)

    Examples
    --------
    >>> linear = kinds.Linear(stall_force="400 N", no_load_speed="1.2 m/s")
    >>> linear.stall_force
    '400 N'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        no_load_speed: Quantity,
        stall_force: Quantity,
    ) -> None:
        super().__init__(
            ("no_load_speed", no_load_speed),
            ("stall_force", stall_force),
        )


class Linkage(Tree):
    """A planar linkage of rigid links, with one degree of freedom or several.

    Parameters
    ----------
    input
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    assembly
        How a group of links is put together, by one of its links: default by its branch
        `+`. Default: {}.
    couplings
        Gears, belts and racks by name, each between two links (or a link and the ground)
        that a third one carries; and cams, each between two links. Default: {}.
    description
        Remarks for people.
    dimensions
        Named numbers, to which the others refer: "rod", "-rod", "rod/2", "rod*0.4". Those
        of a catalogue object are replaced one by one.
    driver
        The pair that is driven: its coordinate is the input of the linkage.
    forces
        Springs, dampers and forces by name. Default: {}.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    gravity
        Weights of the links: false, true (9.80665 m/s², downwards), or acceleration and
        direction. Default: false.
    ground
        Points of the ground by name, each [x, y]. Default: {}.
    inputs
        In place of `input`, `driver`, `position`, `start` and `travel`: its independent
        coordinates by name, as many as its mobility. Each is an output too, `press.left`.
    joint_friction
        True: the friction of the joints acts on the motion in `dam run`. The linkage, or
        single joints of one with several inputs, may come to rest by it. False: it counts
        in `dam forces` only. Default: false.
    links
        The moving links by name.
    outputs
        Outputs by name: other objects take them as `input`, as in `press.ram`, and they are
        recorded. Default: {}.
    pairs
        The kinematic pairs by name, and the welds.
    position
        Input coordinate over the driver's displacement: a constant ratio. Default:
        {"ratio": 1.0}.
    start
        Input coordinate at which `assembly` holds: the linkage is put together there (angle
        in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or ft) Default: 0.0.
    travel
        Least and greatest input coordinate: the stroke of a cylinder; default as far as the
        links allow.

    Examples
    --------
    >>> linkage = kinds.Linkage("motor", from_="linkage/shaper")
    >>> linkage.from_
    'linkage/shaper'
    """

    __slots__ = ()

    def __init__(
        self,
        input: str | None = None,
        *,
        assembly: Mapping[str, LinkageAssembly | Mapping[str, Value]] | None = None,
        couplings: Mapping[str, LinkageCoupling | Mapping[str, Value]] | None = None,
        description: str | None = None,
        dimensions: Mapping[str, Quantity] | None = None,
        driver: str | None = None,
        forces: Mapping[str, LinkageForce | Mapping[str, Value]] | None = None,
        from_: str | None = None,
        gravity: Gravity | Mapping[str, Value] | bool | None = None,
        ground: Mapping[str, Sequence[Quantity]] | None = None,
        inputs: Mapping[str, LinkageInput | Mapping[str, Value]] | None = None,
        joint_friction: bool | None = None,
        links: Mapping[str, LinkageLink | Mapping[str, Value]] | None = None,
        outputs: Mapping[str, LinkageOutput | Mapping[str, Value]] | None = None,
        pairs: Mapping[str, LinkagePair | Mapping[str, Value]] | None = None,
        position: Position | Mapping[str, Value] | Own | None = None,
        start: Quantity | None = None,
        travel: Sequence[Quantity] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "linkage"),
            ("input", input),
            ("assembly", assembly),
            ("couplings", couplings),
            ("description", description),
            ("dimensions", dimensions),
            ("driver", driver),
            ("forces", forces),
            ("from", from_),
            ("gravity", gravity),
            ("ground", ground),
            ("inputs", inputs),
            ("joint_friction", joint_friction),
            ("links", links),
            ("outputs", outputs),
            ("pairs", pairs),
            ("position", position),
            ("start", start),
            ("travel", travel),
        )


class LinkageAssembly(Tree):
    """What `linkage_assembly` is made of.

    Parameters
    ----------
    angle
        Its angle at the start is near this one (angle in rad, deg, mrad or rev)
    branch
        Side on which a group of two links lies.
    near
        Its point is near this place at the start.
    point
        The point of `near`; default the origin of the link's frame.

    Examples
    --------
    >>> linkage_assembly = kinds.LinkageAssembly(angle=0)
    >>> linkage_assembly.angle
    0
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        angle: Quantity | None = None,
        branch: Literal['+', '-'] | None = None,
        near: Sequence[Quantity] | None = None,
        point: str | None = None,
    ) -> None:
        super().__init__(
            ("angle", angle),
            ("branch", branch),
            ("near", near),
            ("point", point),
        )


class LinkageCoupling(Tree):
    """What `linkage_coupling` is made of.

    Parameters
    ----------
    belt
        A belt or chain over two pulleys.
    cam
        A cam of one link on which a roller or a point of another one runs.
    gear
        Two gears: seen from their carrier they turn as their numbers of teeth say.
    rack
        A gear and a rack, which a guide joins to their carrier.

    Examples
    --------
    >>> linkage_coupling = kinds.LinkageCoupling(
    ...     gear={"wheels": ["sun", "planet"], "teeth": [24, 18]},
    ... )
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        belt: Belt | Mapping[str, Value] | None = None,
        cam: LinkageCouplingCam | Mapping[str, Value] | None = None,
        gear: Gear | Mapping[str, Value] | None = None,
        rack: Rack | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("belt", belt),
            ("cam", cam),
            ("gear", gear),
            ("rack", rack),
        )


class LinkageCouplingCam(Tree):
    """A cam of one link on which a roller or a point of another one runs.

    Parameters
    ----------
    base_radius
        Radius of the profile about the centre where the lift is zero; without a `lift` that
        of the whole circle (length in m, mm, cm, µm, in or ft)
    centre
        The cam's centre, about which its profile is given: a point of the link (or the
        ground) that carries the cam.
    roller
        The centre of the roller, or the point that runs on the cam: a point of another
        link, or of the ground.
    direction
        Direction from which the angle of the lift is counted, in the frame of the cam's
        link (angle in rad, deg, mrad or rev) Default: 0.0.
    lift
        Lift of the roller's centre from its circle, radially, over the angle in the cam: a
        law that repeats after a turn; default none, a circle.
    roller_radius
        Radius of the roller; default 0, a point (length in m, mm, cm, µm, in or ft)
        Default: 0.0.
    sense
        Sense in which the angle of the lift is counted. A cam that turns counterclockwise
        brings what lies clockwise of the roller. Default: "counterclockwise".
    surface
        Which side of the cam is touched. Default: "disc".

    Examples
    --------
    >>> linkage_coupling_cam = kinds.LinkageCouplingCam(
    ...     centre="eccentric.C",
    ...     roller="lever.R",
    ...     base_radius="50 mm",
    ...     roller_radius="10 mm",
    ... )
    >>> linkage_coupling_cam.centre
    'eccentric.C'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        base_radius: Quantity,
        centre: str,
        roller: str,
        direction: Quantity | None = None,
        lift: Lift | Mapping[str, Value] | None = None,
        roller_radius: Quantity | None = None,
        sense: Literal['counterclockwise', 'clockwise'] | None = None,
        surface: Literal['disc', 'hollow', 'groove'] | None = None,
    ) -> None:
        super().__init__(
            ("base_radius", base_radius),
            ("centre", centre),
            ("roller", roller),
            ("direction", direction),
            ("lift", lift),
            ("roller_radius", roller_radius),
            ("sense", sense),
            ("surface", surface),
        )


class LinkageForce(Tree):
    """What `linkage_force` is made of.

    Parameters
    ----------
    couple
        A constant couple on a link, counterclockwise.
    couple_table
        A couple on a link, counterclockwise, over the input coordinate.
    force
        A constant force on a point.
    strut
        A spring, a damper and a constant force between two points; tension pulls them
        together.
    table
        A force on a point along a direction, over the input coordinate.
    torsion
        A spring and a damper in a revolute pair.

    Examples
    --------
    >>> linkage_force = kinds.LinkageForce(couple={"link": "crank", "moment": 0.1})
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        couple: Couple | Mapping[str, Value] | None = None,
        couple_table: CoupleTable | Mapping[str, Value] | None = None,
        force: LinkageForceForce | Mapping[str, Value] | None = None,
        strut: Strut | Mapping[str, Value] | None = None,
        table: LinkageForceTable | Mapping[str, Value] | None = None,
        torsion: Torsion | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("couple", couple),
            ("couple_table", couple_table),
            ("force", force),
            ("strut", strut),
            ("table", table),
            ("torsion", torsion),
        )


class LinkageForceForce(Tree):
    """A constant force on a point.

    Parameters
    ----------
    force
        The force, [x, y].
    point
        Where it acts.
    follows
        True: the force turns with the link; false: its direction is fixed. Default: false.

    Examples
    --------
    >>> linkage_force_force = kinds.LinkageForceForce(point="rod.E", force=[1, 0])
    >>> linkage_force_force.point
    'rod.E'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        force: Sequence[Quantity],
        point: str,
        follows: bool | None = None,
    ) -> None:
        super().__init__(
            ("force", force),
            ("point", point),
            ("follows", follows),
        )


class LinkageForceTable(Tree):
    """A force on a point along a direction, over the input coordinate.

    Parameters
    ----------
    point
        Where it acts.
    points
        List of [input coordinate, force]: linear between the points, constant outside.
    direction
        Its direction in the frame of the ground (angle in rad, deg, mrad or rev) Default:
        0.0.
    period
        Repeats after this much of the input coordinate (angle in rad, deg, mrad or rev; or
        length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> linkage_force_table = kinds.LinkageForceTable(
    ...     point="ram.origin",
    ...     points=[["0 deg", 0], ["90 deg", "-2 kN"]],
    ... )
    >>> linkage_force_table.point
    'ram.origin'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        point: str,
        points: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value],
        direction: Quantity | None = None,
        period: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("point", point),
            ("points", points),
            ("direction", direction),
            ("period", period),
        )


class LinkageInput(Tree):
    """What `linkage_input` is made of.

    Parameters
    ----------
    angle
        The angle of a link that floats.
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    object
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    offset
        With `object`: input coordinate where that is at zero; default 0 (angle in rad, deg,
        mrad or rev; or length in m, mm, cm, µm, in or ft)
    pair
        The coordinate of a pair.
    ratio
        With `object`: input coordinate over the displacement of that; default 1 (a pure
        number; or length per angle in m/rad, mm/rad, mm/rev or mm)
    speed
        Speed at the start of a free input; default 0 (angular speed in rad/s, rev/s, rpm,
        1/min or deg/s; or speed in m/s, mm/s, m/min, in/s or ft/s)
    start
        Value at which `assembly` holds; a free input starts there. Default 0, with `object`
        where that starts (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or
        ft)
    x
        x of the origin of a link that floats: no pair joins it to the ground, and its `y`
        and `angle` are inputs too.
    y
        y of the origin of a link that floats.

    Examples
    --------
    >>> linkage_input = kinds.LinkageInput(pair="O")
    >>> linkage_input.pair
    'O'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        angle: str | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        object: str | None = None,
        offset: Quantity | None = None,
        pair: str | None = None,
        ratio: Quantity | None = None,
        speed: Quantity | None = None,
        start: Quantity | None = None,
        x: str | None = None,
        y: str | None = None,
    ) -> None:
        super().__init__(
            ("angle", angle),
            ("loads", loads),
            ("object", object),
            ("offset", offset),
            ("pair", pair),
            ("ratio", ratio),
            ("speed", speed),
            ("start", start),
            ("x", x),
            ("y", y),
        )


class LinkageLink(Tree):
    """What `linkage_link` is made of.

    Parameters
    ----------
    centre
        Centre of mass: [x, y] in the frame of the link, or the name of a point; default its
        origin.
    geometry
        A uniform bar between two points, in place of `mass`, `centre` and `moment`.
    mass
        Mass; default 0 (mass in kg, g, t or lb)
    moment
        Moment of inertia about the centre of mass; default 0 (moment of inertia in kg m^2,
        kg cm^2, g mm^2, lb ft^2 or lb in^2)
    moment_of_inertia
        Another name of `moment`.
    points
        Points by name, each [x, y] in the frame of the link; `origin` is always there.
        Default: {}.

    Examples
    --------
    >>> linkage_link = kinds.LinkageLink(mass=1)
    >>> linkage_link.mass
    1
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        centre: Sequence[Quantity] | str | None = None,
        geometry: LinkageLinkGeometry | Mapping[str, Value] | None = None,
        mass: Quantity | None = None,
        moment: Quantity | None = None,
        moment_of_inertia: Quantity | None = None,
        points: Mapping[str, Sequence[Quantity]] | None = None,
    ) -> None:
        super().__init__(
            ("centre", centre),
            ("geometry", geometry),
            ("mass", mass),
            ("moment", moment),
            ("moment_of_inertia", moment_of_inertia),
            ("points", points),
        )


class LinkageLinkGeometry(Tree):
    """A uniform bar between two points, in place of `mass`, `centre` and `moment`.

    Parameters
    ----------
    density
        Density of the material, with `width` and `height` (density in kg/m^3, g/cm^3 or
        lb/in^3)
    from_
        Point at which the bar begins; both ends may be left out when the link has two
        points, or one besides its origin.
    height
        Height of the section, in the plane of motion; default 0: a slender bar (length in
        m, mm, cm, µm, in or ft)
    mass
        Mass of the whole bar (mass in kg, g, t or lb)
    to
        Point at which it ends.
    width
        Width of the section, with `density` (length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> linkage_link_geometry = kinds.LinkageLinkGeometry(mass=0.2)
    >>> linkage_link_geometry.mass
    0.2
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        density: Quantity | None = None,
        from_: str | None = None,
        height: Quantity | None = None,
        mass: Quantity | None = None,
        to: str | None = None,
        width: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("density", density),
            ("from", from_),
            ("height", height),
            ("mass", mass),
            ("to", to),
            ("width", width),
        )


class LinkageOutput(Tree):
    """What `linkage_output` is made of.

    Parameters
    ----------
    angle
        The angle of a link.
    direction
        Direction of a point's displacement in the frame of the ground; default 0 (angle in
        rad, deg, mrad or rev)
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    pair
        The coordinate of a pair.
    point
        The displacement of a point along a direction.

    Examples
    --------
    >>> linkage_output = kinds.LinkageOutput(pair="B")
    >>> linkage_output.pair
    'B'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        angle: str | None = None,
        direction: Quantity | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        pair: str | None = None,
        point: str | None = None,
    ) -> None:
        super().__init__(
            ("angle", angle),
            ("direction", direction),
            ("loads", loads),
            ("pair", pair),
            ("point", point),
        )


class LinkagePair(Tree):
    """What `linkage_pair` is made of.

    Parameters
    ----------
    diameter
        Diameter of the pin, for friction; default 0 (length in m, mm, cm, µm, in or ft)
    friction
        Coefficient of Coulomb friction μ; it counts in `dam forces`, and with
        `joint_friction` in the motion. (a pure number) Default: 0.0.
    revolute
        A pin: its points on both links. Its coordinate is the angle of the second link less
        that of the first.
    sliding
        A block that slides along a guide.
    weld
        Two links rigidly joined, one body: no pair that moves, and no coordinate. `dam
        forces` prints its force and couple.

    Examples
    --------
    >>> linkage_pair = kinds.LinkagePair(revolute=["k2.E", "k4.E"])
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        diameter: Quantity | None = None,
        friction: Quantity | None = None,
        revolute: Sequence[str] | None = None,
        sliding: Sliding | Mapping[str, Value] | None = None,
        weld: Weld | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("diameter", diameter),
            ("friction", friction),
            ("revolute", revolute),
            ("sliding", sliding),
            ("weld", weld),
        )


class Load(Tree):
    """What `load` is made of.

    Parameters
    ----------
    constant
        Constant force W (moment in N m, kN m, N mm, lbf ft or lbf in; or force in N, kN,
        MN, lbf or kgf)
    expression
        Expression over t, phi and phi_dot of the mass, driver_phi and driver_phi_dot, in s,
        rad or m: "120*sin(2*pi*5*t)".
    friction
        Dry friction that sticks, with `sliding`; or Coulomb friction, regularised: W =
        −force·tanh(φ̇/width).
    harmonic
        Sine over time, or over the displacement of the driver or of the object `over`.
    indicator
        Pressure on a piston over the displacement of the driver or of the object `over`:
        the indicator diagram of an engine or a compressor.
    mass
        Mass it acts on: `last`, `first`, `all`, or its number from 1; default `all` for a
        weight, `last` for everything else.
    over
        Another object or output: `press`, `press.ram`; the name of the drive for the
        machine angle. `window`, `position_table`, `harmonic` and `indicator` refer to its
        displacement in place of the driver's. `expression` knows its motion as over_phi and
        over_phi_dot. `friction` that sticks acts between both: a clutch, a belt.
    position_table
        Force over the driver's displacement, or that of the object `over`.
    spring
        Spring: W = −preload − rate·φ.
    time_table
        List of [time, force]: linear between the points, constant outside.
    unit
        Unit of the value of `expression`; default SI (moment in N m, kN m, N mm, lbf ft or
        lbf in; or force in N, kN, MN, lbf or kgf)
    viscous
        Viscous: W = −b·φ̇, b (rotational damping in N m s/rad or N m s; or damping in N
        s/m, kN s/m or lbf s/in)
    weight
        Weight: W = −m·g·sin(inclination).
    window
        Constant force while the driver, or the object `over`, is between two positions.

    Examples
    --------
    >>> load = kinds.Load(viscous=50)
    >>> load.viscous
    50
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        constant: Quantity | None = None,
        expression: str | None = None,
        friction: Friction | Mapping[str, Value] | None = None,
        harmonic: Harmonic | Mapping[str, Value] | None = None,
        indicator: Indicator | Mapping[str, Value] | None = None,
        mass: int | str | Literal['last', 'first', 'all'] | None = None,
        over: str | None = None,
        position_table: PositionTable | Mapping[str, Value] | Own | None = None,
        spring: Spring | Mapping[str, Value] | None = None,
        time_table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
        unit: str | None = None,
        viscous: Quantity | None = None,
        weight: Weight | Mapping[str, Value] | None = None,
        window: Window | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("constant", constant),
            ("expression", expression),
            ("friction", friction),
            ("harmonic", harmonic),
            ("indicator", indicator),
            ("mass", mass),
            ("over", over),
            ("position_table", position_table),
            ("spring", spring),
            ("time_table", time_table),
            ("unit", unit),
            ("viscous", viscous),
            ("weight", weight),
            ("window", window),
        )


class Material(Tree):
    """Material of follower and cam, the counter-body: for the Hertzian pressure between them.

    Parameters
    ----------
    modulus
        Young's modulus of the object (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    thickness
        Length of the line of contact: the lesser of the thicknesses (length in m, mm, cm,
        µm, in or ft)
    counter_modulus
        Young's modulus of the counter-body; absent: that of the object (modulus in Pa, MPa,
        GPa, N/mm^2 or ksi)
    counter_poisson_ratio
        Poisson's ratio of the counter-body; absent: that of the object (a pure number)
    poisson_ratio
        Poisson's ratio of the object. (a pure number) Default: 0.3.

    Examples
    --------
    >>> material = kinds.Material(thickness="15 mm", modulus="206 GPa")
    >>> material.thickness
    '15 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        modulus: Quantity,
        thickness: Quantity,
        counter_modulus: Quantity | None = None,
        counter_poisson_ratio: Quantity | None = None,
        poisson_ratio: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("modulus", modulus),
            ("thickness", thickness),
            ("counter_modulus", counter_modulus),
            ("counter_poisson_ratio", counter_poisson_ratio),
            ("poisson_ratio", poisson_ratio),
        )


class Motion(Tree):
    """Prescribed motion.

    Parameters
    ----------
    acceleration
        Constant acceleration (angular acceleration in rad/s^2 or deg/s^2; or acceleration
        in m/s^2, mm/s^2, in/s^2 or ft/s^2)
    angle
        Angle at t = 0, with `speed` or `acceleration`; default 0 (angle in rad, deg, mrad
        or rev; or length in m, mm, cm, µm, in or ft)
    displacement
        Displacement at t = 0 of a drive that slides, with `speed` or `acceleration`;
        default 0 (length in m, mm, cm, µm, in or ft)
    expression
        Displacement as an expression of t in s: "0.1*sin(2*pi*t)"; speed, acceleration and
        jerk follow from it.
    fixed
        Held at this displacement. (angle in rad, deg, mrad or rev; or length in m, mm, cm,
        µm, in or ft)
    plan
        Plan of motion over time: moves by laws of motion and dwells.
    run_up
        Smooth run-up from rest to a speed.
    speed
        Constant speed (angular speed in rad/s, rev/s, rpm, 1/min or deg/s; or speed in m/s,
        mm/s, m/min, in/s or ft/s)
    start_speed
        Speed at t = 0, with `acceleration`; default 0 (angular speed in rad/s, rev/s, rpm,
        1/min or deg/s; or speed in m/s, mm/s, m/min, in/s or ft/s)
    table
        List of [time, displacement], at least three: a smooth spline through the points.
    unit
        Unit of the value of `expression`; default SI (angle in rad, deg, mrad or rev; or
        length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> motion = kinds.Motion(fixed=0)
    >>> motion.fixed
    0
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        acceleration: Quantity | None = None,
        angle: Quantity | None = None,
        displacement: Quantity | None = None,
        expression: str | None = None,
        fixed: Quantity | None = None,
        plan: Plan | Mapping[str, Value] | None = None,
        run_up: RunUp | Mapping[str, Value] | None = None,
        speed: Quantity | None = None,
        start_speed: Quantity | None = None,
        table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
        unit: str | None = None,
    ) -> None:
        super().__init__(
            ("acceleration", acceleration),
            ("angle", angle),
            ("displacement", displacement),
            ("expression", expression),
            ("fixed", fixed),
            ("plan", plan),
            ("run_up", run_up),
            ("speed", speed),
            ("start_speed", start_speed),
            ("table", table),
            ("unit", unit),
        )


class Motor(Tree):
    """A motor.

    Parameters
    ----------
    angle
        Angle at t = 0 of a drive that turns (angle in rad, deg, mrad or rev; or length in
        m, mm, cm, µm, in or ft) Default: 0.0.
    displacement
        Displacement at t = 0 of a drive that slides (angle in rad, deg, mrad or rev; or
        length in m, mm, cm, µm, in or ft) Default: 0.0.
    force
        Driving force over speed.
    inertia
        Inertia of the rotor, or mass of a linear motor; 0 when what follows it rigidly has
        inertia enough (moment of inertia in kg m^2, kg cm^2, g mm^2, lb ft^2 or lb in^2; or
        mass in kg, g, t or lb)
    mass
        Another name of `inertia`.
    moment_of_inertia
        Another name of `inertia`.
    speed
        Speed at t = 0 (angular speed in rad/s, rev/s, rpm, 1/min or deg/s; or speed in m/s,
        mm/s, m/min, in/s or ft/s) Default: 0.0.
    torque
        Driving torque over speed.

    Examples
    --------
    >>> motor = kinds.Motor(inertia="2 kg m^2", torque={"constant": 0})
    >>> motor.inertia
    '2 kg m^2'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        angle: Quantity | None = None,
        displacement: Quantity | None = None,
        force: Force | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        mass: Quantity | None = None,
        moment_of_inertia: Quantity | None = None,
        speed: Quantity | None = None,
        torque: Torque | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("angle", angle),
            ("displacement", displacement),
            ("force", force),
            ("inertia", inertia),
            ("mass", mass),
            ("moment_of_inertia", moment_of_inertia),
            ("speed", speed),
            ("torque", torque),
        )


class Optimize(Tree):
    """The wanted best values of several variables (`dam optimize`).

    Parameters
    ----------
    vary
        Variables and their ranges, PATH=LOW:HIGH, with :START and :log if wanted.
    maximize
        Result or variable to be greatest.
    minimize
        Result or variable to be least.
    starts
        Number of starts (8).
    subject
        Conditions on results: "valve.pair.margin >= 50 N". Default: [].

    Examples
    --------
    >>> optimize = kinds.Optimize(
    ...     vary=["follower.loads.spring.spring.rate=0:5000 N/m"],
    ...     subject=["follower.pair.margin >= 0"],
    ...     minimize="follower.loads.spring.spring.rate",
    ... )
    >>> optimize.minimize
    'follower.loads.spring.spring.rate'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        vary: Sequence[str],
        maximize: str | None = None,
        minimize: str | None = None,
        starts: int | str | None = None,
        subject: Sequence[str] | None = None,
    ) -> None:
        super().__init__(
            ("vary", vary),
            ("maximize", maximize),
            ("minimize", minimize),
            ("starts", starts),
            ("subject", subject),
        )


class Pair(Tree):
    """The driving pair.

    Parameters
    ----------
    closure
        How the pair is kept together: always (`bilateral`), by a closing `force`, or by
        `form` with a gap. Default: "force" or "bilateral".
    contact
        Contact between driver and object: an element of its own, in front of link 1.
    gap
        Gap η of a form-closed pair (angle in rad, deg, mrad or rev; or length in m, mm, cm,
        µm, in or ft) Default: 0.0.
    law
        Law of the contact force: `kelvin_voigt` c·p + b·ṗ, `hunt_crossley` c·p·(1 + κ·ṗ); c
        and b of link 1. Default: "kelvin_voigt".
    opens
        Side to which a force-closed pair lifts off. Default: "+".

    Examples
    --------
    >>> pair = kinds.Pair(closure="force")
    >>> pair.closure
    'force'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        closure: Literal['bilateral', 'force', 'form'] | None = None,
        contact: PairContact | Mapping[str, Value] | None = None,
        gap: Quantity | None = None,
        law: Literal['kelvin_voigt', 'hunt_crossley'] | Law | Mapping[str, Value] | None = None,
        opens: Literal['+', '-'] | None = None,
    ) -> None:
        super().__init__(
            ("closure", closure),
            ("contact", contact),
            ("gap", gap),
            ("law", law),
            ("opens", opens),
        )


class PairContact(Tree):
    """Contact between driver and object: an element of its own, in front of link 1.

    Parameters
    ----------
    damping
        Damping of `kelvin_voigt` (rotational damping in N m s/rad or N m s; or damping in N
        s/m, kN s/m or lbf s/in)
    dissipation
        χ of `hunt_crossley` and `hertz`, seconds per unit of indentation (time per angle in
        s/rad or s; or time per length in s/m or s/mm)
    from_
        Geometry from which the stiffness follows, in its place.
    law
        N over the indentation p and its rate: `elastic` k·p; `kelvin_voigt` k·p +
        damping·ṗ; `hunt_crossley` k·p·(1 + dissipation·ṗ); `hertz` K·p^(3/2)·(1 +
        dissipation·ṗ); `restitution` rigid, with impacts, which is the default where that
        is given. Default: "elastic".
    restitution
        Coefficient of restitution e of a rigid contact: the speed after an impact over that
        before it (a pure number)
    stiffness
        Stiffness k of the contact; of `hertz` K, a bare number in N/m^(3/2) or N
        m/rad^(3/2) where the exponent is 3/2; none of `restitution` (rotational stiffness
        in N m/rad, N m, kN m/rad, N m/deg or lbf ft/rad; or stiffness in N/m, N/mm, kN/mm
        or lbf/in)

    Examples
    --------
    >>> pair_contact = kinds.PairContact(restitution=0.5)
    >>> pair_contact.restitution
    0.5
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        damping: Quantity | None = None,
        dissipation: Quantity | None = None,
        from_: From | Mapping[str, Value] | None = None,
        law: Literal['elastic', 'kelvin_voigt', 'hunt_crossley', 'hertz', 'restitution'] | None = None,
        restitution: Quantity | None = None,
        stiffness: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("damping", damping),
            ("dissipation", dissipation),
            ("from", from_),
            ("law", law),
            ("restitution", restitution),
            ("stiffness", stiffness),
        )


class Plan(Tree):
    """Plan of motion: any number of rises, dwells and returns.

    Parameters
    ----------
    stations
        Stations of the plan, ascending. The last one may close the period.
    advance
        Displacement gained in every cycle: the pitch of an indexing motion (angle in rad,
        deg, mrad or rev; or length in m, mm, cm, µm, in or ft) Default: 0.0.
    period
        Length of the cycle; default one turn of a driver that turns, else once through
        (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or ft) Or: Duration
        of the cycle; default: once through (time in s, ms, µs, min or h)
    phase
        Added to the driver's displacement (or to the time) (angle in rad, deg, mrad or rev;
        or length in m, mm, cm, µm, in or ft; or time in s, ms, µs, min or h) Default: 0.0.

    Examples
    --------
    >>> plan = kinds.Plan(
    ...     stations=[
    ...         {"at": 0, "displacement": "-0.2 mm", "motion": "4-5-6-7"},
    ...         {"at": "70 deg", "displacement": "10.5 mm", "motion": "dwell"},
    ...         {"at": "74 deg", "displacement": "10.5 mm", "motion": "4-5-6-7"},
    ...         {"at": "144 deg", "displacement": "-0.2 mm", "motion": "dwell"},
    ...     ],
    ...     period="360 deg",
    ... )
    >>> plan.period
    '360 deg'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        stations: Sequence[Stations | Mapping[str, Value]],
        advance: Quantity | None = None,
        period: Quantity | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("stations", stations),
            ("advance", advance),
            ("period", period),
            ("phase", phase),
        )


class Planetary(Tree):
    """A planetary gear: two of its inputs `sun`, `ring` and `carrier` drive the third.

    Parameters
    ----------
    basic_ratio
        φ_sun/φ_ring with the carrier held: negative where a ring gear turns the other way.
        (a pure number)
    teeth
        Tooth numbers of sun and ring gear.

    Examples
    --------
    >>> planetary = kinds.Planetary(basic_ratio=-3)
    >>> planetary.basic_ratio
    -3
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        basic_ratio: Quantity | None = None,
        teeth: Teeth | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("basic_ratio", basic_ratio),
            ("teeth", teeth),
        )


class PlannedMotion(Tree):
    """What `planned_motion` is made of.

    Parameters
    ----------
    polynomial
        Polynomial from conditions at its ends; θ and θ′ are 0, 0 and 1, 0 there.
    scca
        Sine, constant and cosine acceleration, symmetric.
    sections
        Run-up, uniform motion and run-out.
    table
        List of [τ, θ] from [0, 0] to [1, 1]: a smooth spline, at rest at both ends.

    Examples
    --------
    >>> planned_motion = kinds.PlannedMotion(
    ...     sections={
    ...         "run_up": "equilateral_trapezoid",
    ...         "run_out": "cosine",
    ...         "skewness": 3,
    ...         "uniform": 0,
    ...     },
    ... )
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        polynomial: Polynomial | Mapping[str, Value] | None = None,
        scca: Scca | Mapping[str, Value] | None = None,
        sections: Sections | Mapping[str, Value] | None = None,
        table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("polynomial", polynomial),
            ("scca", scca),
            ("sections", sections),
            ("table", table),
        )


class Point(Tree):
    """Contact in a point, by Hertz: K; the law is `hertz`.

    Parameters
    ----------
    modulus
        Young's modulus of the object (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    arm
        Arm on which the contact acts, of an object that turns (length in m, mm, cm, µm, in
        or ft)
    counter_crown_radius
        Radius of the counter-body across the motion; absent: flat (length in m, mm, cm, µm,
        in or ft)
    counter_modulus
        Young's modulus of the counter-body; absent: that of the object (modulus in Pa, MPa,
        GPa, N/mm^2 or ksi)
    counter_poisson_ratio
        Poisson's ratio of the counter-body; absent: that of the object (a pure number)
    counter_radius
        Radius of the counter-body: positive convex, negative hollow; absent: flat (length
        in m, mm, cm, µm, in or ft)
    crown_radius
        Radius of the object across its motion; absent: `radius`, a ball (length in m, mm,
        cm, µm, in or ft)
    poisson_ratio
        Poisson's ratio of the object. (a pure number) Default: 0.3.
    radius
        Radius of the object: positive convex, negative hollow; absent: flat (length in m,
        mm, cm, µm, in or ft)

    Examples
    --------
    >>> point = kinds.Point(modulus="206 GPa", radius="20 mm", arm="0.2 m")
    >>> point.modulus
    '206 GPa'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        modulus: Quantity,
        arm: Quantity | None = None,
        counter_crown_radius: Quantity | None = None,
        counter_modulus: Quantity | None = None,
        counter_poisson_ratio: Quantity | None = None,
        counter_radius: Quantity | None = None,
        crown_radius: Quantity | None = None,
        poisson_ratio: Quantity | None = None,
        radius: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("modulus", modulus),
            ("arm", arm),
            ("counter_crown_radius", counter_crown_radius),
            ("counter_modulus", counter_modulus),
            ("counter_poisson_ratio", counter_poisson_ratio),
            ("counter_radius", counter_radius),
            ("crown_radius", crown_radius),
            ("poisson_ratio", poisson_ratio),
            ("radius", radius),
        )


class Polynomial(Tree):
    """Polynomial from conditions at its ends; θ and θ′ are 0, 0 and 1, 0 there.

    Parameters
    ----------
    end
        θ, θ′, θ″, … at τ = 1.
    start
        θ, θ′, θ″, … at τ = 0.
    through
        Points [τ, θ] between the ends. Default: [].

    Examples
    --------
    >>> polynomial = kinds.Polynomial(start=[0, 1.5], end=[1, 0])
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        end: Sequence[Quantity],
        start: Sequence[Quantity],
        through: Sequence[Sequence[Quantity]] | None = None,
    ) -> None:
        super().__init__(
            ("end", end),
            ("start", start),
            ("through", through),
        )


class Position(Tree):
    """What `position` is made of.

    Parameters
    ----------
    cam
        Cam with rise, dwell, return and rest.
    four_bar
        Four-bar linkage: angle of the driven lever.
    plan
        Plan of motion: any number of rises, dwells and returns.
    polynomial
        U = a₀ + a₁·φ + a₂·φ² + …
    ratio
        Constant ratio: U = ratio·φ + offset. (a pure number; or length per angle in m/rad,
        mm/rad, mm/rev or mm; or angle per length in rad/m, rad/mm or deg/mm)
    sine
        U = amplitude·sin(harmonic·φ + phase) + offset.
    slider_crank
        Slider-crank: distance of the slide from the crank's axis.
    slotted_link
        Slotted link: crank and slotted link on fixed pivots, a block on the crank's end in
        the slot; crank or block drives.
    table
        Smooth spline through given points.

    Examples
    --------
    >>> position = kinds.Position(ratio=1)
    >>> position.ratio
    1
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        cam: PositionCam | Mapping[str, Value] | None = None,
        four_bar: FourBar | Mapping[str, Value] | None = None,
        plan: Plan | Mapping[str, Value] | None = None,
        polynomial: PositionPolynomial | Mapping[str, Value] | None = None,
        ratio: Quantity | Ratio | Mapping[str, Value] | None = None,
        sine: Sine | Mapping[str, Value] | None = None,
        slider_crank: SliderCrank | Mapping[str, Value] | None = None,
        slotted_link: SlottedLink | Mapping[str, Value] | None = None,
        table: Table | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("cam", cam),
            ("four_bar", four_bar),
            ("plan", plan),
            ("polynomial", polynomial),
            ("ratio", ratio),
            ("sine", sine),
            ("slider_crank", slider_crank),
            ("slotted_link", slotted_link),
            ("table", table),
        )


class PositionCam(Tree):
    """Cam with rise, dwell, return and rest.

    Parameters
    ----------
    law
        Law of motion of both, or an object with one for the rise and one for the return.
    lift
        Full stroke (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or ft)
    return_
        Angle of the return (angle in rad, deg, mrad or rev)
    rise
        Angle of the rise (angle in rad, deg, mrad or rev)
    dwell
        Angle of the upper dwell (angle in rad, deg, mrad or rev) Default: 0.0.
    phase
        Added to the driver's angle (angle in rad, deg, mrad or rev) Default: 0.0.
    rest
        Angle of the rest; if given, the four angles must make a full turn (angle in rad,
        deg, mrad or rev)

    Examples
    --------
    >>> position_cam = kinds.PositionCam(
    ...     lift="10.5 mm",
    ...     rise="70 deg",
    ...     dwell="4 deg",
    ...     return_="70 deg",
    ...     law="4-5-6-7",
    ...     phase="-30 deg",
    ... )
    >>> position_cam.lift
    '10.5 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        law: Literal['parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | LawOf | Mapping[str, Value] | PositionCamLaw,
        lift: Quantity,
        return_: Quantity,
        rise: Quantity,
        dwell: Quantity | None = None,
        phase: Quantity | None = None,
        rest: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("law", law),
            ("lift", lift),
            ("return", return_),
            ("rise", rise),
            ("dwell", dwell),
            ("phase", phase),
            ("rest", rest),
        )


class PositionCamLaw(Tree):
    """What `law` is made of.

    Parameters
    ----------
    return_
        Law of the return, run backwards.
    rise
        Law of the rise.

    Examples
    --------
    >>> position_cam_law = kinds.PositionCamLaw(rise="harmonic", return_="cycloidal")
    >>> position_cam_law.rise
    'harmonic'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        return_: Literal['parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | LawOf | Mapping[str, Value],
        rise: Literal['parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | LawOf | Mapping[str, Value],
    ) -> None:
        super().__init__(
            ("return", return_),
            ("rise", rise),
        )


class PositionPolynomial(Tree):
    """U = a₀ + a₁·φ + a₂·φ² + …

    Parameters
    ----------
    coefficients
        a₀, a₁, a₂, … in SI units (or texts with units), lowest power first.

    Examples
    --------
    >>> position_polynomial = kinds.PositionPolynomial(coefficients=[0, 0.002, 0.0001])
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        coefficients: Sequence[Quantity],
    ) -> None:
        super().__init__(
            ("coefficients", coefficients),
        )


class PositionTable(Tree):
    """Force over the driver's displacement, or that of the object `over`.

    Parameters
    ----------
    points
        List of [displacement of the driver or of `over`, force]: linear between the points.
    period
        Repeats after this much of that displacement; without it the force is constant
        outside the points (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in
        or ft)

    Examples
    --------
    >>> position_table = kinds.PositionTable(points=[["190 mm", 0], ["220 mm", "-40 kN"]])
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        points: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value],
        period: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("points", points),
            ("period", period),
        )


class Rack(Tree):
    """A gear and a rack, which a guide joins to their carrier.

    Parameters
    ----------
    radius
        Radius of the gear's pitch circle; positive: the rack lies to the right of the gear,
        seen along its guide, and slides forwards as the gear turns counterclockwise.
        (length in m, mm, cm, µm, in or ft)
    wheels
        The two links, with the wheels or the gear and its rack; `ground` for what stands
        still.
    carrier
        The link that carries both, or `ground`; default the only one that does.
    offset
        Angle of the second wheel (or displacement of the rack) seen from the carrier where
        that of the first is zero: how they were put together (length in m, mm, cm, µm, in
        or ft) Default: 0.0.

    Examples
    --------
    >>> rack = kinds.Rack(wheels=["rocker", "rack"], radius="60 mm", offset="-120 mm")
    >>> rack.radius
    '60 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        radius: Quantity,
        wheels: Sequence[str],
        carrier: str | None = None,
        offset: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("radius", radius),
            ("wheels", wheels),
            ("carrier", carrier),
            ("offset", offset),
        )


class Ratio(Tree):
    """What `ratio` is made of.

    Parameters
    ----------
    ratio
        U′ (a pure number; or length per angle in m/rad, mm/rad, mm/rev or mm; or angle per
        length in rad/m, rad/mm or deg/mm)
    offset
        U at φ = 0 (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or ft)
        Default: 0.0.

    Examples
    --------
    >>> ratio = kinds.Ratio(ratio=0.25)
    >>> ratio.ratio
    0.25
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        ratio: Quantity,
        offset: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("ratio", ratio),
            ("offset", offset),
        )


class Rocker(Tree):
    """A rocker: a lever that swings about a fixed axis.

    Parameters
    ----------
    input
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    cam
        Geometry of the disc cam that realises the position function: for `dam cam`, and
        with a `material` for the pressure of a run; not for the dynamics.
    damping
        Damping b seen at the last mass (rotational damping in N m s/rad or N m s)
    damping_capacity
        Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default
        0. (a pure number)
    dampings
        Damping of each link
    description
        Remarks for people.
    flexibility
        `static`, in place of `masses`: the uniform object has its static deflection,
        without vibrations, and with it a contact element in series. Its speed follows. Its
        acceleration is that of its driven end. Needs a pair that stays closed and a motion
        that is known beforehand.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    geometry
        Dimensions and material, in place of inertia and stiffness
    inertia
        Total inertia J (moment of inertia in kg m^2, kg cm^2, g mm^2, lb ft^2 or lb in^2)
    inertias
        Inertia of each mass
    lever_ratio
        Factor on the position function. (a pure number)
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    lumping
        Where the inertia of each cell of the object is put. `ends`: at the far end of the
        cell. `balanced`: at both ends, so that the first moment of compliance is kept. It
        needs a contact that cannot separate, or a contact element. Behind that the first
        cell is of the former kind. Default `ends`.
    masses
        Number of masses; 0: rigid; "auto": as many masses or modes as the accuracy of the
        run needs. Default: 1, or the length of the lists.
    modes
        Number of vibration modes that the uniform object is reduced to, in place of
        `masses`: the lowest, of the object held at its driven end. The residual flexibility
        of the others is kept. Needs a pair that stays closed, or a contact element, behind
        which they are the modes of the free object.
    moment_of_inertia
        Another name of `inertia`.
    pair
        The driving pair. Default: {}.
    position
        Position function U(φ): the prescribed position of this object.
    split
        How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.
    stiffness
        Stiffness c seen at the last mass (rotational stiffness in N m/rad, N m, kN m/rad, N
        m/deg or lbf ft/rad)
    stiffnesses
        Stiffness of each link
    stops
        One-sided stops of the last mass against the ground, by name. Default: {}.

    Examples
    --------
    >>> rocker = kinds.Rocker(
    ...     "shaft",
    ...     from_="rocker/steel-lever-205mm",
    ...     position={"sine": {"amplitude": "90 deg"}},
    ...     masses=2,
    ...     pair={"closure": "form", "gap": "0.1 mrad"},
    ... )
    >>> rocker.from_
    'rocker/steel-lever-205mm'
    """

    __slots__ = ()

    def __init__(
        self,
        input: str | None = None,
        *,
        cam: CamOf | Mapping[str, Value] | None = None,
        damping: Quantity | None = None,
        damping_capacity: Quantity | None = None,
        dampings: Sequence[Quantity] | None = None,
        description: str | None = None,
        flexibility: Literal['static'] | None = None,
        from_: str | None = None,
        geometry: RockerGeometry | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        inertias: Sequence[Quantity] | None = None,
        lever_ratio: Quantity | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        lumping: Literal['ends', 'balanced'] | None = None,
        masses: int | str | Literal['auto'] | None = None,
        modes: int | str | None = None,
        moment_of_inertia: Quantity | None = None,
        pair: Pair | Mapping[str, Value] | None = None,
        position: Position | Mapping[str, Value] | Own | None = None,
        split: Literal['cubes', 'equal'] | Sequence[Quantity] | None = None,
        stiffness: Quantity | None = None,
        stiffnesses: Sequence[Quantity] | None = None,
        stops: Mapping[str, Stop | Mapping[str, Value]] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "rocker"),
            ("input", input),
            ("cam", cam),
            ("damping", damping),
            ("damping_capacity", damping_capacity),
            ("dampings", dampings),
            ("description", description),
            ("flexibility", flexibility),
            ("from", from_),
            ("geometry", geometry),
            ("inertia", inertia),
            ("inertias", inertias),
            ("lever_ratio", lever_ratio),
            ("loads", loads),
            ("lumping", lumping),
            ("masses", masses),
            ("modes", modes),
            ("moment_of_inertia", moment_of_inertia),
            ("pair", pair),
            ("position", position),
            ("split", split),
            ("stiffness", stiffness),
            ("stiffnesses", stiffnesses),
            ("stops", stops),
        )


class RockerGeometry(Tree):
    """Dimensions and material, in place of inertia and stiffness

    Parameters
    ----------
    density
        Density of the material (density in kg/m^3, g/cm^3 or lb/in^3)
    height
        Height of the section, in the plane of motion (length in m, mm, cm, µm, in or ft)
    length
        Length from the axis to the tip (length in m, mm, cm, µm, in or ft)
    modulus
        Young's modulus of the material (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    width
        Width of the section, along the axis (length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> rocker_geometry = kinds.RockerGeometry(
    ...     length="120 mm",
    ...     width="12 mm",
    ...     height="30 mm",
    ...     density=2700,
    ...     modulus="70 GPa",
    ... )
    >>> rocker_geometry.length
    '120 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        density: Quantity,
        height: Quantity,
        length: Quantity,
        modulus: Quantity,
        width: Quantity,
    ) -> None:
        super().__init__(
            ("density", density),
            ("height", height),
            ("length", length),
            ("modulus", modulus),
            ("width", width),
        )


class Run(Tree):
    """How the scene is run.

    Parameters
    ----------
    duration
        Simulated time (time in s, ms, µs, min or h)
    accuracy
        Accuracy wanted of the results, the error of the model included: a share of each, "1
        %", or by the address of a result a share or a quantity. Objects of `masses`: "auto"
        are modelled as finely as this needs. (a pure number)
    first_times
        Conditions by names of their own: the first time at which each holds is the result
        `run.first_times.NAME`.
    max_switches
        Greatest number of events; the run ends at the next. Default: 1000000.
    method
        Method of integration. Default: "auto".
    record
        Columns of the record: `objects`, six of each object (default), or `all`,
        displacement and speed of every mass and the force of every link of elastic objects
        too
    samples
        Number of equal sample intervals. Default: 1000.
    start
        State at t = 0: `kinetostatic` (quiet; of a law that repeats, as before t = 0),
        `static`, `on_law`, or explicit states by object. Default: "kinetostatic".
    step
        Step of `rk4`; greatest step of the other methods (time in s, ms, µs, min or h)
    switch_rows
        True: two rows (before, after) at each event. Default: false.
    tolerance
        Error wanted in each object's δ, relative to its scale. Without it, and with the
        method `auto` and results that must keep an accuracy (`accuracy`, `masses`: "auto"),
        it is a tenth of that accuracy. (a pure number) Default: 1e-06.
    until
        Condition that ends the run before `duration`, at the first time at which it holds:
        { "of": "rocker", "condition": "phi > 0.3" }. The motion is found up to `duration`
        first.
    window
        [from, to]: window of the steady results. Default: the last whole cycle of the
        drive.

    Examples
    --------
    >>> run = kinds.Run(duration=1, start="on_law")
    >>> run.duration
    1
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        duration: Quantity,
        accuracy: Quantity | Mapping[str, Quantity] | None = None,
        first_times: Mapping[str, FirstTimes | Mapping[str, Value]] | None = None,
        max_switches: int | str | None = None,
        method: Literal['auto', 'exact', 'rk4', 'dopri5', 'dop853', 'taylor', 'rodas5p', 'radau', 'bdf', 'tr_bdf2', 'esdirk34'] | None = None,
        record: Literal['objects', 'all'] | None = None,
        samples: int | str | None = None,
        start: Literal['kinetostatic', 'static', 'on_law'] | Mapping[str, Start | Mapping[str, Value]] | None = None,
        step: Quantity | None = None,
        switch_rows: bool | None = None,
        tolerance: Quantity | None = None,
        until: Until | Mapping[str, Value] | None = None,
        window: Sequence[Quantity] | None = None,
    ) -> None:
        super().__init__(
            ("duration", duration),
            ("accuracy", accuracy),
            ("first_times", first_times),
            ("max_switches", max_switches),
            ("method", method),
            ("record", record),
            ("samples", samples),
            ("start", start),
            ("step", step),
            ("switch_rows", switch_rows),
            ("tolerance", tolerance),
            ("until", until),
            ("window", window),
        )


class RunLaw(Tree):
    """What `run_law` is made of.

    Parameters
    ----------
    polynomial
        Polynomial from conditions at its ends; θ and θ′ are 0, 0 at the start, θ is 1 at
        the end.
    table
        List of [τ, θ] from [0, 0] to [1, 1]: a smooth spline, from rest.
    trapezoid
        Modified trapezoid of general form: shares of rise and fall of the acceleration,
        together at most 1.

    Examples
    --------
    >>> run_law = kinds.RunLaw(trapezoid={"s1": 0.25, "s2": 0.25})
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        polynomial: Polynomial | Mapping[str, Value] | None = None,
        table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
        trapezoid: Trapezoid | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("polynomial", polynomial),
            ("table", table),
            ("trapezoid", trapezoid),
        )


class RunUp(Tree):
    """Smooth run-up from rest to a speed.

    Parameters
    ----------
    speed
        Final speed (angular speed in rad/s, rev/s, rpm, 1/min or deg/s; or speed in m/s,
        mm/s, m/min, in/s or ft/s)
    time
        Duration of the run-up (time in s, ms, µs, min or h)
    angle
        Angle at t = 0 of a drive that turns (angle in rad, deg, mrad or rev; or length in
        m, mm, cm, µm, in or ft) Default: 0.0.
    displacement
        Displacement at t = 0 of a drive that slides (angle in rad, deg, mrad or rev; or
        length in m, mm, cm, µm, in or ft) Default: 0.0.
    law
        Law of the run-up; default: speed 3τ² − 2τ³ of the final one.

    Examples
    --------
    >>> run_up = kinds.RunUp(speed="40 rad/s", time="0.5 s")
    >>> run_up.speed
    '40 rad/s'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        speed: Quantity,
        time: Quantity,
        angle: Quantity | None = None,
        displacement: Quantity | None = None,
        law: Literal['rectangular', 'equilateral_trapezoid', 'sine', 'cosine', 'reversed_cosine', 'unequal_trapezoid', 'modified_sine'] | RunLaw | Mapping[str, Value] | None = None,
    ) -> None:
        super().__init__(
            ("speed", speed),
            ("time", time),
            ("angle", angle),
            ("displacement", displacement),
            ("law", law),
        )


class Scca(Tree):
    """Sine, constant and cosine acceleration, symmetric.

    Parameters
    ----------
    b
        Share of the sines at both ends together. (a pure number)
    d
        Share of the cosine about the middle. (a pure number)

    Examples
    --------
    >>> scca = kinds.Scca(b=0.25, d=0.5)
    >>> scca.b
    0.25
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        b: Quantity,
        d: Quantity,
    ) -> None:
        super().__init__(
            ("b", b),
            ("d", d),
        )


class Sections(Tree):
    """Run-up, uniform motion and run-out.

    Parameters
    ----------
    run_out
        Law of the run-out, run backwards.
    run_up
        Law of the run-up.
    skewness
        Duration of the run-out by that of the run-up. (a pure number) Default: 1.0.
    uniform
        Share of the whole duration with uniform motion, below 1. (a pure number) Default:
        0.0.

    Examples
    --------
    >>> sections = kinds.Sections(
    ...     run_up="equilateral_trapezoid",
    ...     run_out="cosine",
    ...     skewness=3,
    ...     uniform=0,
    ... )
    >>> sections.run_up
    'equilateral_trapezoid'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        run_out: Literal['rectangular', 'equilateral_trapezoid', 'sine', 'cosine', 'reversed_cosine', 'unequal_trapezoid', 'modified_sine'] | RunLaw | Mapping[str, Value],
        run_up: Literal['rectangular', 'equilateral_trapezoid', 'sine', 'cosine', 'reversed_cosine', 'unequal_trapezoid', 'modified_sine'] | RunLaw | Mapping[str, Value],
        skewness: Quantity | None = None,
        uniform: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("run_out", run_out),
            ("run_up", run_up),
            ("skewness", skewness),
            ("uniform", uniform),
        )


class Shaft(Tree):
    """A shaft: turns in a constant ratio to its driver, with torsional masses and backlash.

    Parameters
    ----------
    input
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    backlash
        Backlash: gap of a form-closed pair (angle in rad, deg, mrad or rev)
    damping
        Damping b seen at the last mass (rotational damping in N m s/rad or N m s)
    damping_capacity
        Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default
        0. (a pure number)
    dampings
        Damping of each link
    description
        Remarks for people.
    flexibility
        `static`, in place of `masses`: the uniform object has its static deflection,
        without vibrations, and with it a contact element in series. Its speed follows. Its
        acceleration is that of its driven end. Needs a pair that stays closed and a motion
        that is known beforehand.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    geometry
        Dimensions and material, in place of inertia and stiffness
    inertia
        Total inertia J (moment of inertia in kg m^2, kg cm^2, g mm^2, lb ft^2 or lb in^2)
    inertias
        Inertia of each mass
    lever_ratio
        Factor on the position function. (a pure number)
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    lumping
        Where the inertia of each cell of the object is put. `ends`: at the far end of the
        cell. `balanced`: at both ends, so that the first moment of compliance is kept. It
        needs a contact that cannot separate, or a contact element. Behind that the first
        cell is of the former kind. Default `ends`.
    masses
        Number of masses; 0: rigid; "auto": as many masses or modes as the accuracy of the
        run needs. Default: 1, or the length of the lists.
    modes
        Number of vibration modes that the uniform object is reduced to, in place of
        `masses`: the lowest, of the object held at its driven end. The residual flexibility
        of the others is kept. Needs a pair that stays closed, or a contact element, behind
        which they are the modes of the free object.
    moment_of_inertia
        Another name of `inertia`.
    pair
        The driving pair. Default: {}.
    position
        Position function U(φ): the prescribed position of this object. Default: {"ratio":
        1.0}.
    split
        How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.
    stiffness
        Stiffness c seen at the last mass (rotational stiffness in N m/rad, N m, kN m/rad, N
        m/deg or lbf ft/rad)
    stiffnesses
        Stiffness of each link
    stops
        One-sided stops of the last mass against the ground, by name. Default: {}.

    Examples
    --------
    >>> shaft = kinds.Shaft("motor", from_="shaft/ball-screw-40mm")
    >>> shaft.from_
    'shaft/ball-screw-40mm'
    """

    __slots__ = ()

    def __init__(
        self,
        input: str | None = None,
        *,
        backlash: Quantity | None = None,
        damping: Quantity | None = None,
        damping_capacity: Quantity | None = None,
        dampings: Sequence[Quantity] | None = None,
        description: str | None = None,
        flexibility: Literal['static'] | None = None,
        from_: str | None = None,
        geometry: ShaftGeometry | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        inertias: Sequence[Quantity] | None = None,
        lever_ratio: Quantity | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        lumping: Literal['ends', 'balanced'] | None = None,
        masses: int | str | Literal['auto'] | None = None,
        modes: int | str | None = None,
        moment_of_inertia: Quantity | None = None,
        pair: Pair | Mapping[str, Value] | None = None,
        position: Position | Mapping[str, Value] | Own | None = None,
        split: Literal['cubes', 'equal'] | Sequence[Quantity] | None = None,
        stiffness: Quantity | None = None,
        stiffnesses: Sequence[Quantity] | None = None,
        stops: Mapping[str, Stop | Mapping[str, Value]] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "shaft"),
            ("input", input),
            ("backlash", backlash),
            ("damping", damping),
            ("damping_capacity", damping_capacity),
            ("dampings", dampings),
            ("description", description),
            ("flexibility", flexibility),
            ("from", from_),
            ("geometry", geometry),
            ("inertia", inertia),
            ("inertias", inertias),
            ("lever_ratio", lever_ratio),
            ("loads", loads),
            ("lumping", lumping),
            ("masses", masses),
            ("modes", modes),
            ("moment_of_inertia", moment_of_inertia),
            ("pair", pair),
            ("position", position),
            ("split", split),
            ("stiffness", stiffness),
            ("stiffnesses", stiffnesses),
            ("stops", stops),
        )


class ShaftGeometry(Tree):
    """Dimensions and material, in place of inertia and stiffness

    Parameters
    ----------
    density
        Density of the material (density in kg/m^3, g/cm^3 or lb/in^3)
    diameter
        Outer diameter (length in m, mm, cm, µm, in or ft)
    length
        Length between driver and follower (length in m, mm, cm, µm, in or ft)
    shear_modulus
        Shear modulus of the material (modulus in Pa, MPa, GPa, N/mm^2 or ksi)
    bore
        Diameter of the bore, less than `diameter` (length in m, mm, cm, µm, in or ft)
        Default: 0.0.

    Examples
    --------
    >>> shaft_geometry = kinds.ShaftGeometry(
    ...     diameter="30 mm",
    ...     length="500 mm",
    ...     density=7850,
    ...     shear_modulus="80 GPa",
    ... )
    >>> shaft_geometry.diameter
    '30 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        density: Quantity,
        diameter: Quantity,
        length: Quantity,
        shear_modulus: Quantity,
        bore: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("density", density),
            ("diameter", diameter),
            ("length", length),
            ("shear_modulus", shear_modulus),
            ("bore", bore),
        )


class Sine(Tree):
    """U = amplitude·sin(harmonic·φ + phase) + offset.

    Parameters
    ----------
    amplitude
        Half the stroke (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or
        ft)
    harmonic
        Oscillations per turn of the driver (a pure number; or angle per length in rad/m,
        rad/mm or deg/mm) Default: 1.0.
    offset
        Middle of the stroke (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in
        or ft) Default: 0.0.
    phase
        Phase at φ = 0 (angle in rad, deg, mrad or rev) Default: 0.0.

    Examples
    --------
    >>> sine = kinds.Sine(amplitude=0.05)
    >>> sine.amplitude
    0.05
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        amplitude: Quantity,
        harmonic: Quantity | None = None,
        offset: Quantity | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("amplitude", amplitude),
            ("harmonic", harmonic),
            ("offset", offset),
            ("phase", phase),
        )


class Slider(Tree):
    """A slide in a straight guide.

    Parameters
    ----------
    input
        Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.
    damping
        Damping b seen at the last mass (damping in N s/m, kN s/m or lbf s/in)
    damping_capacity
        Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default
        0. (a pure number)
    dampings
        Damping of each link
    description
        Remarks for people.
    flexibility
        `static`, in place of `masses`: the uniform object has its static deflection,
        without vibrations, and with it a contact element in series. Its speed follows. Its
        acceleration is that of its driven end. Needs a pair that stays closed and a motion
        that is known beforehand.
    from_
        Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here
        replace its own.
    geometry
        Dimensions and material, in place of inertia and stiffness
    inertia
        Total inertia J (mass in kg, g, t or lb)
    inertias
        Inertia of each mass
    lever_arm
        Arm on which an angle given by the position function becomes a length (length in m,
        mm, cm, µm, in or ft)
    lever_ratio
        Factor on the position function. (a pure number)
    loads
        Loads by name. Positive forces act in the direction of positive displacement.
        Default: {}.
    lumping
        Where the inertia of each cell of the object is put. `ends`: at the far end of the
        cell. `balanced`: at both ends, so that the first moment of compliance is kept. It
        needs a contact that cannot separate, or a contact element. Behind that the first
        cell is of the former kind. Default `ends`.
    mass
        Another name of `inertia`.
    masses
        Number of masses; 0: rigid; "auto": as many masses or modes as the accuracy of the
        run needs. Default: 1, or the length of the lists.
    modes
        Number of vibration modes that the uniform object is reduced to, in place of
        `masses`: the lowest, of the object held at its driven end. The residual flexibility
        of the others is kept. Needs a pair that stays closed, or a contact element, behind
        which they are the modes of the free object.
    pair
        The driving pair. Default: {}.
    position
        Position function U(φ): the prescribed position of this object.
    split
        How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.
    stiffness
        Stiffness c seen at the last mass (stiffness in N/m, N/mm, kN/mm or lbf/in)
    stiffnesses
        Stiffness of each link
    stops
        One-sided stops of the last mass against the ground, by name. Default: {}.

    Examples
    --------
    >>> slider = kinds.Slider("feed", position={"ratio": 1}, inertia=1, stiffness=10000, masses=1)
    >>> slider.input
    'feed'
    """

    __slots__ = ()

    def __init__(
        self,
        input: str | None = None,
        *,
        damping: Quantity | None = None,
        damping_capacity: Quantity | None = None,
        dampings: Sequence[Quantity] | None = None,
        description: str | None = None,
        flexibility: Literal['static'] | None = None,
        from_: str | None = None,
        geometry: Geometry | Mapping[str, Value] | None = None,
        inertia: Quantity | None = None,
        inertias: Sequence[Quantity] | None = None,
        lever_arm: Quantity | None = None,
        lever_ratio: Quantity | None = None,
        loads: Mapping[str, Load | Mapping[str, Value] | Own] | None = None,
        lumping: Literal['ends', 'balanced'] | None = None,
        mass: Quantity | None = None,
        masses: int | str | Literal['auto'] | None = None,
        modes: int | str | None = None,
        pair: Pair | Mapping[str, Value] | None = None,
        position: Position | Mapping[str, Value] | Own | None = None,
        split: Literal['cubes', 'equal'] | Sequence[Quantity] | None = None,
        stiffness: Quantity | None = None,
        stiffnesses: Sequence[Quantity] | None = None,
        stops: Mapping[str, Stop | Mapping[str, Value]] | None = None,
    ) -> None:
        super().__init__(
            ("kind", "slider"),
            ("input", input),
            ("damping", damping),
            ("damping_capacity", damping_capacity),
            ("dampings", dampings),
            ("description", description),
            ("flexibility", flexibility),
            ("from", from_),
            ("geometry", geometry),
            ("inertia", inertia),
            ("inertias", inertias),
            ("lever_arm", lever_arm),
            ("lever_ratio", lever_ratio),
            ("loads", loads),
            ("lumping", lumping),
            ("mass", mass),
            ("masses", masses),
            ("modes", modes),
            ("pair", pair),
            ("position", position),
            ("split", split),
            ("stiffness", stiffness),
            ("stiffnesses", stiffnesses),
            ("stops", stops),
        )


class SliderCrank(Tree):
    """Slider-crank: distance of the slide from the crank's axis.

    Parameters
    ----------
    crank
        Crank radius r (length in m, mm, cm, µm, in or ft)
    rod
        Connecting rod length l (length in m, mm, cm, µm, in or ft)
    branch
        Side of the crank's axis on which the slide runs. Default: "+".
    offset
        Offset e of the guide from the crank's axis (length in m, mm, cm, µm, in or ft)
        Default: 0.0.
    phase
        Added to the driver's angle (angle in rad, deg, mrad or rev) Default: 0.0.

    Examples
    --------
    >>> slider_crank = kinds.SliderCrank(crank="100 mm", rod="80 mm")
    >>> slider_crank.crank
    '100 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        crank: Quantity,
        rod: Quantity,
        branch: Literal['+', '-'] | None = None,
        offset: Quantity | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("crank", crank),
            ("rod", rod),
            ("branch", branch),
            ("offset", offset),
            ("phase", phase),
        )


class Sliding(Tree):
    """A block that slides along a guide.

    Parameters
    ----------
    block
        The block's point on the axis, on the link that slides.
    guide
        A point of the guide's axis, on the link that guides.
    angle
        Angle of the block's frame less the direction of the guide (angle in rad, deg, mrad
        or rev) Default: 0.0.
    corners
        Places of the block's two corners along the guide from its point, the forward one
        first, for reactions and friction; default 10 mm ahead and behind
    direction
        Direction of the guide in the frame of its link; default 0 (angle in rad, deg, mrad
        or rev)
    half_height
        Half the height of the block (length in m, mm, cm, µm, in or ft) Default: 0.0.
    through
        In place of `direction`: another point of the guide's axis, towards which it is
        directed.

    Examples
    --------
    >>> sliding = kinds.Sliding(guide="ground.G", block="ram.origin")
    >>> sliding.guide
    'ground.G'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        block: str,
        guide: str,
        angle: Quantity | None = None,
        corners: Sequence[Quantity] | None = None,
        direction: Quantity | None = None,
        half_height: Quantity | None = None,
        through: str | None = None,
    ) -> None:
        super().__init__(
            ("block", block),
            ("guide", guide),
            ("angle", angle),
            ("corners", corners),
            ("direction", direction),
            ("half_height", half_height),
            ("through", through),
        )


class SlottedLink(Tree):
    """Slotted link: crank and slotted link on fixed pivots, a block on the crank's end in the slot; crank or block drives.

    Parameters
    ----------
    crank
        Length of the crank (length in m, mm, cm, µm, in or ft)
    frame
        Distance of the fixed pivots (length in m, mm, cm, µm, in or ft)
    branch
        When the block drives: the crank turns counterclockwise (`+`) or clockwise (`-`) as
        the block moves away from the pivot of the slotted link. Default: "+".
    driver
        What is driven: the crank by its angle, or the block by its distance from the pivot
        of the slotted link. Default: "crank".
    output
        U: the angle of the slotted link or of the crank, or the distance of the block;
        default by the object: what turns follows the link, what slides the block.
    phase
        Added to the driver's displacement (angle in rad, deg, mrad or rev; or length in m,
        mm, cm, µm, in or ft) Default: 0.0.

    Examples
    --------
    >>> slotted_link = kinds.SlottedLink(crank="80 mm", frame="200 mm")
    >>> slotted_link.crank
    '80 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        crank: Quantity,
        frame: Quantity,
        branch: Literal['+', '-'] | None = None,
        driver: Literal['crank', 'block'] | None = None,
        output: Literal['link', 'crank', 'block'] | None = None,
        phase: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("crank", crank),
            ("frame", frame),
            ("branch", branch),
            ("driver", driver),
            ("output", output),
            ("phase", phase),
        )


class Spring(Tree):
    """Spring: W = −preload − rate·φ.

    Parameters
    ----------
    rate
        Rate of the spring (rotational stiffness in N m/rad, N m, kN m/rad, N m/deg or lbf
        ft/rad; or stiffness in N/m, N/mm, kN/mm or lbf/in)
    preload
        Force at φ = 0, positive towards negative displacement (moment in N m, kN m, N mm,
        lbf ft or lbf in; or force in N, kN, MN, lbf or kgf) Default: 0.0.

    Examples
    --------
    >>> spring = kinds.Spring(rate=5000)
    >>> spring.rate
    5000
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        rate: Quantity,
        preload: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("rate", rate),
            ("preload", preload),
        )


class Start(Tree):
    """What `start` is made of.

    Parameters
    ----------
    displacement
        Displacement of each mass
    speed
        Speed of each mass

    Examples
    --------
    >>> start = kinds.Start(displacement=[0], speed=[0])
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        displacement: Sequence[Quantity],
        speed: Sequence[Quantity],
    ) -> None:
        super().__init__(
            ("displacement", displacement),
            ("speed", speed),
        )


class Stations(Tree):
    """What `stations` is made of.

    Parameters
    ----------
    at
        Displacement of the driver, or time (angle in rad, deg, mrad or rev; or length in m,
        mm, cm, µm, in or ft; or time in s, ms, µs, min or h)
    displacement
        Displacement there (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in
        or ft)
    acceleration
        Second derivative there, taken by smooth motions that meet here (coefficient in SI
        units; or angular acceleration in rad/s^2 or deg/s^2; or acceleration in m/s^2,
        mm/s^2, in/s^2 or ft/s^2)
    match
        Order of derivatives up to which smooth motions match their neighbour here. Default:
        2.
    motion
        Motion from here to the next station: `dwell`, `uniform`, `smooth` (the polynomial
        that matches its neighbours), or a law from rest to rest. Default: "dwell".
    speed
        First derivative there, taken by smooth motions that meet here (a pure number; or
        length per angle in m/rad, mm/rad, mm/rev or mm; or angle per length in rad/m,
        rad/mm or deg/mm; or angular speed in rad/s, rev/s, rpm, 1/min or deg/s; or speed in
        m/s, mm/s, m/min, in/s or ft/s)

    Examples
    --------
    >>> stations = kinds.Stations(at=0, displacement=0, motion="3-4-5")
    >>> stations.at
    0
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        at: Quantity,
        displacement: Quantity,
        acceleration: Quantity | None = None,
        match: int | str | None = None,
        motion: Literal['dwell', 'uniform', 'smooth', 'parabolic', 'harmonic', 'cycloidal', 'modified_trapezoid', 'modified_sine', 'modified_constant_velocity', '3-4-5', '4-5-6-7'] | PlannedMotion | Mapping[str, Value] | None = None,
        speed: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("at", at),
            ("displacement", displacement),
            ("acceleration", acceleration),
            ("match", match),
            ("motion", motion),
            ("speed", speed),
        )


class Steady(Tree):
    """The wanted steady motion of the drive (`dam steady`).

    Parameters
    ----------
    balance
        True: a constant moment on the drive makes the work of a cycle zero. Default: false.
    cycle
        Angle of the drive after which the machine repeats, or a part of it: ratios may ask
        for more turns (angle in rad, deg, mrad or rev) Default: 6.283185307179586.
    drive
        The drive whose motion is wanted; not needed if there is one drive.
    fluctuation
        Required coefficient of fluctuation (ω_max − ω_min)/ω_av: sizes a flywheel (a pure
        number)
    mean
        Kind of mean: over `time`, over the `angle`, or `midrange`, midway between the
        extremes. Default: "time".
    mean_speed
        Required mean speed of the drive. Default: the speed of a prescribed drive; with
        moments that depend on speed only of elastic objects, with `balance` (angular speed
        in rad/s, rev/s, rpm, 1/min or deg/s)
    periods
        Elastic scenes: turns of the drive after which the motion may repeat, at most.
        Default: 1.
    tolerance
        How far the mean speed may be off, relative (a pure number) Default: 1e-12.

    Examples
    --------
    >>> steady = kinds.Steady(mean_speed="200 rad/s", balance=True)
    >>> steady.mean_speed
    '200 rad/s'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        balance: bool | None = None,
        cycle: Quantity | None = None,
        drive: str | None = None,
        fluctuation: Quantity | None = None,
        mean: Literal['time', 'angle', 'midrange'] | None = None,
        mean_speed: Quantity | None = None,
        periods: int | str | None = None,
        tolerance: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("balance", balance),
            ("cycle", cycle),
            ("drive", drive),
            ("fluctuation", fluctuation),
            ("mean", mean),
            ("mean_speed", mean_speed),
            ("periods", periods),
            ("tolerance", tolerance),
        )


class Stop(Tree):
    """What `stop` is made of.

    Parameters
    ----------
    at
        Displacement at which it is touched (angle in rad, deg, mrad or rev; or length in m,
        mm, cm, µm, in or ft)
    contact
        Its contact.
    side
        `-`: it holds the mass from going below `at`; `+`: from going above.

    Examples
    --------
    >>> stop = kinds.Stop(
    ...     at="0 mm",
    ...     side="-",
    ...     contact={
    ...         "law": "kelvin_voigt",
    ...         "stiffness": "20 kN/mm",
    ...         "damping": "1500 N s/m",
    ...     },
    ... )
    >>> stop.at
    '0 mm'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        at: Quantity,
        contact: StopContact | Mapping[str, Value],
        side: Literal['+', '-'],
    ) -> None:
        super().__init__(
            ("at", at),
            ("contact", contact),
            ("side", side),
        )


class StopContact(Tree):
    """Its contact.

    Parameters
    ----------
    damping
        Damping of `kelvin_voigt` (rotational damping in N m s/rad or N m s; or damping in N
        s/m, kN s/m or lbf s/in)
    dissipation
        χ of `hunt_crossley` and `hertz`, seconds per unit of indentation (time per angle in
        s/rad or s; or time per length in s/m or s/mm)
    from_
        Geometry from which the stiffness follows, in its place.
    law
        N over the indentation p and its rate: `elastic` k·p; `kelvin_voigt` k·p +
        damping·ṗ; `hunt_crossley` k·p·(1 + dissipation·ṗ); `hertz` K·p^(3/2)·(1 +
        dissipation·ṗ); `restitution` rigid, with impacts, which is the default where that
        is given. Default: "elastic".
    restitution
        Coefficient of restitution e of a rigid contact: the speed after an impact over that
        before it (a pure number)
    stiffness
        Stiffness k of the contact; of `hertz` K, a bare number in N/m^(3/2) or N
        m/rad^(3/2) where the exponent is 3/2; none of `restitution` (rotational stiffness
        in N m/rad, N m, kN m/rad, N m/deg or lbf ft/rad; or stiffness in N/m, N/mm, kN/mm
        or lbf/in)

    Examples
    --------
    >>> stop_contact = kinds.StopContact(
    ...     law="kelvin_voigt",
    ...     stiffness="20 kN/mm",
    ...     damping="1500 N s/m",
    ... )
    >>> stop_contact.law
    'kelvin_voigt'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        damping: Quantity | None = None,
        dissipation: Quantity | None = None,
        from_: From | Mapping[str, Value] | None = None,
        law: Literal['elastic', 'kelvin_voigt', 'hunt_crossley', 'hertz', 'restitution'] | None = None,
        restitution: Quantity | None = None,
        stiffness: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("damping", damping),
            ("dissipation", dissipation),
            ("from", from_),
            ("law", law),
            ("restitution", restitution),
            ("stiffness", stiffness),
        )


class Strut(Tree):
    """A spring, a damper and a constant force between two points; tension pulls them together.

    Parameters
    ----------
    from_
        One end.
    to
        The other end.
    damping
        Damping (damping in N s/m, kN s/m or lbf s/in) Default: 0.0.
    force
        Constant force besides, as of a gas spring or a cylinder: positive pulls the ends
        together, negative pushes them from each other (force in N, kN, MN, lbf or kgf)
        Default: 0.0.
    free_length
        Length at which the spring has no force (length in m, mm, cm, µm, in or ft) Default:
        0.0.
    rate
        Rate of the spring (stiffness in N/m, N/mm, kN/mm or lbf/in) Default: 0.0.

    Examples
    --------
    >>> strut = kinds.Strut(from_="ground.C", to="k3.D", rate=4530, free_length=0.07785)
    >>> strut.from_
    'ground.C'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        from_: str,
        to: str,
        damping: Quantity | None = None,
        force: Quantity | None = None,
        free_length: Quantity | None = None,
        rate: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("from", from_),
            ("to", to),
            ("damping", damping),
            ("force", force),
            ("free_length", free_length),
            ("rate", rate),
        )


class Table(Tree):
    """Smooth spline through given points.

    Parameters
    ----------
    points
        List of [driver's displacement, displacement], at least three, the first values
        ascending.
    end_slopes
        Slopes U′ at both ends of a table that is not periodic Default: [0.0, 0.0].
    period
        Repeats after this much of the driver's displacement; the curve goes on to the first
        point by itself (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or
        ft)
    periodic
        True: the table repeats. Without `period` the last point closes the period; it has
        the displacement of the first. Default true with `period`. Default: false.

    Examples
    --------
    >>> table = kinds.Table(
    ...     points={"file": "measured_lift.csv", "columns": ["angle", "lift"]},
    ...     periodic=True,
    ... )
    >>> table.periodic
    True
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        points: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value],
        end_slopes: Sequence[Quantity] | None = None,
        period: Quantity | None = None,
        periodic: bool | None = None,
    ) -> None:
        super().__init__(
            ("points", points),
            ("end_slopes", end_slopes),
            ("period", period),
            ("periodic", periodic),
        )


class TableFile(Tree):
    """What `table_file` is made of.

    Parameters
    ----------
    file
        CSV file in the folder of the scene. Its first line names the columns with their
        units: angle [deg], lift [mm].
    columns
        Names of the two columns that are meant; needed where there are more.

    Examples
    --------
    >>> table_file = kinds.TableFile(file="measured_lift.csv", columns=["angle", "lift"])
    >>> table_file.file
    'measured_lift.csv'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        file: str,
        columns: Sequence[str] | None = None,
    ) -> None:
        super().__init__(
            ("file", file),
            ("columns", columns),
        )


class Teeth(Tree):
    """Tooth numbers of sun and ring gear.

    Parameters
    ----------
    ring
        Teeth of the ring gear.
    sun
        Teeth of the sun gear.

    Examples
    --------
    >>> teeth = kinds.Teeth(sun=24, ring=72)
    >>> teeth.sun
    24
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        ring: int | str,
        sun: int | str,
    ) -> None:
        super().__init__(
            ("ring", ring),
            ("sun", sun),
        )


class Tolerance(Tree):
    """Tolerances of numbers, and limits of results (`dam tolerance`).

    Parameters
    ----------
    tol
        Numbers of the scene with their tolerances: "rocker.pair.gap=±0.02 mm".
    figures
        Results that are looked at; those of the limits if none. Default: [].
    limit
        Limits that samples are to meet: "rocker.delta_max <= 0.2 mrad". Default: [].
    samples
        Number of samples (4096); 0 for the stack alone.
    seed
        Seed of the samples (1).

    Examples
    --------
    >>> tolerance = kinds.Tolerance(
    ...     tol=["rocker.inertia=±1 %", "rocker.pair.gap=±0.02 mm uniform"],
    ...     limit=["rocker.delta_max <= 0.2 mrad"],
    ... )
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        tol: Sequence[str],
        figures: Sequence[str] | None = None,
        limit: Sequence[str] | None = None,
        samples: int | str | None = None,
        seed: int | str | None = None,
    ) -> None:
        super().__init__(
            ("tol", tol),
            ("figures", figures),
            ("limit", limit),
            ("samples", samples),
            ("seed", seed),
        )


class Torque(Tree):
    """Driving torque over speed.

    Parameters
    ----------
    constant
        Constant torque (moment in N m, kN m, N mm, lbf ft or lbf in)
    expression
        Expression over t, phi and phi_dot of the drive, in s, rad or m: "30*(1 -
        phi_dot/150)".
    kloss
        Asynchronous motor: 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.
    linear
        T₀·(1 − ω/ω₀).
    over
        Another object or output: `press`, `press.ram`. `expression` knows its motion as
        over_phi and over_phi_dot.
    table
        List of [speed, torque]: linear between the points, constant outside.
    unit
        Unit of the value of `expression`; default SI (moment in N m, kN m, N mm, lbf ft or
        lbf in)

    Examples
    --------
    >>> torque = kinds.Torque(constant=0)
    >>> torque.constant
    0
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        constant: Quantity | None = None,
        expression: str | None = None,
        kloss: Kloss | Mapping[str, Value] | None = None,
        linear: TorqueLinear | Mapping[str, Value] | None = None,
        over: str | None = None,
        table: Sequence[Sequence[Quantity]] | TableFile | Mapping[str, Value] | None = None,
        unit: str | None = None,
    ) -> None:
        super().__init__(
            ("constant", constant),
            ("expression", expression),
            ("kloss", kloss),
            ("linear", linear),
            ("over", over),
            ("table", table),
            ("unit", unit),
        )


class TorqueLinear(Tree):
    """T₀·(1 − ω/ω₀).

    Parameters
    ----------
    no_load_speed
        Speed without load, ω₀ (angular speed in rad/s, rev/s, rpm, 1/min or deg/s)
    stall_torque
        Torque at rest, T₀ (moment in N m, kN m, N mm, lbf ft or lbf in)

    Examples
    --------
    >>> torque_linear = kinds.TorqueLinear(stall_torque=6, no_load_speed=9)
    >>> torque_linear.stall_torque
    6
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        no_load_speed: Quantity,
        stall_torque: Quantity,
    ) -> None:
        super().__init__(
            ("no_load_speed", no_load_speed),
            ("stall_torque", stall_torque),
        )


class Torsion(Tree):
    """A spring and a damper in a revolute pair.

    Parameters
    ----------
    pair
        The revolute pair.
    damping
        Damping (rotational damping in N m s/rad or N m s) Default: 0.0.
    free_angle
        The pair's angle at which the spring has no moment (angle in rad, deg, mrad or rev)
        Default: 0.0.
    rate
        Rate of the spring (rotational stiffness in N m/rad, N m, kN m/rad, N m/deg or lbf
        ft/rad) Default: 0.0.

    Examples
    --------
    >>> torsion = kinds.Torsion(pair="O", rate="20 N m/rad", free_angle="30 deg")
    >>> torsion.pair
    'O'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        pair: str,
        damping: Quantity | None = None,
        free_angle: Quantity | None = None,
        rate: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("pair", pair),
            ("damping", damping),
            ("free_angle", free_angle),
            ("rate", rate),
        )


class Trapezoid(Tree):
    """Modified trapezoid of general form: shares of rise and fall of the acceleration, together at most 1.

    Parameters
    ----------
    s1
        Share of the rise, a quarter sine. (a pure number)
    s2
        Share of the fall, a quarter cosine. (a pure number)

    Examples
    --------
    >>> trapezoid = kinds.Trapezoid(s1=0.25, s2=0.25)
    >>> trapezoid.s1
    0.25
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        s1: Quantity,
        s2: Quantity,
    ) -> None:
        super().__init__(
            ("s1", s1),
            ("s2", s2),
        )


class Until(Tree):
    """Condition that ends the run before `duration`, at the first time at which it holds: { "of": "rocker", "condition": "phi > 0.3" }. The motion is found up to `duration` first.

    Parameters
    ----------
    condition
        Comparisons over t, phi, phi_dot, acceleration, delta, reaction, contact_force and
        clearance of the object, in SI units: "phi > 0.3 && t > 1".
    of
        Object, output or stop whose motion the condition is about: `rocker`, `press.ram`.

    Examples
    --------
    >>> until = kinds.Until(of="gear", condition="phi > pi")
    >>> until.of
    'gear'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        condition: str,
        of: str,
    ) -> None:
        super().__init__(
            ("condition", condition),
            ("of", of),
        )


class Weight(Tree):
    """Weight: W = −m·g·sin(inclination).

    Parameters
    ----------
    inclination
        Angle of the positive direction above the horizontal (angle in rad, deg, mrad or
        rev)

    Examples
    --------
    >>> weight = kinds.Weight(inclination="90 deg")
    >>> weight.inclination
    '90 deg'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        inclination: Quantity,
    ) -> None:
        super().__init__(
            ("inclination", inclination),
        )


class Weld(Tree):
    """Two links rigidly joined, one body: no pair that moves, and no coordinate. `dam forces` prints its force and couple.

    Parameters
    ----------
    link
        The same point on the second link, on which force and couple act.
    on
        The weld's point on the first link, to which its force and couple refer.
    angle
        Angle of the second link's frame less that of the first (angle in rad, deg, mrad or
        rev) Default: 0.0.

    Examples
    --------
    >>> weld = kinds.Weld(on="rod.W", link="tip.origin", angle="-90 deg")
    >>> weld.on
    'rod.W'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        link: str,
        on: str,
        angle: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("link", link),
            ("on", on),
            ("angle", angle),
        )


class Window(Tree):
    """Constant force while the driver, or the object `over`, is between two positions.

    Parameters
    ----------
    force
        Force inside the window (moment in N m, kN m, N mm, lbf ft or lbf in; or force in N,
        kN, MN, lbf or kgf)
    from_
        Start of the window (angle in rad, deg, mrad or rev; or length in m, mm, cm, µm, in
        or ft)
    to
        End of the window, beyond its start (angle in rad, deg, mrad or rev; or length in m,
        mm, cm, µm, in or ft)
    once
        True: the window comes once and does not repeat. Default: false.
    period
        Repeats after this much of that displacement; default one turn of what turns (angle
        in rad, deg, mrad or rev; or length in m, mm, cm, µm, in or ft)

    Examples
    --------
    >>> window = kinds.Window(from_="285 deg", to="330 deg", force="-9 N")
    >>> window.from_
    '285 deg'
    """

    __slots__ = ()

    def __init__(
        self,
        *,
        force: Quantity,
        from_: Quantity,
        to: Quantity,
        once: bool | None = None,
        period: Quantity | None = None,
    ) -> None:
        super().__init__(
            ("force", force),
            ("from", from_),
            ("to", to),
            ("once", once),
            ("period", period),
        )


AnyKind = Union[CamFollower, Crank, Differential, Drive, Linkage, Rocker, Shaft, Slider]
"""An object of any kind."""
