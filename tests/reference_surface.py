"""The cut surface of the slow reference: the piece that each pixel shows, and its depth.

The package must agree except if two pieces have equal costs or a pixel lies on the border of a piece, both
within rounding: `Surface.unsure_depth` and `Surface.unsure_vessel` mark these pixels.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reference import candidates, distance_to, distinct, levels_of, pieces_of, pixel_centers, view_from_world

#: Costs closer than this may be equal in 32-bit floats (mm of depth); the same holds for arc lengths (mm).
TIE = 1e-3
#: Pixels closer than this to the border of a piece or of the lumen may fall on either side (mm).
BORDER = 1e-4
LIFT = 1e7


@dataclass
class Surface:
    """Images of shape (H, W), before the depth filter."""

    depth: np.ndarray
    vessel: np.ndarray
    distance: np.ndarray
    slack: np.ndarray  # what rounding may add to the error of the depth (mm)
    unsure_depth: np.ndarray
    unsure_vessel: np.ndarray
    radius: np.ndarray  # of the winner at level 0 (mm)
    beyond: (
        np.ndarray
    )  # how far beyond the lumen of the winner at level 0 the pixel lies (mm), negative within
    along: np.ndarray  # arc length of the winner at level 0 (mm)
    slope: np.ndarray  # change of depth to the right and upwards, (H, W, 2)
    gap: np.ndarray  # arc length between the two places that are blended (mm)
    cost: np.ndarray  # mm, blended
    level: np.ndarray
    kind: np.ndarray  # of the level with the larger weight


@dataclass
class Winners:
    """The winners of one level at some pixels, and the range of values that rounding allows."""

    z: np.ndarray
    slack: np.ndarray
    vessel: np.ndarray
    r: np.ndarray
    d: np.ndarray
    s: np.ndarray
    s_error: np.ndarray
    slope: np.ndarray
    z_range: np.ndarray
    other_vessel: np.ndarray
    other_place: np.ndarray
    cost: np.ndarray
    kind: np.ndarray


def cost_of(found, settings):
    """Return the cost of Equation 2 (mm)."""
    return found.z + settings.cost_weight * np.maximum(found.d - found.r, 0)


def as_counted(found, settings):
    """Return the candidates with the distance that the cost counts."""
    if settings.distance_rule == "local":
        return found
    beside = (found.kind == 0) & (found.inside < 0)
    whole = np.where(beside, np.inf, found.d).min(axis=1, keepdims=True)
    return replace(found, d=np.broadcast_to(whole, found.d.shape))


def key(found, settings, slack=0.0):
    """Return the order of pieces: with `lumen_first` lumen, wall, surroundings; otherwise only the cost."""
    beyond, cost = found.d - found.r, cost_of(found, settings)
    if not settings.lumen_first:
        return cost
    wall = np.where(beyond <= settings.lumen_margin + slack, found.z - LIFT, cost)
    return np.where(beyond <= slack, found.z - 2 * LIFT, wall)


def winners(vessels, q, settings):
    """The piece with the smallest key at each pixel; on a tie the smaller vessel id."""
    count, pixel = len(q), np.arange(len(q))
    best, sure, kept = np.full(count, np.inf), np.full(count, np.inf), {"vessel": np.zeros(count, int)}
    names = ("z", "r", "s", "d", "z_error", "s_error", "slope", "kind")
    for vessel, pieces in enumerate(vessels):
        found = candidates(pieces, q)
        counted = as_counted(found, settings)
        cost = np.where(found.inside >= 0, key(counted, settings), np.inf)
        mine = pixel, cost.argmin(axis=1)
        wins = cost[mine] < best
        best = np.where(wins, cost[mine], best)
        kept["vessel"][wins] = vessel
        kept.setdefault("cost", np.zeros(count))[wins] = cost_of(counted, settings)[mine][wins]
        for name in names:
            value = getattr(found, name)[mine]
            kept.setdefault(name, np.zeros(value.shape))[wins] = value[wins]
        certain = np.where(found.inside >= BORDER, key(counted, settings, -BORDER), np.inf)
        sure = np.minimum(sure, certain.min(axis=1))
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    others, elsewhere = np.zeros(count, bool), np.zeros(count, bool)
    for vessel, pieces in enumerate(vessels):
        found = candidates(pieces, q)
        keys = key(as_counted(found, settings), settings, BORDER)
        rival = (found.inside >= -BORDER) & (keys <= sure[:, None] + TIE)
        low = np.minimum(low, np.where(rival, found.z, np.inf).min(axis=1))
        high = np.maximum(high, np.where(rival, found.z, -np.inf).max(axis=1))
        others |= rival.any(axis=1) & (kept["vessel"] != vessel)
        near = np.abs(found.s - kept["s"][:, None]) <= 10 * TIE + found.s_error + kept["s_error"][:, None]
        elsewhere |= (rival & ~near).any(axis=1)
    return Winners(
        kept["z"], kept["z_error"], kept["vessel"], kept["r"], kept["d"], kept["s"], kept["s_error"],
        kept["slope"], high - low, others, elsewhere,
        kept["cost"], kept["kind"],
    )  # fmt: skip


def own(vessels, q, settings, decided):
    """Return at each pixel the piece of the winning vessel whose arc length is nearest to the winner's."""
    shape = len(q)
    z, slack, s, z_range, costs, kind = (np.zeros(shape) for _ in range(6))
    slope = np.zeros((shape, 2))
    for vessel in np.unique(decided.vessel):
        here = np.flatnonzero(decided.vessel == vessel)
        found = candidates(vessels[vessel], q[here])
        apart = np.abs(found.s - decided.s[here, None])
        covered = np.where(found.inside >= 0, apart, np.inf)
        cost = cost_of(as_counted(found, settings), settings)
        nearest = covered <= covered.min(axis=1, keepdims=True)
        mine = np.arange(len(here)), np.where(nearest, cost, np.inf).argmin(axis=1)
        z[here], slack[here], s[here], slope[here] = (
            found.z[mine], found.z_error[mine], found.s[mine], found.slope[mine],
        )  # fmt: skip
        costs[here], kind[here] = cost[mine], found.kind[mine]
        error = TIE / 10 + found.s_error + decided.s_error[here, None]
        certain = np.where(found.inside >= BORDER, apart + error, np.inf).min(axis=1, keepdims=True)
        rival = (found.inside >= -BORDER) & (apart - error <= certain)
        low, high = np.where(rival, found.z, np.inf), np.where(rival, found.z, -np.inf)
        z_range[here] = high.max(axis=1) - low.min(axis=1)
    nothing = np.zeros(shape, bool)
    return Winners(
        z, slack, decided.vessel, decided.r, decided.d, s, decided.s_error, slope, z_range, nothing, nothing,
        costs, kind,
    )  # fmt: skip


