---@meta kiri
-- Made from kiri.h by `make bindings`: types for LuaLS. kiri.lua is what runs.

---@class kiri
local kiri = {}

kiri.OK = 0
kiri.PENDING = 1
kiri.ERROR_ARGUMENT = -1
kiri.ERROR_DEF = -2
kiri.ERROR_ID = -3
kiri.ERROR_MESH = -4
kiri.ERROR_STATE = -5
kiri.ERROR_MEMORY = -6
kiri.DIVERGED = -7
kiri.ERROR_LIMIT = -8
kiri.ERROR_BUILD = -9
kiri.ERROR_DATA = -10
kiri.ERROR_REPLAY = -11
kiri.LEAST_TRIANGLES = 16
kiri.MOST_NOTE_BYTES = 1048576
kiri.EVENT_CUT_FINISHED = 1
kiri.EVENT_PIECE_OFF = 2
kiri.EVENT_FRAME_ADDED = 3
kiri.EVENT_DIVERGED = 4
kiri.EVENT_DEFERRED = 5
kiri.EVENT_PIN_BROKE = 6
kiri.EVENT_PIECE_DETACHED = 7
kiri.EVENT_SEAM_BROKE = 8
kiri.EVENT_TEAR_BEGAN = 9
kiri.EVENT_TEAR_ENDED = 10
kiri.EVENT_STRAINED = 11
kiri.STAGE_CUT = 0
kiri.STAGE_GRID = 1
kiri.STAGE_REGIONS = 2
kiri.STAGE_SHAPE = 3
kiri.STAGE_SAMPLES = 4
kiri.STAGE_CONSTANTS = 5
kiri.STAGE_CONTACT = 6
kiri.STAGE_SOLVE = 7
kiri.STAGE_SKIN = 8
kiri.STAGE_COUNT = 9
kiri.MATERIAL_PAPER = 0
kiri.MATERIAL_COTTON = 1
kiri.MATERIAL_RUBBER = 2
kiri.MATERIAL_FOIL = 3
kiri.MATERIAL_CARD = 4
kiri.MATERIAL_SILK = 5
kiri.MATERIAL_SHIRTING = 6
kiri.MATERIAL_WOOL = 7
kiri.MATERIAL_DENIM = 8
kiri.MATERIAL_JERSEY = 9
kiri.MATERIAL_COUNT = 10
kiri.QUALITY_FAST = 0
kiri.QUALITY_BALANCED = 1
kiri.QUALITY_ACCURATE = 2
kiri.QUALITY_COUNT = 3
kiri.SETUP_CURTAIN = 0
kiri.SETUP_PAPER = 1
kiri.SETUP_FLAG = 2
kiri.SETUP_RIBBON = 3
kiri.SETUP_RUBBER = 4
kiri.SETUP_CARD = 5
kiri.SETUP_FOIL = 6
kiri.SETUP_COUNT = 7
kiri.MODEL_LINKS = 0
kiri.MODEL_AFFINE = 1
kiri.MODEL_POINTS = 2
kiri.SKINNING_LINEAR = 0
kiri.SKINNING_SMOOTH = 1
kiri.TIME_STEPPING_SECOND_ORDER = 0
kiri.TIME_STEPPING_EULER = 1
kiri.PIN_POINT = 0
kiri.PIN_HINGE = 1
kiri.PIN_CLAMP = 2
kiri.OBSTACLE_PLANE = 0
kiri.OBSTACLE_SPHERE = 1
kiri.OBSTACLE_CAPSULE = 2
kiri.OBSTACLE_BOX = 3
kiri.OBSTACLE_CYLINDER = 4
kiri.OBSTACLE_PRISM = 5
kiri.DRAW_TRIANGLES = 1
kiri.DRAW_EDGES = 2
kiri.DRAW_BORDERS = 4
kiri.DRAW_FRAMES = 8
kiri.DRAW_LINKS = 16
kiri.DRAW_PINS = 32
kiri.DRAW_CONTACTS = 64
kiri.DRAW_BLADES = 128
kiri.DRAW_BOXES = 256
kiri.DRAW_OBSTACLES = 512
kiri.DRAW_POINTS = 1024
kiri.DRAW_ALL = 2047

--- Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance: using
--- 30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut takes
--- effect; the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it (manual,
--- budget).
---@class kiri.Budget
---@field triangles? integer # split by blades; 0, or KIRI_LEAST_TRIANGLES and more
---@field cells? integer # visited, or with a new distance: grid, regions, shape functions. A link counts as a cell
---@field samples? integer # vertices and collision points with new weights, and the cost of the commit, paid before it
---@field iterations? integer # linear systems, 30 to 60 us each; a large one counts as several (manual, budget)

--- Settings of a world: gravity, budget, and functions of the host.
---@class kiri.WorldDef
---@field cookie? integer
---@field gravity? number[]|ffi.cdata* # m/s^2; default (0, 0, -9.81)
---@field budget? kiri.Budget # default: no limit
---@field alloc? function # null: malloc and free. Set both or none.
---@field free? function
---@field log? function # one line for each error and KIRI_EVENT_STRAINED; null: silent
---@field clock? function # null: the profile has counts, and no times
---@field startTask? function # null: a tick runs in the calling thread alone. Set both or none.
---@field finishTask? function
---@field workerCount? integer # threads for a task, the caller included, 0 to 1024; above 1 with startTask. Default 0
---@field user? number[]|ffi.cdata* # passed to the functions above
---@field record? function # receives the recording of the world, see kiriWorld_Replay; null: no recording
---@field recordHashTicks? integer # ticks between state hashes in the recording; one is at its end. 0: none. Default 60

--- Progress of a replay. Set all fields to zero before the first call.
---@class kiri.Replay
---@field offset? integer # bytes of the recording that were read; calls and ticks made, without refused ticks
---@field calls? integer # bytes of the recording that were read; calls and ticks made, without refused ticks
---@field ticks? integer # bytes of the recording that were read; calls and ticks made, without refused ticks
---@field note? number[]|ffi.cdata* # bytes of the note where the replay stopped, in the recording; else null
---@field noteCount? integer

