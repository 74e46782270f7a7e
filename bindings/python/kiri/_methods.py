"""Made from kiri.h by `make bindings`: the functions of C as methods of what they are about."""

from . import _core as core


def version():
    """The library's version, as KIRI_VERSION."""
    return core.load().kiriGetVersion()


def result_name(result):
    """The name of a result, 'KIRI_OK' and so on; 'unknown' for another number."""
    return core.ffi.string(core.load().kiriGetResultName(result)).decode()


def result_text(result):
    """One line: the meaning of a result, and its cure. For calls without a world that keeps a line, such as
    kiriCreateWorld with a def of zeros (KIRI_ERROR_DEF).
    """
    return core.ffi.string(core.load().kiriGetResultText(result)).decode()


def default_world_def():
    """Fills the def with its defaults, and stamps it."""
    structure = core.ffi.new('kiriWorldDef*')
    core.load().kiriDefaultWorldDef(structure)
    return core.record(structure[0])


def stage_name(stage):
    """The name of a stage, for tables; '' for a number that is none."""
    return core.ffi.string(core.load().kiriGetStageName(stage)).decode()


def material(preset):
    """The numbers of a preset, KIRI_MATERIAL_..."""
    structure = core.ffi.new('kiriMaterial*')
    core.check(core.load().kiriGetMaterial(preset, structure))
    return core.record(structure[0])


def quality(preset):
    """The numbers of a preset, KIRI_QUALITY_..."""
    structure = core.ffi.new('kiriQuality*')
    core.check(core.load().kiriGetQuality(preset, structure))
    return core.record(structure[0])


def default_sheet_def():
    """Fills the def with its defaults, and stamps it. It has no mesh yet."""
    structure = core.ffi.new('kiriSheetDef*')
    core.load().kiriDefaultSheetDef(structure)
    return core.record(structure[0])


def default_pin_def():
    """Fills the def with its defaults, and stamps it."""
    structure = core.ffi.new('kiriPinDef*')
    core.load().kiriDefaultPinDef(structure)
    return core.record(structure[0])


def default_obstacle_def():
    """Fills the def with its defaults, and stamps it."""
    structure = core.ffi.new('kiriObstacleDef*')
    core.load().kiriDefaultObstacleDef(structure)
    return core.record(structure[0])


def default_debug_draw():
    """Fills it with its defaults, and stamps it."""
    structure = core.ffi.new('kiriDebugDraw*')
    core.load().kiriDefaultDebugDraw(structure)
    return core.record(structure[0])


