// Every function of the native library, as dpe/dpe_c.h declares and documents it. No other
// file of the package imports anything. Nothing here needs Unity.
using System;
using System.Runtime.InteropServices;

namespace Dpe
{
    public enum DpeStatus
    {
        Ok = 0,
        Argument = 1,
        Handle = 2,
        Version = 3,
        Input = 4,
        State = 5,
        Buffer = 6,
        Simulation = 7,
        Memory = 8,
        Internal = 9
    }

    public enum DpeState { Stopped = 0, Running = 1, Paused = 2, Failed = 3 }

    public enum DpeParameter { Mass = 0, Stiffness = 1, Damping = 2, Drag = 3, Wind = 4 }

    public enum DpeColliderType { Plane = 0, Sphere = 1 }

    public enum DpeEstimationState
    {
        Idle = 0,
        Running = 1,
        Done = 2,
        Cancelled = 3,
        Failed = 4
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeSceneInfo
    {
        public int NumObjects;
        public int NumColliders;
        public int NumFrames;
        public int StepsPerFrame;
        public double FrameLength;
        public int State;
        public int Reserved;
        public long Frame;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeObjectInfo
    {
        public int NumVertices;
        public int NumTriangles;
        public int NumSprings;
        public int NumFixed;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeColliderData
    {
        public int Type;
        public int Reserved;
        public double PositionX, PositionY, PositionZ;
        public double RotationX, RotationY, RotationZ;
        public double Radius;
        public double Stiffness;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpePlaybackInfo
    {
        public int NumObjects;
        public int NumFrames;
        public double FrameLength;
        public double Duration;
        public double Time;
        public double Rate;
        public int State;
        public int Loop;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeMaterial
    {
        public double TractionStiffness;
        public double BendingStiffness;
        public double ShearStiffness;
        public double Density;
        public double Damping;
        public double Drag;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeProgress
    {
        public int Iteration;
        public int NumFrames;
        public double Cost;
        public double Rms;
        public double Seconds;
        public double Fraction;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeResult
    {
        public int Termination;
        public int Iterations;
        public int NumFrames;
        public int NumBlocks;
        public int NumParameters;
        public int Reserved;
        public double InitialRms;
        public double FinalRms;
        public double Seconds;
        public double DeviationPercent;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct DpeBlock
    {
        public int Object;
        public int Kind;
        public int Mode;
        public int NumValues;
        public int HasErrors;
        public int Reserved;
    }

    // Called in a thread of the library. With IL2CPP it has to be a static method with
    // [MonoPInvokeCallback]; the package itself polls instead.
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public delegate void DpeProgressCallback(IntPtr user, ref DpeProgress progress);

    // Text goes in and out as UTF-8 bytes with a zero byte at the end, see DpeText.
    public static class DpeNative
    {
        public const uint HeaderVersion = 1u << 16;

        private const string Library = "dpe_unity";
        private const CallingConvention Convention = CallingConvention.Cdecl;

        [DllImport(Library, CallingConvention = Convention)]
        public static extern uint dpe_version();

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_check_version(uint header);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern IntPtr dpe_status_name(DpeStatus status);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_last_error(
            ulong handle, [Out] byte[] buffer, int capacity, out int length);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_shutdown();

        [DllImport(Library, CallingConvention = Convention)]
        public static extern int dpe_live_handles();

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_create_from_file(
            uint headerVersion, byte[] path, out ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_create_from_json(
            uint headerVersion, byte[] json, out ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_destroy(ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_warnings(
            ulong scene, [Out] byte[] buffer, int capacity, out int length);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_info(ulong scene, out DpeSceneInfo info);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_object_info(
            ulong scene, int objectIndex, out DpeObjectInfo info);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_triangles(
            ulong scene, int objectIndex, [Out] int[] vertices, int capacity, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_springs(
            ulong scene, int objectIndex, [Out] int[] vertices, int capacity, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_fixed(
            ulong scene, int objectIndex, [Out] byte[] flags, int capacity, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_step(ulong scene, int numFrames);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_start(ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_pause(ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_stop(ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_set_rate(ulong scene, double rate);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_copy_positions(
            ulong scene, int objectIndex, [Out] float[] positions, int capacity,
            ref ulong sequence, out long frame, out int isNew);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_to_json(
            ulong scene, [Out] byte[] buffer, int capacity, out int length);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_save(ulong scene, byte[] path);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_parameter(
            ulong scene, int objectIndex, int kind, [Out] double[] values, int capacity,
            out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_set_parameter(
            ulong scene, int objectIndex, int kind, double[] values, int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_load_optimized(ulong scene, byte[] path);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_add_collider(
            ulong scene, ref DpeColliderData collider, out int id);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_set_collider(
            ulong scene, int id, ref DpeColliderData collider);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_collider(
            ulong scene, int id, out DpeColliderData collider);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_remove_collider(ulong scene, int id);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_get_collider_ids(
            ulong scene, [Out] int[] ids, int capacity, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_move_vertices(
            ulong scene, int objectIndex, int[] vertices, double[] positions, int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_scene_set_fixed(
            ulong scene, int objectIndex, int vertex, int isFixed);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_create(
            uint headerVersion, ulong scene, byte[] path, out ulong playback);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_destroy(ulong playback);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_get_info(
            ulong playback, out DpePlaybackInfo info);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_start(ulong playback);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_pause(ulong playback);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_stop(ulong playback);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_seek(ulong playback, double time);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_set_rate(ulong playback, double rate);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_set_loop(ulong playback, int loop);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_playback_copy_positions(
            ulong playback, int objectIndex, [Out] float[] positions, int capacity,
            ref ulong sequence, out long frame, out int isNew);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_create(
            uint headerVersion, out ulong builder);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_destroy(ulong builder);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_material_default(out DpeMaterial material);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_add_mesh(
            ulong builder, double[] positions, int numPositions, int[] triangles,
            int numIndices, ref DpeMaterial material, out int objectIndex);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_pin_box(
            ulong builder, int objectIndex, double[] lower, double[] upper, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_pin_vertices(
            ulong builder, int objectIndex, int[] vertices, int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_add_collider(
            ulong builder, ref DpeColliderData collider);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_set_wind(ulong builder, double[] wind);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_set_time(
            ulong builder, double frameLength, int stepsPerFrame, int numFrames);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_set_settings(ulong builder, byte[] settings);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_set_method(
            ulong builder, byte[] title, byte[] integrationMethod);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_builder_build(ulong builder, out ulong scene);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_create(
            uint headerVersion, out ulong estimation);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_destroy(ulong estimation);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_set_text(
            ulong estimation, byte[] name, byte[] value);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_set_number(
            ulong estimation, byte[] name, double value);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_set_callback(
            ulong estimation, DpeProgressCallback callback, IntPtr user);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_start(ulong estimation);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_cancel(ulong estimation);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_poll(
            ulong estimation, out int state, out DpeProgress progress);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_wait(
            ulong estimation, double seconds, out int state);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_get_result(
            ulong estimation, out DpeResult result);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_get_message(
            ulong estimation, [Out] byte[] buffer, int capacity, out int length);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_get_block(
            ulong estimation, int block, out DpeBlock info);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_get_values(
            ulong estimation, int block, [Out] double[] values, int capacity, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_get_errors(
            ulong estimation, int block, [Out] double[] errors, int capacity, out int count);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_get_files(
            ulong estimation, [Out] byte[] buffer, int capacity, out int length);

        [DllImport(Library, CallingConvention = Convention)]
        public static extern DpeStatus dpe_estimation_create_scene(
            ulong estimation, out ulong scene);
    }
}