--- An event. It fills the fields that its type names, and `sheet`. Other fields are 0, and `stage` is -1.
---@class kiri.Event
---@field type? integer # KIRI_EVENT_...
---@field sheet? kiri.Sheet
---@field cut? kiri.Cut # 0: none
---@field frame? kiri.Frame # 0: none
---@field pin? kiri.Pin # 0: none
---@field crumb? boolean|integer # 1: the piece is a crumb, see kiriSheetDef
---@field area? number # m^2, or 0
---@field stage? integer # KIRI_STAGE_..., or -1
---@field waiting? integer # points and ends of cuts that are pending or in work; or 0
---@field seam? kiri.Seam # 0: none
---@field stitches? integer # that the seam has left, or 0

--- Work and time of the last tick.
---@class kiri.Profile
---@field seconds? number[]|ffi.cdata* # of the last tick; zero without a clock
---@field cutSegments? integer # blade segments that took effect
---@field trianglesSplit? integer # Items in the units of kiriBudget. An item that takes more work counts more than once.
---@field cellsSettled? integer # Items in the units of kiriBudget. An item that takes more work counts more than once.
---@field samplesRefreshed? integer # Items in the units of kiriBudget. An item that takes more work counts more than once.
---@field solverIterations? integer # Items in the units of kiriBudget. An item that takes more work counts more than once.
---@field cellsChanged? integer # Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
---@field weightsChanged? integer # Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
---@field verticesChanged? integer # Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
---@field pointsChanged? integer # Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
---@field linksChanged? integer # Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
---@field commits? integer # sheets in which a cut took effect; linear systems, large and small
---@field systemsSolved? integer # sheets in which a cut took effect; linear systems, large and small
---@field contacts? integer # planes given to the solver: by the host, by obstacles, and between sheets
---@field sheetPairs? integer # pairs of sheets or pieces that are near each other and not both asleep
---@field largestJump? number # The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m.
---@field largestFade? number # The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m.

--- The material of a sheet: homogeneous, isotropic.
---@class kiri.Material
---@field youngsModulus? number # Pa, above 0
---@field poissonsRatio? number # 0 to below 0.5
---@field thickness? number # m, above 0
---@field density? number # kg/m^3, above 0
---@field airDamping? number # 1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets)
---@field flexDamping? number # s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
---@field yieldStress? number # Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not planar
---@field hardening? number # modulus beyond the yield stress, relative to youngsModulus; 0 to below 1
---@field slack? number # 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets)
---@field detail? integer # sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0
---@field restCurvature? number[]|ffi.cdata* # 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0

--- Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual, accuracy).
---@class kiri.Quality
---@field framesAlong? integer # control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9
---@field gridResolution? integer # for the sheet def
---@field iterations? integer # for the sheet def
---@field substeps? integer # for kiriWorld_Tick

--- Options of the paper, for comparison; part of the sheet def. Default 0, but for integrationOrder.
---@class kiri.PaperOptions
---@field fromScratch? boolean|integer # 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits
---@field popping? boolean|integer # 1: only new frames take their motion from the surface: it jumps, momentum is not kept
---@field linearWeights? boolean|integer # 1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS
---@field integrationPoints? integer # KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work.
---@field integrationOrder? integer # KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work.

--- A sheet: its rest shape, start, material, and computation.
---@class kiri.SheetDef
---@field cookie? integer
---@field restPositions? number[]|ffi.cdata* # The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge; holes and several parts are allowed. Two edges in the same place with different vertices are the lips of a cut (manual, meshes). 2 floats (u, v) a vertex
---@field vertexCount? integer
---@field indices? number[]|ffi.cdata* # 3 a triangle
---@field triangleCount? integer
---@field position? number[]|ffi.cdata* # Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
---@field axisU? number[]|ffi.cdata* # Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
---@field axisV? number[]|ffi.cdata* # Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
---@field velocity? number[]|ffi.cdata* # Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
---@field material? kiri.Material
---@field gridResolution? integer # grid squares along the longer side, 1 to 4096; default 32
---@field snapDistance? number # m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side
---@field weldDistance? number # m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none
---@field frameCount? integer # Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount frames are spread evenly, in straight rows over stiff rectangles, or fewer: one for two squares of the grid. frameCount 0: regions are split, after cuts too, to frameLength; 0: it follows from `accuracy`, the relative error (manual, accuracy). 0, or 1 and more; default 24
---@field frameLength? number # m; used where frameCount is 0; default 0
---@field accuracy? number # 1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default 0.02
---@field framePoints? number[]|ffi.cdata* # 2 floats a frame, or null
---@field maxFrames? integer # re-sampling stops here; default 256
---@field rigidWeight? number # Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy). default 0.95, 0
---@field rigidArea? number # Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy). default 0.95, 0
---@field crumbArea? number # m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
---@field friction? number # of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
---@field contactThickness? number # m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
---@field groups? integer # obstacles and sheets touch if they share a set bit. Default: all
---@field touchesSheets? boolean|integer # touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
---@field selfContact? boolean|integer # touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
---@field collisionPoints? integer # for kiriSheet_SetContacts: spread evenly, at least one in every piece; default 0: none
---@field iterations? integer # Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
---@field sleepSpeed? number # m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
---@field model? integer # KIRI_MODEL_..., default KIRI_MODEL_LINKS
---@field skinning? integer # KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH
---@field planar? boolean|integer # 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0
---@field timeStepping? integer # KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
---@field fadeTime? number # s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2
---@field normals? boolean|integer # 1: every tick computes normals (default). 0: kiriMesh has none, which saves time
---@field paper? kiri.PaperOptions # default: all off

--- Sheet settings that can change after creation. Fields mean the same as in kiriSheetDef.
---@class kiri.SheetSettings
---@field cookie? integer
---@field material? kiri.Material
---@field maxFrames? integer # re-sampling stops here; default 256
---@field crumbArea? number # m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
---@field friction? number # of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
---@field contactThickness? number # m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
---@field groups? integer # obstacles and sheets touch if they share a set bit. Default: all
---@field touchesSheets? boolean|integer # touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
---@field selfContact? boolean|integer # touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
---@field iterations? integer # Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
---@field sleepSpeed? number # m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
---@field skinning? integer # KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH
---@field timeStepping? integer # KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
---@field fadeTime? number # stays 0 with paper.popping
---@field normals? boolean|integer # 1: every tick computes normals (default). 0: kiriMesh has none, which saves time