class World:
    def tick(self, dt, substeps=1):
        """One fixed step of dt seconds (1e-6 to 10), solved in `substeps` equal parts (1 to 64). Takes the waiting cut
        points, then moves every sheet. KIRI_PENDING: the budget is spent and more work waits: the events say which
        cuts; a sheet, or some of its pieces, may also have stood still for want of iterations. KIRI_ERROR_MEMORY:
        nothing moved; cuts and pieces still wait, call again. Refused work is prepared again: until then
        kiriSheet_GetWeights gives KIRI_ERROR_STATE, and with a budget a cut may take effect some ticks later than
        it would have. KIRI_ERROR_LIMIT: the same, and it stays so until frames are destroyed. KIRI_DIVERGED: the
        sheets named by the events were put to rest, the others moved. Work may wait then, too, as
        KIRI_EVENT_DEFERRED says.
        """
        return self.call('kiriWorld_Tick', dt, substeps)

    def set_gravity(self, gravity):
        """m/s^2. All pieces wake."""
        return self.call('kiriWorld_SetGravity', core.vector(gravity, 3))

    def shift_origin(self, origin):
        """Moves the origin of the world to a point (m): subtracts it from the positions of sheets, targets of pins and
        holds, obstacles, blades, and contacts that wait. The motion goes on as before, to rounding. Nothing wakes;
        (0, 0, 0) changes nothing. Use it in large worlds: far from the origin floats lose places. The host shifts
        its own data itself. Arrays that the library handed out keep the old positions until the next tick.
        KIRI_ERROR_ARGUMENT: a position would not fit a float. KIRI_ERROR_MEMORY: nothing has changed.
        """
        return self.call('kiriWorld_ShiftOrigin', core.vector(origin, 3))

    def set_budget(self, **fields):
        """Takes effect with the next tick."""
        kept = []  # until C has read it
        structure = core.structure(self, 'kiriBudget', fields, kept)
        return self.call('kiriWorld_SetBudget', structure)

    def state_hash(self):
        """A hash of everything that the coming ticks depend on, work that waits for its budget included: two worlds
        that got the same calls have the same hash, and two with the same hash go on alike. After a refused
        allocation some items are made again: the hash tells that while work waits, or while the budget limits cells
        or samples.
        """
        return self.get('kiriWorld_GetStateHash', 'uint64_t')

    def sheets(self):
        """Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there
        are.
        """
        things, = self.lists('kiriWorld_GetSheets', ('kiriSheet',))
        return [self.thing('Sheet', thing) for thing in things]

    def finish_cuts(self):
        """Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts that wait for a
        budget take effect. The next tick reports the events. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
        kiriWorld_Tick. Arrays that the world handed out end as with a tick.
        """
        return self.call('kiriWorld_FinishCuts')

    def events(self):
        """*events points to *count events."""
        return self.get_array(
            lambda array, count: [core.record(array[i], self) for i in range(count)],
            'kiriWorld_GetEvents', 'kiriEvent')

    def profile(self):
        """Of the last tick that was not refused."""
        return core.record(self.get('kiriWorld_GetProfile', 'kiriProfile'), self)

    def create_rectangle(self, width, height, columns, rows, **fields):
        """A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows
        triangles; columns and rows are 1 to 4096. def: all but the mesh, which is not read; null: the defaults. A
        recording has it as kiriCreateSheet.
        """
        kept = []  # until C has read it
        structure = core.structure(self, 'kiriSheetDef', fields, kept)
        return self.thing('Sheet', self.get('kiriCreateRectangle', 'kiriSheet', width, height, columns, rows, structure))

    def destroy_pieces(self, frames):
        """The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece
        count once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together.
        detached[i] is the sheet that the piece of frames[i] has become, 0 where it waits.
        """
        ids = [self.id_of(thing, 'Frame') for thing in frames]
        return self.call('kiriWorld_DestroyPieces', core.ffi.new('kiriFrame[]', ids), len(ids))

    def begin_blade(self, sheet=None):
        """sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of their own. A
        blade for one sheet whose sheet is gone cuts nothing.
        """
        return self.thing('Blade', self.get('kiriBeginBlade', 'kiriBlade', self.id_of(sheet, 'Sheet') if sheet else 0))


