// Made from kiri.h by `make bindings`.
using System;

namespace Kiri
{
    /// <summary>An array of the library, without a copy. It may be used until the next tick.</summary>
    public unsafe struct ContactForceView
    {
        readonly World world;
        readonly int epoch;
        readonly ContactForce* rows;
        readonly int length;

        internal ContactForceView(World world, void* rows, int length)
        {
            this.world = world;
            this.epoch = world.Epoch;
            this.rows = (ContactForce*)rows;
            this.length = rows == null ? 0 : length;
        }

        /// <summary>Where it is. Nothing guards what is read there.</summary>
        public ContactForce* Pointer
        {
            get
            {
                if (world != null && world.Epoch != epoch) World.ThrowStale();
                return rows;
            }
        }

        public int Length { get { return length; } }
        public bool IsNull { get { return rows == null; } }

        public ContactForce this[int i]
        {
            get
            {
                if ((uint)i >= (uint)length) World.ThrowRange();
                return Pointer[i];
            }
        }

        /// <summary>Copies so many, from the first on.</summary>
        public void CopyTo(ContactForce[] into)
        {
            if (into.Length < length) World.ThrowRange();
            ContactForce* from = Pointer;
            for (int i = 0; i < length; ++i) into[i] = from[i];
        }

        public ContactForce[] ToArray()
        {
            var into = new ContactForce[length];
            CopyTo(into);
            return into;
        }
#if NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER

        /// <summary>Nothing guards it after this.</summary>
        public ReadOnlySpan<ContactForce> AsSpan() { return new ReadOnlySpan<ContactForce>(Pointer, length); }
#endif

        public Enumerator GetEnumerator() { return new Enumerator(this); }

        public struct Enumerator
        {
            readonly ContactForceView of;
            int at;

            internal Enumerator(ContactForceView of) { this.of = of; at = -1; }
            public bool MoveNext() { return ++at < of.length; }
            public ContactForce Current { get { return of[at]; } }
        }
    }

    /// <summary>An array of the library, without a copy. It may be used until the next tick.</summary>
    public unsafe struct EventView
    {
        readonly World world;
        readonly int epoch;
        readonly Event* rows;
        readonly int length;

        internal EventView(World world, void* rows, int length)
        {
            this.world = world;
            this.epoch = world.Epoch;
            this.rows = (Event*)rows;
            this.length = rows == null ? 0 : length;
        }

        /// <summary>Where it is. Nothing guards what is read there.</summary>
        public Event* Pointer
        {
            get
            {
                if (world != null && world.Epoch != epoch) World.ThrowStale();
                return rows;
            }
        }

        public int Length { get { return length; } }
        public bool IsNull { get { return rows == null; } }

        public Event this[int i]
        {
            get
            {
                if ((uint)i >= (uint)length) World.ThrowRange();
                return Pointer[i];
            }
        }

        /// <summary>Copies so many, from the first on.</summary>
        public void CopyTo(Event[] into)
        {
            if (into.Length < length) World.ThrowRange();
            Event* from = Pointer;
            for (int i = 0; i < length; ++i) into[i] = from[i];
        }

        public Event[] ToArray()
        {
            var into = new Event[length];
            CopyTo(into);
            return into;
        }
#if NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER

        /// <summary>Nothing guards it after this.</summary>
        public ReadOnlySpan<Event> AsSpan() { return new ReadOnlySpan<Event>(Pointer, length); }
#endif

        public Enumerator GetEnumerator() { return new Enumerator(this); }

        public struct Enumerator
        {
            readonly EventView of;
            int at;

            internal Enumerator(EventView of) { this.of = of; at = -1; }
            public bool MoveNext() { return ++at < of.length; }
            public Event Current { get { return of[at]; } }
        }
    }

    /// <summary>An array of the library, without a copy. It may be used until the next tick.</summary>
    public unsafe struct FrameIdView
    {
        readonly World world;
        readonly int epoch;
        readonly FrameId* rows;
        readonly int length;

        internal FrameIdView(World world, void* rows, int length)
        {
            this.world = world;
            this.epoch = world.Epoch;
            this.rows = (FrameId*)rows;
            this.length = rows == null ? 0 : length;
        }

        /// <summary>Where it is. Nothing guards what is read there.</summary>
        public FrameId* Pointer
        {
            get
            {
                if (world != null && world.Epoch != epoch) World.ThrowStale();
                return rows;
            }
        }

        public int Length { get { return length; } }
        public bool IsNull { get { return rows == null; } }

        public FrameId this[int i]
        {
            get
            {
                if ((uint)i >= (uint)length) World.ThrowRange();
                return Pointer[i];
            }
        }

        /// <summary>Copies so many, from the first on.</summary>
        public void CopyTo(FrameId[] into)
        {
            if (into.Length < length) World.ThrowRange();
            FrameId* from = Pointer;
            for (int i = 0; i < length; ++i) into[i] = from[i];
        }

        public FrameId[] ToArray()
        {
            var into = new FrameId[length];
            CopyTo(into);
            return into;
        }
#if NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER

        /// <summary>Nothing guards it after this.</summary>
        public ReadOnlySpan<FrameId> AsSpan() { return new ReadOnlySpan<FrameId>(Pointer, length); }
#endif

        public Enumerator GetEnumerator() { return new Enumerator(this); }

        public struct Enumerator
        {
            readonly FrameIdView of;
            int at;

            internal Enumerator(FrameIdView of) { this.of = of; at = -1; }
            public bool MoveNext() { return ++at < of.length; }
            public FrameId Current { get { return of[at]; } }
        }
    }

    /// <summary>An array of the library, without a copy. It may be used until the next tick.</summary>
    public unsafe struct FloatView
    {
        readonly World world;
        readonly int epoch;
        readonly float* rows;
        readonly int length;

        internal FloatView(World world, void* rows, int length)
        {
            this.world = world;
            this.epoch = world.Epoch;
            this.rows = (float*)rows;
            this.length = rows == null ? 0 : length;
        }

        /// <summary>Where it is. Nothing guards what is read there.</summary>
        public float* Pointer
        {
            get
            {
                if (world != null && world.Epoch != epoch) World.ThrowStale();
                return rows;
            }
        }

        public int Length { get { return length; } }
        public bool IsNull { get { return rows == null; } }

        public float this[int i]
        {
            get
            {
                if ((uint)i >= (uint)length) World.ThrowRange();
                return Pointer[i];
            }
        }

        /// <summary>Copies so many, from the first on.</summary>
        public void CopyTo(float[] into)
        {
            if (into.Length < length) World.ThrowRange();
            float* from = Pointer;
            for (int i = 0; i < length; ++i) into[i] = from[i];
        }

        public float[] ToArray()
        {
            var into = new float[length];
            CopyTo(into);
            return into;
        }
#if NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER

        /// <summary>Nothing guards it after this.</summary>
        public ReadOnlySpan<float> AsSpan() { return new ReadOnlySpan<float>(Pointer, length); }
#endif

        public Enumerator GetEnumerator() { return new Enumerator(this); }

        public struct Enumerator
        {
            readonly FloatView of;
            int at;

            internal Enumerator(FloatView of) { this.of = of; at = -1; }
            public bool MoveNext() { return ++at < of.length; }
            public float Current { get { return of[at]; } }
        }
    }

    /// <summary>An array of the library, without a copy. It may be used until the next tick.</summary>
    public unsafe struct IntView
    {
        readonly World world;
        readonly int epoch;
        readonly int* rows;
        readonly int length;

        internal IntView(World world, void* rows, int length)
        {
            this.world = world;
            this.epoch = world.Epoch;
            this.rows = (int*)rows;
            this.length = rows == null ? 0 : length;
        }

        /// <summary>Where it is. Nothing guards what is read there.</summary>
        public int* Pointer
        {
            get
            {
                if (world != null && world.Epoch != epoch) World.ThrowStale();
                return rows;
            }
        }