--- A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and each side has its
--- own frames. Lines may end in the material, meet and cross; cuts go through or along them (manual, folding).
---@class kiri.Fold
---@field from? number[]|ffi.cdata* # m
---@field to? number[]|ffi.cdata* # m
---@field stiffness? number # N m/rad per metre of the line, 0 or more; 0: a free hinge
---@field restAngle? number # rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it
---@field yieldMoment? number # N m per metre: it bends for good beyond, with a yieldStress. 0: no limit

--- A fold, its mean angle (rad, as restAngle) and the length (m) along which it joins two sides: not cut, nor rigid.
---@class kiri.FoldState
---@field fold? kiri.Fold
---@field angle? number
---@field length? number

--- The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision grows when indices
--- or vertices are added or changed. Sources have the precision of the library, 2^-29 of the sheet.
---@class kiri.Mesh
---@field positions? number[]|ffi.cdata* # 3 a vertex, m, world
---@field normals? number[]|ffi.cdata* # 3 a vertex, unit; null where the sheet makes none
---@field restPositions? number[]|ffi.cdata* # 2 a vertex, m
---@field indices? number[]|ffi.cdata* # 3 a triangle
---@field sourceTriangles? number[]|ffi.cdata* # 1 a vertex: the triangle of the def that contains it,
---@field sourceWeights? number[]|ffi.cdata* # 3 a vertex: and its barycentric coordinates there
---@field vertexCount? integer
---@field triangleCount? integer
---@field revision? integer

--- `count` items from `first` on.
---@class kiri.Range
---@field first? integer
---@field count? integer

--- Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change in every tick.
---@class kiri.Dirty
---@field newVertices? kiri.Range # up to the last one of the mesh
---@field newTriangles? kiri.Range # up to the last one of the mesh
---@field oldVertices? kiri.Range # the smallest ranges that hold all older ones with other data
---@field oldTriangles? kiri.Range # the smallest ranges that hold all older ones with other data
---@field revision? integer # for the next call

--- The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips. First the vertices
--- of kiriMesh on the side of the normal, then the same on the other side, then four for each border edge.
---@class kiri.Solid
---@field positions? number[]|ffi.cdata* # 3 a vertex, m, world
---@field normals? number[]|ffi.cdata* # 3 a vertex, unit, outwards
---@field restPositions? number[]|ffi.cdata* # 2 a vertex, m
---@field indices? number[]|ffi.cdata* # 3 a triangle, counter-clockwise from outside
---@field sources? number[]|ffi.cdata* # 1 a vertex: its vertex in kiriMesh
---@field vertexCount? integer
---@field triangleCount? integer
---@field rimTriangle? integer # rims begin at this triangle

--- Numbers of items in a sheet.
---@class kiri.Counts
---@field vertices? integer
---@field triangles? integer
---@field cells? integer
---@field frames? integer
---@field links? integer
---@field pieces? integer
---@field collisionPoints? integer

--- m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s and kg m^2/s.
---@class kiri.Totals
---@field area? number
---@field mass? number
---@field kineticEnergy? number
---@field elasticEnergy? number
---@field center? number[]|ffi.cdata*
---@field momentum? number[]|ffi.cdata*
---@field angularMomentum? number[]|ffi.cdata*

--- The first point where a ray meets a sheet.
---@class kiri.Hit
---@field restPoint? number[]|ffi.cdata* # m: where to cut
---@field position? number[]|ffi.cdata* # m, world
---@field normal? number[]|ffi.cdata* # unit
---@field distance? number # m along the direction, which need not be a unit vector
---@field triangle? integer # -1: none

--- A point of the material on the visible surface.
---@class kiri.PointState
---@field position? number[]|ffi.cdata* # m, world; unit
---@field normal? number[]|ffi.cdata* # m, world; unit
---@field velocity? number[]|ffi.cdata* # m/s, by the weights of the point
---@field frame? kiri.Frame # the frame of its region; it also names the piece

--- A connected part of a sheet. Any of its frames names it. Indices go from 0 to kiriCounts.pieces, and change when a
--- piece comes off or goes (kiriFrame_GetPiece). Cuts with pending work have separated nothing yet.
---@class kiri.PieceState
---@field area? number # m^2, kg
---@field mass? number # m^2, kg
---@field center? number[]|ffi.cdata* # of mass, m; kg m/s, kg m^2/s about the origin
---@field momentum? number[]|ffi.cdata* # of mass, m; kg m/s, kg m^2/s about the origin
---@field angularMomentum? number[]|ffi.cdata* # of mass, m; kg m/s, kg m^2/s about the origin
---@field lower? number[]|ffi.cdata* # m, world: the smallest box around its vertices
---@field upper? number[]|ffi.cdata* # m, world: the smallest box around its vertices
---@field frames? integer # counts
---@field vertices? integer # counts
---@field triangles? integer # counts
---@field collisionPoints? integer # counts
---@field crumb? boolean|integer # 1: see kiriSheetDef
---@field asleep? boolean|integer # 1: see sleepSpeed

--- The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all pieces, piece by piece.
---@class kiri.PieceMesh
---@field vertices? number[]|ffi.cdata* # 1 a vertex: its index in kiriMesh
---@field triangles? number[]|ffi.cdata* # 1 a triangle: its index in kiriMesh
---@field indices? number[]|ffi.cdata* # 3 a triangle, as in kiriMesh: draw them
---@field collisionPoints? number[]|ffi.cdata* # 1 a point, see kiriSheet_GetCollisionPoints
---@field vertexCount? integer
---@field triangleCount? integer
---@field collisionPointCount? integer

--- How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or a sharp notch,
--- goes on across the tension where the sheet would set more energy free than the tear takes. Two frames go with its
--- tip. Where a mean tension over a distance of frames exceeds the strength, a tear begins at the nearest border, one
--- at a time.
---@class kiri.Tearing
---@field toughness? number # J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear
---@field strength? number # Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored
---@field grain? number[]|ffi.cdata* # direction in the rest plane along which it tears; 0, 0: none
---@field grainRatio? number # toughness across the grain, relative to along it; below 1: 1
---@field maxSpeed? number # m/s in the rest plane, 0 or more; 0: no limit but the distance above
---@field maxTips? integer # tips that tear in a tick, 0 or more; 0: 8. Others wait

