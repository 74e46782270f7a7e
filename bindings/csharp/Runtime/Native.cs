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

    public enum ResultCode
    {
        Ok = 0,
        /// <summary>done, and work is left for later ticks</summary>
        Pending = 1,
        /// <summary>null pointer, NaN, infinite, or outside the documented range; or a sheet or obstacle would be where floats
        /// end, or move that fast: 4e37 m, m/s or 1/s</summary>
        ErrorArgument = -1,
        /// <summary>the def was not filled by its kiriDefault function, all zeros say: call that first</summary>
        ErrorDef = -2,
        /// <summary>unknown or stale id, or the id of another kind</summary>
        ErrorId = -3,
        /// <summary>the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping</summary>
        ErrorMesh = -4,
        /// <summary>the call comes in the wrong order, or from a callback that may not make it</summary>
        ErrorState = -5,
        /// <summary>the allocator returned null</summary>
        ErrorMemory = -6,
        /// <summary>the motion of a sheet could not be continued; it was put to rest where it was</summary>
        Diverged = -7,
        /// <summary>all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world</summary>
        ErrorLimit = -8,
        /// <summary>floats are not computed as on other machines, see kiriCreateWorld</summary>
        ErrorBuild = -9,
        /// <summary>bytes that are damaged, cut short, of something else, or of a later version</summary>
        ErrorData = -10,
        /// <summary>a call that was made again gave something else than its recording has</summary>
        ErrorReplay = -11,
    }

    /// <summary>What happened since the start of the last tick that was not refused.</summary>
    public enum EventType
    {
        /// <summary>cut: all of it is in the mesh; the id is stale from now on</summary>
        CutFinished = 1,
        /// <summary>frame (its first, which names it), crumb, area: a connected part came off</summary>
        PieceOff = 2,
        /// <summary>frame</summary>
        FrameAdded = 3,
        /// <summary>the sheet was put to rest</summary>
        Diverged = 4,
        /// <summary>stage, waiting: the budget ended in this stage of the sheet's work</summary>
        Deferred = 5,
        /// <summary>pin: its force passed breakForce; the id is stale from now on</summary>
        PinBroke = 6,
        /// <summary>sheet (the new one), frame, area: what kiriFrame_DetachPiece left waiting is done</summary>
        PieceDetached = 7,
    }

    /// <summary>The stages of a tick in their order.</summary>
    public enum Stage
    {
        /// <summary>split the mesh along the blade</summary>
        Cut = 0,
        /// <summary>cells and what links them</summary>
        Grid = 1,
        /// <summary>geodesic distances, regions, links; placing of frames</summary>
        Regions = 2,
        /// <summary>shape functions</summary>
        Shape = 3,
        /// <summary>weights of vertices and collision points</summary>
        Samples = 4,
        /// <summary>mass, the pattern of the solver's matrix, and when all is put in force</summary>
        Constants = 5,
        /// <summary>what touches obstacles, other sheets and other pieces</summary>
        Contact = 6,
        /// <summary>the motion of the frames</summary>
        Solve = 7,
        /// <summary>positions and normals of the mesh</summary>
        Skin = 8,
        Count = 9,
    }

    /// <summary>Materials to start from; src/world/kiri_preset.c says where their numbers come from.</summary>
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
        Count = 4,
    }

    public enum QualityPreset
    {
        Fast = 0,
        Balanced = 1,
        Accurate = 2,
        Count = 3,
    }

    /// <summary>How a sheet deforms.</summary>
    public enum Model
    {
        /// <summary>Rigid frames joined by links: paper, foil, stiff cloth. 6 unknowns a frame, which its neighbours couple.</summary>
        Links = 0,
        /// <summary>Affine frames joined by links: cloth and rubber, whose stretch inside a region is seen. 12 unknowns a frame,
        /// which neighbours of neighbours couple: a tick takes five to seven times as long as with KIRI_MODEL_LINKS.
        /// From 1e8 Pa or so on it needs more `iterations`, 8 say.</summary>
        Affine = 1,
        /// <summary>Affine frames, strains at integration points: the scheme of the paper, to compare with. Weights that vary
        /// across a strip cannot bend it as a cylinder, however many points there are: a clamped strip on 9 frames goes
        /// 3, 20, 51 and 70 % too short a way down where it is a 10th, 20th, 50th and 400th of its length thick. 12
        /// unknowns a frame.</summary>
        Points = 2,
    }

    /// <summary>What is seen between the frames, and met by rays, blades, obstacles, other sheets, and contacts of rest points;
    /// pins, clamps and holds hold it. Where nothing touches or holds the sheet it does not change how that moves.
    /// Collision points stay on the linear surface.</summary>
    public enum Skinning
    {
        /// <summary>each frame carries a flat patch; the weights blend them (equation 1 of the paper)</summary>
        Linear = 0,
        /// <summary>each carries a patch that bends towards its neighbours: no bumps at the frames</summary>
        Smooth = 1,
    }

    /// <summary>How time is stepped. Both solve one linear system an iteration.</summary>
    public enum TimeStepping
    {
        /// <summary>TR-BDF2: trapezoid and BDF2 by turns, of second order. Motion lasts: of the energy of a swinging strip of 9
        /// frames 96 to 98 % is left after 10 s with 2 substeps a 60th of a second and 1 iteration, 99.7 % with 4.
        /// Backward Euler takes its place in the steps in which a contact touches a piece, a pin or hold is made, moved
        /// or removed, or a frame is new or turns by more than a radian.</summary>
        SecondOrder = 0,
        /// <summary>Backward Euler, of first order: takes energy out of all that swings, the more the longer the step. Of that
        /// strip's 0.4 % is left.</summary>
        Euler = 1,
    }

    /// <summary>What a pin holds.</summary>
    public enum PinType
    {
        Point = 0,
        Hinge = 1,
        Clamp = 2,
    }

    /// <summary>A body that sheets touch: a floor, a ball, a crate of another engine. Kiri moves no obstacle by forces. An
    /// obstacle goes on with its velocities; a host that moves bodies by an engine of its own sets pose and velocities
    /// before each tick, and gives the impulse that kiriObstacle_GetState tells to that engine after it. Contacts
    /// follow its motion within the tick, and push no harder than its mass resists. Sheets stay half their
    /// contactThickness away from it; that is what is seen of them, with smooth skinning too. A sheet that rests wakes
    /// where an obstacle near it comes, goes, or has moved by half a second of its sleepSpeed. Lengths of shapes are up
    /// to 1e6 m.</summary>
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
        /// <summary>outline: a convex polygon in the plane of the first two columns; height: along the third, 0: without end</summary>
        Prism = 5,
    }

    /// <summary>What is drawn.</summary>
    [Flags]
    public enum DrawFlag : uint
    {
        /// <summary>a triangle for each of the mesh, in a colour of its piece, pale where that sleeps</summary>
        Triangles = 1,
        /// <summary>a line for each edge between two triangles</summary>
        Edges = 2,
        /// <summary>a line for each edge of the outline and of lips</summary>
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

    /// <summary>The most work that one tick may do, over all sheets. 0: no limit. Triangles, cells and samples share one
    /// allowance: using 30 % of one leaves 70 % of the others. So the work on cuts takes no longer than the costliest
    /// of the three limits alone. A single step that exceeds the whole limit is not split. It runs alone in its tick.
    /// Work that does not fit goes on in the next tick. Until a cut takes effect its lips move together. All points of
    /// a sheet that are pending when work on them begins take effect together, whatever ticks they were given before.
    /// So the tick in which a cut takes effect depends on the budget, too. Its result does not: when all work is done,
    /// mesh, grid, regions, weights and sites of frames equal, bit for bit, a run of the same calls without a budget.
    /// Motion differs. Sheets take turns. In every other tick the sheet whose points came first is served first, in the
    /// ticks between the sheet whose work has used least. Pieces that wait to be detached get half of every other tick.
    /// An example at 60 Hz, with 2 ms of work on cuts a tick (about 32 000 cells and 4000 samples): a cut from side to
    /// side of 64 x 64 squares with 9 frames parts 17 to 100 ms after the blade has left, one of 127 x 127 squares with
    /// 24 frames 67 to 200 ms. A slow blade parts sooner, for its work is done on the way. tests/bench_swipe.c prints
    /// the table.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Budget
    {
        /// <summary>split by blades; 0, or KIRI_LEAST_TRIANGLES and more</summary>
        public int Triangles;
        /// <summary>looked at, or given another distance: grid, regions, shape functions; a link counts as many</summary>
        public int Cells;
        /// <summary>vertices and collision points with new weights; and what it takes to put all that is new in force at once,
        /// which is paid before</summary>
        public int Samples;
        /// <summary>work on linear systems, of 30 to 60 us each. A system counts 1, and 1 more for each 16 frames (5 of affine
        /// ones), for each 64 contacts, and for each 1280 products of blocks that its factorisation takes: in a square
        /// of 24, 289, 1000, 5000 frames it is 2, 36, 184, 2411. A sheet that gets fewer systems than its substeps
        /// takes longer ones. Where one system of all its pieces is more than what is left, they take turns: some are
        /// moved, the others stay where they are in this tick, with their velocity, and come first in the next; a sheet
        /// that gets none stands still, too. A piece whose system is more than the whole limit is moved alone</summary>
        public int Iterations;
    }

    /// <summary>Of a world: gravity, budget, and the host's functions.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativeWorldDef
    {
        public uint Cookie;
        /// <summary>m/s^2; default (0, 0, -9.81)</summary>
        public Float3 Gravity;
        /// <summary>default: no limit</summary>
        public Budget Budget;
        /// <summary>null: malloc and free. Both or none.</summary>
        public IntPtr Alloc;
        public IntPtr Free;
        /// <summary>one line for each error; null: silent</summary>
        public IntPtr Log;
        /// <summary>null: the profile counts, and shows no times</summary>
        public IntPtr Clock;
        /// <summary>null: a tick runs in its caller alone. Both or none.</summary>
        public IntPtr StartTask;
        public IntPtr FinishTask;
        /// <summary>threads that may work on a task, the caller of the tick with them, 0 to 1024: sizes ranges; up to 1: no task
        /// is started. Default 0</summary>
        public int WorkerCount;
        /// <summary>handed to the functions above</summary>
        public void* User;
        /// <summary>gets the recording of the world, see kiriWorld_Replay; null: there is none</summary>
        public IntPtr Record;
        /// <summary>the recording has the state hash after so many ticks, and at the end; 0: never. Default 60</summary>
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

    /// <summary>How far a replay has come: all zero at its start.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativeReplay
    {
        /// <summary>in the recording: where it goes on</summary>
        public long Offset;
        /// <summary>made so far</summary>
        public long Calls;
        /// <summary>that were not refused</summary>
        public long Ticks;
        /// <summary>where it stopped at a note: its bytes, in the recording; else null</summary>
        public void* Note;
        public int NoteCount;
    }

    /// <summary>Of the fields after `sheet` an event has those that its type names; the others are 0, `stage` is -1.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Event
    {
        /// <summary>KIRI_EVENT_...</summary>
        public EventType Type;
        public SheetId Sheet;
        /// <summary>or 0</summary>
        public CutId Cut;
        /// <summary>or 0</summary>
        public FrameId Frame;
        /// <summary>or 0</summary>
        public PinId Pin;
        /// <summary>1: the piece is a crumb, see kiriSheetDef</summary>
        public Flag Crumb;
        /// <summary>m^2 of the piece, or 0</summary>
        public float Area;
        /// <summary>KIRI_STAGE_..., or -1</summary>
        public Stage Stage;
        /// <summary>blade points and ends of cuts that are pending or being worked on; or 0</summary>
        public int Waiting;
    }

    /// <summary>What the last tick did, and what it took.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Profile
    {
        /// <summary>of the last tick; zero without a clock</summary>
        public Double9 Seconds;
        /// <summary>blade segments that took effect</summary>
        public int CutSegments;
        /// <summary>Items, as the budget counts them: more than what is split or weighed, where one takes more work.</summary>
        public int TrianglesSplit;
        /// <summary>Items, as the budget counts them: more than what is split or weighed, where one takes more work.</summary>
        public int CellsSettled;
        /// <summary>Items, as the budget counts them: more than what is split or weighed, where one takes more work.</summary>
        public int SamplesRefreshed;
        /// <summary>Items, as the budget counts them: more than what is split or weighed, where one takes more work.</summary>
        public int SolverIterations;
        /// <summary>What commits changed: cells made or with other material, cells with other weights, vertices and collision
        /// points with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.</summary>
        public int CellsChanged;
        /// <summary>What commits changed: cells made or with other material, cells with other weights, vertices and collision
        /// points with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.</summary>
        public int WeightsChanged;
        /// <summary>What commits changed: cells made or with other material, cells with other weights, vertices and collision
        /// points with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.</summary>
        public int VerticesChanged;
        /// <summary>What commits changed: cells made or with other material, cells with other weights, vertices and collision
        /// points with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.</summary>
        public int PointsChanged;
        /// <summary>What commits changed: cells made or with other material, cells with other weights, vertices and collision
        /// points with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.</summary>
        public int LinksChanged;
        /// <summary>sheets in which a cut took effect</summary>
        public int Commits;
        /// <summary>linear systems, large and small</summary>
        public int SystemsSolved;
        /// <summary>planes given to the solver: the host's, those of obstacles, and those between sheets</summary>
        public int Contacts;
        /// <summary>pairs of sheets or pieces, near each other and not both asleep</summary>
        public int SheetPairs;
        /// <summary>The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went
        /// by a fade.</summary>
        public double LargestJump;
        /// <summary>The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went
        /// by a fade.</summary>
        public double LargestFade;
    }

    /// <summary>What a sheet is made of: homogeneous, isotropic.</summary>
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
        /// <summary>1/s, 0 or more: velocities fade as exp(-airDamping t)</summary>
        public float AirDamping;
        /// <summary>s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation</summary>
        public float FlexDamping;
    }

    /// <summary>How much work for how much accuracy. The presets are measured (`make accuracy`; tests/sweep.h has the scenes) on
    /// a strip of stiff paper, 0.2 m x 0.05 m, clamped at one end, with one row of frames, and on a square of 0.2 m
    /// that bends five times as easily, hangs by two corners, and has half as many rows and columns, rounded up. Let
    /// go, they swing for 0.4 s at 60 ticks a second. Error: rms distance of the vertices from where a much finer run
    /// brings them, by the rms way that they go; at most, over grids from 4/5 to 5/4 as fine and with frames in regular
    /// rows or moved a little. FAST: 2 %. BALANCED: 0.8 %. ACCURATE: 0.4 %. What a cut leaves narrow wants more frames:
    /// see `accuracy` in the sheet def.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Quality
    {
        /// <summary>control frames in a row along a strip; a square does with half as many in either direction, rounded up: 3 x
        /// 3, 5 x 5, 9 x 9</summary>
        public int FramesAlong;
        /// <summary>for the sheet def</summary>
        public int GridResolution;
        /// <summary>for the sheet def</summary>
        public int Iterations;
        /// <summary>for kiriWorld_Tick</summary>
        public int Substeps;
    }

    /// <summary>The paper's own ways, to compare with; part of the sheet def.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PaperOptions
    {
        /// <summary>1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the same bit for bit.
        /// Default 0.</summary>
        public Flag FromScratch;
        /// <summary>1: when a cut takes effect, only new frames take their motion from the surface: what is seen jumps, and
        /// momentum is not kept. Default 0.</summary>
        public Flag Popping;
        /// <summary>1: the weights of frames are linear on the way from frame to frame, so the surface that is seen has a kink
        /// at each frame. Always so with KIRI_MODEL_POINTS. Default 0: their slope is zero at the frames.</summary>
        public Flag LinearWeights;
        /// <summary>KIRI_MODEL_POINTS only. Work grows with the points: spread evenly over the sheet, at least one in every
        /// piece; default 0: four for each of frameCount. Order 1 (default) takes the strain at a point for all of the
        /// material around it, order 2 a strain linear in it, at four times the work a point. 0 to 1048576</summary>
        public int IntegrationPoints;
        /// <summary>1 or 2</summary>
        public int IntegrationOrder;
    }

    /// <summary>Of a sheet: its rest shape, where it starts, its material, and how it is computed.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct SheetDef
    {
        internal uint cookie;
        /// <summary>The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge. Holes and several
        /// parts are fine. Copied by kiriCreateSheet; vertices of no triangle are left out. Edges whose ends lie at the
        /// same places, but are different vertices, are the lips of a cut that is there already; weldDistance closes
        /// them. 2 floats (u, v) a vertex</summary>
        internal float* restPositions;
        internal int vertexCount;
        /// <summary>3 a triangle</summary>
        internal int* indices;
        internal int triangleCount;
        /// <summary>Where it starts: x = position + u axisU + v axisV. The axes are orthonormal.</summary>
        public Float3 Position;
        public Float3 AxisU;
        public Float3 AxisV;
        /// <summary>m/s</summary>
        public Float3 Velocity;
        public Material Material;
        /// <summary>grid squares along the longer side, 1 to 4096; default 32</summary>
        public int GridResolution;
        /// <summary>m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a cut keeps within
        /// half of it of its line; 0: 1e-4 of the longer side</summary>
        public float SnapDistance;
        /// <summary>Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture coordinates, and
        /// triangles without shared vertices (STL). In the order of vertices, each becomes the nearest vertex that was
        /// kept before and is nearer than this; else it is kept. So none moves farther, and a chain of near vertices is
        /// not one point. A triangle with two corners at one vertex is left out. kiriSheet_CopySources leads to the
        /// vertices of the def. Default 0: vertices are as the indices say.</summary>
        public float WeldDistance;
        /// <summary>Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null:
        /// frameCount frames are spread evenly, some of them in pairs at both sides of slit ends. The grid carries one
        /// frame for every two squares of material at most: more are refused (KIRI_ERROR_ARGUMENT), and re-sampling
        /// stops there. A new sheet has no more frames than frameCount, or than pieces where these are more. frameCount
        /// 0: as many as the sheet needs: a region is split while its size, 2.45 times its radius of gyration, exceeds
        /// 1.25 frameLength, after cuts too: so arms that a cut leaves get frames along them. frameLength 0: it follows
        /// from `accuracy`, the relative error of the shape under the sheet's own weight that is good enough, but is
        /// three squares of the grid at least. kiriSheet_EstimateError says what came of it. 0, or 1 and more; default
        /// 5</summary>
        public int FrameCount;
        /// <summary>m; used where frameCount is 0; default 0</summary>
        public float FrameLength;
        /// <summary>1e-4 to 1; used where frameCount and frameLength are 0; default 0.02</summary>
        public float Accuracy;
        internal float* framePoints;
        /// <summary>re-sampling stops here; default 256</summary>
        public int MaxFrames;
        /// <summary>Re-sampling (section 5 of the paper): a frame whose weight exceeds rigidWeight over an area larger than
        /// rigidArea (m^2) gets others beside it. In a new sheet this is done only with frameCount 0. After cuts it is
        /// done where the area is also larger than in the new sheet: when a cut ends, or has met the border or another
        /// cut. A sheet that is to stay rigid sets frameCount and maxFrames to 1. rigidArea 0: a quarter of the area
        /// that a frame has at the start. default 0.95</summary>
        public float RigidWeight;
        /// <summary>default 0</summary>
        public float RigidArea;
        /// <summary>A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it.
        /// Default 0.</summary>
        public float CrumbArea;
        /// <summary>Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the
        /// geometric mean. Default 0.5</summary>
        public float Friction;
        /// <summary>m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's
        /// thickness, a 20th of a grid square at least. Default 0</summary>
        public float ContactThickness;
        /// <summary>obstacles and sheets touch where a bit is set in the groups of both. Default: all</summary>
        public uint Groups;
        /// <summary>1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is
        /// planar. Of two pieces that are near each other the one that lies above, against gravity, is kept on its side
        /// of the other by planes; side by side the one that nothing holds, or the lighter one. So piles keep their
        /// order. The lower one feels what presses on it within 0.3 s: weight acts in full, an impact does so only
        /// while the upper one stays, and momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s.
        /// A sheet feels others by its vertices, about one a grid square and more along borders: two edges that cross
        /// are not seen. A piece that wraps around the border of another, so that it lies on both sides of it, has one
        /// side all the same. Folds of one piece do not touch each other. Pieces that touch wake and fall asleep
        /// together. Default 0.</summary>
        public Flag TouchesSheets;
        /// <summary>spread evenly over the sheet, at least one in every piece; default 0: none</summary>
        public int CollisionPoints;
        /// <summary>Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual</summary>
        public int Iterations;
        /// <summary>A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second
        /// falls asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when
        /// that takes effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell
        /// asleep with; something that moves and comes near. Gravity, wind, settings and kiriSheet_Wake wake all pieces
        /// of the sheet. The ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.</summary>
        public float SleepSpeed;
        /// <summary>KIRI_MODEL_..., default KIRI_MODEL_LINKS</summary>
        public Model Model;
        /// <summary>KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR</summary>
        public Skinning Skinning;
        /// <summary>1: the sheet stays in the plane where it starts, without bending; what velocities, forces and held positions
        /// have across the plane is dropped. 3 unknowns a rigid frame, 6 an affine one: two thirds of the solver's
        /// work, or about a third. Default 0.</summary>
        public Flag Planar;
        /// <summary>KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER</summary>
        public TimeStepping TimeStepping;
        /// <summary>When a cut takes effect, weights change, and what is seen between the frames would jump. The difference
        /// fades within this time (s). So does the difference of strain in links of KIRI_MODEL_LINKS whose borders have
        /// moved. Default 0.2; 0: at once.</summary>
        public float FadeTime;
        /// <summary>1: normals of the mesh are made in every tick. 0: kiriMesh has none, and kiriSheet_CopyVertices copies none;
        /// this saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of
        /// obstacles or other sheets touch it, the tick makes normals for itself. So does kiriSheet_GetSolid; and what
        /// kiriSheet_GetPoint says is the same to rounding. Default 1.</summary>
        public Flag Normals;
        /// <summary>default: none of the paper's own ways</summary>
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

    /// <summary>What of the def may be changed while the sheet lives, as there. kiriSheet_GetSettings stamps it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct SheetSettings
    {
        internal uint cookie;
        public Material Material;
        /// <summary>re-sampling stops here; default 256</summary>
        public int MaxFrames;
        /// <summary>A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it.
        /// Default 0.</summary>
        public float CrumbArea;
        /// <summary>Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the
        /// geometric mean. Default 0.5</summary>
        public float Friction;
        /// <summary>m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's
        /// thickness, a 20th of a grid square at least. Default 0</summary>
        public float ContactThickness;
        /// <summary>obstacles and sheets touch where a bit is set in the groups of both. Default: all</summary>
        public uint Groups;
        /// <summary>1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is
        /// planar. Of two pieces that are near each other the one that lies above, against gravity, is kept on its side
        /// of the other by planes; side by side the one that nothing holds, or the lighter one. So piles keep their
        /// order. The lower one feels what presses on it within 0.3 s: weight acts in full, an impact does so only
        /// while the upper one stays, and momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s.
        /// A sheet feels others by its vertices, about one a grid square and more along borders: two edges that cross
        /// are not seen. A piece that wraps around the border of another, so that it lies on both sides of it, has one
        /// side all the same. Folds of one piece do not touch each other. Pieces that touch wake and fall asleep
        /// together. Default 0.</summary>
        public Flag TouchesSheets;
        /// <summary>Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual</summary>
        public int Iterations;
        /// <summary>A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second
        /// falls asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when
        /// that takes effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell
        /// asleep with; something that moves and comes near. Gravity, wind, settings and kiriSheet_Wake wake all pieces
        /// of the sheet. The ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.</summary>
        public float SleepSpeed;
        /// <summary>KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR</summary>
        public Skinning Skinning;
        /// <summary>KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER</summary>
        public TimeStepping TimeStepping;
        /// <summary>stays 0 with paper.popping</summary>
        public float FadeTime;
        /// <summary>1: normals of the mesh are made in every tick. 0: kiriMesh has none, and kiriSheet_CopyVertices copies none;
        /// this saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of
        /// obstacles or other sheets touch it, the tick makes normals for itself. So does kiriSheet_GetSolid; and what
        /// kiriSheet_GetPoint says is the same to rounding. Default 1.</summary>
        public Flag Normals;
    }

    /// <summary>The triangles that are seen, as after the last tick. revision grows whenever indices or vertices are added or
    /// changed. Rest positions are floats, 6e-8 of the distance from the origin of the rest plane apart: where
    /// triangles are not much larger than that, they look flat or inverted. The library computes with the positions of
    /// the def to 2^-29 of the sheet; sourceTriangles and sourceWeights are as exact as the sheet is large.</summary>
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
        /// <summary>1 a vertex: the triangle of the def that it lies in,</summary>
        public int* sourceTriangles;
        /// <summary>3 a vertex: and its barycentric coordinates there</summary>
        public float* sourceWeights;
        public int vertexCount;
        public int triangleCount;
        public uint Revision;
    }

    /// <summary>So many items from the first on.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Range
    {
        public int First;
        public int Count;
    }

    /// <summary>What has changed in the mesh, for hosts that keep a copy of it, on a GPU say. Positions and normals change with
    /// every tick; all else of a vertex, and the corners of a triangle, only in these ranges.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Dirty
    {
        /// <summary>up to the last one of the mesh</summary>
        public Range NewVertices;
        /// <summary>up to the last one of the mesh</summary>
        public Range NewTriangles;
        /// <summary>the least ranges that hold all older ones with other data</summary>
        public Range OldVertices;
        /// <summary>the least ranges that hold all older ones with other data</summary>
        public Range OldTriangles;
        /// <summary>for the next call</summary>
        public uint Revision;
    }

    /// <summary>The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the lips of cuts.
    /// First come the vertices of kiriMesh on the side that the normal leaves, then the same on the other side, then
    /// four for each edge of the border, so that rims are flat and their edges sharp.</summary>
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
        /// <summary>1 a vertex: that of kiriMesh which it stands on</summary>
        public int* sources;
        public int vertexCount;
        public int triangleCount;
        /// <summary>from this one on triangles are rims</summary>
        public int RimTriangle;
    }

    /// <summary>How many there are of each.</summary>
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

    /// <summary>Area (m^2), mass (kg), kinetic energy and elastic energy (J), linear and angular momentum about the world's
    /// origin (kg m/s, kg m^2/s), centre of mass (m).</summary>
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

    /// <summary>What a ray meets.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Hit
    {
        /// <summary>where to cut</summary>
        public Float2 RestPoint;
        public Float3 Position;
        public Float3 Normal;
        /// <summary>m along the direction, which need not be a unit vector</summary>
        public float Distance;
        public int Triangle;
    }

    /// <summary>A point of the material, as it is seen.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PointState
    {
        /// <summary>m, world; unit</summary>
        public Float3 Position;
        /// <summary>m, world; unit</summary>
        public Float3 Normal;
        /// <summary>m/s, by the weights of the point</summary>
        public Float3 Velocity;
        /// <summary>in whose region it is; it names the piece, too</summary>
        public FrameId Frame;
    }

    /// <summary>The connected parts of a sheet. A piece is named by any of its frames. To go through all of them there are
    /// indices too, from 0 on to kiriCounts.pieces, in the order of first frames: they change when a piece comes off or
    /// is taken away; kiriFrame_GetPiece has that of now. A cut whose work waits for its budget has not parted anything
    /// yet. Momentum is about the world's origin.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PieceState
    {
        /// <summary>m^2, kg</summary>
        public double Area;
        /// <summary>m^2, kg</summary>
        public double Mass;
        /// <summary>of mass, m; kg m/s; kg m^2/s</summary>
        public Double3 Center;
        /// <summary>of mass, m; kg m/s; kg m^2/s</summary>
        public Double3 Momentum;
        /// <summary>of mass, m; kg m/s; kg m^2/s</summary>
        public Double3 AngularMomentum;
        /// <summary>m, world: the least box around its vertices</summary>
        public Float3 Lower;
        /// <summary>m, world: the least box around its vertices</summary>
        public Float3 Upper;
        /// <summary>how many</summary>
        public int Frames;
        /// <summary>how many</summary>
        public int Vertices;
        /// <summary>how many</summary>
        public int Triangles;
        /// <summary>how many</summary>
        public int CollisionPoints;
        /// <summary>1: see kiriSheetDef</summary>
        public Flag Crumb;
        /// <summary>1: see sleepSpeed</summary>
        public Flag Asleep;
    }

    /// <summary>What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece after piece.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct NativePieceMesh
    {
        /// <summary>of kiriMesh</summary>
        public int* vertices;
        /// <summary>of kiriMesh</summary>
        public int* triangles;
        /// <summary>3 a triangle, as in kiriMesh: draw them</summary>
        public int* indices;
        /// <summary>see kiriSheet_GetCollisionPoints</summary>
        public int* collisionPoints;
        public int vertexCount;
        public int triangleCount;
        public int collisionPointCount;
    }

    /// <summary>Pose, motion and region of a frame.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct FrameState
    {
        public Float2 RestPoint;
        /// <summary>of the rest point</summary>
        public Float3 Position;
        /// <summary>columns: direction of u, direction of v, normal; of an affine frame the columns of A, which stretch with the
        /// sheet</summary>
        public Float9 Rotation;
        /// <summary>m/s</summary>
        public Float3 Velocity;
        /// <summary>rad/s</summary>
        public Float3 AngularVelocity;
        /// <summary>m^2 of its region</summary>
        public float Area;
        /// <summary>kg</summary>
        public float Mass;
        /// <summary>1: moved by the host, see kiriFrame_Hold</summary>
        public Flag Held;
    }

    /// <summary>Air that moves past the sheet, in every tick until the next call. On each square metre act, with v the velocity
    /// of the air less that of the material, and n the normal: density / 2 times |v| (drag (v.n) n + lift (v - (v.n)
    /// n)). Zero velocity with drag and lift above zero: still air, which resists. All zero: none. It acts at four
    /// points of the region of each frame, and follows its motion within the tick: sheets flutter, and no wind is too
    /// strong. Gusts are a call a tick. Wind that stays as it is lets a sheet sleep.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Wind
    {
        /// <summary>m/s</summary>
        public Float3 Velocity;
        /// <summary>kg/m^3, 0 or more; 1.2 of air</summary>
        public float Density;
        /// <summary>0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along the sheet,
        /// 0.01 or so of a smooth one</summary>
        public float Drag;
        /// <summary>0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along the sheet,
        /// 0.01 or so of a smooth one</summary>
        public float Lift;
    }

    /// <summary>A pin holds a point of the material at its target, by a spring.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PinDef
    {
        internal uint cookie;
        /// <summary>in the material</summary>
        public Float2 RestPoint;
        /// <summary>m, world: where it is held</summary>
        public Float3 Target;
        /// <summary>N/m; 0: ten times Young's modulus times thickness</summary>
        public float Stiffness;
        /// <summary>N: it breaks (KIRI_EVENT_PIN_BROKE) in a tick in which it held with more; 0: never</summary>
        public float BreakForce;
        /// <summary>or 0. The target goes with this obstacle from where it is when the pin is made, or kiriPin_SetTarget puts
        /// it, and the obstacle feels the pin (kiriObstacle_GetState); one with mass yields to it within the tick. When
        /// it is destroyed the target stays where it was</summary>
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

    /// <summary>What a pin is, and where it holds.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct PinState
    {
        /// <summary>KIRI_PIN_...</summary>
        public PinType Type;
        public SheetId Sheet;
        /// <summary>rest position: of a point, twice, or of the ends of the line</summary>
        public Float2 From;
        /// <summary>rest position: of a point, twice, or of the ends of the line</summary>
        public Float2 To;
        public Float3 Target;
        /// <summary>of a line; of a point the identity</summary>
        public Float9 Rotation;
        /// <summary>N, or 0</summary>
        public float BreakForce;
        /// <summary>that it goes with, or 0</summary>
        public ObstacleId Obstacle;
    }

    /// <summary>A point of the material that touches something: the plane dot(normal, x) = offset keeps it on its upper side,
    /// with as much force as that takes, and Coulomb friction acts along the plane. The plane is that of an obstacle of
    /// the host, who finds it anew for each tick from where the sheet is seen. A contact may lie in the path of the
    /// point, above or below it: one that does not reach its plane in the tick costs little and does nothing.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Contact
    {
        /// <summary>index of the collision point; -1: restPoint says which point of the material</summary>
        public int Point;
        /// <summary>in the material; only read where point is -1</summary>
        public Float2 RestPoint;
        /// <summary>unit, out of the obstacle</summary>
        public Float3 Normal;
        /// <summary>m: of the obstacle's surface at the start of the tick</summary>
        public float Offset;
        /// <summary>m/s: of the obstacle there. The plane moves with it within the tick, and friction acts against the sliding
        /// that is left</summary>
        public Float3 Velocity;
        /// <summary>0 or more: of both sides together</summary>
        public float Friction;
        /// <summary>1/kg, 0 or more: of the obstacle as felt along the normal there, 1/m + (r x n) . I^-1 (r x n); 0: it does
        /// not yield</summary>
        public float InverseMass;
        /// <summary>m/s, 0 or more: a point that starts below the plane is pushed out no faster. 0: 1 m/s</summary>
        public float PushSpeed;
        /// <summary>the host's number. Contacts of one number press on one obstacle, and share its mass</summary>
        public int Obstacle;
    }

    /// <summary>What a contact did in the last tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct ContactForce
    {
        /// <summary>N s, on the sheet: the sum over the tick. The obstacle gets the opposite</summary>
        public Double3 Impulse;
        /// <summary>m, world: where it acted, the point of the sheet at the end of the tick</summary>
        public Double3 Position;
        /// <summary>m: how deep the point is below the plane at the end of the tick; below 0: above it</summary>
        public double Depth;
        /// <summary>as in the contact</summary>
        public int Point;
        /// <summary>as in the contact</summary>
        public int Obstacle;
    }

    /// <summary>Of an obstacle: its shape, where it is, its motion, and its mass.</summary>
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
        /// <summary>2 floats a corner, m, counter-clockwise; copied</summary>
        internal float* outline;
        /// <summary>3 to 64</summary>
        internal int outlineCount;
        /// <summary>m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0</summary>
        public float Rounding;
        /// <summary>m, world</summary>
        public Float3 Position;
        /// <summary>columns; default: the axes of the world</summary>
        public Float9 Rotation;
        /// <summary>m/s, of its position</summary>
        public Float3 Velocity;
        /// <summary>rad/s</summary>
        public Float3 AngularVelocity;
        /// <summary>m/s, world: of its surface beside that, as of a conveyor</summary>
        public Float3 SurfaceVelocity;
        /// <summary>0 or more; default 0.5</summary>
        public float Friction;
        /// <summary>kg; 0 (default): nothing moves it</summary>
        public float Mass;
        /// <summary>kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz. Positive definite,
        /// but for axes whose numbers are all 0: it does not turn about these</summary>
        public Float6 Inertia;
        /// <summary>m, from its position in its own axes</summary>
        public Float3 CenterOfMass;
        /// <summary>obstacles of the same number, but 0, are parts of one body, whose mass each of them has</summary>
        public uint Body;
        /// <summary>m/s, above 0: what is inside is pushed out no faster. Default 1</summary>
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

    /// <summary>Where it is now, with what it moves, and what it felt.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct ObstacleState
    {
        public Float3 Position;
        public Float9 Rotation;
        public Float3 Velocity;
        public Float3 AngularVelocity;
        /// <summary>N s, N m s about its centre of mass: what sheets and pins gave it in the last tick</summary>
        public Double3 Impulse;
        /// <summary>N s, N m s about its centre of mass: what sheets and pins gave it in the last tick</summary>
        public Double3 AngularImpulse;
        /// <summary>that pushed in the last tick</summary>
        public int Contacts;
    }

    /// <summary>A corner of what is drawn: as it is, it may go to a GPU.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct DrawVertex
    {
        /// <summary>m, world</summary>
        public Float3 Position;
        /// <summary>red in its lowest byte, then green, blue, and opacity, which is 255</summary>
        public uint Color;
    }

    /// <summary>What is drawn, and by whom.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct DebugDraw
    {
        internal uint cookie;
        /// <summary>KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES</summary>
        public DrawFlag Flags;
        /// <summary>only this one is drawn, without obstacles and blades; 0 (default): all</summary>
        public SheetId Sheet;
        /// <summary>m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05</summary>
        public float Size;
        /// <summary>null: these are not drawn</summary>
        public IntPtr Points;
        /// <summary>the same</summary>
        public IntPtr Lines;
        /// <summary>the same</summary>
        public IntPtr Triangles;
        /// <summary>handed to these functions</summary>
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
        public const int Version = 1200;
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
        public static extern int kiriWorld_SetGravity(IntPtr world, float* gravity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriWorld_ShiftOrigin(IntPtr world, float* origin);

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
        public static extern int kiriCreateRectangle(IntPtr world, float width, float height, int columns, int rows, SheetDef* @def, SheetId* sheet);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_GetSettings(IntPtr world, SheetId sheet, SheetSettings* settings);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriSheet_SetSettings(IntPtr world, SheetId sheet, SheetSettings* settings);

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
        public static extern int kiriSheet_Slice(IntPtr world, SheetId sheet, float* blade, CutId* cut);

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
        public static extern int kiriFrame_GetState(IntPtr world, FrameId frame, FrameState* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int kiriFrame_Hold(IntPtr world, FrameId frame, float* position, float* rotation);

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
        public static extern int kiriDestroyPin(IntPtr world, PinId pin);

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