class Sheet:
    def destroy(self):
        """The sheet is gone, with its cuts, frames and pins; their ids are stale."""
        return self.world.call('kiriDestroySheet', self.id)

    def settings(self):
        """What they are now, stamped for kiriSheet_SetSettings."""
        return core.record(self.world.get('kiriSheet_GetSettings', 'kiriSheetSettings', self.id), self.world)

    def mesh(self, *names):
        """The arrays, without a copy."""
        return self.world.get_copies(names, 'kiriSheet_GetMesh', 'kiriMesh', self.id)

    def mesh_view(self):
        """The same without copies, for a `with` statement, within which the world does not change: see Loan."""
        return core.Loan(self.world, 'kiriSheet_GetMesh', 'kiriMesh', self.id)

    def dirty(self, since_revision):
        """What changed since the host saw that revision; all of the mesh where that is too long ago, or 0."""
        return core.record(self.world.get('kiriSheet_GetDirty', 'kiriDirty', self.id, since_revision), self.world)

    def solid(self, *names, thickness=0.0):
        """thickness: m, 0: that of the material. Made when it is asked for."""
        return self.world.get_copies(names, 'kiriSheet_GetSolid', 'kiriSolid', self.id, thickness)

    def solid_view(self, thickness=0.0):
        """The same without copies, for a `with` statement, within which the world does not change: see Loan."""
        return core.Loan(self.world, 'kiriSheet_GetSolid', 'kiriSolid', self.id, thickness)

    def collision_points(self):
        """Collision points: 3 floats of position (m, world) a point."""
        return self.world.get_array(
            lambda array, count: core.copy(array, count, 3),
            'kiriSheet_GetCollisionPoints', 'float', self.id)

    def counts(self):
        """Costs nothing."""
        return core.record(self.world.get('kiriSheet_GetCounts', 'kiriCounts', self.id), self.world)

    def totals(self):
        """Sums over the frames, made when they are asked for."""
        return core.record(self.world.get('kiriSheet_GetTotals', 'kiriTotals', self.id), self.world)

    def estimate_error(self):
        """An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly: rms distance
        from where a sheet of very many frames would be under the same loads, over the rms way that it has gone from
        its flat shape; 0 to 1, and 1 where there are too few frames to tell. It compares the strains of
        neighbouring links (KIRI_MODEL_LINKS only; else KIRI_ERROR_STATE). Measured on cantilevers and on a sheet
        with a slit, of 3 to 140 frames, it is not below a third of the error, and not above four times the error
        or, where that is below 0.5 %, 1.5 %. Where a sheet also turned as a whole, as by hanging from two corners,
        it says up to ten times too much. It knows nothing of errors of the grid, of time stepping, and of loads
        that are finer than frames. It takes memory and time for one pass over the links, when it is called.
        """
        return self.world.get('kiriSheet_EstimateError', 'double', self.id)

    def is_awake(self):
        """*awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do.
        kiriSheet_Wake wakes all of them.
        """
        return self.world.get('kiriSheet_IsAwake', 'int32_t', self.id) != 0

    def wake(self):
        """*awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do.
        kiriSheet_Wake wakes all of them.
        """
        return self.world.call('kiriSheet_Wake', self.id)

    def transform(self, rotation, translation):
        """Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities turn. The
        columns of `rotation` are where R takes the axes of the world; a planar sheet turns about its normal only.
        It wakes. Targets of its pins, hinges, clamps and holds go along, so nothing draws it back. To set a target
        to its current value changes nothing. A target that the host has set nearer to the new place of the pin than
        to the old one stays: so the host may set targets before or after. Pins on an obstacle stay on it: put the
        obstacle elsewhere by the same motion (kiriObstacle_SetPose), before or after. Loads and contacts that wait
        for the next tick stay.
        """
        return self.world.call('kiriSheet_Transform', self.id, core.vector(rotation, 9), core.vector(translation, 3))

    def set_velocity(self, velocity, angular_velocity=(0.0, 0.0, 0.0)):
        """From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
        `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow
        their hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone.
        """
        return self.world.call('kiriSheet_SetVelocity', self.id, core.vector(velocity, 3), core.vector(angular_velocity, 3))

    def set_user_data(self, data):
        """A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
        """
        return self.world.call('kiriSheet_SetUserData', self.id, data)

    def user_data(self):
        """A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
        """
        return self.world.get('kiriSheet_GetUserData', 'uint64_t', self.id)

    def point(self, rest_point):
        """Outside the sheet: KIRI_ERROR_ARGUMENT. On a cut, the lip that holds the point; either where both do."""
        return core.record(self.world.get('kiriSheet_GetPoint', 'kiriPointState', self.id, core.vector(rest_point, 2)), self.world)

    def piece(self, piece):
        """The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An
        index that is no piece's: KIRI_ERROR_ARGUMENT.
        """
        return core.record(self.world.get('kiriSheet_GetPiece', 'kiriPieceState', self.id, piece), self.world)

    def piece_mesh(self, piece, *names):
        """The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An
        index that is no piece's: KIRI_ERROR_ARGUMENT.
        """
        return self.world.get_copies(names, 'kiriSheet_GetPieceMesh', 'kiriPieceMesh', self.id, piece)

    def piece_mesh_view(self, piece):
        """The same without copies, for a `with` statement, within which the world does not change: see Loan."""
        return core.Loan(self.world, 'kiriSheet_GetPieceMesh', 'kiriPieceMesh', self.id, piece)

    def piece_frames(self, piece):
        """*frames points to *count ids."""
        return self.world.get_array(
            lambda array, count: [self.world.thing('Frame', array[i]) for i in range(count)],
            'kiriSheet_GetPieceFrames', 'kiriFrame', self.id, piece)

    def drop_crumbs(self, area):
        """Destroys all pieces below an area (m^2) except the largest piece, at the cost of one. *count is how many.
        Where that one waits to become a sheet, the largest of the others stays, too.
        """
        return self.world.get('kiriSheet_DropCrumbs', 'int32_t', self.id, area)

    def begin_cut(self, rest_point):
        """A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet cuts nothing.
        Points wait until the next tick. The end of a cut that lies inside the sheet stays closed until the blade
        moves on.
        """
        return self.world.thing('Cut', self.world.get('kiriBeginCut', 'kiriCut', self.id, core.vector(rest_point, 2)))

    def slice(self, blade):
        """A blade (a straight edge) that moves in world space from blade[0]-blade[1] to blade[3]-blade[2] cuts where
        the swept quadrilateral meets the sheet as it is now, past borders, so that it parts what it crosses. The
        cut is ended already. Slices of a sheet that moves do not join from tick to tick: for that take a blade.
        """
        return self.world.thing('Cut', self.world.get('kiriSheet_Slice', 'kiriCut', self.id, core.vector(blade, 12)))

    def frames(self):
        """Writes up to `capacity` ids of the sheet's frames; *count is how many there are."""
        things, = self.world.lists('kiriSheet_GetFrames', ('kiriFrame',), self.id)
        return [self.world.thing('Frame', thing) for thing in things]

    def apply_force(self, rest_point, force, torque=(0.0, 0.0, 0.0)):
        """A force (N, world) on a point of the material and a torque (N m)."""
        return self.world.call('kiriSheet_ApplyForce', self.id, core.vector(rest_point, 2), core.vector(force, 3), core.vector(torque, 3))

    def apply_line_load(self, start, end, force_per_length):
        """A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in the material,
        edges included. Where it runs along a cut, each lip gets half. The ends differ; a line that meets no
        material: KIRI_ERROR_ARGUMENT.
        """
        return self.world.call('kiriSheet_ApplyLineLoad', self.id, core.vector(start, 2), core.vector(end, 2), core.vector(force_per_length, 3))

    def apply_pressure(self, pressure):
        """A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0."""
        return self.world.call('kiriSheet_ApplyPressure', self.id, pressure)

    def apply_impulse(self, rest_point, impulse):
        """An impulse (N s, world) on a point of the material, where it is seen now. Velocities change at once, by as
        much as the frames that carry the point resist; a held frame's part is lost. Outside the sheet:
        KIRI_ERROR_ARGUMENT.
        """
        return self.world.call('kiriSheet_ApplyImpulse', self.id, core.vector(rest_point, 2), core.vector(impulse, 3))

    def set_wind(self, **fields):
        """Copied; it blows until the next call."""
        kept = []  # until C has read it
        structure = core.structure(self.world, 'kiriWind', fields, kept)
        return self.world.call('kiriSheet_SetWind', self.id, structure)

    def clamp_line(self, start, end):
        """Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and
        direction of the material there, as a vice does; a hinge its place only, so that the sheet may turn about
        the line. Both begin where the material is now; the line stays straight, and as long as it is at rest: so
        material that is bent there is pulled straight, and pieces that have come apart are pulled together, however
        fast that makes them.
        They hold what the line meets, edges included, with the stiffness that the material has between the line and
        the frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of
        frames, where kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two
        sides, so that neither bends the other. A line that runs along a cut holds both lips; one beside it, by a
        512th of a square of the grid or more, holds one. The ends differ; a line that meets no material:
        KIRI_ERROR_ARGUMENT.
        """
        return self.world.thing('Pin', self.world.get('kiriSheet_ClampLine', 'kiriPin', self.id, core.vector(start, 2), core.vector(end, 2)))

    def hinge_line(self, start, end):
        """Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and
        direction of the material there, as a vice does; a hinge its place only, so that the sheet may turn about
        the line. Both begin where the material is now; the line stays straight, and as long as it is at rest: so
        material that is bent there is pulled straight, and pieces that have come apart are pulled together, however
        fast that makes them.
        They hold what the line meets, edges included, with the stiffness that the material has between the line and
        the frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of
        frames, where kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two
        sides, so that neither bends the other. A line that runs along a cut holds both lips; one beside it, by a
        512th of a square of the grid or more, holds one. The ends differ; a line that meets no material:
        KIRI_ERROR_ARGUMENT.
        """
        return self.world.thing('Pin', self.world.get('kiriSheet_HingeLine', 'kiriPin', self.id, core.vector(start, 2), core.vector(end, 2)))

    def pins(self):
        """Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are."""
        things, = self.world.lists('kiriSheet_GetPins', ('kiriPin',), self.id)
        return [self.world.thing('Pin', thing) for thing in things]

    def contact_forces(self):
        """One for each contact that was set before the last tick, in the order given. The sum of the impulses, with
        those of gravity, loads and obstacles, is the change of momentum of a piece that nothing holds. A piece that
        sleeps goes on to press with what it fell asleep with.
        """
        return self.world.get_array(
            lambda array, count: [core.record(array[i], self.world) for i in range(count)],
            'kiriSheet_GetContactForces', 'kiriContactForce', self.id)

    def reach(self, dt):
        """The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no obstacles or
        contacts outside. It reaches as far around the sheet as its fastest point can go by its velocity and
        gravity, twice, and the contact thickness. Obstacles that move themselves come as much nearer. dt as in
        kiriWorld_Tick.
        """
        lower = core.ffi.new('float[3]')
        upper = core.ffi.new('float[3]')
        self.world.call('kiriSheet_GetReach', self.id, dt, lower, upper)
        return tuple(lower), tuple(upper)


