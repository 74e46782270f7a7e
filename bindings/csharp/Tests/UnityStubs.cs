// As much of Unity as the components use, with the signatures that its manual has: so that they compile and run here.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector2 { public float x, y; public Vector2(float x, float y) { this.x = x; this.y = y; } }

    [StructLayout(LayoutKind.Sequential)]
    public struct Vector3 { public float x, y, z; public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; } }

    public struct Ray { public Vector3 origin, direction; public Ray(Vector3 origin, Vector3 direction) { this.origin = origin; this.direction = direction; } }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class RequireComponent : Attribute { public RequireComponent(Type a, Type b) { } }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class DefaultExecutionOrder : Attribute { public DefaultExecutionOrder(int order) { } }

    public static class Time { public static float fixedDeltaTime { get { return 0.02f; } } }
    public static class Debug { public static void LogWarning(object line) { Console.WriteLine(line); } }
    public sealed class Transform { public Vector3 position { get; set; } public Vector3 localScale { get; set; } }
    public class MonoBehaviour
    {
        readonly Dictionary<Type, object> components = new Dictionary<Type, object>();
        public readonly Transform transform = new Transform();

        public T GetComponent<T>() where T : new()
        {
            if (!components.ContainsKey(typeof(T))) components[typeof(T)] = new T();
            return (T)components[typeof(T)];
        }
    }
    public sealed class MeshFilter { public Mesh mesh { get; set; } }
    public sealed class MeshRenderer { }

    public sealed unsafe class Mesh
    {
        public Kiri.Unity.KiriSheet.Vertex[] Vertices;
        public int[] Indices;
        public Rendering.SubMeshDescriptor Drawn;

        public void MarkDynamic() { }
        public void RecalculateBounds() { }
        public void SetVertexBufferParams(int count, params Rendering.VertexAttributeDescriptor[] attributes)
        {
            Vertices = new Kiri.Unity.KiriSheet.Vertex[count];
        }
        public void SetIndexBufferParams(int count, Rendering.IndexFormat format) { Indices = new int[count]; }
        public void SetSubMesh(int index, Rendering.SubMeshDescriptor drawn, Rendering.MeshUpdateFlags flags = 0) { Drawn = drawn; }

        public void SetVertexBufferData<T>(Unity.Collections.NativeArray<T> data, int from, int to, int count, int stream = 0,
                                           Rendering.MeshUpdateFlags flags = 0) where T : struct
        {
            fixed (void* into = &Vertices[to]) Buffer.MemoryCopy(data.At, into, 32L * Vertices.Length, 32L * count);
        }

        public void SetIndexBufferData<T>(Unity.Collections.NativeArray<T> data, int from, int to, int count,
                                          Rendering.MeshUpdateFlags flags = 0) where T : struct
        {
            fixed (void* into = &Indices[to]) Buffer.MemoryCopy(data.At, into, 4L * Indices.Length, 4L * count);
        }
    }
}

namespace UnityEngine.Rendering
{
    public enum VertexAttribute { Position, Normal, Tangent, Color, TexCoord0 }
    public enum VertexAttributeFormat { Float32 }
    public enum IndexFormat { UInt16, UInt32 }
    [Flags] public enum MeshUpdateFlags { Default = 0, DontValidateIndices = 1, DontRecalculateBounds = 8 }
    public struct SubMeshDescriptor { public int Count; public SubMeshDescriptor(int start, int count) { Count = count; } }
    public struct VertexAttributeDescriptor
    {
        public VertexAttributeDescriptor(VertexAttribute attribute, VertexAttributeFormat format = VertexAttributeFormat.Float32, int dimension = 3, int stream = 0) { }
    }
}

namespace Unity.Collections
{
    public enum Allocator { Persistent = 4 }

    public unsafe struct NativeArray<T> : IDisposable where T : struct
    {
        internal void* At;
        public int Length { get; private set; }

        public NativeArray(int length, Allocator allocator)
        {
            int size = length * Marshal.SizeOf(typeof(T));
            At = (void*)Marshal.AllocHGlobal(size);
            for (int i = 0; i < size; ++i) ((byte*)At)[i] = 0;
            Length = length;
        }

        public bool IsCreated { get { return At != null; } }
        public void Dispose() { Marshal.FreeHGlobal((IntPtr)At); At = null; Length = 0; }
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
    public static unsafe class NativeArrayUnsafeUtility
    {
        public static void* GetUnsafePtr<T>(NativeArray<T> array) where T : struct { return array.At; }
    }

    public static unsafe class UnsafeUtility
    {
        public static void MemCpy(void* into, void* from, long size) { Buffer.MemoryCopy(from, into, size, size); }
    }
}
