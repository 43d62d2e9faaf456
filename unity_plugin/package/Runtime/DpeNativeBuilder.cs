// Makes a scene of meshes. Nothing here needs Unity; coordinates are the library's.
using System;

namespace Dpe
{
    public sealed class DpeNativeBuilder : IDisposable
    {
        private ulong handle;

        public DpeNativeBuilder()
        {
            DpeText.Check(DpeNative.dpe_builder_create(DpeNative.HeaderVersion, out handle));
        }

        ~DpeNativeBuilder()
        {
            Destroy();
        }

        public static DpeMaterial DefaultMaterial()
        {
            DpeMaterial material;
            DpeText.Check(DpeNative.dpe_material_default(out material));
            return material;
        }

        public void Dispose()
        {
            Destroy();
            GC.SuppressFinalize(this);
        }

        public int AddMesh(double[] positions, int[] triangles, DpeMaterial material)
        {
            int objectIndex;
            DpeText.Check(DpeNative.dpe_builder_add_mesh(handle, positions, positions.Length,
                                                         triangles, triangles.Length,
                                                         ref material, out objectIndex));
            return objectIndex;
        }

        public void PinVertices(int objectIndex, int[] vertices)
        {
            DpeText.Check(DpeNative.dpe_builder_pin_vertices(handle, objectIndex, vertices,
                                                             vertices.Length));
        }

        public void AddCollider(DpeColliderData collider)
        {
            DpeText.Check(DpeNative.dpe_builder_add_collider(handle, ref collider));
        }

        public void SetWind(double[] wind)
        {
            DpeText.Check(DpeNative.dpe_builder_set_wind(handle, wind));
        }

        public void SetTime(double frameLength, int stepsPerFrame, int numFrames)
        {
            DpeText.Check(DpeNative.dpe_builder_set_time(handle, frameLength, stepsPerFrame,
                                                         numFrames));
        }

        public void SetSettings(string settings)
        {
            DpeText.Check(
                DpeNative.dpe_builder_set_settings(handle, DpeText.ToBytes(settings)));
        }

        public void SetMethod(string title, string integrationMethod)
        {
            DpeText.Check(DpeNative.dpe_builder_set_method(
                handle, DpeText.ToBytes(title), DpeText.ToBytes(integrationMethod)));
        }

        public DpeNativeScene Build()
        {
            ulong scene;
            DpeText.Check(DpeNative.dpe_builder_build(handle, out scene));
            return new DpeNativeScene(scene);
        }

        private void Destroy()
        {
            if (handle != 0) DpeNative.dpe_builder_destroy(handle);
            handle = 0;
        }
    }
}