--- Pose, motion and region of a frame.
---@class kiri.FrameState
---@field restPoint? number[]|ffi.cdata* # m
---@field position? number[]|ffi.cdata* # m, world: of the rest point
---@field rotation? number[]|ffi.cdata* # columns: direction of u, of v, normal; an affine frame: columns of A, which stretch
---@field velocity? number[]|ffi.cdata* # m/s, rad/s
---@field angularVelocity? number[]|ffi.cdata* # m/s, rad/s
---@field area? number # m^2 of its region; kg
---@field mass? number # m^2 of its region; kg
---@field held? boolean|integer # 1: moved by the host, see kiriFrame_Hold

--- Air past the sheet. v is the velocity of the air less the material's, n the normal: each square metre gets density
--- / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)); airDamping acts in any density. A sheet can sleep in wind.
---@class kiri.Wind
---@field velocity? number[]|ffi.cdata* # m/s
---@field density? number # kg/m^3, 0 or more; air: 1.2
---@field drag? number # 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
---@field lift? number # 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)

--- A pin holds a point of the material at its target by a spring.
---@class kiri.PinDef
---@field cookie? integer
---@field restPoint? number[]|ffi.cdata* # m, in the material
---@field target? number[]|ffi.cdata* # m, world
---@field stiffness? number # N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target (manual)
---@field breakForce? number # N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never
---@field obstacle? kiri.Obstacle # 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there

--- Type and target of a pin.
---@class kiri.PinState
---@field type? integer # KIRI_PIN_...
---@field sheet? kiri.Sheet
---@field from? number[]|ffi.cdata* # m, rest plane: the ends of the line, or the point twice
---@field to? number[]|ffi.cdata* # m, rest plane: the ends of the line, or the point twice
---@field target? number[]|ffi.cdata* # m, world
---@field rotation? number[]|ffi.cdata* # of a line; of a point the identity
---@field breakForce? number # N, or 0
---@field obstacle? kiri.Obstacle # that the target moves with; 0: none

--- A seam joins two lines in the material, of two sheets or of one: stitches join points at the same parts of both.
--- Cuts go through a seam, and pieces keep their stitches. A stitch ends with the piece of a point (manual, sewing).
---@class kiri.SeamDef
---@field cookie? integer
---@field sheetA? kiri.Sheet # of the same model, and not planar
---@field sheetB? kiri.Sheet # of the same model, and not planar
---@field lineA? number[]|ffi.cdata* # 2 floats a point, m, in the material, such as its edge; copied
---@field lineB? number[]|ffi.cdata* # 2 floats a point
---@field countA? integer # points: 2 to 65536
---@field countB? integer # points: 2 to 65536
---@field stitches? integer # 2 to 4096; 0 (default): three for two distances of frames
---@field stiffness? number # N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free
---@field restAngle? number # rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal
---@field breakForce? number # N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never

--- A stitch, as after the last tick.
---@class kiri.Stitch
---@field sheetA? kiri.Sheet
---@field sheetB? kiri.Sheet
---@field restA? number[]|ffi.cdata* # m, in the material
---@field restB? number[]|ffi.cdata* # m, in the material
---@field position? number[]|ffi.cdata* # m, world: where both drawn lips meet; their middle while they are apart
---@field gap? number # m: distance of the two points; a stitch yields by micrometres under the sheet's weight
---@field force? number[]|ffi.cdata* # N, on sheet A: mean over the last tick that moved it
---@field angle? number # rad, as restAngle

--- A contact of a point of the material: the plane dot(normal, x) = offset keeps the point on its upper side, with
--- Coulomb friction. The host computes planes from the visible surface for each tick. Planes out of reach do nothing.
---@class kiri.Contact
---@field point? integer # index of the collision point; -1: restPoint names the point
---@field restPoint? number[]|ffi.cdata* # m, in the material; read only where point is -1
---@field normal? number[]|ffi.cdata* # unit, out of the obstacle
---@field offset? number # m: of the obstacle's surface at the start of the tick
---@field velocity? number[]|ffi.cdata* # m/s: of the obstacle at the contact. The plane moves with it within the tick
---@field friction? number # 0 or more: of both sides together
---@field inverseMass? number # 1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid
---@field pushSpeed? number # m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s
---@field obstacle? integer # a number of the host. Contacts with one number press on one obstacle, and share its mass

--- The result of a contact in the last tick.
---@class kiri.ContactForce
---@field impulse? number[]|ffi.cdata* # N s, on the sheet: the sum over the tick. The obstacle gets the opposite
---@field position? number[]|ffi.cdata* # m, world: the point of the sheet at the end of the tick
---@field depth? number # m: of the point below the plane at the end of the tick; below 0: above it
---@field point? integer # as in the contact
---@field obstacle? integer # as in the contact

--- An obstacle: its shape, pose, motion, and mass.
---@class kiri.ObstacleDef
---@field cookie? integer
---@field type? integer # KIRI_OBSTACLE_...
---@field size? number[]|ffi.cdata* # m
---@field radius? number # m
---@field height? number # m
---@field outline? number[]|ffi.cdata* # 2 floats a corner, m, counter-clockwise; copied. Null: no prism
---@field outlineCount? integer # 3 to 64
---@field rounding? number # m, 0 or more: prisms and boxes grow by this, with round edges. Default 0
---@field position? number[]|ffi.cdata* # m, world
---@field rotation? number[]|ffi.cdata* # columns; default: the axes of the world
---@field velocity? number[]|ffi.cdata* # m/s, of its position
---@field angularVelocity? number[]|ffi.cdata* # rad/s
---@field surfaceVelocity? number[]|ffi.cdata* # m/s, world: of its surface, added to its motion, as of a conveyor
---@field friction? number # 0 or more; default 0.5
---@field mass? number # kg; 0 (default): nothing moves it
---@field inertia? number[]|ffi.cdata* # kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz. Positive definite, but for axes whose numbers are all 0: it does not turn about these
---@field centerOfMass? number[]|ffi.cdata* # m, from its position in its own axes
---@field body? integer # obstacles with the same number, except 0, are parts of one body; each has its whole mass
---@field pushSpeed? number # m/s, above 0: maximum speed at which points inside are pushed out. Default 1
---@field groups? integer # see the sheet def. Default: all

