// Made from kiri.h by `make bindings`.
using System;
using System.Runtime.InteropServices;

namespace Kiri
{
    /// <summary>3 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Double3
    {
        public double X, Y, Z;

        public Double3(double x, double y, double z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        public double this[int i]
        {
            get
            {
                if ((uint)i >= 3) throw new IndexOutOfRangeException();
                fixed (double* first = &X) return first[i];
            }
            set
            {
                if ((uint)i >= 3) throw new IndexOutOfRangeException();
                fixed (double* first = &X) first[i] = value;
            }
        }
    }

    /// <summary>9 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Double9
    {
        public double M0, M1, M2, M3, M4, M5, M6, M7, M8;

        public Double9(double m0, double m1, double m2, double m3, double m4, double m5, double m6, double m7, double m8)
        {
            M0 = m0;
            M1 = m1;
            M2 = m2;
            M3 = m3;
            M4 = m4;
            M5 = m5;
            M6 = m6;
            M7 = m7;
            M8 = m8;
        }

        public double this[int i]
        {
            get
            {
                if ((uint)i >= 9) throw new IndexOutOfRangeException();
                fixed (double* first = &M0) return first[i];
            }
            set
            {
                if ((uint)i >= 9) throw new IndexOutOfRangeException();
                fixed (double* first = &M0) first[i] = value;
            }
        }
    }

    /// <summary>2 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Float2
    {
        public float X, Y;

        public Float2(float x, float y)
        {
            X = x;
            Y = y;
        }

        public float this[int i]
        {
            get
            {
                if ((uint)i >= 2) throw new IndexOutOfRangeException();
                fixed (float* first = &X) return first[i];
            }
            set
            {
                if ((uint)i >= 2) throw new IndexOutOfRangeException();
                fixed (float* first = &X) first[i] = value;
            }
        }
#if UNITY_2019_1_OR_NEWER || KIRI_UNITY
        public static implicit operator Float2(UnityEngine.Vector2 v) { return new Float2(v.x, v.y); }
        public static implicit operator UnityEngine.Vector2(Float2 v) { return new UnityEngine.Vector2(v.X, v.Y); }
#endif
    }

    /// <summary>3 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Float3
    {
        public float X, Y, Z;

        public Float3(float x, float y, float z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        public float this[int i]
        {
            get
            {
                if ((uint)i >= 3) throw new IndexOutOfRangeException();
                fixed (float* first = &X) return first[i];
            }
            set
            {
                if ((uint)i >= 3) throw new IndexOutOfRangeException();
                fixed (float* first = &X) first[i] = value;
            }
        }
#if UNITY_2019_1_OR_NEWER || KIRI_UNITY
        public static implicit operator Float3(UnityEngine.Vector3 v) { return new Float3(v.x, v.y, v.z); }
        public static implicit operator UnityEngine.Vector3(Float3 v) { return new UnityEngine.Vector3(v.X, v.Y, v.Z); }
#endif
    }

    /// <summary>6 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Float6
    {
        public float M0, M1, M2, M3, M4, M5;

        public Float6(float m0, float m1, float m2, float m3, float m4, float m5)
        {
            M0 = m0;
            M1 = m1;
            M2 = m2;
            M3 = m3;
            M4 = m4;
            M5 = m5;
        }

        public float this[int i]
        {
            get
            {
                if ((uint)i >= 6) throw new IndexOutOfRangeException();
                fixed (float* first = &M0) return first[i];
            }
            set
            {
                if ((uint)i >= 6) throw new IndexOutOfRangeException();
                fixed (float* first = &M0) first[i] = value;
            }
        }
    }

    /// <summary>9 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Float9
    {
        public float M0, M1, M2, M3, M4, M5, M6, M7, M8;

        public Float9(float m0, float m1, float m2, float m3, float m4, float m5, float m6, float m7, float m8)
        {
            M0 = m0;
            M1 = m1;
            M2 = m2;
            M3 = m3;
            M4 = m4;
            M5 = m5;
            M6 = m6;
            M7 = m7;
            M8 = m8;
        }

        public float this[int i]
        {
            get
            {
                if ((uint)i >= 9) throw new IndexOutOfRangeException();
                fixed (float* first = &M0) return first[i];
            }
            set
            {
                if ((uint)i >= 9) throw new IndexOutOfRangeException();
                fixed (float* first = &M0) first[i] = value;
            }
        }
    }

    /// <summary>12 numbers, one after the other.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Float12
    {
        public float M0, M1, M2, M3, M4, M5, M6, M7, M8, M9, M10, M11;

        public Float12(float m0, float m1, float m2, float m3, float m4, float m5, float m6, float m7, float m8, float m9, float m10, float m11)
        {
            M0 = m0;
            M1 = m1;
            M2 = m2;
            M3 = m3;
            M4 = m4;
            M5 = m5;
            M6 = m6;
            M7 = m7;
            M8 = m8;
            M9 = m9;
            M10 = m10;
            M11 = m11;
        }

        public float this[int i]
        {
            get
            {
                if ((uint)i >= 12) throw new IndexOutOfRangeException();
                fixed (float* first = &M0) return first[i];
            }
            set
            {
                if ((uint)i >= 12) throw new IndexOutOfRangeException();
                fixed (float* first = &M0) first[i] = value;
            }
        }
    }

    /// <summary>The number of a sheet; 0 is none. World.Get makes a Sheet of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SheetId : IEquatable<SheetId>
    {
        public readonly uint Value;

        public SheetId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(SheetId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is SheetId && Equals((SheetId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(SheetId a, SheetId b) { return a.Value == b.Value; }
        public static bool operator !=(SheetId a, SheetId b) { return a.Value != b.Value; }
    }

    /// <summary>The number of a cut; 0 is none. World.Get makes a Cut of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CutId : IEquatable<CutId>
    {
        public readonly uint Value;

        public CutId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(CutId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is CutId && Equals((CutId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(CutId a, CutId b) { return a.Value == b.Value; }
        public static bool operator !=(CutId a, CutId b) { return a.Value != b.Value; }
    }

    /// <summary>The number of a frame; 0 is none. World.Get makes a Frame of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct FrameId : IEquatable<FrameId>
    {
        public readonly uint Value;

        public FrameId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(FrameId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is FrameId && Equals((FrameId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(FrameId a, FrameId b) { return a.Value == b.Value; }
        public static bool operator !=(FrameId a, FrameId b) { return a.Value != b.Value; }
    }

    /// <summary>The number of a pin; 0 is none. World.Get makes a Pin of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct PinId : IEquatable<PinId>
    {
        public readonly uint Value;

        public PinId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(PinId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is PinId && Equals((PinId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(PinId a, PinId b) { return a.Value == b.Value; }
        public static bool operator !=(PinId a, PinId b) { return a.Value != b.Value; }
    }

    /// <summary>The number of a obstacle; 0 is none. World.Get makes a Obstacle of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ObstacleId : IEquatable<ObstacleId>
    {
        public readonly uint Value;

        public ObstacleId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(ObstacleId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is ObstacleId && Equals((ObstacleId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(ObstacleId a, ObstacleId b) { return a.Value == b.Value; }
        public static bool operator !=(ObstacleId a, ObstacleId b) { return a.Value != b.Value; }
    }

    /// <summary>The number of a blade; 0 is none. World.Get makes a Blade of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct BladeId : IEquatable<BladeId>
    {
        public readonly uint Value;

        public BladeId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(BladeId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is BladeId && Equals((BladeId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(BladeId a, BladeId b) { return a.Value == b.Value; }
        public static bool operator !=(BladeId a, BladeId b) { return a.Value != b.Value; }
    }

    /// <summary>The number of a seam; 0 is none. World.Get makes a Seam of it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SeamId : IEquatable<SeamId>
    {
        public readonly uint Value;

        public SeamId(uint value) { Value = value; }
        public bool IsNone { get { return Value == 0; } }
        public bool Equals(SeamId other) { return Value == other.Value; }
        public override bool Equals(object other) { return other is SeamId && Equals((SeamId)other); }
        public override int GetHashCode() { return (int)Value; }
        public static bool operator ==(SeamId a, SeamId b) { return a.Value == b.Value; }
        public static bool operator !=(SeamId a, SeamId b) { return a.Value != b.Value; }
    }

    public enum ResultCode
    {
        Ok = 0,
        /// <summary>success; work is left for later ticks</summary>
        Pending = 1,
        /// <summary>null, NaN, infinite, outside the documented range, or beyond 4e37 m, m/s or 1/s</summary>
        ErrorArgument = -1,
        /// <summary>the def was not filled by its kiriDefault function: call that first</summary>
        ErrorDef = -2,
        /// <summary>unknown or stale id, or the id of another kind</summary>
        ErrorId = -3,
        /// <summary>the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping</summary>
        ErrorMesh = -4,
        /// <summary>the call comes in the wrong order, or from a callback that may not make it</summary>
        ErrorState = -5,
        /// <summary>the allocator returned null</summary>
        ErrorMemory = -6,
        /// <summary>the motion of a sheet could not be continued; the sheet was stopped where it was</summary>
        Diverged = -7,
        /// <summary>all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world</summary>
        ErrorLimit = -8,
        /// <summary>floats are not computed as on other machines, see kiriCreateWorld</summary>
        ErrorBuild = -9,
        /// <summary>the bytes are damaged, cut short, of another kind, or of a later version</summary>
        ErrorData = -10,
        /// <summary>a repeated call gave another result than its recording has</summary>
        ErrorReplay = -11,
    }

    /// <summary>Events since the start of the last tick that was not refused.</summary>
    public enum EventType
    {
        /// <summary>cut: all of it is in the mesh; the id is stale from now on</summary>
        CutFinished = 1,
        /// <summary>frame (its first, which names it), crumb, area: a part came off, never the largest</summary>
        PieceOff = 2,
        /// <summary>frame</summary>
        FrameAdded = 3,
        /// <summary>the sheet was stopped</summary>
        Diverged = 4,
        /// <summary>stage, waiting: the budget ended in this stage of the sheet's work</summary>
        Deferred = 5,
        /// <summary>pin: its force exceeded breakForce; the id is stale from now on</summary>
        PinBroke = 6,
        /// <summary>sheet (the new one), frame, area: a pending kiriFrame_DetachPiece is done</summary>
        PieceDetached = 7,
        /// <summary>seam, stitches: some stitches broke; with none left the id is stale from now on</summary>
        SeamBroke = 8,
        /// <summary>cut: the library began it, see kiriTearing</summary>
        TearBegan = 9,
        /// <summary>cut: the tear has rested for half a second; the id is stale from now on</summary>
        TearEnded = 10,
        /// <summary>area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s</summary>
        Strained = 11,
    }

    /// <summary>The stages of a tick in their order.</summary>
    public enum Stage
    {
        /// <summary>splits the mesh along the blade</summary>
        Cut = 0,
        /// <summary>cells and their connections</summary>
        Grid = 1,
        /// <summary>geodesic distances, regions, links; places frames</summary>
        Regions = 2,
        /// <summary>shape functions</summary>
        Shape = 3,
        /// <summary>weights of vertices and collision points</summary>
        Samples = 4,
        /// <summary>mass, the pattern of the solver's matrix, and the commit</summary>
        Constants = 5,
        /// <summary>contacts with obstacles, other sheets and other pieces</summary>
        Contact = 6,
        /// <summary>the motion of the frames</summary>
        Solve = 7,
        /// <summary>positions and normals of the mesh</summary>
        Skin = 8,
        Count = 9,
    }

    /// <summary>Materials to start from; src/world/kiri_api_world.c has the sources. From SILK on: measured cloths (manual,
    /// sheets)</summary>
    public enum MaterialPreset
    {
        /// <summary>printing paper, 0.11 mm</summary>
        Paper = 0,
        /// <summary>cloth, 0.5 mm; the default of a sheet def</summary>
        Cotton = 1,
        /// <summary>natural rubber, 1 mm</summary>
        Rubber = 2,
        /// <summary>aluminium, 16 um</summary>
        Foil = 3,
        /// <summary>paperboard, 0.4 mm</summary>
        Card = 4,
        Silk = 5,
        Shirting = 6,
        Wool = 7,
        Denim = 8,
        Jersey = 9,
        Count = 10,
    }

    /// <summary>Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual,
    /// accuracy).</summary>
    public enum QualityPreset
    {
        Fast = 0,
        Balanced = 1,
        Accurate = 2,
        Count = 3,
    }

    /// <summary>Kinds of sheets to begin with. They want a tick of 1/60 s with 4 substeps; curtain and card do with 2.</summary>
    public enum SetupPreset
    {
        Curtain = 0,
        Paper = 1,
        Flag = 2,
        Ribbon = 3,
        Rubber = 4,
        Card = 5,
        Foil = 6,
        Count = 7,
    }

    /// <summary>How a sheet deforms (manual, sheets). Rigid frames have 6 unknowns, affine ones 12.</summary>
    public enum Model
    {
        /// <summary>rigid frames joined by links: paper, foil, stiff cloth</summary>
        Links = 0,
        /// <summary>affine frames joined by links: cloth and rubber that stretch inside a region</summary>
        Affine = 1,
        /// <summary>affine frames, strains at integration points, as in the paper. Thin sheets hardly bend</summary>
        Points = 2,
    }

    /// <summary>The surface between the frames, which blades and contacts meet (manual, sheets).</summary>
    public enum Skinning
    {
        /// <summary>each frame carries a flat patch; the weights blend them (equation 1 of the paper)</summary>
        Linear = 0,
        /// <summary>patches bend and stretch as their neighbours lie: no bumps at the frames</summary>
        Smooth = 1,
    }

    /// <summary>Integration in time, with one linear system an iteration. Steps with contacts or new pins take backward Euler.</summary>
    public enum TimeStepping
    {
        /// <summary>TR-BDF2, of second order: keeps the energy of motion</summary>
        SecondOrder = 0,
        /// <summary>backward Euler, of first order: takes energy out of a swing, more in longer steps</summary>
        Euler = 1,
    }

    /// <summary>The types of pins.</summary>
    public enum PinType
    {
        Point = 0,
        Hinge = 1,
        Clamp = 2,
    }

    /// <summary>A body that sheets touch: a floor, a ball, a crate of another engine. It moves on with its velocities alone: set
    /// pose and velocity before a tick, and apply the impulse of its state after it (manual, contact). Lengths: up to
    /// 1e6 m.</summary>
    public enum ObstacleType
    {
        /// <summary>all below the plane through its position; the third column of its rotation points out</summary>
        Plane = 0,
        /// <summary>radius</summary>
        Sphere = 1,
        /// <summary>radius, height: of its axis, the third column, between the middles of its round ends</summary>
        Capsule = 2,
        /// <summary>size: lengths of its edges along the columns of its rotation</summary>
        Box = 3,
        /// <summary>radius, height: along the third column</summary>
        Cylinder = 4,
        /// <summary>outline: convex, in the plane of the first two columns; height along the third, 0: endless</summary>
        Prism = 5,
    }

    /// <summary>The things to draw.</summary>
    [Flags]
    public enum DrawFlag : uint
    {
        /// <summary>a triangle for each triangle of the mesh, in a colour of its piece; sleeping: pale</summary>
        Triangles = 1,
        /// <summary>a line for each edge between two triangles</summary>
        Edges = 2,
        /// <summary>a line for each edge of the outline, of lips and of folds</summary>
        Borders = 4,
        /// <summary>a point and three axes each: u red, v green, normal blue; held ones red</summary>
        Frames = 8,
        /// <summary>two lines each: from frame to frame by the middle of their border</summary>
        Links = 16,
        /// <summary>a point at the target; a line to the point of the material, or along the line</summary>
        Pins = 32,
        /// <summary>a point and its normal for each that pushed as the last tick ended</summary>
        Contacts = 64,
        /// <summary>a line along the edge, and a point in each layer that it is in</summary>
        Blades = 128,
        /// <summary>twelve lines around each piece</summary>
        Boxes = 256,
        /// <summary>lines along edges and rims, without the rounding; a plane is a square</summary>
        Obstacles = 512,
        /// <summary>a point for each collision point</summary>
        Points = 1024,
        All = 2047,
    }

    /// <summary>Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance:
    /// using 30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut
    /// takes effect; the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it
    /// (manual, budget).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Budget
    {
        /// <summary>split by blades; 0, or KIRI_LEAST_TRIANGLES and more</summary>
        public int Triangles;
        /// <summary>visited, or with a new distance: grid, regions, shape functions. A link counts as a cell</summary>
        public int Cells;
        /// <summary>vertices and collision points with new weights, and the cost of the commit, paid before it</summary>
        public int Samples;
        /// <summary>linear systems, 30 to 60 us each; a large one counts as several (manual, budget)</summary>
        public int Iterations;
    }

    /// <summary>Settings of a world: gravity, budget, and functions of the host.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativeWorldDef
    {
        public uint Cookie;
        /// <summary>m/s^2; default (0, 0, -9.81)</summary>
        public Float3 Gravity;
        /// <summary>default: no limit</summary>
        public Budget Budget;
        /// <summary>null: malloc and free. Set both or none.</summary>
        public IntPtr Alloc;
        public IntPtr Free;
        /// <summary>one line for each error and KIRI_EVENT_STRAINED; null: silent</summary>
        public IntPtr Log;
        /// <summary>null: the profile has counts, and no times</summary>
        public IntPtr Clock;
        /// <summary>null: a tick runs in the calling thread alone. Set both or none.</summary>
        public IntPtr StartTask;
        public IntPtr FinishTask;
        /// <summary>threads for a task, the caller included, 0 to 1024; above 1 with startTask. Default 0</summary>
        public int WorkerCount;
        /// <summary>passed to the functions above</summary>
        public void* User;
        /// <summary>receives the recording of the world, see kiriWorld_Replay; null: no recording</summary>
        public IntPtr Record;
        /// <summary>ticks between state hashes in the recording; one is at its end. 0: none. Default 60</summary>
        public int RecordHashTicks;

        /// <summary>With the defaults of the library.</summary>
        public static NativeWorldDef Default
        {
            get
            {
                NativeWorldDef def;
                Native.kiriDefaultWorldDef(&def);
                return def;
            }
        }
    }

    /// <summary>Progress of a replay. Set all fields to zero before the first call.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativeReplay
    {
        /// <summary>bytes of the recording that were read; calls and ticks made, without refused ticks</summary>
        public long Offset;
        /// <summary>bytes of the recording that were read; calls and ticks made, without refused ticks</summary>
        public long Calls;
        /// <summary>bytes of the recording that were read; calls and ticks made, without refused ticks</summary>
        public long Ticks;
        /// <summary>bytes of the note where the replay stopped, in the recording; else null</summary>
        public void* Note;
        public int NoteCount;
    }

    /// <summary>An event. It fills the fields that its type names, and `sheet`. Other fields are 0, and `stage` is -1.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Event
    {
        /// <summary>KIRI_EVENT_...</summary>
        public EventType Type;
        public SheetId Sheet;
        /// <summary>0: none</summary>
        public CutId Cut;
        /// <summary>0: none</summary>
        public FrameId Frame;
        /// <summary>0: none</summary>
        public PinId Pin;
        /// <summary>1: the piece is a crumb, see kiriSheetDef</summary>
        public Flag Crumb;
        /// <summary>m^2, or 0</summary>
        public float Area;
        /// <summary>KIRI_STAGE_..., or -1</summary>
        public Stage Stage;
        /// <summary>points and ends of cuts that are pending or in work; or 0</summary>
        public int Waiting;
        /// <summary>0: none</summary>
        public SeamId Seam;
        /// <summary>that the seam has left, or 0</summary>
        public int Stitches;
    }

    /// <summary>Work and time of the last tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Profile
    {
        /// <summary>of the last tick; zero without a clock</summary>
        public Double9 Seconds;
        /// <summary>blade segments that took effect</summary>
        public int CutSegments;
        /// <summary>Items in the units of kiriBudget. An item that takes more work counts more than once.</summary>
        public int TrianglesSplit;
        /// <summary>Items in the units of kiriBudget. An item that takes more work counts more than once.</summary>
        public int CellsSettled;
        /// <summary>Items in the units of kiriBudget. An item that takes more work counts more than once.</summary>
        public int SamplesRefreshed;
        /// <summary>Items in the units of kiriBudget. An item that takes more work counts more than once.</summary>
        public int SolverIterations;
        /// <summary>Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals:
        /// kiriCounts).</summary>
        public int CellsChanged;
        /// <summary>Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals:
        /// kiriCounts).</summary>
        public int WeightsChanged;
        /// <summary>Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals:
        /// kiriCounts).</summary>
        public int VerticesChanged;
        /// <summary>Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals:
        /// kiriCounts).</summary>
        public int PointsChanged;
        /// <summary>Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals:
        /// kiriCounts).</summary>
        public int LinksChanged;
        /// <summary>sheets in which a cut took effect; linear systems, large and small</summary>
        public int Commits;
        /// <summary>sheets in which a cut took effect; linear systems, large and small</summary>
        public int SystemsSolved;
        /// <summary>planes given to the solver: by the host, by obstacles, and between sheets</summary>
        public int Contacts;
        /// <summary>pairs of sheets or pieces that are near each other and not both asleep</summary>
        public int SheetPairs;
        /// <summary>The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m.</summary>
        public double LargestJump;
        /// <summary>The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m.</summary>
        public double LargestFade;
    }

    /// <summary>The material of a sheet: homogeneous, isotropic.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Material
    {
        /// <summary>Pa, above 0</summary>
        public float YoungsModulus;
        /// <summary>0 to below 0.5</summary>
        public float PoissonsRatio;
        /// <summary>m, above 0</summary>
        public float Thickness;
        /// <summary>kg/m^3, above 0</summary>
        public float Density;
        /// <summary>1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets)</summary>
        public float AirDamping;
        /// <summary>s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation</summary>
        public float FlexDamping;
        /// <summary>Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not planar</summary>
        public float YieldStress;
        /// <summary>modulus beyond the yield stress, relative to youngsModulus; 0 to below 1</summary>
        public float Hardening;
        /// <summary>0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets)</summary>
        public float Slack;
        /// <summary>sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0</summary>
        public int Detail;
        /// <summary>1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0</summary>
        public Float3 RestCurvature;
    }

    /// <summary>Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual,
    /// accuracy).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Quality
    {
        /// <summary>control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9</summary>
        public int FramesAlong;
        /// <summary>for the sheet def</summary>
        public int GridResolution;
        /// <summary>for the sheet def</summary>
        public int Iterations;
        /// <summary>for kiriWorld_Tick</summary>
        public int Substeps;
    }

    /// <summary>Options of the paper, for comparison; part of the sheet def. Default 0, but for integrationOrder.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PaperOptions
    {
        /// <summary>1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits</summary>
        public Flag FromScratch;
        /// <summary>1: only new frames take their motion from the surface: it jumps, momentum is not kept</summary>
        public Flag Popping;
        /// <summary>1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS</summary>
        public Flag LinearWeights;
        /// <summary>KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
        /// frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work.</summary>
        public int IntegrationPoints;
        /// <summary>KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
        /// frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work.</summary>
        public int IntegrationOrder;
    }

    /// <summary>A sheet: its rest shape, start, material, and computation.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct SheetDef
    {
        internal uint cookie;
        /// <summary>The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge; holes and several
        /// parts are allowed. Two edges in the same place with different vertices are the lips of a cut (manual,
        /// meshes). 2 floats (u, v) a vertex</summary>
        internal float* restPositions;
        internal int vertexCount;
        /// <summary>3 a triangle</summary>
        internal int* indices;
        internal int triangleCount;
        /// <summary>Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.</summary>
        public Float3 Position;
        /// <summary>Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.</summary>
        public Float3 AxisU;
        /// <summary>Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.</summary>
        public Float3 AxisV;
        /// <summary>Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.</summary>
        public Float3 Velocity;
        public Material Material;
        /// <summary>grid squares along the longer side, 1 to 4096; default 32</summary>
        public int GridResolution;
        /// <summary>m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side</summary>
        public float SnapDistance;
        /// <summary>m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none</summary>
        public float WeldDistance;
        /// <summary>Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null:
        /// frameCount frames are spread evenly, in straight rows over stiff rectangles, or fewer: one for two squares
        /// of the grid. frameCount 0: regions are split, after cuts too, to frameLength; 0: it follows from `accuracy`,
        /// the relative error (manual, accuracy). 0, or 1 and more; default 24</summary>
        public int FrameCount;
        /// <summary>m; used where frameCount is 0; default 0</summary>
        public float FrameLength;
        /// <summary>1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default 0.02</summary>
        public float Accuracy;
        /// <summary>2 floats a frame, or null</summary>
        internal float* framePoints;
        /// <summary>re-sampling stops here; default 256</summary>
        public int MaxFrames;
        /// <summary>Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new
        /// frames beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual,
        /// accuracy). default 0.95, 0</summary>
        public float RigidWeight;
        /// <summary>Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new
        /// frames beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual,
        /// accuracy). default 0.95, 0</summary>
        public float RigidArea;
        /// <summary>m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0</summary>
        public float CrumbArea;
        /// <summary>of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5</summary>
        public float Friction;
        /// <summary>m between sheets, half to obstacles. 0: the material's, at least a 20th of a square</summary>
        public float ContactThickness;
        /// <summary>obstacles and sheets touch if they share a set bit. Default: all</summary>
        public uint Groups;
        /// <summary>touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set.
        /// selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.</summary>
        public Flag TouchesSheets;
        /// <summary>touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set.
        /// selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.</summary>
        public Flag SelfContact;
        /// <summary>for kiriSheet_SetContacts: spread evenly, at least one in every piece; default 0: none</summary>
        public int CollisionPoints;
        /// <summary>Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual</summary>
        public int Iterations;
        /// <summary>m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never</summary>
        public float SleepSpeed;
        /// <summary>KIRI_MODEL_..., default KIRI_MODEL_LINKS</summary>
        public Model Model;
        /// <summary>KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH</summary>
        public Skinning Skinning;
        /// <summary>1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0</summary>
        public Flag Planar;
        /// <summary>KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER</summary>
        public TimeStepping TimeStepping;
        /// <summary>s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2</summary>
        public float FadeTime;
        /// <summary>1: every tick computes normals (default). 0: kiriMesh has none, which saves time</summary>
        public Flag Normals;
        /// <summary>default: all off</summary>
        public PaperOptions Paper;

        /// <summary>With the defaults of the library.</summary>
        public static SheetDef Default
        {
            get
            {
                SheetDef def;
                Native.kiriDefaultSheetDef(&def);
                return def;
            }
        }
    }

    /// <summary>Sheet settings that can change after creation. Fields mean the same as in kiriSheetDef.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct SheetSettings
    {
        internal uint cookie;
        public Material Material;
        /// <summary>re-sampling stops here; default 256</summary>
        public int MaxFrames;
        /// <summary>m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0</summary>
        public float CrumbArea;
        /// <summary>of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5</summary>
        public float Friction;
        /// <summary>m between sheets, half to obstacles. 0: the material's, at least a 20th of a square</summary>
        public float ContactThickness;
        /// <summary>obstacles and sheets touch if they share a set bit. Default: all</summary>
        public uint Groups;
        /// <summary>touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set.
        /// selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.</summary>
        public Flag TouchesSheets;
        /// <summary>touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set.
        /// selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.</summary>
        public Flag SelfContact;
        /// <summary>Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual</summary>
        public int Iterations;
        /// <summary>m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never</summary>
        public float SleepSpeed;
        /// <summary>KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH</summary>
        public Skinning Skinning;
        /// <summary>KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER</summary>
        public TimeStepping TimeStepping;
        /// <summary>stays 0 with paper.popping</summary>
        public float FadeTime;
        /// <summary>1: every tick computes normals (default). 0: kiriMesh has none, which saves time</summary>
        public Flag Normals;
    }

    /// <summary>A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and each side has its
    /// own frames. Lines may end in the material, meet and cross; cuts go through or along them (manual, folding).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Fold
    {
        /// <summary>m</summary>
        public Float2 From;
        /// <summary>m</summary>
        public Float2 To;
        /// <summary>N m/rad per metre of the line, 0 or more; 0: a free hinge</summary>
        public float Stiffness;
        /// <summary>rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it</summary>
        public float RestAngle;
        /// <summary>N m per metre: it bends for good beyond, with a yieldStress. 0: no limit</summary>
        public float YieldMoment;
    }

    /// <summary>A fold, its mean angle (rad, as restAngle) and the length (m) along which it joins two sides: not cut, nor
    /// rigid.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct FoldState
    {
        public Fold Fold;
        public double Angle;
        public double Length;
    }

    /// <summary>The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision grows when
    /// indices or vertices are added or changed. Sources have the precision of the library, 2^-29 of the sheet.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativeMesh
    {
        /// <summary>3 a vertex, m, world</summary>
        public float* positions;
        /// <summary>3 a vertex, unit; null where the sheet makes none</summary>
        public float* normals;
        /// <summary>2 a vertex, m</summary>
        public float* restPositions;
        /// <summary>3 a triangle</summary>
        public int* indices;
        /// <summary>1 a vertex: the triangle of the def that contains it,</summary>
        public int* sourceTriangles;
        /// <summary>3 a vertex: and its barycentric coordinates there</summary>
        public float* sourceWeights;
        public int vertexCount;
        public int triangleCount;
        public uint Revision;
    }

    /// <summary>`count` items from `first` on.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Range
    {
        public int First;
        public int Count;
    }

    /// <summary>Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change in every tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Dirty
    {
        /// <summary>up to the last one of the mesh</summary>
        public Range NewVertices;
        /// <summary>up to the last one of the mesh</summary>
        public Range NewTriangles;
        /// <summary>the smallest ranges that hold all older ones with other data</summary>
        public Range OldVertices;
        /// <summary>the smallest ranges that hold all older ones with other data</summary>
        public Range OldTriangles;
        /// <summary>for the next call</summary>
        public uint Revision;
    }

    /// <summary>The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips. First the
    /// vertices of kiriMesh on the side of the normal, then the same on the other side, then four for each border edge.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativeSolid
    {
        /// <summary>3 a vertex, m, world</summary>
        public float* positions;
        /// <summary>3 a vertex, unit, outwards</summary>
        public float* normals;
        /// <summary>2 a vertex, m</summary>
        public float* restPositions;
        /// <summary>3 a triangle, counter-clockwise from outside</summary>
        public int* indices;
        /// <summary>1 a vertex: its vertex in kiriMesh</summary>
        public int* sources;
        public int vertexCount;
        public int triangleCount;
        /// <summary>rims begin at this triangle</summary>
        public int RimTriangle;
    }

    /// <summary>Numbers of items in a sheet.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Counts
    {
        public int Vertices;
        public int Triangles;
        public int Cells;
        public int Frames;
        public int Links;
        public int Pieces;
        public int CollisionPoints;
    }

    /// <summary>m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s and kg m^2/s.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Totals
    {
        public double Area;
        public double Mass;
        public double KineticEnergy;
        public double ElasticEnergy;
        public Double3 Center;
        public Double3 Momentum;
        public Double3 AngularMomentum;
    }

    /// <summary>The first point where a ray meets a sheet.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Hit
    {
        /// <summary>m: where to cut</summary>
        public Float2 RestPoint;
        /// <summary>m, world</summary>
        public Float3 Position;
        /// <summary>unit</summary>
        public Float3 Normal;
        /// <summary>m along the direction, which need not be a unit vector</summary>
        public float Distance;
        /// <summary>-1: none</summary>
        public int Triangle;
    }

    /// <summary>A point of the material on the visible surface.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PointState
    {
        /// <summary>m, world; unit</summary>
        public Float3 Position;
        /// <summary>m, world; unit</summary>
        public Float3 Normal;
        /// <summary>m/s, by the weights of the point</summary>
        public Float3 Velocity;
        /// <summary>the frame of its region; it also names the piece</summary>
        public FrameId Frame;
    }

    /// <summary>A connected part of a sheet. Any of its frames names it. Indices go from 0 to kiriCounts.pieces, and change when
    /// a piece comes off or goes (kiriFrame_GetPiece). Cuts with pending work have separated nothing yet.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PieceState
    {
        /// <summary>m^2, kg</summary>
        public double Area;
        /// <summary>m^2, kg</summary>
        public double Mass;
        /// <summary>of mass, m; kg m/s, kg m^2/s about the origin</summary>
        public Double3 Center;
        /// <summary>of mass, m; kg m/s, kg m^2/s about the origin</summary>
        public Double3 Momentum;
        /// <summary>of mass, m; kg m/s, kg m^2/s about the origin</summary>
        public Double3 AngularMomentum;
        /// <summary>m, world: the smallest box around its vertices</summary>
        public Float3 Lower;
        /// <summary>m, world: the smallest box around its vertices</summary>
        public Float3 Upper;
        /// <summary>counts</summary>
        public int Frames;
        /// <summary>counts</summary>
        public int Vertices;
        /// <summary>counts</summary>
        public int Triangles;
        /// <summary>counts</summary>
        public int CollisionPoints;
        /// <summary>1: see kiriSheetDef</summary>
        public Flag Crumb;
        /// <summary>1: see sleepSpeed</summary>
        public Flag Asleep;
    }

    /// <summary>The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all pieces, piece by
    /// piece.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativePieceMesh
    {
        /// <summary>1 a vertex: its index in kiriMesh</summary>
        public int* vertices;
        /// <summary>1 a triangle: its index in kiriMesh</summary>
        public int* triangles;
        /// <summary>3 a triangle, as in kiriMesh: draw them</summary>
        public int* indices;
        /// <summary>1 a point, see kiriSheet_GetCollisionPoints</summary>
        public int* collisionPoints;
        public int vertexCount;
        public int triangleCount;
        public int collisionPointCount;
    }

    /// <summary>How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or a sharp notch,
    /// goes on across the tension where the sheet would set more energy free than the tear takes. Two frames go with
    /// its tip. Where a mean tension over a distance of frames exceeds the strength, a tear begins at the nearest
    /// border, one at a time.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Tearing
    {
        /// <summary>J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear</summary>
        public float Toughness;
        /// <summary>Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored</summary>
        public float Strength;
        /// <summary>direction in the rest plane along which it tears; 0, 0: none</summary>
        public Float2 Grain;
        /// <summary>toughness across the grain, relative to along it; below 1: 1</summary>
        public float GrainRatio;
        /// <summary>m/s in the rest plane, 0 or more; 0: no limit but the distance above</summary>
        public float MaxSpeed;
        /// <summary>tips that tear in a tick, 0 or more; 0: 8. Others wait</summary>
        public int MaxTips;
    }

    /// <summary>Pose, motion and region of a frame.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct FrameState
    {
        /// <summary>m</summary>
        public Float2 RestPoint;
        /// <summary>m, world: of the rest point</summary>
        public Float3 Position;
        /// <summary>columns: direction of u, of v, normal; an affine frame: columns of A, which stretch</summary>
        public Float9 Rotation;
        /// <summary>m/s, rad/s</summary>
        public Float3 Velocity;
        /// <summary>m/s, rad/s</summary>
        public Float3 AngularVelocity;
        /// <summary>m^2 of its region; kg</summary>
        public float Area;
        /// <summary>m^2 of its region; kg</summary>
        public float Mass;
        /// <summary>1: moved by the host, see kiriFrame_Hold</summary>
        public Flag Held;
    }

    /// <summary>Air past the sheet. v is the velocity of the air less the material's, n the normal: each square metre gets
    /// density / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)); airDamping acts in any density. A sheet can sleep in
    /// wind.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Wind
    {
        /// <summary>m/s</summary>
        public Float3 Velocity;
        /// <summary>kg/m^3, 0 or more; air: 1.2</summary>
        public float Density;
        /// <summary>0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)</summary>
        public float Drag;
        /// <summary>0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)</summary>
        public float Lift;
    }

    /// <summary>A pin holds a point of the material at its target by a spring.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PinDef
    {
        internal uint cookie;
        /// <summary>m, in the material</summary>
        public Float2 RestPoint;
        /// <summary>m, world</summary>
        public Float3 Target;
        /// <summary>N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target (manual)</summary>
        public float Stiffness;
        /// <summary>N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never</summary>
        public float BreakForce;
        /// <summary>0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there</summary>
        public ObstacleId Obstacle;

        /// <summary>With the defaults of the library.</summary>
        public static PinDef Default
        {
            get
            {
                PinDef def;
                Native.kiriDefaultPinDef(&def);
                return def;
            }
        }
    }

    /// <summary>Type and target of a pin.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PinState
    {
        /// <summary>KIRI_PIN_...</summary>
        public PinType Type;
        public SheetId Sheet;
        /// <summary>m, rest plane: the ends of the line, or the point twice</summary>
        public Float2 From;
        /// <summary>m, rest plane: the ends of the line, or the point twice</summary>
        public Float2 To;
        /// <summary>m, world</summary>
        public Float3 Target;
        /// <summary>of a line; of a point the identity</summary>
        public Float9 Rotation;
        /// <summary>N, or 0</summary>
        public float BreakForce;
        /// <summary>that the target moves with; 0: none</summary>
        public ObstacleId Obstacle;
    }

    /// <summary>A seam joins two lines in the material, of two sheets or of one: stitches join points at the same parts of both.
    /// Cuts go through a seam, and pieces keep their stitches. A stitch ends with the piece of a point (manual,
    /// sewing).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct SeamDef
    {
        internal uint cookie;
        /// <summary>of the same model, and not planar</summary>
        public SheetId SheetA;
        /// <summary>of the same model, and not planar</summary>
        public SheetId SheetB;
        /// <summary>2 floats a point, m, in the material, such as its edge; copied</summary>
        internal float* lineA;
        /// <summary>2 floats a point</summary>
        internal float* lineB;
        /// <summary>points: 2 to 65536</summary>
        internal int countA;
        /// <summary>points: 2 to 65536</summary>
        internal int countB;
        /// <summary>2 to 4096; 0 (default): three for two distances of frames</summary>
        public int Stitches;
        /// <summary>N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free</summary>
        public float Stiffness;
        /// <summary>rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal</summary>
        public float RestAngle;
        /// <summary>N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never</summary>
        public float BreakForce;

        /// <summary>With the defaults of the library.</summary>
        public static SeamDef Default
        {
            get
            {
                SeamDef def;
                Native.kiriDefaultSeamDef(&def);
                return def;
            }
        }
    }

    /// <summary>A stitch, as after the last tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Stitch
    {
        public SheetId SheetA;
        public SheetId SheetB;
        /// <summary>m, in the material</summary>
        public Float2 RestA;
        /// <summary>m, in the material</summary>
        public Float2 RestB;
        /// <summary>m, world: where both drawn lips meet; their middle while they are apart</summary>
        public Float3 Position;
        /// <summary>m: distance of the two points; a stitch yields by micrometres under the sheet's weight</summary>
        public float Gap;
        /// <summary>N, on sheet A: mean over the last tick that moved it</summary>
        public Float3 Force;
        /// <summary>rad, as restAngle</summary>
        public float Angle;
    }

    /// <summary>A contact of a point of the material: the plane dot(normal, x) = offset keeps the point on its upper side, with
    /// Coulomb friction. The host computes planes from the visible surface for each tick. Planes out of reach do
    /// nothing.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Contact
    {
        /// <summary>index of the collision point; -1: restPoint names the point</summary>
        public int Point;
        /// <summary>m, in the material; read only where point is -1</summary>
        public Float2 RestPoint;
        /// <summary>unit, out of the obstacle</summary>
        public Float3 Normal;
        /// <summary>m: of the obstacle's surface at the start of the tick</summary>
        public float Offset;
        /// <summary>m/s: of the obstacle at the contact. The plane moves with it within the tick</summary>
        public Float3 Velocity;
        /// <summary>0 or more: of both sides together</summary>
        public float Friction;
        /// <summary>1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid</summary>
        public float InverseMass;
        /// <summary>m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s</summary>
        public float PushSpeed;
        /// <summary>a number of the host. Contacts with one number press on one obstacle, and share its mass</summary>
        public int Obstacle;
    }

    /// <summary>The result of a contact in the last tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct ContactForce
    {
        /// <summary>N s, on the sheet: the sum over the tick. The obstacle gets the opposite</summary>
        public Double3 Impulse;
        /// <summary>m, world: the point of the sheet at the end of the tick</summary>
        public Double3 Position;
        /// <summary>m: of the point below the plane at the end of the tick; below 0: above it</summary>
        public double Depth;
        /// <summary>as in the contact</summary>
        public int Point;
        /// <summary>as in the contact</summary>
        public int Obstacle;
    }

    /// <summary>An obstacle: its shape, pose, motion, and mass.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct ObstacleDef
    {
        internal uint cookie;
        /// <summary>KIRI_OBSTACLE_...</summary>
        public ObstacleType Type;
        /// <summary>m</summary>
        public Float3 Size;
        /// <summary>m</summary>
        public float Radius;
        /// <summary>m</summary>
        public float Height;
        /// <summary>2 floats a corner, m, counter-clockwise; copied. Null: no prism</summary>
        internal float* outline;
        /// <summary>3 to 64</summary>
        internal int outlineCount;
        /// <summary>m, 0 or more: prisms and boxes grow by this, with round edges. Default 0</summary>
        public float Rounding;
        /// <summary>m, world</summary>
        public Float3 Position;
        /// <summary>columns; default: the axes of the world</summary>
        public Float9 Rotation;
        /// <summary>m/s, of its position</summary>
        public Float3 Velocity;
        /// <summary>rad/s</summary>
        public Float3 AngularVelocity;
        /// <summary>m/s, world: of its surface, added to its motion, as of a conveyor</summary>
        public Float3 SurfaceVelocity;
        /// <summary>0 or more; default 0.5</summary>
        public float Friction;
        /// <summary>kg; 0 (default): nothing moves it</summary>
        public float Mass;
        /// <summary>kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz. Positive
        /// definite, but for axes whose numbers are all 0: it does not turn about these</summary>
        public Float6 Inertia;
        /// <summary>m, from its position in its own axes</summary>
        public Float3 CenterOfMass;
        /// <summary>obstacles with the same number, except 0, are parts of one body; each has its whole mass</summary>
        public uint Body;
        /// <summary>m/s, above 0: maximum speed at which points inside are pushed out. Default 1</summary>
        public float PushSpeed;
        /// <summary>see the sheet def. Default: all</summary>
        public uint Groups;

        /// <summary>With the defaults of the library.</summary>
        public static ObstacleDef Default
        {
            get
            {
                ObstacleDef def;
                Native.kiriDefaultObstacleDef(&def);
                return def;
            }
        }
    }

    /// <summary>Pose, motion, and reaction of an obstacle.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct ObstacleState
    {
        public Float3 Position;
        public Float9 Rotation;
        public Float3 Velocity;
        public Float3 AngularVelocity;
        /// <summary>N s, N m s about its centre of mass: of sheets and pins in the last tick</summary>
        public Double3 Impulse;
        /// <summary>N s, N m s about its centre of mass: of sheets and pins in the last tick</summary>
        public Double3 AngularImpulse;
        /// <summary>that pushed in the last tick</summary>
        public int Contacts;
    }

    /// <summary>A corner to draw, in a layout for a GPU.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct DrawVertex
    {
        /// <summary>m, world</summary>
        public Float3 Position;
        /// <summary>red in its lowest byte, then green, blue, and opacity, which is 255</summary>
        public uint Color;
    }

    /// <summary>Flags, filter and functions of debug draw.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct DebugDraw
    {
        internal uint cookie;
        /// <summary>KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES</summary>
        public DrawFlag Flags;
        /// <summary>draws only this one, without obstacles and blades; 0 (default): all</summary>
        public SheetId Sheet;
        /// <summary>m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05</summary>
        public float Size;
        /// <summary>null: these are not drawn</summary>
        public IntPtr Points;
        /// <summary>the same</summary>
        public IntPtr Lines;
        /// <summary>the same</summary>
        public IntPtr Triangles;
        /// <summary>passed to these functions</summary>
        internal void* user;

        /// <summary>With the defaults of the library.</summary>
        public static DebugDraw Default
        {
            get
            {
                DebugDraw def;
                Native.kiriDefaultDebugDraw(&def);
                return def;
            }
        }
    }

    /// <summary>The functions as C has them.</summary>
    public static unsafe class Native
    {
#if (UNITY_IOS || UNITY_WEBGL) && !UNITY_EDITOR
        const string Library = "__Internal";
#else
        const string Library = "kiri";
#endif

        /// <summary>Of the header.</summary>
        public const int Version = 3400;
        public const int LeastTriangles = 16;
        public const int MostNoteBytes = 1048576;

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriGetVersion();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* kiriGetResultName(int result);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* kiriGetResultText(int result);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDefaultWorldDef(NativeWorldDef* @def);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreateWorld(NativeWorldDef* @def, IntPtr* world);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDestroyWorld(IntPtr world);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Tick(IntPtr world, float dt, int substeps);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* kiriWorld_GetLastError(IntPtr world);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_ShiftOrigin(IntPtr world, float* origin);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_SetGravity(IntPtr world, float* gravity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_SetBudget(IntPtr world, Budget* budget);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_GetStateHash(IntPtr world, ulong* hash);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_GetSheets(IntPtr world, SheetId* sheets, int capacity, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Note(IntPtr world, void* bytes, int count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Replay(IntPtr world, void* recording, long size, NativeReplay* replay);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Save(IntPtr world, void* bytes, long capacity, long* size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_FinishCuts(IntPtr world);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Load(IntPtr world, void* bytes, long size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Snapshot(IntPtr world, void* bytes, long capacity, long* size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Restore(IntPtr world, void* bytes, long size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_GetEvents(IntPtr world, Event** events, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_GetProfile(IntPtr world, Profile* profile);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFitBudget(Profile* profile, float microseconds, Budget* budget);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* kiriGetStageName(int stage);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriGetMaterial(int preset, Material* material);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriGetQuality(int preset, Quality* quality);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDefaultSheetDef(SheetDef* @def);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreateSheet(IntPtr world, SheetDef* @def, SheetId* sheet);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriDestroySheet(IntPtr world, SheetId sheet);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriGetSetup(int preset, float width, float height, SheetDef* @def);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreateRectangle(IntPtr world, float width, float height, int columns, int rows, SheetDef* @def, SheetId* sheet);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetSettings(IntPtr world, SheetId sheet, SheetSettings* settings);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetSettings(IntPtr world, SheetId sheet, SheetSettings* settings);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreateFoldedSheet(IntPtr world, SheetDef* @def, Fold* folds, int count, SheetId* sheet);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_AddFold(IntPtr world, SheetId sheet, Fold* fold, int* @index);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetFold(IntPtr world, SheetId sheet, int @index, FoldState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetFold(IntPtr world, SheetId sheet, int @index, float stiffness, float restAngle);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFillRectangle(float width, float height, int columns, int rows, float* restPositions, int* @indices);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetMesh(IntPtr world, SheetId sheet, NativeMesh* mesh);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetDirty(IntPtr world, SheetId sheet, uint sinceRevision, Dirty* dirty);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_CopyVertices(IntPtr world, SheetId sheet, int first, int count, void* positions, int positionStride, void* normals, int normalStride);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_CopyPrevious(IntPtr world, SheetId sheet, int first, int count, int* vertices, SheetId* from);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_CopyIndices16(IntPtr world, SheetId sheet, int firstTriangle, int count, ushort* @indices);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_CopySources(IntPtr world, SheetId sheet, int firstTriangle, int count, int* sources);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_CopySourceWeights(IntPtr world, SheetId sheet, int firstTriangle, int count, float* weights);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetSolid(IntPtr world, SheetId sheet, float thickness, NativeSolid* solid);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetCollisionPoints(IntPtr world, SheetId sheet, float** positions, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetCounts(IntPtr world, SheetId sheet, Counts* counts);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetTotals(IntPtr world, SheetId sheet, Totals* totals);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_EstimateError(IntPtr world, SheetId sheet, double* relative);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_IsAwake(IntPtr world, SheetId sheet, int* awake);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_Wake(IntPtr world, SheetId sheet);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_Transform(IntPtr world, SheetId sheet, float* rotation, float* translation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetVelocity(IntPtr world, SheetId sheet, float* velocity, float* angularVelocity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_SetPieceVelocity(IntPtr world, FrameId frame, float* velocity, float* angularVelocity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetUserData(IntPtr world, SheetId sheet, ulong data);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetUserData(IntPtr world, SheetId sheet, ulong* data);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_SetUserData(IntPtr world, PinId pin, ulong data);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_GetUserData(IntPtr world, PinId pin, ulong* data);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_SetPieceUserData(IntPtr world, FrameId frame, ulong data);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_GetPieceUserData(IntPtr world, FrameId frame, ulong* data);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_Raycast(IntPtr world, SheetId sheet, float* origin, float* direction, float maxDistance, Hit* hit);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_Raycast(IntPtr world, float* origin, float* direction, float maxDistance, SheetId* sheet, Hit* hit);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetPoint(IntPtr world, SheetId sheet, float* restPoint, PointState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetWeights(IntPtr world, SheetId sheet, float* restPoint, FrameId* frames, float* weights, float* gradients, int capacity, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetPiece(IntPtr world, SheetId sheet, int piece, PieceState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetPieceMesh(IntPtr world, SheetId sheet, int piece, NativePieceMesh* mesh);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetPieceFrames(IntPtr world, SheetId sheet, int piece, FrameId** frames, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_GetPiece(IntPtr world, FrameId frame, int* piece);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_DetachPiece(IntPtr world, FrameId frame, SheetId* detached);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_DestroyPiece(IntPtr world, FrameId frame);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_DetachPieces(IntPtr world, FrameId* frames, int count, SheetId* detached);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_DestroyPieces(IntPtr world, FrameId* frames, int count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_DropCrumbs(IntPtr world, SheetId sheet, float area, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriBeginCut(IntPtr world, SheetId sheet, float* restPoint, CutId* cut);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCut_Extend(IntPtr world, CutId cut, float* restPoints, int count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCut_End(IntPtr world, CutId cut);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_Cut(IntPtr world, SheetId sheet, float* restPoints, int count, CutId* cut);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_Slice(IntPtr world, SheetId sheet, float* blade, CutId* cut);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriGetTearing(int preset, Tearing* tearing);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetTearing(IntPtr world, SheetId sheet, Tearing* tearing);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetTearing(IntPtr world, SheetId sheet, Tearing* tearing);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetTearLine(IntPtr world, SheetId sheet, float* restPoints, int count, float factor);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriBeginBlade(IntPtr world, SheetId sheet, BladeId* blade);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriBlade_MoveEdge(IntPtr world, BladeId blade, float* from, float* to);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriBlade_MoveRay(IntPtr world, BladeId blade, float* origin, float* direction, float length);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriBlade_End(IntPtr world, BladeId blade);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetFrames(IntPtr world, SheetId sheet, FrameId* frames, int capacity, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_Hold(IntPtr world, FrameId frame, float* position, float* rotation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_GetState(IntPtr world, FrameId frame, FrameState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_GetReaction(IntPtr world, FrameId frame, double* force, double* torque);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_ApplyForce(IntPtr world, FrameId frame, float* force, float* torque);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_ApplyForce(IntPtr world, SheetId sheet, float* restPoint, float* force, float* torque);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_ApplyLineLoad(IntPtr world, SheetId sheet, float* from, float* to, float* forcePerLength);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_ApplyPressure(IntPtr world, SheetId sheet, float pressure);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_ApplyImpulse(IntPtr world, SheetId sheet, float* restPoint, float* impulse);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetWind(IntPtr world, SheetId sheet, Wind* wind);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDefaultPinDef(PinDef* @def);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreatePin(IntPtr world, SheetId sheet, PinDef* @def, PinId* pin);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriDestroyPin(IntPtr world, PinId pin);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_ClampLine(IntPtr world, SheetId sheet, float* from, float* to, PinId* clamp);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_HingeLine(IntPtr world, SheetId sheet, float* from, float* to, PinId* hinge);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_SetTarget(IntPtr world, PinId pin, float* target);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_SetPose(IntPtr world, PinId pin, float* target, float* rotation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_SetBreakForce(IntPtr world, PinId pin, float breakForce);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_GetState(IntPtr world, PinId pin, PinState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriPin_GetReaction(IntPtr world, PinId pin, double* force, double* torque);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetPins(IntPtr world, SheetId sheet, PinId* pins, int capacity, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDefaultSeamDef(SeamDef* @def);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreateSeam(IntPtr world, SeamDef* @def, SeamId* seam);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriDestroySeam(IntPtr world, SeamId seam);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSeam_SetHinge(IntPtr world, SeamId seam, float stiffness, float restAngle);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSeam_GetStitch(IntPtr world, SeamId seam, int @index, Stitch* stitch);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSeam_GetCount(IntPtr world, SeamId seam, int* stitches);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_GetSeams(IntPtr world, SeamId* seams, int capacity, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetContacts(IntPtr world, SheetId sheet, Contact* contacts, int count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetContactForces(IntPtr world, SheetId sheet, ContactForce** forces, int* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDefaultObstacleDef(ObstacleDef* @def);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriCreateObstacle(IntPtr world, ObstacleDef* @def, ObstacleId* obstacle);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriDestroyObstacle(IntPtr world, ObstacleId obstacle);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriObstacle_SetPose(IntPtr world, ObstacleId obstacle, float* position, float* rotation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriObstacle_SetVelocity(IntPtr world, ObstacleId obstacle, float* velocity, float* angularVelocity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriObstacle_SetSurfaceVelocity(IntPtr world, ObstacleId obstacle, float* velocity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriObstacle_SetMass(IntPtr world, ObstacleId obstacle, float mass, float* @inertia, float* centerOfMass);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriObstacle_GetState(IntPtr world, ObstacleId obstacle, ObstacleState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetReach(IntPtr world, SheetId sheet, float dt, float* lower, float* upper);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void kiriDefaultDebugDraw(DebugDraw* draw);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_DebugDraw(IntPtr world, DebugDraw* draw);
    }
}
