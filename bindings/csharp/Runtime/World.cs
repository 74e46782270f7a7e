using System;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;

namespace Kiri
{
    /// <summary>Whether work is left for later ticks.</summary>
    public enum Status { Done, Pending }

    /// <summary>0 or 1, as C has it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Flag
    {
        int value;

        public static implicit operator bool(Flag flag) { return flag.value != 0; }
        public static implicit operator Flag(bool value) { return new Flag { value = value ? 1 : 0 }; }
    }

    /// <summary>What a call refuses: what it is, and a line that says why.</summary>
    public sealed unsafe class KiriException : Exception
    {
        public readonly ResultCode Code;

        internal KiriException(ResultCode code, string call, string line)
            : base(call + ": " + Own(line != "" ? line : World.Text(Native.kiriGetResultText((int)code))) + " (" + code + ")")
        {
            Code = code;
        }

        // A line of C begins with its name for the call, and ends with the code; fields are named as in C.
        static string Own(string line)
        {
            return Regex.Replace(Regex.Replace(line, @"^kiri\w+: | \(KIRI_\w+\)$", ""), @"\.[a-z]", field => field.Value.ToUpperInvariant());
        }
    }

    /// <summary>The host's functions. None of these may throw, or use the world.</summary>
    public sealed unsafe class Hooks
    {
        /// <summary>Gets one line for each error.</summary>
        public Action<string> Log;
        /// <summary>Seconds; read for the profile only.</summary>
        public Func<double> Clock;
        /// <summary>Gets the recording of the world, so many bytes at a time, see Replay.</summary>
        public Action<IntPtr, int> Record;

        // The last line of the log of this thread: what a call that only reads says of its error.
        [ThreadStatic] internal static string Line;

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)] delegate void LogFn(IntPtr user, IntPtr line);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)] delegate double ClockFn(IntPtr user);
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)] delegate void RecordFn(IntPtr user, IntPtr bytes, int count);

        static readonly LogFn onLog = OnLog;
        static readonly ClockFn onClock = OnClock;
        static readonly RecordFn onRecord = OnRecord;

        static Hooks Of(IntPtr user) { return (Hooks)GCHandle.FromIntPtr(user).Target; }

        internal void FillIn(ref NativeWorldDef def)
        {
            def.Log = Marshal.GetFunctionPointerForDelegate(onLog);
            if (Clock != null) def.Clock = Marshal.GetFunctionPointerForDelegate(onClock);
            if (Record != null) def.Record = Marshal.GetFunctionPointerForDelegate(onRecord);
        }

#if ENABLE_IL2CPP
        [AOT.MonoPInvokeCallback(typeof(LogFn))]
#endif
        static void OnLog(IntPtr user, IntPtr line)
        {
            Line = Marshal.PtrToStringAnsi(line);
            Hooks hooks = Of(user);
            if (hooks.Log != null) hooks.Log(Line);
        }

#if ENABLE_IL2CPP
        [AOT.MonoPInvokeCallback(typeof(ClockFn))]
#endif
        static double OnClock(IntPtr user) { return Of(user).Clock(); }

#if ENABLE_IL2CPP
        [AOT.MonoPInvokeCallback(typeof(RecordFn))]