class Cut:
    def extend(self, rest_points):
        """restPoints: 2 floats a point; count is 1 to 2^24."""
        return self.world.call('kiriCut_Extend', self.id, *core.rows('float', rest_points, 2))

    def end(self):
        """No more points come. After the tick in which the last of them takes effect the id is stale, and
        KIRI_EVENT_CUT_FINISHED tells. Frames that the sheet needs after the cut are added then.
        """
        return self.world.call('kiriCut_End', self.id)


class Frame:
    def set_piece_velocity(self, velocity, angular_velocity=(0.0, 0.0, 0.0)):
        """From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
        `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow
        their hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone.
        """
        return self.world.call('kiriFrame_SetPieceVelocity', self.id, core.vector(velocity, 3), core.vector(angular_velocity, 3))

    def set_piece_user_data(self, data):
        """A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
        """
        return self.world.call('kiriFrame_SetPieceUserData', self.id, data)

    def piece_user_data(self):
        """A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
        """
        return self.world.get('kiriFrame_GetPieceUserData', 'uint64_t', self.id)

    def piece(self):
        """The index that the piece with this frame has now."""
        return self.world.get('kiriFrame_GetPiece', 'int32_t', self.id)

    def detach_piece(self):
        """Makes a sheet of the piece with this frame. Its frames, pins and collision points move along, in their
        order; they keep their ids and states, and what waits for the next tick: the motion goes on as if nothing
        had happened, but for the solver's guard over energy and step length, which is one for each sheet. A clamp
        or hinge that holds both becomes two: the rest keeps the id, the new sheet's has one of its own
        (kiriSheet_GetPins). Both sheets have all settings (of collisionPoints and integrationPoints the share that
        falls to their area), maxFrames each for itself; a piece that sleeps goes on sleeping. Cuts stay with the
        rest: a blade in the piece cuts nothing until it is back. Indices of collision points of the rest change.
        Its triangles and vertices keep their indices where it has more than 4096 vertices, and while no more than
        half of them are of pieces that went: these triangles have three equal corners, these vertices are of no
        triangle. Else all move together, and their indices change. In either case its revision grows, and
        kiriSheet_GetDirty says what changed. The new sheet has the squares of the grid around it, at about 40 bytes
        a square: crumbs are better dropped. Costs what the piece takes to make, and a look at the weights of what
        is left; where indices change more. KIRI_PENDING: work on a cut is at hand in the sheet, or it takes more
        samples than the budget leaves calls before the next tick; *detached is 0. When the work is done, what is
        the piece of this frame then becomes a sheet, and KIRI_EVENT_PIECE_DETACHED names it. Samples pay for it
        before, over several ticks if need be, of many pieces one after the other: of the first that waits 3 for
        each vertex, 2.5 to 9 for each cell (the more frames, the more) and 100 for each frame, of others 3 for each
        vertex and 1.4 for each cell; and one for 80 vertices of the rest. Until then further cuts of the sheet
        wait. The first piece is made as it is paid, and leaves at the start of the tick after the last sample is
        paid. That tick does an eighth of the work; the first tick after a load makes the parts again that saves
        leave out. The coming ticks have fewer samples for the work of calls. KIRI_ERROR_STATE: nothing would be
        left of the sheet.
        """
        return self.world.thing('Sheet', self.world.get('kiriFrame_DetachPiece', 'kiriSheet', self.id))

    def destroy_piece(self):
        """The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but for making a
        sheet: that is done at once, and the coming ticks have less. Where kiriSheet_GetMesh has been called since
        the last tick, all indices are copied. KIRI_PENDING: work on a cut is at hand. The piece is gone all the
        same: its triangles are in kiriMesh, with three equal corners; it touches nothing; no point of it is found.
        When the work is done its vertices go, too; until then kiriCounts still counts it, and its kiriPieceState is
        all zeros.
        """
        return self.world.call('kiriFrame_DestroyPiece', self.id)

    def state(self):
        """Pose, motion and region as they are now."""
        return core.record(self.world.get('kiriFrame_GetState', 'kiriFrameState', self.id), self.world)

    def reaction(self):
        """With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the frame's rest
        point; means over the last tick, impulses divided by its dt. They carry the frame's own weight and change
        its momentum, too. Zero for a frame that was free. A piece that sleeps keeps those that it fell asleep with.
        """
        force = core.ffi.new('double[3]')
        torque = core.ffi.new('double[3]')
        self.world.call('kiriFrame_GetReaction', self.id, force, torque)
        return tuple(force), tuple(torque)

    def apply_force(self, force, torque=(0.0, 0.0, 0.0)):
        """A force (N, world) on the frame's centre of mass and a torque (N m)."""
        return self.world.call('kiriFrame_ApplyForce', self.id, core.vector(force, 3), core.vector(torque, 3))