--- Pose, motion, and reaction of an obstacle.
---@class kiri.ObstacleState
---@field position? number[]|ffi.cdata*
---@field rotation? number[]|ffi.cdata*
---@field velocity? number[]|ffi.cdata*
---@field angularVelocity? number[]|ffi.cdata*
---@field impulse? number[]|ffi.cdata* # N s, N m s about its centre of mass: of sheets and pins in the last tick
---@field angularImpulse? number[]|ffi.cdata* # N s, N m s about its centre of mass: of sheets and pins in the last tick
---@field contacts? integer # that pushed in the last tick

--- A corner to draw, in a layout for a GPU.
---@class kiri.DrawVertex
---@field position? number[]|ffi.cdata* # m, world
---@field color? integer # red in its lowest byte, then green, blue, and opacity, which is 255

--- Flags, filter and functions of debug draw.
---@class kiri.DebugDraw
---@field cookie? integer
---@field flags? integer # KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES
---@field sheet? kiri.Sheet # draws only this one, without obstacles and blades; 0 (default): all
---@field size? number # m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05
---@field points? function # null: these are not drawn
---@field lines? function # the same
---@field triangles? function # the same
---@field user? number[]|ffi.cdata* # passed to these functions

--- An array of the library, from 0 on. It ends with the next tick.
---@class kiri.Array: ffi.cdata*
---@field [integer] any

---@class kiri.World
---@overload fun(def?: kiri.WorldDef): kiri.World
local World = {}

kiri.World = World

--- Frees the world and all its content.
function World:destroy() end

--- Draws the world as after the last tick, by functions of the host.
---@param draw kiri.DebugDraw
function World:debugDraw(draw) end

---@param id integer
---@return kiri.Sheet
function World:sheet(id) end

---@param id integer
---@return kiri.Cut
function World:cut(id) end

---@param id integer
---@return kiri.Frame
function World:frame(id) end

---@param id integer
---@return kiri.Pin
function World:pin(id) end

---@param id integer
---@return kiri.Obstacle
function World:obstacle(id) end

---@param id integer
---@return kiri.Blade
function World:blade(id) end

---@param id integer
---@return kiri.Seam
function World:seam(id) end

---@class kiri.Sheet
---@field id integer
---@field world kiri.World
local Sheet = {}

---@class kiri.Cut
---@field id integer
---@field world kiri.World
local Cut = {}

---@class kiri.Frame
---@field id integer
---@field world kiri.World
local Frame = {}

---@class kiri.Pin
---@field id integer
---@field world kiri.World
local Pin = {}

---@class kiri.Obstacle
---@field id integer
---@field world kiri.World
local Obstacle = {}

---@class kiri.Blade
---@field id integer
---@field world kiri.World
local Blade = {}

---@class kiri.Seam
---@field id integer
---@field world kiri.World
local Seam = {}

--- Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
---@return integer
function kiri.getVersion() end

--- Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
---@param result integer
---@return string
function kiri.getResultName(result) end

--- Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
---@param result integer
---@return string
function kiri.getResultText(result) end

--- Fill the def; create an empty world (def null: the defaults; on failure *world is null, and the log gets the
--- line); free it (null: nothing). KIRI_ERROR_BUILD: the compiler, or a mode of this thread, changes float operations
--- (manual, budget).
---@param def? kiri.WorldDef
---@return kiri.WorldDef
function kiri.defaultWorldDef(def) end

--- Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the pending cut
--- points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that still have work.
--- KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget). KIRI_ERROR_LIMIT: no ids
--- are left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED: events name sheets that were
--- stopped.
---@param dt number
---@param substeps integer
---@return boolean # work is left for later ticks
function World:tick(dt, substeps) end

--- Returns the line of the last function that changes the world, if it failed; else "". Valid until the next one.
---@return string
function World:getLastError() end

--- Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing
--- wakes. Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not fit a
--- float.
---@param origin number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function World:shiftOrigin(origin) end

--- Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
---@param gravity number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function World:setGravity(gravity) end

--- Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
---@param budget? kiri.Budget
---@return boolean # work is left for later ticks
function World:setBudget(budget) end

--- Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual, budget).
---@return integer
function World:getStateHash() end

--- Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are.
---@return kiri.Sheet[]
function World:getSheets() end

--- Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A replay stops there.
---@param bytes string|ffi.cdata*
---@param count? integer
---@return boolean # work is left for later ticks
function World:note(bytes, count) end

--- Makes the calls of a recording up to the next tick or note, included. The world must be new; hooks stay the
--- host's. KIRI_PENDING: more calls follow. KIRI_OK: the recording ended. KIRI_ERROR_REPLAY: a call gave another
--- result, other ids or another state; the line names it, and the next call goes on behind it. KIRI_ERROR_DATA: not a
--- recording, damaged, cut short, or of another version. KIRI_ERROR_STATE: the world is not new. KIRI_ERROR_MEMORY:
--- start again.
---@param recording string|ffi.cdata*
---@param replay? kiri.Replay
---@param size? integer
---@return boolean # work is left for later ticks
function World:replay(recording, replay, size) end

--- Writes the world to memory with room for `capacity`; bytes null: only counts them. *size: bytes of the save.
--- KIRI_ERROR_ARGUMENT: `capacity` is less. KIRI_PENDING: a cut is pending (kiriWorld_FinishCuts); *size is 0.
---@param bytes? string|ffi.cdata*
---@param capacity? integer
---@return string
function World:save(bytes, capacity) end

--- Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports the
--- events. Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
--- kiriWorld_Tick.
---@return boolean # work is left for later ticks
function World:finishCuts() end

--- Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a malicious save cannot
--- crash the program, and takes memory in proportion to its size, which is below 2^31. Old arrays live until the next
--- tick. On failure nothing has changed: KIRI_ERROR_DATA: not a save, damaged, or of another version.
--- KIRI_ERROR_MEMORY.
---@param bytes string|ffi.cdata*
---@param size? integer
---@return boolean # work is left for later ticks
function World:load(bytes, size) end

