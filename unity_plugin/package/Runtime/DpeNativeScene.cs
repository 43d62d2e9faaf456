// A scene of the library. Nothing here needs Unity: coordinates are the library's, which
// are right-handed (DpeCoordinates converts).
using System;

namespace Dpe
{
    public sealed class DpeNativeScene : IDisposable
    {
        private ulong handle;

        // Takes over a handle.
        public DpeNativeScene(ulong handle)
        {
            this.handle = handle;
        }

        // Who forgets Dispose leaks nothing: the library's thread ends here.
        ~DpeNativeScene()
        {
            Destroy();
        }

        public ulong Handle => handle;

        public static DpeNativeScene FromFile(string path)
        {
            ulong scene;
            DpeText.Check(DpeNative.dpe_scene_create_from_file(
                DpeNative.HeaderVersion, DpeText.ToBytes(path), out scene));
            return new DpeNativeScene(scene);
        }

        public static DpeNativeScene FromJson(string json)
        {
            ulong scene;
            DpeText.Check(DpeNative.dpe_scene_create_from_json(
                DpeNative.HeaderVersion, DpeText.ToBytes(json), out scene));
            return new DpeNativeScene(scene);
        }

        public void Dispose()
        {
            Destroy();
            GC.SuppressFinalize(this);
        }

        public DpeSceneInfo Info()
        {
            DpeSceneInfo info;
            DpeText.Check(DpeNative.dpe_scene_get_info(handle, out info));
            return info;
        }

        public DpeObjectInfo ObjectInfo(int objectIndex)
        {
            DpeObjectInfo info;
            DpeText.Check(DpeNative.dpe_scene_get_object_info(handle, objectIndex, out info));
            return info;
        }

        public int[] Triangles(int objectIndex)
        {
            var vertices = new int[3 * ObjectInfo(objectIndex).NumTriangles];
            int count;
            DpeText.Check(DpeNative.dpe_scene_get_triangles(handle, objectIndex, vertices,
                                                            vertices.Length, out count));
            return vertices;
        }

        public void Step(int numFrames)
        {
            DpeText.Check(DpeNative.dpe_scene_step(handle, numFrames));
        }

        public void Start()
        {
            DpeText.Check(DpeNative.dpe_scene_start(handle));
        }

        public void Pause()
        {
            DpeText.Check(DpeNative.dpe_scene_pause(handle));
        }

        public void Stop()
        {
            DpeText.Check(DpeNative.dpe_scene_stop(handle));
        }

        public void SetRate(double rate)
        {
            DpeText.Check(DpeNative.dpe_scene_set_rate(handle, rate));
        }

        // True if there was something new. Makes no garbage and does not wait.
        public bool CopyPositions(int objectIndex, float[] positions, ref ulong sequence,
                                  out long frame)
        {
            int isNew;
            DpeText.Check(DpeNative.dpe_scene_copy_positions(handle, objectIndex, positions,
                                                             positions.Length, ref sequence,
                                                             out frame, out isNew));
            return isNew != 0;
        }

        public double[] GetParameter(int objectIndex, DpeParameter kind)
        {
            int count;
            var values = new double[0];
            if (DpeNative.dpe_scene_get_parameter(handle, objectIndex, (int)kind, values, 0,
                                                  out count) == DpeStatus.Buffer)
            {
                values = new double[count];
            }
            DpeText.Check(DpeNative.dpe_scene_get_parameter(handle, objectIndex, (int)kind,
                                                            values, values.Length,
                                                            out count));
            return values;
        }

        // One value for all elements, or as many as there are.
        public void SetParameter(int objectIndex, DpeParameter kind, double[] values)
        {
            DpeText.Check(DpeNative.dpe_scene_set_parameter(handle, objectIndex, (int)kind,
                                                            values, values.Length));
        }

        public void LoadOptimized(string path)
        {
            DpeText.Check(DpeNative.dpe_scene_load_optimized(handle, DpeText.ToBytes(path)));
        }

        public int AddCollider(DpeColliderData collider)
        {
            int id;
            DpeText.Check(DpeNative.dpe_scene_add_collider(handle, ref collider, out id));
            return id;
        }

        public void SetCollider(int id, DpeColliderData collider)
        {
            DpeText.Check(DpeNative.dpe_scene_set_collider(handle, id, ref collider));
        }

        public void RemoveCollider(int id)
        {
            DpeText.Check(DpeNative.dpe_scene_remove_collider(handle, id));
        }

        public void MoveVertices(int objectIndex, int[] vertices, double[] positions)
        {
            DpeText.Check(DpeNative.dpe_scene_move_vertices(handle, objectIndex, vertices,
                                                            positions, vertices.Length));
        }

        public void SetFixed(int objectIndex, int vertex, bool isFixed)
        {
            DpeText.Check(DpeNative.dpe_scene_set_fixed(handle, objectIndex, vertex,
                                                        isFixed ? 1 : 0));
        }

        public void Save(string path)
        {
            DpeText.Check(DpeNative.dpe_scene_save(handle, DpeText.ToBytes(path)));
        }

        private void Destroy()
        {
            if (handle != 0) DpeNative.dpe_scene_destroy(handle);
            handle = 0;
        }
    }
}