#endif
        static void OnRecord(IntPtr user, IntPtr bytes, int count) { Of(user).Record(bytes, count); }
    }

    public static unsafe partial class Library
    {
        /// <summary>10000 major + 100 minor + patch.</summary>
        public static int Version { get { return Native.kiriGetVersion(); } }
    }

    /// <summary>All sheets and what they touch. One thread at a time changes it.</summary>
    public sealed unsafe partial class World : IDisposable
    {
        IntPtr handle;
        GCHandle hooks;

        /// <summary>Grows where views end: with a tick, and with the world.</summary>
        internal int Epoch;

        public World() : this(new Float3(0.0f, 0.0f, -9.81f)) { }

        public World(Float3 gravity, Hooks hooks = null)
        {
            NativeWorldDef def = NativeWorldDef.Default;
            def.Gravity = gravity;
            Create(def, hooks);
        }

        /// <summary>With functions of C in the def. Its user, log, clock and record are those of the hooks.</summary>
        public World(NativeWorldDef def, Hooks hooks = null) { Create(def, hooks); }

        void Create(NativeWorldDef def, Hooks hooks)
        {
            if (Native.kiriGetVersion() != Native.Version)
                throw new DllNotFoundException("libkiri is of version " + Native.kiriGetVersion() + ", wanted is " + Native.Version);
            hooks = hooks ?? new Hooks();
            this.hooks = GCHandle.Alloc(hooks);
            def.User = GCHandle.ToIntPtr(this.hooks).ToPointer();
            hooks.FillIn(ref def);
            IntPtr made;
            int result = Native.kiriCreateWorld(&def, &made);
            if (result < 0) this.hooks.Free();
            CheckRead(result, "World");
            handle = made;
        }

        ~World() { Free(); }

        public void Dispose()
        {
            Free();
            GC.SuppressFinalize(this);
        }

        void Free()
        {
            if (handle == IntPtr.Zero) return;
            EndViews();
            Native.kiriDestroyWorld(handle);
            handle = IntPtr.Zero;
            hooks.Free();
        }

        /// <summary>For the functions of Native.</summary>
        public IntPtr Handle
        {
            get
            {
                if (handle == IntPtr.Zero) throw new ObjectDisposedException("World");
                return handle;
            }
        }

        /// <summary>What went wrong in the last call that changes the world, in one line.</summary>
        public string LastError { get { return Text(Native.kiriWorld_GetLastError(Handle)); } }

        void EndViews() { ++Epoch; }

        internal int Check(int result, string call)
        {
            if (result < 0) throw new KiriException((ResultCode)result, call, LastError);
            return result;
        }

        internal int CheckRead(int result, string call)
        {
            if (result < 0) throw new KiriException((ResultCode)result, call, Hooks.Line ?? "");
            return result;
        }

        internal static int CheckStatic(int result, string call)
        {
            if (result < 0) throw new KiriException((ResultCode)result, call, "");
            return result;
        }

        internal static void CheckRoom(Array rows, int length)
        {
            if (rows != null && rows.Length < length) ThrowRange();
        }

        internal static string Text(byte* text) { return Marshal.PtrToStringAnsi((IntPtr)text); }
        internal static void ThrowRange() { throw new ArgumentOutOfRangeException(); }
        internal static void ThrowStale() { throw new InvalidOperationException("the world has ticked, or is gone, since it lent this"); }
    }

    public unsafe partial struct Sheet
    {
        /// <summary>Copies positions and normals of vertices to where the host wants them: strides in bytes; null: without.
        /// There must be room.</summary>
        public void CopyVertices(int first, int count, void* positions, int positionStride, void* normals, int normalStride)
        {
            World.CheckRead(Native.kiriSheet_CopyVertices(World.Handle, Id, first, count, positions, positionStride, normals, normalStride),
                            "Sheet.CopyVertices");
        }

        /// <summary>The same to rows of `stride` floats, with the position at the start and, unless below 3, the normal at
        /// `normalAt`.</summary>
        public void CopyVertices(int first, int count, float[] rows, int stride = 3, int normalAt = 0)
        {
            if (count < 0 || stride < 3 || normalAt > stride - 3 || (long)stride * count > rows.Length) World.ThrowRange();
            fixed (float* at = rows)
                CopyVertices(first, count, at, 4 * stride, normalAt < 3 ? null : at + normalAt, 4 * stride);
        }

        /// <summary>A cut along a polyline of rest points, 2 floats each, all at once.</summary>
        public Cut Cut(params float[] restPoints)
        {
            if (restPoints.Length < 2) World.ThrowRange();
            Cut cut = BeginCut(new Float2(restPoints[0], restPoints[1]));
            fixed (float* points = restPoints)
                if (restPoints.Length > 2)
                    World.Check(Native.kiriCut_Extend(World.Handle, cut.Id, points + 2, restPoints.Length / 2 - 1), "Cut.Extend");
            cut.End();
            return cut;
        }
    }

    /// <summary>A recording, and how far it has come.</summary>
    public sealed unsafe class Replay
    {
        readonly byte[] recording;
        NativeReplay raw;

        public Replay(byte[] recording)
        {
            this.recording = recording;
        }

        /// <summary>Makes the calls up to the next tick or note, and that one, in a world that was new at the start.</summary>
        public Status Step(World world)
        {
            Note = null;
            fixed (byte* bytes = recording)
            {
                int result;
                fixed (NativeReplay* at = &raw)
                    result = world.Replay(bytes, recording.Length, at);
                if (raw.Note != null)
                {
                    Note = new byte[raw.NoteCount];
                    Marshal.Copy((IntPtr)raw.Note, Note, 0, raw.NoteCount);
                }
                return result == 0 ? Status.Done : Status.Pending;
            }
        }

        /// <summary>Where it stopped at a note: its bytes.</summary>
        public byte[] Note { get; private set; }
        public long Offset { get { return raw.Offset; } }
        public long Calls { get { return raw.Calls; } }
        public long Ticks { get { return raw.Ticks; } }
    }

    public sealed unsafe partial class World
    {
        internal int Replay(byte* recording, long size, NativeReplay* replay)
        {
            EndViews();
            return Check(Native.kiriWorld_Replay(Handle, recording, size, replay), "World.Replay");
        }
    }
}
