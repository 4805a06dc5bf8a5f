"""The contact laws, with the numbers that LIGGGHTS takes them to mean.

hertz. YADE's Mindlin law with its moment law, which is LIGGGHTS's epsd2: an elastic moment, at most mu_r R* F_n. YADE has one
rolling coefficient a functor, not a pair of materials; so grains are of another class of material than surfaces, with a functor
of their own. R* is r1 r2 / (r1 + r2) there and the mean radius times a number here: for two grains within 1 % at a spread of 10 %.

kelvin_voigt. The stiffness of a contact is that of two springs in series, k1 k2 / (k1 + k2), and so is its damping: the
materials' own values are chosen such that contacts get the values asked for.
"""
import math

from yade.wrapper import (FrictMat, Ig2_Facet_Sphere_ScGeom, Ig2_Sphere_Sphere_ScGeom, InteractionLoop,
                          Ip2_FrictMat_FrictMat_MindlinPhys, Ip2_PartialSatMat_PartialSatMat_MindlinPhys,
                          Ip2_ViscElMat_ViscElMat_ViscElPhys, Law2_ScGeom_MindlinPhys_Mindlin, Law2_ScGeom_ViscElPhys_Basic,
                          MatchMaker, PartialSatMat, ViscElMat)

RADIUS_OF_FACET = 1e8  # times the sphere's, by Ig2_Facet_Sphere_ScGeom(hertzian=True): then R* is the sphere's radius


def materials(setup):
    """That of the grains, then one for each surface."""
    if setup.contact == "hertz":
        common = {"young": setup.youngs_modulus, "poisson": setup.poisson_ratio, "density": setup.density}
        return [PartialSatMat(**common)] + [FrictMat(**common) for _ in setup.surfaces]
    c, along = setup.linear, 1.0 if setup.tangential_damping else 0.0

    def material(damping, shear_damping):
        return ViscElMat(kn=2 * c.stiffness, ks=2 * c.shear_stiffness, cn=damping, cs=along * shear_damping, density=setup.density)

    return [material(2 * c.damping, 2 * c.shear_damping)] + [
        material(in_series(c.surface_damping, 2 * c.damping), in_series(c.surface_shear_damping, 2 * c.shear_damping))
        for _ in setup.surfaces]


def in_series(together, one):
    """What in series with `one` makes `together`."""
    return together * one / (one - together) if together > 0 else 0.0


def interaction_loop(setup, ids):
    """The engine of the contacts; ids: of the materials, in their order."""
    friction = MatchMaker(matches=[(ids[0], ids[0], math.atan(setup.friction))] +
                          [(ids[0], id, math.atan(s.friction)) for id, s in zip(ids[1:], setup.surfaces)])
    geometry = [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(hertzian=setup.contact == "hertz")]
    if setup.contact == "kelvin_voigt":
        return InteractionLoop(geometry, [Ip2_ViscElMat_ViscElMat_ViscElPhys(frictAngle=friction)], [Law2_ScGeom_ViscElPhys_Basic()])
    common = {"en": setup.restitution, "es": setup.restitution if setup.tangential_damping else 1.0, "frictAngle": friction}
    # Two radii of a pair of equal grains have the mean r and R* = r / 2.
    grains = Ip2_PartialSatMat_PartialSatMat_MindlinPhys(
        eta=setup.rolling_friction / 2, krot=rolling_stiffness(setup, setup.rolling_friction, 0.5 * setup.max_radius), **common)
    rolling = surface_rolling_friction(setup)
    surfaces = Ip2_FrictMat_FrictMat_MindlinPhys(
        eta=2 * rolling / RADIUS_OF_FACET, krot=rolling_stiffness(setup, rolling, setup.max_radius), **common)
    return InteractionLoop(geometry, [grains, surfaces], [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=True)])


def rolling_stiffness(setup, friction, radius):
    """k_t R*^2 [N m], k_t of an overlap of a thousandth of the diameter: LIGGGHTS follows the overlap, YADE has a constant."""
    if friction == 0:
        return 0.0  # YADE takes a limit of 0 for no limit
    nu = setup.poisson_ratio
    shear = setup.youngs_modulus / (4 * (2 - nu) * (1 + nu))
    return 8 * shear * math.sqrt(radius * 2e-3 * setup.max_radius) * radius ** 2


def surface_rolling_friction(setup):
    values = {s.rolling_friction for s in setup.surfaces}
    if len(values) > 1:
        first, other = setup.surfaces[0], next(s for s in setup.surfaces if s.rolling_friction != setup.surfaces[0].rolling_friction)
        raise ValueError(f"YADE takes one rolling friction for all surfaces: '{first.name}' has {first.rolling_friction:g} and "
                         f"'{other.name}' {other.rolling_friction:g}; give them the same, or use LIGGGHTS")
    return values.pop() if values else 0.0