        public int Length { get { return length; } }
        public bool IsNull { get { return rows == null; } }

        public int this[int i]
        {
            get
            {
                if ((uint)i >= (uint)length) World.ThrowRange();
                return Pointer[i];
            }
        }

        /// <summary>Copies so many, from the first on.</summary>
        public void CopyTo(int[] into)
        {
            if (into.Length < length) World.ThrowRange();
            int* from = Pointer;
            for (int i = 0; i < length; ++i) into[i] = from[i];
        }

        public int[] ToArray()
        {
            var into = new int[length];
            CopyTo(into);
            return into;
        }
#if NETSTANDARD2_1_OR_GREATER || NETCOREAPP || UNITY_2021_2_OR_NEWER

        /// <summary>Nothing guards it after this.</summary>
        public ReadOnlySpan<int> AsSpan() { return new ReadOnlySpan<int>(Pointer, length); }
#endif

        public Enumerator GetEnumerator() { return new Enumerator(this); }

        public struct Enumerator
        {
            readonly IntView of;
            int at;

            internal Enumerator(IntView of) { this.of = of; at = -1; }
            public bool MoveNext() { return ++at < of.length; }
            public int Current { get { return of[at]; } }
        }
    }

    /// <summary>The triangles that are seen, as after the last tick. revision grows whenever indices or vertices are added or
    /// changed. Rest positions are floats, 6e-8 of the distance from the origin of the rest plane apart: where
    /// triangles are not much larger than that, they look flat or inverted. The library computes with the positions of
    /// the def to 2^-29 of the sheet; sourceTriangles and sourceWeights are as exact as the sheet is large.</summary>
    public unsafe struct MeshView
    {
        readonly World world;
        readonly NativeMesh raw;

        internal MeshView(World world, NativeMesh raw) { this.world = world; this.raw = raw; epoch = world.Epoch; }
        readonly int epoch;

        World Now()
        {
            if (world.Epoch != epoch) World.ThrowStale();
            return world;
        }

        /// <summary>3 a vertex, m, world</summary>
        public FloatView Positions { get { return new FloatView(Now(), raw.positions, 3 * raw.vertexCount); } }

        /// <summary>3 a vertex, unit; null where the sheet makes none</summary>
        public FloatView Normals { get { return new FloatView(Now(), raw.normals, 3 * raw.vertexCount); } }

        /// <summary>2 a vertex, m</summary>
        public FloatView RestPositions { get { return new FloatView(Now(), raw.restPositions, 2 * raw.vertexCount); } }

        /// <summary>3 a triangle</summary>
        public IntView Indices { get { return new IntView(Now(), raw.indices, 3 * raw.triangleCount); } }

        /// <summary>1 a vertex: the triangle of the def that it lies in,</summary>
        public IntView SourceTriangles { get { return new IntView(Now(), raw.sourceTriangles, raw.vertexCount); } }

        /// <summary>3 a vertex: and its barycentric coordinates there</summary>
        public FloatView SourceWeights { get { return new FloatView(Now(), raw.sourceWeights, 3 * raw.vertexCount); } }

        public int VertexCount { get { return raw.vertexCount; } }

        public int TriangleCount { get { return raw.triangleCount; } }

        public uint Revision { get { return raw.Revision; } }
    }

    /// <summary>The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the lips of cuts.
    /// First come the vertices of kiriMesh on the side that the normal leaves, then the same on the other side, then
    /// four for each edge of the border, so that rims are flat and their edges sharp.</summary>
    public unsafe struct SolidView
    {
        readonly World world;
        readonly NativeSolid raw;

        internal SolidView(World world, NativeSolid raw) { this.world = world; this.raw = raw; epoch = world.Epoch; }
        readonly int epoch;

        World Now()
        {
            if (world.Epoch != epoch) World.ThrowStale();
            return world;
        }

        /// <summary>3 a vertex, m, world</summary>
        public FloatView Positions { get { return new FloatView(Now(), raw.positions, 3 * raw.vertexCount); } }

        /// <summary>3 a vertex, unit, outwards</summary>
        public FloatView Normals { get { return new FloatView(Now(), raw.normals, 3 * raw.vertexCount); } }

        /// <summary>2 a vertex, m</summary>
        public FloatView RestPositions { get { return new FloatView(Now(), raw.restPositions, 2 * raw.vertexCount); } }

        /// <summary>3 a triangle, counter-clockwise from outside</summary>
        public IntView Indices { get { return new IntView(Now(), raw.indices, 3 * raw.triangleCount); } }

        /// <summary>1 a vertex: that of kiriMesh which it stands on</summary>
        public IntView Sources { get { return new IntView(Now(), raw.sources, raw.vertexCount); } }

        public int VertexCount { get { return raw.vertexCount; } }

        public int TriangleCount { get { return raw.triangleCount; } }

        /// <summary>from this one on triangles are rims</summary>
        public int RimTriangle { get { return raw.RimTriangle; } }
    }

    /// <summary>What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece after piece.</summary>
    public unsafe struct PieceMeshView
    {
        readonly World world;
        readonly NativePieceMesh raw;

        internal PieceMeshView(World world, NativePieceMesh raw) { this.world = world; this.raw = raw; epoch = world.Epoch; }
        readonly int epoch;

        World Now()
        {
            if (world.Epoch != epoch) World.ThrowStale();
            return world;
        }

        /// <summary>of kiriMesh</summary>
        public IntView Vertices { get { return new IntView(Now(), raw.vertices, raw.vertexCount); } }

        /// <summary>of kiriMesh</summary>
        public IntView Triangles { get { return new IntView(Now(), raw.triangles, raw.triangleCount); } }

        /// <summary>3 a triangle, as in kiriMesh: draw them</summary>
        public IntView Indices { get { return new IntView(Now(), raw.indices, 3 * raw.triangleCount); } }

        /// <summary>see kiriSheet_GetCollisionPoints</summary>
        public IntView CollisionPoints { get { return new IntView(Now(), raw.collisionPoints, raw.collisionPointCount); } }

        public int VertexCount { get { return raw.vertexCount; } }

        public int TriangleCount { get { return raw.triangleCount; } }

        public int CollisionPointCount { get { return raw.collisionPointCount; } }
    }

    public sealed unsafe partial class World
    {
        public Blade Get(BladeId id) { return new Blade(this, id); }
        public Cut Get(CutId id) { return new Cut(this, id); }
        public Frame Get(FrameId id) { return new Frame(this, id); }
        public Obstacle Get(ObstacleId id) { return new Obstacle(this, id); }
        public Pin Get(PinId id) { return new Pin(this, id); }
        public Sheet Get(SheetId id) { return new Sheet(this, id); }