class Pin:
    def set_user_data(self, data):
        """A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
        """
        return self.world.call('kiriPin_SetUserData', self.id, data)

    def user_data(self):
        """A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
        """
        return self.world.get('kiriPin_GetUserData', 'uint64_t', self.id)

    def set_target(self, target):
        """Where the pin holds its point, or the middle of its line (m, world): at the end of the next tick, and until
        the next call. Within the tick it goes there evenly. The current target of kiriPin_GetState changes nothing.
        With KIRI_SKINNING_SMOOTH what pins and clamps hold is what is seen there; of a clamp the mean along its
        line, for each piece: single points of the line are seen a little off it.
        """
        return self.world.call('kiriPin_SetTarget', self.id, core.vector(target, 3))

    def set_pose(self, target, rotation):
        """The same with the rotation of the line's material: columns are the directions of u and v and the normal. On
        a planar sheet it is about the sheet's normal. KIRI_ERROR_ARGUMENT for a pin that holds a point.
        """
        return self.world.call('kiriPin_SetPose', self.id, core.vector(target, 3), core.vector(rotation, 9))

    def set_break_force(self, break_force):
        """As in the def, for pins of all types; N, 0: it never breaks."""
        return self.world.call('kiriPin_SetBreakForce', self.id, break_force)

    def state(self):
        """What it is, and where it holds now."""
        return core.record(self.world.get('kiriPin_GetState', 'kiriPinState', self.id), self.world)

    def reaction(self):
        """With what the pin acted on the sheet: force (N, world) and torque (N m) about its target; means over the
        last tick, impulses divided by its dt. So the reactions of all pins and held frames are the weight of a
        sheet at rest, and in motion what changes its momentum (as far as `iterations` have the tick solved). Zero
        before the first tick. A piece that sleeps keeps those that it fell asleep with.
        """
        force = core.ffi.new('double[3]')
        torque = core.ffi.new('double[3]')
        self.world.call('kiriPin_GetReaction', self.id, force, torque)
        return tuple(force), tuple(torque)

    def destroy(self):
        """It lets go; its id is stale."""
        return self.world.call('kiriDestroyPin', self.id)