--- For rollback: copies all of the world, also work in progress, into memory of the host; much faster than a save,
--- and exact to the bit. For this process only: never store or send the bytes. bytes null: as of kiriWorld_Save.
---@param bytes? string|ffi.cdata*
---@param capacity? integer
---@return string
function World:snapshot(bytes, capacity) end

--- Replaces the world by the world of the snapshot, as kiriWorld_Load does. The bytes are trusted. On failure nothing
--- has changed: KIRI_ERROR_DATA: no snapshot of this build. KIRI_ERROR_STATE: it is recorded. KIRI_ERROR_MEMORY.
---@param bytes string|ffi.cdata*
---@param size? integer
---@return boolean # work is left for later ticks
function World:restore(bytes, size) end

--- Gets the events: *events points to *count of them.
---@return kiri.Array
function World:getEvents() end

--- Gets the profile of the last tick that was not refused.
---@param profile? kiri.Profile
---@return kiri.Profile
function World:getProfile(profile) end

--- Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum of several: half for
--- cuts, half for motion; all if it has one alone. Limits without recorded work stay. A replay must set the same
--- budgets.
---@param profile? kiri.Profile
---@param microseconds number
---@param budget? kiri.Budget
---@return boolean # work is left for later ticks
function kiri.fitBudget(profile, microseconds, budget) end

--- Returns the name of a stage; "" for another number.
---@param stage integer
---@return string
function kiri.getStageName(stage) end

--- Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
---@param preset integer
---@param material? kiri.Material
---@return kiri.Material
function kiri.getMaterial(preset, material) end

--- Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
---@param preset integer
---@param quality? kiri.Quality
---@return kiri.Quality
function kiri.getQuality(preset, quality) end

--- Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
--- failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
---@param def? kiri.SheetDef
---@return kiri.SheetDef
function kiri.defaultSheetDef(def) end

--- Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
--- failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
---@param def? kiri.SheetDef
---@return kiri.Sheet
function World:createSheet(def) end

--- Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
--- failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
---@return boolean # work is left for later ticks
function Sheet:destroy() end

--- Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of sheet and
--- its sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual, accuracy).
---@param preset integer
---@param width number
---@param height number
---@param def? kiri.SheetDef
---@return kiri.SheetDef
function kiri.getSetup(preset, width, height, def) end

--- Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns or
--- rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def null: the
--- defaults.
---@param width number
---@param height number
---@param columns integer
---@param rows integer
---@param def? kiri.SheetDef
---@return kiri.Sheet
function World:createRectangle(width, height, columns, rows, def) end

--- Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not
--- come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
---@param settings? kiri.SheetSettings
---@return kiri.SheetSettings
function Sheet:getSettings(settings) end

--- Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not
--- come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
---@param settings? kiri.SheetSettings
---@return boolean # work is left for later ticks
function Sheet:setSettings(settings) end

--- Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no material at
--- one.
---@param def? kiri.SheetDef
---@param folds kiri.Fold[]|ffi.cdata*
---@param count? integer
---@return kiri.Sheet
function World:createFoldedSheet(def, folds, count) end

--- Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
--- KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet.
---@param fold? kiri.Fold
---@return integer
function Sheet:addFold(fold) end

--- A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet.
---@param index integer
---@param state? kiri.FoldState
---@return kiri.FoldState
function Sheet:getFold(index, state) end

--- A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet.
---@param index integer
---@param stiffness number
---@param restAngle number
---@return boolean # work is left for later ticks
function Sheet:setFold(index, stiffness, restAngle) end

--- Fills in the mesh of kiriCreateRectangle: 2 (columns + 1) (rows + 1) floats and 6 columns rows indices.
---@param width number
---@param height number
---@param columns integer
---@param rows integer
---@param restPositions? number[]|ffi.cdata*
---@param indices? number[]|ffi.cdata*
---@return ffi.cdata*
---@return ffi.cdata*
function kiri.fillRectangle(width, height, columns, rows, restPositions, indices) end

--- Gets the arrays, without a copy.
---@param mesh? kiri.Mesh
---@return kiri.Mesh
function Sheet:getMesh(mesh) end

--- Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore.
---@param sinceRevision integer
---@param dirty? kiri.Dirty
---@return kiri.Dirty
function Sheet:getDirty(sinceRevision, dirty) end

--- Copies 3 floats each; positions or normals null: none. Strides: 12 bytes or more. KIRI_ERROR_STATE: no normals.
---@param first integer
---@param count integer
---@param positions? number[]|ffi.cdata*
---@param positionStride integer
---@param normals? number[]|ffi.cdata*
---@param normalStride integer
---@return boolean # work is left for later ticks
function Sheet:copyVertices(first, count, positions, positionStride, normals, normalStride) end

--- Copies the index that each vertex had when the last tick began, to draw between two ticks; -1: it did not exist.
--- *from: the sheet that had them then. A vertex that a cut separated has the other's index (manual, drawing).
---@param first integer
---@param count integer
---@param vertices number[]|ffi.cdata*
---@return ffi.cdata*
---@return kiri.Sheet
function Sheet:copyPrevious(first, count, vertices) end

--- Copies indices of some triangles as 16-bit numbers, 3 each. KIRI_ERROR_STATE: there are more than 65535 vertices.
---@param firstTriangle integer
---@param count integer
---@param indices number[]|ffi.cdata*
---@return ffi.cdata*
function Sheet:copyIndices16(firstTriangle, count, indices) end

--- Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9
--- floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes).
---@param firstTriangle integer
---@param count integer
---@param sources number[]|ffi.cdata*
---@return ffi.cdata*
function Sheet:copySources(firstTriangle, count, sources) end

--- Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9
--- floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes).
---@param firstTriangle integer
---@param count integer
---@param weights number[]|ffi.cdata*
---@return ffi.cdata*
function Sheet:copySourceWeights(firstTriangle, count, weights) end

--- Makes the solid surface, with a thickness in m; thickness 0: the material's.
---@param thickness number
---@param solid? kiri.Solid
---@return kiri.Solid
function Sheet:getSolid(thickness, solid) end