        /// <summary>One fixed step of dt seconds (1e-6 to 10), solved in `substeps` equal parts (1 to 64). Takes the waiting cut
        /// points, then moves every sheet. KIRI_PENDING: the budget is spent and more work waits: the events say which
        /// cuts; a sheet, or some of its pieces, may also have stood still for want of iterations. KIRI_ERROR_MEMORY:
        /// nothing moved; cuts and pieces still wait, call again. Refused work is prepared again: until then
        /// kiriSheet_GetWeights gives KIRI_ERROR_STATE, and with a budget a cut may take effect some ticks later than
        /// it would have. KIRI_ERROR_LIMIT: the same, and it stays so until frames are destroyed. KIRI_DIVERGED: the
        /// sheets named by the events were put to rest, the others moved. Work may wait then, too, as
        /// KIRI_EVENT_DEFERRED says.</summary>
        public Status Tick(float dt, int substeps)
        {
            int result;
            EndViews();
            result = Check(Native.kiriWorld_Tick(Handle, dt, substeps));
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>m/s^2. All pieces wake.</summary>
        public void SetGravity(Float3 gravity)
        {
            Check(Native.kiriWorld_SetGravity(Handle, (float*)&gravity));
        }

        /// <summary>Moves the origin of the world to a point (m): subtracts it from the positions of sheets, targets of pins and
        /// holds, obstacles, blades, and contacts that wait. The motion goes on as before, to rounding. Nothing wakes;
        /// (0, 0, 0) changes nothing. Use it in large worlds: far from the origin floats lose places. The host shifts
        /// its own data itself. Arrays that the library handed out keep the old positions until the next tick.
        /// KIRI_ERROR_ARGUMENT: a position would not fit a float. KIRI_ERROR_MEMORY: nothing has changed.</summary>
        public void ShiftOrigin(Float3 origin)
        {
            Check(Native.kiriWorld_ShiftOrigin(Handle, (float*)&origin));
        }

        /// <summary>Takes effect with the next tick.</summary>
        public void SetBudget(Budget budget)
        {
            Check(Native.kiriWorld_SetBudget(Handle, &budget));
        }

        /// <summary>A hash of everything that the coming ticks depend on, work that waits for its budget included: two worlds
        /// that got the same calls have the same hash, and two with the same hash go on alike. After a refused
        /// allocation some items are made again: the hash tells that while work waits, or while the budget limits cells
        /// or samples.</summary>
        public ulong GetStateHash()
        {
            ulong hashValue = 0;
            CheckRead(Native.kiriWorld_GetStateHash(Handle, &hashValue));
            return hashValue;
        }

        /// <summary>Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there
        /// are.</summary>
        public int GetSheets(SheetId[] sheets)
        {
            int count = 0;
            fixed (SheetId* sheetsRows = sheets)
            {
                CheckRead(Native.kiriWorld_GetSheets(Handle, sheetsRows, (sheets == null ? 0 : sheets.Length), &count));
            }
            return count;
        }

        public SheetId[] GetSheets()
        {
            var sheets = new SheetId[GetSheets(null)];
            GetSheets(sheets);
            return sheets;
        }

        /// <summary>Puts some bytes of the host's own (1 to KIRI_MOST_NOTE_BYTES) in the recording, where a replay finds them:
        /// what its camera saw, what a player pressed. The world does not change; without a recording nothing happens.</summary>
        public void Note(byte[] bytes)
        {
            fixed (byte* bytesRows = bytes)
            {
                Check(Native.kiriWorld_Note(Handle, bytesRows, bytes.Length));
            }
        }

        /// <summary>Writes the world, which only is read. *size: bytes of the save. `bytes` null: they are counted only, and
        /// capacity is not read; else it has room for `capacity`. KIRI_ERROR_ARGUMENT: that is less than *size; nothing
        /// is written. KIRI_PENDING: a cut is being worked on; *size is 0, and nothing is written. Save after a later
        /// tick, or after kiriWorld_FinishCuts.</summary>
        public long Save(byte[] bytes)
        {
            long size = 0;
            fixed (byte* bytesRows = bytes)
            {
                CheckRead(Native.kiriWorld_Save(Handle, bytesRows, (bytes == null ? 0 : bytes.Length), &size));
            }
            return size;
        }

        public byte[] Save()
        {
            var bytes = new byte[Save(null)];
            Save(bytes);
            return bytes;
        }

        /// <summary>Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts that wait for a
        /// budget take effect. The next tick reports the events. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
        /// kiriWorld_Tick. Arrays that the world handed out end as with a tick.</summary>
        public void FinishCuts()
        {
            Check(Native.kiriWorld_FinishCuts(Handle));
        }

        /// <summary>Replaces the world by a saved one. It may have any hooks; its own allocation, log, clock and tasks stay. The
        /// bytes may come from anybody: a malicious save may give a strange world but cannot crash the program, and
        /// takes memory in proportion to its size. Takes about as long as to create the sheets. The profile has no
        /// times until the next tick. Arrays that the old world handed out live until then. KIRI_ERROR_DATA: the bytes
        /// are not a save, damaged, or of another version. KIRI_ERROR_MEMORY. Then nothing has changed. A recording has
        /// the bytes, up to 2^31 of them.</summary>
        public void Load(byte[] bytes)
        {
            fixed (byte* bytesRows = bytes)
            {
                Check(Native.kiriWorld_Load(Handle, bytesRows, bytes.Length));
            }
        }

        /// <summary>For rollback: copies all of the world, also work on cuts and pieces that wait, into memory of the host. Much
        /// faster than a save, and exact to the bit. The bytes are good for this process only: never store or send
        /// them. Arguments as of kiriWorld_Save.</summary>
        public long Snapshot(byte[] bytes)
        {
            long size = 0;
            fixed (byte* bytesRows = bytes)
            {
                CheckRead(Native.kiriWorld_Snapshot(Handle, bytesRows, (bytes == null ? 0 : bytes.Length), &size));
            }
            return size;
        }

        public byte[] Snapshot()
        {
            var bytes = new byte[Snapshot(null)];
            Snapshot(bytes);
            return bytes;
        }

        /// <summary>Replaces the world by the world of the snapshot; ids name the same things. The bytes are trusted: hand over
        /// only the output of kiriWorld_Snapshot. KIRI_ERROR_DATA: not a snapshot of this build of the library.
        /// KIRI_ERROR_MEMORY. KIRI_ERROR_STATE: the world is recorded. Then nothing has changed. Hooks and arrays as
        /// with kiriWorld_Load.</summary>
        public void Restore(byte[] bytes)
        {
            fixed (byte* bytesRows = bytes)
            {
                Check(Native.kiriWorld_Restore(Handle, bytesRows, bytes.Length));
            }
        }

        /// <summary>*events points to *count events.</summary>
        public EventView GetEvents()
        {
            Event* eventsValue = null;
            int count = 0;
            CheckRead(Native.kiriWorld_GetEvents(Handle, &eventsValue, &count));
            return new EventView(this, eventsValue, count);
        }

        /// <summary>Of the last tick that was not refused.</summary>
        public Profile GetProfile()
        {
            var profileValue = new Profile();
            CheckRead(Native.kiriWorld_GetProfile(Handle, &profileValue));
            return profileValue;
        }

        /// <summary>Adds a sheet. On failure *sheet is 0. KIRI_ERROR_MESH: the triangles do not form a sheet. The line names a
        /// triangle, or the two triangles at an edge, by their numbers in the def, and says why.</summary>
        public Sheet CreateSheet(float[] restPositions, int[] indices, SheetDef @def, float[] framePoints = null)
        {
            @def.vertexCount = restPositions.Length / 2;
            @def.triangleCount = indices.Length / 3;
            if (framePoints != null) @def.FrameCount = framePoints.Length / 2;
            var sheetValue = new SheetId();
            fixed (float* restPositionsRows = restPositions)
            fixed (int* indicesRows = indices)
            fixed (float* framePointsRows = framePoints)
            {
                @def.restPositions = restPositionsRows;
                @def.indices = indicesRows;
                @def.framePoints = framePointsRows;
                Check(Native.kiriCreateSheet(Handle, &@def, &sheetValue));
            }
            return new Sheet(this, sheetValue);
        }

        /// <summary>A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows
        /// triangles; columns and rows are 1 to 4096. def: all but the mesh, which is not read; null: the defaults. A
        /// recording has it as kiriCreateSheet.</summary>
        public Sheet CreateRectangle(float width, float height, int columns, int rows, SheetDef? @def = null)
        {
            SheetDef defValue = @def.GetValueOrDefault();
            var sheetValue = new SheetId();
            Check(Native.kiriCreateRectangle(Handle, width, height, columns, rows, @def.HasValue ? &defValue : null, &sheetValue));
            return new Sheet(this, sheetValue);
        }

        /// <summary>The first sheet that a ray meets; *sheet is 0 where there is none.</summary>
        public bool Raycast(Float3 origin, Float3 direction, float maxDistance, out Sheet sheet, out Hit hit)
        {
            var sheetValue = new SheetId();
            var hitValue = new Hit();
            CheckRead(Native.kiriWorld_Raycast(Handle, (float*)&origin, (float*)&direction, maxDistance, &sheetValue, &hitValue));
            sheet = new Sheet(this, sheetValue);
            hit = hitValue;
            return hitValue.Triangle >= 0;
        }

        /// <summary>The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece
        /// count once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together.
        /// detached[i] is the sheet that the piece of frames[i] has become, 0 where it waits.</summary>
        public Status DetachPieces(FrameId[] frames, SheetId[] detached, int count = -1)
        {
            int result;
            World.CheckRoom(detached, frames.Length);
            if (count < 0) count = frames.Length;
            if (count > frames.Length) World.ThrowRange();
            fixed (FrameId* framesRows = frames)
            fixed (SheetId* detachedRows = detached)
            {
                result = Check(Native.kiriWorld_DetachPieces(Handle, framesRows, count, detachedRows));
            }
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece
        /// count once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together.
        /// detached[i] is the sheet that the piece of frames[i] has become, 0 where it waits.</summary>
        public Status DestroyPieces(FrameId[] frames, int count = -1)
        {
            int result;
            if (count < 0) count = frames.Length;
            if (count > frames.Length) World.ThrowRange();
            fixed (FrameId* framesRows = frames)
            {
                result = Check(Native.kiriWorld_DestroyPieces(Handle, framesRows, count));
            }
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of their own. A
        /// blade for one sheet whose sheet is gone cuts nothing.</summary>
        public Blade BeginBlade(SheetId sheet)
        {
            var bladeValue = new BladeId();
            Check(Native.kiriBeginBlade(Handle, sheet, &bladeValue));
            return new Blade(this, bladeValue);
        }

        /// <summary>Adds an obstacle. On failure *obstacle is 0.</summary>
        public Obstacle CreateObstacle(ObstacleDef @def, float[] outline = null)
        {
            if (outline != null) @def.outlineCount = outline.Length / 2;
            var obstacleValue = new ObstacleId();
            fixed (float* outlineRows = outline)
            {
                @def.outline = outlineRows;
                Check(Native.kiriCreateObstacle(Handle, &@def, &obstacleValue));
            }
            return new Obstacle(this, obstacleValue);
        }
    }

    /// <summary>Functions without a world.</summary>
    public static unsafe partial class Library
    {

        /// <summary>The name of a result, "KIRI_OK" and so on; "unknown" for another number.</summary>
        public static string GetResultName(ResultCode result)
        {
            return World.Text(Native.kiriGetResultName((int)result));
        }

        /// <summary>One line: the meaning of a result, and its cure. For calls without a world that keeps a line, such as
        /// kiriCreateWorld with a def of zeros (KIRI_ERROR_DEF).</summary>
        public static string GetResultText(ResultCode result)
        {
            return World.Text(Native.kiriGetResultText((int)result));
        }

        /// <summary>For hosts that would rather think in time than in items: the budget whose work would have taken so many
        /// microseconds a tick at the pace of the profile, which may be the sum of several. Work on cuts and linear
        /// systems share the time as they did in the profile, and each of triangles, cells and samples gets what the
        /// three took together, see kiriBudget. Each item that the profile has some of is set; others stay. The
        /// simulation never reads a clock: the choice is the host's, and a replay must hand in the same budgets.</summary>
        public static void FitBudget(Profile profile, float microseconds, ref Budget budget)
        {
            fixed (Budget* budgetValue = &budget)
            {
                World.CheckStatic(Native.kiriFitBudget(&profile, microseconds, budgetValue));
            }
        }

        /// <summary>The name of a stage, for tables; "" for a number that is none.</summary>
        public static string GetStageName(Stage stage)
        {
            return World.Text(Native.kiriGetStageName((int)stage));
        }

        /// <summary>The numbers of a preset, KIRI_MATERIAL_...</summary>
        public static Material GetMaterial(MaterialPreset preset)
        {
            var materialValue = new Material();
            World.CheckStatic(Native.kiriGetMaterial((int)preset, &materialValue));
            return materialValue;
        }

        /// <summary>The numbers of a preset, KIRI_QUALITY_...</summary>
        public static Quality GetQuality(QualityPreset preset)
        {
            var qualityValue = new Quality();
            World.CheckStatic(Native.kiriGetQuality((int)preset, &qualityValue));
            return qualityValue;
        }

        /// <summary>A rectangle from (0, 0) to (width, height) for a sheet def: writes 2 * (columns + 1) * (rows + 1) floats and
        /// 6 * columns * rows indices. columns and rows are 1 to 4096.</summary>
        public static void FillRectangle(float width, float height, int columns, int rows, out float[] restPositions, out int[] indices)
        {
            restPositions = new float[2 * (Math.Max(0, Math.Min(columns, 4096)) + 1) * (Math.Max(0, Math.Min(rows, 4096)) + 1)];
            indices = new int[6 * Math.Max(0, Math.Min(columns, 4096)) * Math.Max(0, Math.Min(rows, 4096))];
            fixed (float* restPositionsRows = restPositions)
            fixed (int* indicesRows = indices)
            {
                World.CheckStatic(Native.kiriFillRectangle(width, height, columns, rows, restPositionsRows, indicesRows));
            }
        }
    }

    public unsafe partial struct Sheet : IEquatable<Sheet>
    {
        public readonly World World;
        public readonly SheetId Id;

        internal Sheet(World world, SheetId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Sheet other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Sheet && Equals((Sheet)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator SheetId(Sheet handle) { return handle.Id; }

        /// <summary>The sheet is gone, with its cuts, frames and pins; their ids are stale.</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroySheet(World.Handle, Id));
        }

        /// <summary>What they are now, stamped for kiriSheet_SetSettings.</summary>
        public SheetSettings GetSettings()
        {
            var settingsValue = new SheetSettings();
            World.CheckRead(Native.kiriSheet_GetSettings(World.Handle, Id, &settingsValue));
            return settingsValue;
        }

        /// <summary>Checked as the def is: all or nothing. KIRI_ERROR_DEF: they did not come from GetSettings. The sheet wakes
        /// where one is other than before. Places and velocities stay: with another mass so momentum changes.
        /// Stiffnesses that pins have, and the lengths that frames were spread by, stay as they are.</summary>
        public void SetSettings(SheetSettings settings)
        {
            World.Check(Native.kiriSheet_SetSettings(World.Handle, Id, &settings));
        }

        /// <summary>The arrays, without a copy.</summary>
        public MeshView GetMesh()
        {
            var meshValue = new NativeMesh();
            World.CheckRead(Native.kiriSheet_GetMesh(World.Handle, Id, &meshValue));
            return new MeshView(World, meshValue);
        }

        /// <summary>What changed since the host saw that revision; all of the mesh where that is too long ago, or 0.</summary>
        public Dirty GetDirty(uint sinceRevision)
        {
            var dirtyValue = new Dirty();
            World.CheckRead(Native.kiriSheet_GetDirty(World.Handle, Id, sinceRevision, &dirtyValue));
            return dirtyValue;
        }

        /// <summary>Copies the index that some vertices had when the last call of kiriWorld_Tick began, for hosts that draw
        /// between two ticks. *from: the sheet that had them then, which is another one if this sheet was a piece of
        /// it. A vertex that a cut tore off another one gets the index of the other. -1: the vertex did not exist; so
        /// all vertices of a sheet that was created or loaded since. The manual has the code (drawing).</summary>
        public Sheet CopyPrevious(int first, int[] vertices, int count = -1)
        {
            if (count < 0) count = vertices.Length;
            if (count > vertices.Length) World.ThrowRange();
            var fromValue = new SheetId();
            fixed (int* verticesRows = vertices)
            {
                World.CheckRead(Native.kiriSheet_CopyPrevious(World.Handle, Id, first, count, verticesRows, &fromValue));
            }
            return new Sheet(World, fromValue);
        }

        /// <summary>Copies the indices of some triangles, 3 each, as 16-bit numbers. KIRI_ERROR_STATE: there are more than 65535
        /// vertices.</summary>
        public void CopyIndices16(int firstTriangle, ushort[] indices, int count = -1)
        {
            if (count < 0) count = indices.Length / 3;
            if (count > indices.Length / 3) World.ThrowRange();
            fixed (ushort* indicesRows = indices)
            {
                World.CheckRead(Native.kiriSheet_CopyIndices16(World.Handle, Id, firstTriangle, count, indicesRows));
            }
        }

        /// <summary>Map triangles to the def, to draw with data that the host keeps by its own vertices. Sources: the triangle
        /// of the def that contains each; -1 for one that has left (its corners are equal). Weights: 9 floats each, the
        /// barycentric coordinates of its three corners in that triangle. They are right on both sides of a seam that
        /// weldDistance has closed; sourceTriangles name a triangle on one side. The manual has the code (meshes).</summary>
        public void CopySources(int firstTriangle, int[] sources, int count = -1)
        {
            if (count < 0) count = sources.Length;
            if (count > sources.Length) World.ThrowRange();
            fixed (int* sourcesRows = sources)
            {
                World.CheckRead(Native.kiriSheet_CopySources(World.Handle, Id, firstTriangle, count, sourcesRows));
            }
        }

        /// <summary>Map triangles to the def, to draw with data that the host keeps by its own vertices. Sources: the triangle
        /// of the def that contains each; -1 for one that has left (its corners are equal). Weights: 9 floats each, the
        /// barycentric coordinates of its three corners in that triangle. They are right on both sides of a seam that
        /// weldDistance has closed; sourceTriangles name a triangle on one side. The manual has the code (meshes).</summary>
        public void CopySourceWeights(int firstTriangle, float[] weights, int count = -1)
        {
            if (count < 0) count = weights.Length / 9;
            if (count > weights.Length / 9) World.ThrowRange();
            fixed (float* weightsRows = weights)
            {
                World.CheckRead(Native.kiriSheet_CopySourceWeights(World.Handle, Id, firstTriangle, count, weightsRows));
            }
        }

        /// <summary>thickness: m, 0: that of the material. Made when it is asked for.</summary>
        public SolidView GetSolid(float thickness)
        {
            var solidValue = new NativeSolid();
            World.Check(Native.kiriSheet_GetSolid(World.Handle, Id, thickness, &solidValue));
            return new SolidView(World, solidValue);
        }

        /// <summary>Collision points: 3 floats of position (m, world) a point.</summary>
        public FloatView GetCollisionPoints()
        {
            float* positionsValue = null;
            int count = 0;
            World.CheckRead(Native.kiriSheet_GetCollisionPoints(World.Handle, Id, &positionsValue, &count));
            return new FloatView(World, positionsValue, 3 * count);
        }

        /// <summary>Costs nothing.</summary>
        public Counts GetCounts()
        {
            var countsValue = new Counts();
            World.CheckRead(Native.kiriSheet_GetCounts(World.Handle, Id, &countsValue));
            return countsValue;
        }

        /// <summary>Sums over the frames, made when they are asked for.</summary>
        public Totals GetTotals()
        {
            var totalsValue = new Totals();
            World.CheckRead(Native.kiriSheet_GetTotals(World.Handle, Id, &totalsValue));
            return totalsValue;
        }

        /// <summary>An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly: rms distance
        /// from where a sheet of very many frames would be under the same loads, over the rms way that it has gone from
        /// its flat shape; 0 to 1, and 1 where there are too few frames to tell. It compares the strains of
        /// neighbouring links (KIRI_MODEL_LINKS only; else KIRI_ERROR_STATE). Measured on cantilevers and on a sheet
        /// with a slit, of 3 to 140 frames, it is not below a third of the error, and not above four times the error
        /// or, where that is below 0.5 %, 1.5 %. Where a sheet also turned as a whole, as by hanging from two corners,
        /// it says up to ten times too much. It knows nothing of errors of the grid, of time stepping, and of loads
        /// that are finer than frames. It takes memory and time for one pass over the links, when it is called.</summary>
        public double EstimateError()
        {
            double relativeValue = 0;
            World.CheckRead(Native.kiriSheet_EstimateError(World.Handle, Id, &relativeValue));
            return relativeValue;
        }

        /// <summary>*awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do.
        /// kiriSheet_Wake wakes all of them.</summary>
        public bool IsAwake()
        {
            int awakeValue = 0;
            World.CheckRead(Native.kiriSheet_IsAwake(World.Handle, Id, &awakeValue));
            return awakeValue != 0;
        }

        /// <summary>*awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do.
        /// kiriSheet_Wake wakes all of them.</summary>
        public void Wake()
        {
            World.Check(Native.kiriSheet_Wake(World.Handle, Id));
        }

        /// <summary>Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities turn. The
        /// columns of `rotation` are where R takes the axes of the world; a planar sheet turns about its normal only.
        /// It wakes. Targets of its pins, hinges, clamps and holds go along, so nothing draws it back. To set a target
        /// to its current value changes nothing. A target that the host has set nearer to the new place of the pin than
        /// to the old one stays: so the host may set targets before or after. Pins on an obstacle stay on it: put the
        /// obstacle elsewhere by the same motion (kiriObstacle_SetPose), before or after. Loads and contacts that wait
        /// for the next tick stay.</summary>
        public void Transform(Float9 rotation, Float3 translation)
        {
            World.Check(Native.kiriSheet_Transform(World.Handle, Id, (float*)&rotation, (float*)&translation));
        }

        /// <summary>From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
        /// `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow
        /// their hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone.</summary>
        public void SetVelocity(Float3 velocity, Float3 angularVelocity)
        {
            World.Check(Native.kiriSheet_SetVelocity(World.Handle, Id, (float*)&velocity, (float*)&angularVelocity));
        }

        /// <summary>A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        /// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        /// the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.</summary>
        public void SetUserData(ulong data)
        {
            World.Check(Native.kiriSheet_SetUserData(World.Handle, Id, data));
        }

        /// <summary>A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        /// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        /// the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.</summary>
        public ulong GetUserData()
        {
            ulong dataValue = 0;
            World.CheckRead(Native.kiriSheet_GetUserData(World.Handle, Id, &dataValue));
            return dataValue;
        }

        /// <summary>Where a ray first meets the sheet, up to maxDistance. KIRI_OK with hit-&gt;triangle = -1: nowhere. The first
        /// ray looks at every triangle; the next tick makes boxes over them, and as long as somebody asks every now and
        /// then (in 120 ticks) they follow the sheet: a ray takes some microseconds, and a tick of a large sheet a
        /// quarter more.</summary>
        public bool Raycast(Float3 origin, Float3 direction, float maxDistance, out Hit hit)
        {
            var hitValue = new Hit();
            World.CheckRead(Native.kiriSheet_Raycast(World.Handle, Id, (float*)&origin, (float*)&direction, maxDistance, &hitValue));
            hit = hitValue;
            return hitValue.Triangle >= 0;
        }

        /// <summary>Outside the sheet: KIRI_ERROR_ARGUMENT. On a cut, the lip that holds the point; either where both do.</summary>
        public PointState GetPoint(Float2 restPoint)
        {
            var stateValue = new PointState();
            World.CheckRead(Native.kiriSheet_GetPoint(World.Handle, Id, (float*)&restPoint, &stateValue));
            return stateValue;
        }

        /// <summary>The shape functions at a rest point: up to `capacity` frames with their weights (sum 1) and, unless null,
        /// gradients (2 floats a frame, 1/m). *count is how many there are, however many fit. Outside the sheet:
        /// KIRI_ERROR_ARGUMENT; while work on a cut waits for its budget: KIRI_ERROR_STATE.</summary>
        public int GetWeights(Float2 restPoint, FrameId[] frames, float[] weights, float[] gradients)
        {
            World.CheckRoom(weights, 1 * frames.Length);
            World.CheckRoom(gradients, 2 * frames.Length);
            int count = 0;
            fixed (FrameId* framesRows = frames)
            fixed (float* weightsRows = weights)
            fixed (float* gradientsRows = gradients)
            {
                World.CheckRead(Native.kiriSheet_GetWeights(World.Handle, Id, (float*)&restPoint, framesRows, weightsRows, gradientsRows, (frames == null ? 0 : frames.Length), &count));
            }
            return count;
        }

        /// <summary>The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An
        /// index that is no piece's: KIRI_ERROR_ARGUMENT.</summary>
        public PieceState GetPiece(int piece)
        {
            var stateValue = new PieceState();
            World.Check(Native.kiriSheet_GetPiece(World.Handle, Id, piece, &stateValue));
            return stateValue;
        }

        /// <summary>The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An
        /// index that is no piece's: KIRI_ERROR_ARGUMENT.</summary>
        public PieceMeshView GetPieceMesh(int piece)
        {
            var meshValue = new NativePieceMesh();
            World.Check(Native.kiriSheet_GetPieceMesh(World.Handle, Id, piece, &meshValue));
            return new PieceMeshView(World, meshValue);
        }

        /// <summary>*frames points to *count ids.</summary>
        public FrameIdView GetPieceFrames(int piece)
        {
            FrameId* framesValue = null;
            int count = 0;
            World.Check(Native.kiriSheet_GetPieceFrames(World.Handle, Id, piece, &framesValue, &count));
            return new FrameIdView(World, framesValue, count);
        }

        /// <summary>Destroys all pieces below an area (m^2) except the largest piece, at the cost of one. *count is how many.
        /// Where that one waits to become a sheet, the largest of the others stays, too.</summary>
        public int DropCrumbs(float area)
        {
            int countValue = 0;
            World.Check(Native.kiriSheet_DropCrumbs(World.Handle, Id, area, &countValue));
            return countValue;
        }

        /// <summary>A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet cuts nothing.
        /// Points wait until the next tick. The end of a cut that lies inside the sheet stays closed until the blade
        /// moves on.</summary>
        public Cut BeginCut(Float2 restPoint)
        {
            var cutValue = new CutId();
            World.Check(Native.kiriBeginCut(World.Handle, Id, (float*)&restPoint, &cutValue));
            return new Cut(World, cutValue);
        }

        /// <summary>A blade (a straight edge) that moves in world space from blade[0]-blade[1] to blade[3]-blade[2] cuts where
        /// the swept quadrilateral meets the sheet as it is now, past borders, so that it parts what it crosses. The
        /// cut is ended already. Slices of a sheet that moves do not join from tick to tick: for that take a blade.</summary>
        public Cut Slice(Float12 blade)
        {
            var cutValue = new CutId();
            World.Check(Native.kiriSheet_Slice(World.Handle, Id, (float*)&blade, &cutValue));
            return new Cut(World, cutValue);
        }

        /// <summary>Writes up to `capacity` ids of the sheet's frames; *count is how many there are.</summary>
        public int GetFrames(FrameId[] frames)
        {
            int count = 0;
            fixed (FrameId* framesRows = frames)
            {
                World.CheckRead(Native.kiriSheet_GetFrames(World.Handle, Id, framesRows, (frames == null ? 0 : frames.Length), &count));
            }
            return count;
        }

        public FrameId[] GetFrames()
        {
            var frames = new FrameId[GetFrames(null)];
            GetFrames(frames);
            return frames;
        }

        /// <summary>A force (N, world) on a point of the material and a torque (N m).</summary>
        public void ApplyForce(Float2 restPoint, Float3 force, Float3 torque)
        {
            World.Check(Native.kiriSheet_ApplyForce(World.Handle, Id, (float*)&restPoint, (float*)&force, (float*)&torque));
        }

        /// <summary>A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in the material,
        /// edges included. Where it runs along a cut, each lip gets half. The ends differ; a line that meets no
        /// material: KIRI_ERROR_ARGUMENT.</summary>
        public void ApplyLineLoad(Float2 from, Float2 to, Float3 forcePerLength)
        {
            World.Check(Native.kiriSheet_ApplyLineLoad(World.Handle, Id, (float*)&from, (float*)&to, (float*)&forcePerLength));
        }

        /// <summary>A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0.</summary>
        public void ApplyPressure(float pressure)
        {
            World.Check(Native.kiriSheet_ApplyPressure(World.Handle, Id, pressure));
        }

        /// <summary>An impulse (N s, world) on a point of the material, where it is seen now. Velocities change at once, by as
        /// much as the frames that carry the point resist; a held frame's part is lost. Outside the sheet:
        /// KIRI_ERROR_ARGUMENT.</summary>
        public void ApplyImpulse(Float2 restPoint, Float3 impulse)
        {
            World.Check(Native.kiriSheet_ApplyImpulse(World.Handle, Id, (float*)&restPoint, (float*)&impulse));
        }

        /// <summary>Copied; it blows until the next call.</summary>
        public void SetWind(Wind wind)
        {
            World.Check(Native.kiriSheet_SetWind(World.Handle, Id, &wind));
        }

        /// <summary>Pins a point of the sheet. On failure *pin is 0. A point outside the sheet: KIRI_ERROR_ARGUMENT.</summary>
        public Pin CreatePin(PinDef @def)
        {
            var pinValue = new PinId();
            World.Check(Native.kiriCreatePin(World.Handle, Id, &@def, &pinValue));
            return new Pin(World, pinValue);
        }

        /// <summary>Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and
        /// direction of the material there, as a vice does; a hinge its place only, so that the sheet may turn about
        /// the line. Both begin where the material is now; the line stays straight, and as long as it is at rest: so
        /// material that is bent there is pulled straight, and pieces that have come apart are pulled together, however
        /// fast that makes them.
        ///
        /// They hold what the line meets, edges included, with the stiffness that the material has between the line and
        /// the frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of
        /// frames, where kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two
        /// sides, so that neither bends the other. A line that runs along a cut holds both lips; one beside it, by a
        /// 512th of a square of the grid or more, holds one. The ends differ; a line that meets no material:
        /// KIRI_ERROR_ARGUMENT.</summary>
        public Pin ClampLine(Float2 from, Float2 to)
        {
            var clampValue = new PinId();
            World.Check(Native.kiriSheet_ClampLine(World.Handle, Id, (float*)&from, (float*)&to, &clampValue));
            return new Pin(World, clampValue);
        }

        /// <summary>Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and
        /// direction of the material there, as a vice does; a hinge its place only, so that the sheet may turn about
        /// the line. Both begin where the material is now; the line stays straight, and as long as it is at rest: so
        /// material that is bent there is pulled straight, and pieces that have come apart are pulled together, however
        /// fast that makes them.
        ///
        /// They hold what the line meets, edges included, with the stiffness that the material has between the line and
        /// the frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of
        /// frames, where kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two
        /// sides, so that neither bends the other. A line that runs along a cut holds both lips; one beside it, by a
        /// 512th of a square of the grid or more, holds one. The ends differ; a line that meets no material:
        /// KIRI_ERROR_ARGUMENT.</summary>
        public Pin HingeLine(Float2 from, Float2 to)
        {
            var hingeValue = new PinId();
            World.Check(Native.kiriSheet_HingeLine(World.Handle, Id, (float*)&from, (float*)&to, &hingeValue));
            return new Pin(World, hingeValue);
        }

        /// <summary>Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are.</summary>
        public int GetPins(PinId[] pins)
        {
            int count = 0;
            fixed (PinId* pinsRows = pins)
            {
                World.CheckRead(Native.kiriSheet_GetPins(World.Handle, Id, pinsRows, (pins == null ? 0 : pins.Length), &count));
            }
            return count;
        }

        public PinId[] GetPins()
        {
            var pins = new PinId[GetPins(null)];
            GetPins(pins);
            return pins;
        }

        /// <summary>The contacts of the next tick; they replace those of an earlier call, and are gone after the tick. A contact
        /// is known again by its point, or its rest point, and its obstacle: what it pushed with is where the next tick
        /// starts.</summary>
        public void SetContacts(Contact[] contacts, int count = -1)
        {
            if (count < 0) count = contacts.Length;
            if (count > contacts.Length) World.ThrowRange();
            fixed (Contact* contactsRows = contacts)
            {
                World.Check(Native.kiriSheet_SetContacts(World.Handle, Id, contactsRows, count));
            }
        }

        /// <summary>One for each contact that was set before the last tick, in the order given. The sum of the impulses, with
        /// those of gravity, loads and obstacles, is the change of momentum of a piece that nothing holds. A piece that
        /// sleeps goes on to press with what it fell asleep with.</summary>
        public ContactForceView GetContactForces()
        {
            ContactForce* forcesValue = null;
            int count = 0;
            World.CheckRead(Native.kiriSheet_GetContactForces(World.Handle, Id, &forcesValue, &count));
            return new ContactForceView(World, forcesValue, count);
        }

        /// <summary>The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no obstacles or
        /// contacts outside. It reaches as far around the sheet as its fastest point can go by its velocity and
        /// gravity, twice, and the contact thickness. Obstacles that move themselves come as much nearer. dt as in
        /// kiriWorld_Tick.</summary>
        public void GetReach(float dt, out Float3 lower, out Float3 upper)
        {
            var lowerValue = new Float3();
            var upperValue = new Float3();
            World.CheckRead(Native.kiriSheet_GetReach(World.Handle, Id, dt, (float*)&lowerValue, (float*)&upperValue));
            lower = lowerValue;
            upper = upperValue;
        }
    }

    public unsafe partial struct Frame : IEquatable<Frame>
    {
        public readonly World World;
        public readonly FrameId Id;

        internal Frame(World world, FrameId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Frame other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Frame && Equals((Frame)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator FrameId(Frame handle) { return handle.Id; }

        /// <summary>From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
        /// `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow
        /// their hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone.</summary>
        public void SetPieceVelocity(Float3 velocity, Float3 angularVelocity)
        {
            World.Check(Native.kiriFrame_SetPieceVelocity(World.Handle, Id, (float*)&velocity, (float*)&angularVelocity));
        }

        /// <summary>A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        /// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        /// the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.</summary>
        public void SetPieceUserData(ulong data)
        {
            World.Check(Native.kiriFrame_SetPieceUserData(World.Handle, Id, data));
        }

        /// <summary>A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        /// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        /// the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.</summary>
        public ulong GetPieceUserData()
        {
            ulong dataValue = 0;
            World.CheckRead(Native.kiriFrame_GetPieceUserData(World.Handle, Id, &dataValue));
            return dataValue;
        }

        /// <summary>The index that the piece with this frame has now.</summary>
        public int GetPiece()
        {
            int pieceValue = 0;
            World.CheckRead(Native.kiriFrame_GetPiece(World.Handle, Id, &pieceValue));
            return pieceValue;
        }

        /// <summary>Makes a sheet of the piece with this frame. Its frames, pins and collision points move along, in their
        /// order; they keep their ids and states, and what waits for the next tick: the motion goes on as if nothing
        /// had happened, but for the solver's guard over energy and step length, which is one for each sheet. A clamp
        /// or hinge that holds both becomes two: the rest keeps the id, the new sheet's has one of its own
        /// (kiriSheet_GetPins). Both sheets have all settings (of collisionPoints and integrationPoints the share that
        /// falls to their area), maxFrames each for itself; a piece that sleeps goes on sleeping. Cuts stay with the
        /// rest: a blade in the piece cuts nothing until it is back. Indices of collision points of the rest change.
        /// Its triangles and vertices keep their indices where it has more than 4096 vertices, and while no more than
        /// half of them are of pieces that went: these triangles have three equal corners, these vertices are of no
        /// triangle. Else all move together, and their indices change. In either case its revision grows, and
        /// kiriSheet_GetDirty says what changed. The new sheet has the squares of the grid around it, at about 40 bytes
        /// a square: crumbs are better dropped. Costs what the piece takes to make, and a look at the weights of what
        /// is left; where indices change more. KIRI_PENDING: work on a cut is at hand in the sheet, or it takes more
        /// samples than the budget leaves calls before the next tick; *detached is 0. When the work is done, what is
        /// the piece of this frame then becomes a sheet, and KIRI_EVENT_PIECE_DETACHED names it. Samples pay for it
        /// before, over several ticks if need be, of many pieces one after the other: of the first that waits 3 for
        /// each vertex, 2.5 to 9 for each cell (the more frames, the more) and 100 for each frame, of others 3 for each
        /// vertex and 1.4 for each cell; and one for 80 vertices of the rest. Until then further cuts of the sheet
        /// wait. The first piece is made as it is paid, and leaves at the start of the tick after the last sample is
        /// paid. That tick does an eighth of the work; the first tick after a load makes the parts again that saves
        /// leave out. The coming ticks have fewer samples for the work of calls. KIRI_ERROR_STATE: nothing would be
        /// left of the sheet.</summary>
        public Sheet DetachPiece()
        {
            var detachedValue = new SheetId();
            World.Check(Native.kiriFrame_DetachPiece(World.Handle, Id, &detachedValue));
            return new Sheet(World, detachedValue);
        }

        /// <summary>The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but for making a
        /// sheet: that is done at once, and the coming ticks have less. Where kiriSheet_GetMesh has been called since
        /// the last tick, all indices are copied. KIRI_PENDING: work on a cut is at hand. The piece is gone all the
        /// same: its triangles are in kiriMesh, with three equal corners; it touches nothing; no point of it is found.
        /// When the work is done its vertices go, too; until then kiriCounts still counts it, and its kiriPieceState is
        /// all zeros.</summary>
        public Status DestroyPiece()
        {
            int result;
            result = World.Check(Native.kiriFrame_DestroyPiece(World.Handle, Id));
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>Pose, motion and region as they are now.</summary>
        public FrameState GetState()
        {
            var stateValue = new FrameState();
            World.CheckRead(Native.kiriFrame_GetState(World.Handle, Id, &stateValue));
            return stateValue;
        }

        /// <summary>The host moves the frame: its rest point, as it is seen, goes to `position` with `rotation` (a rotation
        /// matrix, columns as above) in the next tick, evenly, and stays there until the next call. An affine frame is
        /// not stretched then. On a planar sheet the rotation is about its normal. Null, null: it is free again.
        /// Contacts do not push material that held frames carry for more than half: it goes where the host has it,
        /// through obstacles too.</summary>
        public void Hold(Float3? position = null, Float9? rotation = null)
        {
            Float3 positionValue = position.GetValueOrDefault();
            Float9 rotationValue = rotation.GetValueOrDefault();
            World.Check(Native.kiriFrame_Hold(World.Handle, Id, position.HasValue ? (float*)&positionValue : null, rotation.HasValue ? (float*)&rotationValue : null));
        }

        /// <summary>With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the frame's rest
        /// point; means over the last tick, impulses divided by its dt. They carry the frame's own weight and change
        /// its momentum, too. Zero for a frame that was free. A piece that sleeps keeps those that it fell asleep with.</summary>
        public void GetReaction(out Double3 force, out Double3 torque)
        {
            var forceValue = new Double3();
            var torqueValue = new Double3();
            World.CheckRead(Native.kiriFrame_GetReaction(World.Handle, Id, (double*)&forceValue, (double*)&torqueValue));
            force = forceValue;
            torque = torqueValue;
        }

        /// <summary>A force (N, world) on the frame's centre of mass and a torque (N m).</summary>
        public void ApplyForce(Float3 force, Float3 torque)
        {
            World.Check(Native.kiriFrame_ApplyForce(World.Handle, Id, (float*)&force, (float*)&torque));
        }
    }

    public unsafe partial struct Pin : IEquatable<Pin>
    {
        public readonly World World;
        public readonly PinId Id;

        internal Pin(World world, PinId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Pin other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Pin && Equals((Pin)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator PinId(Pin handle) { return handle.Id; }

        /// <summary>A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        /// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        /// the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.</summary>
        public void SetUserData(ulong data)
        {
            World.Check(Native.kiriPin_SetUserData(World.Handle, Id, data));
        }

        /// <summary>A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
        /// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames:
        /// the parts of a piece that is cut have that of the piece, as does a sheet that is made of it.</summary>
        public ulong GetUserData()
        {
            ulong dataValue = 0;
            World.CheckRead(Native.kiriPin_GetUserData(World.Handle, Id, &dataValue));
            return dataValue;
        }

        /// <summary>Where the pin holds its point, or the middle of its line (m, world): at the end of the next tick, and until
        /// the next call. Within the tick it goes there evenly. The current target of kiriPin_GetState changes nothing.
        /// With KIRI_SKINNING_SMOOTH what pins and clamps hold is what is seen there; of a clamp the mean along its
        /// line, for each piece: single points of the line are seen a little off it.</summary>
        public void SetTarget(Float3 target)
        {
            World.Check(Native.kiriPin_SetTarget(World.Handle, Id, (float*)&target));
        }

        /// <summary>The same with the rotation of the line's material: columns are the directions of u and v and the normal. On
        /// a planar sheet it is about the sheet's normal. KIRI_ERROR_ARGUMENT for a pin that holds a point.</summary>
        public void SetPose(Float3 target, Float9 rotation)
        {
            World.Check(Native.kiriPin_SetPose(World.Handle, Id, (float*)&target, (float*)&rotation));
        }

        /// <summary>As in the def, for pins of all types; N, 0: it never breaks.</summary>
        public void SetBreakForce(float breakForce)
        {
            World.Check(Native.kiriPin_SetBreakForce(World.Handle, Id, breakForce));
        }

        /// <summary>What it is, and where it holds now.</summary>
        public PinState GetState()
        {
            var stateValue = new PinState();
            World.CheckRead(Native.kiriPin_GetState(World.Handle, Id, &stateValue));
            return stateValue;
        }

        /// <summary>With what the pin acted on the sheet: force (N, world) and torque (N m) about its target; means over the
        /// last tick, impulses divided by its dt. So the reactions of all pins and held frames are the weight of a
        /// sheet at rest, and in motion what changes its momentum (as far as `iterations` have the tick solved). Zero
        /// before the first tick. A piece that sleeps keeps those that it fell asleep with.</summary>
        public void GetReaction(out Double3 force, out Double3 torque)
        {
            var forceValue = new Double3();
            var torqueValue = new Double3();
            World.CheckRead(Native.kiriPin_GetReaction(World.Handle, Id, (double*)&forceValue, (double*)&torqueValue));
            force = forceValue;
            torque = torqueValue;
        }

        /// <summary>It lets go; its id is stale.</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroyPin(World.Handle, Id));
        }
    }

    public unsafe partial struct Cut : IEquatable<Cut>
    {
        public readonly World World;
        public readonly CutId Id;

        internal Cut(World world, CutId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Cut other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Cut && Equals((Cut)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator CutId(Cut handle) { return handle.Id; }

        /// <summary>restPoints: 2 floats a point; count is 1 to 2^24.</summary>
        public void Extend(float[] restPoints, int count = -1)
        {
            if (count < 0) count = restPoints.Length / 2;
            if (count > restPoints.Length / 2) World.ThrowRange();
            fixed (float* restPointsRows = restPoints)
            {
                World.Check(Native.kiriCut_Extend(World.Handle, Id, restPointsRows, count));
            }
        }

        /// <summary>No more points come. After the tick in which the last of them takes effect the id is stale, and
        /// KIRI_EVENT_CUT_FINISHED tells. Frames that the sheet needs after the cut are added then.</summary>
        public void End()
        {
            World.Check(Native.kiriCut_End(World.Handle, Id));
        }
    }

    public unsafe partial struct Blade : IEquatable<Blade>
    {
        public readonly World World;
        public readonly BladeId Id;

        internal Blade(World world, BladeId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Blade other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Blade && Equals((Blade)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator BladeId(Blade handle) { return handle.Id; }

        /// <summary>The blade is now the straight edge between two points (m, world). From where it was it got there straight,
        /// each end along a line. The first call only says where it begins. Where an end of the edge lies inside of
        /// what it sweeps of the sheet, it cuts only what it sweeps. An edge without length cuts nothing.</summary>
        public void MoveEdge(Float3 from, Float3 to)
        {
            World.Check(Native.kiriBlade_MoveEdge(World.Handle, Id, (float*)&from, (float*)&to));
        }

        /// <summary>The same for a ray that a camera casts: an edge `length` m long.</summary>
        public void MoveRay(Float3 origin, Float3 direction, float length)
        {
            World.Check(Native.kiriBlade_MoveRay(World.Handle, Id, (float*)&origin, (float*)&direction, length));
        }

        /// <summary>It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends.</summary>
        public void End()
        {
            World.Check(Native.kiriBlade_End(World.Handle, Id));
        }
    }

    public unsafe partial struct Obstacle : IEquatable<Obstacle>
    {
        public readonly World World;
        public readonly ObstacleId Id;

        internal Obstacle(World world, ObstacleId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Obstacle other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Obstacle && Equals((Obstacle)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator ObstacleId(Obstacle handle) { return handle.Id; }

        /// <summary>It is gone, its id stale. What rested on it wakes.</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroyObstacle(World.Handle, Id));
        }

        /// <summary>Where it is when the next tick starts. It did not move there: velocities alone say what sheets feel.
        /// rotation: a rotation matrix, columns as in the def.</summary>
        public void SetPose(Float3 position, Float9 rotation)
        {
            World.Check(Native.kiriObstacle_SetPose(World.Handle, Id, (float*)&position, (float*)&rotation));
        }

        /// <summary>With what it moves in the next tick and from then on.</summary>
        public void SetVelocity(Float3 velocity, Float3 angularVelocity)
        {
            World.Check(Native.kiriObstacle_SetVelocity(World.Handle, Id, (float*)&velocity, (float*)&angularVelocity));
        }

        /// <summary>With what it moves in the next tick and from then on.</summary>
        public void SetSurfaceVelocity(Float3 velocity)
        {
            World.Check(Native.kiriObstacle_SetSurfaceVelocity(World.Handle, Id, (float*)&velocity));
        }

        /// <summary>As in the def.</summary>
        public void SetMass(float mass, Float6 inertia, Float3 centerOfMass)
        {
            World.Check(Native.kiriObstacle_SetMass(World.Handle, Id, mass, (float*)&inertia, (float*)&centerOfMass));
        }

        /// <summary>Pose and velocities as they are now.</summary>
        public ObstacleState GetState()
        {
            var stateValue = new ObstacleState();
            World.CheckRead(Native.kiriObstacle_GetState(World.Handle, Id, &stateValue));
            return stateValue;
        }
    }

}
