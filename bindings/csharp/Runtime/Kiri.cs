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

    /// <summary>The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision grows when
    /// indices or vertices are added or changed. Sources have the precision of the library, 2^-29 of the sheet.</summary>
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

        /// <summary>1 a vertex: the triangle of the def that contains it,</summary>
        public IntView SourceTriangles { get { return new IntView(Now(), raw.sourceTriangles, raw.vertexCount); } }

        /// <summary>3 a vertex: and its barycentric coordinates there</summary>
        public FloatView SourceWeights { get { return new FloatView(Now(), raw.sourceWeights, 3 * raw.vertexCount); } }

        public int VertexCount { get { return raw.vertexCount; } }

        public int TriangleCount { get { return raw.triangleCount; } }

        public uint Revision { get { return raw.Revision; } }
    }

    /// <summary>The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips. First the
    /// vertices of kiriMesh on the side of the normal, then the same on the other side, then four for each border edge.</summary>
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

        /// <summary>1 a vertex: its vertex in kiriMesh</summary>
        public IntView Sources { get { return new IntView(Now(), raw.sources, raw.vertexCount); } }

        public int VertexCount { get { return raw.vertexCount; } }

        public int TriangleCount { get { return raw.triangleCount; } }

        /// <summary>rims begin at this triangle</summary>
        public int RimTriangle { get { return raw.RimTriangle; } }
    }

    /// <summary>The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all pieces, piece by
    /// piece.</summary>
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

        /// <summary>1 a vertex: its index in kiriMesh</summary>
        public IntView Vertices { get { return new IntView(Now(), raw.vertices, raw.vertexCount); } }

        /// <summary>1 a triangle: its index in kiriMesh</summary>
        public IntView Triangles { get { return new IntView(Now(), raw.triangles, raw.triangleCount); } }

        /// <summary>3 a triangle, as in kiriMesh: draw them</summary>
        public IntView Indices { get { return new IntView(Now(), raw.indices, 3 * raw.triangleCount); } }

        /// <summary>1 a point, see kiriSheet_GetCollisionPoints</summary>
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
        public Seam Get(SeamId id) { return new Seam(this, id); }
        public Sheet Get(SheetId id) { return new Sheet(this, id); }

        /// <summary>Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the
        /// pending cut points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that
        /// still have work. KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget).
        /// KIRI_ERROR_LIMIT: no ids are left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED:
        /// events name sheets that were stopped.</summary>
        public Status Tick(float dt, int substeps)
        {
            int result;
            EndViews();
            result = Check(Native.kiriWorld_Tick(Handle, dt, substeps), "World.Tick");
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing
        /// wakes. Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not
        /// fit a float.</summary>
        public void ShiftOrigin(Float3 origin)
        {
            Check(Native.kiriWorld_ShiftOrigin(Handle, (float*)&origin), "World.ShiftOrigin");
        }

        /// <summary>Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.</summary>
        public void SetGravity(Float3 gravity)
        {
            Check(Native.kiriWorld_SetGravity(Handle, (float*)&gravity), "World.SetGravity");
        }

        /// <summary>Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.</summary>
        public void SetBudget(Budget budget)
        {
            Check(Native.kiriWorld_SetBudget(Handle, &budget), "World.SetBudget");
        }

        /// <summary>Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual,
        /// budget).</summary>
        public ulong GetStateHash()
        {
            ulong hashValue = 0;
            CheckRead(Native.kiriWorld_GetStateHash(Handle, &hashValue), "World.GetStateHash");
            return hashValue;
        }

        /// <summary>Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there
        /// are.</summary>
        public int GetSheets(SheetId[] sheets)
        {
            int count = 0;
            fixed (SheetId* sheetsRows = sheets)
            {
                CheckRead(Native.kiriWorld_GetSheets(Handle, sheetsRows, (sheets == null ? 0 : sheets.Length), &count), "World.GetSheets");
            }
            return count;
        }

        public SheetId[] GetSheets()
        {
            var sheets = new SheetId[GetSheets(null)];
            GetSheets(sheets);
            return sheets;
        }

        /// <summary>Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A replay stops
        /// there.</summary>
        public void Note(byte[] bytes)
        {
            fixed (byte* bytesRows = bytes)
            {
                Check(Native.kiriWorld_Note(Handle, bytesRows, bytes.Length), "World.Note");
            }
        }

        /// <summary>Writes the world to memory with room for `capacity`; bytes null: only counts them. *size: bytes of the save.
        /// KIRI_ERROR_ARGUMENT: `capacity` is less. KIRI_PENDING: a cut is pending (kiriWorld_FinishCuts); *size is 0.</summary>
        public long Save(byte[] bytes)
        {
            long size = 0;
            fixed (byte* bytesRows = bytes)
            {
                CheckRead(Native.kiriWorld_Save(Handle, bytesRows, (bytes == null ? 0 : bytes.Length), &size), "World.Save");
            }
            return size;
        }

        public byte[] Save()
        {
            var bytes = new byte[Save(null)];
            Save(bytes);
            return bytes;
        }

        /// <summary>Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports
        /// the events. Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
        /// kiriWorld_Tick.</summary>
        public void FinishCuts()
        {
            Check(Native.kiriWorld_FinishCuts(Handle), "World.FinishCuts");
        }

        /// <summary>Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a malicious save
        /// cannot crash the program, and takes memory in proportion to its size, which is below 2^31. Old arrays live
        /// until the next tick. On failure nothing has changed: KIRI_ERROR_DATA: not a save, damaged, or of another
        /// version. KIRI_ERROR_MEMORY.</summary>
        public void Load(byte[] bytes)
        {
            fixed (byte* bytesRows = bytes)
            {
                Check(Native.kiriWorld_Load(Handle, bytesRows, bytes.Length), "World.Load");
            }
        }

        /// <summary>For rollback: copies all of the world, also work in progress, into memory of the host; much faster than a
        /// save, and exact to the bit. For this process only: never store or send the bytes. bytes null: as of
        /// kiriWorld_Save.</summary>
        public long Snapshot(byte[] bytes)
        {
            long size = 0;
            fixed (byte* bytesRows = bytes)
            {
                CheckRead(Native.kiriWorld_Snapshot(Handle, bytesRows, (bytes == null ? 0 : bytes.Length), &size), "World.Snapshot");
            }
            return size;
        }

        public byte[] Snapshot()
        {
            var bytes = new byte[Snapshot(null)];
            Snapshot(bytes);
            return bytes;
        }

        /// <summary>Replaces the world by the world of the snapshot, as kiriWorld_Load does. The bytes are trusted. On failure
        /// nothing has changed: KIRI_ERROR_DATA: no snapshot of this build. KIRI_ERROR_STATE: it is recorded.
        /// KIRI_ERROR_MEMORY.</summary>
        public void Restore(byte[] bytes)
        {
            fixed (byte* bytesRows = bytes)
            {
                Check(Native.kiriWorld_Restore(Handle, bytesRows, bytes.Length), "World.Restore");
            }
        }

        /// <summary>Gets the events: *events points to *count of them.</summary>
        public EventView GetEvents()
        {
            Event* eventsValue = null;
            int count = 0;
            CheckRead(Native.kiriWorld_GetEvents(Handle, &eventsValue, &count), "World.GetEvents");
            return new EventView(this, eventsValue, count);
        }

        /// <summary>Gets the profile of the last tick that was not refused.</summary>
        public Profile GetProfile()
        {
            var profileValue = new Profile();
            CheckRead(Native.kiriWorld_GetProfile(Handle, &profileValue), "World.GetProfile");
            return profileValue;
        }

        /// <summary>Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins.
        /// On failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the
        /// def.</summary>
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
                Check(Native.kiriCreateSheet(Handle, &@def, &sheetValue), "World.CreateSheet");
            }
            return new Sheet(this, sheetValue);
        }

        /// <summary>Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns
        /// or rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def
        /// null: the defaults.</summary>
        public Sheet CreateRectangle(float width, float height, int columns, int rows, SheetDef? @def = null)
        {
            SheetDef defValue = @def.GetValueOrDefault();
            var sheetValue = new SheetId();
            Check(Native.kiriCreateRectangle(Handle, width, height, columns, rows, @def.HasValue ? &defValue : null, &sheetValue), "World.CreateRectangle");
            return new Sheet(this, sheetValue);
        }

        /// <summary>Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no
        /// material at one.</summary>
        public Sheet CreateFoldedSheet(float[] restPositions, int[] indices, SheetDef @def, Fold[] folds, float[] framePoints = null, int count = -1)
        {
            @def.vertexCount = restPositions.Length / 2;
            @def.triangleCount = indices.Length / 3;
            if (framePoints != null) @def.FrameCount = framePoints.Length / 2;
            if (count < 0) count = folds.Length;
            if (count > folds.Length) World.ThrowRange();
            var sheetValue = new SheetId();
            fixed (float* restPositionsRows = restPositions)
            fixed (int* indicesRows = indices)
            fixed (float* framePointsRows = framePoints)
            fixed (Fold* foldsRows = folds)
            {
                @def.restPositions = restPositionsRows;
                @def.indices = indicesRows;
                @def.framePoints = framePointsRows;
                Check(Native.kiriCreateFoldedSheet(Handle, &@def, foldsRows, count, &sheetValue), "World.CreateFoldedSheet");
            }
            return new Sheet(this, sheetValue);
        }

        /// <summary>Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit-&gt;triangle -1: it
        /// does not.</summary>
        public bool Raycast(Float3 origin, Float3 direction, float maxDistance, out Sheet sheet, out Hit hit)
        {
            var sheetValue = new SheetId();
            var hitValue = new Hit();
            CheckRead(Native.kiriWorld_Raycast(Handle, (float*)&origin, (float*)&direction, maxDistance, &sheetValue, &hitValue), "World.Raycast");
            sheet = new Sheet(this, sheetValue);
            hit = hitValue;
            return hitValue.Triangle >= 0;
        }

        /// <summary>Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
        /// KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i],
        /// 0: pending.</summary>
        public Status DetachPieces(FrameId[] frames, SheetId[] detached, int count = -1)
        {
            int result;
            World.CheckRoom(detached, frames.Length);
            if (count < 0) count = frames.Length;
            if (count > frames.Length) World.ThrowRange();
            fixed (FrameId* framesRows = frames)
            fixed (SheetId* detachedRows = detached)
            {
                result = Check(Native.kiriWorld_DetachPieces(Handle, framesRows, count, detachedRows), "World.DetachPieces");
            }
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
        /// KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i],
        /// 0: pending.</summary>
        public Status DestroyPieces(FrameId[] frames, int count = -1)
        {
            int result;
            if (count < 0) count = frames.Length;
            if (count > frames.Length) World.ThrowRange();
            fixed (FrameId* framesRows = frames)
            {
                result = Check(Native.kiriWorld_DestroyPieces(Handle, framesRows, count), "World.DestroyPieces");
            }
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer,
        /// and cuts on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting).
        /// `sheet` 0: all.</summary>
        public Blade BeginBlade(SheetId sheet)
        {
            var bladeValue = new BladeId();
            Check(Native.kiriBeginBlade(Handle, sheet, &bladeValue), "World.BeginBlade");
            return new Blade(this, bladeValue);
        }

        /// <summary>Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is
        /// 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual,
        /// sewing).</summary>
        public Seam CreateSeam(float[] lineA, float[] lineB, SeamDef @def)
        {
            @def.countA = lineA.Length / 2;
            @def.countB = lineB.Length / 2;
            var seamValue = new SeamId();
            fixed (float* lineARows = lineA)
            fixed (float* lineBRows = lineB)
            {
                @def.lineA = lineARows;
                @def.lineB = lineBRows;
                Check(Native.kiriCreateSeam(Handle, &@def, &seamValue), "World.CreateSeam");
            }
            return new Seam(this, seamValue);
        }

        /// <summary>Writes up to `capacity` ids of the world's seams; *count is how many there are.</summary>
        public int GetSeams(SeamId[] seams)
        {
            int count = 0;
            fixed (SeamId* seamsRows = seams)
            {
                CheckRead(Native.kiriWorld_GetSeams(Handle, seamsRows, (seams == null ? 0 : seams.Length), &count), "World.GetSeams");
            }
            return count;
        }

        public SeamId[] GetSeams()
        {
            var seams = new SeamId[GetSeams(null)];
            GetSeams(seams);
            return seams;
        }

        /// <summary>Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.</summary>
        public Obstacle CreateObstacle(ObstacleDef @def, float[] outline = null)
        {
            if (outline != null) @def.outlineCount = outline.Length / 2;
            var obstacleValue = new ObstacleId();
            fixed (float* outlineRows = outline)
            {
                @def.outline = outlineRows;
                Check(Native.kiriCreateObstacle(Handle, &@def, &obstacleValue), "World.CreateObstacle");
            }
            return new Obstacle(this, obstacleValue);
        }
    }

    /// <summary>Functions without a world.</summary>
    public static unsafe partial class Library
    {

        /// <summary>Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its
        /// meaning.</summary>
        public static string GetResultName(ResultCode result)
        {
            return World.Text(Native.kiriGetResultName((int)result));
        }

        /// <summary>Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its
        /// meaning.</summary>
        public static string GetResultText(ResultCode result)
        {
            return World.Text(Native.kiriGetResultText((int)result));
        }

        /// <summary>Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum of several: half
        /// for cuts, half for motion; all if it has one alone. Limits without recorded work stay. A replay must set the
        /// same budgets.</summary>
        public static void FitBudget(Profile profile, float microseconds, ref Budget budget)
        {
            fixed (Budget* budgetValue = &budget)
            {
                World.CheckStatic(Native.kiriFitBudget(&profile, microseconds, budgetValue), "Library.FitBudget");
            }
        }

        /// <summary>Returns the name of a stage; "" for another number.</summary>
        public static string GetStageName(Stage stage)
        {
            return World.Text(Native.kiriGetStageName((int)stage));
        }

        /// <summary>Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...</summary>
        public static Material GetMaterial(MaterialPreset preset)
        {
            var materialValue = new Material();
            World.CheckStatic(Native.kiriGetMaterial((int)preset, &materialValue), "Library.GetMaterial");
            return materialValue;
        }

        /// <summary>Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...</summary>
        public static Quality GetQuality(QualityPreset preset)
        {
            var qualityValue = new Quality();
            World.CheckStatic(Native.kiriGetQuality((int)preset, &qualityValue), "Library.GetQuality");
            return qualityValue;
        }

        /// <summary>Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of
        /// sheet and its sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual,
        /// accuracy).</summary>
        public static SheetDef GetSetup(SetupPreset preset, float width, float height)
        {
            var defValue = new SheetDef();
            World.CheckStatic(Native.kiriGetSetup((int)preset, width, height, &defValue), "Library.GetSetup");
            return defValue;
        }

        /// <summary>Fills in the mesh of kiriCreateRectangle: 2 (columns + 1) (rows + 1) floats and 6 columns rows indices.</summary>
        public static void FillRectangle(float width, float height, int columns, int rows, out float[] restPositions, out int[] indices)
        {
            restPositions = new float[2 * (Math.Max(0, Math.Min(columns, 4096)) + 1) * (Math.Max(0, Math.Min(rows, 4096)) + 1)];
            indices = new int[6 * Math.Max(0, Math.Min(columns, 4096)) * Math.Max(0, Math.Min(rows, 4096))];
            fixed (float* restPositionsRows = restPositions)
            fixed (int* indicesRows = indices)
            {
                World.CheckStatic(Native.kiriFillRectangle(width, height, columns, rows, restPositionsRows, indicesRows), "Library.FillRectangle");
            }
        }

        /// <summary>Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the
        /// sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS,
        /// another preset.</summary>
        public static Tearing GetTearing(MaterialPreset preset)
        {
            var tearingValue = new Tearing();
            World.CheckStatic(Native.kiriGetTearing((int)preset, &tearingValue), "Library.GetTearing");
            return tearingValue;
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

        /// <summary>Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins.
        /// On failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the
        /// def.</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroySheet(World.Handle, Id), "Sheet.Destroy");
        }

        /// <summary>Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do
        /// not come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.</summary>
        public SheetSettings GetSettings()
        {
            var settingsValue = new SheetSettings();
            World.CheckRead(Native.kiriSheet_GetSettings(World.Handle, Id, &settingsValue), "Sheet.GetSettings");
            return settingsValue;
        }

        /// <summary>Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do
        /// not come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.</summary>
        public void SetSettings(SheetSettings settings)
        {
            World.Check(Native.kiriSheet_SetSettings(World.Handle, Id, &settings), "Sheet.SetSettings");
        }

        /// <summary>Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
        /// KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet.</summary>
        public int AddFold(Fold fold)
        {
            int indexValue = 0;
            World.Check(Native.kiriSheet_AddFold(World.Handle, Id, &fold, &indexValue), "Sheet.AddFold");
            return indexValue;
        }

        /// <summary>A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the
        /// sheet.</summary>
        public FoldState GetFold(int index)
        {
            var stateValue = new FoldState();
            World.CheckRead(Native.kiriSheet_GetFold(World.Handle, Id, index, &stateValue), "Sheet.GetFold");
            return stateValue;
        }

        /// <summary>A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the
        /// sheet.</summary>
        public void SetFold(int index, float stiffness, float restAngle)
        {
            World.Check(Native.kiriSheet_SetFold(World.Handle, Id, index, stiffness, restAngle), "Sheet.SetFold");
        }

        /// <summary>Gets the arrays, without a copy.</summary>
        public MeshView GetMesh()
        {
            var meshValue = new NativeMesh();
            World.CheckRead(Native.kiriSheet_GetMesh(World.Handle, Id, &meshValue), "Sheet.GetMesh");
            return new MeshView(World, meshValue);
        }

        /// <summary>Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore.</summary>
        public Dirty GetDirty(uint sinceRevision)
        {
            var dirtyValue = new Dirty();
            World.CheckRead(Native.kiriSheet_GetDirty(World.Handle, Id, sinceRevision, &dirtyValue), "Sheet.GetDirty");
            return dirtyValue;
        }

        /// <summary>Copies the index that each vertex had when the last tick began, to draw between two ticks; -1: it did not
        /// exist. *from: the sheet that had them then. A vertex that a cut separated has the other's index (manual,
        /// drawing).</summary>
        public Sheet CopyPrevious(int first, int[] vertices, int count = -1)
        {
            if (count < 0) count = vertices.Length;
            if (count > vertices.Length) World.ThrowRange();
            var fromValue = new SheetId();
            fixed (int* verticesRows = vertices)
            {
                World.CheckRead(Native.kiriSheet_CopyPrevious(World.Handle, Id, first, count, verticesRows, &fromValue), "Sheet.CopyPrevious");
            }
            return new Sheet(World, fromValue);
        }

        /// <summary>Copies indices of some triangles as 16-bit numbers, 3 each. KIRI_ERROR_STATE: there are more than 65535
        /// vertices.</summary>
        public void CopyIndices16(int firstTriangle, ushort[] indices, int count = -1)
        {
            if (count < 0) count = indices.Length / 3;
            if (count > indices.Length / 3) World.ThrowRange();
            fixed (ushort* indicesRows = indices)
            {
                World.CheckRead(Native.kiriSheet_CopyIndices16(World.Handle, Id, firstTriangle, count, indicesRows), "Sheet.CopyIndices16");
            }
        }

        /// <summary>Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights:
        /// 9 floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual,
        /// meshes).</summary>
        public void CopySources(int firstTriangle, int[] sources, int count = -1)
        {
            if (count < 0) count = sources.Length;
            if (count > sources.Length) World.ThrowRange();
            fixed (int* sourcesRows = sources)
            {
                World.CheckRead(Native.kiriSheet_CopySources(World.Handle, Id, firstTriangle, count, sourcesRows), "Sheet.CopySources");
            }
        }

        /// <summary>Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights:
        /// 9 floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual,
        /// meshes).</summary>
        public void CopySourceWeights(int firstTriangle, float[] weights, int count = -1)
        {
            if (count < 0) count = weights.Length / 9;
            if (count > weights.Length / 9) World.ThrowRange();
            fixed (float* weightsRows = weights)
            {
                World.CheckRead(Native.kiriSheet_CopySourceWeights(World.Handle, Id, firstTriangle, count, weightsRows), "Sheet.CopySourceWeights");
            }
        }

        /// <summary>Makes the solid surface, with a thickness in m; thickness 0: the material's.</summary>
        public SolidView GetSolid(float thickness)
        {
            var solidValue = new NativeSolid();
            World.Check(Native.kiriSheet_GetSolid(World.Handle, Id, thickness, &solidValue), "Sheet.GetSolid");
            return new SolidView(World, solidValue);
        }

        /// <summary>Gets the collision points: 3 floats of position (m, world) a point.</summary>
        public FloatView GetCollisionPoints()
        {
            float* positionsValue = null;
            int count = 0;
            World.CheckRead(Native.kiriSheet_GetCollisionPoints(World.Handle, Id, &positionsValue, &count), "Sheet.GetCollisionPoints");
            return new FloatView(World, positionsValue, 3 * count);
        }

        /// <summary>Get the counts, at no cost; sum the totals over the frames.</summary>
        public Counts GetCounts()
        {
            var countsValue = new Counts();
            World.CheckRead(Native.kiriSheet_GetCounts(World.Handle, Id, &countsValue), "Sheet.GetCounts");
            return countsValue;
        }

        /// <summary>Get the counts, at no cost; sum the totals over the frames.</summary>
        public Totals GetTotals()
        {
            var totalsValue = new Totals();
            World.CheckRead(Native.kiriSheet_GetTotals(World.Handle, Id, &totalsValue), "Sheet.GetTotals");
            return totalsValue;
        }

        /// <summary>Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not
        /// KIRI_MODEL_LINKS.</summary>
        public double EstimateError()
        {
            double relativeValue = 0;
            World.CheckRead(Native.kiriSheet_EstimateError(World.Handle, Id, &relativeValue), "Sheet.EstimateError");
            return relativeValue;
        }

        /// <summary>Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes
        /// all.</summary>
        public bool IsAwake()
        {
            int awakeValue = 0;
            World.CheckRead(Native.kiriSheet_IsAwake(World.Handle, Id, &awakeValue), "Sheet.IsAwake");
            return awakeValue != 0;
        }

        /// <summary>Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes
        /// all.</summary>
        public void Wake()
        {
            World.Check(Native.kiriSheet_Wake(World.Handle, Id), "Sheet.Wake");
        }

        /// <summary>Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar
        /// sheet turns about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual,
        /// sheets).</summary>
        public void Transform(Float9 rotation, Float3 translation)
        {
            World.Check(Native.kiriSheet_Transform(World.Handle, Id, (float*)&rotation, (float*)&translation), "Sheet.Transform");
        }

        /// <summary>Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its
        /// centre of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held
        /// frames stay held.</summary>
        public void SetVelocity(Float3 velocity, Float3 angularVelocity)
        {
            World.Check(Native.kiriSheet_SetVelocity(World.Handle, Id, (float*)&velocity, (float*)&angularVelocity), "Sheet.SetVelocity");
        }

        /// <summary>Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        /// a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        /// has both.</summary>
        public void SetUserData(ulong data)
        {
            World.Check(Native.kiriSheet_SetUserData(World.Handle, Id, data), "Sheet.SetUserData");
        }

        /// <summary>Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        /// a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        /// has both.</summary>
        public ulong GetUserData()
        {
            ulong dataValue = 0;
            World.CheckRead(Native.kiriSheet_GetUserData(World.Handle, Id, &dataValue), "Sheet.GetUserData");
            return dataValue;
        }

        /// <summary>Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit-&gt;triangle -1: it
        /// does not.</summary>
        public bool Raycast(Float3 origin, Float3 direction, float maxDistance, out Hit hit)
        {
            var hitValue = new Hit();
            World.CheckRead(Native.kiriSheet_Raycast(World.Handle, Id, (float*)&origin, (float*)&direction, maxDistance, &hitValue), "Sheet.Raycast");
            hit = hitValue;
            return hitValue.Triangle >= 0;
        }

        /// <summary>Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the
        /// point.</summary>
        public PointState GetPoint(Float2 restPoint)
        {
            var stateValue = new PointState();
            World.CheckRead(Native.kiriSheet_GetPoint(World.Handle, Id, (float*)&restPoint, &stateValue), "Sheet.GetPoint");
            return stateValue;
        }

        /// <summary>Gets the shape functions at a rest point: up to `capacity` frames with weights, sum 1, and gradients (2
        /// floats, 1/m; gradients null: none). *count: all. KIRI_ERROR_ARGUMENT: outside the sheet. KIRI_ERROR_STATE: a
        /// cut is pending.</summary>
        public int GetWeights(Float2 restPoint, FrameId[] frames, float[] weights, float[] gradients)
        {
            World.CheckRoom(weights, 1 * frames.Length);
            World.CheckRoom(gradients, 2 * frames.Length);
            int count = 0;
            fixed (FrameId* framesRows = frames)
            fixed (float* weightsRows = weights)
            fixed (float* gradientsRows = gradients)
            {
                World.CheckRead(Native.kiriSheet_GetWeights(World.Handle, Id, (float*)&restPoint, framesRows, weightsRows, gradientsRows, (frames == null ? 0 : frames.Length), &count), "Sheet.GetWeights");
            }
            return count;
        }

        /// <summary>Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the
        /// index.</summary>
        public PieceState GetPiece(int piece)
        {
            var stateValue = new PieceState();
            World.Check(Native.kiriSheet_GetPiece(World.Handle, Id, piece, &stateValue), "Sheet.GetPiece");
            return stateValue;
        }

        /// <summary>Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the
        /// index.</summary>
        public PieceMeshView GetPieceMesh(int piece)
        {
            var meshValue = new NativePieceMesh();
            World.Check(Native.kiriSheet_GetPieceMesh(World.Handle, Id, piece, &meshValue), "Sheet.GetPieceMesh");
            return new PieceMeshView(World, meshValue);
        }

        /// <summary>Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.</summary>
        public FrameIdView GetPieceFrames(int piece)
        {
            FrameId* framesValue = null;
            int count = 0;
            World.Check(Native.kiriSheet_GetPieceFrames(World.Handle, Id, piece, &framesValue, &count), "Sheet.GetPieceFrames");
            return new FrameIdView(World, framesValue, count);
        }

        /// <summary>Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. *count: their
        /// number.</summary>
        public int DropCrumbs(float area)
        {
            int countValue = 0;
            World.Check(Native.kiriSheet_DropCrumbs(World.Handle, Id, area, &countValue), "Sheet.DropCrumbs");
            return countValue;
        }

        /// <summary>Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        /// once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        /// nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        /// point (KIRI_EVENT_CUT_FINISHED).</summary>
        public Cut BeginCut(Float2 restPoint)
        {
            var cutValue = new CutId();
            World.Check(Native.kiriBeginCut(World.Handle, Id, (float*)&restPoint, &cutValue), "Sheet.BeginCut");
            return new Cut(World, cutValue);
        }

        /// <summary>Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        /// once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        /// nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        /// point (KIRI_EVENT_CUT_FINISHED).</summary>
        public Cut Cut(float[] restPoints, int count = -1)
        {
            if (count < 0) count = restPoints.Length / 2;
            if (count > restPoints.Length / 2) World.ThrowRange();
            var cutValue = new CutId();
            fixed (float* restPointsRows = restPoints)
            {
                World.Check(Native.kiriSheet_Cut(World.Handle, Id, restPointsRows, count, &cutValue), "Sheet.Cut");
            }
            return new Cut(World, cutValue);
        }

        /// <summary>Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2],
        /// meets the current sheet; past borders, so that it separates the parts that it crosses. The cut is already
        /// ended.</summary>
        public Cut Slice(Float12 blade)
        {
            var cutValue = new CutId();
            World.Check(Native.kiriSheet_Slice(World.Handle, Id, (float*)&blade, &cutValue), "Sheet.Slice");
            return new Cut(World, cutValue);
        }

        /// <summary>Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the
        /// sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS,
        /// another preset.</summary>
        public void SetTearing(Tearing tearing)
        {
            World.Check(Native.kiriSheet_SetTearing(World.Handle, Id, &tearing), "Sheet.SetTearing");
        }

        /// <summary>Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the
        /// sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS,
        /// another preset.</summary>
        public Tearing GetTearing()
        {
            var tearingValue = new Tearing();
            World.CheckRead(Native.kiriSheet_GetTearing(World.Handle, Id, &tearingValue), "Sheet.GetTearing");
            return tearingValue;
        }

        /// <summary>Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a
        /// factor, 0 or more: below 1 tears follow it, above 1 they stop there. The same points replace it.
        /// KIRI_ERROR_ARGUMENT: no material.</summary>
        public void SetTearLine(float[] restPoints, float factor, int count = -1)
        {
            if (count < 0) count = restPoints.Length / 2;
            if (count > restPoints.Length / 2) World.ThrowRange();
            fixed (float* restPointsRows = restPoints)
            {
                World.Check(Native.kiriSheet_SetTearLine(World.Handle, Id, restPointsRows, count, factor), "Sheet.SetTearLine");
            }
        }

        /// <summary>Writes up to `capacity` ids of the sheet's frames; *count is how many there are.</summary>
        public int GetFrames(FrameId[] frames)
        {
            int count = 0;
            fixed (FrameId* framesRows = frames)
            {
                World.CheckRead(Native.kiriSheet_GetFrames(World.Handle, Id, framesRows, (frames == null ? 0 : frames.Length), &count), "Sheet.GetFrames");
            }
            return count;
        }

        public FrameId[] GetFrames()
        {
            var frames = new FrameId[GetFrames(null)];
            GetFrames(frames);
            return frames;
        }

        /// <summary>Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).</summary>
        public void ApplyForce(Float2 restPoint, Float3 force, Float3 torque)
        {
            World.Check(Native.kiriSheet_ApplyForce(World.Handle, Id, (float*)&restPoint, (float*)&force, (float*)&torque), "Sheet.ApplyForce");
        }

        /// <summary>Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges
        /// included. Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of kiriSheet_ClampLine.</summary>
        public void ApplyLineLoad(Float2 from, Float2 to, Float3 forcePerLength)
        {
            World.Check(Native.kiriSheet_ApplyLineLoad(World.Handle, Id, (float*)&from, (float*)&to, (float*)&forcePerLength), "Sheet.ApplyLineLoad");
        }

        /// <summary>Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it.</summary>
        public void ApplyPressure(float pressure)
        {
            World.Check(Native.kiriSheet_ApplyPressure(World.Handle, Id, pressure), "Sheet.ApplyPressure");
        }

        /// <summary>Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of
        /// the frames that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the
        /// sheet.</summary>
        public void ApplyImpulse(Float2 restPoint, Float3 impulse)
        {
            World.Check(Native.kiriSheet_ApplyImpulse(World.Handle, Id, (float*)&restPoint, (float*)&impulse), "Sheet.ApplyImpulse");
        }

        /// <summary>Copies the wind; it blows until the next call.</summary>
        public void SetWind(Wind wind)
        {
            World.Check(Native.kiriSheet_SetWind(World.Handle, Id, &wind), "Sheet.SetWind");
        }

        /// <summary>Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT:
        /// outside.</summary>
        public Pin CreatePin(PinDef @def)
        {
            var pinValue = new PinId();
            World.Check(Native.kiriCreatePin(World.Handle, Id, &@def, &pinValue), "Sheet.CreatePin");
            return new Pin(World, pinValue);
        }

        /// <summary>Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its
        /// material, as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends
        /// equal, or far outside.</summary>
        public Pin ClampLine(Float2 from, Float2 to)
        {
            var clampValue = new PinId();
            World.Check(Native.kiriSheet_ClampLine(World.Handle, Id, (float*)&from, (float*)&to, &clampValue), "Sheet.ClampLine");
            return new Pin(World, clampValue);
        }

        /// <summary>Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its
        /// material, as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends
        /// equal, or far outside.</summary>
        public Pin HingeLine(Float2 from, Float2 to)
        {
            var hingeValue = new PinId();
            World.Check(Native.kiriSheet_HingeLine(World.Handle, Id, (float*)&from, (float*)&to, &hingeValue), "Sheet.HingeLine");
            return new Pin(World, hingeValue);
        }

        /// <summary>Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are.</summary>
        public int GetPins(PinId[] pins)
        {
            int count = 0;
            fixed (PinId* pinsRows = pins)
            {
                World.CheckRead(Native.kiriSheet_GetPins(World.Handle, Id, pinsRows, (pins == null ? 0 : pins.Length), &count), "Sheet.GetPins");
            }
            return count;
        }

        public PinId[] GetPins()
        {
            var pins = new PinId[GetPins(null)];
            GetPins(pins);
            return pins;
        }

        /// <summary>Sets the contacts of the next tick alone. One with point and obstacle of an earlier one starts with its
        /// impulse.</summary>
        public void SetContacts(Contact[] contacts, int count = -1)
        {
            if (count < 0) count = contacts.Length;
            if (count > contacts.Length) World.ThrowRange();
            fixed (Contact* contactsRows = contacts)
            {
                World.Check(Native.kiriSheet_SetContacts(World.Handle, Id, contactsRows, count), "Sheet.SetContacts");
            }
        }

        /// <summary>Gets one result for each contact that was set before the last tick, in that order. A sleeping piece presses
        /// on.</summary>
        public ContactForceView GetContactForces()
        {
            ContactForce* forcesValue = null;
            int count = 0;
            World.CheckRead(Native.kiriSheet_GetContactForces(World.Handle, Id, &forcesValue, &count), "Sheet.GetContactForces");
            return new ContactForceView(World, forcesValue, count);
        }

        /// <summary>Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add
        /// their way.</summary>
        public void GetReach(float dt, out Float3 lower, out Float3 upper)
        {
            var lowerValue = new Float3();
            var upperValue = new Float3();
            World.CheckRead(Native.kiriSheet_GetReach(World.Handle, Id, dt, (float*)&lowerValue, (float*)&upperValue), "Sheet.GetReach");
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

        /// <summary>Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its
        /// centre of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held
        /// frames stay held.</summary>
        public void SetPieceVelocity(Float3 velocity, Float3 angularVelocity)
        {
            World.Check(Native.kiriFrame_SetPieceVelocity(World.Handle, Id, (float*)&velocity, (float*)&angularVelocity), "Frame.SetPieceVelocity");
        }

        /// <summary>Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        /// a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        /// has both.</summary>
        public void SetPieceUserData(ulong data)
        {
            World.Check(Native.kiriFrame_SetPieceUserData(World.Handle, Id, data), "Frame.SetPieceUserData");
        }

        /// <summary>Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        /// a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        /// has both.</summary>
        public ulong GetPieceUserData()
        {
            ulong dataValue = 0;
            World.CheckRead(Native.kiriFrame_GetPieceUserData(World.Handle, Id, &dataValue), "Frame.GetPieceUserData");
            return dataValue;
        }

        /// <summary>Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.</summary>
        public int GetPiece()
        {
            int pieceValue = 0;
            World.CheckRead(Native.kiriFrame_GetPiece(World.Handle, Id, &pieceValue), "Frame.GetPiece");
            return pieceValue;
        }

        /// <summary>Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay
        /// with the old sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut
        /// is pending, or the budget lacks samples for the piece; *detached is 0, further cuts of the sheet wait, and
        /// KIRI_EVENT_PIECE_DETACHED names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the
        /// sheet (manual, cutting).</summary>
        public Sheet DetachPiece()
        {
            var detachedValue = new SheetId();
            World.Check(Native.kiriFrame_DetachPiece(World.Handle, Id, &detachedValue), "Frame.DetachPiece");
            return new Sheet(World, detachedValue);
        }

        /// <summary>Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles
        /// stay with three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all
        /// of its sheet.</summary>
        public Status DestroyPiece()
        {
            int result;
            result = World.Check(Native.kiriFrame_DestroyPiece(World.Handle, Id), "Frame.DestroyPiece");
            return result == 0 ? Status.Done : Status.Pending;
        }

        /// <summary>Holds the frame: its rest point moves evenly to `position` (m, world) with `rotation` (columns as above) in
        /// the next tick; position and rotation null: frees it. Material that held frames mostly carry moves through
        /// obstacles.</summary>
        public void Hold(Float3? position = null, Float9? rotation = null)
        {
            Float3 positionValue = position.GetValueOrDefault();
            Float9 rotationValue = rotation.GetValueOrDefault();
            World.Check(Native.kiriFrame_Hold(World.Handle, Id, position.HasValue ? (float*)&positionValue : null, rotation.HasValue ? (float*)&rotationValue : null), "Frame.Hold");
        }

        /// <summary>Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet:
        /// means over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for
        /// a free frame.</summary>
        public FrameState GetState()
        {
            var stateValue = new FrameState();
            World.CheckRead(Native.kiriFrame_GetState(World.Handle, Id, &stateValue), "Frame.GetState");
            return stateValue;
        }

        /// <summary>Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet:
        /// means over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for
        /// a free frame.</summary>
        public void GetReaction(out Double3 force, out Double3 torque)
        {
            var forceValue = new Double3();
            var torqueValue = new Double3();
            World.CheckRead(Native.kiriFrame_GetReaction(World.Handle, Id, (double*)&forceValue, (double*)&torqueValue), "Frame.GetReaction");
            force = forceValue;
            torque = torqueValue;
        }

        /// <summary>Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).</summary>
        public void ApplyForce(Float3 force, Float3 torque)
        {
            World.Check(Native.kiriFrame_ApplyForce(World.Handle, Id, (float*)&force, (float*)&torque), "Frame.ApplyForce");
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

        /// <summary>Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        /// a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        /// has both.</summary>
        public void SetUserData(ulong data)
        {
            World.Check(Native.kiriPin_SetUserData(World.Handle, Id, data), "Pin.SetUserData");
        }

        /// <summary>Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        /// a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        /// has both.</summary>
        public ulong GetUserData()
        {
            ulong dataValue = 0;
            World.CheckRead(Native.kiriPin_GetUserData(World.Handle, Id, &dataValue), "Pin.GetUserData");
            return dataValue;
        }

        /// <summary>Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT:
        /// outside.</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroyPin(World.Handle, Id), "Pin.Destroy");
        }

        /// <summary>Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's
        /// material (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and
        /// later. The pin moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a
        /// point.</summary>
        public void SetTarget(Float3 target)
        {
            World.Check(Native.kiriPin_SetTarget(World.Handle, Id, (float*)&target), "Pin.SetTarget");
        }

        /// <summary>Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's
        /// material (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and
        /// later. The pin moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a
        /// point.</summary>
        public void SetPose(Float3 target, Float9 rotation)
        {
            World.Check(Native.kiriPin_SetPose(World.Handle, Id, (float*)&target, (float*)&rotation), "Pin.SetPose");
        }

        /// <summary>Sets the force (N) that breaks a pin of any type; 0: it never breaks.</summary>
        public void SetBreakForce(float breakForce)
        {
            World.Check(Native.kiriPin_SetBreakForce(World.Handle, Id, breakForce), "Pin.SetBreakForce");
        }

        /// <summary>Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that
        /// moved it.</summary>
        public PinState GetState()
        {
            var stateValue = new PinState();
            World.CheckRead(Native.kiriPin_GetState(World.Handle, Id, &stateValue), "Pin.GetState");
            return stateValue;
        }

        /// <summary>Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that
        /// moved it.</summary>
        public void GetReaction(out Double3 force, out Double3 torque)
        {
            var forceValue = new Double3();
            var torqueValue = new Double3();
            World.CheckRead(Native.kiriPin_GetReaction(World.Handle, Id, (double*)&forceValue, (double*)&torqueValue), "Pin.GetReaction");
            force = forceValue;
            torque = torqueValue;
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

        /// <summary>Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        /// once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        /// nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        /// point (KIRI_EVENT_CUT_FINISHED).</summary>
        public void Extend(float[] restPoints, int count = -1)
        {
            if (count < 0) count = restPoints.Length / 2;
            if (count > restPoints.Length / 2) World.ThrowRange();
            fixed (float* restPointsRows = restPoints)
            {
                World.Check(Native.kiriCut_Extend(World.Handle, Id, restPointsRows, count), "Cut.Extend");
            }
        }

        /// <summary>Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        /// once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        /// nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        /// point (KIRI_EVENT_CUT_FINISHED).</summary>
        public void End()
        {
            World.Check(Native.kiriCut_End(World.Handle, Id), "Cut.End");
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

        /// <summary>Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
        /// casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it:
        /// cuts stay.</summary>
        public void MoveEdge(Float3 from, Float3 to)
        {
            World.Check(Native.kiriBlade_MoveEdge(World.Handle, Id, (float*)&from, (float*)&to), "Blade.MoveEdge");
        }

        /// <summary>Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
        /// casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it:
        /// cuts stay.</summary>
        public void MoveRay(Float3 origin, Float3 direction, float length)
        {
            World.Check(Native.kiriBlade_MoveRay(World.Handle, Id, (float*)&origin, (float*)&direction, length), "Blade.MoveRay");
        }

        /// <summary>Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
        /// casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it:
        /// cuts stay.</summary>
        public void End()
        {
            World.Check(Native.kiriBlade_End(World.Handle, Id), "Blade.End");
        }
    }

    public unsafe partial struct Seam : IEquatable<Seam>
    {
        public readonly World World;
        public readonly SeamId Id;

        internal Seam(World world, SeamId id) { World = world; Id = id; }
        public bool IsNone { get { return Id.IsNone; } }
        public bool Equals(Seam other) { return World == other.World && Id == other.Id; }
        public override bool Equals(object other) { return other is Seam && Equals((Seam)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public static implicit operator SeamId(Seam handle) { return handle.Id; }

        /// <summary>Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is
        /// 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual,
        /// sewing).</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroySeam(World.Handle, Id), "Seam.Destroy");
        }

        /// <summary>Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is
        /// 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual,
        /// sewing).</summary>
        public void SetHinge(float stiffness, float restAngle)
        {
            World.Check(Native.kiriSeam_SetHinge(World.Handle, Id, stiffness, restAngle), "Seam.SetHinge");
        }

        /// <summary>Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.</summary>
        public Stitch GetStitch(int index)
        {
            var stitchValue = new Stitch();
            World.CheckRead(Native.kiriSeam_GetStitch(World.Handle, Id, index, &stitchValue), "Seam.GetStitch");
            return stitchValue;
        }

        /// <summary>Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.</summary>
        public int GetCount()
        {
            int stitchesValue = 0;
            World.CheckRead(Native.kiriSeam_GetCount(World.Handle, Id, &stitchesValue), "Seam.GetCount");
            return stitchesValue;
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

        /// <summary>Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.</summary>
        public void Destroy()
        {
            World.Check(Native.kiriDestroyObstacle(World.Handle, Id), "Obstacle.Destroy");
        }

        /// <summary>Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity), not to the jump.</summary>
        public void SetPose(Float3 position, Float9 rotation)
        {
            World.Check(Native.kiriObstacle_SetPose(World.Handle, Id, (float*)&position, (float*)&rotation), "Obstacle.SetPose");
        }

        /// <summary>Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
        /// mass.</summary>
        public void SetVelocity(Float3 velocity, Float3 angularVelocity)
        {
            World.Check(Native.kiriObstacle_SetVelocity(World.Handle, Id, (float*)&velocity, (float*)&angularVelocity), "Obstacle.SetVelocity");
        }

        /// <summary>Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
        /// mass.</summary>
        public void SetSurfaceVelocity(Float3 velocity)
        {
            World.Check(Native.kiriObstacle_SetSurfaceVelocity(World.Handle, Id, (float*)&velocity), "Obstacle.SetSurfaceVelocity");
        }

        /// <summary>Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
        /// mass.</summary>
        public void SetMass(float mass, Float6 inertia, Float3 centerOfMass)
        {
            World.Check(Native.kiriObstacle_SetMass(World.Handle, Id, mass, (float*)&inertia, (float*)&centerOfMass), "Obstacle.SetMass");
        }

        /// <summary>Gets the current state.</summary>
        public ObstacleState GetState()
        {
            var stateValue = new ObstacleState();
            World.CheckRead(Native.kiriObstacle_GetState(World.Handle, Id, &stateValue), "Obstacle.GetState");
            return stateValue;
        }
    }

}