class Obstacle:
    def destroy(self):
        """It is gone, its id stale. What rested on it wakes."""
        return self.world.call('kiriDestroyObstacle', self.id)

    def set_pose(self, position, rotation=(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)):
        """Where it is when the next tick starts. It did not move there: velocities alone say what sheets feel.
        rotation: a rotation matrix, columns as in the def.
        """
        return self.world.call('kiriObstacle_SetPose', self.id, core.vector(position, 3), core.vector(rotation, 9))

    def set_velocity(self, velocity, angular_velocity=(0.0, 0.0, 0.0)):
        """With what it moves in the next tick and from then on."""
        return self.world.call('kiriObstacle_SetVelocity', self.id, core.vector(velocity, 3), core.vector(angular_velocity, 3))

    def set_surface_velocity(self, velocity):
        """With what it moves in the next tick and from then on."""
        return self.world.call('kiriObstacle_SetSurfaceVelocity', self.id, core.vector(velocity, 3))

    def set_mass(self, mass, inertia=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), center_of_mass=(0.0, 0.0, 0.0)):
        """As in the def."""
        return self.world.call('kiriObstacle_SetMass', self.id, mass, core.vector(inertia, 6), core.vector(center_of_mass, 3))

    def state(self):
        """Pose and velocities as they are now."""
        return core.record(self.world.get('kiriObstacle_GetState', 'kiriObstacleState', self.id), self.world)


class Blade:
    def move_edge(self, start, end):
        """The blade is now the straight edge between two points (m, world). From where it was it got there straight,
        each end along a line. The first call only says where it begins. Where an end of the edge lies inside of
        what it sweeps of the sheet, it cuts only what it sweeps. An edge without length cuts nothing.
        """
        return self.world.call('kiriBlade_MoveEdge', self.id, core.vector(start, 3), core.vector(end, 3))

    def move_ray(self, origin, direction, length):
        """The same for a ray that a camera casts: an edge `length` m long."""
        return self.world.call('kiriBlade_MoveRay', self.id, core.vector(origin, 3), core.vector(direction, 3), length)

    def end(self):
        """It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends."""
        return self.world.call('kiriBlade_End', self.id)
