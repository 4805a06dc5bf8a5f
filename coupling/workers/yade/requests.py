"""What a request must be. The sentences are those of the other engine's worker."""
import numpy as np

LARGEST = 2147483647


class Refused(Exception):
    pass


class RanAway(Exception):
    """The engine works, its grains do not."""
    runaway = True


def check(request, setup, book):
    if request.steps < 0 or request.steps > LARGEST or (request.steps == 0 and (request.insert or len(request.remove))):
        raise Refused(f"an advance over {request.steps} steps is not possible")
    if request.sample_steps < 0:
        raise Refused(f"a mean over {request.sample_steps} steps is not possible")
    faces = setup.faces
    if request.rim_moves:
        check_rim_moves(request, book)
        faces = request.rim_moves[0].faces
    for g in request.insert:
        check_grain(g, setup, faces)
    check_ids(request, book)
    check_drives(request.drives, faces, bool(request.rim_moves))


def has_segment(faces, face, segment):
    return 0 <= face < len(faces) and 0 <= segment < faces[face].segments


def check_rim_moves(request, book):
    if len(request.rim_moves) > 1:
        raise Refused("the rim is to move twice in one advance")
    if request.steps == 0:
        raise Refused("a rim cannot move in an advance over 0 steps")
    move = request.rim_moves[0]
    for id, face, segment in move.driven:
        if not has_segment(move.faces, face, segment):
            raise Refused(f"the grain {id} is to be driven by segment {segment} of face {face}, which does not exist")
    ids = np.array([id for id, _, _ in move.driven], np.int64)
    if len(np.unique(ids)) < len(ids) or not book.has(ids).all():
        raise Refused("a grain is to be driven which is unknown or named twice")


def check_grain(g, setup, faces):
    if not 0 < g.id <= LARGEST:
        raise Refused(f"a grain's id must be in 1..{LARGEST}, not {g.id}")
    if not np.isfinite(g.position + g.velocity + g.spin).all():
        raise Refused(f"the new grain {g.id} has no finite position, velocity or spin")
    if not 0 < g.radius <= setup.max_radius:
        raise Refused(f"the new grain {g.id} has radius {g.radius:g} m; allowed are radii up to {setup.max_radius:g} m")
    if any(not p and not lo <= x <= hi for p, lo, x, hi in zip(setup.periodic, setup.lo, g.position, setup.hi)):
        x, y, z = g.position
        raise Refused(f"the new grain {g.id} at ({x:g}, {y:g}, {z:g}) m lies outside of the box")
    if g.segment >= 0 and not has_segment(faces, g.face, g.segment):
        raise Refused(f"the new grain {g.id} is to be driven by segment {g.segment} of face {g.face}, which does not exist")


def check_ids(request, book):
    """Every id to be removed is there, once; no new id is there yet."""
    seen = set()
    for id, there in zip(request.remove.tolist(), book.has(request.remove)):
        if not there:
            raise Refused(f"the grain {id} is to be removed, which is unknown")
        if id in seen:
            raise Refused(f"the grain {id} is to be removed twice")
        seen.add(id)
    new = [g.id for g in request.insert]
    for id, there in zip(new, book.has(np.array(new, np.int64))):
        if id in seen:
            raise Refused(f"the new grain {id} is given twice, or also removed")
        if there:
            raise Refused(f"the new grain {id} has the id of a grain that is there already")
        seen.add(id)


def check_drives(drives, faces, needed):
    if not drives and not needed:
        return
    if [len(face) for face in drives] != [face.segments for face in faces]:
        raise Refused("the drives given are not one for each segment of each face")
    for f, face in enumerate(drives):
        for d in face:
            if not d.least <= d.most or not np.isfinite([d.push, d.along, d.slide, *d.exit_velocity]).all():
                raise Refused(f"face {f} has a drive with velocities {d.least:g}..{d.most:g} m/s and push {d.push:g} N, which is "
                              "not possible")