def pieces_at(level, camera, settings):
    """Return the pieces of all vessels of a level; radii that do not count or are unknown are replaced."""
    made = []
    for points, known, arc in level:
        radius = known * settings.preserve_lumen
        if settings.lumen_first:
            radius = np.where(radius > 0, radius, settings.unknown_radius)
        new = distinct(points)
        made.append(pieces_of(view_from_world(points[new], camera), radius[new], arc[new]))
    return made


def cut_surface(tree, camera, settings, depth_tolerance=1e-3):
    """Return the cut surface, and where rounding may change it by more than `depth_tolerance` (mm)."""
    q, n = pixel_centers(camera), settings.levels
    levels = levels_of(tree, n)
    distance = distance_to([view_from_world(points, camera) for points, *_ in levels[0]], q)
    decided = winners(pieces_at(levels[0], camera, settings), q, settings)
    is_own = settings.level_choice == "own"
    # The levels are selected by the distance to any centerline, or by the distance to the wall of the winner.
    beyond = decided.d - decided.r - settings.lumen_margin if is_own else distance
    f = np.sqrt(n * np.maximum(beyond, 0) / settings.level_distance)
    fine = np.minimum(n, np.floor(f)).astype(int)
    coarse = np.minimum(n, fine + 1)
    made = {name: [] for name in vars(decided)}
    for k in range(n + 1):
        found = {name: value.copy() for name, value in vars(decided).items()}
        used = np.flatnonzero((fine == k) | (coarse == k))
        if k > 0 and len(used) > 0:
            pieces = pieces_at(levels[k], camera, settings)
            there = Winners(*(value[used] for value in vars(decided).values()))
            won = own(pieces, q[used], settings, there) if is_own else winners(pieces, q[used], settings)
            for name, value in vars(won).items():
                found[name][used] = value
        for name, value in found.items():
            made[name].append(value)
    pixel = np.arange(len(q))
    first, second = (
        {name: np.stack(values)[k, pixel] for name, values in made.items()} for k in (fine, coarse)
    )
    weight = np.where(fine == n, 0.0, f - fine)
    # Near distance 0 the square root amplifies rounding.
    low, high = np.sqrt(np.maximum(beyond, 0)), np.sqrt(np.maximum(beyond + 2e-5, 0))
    blur = np.sqrt(n / settings.level_distance) * (high - low)

    def mixed(name):
        share = weight[:, None] if made[name][0].ndim == 2 else weight
        return (1 - share) * first[name] + share * second[name]

    vague = mixed("z_range") + blur * np.abs(second["z"] - first["z"])
    unsure, same = vague > depth_tolerance, first["vessel"] == second["vessel"]
    if is_own:
        vessel, other = decided.vessel, decided.other_vessel
        # If another winner is possible, everything at coarser levels may differ too.
        unsure |= (f > 0) & (decided.other_vessel | decided.other_place)
    else:
        vessel = np.where(weight > 0.5, second["vessel"], first["vessel"])
        balanced = (np.abs(weight - 0.5) < blur + 1e-5) & ~same
        other = np.where(weight > 0.5, second["other_vessel"], first["other_vessel"]) | balanced
    gap = np.where(same, np.abs(second["s"] - first["s"]) * (weight > 0), np.inf)
    flat = (
        *(mixed("z"), vessel, distance, mixed("slack"), unsure, other),
        *(decided.r, decided.d - decided.r, decided.s, mixed("slope"), gap),
        *(mixed("cost"), fine + weight, np.where(weight > 0.5, second["kind"], first["kind"])),
    )
    size = camera.size[::-1]
    return Surface(*(image.reshape(*size, *image.shape[1:]) for image in flat))