--- Gets the collision points: 3 floats of position (m, world) a point.
---@return kiri.Array
function Sheet:getCollisionPoints() end

--- Get the counts, at no cost; sum the totals over the frames.
---@param counts? kiri.Counts
---@return kiri.Counts
function Sheet:getCounts(counts) end

--- Get the counts, at no cost; sum the totals over the frames.
---@param totals? kiri.Totals
---@return kiri.Totals
function Sheet:getTotals(totals) end

--- Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not
--- KIRI_MODEL_LINKS.
---@return number
function Sheet:estimateError() end

--- Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all.
---@return boolean
function Sheet:isAwake() end

--- Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all.
---@return boolean # work is left for later ticks
function Sheet:wake() end

--- Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar sheet
--- turns about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual, sheets).
---@param rotation number[]|ffi.cdata*
---@param translation number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Sheet:transform(rotation, translation) end

--- Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre
--- of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay
--- held.
---@param velocity number[]|ffi.cdata*
---@param angularVelocity number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Sheet:setVelocity(velocity, angularVelocity) end

--- Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre
--- of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay
--- held.
---@param velocity number[]|ffi.cdata*
---@param angularVelocity number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Frame:setPieceVelocity(velocity, angularVelocity) end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
---@param data integer
---@return boolean # work is left for later ticks
function Sheet:setUserData(data) end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
---@return integer
function Sheet:getUserData() end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
---@param data integer
---@return boolean # work is left for later ticks
function Pin:setUserData(data) end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
---@return integer
function Pin:getUserData() end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
---@param data integer
---@return boolean # work is left for later ticks
function Frame:setPieceUserData(data) end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
---@return integer
function Frame:getPieceUserData() end

--- Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not.
---@param origin number[]|ffi.cdata*
---@param direction number[]|ffi.cdata*
---@param maxDistance number
---@param hit? kiri.Hit
---@return kiri.Hit
function Sheet:raycast(origin, direction, maxDistance, hit) end

--- Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not.
---@param origin number[]|ffi.cdata*
---@param direction number[]|ffi.cdata*
---@param maxDistance number
---@param hit? kiri.Hit
---@return kiri.Sheet?
---@return kiri.Hit
function World:raycast(origin, direction, maxDistance, hit) end

--- Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the point.
---@param restPoint number[]|ffi.cdata*
---@param state? kiri.PointState
---@return kiri.PointState
function Sheet:getPoint(restPoint, state) end

--- Gets the shape functions at a rest point: up to `capacity` frames with weights, sum 1, and gradients (2 floats,
--- 1/m; gradients null: none). *count: all. KIRI_ERROR_ARGUMENT: outside the sheet. KIRI_ERROR_STATE: a cut is
--- pending.
---@param restPoint number[]|ffi.cdata*
---@return kiri.Frame[]
---@return number[]
---@return number[]
function Sheet:getWeights(restPoint) end

--- Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index.
---@param piece integer
---@param state? kiri.PieceState
---@return kiri.PieceState
function Sheet:getPiece(piece, state) end

--- Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index.
---@param piece integer
---@param mesh? kiri.PieceMesh
---@return kiri.PieceMesh
function Sheet:getPieceMesh(piece, mesh) end

--- Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.
---@param piece integer
---@return kiri.Array
function Sheet:getPieceFrames(piece) end

--- Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.
---@return integer
function Frame:getPiece() end

--- Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay with the
--- old sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut is pending, or
--- the budget lacks samples for the piece; *detached is 0, further cuts of the sheet wait, and
--- KIRI_EVENT_PIECE_DETACHED names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the sheet
--- (manual, cutting).
---@return kiri.Sheet?
function Frame:detachPiece() end

--- Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles stay
--- with three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all of its
--- sheet.
---@return boolean # work is left for later ticks
function Frame:destroyPiece() end

--- Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
--- KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
--- pending.
---@param frames kiri.Frame[]|ffi.cdata*
---@param count? integer
---@return kiri.Sheet[]
function World:detachPieces(frames, count) end

--- Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
--- KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
--- pending.
---@param frames kiri.Frame[]|ffi.cdata*
---@param count? integer
---@return boolean # work is left for later ticks
function World:destroyPieces(frames, count) end

--- Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. *count: their number.
---@param area number
---@return integer
function Sheet:dropCrumbs(area) end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
---@param restPoint number[]|ffi.cdata*
---@return kiri.Cut
function Sheet:beginCut(restPoint) end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
---@param restPoints number[]|ffi.cdata*
---@param count? integer
---@return boolean # work is left for later ticks
function Cut:extend(restPoints, count) end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
---@return boolean # work is left for later ticks
function Cut:finish() end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
---@param restPoints number[]|ffi.cdata*
---@param count? integer
---@return kiri.Cut
function Sheet:cut(restPoints, count) end

--- Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2], meets
--- the current sheet; past borders, so that it separates the parts that it crosses. The cut is already ended.
---@param blade number[]|ffi.cdata*
---@return kiri.Cut
function Sheet:slice(blade) end

--- Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
--- inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
---@param preset integer
---@param tearing? kiri.Tearing
---@return kiri.Tearing
function kiri.getTearing(preset, tearing) end

--- Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
--- inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
---@param tearing? kiri.Tearing
---@return boolean # work is left for later ticks
function Sheet:setTearing(tearing) end

--- Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
--- inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
---@param tearing? kiri.Tearing
---@return kiri.Tearing
function Sheet:getTearing(tearing) end

--- Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a factor, 0 or
--- more: below 1 tears follow it, above 1 they stop there. The same points replace it. KIRI_ERROR_ARGUMENT: no
--- material.
---@param restPoints number[]|ffi.cdata*
---@param factor number
---@param count? integer
---@return boolean # work is left for later ticks
function Sheet:setTearLine(restPoints, factor, count) end

--- A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer, and
--- cuts on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting). `sheet` 0:
--- all.
---@param sheet? kiri.Sheet
---@return kiri.Blade
function World:beginBlade(sheet) end

--- Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
--- each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
---@param from number[]|ffi.cdata*
---@param to number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Blade:moveEdge(from, to) end

--- Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
--- each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
---@param origin number[]|ffi.cdata*
---@param direction number[]|ffi.cdata*
---@param length number
---@return boolean # work is left for later ticks
function Blade:moveRay(origin, direction, length) end

--- Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
--- each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
---@return boolean # work is left for later ticks
function Blade:finish() end

--- Writes up to `capacity` ids of the sheet's frames; *count is how many there are.
---@return kiri.Frame[]
function Sheet:getFrames() end

--- Holds the frame: its rest point moves evenly to `position` (m, world) with `rotation` (columns as above) in the
--- next tick; position and rotation null: frees it. Material that held frames mostly carry moves through obstacles.
---@param position? number[]|ffi.cdata*
---@param rotation? number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Frame:hold(position, rotation) end

--- Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
--- over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free
--- frame.
---@param state? kiri.FrameState
---@return kiri.FrameState
function Frame:getState(state) end

--- Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
--- over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free
--- frame.
---@param force? number[]|ffi.cdata*
---@param torque? number[]|ffi.cdata*
---@return ffi.cdata*
---@return ffi.cdata*
function Frame:getReaction(force, torque) end

--- Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).
---@param force number[]|ffi.cdata*
---@param torque number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Frame:applyForce(force, torque) end

--- Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).
---@param restPoint number[]|ffi.cdata*
---@param force number[]|ffi.cdata*
---@param torque number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Sheet:applyForce(restPoint, force, torque) end

--- Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges
--- included. Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of kiriSheet_ClampLine.
---@param from number[]|ffi.cdata*
---@param to number[]|ffi.cdata*
---@param forcePerLength number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Sheet:applyLineLoad(from, to, forcePerLength) end

--- Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it.
---@param pressure number
---@return boolean # work is left for later ticks
function Sheet:applyPressure(pressure) end

--- Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of the
--- frames that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the sheet.
---@param restPoint number[]|ffi.cdata*
---@param impulse number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Sheet:applyImpulse(restPoint, impulse) end

--- Copies the wind; it blows until the next call.
---@param wind? kiri.Wind
---@return boolean # work is left for later ticks
function Sheet:setWind(wind) end

--- Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
---@param def? kiri.PinDef
---@return kiri.PinDef
function kiri.defaultPinDef(def) end

--- Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
---@param def? kiri.PinDef
---@return kiri.Pin
function Sheet:createPin(def) end

--- Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
---@return boolean # work is left for later ticks
function Pin:destroy() end

--- Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material,
--- as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far
--- outside.
---@param from number[]|ffi.cdata*
---@param to number[]|ffi.cdata*
---@return kiri.Pin
function Sheet:clampLine(from, to) end

--- Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material,
--- as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far
--- outside.
---@param from number[]|ffi.cdata*
---@param to number[]|ffi.cdata*
---@return kiri.Pin
function Sheet:hingeLine(from, to) end

--- Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
--- (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
--- moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
---@param target number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Pin:setTarget(target) end

--- Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
--- (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
--- moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
---@param target number[]|ffi.cdata*
---@param rotation number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Pin:setPose(target, rotation) end

--- Sets the force (N) that breaks a pin of any type; 0: it never breaks.
---@param breakForce number
---@return boolean # work is left for later ticks
function Pin:setBreakForce(breakForce) end

--- Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it.
---@param state? kiri.PinState
---@return kiri.PinState
function Pin:getState(state) end

--- Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it.
---@param force? number[]|ffi.cdata*
---@param torque? number[]|ffi.cdata*
---@return ffi.cdata*
---@return ffi.cdata*
function Pin:getReaction(force, torque) end

--- Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are.
---@return kiri.Pin[]
function Sheet:getPins() end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
---@param def? kiri.SeamDef
---@return kiri.SeamDef
function kiri.defaultSeamDef(def) end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
---@param def? kiri.SeamDef
---@return kiri.Seam
function World:createSeam(def) end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
---@return boolean # work is left for later ticks
function Seam:destroy() end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
---@param stiffness number
---@param restAngle number
---@return boolean # work is left for later ticks
function Seam:setHinge(stiffness, restAngle) end

--- Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.
---@param index integer
---@param stitch? kiri.Stitch
---@return kiri.Stitch
function Seam:getStitch(index, stitch) end

--- Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.
---@return integer
function Seam:getCount() end

--- Writes up to `capacity` ids of the world's seams; *count is how many there are.
---@return kiri.Seam[]
function World:getSeams() end

--- Sets the contacts of the next tick alone. One with point and obstacle of an earlier one starts with its impulse.
---@param contacts kiri.Contact[]|ffi.cdata*
---@param count? integer
---@return boolean # work is left for later ticks
function Sheet:setContacts(contacts, count) end

--- Gets one result for each contact that was set before the last tick, in that order. A sleeping piece presses on.
---@return kiri.Array
function Sheet:getContactForces() end

--- Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
---@param def? kiri.ObstacleDef
---@return kiri.ObstacleDef
function kiri.defaultObstacleDef(def) end

--- Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
---@param def? kiri.ObstacleDef
---@return kiri.Obstacle
function World:createObstacle(def) end

--- Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
---@return boolean # work is left for later ticks
function Obstacle:destroy() end

--- Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity), not to the jump.
---@param position number[]|ffi.cdata*
---@param rotation number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Obstacle:setPose(position, rotation) end

--- Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
---@param velocity number[]|ffi.cdata*
---@param angularVelocity number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Obstacle:setVelocity(velocity, angularVelocity) end

--- Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
---@param velocity number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Obstacle:setSurfaceVelocity(velocity) end

--- Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
---@param mass number
---@param inertia number[]|ffi.cdata*
---@param centerOfMass number[]|ffi.cdata*
---@return boolean # work is left for later ticks
function Obstacle:setMass(mass, inertia, centerOfMass) end

--- Gets the current state.
---@param state? kiri.ObstacleState
---@return kiri.ObstacleState
function Obstacle:getState(state) end

--- Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add their way.
---@param dt number
---@param lower? number[]|ffi.cdata*
---@param upper? number[]|ffi.cdata*
---@return ffi.cdata*
---@return ffi.cdata*
function Sheet:getReach(dt, lower, upper) end

--- Fill the struct with its defaults; draw the world as after the last tick. This only reads, and takes no memory.
---@param draw? kiri.DebugDraw
---@return kiri.DebugDraw
function kiri.defaultDebugDraw(draw) end

return kiri
