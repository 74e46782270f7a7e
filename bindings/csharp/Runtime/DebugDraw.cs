using System;
using System.Runtime.InteropServices;

namespace Kiri
{
    /// <summary>What vertices are drawn as: one for a point, two for a line, three for a triangle.</summary>
    public enum Shape { Points, Lines, Triangles }

    /// <summary>Gets the next vertices, up to 240 in a call. They are the library's, and gone after it. It may not throw.</summary>
    public unsafe delegate void DrawHandler(Shape shape, DrawVertex* vertices, int count);

    public sealed unsafe partial class World
    {
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        delegate void DrawFn(IntPtr user, DrawVertex* vertices, int count);

        static readonly DrawFn onPoints = OnPoints, onLines = OnLines, onTriangles = OnTriangles;

        /// <summary>Draws the world as after the last tick.</summary>
        public void DebugDraw(DebugDraw what, DrawHandler draw)
        {
            GCHandle user = GCHandle.Alloc(draw);
            try
            {
                what.Points = Marshal.GetFunctionPointerForDelegate(onPoints);
                what.Lines = Marshal.GetFunctionPointerForDelegate(onLines);
                what.Triangles = Marshal.GetFunctionPointerForDelegate(onTriangles);
                what.user = GCHandle.ToIntPtr(user).ToPointer();
                CheckRead(Native.kiriWorld_DebugDraw(Handle, &what), "World.DebugDraw");
            }
            finally { user.Free(); }
        }

        static void Draw(IntPtr user, Shape shape, DrawVertex* vertices, int count)
        {
            ((DrawHandler)GCHandle.FromIntPtr(user).Target)(shape, vertices, count);
        }

#if ENABLE_IL2CPP
        [AOT.MonoPInvokeCallback(typeof(DrawFn))]
#endif
        static void OnPoints(IntPtr user, DrawVertex* vertices, int count) { Draw(user, Shape.Points, vertices, count); }

#if ENABLE_IL2CPP
        [AOT.MonoPInvokeCallback(typeof(DrawFn))]
#endif
        static void OnLines(IntPtr user, DrawVertex* vertices, int count) { Draw(user, Shape.Lines, vertices, count); }

#if ENABLE_IL2CPP
        [AOT.MonoPInvokeCallback(typeof(DrawFn))]
#endif
        static void OnTriangles(IntPtr user, DrawVertex* vertices, int count) { Draw(user, Shape.Triangles, vertices, count); }
    }
}
